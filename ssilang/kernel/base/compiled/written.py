"""Functions whose machine code is written in LLVM's form, for compiled callers.

A function marked `written` says in Python what it does, which is what runs without compilation. Its
code is written by the function of the same name in another module, that is imported only where
something is compiled, and goes into the caller.
"""

# mypy: allow-untyped-calls

import functools
import importlib
from collections.abc import Callable
from typing import Any, TypeVar, cast

from ssilang.kernel.base.compiled import UNCOMPILED

Function = TypeVar("Function", bound=Callable[..., Any])


class Written:
    """A function with its writer, `write(builder, *arguments)`; it returns nothing.

    The writer gets of each argument LLVM's value: a number, or the address of an array's first.
    """

    def __init__(self, function: Callable[..., Any], module: str) -> None:
        functools.update_wrapper(self, function)
        self.py_func, self.module = function, module

    def __call__(self, *args: Any) -> None:
        self.py_func(*args)

    @functools.cached_property
    def _numba_type_(self) -> Any:
        """Read by numba where compiled code names the function."""
        from numba.core import types

        from ssilang.kernel.base.compiled.calls import intrinsic

        write = getattr(importlib.import_module(self.module), self.py_func.__name__)

        def code(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            plain = [
                context.make_array(kind)(context, builder, value).data
                if isinstance(kind, types.Array)
                else context.cast(builder, value, kind, types.int64)
                for kind, value in zip(sig.args, args, strict=True)
            ]
            write(builder, *plain)
            return context.get_dummy_value()

        return intrinsic(self, types.none, code)


def written(module: str) -> Callable[[Function], Function]:
    """Mark a function whose code a module of the kernel writes."""

    def mark(function: Function) -> Function:
        return function if UNCOMPILED else cast(Function, Written(function, module))

    return mark
