"""What Python hands to compiled code arrives as it is, whatever its layout."""

import sys
import threading
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled import PLAIN, UNCOMPILED, entry
from ssilang.kernel.base.compiled.compiler import compiled, compiled_threaded

pytestmark = pytest.mark.skipif(PLAIN or UNCOMPILED, reason="numba's own way in")
NUMPY = "NRT_adapt_ndarray_from_python"  # by which numba reads an array


class Law(NamedTuple):
    """A record of a number and something else."""

    stiffness: Any
    rest: Any


@compiled
def place_of_largest(x: FloatArray) -> tuple[int, float]:
    """Position, counted in C's order, and value of the largest entry."""
    best, at = -np.inf, -1
    for i, value in enumerate(x.flat):
        if value > best:
            best, at = value, i
    return at, best


@given(hnp.arrays(np.float64, hnp.array_shapes(max_dims=3), unique=True,
                  elements=st.floats(-1e9, 1e9)), st.data())  # fmt: skip
@settings(deadline=None)
def test_parts_of_arrays_are_read_as_they_lie(whole, data):
    part = whole[data.draw(hnp.basic_indices(whole.shape, allow_ellipsis=False))]
    if not isinstance(part, np.ndarray) or not part.ndim:
        return
    part.flags.writeable = data.draw(st.booleans())
    expected = (int(part.argmax()), part.max()) if part.size else (-1, -np.inf)
    assert place_of_largest(part) == expected


@compiled
def told(x: tuple) -> tuple[int, int, float, float, bool]:
    """Lengths, an entry, the number, the truth of `(Law(k, A), (flags, (n, true)), None)`."""
    law, (flags, (n, true)), _ = x
    return flags.shape[0], n, law.rest[1, 0, 2], law.stiffness, flags[1] and true


@given(st.floats(allow_nan=False), st.integers(-(2**63), 2**63 - 1), st.booleans(),
       st.sampled_from([float, np.float64]), st.sampled_from([int, np.int64]))  # fmt: skip
@settings(deadline=None)
def test_records_in_tuples_are_read_entry_by_entry(number, n, true, real, whole):
    A = np.arange(24.0).reshape(2, 3, 4)
    given = (Law(real(number), A), (np.array([False, True, False]), (whole(n), true)), None)
    assert told(given) == (3, n, A[1, 0, 2], number, true)


@pytest.mark.parametrize("n", [2**63, -(2**63) - 1, 10**30])
def test_a_number_of_more_than_64_bits_is_refused(n):
    given = (Law(1.0, np.zeros((2, 1, 3))), (np.array([False, True]), (n, True)), None)
    with pytest.raises(OverflowError):
        told(given)


@compiled
def doubled(x: FloatArray, good: bool) -> FloatArray:
    if not good:
        raise ValueError("bad")
    return x * 2.0


@compiled
def total_of_copies(x: FloatArray, good: bool) -> float:
    """Makes arrays, and parts of those that it gets."""
    made = doubled(x, good)
    rest = x[1:]
    return made.sum() + rest.sum()


def test_nothing_holds_an_array_after_a_call_that_made_others_of_it():
    x = np.array([1.0, 2.0, 3.0])
    held = sys.getrefcount(x)
    for _ in range(3):
        assert total_of_copies(x, True) == 17.0
        with pytest.raises(ValueError, match="bad"):
            total_of_copies(x, False)
    assert sys.getrefcount(x) == held


def needs(function, *values):
    code, ready = function.dispatcher.made(tuple(numba.typeof(value) for value in values))
    return code.needs, ready.call(*values)


def test_arrays_that_come_back_go_numba_s_way(monkeypatch):
    x = np.array([1.0, 2.0])
    used, made = needs(doubled, x, True)
    assert NUMPY in used
    np.testing.assert_array_equal(made, [2.0, 4.0])


@pytest.mark.parametrize("known", [True, False])
def test_a_layout_that_is_not_numpy_s_goes_numba_s_way(monkeypatch, known):
    @compiled
    def first(x: FloatArray) -> float:
        return x[0]

    assert entry.is_layout_known()
    monkeypatch.setattr(entry, "is_layout_known", lambda: known)
    used, found = needs(first, np.array([4.0, 5.0]))
    assert found == 4.0
    assert (NUMPY in used) is not known


@compiled_threaded
def sum_until(x: FloatArray, stop: np.ndarray) -> float:
    """Waits for another thread to say so; were nothing written, `stop` would be read once."""
    turns = 0
    while stop[0] == 0 and turns < 2_000_000_000:
        turns += 1
        x[turns % len(x)] += 1.0
    return x[0] if stop[0] else np.nan


def test_other_threads_run_while_a_threaded_function_does():
    x, stop = np.ones(8), np.zeros(1, np.int64)
    sum_until(x, np.ones(1, np.int64))  # compiled
    timer = threading.Timer(0.05, stop.__setitem__, (0, 1))
    timer.start()
    assert sum_until(x, stop) > 0.0
    timer.join()
