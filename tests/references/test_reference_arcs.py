"""The event-driven solver: first roots, energy, independence of any bracket, solve_ivp."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from .arcs import Arc, Forcing
from .contact import System, UnilateralSpring, solve
from .oscillators import ClubB, ClubC
from .rocking import FlexibleTower, TwoSpringBlock

BLOCK = TwoSpringBlock(mass=1e5, inertia=4e5, height=4.0, half_width=1.5, k=5e7)
KICK = np.array([0.05, 0.7])


def pushed_block():
    """The block at rest, pushed half a second by 0.4 g, then free: it bounces on both sides."""
    return solve(BLOCK.system((0.0, 4.0), (0.5, 0.0)), BLOCK.rest, np.zeros(2), 4.0)


def kicked_block():
    return solve(BLOCK.system(), BLOCK.rest, KICK, 6.0)


def test_first_root_is_found_even_when_it_barely_crosses():
    # u = cos t + 0.999 999 has a double-root-like dip of depth 0 at t = pi: it must not be
    # stepped over, and 1.000 001 must not be reported
    one = np.ones((1, 1))
    arc = Arc(one, one, Forcing(0.0, np.zeros(1)), 0.0, np.ones(1), np.zeros(1))
    expected = np.arccos(-0.999999)
    found = arc.first_root(np.ones(1), 0.999999, 1.0, 10.0)
    assert found == pytest.approx(expected, abs=1e-12)
    assert arc.first_root(np.ones(1), 1.000001, 1.0, 10.0) == np.inf


def test_forced_arc_satisfies_its_equation():
    rng = np.random.default_rng(1)
    a = rng.normal(size=(3, 3))
    mass, stiffness = a @ a.T + np.eye(3), np.diag([3.0, 0.0, 7.0])
    load = Forcing(0.0, rng.normal(size=3), rng.normal(size=3), 2.3, 0.4)
    arc = Arc(mass, stiffness, load, 0.7, rng.normal(size=3), rng.normal(size=3))
    h, t = 1e-3, np.array([0.7, 1.1, 5.0])
    acceleration = (arc.state(t + h)[1] - arc.state(t - h)[1]) / (2 * h)
    force = load.constant + np.outer(np.sin(2.3 * t + 0.4), load.amplitude)
    residual = acceleration @ mass + arc.state(t)[0] @ stiffness - force
    # centred difference: h^2/6 times the third derivative of the velocity
    assert np.max(np.abs(residual)) < 1e-4


def test_curvature_bound_holds_along_the_arc():
    motion = kicked_block()
    c, h = np.array([1.0, 1.5]), 1e-5
    for arc in motion.arcs:
        t = np.linspace(arc.start, arc.start + 1.0, 500)
        curvature = (arc.state(t + h)[1] - arc.state(t - h)[1]) @ c / (2 * h)
        assert np.max(np.abs(curvature)) <= arc.curvature_bound(c) * (1 + 1e-6)


@pytest.mark.parametrize("case", [ClubB(), ClubC()])
def test_event_driven_motion_equals_the_closed_form(case):
    end, t = 1.0, np.linspace(0.0, 1.0, 4001)
    u, v = case.motion(t)
    motion = solve(case.system, u[:1], v[:1], end)
    assert motion.times(0, True) == pytest.approx(case.closings(end), abs=1e-12)
    assert motion.times(0, False) == pytest.approx(case.openings(end), abs=1e-12)
    found = motion(t)
    assert np.max(np.abs(found[0][:, 0] - u)) < 1e-11 * np.max(np.abs(u))
    assert np.max(np.abs(found[1][:, 0] - v)) < 1e-11 * np.max(np.abs(v))


def test_energy_of_the_kicked_block_is_constant():
    motion = kicked_block()
    assert len(motion.events) > 10
    energy = motion.energy(np.linspace(0.0, 6.0, 3001))
    kinetic = 0.5 * KICK @ BLOCK.system().mass @ KICK
    assert np.ptp(energy) < 1e-12 * kinetic


def test_gap_is_zero_at_every_event_and_has_the_announced_sign_between():
    motion = pushed_block()
    springs = motion.system.springs
    for e in motion.events:
        assert abs(springs[e.spring].gap(e.u)) < 1e-13
        assert (e.gap_velocity < 0.0) == e.closes
    t = np.linspace(0.0, 4.0, 20001)
    u, _ = motion(t)
    for i, spring in enumerate(springs):
        flips = np.sum([e.time < t for e in motion.events if e.spring == i], axis=0)
        # each starts closed: after an odd number of events it is open
        inside = np.abs(spring.gap(u)) > 1e-12
        assert np.all((spring.gap(u) > 0.0)[inside] == (flips % 2 == 1)[inside])


@pytest.mark.parametrize("width", [1e-3, 2.7e-3, 7e-3])
def test_contact_times_do_not_depend_on_a_bracket(width):
    motion = pushed_block()
    t = np.arange(0.0, 4.0, width)
    for i, spring in enumerate(motion.system.springs):
        gap = spring.gap(motion(t)[0])
        cells = np.nonzero(gap[:-1] * gap[1:] < 0.0)[0]
        found = np.array(
            [
                brentq(lambda x, s=spring: float(s.gap(motion(x)[0])), t[j], t[j + 1], xtol=1e-14)
                for j in cells
            ]
        )
        times = np.array([e.time for e in motion.events if e.spring == i])
        # a scan may miss two events in one cell, never find another one
        distance = np.min(np.abs(found[:, None] - times[None, :]), axis=1)
        assert np.max(distance) < 1e-12
        if width == 1e-3:
            assert len(found) == len(times)


def test_restart_from_the_middle_gives_the_same_motion():
    motion = kicked_block()
    u, v = motion(2.345)
    again = solve(BLOCK.system(), u, v, 3.0)
    late = np.array([e.time for e in motion.events if 2.345 < e.time < 5.3])
    times = np.array([e.time for e in again.events])[: len(late)]
    assert times + 2.345 == pytest.approx(late, abs=1e-11)


def right_side(system):
    inverse = np.linalg.inv(system.mass)
    n = len(system.mass)

    def f(t, y):
        u, v = y[:n], y[n:]
        load = [x for x in system.forcings if x.start <= t][-1]
        force = load.constant + load.amplitude * np.sin(load.pulsation * t + load.phase)
        force = force - system.stiffness @ u
        for s in system.springs:
            force = force - s.c * s.k * min(float(s.gap(u)), 0.0)
        return np.concatenate([v, inverse @ force])

    return f


def integrate(system, u, v, breaks, t):
    y, values = np.concatenate([u, v]), []
    for a, b in pairwise(breaks):
        inside = t[(t >= a) & (t < b)]
        run = solve_ivp(
            right_side(system), (a, b - 1e-15), y, "DOP853", inside, rtol=1e-12, atol=1e-13
        )
        values.append(run.y.T)
        last = solve_ivp(right_side(system), (a, b - 1e-15), y, "DOP853", rtol=1e-12, atol=1e-13)
        y = last.y[:, -1]
    return np.concatenate(values)


def test_pushed_block_agrees_with_solve_ivp():
    motion, t = pushed_block(), np.linspace(0.0, 1.99, 200)
    values = integrate(motion.system, BLOCK.rest, np.zeros(2), [0.0, 0.5, 2.0], t)
    u, _ = motion(t)
    assert len([e for e in motion.events if e.time < 2.0]) >= 4
    assert np.max(np.abs(values[:, :2] - u)) < 1e-8 * np.max(np.abs(u))


def test_flexible_tower_agrees_with_solve_ivp():
    tower = FlexibleTower(1e5, 2e4, 2e4, 10.0, 2.0, 4e6, 6e7)
    system = tower.system(3.0, 6.0)
    motion = solve(system, tower.rest, np.zeros(3), 3.0)
    assert motion.times(0, False).size + motion.times(1, False).size >= 2
    t = np.linspace(0.0, 1.5, 150)
    values = integrate(system, tower.rest, np.zeros(3), [0.0, np.pi / 6.0, 1.6], t)
    u, _ = motion(t)
    assert np.max(np.abs(values[:, :3] - u)) < 1e-8 * np.max(np.abs(u))


def test_system_without_contact_conserves_momentum_in_flight():
    # a body thrown up: parabola, no event before it lands
    spring = UnilateralSpring(np.ones(1), 100.0)
    weight = Forcing(0.0, np.array([-2.0 * 9.81]))
    system = System(2.0 * np.ones((1, 1)), np.zeros((1, 1)), (spring,), (weight,))
    motion = solve(system, np.array([1.0]), np.array([3.0]), 2.0)
    landing = (3.0 + np.sqrt(9.0 + 2.0 * 9.81)) / 9.81
    assert motion.events[0].time == pytest.approx(landing, abs=1e-13)
    assert motion.events[0].v[0] == pytest.approx(3.0 - 9.81 * landing, abs=1e-12)
