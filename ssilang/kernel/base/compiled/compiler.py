"""The decorators for compiled inner loops, with types that mypy can follow."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from ssilang.kernel.base.compiled import PLAIN
from ssilang.kernel.base.compiled.cache import folder_of

Function = TypeVar("Function", bound=Callable[..., Any])

# no entry for C, that nothing uses: it takes time to compile
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "no_cfunc_wrapper": True}


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


def _made(function: Function, freedom: set[str] | bool, inline: bool = False) -> Function:
    kept = None
    if os.environ.get("NUMBA_CACHE_DIR") or not PLAIN:
        kept = folder_of(function.__module__)
    if kept is not None:
        numba.config.CACHE_DIR = str(kept)  # type: ignore[attr-defined]
    made = numba.njit(fastmath=freedom, cache=kept is not None, forceinline=inline, **_OPTIONS)
    return cast(Function, made(function))
