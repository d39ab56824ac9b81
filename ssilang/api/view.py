"""What all views of the language's objects have."""

from dataclasses import dataclass
from importlib import import_module
from typing import Any, Generic, TypeVar

from ssilang.api.errors import MissingLibrary, refused

Held = TypeVar("Held")


@dataclass(frozen=True, eq=False, repr=False)
class View(Generic[Held]):
    """An object of the language, as Python sees it.

    Attributes
    ----------
    held : object
        The language's own object.
    language : 'en' or 'fr'
        Of what it refuses.
    """

    held: Held
    language: str = "en"


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
