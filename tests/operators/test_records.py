"""Records, artificial signals, wavelets and sampled lists against closed forms."""

import itertools

import numpy as np
import pytest

from ssilang.kernel.records.filters import displacement_integral, integrated
from ssilang.kernel.records.modulated import Band, motion, sines
from ssilang.kernel.records.power import (
    mean_peak,
    median_peak,
    power_density,
    response_moments,
)
from ssilang.kernel.records.signals import energy_envelope


def parts(curve):
    return [(p.abscissas, p.ordinates) for p in curve.parts]


# ---- integration and correction


@pytest.mark.parametrize("rule", ["SIMP", "LINE"])
def test_corrected_record_ends_at_rest_and_is_the_nearest_such(found, rule):
    script = (
        "A = EVOL 'MANU' 'T' (PROG 0. PAS 0.02 NPAS 200) 'A' (BRUI 'BLAN' 'GAUS' 0.3 1. 201) ; "
        f"B = COSI A '{rule}' ; D V = INSI B '{rule}' ; "
    )
    a, b, d, v = (parts(c)[0][1] for c in found(script, "A", "B", "D", "V"))
    assert abs(v[-1]) < 1e-13
    assert abs(d[-1]) < 1e-13
    linear = rule == "LINE"
    assert abs(displacement_integral(b, 0.02, linear)) < 1e-13
    # nearest: the change is orthogonal to every record that ends at rest
    other = np.random.default_rng(2).normal(size=201)
    rows = []
    for k in range(201):
        unit = np.eye(201)[k]
        w, x = integrated(unit, 0.02, linear)
        rows.append([w[-1], x[-1], displacement_integral(unit, 0.02, linear)])
    rows = np.array(rows).T
    other -= rows.T @ np.linalg.solve(rows @ rows.T, rows @ other)
    assert abs(other @ (a - b)) < 1e-9


def test_a_displacement_is_integrated_by_its_own_rule():
    t = np.linspace(0.0, 2.0, 9)
    assert displacement_integral(6.0 * t, 0.25, True) == pytest.approx(4.0)  # of t^3
    _, d = integrated(6.0 * t, 0.25)
    assert displacement_integral(6.0 * t, 0.25) == pytest.approx(np.trapezoid(d, t))


# ---- spectra


def test_power_density_sums_to_the_mean_square(found):
    y = np.random.default_rng(0).normal(size=256)
    f, density = power_density(y, 0.01, 256)
    assert density.sum() * f[1] == pytest.approx(np.mean(y**2))
    seen = found(
        "S = EVOL 'MANU' (PROG 0. PAS 0.125 NPAS 7) (SIN (PROG 0. PAS 90. NPAS 7)) ; "
        "P = DSPR 3 S 'FMIN' 1. 'FMAX' 3. ;",
        "P",
    )
    np.testing.assert_allclose(parts(seen)[0], ([1, 2, 3], [0, 0.5, 0]), atol=1e-15)


def test_moments_of_white_noise_are_the_known_ones():
    f = np.linspace(0.0, 400.0, 5)
    w, xi = 2 * np.pi * 2.0, 0.05
    # one-sided density 1 per hertz is 1 / (4 pi) two-sided per rad/s: variance pi S / (2 xi w^3)
    m0, _, m2 = response_moments(f, np.ones(5), 2.0, xi, "DEPL")
    assert m0 == pytest.approx(1.0 / (8 * xi * w**3), rel=1e-4)
    # the speed's variance is 1 / (8 xi w), short of the tail beyond 400 Hz (1 / (2 pi 400 2 pi))
    assert m2 == pytest.approx(1.0 / (8 * xi * w) - 1 / (2 * np.pi) ** 2 / 400, rel=1e-3)


def test_median_peak_leaves_half_of_the_crossings_out():
    moments = (4.0, 0.0, 4.0 * (2 * np.pi * 5) ** 2)  # deviation 2, five crossings a second
    x = median_peak(moments, 20.0)
    assert np.exp(-5 * 20 * np.exp(-(x**2) / 8)) == pytest.approx(0.5)


def test_mean_peak_is_that_of_drawn_signals():
    f = np.linspace(0.5, 1.5, 11)
    density = np.full(11, 1.0)
    xi, natural, duration = 0.05, 1.0, 60.0
    moments = response_moments(f, density, natural, xi, "DEPL")
    rng = np.random.default_rng(4)
    t = np.arange(0.0, duration, 0.02)
    x, amplitude = sines(f, density, 400)
    w = 2 * np.pi * x
    gain = 1 / np.abs((2 * np.pi) ** 2 - w**2 + 2j * xi * w * 2 * np.pi)
    across = np.cos(np.outer(w, t)), np.sin(np.outer(w, t))
    peaks = []
    for _ in range(100):
        phase = rng.uniform(0, 2 * np.pi, 400)
        amp = amplitude * gain
        peaks.append(
            np.abs((amp * np.cos(phase)) @ across[0] - (amp * np.sin(phase)) @ across[1]).max()
        )
    # a hundred drawn peaks: their mean is known to 1 %; of a lightly damped response the law of
    # Vanmarcke is 5 % low and the Gumbel law through two of its fractiles 2 % more
    assert mean_peak(moments, duration) == pytest.approx(np.mean(peaks), rel=0.1)


def test_response_spectrum_over_frequencies_increases_them(found):
    script = (
        "S = EVOL 'MANU' (PROG 0.1 20.) (PROG 0.1 0.1) ; "
        "A = PSRS S 10. (PROG 0.02 0.05) (PROG 0.1 0.5) 'FREQ' 'DEPL' ; "
        "B = PSRS S 10. (PROG 0.05) ;"
    )
    a, b = found(script, "A", "B")
    (fa, low), (_, high) = parts(a)
    np.testing.assert_allclose(fa, [2, 10])
    assert (low > high).all()
    moments = response_moments(np.array([0.1, 20]), np.full(2, 0.1), 2.0, 0.02, "DEPL")
    assert low[0] == pytest.approx(median_peak(moments, 10.0))
    assert len(parts(b)[0][0]) == 75
    assert parts(b)[0][0][[0, -1]] == pytest.approx([0.04, 10])


def test_stiff_oscillator_follows_the_ground(found):
    script = (
        "S = EVOL 'MANU' (PROG 0.5 2.) (PROG 1. 1.) ; "
        "A = PSRS S 20. (PROG 0.05) (PROG 0.001) 'ACCE' ; "
    )
    # the acceleration of a stiff oscillator is the ground's: variance 1.5, sum of f^2 = 2.625
    crossings = 20 * np.sqrt(2.625 / 1.5)
    expected = np.sqrt(2 * 1.5 * np.log(crossings / np.log(2)))
    assert parts(found(script, "A"))[0][1][0] == pytest.approx(expected, rel=1e-3)


# ---- artificial signals


def test_motion_is_the_integral_of_its_acceleration():
    bands = (
        Band(0.0, 2.0, np.array([0.0, 1.0, 4.0]), np.array([0.0, 1.0, 0.3])),
        Band(2.0, 4.0, np.array([0.0, 2.0, 4.0]), np.array([0.5, 1.0, 0.0])),
    )
    t = np.linspace(0.0, 4.0, 4001)
    f = np.array([0.7, 1.1, 2.0, 3.3])
    a, v, d = motion(t, f, np.ones(4), np.array([0.1, 2.0, 4.0, 1.0]), bands, 0.0)
    w, x = integrated(a, 0.001, True)
    # linear between 1 ms samples: the error of a sine is (w dt)^2 / 12 of its amplitude
    assert np.abs(v - w).max() < 1e-5
    assert np.abs(d - x).max() < 2e-5


def test_artificial_signal_has_the_power_of_its_spectrum(found):
    script = (
        "S = EVOL 'MANU' (PROG 1. 5.) (PROG 0.5 0.5) ; "
        "A = SIAR S 40. 'ACCE' 'NCOU' 3 'INIT' 7 ; B = SIAR S 40. 'ACCE' 'NCOU' 3 'INIT' 7 ; "
        "C V D = SIAR S 4. 'NPOI' 11 'TINI' 1. ; "
    )
    a, b, c, v, d = found(script, "A", "B", "C", "V", "D")
    for (t, y), (_, again) in zip(parts(a), parts(b), strict=True):
        assert len(t) == 2001
        assert np.mean(y**2) == pytest.approx(2.0, rel=0.02)  # 0.5 times 4 Hz
        np.testing.assert_array_equal(y, again)
    np.testing.assert_allclose(parts(c)[0][0], np.linspace(1, 4, 11))
    assert len(v.parts) == len(d.parts) == 1


def test_perturbed_list_keeps_its_power(found):
    made, signed = found(
        "L = PROG 1. -2. 3. -4. 5. ; A = PERT L 'AMPL' 60. 'INIT' 5 ; B = PERT L 'INIT' 5 ;",
        "A", "B",
    )  # fmt: skip
    assert np.sum(made.values**2) == pytest.approx(55.0)
    assert list(np.sign(made.values)) == [1, -1, 1, -1, 1]
    assert not np.allclose(np.abs(made.values), [1, 2, 3, 4, 5])
    assert list(np.abs(signed.values)) == [1, 2, 3, 4, 5]


# ---- wavelets


def test_wavelets_give_amplitude_frequency_and_phase_of_a_sine(found):
    script = (
        "OPTI DIME 2 ; T = PROG 0. PAS 0.02 NPAS 1023 ; "
        "S = EVOL 'MANU' 'TEMP' T 'A' (3. * (COS (540. * T))) ; "
        "R = ONDE 10 S 'CRMO' 'FMIN' 1. 'FMAX' 3. 'NFRQ' 200 ; "
        "P = ONDE 10 S 'CRPH' 'FMIN' 1. 'FMAX' 3. 'NFRQ' 200 'EPSI' 0.002 ; "
        "C M = ONDE 9 S 'MOPH' 'FMIN' 1. 'FMAX' 3. 'NFRQ' 20 ; N = NBEL M ;"
    )
    ridge, phase, field, cells = found(script, "R", "P", "C", "N")
    for found_ridge in (ridge, phase):
        (t, f), (_, size) = parts(found_ridge)
        assert len(f) > 500
        # two scales from the ends still count e^-2; in the middle nothing does
        middle = (t > 4) & (t < 16)
        np.testing.assert_allclose(f[middle], 1.5, rtol=3e-3)  # the grid of scales is this fine
        np.testing.assert_allclose(size[middle], 3.0, rtol=1e-3)
    assert cells == 20 * 511
    assert field.components["MODU"].values.max() == pytest.approx(3.0, rel=0.01)


# ---- shaping


def test_energy_envelope_keeps_the_squares_of_each_interval():
    x = np.linspace(0.0, 4.0, 81)
    y = np.random.default_rng(1).normal(size=81) * (1 + np.sin(x))
    places, level = energy_envelope(x, y, 8)
    line = np.interp(x, places, level)
    for a, b in itertools.pairwise(places):
        inside = (x > a + 1e-9) & (x < b + 1e-9)
        assert np.sum(line[inside] ** 2) == pytest.approx(np.sum(y[inside] ** 2), rel=1e-9)
    assert (level >= 0).all()


def test_inverse_laplace_of_a_sine(found):
    script = (
        "W = PROG 0. PAS 0.25 NPAS 8191 ; A = 0.3 ; B = 2. ; "
        "RE = (A * A) + (B * B) - (W * W) ; IM = 2. * A * W ; D = (RE * RE) + (IM * IM) ; "
        "E = LAPL 'INVERSE' W (B * RE / D) (-1. * B * IM / D) A 16 ;"
    )
    t, y = parts(found(script, "E"))[0]
    assert len(t) == 512
    # Durbin's aliasing is exp(-2 a T) of the next period, and the end of a period is poor
    kept = (t > 0.1) & (t < 15)
    np.testing.assert_allclose(y[kept], np.sin(2 * t[kept]), atol=2e-3)


# ---- sampled lists


# ---- two components together


@pytest.mark.parametrize("unit", [1.0, 1e-3, 1e4])
def test_components_are_turned_from_x_to_y(found, unit):
    """A record along the new x axis is all in its component, whatever the unit of time."""
    angle = np.radians(25.0)
    script = (
        f"T = {unit} * (PROG 0. 1. 2. 3.5) ; "
        f"X = EVOL 'MANU' T (PROG 0. {3 * np.cos(angle)} 0. {-2 * np.cos(angle)}) ; "
        f"Y = EVOL 'MANU' T (PROG 0. {3 * np.sin(angle)} 0. {-2 * np.sin(angle)}) ; "
        "A B = TOUR X Y 25. ; "
    )
    a, b = found(script, "A", "B")
    np.testing.assert_allclose(parts(a)[0][1], [0, 3, 0, -2], atol=1e-12)
    np.testing.assert_allclose(parts(b)[0][1], 0, atol=1e-12)
    np.testing.assert_allclose(parts(a)[0][0], unit * np.array([0, 1, 2, 3.5]))
