"""Rigid bases under waves that pass and differ: closed forms, direct double integrals, limits."""

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import erf, j1, jv
from together import together

from ssilang.kernel.waves.incoherence import (
    Ground,
    RigidBase,
    averaged,
    factors,
    frequencies_of,
    signs,
)

STRIP, DISC = RigidBase("strip", 12.0), RigidBase("disc", 10.0)
RECTANGLE = RigidBase("rectangle", 12.0, 7.0)
F = np.array([0.3, 1.0, 2.7, 6.0, 15.0, 40.0])
PASSAGE = Ground(200.0, 0.0, 800.0)
CHANCE = Ground(200.0, 0.2)
Z = 2 * np.pi * F / 800.0  # wave number


def test_passage_along_a_strip_is_sine_over_argument():
    found, z = factors(STRIP, PASSAGE, F), 12.0 * Z
    np.testing.assert_allclose(found.translation, np.abs(np.sin(z) / z), rtol=0, atol=1e-9)
    exact = 3 * np.abs(np.sin(z) - z * np.cos(z)) / (12.0 * z**2)
    np.testing.assert_allclose(found.rotation, exact, rtol=0, atol=1e-9)
    assert not found.torsion.any()


def test_passage_along_a_disc_is_in_bessel_functions():
    found, z = factors(DISC, PASSAGE, F), 10.0 * Z
    np.testing.assert_allclose(found.translation, np.abs(2 * j1(z) / z), rtol=0, atol=1e-8)
    np.testing.assert_allclose(found.rotation, np.abs(8 * jv(2, z) / z) / 10.0, rtol=0, atol=1e-8)
    np.testing.assert_allclose(found.torsion, found.rotation / 2, rtol=1e-15)


def line_by_chance(half, frequency):
    """T^2 of a line by the error function."""
    b = 2 * half * CHANCE.gamma * 2 * np.pi * frequency / CHANCE.shear
    return np.sqrt(np.pi) / b * erf(b) + np.expm1(-(b**2)) / b**2


def test_chance_over_strips_and_rectangles_is_in_error_functions():
    strip, rectangle = factors(STRIP, CHANCE, F), factors(RECTANGLE, CHANCE, F)
    np.testing.assert_allclose(strip.translation**2, line_by_chance(12.0, F), rtol=1e-11)
    both = line_by_chance(12.0, F) * line_by_chance(7.0, F)
    np.testing.assert_allclose(rectangle.translation**2, both, rtol=1e-11)
    share = 144.0 / (144.0 + 49.0)
    np.testing.assert_allclose(rectangle.torsion, share * rectangle.rotation, rtol=1e-14)


def test_both_at_once_are_the_double_integral():
    ground, f, a = Ground(200.0, 0.2, 500.0), 4.0, 12.0
    decay, number = ground.numbers(f)

    def coherency(x, y):
        return np.exp(-((decay * (x - y)) ** 2)) * np.cos(number * (x - y))

    mean, _ = dblquad(coherency, -a, a, -a, a, epsabs=1e-10)
    moments, _ = dblquad(lambda x, y: x * y * coherency(x, y), -a, a, -a, a, epsabs=1e-8)
    found = factors(STRIP, ground, np.array([f]))
    assert found.translation[0] ** 2 == pytest.approx(mean / (2 * a) ** 2, rel=1e-8)
    assert found.rotation[0] ** 2 == pytest.approx(moments / (2 * a**3 / 3) ** 2, rel=1e-8)


def test_a_disc_is_the_mean_over_many_pairs_of_its_points():
    """Gauss points of the area by rings and spokes."""
    ground, f = Ground(200.0, 0.2, 500.0), 3.0
    decay, number = ground.numbers(f)
    r, w = np.polynomial.legendre.leggauss(30)
    r, w = 5.0 * (r + 1), 5.0 * w
    phi = 2 * np.pi * np.arange(48) / 48
    x, y = (r[:, None] * np.cos(phi)).ravel(), (r[:, None] * np.sin(phi)).ravel()
    weight = np.repeat(w * r * 2 * np.pi / 48, 48)
    gamma = np.cos(number * np.subtract.outer(x, x)) * np.exp(
        -(decay**2) * (np.subtract.outer(x, x) ** 2 + np.subtract.outer(y, y) ** 2)
    )
    found = factors(DISC, ground, np.array([f]))
    area, moment = np.pi * 100.0, np.pi * 1e4 / 4
    assert found.translation[0] ** 2 == pytest.approx(weight @ gamma @ weight / area**2, rel=1e-9)
    turned = (x * weight) @ gamma @ (x * weight) / moment**2
    assert found.rotation[0] ** 2 == pytest.approx(turned, rel=1e-9)


@together("base", [STRIP, RECTANGLE, DISC])
def test_slow_motion_moves_the_base_as_the_ground_and_turns_it_by_its_slope(base):
    found = factors(base, PASSAGE, np.array([0.0, 1e-3]))
    np.testing.assert_allclose(found.translation, 1.0, atol=1e-9)
    assert found.rotation[0] == 0.0
    assert found.rotation[1] == pytest.approx(2 * np.pi * 1e-3 / 800.0, rel=1e-6)


@together("base", [STRIP, RECTANGLE])
def test_a_record_becomes_the_mean_of_the_wave_below(base):
    """A pulse of 8 Hz, far beyond where a wave of 300 m/s turns the base against its centre."""
    ground, step = Ground(200.0, 0.0, 300.0), 0.004
    t = step * np.arange(500) - 1.0

    def pulse(t):
        y = (np.pi * 8.0 * t) ** 2
        return (1 - 2 * y) * np.exp(-y)

    record = pulse(t)
    f = frequencies_of(record, step)
    found, (with_wave, slope) = factors(base, ground, f), signs(base, ground, f)
    x, weights = np.polynomial.legendre.leggauss(60)
    below = pulse(t[:, None] - 12.0 / 300.0 * x)
    mean = averaged(record, with_wave * found.translation)
    np.testing.assert_allclose(mean, below @ weights / 2, rtol=0, atol=1e-8)
    turned = averaged(record, -1j * slope * found.rotation)
    np.testing.assert_allclose(turned, below @ (1.5 * weights * x) / 12.0, rtol=0, atol=1e-8)


def test_signs_of_a_disc_are_the_wave_s_until_chance_prevails():
    z = 10.0 * 2 * np.pi * F / 200.0
    translation, slope = signs(DISC, Ground(200.0, 0.0, 200.0), F)
    np.testing.assert_array_equal(translation, np.sign(j1(z)))
    np.testing.assert_array_equal(slope, np.sign(jv(2, z)))
    assert set(translation) == {-1.0, 1.0}
    for of in signs(DISC, Ground(200.0, 3.0, 200.0), F):
        assert np.all(of == 1.0)
