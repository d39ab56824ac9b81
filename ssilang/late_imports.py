"""Modules that libraries import at their start and a run hardly ever uses, loaded at first use.

scipy takes every public name of numpy, its Fortran compiler and its tests among them, and Python's
help; numba looks for a YAML file of settings, mostly in vain, and for packages that extend it:
a tenth of a second a run. These modules are found as ever, and loaded when something in them is
asked for.

`Late` stands for a module under a name, loaded when something in it is used.

What is loaded stays: `lasting` keeps the search for garbage from walking through it.
"""

import gc
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import LazyLoader
from types import ModuleType
from typing import Any

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


class LateFinder:
    """Finds the modules that are seldom used."""

    @staticmethod
    def find_spec(
        name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """How to load a module late; None for all others."""
        spec = PathFinder.find_spec(name, path, target) if name in SELDOM else None
        if spec is not None and spec.loader is not None:
            spec.loader = LazyLoader(spec.loader)
        return spec


class Late:
    """A module, loaded when something in it is used."""

    def __init__(self, module: str) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Any:
        value = getattr(import_module(self._module), name)
        setattr(self, name, value)
        return value


def load_late() -> None:
    """Load what is seldom used when it is, in this process."""
    if LateFinder not in sys.meta_path:
        sys.meta_path.insert(0, LateFinder)


@contextmanager
def without_collections() -> Iterator[None]:
    """Objects that stay are made here: searches for garbage among them would find none.

    A script of 30 000 lines is half a million objects, and these searches three quarters of the
    time that reading it takes.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


@contextmanager
def lasting() -> Iterator[None]:
    """Modules are loaded here: what they make is not searched for garbage, now or soon.

    A start makes a quarter of a million objects that last, and looking through them takes 7 % of
    it. They become old at once, with all that is there; garbage among it is found by the next
    search through everything.
    """
    collects = gc.isenabled()
    with without_collections():
        yield
        # where some are frozen, someone holds objects there, who would lose them: Python 3.12 does
        if collects and not gc.get_freeze_count():
            gc.freeze()
            gc.unfreeze()
