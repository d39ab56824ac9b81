"""Degrees, splitting, copies, selections, boundaries."""

from itertools import pairwise

import numpy as np
import pytest
from references.straight_line import line_between
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import chained, contour, edges, envelope, faces, sharp_edges
from ssilang.kernel.mesh.changes.degree import QUADRATIC, linear, middle_places, quadratic
from ssilang.kernel.mesh.changes.split import split_quadrangles, tetrahedra
from ssilang.kernel.mesh.changes.transform import (
    straighten_middles,
)
from ssilang.kernel.mesh.combine import difference, union
from ssilang.kernel.mesh.generators.sweep import sweep_line, sweep_surface, translation
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import check_consistent, flip, signed_volumes
from ssilang.kernel.mesh.queries.measure import enclosed_volume, total_measure


def box(surface: str = "QUA4") -> Mesh:
    """A box of sides 1, 2 and 3 in 2 x 3 x 2 bricks (or twice as many prisms)."""
    base = line_between(NodeTable(), [0, 0, 0], [1, 0, 0], 2)
    y, z = np.array([0.0, 2, 0]), np.array([0.0, 0, 3])
    floor = sweep_line(base, translation(y), subdivide(2.0, count=3), surface)
    return sweep_surface(floor, translation(z), subdivide(3.0, count=2))


def test_middles_go_along_their_edges_to_where_both_ends_are_as_far() -> None:
    mesh = quadratic(box())
    mesh = union(mesh, line_between(mesh.nodes, [9, 0, 0], [9, 1, 0], 1))  # one without middles
    (bent,) = (b for b in edges(mesh).blocks if b.cell_type == "SEG3")
    x = mesh.nodes.coordinates
    middles = bent.connectivity[:, 1]
    x[middles] += np.random.default_rng(4).uniform(-0.1, 0.1, (len(middles), 3))
    ends, before = bent.coordinates[:, [0, 2]].copy(), bent.coordinates[:, 1].copy()
    straighten_middles(mesh)
    a, m, b = np.moveaxis(bent.coordinates, 1, 0)
    np.testing.assert_array_equal(np.stack([a, b], axis=1), ends)
    np.testing.assert_allclose(np.linalg.norm(m - a, axis=1), np.linalg.norm(m - b, axis=1))
    np.testing.assert_allclose(np.cross(m - before, b - a), 0.0, atol=1e-15)


@together("name", sorted(QUADRATIC.values()))
def test_each_middle_stands_between_two_corners(name: str) -> None:
    places = middle_places(name)
    expected = {"SEG3": 1, "TRI6": 3, "QUA8": 4, "TE10": 6, "PY13": 8, "PR15": 9, "CU20": 12}
    assert len(places) == expected[name]


@together("surface, cell", [("QUA4", "CU20"), ("TRI3", "PR15")])
def test_quadratic_cells_have_their_middles_in_the_middle(surface: str, cell: str) -> None:
    volume = box(surface)
    made = quadratic(volume)
    block = made.single_block()
    assert block.cell_type == cell
    for middle, a, b in middle_places(cell):
        x = block.coordinates
        assert x[:, middle] == pytest.approx((x[:, a] + x[:, b]) / 2)
    # one middle an edge
    assert len(made.node_ids) == len(volume.node_ids) + edges(volume).n_cells
    back = linear(made).single_block()
    assert (back.connectivity == volume.single_block().connectivity).all()


@together("surface", ["QUA4", "TRI3"])
def test_bricks_and_prisms_split_into_conforming_tetrahedra(surface: str) -> None:
    volume = box(surface)
    made = Mesh(volume.nodes, (tetrahedra(volume.single_block()),))
    assert (signed_volumes(made.single_block()) > 0).all()
    assert total_measure(made) == pytest.approx(6.0)
    skin = envelope(made)
    assert total_measure(skin) == pytest.approx(total_measure(envelope(volume)))


def test_envelope_faces_outwards_and_closes() -> None:
    skin = envelope(box())
    assert enclosed_volume(skin) == pytest.approx(6.0)
    assert total_measure(skin) == pytest.approx(2 * (2 + 3 + 6))
    assert contour(skin).n_cells == 0
    check_consistent(skin)


def test_sharp_edges_of_a_box_are_its_twelve_edges() -> None:
    for volume in (box(), quadratic(box())):
        found = sharp_edges(volume)
        assert total_measure(found) == pytest.approx(4 * (1 + 2 + 3))
        pairs = np.sort(found.single_block().connectivity, axis=1)
        assert len(np.unique(pairs, axis=0)) == len(pairs)
    first = Mesh.of(found.nodes, "TRI6", np.array([[1, 0, 2, 3, 4, 5]]))  # a middle of number 0
    assert sharp_edges(first).n_cells == 6


def test_edges_are_sharp_by_the_vectors_of_areas_of_faces_that_are_not_plane() -> None:
    plan = np.array([[0, 0], [0, 1], [1, 1.3], [1.5, 0.5], [1, -0.3], [-1, 0], [-1, 1]])
    rings = ("POL", np.array([0, 4, 3, 2, 1])), ("QUA", np.array([0, 1, 6, 5]))
    for heights in np.random.default_rng(2).uniform(-0.4, 0.4, (20, 7)):
        x = np.column_stack([plan, heights])
        nodes = NodeTable()
        ids = nodes.add(x)
        mesh = union(*(Mesh.of(nodes, f"{k}{len(r)}", ids[r][None, :]) for k, r in rings))
        a, b = (np.cross(x[r], np.roll(x[r], -1, axis=0)).sum(axis=0) for _, r in rings)
        turn = np.degrees(np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b)))
        assert sharp_edges(mesh, turn + 0.1).n_cells == 7
        assert sharp_edges(mesh, turn - 0.1).n_cells == 8


def test_counts_of_edges_and_faces_of_a_grid_of_bricks() -> None:
    volume = box()
    assert edges(volume).n_cells == 2 * 4 * 3 + 3 * 3 * 3 + 3 * 4 * 2
    assert faces(volume).n_cells == 3 * 3 * 2 + 2 * 4 * 2 + 2 * 3 * 3
    corners = volume.node_ids[None, :8]
    plane = Mesh.of(volume.nodes, "QUA4", corners[:, :4])
    joint = Mesh.of(volume.nodes, "LIA4", corners)
    assert {b.cell_type for b in faces(union(plane, joint)).blocks} == {"QUA4"}


@pytest.mark.parametrize(("sizes", "closed"), [((5,), True), ((4, 6), True), ((7, 3), False)])
def test_cells_in_any_order_are_put_end_to_end(sizes: tuple[int, ...], closed: bool) -> None:
    ways, nodes, wanted = [], NodeTable(), []
    for size in sizes:
        ids = nodes.add(np.random.default_rng(size).uniform(size=(size, 2))).tolist()
        ways.append(list(pairwise([*ids, *ids[:closed]])))
    given = np.random.default_rng(3).permutation(np.concatenate(ways))
    for cell in map(tuple, given.tolist()):
        (way,) = (way for way in ways if cell in way)
        at = way.index(cell)
        if cell not in wanted and (closed or at == 0):
            wanted += [*way[at:], *way[:at]]
    block = CellBlock.make(nodes, "SEG2", given, given[:, 0])
    (found,) = chained(Mesh(nodes, (block,))).blocks
    assert list(map(tuple, found.connectivity.tolist())) == wanted
    assert found.colours.tolist() == [a for a, _ in wanted]


def test_opposed_neighbours_are_found() -> None:
    base = line_between(NodeTable(), [0, 0], [1, 0], 2)
    plate = sweep_line(base, translation(np.array([0.0, 2, 0])), subdivide(2.0, count=1), "QUA4")
    check_consistent(plate)
    block = plate.single_block()
    with pytest.raises(MeshError, match="opposite senses"):
        check_consistent(Mesh(plate.nodes, (flip(block, np.array([True, False])),)))


def test_split_squares_alternate_their_diagonals() -> None:
    base = line_between(NodeTable(), [0, 0], [1, 0], 2)
    plate = sweep_line(base, translation(np.array([0.0, 1, 0])), subdivide(1.0, count=1), "QUA4")
    made = split_quadrangles(plate)
    shared = difference(edges(made), edges(plate)).single_block().coordinates
    slopes = np.sign(shared[:, 1] - shared[:, 0])
    assert (slopes[0, :2].prod(), slopes[1, :2].prod()) in ((1, -1), (-1, 1))
