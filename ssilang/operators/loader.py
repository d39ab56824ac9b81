"""Imports every module of this package, so that its operators register themselves."""

from __future__ import annotations

import importlib
import pkgutil

import ssilang.operators as package


def load_operators() -> None:
    """Load all operators; modules import heavy libraries only inside their functions."""
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        importlib.import_module(module.name)
