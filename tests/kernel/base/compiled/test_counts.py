"""Functions compiled without counts of references make no arrays and hand none back."""

import dis
import importlib
import itertools
import pkgutil
import sys
from types import UnionType
from typing import get_args, get_origin, get_type_hints

import numpy as np
import pytest
from together import together

import ssilang.kernel
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.apart import Apart
from ssilang.kernel.base.compiled.compiler import Compiled, compiled, counts
from ssilang.kernel.base.compiled.kinds import RESULTS
from ssilang.kernel.stepping.newmark import Newmark, Quantity
from ssilang.kernel.stepping.state import Motion

OF_SCALARS = {
    "ceil", "cos", "inf", "isfinite", "isnan", "nan", "pi", "sign", "sin", "sqrt", "int32", "int64",
    "bool_",
}  # fmt: skip


def dispatchers():
    """Compiled functions of the kernel."""
    found = {}
    for module in pkgutil.walk_packages(ssilang.kernel.__path__, "ssilang.kernel."):
        for value in vars(importlib.import_module(module.name)).values():
            made = getattr(value, "function", value)
            if isinstance(made, Compiled):
                found[made.py_func] = made.dispatcher
    return found


def uncounted():
    return [f for f, d in dispatchers().items() if not d.targetoptions["_nrt"]]


def gives_numbers(function):
    return holds_numbers(get_type_hints(function)["return"])


def holds_numbers(kind):
    if get_origin(kind) in (tuple, UnionType):
        return all(map(holds_numbers, get_args(kind)))
    if hasattr(kind, "_fields"):
        return all(map(holds_numbers, get_type_hints(kind).values()))
    return kind in (type(None), bool, int, float, Quantity)


@pytest.mark.skipif(PLAIN, reason="plain numba counts everywhere")
def test_most_functions_of_the_kernel_are_compiled_without_counts():
    assert len(uncounted()) > 0.5 * len(dispatchers())


def test_uncounted_functions_take_scalars_from_numpy_and_from_what_they_call():
    for function in uncounted():
        assert gives_numbers(function), function
        instructions = list(dis.get_instructions(function))
        for here, there in itertools.pairwise(instructions):
            if here.opname == "LOAD_GLOBAL" and here.argval == "np":
                assert there.argval in OF_SCALARS, (function, there.argval)
            called = function.__globals__.get(here.argval) if here.opname == "LOAD_GLOBAL" else None
            if hasattr(called, "py_func"):
                assert gives_numbers(called.py_func), (function, called)


@together("result, text, counted", [
        (None, "None", False), (int, "int", False), (tuple[int, float], "tuple[int, float]", False),
        (Newmark, "Newmark", False), (Motion, "Motion", True), (FloatArray, "FloatArray", True),
    ])  # fmt: skip
def test_results_written_as_types_count_as_those_written_as_text(result, text, counted):
    def function():
        raise AssertionError

    for annotation in (result, text):
        function.__annotations__["return"] = annotation
        assert counts(function) is counted
        if text in RESULTS and not PLAIN:
            assert Apart(compiled(function)).result == text


@compiled
def rows_sum(A: FloatArray) -> float:
    total = 0.0
    for i in range(len(A)):
        row = A[i]
        for j in range(len(row)):
            total += row[j]
    return total


@compiled
def sum_of_square(A: FloatArray) -> float:
    flat = A.reshape(6)
    square, total = flat[2:6].reshape((2, 2)), 0.0
    for i in range(2):
        for j in range(2):
            total += square[i, j]
    return total + flat[0] + flat[1]


@compiled
def row_of(A: FloatArray, i: int) -> FloatArray:
    return A[i]


@compiled
def sums_of_rows(A: FloatArray) -> FloatArray:
    found = np.zeros(len(A))
    for i in range(len(A)):
        row = row_of(A, i)
        for j in range(len(row)):
            found[i] += row[j]
    return found


@together("function", [rows_sum, sum_of_square, sums_of_rows])
def test_arrays_that_compiled_code_has_seen_are_freed(function):
    A = np.arange(6.0).reshape(2, 3)
    before = sys.getrefcount(A)
    for _ in range(3):
        np.testing.assert_allclose(np.sum(function(A)), 15.0)
    assert sys.getrefcount(A) == before


def test_a_row_handed_back_holds_its_array():
    A = np.arange(6.0).reshape(2, 3)
    row = row_of(A, 1)
    del A
    np.testing.assert_array_equal(row, [3.0, 4.0, 5.0])
