"""Records matched to a spectrum: what comes out, looked at by other means."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import lsim

from ssilang.kernel.modal.oscillator import spectrum
from ssilang.kernel.records import matching
from ssilang.kernel.records.filters import integrated
from ssilang.kernel.records.matching import matched, wavelets

STEP = 0.01
TIMES = STEP * np.arange(1500)
FREQUENCIES = np.geomspace(0.5, 20.0, 40)


def record() -> np.ndarray:
    random = np.random.default_rng(5)
    shape = (TIMES / 3.0) ** 2 * np.exp(2.0 - TIMES / 1.5)
    noise = np.convolve(random.normal(size=len(TIMES)), np.hanning(12), "same")
    return shape * noise


def test_the_spectrum_of_the_matched_record_is_the_target() -> None:
    a = record()
    target = np.where(FREQUENCIES > 2.0, 6.0, 3.0 * FREQUENCIES)
    got = matched(TIMES, a, FREQUENCIES, target, 0.05, 0.05)
    assert got.misfit <= 0.05
    # by another integrator, at four times the step's resolution
    fine = np.linspace(0.0, TIMES[-1], 4 * (len(TIMES) - 1) + 1)
    signal = np.interp(fine, TIMES, got.values)
    for f, wanted in list(zip(FREQUENCIES, target, strict=True))[::6]:
        w = 2.0 * np.pi * f
        _, x, _ = lsim(([w**2], [1.0, 2 * 0.05 * w, w**2]), signal, fine)
        assert np.abs(x).max() == pytest.approx(wanted, rel=0.07)
    v, d = integrated(got.values, STEP, linear=True)
    v0, d0 = integrated(a * got_factor(a, target), STEP, linear=True)
    assert abs(v[-1] - v0[-1]) < 1e-9  # wavelets leave nothing
    assert abs(d[-1] - d0[-1]) < 1e-9
    # it is still the record: most of the scaled one is in it
    assert np.corrcoef(got.values, a)[0, 1] > 0.7


def got_factor(a: np.ndarray, target: np.ndarray) -> float:
    own = spectrum(TIMES, a, FREQUENCIES, 0.05, "ACCE")
    return float(np.exp(np.mean(np.log(target / own))))


def test_a_multiple_of_the_target_s_own_record_is_scaled_alone(monkeypatch) -> None:
    monkeypatch.setattr(matching, "_adjustment", None)  # no round begins
    a = record()
    target = spectrum(TIMES, a, FREQUENCIES, 0.05, "ACCE")
    got = matched(TIMES, 3.0 * a, FREQUENCIES, target, 0.05, 1e-9)
    np.testing.assert_allclose(got.values, a, rtol=1e-12, atol=1e-12)


def test_a_wavelet_leaves_no_velocity_and_pushes_its_oscillator_at_its_instant() -> None:
    f, xi, peak = 1.3, 0.05, 7.0

    def wave(t: float) -> float:
        return float(wavelets(np.array([t]), np.array([f]), xi, np.array([peak]))[0, 0])

    width, turning = 1.178 * f**-0.93, 2.0 * np.pi * f * np.sqrt(1.0 - xi**2)
    left = np.sqrt(np.pi) * width * np.exp(-((turning * width / 2.0) ** 2))  # 1e-6 s
    assert quad(wave, 0.0, 14.0, limit=400)[0] == pytest.approx(left, rel=1e-3)
    fine = np.linspace(0.0, 14.0, 14001)
    w = 2.0 * np.pi * f
    u = wavelets(fine, np.array([f]), xi, np.array([peak]))[0]
    _, x, _ = lsim(([1.0], [1.0, 2 * xi * w, w**2]), u, fine)
    near = np.abs(fine - peak) < 0.25 / f
    assert abs(fine[near][np.abs(x[near]).argmax()] - peak) < 0.06 / f
