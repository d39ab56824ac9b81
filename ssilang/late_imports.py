"""Modules that libraries import at their start and a run hardly ever uses, loaded at first use.

scipy takes every public name of numpy, its Fortran compiler and its tests among them; numba looks
for a YAML file of settings, mostly in vain: a tenth of a second a run. These modules are found as
ever, and loaded when something in them is asked for.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import LazyLoader
from types import ModuleType

SELDOM = frozenset({"numpy.f2py", "numpy.ma", "numpy.testing", "yaml"})


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


def load_late() -> None:
    """Load what is seldom used when it is, in this process."""
    if LateFinder not in sys.meta_path:
        sys.meta_path.insert(0, LateFinder)
