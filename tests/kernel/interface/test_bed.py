"""Macro-elements whose ground yields: capacities of the whole footing, its tangent, its energy."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from references.assembled import Bench

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.interface import (
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
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem

B, L, R, C = 4.0, 6.0, 2.0, 5e4
STRIP = {"KN": 8e7, "KS": 4e7, "LARG": B}
RECTANGLE = STRIP | {"LONG": L}
DISC = {"KN": 8e7, "KS": 4e7, "RAYO": R}
PLANE, SPACE = Mode.PLANE_STRAIN, Mode.THREE_DIMENSIONAL
SHAPES = {
    "strip": (PLANE, "MACRO_SEMELLE", STRIP),
    "disc in the plane": (PLANE, "MACRO_DISQUE", DISC),
    "rectangle": (SPACE, "MACRO_SEMELLE", RECTANGLE),
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
        self.problem = make_problem(
            Inputs(bench.stiffness, np.array([0.0, 1.0]), model=bench.model,
                   characteristics=bench.characteristics)
        )  # fmt: skip
        self.joints = self.problem.interface
        self.state = self.joints.initial_state()

    def places(self):
        n = self.problem.numbering
        return np.array([n.index_of(self.base, name) for name in self.names])

    def tried(self, motion):
        """Tractions, states and tangents at motions of the base, in the order of its names."""
        x = self.joints
        u = np.zeros(self.problem.numbering.size)
        u[self.places()] = motion
        w, t = np.zeros((x.n_points, x.dimension)), np.zeros((x.n_points, x.dimension))
        new, D = np.zeros((x.n_points, N_STATE)), np.zeros((x.n_points, x.dimension, x.dimension))
        local_jumps(x.points, x.J @ u, w)
        respond(x.codes, w, self.state, x.points.p, t, new, D)
        return w, t, new, D

    def force(self, t):
        """Forces of the interface on the base, in the order of its names."""
        f = np.zeros(self.joints.size)
        interface_forces(self.joints.points, t, f)
        return (self.joints.J.T @ f)[self.places()]

    def whole(self, motion):
        """Forces with those of the linear springs that stand beside the interface."""
        w, t, new, _ = self.tried(motion)
        K = self.problem.K.toarray() - np.eye(self.problem.numbering.size)
        at = self.places()
        return self.force(t) + K[np.ix_(at, at)] @ motion, (w, t, new)

    def move(self, motion):
        found, (_, _, self.state) = self.whole(np.asarray(motion, float))
        return found

    def stiffness(self, motion):
        _, _, _, D = self.tried(motion)
        K = np.zeros((self.joints.size, self.joints.size))
        interface_stiffness(self.joints.points, D, K)
        at = self.places()
        return (self.joints.J.T @ K @ self.joints.J)[np.ix_(at, at)]


def made(name, **given):
    mode, law, sizes = SHAPES[name]
    return Footing(mode, law, **(sizes | given))


def motion_of(footing, u=0.0, v=0.0, theta=0.0):
    """Along X, up, and a turn that lifts the side of positive X."""
    return np.array([u, 0.0, v, 0.0, -theta, 0.0] if footing.space else [u, v, theta])


AREAS = {"strip": B, "disc in the plane": math.pi * R**2, "rectangle": B * L,
         "disc": math.pi * R**2}  # fmt: skip
FACTORS = {"strip": 2 + math.pi, "disc in the plane": 6.05, "disc": 6.05,
           "rectangle": (2 + math.pi) * (1 + 0.2 * B / L)}  # fmt: skip


@pytest.mark.parametrize("name", SHAPES)
def test_pressed_down_it_bears_its_capacity(name):
    footing = made(name, COHE=C)
    up = 2 if footing.space else 1
    capacity = FACTORS[name] * C * AREAS[name]
    assert footing.move(motion_of(footing, v=-2.0))[up] == pytest.approx(-capacity, rel=1e-12)
    half = made(name, COHE=C, QULT=1e5)
    assert half.move(motion_of(half, v=-2.0))[up] == pytest.approx(-1e5 * AREAS[name], rel=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_dragged_along_it_holds_by_the_cohesion_and_twisted_by_its_lever(name):
    footing = made(name, COHE=C)
    dragged = footing.move(motion_of(footing, u=3.0))[0]
    assert dragged == pytest.approx(C * AREAS[name], rel=1e-9)
    if name == "disc":  # 2/3 pi r^3 c, by rings
        twist = made(name, COHE=C).move([0.0, 0.0, 0.0, 0.0, 0.0, 3.0])
        assert twist[5] == pytest.approx(2 / 3 * math.pi * R**3 * C, rel=3e-3)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 3.0])
def test_inclined_loads_of_a_strip_meet_green(ratio):
    footing = made("strip", COHE=C)
    V, N, _ = footing.move([2.0, -2.0 * ratio, 0.0])
    x = V / (C * B)
    allowed = (1 + math.pi / 2 + math.acos(min(x, 1.0)) + math.sqrt(max(1 - x * x, 0.0))) * C * B
    assert pytest.approx(allowed, rel=1e-9) == -N


@pytest.mark.parametrize("part", [0.1, 0.25, 0.5, 0.8])
def test_eccentric_loads_meet_the_effective_width(part):
    """A strip in contact over `part` of its width: N = part N_0, M = N B/2 (1 - N/N_0)."""
    footing, q = made("strip", COHE=C), FACTORS["strip"] * C
    theta = 400.0 * q / 8e7
    _, N, M = footing.move([0.0, theta * (0.5 - part) * B, theta])
    found = -N / (q * B)
    assert found == pytest.approx(part, abs=0.02)  # the edge of contact is still elastic
    assert abs(M) == pytest.approx(-N * B / 2 * (1 - found), rel=2e-3)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize(("v", "turn"), [(-0.01, 4e-3), (-0.01, 0.02), (0.01, 0.03)])
def test_a_first_push_is_the_integral_of_a_fine_bed(name, v, turn):
    """Pressures min(q, -k w) all over the base, by many places."""
    footing, n = made(name, COHE=C), 1200
    found = footing.move(motion_of(footing, v=v, theta=turn))
    N, M = (found[2], -found[4]) if footing.space else (found[1], found[2])
    x = (np.arange(n) + 0.5) / n * 2 - 1
    if name in ("strip", "rectangle"):
        s, widths = x * B / 2, np.full(n, AREAS[name] / n)
    else:
        s, widths = x * R, 2 * R * np.sqrt(1 - x**2) * 2 * R / n
    pressure = np.clip(-8e7 / AREAS[name] * (v + turn * s), 0.0, FACTORS[name] * C)
    close = 2e-3 if name in ("strip", "disc in the plane") else 1.5e-2
    assert pytest.approx(pressure @ widths, rel=close) == -N
    assert pytest.approx(pressure * s @ widths, rel=close) == -M


PATH = [(1e-3, -4e-3, 1e-3), (-2e-3, -6e-3, 4e-3), (0.0, -3e-3, -5e-3), (1e-3, 5e-3, 1e-3)]


@pytest.mark.parametrize("name", SHAPES)
def test_ground_of_great_strength_is_the_elastic_macro_element(name):
    strong, elastic = made(name, COHE=1e12), made(name)
    for u, v, theta in PATH:
        found = strong.move(motion_of(strong, u, v, theta))
        wanted = elastic.move(motion_of(elastic, u, v, theta))
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-12 * abs(wanted).max())


STEP = st.tuples(st.floats(-0.02, 0.02), st.floats(-0.03, 0.005), st.floats(-0.01, 0.01))
FEET = {name: made(name, COHE=C) for name in SHAPES}


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(list(SHAPES)), st.lists(STEP, min_size=2, max_size=5))
def test_paths_lose_energy_and_balance(name, path):
    """Work of fine steps is what is stored and what is lost."""
    footing = FEET[name]
    footing.state = footing.joints.initial_state()
    lost = 0.0
    for step in path:
        goal = motion_of(footing, *step)
        _, (w, t, new) = footing.whole(goal)
        _, gone = interface_energies(footing.joints.points, w, t, new)
        assert gone >= lost - 1e-9 * abs(lost)
        footing.state, lost = new, gone


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(list(SHAPES)), STEP, STEP)
def test_the_tangent_of_the_footing_is_the_derivative(name, first, then):
    footing = FEET[name]
    footing.state = footing.joints.initial_state()
    footing.move(motion_of(footing, *first))
    motion, h = motion_of(footing, *then), 1e-8
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


@pytest.mark.parametrize("name", SHAPES)
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
