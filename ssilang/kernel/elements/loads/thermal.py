"""Strains without stress: those that a change of temperature causes, or as they are given."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.elements.beams.fibre_section import section_of_beam
from ssilang.kernel.elements.catalog import SOLID_FAMILIES, THIN_SHELLS, family_name, support_shapes
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.shells.thick_shell import ACROSS
from ssilang.kernel.elements.solids.kinematics import as_components
from ssilang.kernel.elements.solids.solid_moduli import material_axes, symmetry_of
from ssilang.kernel.elements.zone_fields import ZoneField, n_points, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.mesh.cells import CELL_TYPES

JOINT_RATES = {
    "DRN": ("ALPN",), "EXX": ("ALPN",), "GXY": ("ALPS", "ALP1"), "GXZ": ("ALP2",),
    "CXX": ("ALQN",), "CXY": ("ALQ1",), "CXZ": ("ALQS", "ALQ2"),
}  # fmt: skip
"""Jumps of a joint that temperature makes, and their coefficients (m/K, 1/K), in 2D and 3D."""
FULL_RATES = {
    "EXX": ("ALP1",), "GXY": ("ALP2",), "GXZ": ("ALP3",),
    "CXX": ("ALQ1",), "CXY": ("ALQ2",), "CXZ": ("ALQ3",),
}  # fmt: skip
"""Those of anisotropic joints of two points, in the order of their moduli."""
SKINS = ("TINF", "TSUP")
"""Temperatures of a shell's lower and upper skin, beside that of its middle, T."""


def temperature(zone: Zone, field: NodeField | CellField, name: str = "T") -> FloatArray:
    """Temperature (n_cells, n_points) at the points of 'STRESSES'."""
    if isinstance(field, CellField):
        seen = zone_field(zone, field)
        chosen = name if name in seen.names else (seen.names or (name,))[0]
        values = seen.at(chosen, "STRESSES")
        return np.broadcast_to(values, (len(zone.cells), n_points(zone.element, "STRESSES")))
    if name not in field.components:
        raise FieldError(
            "kernel.elements.field-no-component", name=name, components=field.components
        )
    return (
        field.values_at(name, zone.cells.connectivity) @ support_shapes(zone.element, "STRESSES").T
    )


def refuse_expanding(joints: list[Zone], material: CellField | None) -> None:
    """Refuse joints with a law that expand where temperatures load a model in time.

    Raises
    ------
    MaterialError
        If one has a coefficient of expansion: laws of joints take no free jumps.
    """
    for seen in (zone_field(z, material) for z in joints):
        for name in {n for rates in JOINT_RATES.values() for n in rates if n in seen}:
            if np.any(seen.at(name, "STRESSES")):
                raise MaterialError("kernel.elements.joints-expand-in-time", name=name)


def thermal_strain(zone: Zone, material: CellField, field: NodeField | CellField) -> FloatArray:
    """Strains ALPH (T - TALP), (n_cells, n_strains, n_points); zero where ALPH is not given.

    Orthotropic elements expand by ALP1 ALP2 (ALP3) along their axes. Linear elements whose volume
    change is a mean take the cell's mean temperature, too: else T locks what they free. Shells
    take TINF T TSUP, the temperatures of the lower skin, the middle and the upper skin, or T
    alone. Joints open by ALPN and slide and turn by its kin, of temperatures at their own points.

    Raises
    ------
    FieldError
        If the temperatures of a joint stand at nodes, of which it has two at one place.
    """
    family = family_of(zone)
    parameters = zone_field(zone, material)
    kind = family_name(zone)
    if kind == "joint" and isinstance(field, NodeField):
        raise FieldError("kernel.elements.temperature-joints-cells", element=zone.element)
    rise = temperature(zone, field) - parameters.at("TALP", "STRESSES", 0.0)
    names = family.strain_names(zone)
    values = np.zeros((len(zone.cells), len(names), rise.shape[1]))
    if kind in SOLID_FAMILIES:
        if kind == "incompressible" and CELL_TYPES[zone.cells.cell_type].degree == 1:
            rise = np.broadcast_to(rise.mean(axis=1, keepdims=True), rise.shape)
        return _solid(zone, parameters, rise, len(names))
    if kind == "solid shell":
        values[:, :6] = _solid(zone, parameters, rise, 6)
        return values
    if "SECTION" in zone.behaviour:
        if any("ALPH" in part.parameters for part in section_of_beam(parameters).zones):
            raise MaterialError("kernel.elements.thermal-expansion-sections-fibres")
        return values
    if kind == "joint":
        known = FULL_RATES if "ANISOTROPE" in zone.behaviour else JOINT_RATES
        for i, name in enumerate(names):
            rates = known.get(name, ())
            values[:, i] = sum(parameters.at(r, "STRESSES", 0.0) for r in rates) * rise
        return values
    if kind in THIN_SHELLS:
        return _thin_shell(zone, parameters, field, names)
    if kind == "thick":
        values[:, :3] = _shell_rates(zone, parameters) * _across(zone, parameters, field)[:, None]
        return values
    values[:, 0] = parameters.at("ALPH", "STRESSES", 0.0) * rise
    return values


def _skins(zone: Zone, field: NodeField | CellField) -> tuple[FloatArray, FloatArray] | None:
    """Temperatures (n_cells, n_points) of both skins; None where the middle's holds all across."""
    known = zone_field(zone, field).names if isinstance(field, CellField) else field.components
    if not any(n in known for n in SKINS):
        return None
    missing = [n for n in ("T", *SKINS) if n not in known]
    if missing:
        raise FieldError("kernel.elements.field-no-component", name=missing[0], components=known)
    lower, upper = (temperature(zone, field, n) for n in SKINS)
    return lower, upper


def _rates_along_axes(zone: Zone, parameters: ZoneField) -> list[FloatArray]:
    """Expansion along the three axes of orthotropy; of one direction: along it."""
    names = ("ALPH", "", "") if symmetry_of(zone) == "UNIDIRECTIONNEL" else ("ALP1", "ALP2", "ALP3")
    return [parameters.at(n, "STRESSES", 0.0) for n in names]


def _shell_rates(zone: Zone, parameters: ZoneField) -> FloatArray:
    """Expansion (n_cells or 1, 3, n_points or 1) along s, t and shear, in the own frame."""
    if symmetry_of(zone) == "ISOTROPE":
        alpha = parameters.at("ALPH", "STRESSES", 0.0)
        return np.stack([alpha, alpha, 0.0 * alpha], axis=1)
    first, second, _ = _rates_along_axes(zone, parameters)
    c, s = (parameters.at(n, "STRESSES") for n in ("V1X", "V1Y"))
    rates = np.broadcast_arrays(
        first * c**2 + second * s**2,
        first * s**2 + second * c**2,
        2 * c * s * (first - second),
    )
    return np.stack(rates, axis=1)


def _thin_shell(
    zone: Zone, parameters: ZoneField, field: NodeField | CellField, names: tuple[str, ...]
) -> FloatArray:
    """Membrane strains of the mean across the thickness, curvatures of the skins' difference.

    The temperature is a parabola across the thickness, through T and those of both skins.
    """
    middle, skins = temperature(zone, field), _skins(zone, field)
    mean, slope = middle, np.zeros_like(middle)
    if skins is not None:
        lower, upper = skins
        mean = (lower + 4 * middle + upper) / 6
        slope = (upper - lower) / parameters.at("EPAI", "STRESSES")
    mean = mean - parameters.at("TALP", "STRESSES", 0.0)
    rates = _shell_rates(zone, parameters)
    along, around, shear = (rates[:, i] for i in range(3))
    found = {
        "EPSS": along * mean, "EPTT": around * mean, "EPZZ": around * mean, "GAST": shear * mean,
        "RTSS": along * slope, "RTTT": around * slope, "RTZZ": around * slope,
        "RTST": shear * slope,
    }  # fmt: skip
    nothing = np.zeros_like(mean)
    return np.stack([np.broadcast_to(found.get(n, nothing), mean.shape) for n in names], axis=1)


def _across(zone: Zone, parameters: ZoneField, field: NodeField | CellField) -> FloatArray:
    """Change of temperature (n_cells, n_points) at the points across a thick shell."""
    middle, skins = temperature(zone, field), _skins(zone, field)
    found = middle - parameters.at("TALP", "STRESSES", 0.0)
    if skins is None:
        return found
    lower, upper = skins
    n_points = middle.shape[1]
    height = np.where(np.arange(n_points) < n_points // 2, -1.0, 1.0) * ACROSS
    found = found + (upper - lower) / 2 * height + (lower + upper - 2 * middle) / 2 * height**2
    return np.asarray(found)


def given_strain(zone: Zone, field: CellField) -> FloatArray:
    """A field of strains (n_cells, n_strains, n_points) at the points of 'STRESSES'.

    Components that the field lacks, and all on zones that it does not cover, are zero.
    """
    return zone_field(zone, field).matrix(family_of(zone).strain_names(zone), "STRESSES")


def _solid(zone: Zone, parameters: ZoneField, rise: FloatArray, n_strains: int) -> FloatArray:
    if symmetry_of(zone) == "ISOTROPE":
        alpha = parameters.at("ALPH", "STRESSES", 0.0) * rise
        T = alpha[..., None, None] * np.eye(3)
    else:
        axes = material_axes(parameters, "STRESSES")
        rates = np.zeros((*rise.shape, 3, 3))
        for i, rate in enumerate(_rates_along_axes(zone, parameters)):
            rates[..., i, i] = rate
        if symmetry_of(zone) == "ANISOTROPE":
            for i, j in ((0, 1), (0, 2), (1, 2)):  # angles of shear
                angle = parameters.at(f"AL{i + 1}{j + 1}", "STRESSES", 0.0)
                rates[..., i, j] = rates[..., j, i] = angle / 2
        axes = np.broadcast_to(axes, (*rise.shape, 3, 3))
        T = np.einsum("cpki,cp,cpkl,cplj->cpij", axes, rise, rates, axes)
    return as_components(T, n_strains, strains=True)
