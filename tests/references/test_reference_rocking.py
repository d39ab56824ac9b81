"""Free rocking: periods against direct integration of the equation of motion."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from .contact import solve
from .footing import Strip
from .rocking import HousnerBlock, RigidTower, TwoSpringBlock, macro_element_period

STRIP = Strip(width=4.0, length=1.0, k0=2e7, normal=6e5)


def quarter(f, theta):
    """Time from rest at theta to theta = 0 of theta'' = f(theta)."""

    def crossing(t, y):
        return y[0]

    crossing.terminal = True
    run = solve_ivp(
        lambda t, y: [y[1], f(y[0])],
        (0.0, 1e3),
        [theta, 0.0],
        "DOP853",
        events=crossing,
        rtol=1e-12,
        atol=1e-15,
    )
    return run.t_events[0][0]


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5, 5.0, 50.0])
def test_macro_element_period_against_direct_integration(ratio):
    inertia, theta = 3e6, ratio * STRIP.uplift_rotation
    time = quarter(lambda x: -float(STRIP.moment(x)) / inertia, theta)
    assert macro_element_period(STRIP, inertia, theta) == pytest.approx(4 * time, rel=1e-8)


def test_macro_element_period_is_harmonic_before_uplift_and_grows_after():
    inertia, theta = 3e6, STRIP.uplift_rotation
    harmonic = 2 * np.pi * np.sqrt(inertia / STRIP.stiffness)
    assert macro_element_period(STRIP, inertia, 0.3 * theta) == pytest.approx(harmonic, rel=1e-12)
    periods = [macro_element_period(STRIP, inertia, r * theta) for r in (1.0, 2.0, 4.0, 8.0)]
    assert periods[0] == pytest.approx(harmonic, rel=1e-12)
    assert np.all(np.diff(periods) > 0.0)


def test_housner_period_against_direct_integration():
    block = HousnerBlock(radius=3.0, alpha=0.25)
    slender = quarter(lambda x: -(block.p**2) * (block.alpha - x), 0.1)
    large = quarter(lambda x: -(block.p**2) * np.sin(block.alpha - x), 0.1)
    assert block.period(0.1) == pytest.approx(4 * slender, rel=1e-9)
    assert block.period_large(0.1) == pytest.approx(4 * large, rel=1e-9)


def test_housner_large_period_tends_to_the_slender_one():
    block = HousnerBlock(radius=3.0, alpha=0.01)
    assert block.period_large(0.004) == pytest.approx(block.period(0.004), rel=1e-4)


def test_housner_amplitudes_follow_the_energy_lost_at_each_impact():
    block = HousnerBlock(radius=3.0, alpha=0.25)
    heights = block.amplitudes(0.1, 4)
    assert heights[0] == pytest.approx(0.1)
    # slender energy p^2 (alpha theta - theta^2/2) falls by e^2 at each impact
    energy = block.alpha * heights - heights**2 / 2
    assert energy[1:] / energy[:-1] == pytest.approx(block.restitution**2, rel=1e-12)


def test_tower_in_space_keeps_its_energy_and_is_the_block_in_a_plane():
    tower = RigidTower(1e5, 3.2e6, 5.0, 1.5, 2.0, 4e7)
    motion = solve(
        tower.system(np.pi / 0.25, (4.0, 1.5, 2.0), (1.0, 5.0, -2.0)), tower.rest, np.zeros(3), 2.0
    )
    energy = motion.energy(np.linspace(0.51, 2.0, 30))
    assert np.ptp(energy) <= 1e-9 * np.abs(energy).max()
    assert all(len(motion.times(i, False)) > 0 for i in range(4))
    # pushed about y alone: a block on two springs of twice the stiffness
    block = TwoSpringBlock(1e5, 3.2e6 - 1e5 * 25.0, 5.0, 1.5, 8e7)
    start = np.array([-block.settlement + 0.01, 0.0, 0.006])
    space = solve(tower.system(1.0), start, np.zeros(3), 1.0)
    plane = solve(block.system(), np.array([start[0], -start[2]]), np.zeros(2), 1.0)
    t = np.linspace(0.0, 1.0, 50)
    np.testing.assert_allclose(space(t)[0][:, 0], plane(t)[0][:, 0], atol=1e-10)
    np.testing.assert_allclose(space(t)[0][:, 2], -plane(t)[0][:, 1], atol=1e-10)
