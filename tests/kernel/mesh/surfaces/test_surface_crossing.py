"""Voronoi partitions; surfaces of triangles cut where they cross: closed forms, invariants."""

import itertools

import numpy as np
import pytest
from scipy.spatial import cKDTree
from together import together

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces.surface_crossing import _cut, crossed, crossing_segments
from ssilang.kernel.mesh.surfaces.voronoi import OUTSIDE, voronoi_partition


def areas(mesh: Mesh) -> FloatArray:
    xyz = np.vstack([b.coordinates for b in mesh.blocks])
    normal = np.cross(xyz[:, 1] - xyz[:, 0], xyz[:, 2] - xyz[:, 0])
    return np.linalg.norm(normal, axis=1) / 2


def length(line: Mesh) -> float:
    ends = np.vstack([b.coordinates for b in line.blocks])
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())


def sheet(nodes: NodeTable, n: int, origin: list[float], u: list[float], v: list[float]) -> Mesh:
    """An n x n sheet of triangles on origin + s u + t v."""
    s, t = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    xyz = np.array(origin) + s.reshape(-1, 1) * np.array(u) + t.reshape(-1, 1) * np.array(v)
    ids = nodes.add(xyz).reshape(n + 1, n + 1)
    a, b, c, d = ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]
    rows = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    return Mesh.of(nodes, "TRI3", rows)


def ball(nodes: NodeTable, radius: float, centre: list[float], n: int = 12) -> Mesh:
    """A closed surface of triangles with its corners on a sphere."""
    turn, rise = 2 * np.pi * np.arange(2 * n) / (2 * n), np.pi * np.arange(1, n) / n
    ring = [[np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)] for b in rise for a in turn]
    top, bottom, *rest = nodes.add(
        np.array(centre) + radius * np.array([[0, 0, 1.0], [0, 0, -1.0], *ring])
    ).tolist()
    rows = [rest[2 * n * k : 2 * n * (k + 1)] for k in range(n - 1)]
    table = []
    for i in range(2 * n):
        j = (i + 1) % (2 * n)
        table += [[top, rows[0][i], rows[0][j]], [bottom, rows[-1][j], rows[-1][i]]]
        for low, high in itertools.pairwise(rows):
            table += [[low[i], high[i], high[j]], [low[i], high[j], low[j]]]
    return Mesh.of(nodes, "TRI3", np.array(table))


def sides(mesh: Mesh) -> dict[tuple[int, int], int]:
    """How many triangles stand on each side."""
    count: dict[tuple[int, int], int] = {}
    for row in np.vstack([b.connectivity for b in mesh.blocks]).tolist():
        for p, q in zip(row, [*row[1:], row[0]], strict=True):
            key = (min(p, q), max(p, q))
            count[key] = count.get(key, 0) + 1
    return count


def test_a_triangle_that_another_passes_through_shares_one_segment() -> None:
    a = np.array([[[0.0, 0, 0], [2, 0, 0], [0, 2, 0]]])
    b = np.array([[[0.5, -1, -1], [0.5, 5, -1], [0.5, -1, 5]]])
    rows_a, rows_b, ends = crossing_segments(a, b)
    assert (rows_a.tolist(), rows_b.tolist()) == ([0], [0])
    assert np.sort(ends[0], axis=0) == pytest.approx(np.array([[0.5, 0, 0], [0.5, 1.5, 0]]))


def test_triangles_that_touch_in_a_point_or_lie_in_one_plane_share_no_segment() -> None:
    a = np.array([[[0.0, 0, 0], [2, 0, 0], [0, 2, 0]]])
    touching = np.array([[[0.5, 0.5, 0], [0.5, 5, 1], [0.5, -1, 5]]])
    coplanar = a + 0.25 * np.array([1.0, 1.0, 0.0])
    for b in (touching, coplanar):
        assert len(crossing_segments(a, b)[0]) == 0


@together("height", [0.0, 0.05, 0.137])
def test_crossing_sheets_keep_their_areas_and_share_the_line_of_their_planes(height: float) -> None:
    nodes = NodeTable()
    flat = sheet(nodes, 5, [0, 0, 0], [1, 0, 0], [0, 1, 0])
    steep = sheet(nodes, 4, [-0.5, height, -0.4], [2.0, 0, 0], [0, 0.8, 0.8])
    cut, other, line, twin = crossed(flat, steep)
    assert areas(cut).sum() == pytest.approx(1.0, rel=1e-12)
    assert areas(other).sum() == pytest.approx(areas(steep).sum(), rel=1e-12)
    assert length(line) == pytest.approx(1.0, rel=1e-12) == length(twin)
    assert areas(cut).min() > 0
    assert areas(other).min() > 0


def test_lines_are_sides_of_triangles_of_their_own_surface() -> None:
    nodes = NodeTable()
    cut, other, line, twin = crossed(
        ball(nodes, 1.0, [0, 0, 0]), sheet(nodes, 6, [-2, -2, 0.31], [4, 0.1, 0], [0, 4, 0.2])
    )
    for surface, own in ((cut, line), (other, twin)):
        pairs = np.sort(own.single_block().connectivity, axis=1)
        assert {(p, q) for p, q in pairs.tolist()} <= set(sides(surface))
    assert not set(cut.node_ids.tolist()) & set(other.node_ids.tolist())


def test_a_closed_surface_stays_closed_and_its_line_is_one_loop() -> None:
    nodes = NodeTable()
    first, second = ball(nodes, 1.0, [0, 0, 0]), ball(nodes, 0.8, [0.7, 0.33, 0.21], n=9)
    cut, other, line, _ = crossed(first, second)
    assert set(sides(cut).values()) == set(sides(other).values()) == {2}
    table = line.single_block().connectivity
    assert np.array_equal(table[1:, 0], table[:-1, 1])
    assert table[0, 0] == table[-1, 1]
    gap = float(np.linalg.norm([0.7, 0.33, 0.21]))
    away = (gap**2 + 1.0 - 0.64) / (2 * gap)
    assert length(line) == pytest.approx(2 * np.pi * np.sqrt(1 - away**2), rel=0.03)
    assert areas(cut).sum() == pytest.approx(areas(first).sum(), rel=1e-12)


def test_a_segment_inside_a_triangle_gives_five_and_a_corner_cut_off_three() -> None:
    nodes = NodeTable()
    ids = nodes.add(
        np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [-9, 1, 5], [9, 1, 5], [0, 1, -5]])
    )
    small, large = (Mesh.of(nodes, "TRI3", row[None], 3) for row in (ids[:3], ids[3:]))
    cut, other, _, _ = crossed(small, large)
    assert (cut.n_cells, other.n_cells) == (3, 5)
    assert set(cut.blocks[0].colours.tolist()) == {3}


def test_surfaces_apart_stay_as_they_are() -> None:
    nodes = NodeTable()
    first = sheet(nodes, 2, [0, 0, 0], [1, 0, 0], [0, 1, 0])
    second = sheet(nodes, 2, [0, 0, 1], [1, 0, 0], [0, 1, 0.5])
    cut, _, line, _ = crossed(first, second)
    assert np.array_equal(cut.blocks[0].connectivity, first.blocks[0].connectivity)
    assert not line.blocks


def test_other_cells_than_triangles_are_refused() -> None:
    nodes = NodeTable()
    ids = nodes.add(np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]))
    square = Mesh.of(nodes, "QUA4", ids[None])
    with pytest.raises(MeshError, match="TRI3"):
        crossed(square, square)


def test_a_crossing_along_a_side_that_has_nodes_cuts_nothing_off() -> None:
    """Corners 0 1 2, nodes 3 and 4 on the first side; one cut from 4 to the last corner."""
    xyz = np.array([(0.0, 0, 0), (4, 0, 0), (0, 3, 0), (1, 0, 0), (3, 0, 0)])
    sides, whole = {(0, 1): {3, 4}}, [(0, 1), (0, 4), (2, 4)]
    made = _cut(xyz, [0, 3, 4, 1, 2], [0, 1, 2], sides, whole)
    edges = {frozenset(e) for t in made for e in itertools.combinations(t, 2)}
    assert frozenset((2, 4)) in edges
    assert not {frozenset((0, 1)), frozenset((0, 4))} & edges
    turns = [np.cross(xyz[b] - xyz[a], xyz[c] - xyz[a])[2] for a, b, c in made]
    assert min(turns) > 0
    assert sum(turns) == pytest.approx(12.0)


SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
ANGLE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]])


def ring(n):
    return np.column_stack([np.arange(n), np.roll(np.arange(n), -1)])


def areas_of_cells(partition, n):
    a, b = partition.points[partition.edges.T]
    halves = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    made = np.zeros(n)
    for column, sign in ((0, 1.0), (1, -1.0)):
        owner = partition.owners[:, column]
        np.add.at(made, owner[owner != OUTSIDE], sign * halves[owner != OUTSIDE])
    return made


@together("n", [1, 2, 5, 60])
def test_cells_hold_what_is_nearest_to_their_germ(n):
    rng = np.random.default_rng(3)
    germs = rng.random((n, 2))
    partition = voronoi_partition(germs, np.zeros(n), SQUARE, ring(4))
    counted = np.bincount(cKDTree(germs).query(rng.random((100_000, 2)))[1], minlength=n) / 1e5
    np.testing.assert_allclose(areas_of_cells(partition, n), counted, atol=5e-3)
    assert len(partition.points) - len(partition.edges) + n == 1


def test_a_contour_in_the_other_sense_and_not_convex_is_filled_by_the_cells():
    germs = np.random.default_rng(1).random((40, 2))
    partition = voronoi_partition(germs, np.zeros(40), ANGLE, ring(6)[:, ::-1])
    assert areas_of_cells(partition, 40).sum() == pytest.approx(3.0, rel=1e-12)
    assert len(partition.points) - len(partition.edges) + 40 == 1


def test_a_grid_of_germs_gives_its_squares():
    x = np.arange(0.05, 1.0, 0.1)
    germs = np.stack(np.meshgrid(x, x), axis=-1).reshape(-1, 2)
    partition = voronoi_partition(germs, np.zeros(100), SQUARE, ring(4))
    np.testing.assert_allclose(areas_of_cells(partition, 100), 0.01, rtol=1e-10)
    assert (len(partition.points), len(partition.edges)) == (121, 220)


def test_a_weight_moves_the_edge_by_the_difference_of_squares_over_twice_the_distance():
    germs = np.array([[0.3, 0.5], [0.7, 0.5]])
    partition = voronoi_partition(germs, np.array([0.3, 0.1]), SQUARE, ring(4))
    place = 0.5 + (0.3**2 - 0.1**2) / (2 * 0.4)
    np.testing.assert_allclose(areas_of_cells(partition, 2), [place, 1 - place], rtol=1e-12)


@together("n", [2, 30])
@together("size, shift", [(1.0, 1e4), (1e8, -7.0), (1e-3, 0.2)])
def test_cells_of_any_size_and_far_from_the_origin_keep_their_digits(n, size, shift):
    germs = np.random.default_rng(2).random((n, 2))
    near = voronoi_partition(germs, np.zeros(n), SQUARE, ring(4))
    far = voronoi_partition(size * germs + shift, np.zeros(n), size * SQUARE + shift, ring(4))
    moved = type(far)((far.points - shift) / size, far.edges, far.owners)
    np.testing.assert_allclose(areas_of_cells(moved, n), areas_of_cells(near, n), rtol=1e-7)
    assert (len(far.points), len(far.edges)) == (len(near.points), len(near.edges))


@together(
    "germs, weights, told",
    [
        ([[0.5, 0.5], [1.5, 0.5]], [0.0, 0.0], "outside"),
        ([[0.5, 0.5], [0.5, 0.5]], [0.0, 0.0], "same place"),
        ([[0.5, 0.5], [0.5, 0.5 + 5e-10]], [0.0, 0.0], "same place"),
        ([[0.4, 0.5], [0.6, 0.5]], [0.5, 0.0], "differ by too much"),
    ],
)
def test_germs_that_have_no_cell_are_refused(germs, weights, told):
    with pytest.raises(MeshError, match=told):
        voronoi_partition(np.array(germs), np.array(weights), SQUARE, ring(4))
