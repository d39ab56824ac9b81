"""Continuous elements against what holds for any of them: weights, rigid motions, mass."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import Layout
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.samples import PLANE, SPACE, cell_zone, field, material

E, NU = 2.0e5, 0.3


def _vector(block, nodal):
    return Layout(block.table, block.raw_nodes, block.local, block.unknowns).gather(nodal)[0]


@together("element", [*PLANE, *SPACE])
def test_weights_are_those_of_the_strain_operator(element):
    mode = Mode.PLANE_STRESS if element in PLANE else Mode.THREE_DIMENSIONAL
    zone = cell_zone(element, mode)
    values = {"DIM3": 0.25} if element in PLANE else {"RHO": 2.0}
    parameters = zone_field(zone, material(zone, YOUN=E, NU=NU, **values))
    weights = family_of(zone).weights(zone, parameters, "RIGIDITE")
    whole = slice(0, len(zone.cells))
    expected = family_of(zone).strain_operator(zone, parameters, "RIGIDITE", whole).weights
    np.testing.assert_allclose(weights, expected, rtol=1e-13)


def test_axisymmetric_pressure_vessel_strain_has_the_hoop_component():
    zone = cell_zone("QUA8", Mode.AXISYMMETRIC)
    u = field(zone, UR=lambda x: 2e-3 * x[:, 0], UZ=lambda x: -1e-3 * x[:, 1])
    block = families.strain(zone, u)
    for name, value in {"EPRR": 2e-3, "EPZZ": -1e-3, "EPTT": 2e-3, "GARZ": 0.0}.items():
        np.testing.assert_allclose(block.components[name], value, atol=1e-14)


def test_thickness_scales_plane_stress_only():
    flat = cell_zone("QUA4", Mode.PLANE_STRESS)
    thin = families.stiffness(flat, material(flat, YOUN=E, NU=NU, DIM3=0.1)).values
    unit = families.stiffness(flat, material(flat, YOUN=E, NU=NU)).values
    np.testing.assert_allclose(thin, 0.1 * unit)


def test_incompressible_element_does_not_lock_in_volume():
    zone = cell_zone("ICQ4", Mode.PLANE_STRAIN)
    usual = cell_zone("QUA4", Mode.PLANE_STRAIN)
    bend = {"UX": lambda x: (x[:, 0] - 3) * x[:, 1], "UY": lambda x: 0.0 * x[:, 0]}
    energies = []
    for z in (zone, usual):
        block = families.stiffness(z, material(z, YOUN=1.0, NU=0.49999))
        v = _vector(block, field(z, **bend))
        energies.append(v @ block.values[0] @ v)
    assert energies[0] < 1e-2 * energies[1]


def test_missing_and_inadmissible_parameters_are_named():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    with pytest.raises(MaterialError, match="NU is missing"):
        families.stiffness(zone, material(zone, YOUN=E))
    with pytest.raises(MaterialError, match=r"0\.5"):
        families.stiffness(zone, material(zone, YOUN=E, NU=0.5))


def test_folded_cell_is_refused():
    zone = cell_zone("QUA4", Mode.PLANE_STRAIN)
    nodes = zone.cells.connectivity[0]
    zone.cells.nodes.coordinates[nodes[2]] = zone.cells.nodes.coordinates[nodes[0]] - [1, 1, 0]
    with pytest.raises(MeshError, match="Jacobian"):
        families.stiffness(zone, material(zone, YOUN=E, NU=NU))
