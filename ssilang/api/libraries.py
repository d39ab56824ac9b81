"""Libraries that hold results in their own objects, imported when these are asked for."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ssilang.api.errors import MissingLibrary, refused

_LINES = {"pandas": "'ssilang[python]'", "xarray": "'ssilang[python]'", "pyvista": "pyvista"}
"""What pip installs for a library."""


def library(name: str, language: str = "en") -> Any:
    """A library, imported.

    Raises
    ------
    MissingLibrary
        If it is not installed: how to do that.
    """
    try:
        return import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name != name:
            raise
        line = _LINES[name]
        raise refused(
            "api.library-missing", language, MissingLibrary, name=name, line=line
        ) from None
