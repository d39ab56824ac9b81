"""Strip, disc, two springs, macro-element against brute-force integration of a no-tension bed."""

import numpy as np
import pytest
from scipy.optimize import brentq

from .footing import (
    Disc,
    Rectangle,
    Strip,
    TwoSprings,
    macro_element,
    onset_acceleration,
    onset_ramp_time,
    onset_step_acceleration,
)

STRIP = Strip(width=4.0, length=1.0, k0=2e7, normal=6e5)
DISC = Disc(radius=2.0, k0=2e7, normal=6e5)
RATIOS = [0.5, 1.0, 1.5, 2.0, 5.0, 10.0, 100.0]


def resultants(x, area, k0, v, theta):
    pressure = k0 * np.maximum(-(v + theta * x), 0.0)
    return np.sum(pressure * area), -np.sum(pressure * area * x)


def brute_force(x, area, k0, normal, theta):
    """Moment at constant normal force, the lift found by bisection."""
    extent = abs(theta) * np.max(np.abs(x)) + 10.0 * normal / (k0 * np.sum(area))
    v = brentq(lambda z: resultants(x, area, k0, z, theta)[0] - normal, -extent, extent, xtol=1e-16)
    return resultants(x, area, k0, v, theta)[1], v


@pytest.mark.parametrize("ratio", RATIOS)
def test_strip_against_many_springs(ratio):
    theta = ratio * STRIP.uplift_rotation
    n = 40000
    x = STRIP.width * ((np.arange(n) + 0.5) / n - 0.5)
    moment, v = brute_force(x, np.full(n, STRIP.width / n), STRIP.k0, STRIP.normal, theta)
    assert STRIP.moment(theta) == pytest.approx(moment, rel=2e-7)
    assert STRIP.lift(theta) == pytest.approx(v, rel=1e-6)


@pytest.mark.parametrize("ratio", RATIOS)
def test_disc_against_many_springs(ratio):
    theta = ratio * DISC.uplift_rotation
    n, r = 40000, DISC.radius
    a = np.pi * (np.arange(n) + 0.5) / n  # x = -r cos a: the chords' ends are resolved
    x, area = -r * np.cos(a), 2.0 * (r * np.sin(a)) ** 2 * np.pi / n
    moment, _ = brute_force(x, area, DISC.k0, DISC.normal, theta)
    assert DISC.moment(theta) == pytest.approx(moment, rel=2e-7)


@pytest.mark.parametrize("case", [STRIP, DISC])
def test_moment_and_slope_are_continuous_at_onset(case):
    theta = case.uplift_rotation
    assert case.moment(theta) == pytest.approx(case.normal * case.kern, rel=1e-13)
    above, below = case.moment(theta * (1 + 1e-6)), case.moment(theta * (1 - 1e-6))
    assert (above - below) / (2e-6 * theta) == pytest.approx(case.stiffness, rel=1e-3)


def test_moments_tend_to_overturning():
    assert STRIP.moment(1e8 * STRIP.uplift_rotation) == pytest.approx(STRIP.limit_moment, rel=1e-4)
    gaps = [1 - DISC.moment(r * DISC.uplift_rotation) / DISC.limit_moment for r in (1e4, 1e6)]
    # the segment in contact has the area ~ height^(3/2): its height falls as theta^(-2/5)
    assert gaps[1] / gaps[0] == pytest.approx(100.0**-0.4, rel=0.02)


def test_kerns():
    assert STRIP.kern == pytest.approx(STRIP.width / 6)
    assert DISC.kern == pytest.approx(DISC.radius / 4)
    two = TwoSprings(2.0, 1e7, 6e5)
    assert two.moment(two.uplift_rotation) == pytest.approx(two.normal * two.half_width)
    assert two.moment(9 * two.uplift_rotation) == pytest.approx(two.normal * two.half_width)


def test_strip_tangent_and_energy_are_derivative_and_integral_of_the_moment():
    for ratio in (0.3, 1.7, 8.0):
        theta, h = ratio * STRIP.uplift_rotation, 1e-5 * STRIP.uplift_rotation
        slope = (STRIP.moment(theta + h) - STRIP.moment(theta - h)) / (2 * h)
        assert STRIP.tangent(theta) == pytest.approx(slope, rel=1e-7)
        work = (STRIP.energy(theta + h) - STRIP.energy(theta - h)) / (2 * h)
        assert STRIP.moment(theta) == pytest.approx(work, rel=1e-7)


@pytest.mark.parametrize(("v", "theta"), [(-2e-3, 1e-3), (-5e-3, 1e-3), (1e-3, 2e-3), (3e-3, 1e-3)])
def test_macro_element_against_many_springs_and_its_tangent(v, theta):
    n = 40000
    x = STRIP.width * ((np.arange(n) + 0.5) / n - 0.5)
    area = np.full(n, STRIP.width / n)
    force, moment, tangent = macro_element(STRIP.width, 1.0, STRIP.k0, v, theta)
    expected = resultants(x, area, STRIP.k0, v, theta)
    assert force == pytest.approx(expected[0], rel=1e-7, abs=1e-9)
    assert moment == pytest.approx(expected[1], rel=1e-6, abs=1e-9)
    h = 1e-8
    for column, (dv, dt) in enumerate([(h, 0.0), (0.0, h)]):
        up = macro_element(STRIP.width, 1.0, STRIP.k0, v + dv, theta + dt)
        down = macro_element(STRIP.width, 1.0, STRIP.k0, v - dv, theta - dt)
        slope = np.array([-(up[0] - down[0]), up[1] - down[1]]) / (2 * h)
        scale = STRIP.k0 * STRIP.width**3
        # the corner v = -B theta/2 has one-sided curvature only: the tangent is continuous there
        assert tangent[:, column] == pytest.approx(slope, abs=1e-4 * scale)


def test_macro_element_at_constant_force_is_the_strip():
    for ratio in (0.4, 3.0, 30.0):
        theta = ratio * STRIP.uplift_rotation
        force, moment, _ = macro_element(4.0, 1.0, STRIP.k0, float(STRIP.lift(theta)), theta)
        assert force == pytest.approx(STRIP.normal, rel=1e-12)
        assert moment == pytest.approx(float(STRIP.moment(theta)), rel=1e-12)


def test_onset_acceleration_brings_the_resultant_to_the_kern():
    height, mass = 6.0, 1e5
    a = onset_acceleration(STRIP.kern, height)
    assert mass * a * height == pytest.approx(mass * 9.81 * STRIP.kern)


def test_sudden_acceleration_lifts_at_half_the_slow_one():
    from .contact import solve
    from .rocking import TwoSpringBlock

    block = TwoSpringBlock(mass=1e5, inertia=4e5, height=4.0, half_width=1.5, k=5e7)
    a = onset_step_acceleration(block.half_width, block.height)
    for factor, lifts in ((0.999, False), (1.001, True)):
        motion = solve(block.system((0.0, factor * a)), block.rest, np.zeros(2), 2.0)
        assert bool(motion.events) == lifts


def test_rectangle_about_one_axis_is_the_strip():
    model = Rectangle(6.0, 4.0, 2e7, 2.4e6)
    about_x, about_y = Strip(4.0, 6.0, 2e7, 2.4e6), Strip(6.0, 4.0, 2e7, 2.4e6)
    for moment in (1e6, 3e6):
        v, turn, rest = model.position(moment, 0.0)
        assert about_x.moment(turn) == pytest.approx(moment, rel=1e-12)
        assert v == pytest.approx(about_x.lift(turn), rel=1e-10)
        assert abs(rest) < 1e-15
        assert about_y.moment(model.position(0.0, moment)[2]) == pytest.approx(moment, rel=1e-12)


def test_rectangle_is_in_equilibrium_about_both_axes():
    model = Rectangle(6.0, 4.0, 2e7, 2.4e6)
    u = model.position(2e6, 2.5e6)
    n = 2000  # a bed of small springs
    x = ((np.arange(n) + 0.5) / n - 0.5) * 6.0
    y = ((np.arange(n) + 0.5) / n - 0.5)[:, None] * 4.0
    push = 2e7 * np.minimum(u[0] + u[1] * y - u[2] * x, 0.0) * 24.0 / n**2
    assert push.sum() == pytest.approx(-2.4e6, rel=1e-6)
    assert (push * y).sum() == pytest.approx(2e6, rel=1e-6)
    assert -(push * x).sum() == pytest.approx(2.5e6, rel=1e-6)


def test_onset_under_a_ramp_by_direct_integration():
    from scipy.integrate import solve_ivp

    rise, w = 3.0, 8.0
    reached = lambda t, y: y[0] - 1.0  # noqa: E731
    reached.terminal = True  # type: ignore[attr-defined]
    motion = solve_ivp(
        lambda t, y: [y[1], w**2 * (t / rise - y[0])], (0, 10), [0.0, 0.0], rtol=1e-11,
        atol=1e-13, events=reached,
    )  # fmt: skip
    assert onset_ramp_time(rise, w) == pytest.approx(motion.t_events[0][0], rel=1e-8)
