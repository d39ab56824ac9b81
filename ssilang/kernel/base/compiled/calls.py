"""How numba compiles a call of a function that is reached by its address (`apart`)."""

# mypy: allow-untyped-calls

import functools
import inspect
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import cgutils, imputils, types
from numba.core.typing.templates import infer, infer_global, make_intrinsic_template, signature

from ssilang.kernel.base.compiled.beside import BESIDE, task_of, title
from ssilang.kernel.base.compiled.kinds import RESULTS, words_of_types
from ssilang.kernel.base.compiled.machine import STOPPED, SYMBOL

_RESULTS = {
    str(kind): kind
    for kind in (
        types.none, types.boolean, types.int64, types.float64,
        types.Tuple((types.int64, types.float64)), types.UniTuple(types.float64, 2),
    )
}  # fmt: skip


@functools.cache
def type_of(function: Any) -> types.Function:
    """What numba sees where compiled code names a function apart."""
    result = _RESULTS[RESULTS[function.result]]
    return intrinsic(function, result, functools.partial(_call, function))


def intrinsic(function: Any, result: types.Type, code: Callable[..., Any]) -> types.Function:
    """What numba sees of a function whose calls are written by `code`; it gives a `result`.

    `function.py_func` has the arguments; `code` takes what numba gives: context, builder,
    signature, values.
    """

    def typed(context: Any, *args: types.Type) -> tuple[Any, Any]:
        # a literal would be a type, and code, of its own
        return signature(result, *(types.unliteral(a) for a in args)), code

    names = "context", *inspect.signature(function.py_func).parameters
    shown = [inspect.Parameter(name, inspect.Parameter.POSITIONAL_ONLY) for name in names]
    typed.__signature__ = inspect.Signature(shown)  # type: ignore[attr-defined]
    template = make_intrinsic_template(function, typed, function.py_func.__name__)
    infer(template)
    made = types.Function(template)
    infer_global(function, made)
    return made


def _call(function: Any, context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Code of a call: the address from its place, or from `_resolve`, then the call."""
    conv, int64 = context.call_conv, ir.IntType(64)
    name = f"{function.__module__}.{function.name}"
    words = words_of_types(sig.args)
    wanted = task_of(function.__module__, function.name, words, sig.args, function.later)
    if function.expected and not function.function.has(words):
        BESIDE.tell(title(function.__module__, function.name, words), wanted)
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
