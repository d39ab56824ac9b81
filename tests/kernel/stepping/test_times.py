"""Runs of equal steps, saved steps."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.stepping.times import every, nearest, runs_of


def test_runs_share_a_step_and_are_cut_at_the_longest():
    times = np.concatenate([np.arange(11) * 0.1, 1.0 + np.arange(1, 4) * 0.05, [2.0]])
    found = [(r.first, r.last, round(r.dt, 12)) for r in runs_of(times, 6)]
    assert found == [(0, 6, 0.1), (6, 10, 0.1), (10, 13, 0.05), (13, 14, 0.85)]


def test_rounded_times_are_one_run():
    times = np.arange(100001) * 1e-3
    assert [(r.first, r.last) for r in runs_of(times, 10**9)] == [(0, 100000)]


def test_a_step_that_comes_back_is_the_same_number():
    """Factors are kept by the step's length: one that differs by rounding would be made anew."""
    times = np.concatenate([[0.0], np.cumsum([0.1, 0.1, 0.3, 0.1 * (1 + 1e-13), 0.3])])
    steps = [r.dt for r in runs_of(times, 10)]
    assert len(steps) == 4
    assert steps[2] == steps[0]
    assert steps[3] == steps[1]


def test_saved_steps():
    times = np.linspace(0, 1, 11)
    assert np.flatnonzero(every(times, 4)).tolist() == [0, 4, 8, 10]
    assert np.flatnonzero(nearest(times, np.array([0.31, 1.0]))).tolist() == [3, 10]
    with pytest.raises(KernelError, match="outside"):
        nearest(times, np.array([1.2]))
    times = np.array([0.0, 0.1, 0.2, 0.5, 0.75])  # half of the largest step beyond the ends
    found = nearest(times, np.array([0.9 + 1e-12, 0.34, -0.15, 0.36]))
    assert np.flatnonzero(found).tolist() == [0, 2, 3, 4]
    for outside in (0.91, -0.16):
        with pytest.raises(KernelError, match="outside"):
            nearest(times, np.array([outside]))
    with pytest.raises(KernelError, check=lambda e: e.code == "kernel.stepping.step-cannot-saved"):
        every(times, 0)
