"""Compiled functions that their compiled callers reach by address.

Numba links the code of all that a function calls into it, optimises the whole once more and
translates it once more: compiling then grows with the depth of calls. A function marked `apart` is
compiled by itself, when it is first called, and found in its callers' code by its address. Cold
branches therefore cost nothing before a run enters them. A call costs a few nanoseconds more, and
nothing of the function is inlined.

A caller holds a place for the address, empty at first. It is filled by `_resolve`, the only symbol
that compiled code must find: kept code stays good in the next process.
"""

# mypy: allow-untyped-calls

from __future__ import annotations

import ctypes
import functools
import importlib
import inspect
import pickle
import sys
from collections.abc import Callable
from typing import Any, TypeVar, cast

import llvmlite.binding as llvm
import numba
from llvmlite import ir
from numba.core import cgutils, imputils, types
from numba.core.typing.templates import infer, infer_global, make_intrinsic_template, signature

from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.beside import BESIDE, title
from ssilang.kernel.base.compiled.compiler import compiled

Function = TypeVar("Function", bound=Callable[..., Any])

SYMBOL = "ssilang_resolve"
STOPPED = 1  # no address
RESULTS = {
    "None": types.none,
    "bool": types.boolean,
    "int": types.int64,
    "float": types.float64,
    "tuple[int, float]": types.Tuple((types.int64, types.float64)),
    "tuple[float, float]": types.UniTuple(types.float64, 2),
}
"""Types of results by annotation: a caller is compiled before the function is."""


class Apart:
    """A compiled function; called from Python as any other, from compiled code by its address."""

    def __init__(self, dispatcher: Any, expected: bool = True) -> None:
        functools.update_wrapper(self, dispatcher)
        self.name: str = dispatcher.py_func.__qualname__
        self.dispatcher, self.expected = dispatcher, expected
        self.py_func = dispatcher.py_func
        self.result = RESULTS[self.py_func.__annotations__["return"]]
        dispatcher.targetoptions["no_cpython_wrapper"] = True  # half of what is compiled for some
        self._face: Callable[..., Any] | None = None

    def __call__(self, *args: Any) -> Any:
        if self._face is None:
            self._face = _face_of(self)
        return self._face(*args)

    def __deepcopy__(self, memo: dict[int, Any]) -> Apart:
        return self

    def __reduce__(self) -> str:
        return self.name

    def compile(self, args: tuple[types.Type, ...]) -> None:
        """Make or load the code for these types."""
        self.dispatcher.compile(args)

    def address(self, args: tuple[types.Type, ...]) -> int:
        """Address of the code for these types, compiled now if it is not yet.

        Raises
        ------
        TypeError
            If the function does not return what its annotation says.
        """
        self.compile(args)
        made = self.dispatcher.overloads[args]
        if made.signature.return_type != self.result:
            found = made.signature.return_type
            raise TypeError(f"{self.name} returns {found}, not {self.result}")
        return int(made.library.get_pointer_to_function(made.fndesc.llvm_func_name))


def apart(function: Function) -> Function:
    """Keep a compiled function out of the code of its callers; written above `@compiled`.

    Without compilation (NUMBA_DISABLE_JIT=1), or by plain numba alone, it stays what it is.
    """
    return _made(function, True)


def seldom(function: Function) -> Function:
    """As `apart`, for one of several that few runs enter: a second process does not compile it."""
    return _made(function, False)


def _made(function: Function, expected: bool) -> Function:
    if PLAIN or numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    made = Apart(function, expected)
    template = make_intrinsic_template(made, _typing_of(made), made.name)
    infer(template)
    infer_global(made, types.Function(template))
    return cast(Function, made)


def _face_of(function: Apart) -> Callable[..., Any]:
    """What Python calls: few runs need it, so it is compiled for these."""

    def face(*args):  # type: ignore[no-untyped-def]
        return function(*args)

    face.__module__ = __name__
    return compiled(face)


def _typing_of(function: Apart) -> Callable[..., Any]:
    """What numba asks of an intrinsic: signature and code of a call, from types of arguments."""

    def typed(context: Any, *args: types.Type) -> tuple[Any, Any]:
        # a literal would be a type, and code, of its own
        plain = signature(function.result, *(types.unliteral(a) for a in args))
        return plain, functools.partial(_call, function)

    shown = inspect.signature(function.py_func)
    first = inspect.Parameter("context", inspect.Parameter.POSITIONAL_ONLY)
    plain = [p.replace(kind=p.POSITIONAL_ONLY) for p in shown.parameters.values()]
    typed.__signature__ = inspect.Signature([first, *plain])  # type: ignore[attr-defined]
    return typed


def _call(function: Apart, context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Code of a call: the address from its place, or from `_resolve`, then the call."""
    conv, int64 = context.call_conv, ir.IntType(64)
    name = f"{function.__module__}.{function.name}"
    wanted = pickle.dumps((function.__module__, function.name, sig.args))
    if function.expected and sig.args not in function.dispatcher.overloads:
        BESIDE.tell(title(function.__module__, function.name, sig.args), wanted)
    place = cgutils.add_global_variable(builder.module, int64, f"address of {name}{sig.args}")
    place.linkage, place.initializer = "internal", int64(0)
    with cgutils.if_unlikely(builder, cgutils.is_null(builder, builder.load(place))):
        text = cgutils.global_constant(builder, f"name of {name}", cgutils.make_bytearray(wanted))
        kind = ir.FunctionType(int64, [cgutils.voidptr_t, int64])
        resolve = cgutils.get_or_insert_function(builder.module, kind, SYMBOL)
        at = builder.bitcast(text, cgutils.voidptr_t)
        found = builder.call(resolve, [at, int64(len(wanted))])
        with cgutils.if_unlikely(builder, cgutils.is_null(builder, found)):
            conv.return_user_exc(builder, RuntimeError, (f"{name} could not be compiled",))
        with cgutils.if_unlikely(builder, builder.icmp_unsigned("==", found, int64(STOPPED))):
            conv.return_user_exc(builder, KeyboardInterrupt, ())
        builder.store(found, place)
    kind = conv.get_function_type(sig.return_type, sig.args)
    code = builder.inttoptr(builder.load(place), kind.as_pointer())
    status, result = conv.call_function(builder, code, sig.return_type, sig.args, args)
    with cgutils.if_unlikely(builder, status.is_error):
        conv.return_status_propagate(builder, status)
    if sig.return_type == types.none:
        return context.get_dummy_value()
    return imputils.impl_ret_new_ref(context, builder, sig.return_type, result)


def _resolve(text: int, size: int) -> int:
    """Address of a function by its pickled module, name and types of arguments.

    0 if it cannot be compiled (the reason is shown), `STOPPED` if someone interrupts.
    """
    try:
        module, name, args = pickle.loads(ctypes.string_at(text, size))
        return int(getattr(importlib.import_module(module), name).address(args))
    except KeyboardInterrupt:
        return STOPPED
    except Exception:
        sys.excepthook(*sys.exc_info())
        return 0


_RESOLVE = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64)(_resolve)
llvm.add_symbol(SYMBOL, cast(int, ctypes.cast(_RESOLVE, ctypes.c_void_p).value))
