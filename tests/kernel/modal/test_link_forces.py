"""Forces of every kind of link against plain formulas and derivatives of an energy."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.modal import link_laws as law
from ssilang.kernel.modal.link_laws import Points, link_forces
from ssilang.kernel.modal.links import Link, link_arrays, segments_of

N = 4
RNG = np.random.default_rng(17)
Q, V = 0.3 * RNG.standard_normal(N), RNG.standard_normal(N)
SEES, RECEIVES = RNG.standard_normal((2, 3, N))
UNIT = RNG.standard_normal(3)
UNIT /= np.linalg.norm(UNIT)
NORMAL = dict(zip((law.NX, law.NY, law.NZ), UNIT, strict=True))


def forces(links, q=Q, v=V, t=0.4, state=None, points=None, segments=None):
    """Forces on the modes, what is recorded, the state of the links."""
    arrays = link_arrays(links, N, points, segments)
    state = np.zeros((len(links), law.STATES)) if state is None else state
    record, total = np.full((len(links), law.RECORDS), np.nan), np.full(N, np.nan)
    link_forces(np.array(q), np.array(v), t, arrays, state, record, total)
    return total, record, state


COUPLINGS = {
    law.POWER: lambda x, v, t: 1.7 * x**3.0,
    law.SINE: lambda x, v, t: 1.7 * np.sin(x),
    law.COSINE: lambda x, v, t: 1.7 * np.cos(x),
    law.COSINE_OF_TIME: lambda x, v, t: 1.7 * np.cos(2.3 * t) * x,
    law.SINE_OF_TIME: lambda x, v, t: 1.7 * np.sin(2.3 * t) * x,
    law.VELOCITY: lambda x, v, t: 1.7 * v,
}


@together("kind", COUPLINGS)
def test_couplings_are_their_formulas(kind):
    numbers = {law.FACTOR: 1.7, law.EXPONENT: 3.0, law.FREQUENCY: 2.3}
    total, record, _ = forces([Link(kind, RECEIVES, SEES, numbers)])
    x, v = SEES[0] @ Q, SEES[0] @ V
    f = COUPLINGS[kind](x, v, 0.4)
    np.testing.assert_allclose(total, RECEIVES[0] * f)
    wanted = (x, v, f, abs(f))
    np.testing.assert_allclose(record[0, [law.X, law.VN, law.FN, law.FORCE]], wanted)


def test_polynomials_are_products_of_what_is_beyond_gaps():
    terms = np.array([[1, 2.0, -0.9, 0.0, 0.0], [3, 1.0, 0.9, 3.0, -2.9]])
    q, v = np.array([0.0, -1.6, 0.0, 1.2]), np.array([0.0, 5.0, 0.0, -4.0])
    link = Link(law.POLYNOMIAL, RECEIVES, SEES, {law.FACTOR: -2.0}, terms=terms)
    total, _, _ = forces([link], q, v)
    np.testing.assert_allclose(total, RECEIVES[0] * -2.0 * 0.7**2 * 0.3 * 1.1**3)
    for i, value in ((1, -0.8), (3, 0.8)):
        assert not forces([link], np.where(np.arange(N) == i, value, q), v)[0].any()


# --- contacts: the energy of their springs, by geometry alone

SPRING = np.array([[0.0, 0.0], [0.4, 30.0], [1.1, 44.0]])


def stored(depth, law_points):
    """Energy of a spring at an overlap."""
    if depth <= 0.0:
        return 0.0
    if law_points is None:
        return 0.5 * 70.0 * depth**2
    s = np.linspace(0.0, depth, 4001)
    inside = np.interp(s, *law_points.T)
    beyond = law_points[-1, 1] + 20.0 * (s - law_points[-1, 0])
    return float(np.trapezoid(np.where(s > law_points[-1, 0], beyond, inside), s))


# all in the plane across the axis, as links of lines are made; the ring's line is along it
ACROSS = np.eye(3) - np.outer(UNIT, UNIT)
PLACES = np.array([[0.1, 0.3, 0.05], [-1.5, 0.0, 0.0], [0.2, 0.05, 0.1], [1.6, -0.4, 0.0],
                   [2.0, -2.0, 0.0]]) @ ACROSS  # fmt: skip
ROWS = ACROSS @ (0.2 * RNG.standard_normal((5, 3, N)))
ARMS = RNG.standard_normal((5, 3))
AXES = np.tile(UNIT, (5, 1))
SPINS = np.array([2, -1, 3, -1, 2])
POINTS = Points(ROWS, PLACES, SPINS, AXES, ARMS)
LINE = np.array([[1, 2], [2, 3], [3, 4]])
ALONG = Points(
    ROWS,
    np.concatenate([PLACES[:1], [0.4, -0.2, 0.1] + np.array([[-2.0], [-0.3], [0.5], [2]]) * UNIT]),
    np.array([2, -1, -1, -1, -1]), AXES, ARMS,
)  # fmt: skip


def turned(p, q):
    """What the rotation of its body moves a point by."""
    if SPINS[p] < 0:
        return np.zeros(3)
    e, a, angle = AXES[p], ARMS[p], q[SPINS[p]]
    along = (e @ a) * e
    return along + np.cos(angle) * (a - along) + np.sin(angle) * np.cross(e, a) - a


def places(q, of=POINTS):
    return [
        of.places[p] + of.rows[p] @ q + (turned(p, q) if of.spins[p] >= 0 else 0.0)
        for p in range(5)
    ]


OFF = ACROSS @ [0.05, -0.1, 0.2]


def plane_depth(q, gap):
    return UNIT @ (SEES @ q + turned(0, q) - turned(2, q)) - gap


def circle_depth(q, gap, outside=False):
    x = SEES @ q
    off = x - (UNIT @ x) * UNIT - OFF
    return (gap - np.linalg.norm(off)) if outside else (np.linalg.norm(off) - gap)


def line_depth(q, gap):
    """How far left of the line, seen against the axis, its point is."""
    x = places(q)
    best = None
    for a, b in LINE:
        s = np.clip((x[0] - x[a]) @ (x[b] - x[a]) / ((x[b] - x[a]) @ (x[b] - x[a])), 0.0, 1.0)
        off = x[0] - x[a] - s * (x[b] - x[a])
        if best is None or off @ off < best[0]:
            left = np.cross(UNIT, x[b] - x[a])
            best = off @ off, off - (off @ UNIT) * UNIT, left / np.linalg.norm(left), s
    assert 0.0 < best[3] < 1.0
    return best[1] @ best[2] - gap


def ring_depth(q, gap):
    x = places(q, ALONG)
    least = np.inf
    for a, b in LINE:
        s = (x[0] - x[a]) @ UNIT / ((x[b] - x[a]) @ UNIT)
        if 0.0 <= s <= 1.0:
            least = min(least, np.linalg.norm(x[0] - x[a] - s * (x[b] - x[a])))
    return least - gap


SIDES = dict(zip((law.EX, law.EY, law.EZ), OFF, strict=True))
SPAN = {law.FIRST: 0, law.LAST: 3}
CONTACTS = {
    "plane": (law.PLANE, plane_depth, {}, ((0, 1.0), (2, -1.0))),
    "circle": (law.CIRCLE, circle_depth, SIDES, ()),
    "outside": (law.CIRCLE, lambda q, g: circle_depth(q, g, True), SIDES | {law.OUTSIDE: 1.0}, ()),
    "line": (law.LINE, line_depth, SPAN, ((0, 1.0),)),
    "ring": (law.RING, ring_depth, SPAN, ((0, 1.0),)),
}


@together("spring", [None, SPRING])
@together("name", CONTACTS)
def test_contacts_push_by_the_derivative_of_their_energy(name, spring):
    kind, depth, more, ends = CONTACTS[name]
    met = 0
    for seed in range(6):
        q = 0.25 * np.random.default_rng(seed).standard_normal(N)
        on_line = kind in (law.LINE, law.RING)
        try:
            bare = depth(q, 0.0)
        except AssertionError:  # at a corner of the line: it has no single normal
            continue
        if not np.isfinite(bare):
            continue
        gap = 0.6 - bare if name == "outside" else bare - 0.6
        numbers = NORMAL | more | {law.GAP: gap}
        if spring is None:
            numbers[law.STIFF] = 70.0
        rows = ROWS[0] if on_line else SEES
        link = Link(kind, rows, rows, numbers, spring, ends=ends)
        segments = segments_of(LINE) if on_line else None
        points = ALONG if kind == law.RING else POINTS
        total, record, _ = forces([link], q, 0 * V, points=points, segments=segments)
        h = 1e-5
        exact = [
            (stored(depth(q - h * e, gap), spring) - stored(depth(q + h * e, gap), spring))
            / (2 * h)
            for e in np.eye(N)
        ]
        np.testing.assert_allclose(total, exact, atol=2e-3 * np.abs(exact).max())
        size = 42.0 if spring is None else 34.0  # at an overlap of 0.6
        assert record[0, law.FN] == pytest.approx(-size)
        assert record[0, law.FORCE] == pytest.approx(size)
        away = link.numbers | {law.GAP: gap + (-0.7 if name == "outside" else 0.7)}
        apart = Link(kind, rows, rows, away, spring, ends=ends)
        assert not forces([apart], q, V, points=points, segments=segments)[0].any()
        met += 1
    assert met >= 2


def test_a_line_pushes_what_is_left_of_it_by_its_distance_to_the_nearest_place():
    """At corners by the side of both segments, nothing beyond its ends, whatever lies off plane."""
    t1 = OFF / np.linalg.norm(OFF)
    plane = np.stack([t1, np.cross(UNIT, t1)])
    at = np.array([[-2.0, 0.5], [-0.5, -0.4], [0.6, 0.3], [2.0, 0.1]])
    rows = np.zeros((5, 3, N))
    rows[0, :, :3] = np.eye(3)
    x = np.concatenate([np.zeros((1, 3)), at @ plane])
    points = Points(rows, x, np.full(5, -1), AXES, ARMS)
    numbers = NORMAL | SPAN | {law.GAP: -0.4, law.STIFF: 70.0}
    link, met = Link(law.LINE, rows[0], rows[0], numbers, ends=((0, 1.0),)), set()
    for place in np.random.default_rng(2).uniform([-3.0, -1.0, -0.3], [3.0, 1.0, 0.3], (400, 3)):
        own, way = place[:2], np.diff(at, axis=0)
        s = ((own - at[:-1]) * way).sum(axis=1) / (way**2).sum(axis=1)
        off = own - at[:-1] - np.clip(s, 0.0, 1.0)[:, None] * way
        i = int(np.linalg.norm(off, axis=1).argmin())
        left = np.stack([-way[:, 1], way[:, 0]], axis=1) / np.linalg.norm(way, axis=1)[:, None]
        j = i - 1 if s[i] < 0.0 else i + 1 if s[i] > 1.0 else i
        kind = "end" if not 0 <= j < 3 else "side" if i == j else "corner"
        sign = np.sign(off[i] @ (left[i] + left[min(max(j, 0), 2)]))
        depth = -np.inf if kind == "end" else sign * np.linalg.norm(off[i])
        q = np.append(place[:2] @ plane + place[2] * UNIT, 0.7)
        total, record, _ = forces([link], q, 0 * V, points=points, segments=segments_of(LINE))
        push = 70.0 * max(depth + 0.4, 0.0)
        assert -record[0, law.FN] == pytest.approx(push, abs=1e-9)
        assert np.linalg.norm(total) == pytest.approx(push, abs=1e-9)
        if push and sign > 0.0:
            np.testing.assert_allclose(plane @ total[:3], -push * off[i] / depth, atol=1e-9)
        met.add((kind, sign, push > 0.0))
    assert len(met) > 7


def test_dampers_push_only_and_permanent_links_pull():
    x, v = UNIT @ SEES @ Q, UNIT @ SEES @ V
    numbers = NORMAL | {law.STIFF: 70.0, law.DAMP: 3.0, law.GAP: x - 0.6}
    total, record, _ = forces([Link(law.PLANE, SEES, SEES, numbers)])
    push = 42.0 + 3.0 * v
    assert push > 0.0
    np.testing.assert_allclose(total, -push * UNIT @ SEES)
    np.testing.assert_allclose(record[0, law.X : law.X + 3], SEES @ Q)
    np.testing.assert_allclose(record[0, law.VC : law.VC + 3], SEES @ V)
    assert record[0, law.VN] == pytest.approx(v)
    fast = np.sign(v) * -30.0 * V
    assert not forces([Link(law.PLANE, SEES, SEES, numbers)], v=fast)[0].any()
    pulls = numbers | {law.PERMANENT: 1.0, law.GAP: x + 0.6}
    total, _, _ = forces([Link(law.PLANE, SEES, SEES, pulls, SPRING)])
    np.testing.assert_allclose(total, (34.0 - 3.0 * v) * UNIT @ SEES)


@pytest.mark.parametrize("kinematic", [0.0, 1.0])
@pytest.mark.parametrize("permanent", [0.0, 1.0])
def test_plastic_springs_do_not_see_the_steps_and_stay_on_their_law(kinematic, permanent):
    """Over several lines of the law at once, there and back, beyond the start of hardening."""
    spring = np.array([[0.0, 0.0], [0.2, 10.0], [0.5, 16.0], [1.1, 20.0], [1.5, 21.0]])
    along = SEES.T @ UNIT / (UNIT @ SEES @ SEES.T @ UNIT)
    numbers = NORMAL | {law.GAP: 0.0, law.PLASTIC: 1.0, law.KINEMATIC: kinematic,
                        law.PERMANENT: permanent}  # fmt: skip
    link, states = [Link(law.PLANE, SEES, SEES, numbers, spring)], (None, None)
    x = 0.0
    for end in (0.9, 0.3, 1.9, 0.65, 1.2, -1.4, 0.4, 2.5, -2.0):
        found = []
        for way, state in zip(([end], np.linspace(x, end, 201)[1:]), states, strict=True):
            for at in way:
                _, record, state = forces(link, at * along, 0 * V, state=state)
            found.append((record[0, law.FN], state))
        assert found[0][0] == pytest.approx(found[1][0], rel=1e-9, abs=1e-9)
        np.testing.assert_allclose(found[0][1], found[1][1], rtol=1e-9, atol=1e-9)
        if end == 0.9 or (end == 1.9 and not kinematic):
            assert -found[0][0] == pytest.approx(np.interp(end, *spring.T) if end < 1 else 22.0)
        x, states = end, tuple(s for _, s in found)


DRIVE = np.array([0.3, -0.2, 0.5])


def sliding(numbers, v):
    x = SEES @ Q
    numbers = NORMAL | {law.STIFF: 70.0, law.GAP: UNIT @ x - 0.6, law.FRICTION: 1.0,
                        law.SLIDE: 0.3, law.STICK: 0.5, law.DX: DRIVE[0], law.DY: DRIVE[1],
                        law.DZ: DRIVE[2]} | numbers  # fmt: skip
    rate = SEES @ v
    across = rate - (UNIT @ rate) * UNIT - DRIVE
    return Link(law.PLANE, SEES, SEES, numbers), across


@together("share", [0.3, 4.0])
def test_regularised_friction_grows_to_that_of_sliding(share):
    _, across = sliding({}, V)
    speed = np.linalg.norm(across)
    link, _ = sliding({law.TANGENT: -1.0, law.TANGENT_DAMP: speed / share}, V)
    total, record, _ = forces([link])
    size = 0.3 * 42.0 * ((2 - share) * share if share < 1 else 1.0)
    ft = -size * across / speed
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], ft)
    np.testing.assert_allclose(total, (ft - 42.0 * UNIT) @ SEES)
    assert record[0, law.VT] == pytest.approx(speed)
    assert record[0, law.WEAR] == pytest.approx(42.0 * speed)


def test_sticking_friction_holds_to_its_limit_slides_and_sticks_again():
    link, across = sliding({law.TANGENT: 8.0, law.TANGENT_DAMP: 0.05}, V)
    state = np.zeros((1, law.STATES))
    _, record, _ = forces([link], t=1.0, state=state)
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], -0.05 * across)
    assert record[0, law.WEAR] == 0.0
    tangent = SEES - np.outer(UNIT, UNIT @ SEES)
    move = np.linalg.lstsq(SEES, np.cross(UNIT, [0.4, 0.1, -0.2]))[0]
    step = tangent @ move
    _, record, _ = forces([link], Q + move, t=1.5, state=state)
    held = -8.0 * (step - 0.5 * DRIVE) - 0.05 * across
    assert np.linalg.norm(held) < 0.5 * 42.0
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], held)
    _, record, _ = forces([link], Q + 20 * move, t=2.0, state=state)
    beyond = -8.0 * (20 * step - 1.0 * DRIVE) - 0.05 * across
    beyond *= 0.3 * 42.0 / np.linalg.norm(beyond)
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], beyond)
    forward = V + 9.0 * move  # goes on the same way
    _, across = sliding({}, forward)
    _, record, _ = forces([link], Q + 20 * move, forward, t=2.0, state=state)
    slides = -0.3 * 42.0 * across / np.linalg.norm(across)
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], slides)
    assert record[0, law.WEAR] == pytest.approx(42.0 * np.linalg.norm(across))
    back = np.linalg.lstsq(SEES, DRIVE - 0.5 * across + 0.3 * UNIT)[0]
    _, turning = sliding({}, back)
    _, record, _ = forces([link], Q + 20 * move, back, t=2.0, state=state)
    np.testing.assert_allclose(record[0, law.FT : law.FT + 3], slides - 0.05 * turning, rtol=1e-6)
    assert record[0, law.WEAR] == 0.0


def test_the_edge_of_a_circle_rubs_where_it_touches():
    """A turning point of radius r in a hole: its edge has the velocity of the centre and r w."""
    turns = RNG.standard_normal((3, N))
    x = SEES @ Q
    off = x - (UNIT @ x) * UNIT - OFF
    n = off / np.linalg.norm(off)
    numbers = NORMAL | SIDES | {law.STIFF: 70.0, law.GAP: np.linalg.norm(off) - 0.6,
                                law.RADIUS: 0.7, law.FRICTION: 1.0, law.SLIDE: 0.3,
                                law.TANGENT: -1.0, law.TANGENT_DAMP: 1e-9, law.DX: 1.4}  # fmt: skip
    total, record, _ = forces([Link(law.CIRCLE, SEES, SEES, numbers, turns=turns)])
    rows = SEES + np.cross(turns, 0.7 * n, axisa=0, axisb=0, axisc=0)
    rate = rows @ V
    across = rate - (n @ rate) * n - 1.4 * np.cross(UNIT, n)
    f = -42.0 * n - 0.3 * 42.0 * across / np.linalg.norm(across)
    np.testing.assert_allclose(total, f @ rows)
    np.testing.assert_allclose(record[0, law.VC : law.VC + 3], rate)
    np.testing.assert_allclose(record[0, law.MC : law.MC + 3], np.cross(0.7 * n, f))


def test_conditions_look_at_groups_of_links():
    x = SEES[0] @ Q
    assert x != 0.0
    pushes = Link(law.POWER, RECEIVES, SEES, {law.FACTOR: 2.0, law.EXPONENT: 1.0}, group=1)
    rests = Link(law.POWER, RECEIVES, SEES, {law.FACTOR: 0.0, law.EXPONENT: 1.0}, group=1)
    numbers = {law.FACTOR: 5.0, law.EXPONENT: 1.0}
    for wanted in (True, False):
        third = Link(law.POWER, SEES, SEES, numbers, conditions={1: wanted}, group=0)
        for others, active in (([pushes, rests], True), ([rests, pushes], True),
                               ([rests, rests], False)):  # fmt: skip
            total, _, _ = forces([*others, third])
            alone = sum(2.0 * x * RECEIVES[0] for o in others if o is pushes) + 0 * Q
            np.testing.assert_allclose(total, alone + (5.0 * x * SEES[0]) * (active == wanted))
