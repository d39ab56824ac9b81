"""What compiled code calls is linked into it, and made for Python only if Python calls it."""

import gc
import pickle

import numpy as np
import pytest
from numba.core import compiler, serialize, targetconfig
from together import together

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast
from ssilang.kernel.base.compiled.linked import _Options

pytestmark = pytest.mark.skipif(PLAIN, reason="plain numba compiles each function for Python")


@compiled_fast
def scaled_sum(x: FloatArray, factor: float = 2.0) -> float:
    total = 0.0
    for i in range(len(x)):
        total += factor * x[i]
    return total


@compiled
def steps(x: FloatArray, count: int) -> FloatArray:
    if count < 0:
        raise ValueError("count")
    made = np.zeros(count)
    for i in range(count):
        made[i] = scaled_sum(x, factor=3.0) + scaled_sum(x)
    return made


@compiled
def last(x: FloatArray, count: int) -> float:
    return steps(x, count)[count - 1]


def test_only_what_python_calls_is_made_for_python(monkeypatch):
    x = np.array([1.0, 2.0, 4.0])
    for function in (scaled_sum, steps, last):
        monkeypatch.setattr(function, "name", None)  # nothing is kept
        function._seen.clear()
        function._ready.clear()
    assert last(x, 3) == pytest.approx((3.0 + 2.0) * 7.0)
    assert [len(f.dispatcher.overloads) for f in (last, steps, scaled_sum)] == [1, 0, 0]
    np.testing.assert_allclose(steps(x, 2), [35.0, 35.0])
    assert [len(f.dispatcher.overloads) for f in (steps, scaled_sum)] == [1, 0]
    assert scaled_sum(x) == pytest.approx(14.0)
    assert len(scaled_sum.dispatcher.overloads) == 1


def test_refusals_of_what_is_linked_come_out_of_the_caller():
    with pytest.raises(ValueError, match="count"):
        last(np.ones(2), -1)


def test_a_compiled_function_is_the_same_after_pickling():
    assert pickle.loads(serialize.dumps(scaled_sum)) is scaled_sum


@together("collects", [True, False])
def test_compiling_leaves_the_collection_of_garbage_as_it_was(collects):
    @compiled
    def twice(x: float) -> float:
        return 2.0 * x

    was = gc.isenabled()
    (gc.enable if collects else gc.disable)()
    try:
        assert twice(2.0) == 4.0
        assert gc.isenabled() == collects
    finally:
        (gc.enable if was else gc.disable)()


def test_options_that_change_no_type_are_one_object_and_others_are_not():
    def made(**values):
        options = compiler.Flags()
        for name, value in values.items():
            setattr(options, name, value)
        return _Options(options).copy()

    assert made(nrt=True) is made(nrt=True, no_compile=True, no_cpython_wrapper=True)
    assert made(nrt=True) != made(nrt=False)
    assert made(nrt=True) != made(nrt=True, fastmath=True)
    assert isinstance(made(nrt=True), targetconfig.TargetConfig)
