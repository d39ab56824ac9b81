"""One thread for BLAS unless the user asks for more.

The factorisations here are small or block-wise: several threads make them many times slower. The
libraries read the environment when they load, so this runs before numpy is imported; where a
program imported numpy first, its OpenBLAS is told directly.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

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
        _tell_loaded(Path(str(numpy.__file__)).parent)


def _tell_loaded(package: Path) -> None:
    """Set the threads of the OpenBLAS that came with a package already imported."""
    import ctypes

    folders = (package.parent / f"{package.name}.libs", package / ".dylibs")
    for path in (p for folder in folders for p in folder.glob("*openblas*")):
        try:
            library = ctypes.CDLL(str(path))
        except OSError:
            continue
        setter = next((s for s in _SETTERS if hasattr(library, s)), None)
        if setter is not None:
            getattr(library, setter)(1)
