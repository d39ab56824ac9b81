"""Curves in a crooked frame against their definitions, by small chords; ways along networks."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines import curves
from ssilang.kernel.mesh.lines.crossing_curve import crossing_curve
from ssilang.kernel.mesh.lines.lines import (
    frenet_frames,
    line_chain,
    network_of_lines,
    shortest_line,
)
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

FRAME = np.linalg.qr(np.random.default_rng(6).standard_normal((3, 3)))[0]
AT = np.array([1.3, -0.4, 2.2])


def place(angle, radius=1.7, height=0.3):
    return AT + FRAME @ np.array([radius * np.cos(angle), radius * np.sin(angle), height])


def inside(x):
    return (x - AT) @ FRAME


def chords(x):
    return np.linalg.norm(np.diff(x, axis=0), axis=1)


S = np.linspace(0.0, 1.0, 4001)
ARCS = {
    "centre": (curves.arc_about_centre(place(0.4), AT + 0.3 * FRAME[:, 2], place(2.9)), 0.4, 2.9),
    "short way": (
        curves.arc_about_centre(place(5), AT + 0.3 * FRAME[:, 2], place(1)), 5, 1 + 2 * np.pi
    ),
    "through": (curves.arc_through(place(0.4), place(3.1), place(5.0)), 0.4, 5.0),
    "other way": (curves.arc_through(place(0.4), place(5.8), place(5.0)), 0.4, 5.0 - 2 * np.pi),
    "axis": (curves.arc_about_axis(place(0.4), AT, 3 * FRAME[:, 2], 1.9), 0.4, None),
    "backwards": (curves.arc_about_axis(place(0.4), AT, 3 * FRAME[:, 2], -4.0), 0.4, None),
}  # fmt: skip


@together("name", ARCS)
def test_arcs_turn_evenly_at_their_radius_from_end_to_end(name):
    arc, first, last = ARCS[name]
    if last is None:  # the frame may be left-handed
        last = first + arc.angle * np.sign(np.linalg.det(FRAME))
    angles = np.linspace(first, last, len(S))
    expected = np.array([place(a) for a in angles[::400]])
    np.testing.assert_allclose(arc(S[::400]), expected, atol=1e-12)
    assert arc.length == pytest.approx(1.7 * abs(last - first), rel=1e-12)


def test_a_centre_slightly_off_is_moved_onto_the_mediator():
    arc = curves.arc_about_centre(place(0.0), AT + FRAME @ [0.004, 0.0, 0.3], place(1.0))
    np.testing.assert_allclose(arc(np.array([0.0, 1.0])), [place(0.0), place(1.0)], atol=1e-12)
    assert arc.length == pytest.approx(1.7, rel=5e-3)


COEFFICIENTS = np.random.default_rng(2).standard_normal((4, 3))
POLYNOMIALS = {
    "parabola": curves.parabola(place(0), place(1, 3.0), place(2)),
    "cubic": curves.cubic_through(place(0), place(1), place(2, 2.5), place(3), True),
    "part": curves.Polynomial(COEFFICIENTS, -0.4, 1.3, regular=True),
    "back": curves.Polynomial(COEFFICIENTS, 1.3, -0.4, regular=True),
}


@together("name", POLYNOMIALS)
def test_polynomials_are_run_through_at_one_speed(name):
    curve = POLYNOMIALS[name]
    steps = chords(curve(S))
    assert curve.length == pytest.approx(steps.sum(), rel=1e-6)
    np.testing.assert_allclose(steps, steps.mean(), rtol=1e-4)
    free = curves.Polynomial(curve.coefficients, curve.begin, curve.finish)
    u = curve.begin + S * (curve.finish - curve.begin)
    np.testing.assert_allclose(free.parameter(S), u)
    straight = sum(c * u[:, None] ** i for i, c in enumerate(curve.coefficients))
    np.testing.assert_allclose(free(S), straight, atol=1e-12)
    assert free.length == pytest.approx(curve.length)


def test_polynomials_meet_what_they_are_made_of():
    ends = np.array([0.0, 1.0])
    p = [place(0), place(1, 3.0), place(2), place(3, 2.0)]
    cubic = curves.cubic_through(*p, False)
    np.testing.assert_allclose(cubic(np.array([0, 1 / 3, 2 / 3, 1])), p, atol=1e-12)
    h = 1e-6
    for curve, tangents in (
        (curves.parabola(*p[:3]), (2 * (p[1] - p[0]), 2 * (p[2] - p[1]))),
        (curves.cubic_tangents(p[0], p[1] - p[0], p[3] - p[1], p[3]), (p[1] - p[0], p[3] - p[1])),
    ):
        last = p[2] if len(curve.coefficients) == 3 else p[3]
        np.testing.assert_allclose(curve.at(ends), [p[0], last], atol=1e-12)
        slope = (curve.at(ends + h) - curve.at(ends - h)) / (2 * h)
        np.testing.assert_allclose(slope, tangents, atol=1e-7)


def test_parabolas_touch_their_arc_at_their_ends():
    arc, fractions = ARCS["through"][0], np.array([0.0, 0.1, 0.45, 0.6, 1.0])
    middles = curves.parabolic_middles(arc, fractions)
    h = 1e-6
    for a, b, middle in zip(fractions[:-1], fractions[1:], middles, strict=True):
        ends = arc(np.array([a, b]))
        corner = 2 * middle - ends.mean(axis=0)  # the end tangents of the parabola meet there
        for at, end in zip((a, b), ends, strict=True):
            along = arc(np.array([at + h])) - arc(np.array([at - h]))
            np.testing.assert_allclose(np.cross(along / np.linalg.norm(along), corner - end), 0,
                                       atol=1e-8)  # fmt: skip
    with pytest.raises(MeshError, match="half turn"):
        curves.parabolic_middles(arc, np.array([0.0, 0.2, 1.0]))


@together(
    "made, match",
    [
        (lambda: curves.arc_about_centre(AT, place(1), AT), "coincide"),
        (lambda: curves.arc_about_centre(place(0), AT, place(1, 3.6)), "distance"),
        (lambda: curves.arc_about_centre(place(0), AT + 0.3 * FRAME[:, 2], place(np.pi)), "line"),
        (lambda: curves.arc_through(AT, AT + FRAME[0], AT + 3 * FRAME[0]), "line"),
        (lambda: curves.arc_about_axis(AT, AT, AT * 0, 1.0), "coincide"),
        (lambda: curves.arc_about_axis(AT + FRAME[0], AT, FRAME[0], 1.0), "axis"),
        (lambda: curves.plane_normal(AT, place(1), 2 * place(1) - AT), "line"),
    ],
)
def test_curves_that_are_not_defined_are_refused(made, match):
    with pytest.raises(MeshError, match=match):
        made()


# --- where a sphere and a plane, or a cylinder, cross --------------------------------------------


def sphere(x):
    return np.linalg.norm(inside(x), axis=1) - 2.0


def flat(x):
    return inside(x)[:, 2] - 1.2


RADIUS = 1.6  # of the circle where they cross


def round_about(a):
    return place(a, RADIUS, 1.2)


@together("last, turn, share", [(2.6, 2.6, None), (3.6, 3.6 - 2 * np.pi, 0.6), (2.6, 2.6, 1.3)])
def test_a_crossing_is_followed_the_short_way_and_beyond(last, turn, share):
    length = None if share is None else share * RADIUS * abs(turn)
    curve = crossing_curve((sphere, flat), round_about(0.0), round_about(last), length)
    part = turn * (share or 1.0)
    assert curve.length == pytest.approx(RADIUS * abs(part), rel=1e-8)
    s = np.array([0.0, 0.17, 0.5, 0.83, 1.0])
    expected = np.array([round_about(a) for a in part * s])
    np.testing.assert_allclose(curve(s), expected, atol=1e-6)
    np.testing.assert_allclose(sphere(curve(s)), 0.0, atol=1e-9)


def test_surfaces_that_touch_or_points_off_them_are_refused():
    a, b = round_about(0.0), round_about(1.0)
    with pytest.raises(MeshError, match="same"):
        crossing_curve((sphere, flat), a, a)
    for ends, which in (((a + 0.01, b), "first"), ((a, b + 0.01), "last")):
        with pytest.raises(MeshError, match=which):
            crossing_curve((sphere, flat), *ends)
    with pytest.raises(MeshError, match="touch"):
        crossing_curve((sphere, sphere), a, b)


@together(
    "length, start, end, count",
    [
        (7.0, 0.3, 1.1, 0),
        (7.0, 1.1, 0.3, 0),
        (7.0, 0.3, 1.1, -5),
        (0.02, 0.005, 0.001, 0),
        (5.0, 0.8, 0.8, 0),
        (5.0, 0.8, 0.8, -4),
        (7.0, 0.3, 0.0, -5),
        (5.0, 0.0, 0.0, -4),
        (5.0, 0.0, 0.0, 7),
    ],
)
def test_sizes_grow_by_one_ratio_whose_end_sizes_are_those_asked_for(length, start, end, count):
    cuts = subdivide(length, start, end, count)
    sizes = length * np.diff(cuts.fractions)
    ratio = sizes[1:] / sizes[:-1]
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-9)
    np.testing.assert_allclose(cuts.middles, (cuts.fractions[1:] + cuts.fractions[:-1]) / 2)
    if count > 0:
        np.testing.assert_allclose(sizes, length / count)
        return
    d = (end - start) / length
    np.testing.assert_allclose(np.sqrt(ratio) - 1 / np.sqrt(ratio), d, atol=1e-9)
    if count:
        assert cuts.count == -count
    elif start != end:  # the number for which the first is the size at the start, or nearest
        exact = np.log(end / start) / np.log(ratio[0])
        assert cuts.count == round(exact) or abs(np.log(cuts.count / exact)) < np.log(1.5)
        assert sizes[0] / np.sqrt(ratio[0]) == pytest.approx(start, rel=0.2)
    np.testing.assert_allclose(cuts.density(np.array([0.0, 1.0])),
                               [cuts.start_density, cuts.end_density])  # fmt: skip
    assert cuts.end_density == end
    for bad, match in (((1.0, 0.0, 1.0), "positive"), ((0.0, 1.0, 1.0), "zero"),
                       ((1.0, 0.0, -1.0, -3), "positive"),
                       ((1e9, 1.0, 1.0), "elements")):  # fmt: skip
        with pytest.raises(MeshError, match=match):
            subdivide(*bad)


def network():
    """A square 0 1 2 3 of four cells, a tail 2 4, a lone cell 5 6; cells of any sense."""
    nodes = NodeTable()
    at = [(0, 0), (1, 0), (1, 1), (0, 1.5), (2, 1), (5, 0), (6, 0)]
    ids = nodes.add(np.array([(x, y, 0.0) for x, y in at]), np.zeros(len(at)))
    cells = ids[np.array([[1, 0], [1, 2], [3, 2], [3, 0], [4, 2], [5, 6]])]
    return ids, Mesh.of(nodes, "SEG2", cells)


def test_the_shortest_way_is_taken_and_described_from_its_beginning():
    ids, mesh = network()
    assert network_of_lines(mesh)
    found = shortest_line(mesh, int(ids[0]), int(ids[4]))
    np.testing.assert_array_equal(
        found.blocks[0].connectivity, ids[np.array([[0, 1], [1, 2], [2, 4]])]
    )


def test_points_that_no_way_joins_are_refused():
    ids, mesh = network()
    with pytest.raises(MeshError, match="no way"):
        shortest_line(mesh, int(ids[0]), int(ids[5]))
    with pytest.raises(MeshError, match="ends"):
        shortest_line(mesh, int(ids[0]), int(ids[0]))


@together("kind", ["SEG2", "SEG3"])
@together("closed", [False, True])
def test_cells_of_a_line_in_no_order_are_put_one_behind_the_other(kind, closed):
    nodes, step = NodeTable(), 1 if kind == "SEG2" else 2
    angle = np.arange(5 * step + 1) * 1.1 / step
    ids = nodes.add(np.column_stack([np.cos(angle), np.sin(angle), angle]))[::-1].copy()
    chain = np.append(ids[:-1], ids[0]) if closed else ids
    cells = np.stack([chain[k : len(chain) - step + k : step] for k in range(step + 1)], axis=1)
    found = line_chain(Mesh.of(nodes, kind, cells[[3, 0, 4, 1, 2]]))
    wanted = chain if not closed else np.roll(chain[:-1], -3 * step).tolist()
    assert found.tolist()[: len(wanted)] == list(wanted)
    assert (found[0] == found[-1]) is np.bool_(closed)
    back = cells.copy()
    back[2] = back[2, ::-1]
    assert line_chain(Mesh.of(nodes, kind, back)).tolist() == chain.tolist()
    with pytest.raises(MeshError, match="follow"):
        line_chain(Mesh.of(nodes, kind, cells[[0, 1, 3]]))


def test_frames_of_an_arc_in_space_are_those_of_its_circle():
    """Uneven steps in a slanted plane, nodes and cells in no order; at both ends along the cell."""
    nodes, order = NodeTable(), np.array([3, 0, 4, 1, 2])
    nodes.add(np.ones((3, 3)))
    across, up, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    c, s = (f(np.cumsum([0.3, 0.2, 0.5, 0.1, 0.4]))[:, None] for f in (np.cos, np.sin))
    out, along = c * across + s * up, c * up - s * across
    ids = nodes.add([3.0, -1.0, 2.0] + 2.0 * out[order])[np.argsort(order)]
    cells = np.column_stack([ids[:-1], ids[1:]])[[2, 0, 3, 1]]
    found, frames = frenet_frames(Mesh.of(nodes, "SEG2", cells))
    frames = frames[np.searchsorted(found, ids)]
    binormal = np.cross(along, -out)
    ends = np.diff(out, axis=0)[[0, -1]]
    along[[0, -1]] = ends / np.linalg.norm(ends, axis=1, keepdims=True)
    wanted = np.stack([along, np.cross(binormal, along), binormal], axis=1)
    np.testing.assert_allclose(frames, wanted, atol=1e-12)


@together("to, binormal", [([0.6, 0, 0.8], [-0.8, 0, 0.6]), ([0, 0, 1], [0, 1, 0])])
@together("count", [1, 3])
def test_straight_lines_have_their_binormal_near_the_z_axis(count, to, binormal):
    nodes = NodeTable()
    ids = nodes.add(np.arange(count + 1)[:, None] ** 1.5 * np.array(to))
    line = Mesh.of(nodes, "SEG2", np.column_stack([ids[:-1], ids[1:]]))
    wanted = [to, np.cross(binormal, to), binormal]
    np.testing.assert_allclose(frenet_frames(line)[1], [wanted] * (count + 1), atol=1e-12)
    with pytest.raises(MeshError, match="branches"):
        frenet_frames(Mesh.of(nodes, "SEG2", [*line.blocks[0].connectivity, ids[[0, -1]]][-2:]))
