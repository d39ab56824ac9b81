"""Macro-elements whose ground yields: capacities of the whole footing, its tangent, its energy."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from references.assembled import Bench
from references.recorder import recorded
from scipy.optimize import brentq
from together import together

from ssilang.kernel.base.errors import ConvergenceError, MaterialError
from ssilang.kernel.curves.curve import Load
from ssilang.kernel.interface.footing import footings_of
from ssilang.kernel.interface.interface import (
    interface_field,
    interface_of,
    joint_zones,
    point_history,
    state_field,
    state_from_field,
)
from ssilang.kernel.interface.laws.columns import N_STATE
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.response import (
    interface_energies,
    interface_forces,
    interface_stiffness,
    local_jumps,
)
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping.problem.plausibility import overloads

B, L, R, C = 4.0, 6.0, 2.0, 5e4
STRIP = {"KN": 8e7, "KS": 4e7, "LARG": B}
RECTANGLE = STRIP | {"LONG": L}
DISC = {"KN": 8e7, "KS": 4e7, "RAYO": R}
PLANE, SPACE = Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL
SHAPES = {
    "strip": (PLANE, "MACRO_SEMELLE", STRIP),
    "disc in the plane": (PLANE, "MACRO_DISQUE", DISC),
    "rectangle": (SPACE, "MACRO_SEMELLE", RECTANGLE),
    "wide rectangle": (SPACE, "MACRO_SEMELLE", RECTANGLE | {"LARG": L, "LONG": B}),
    "disc": (SPACE, "MACRO_DISQUE", DISC),
}


class Footing:
    """A macro-element at the origin, moved by hand, with the memory of its path."""

    def __init__(self, mode, law, **given):
        bench = Bench(mode)
        self.space = mode is SPACE
        self.soil = bench.node(0.0, 0.0, -1.0) if self.space else bench.node(0.0, -1.0)
        self.base = bench.node(0.0, 0.0, 0.0) if self.space else bench.node(0.0, 0.0)
        bench.joint("SEG2", [[self.soil, self.base]], "JOI1", law, **given)
        self.names = ("UX", "UY", "UZ", "RX", "RY", "RZ") if self.space else ("UX", "UY", "RZ")
        for node in (self.soil, self.base):
            for name in self.names:
                bench.spring(1.0, node, unknown=name)
        self.problem = bench.problem(np.array([0.0, 1.0]))
        places = [self.problem.numbering.index_of(self.base, name) for name in self.names]
        self.joints = self.problem.interface
        self.state = self.joints.initial_state()
        self.J = self.joints.J.toarray()[:, places]
        """Jumps by motions of the base, in the order of its names."""
        self.springs = self.problem.K.toarray()[np.ix_(places, places)] - np.eye(len(places))
        """Stiffness of the linear springs that stand beside the interface, on the base."""

    def tried(self, motion):
        """Tractions, states and tangents at motions of the base, in the order of its names."""
        x = self.joints
        w, t = np.zeros((x.n_points, x.dimension)), np.zeros((x.n_points, x.dimension))
        new, D = np.zeros((x.n_points, N_STATE)), np.zeros((x.n_points, x.dimension, x.dimension))
        local_jumps(x.points, self.J @ motion, w)
        respond(x.codes, w, self.state, x.points.p, t, new, D)
        return w, t, new, D

    def force(self, t):
        """Forces of the interface on the base, in the order of its names."""
        f = np.zeros(self.joints.size)
        interface_forces(self.joints.points, t, f)
        return self.J.T @ f

    def whole(self, motion):
        """Forces with those of the linear springs that stand beside the interface."""
        w, t, new, _ = self.tried(motion)
        return self.force(t) + self.springs @ motion, (w, t, new)

    def move(self, motion):
        found, (_, _, self.state) = self.whole(np.asarray(motion, float))
        return found

    def stiffness(self, motion):
        _, _, _, D = self.tried(motion)
        K = np.zeros((self.joints.size, self.joints.size))
        interface_stiffness(self.joints.points, D, K)
        return self.J.T @ K @ self.J


def made(name, **given):
    mode, law, sizes = SHAPES[name]
    return Footing(mode, law, **(sizes | given))


def motion_of(footing, u=0.0, v=0.0, theta=0.0):
    """Along X, up, and a turn that lifts the side of positive X."""
    return np.array([u, 0.0, v, 0.0, -theta, 0.0] if footing.space else [u, v, theta])


AREAS = {"strip": B, "disc in the plane": math.pi * R**2, "rectangle": B * L,
         "wide rectangle": B * L, "disc": math.pi * R**2}  # fmt: skip
FACTORS = {"strip": 2 + math.pi, "disc in the plane": 6.05, "disc": 6.05,
           "rectangle": (2 + math.pi) * (1 + 0.2 * B / L)}  # fmt: skip
FACTORS["wide rectangle"] = FACTORS["rectangle"]  # B is the shorter side


@together("name", SHAPES)
def test_pressed_down_it_bears_its_capacity(name):
    footing = made(name, COHE=C)
    up = 2 if footing.space else 1
    capacity = FACTORS[name] * C * AREAS[name]
    assert footing.move(motion_of(footing, v=-2.0))[up] == pytest.approx(-capacity, rel=1e-12)
    half = made(name, COHE=C, QULT=1e5)
    assert half.move(motion_of(half, v=-2.0))[up] == pytest.approx(-1e5 * AREAS[name], rel=1e-12)


@together("name", SHAPES)
def test_dragged_along_it_holds_by_the_cohesion_and_twisted_by_its_lever(name):
    footing = made(name, COHE=C)
    dragged = footing.move(motion_of(footing, u=3.0))[0]
    assert dragged == pytest.approx(C * AREAS[name], rel=1e-9)
    if name == "disc":  # 2/3 pi r^3 c, by rings
        twist = made(name, COHE=C).move([0.0, 0.0, 0.0, 0.0, 0.0, 3.0])
        assert twist[5] == pytest.approx(2 / 3 * math.pi * R**3 * C, rel=3e-3)


SPOTS = pytest.mark.parametrize("spots", [0.0, 0.3])
"""Even ground, and a tenth of its area with three tenths of its strength."""


@SPOTS
@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_inclined_loads_of_a_strip_meet_green(ratio, spots):
    footing = made("strip", COHE=C, PDUR=spots)
    V, N, _ = footing.move([2e3, -2e3 * ratio, 0.0])
    x = V / (C * B)
    allowed = (1 + math.pi / 2 + math.acos(min(x, 1.0)) + math.sqrt(max(1 - x * x, 0.0))) * C * B
    assert pytest.approx(allowed, rel=1e-9) == -N


@SPOTS
@pytest.mark.parametrize("part", [0.1, 0.25, 0.5, 0.8])
def test_eccentric_loads_meet_the_effective_width(part, spots):
    """A strip in contact over `part` of its width: N = part N_0, M = N B/2 (1 - N/N_0)."""
    footing, q = made("strip", COHE=C, PDUR=spots), FACTORS["strip"] * C
    theta = 400.0 * q / 8e7
    _, N, M = footing.move([0.0, theta * (0.5 - part) * B, theta])
    found = -N / (q * B)
    assert found == pytest.approx(part, abs=0.02)  # the edge of contact is still elastic
    assert abs(M) == pytest.approx(-N * B / 2 * (1 - found), rel=2e-3)


@together("name", SHAPES)
@together("v, turn", [(-0.01, 4e-3), (-0.01, 0.02), (0.01, 0.03)])
def test_a_first_push_is_the_integral_of_a_fine_bed(name, v, turn):
    """Pressures min(q, -k w) all over the base, by many places."""
    footing, n = made(name, COHE=C), 1200
    found = footing.move(motion_of(footing, v=v, theta=turn))
    N, M = (found[2], -found[4]) if footing.space else (found[1], found[2])
    x = (np.arange(n) + 0.5) / n * 2 - 1
    if "dis" not in name:
        s, widths = x * (L if name == "wide rectangle" else B) / 2, np.full(n, AREAS[name] / n)
    else:
        s, widths = x * R, 2 * R * np.sqrt(1 - x**2) * 2 * R / n
    pressure = np.clip(-8e7 / AREAS[name] * (v + turn * s), 0.0, FACTORS[name] * C)
    close = 2e-3 if name in ("strip", "disc in the plane") else 1.5e-2
    assert pytest.approx(pressure @ widths, rel=close) == -N
    assert pytest.approx(pressure * s @ widths, rel=close) == -M


@together("name", SHAPES)
def test_hard_spots_still_press_where_the_rest_is_unloaded(name):
    """Pressed down until all but the spots yields, and back: two springs side by side."""
    footing, k, q = made(name, COHE=C, PDUR=0.3), 8e7 / AREAS[name], FACTORS[name] * C
    up, yielded = 2 if footing.space else 1, 0.7 / 0.9 * q
    down = 1.5 * q / k
    found = [footing.move(motion_of(footing, v=-x * down))[up] for x in (1.0, 0.8, 0.3, 0.0)]
    rest = np.array([yielded, yielded - 0.2 * k * down, 0.0, 0.0])
    spots = k * down * np.array([1.0, 0.8, 0.3, 0.0])
    expected = -(0.9 * rest + 0.1 * spots) * AREAS[name]
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-3)


PATH = [(1e-3, -4e-3, 1e-3), (-2e-3, -6e-3, 4e-3), (0.0, -3e-3, -5e-3), (1e-3, 5e-3, 1e-3)]


@SPOTS
@pytest.mark.parametrize("name", SHAPES)
def test_ground_of_great_strength_is_the_elastic_macro_element(name, spots):
    strong, elastic = made(name, COHE=1e12, PDUR=spots), made(name)
    for u, v, theta in PATH:
        found = strong.move(motion_of(strong, u, v, theta))
        wanted = elastic.move(motion_of(elastic, u, v, theta))
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-12 * abs(wanted).max())


STEP = st.tuples(st.floats(-0.02, 0.02), st.floats(-0.03, 0.005), st.floats(-0.01, 0.01))
FEET = {name: made(name, COHE=C) for name in SHAPES}
FEET |= {f"hard spots, {name}": made(name, COHE=C, PDUR=0.3) for name in ("strip", "rectangle")}
FINE, FINEST = 60, 1e-5
ASIDE = (1.2345e-6, -3.4567e-6, 2.3456e-7)  # round numbers stand where the ground begins to yield


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(list(FEET)), st.lists(STEP, min_size=2, max_size=4))
@example("strip", [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0001220703125), (0.0, 0.00390625, 0.0)])
def test_paths_lose_energy_and_balance(name, path):
    """Work of fine steps is what is stored and what is lost, which never falls.

    Steps are halved where the force changes by much within them: a foot that stood hardly pressed
    and is lifted far leaves its ground in the first.
    """
    footing = FEET[name]
    footing.state = footing.joints.initial_state()
    now, lost, work, moved = np.zeros(len(footing.names)), 0.0, 0.0, 0.0
    f = np.zeros_like(now)
    for step in path:
        way, at = motion_of(footing, *step) - now, 0.0
        ends = np.linspace(1.0, 0.0, FINE + 1)[:-1].tolist()
        while ends:
            part = ends[-1] - at
            after, (w, t, new) = footing.whole(now + ends[-1] * way)
            before, behind = part * (f @ way), part * (after @ way)
            if abs(behind - before) > 0.1 * abs(behind + before) and part > FINEST:
                ends.append(at + 0.5 * part)
                continue
            stored, gone = interface_energies(footing.joints.points, w, t, new)
            assert gone >= lost - 1e-9 * abs(lost)
            done, at = 0.5 * (before + behind), ends.pop()
            footing.state, lost, f, work, moved = new, gone, after, work + done, moved + abs(done)
        now = now + way
    springs = 0.5 * now @ footing.springs @ now
    assert stored + lost + springs == pytest.approx(work, abs=5e-3 * moved + 1e-9)


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(list(FEET)), STEP, STEP)
def test_the_tangent_of_the_footing_is_the_derivative(name, first, then):
    footing = FEET[name]
    footing.state = footing.joints.initial_state()
    footing.move(motion_of(footing, *first))
    motion, h = motion_of(footing, *np.add(then, ASIDE)), 1e-8
    if footing.space:
        motion = motion + np.array([0.0, 1e-3, 0.0, 5e-4, 0.0, 2e-4])
    K = footing.stiffness(motion)
    scale = np.abs(footing.stiffness(np.zeros(len(motion)))).max() + 8e7
    for i in range(len(motion)):
        ends = [motion + sign * h * np.eye(len(motion))[i] for sign in (1.0, -1.0)]
        slopes = [footing.stiffness(end) for end in ends]
        if np.abs(slopes[0] - slopes[1]).max() > 1e-4 * scale:
            continue  # a place yields, opens or closes between
        up, down = (footing.force(footing.tried(end)[1]) for end in ends)
        np.testing.assert_allclose((up - down) / (2 * h), K[:, i], atol=2e-4 * scale)
    np.testing.assert_allclose(K, K.T, atol=1e-9 * scale)


def test_one_slow_path_balances_work_with_what_is_stored_and_lost():
    footing = made("strip", COHE=C)
    t = np.linspace(0.0, 1.0, 1501)
    path = np.stack([2e-3 * np.sin(9 * t), -0.012 * np.sin(3 * t), 8e-3 * np.sin(12 * t)], axis=1)
    work, before, f0 = 0.0, path[0], np.zeros(3)
    for motion in path:
        f1, (w, tr, new) = footing.whole(motion)
        work += 0.5 * (f0 + f1) @ (motion - before)
        footing.state, f0, before = new, f1, motion
    stored, lost = interface_energies(footing.joints.points, w, tr, new)
    springs = 0.5 * 4e7 * path[-1][0] ** 2
    assert lost > 0.2 * work
    assert stored + lost + springs == pytest.approx(work, rel=2e-3)


@together("name", SHAPES)
def test_the_memory_of_the_ground_stands_in_its_variables(name):
    footing = made(name, COHE=C)
    for step in [(2e-2, -0.2, 0.04), (0.0, -0.19, -0.02)]:
        _, (w, t, new) = footing.whole(motion_of(footing, *step))
        footing.state = new
    field = state_field(footing.joints, new, w, t)
    again = state_from_field(footing.joints, field)
    kept = [0, 1, 2]  # settlement and slips
    np.testing.assert_array_equal(again[:, kept], new[:, kept])
    (block,) = field.blocks
    assert 0.0 < block.components["PART"][0, 0] < 1.0
    assert block.components["TASS"][0, 0] == pytest.approx(
        footing.joints.beds[0].areas @ -new[1:, 0] / AREAS[name], rel=1e-12
    )
    assert block.components["EPER"][0, 0] == pytest.approx(
        interface_energies(footing.joints.points, w, t, new)[1]
    )


def test_what_the_ground_does_not_know_is_refused():
    with pytest.raises(MaterialError, match="QN"):
        made("disc", COHE=C, QN=1e8)
    with pytest.raises(MaterialError, match="KS1 and KS2"):
        made("disc", COHE=C, KS2=1e7)
    with pytest.raises(MaterialError, match="COHE"):
        made("strip", QULT=1e5)
    with pytest.raises(MaterialError, match="COHE"):
        made("strip", FROT=0.5)
    with pytest.raises(MaterialError, match="PDUR"):
        made("strip", COHE=C, PDUR=0.1)


def rocking_by_springs(mass, inertia, turning, times):
    """Rotation and lift in time of a strip thrown over, on many springs that press and yield.

    Central differences on each degree of freedom, a spring at a time: no code of the package.
    """
    n, weight, dt = 600, 0.3 * FACTORS["strip"] * C * B, 1e-4
    s, area = ((np.arange(n) + 0.5) / n - 0.5) * B, B / n
    k, q = 8e7 / B, FACTORS["strip"] * C
    settled = np.zeros(n)
    x, speed = np.array([-weight / 8e7, 0.0]), np.array([0.0, turning])
    lasting, found = round(times[-1] / dt), []
    every = round((times[1] - times[0]) / dt)
    for step in range(lasting + 1):
        press = np.maximum(k * (settled - x[0] - s * x[1]), 0.0)
        settled = settled - np.maximum(press - q, 0.0) / k
        press = np.minimum(press, q)
        force = np.array([press.sum() * area - weight, (press * s).sum() * area])
        if step % every == 0:
            found.append([x[1], x[0], settled @ np.full(n, -area) / B])
        speed = speed + (0.5 if step == 0 else 1.0) * dt * force / np.array([mass, inertia])
        x = x + dt * speed
    return np.array(found)


def thrown(bench, base, times, weight, **velocity):
    """Motion from rest on the ground: by the unknowns with a velocity and the vertical one,
    settlement in the mean at its end, imbalance and largest sum of energies.
    """
    lift = "UZ" if "RX" in velocity else "UY"
    problem = bench.problem(
        times,
        bench.load(bench.field((base, lift.replace("U", "F"), -weight))),
        displacement=bench.field((base, lift, -weight / 8e7)),
        velocity=bench.field(*((base, name, v) for name, v in velocity.items())),
    )
    recorder, history = recorded(problem)
    places = [problem.numbering.index_of(base, name) for name in (*velocity, lift)]
    bed = problem.interface.beds[0]
    settled = -recorder.of("state")[-1, bed.points, 0] @ bed.areas / bed.areas.sum()
    balance = history.energies[:, :5].sum(axis=1) - history.energies[:, 5]
    swing = np.abs(balance - balance[0]).max()
    return recorder.of("u")[:, places], settled, swing, history.energies[:, 3].max()


def test_a_strip_thrown_over_rocks_and_settles_as_on_many_springs():
    weight, inertia, turning = 0.3 * FACTORS["strip"] * C * B, 5e5, 0.25
    bench = Bench(PLANE)
    soil, base = bench.node(0.0, -1.0), bench.node(0.0, 0.0)
    bench.fix(soil, "UX", "UY", "RZ")
    bench.fix(base, "UX")
    bench.joint("SEG2", [[soil, base]], "JOI1", "MACRO_SEMELLE", **STRIP, COHE=C)
    bench.mass(weight / 9.81, base, ("UY",))
    bench.mass(inertia, base, ("RZ",))
    times = np.linspace(0.0, 1.2, 2401)
    found, settled, swing, energy = thrown(bench, base, times, weight, RZ=turning)
    exact = rocking_by_springs(weight / 9.81, inertia, turning, times)
    largest = np.abs(exact).max(axis=0)
    assert largest[0] > 0.02
    assert (np.abs(found - exact[:, :2]) <= 0.01 * largest[:2]).all()
    assert settled == pytest.approx(exact[-1, 2], rel=0.02)
    assert settled > 1e-3
    assert swing < 1e-3 * energy + 5.0


def rocking_in_space(mass, inertia, turning, lasting, dt):
    """Rotations about both axes and lift of a rectangle thrown over, and its settlement.

    Many springs, central differences: no code of the package. The opening is v + a s2 - b s1.
    """
    n, weight = 40, 0.3 * FACTORS["rectangle"] * C * B * L
    s1, s2 = (
        x.ravel() for x in np.meshgrid(*(((np.arange(n) + 0.5) / n - 0.5) * x for x in (B, L)))
    )
    area, k, q = B * L / n**2, 8e7 / (B * L), FACTORS["rectangle"] * C
    levers = np.stack([s2, -s1, np.ones(n * n)])
    settled, found = np.zeros(n * n), []
    x, speed = np.array([0.0, 0.0, -weight / 8e7]), np.array([*turning, 0.0])
    for step in range(round(lasting / dt) + 1):
        press = np.maximum(k * (settled - x @ levers), 0.0)
        settled = settled - np.maximum(press - q, 0.0) / k
        force = levers @ np.minimum(press, q) * area - np.array([0.0, 0.0, weight])
        found.append([*x, -settled.mean()])
        speed = speed + (0.5 if step == 0 else 1.0) * dt * force / np.array(
            [inertia, inertia, mass]
        )
        x = x + dt * speed
    return np.array(found)


def test_a_rectangle_thrown_over_both_its_edges_rocks_as_on_many_springs():
    weight, inertia, turning, dt = 0.3 * FACTORS["rectangle"] * C * B * L, 4e6, (0.25, 0.3), 1e-3
    bench = Bench(SPACE)
    soil, base = bench.node(0.0, 0.0, -1.0), bench.node(0.0, 0.0, 0.0)
    bench.fix(soil, "UX", "UY", "UZ", "RX", "RY", "RZ")
    bench.fix(base, "UX", "UY", "RZ")
    bench.joint("SEG2", [[soil, base]], "JOI1", "MACRO_SEMELLE", **RECTANGLE, COHE=C)
    bench.mass(weight / 9.81, base, ("UZ",))
    bench.mass(inertia, base, ("RX", "RY"))
    times = np.arange(601) * dt
    found, settled, swing, energy = thrown(bench, base, times, weight, RX=turning[0], RY=turning[1])
    exact = rocking_in_space(weight / 9.81, inertia, turning, times[-1], dt / 4)[::4]
    largest = np.abs(exact).max(axis=0)
    assert (largest[:2] > 0.01).all()
    # 16 by 16 places against 40 by 40
    assert (np.abs(found - exact[:, :3]) < 0.02 * largest[:3]).all()
    assert settled == pytest.approx(exact[-1, 3], rel=0.02)
    assert swing < 2e-3 * energy + 5.0


def three_rows(x, w, t, state):
    """A history of three alike instants, as observers get it."""
    return SimpleNamespace(w=np.stack([w] * 3), t=np.stack([t] * 3), state=np.stack([state] * 3))


@together("name", SHAPES)
def test_fields_histories_and_footings_tell_what_the_whole_carries(name):
    footing = made(name, COHE=C)
    footing.move(motion_of(footing, 1e-2, -0.02, 4e-3))
    motion = motion_of(footing, 0.0, -0.01, -8e-3)
    _, (w, t, new) = footing.whole(motion)
    of_all = footing.force(t)
    vertical, turning = (2, 4) if footing.space else (1, 2)
    moment = "MOMZ"  # about t2, Y in space
    x = footing.joints
    (block,) = interface_field(x, t, "traction").blocks
    assert block.components["EFFX"][0, 0] == pytest.approx(of_all[vertical], rel=1e-12)
    assert block.components[moment][0, 0] == pytest.approx(of_all[turning], rel=1e-12)
    rows = three_rows(x, w, t, new)
    for kind, component in (("traction", "EFFX"), ("variables", "PART"), ("variables", "TASS"),
                            ("variables", "EPER"), ("variables", "ETAT")):  # fmt: skip
        history = point_history(x, rows, kind, component, (0, 0, 0))
        made_by = (
            interface_field(x, t, "traction") if kind == "traction" else state_field(x, new, w, t)
        )
        assert history == pytest.approx([made_by.blocks[0].components[component][0, 0]] * 3)
    (whole,) = footings_of(x, footing.problem.numbering)
    loads = whole.loads(w[None], t[None], np.zeros((1, 0)))
    assert loads.force[0] == pytest.approx(-of_all[vertical], rel=1e-12)
    assert loads.share[0] == block_of(x, new, w, t).components["PART"][0, 0]
    assert 0.0 < loads.pressure[0] <= FACTORS[name] * C * (1 + 1e-12)


def block_of(x, state, w, t):
    (block,) = state_field(x, state, w, t).blocks
    return block


@together("beside", ["face", "two springs"])
def test_a_joint_beside_a_yielding_footing_keeps_its_own_answer(beside):
    """Surface joints and a macro-element in one interface: each as if it stood alone."""
    bench = Bench(PLANE)
    soil, base = bench.node(0.0, -1.0), bench.node(0.0, 0.0)
    below = 5.0 if beside == "face" else 4.0
    upper, lower = ([bench.node(x, y) for x in (6.0, 8.0)] for y in (5.0, below))
    bench.joint("SEG2", [[soil, base]], "JOI1", "MACRO_SEMELLE", **STRIP, COHE=C)
    if beside == "face":
        bench.joint("RAC2", [[*upper, *lower]], "JOI2", KN=2e7, KS=1e7)
    else:
        bench.joint("SEG2", [*zip(lower, upper, strict=True)], "JOI1", KN=2e7, KS=1e7)
    for node in (soil, base, *upper, *lower):
        for unknown in ("UX", "UY", "RZ"):
            bench.spring(1.0, node, unknown=unknown)
    x = interface_of(
        joint_zones(bench.model), bench.characteristics,
        bench.problem(np.array([0.0, 1.0])).numbering,
    )  # fmt: skip
    rng = np.random.default_rng(3)
    alone = made("strip", COHE=C)
    motion = np.array([0.01, -0.02, 6e-3])
    n = x.J.shape[1]
    u = rng.normal(size=n) * 1e-3
    numbering = bench.problem(np.array([0.0, 1.0])).numbering
    places = [numbering.index_of(base, name) for name in ("UX", "UY", "RZ")]
    u[places] = motion
    u[[numbering.index_of(soil, name) for name in ("UX", "UY", "RZ")]] = 0.0
    w, t = np.zeros((x.n_points, 2)), np.zeros((x.n_points, 2))
    new, D = np.zeros((x.n_points, N_STATE)), np.zeros((x.n_points, 2, 2))
    local_jumps(x.points, x.J @ u, w)
    respond(x.codes, w, x.initial_state(), x.points.p, t, new, D)
    f = np.zeros(x.size)
    interface_forces(x.points, t, f)
    forces = x.J.T @ f
    _, t_alone, _, _ = alone.tried(motion)
    np.testing.assert_allclose(forces[places], alone.force(t_alone), rtol=1e-12)
    opened = [u[numbering.index_of(one, "UY")] - u[numbering.index_of(other, "UY")]
              for one, other in zip(upper, lower, strict=True)]  # fmt: skip
    assert abs(w[:2, 1].sum()) == pytest.approx(abs(sum(opened)), rel=1e-9)
    plain = np.minimum(w[:2, 1], 0.0) * 2e7
    np.testing.assert_allclose(t[:2, 1], plain, rtol=1e-12, atol=1e-9)
    again = state_from_field(x, state_field(x, new, w, t))
    np.testing.assert_array_equal(again[3:, :3], new[3:, :3])


@pytest.mark.parametrize(("axis", "arm"), [(3, L), (4, B)])
def test_a_rectangle_turned_under_its_weight_about_either_axis_meets_its_effective_area(axis, arm):
    """M = N a/2 (1 - N/N0) with a the side that turns, whatever the path that led there."""
    footing = made("rectangle", COHE=C)
    capacity = FACTORS["rectangle"] * C * AREAS["rectangle"]
    weight = 0.3 * capacity
    for turn in np.linspace(0.0, 0.4, 41):
        motion = np.zeros(6)
        motion[axis] = turn

        def carried_at(v, motion=motion):
            return footing.whole(motion + v * np.eye(6)[2])[0][2] + weight

        v = brentq(carried_at, -1.0, 1.0, xtol=1e-13)
        found = footing.move(motion + v * np.eye(6)[2])
    assert -found[2] == pytest.approx(weight, rel=1e-6)
    assert abs(found[axis]) == pytest.approx(weight * arm / 2 * 0.7, rel=1e-2)
    assert abs(found[7 - axis]) < 1e-6 * abs(found[axis])  # nothing about the other axis


@together("held, tied, told", [(False, False, 2), (True, False, 1), (False, True, 0)])
def test_bodies_on_one_footing_that_nothing_else_holds_are_looked_at(held, tied, told):
    """Two footings under two bodies; where a spring or both hold one, who bears is not known."""
    bench = Bench()
    soils, tops = ([bench.node(x, y) for x in (0.0, 9.0)] for y in (-1.0, 0.0))
    bench.joint("SEG2", [*zip(soils, tops, strict=True)], "JOI1", "MACRO_SEMELLE", **STRIP, COHE=C)
    for soil in soils:
        bench.fix(soil, "UX", "UY", "RZ")
    if held:
        bench.spring(1e3, tops[0])
    if tied:
        bench.relate([(1.0, "UY", tops[0]), (-1.0, "UY", tops[1])])
    capacity = FACTORS["strip"] * C * B
    pressing = [1.3 * capacity, 1.7 * capacity]
    weight = bench.field(*((n, "FY", -p) for n, p in zip(tops, pressing, strict=True)))
    found = overloads(bench.problem(np.array([0.0, 1.0]), bench.load(weight)), np.array([1.0]))
    assert [f.node for f in found] == tops[2 - told :]
    assert [f.pressing for f in found] == pytest.approx(pressing[2 - told :])
    assert [f.capacity for f in found] == pytest.approx([capacity] * told)


@together("vertical, arm", [(1.3, 0.0), (0.6, 0.3 * B)])
def test_load_steps_beyond_what_the_ground_bears_are_refused(vertical, arm):
    """By their weight, or by where it stands; a body beside it is pressed harder and held."""
    bench, times = Bench(), np.array([0.0, 0.5, 1.5, 2.0])
    soil, base, top, apart = (bench.node(0.0, y) for y in (-1.0, 0.0, 1.0, 9.0))
    bench.joint("SEG2", [[soil, base]], "JOI1", "MACRO_SEMELLE", **STRIP, COHE=C)
    bench.fix(soil, "UX", "UY", "RZ")
    for name in ("UX", "UY"):
        bench.spring(1e9, top, base, name)
        bench.spring(1e9, apart, unknown=name)
    bench.spring(1.0, base, unknown="RZ")
    capacity = FACTORS["strip"] * C * B
    weight = bench.field((top, "FY", -vertical * capacity), (apart, "FY", -9.0 * capacity))
    turn = bench.field((base, "MZ", vertical * capacity * arm))
    loads = (bench.load(weight, [0.0, 1.0, 2.0], [0.0, 1.0, 1.0]),
             bench.load(turn, [0.0, 1.0, 2.0], [0.0, 0.0, 1.0]))  # fmt: skip
    problem = bench.problem(times, Load(tuple(p for x in loads for p in x.parts)))
    with pytest.raises(ConvergenceError) as told:
        step_statics(problem)
    data = told.value.data
    assert data["node"] == bench.table.told(base)
    if arm:
        assert (told.value.code, data["step"]) == ("kernel.statics.footing-gives-way", 3)
        assert data["used"] == pytest.approx(60.0, rel=1e-6)
        assert 0.0 < data["share"] < 100.0
    else:
        assert (told.value.code, data["step"]) == ("kernel.statics.footing-overloaded", 2)
        assert data["pressing"] == pytest.approx(vertical * capacity, rel=1e-9)
        assert data["capacity"] == pytest.approx(capacity, rel=1e-9)
