"""Which classes a save file may hold, and which of their fields number nodes."""

import importlib
import importlib.util
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from ssilang.io.errors import InputError, OutputError
from ssilang.remembered import tables_of

_TRUSTED = ("ssilang.kernel.", "ssilang.io.plots.labels")

HOMES: dict[str, str] = {
    name: f"ssilang.{home}"
    for home, names in tables_of(Path(__file__).with_suffix(".toml")).items()
    for name in names
}
"""Where classes stand that files hold by their name alone: a file outlives the moves of modules."""

# fields that hold node numbers, shifted when nodes are added to those of a session
NODE_FIELDS: dict[str, tuple[str, ...]] = {
    "Point": ("number",),
    "CellBlock": ("raw",),
    "NodeValues": ("nodes",),
    "ElementMatrices": ("raw_nodes",),
    "Relations": ("raw_nodes", "raw_multipliers"),
    "ArrowPart": ("nodes",),
}


@dataclass(frozen=True)
class Packing:
    """How objects of a class that is no data class are taken apart and made again.

    `fill` completes an object made by `make` (shared or self-containing ones: tables).
    """

    pack: Callable[[Any], Any]
    make: Callable[[Any], Any]
    fill: Callable[[Any, Any], None] | None = None
    mutable: bool = False


_PACKINGS: dict[str, Packing] = {}
_TAGS: dict[type, str] = {}


def register_packing(cls: type, tag: str, packing: Packing) -> None:
    """Let save files hold objects of a class of the language."""
    _PACKINGS[tag] = packing
    _TAGS[cls] = tag


def packing_of(cls: type) -> tuple[str, Packing] | None:
    """Tag and packing of a registered class."""
    tag = _TAGS.get(cls)
    return None if tag is None else (tag, _PACKINGS[tag])


def packing_named(tag: str) -> Packing:
    """The packing registered under a tag."""
    if tag not in _PACKINGS:
        raise InputError("io.save-file-holds-object", tag=tag)
    return _PACKINGS[tag]


def class_name(cls: type) -> str:
    """Name under which a data class or an enumeration of the kernel is saved.

    Raises
    ------
    OutputError
        For any other class.
    """
    if HOMES.get(cls.__qualname__) == cls.__module__:
        return f":{cls.__qualname__}"
    name = f"{cls.__module__}:{cls.__qualname__}"
    if not name.startswith(_TRUSTED) or not (is_dataclass(cls) or issubclass(cls, Enum)):
        raise OutputError("io.object-class-cannot-saved", name=cls.__name__)
    return name


def class_named(name: str) -> type:
    """The data class or enumeration saved under a name; nothing else is ever looked up.

    Raises
    ------
    InputError
        For a name outside of the kernel.
    """
    module, _, qualname = name.rpartition(":")
    if not module or (name.startswith(_TRUSTED) and qualname in HOMES and not _stands(module)):
        module = HOMES.get(qualname, "")  # files of older versions say where the class stood
    if not module.startswith(_TRUSTED) or "." in qualname:
        raise InputError("io.save-file-asks-no", name=name)
    try:
        found = getattr(importlib.import_module(module), qualname)
    except (ImportError, AttributeError):
        raise InputError("io.save-file-asks-not", name=name) from None
    if not (isinstance(found, type) and (is_dataclass(found) or issubclass(found, Enum))):
        raise InputError("io.save-file-asks-no", name=name)
    return found


def _stands(module: str) -> bool:
    """Whether there is such a module today."""
    try:
        return importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        return False


def saved_fields(cls: type) -> tuple[str, ...]:
    """Fields of a data class that are saved: those of its constructor, without caches."""
    hidden = ("cache", "_resolved")
    return tuple(f.name for f in fields(cls) if f.init and f.name not in hidden)
