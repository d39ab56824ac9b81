"""Imports every module of this package, so that its operators register themselves."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

import ssilang.operators as package


@cache
def load_operators() -> None:
    """Load all operators, once; modules import heavy libraries only inside their functions."""
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
