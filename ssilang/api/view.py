"""What all views of the language's objects have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

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
