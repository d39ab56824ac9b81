"""Surfaces inside contours: area, conformity, holes, degree, curved charts, sizes."""

import math
from collections import Counter

import numpy as np
import pytest
from references.straight_line import straight_line
from scipy.spatial import ConvexHull, Delaunay
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.combine import cell_keys, union
from ssilang.kernel.mesh.lines.curves import arc_about_axis
from ssilang.kernel.mesh.lines.lines import mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line, surface_normals
from ssilang.kernel.mesh.queries.measure import total_measure
from ssilang.kernel.mesh.surfaces.charts import plane_chart, sphere_chart
from ssilang.kernel.mesh.surfaces.surface import (
    _convex,
    _pairs,
    contour_chart_data,
    facet_shape,
    fill_surface,
    join_triangles,
)


def square(nodes: NodeTable, side: float, cuts: int, quadratic: bool = False) -> Mesh:
    """Contour of a square, anticlockwise from the origin."""
    corners = nodes.add(np.array([[0.0, 0], [side, 0], [side, side], [0, side]]))
    pairs = zip(corners, np.roll(corners, -1), strict=True)
    lines = [straight_line(nodes, int(a), int(b), cuts, quadratic=quadratic) for a, b in pairs]
    return union(*lines, as_given=True)


def circle(nodes: NodeTable, centre: tuple[float, float, float], radius: float, cuts: int) -> Mesh:
    """Closed circle of SEG2 in the plane z of its centre, anticlockwise."""
    middle = np.array(centre)
    start = int(nodes.add((middle + np.array([radius, 0, 0]))[None])[0])
    arc = arc_about_axis(nodes.coordinates[start].copy(), middle, np.array([0.0, 0, 1]), 2 * np.pi)
    return mesh_curve(nodes, arc, start, start, subdivide(arc.length, count=cuts))


def filled(line: Mesh, surface: str) -> Mesh:
    return fill_surface(line, plane_chart(*contour_chart_data(line)), surface)


@together("surface", ["TRI3", "QUA4", "TRI6", "QUA8"])
def test_square_is_filled_and_keeps_its_contour(surface: str) -> None:
    """Quadratic cells share their middles."""
    quadratic = surface in ("TRI6", "QUA8")
    line = square(NodeTable(), 2.0, 4 if quadratic else 7, quadratic)
    made = filled(line, surface)
    assert surface in {b.cell_type for b in made.blocks}
    assert total_measure(made) == pytest.approx(4.0, rel=1e-12)
    assert all((surface_normals(b)[:, 2] > 0).all() for b in made.blocks)
    found, given = contour(made).single_block(), line.single_block()
    assert sorted(cell_keys(found).tolist()) == sorted(cell_keys(given).tolist())


@together("side", [0.02, 2.0])
def test_inner_node_of_a_small_square_is_its_middle(side: float) -> None:
    """Middles and corners lie on circles with it: either diagonal may stand, none may pull."""
    nodes = NodeTable()
    filled(square(nodes, side, 2), "TRI3")
    assert nodes.coordinates[8:, :2] == pytest.approx(np.full((1, 2), side / 2), abs=1e-12 * side)


def test_clockwise_contour_gives_clockwise_cells() -> None:
    made = filled(reversed_line(square(NodeTable(), 1.0, 4)), "TRI3")
    assert all((surface_normals(b)[:, 2] < 0).all() for b in made.blocks)


def test_hole_stays_empty() -> None:
    nodes = NodeTable()
    outer = square(nodes, 2.0, 8)
    hole = reversed_line(circle(nodes, (1.0, 1.0, 0.0), 0.5, 16))
    made = filled(union(outer, hole, as_given=True), "TRI3")
    polygon = 0.5 * 16 * 0.25 * math.sin(2 * math.pi / 16)
    assert total_measure(made) == pytest.approx(4.0 - polygon, rel=1e-12)


def test_cells_follow_the_wanted_sizes() -> None:
    line = square(NodeTable(), 1.0, 10)
    line.nodes.coordinates[:, 0] += 0.5 * line.nodes.coordinates[:, 1]
    chart = plane_chart(*contour_chart_data(line))
    usual = fill_surface(line, chart, "TRI3")
    at = np.array([[0.0, 0, 0], [1, 0, 0], [1.5, 1, 0], [0.5, 1, 0]])
    coarse = fill_surface(line, chart, "TRI3", sizes=(at, np.full(4, 0.3)))
    assert coarse.n_cells < 0.8 * usual.n_cells
    for side in (line, reversed_line(line)):  # the chart sees the second one from behind
        made = fill_surface(side, chart, "TRI3", sizes=(at, np.array([0.08, 0.08, 0.4, 0.4])))
        low = made.single_block().coordinates[:, :, 1].mean(axis=1) < 0.5
        assert np.count_nonzero(low) > 0.7 * len(low)
        assert total_measure(made) == pytest.approx(1.0, rel=1e-12)


def test_cap_of_a_sphere_has_its_area() -> None:
    # circle at height 0.6 on the unit sphere: cap of area 2 pi (1 - 0.6), less facets' defect
    nodes = NodeTable()
    line = circle(nodes, (0.0, 0.0, 0.6), 0.8, 48)
    boundary, _ = contour_chart_data(line)
    made = fill_surface(line, sphere_chart(boundary, np.zeros(3)), "TRI3")
    assert total_measure(made) == pytest.approx(0.8 * math.pi, rel=5e-3)
    ids = made.node_ids
    assert np.linalg.norm(nodes.coordinates[ids], axis=1) == pytest.approx(1.0, abs=1e-12)


def test_polygons_that_turn_one_way_alone_are_convex() -> None:
    random, seen = np.random.default_rng(3), set()
    for corners in random.normal(size=(60, 4, 2)):
        hull = ConvexHull(corners).vertices  # anticlockwise
        convex = len(hull) == 4 and np.ptp(np.diff(np.append(hull, hull[0])) % 4) == 0
        convex = convex and (hull[1] - hull[0]) % 4 == 1
        assert _convex(corners.copy()) == convex
        seen.add(convex)
    assert seen == {True, False}


@together("seed", range(3))
def test_a_regular_net_becomes_the_hexagons_around_its_first_node(seed: int) -> None:
    """Nineteen hexagons side by side, their nodes in any order but for the first inner one."""
    rng, steps = np.random.default_rng(seed), [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]
    ways = range(-2, 3)
    middles = [(i - j, i + 2 * j) for i in ways for j in ways if abs(i + j) < 3]
    around = [[(i + a, j + b) for a, b in steps] for i, j in middles]
    times = Counter(corner for ring in around for corner in ring)
    edge, inner = ([c for c in times if (times[c] < 3) == side] for side in (True, False))
    rng.shuffle(edge)
    later = [*inner, *middles[1:]]
    rng.shuffle(later)
    names = [*edge, middles[0], *later]
    names = [(int(i), int(j)) for i, j in names]
    number = {name: k for k, name in enumerate(names)}
    net = [
        [m, ring[k - 1], ring[k]] for m, ring in zip(middles, around, strict=True) for k in range(6)
    ]
    rng.shuffle(net)
    triangles = np.array([[number[tuple(map(int, n))] for n in t] for t in net])
    points = np.array([[i + 0.5 * j, 0.75**0.5 * j] for i, j in names])
    made = join_triangles(points, triangles, len(edge))
    assert set(made) == {6}
    wanted = {frozenset(number[n] for n in ring) for ring in around}
    assert {frozenset(row) for row in made[6].tolist()} == wanted


def test_triangles_with_a_common_side_make_one_quadrangle_each() -> None:
    """By the neighbours that Delaunay's triangulation tells, in any order of triangles."""
    rng = np.random.default_rng(4)
    points = rng.random((30, 2))
    made = Delaunay(points)
    first, second, quads = _pairs(made.simplices)
    wanted = {frozenset((i, j)) for i, row in enumerate(made.neighbors) for j in row if j >= 0}
    pairs = list(zip(first, second, strict=True))
    assert len(pairs) == len(wanted)
    assert {frozenset(map(int, pair)) for pair in pairs} == wanted
    for pair, quad in zip(pairs, quads, strict=True):
        both = [made.simplices[i] for i in pair]
        assert set(quad) == set(np.concatenate(both))
        sizes = [_signed(points[corners]) for corners in (*both, quad)]
        assert sizes[0] + sizes[1] == pytest.approx(sizes[2])


def _signed(x: np.ndarray) -> float:
    """Area of a polygon (k, 2), positive anticlockwise."""
    y = np.roll(x, -1, axis=0)
    return float(0.5 * (x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]).sum())


def test_open_contour_is_refused() -> None:
    nodes = NodeTable()
    ids = nodes.add(np.array([[0.0, 0], [1.0, 0], [1.0, 1.0]]))
    line = union(*(straight_line(nodes, int(ids[k]), int(ids[k + 1]), 3) for k in (0, 1)))
    with pytest.raises(MeshError, match="not closed"):
        filled(line, "TRI3")


def test_rays_in_the_plane_meet_the_nearest_line_that_they_cross():
    rng, nodes = np.random.default_rng(6), NodeTable()
    x = np.column_stack([rng.uniform(20.0, 24.0, (6, 2)), np.zeros(6)])
    ids = nodes.add(x)
    shape = facet_shape(Mesh.of(nodes, "SEG3", ids[[[0, 1, 2], [3, 4, 5]]]))
    starts, rays = (
        np.pad(rng.uniform(a, b, (40, 2)), ((0, 0), (0, 1))) for a, b in ((20, 24), (-1, 1))
    )
    found = shape.project_along(starts, rays)
    for start, ray, place in zip(starts, rays, found, strict=True):
        ways = []
        for i, j in ((0, 1), (1, 2), (3, 4), (4, 5)):
            way, share = np.linalg.solve(
                np.stack([ray, x[i] - x[j]], axis=1)[:2], (x[i] - start)[:2]
            )
            ways += [way] if 0.0 <= share <= 1.0 else []
        if ways:
            np.testing.assert_allclose(place, start + min(ways, key=abs) * ray, atol=1e-9)
        else:
            assert np.isnan(place).all()
