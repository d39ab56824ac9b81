"""Finite elements: data (catalogue, shapes, quadrature) and the quantities of a zone."""

from ssilang.kernel.elements.catalog import (
    ELEMENTS,
    ElementKind,
    default_element,
    register_element,
    support_rule,
)
from ssilang.kernel.elements.families import (
    elastic_strain,
    elastic_stress,
    family_of,
    geometric_stiffness,
    integration_weights,
    internal_forces,
    mass,
    register_family,
    stiffness,
    strain,
    stress,
    viscosity,
)
from ssilang.kernel.elements.family import ElementFamily, Layout, StrainOperator
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field

__all__ = [
    "ELEMENTS",
    "ElementFamily",
    "ElementKind",
    "Layout",
    "StrainOperator",
    "ZoneField",
    "default_element",
    "elastic_strain",
    "elastic_stress",
    "family_of",
    "geometric_stiffness",
    "integration_weights",
    "internal_forces",
    "mass",
    "register_element",
    "register_family",
    "stiffness",
    "strain",
    "stress",
    "support_rule",
    "viscosity",
    "zone_field",
]
