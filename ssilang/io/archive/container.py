"""The zip file: JSON for the objects, NPY for their arrays."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang import __version__
from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError

FORMAT = "ssilang-save"
VERSION = 1
_OBJECTS = "objects.json"
DAMAGES = (
    OSError, LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError,
    RecursionError, SyntaxError, NotImplementedError, zipfile.BadZipFile, zlib.error, TokenError,
)  # fmt: skip
"""What Python and its libraries raise over bytes that are no archive of ours."""


@dataclass
class Record:
    """What one SAUV wrote: its label, names of the script with the objects they stand for."""

    label: str = ""
    names: dict[str, Any] = field(default_factory=dict)


def write_archive(
    path: Path,
    objects: list[Any],
    arrays: list[NDArray[Any]],
    records: list[Record],
    settings: Mapping[str, Any],
) -> None:
    """Write a file, whole or not at all."""
    head = {
        "format": FORMAT,
        "version": VERSION,
        "ssilang": __version__,
        "settings": dict(settings),
        "records": [{"label": r.label, "names": r.names} for r in records],
        "objects": objects,
    }
    with (
        replacing(path) as stream,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, True, 1) as z,
    ):
        z.writestr(_OBJECTS, json.dumps(head))
        for number, array in enumerate(arrays):
            buffer = io.BytesIO()
            np.save(buffer, array, allow_pickle=False)
            z.writestr(f"arrays/{number}.npy", buffer.getvalue())


@dataclass
class Archive:
    """A file's content; arrays are loaded when asked for, from the file kept open till `close`."""

    path: Path
    objects: list[Any]
    records: list[Record]
    settings: dict[str, Any]
    file: zipfile.ZipFile
    left: int  # bytes that its arrays may still take

    def close(self) -> None:
        """Close the file."""
        self.file.close()

    def array(self, number: int) -> NDArray[Any]:
        """Array by its number."""
        try:
            self.left -= self.file.getinfo(f"arrays/{number}.npy").file_size
            if self.left < 0:
                raise _too_large(self.path)
            raw = self.file.read(f"arrays/{number}.npy")
            array: NDArray[Any] = np.load(io.BytesIO(raw), allow_pickle=False)
        except DAMAGES as error:
            raise _unreadable(self.path, error) from error
        return array


def read_archive(path: Path) -> Archive:
    """Open a file written by `write_archive`; the caller closes it.

    Raises
    ------
    InputError
        If it cannot be read, is of another kind, or of a later version.
    """
    try:
        file = zipfile.ZipFile(path)
        bound = most_unpacked(path)
        if sum(i.file_size for i in file.infolist()) > bound:
            file.close()
            raise _too_large(path)
        head = json.loads(file.read(_OBJECTS))
        if head["format"] != FORMAT:
            raise ValueError(f"format {head['format']!r}")
        records = [Record(r["label"], r["names"]) for r in head["records"]]
        version, objects, settings = int(head["version"]), head["objects"], head["settings"]
        if not (isinstance(objects, list) and isinstance(settings, dict)):
            raise TypeError("objects")
        if not all(isinstance(r.label, str) and isinstance(r.names, dict) for r in records):
            raise TypeError("records")
    except DAMAGES as error:
        raise _unreadable(path, error) from error
    if version > VERSION:
        by = str(head.get("ssilang", "?"))
        raise InputError("io.written-later-version-ssilang", name=path.name, by=by, own=__version__)
    return Archive(path, objects, records, settings, file, bound)


_SMALL = 2**28  # bytes that any archive may take
_DENSEST = 200  # bytes for each of the file's: fields that are nearly all zero are packed so


def most_unpacked(path: Path) -> int:
    """Bytes that an archive may take in memory, by the size of its file."""
    return max(_SMALL, _DENSEST * path.stat().st_size)


def _too_large(path: Path) -> InputError:
    most, size = most_unpacked(path) / 1e6, path.stat().st_size / 1e6
    return InputError("io.archive-too-large", name=path.name, most=most, size=size)


def _unreadable(path: Path, error: Exception) -> InputError:
    return InputError("io.no-file-sauv-ssilang", name=path.name, error=error)
