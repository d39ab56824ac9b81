"""Simple surfaces in a crooked frame: distances, projections and charts against their equations."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces import analytic, charts
from ssilang.kernel.mesh.surfaces.surface import facet_shape

RNG = np.random.default_rng(5)
FRAME = np.linalg.qr(RNG.standard_normal((3, 3)))[0]
ORIGIN = np.array([0.7, -1.3, 2.1])


def place(*local):
    """Points from coordinates whose third axis is the surface's."""
    return [ORIGIN + FRAME @ np.array(p, float) for p in local]


def local(x):
    return (x - ORIGIN) @ FRAME


def radial(p):
    return np.hypot(p[..., 0], p[..., 1])


# name: the shape, and a function of local coordinates that is its distance
SHAPES = {
    "sphere": (
        analytic.sphere_shape(*place([0, 0, 0], [1.0, 2.0, -2.0])),
        lambda p: np.linalg.norm(p, axis=-1) - 3.0,
    ),
    "plane": (
        analytic.plane_shape(*place([0.2, 0.1, 0.4], [1.5, 0.3, 0.4], [0.4, 2.0, 0.4])),
        lambda p: p[..., 2] - 0.4,
    ),
    "cylinder": (
        analytic.cylinder_shape(*place([0, 0, -1], [0, 0, 2], [1.2, 0.5, 0.8])),
        lambda p: radial(p) - 1.3,
    ),
    "cone": (
        analytic.cone_shape(*place([0, 0, 0], [0, 0, 2], [0.9, 1.2, 2.0])),
        lambda p: (2.0 * radial(p) - 1.5 * np.abs(p[..., 2])) / 2.5,
    ),
    "torus": (
        analytic.torus_shape(*place([0, 0, 0], [0, 0, 1], [0, 2.0, 0.3], [2.4, 0, 0.3])),
        lambda p: np.hypot(radial(p) - 2.0, p[..., 2]) - 0.5,
    ),
}


@together("name", SHAPES)
def test_distances_are_those_of_the_equation(name):
    shape, equation = SHAPES[name]
    x = ORIGIN + 2.5 * RNG.standard_normal((40, 3))
    expected = equation(local(x))
    if name == "plane":  # which side counts is by the order of its points
        side = FRAME[:, 2] @ np.cross(FRAME[:, 0], FRAME[:, 1])
        expected = expected * side
    np.testing.assert_allclose(shape.distance(x), expected, atol=1e-12)


@together("apex", [None, np.array([0.5, 0.9, -0.4])])
@together("name", SHAPES)
def test_projections_are_the_nearest_along_the_ray_on_either_side(name, apex):
    shape, equation = SHAPES[name]
    x = ORIGIN + 1.7 * np.random.default_rng(3).standard_normal((30, 3))
    way = np.array([0.6, -2.0, 1.1])
    rays = np.broadcast_to(way, x.shape) if apex is None else x - apex
    rays = rays / np.linalg.norm(rays, axis=1)[:, None]
    t = np.linspace(-9.0, 9.0, 4501)
    values = equation(local(x[:, None] + t[:, None] * rays[:, None]))
    change = values[:, :-1] * values[:, 1:] < 0
    met = change.any(axis=1)
    assert met.sum() > 6
    away = np.where(change, np.abs(t[:-1] + 2e-3), np.inf).min(axis=1)
    found = analytic.project(shape, x[met], way if apex is None else None, apex)
    arm = found - x[met]
    np.testing.assert_allclose(np.cross(arm, rays[met]), 0.0, atol=1e-9)
    np.testing.assert_allclose(equation(local(found)), 0.0, atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(arm, axis=1), away[met], atol=4e-3)
    grazing = np.abs(values).min(axis=1) < 0.05
    if name != "plane" and (~met & ~grazing).any():
        with pytest.raises(MeshError, match="no projection"):
            analytic.project(shape, x[~grazing], way if apex is None else None, apex)


def test_what_has_no_projection_or_no_shape_is_refused():
    shape, a, b = SHAPES["sphere"][0], *place([1, 2, 3], [0, 1, 4])
    apart = np.array([a, b])
    for match, made in {
        "apex": lambda: analytic.project(shape, apart, None, b),
        "direction": lambda: analytic.project(shape, apart, np.zeros(3), None),
        "coincide": lambda: analytic.line_shape(a, a),
        "line": lambda: analytic.plane_shape(a, b, 2 * b - a),
        "axis": lambda: analytic.cylinder_shape(b, b, a),
        "cone": lambda: analytic.cone_shape(*place([0, 0, 0], [0, 0, 1], [2, 1, 0])),
        "torus": lambda: analytic.torus_shape(a, a, b, b),
    }.items():
        with pytest.raises(MeshError, match=match):
            made()


def test_a_line_of_the_plane_is_met_where_two_lines_cross():
    shape = analytic.line_shape(np.array([1.0, 2.0, 0.0]), np.array([4.0, 3.0, 0.0]))
    x = np.array([[2.0, 5.0, 0.0], [-1.0, 0.5, 0.0]])
    normal = np.array([-1.0, 3.0]) / np.sqrt(10)
    np.testing.assert_allclose(shape.distance(x), np.abs((x[:, :2] - [1, 2]) @ normal))
    found = analytic.project(shape, x, np.array([1.0, 1.0, 0.0]), None)
    s = np.linalg.solve([[3.0, -1.0], [1.0, -1.0]], (x[:, :2] - [1, 2]).T)[0]
    np.testing.assert_allclose(found[:, :2], np.array([1.0, 2.0]) + s[:, None] * [3.0, 1.0])


# --- charts: the inside of a contour on each surface --------------------------------------------

TURN, HIGH = np.meshgrid(np.linspace(0.3, 1.4, 5), np.linspace(0.4, 1.1, 4))
RIM = np.ones(TURN.shape, bool)
RIM[1:-1, 1:-1] = False


def on_surface(name):
    """Local coordinates of a patch (5 x 4 points) of a surface, not about the middle of it."""
    u, v = TURN.ravel(), HIGH.ravel()
    ring = np.column_stack([np.cos(u), np.sin(u), 0 * u])
    up = np.array([0.0, 0.0, 1.0])
    return {
        "plane": np.column_stack([u, v, 0 * u + 0.4]),
        "cylinder": 1.3 * ring + v[:, None] * up,
        "cone": v[:, None] * (0.6 * ring + 0.8 * up),
        "downward cone": v[:, None] * (0.6 * ring - 0.8 * up),
        "sphere": 3 * (np.cos(v)[:, None] * ring + np.sin(v)[:, None] * up),
        "torus": (2 + 0.5 * np.cos(3 * v))[:, None] * ring + 0.5 * np.sin(3 * v)[:, None] * up,
    }[name]


def chart_of(name, boundary):
    o, z, ring = place([0, 0, 0], [0, 0, 2], [0, 2.0, 0.3])
    if name == "plane":
        return charts.plane_chart(boundary, np.stack([boundary, np.roll(boundary, -1, 0)], axis=1))
    if name == "sphere":
        return charts.sphere_chart(boundary, o)
    if name == "torus":
        return charts.torus_chart(boundary, o, z, ring)
    return {"cylinder": charts.cylinder_chart}.get(name, charts.cone_chart)(boundary, o, z)


CHARTS = ("plane", "cylinder", "cone", "downward cone", "sphere", "torus")


@together("name", CHARTS)
def test_a_chart_lifts_what_it_flattens_and_keeps_lengths_or_angles(name):
    """Planes, cylinders and cones keep both; spheres angles; the torus lengths where it is read."""
    x = ORIGIN + on_surface(name) @ FRAME.T
    rim = x[RIM.ravel()]
    if name == "plane":  # in the order of its contour
        rim = x.reshape(4, 5, 3)
        rim = np.concatenate([rim[0, :-1], rim[:-1, -1], rim[-1, :0:-1], rim[:0:-1, 0]])
    chart = chart_of(name, rim)
    flat = chart.flatten(x)
    np.testing.assert_allclose(chart.lift(flat), x, atol=1e-12)
    h = 1e-6
    steps = [(chart.lift(flat + h * e) - chart.lift(flat - h * e)) / (2 * h) for e in np.eye(2)]
    a, b = (np.linalg.norm(s, axis=1) for s in steps)
    np.testing.assert_allclose((steps[0] * steps[1]).sum(axis=1), 0.0, atol=1e-7)
    if name == "torus":
        np.testing.assert_allclose(a, radial(on_surface(name)) / 2.0, rtol=1e-7)
    elif name == "sphere":
        np.testing.assert_allclose(a, b, rtol=1e-7)
    else:
        np.testing.assert_allclose(a, 1.0, rtol=1e-7)
    if name != "sphere":
        np.testing.assert_allclose(b, 1.0, rtol=1e-7)


# --- facets --------------------------------------------------------------------------------------


def crossing(x, way, corners):
    """Where a line meets a polygon's plane inside it, by the fan around its mean, or None."""
    for i in range(len(corners)):
        a, b, c = corners[i], corners[(i + 1) % len(corners)], corners.mean(axis=0)
        try:
            s, t, w = np.linalg.solve(np.column_stack([b - a, c - a, -way]), x - a)
        except np.linalg.LinAlgError:
            continue
        if min(s, t, 1 - s - t) > -1e-9:
            return w
    return None


def test_facets_are_met_where_lines_meet_the_nearest_of_them():
    nodes, up = NodeTable(), np.array([0.4, 0.2, 3.0])
    foot = np.array([[0.0, 0.0, 0.0], [2.0, 0.3, 0.5], [1.4, 2.2, 0.1]])
    ids = nodes.add(np.concatenate([foot, foot + up]))
    sheet = Mesh.of(nodes, "QUA4", ids[[[0, 1, 4, 3], [2, 5, 4, 1]]])
    other = Mesh.of(nodes, "TRI3", nodes.add(np.array([[0, 2, 0.3], [3, 2, 1], [1, 3, 3.0]]))[None])
    both = Mesh(nodes, (*sheet.blocks, *other.blocks))
    x = np.array([[0.2, 1.5, 1.2], [1.5, -1.0, 1.4], [3.0, 1.1, 1.5], [1.3, 4.0, 1.3]])
    way = np.array([0.35, 0.9, 0.11]) / np.linalg.norm([0.35, 0.9, 0.11])
    found = facet_shape(both).project_along(x, np.broadcast_to(way, x.shape))
    seen = 0
    for at, got in zip(x, found, strict=True):
        hits = [crossing(at, way, k) for block in both.blocks for k in block.coordinates]
        hits = [w for w in hits if w is not None]
        if not hits:
            assert np.isnan(got).all()
            continue
        seen += 1
        np.testing.assert_allclose(got, at + min(hits, key=abs) * way, atol=1e-12)
    assert seen > 1
