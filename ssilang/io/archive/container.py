"""The zip file: JSON for the objects, NPY for their arrays.

Objects turned into JSON and arrays.
"""

import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang import __version__
from ssilang.io.archive.classes import NODE_FIELDS, class_name, packing_of, saved_fields
from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError
from ssilang.kernel.mesh.nodes import NodeTable

FORMAT = "ssilang-save"
VERSION = 1
_OBJECTS = "objects.json"
DAMAGES = (
    OSError, LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError,
    RuntimeError, MemoryError, SyntaxError, zipfile.BadZipFile, zlib.error, TokenError,
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
            if array.dtype.kind not in "buif":  # objects hold no complex numbers, words, dates
                raise ValueError(f"{array.dtype}, {array.shape}")
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
        objects_size = file.getinfo(_OBJECTS).file_size  # takes some 25 times that in memory
        most = max(_SMALL // _WORDY, _DENSEST // 4 * path.stat().st_size)
        if sum(i.file_size for i in file.infolist()) > bound or objects_size > most:
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
_WORDY = 16  # objects before their bytes are made to arrays
_DENSEST = 200  # bytes for each of the file's: fields that are nearly all zero are packed so


def most_unpacked(path: Path) -> int:
    """Bytes that an archive may take in memory, by the size of its file."""
    return max(_SMALL, _DENSEST * path.stat().st_size)


def _too_large(path: Path) -> InputError:
    most, size = most_unpacked(path) / 1e6, path.stat().st_size / 1e6
    return InputError("io.archive-too-large", name=path.name, most=most, size=size)


def _unreadable(path: Path, error: Exception) -> InputError:
    return InputError("io.no-file-sauv-ssilang", name=path.name, error=error)


class Encoder:
    """Collects objects; each is stored once, however many refer to it.

    What `encode` returns stands for the value: a JSON scalar for itself, a list whose first item
    says what it is for the others: ["o", n] object number n, ["a", n] array, ["l" | "t", items]
    list and tuple, ["d", pairs] mapping, ["e", class, name] enumeration, ["m", text] text of a
    class of words.
    """

    def __init__(self) -> None:
        self.objects: list[Any] = []
        self.arrays: list[NDArray[Any]] = []
        self._kept: dict[int, tuple[Any, list[Any]]] = {}  # the value is held so that its id is
        self._changing: list[int] = []

    def begin_record(self) -> None:
        """Forget objects that can change, so that the next record holds their present state."""
        for key in self._changing:
            self._kept.pop(key, None)
        self._changing = []

    def held(self) -> set[int]:
        """Identities of the objects that are stored."""
        return set(self._kept)

    def nodes(self, keys: set[int], count: int) -> NDArray[np.bool_]:
        """Which of `count` nodes these stored objects stand on, shape (count,)."""
        found = np.zeros(count, dtype=bool)
        for value in (self._kept[key][0] for key in keys):
            for name in NODE_FIELDS.get(type(value).__name__, ()):
                found[getattr(value, name)] = True
        return found

    def encode(self, value: Any) -> Any:
        """The code of a value.

        Raises
        ------
        OutputError
            For an object that cannot be saved.
        """
        if value is None or type(value) in (bool, int, float, str):
            return value
        if isinstance(value, np.generic):
            return value.item()
        if id(value) in self._kept:
            return self._kept[id(value)][1]
        if isinstance(value, Enum):
            return ["e", class_name(type(value)), value.name]
        if isinstance(value, np.ndarray):
            return self._array(value)
        if isinstance(value, (list, tuple)):
            kind = "t" if isinstance(value, tuple) else "l"
            return [kind, [self.encode(v) for v in value]]
        if isinstance(value, Mapping):
            return ["d", [[self.encode(k), self.encode(v)] for k, v in value.items()]]
        return self._object(value)

    def _array(self, value: NDArray[Any]) -> list[Any]:
        if value.dtype == object:
            items = [self.encode(v) for v in value.ravel()]
            return ["ao", list(value.shape), items]
        self.arrays.append(value.copy())
        return ["a", len(self.arrays) - 1]

    def _object(self, value: Any) -> list[Any]:
        number = len(self.objects)
        self.objects.append(None)
        reference = ["o", number]
        self._kept[id(value)] = (value, reference)
        packing = packing_of(type(value))
        if packing is not None:
            tag, how = packing
            if how.mutable:
                self._changing.append(id(value))
            self.objects[number] = [tag, self.encode(how.pack(value))]
        elif isinstance(value, NodeTable):
            self._changing.append(id(value))
            self.objects[number] = ["nodes", self._nodes(value)]
        else:
            name = class_name(type(value))
            parts = {f: self.encode(getattr(value, f)) for f in saved_fields(type(value))}
            self.objects[number] = [name, parts]
        return reference

    def _nodes(self, table: NodeTable) -> list[Any]:
        ids = np.arange(len(table), dtype=np.int64)
        return [self._array(a) for a in (table.coordinates, table.density, table.resolve(ids))]
