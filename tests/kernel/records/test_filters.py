"""Filters, base lines and directions of records against closed forms."""

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.modal.oscillator import spectrum
from ssilang.kernel.records.filters import butterworth, integrated, without_trend
from ssilang.kernel.records.signals import rotated_spectra, turned

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
