"""Plane contours triangulated, filled and cut in two, against lattices and plain geometry."""

import itertools

import numpy as np
import pytest
from scipy.spatial import Delaunay
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces import fill
from ssilang.kernel.mesh.surfaces.constrained import (
    delaunay_mesh,
    is_closed,
    refined_triangles,
    triangulated_with_lines,
)
from ssilang.kernel.mesh.surfaces.triangulate import (
    delaunay_triangles,
    doubled_areas,
    triangulate_inside,
)


def ring(n, first=0):
    """Segments round n points."""
    return first + np.column_stack([np.arange(n), (np.arange(n) + 1) % n])


def along(corners, h):
    """Points every h (sides are whole multiples) round a polygon."""
    parts = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        n = round(np.linalg.norm(b - a) / h)
        parts.append(a + np.arange(n)[:, None] / n * (b - a))
    return np.concatenate(parts)


def shoelace(p):
    x, y = p.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def sides(triangles):
    found = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return {tuple(sorted(s)) for s in found.tolist()}


COMB = np.array([[0, 0], [7, 0.4], [6.6, 3], [5, 0.9], [4.4, 4], [4.1, 1.1], [3, 3.4], [-0.5, 1.0]])


@pytest.mark.parametrize("scale", [1e-4, 1.0, 3e5])
@pytest.mark.parametrize("sense", [1, -1])
def test_triangles_fill_the_contour_and_are_delaunay_but_for_its_sides(scale, sense):
    rng = np.random.default_rng(4)
    corners = COMB[::sense]
    loose = rng.uniform([-0.4, 0], [7, 4], (80, 2))
    segments = ring(8)
    hole = np.array([[0.6, 0.5], [1.1, 0.6], [0.8, 1.2]])
    p = scale * np.concatenate([corners, hole, loose])
    segments = np.concatenate([segments, ring(3, 8)])
    t = triangulate_inside(p, segments)
    areas = doubled_areas(p, t)
    assert (areas > 0).all()
    wanted = abs(shoelace(corners)) - shoelace(hole)
    assert areas.sum() / 2 == pytest.approx(scale**2 * wanted, rel=1e-12)
    fixed = {tuple(sorted(s)) for s in segments.tolist()}
    assert fixed <= sides(t)
    owners: dict = {}
    for k, row in enumerate(t.tolist()):
        for i in range(3):
            owners.setdefault(tuple(sorted((row[i], row[i - 1]))), []).append((k, row[i - 2]))
    for side, both in owners.items():
        if side in fixed or len(both) == 1:
            continue
        (k, _), (_, other) = both
        a, b, c = p[t[k]] / scale
        A = 2 * np.array([b - a, c - a])
        centre = np.linalg.solve(A, [b @ b - a @ a, c @ c - a @ a])
        away = np.linalg.norm(p[other] / scale - centre)
        assert away > np.linalg.norm(a - centre) - 1e-9


def test_points_far_from_the_origin_are_triangulated_as_near_it():
    p = np.random.default_rng(3).integers(0, 4096, (60, 2)) / 1024.0
    near, far = (delaunay_triangles(p + shift) for shift in (0.0, 2.0**24))
    assert {*map(frozenset, near.tolist())} == {*map(frozenset, far.tolist())}


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_contours_that_pass_through_points_or_cross_are_refused(scale):
    square = np.array([[0, 0], [3, 0], [3, 2], [0, 2.0]])
    bow = scale * square[[0, 2, 1, 3]]
    with pytest.raises(MeshError, match="crosses"):
        triangulate_inside(bow, ring(4))
    through = scale * np.concatenate([square, [[1.5, 0.0], [1.5, 2 / 3], [0.7, 0.9]]])
    with pytest.raises(MeshError, match="passes through"):
        triangulate_inside(through, ring(4))


def test_a_size_is_linear_between_points_and_never_below_the_least():
    p = np.array([[0, 0], [4, 0], [0, 3.0], [4.5, 3.5]])
    size = fill.SizeField(p, np.array([0.2, 1.0, 0.5, 1.4]))
    w = np.random.default_rng(1).dirichlet(np.ones(3), 9)
    np.testing.assert_allclose(size(w @ p[:3]), w @ [0.2, 1.0, 0.5])
    far = size(np.array([[-2.0, -2.0], [9.0, 9.0]]))
    assert 1.4 > far[1] > far[0] >= 0.2
    found = fill.mean_sizes(p[:3], np.array([[0, 1], [1, 2], [2, 0]]))
    np.testing.assert_allclose(found, [3.5, 4.5, 4.0])


@pytest.mark.parametrize("squares", [True, False])
def test_centres_of_large_triangles_are_told_the_largest_first(squares):
    """By a linear system each; sizes differ from place to place."""
    p = 5.0 * np.random.default_rng(3).random((60, 2))
    size = fill.SizeField(p, 0.4 + 0.05 * p[:, 0])
    triangles = Delaunay(p).simplices
    rows = []
    for a, b, c in p[triangles]:
        centre = np.linalg.solve(2 * np.array([b - a, c - a]), [b @ b - a @ a, c @ c - a @ a])
        wanted = size((a + b + c)[None] / 3)[0] / (2.0 if squares else 3.0) ** 0.5
        rows.append((np.linalg.norm(a - centre) / wanted, *centre))
    excess, centres = np.split(np.array(sorted(rows, reverse=True)), [1], axis=1)
    of = [(excess > low) & (excess < high) for low, high in ((1.4, 8.0), (1.9, 4.0))]
    np.testing.assert_allclose(fill._large_centres(p, triangles, size, squares),
                               centres[of[0].ravel()])  # fmt: skip
    made = fill._proposals(p, triangles, size, squares)
    assert 0 < of[1].sum() < of[0].sum()
    np.testing.assert_allclose(made[len(made) - of[1].sum() :], centres[of[1].ravel()])


@pytest.mark.parametrize("h", [1.0, 0.02])
def test_squares_fill_a_rectangle_on_its_grid(h):
    rim = along(h * np.array([[0, 0], [7, 0], [7, 3], [0, 3.0]]), h)
    size = fill.SizeField(rim, np.full(len(rim), h))
    points, triangles = fill.fill_contour(rim, ring(len(rim)), size, True)
    grid = {(x, y) for x, y in itertools.product(range(8), range(4))}
    assert {tuple(q) for q in np.round(points / h).astype(int).tolist()} == grid
    np.testing.assert_allclose(points / h, np.round(points / h), atol=1e-9)
    np.testing.assert_allclose(doubled_areas(points, triangles), h * h)


@pytest.mark.parametrize("squares", [False, True])
def test_a_crooked_contour_is_filled_by_its_sizes(squares):
    corners = np.array([[0, 0], [8, 1], [7, 6], [4, 3], [-1, 5.0]])
    parts = [a + np.arange(n)[:, None] / n * (b - a) for a, b, n in
             zip(corners, np.roll(corners, -1, 0), (10, 12, 11, 8, 7), strict=True)]  # fmt: skip
    rim = np.concatenate(parts)
    segments = ring(len(rim))
    size = fill.SizeField(rim, fill.mean_sizes(rim, segments))
    points, triangles = fill.fill_contour(rim, segments, size, squares)
    np.testing.assert_array_equal(points[: len(rim)], rim)
    areas = doubled_areas(points, triangles)
    assert (areas > 0).all()
    assert areas.sum() / 2 == pytest.approx(shoelace(corners))
    assert {tuple(sorted(s)) for s in segments.tolist()} <= sides(triangles)
    h = size(points[triangles].mean(axis=1))
    usual = h**2 * (1.0 if squares else 0.75**0.5)
    assert (areas / usual).mean() == pytest.approx(1.0, abs=0.25)
    assert (areas / usual).max() < 2.3
    inner = points[len(rim) :]
    away = np.linalg.norm(inner[:, None] - points[None], axis=2)
    away[away == 0.0] = np.inf
    assert (away.min(axis=1) > 0.5 * size(inner)).all()


@pytest.mark.parametrize(("rounds", "weight"), [(1, 0.7), (3, 0.4)])
def test_smoothing_draws_inner_points_towards_their_neighbours(rounds, weight):
    p = np.random.default_rng(3).uniform(size=(6, 2))
    links = np.array([[0, 4], [1, 4], [4, 5], [2, 5], [3, 5], [0, 5]])
    A = np.zeros((6, 6))
    A[links[:, 0], links[:, 1]] = A[links[:, 1], links[:, 0]] = 1.0
    expected = p.copy()
    for _ in range(rounds):
        mean = (A @ expected) / A.sum(axis=1)[:, None]
        expected[4:] = (1 - weight) * expected[4:] + weight * mean[4:]
    was = p.copy()
    np.testing.assert_allclose(fill.smooth(p, links, 4, rounds, weight), expected)
    np.testing.assert_array_equal(p, was)


def test_sides_between_four_on_a_circle_are_not_certain():
    p = np.array([[0, 0], [2, 0], [2, 1], [0, 1], [3.5, 0.4]])
    t = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 2]])
    found = fill.certain_sides(p, t)
    assert {tuple(s) for s in found.tolist()} == sides(t) - {(0, 2)}
    quads = fill.sides_of(np.array([[0, 1, 2, 3], [1, 4, 5, 2]]))
    assert {tuple(s) for s in quads.tolist()} == {
        (0, 1), (1, 2), (2, 3), (0, 3), (1, 4), (4, 5), (2, 5)
    }  # fmt: skip


CLOSED = [5, 3, 8, 0, 9, 2, 7]  # nodes in the order of the contour
PLACES = {n: (2 * np.cos(k), np.sin(k) * (1 + 0.1 * k)) for k, n in enumerate(CLOSED)}


def contour(closed=True, nodes=None):
    nodes = nodes or NodeTable()
    ids = nodes.add(np.array([PLACES.get(n, (9.0, float(n))) for n in range(10)]))
    chain = ids[CLOSED + CLOSED[:1] if closed else CLOSED]
    return Mesh.of(nodes, "SEG2", np.column_stack([chain[:-1], chain[1:]]), 4)


def chain_of(mesh):
    cells = mesh.single_block().connectivity.tolist()
    assert [c[1] for c in cells[:-1]] == [c[0] for c in cells[1:]]
    return [c[0] for c in cells] + [cells[-1][1]]


@together(
    "closed, first, second, home, away",
    [
        (True, 3, 9, [9, 2, 7, 5, 3, 9], [3, 8, 0, 9, 3]),
        (True, 9, 3, [3, 8, 0, 9, 3], [9, 2, 7, 5, 3, 9]),
        (False, 3, 9, [5, 3, 9, 2, 7], [3, 8, 0, 9, 3]),
        (False, 9, 3, [3, 8, 0, 9, 3], [5, 3, 9, 2, 7]),
    ],
)
def test_a_contour_is_cut_between_two_of_its_nodes(closed, first, second, home, away):
    whole = contour(closed)
    ends = [Mesh.of(whole.nodes, "POI1", np.array([[n]])) for n in (first, second)]
    cut, one, two = fill.split_contour(whole, *ends)
    assert chain_of(cut) == [first, second]
    assert {tuple(chain_of(one)), tuple(chain_of(two))} == {tuple(home), tuple(away)}
    assert [first, second] in one.single_block().connectivity.tolist()
    assert [second, first] in two.single_block().connectivity.tolist()
    assert {int(m.blocks[0].colours[0]) for m in (cut, one, two)} == {4}


def test_the_nearest_of_two_sets_are_joined_and_what_cannot_be_cut_is_refused():
    whole = contour()

    def points(*ids):
        return Mesh.of(whole.nodes, "POI1", np.array(ids)[:, None])

    x = whole.nodes.coordinates
    first, second = (5, 8, 9), (0, 7, 3)
    apart = {frozenset(pair) for pair in zip(CLOSED, CLOSED[1:] + CLOSED[:1], strict=True)}
    a, b = min(itertools.product(first, second), key=lambda p: np.linalg.norm(x[p[0]] - x[p[1]]))
    with pytest.raises(MeshError, match="neighbours"):  # the nearest are, others would not be
        fill.split_contour(whole, points(*first), points(*second))
    assert frozenset((a, b)) in apart
    x[[8, 7]] = [[0.1, 0.2, 0], [0.2, 0.1, 0]]
    assert chain_of(fill.split_contour(whole, points(*first), points(*second))[0]) == [8, 7]
    assert chain_of(fill.split_contour(whole, points(8, 7), points(8, 7))[0]) in ([8, 7], [7, 8])
    for pair, match in {
        (5, 3): "neighbours", (5, 7): "neighbours", (1, 3): "second", (3, 1): "third",
        (3, 3): "same",
    }.items():  # fmt: skip
        with pytest.raises(MeshError, match=match):
            fill.split_contour(whole, points(pair[0]), points(pair[1]))
    quadratic = Mesh.of(whole.nodes, "SEG3", np.array([[0, 1, 2]]))
    with pytest.raises(MeshError, match="SEG2"):
        fill.split_contour(quadratic, points(0), points(2))
    two = Mesh.of(whole.nodes, "SEG2", np.array([[0, 1], [2, 3]]))
    with pytest.raises(MeshError, match="line"):
        fill.split_contour(two, points(0), points(2))


# --- lines inside, points added, points alone -----------------------------------------------------


def lines(corners, segments, tilt=None):
    """A mesh of SEG2 in the plane, or turned into space, its nodes out of order."""
    nodes = NodeTable()
    order = np.random.default_rng(2).permutation(len(corners))
    x = np.column_stack([corners, np.zeros(len(corners))])
    if tilt is not None:
        x = x @ tilt.T + [1.0, 2.0, 3.0]
    place = np.empty(len(corners), int)
    place[order] = nodes.add(x[order])
    return Mesh.of(nodes, "SEG2", place[np.asarray(segments)])


TILT = np.linalg.qr(np.random.default_rng(8).standard_normal((3, 3)))[0]


@pytest.mark.parametrize("tilt", [None, TILT])
def test_lines_inside_are_sides_and_holes_stay_empty(tilt):
    corners = np.array([[0, 0], [6, 0.5], [5, 4], [-1, 3.5], [2, 1], [3, 1.2], [2.4, 2], [4, 2.5]])
    segments = [*ring(4).tolist(), *ring(3, 4).tolist(), [1, 7]]
    made = triangulated_with_lines(lines(corners, segments, tilt), 2 if tilt is None else 3, 3)
    block = made.single_block()
    x = block.coordinates
    areas = np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
    hole = shoelace(corners[4:7])
    assert areas.sum() == pytest.approx(shoelace(corners[:4]) - hole)
    given = lines(corners, segments, tilt).single_block().connectivity
    assert {tuple(sorted(s)) for s in given.tolist()} <= sides(block.connectivity)
    assert set(block.colours.tolist()) == {3}


def test_lines_that_enclose_nothing_or_lie_in_no_plane_are_refused():
    open_line = lines(np.array([[0, 0], [1, 0], [1, 1], [3, 0.2]]), [[0, 1], [1, 2], [2, 3]])
    assert not is_closed(open_line)
    assert is_closed(lines(COMB, ring(8)))
    with pytest.raises(MeshError, match="enclose"):
        triangulated_with_lines(open_line, 2)
    bent = lines(COMB, ring(8))
    bent.nodes.coordinates[2, 2] = 0.3
    with pytest.raises(MeshError, match="plane"):
        triangulated_with_lines(bent, 3)
    with pytest.raises(MeshError, match="SEG2"):
        triangulated_with_lines(Mesh.of(bent.nodes, "SEG3", np.array([[0, 1, 2]])), 2)


def test_triangles_are_refined_to_the_sizes_asked_for_below_a_number_of_nodes():
    nodes = NodeTable()
    ids = nodes.add(np.array([[0, 0, 1.0], [4, 0, 1], [4, 3, 1], [0, 3, 1]]))
    coarse = Mesh.of(nodes, "TRI3", ids[[[0, 1, 2], [0, 2, 3]]], 2)
    sizes = np.array([0.3, 0.6, 0.9, 0.6])
    fine = refined_triangles(coarse, ids, sizes)
    few = refined_triangles(coarse, ids, sizes, limit=30)
    for made in (fine, few):
        x = made.single_block().coordinates
        area = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])[:, 2] / 2
        assert (area > 0).all()
        assert area.sum() == pytest.approx(12.0)
        assert set(ids.tolist()) <= set(made.node_ids.tolist())
    x = fine.single_block().coordinates[..., :2]
    size = fill.SizeField(nodes.coordinates[ids, :2], sizes)
    areas = np.abs(np.linalg.det(x[:, 1:] - x[:, :1])) / 2
    inner = np.linalg.norm(x.mean(axis=1) - [2, 1.5], axis=1) < 1.0  # the contour is not divided
    ratio = areas[inner] / (0.433 * size(x[inner].mean(axis=1)) ** 2)
    assert ratio.mean() == pytest.approx(1.0, abs=0.35)
    assert len(few.node_ids) <= 30 < len(fine.node_ids)
    density = nodes.density[np.setdiff1d(fine.node_ids, ids)]
    assert density == pytest.approx(size(nodes.coordinates[np.setdiff1d(fine.node_ids, ids), :2]))
    with pytest.raises(MeshError, match="nodes"):
        refined_triangles(coarse, ids, sizes, limit=3)


@pytest.mark.parametrize("dimension", [2, 3])
def test_points_are_triangulated_as_delaunay_says(dimension):
    nodes = NodeTable()
    x = np.random.default_rng(5).uniform(size=(14, 3))
    ids = nodes.add(x)
    made = delaunay_mesh(Mesh.of(nodes, "POI1", ids[3:][:, None]), dimension, 5).single_block()
    p = made.coordinates[..., :dimension]
    arms = p[:, 1:] - p[:, :1]
    assert (np.linalg.det(arms) > 0).all()
    assert set(made.colours.tolist()) == {5}
    half = 0.5 * (arms**2).sum(axis=2)
    centre = np.linalg.solve(arms, half[..., None])[..., 0]
    radius = np.linalg.norm(centre, axis=1)
    away = np.linalg.norm(x[3:, :dimension] - (p[:, 0] + centre)[:, None], axis=2)
    assert (away > radius[:, None] - 1e-9).all()
    for few, match in ((ids[:0], "empty"), (ids[:2], "few")):
        with pytest.raises(MeshError, match=match):
            delaunay_mesh(Mesh.of(nodes, "POI1", few[:, None]), dimension)
