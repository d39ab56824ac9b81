"""The decorator for compiled inner loops, with types that mypy can follow.

Numba keeps compiled code beside each module and looks at that module's file alone to tell whether
it is still good: a function keeps the old code of what it calls. All code compiled here is
therefore kept in one folder named after the state of the modules that call one another.
"""

from __future__ import annotations

import getpass
import hashlib
import os
import shutil
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])

# packages whose compiled functions call one another
CALLING = ("joints", "dynamics", "solvers", "modal")
KEPT_SECONDS = 30 * 86400.0  # code of older states of the kernel is removed after this

# no entry for C, that nothing uses: it takes time to compile
_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}


def compiled(function: Function) -> Function:
    """Compile with numba (no Python objects, result kept on disk for the next start)."""
    return cast(Function, numba.njit(**_OPTIONS)(function))


def compiled_fast(function: Function) -> Function:
    """As `compiled`, sums in any order (vectors); NaN and infinity keep their meaning."""
    freedom = {"reassoc", "contract", "nsz", "arcp"}
    return cast(Function, numba.njit(fastmath=freedom, **_OPTIONS)(function))


def compiled_fused(function: Function) -> Function:
    """As `compiled`, products fused with sums; no other order of sums, so what cancels does."""
    return cast(Function, numba.njit(fastmath={"contract"}, **_OPTIONS)(function))


def is_compiled(package: str) -> bool:
    """Whether functions of a package of the kernel ('dynamics') were compiled before."""
    return any(Path(_CACHE).glob(f"{package}_*/*.nbi"))


def _state() -> str:
    """A name for the state of the modules: paths, sizes, times of change."""
    digest = hashlib.sha256()
    kernel = Path(__file__).parent
    for path in (p for name in CALLING for p in sorted((kernel / name).glob("*.py"))):
        at = path.stat()
        digest.update(f"{path}:{at.st_size}:{at.st_mtime_ns};".encode())
    return digest.hexdigest()[:16]


def _cache_folder() -> Path:
    """Folder of the user (or a temporary one) for this state of the kernel."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    state = _state()
    for base in (Path(home), Path(tempfile.gettempdir()) / f"cache-{getpass.getuser()}"):
        folder = base / "ssilang" / state
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            _remove_old(folder)
            return folder
    return Path(tempfile.mkdtemp(prefix="ssilang-"))


def _remove_old(kept: Path) -> None:
    limit = time.time() - KEPT_SECONDS
    for folder in kept.parent.iterdir():
        if folder != kept and folder.is_dir() and folder.stat().st_mtime < limit:
            shutil.rmtree(folder, ignore_errors=True)


_CACHE = os.environ.get("NUMBA_CACHE_DIR") or str(_cache_folder())
numba.config.CACHE_DIR = _CACHE  # type: ignore[attr-defined]
