"""The decorators for compiled inner loops, with types that mypy can follow.

Numba counts the references to each array that it slices or takes out of a record, by two locked
instructions each time: half of the time of a small step. Functions that neither make arrays nor
hand any back need no count, their callers hold all that they see; they are compiled without it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.cache import folder_of
from ssilang.kernel.base.compiled.kept import keep
from ssilang.kernel.base.compiled.linked import Linked

Function = TypeVar("Function", bound=Callable[..., Any])

# no entry for C, that nothing uses: it takes time to compile
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "no_cfunc_wrapper": True}

SCALARS = {"None", "bool", "int", "float", "tuple", "Quantity"}
MAKERS = {"array", "copy", "dot", "empty", "full", "reshape", "sort", "zeros"}
"""Types of results that are no arrays; names that bring arrays into a function."""


def compiled(function: Function) -> Function:
    """Compile with numba (no Python objects, result kept on disk for the next start)."""
    return _made(function, False)


def compiled_fast(function: Function) -> Function:
    """As `compiled`, sums in any order (vectors); NaN and infinity keep their meaning."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"})


def compiled_fused(function: Function) -> Function:
    """As `compiled`, products fused with sums; no other order of sums, so what cancels does."""
    return _made(function, {"contract"})


def compiled_inline(function: Function) -> Function:
    """As `compiled_fast`, written out in each caller: large records need not be handed over."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"}, True)


def compiled_threaded(function: Function) -> Function:
    """As `compiled_fast`, for `base.threads`: other threads run meanwhile."""
    return _made(function, {"reassoc", "contract", "nsz", "arcp"}, nogil=True)


def _made(
    function: Function, freedom: set[str] | bool, inline: bool = False, nogil: bool = False
) -> Function:
    kept = None
    if os.environ.get("NUMBA_CACHE_DIR") or not PLAIN:
        kept = folder_of(function.__module__)
    if kept is not None:
        numba.config.CACHE_DIR = str(kept)  # type: ignore[attr-defined]
    options = _OPTIONS | {"_nrt": PLAIN or counts(function)}
    options |= {"fastmath": freedom, "forceinline": inline}
    options |= {"nogil": True} if nogil else {}
    if PLAIN or numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return cast(Function, numba.njit(cache=kept is not None, **options)(function))
    made = Linked(function, None, options | {"nopython": True, "boundscheck": None})
    if kept is not None:
        keep(made)
    return cast(Function, made)


def counts(function: Callable[..., Any]) -> bool:
    """Whether a function must count references: it makes arrays, or hands some back.

    A function without counts would never give back arrays that it gets from what it calls.
    """
    names = set(function.__code__.co_names)
    called = (getattr(function.__globals__.get(name), "py_func", None) for name in names)
    own = MAKERS & names or _gives_arrays(function)
    return bool(own) or any(_gives_arrays(f) for f in called if f is not None)


def _gives_arrays(function: Callable[..., Any]) -> bool:
    """Whether the annotated result is or holds an array."""
    result = str(function.__annotations__.get("return", "not annotated"))
    return not set(re.findall(r"\w+", result)) <= SCALARS
