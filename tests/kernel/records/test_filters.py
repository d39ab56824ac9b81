"""Transforms, filters, base lines and directions of records, envelopes: against closed forms."""

from itertools import pairwise

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.modal.oscillator import spectrum
from ssilang.kernel.records.filters import butterworth, integrated, without_trend
from ssilang.kernel.records.signals import (
    energy_envelope,
    fourier,
    inverse_fourier,
    inverse_laplace,
    mean_shock,
    rotated_spectra,
    turned,
)

STEP = 0.01
TIMES = STEP * np.arange(6000)
MIDDLE = slice(2500, 3500)
PERCENTILES = np.array([0.0, 50.0, 100.0])


def gain(f: float, corner: float, order: int, high_pass: bool) -> float:
    """Butterworth's |H| after the bilinear transformation."""
    ratio = np.tan(np.pi * f * STEP) / np.tan(np.pi * corner * STEP)
    return float(1.0 / np.sqrt(1.0 + (1.0 / ratio if high_pass else ratio) ** (2 * order)))


@together("causal", [True, False])
@together("f", [0.5, 1.0, 3.0])
def test_a_sine_keeps_the_part_that_both_corners_leave(f: float, causal: bool) -> None:
    sine = np.sin(2.0 * np.pi * f * TIMES)
    got = butterworth(sine, STEP, 3, 0.6, 2.5, causal=causal)[MIDDLE]
    part = gain(f, 0.6, 3, True) * gain(f, 2.5, 3, False)
    wanted = part if causal else part**2
    cos = 2.0 * np.mean(got * np.cos(2.0 * np.pi * f * TIMES[MIDDLE]))
    sin = 2.0 * np.mean(got * sine[MIDDLE])
    assert np.hypot(cos, sin) == pytest.approx(wanted, rel=1e-4)
    assert (abs(cos) < 1e-4 * sin) != causal  # the phase


def test_a_causal_filter_moves_nothing_before_its_cause() -> None:
    pulse = np.zeros(400)
    pulse[200] = 1.0
    assert not butterworth(pulse, STEP, 4, 0.5, None, causal=True)[:200].any()
    there = butterworth(pulse, STEP, 4, 0.5, None, causal=False)
    np.testing.assert_allclose(there[1:200], there[:200:-1], atol=1e-6)


@together("rule", [True, False])
def test_a_polynomial_goes_and_what_has_none_stays(rule: bool) -> None:
    t = TIMES[:1001]
    drift = 0.3 - 0.2 * t + 0.05 * t**2
    assert np.abs(without_trend(drift, STEP, 3, linear=True)).max() < 1e-10
    swing = np.sin(2.0 * np.pi * t / t[-1] * 3.0)
    left = without_trend(swing + drift, STEP, 3, rule)
    np.testing.assert_allclose(left, without_trend(swing, STEP, 3, rule), atol=1e-4)
    v, _ = integrated(left, STEP, rule)
    for power in (1, 2, 3):  # least squares: what is left has nothing of the polynomial
        assert abs(np.mean(v * (t / t[-1]) ** power)) < 2e-5


def test_one_component_over_all_directions() -> None:
    a = np.exp(-TIMES[:800]) * np.sin(9.0 * TIMES[:800])
    f = np.array([0.7, 1.5, 4.0])
    for kind in ("ACCE", "DEPL", "ACCA"):
        own = spectrum(TIMES[:800], a, f, 0.05, kind)
        # of u cos(angle), angles spread evenly over a half turn: 0, 1/sqrt(2), 1 of the largest
        got = rotated_spectra(TIMES[:800], a, 0.0 * a, f, 0.05, kind, PERCENTILES)
        np.testing.assert_allclose(got[1], own * np.sqrt(0.5), rtol=1e-3)
        np.testing.assert_allclose(got[2], own, rtol=1e-12)
        assert (got[0] < 1e-12 * own).all()


def test_a_circle_is_the_same_in_all_directions_and_axes_change_no_percentile() -> None:
    t = TIMES[:1500]
    x, y = np.cos(8.0 * t), np.sin(8.0 * t)
    f = np.array([8.0 / (2.0 * np.pi)])
    low, middle, high = rotated_spectra(t, x, y, f, 0.2, "DEPL", PERCENTILES)[:, 0]
    assert low == pytest.approx(high, rel=0.02)  # resonance: 1/(2 xi w^2)
    assert middle == pytest.approx(1.0 / (2 * 0.2 * 64.0), rel=0.02)
    other = turned(x, y, 30.0)
    got = rotated_spectra(t, *other, f, 0.2, "DEPL", PERCENTILES)[:, 0]
    np.testing.assert_allclose(got, [low, middle, high], rtol=1e-12)  # whole degrees
    np.testing.assert_allclose(other[0], np.cos(8.0 * t - np.pi / 6.0), atol=1e-12)


def test_what_no_filter_is_is_refused() -> None:
    for order, low, high, code in (
        (0, 1.0, None, "filter-order"), (13, 1.0, None, "filter-order"),
        (4, 60.0, None, "filter-corner"), (4, 50.0, None, "filter-corner"),
        (4, 0.0, 1.0, "filter-corner"), (4, None, 0.0, "filter-corner"),
        (4, None, -1.0, "filter-corner"), (4, 2.0, 1.0, "filter-corners-cross"),
        (4, 2.0, 2.0, "filter-corners-cross"),
    ):  # fmt: skip
        with refusal(FieldError, f"kernel.records.{code}"):
            butterworth(np.ones(50), STEP, order, low, high, causal=True)
    with pytest.raises(FieldError):
        without_trend(np.ones(50), STEP, 7)
    with pytest.raises(FieldError):
        rotated_spectra(TIMES, TIMES, TIMES, np.ones(1), 0.05, "ACCE", np.array([101.0]))


def test_transform_of_a_gaussian_is_a_gaussian():
    t = np.arange(1024) * 0.01
    f, values = fourier(np.exp(-np.pi * (t - 5) ** 2), 0.01, 1024)
    # the continuous transform: exp(-pi f^2), delayed by 5
    np.testing.assert_allclose(values, np.exp(-np.pi * f**2 - 10j * np.pi * f), atol=1e-12)


def test_inverse_needs_two_frequencies():
    code = "kernel.records.signal-needs-two-points"
    with pytest.raises(FieldError, check=lambda e: e.code == code):
        inverse_fourier(np.array([0.0]), np.array([1.0 + 0j]))


T = np.arange(12.0) * 0.5


@together("first", [1, 2, 3])
def test_shocks_are_found_wherever_they_begin(first):
    y = np.zeros(12)
    y[first : first + 3] = [4.0, -2.0, 1.0]
    y[first + 5 : first + 7] = [-3.0, 6.0]
    y[first - 1] = 2.0
    t, mean = mean_shock(T, y, 40.0, 1.0, None)  # above 2.4: at `first` and five samples later
    np.testing.assert_allclose(t, [0.0, 0.5, 1.0])
    np.testing.assert_allclose(mean, [(4 - 3) / 2, (-2 + 6) / 2, (1 + 0) / 2])


@together("rest", [[5.0, 5.0, 0.0, 0.0], [5.0, 0.0], [0.0]])
def test_a_shock_longer_than_its_recording_is_one(rest):
    y = np.pad([0.0, 5.0, 5.0, *rest, 3.0, 3.0], (0, 7 - len(rest)))
    _, mean = mean_shock(T, y, 50.0, 0.5, None)
    np.testing.assert_allclose(mean, [4.0, 4.0])
    _, mean = mean_shock(T, y, 50.0, 0.5, 1)
    np.testing.assert_allclose(mean, [5.0, 5.0])


@together("percent", [50.0, 99.0])
def test_a_shock_that_the_record_cuts_does_not_count(percent):
    y = np.zeros(12)
    y[11] = 1.0
    with refusal(FieldError, "kernel.records.record-no-whole-shock"):
        mean_shock(T, y, percent, 1.0, None)
    y[9] = 1.0
    with pytest.raises(FieldError):
        mean_shock(T, y, percent, 1.5, None)


def test_an_envelope_has_the_energy_of_the_signal_on_each_interval():
    rng = np.random.default_rng(4)
    x = np.linspace(0.0, 3.0, 301)
    y = rng.standard_normal(301) * np.exp(-((x - 1.0) ** 2))
    places, values = energy_envelope(x, y, 10)
    assert (values >= 0.0).all()
    assert places[0] == x[0]
    assert places[-1] == x[-1]
    line = np.interp(x, places, values)
    ends = np.searchsorted(x, places)
    assert len(ends) > 11  # some are shortened
    assert set(range(0, 301, 30)) <= set(ends.tolist())
    for begin, end in pairwise(ends):
        part = slice(begin + 1, end + 1)
        assert np.sum(line[part] ** 2) == pytest.approx(np.sum(y[part] ** 2), rel=1e-9)


@together("size", [1.0, 0.1, 0.3, 0.7, 1.1])
def test_a_line_that_falls_to_nought_is_its_own_envelope(size):
    x = np.arange(4.0)
    places, values = energy_envelope(x, size * (3.0 - x), 1)
    assert places.tolist() == [0.0, 3.0]
    np.testing.assert_allclose(values, [3.0 * size, 0.0], atol=1e-7)


@together("times, duration", [(T, 0.0), (T, -1.0), (np.zeros(12), 1.0)])
def test_a_recording_has_a_duration_and_a_step(times, duration):
    with refusal(FieldError, "kernel.records.recording-time-shock-must"):
        mean_shock(times, np.ones(12), 50.0, duration, None)


@together("step", [0.01, 1.0, 100.0])
def test_frequencies_of_a_laplace_transform_have_one_step(step):
    """The step is the same within a ten thousandth of itself."""
    omega = step * np.arange(8.0)
    values = 1.0 / (0.5 * step + 1j * omega)
    for share, sound in ((0.5e-4, True), (2e-4, False)):
        bent = omega.copy()
        bent[-1] += share * step
        if sound:
            inverse_laplace(bent, values, 0.5 * step, 2)
            continue
        with refusal(FieldError, "kernel.records.frequencies-begin-constant-step"):
            inverse_laplace(bent, values, 0.5 * step, 2)
