"""Types of arguments as words: what compiled code is kept and found under.

    float64[2C]                             an array of two indices, in C's order
    ssilang.kernel.stepping.newmark.Newmark(float64,float64)    a named tuple

Values tell their kind without the compiler, which is not loaded where all code is kept.
"""

from typing import Any

import numpy as np

C, F, ALIGNED, WRITEABLE = 0x1, 0x2, 0x100, 0x400  # of numpy's flags
SEEN = C | F | ALIGNED | WRITEABLE

PLAIN_KINDS: dict[type, str] = {
    float: "float64",
    int: "int64",
    bool: "bool",
    complex: "complex128",
    type(None): "none",
    **{kind: np.dtype(kind).name for kind in (np.float64, np.float32, np.complex128, np.bool_)},
    **{kind: np.dtype(kind).name for kind in (np.int64, np.int32, np.int16, np.int8, np.uint8)},
}
RESULTS = {
    "None": "none",
    "bool": "bool",
    "int": "int64",
    "float": "float64",
    "tuple[int, float]": "Tuple(int64, float64)",
    "tuple[float, float]": "UniTuple(float64 x 2)",
}
"""Results of functions apart by annotation, as numba says them: callers are compiled before."""
NUMBERS = "biufc"  # kinds of numbers that arrays hold

Key = tuple[Any, ...]


def key_of(values: tuple[Any, ...]) -> Key:
    """What tells the types of values at once: equal for equal types, quick to make."""
    made: list[Any] = []
    for value in values:
        kind = type(value)
        if kind is np.ndarray:
            made.append((value.dtype, value.ndim, value.flags.num & SEEN))
        elif isinstance(value, tuple):
            made.append((kind, key_of(value)))
        else:
            made.append(kind)
    return tuple(made)


def words_of(key: Key) -> str | None:
    """The kinds that a key stands for; None if one of them is unknown here."""
    found = [_word(one) for one in key]
    return None if None in found else ",".join(found)  # type: ignore[arg-type]


def _word(one: Any) -> str | None:
    if isinstance(one, type):
        return PLAIN_KINDS.get(one)
    if len(one) == 3:
        dtype, indices, flags = one
        if dtype.kind not in NUMBERS or not dtype.isnative or not indices:
            return None
        order = "C" if flags & C else "F" if flags & F else "A"
        return _array(dtype.name, indices, order, flags & WRITEABLE, flags & ALIGNED)
    kind, inside = one
    words = words_of(inside)
    if words is None or (kind is not tuple and not hasattr(kind, "_fields")):
        return None
    return _tuple(None if kind is tuple else kind, words)


def words_of_types(types: tuple[Any, ...]) -> str:
    """The kinds that numba's types are."""
    from numba.core.types import Array, BaseTuple

    found = []
    for one in types:
        word = str(one)
        if isinstance(one, Array):
            word = _array(str(one.dtype), one.ndim, one.layout, one.mutable, one.aligned)
        elif isinstance(one, BaseTuple):
            inside: Any = one
            word = _tuple(getattr(one, "instance_class", None), words_of_types((*inside,)))
        found.append(word)
    return ",".join(found)


def _array(number: str, indices: int, order: str, writeable: object, aligned: object) -> str:
    return f"{number}[{indices}{order}{'' if writeable else 'r'}{'' if aligned else 'u'}]"


def _tuple(kind: type | None, words: str) -> str:
    return f"{'' if kind is None else f'{kind.__module__}.{kind.__qualname__}'}({words})"
