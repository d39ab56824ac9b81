"""Fields carried to other meshes, models and axes: two zones, values that are not alike."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.results.frames import (
    SurfaceAxes,
    following_axes,
    is_flat_shell,
    points_of,
    shell_in_axes,
    strains_or_stresses,
)
from ssilang.kernel.elements.results.projection import by_least_squares, on_mesh, on_model
from ssilang.kernel.elements.shells.flat_shell import flat_frames
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface import family as _joints  # noqa: F401
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from tests.kernel.elements.samples import ELASTIC, TILT, line_zone, model, tilted_plate

COARSE = np.array([[0, 0], [4, 0], [4, 3], [0, 3], [8, 0], [8, 3]])


@pytest.fixture
def source():
    """A bilinear field on a square, a constant on two triangles beside it, another component."""
    table = NodeTable()
    ids = table.add(COARSE)
    square = CellBlock.make(table, "QUA4", ids[[[0, 1, 2, 3]]])
    pair = CellBlock.make(table, "TRI3", ids[[[1, 4, 5], [1, 5, 2]]])
    x = square.coordinates[0]
    return table, CellField((
        CellFieldBlock(square, {"A": (1 + x[:, 0] + 2 * x[:, 1] * x[:, 0])[None]}),
        CellFieldBlock(pair, {"A": np.array([[5.0], [7.0]]), "B": np.array([[3.0]])}),
    ), "title")  # fmt: skip


def exact(x):
    """A, and whether it is known; on the common side the square comes first."""
    a = np.where(x[:, 0] <= 4, 1 + x[:, 0] + 2 * x[:, 1] * x[:, 0],
                 np.where(x[:, 1] < 0.75 * (x[:, 0] - 4), 5.0, 7.0))  # fmt: skip
    return a, (x[:, 0] <= 8) & (x[:, 1] <= 3)


PLACES = np.array([[1.0, 1.0], [3.5, 2.9], [7.0, 1.0], [5.0, 2.5], [9.0, 1.0], [4.0, 1.0]])


def test_nodes_take_the_value_of_the_first_cell_that_holds_them(source):
    table, field = source
    ids = table.add(PLACES)
    lost = []
    found = on_mesh(field, Mesh.of(table, "POI1", ids[::-1, None]), 1e-6, lost)
    a, known = exact(PLACES)
    part = found.components["A"]
    assert part.nodes.tolist() == ids[known].tolist()
    np.testing.assert_allclose(part.values, a[known])
    assert found.components["B"].nodes.tolist() == ids[[2, 3, 5]].tolist()
    np.testing.assert_allclose(np.concatenate(lost)[:, :2], PLACES[~known])
    wrong = CellField((CellFieldBlock(field.blocks[0].cells, {"A": np.ones((1, 3))}),))
    with pytest.raises(FieldError, match="nodes"):
        on_mesh(wrong, Mesh.of(table, "POI1", ids[:, None]), 1e-6, [])


@pytest.mark.parametrize("mode", [Mode.PLANE_STRAIN, Mode.AXISYMMETRIC])
def test_models_take_values_at_their_points_or_in_the_mean_of_squares(source, mode):
    table, field = source
    ids = table.add(np.array([[0.5, 0.5], [2.5, 0.4], [2.2, 2.5], [0.4, 2.1], [9.0, 9.0], [9.5, 9],
                              [9, 9.5]]))  # fmt: skip
    inside = Zone(CellBlock.make(table, "QUA4", ids[[[0, 1, 2, 3]]]), "MECANIQUE", ELASTIC, "QUA4",
                  mode)  # fmt: skip
    beyond = Zone(CellBlock.make(table, "TRI3", ids[[[4, 5, 6]]]), "MECANIQUE", ELASTIC, "TRI3",
                  mode)  # fmt: skip
    both, lost = Model((inside, beyond)), []
    made = on_model(field, both, "RIGIDITE", 1e-6, lost)
    x = points_of(inside, "RIGIDITE")[0]
    np.testing.assert_allclose(made.blocks[0].components["A"][0], exact(x)[0])
    assert made.title == "title"
    assert not any(block.components["A"].any() for block in made.blocks[1:])
    assert len(np.concatenate(lost)) > 0
    nodal = by_least_squares(field, Model((inside,)), 4, 1e-6, [])
    values = nodal.blocks[0].components["A"][0]
    assert nodal.blocks[0].support == "NOEUD"
    # what is left is orthogonal to the functions of the cell, counted round the axis
    X, W = np.polynomial.legendre.leggauss(12)
    corners, rest = inside.cells.coordinates[0, :, :2], np.zeros(4)
    for a, wa in zip(X, W, strict=True):
        for b, wb in zip(X, W, strict=True):
            N = np.array([(1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b),
                          (1 - a) * (1 + b)]) / 4  # fmt: skip
            d1 = np.array([-(1 - b), 1 - b, 1 + b, -(1 + b)]) / 4 @ corners
            d2 = np.array([-(1 - a), -(1 + a), 1 + a, 1 - a]) / 4 @ corners
            at = N @ corners
            weight = wa * wb * abs(d1[0] * d2[1] - d1[1] * d2[0])
            weight *= at[0] if mode is Mode.AXISYMMETRIC else 1.0
            rest += weight * N * (N @ values - exact(at[None])[0][0])
    np.testing.assert_allclose(rest, 0.0, atol=1e-9)
    with pytest.raises(FieldError, match="QUA4"):
        by_least_squares(field, Model((inside,)), 1, 1e-6, [])
    joint = Zone(CellBlock.make(table, "RAC2", ids[[[0, 1, 3, 2]]]), "MECANIQUE", ELASTIC, "JOI2",
                 mode)  # fmt: skip
    with pytest.raises(FieldError, match="JOI2"):
        by_least_squares(field, model(joint), 3, 1e-6, [])


# --- axes in the surface of shells

OTHER = np.array([0.3, -1.0, 2.0])


@together("first", np.random.default_rng(7).standard_normal((6, 3)))
@together("strains", [False, True])
@together("said", ["plain", "toward", "normal", "otherwise"])
@together("element", ["DKT", "DST"])
def test_forces_and_strains_of_shells_turn_with_the_axes(first, strains, said, element):
    zone = tilted_plate(element)
    frames = flat_frames(zone)[0]
    names = ("EPSS", "EPTT", "GAST", "RTSS", "RTTT", "RTST", "GASN", "GATN") if strains else (
        "N11", "N22", "N12", "M11", "M22", "M12", "V1", "V2")  # fmt: skip
    names = names[: 8 if element == "DST" else 6]
    given = np.random.default_rng(1).standard_normal((len(names), 2, 1))
    field = CellField((CellFieldBlock(zone.cells, dict(zip(names, given, strict=True)), "GRAVITE",
                                      element),))  # fmt: skip
    up = TILT[:, 2]
    axes = {
        "plain": SurfaceAxes(first), "toward": SurfaceAxes(first, toward=OTHER),
        "normal": SurfaceAxes(first, normal=up),
        "otherwise": SurfaceAxes(first, toward=up, otherwise=OTHER),
    }[said]  # fmt: skip
    assert is_flat_shell(zone)
    assert strains_or_stresses(zone, field)[2] == "GRAVITE"
    found = shell_in_axes(zone, field, axes).components
    half = 0.5 if strains else 1.0
    flat = first - first @ up * up
    x = flat / np.linalg.norm(flat)
    for k in range(2):
        own = frames[k]
        y = np.cross(up, x)
        if said in ("toward", "otherwise"):
            y = y * np.sign(y @ OTHER)
        elif said == "plain":  # to the element's own side
            y = y * np.sign(own[2] @ up)
        for start in (0, 3):
            a, b, c = given[start : start + 3, k, 0]
            T = own[:2].T @ np.array([[a, half * c], [half * c, b]]) @ own[:2]
            row = [found[n][k, 0] for n in names[start : start + 3]]
            np.testing.assert_allclose(row, [x @ T @ x, y @ T @ y, x @ T @ y / half], atol=1e-12)
        for i, n in enumerate(names[6:]):  # shears across
            assert found[n][k, 0] == pytest.approx((x, y)[i] @ (given[6:, k, 0] @ own[:2]))


# --- axes that follow


def test_axes_of_beams_turn_by_the_mean_rotation_and_those_of_joints_with_their_segment():
    beam = line_zone("POUT", [(0, 0, 0), (2, 1, 0), (3, 1, 2)], Mode.THREE_DIMENSIONAL)
    other = line_zone("BARR", [(0, 0, 0), (2, 1, 0)], Mode.THREE_DIMENSIONAL)
    table = beam.cells.nodes
    rng = np.random.default_rng(2)
    turns = 0.7 * rng.standard_normal((3, 3))
    motion = NodeField.of(table, np.arange(3), dict(zip(("RX", "RY", "RZ"), turns.T, strict=True)))
    values = rng.standard_normal((3, 2, 1))
    parts = dict(zip(("VX", "VY", "VZ"), values, strict=True)) | {"SECT": np.ones((1, 1))}
    field = CellField((CellFieldBlock(beam.cells, parts, "GRAVITE", "POUT"),
                       CellFieldBlock(other.cells, parts, "GRAVITE", "BARR")), "t")  # fmt: skip
    made = following_axes(Model((beam, other)), field, motion)
    for k in range(2):
        R = Rotation.from_rotvec(turns[k : k + 2].mean(axis=0)).as_matrix()
        got = [made.blocks[0].components[n][k, 0] for n in ("VX", "VY", "VZ")]
        np.testing.assert_allclose(got, R @ values[:, k, 0], atol=1e-12)
    assert made.blocks[1] is field.blocks[1]
    assert made.title == "t"


@together("bound", [True, False])
def test_axes_of_bound_joints_turn_with_the_segment_and_about_it(bound):
    start = np.array([[0.0, 0, 0], [1.0, 0.5, 0.2]])
    u = np.array([[0.1, 0.2, -0.1], [-0.6, 0.9, 0.4]])
    turns = np.array([[0.3, 0.1, -0.2], [0.5, -0.3, 0.4]])
    zone = line_zone("JOI1", start + u, Mode.THREE_DIMENSIONAL)
    if bound:
        zone.options["FRAME"] = "LIE"
    table = zone.cells.nodes
    names = ("UX", "UY", "UZ", "RX", "RY", "RZ")
    motion = NodeField.of(
        table, np.arange(2), dict(zip(names, np.hstack([u, turns]).T, strict=True))
    )
    v = np.array([0.2, -0.5, 0.9])
    parts = {n: np.array([[x]]) for n, x in zip(("V1X", "V1Y", "V1Z"), v, strict=True)}
    field = CellField((CellFieldBlock(zone.cells, parts, "GRAVITE", "JOI1"),))
    made = following_axes(Model((zone,)), field, motion).blocks[0].components
    got = np.array([made[n].ravel()[0] for n in ("V1X", "V1Y", "V1Z")])
    if not bound:
        np.testing.assert_array_equal(got, v)
        return
    before, after = start[1] - start[0], start[1] + u[1] - start[0] - u[0]
    e, f = before / np.linalg.norm(before), after / np.linalg.norm(after)
    spin = Rotation.from_rotvec((turns.mean(axis=0) @ e) * e).as_matrix()
    axis = np.cross(e, f)
    c = e @ f
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    swing = np.eye(3) + K + K @ K / (1 + c)  # the shortest way
    np.testing.assert_allclose(swing @ e, f, atol=1e-12)
    np.testing.assert_allclose(got, swing @ spin @ v, atol=1e-12)
