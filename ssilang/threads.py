"""One thread for BLAS unless the user asks for more.

The factorisations here are small or block-wise: several threads make them many times slower. The
libraries read the environment when they load, so this runs before numpy is imported; where a
program imported numpy first, its OpenBLAS is told directly.
"""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ctypes import CDLL

_VARIABLES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_SETTERS = (
    "scipy_openblas_set_num_threads64_",
    "openblas_set_num_threads64_",
    "scipy_openblas_set_num_threads",
    "openblas_set_num_threads",
)


def one_blas_thread() -> None:
    """Ask for one thread, for this process and those it starts, where nothing else is asked."""
    if "OMP_NUM_THREADS" in os.environ or "OPENBLAS_NUM_THREADS" in os.environ:
        return
    for name in _VARIABLES:
        os.environ.setdefault(name, "1")
    numpy = sys.modules.get("numpy")
    if numpy is not None and getattr(numpy, "__file__", None):
        for library in _openblas(Path(str(numpy.__file__)).parent):
            if setter := _first_of(library, _SETTERS):
                setter(1)


def blas(package: Path) -> tuple[str, int]:
    """Kernels and threads of the OpenBLAS that came with a package; ('', 0): it has none."""
    import ctypes

    for library in _openblas(package):
        core = _first_of(library, [s.replace("set_num_threads", "get_corename") for s in _SETTERS])
        count = _first_of(library, [s.replace("set_num", "get_num") for s in _SETTERS])
        if core and count:
            core.restype = ctypes.c_char_p
            return core().decode(), count()
    return "", 0


def _openblas(package: Path) -> "Iterator[CDLL]":
    from ctypes import CDLL

    folders = (package.parent / f"{package.name}.libs", package / ".dylibs")
    for path in (p for folder in folders for p in folder.glob("*openblas*")):
        with suppress(OSError):
            yield CDLL(str(path))


def _first_of(library: "CDLL", names: Iterable[str]) -> Any:
    return next((getattr(library, name) for name in names if hasattr(library, name)), None)
