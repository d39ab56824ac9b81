"""Lines, sweeps, blocks, rounded corners, refined triangles, frames along lines: closed forms."""

import math

import numpy as np
import pytest
from references.straight_line import line_between, straight_line
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import envelope, faces_inside
from ssilang.kernel.mesh.changes.merge import merge_close
from ssilang.kernel.mesh.changes.transform import NodeCopier, shift
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.interfaces import joints_inside
from ssilang.kernel.mesh.generators.sweep import (
    sweep_line,
    sweep_surface,
    translation,
)
from ssilang.kernel.mesh.lines.curves import arc_about_axis, fillet
from ssilang.kernel.mesh.lines.lines import frenet_frames, line_chain, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, signed_volumes
from ssilang.kernel.mesh.queries.measure import total_measure
from ssilang.kernel.mesh.volumes.block import fill_block

X, Y, Z = np.eye(3)


def sheet(base: Mesh, way: np.ndarray, n: int) -> Mesh:
    name = "QUA8" if base.single_block().cell_type == "SEG3" else "QUA4"
    length = float(np.linalg.norm(way))
    return sweep_line(base, translation(way), subdivide(length, count=n), name)


def six_faces(quadratic: bool) -> list[Mesh]:
    """Faces of a box of sides 1, 2 and 3, cut in 2, 3 and 4, with common nodes merged."""
    nodes = NodeTable()
    width = line_between(nodes, [0, 0, 0], X, 2, quadratic)
    depth = line_between(nodes, [0, 0, 0], 2 * Y, 3, quadratic)
    pairs = [
        (sheet(width, 2 * Y, 3), 3 * Z),
        (sheet(width, 3 * Z, 4), 2 * Y),
        (sheet(depth, 3 * Z, 4), X),
    ]
    faces = []
    for first, way in pairs:
        faces += [first, NodeCopier(nodes, shift(way)).mesh(first)]
    merge_close(nodes, union(*faces).node_ids, 1e-6)
    return faces


@together("quadratic, name", [(False, "CUB8"), (True, "CU20")])
def test_block_of_six_faces_is_filled_with_bricks(quadratic: bool, name: str) -> None:
    faces = six_faces(quadratic)
    made = fill_block([*faces[4:], faces[1], faces[0], *faces[2:4]])
    block = made.single_block()
    assert (block.cell_type, len(block)) == (name, 24)
    assert np.abs(signed_volumes(block)) == pytest.approx(0.25)
    skin = envelope(made)
    assert set(skin.node_ids) == set(union(*faces).node_ids)


@together("quadratic", [False, True])
@together("radius", [0.5, 0.97])  # nearer to the next node, and farther
def test_rounded_corner_is_tangent_to_both_lines(radius: float, quadratic: bool) -> None:
    nodes = NodeTable()
    corner = int(nodes.add(np.array([[2.0, 0, 0]]))[0])
    start, end = nodes.add(np.array([[0.0, 0], [3.0, 1.0]])).tolist()
    first = straight_line(nodes, start, corner, 8, quadratic=quadratic)
    second = straight_line(nodes, corner, end, 8, quadratic=quadratic)
    one, arc, two = fillet(first, second, radius, 6)
    reach = radius * math.tan(math.pi / 8)
    assert total_measure(one) == pytest.approx(2 - reach)
    assert total_measure(two) == pytest.approx(math.sqrt(2) - reach)
    at = nodes.coordinates[line_chain(arc)]
    centre = np.array([2 - reach, radius, 0])
    assert np.linalg.norm(at - centre, axis=1) == pytest.approx(radius)
    assert line_chain(one)[-1] == line_chain(arc)[0]
    assert line_chain(arc)[-1] == line_chain(two)[0]
    for cut, whole, step, k in ((one, first, 0.25, -1), (two, second, 0.25 / math.sqrt(2), 0)):
        x = cut.single_block().coordinates
        sizes = np.linalg.norm(x[:, -1] - x[:, 0], axis=1) / step
        assert 0.3 < sizes[k] < 1.3  # where it is cut
        assert np.delete(sizes, k) == pytest.approx(1.0)
        assert x.mean(axis=1) == pytest.approx(x[:, [0, -1]].mean(axis=1))  # middles, too
        assert np.isin(cut.node_ids, whole.node_ids).sum() == cut.node_ids.size - 1 - quadratic


def test_too_large_a_radius_is_refused() -> None:
    nodes = NodeTable()
    first, second = line_between(nodes, [0, 0], [1, 0], 4), line_between(nodes, [1, 0], [1, 1], 4)
    with pytest.raises(MeshError, match="too large"):
        fillet(first, second, 2.0, 4)
    with pytest.raises(MeshError, match="parallel"):
        fillet(first, first, 0.1, 4)


def test_frames_of_a_closed_circle_are_exact() -> None:
    nodes = NodeTable()
    start = int(nodes.add(np.array([[2.0, 0, 0]]))[0])
    arc = arc_about_axis(nodes.coordinates[start].copy(), np.zeros(3), Z, 2 * math.pi)
    cuts = subdivide(arc.length, 0.3, 0.9, -17)
    circle = mesh_curve(nodes, arc, start, start, cuts)
    ids, frames = frenet_frames(circle)
    radial = nodes.coordinates[ids] / 2.0
    assert frames[:, 0] == pytest.approx(np.cross(Z, radial), abs=1e-12)
    assert frames[:, 1] == pytest.approx(-radial, abs=1e-12)
    assert frames[:, 2] == pytest.approx(np.tile(Z, (len(ids), 1)), abs=1e-12)


@together("turned", [(), (0,), (1,), (0, 1)])
@together("order", [1, -1])
@together("dimension", [2, 3])
def test_touching_parts_are_joined_once_and_open_as_they_part(
    dimension: int, order: int, turned: tuple[int, ...]
) -> None:
    nodes = NodeTable()
    base = line_between(nodes, np.zeros(dimension), X[:dimension], 3)
    low, up = sheet(base, Y, 2), Y
    if dimension == 3:
        low, up = sweep_surface(low, translation(Z), subdivide(1.0, count=1)), Z
    bodies = [low, NodeCopier(nodes, shift(up)).mesh(low)]
    bodies = [reversed_line(b) if i in turned else b for i, b in enumerate(bodies)]
    block = joints_inside(union(*bodies[::order]), 1e-6).single_block()
    assert (block.cell_type, len(block)) == (("RAC2", 3) if dimension == 2 else ("LIA4", 6))
    first, second = np.split(block.coordinates, 2, axis=1)
    assert first == pytest.approx(second)
    assert first @ up == pytest.approx(1.0)
    x, y = first[:, 1] - first[:, 0], first[:, -1] - first[:, 0]
    normal = np.cross(Z, x) if dimension == 2 else np.cross(x, y)
    into_upper = np.isin(block.connectivity[:, 0], bodies[1].node_ids)
    assert ((normal @ up > 0.0) == into_upper).all()
    if dimension == 2:  # a single pair
        cells = [b.single_block().connectivity for b in bodies]
        ends = [Mesh.of(nodes, "QUA4", c[i : i + 1]) for c, i in zip(cells, (3, 0), strict=True)]
        assert len(joints_inside(union(*ends), 1e-6).single_block()) == 1
    with pytest.raises(MeshError, match="face each other"):
        joints_inside(low, 1e-6)


def test_faces_with_cells_on_both_sides() -> None:
    """A square beside two triangles; faces in either sense, and twice."""
    nodes = NodeTable()
    nodes.add(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float))
    cells = {"QUA4": [[0, 1, 2, 3]], "TRI3": [[1, 4, 5], [1, 5, 2]]}
    mesh = Mesh(nodes, tuple(CellBlock.make(nodes, k, np.array(t)) for k, t in cells.items()))
    for pairs, inside in (
        ([[0, 1], [4, 5], [3, 0]], 0),
        ([[2, 1], [0, 1]], 1),
        ([[1, 2], [5, 1], [2, 1]], 3),
        ([[0, 5], [0, 1], [1, 0]], 0),
    ):
        faces = Mesh(nodes, (CellBlock.make(nodes, "SEG2", np.array(pairs)),))
        assert faces_inside(faces, mesh) == inside


def test_equal_densities_give_equal_elements() -> None:
    assert subdivide(1.0, 0.24, 0.24).count == 4
    assert subdivide(1.0, 0.24, 0.24).fractions == pytest.approx(np.linspace(0, 1, 5))
