"""The decorator for compiled inner loops, with types that mypy can follow.

Numba keeps compiled code beside each module and looks at that module's file alone to tell whether
it is still good: a function keeps the old code of what it calls. The code of a module compiled here
is therefore kept in a folder named after its text and that of all modules of the kernel that it
imports, directly or not: an edit costs the code that it may change, and no other.
"""

from __future__ import annotations

import getpass
import hashlib
import os
import re
import shutil
import tempfile
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., Any])

KEPT_SECONDS = 30 * 86400.0  # code of older states of a module is removed after this
IMPORTED = re.compile(r"^from (ssilang\.kernel[\w.]*) import (.*)$", re.MULTILINE)
PACKAGE = Path(__file__).parent.parent  # ssilang

# no entry for C, that nothing uses: it takes time to compile
_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}


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
    if not os.environ.get("NUMBA_CACHE_DIR"):
        numba.config.CACHE_DIR = str(_folder(function.__module__))  # type: ignore[attr-defined]
    return cast(Function, numba.njit(fastmath=freedom, forceinline=inline, **_OPTIONS)(function))


def is_compiled(package: str) -> bool:
    """Whether functions of a package of the kernel ('stepping') were compiled before."""
    root = PACKAGE / "kernel" / package
    given = os.environ.get("NUMBA_CACHE_DIR")
    if given:
        folders = [root, *(p for p in root.rglob("*") if p.is_dir())]
        return any(any(Path(given).glob(f"{p.name}_*/*.nbi")) for p in folders)
    paths = (p.relative_to(PACKAGE.parent).with_suffix("") for p in root.rglob("*.py"))
    kept = (_base() / f"{name}-{state_of(name)}" for name in (".".join(p.parts) for p in paths))
    return any(any(folder.glob("*/*.nbi")) for folder in kept)


def state_of(module: str, package: Path = PACKAGE) -> str:
    """A name for the text of a module and of those that it imports from the kernel.

    Parameters
    ----------
    package : Path
        Folder of ssilang.
    """
    known, waiting = {}, [module]
    while waiting:
        name = waiting.pop()
        if name not in known:
            known[name], imported = _read(name, package)
            waiting += imported
    digest = hashlib.sha256("".join(known[name] for name in sorted(known)).encode())
    return digest.hexdigest()[:16]


@cache
def _read(module: str, package: Path) -> tuple[str, tuple[str, ...]]:
    """Digest of a module's name and text, and the modules that it imports from the kernel."""
    path = package.joinpath(*module.split(".")[1:])
    path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    try:
        text = path.read_text(encoding="utf-8")
    except OSError:  # a name that is imported and no module
        return "", ()
    names = [
        (m, [f"{m}.{word}" for word in re.findall(r"\w+", rest)])
        for m, rest in IMPORTED.findall(text)
    ]
    found = [n for m, inside in names for n in (m, *(inside if _is_package(m, package) else ()))]
    return hashlib.sha256(f"{module}\n{text}".encode()).hexdigest(), tuple(found)


def _is_package(module: str, package: Path) -> bool:
    return package.joinpath(*module.split(".")[1:]).is_dir()


@cache
def _base() -> Path:
    """Folder of the user, or a temporary one, that can be written to."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    for base in (Path(home), Path(tempfile.gettempdir()) / f"cache-{getpass.getuser()}"):
        folder = base / "ssilang"
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return folder
    return Path(tempfile.mkdtemp(prefix="ssilang-"))


@cache
def _folder(module: str) -> Path:
    """Where the code of a module in its present state is kept; it counts as used now."""
    folder = _base() / f"{module}-{state_of(module)}"
    try:
        folder.mkdir(exist_ok=True)
        os.utime(folder)
        _remove_old(module, folder)
    except OSError:  # another process removes the same folders, or the disk is full
        pass
    return folder


def _remove_old(module: str, kept: Path) -> None:
    limit = time.time() - KEPT_SECONDS
    for folder in kept.parent.glob(f"{module}-*"):
        if folder != kept and folder.stat().st_mtime < limit:
            shutil.rmtree(folder, ignore_errors=True)
