"""The compiled sum of products of gradients against the strain operator, cell by cell."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.elements.solids import solid
from ssilang.kernel.elements.solids.solid_products import _cofactors
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable

SPACE, PLANE = Mode.THREE_DIMENSIONAL, Mode.PLANE_STRAIN


def zone_of(cell_type, mode, spoilt="", n=5, axes="ISOTROPE"):
    """Crooked cells that share nothing, one of them folded or flat if asked."""
    random, table = np.random.default_rng(0), NodeTable()
    corners = REFERENCE_CELLS[cell_type].nodes.clip(0.0)  # of side one
    points = corners + 0.15 * random.standard_normal((n, *corners.shape))
    if spoilt == "folded":
        points[1] = points[1, [1, 0, *range(2, len(corners))]]
    elif spoilt == "flat":
        points[1, :, -1] = 0.0
    cells = table.add(points.reshape(-1, corners.shape[1])).reshape(n, -1)
    block = CellBlock.make(table, cell_type, cells)
    return Zone(block, "MECANIQUE", ("ELASTIQUE", axes), cell_type, mode)


def field_of(zone, parameters):
    return CellField((CellFieldBlock(zone.cells, parameters, "STRESSES", zone.element),))


def matrices(zone, parameters, monkeypatch):
    """Element matrices by the compiled sum if it takes them, and without it."""
    field = field_of(zone, parameters)
    seen, made = [], solid.uniform_stiffness

    def watched(*given):
        seen.append(made(*given))
        return seen[-1]

    monkeypatch.setattr(solid, "MANY_TERMS", 0)
    monkeypatch.setattr(solid, "uniform_stiffness", watched)
    found = families.stiffness(zone, field).values
    monkeypatch.setattr(solid, "uniform_stiffness", lambda *given: None)
    return found, families.stiffness(zone, field).values, seen[0] is not None


@together("d", [1, 2, 3])
def test_cofactors_are_the_inverse_s_and_stay_in_their_matrix(d):
    J, room = np.random.default_rng(d).standard_normal((d, d)), np.full((5, d), 7.0)
    det = _cofactors(J, room[:d])
    np.testing.assert_allclose(room[:d], det * np.linalg.inv(J).T, rtol=1e-12)
    assert det == pytest.approx(np.linalg.det(J), rel=1e-12)
    assert (room[d:] == 7.0).all()


STRESS = Mode.PLANE_STRESS


@together(
    "cell_type, mode",
    [("CUB8", SPACE), ("TET4", SPACE), ("QUA4", PLANE), ("TRI3", PLANE), ("QUA4", STRESS)],
)
@together("uniform", [True, False])
def test_crooked_cells_have_the_same_matrices(cell_type, mode, uniform, monkeypatch):
    zone = zone_of(cell_type, mode)
    young = 1e9 * np.ones((5, 1)) if uniform else 1e9 * np.arange(1.0, 6.0)[:, None]
    parameters = {"YOUN": young, "NU": np.full((5, 1), 0.3)}
    if mode is Mode.PLANE_STRESS:
        parameters["DIM3"] = np.linspace(0.1, 0.4, 5)[:, None]
    found, expected, compiled = matrices(zone, parameters, monkeypatch)
    assert compiled
    np.testing.assert_allclose(found, expected, atol=1e-13 * np.abs(expected).max())


def test_moduli_that_change_inside_a_cell_are_summed_at_points(monkeypatch):
    zone = zone_of("QUA4", PLANE)
    young = 1e9 * np.random.default_rng(1).uniform(1.0, 2.0, (5, 4))
    found, expected, compiled = matrices(
        zone, {"YOUN": young, "NU": np.full((5, 1), 0.3)}, monkeypatch
    )
    assert not compiled
    assert (found == expected).all()


@together("spoilt", ["folded", "flat"])
@together("cell_type, mode", [("CUB8", SPACE), ("QUA4", PLANE)])
def test_folded_cells_are_named(cell_type, mode, spoilt, monkeypatch):
    zone = zone_of(cell_type, mode, spoilt)
    parameters = {"YOUN": np.full((5, 1), 1e9), "NU": np.full((5, 1), 0.3)}
    monkeypatch.setattr(solid, "MANY_TERMS", 0)  # the sum at points would refuse them too
    with pytest.raises(MeshError, match="being number 2"):
        families.stiffness(zone, field_of(zone, parameters))
