"""The way into compiled code from Python, as little code as it can be.

Numba asks numpy for each array of the arguments, counts who holds it and checks each answer: for a
time loop, with a hundred arrays in its records, that is a third of what is compiled. Who calls is
known here (`compiler.Compiled`): it tells the kinds of all values before, and holds them meanwhile.
So what an array is gets read where numpy keeps it, as what it keeps there is part of its interface
to C, and nothing is counted.
"""

# mypy: allow-untyped-calls

from __future__ import annotations

import ctypes
from functools import cache
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.callwrapper import PyCallWrapper
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering

from ssilang.kernel.base.compiled import UNTRIED

WORD = ctypes.sizeof(ctypes.c_void_p)
DATA = object.__basicsize__  # of numpy's PyArrayObject: address, number and lengths of indices
SHAPE, STRIDES = DATA + 2 * WORD, DATA + 3 * WORD
FIRST = tuple.__basicsize__  # entry of a tuple
NUMBERS = (types.float64, types.int64, types.boolean, types.none)
ITEMS = types.number_domain | {types.boolean}
INT64 = ir.IntType(64)
POINTER = ir.IntType(8).as_pointer()


class _Entry(PyCallWrapper):
    """A function that Python calls with the tuple of its arguments."""

    def build_wrapper(self, api: Any, builder: Any, closure: Any, args: Any, kws: Any) -> None:
        """Write it; numba's own way where arguments are of other kinds or arrays come back."""
        kinds, result = self.fndesc.argtypes, self.fndesc.restype
        if not (is_layout_known() and all(map(is_read, kinds)) and is_number(result)):
            super().build_wrapper(api, builder, closure, args, kws)
            return
        environment = self.get_env(api, builder)
        values = _Reader(self.context, builder, api).entries(args, kinds)
        thread = api.save_thread() if self.release_gil else None
        conv = self.context.call_conv
        status, value = conv.call_function(
            builder, self.func, result, kinds, values, attrs=("noinline",)
        )
        if thread is not None:
            api.restore_thread(thread)
        with builder.if_then(status.is_ok, likely=True):
            with builder.if_then(status.is_none):
                api.return_none()
            builder.ret(api.from_native_return(result, value, environment))
        conv.raise_error(builder, api, status)
        builder.ret(api.get_null_object())


class _Reader:
    """Values of Python as compiled code holds them."""

    def __init__(self, context: Any, builder: Any, api: Any) -> None:
        self.context, self.builder, self.api = context, builder, api

    def entries(self, record: Any, kinds: Any) -> list[Any]:
        """Of a tuple."""
        at = (FIRST + WORD * i for i in range(len(kinds)))
        return [
            self.value(self.load(record, offset, POINTER), kind)
            for offset, kind in zip(at, kinds, strict=True)
        ]

    def value(self, held: Any, kind: Any) -> Any:
        """Of one object."""
        builder, api = self.builder, self.api
        if isinstance(kind, types.Array):
            return self.array(held, kind)
        if isinstance(kind, types.BaseTuple):
            return self.context.make_tuple(builder, kind, self.entries(held, _kinds(kind)))
        if kind == types.float64:
            return api.float_as_double(held)
        if kind == types.boolean:
            return builder.icmp_signed("!=", api.object_istrue(held), ir.IntType(32)(0))
        if kind == types.none:
            return self.context.get_dummy_value()
        number = api.long_as_longlong(held)  # beyond 64 bits there is an error
        told = builder.icmp_signed("==", number, INT64(-1))
        with (
            builder.if_then(told, likely=False),
            builder.if_then(cgutils.is_not_null(builder, api.err_occurred())),
        ):
            builder.ret(api.get_null_object())
        return number

    def array(self, held: Any, kind: types.Array) -> Any:
        """An array, that whoever calls holds."""
        builder, context = self.builder, self.context
        whole = context.get_value_type(kind)
        fields = dict(zip(context.data_model_manager[kind]._fields, whole.elements, strict=True))
        numbers = INT64.as_pointer()
        shape, strides = (
            self.numbers(self.load(held, offset, numbers), kind.ndim) for offset in (SHAPE, STRIDES)
        )
        items = INT64(1)
        for length in shape:
            items = builder.mul(items, length)
        found = {
            "meminfo": ir.Constant(fields["meminfo"], None),
            "parent": ir.Constant(fields["parent"], None),
            "nitems": items,
            "itemsize": INT64(context.get_abi_sizeof(fields["data"].pointee)),
            "data": self.load(held, DATA, fields["data"]),
            "shape": cgutils.pack_array(builder, shape, INT64),
            "strides": cgutils.pack_array(builder, strides, INT64),
        }
        value = ir.Constant(whole, ir.Undefined)
        for i, name in enumerate(fields):
            value = builder.insert_value(value, found[name], i)
        return value

    def numbers(self, first: Any, n: int) -> list[Any]:
        """The numbers that stand one after another."""
        builder = self.builder
        return [builder.load(builder.gep(first, [INT64(i)], inbounds=True)) for i in range(n)]

    def load(self, held: Any, offset: int, kind: Any) -> Any:
        """What stands in an object."""
        builder = self.builder
        place = builder.gep(builder.bitcast(held, POINTER), [INT64(offset)], inbounds=True)
        return builder.load(builder.bitcast(place, kind.as_pointer()))


class _Lower(Lower):
    """A function in LLVM's form, with the way in from Python that is written here."""

    def create_cpython_wrapper(self, release_gil: bool = False) -> None:
        context: Any = self.context
        module = context.create_module("wrapper")
        names = self.fndesc
        kind = context.call_conv.get_function_type(names.restype, names.argtypes)
        function = ir.Function(module, kind, names.llvm_func_name)
        _Entry(context, module, function, names, self.env, self.call_helper, release_gil).build()
        self.library.add_ir_module(module)


@register_pass(mutates_CFG=True, analysis_only=False)
class Lowering(NativeLowering):
    """Numba's pass of that name, by `_Lower`."""

    _name = "ssilang_lowering"

    @property
    def lowering_class(self) -> type[Lower]:
        """What it writes by."""
        return _Lower


def _kinds(kind: Any) -> list[Any]:
    """Of the entries of a tuple."""
    return [*kind]


def is_read(kind: types.Type) -> bool:
    """Whether values of a type are read here."""
    if isinstance(kind, types.BaseTuple):
        return all(map(is_read, _kinds(kind)))
    return kind in NUMBERS or (isinstance(kind, types.Array) and kind.dtype in ITEMS)


def is_number(kind: types.Type) -> bool:
    """Whether a type is one of numbers, or of tuples of them."""
    if isinstance(kind, types.BaseTuple):
        return all(map(is_number, _kinds(kind)))
    return kind in NUMBERS


@cache
def is_layout_known() -> bool:
    """Whether numpy's arrays and Python's tuples are laid out as they are read here.

    Where versions were not tried it is not looked at: a layout may hold for one array by chance.
    """
    if UNTRIED:
        return False
    array = np.empty((2, 3))[:, ::2]
    array_at, held = id(array), (array, None)

    def word(at: int) -> int:
        return int(ctypes.c_ssize_t.from_address(at).value)

    def words(offset: int) -> tuple[int, ...]:
        first = word(array_at + offset)
        return tuple(word(first + WORD * i) for i in range(array.ndim))

    return (
        word(id(held) + FIRST) == array_at
        and word(id(held) + FIRST + WORD) == id(None)
        and word(array_at + DATA) == array.ctypes.data
        and ctypes.c_int.from_address(array_at + DATA + WORD).value == array.ndim
        and words(SHAPE) == array.shape
        and words(STRIDES) == array.strides
    )
