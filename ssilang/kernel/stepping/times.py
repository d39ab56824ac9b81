"""When a calculation steps and what it keeps: runs of equal steps, saved steps."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError

SAME = 1e-9  # relative difference of steps that share a factor: rounding of a list of times


@dataclass(frozen=True)
class Run:
    """Steps `first` ... `last - 1`, all of length dt; step i ends at times[i + 1]."""

    first: int
    last: int
    dt: float


def runs_of(times: FloatArray, longest: int) -> Iterator[Run]:
    """Runs of steps of the same length, at most `longest` steps each."""
    steps = np.diff(times)
    known: list[float] = []
    start = 0
    while start < len(steps):
        dt = next((k for k in known if abs(k - steps[start]) <= SAME * k), float(steps[start]))
        if dt not in known:
            known.append(dt)
        part = steps[start : start + longest]
        stop = start + len(part)
        if not (part.max() - dt <= SAME * dt and dt - part.min() <= SAME * dt):
            stop = start + int(np.argmax(np.abs(part - dt) > SAME * dt))
        yield Run(start, stop, dt)
        start = stop


def every(times: FloatArray, cadence: int) -> NDArray[np.bool_]:
    """Steps saved one in `cadence`, the first and the last always; shape (n_times,)."""
    if cadence < 1:
        raise KernelError("kernel.stepping.step-cannot-saved", cadence=cadence)
    chosen = np.zeros(len(times), bool)
    chosen[::cadence] = True
    chosen[-1] = True
    return chosen


def nearest(times: FloatArray, wanted: FloatArray) -> NDArray[np.bool_]:
    """Steps nearest to the times wanted; shape (n_times,).

    Raises
    ------
    KernelError
        If a time wanted lies outside the calculation.
    """
    chosen = np.zeros(len(times), bool)
    for t in wanted:
        at = int(np.argmin(np.abs(times - t)))
        slack = 0.5 * float(np.diff(times).max())
        if abs(times[at] - t) > slack * (1 + SAME):
            raise KernelError(
                "kernel.stepping.time-save-lies-outside", t=t, times=times[0], times_2=times[-1]
            )
        chosen[at] = True
    return chosen
