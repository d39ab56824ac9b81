"""The decorator for compiled inner loops, with types that mypy can follow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile with numba (no Python objects, result kept on disk for the next start)."""
    return cast(Function, numba.njit(cache=True, error_model="numpy")(function))
