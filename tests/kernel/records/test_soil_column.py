"""Free field of a soil column against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from together import together

from ssilang.kernel.records.soil_column import SoilColumn, free_field, transfers

DENSITY, MODULUS = 2000.0, 8e7
SPEED = np.sqrt(MODULUS / DENSITY)  # 200 m/s


def column(*thickness, damping=0.0):
    n = len(thickness)
    return SoilColumn(
        np.array(thickness),
        np.full(n, DENSITY),
        np.full(n, MODULUS),
        np.full(n, damping),
        2.0,
        10.0,
    )


def pulse(t, centre=0.6, f=5.0):
    a = (np.pi * f * (t - centre)) ** 2
    return (1 - 2 * a) * np.exp(-a)


def test_standing_wave_of_a_layer_cut_in_two():
    omega = 2 * np.pi * np.array([0.5, 3.0, 11.0])
    depths = np.array([0.0, 3.0, 10.0])
    u, s, e, outcrop = transfers(column(4.0, 6.0), omega, depths)
    k = omega / SPEED
    assert u == pytest.approx(np.cos(np.outer(depths, k)), abs=1e-12)
    assert s == pytest.approx(MODULUS * k * np.sin(np.outer(depths, k)), abs=1e-3)
    assert e == pytest.approx(k * np.sin(np.outer(depths, k)), abs=1e-12)
    # twice the upgoing wave exp(i k d) / 2
    assert outcrop == pytest.approx(np.exp(1j * k * 10.0), abs=1e-12)


def test_two_layers_keep_motion_and_stress():
    soil = SoilColumn(
        np.array([5.0, 5.0]), np.array([1800.0, 2200.0]), np.array([5e7, 4e8]),
        np.array([0.05, 0.02]), 2.0, 10.0,
    )  # fmt: skip
    omega = 2 * np.pi * np.array([4.0])
    h = 1e-5
    u, s, _, _ = transfers(soil, omega, np.array([7 - h, 7.0, 7 + h]))
    alpha, beta = (c[1] for c in soil.rayleigh())
    slope = -(u[2] - u[0]) / (2 * h)
    assert s[1] == pytest.approx(4e8 * (1 + 1j * omega * beta) * slope, rel=1e-5)
    # equilibrium along the upward axis: ds/dz = rho (-omega^2 + i omega alpha) u
    inertia = 2200.0 * (-(omega**2) + 1j * omega * alpha) * u[1]
    assert -(s[2] - s[0]) / (2 * h) == pytest.approx(inertia, rel=1e-5)


def test_rayleigh_damping_is_right_at_both_frequencies():
    soil = column(5.0, damping=0.07)
    alpha, beta = soil.rayleigh()
    for f in (2.0, 10.0):
        w = 2 * np.pi * f
        assert alpha / (2 * w) + beta * w / 2 == pytest.approx(0.07)


def test_surface_pulse_is_the_mean_of_two_delayed_ones_below():
    step, depth = 0.01, 10.0
    field = free_field(
        column(depth), step, pulse(np.arange(300) * step), np.array([0.0, depth]), 40.0
    )
    delay = depth / SPEED
    wanted = 0.5 * (pulse(field.times - delay) + pulse(field.times + delay))
    assert field.acceleration[1] == pytest.approx(wanted, abs=1e-6)
    speed = np.cumsum(pulse(field.times)) * field.times[1]
    assert field.velocity[0] == pytest.approx(speed, abs=2e-3)
    # undamped: tau = rho c (v upgoing - v downgoing) / 2
    v = np.interp
    up, down = (v(field.times + s * delay, field.times, field.velocity[0]) for s in (1, -1))
    inner = slice(200, len(field.times) - 200)
    stress = -DENSITY * SPEED * (up - down) / 2
    assert field.stress[1][inner] == pytest.approx(stress[inner], abs=2e-3 * np.abs(stress).max())


@together("control", [6.0, None])
def test_motion_given_below_gives_back_the_surface(control):
    step, soil = 0.01, column(4.0, 8.0, damping=0.05)
    given = pulse(np.arange(400) * step)
    surface = free_field(soil, step, given, np.array([0.0]), 40.0, control)
    finer = round(step / surface.times[1])
    back = free_field(
        soil, step, surface.acceleration[0][::finer][:400], np.array([6.0]), 40.0, 0.0
    )
    if control is None:
        assert np.abs(surface.acceleration[0]).max() < 1.0  # damped on its way
        return
    assert back.acceleration[0][::finer][:400] == pytest.approx(given, abs=2e-3)


def test_slow_acceleration_carries_the_mass_above():
    soil = replace(column(4.0, 6.0), density=np.array([DENSITY, 1500.0]))
    field = free_field(soil, 0.05, np.ones(400), np.array([3.0, 7.0, 10.0]), 5.0)
    middle = (field.times > 8) & (field.times < 12)
    above = [3.0 * DENSITY, 4.0 * DENSITY + 4500.0, 4.0 * DENSITY + 9000.0]
    assert -field.stress[:, middle].mean(axis=1) == pytest.approx(above, rel=0.02)


def test_waves_that_are_in_the_ground_before_a_record_begins_are_told():
    """A jump at the surface was below one crossing ago: with that much rest it is all there."""
    step, soil, depths = 0.02, column(20.0, 20.0), np.array([0.0, 20.0, 40.0])
    jump = np.cos(4 * np.pi * np.arange(200) * step)
    assert soil.crossing == pytest.approx(40.0 / SPEED)
    rest = np.zeros(round(1.5 * soil.crossing / step))
    begun = [free_field(soil, step, a, depths, 20.0).begun for a in (jump, np.append(rest, jump))]
    assert begun[0] > 0.1
    assert begun[1] < 0.01


def test_depths_do_not_drift_apart_behind_a_record_that_begins_with_a_jump() -> None:
    """The displacement between two depths, from their velocities, is the strain between them."""
    step, soil = 0.02, column(20.0, 20.0, damping=0.03)
    jump = np.cos(4 * np.pi * np.arange(400) * step) * np.linspace(1.0, 0.2, 400)
    field = free_field(soil, step, jump, np.array([9.9, 10.0, 10.1]), 20.0)
    apart = np.cumsum(field.velocity[0] - field.velocity[2]) * field.times[1] / 0.2
    assert np.ptp(apart) / 2 <= 1.02 * field.strain[1]
