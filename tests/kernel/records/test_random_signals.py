"""Power spectra, floors, integrals and wavelets of records against sums in time and frequency."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records import filters, floors, modulated, power, signals

F = np.array([0.4, 0.9, 1.6, 3.0, 5.0])
DENSITY = np.array([0.2, 1.1, 0.7, 0.9, 0.1])


@pytest.mark.parametrize("n", [64, 51])
@pytest.mark.parametrize("columns", [(), (3,)])
def test_a_transform_is_its_sum_and_goes_back(n, columns):
    x = np.random.default_rng(1).standard_normal((51, *columns))
    f, found = signals.fourier(x, 0.1, n)
    t = 0.1 * np.arange(51)
    expected = 0.1 * np.tensordot(np.exp(-2j * np.pi * np.outer(f, t)), x, 1)
    np.testing.assert_allclose(found, expected, atol=1e-12)
    np.testing.assert_allclose(f, np.arange(n // 2 + 1) / (0.1 * n))
    if n == 64 and not columns:
        times, back = signals.inverse_fourier(f, found)
        np.testing.assert_allclose(times[:51], t)
        np.testing.assert_allclose(back[:51], x, atol=1e-12)
        np.testing.assert_allclose(back[51:], 0.0, atol=1e-12)
        _, density = power.power_density(x, 0.1, n)
        assert density.sum() * f[1] == pytest.approx((x**2).sum() / n)
        assert signals.constant_step(times) == pytest.approx(0.1)
    with pytest.raises(FieldError, match="regular"):
        signals.constant_step(np.array([0.0, 0.1, 0.3]))
    with pytest.raises(FieldError, match="two"):
        signals.constant_step(np.array([0.0]))


@pytest.mark.parametrize("kind", ["ACCE", "VITE", "DEPL"])
@pytest.mark.parametrize(("natural", "damping"), [(1.2, 0.03), (4.9, 0.2), (9.0, 0.05)])
def test_moments_are_those_of_the_complex_transfer(kind, natural, damping):
    w0 = 2 * np.pi * natural

    def squared(f, k):
        w = 2 * np.pi * f
        z = -1 / (w0**2 - w**2 + 2j * damping * w * w0)
        h = {"DEPL": z, "VITE": 1j * w * z, "ACCE": 1 - w**2 * z}[kind]
        return abs(h) ** 2 * np.interp(f, F, DENSITY) * w**k

    found = power.response_moments(F, DENSITY, natural, damping, kind)
    for k in range(3):
        exact = quad(squared, F[0], F[-1], (k,), points=[*F[1:-1], natural], limit=400)[0]
        assert found[k] == pytest.approx(exact, rel=1e-5)


def test_largest_values_follow_their_laws():
    m, duration = (2.0, 9.0, 50.0), 7.0
    rate = np.sqrt(m[2] / m[0]) / np.pi  # crossings of both levels
    poisson = power.median_peak(m, duration)
    level = poisson**2 / (2 * m[0])
    assert np.exp(-0.5 * rate * duration * np.exp(-level)) == pytest.approx(0.5)
    assert power.median_peak(m, 1e-3) == 0.0
    q = np.sqrt(1 - m[1] ** 2 / (m[0] * m[2])) ** 1.2

    def below(r):
        clumps = (1 - np.exp(-np.sqrt(np.pi / 2) * q * r)) / (np.exp(r**2 / 2) - 1)
        return (1 - np.exp(-(r**2) / 2)) * np.exp(-rate * duration * clumps)

    low, high = (brentq(lambda r, p=p: below(r) - p, 1e-3, 9.0) for p in (0.05, 0.95))
    a = np.log(np.log(0.05) / np.log(0.95)) / (high - low)
    u = low + np.log(-np.log(0.05)) / a
    mean = quad(lambda r: r * a * np.exp(-a * (r - u) - np.exp(-a * (r - u))), -20, 60)[0]
    assert power.mean_peak(m, duration) == pytest.approx(np.sqrt(2.0) * mean, rel=1e-6)
    periods = np.array([0.3, 0.8])
    for law, peak in (("CRAM", power.median_peak), ("NEWG", power.mean_peak)):
        found = power.response_spectrum(F, DENSITY, duration, periods, 0.05, "DEPL", law)
        expected = [
            peak(power.response_moments(F, DENSITY, 1 / t, 0.05, "DEPL"), duration) for t in periods
        ]
        np.testing.assert_allclose(found, expected)


STOREY = floors.Storey(np.array([1.1, 2.7]), np.array([0.06, 0.03]), np.array([1.3, -0.4]))


def test_an_oscillator_on_a_floor_moves_as_step_by_step():
    """Under a sum of all frequencies of the density, each integrated in time by small steps."""
    envelope = (np.array([1.0, 2.5, 4.0]), np.array([0.0, 1.0, 0.4]))
    times, moments = floors.floor_evolution(STOREY, (F, DENSITY), envelope, 1.9, 0.04)
    f = np.linspace(F[0], F[-1], 121)
    w, dt = 2 * np.pi * f, 0.004
    n, x, c = 2 * np.pi * STOREY.frequencies, STOREY.dampings, STOREY.participations
    w0, x0 = 2 * np.pi * 1.9, 0.04
    t = np.arange(0, times[-1] + dt / 2, dt)
    level = np.where(t <= 3.0, np.interp(t + 1.0, *envelope), 0.0)
    q, v = np.zeros((2, 2, len(f)), complex)
    z, zv = np.zeros((2, len(f)), complex)
    rows = [(z.copy(), zv.copy())]
    for i in range(len(t) - 1):  # velocities half a step ahead, by the mean of damping
        a = level[i] * np.exp(1j * w * t[i])
        kick = dt * (0.5 if i == 0 else 1.0)
        acc = -a - 2 * x[:, None] * n[:, None] * v - n[:, None] ** 2 * q
        v_new = v + kick * acc
        mean = (v + v_new) / 2
        acc = -a - 2 * x[:, None] * n[:, None] * mean - n[:, None] ** 2 * q
        v = v + kick * acc
        floor = a + c @ acc
        zacc = -floor - w0**2 * z
        zv = (zv * (1 - x0 * w0 * kick) + kick * zacc) / (1 + x0 * w0 * kick)
        q, z = q + dt * v, z + dt * zv
        rows.append((z.copy(), zv.copy()))
    z = np.array([r[0] for r in rows])
    zv = np.array([r[1] for r in rows])
    zv[1:-1] = 0.5 * (zv[1:-1] + zv[2:])
    density = np.interp(f, F, DENSITY)
    assert times[0] == 0.0
    for k in (0, 2):
        part = np.abs(z if k == 0 else zv) ** 2 * density
        own = np.trapezoid(part, f, axis=1)
        found = np.interp(t, times, moments[:, k])
        np.testing.assert_allclose(found, own, atol=0.03 * own.max())
    cross = np.trapezoid((np.conj(z) * zv).imag * density, f, axis=1)
    np.testing.assert_allclose(np.interp(t, times, moments[:, 1]), cross, atol=0.03 * cross.max())
    found, factors = floors.floor_spectrum(STOREY, (F, DENSITY), envelope, np.array([1.9]), 0.04)
    assert found[0] == pytest.approx(np.sqrt(moments[:, 0].max()))
    assert 1.0 < factors[0] < 4.0


def test_sines_have_the_power_of_their_slices():
    f, a = modulated.sines(F, DENSITY, 23)
    np.testing.assert_allclose(np.diff(f), (F[-1] - F[0]) / 23)
    assert f[0] - F[0] == pytest.approx(F[-1] - f[-1])
    np.testing.assert_allclose(a**2 / 2, np.interp(f, F, DENSITY) * (F[-1] - F[0]) / 23)


@pytest.mark.parametrize("start", [0.0, 0.7])
def test_sines_of_bands_are_modulated_and_integrated_each_by_its_own(start):
    rng = np.random.default_rng(2)
    f, a, phase = rng.uniform(0.5, 4.0, 9), rng.uniform(1, 2, 9), rng.uniform(0, 6, 9)
    f[3] = 4.0  # at the end of the last band
    bands = (
        modulated.Band(0.5, 2.0, np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.5, 0.2])),
        modulated.Band(2.0, 4.0, np.array([0.0, 2.0, 3.0]), np.array([1.0, 0.5, 0.9])),
    )
    t = np.linspace(start, 3.0, 4001)
    got = modulated.motion(t, f, a, phase, bands, start)
    expected = np.zeros(len(t))
    for one, two, three in zip(f, a, phase, strict=True):
        band = bands[int(one >= 2.0)]
        m = np.interp(t, band.times, band.values)
        expected += m * two * np.cos(2 * np.pi * one * t + three)
    np.testing.assert_allclose(got[0], expected, atol=1e-9)
    v, d = filters.integrated(expected, t[1] - t[0], True)
    np.testing.assert_allclose(got[1], v, atol=1e-5 * np.abs(v).max())
    np.testing.assert_allclose(got[2], d, atol=1e-5 * np.abs(d).max())


@pytest.mark.parametrize("linear", [False, True])
def test_a_record_is_brought_to_rest_by_the_least_change(linear):
    a, step = np.random.default_rng(5).standard_normal(40), 0.3
    rows = filters.end_rows(40, step, linear)
    v, d = filters.integrated(a, step, linear)
    mean = filters.displacement_integral(a, step, linear)
    np.testing.assert_allclose(rows @ a, [v[-1], d[-1], mean], rtol=1e-9)
    if linear:  # exact, from the sum of second and third powers
        t = step * np.arange(40)
        fine = np.linspace(0, t[-1], 40001)
        values = np.interp(fine, t, a)
        own = [np.trapezoid(values * (t[-1] - fine) ** k, fine) / (1, 1, 2)[k] for k in range(3)]
        np.testing.assert_allclose([v[-1], d[-1], mean], own, rtol=1e-4)
    else:
        own = np.trapezoid(a, dx=step)
        assert v[-1] == pytest.approx(own)
        assert mean == pytest.approx(np.trapezoid(d, dx=step))
    made = filters.brought_to_rest(a, step, linear)
    np.testing.assert_allclose(rows @ made, 0.0, atol=1e-8 * np.abs(rows).sum(axis=1).max())
    change = a - made
    left = change - rows.T @ np.linalg.lstsq(rows.T, change, rcond=None)[0]
    np.testing.assert_allclose(left, 0.0, atol=1e-9)
    with pytest.raises(FieldError, match="four"):
        filters.brought_to_rest(a[:3], step)


def test_shocks_and_times_above_a_level():
    x = np.array([0.0, 3.0, -5.0, 1.0, 0.5, 4.0, 4.5, 0.0, -4.2])
    peaks, begins, ends = signals.shocks(x, 50.0)
    assert peaks.tolist() == [-5.0, 4.5, -4.2]
    assert (begins.tolist(), ends.tolist()) == ([1, 5, 8], [3, 7])
    t = np.array([0.0, 1.0, 3.0, 3.5])
    y = np.array([0.0, 2.0, -4.0, -1.0])
    assert signals.time_above(t, y, 1.5) == pytest.approx(
        0.25 + 2 * 0.5 / 6 + 2 * 2.5 / 6 + 0.5 * 2.5 / 3
    )
    u, v = signals.turned(np.array([3.0]), np.array([1.0]), 30.0)
    assert u + 1j * v == pytest.approx((3 + 1j) * np.exp(-1j * np.pi / 6))


def test_ridges_of_a_wavelet_follow_a_sine_and_its_amplitude():
    step, n, pulsation = 0.02, 1024, 12.0
    t = 5.0 + step * np.arange(n)
    scale = signals.scales(1.0, 4.0, 60, pulsation)
    np.testing.assert_allclose(scale[[0, -1]], pulsation / (2 * np.pi * np.array([4.0, 1.0])))
    assert len(scale) == 61
    x = 1.7 * np.cos(2 * np.pi * 2.2 * t + 0.4)
    found = signals.transform(x, step, n, scale, pulsation)
    at, f, size = signals.modulus_ridge(t, found, scale, pulsation)
    assert at[0] >= t[0] + 2 * scale[-1]
    assert at[-1] <= t[-1] - 2 * scale[-1]
    np.testing.assert_allclose(f, 2.2, rtol=0.02)
    np.testing.assert_allclose(size, 1.7, rtol=0.01)
    at, f, size = signals.phase_ridge(t, found, scale, pulsation, 0.02)
    strong = size > 0.5  # where next to nothing is left the phase is that of the ends
    np.testing.assert_allclose(f[strong], 2.2, rtol=0.08)
    assert strong.sum() > 400
    inner = strong & (at > 9) & (at < 21)
    assert size[inner].max() == pytest.approx(1.7, rel=0.02)
    cut = signals.transform(x, step, 512, scale, pulsation)
    assert cut.shape == (61, 512)
