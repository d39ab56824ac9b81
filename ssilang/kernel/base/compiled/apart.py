"""Compiled functions that their compiled callers reach by address.

Numba links the code of all that a function calls into it, optimises the whole once more and
translates it once more: compiling then grows with the depth of calls. A function marked `apart` is
compiled by itself, when it is first called, and found in its callers' code by its address. Cold
branches therefore cost nothing before a run enters them. A call costs a few nanoseconds more, and
nothing of the function is inlined.

A caller holds a place for the address, empty at first. It is filled by `_resolve`, the only symbol
that compiled code must find: kept code stays good in the next process. How callers are compiled
stands in `calls`.
"""

# mypy: allow-untyped-calls

import ctypes
import functools
import importlib
import pickle
import sys
from collections.abc import Callable
from typing import Any, TypeVar, cast

import llvmlite.binding as llvm

from ssilang.kernel.base.compiled import PLAIN, UNCOMPILED
from ssilang.kernel.base.compiled.compiler import Compiled, Types, compiled, written
from ssilang.kernel.base.compiled.kinds import RESULTS
from ssilang.kernel.base.compiled.machine import STOPPED, SYMBOL, Ready

Function = TypeVar("Function", bound=Callable[..., Any])


class Apart:
    """A compiled function; called from Python as any other, from compiled code by its address."""

    def __init__(self, function: Compiled, expected: bool = True, later: bool = False) -> None:
        functools.update_wrapper(self, function)
        self.name: str = function.py_func.__qualname__
        self.function, self.expected, self.later = function, expected, later
        self.py_func = function.py_func
        self.result = written(self.py_func.__annotations__["return"])
        function.options["no_cpython_wrapper"] = True  # half of what is compiled for some

    def __call__(self, *args: Any) -> Any:
        return self._face(*args)

    @functools.cached_property
    def _face(self) -> Callable[..., Any]:
        """What Python calls: few runs need it, so it is compiled for these."""

        def face(*args):  # type: ignore[no-untyped-def]
            return self(*args)

        face.__module__ = self.py_func.__module__
        made = cast(Compiled, compiled(face))
        made.name = f"{self.name}.face"  # what it closes over
        return made

    @property
    def _numba_type_(self) -> Any:
        """Read by numba where compiled code names the function."""
        from ssilang.kernel.base.compiled.calls import type_of

        return type_of(self)

    def __deepcopy__(self, memo: dict[int, Any]) -> "Apart":
        return self

    def __reduce__(self) -> str:
        return self.name

    def ready(self, words: str, types: Callable[[], Types]) -> Ready | None:
        """As `Compiled.ready`."""
        return self.function.ready(words, types)

    def address(self, words: str, types: Callable[[], Types]) -> int:
        """Address of the code for kinds of arguments, compiled now if it is not yet.

        Raises
        ------
        TypeError
            If the function does not return what its annotation says.
        """
        ready = self.ready(words, types)
        assert ready is not None
        expected = RESULTS[self.result]
        if ready.result != expected:
            raise TypeError(f"{self.name} returns {ready.result}, not {expected}")
        return ready.address


def apart(function: Function) -> Function:
    """Keep a compiled function out of the code of its callers; written above `@compiled`.

    Without compilation (NUMBA_DISABLE_JIT=1), or by plain numba alone, it stays what it is.
    """
    return _made(function)


def later(function: Function) -> Function:
    """As `apart`, for one that first steps do without: a second process takes it last."""
    return _made(function, later=True)


def seldom(function: Function) -> Function:
    """As `apart`, for one of several that few runs enter: a second process is not told of it here.

    `beside.tell_more` does where a model shows that it is entered.
    """
    return _made(function, expected=False)


def _made(function: Function, expected: bool = True, later: bool = False) -> Function:
    if PLAIN or UNCOMPILED:
        return function
    return cast(Function, Apart(cast(Compiled, function), expected, later))


def _resolve(text: int, size: int) -> int:
    """Address of a function by its `beside.task_of`.

    0 if it cannot be compiled (the reason is shown), `STOPPED` if someone interrupts.
    """
    try:
        module, name, words, types, _ = pickle.loads(ctypes.string_at(text, size))
        function = getattr(importlib.import_module(module), name)
        return int(function.address(words, lambda: pickle.loads(types)))
    except KeyboardInterrupt:
        return STOPPED
    except Exception as error:
        sys.excepthook(type(error), error, error.__traceback__)
        return 0


_RESOLVE = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64)(_resolve)
llvm.add_symbol(SYMBOL, cast(int, ctypes.cast(_RESOLVE, ctypes.c_void_p).value))
