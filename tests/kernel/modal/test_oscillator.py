"""Oscillators against closed solutions, and spectra against their limits."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.modal.oscillator import (
    Oscillators,
    default_frequencies,
    response,
    spectrum,
)


@together("t", [np.linspace(0.0, 2.0, 9), np.array([0.0, 0.1, 0.2, 1.2])])
@together("xi", [0.0, 0.05, 0.7])
def test_free_decay_is_exact_whatever_the_step(xi, t):
    _, x = response(t, np.zeros(len(t)), 1.5, xi, None, 0.2, -1.0)
    w = 2.0 * np.pi * 1.5
    wd = w * np.sqrt(1.0 - xi**2)
    exact = np.exp(-xi * w * t) * (
        0.2 * np.cos(wd * t) + (-1.0 + xi * w * 0.2) / wd * np.sin(wd * t)
    )
    np.testing.assert_allclose(x, exact, atol=1e-12)


@together("xi", [1.0, 2.0])
def test_ramp_is_followed_beyond_critical_damping(xi):
    t = np.linspace(0.0, 40.0, 401)
    _, x = response(t, t, 0.5, xi)
    w = np.pi
    assert x[-1] == pytest.approx((t[-1] - 2.0 * xi / w) / w**2, rel=1e-6)


def test_harmonic_resonance_grows_as_theory():
    w = 2.0 * np.pi
    t = np.linspace(0.0, 5.0, 5001)
    _, x = response(t, np.sin(w * t), 1.0, 0.0)
    exact = (np.sin(w * t) / w - t * np.cos(w * t)) / (2.0 * w)
    assert np.abs(x - exact).max() < 1e-4 * np.abs(exact).max()


def test_response_at_other_times_is_that_of_the_whole_signal():
    t = np.linspace(0.0, 1.0, 11)
    g = np.sin(7.0 * t)
    wanted = np.array([0.05, 0.33, 0.9])
    fine = np.union1d(t, wanted)
    at, x = response(t, g, 2.0, 0.1, wanted)
    _, whole = response(fine, np.interp(fine, t, g), 2.0, 0.1)
    np.testing.assert_allclose(at, wanted)
    np.testing.assert_allclose(x, whole[np.isin(fine, wanted)], atol=1e-13)


def test_stiff_oscillators_follow_the_ground():
    t = np.linspace(0.0, 10.0, 2001)
    g = np.sin(2.0 * np.pi * t) * np.exp(-((t - 5.0) ** 2))
    for kind in ("ACCE", "ACCA"):
        found = spectrum(t, g, np.array([45.0]), 0.05, kind)
        assert found[0] == pytest.approx(np.abs(g).max(), rel=5e-3)


def test_spectra_are_tied_by_the_frequency():
    t = np.linspace(0.0, 4.0, 401)
    g = np.cos(9.0 * t)
    f = np.array([0.5, 1.4, 6.0])
    w = 2.0 * np.pi * f
    d, v, a = (spectrum(t, g, f, 0.02, kind) for kind in ("DEPL", "VITE", "ACCE"))
    np.testing.assert_allclose(v, w * d)
    np.testing.assert_allclose(a, w**2 * d)


def test_peak_after_the_end_of_the_signal_counts():
    # a short pulse: x(t) = impulse / w sin w t after it, largest a quarter period later
    t = np.array([0.0, 0.005, 0.01])
    g = np.array([0.0, 1.0, 0.0])
    found = spectrum(t, g, np.array([1.0]), 0.0, "DEPL")
    assert found[0] == pytest.approx(0.005 / (2.0 * np.pi), rel=1e-3)


def test_default_frequencies_step_by_the_duration_then_by_the_damping():
    t = np.linspace(0.0, 10.0, 1001)
    f = default_frequencies(t, 0.05)
    np.testing.assert_allclose(f[:20], 0.1 * np.arange(1, 21))
    np.testing.assert_allclose(np.diff(f)[25:] / f[25:-1], 0.05)
    assert f[-1] <= 50.0 < f[-1] * 1.05


def test_equal_steps_give_the_history_of_the_step_by_step_march():
    rng = np.random.default_rng(4)
    t = np.linspace(2.0, 5.0, 1000)
    g = rng.normal(size=1000)
    for xi in (0.0, 0.3, 1.0, 3.0):
        oscillator = Oscillators(np.array([1.7]), xi)
        marched = np.array([x[0] for x, _ in oscillator.march(t, g, 0.4, -2.0)])
        found = oscillator.history(t, g, 0.4, -2.0)
        np.testing.assert_allclose(found, marched, atol=1e-11 * np.abs(marched).max())


def test_a_million_steps_keep_their_digits():
    t = np.linspace(0.0, 1.0, 1_000_001)
    _, x = response(t, np.zeros_like(t), 2.0, 0.0, None, 1.0, 0.0)
    assert np.abs(x - np.cos(4.0 * np.pi * t)).max() < 1e-8


def test_huge_damping_does_not_overflow():
    with np.errstate(all="raise", under="ignore"):
        t = np.linspace(0.0, 1.0, 11)
        _, x = response(t, np.ones(11), 100.0, 1e3, None, 0.0, 0.0)
    assert np.isfinite(x).all()
    assert (np.diff(x) > 0.0).all()
