"""Records brought to a target spectrum by wavelets in time.

Al Atik & Abrahamson, Earthquake Spectra 26 (2010): to the record are added tapered cosines, each
at the instant at which the oscillator of its frequency has its largest answer, with amplitudes that
are the solution of a linear system; the tapered cosine leaves neither velocity nor displacement.
The amplitudes are found by damped least squares here, and the step is halved where it does no good.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.modal.oscillator import Oscillators, rested
from ssilang.kernel.records.filters import brought_to_rest
from ssilang.kernel.records.signals import constant_step

_DAMPING = 0.1
"""Of the least squares: weight of an amplitude against that of its own misfit."""
_HALVINGS = 4
_ROUNDS = 40


@dataclass(frozen=True)
class Matched:
    """A record and how far its spectrum is from the target: largest part of the target."""

    values: FloatArray
    misfit: float


@dataclass(frozen=True)
class _Answers:
    """Largest answers (n_f,), with their signs, and their instants (n_f,)."""

    values: FloatArray
    times: FloatArray


def matched(
    times: FloatArray,
    values: FloatArray,
    frequencies: FloatArray,
    target: FloatArray,
    damping: float,
    tolerance: float,
) -> Matched:
    """The record near a given one whose spectrum is the target.

    Parameters
    ----------
    times, values : arrays (n,)
        Acceleration at a constant step; it is scaled first, by the mean ratio of the spectra.
    frequencies, target : arrays (n_f,)
        Hz, and pseudo-accelerations in the unit of the record.
    damping : float
        Fraction of critical, between 0 and 1.
    tolerance : float
        Part of the target that the largest misfit may have; the search ends there.

    Raises
    ------
    FieldError
        If the target is not positive, a frequency is above half the sampling frequency, or the
        record is zero.
    """
    step = constant_step(times)
    if not 0.0 < damping < 1.0:
        raise FieldError("kernel.records.damping-between-not", damping=damping)
    if not (target > 0.0).all():
        raise FieldError("kernel.records.target-not-positive")
    if float(frequencies.max()) >= 0.5 / step:
        raise FieldError(
            "kernel.records.target-too-fast", frequency=float(frequencies.max()), most=0.5 / step
        )
    if not values.any():
        raise FieldError("kernel.records.record-zero")
    first = _answers(times, values, frequencies, damping)
    values = values * float(np.exp(np.mean(np.log(target / np.abs(first.values)))))
    best, answers = values, _answers(times, values, frequencies, damping)
    misfit = _misfit(answers, target)
    for _ in range(_ROUNDS):
        if misfit.max() <= tolerance:
            return Matched(best, float(misfit.max()))
        move = _adjustment(times, step, frequencies, target, damping, answers)
        for halving in range(_HALVINGS):
            tried = best + move / 2.0**halving
            found = _answers(times, tried, frequencies, damping)
            other = _misfit(found, target)
            if np.sum(other**2) < np.sum(misfit**2) or other.max() < misfit.max():
                best, answers, misfit = tried, found, other
                break
        else:
            return Matched(best, float(misfit.max()))
    return Matched(best, float(misfit.max()))


def _misfit(answers: _Answers, target: FloatArray) -> FloatArray:
    return np.abs(np.abs(answers.values) / target - 1.0)


def _answers(
    times: FloatArray, values: FloatArray, frequencies: FloatArray, damping: float
) -> _Answers:
    """Largest pseudo-accelerations of oscillators, and when."""
    oscillators = Oscillators(frequencies, damping)
    t, a = rested(times, values, float(frequencies.min()))
    largest, when = np.zeros(len(frequencies)), np.full(len(frequencies), t[0])
    for time, (x, _) in zip(t, oscillators.march(t, a), strict=True):
        above = np.abs(x) > np.abs(largest)
        largest[above], when[above] = x[above], time
    return _Answers(largest * oscillators.w**2, when)


def _adjustment(
    times: FloatArray,
    step: float,
    frequencies: FloatArray,
    target: FloatArray,
    damping: float,
    answers: _Answers,
) -> FloatArray:
    """What is added to the record (n,): wavelets that close the misfit to first order."""
    waves = wavelets(times, frequencies, damping, answers.times)
    w = 2.0 * np.pi * frequencies[:, None]
    turning = w * np.sqrt(1.0 - damping**2)
    late = np.maximum(answers.times[:, None] - times, 0.0)
    pulse = w**2 / turning * np.exp(-damping * w * late) * np.sin(turning * late) * step
    missing = np.sign(answers.values) * target - answers.values
    effect = (pulse @ waves.T) / target[:, None]  # (n_f, n_f): of wavelet j on oscillator i
    own = np.abs(np.diag(effect))
    weight = _DAMPING * np.maximum(own, 1e-3 * own.max())
    rows = np.concatenate([effect, np.diag(weight)])
    amplitudes, *_ = np.linalg.lstsq(
        rows, np.concatenate([missing / target, np.zeros(len(target))]), rcond=None
    )
    # a wavelet that an end of the record cuts leaves a velocity: it is taken off
    return brought_to_rest(amplitudes @ waves, step, linear=True)


def wavelets(
    times: FloatArray, frequencies: FloatArray, damping: float, peaks: FloatArray
) -> FloatArray:
    """Tapered cosines (n_f, n) that make the oscillators answer most at given instants.

    `cos(w' s) exp(-(s / g)^2)`, s = t - peak + atan(sqrt(1 - xi^2) / xi) / w', g = 1.178 f^-0.93.
    """
    turning = 2.0 * np.pi * frequencies[:, None] * np.sqrt(1.0 - damping**2)
    delay = np.arctan(np.sqrt(1.0 - damping**2) / damping) / turning
    s = times - peaks[:, None] + delay
    return np.cos(turning * s) * np.exp(-((s / (1.178 * frequencies[:, None] ** -0.93)) ** 2))
