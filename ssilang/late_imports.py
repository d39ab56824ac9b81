"""Modules that libraries import at their start and a run hardly ever uses, loaded at first use.

scipy takes every public name of numpy, its Fortran compiler and its tests among them, and Python's
help; numba looks for a YAML file of settings, mostly in vain, and for packages that extend it:
a tenth of a second a run. These modules are found as ever, and loaded when something in them is
asked for.

What is loaded stays: `lasting` keeps the search for garbage from walking through it.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import LazyLoader, module_from_spec
from types import ModuleType

SELDOM = frozenset(
    {
        "html",
        "importlib.metadata",
        "numpy.f2py",
        "numpy.ma",
        "numpy.testing",
        "pydoc",
        "xml.etree.ElementTree",
        "yaml",
    }
)
ALGEBRA = "scipy.linalg"
ALONE = ("cython_blas", "cython_lapack")
"""Its modules that compiled code takes BLAS and LAPACK from; they need nothing of the others."""


class LateFinder:
    """Finds the modules that are seldom used, and the one that others are loaded ahead of."""

    @staticmethod
    def find_spec(
        name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """How to load a module late; None for all others."""
        if name in SELDOM:
            spec = PathFinder.find_spec(name, path, target)
            if spec is not None and spec.loader is not None:
                spec.loader = LazyLoader(spec.loader)
            return spec
        if name == ALGEBRA and f"{ALGEBRA}.{ALONE[0]}" in sys.modules:
            spec = PathFinder.find_spec(name, path, target)
            if spec is not None and spec.origin is not None:
                spec.loader = _Around(name, spec.origin)
            return spec
        return None


class _Around(SourceFileLoader):
    """Loads scipy.linalg around modules of it that are there already."""

    def exec_module(self, module: ModuleType) -> None:
        """Run it; what was loaded alone stands in it, as if it had been loaded by it."""
        for name in ALONE:
            if (loaded := sys.modules.get(f"{ALGEBRA}.{name}")) is not None:
                setattr(module, name, loaded)
        super().exec_module(module)


def load_blas() -> None:
    """Load what compiled code calls of scipy.linalg, and not the rest of it, that takes 0.04 s.

    Where that does not work, compiled code loads the whole when it needs it.
    """
    if ALGEBRA in sys.modules or LateFinder not in sys.meta_path:
        return
    import scipy

    places = [f"{place}/linalg" for place in scipy.__path__]
    for name in (f"{ALGEBRA}.{part}" for part in ALONE):
        spec = PathFinder.find_spec(name, places)
        if name in sys.modules or spec is None or spec.loader is None:
            continue
        sys.modules[name] = module = module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        except Exception:  # another scipy, whose parts need each other
            del sys.modules[name]


def load_late() -> None:
    """Load what is seldom used when it is, in this process."""
    if LateFinder not in sys.meta_path:
        sys.meta_path.insert(0, LateFinder)


@contextmanager
def lasting() -> Iterator[None]:
    """Modules are loaded here: what they make is not searched for garbage, now or soon.

    A start makes a quarter of a million objects that last, and looking through them takes 7 % of
    it. They become old at once, with all that is there; garbage among it is found by the next
    search through everything.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            if not gc.get_freeze_count():  # else someone holds objects there, who would lose them
                gc.freeze()
                gc.unfreeze()
            gc.enable()
