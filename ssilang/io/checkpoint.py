"""Checkpoints: what a run that ends early leaves for the next one, in a folder of its output.

The calculations of a deck that are kept are numbered as they begin. Of each the folder has two
files. `N.state` is a zip of `head.json` and arrays (NPY): all that the steps to come depend on,
written whole or not at all. `N.rows` only grows: names and arrays behind one another, of the steps
done since the checkpoint before; the state says how many bytes of it count and their CRC-32, and
what lies behind them (of a run that was killed while it wrote) is written over. Nothing in them is
ever executed.
"""

import hashlib
import json
import os
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from ssilang.io.archive.container import DAMAGES
from ssilang.io.atomic import cannot_write, replacing
from ssilang.io.errors import InputError
from ssilang.system import GUARDED

FORMAT = "ssilang-checkpoint"
VERSION = 3
FOLDER = "checkpoints"
_ARRAY = "@"  # key that stands for an array

Rows = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Deck:
    """What was run: whose checkpoints these are, or whose row of a sweep.

    Attributes
    ----------
    version : str
        Of ssilang.
    text : str
        Digest of the deck's text.
    given : dict
        Parameters of the command line, by name, as text.
    """

    version: str
    text: str
    given: Mapping[str, str] = field(default_factory=dict)

    def kept(self) -> dict[str, Any]:
        """What is written down of it."""
        return {"ssilang": self.version, "deck": self.text, "given": dict(self.given)}

    def change_since(self, kept: Mapping[str, Any]) -> str:
        """The first of 'ssilang', 'deck' and 'given' that was another one, '' if none was."""
        return next((name for name, now in self.kept().items() if kept[name] != now), "")


@dataclass(frozen=True, eq=False)
class Kept:
    """One calculation as it was kept: what identifies it, its state, the rows of its steps."""

    call: dict[str, Any]
    state: dict[str, Any]
    rows: list[Rows]


@dataclass
class Checkpoints:
    """The checkpoints of a run.

    Parameters
    ----------
    resume : bool
        Whether the run goes on from what stands there; without it the first checkpoint of the run
        replaces all of them.
    """

    folder: Path
    deck: Deck
    resume: bool = False
    _number: int = 0
    _lengths: dict[int, tuple[int, int, int]] = field(default_factory=dict)

    @property
    def found(self) -> bool:
        """Whether an earlier run left any."""
        return next(self._states(), None) is not None

    @property
    def kept(self) -> bool:
        """Whether this run keeps any, its own or those that it goes on from."""
        return bool(self._lengths)

    def begin(self) -> int:
        """The number of a calculation that begins."""
        self._number += 1
        return self._number

    def check(self) -> None:
        """Check that what stands there was left by this deck.

        Raises
        ------
        InputError
            If another deck, other parameters or another version of ssilang left it.
        """
        for path in self._states():
            self._head(path)

    def read(self, number: int) -> Kept | None:
        """What an earlier run kept of a calculation; None if it kept nothing, or is not asked for.

        Raises
        ------
        InputError
            If it cannot be read, or belongs to another deck.
        """
        path = self._path(number, "state")
        if not self.resume or not path.is_file():
            return None
        head = self._head(path)
        try:
            with zipfile.ZipFile(path) as file:
                state = _decoded(head["state"], file)
            path = _plain(self._path(number, "rows"))
            length, total, batches = (int(head[name]) for name in ("length", "sum", "batches"))
            rows = _read_rows(path, length, total, batches)
        except DAMAGES as error:
            raise self._damaged(path, error) from error
        self._lengths[number] = length, total, batches
        return Kept(head["call"], state, rows)

    def write(
        self, number: int, call: Mapping[str, Any], state: Mapping[str, Any], rows: Rows
    ) -> None:
        """Keep a calculation: the rows since the last time, then its state.

        Raises
        ------
        OutputError
            If that cannot be written; the checkpoint before stands still.
        """
        if not (self.resume or self._lengths):
            self._remove()  # what an earlier run left is no part of this one
        length, total, batches = self._lengths.get(number, (0, 0, 0))
        try:
            names = np.frombuffer(json.dumps(list(rows)).encode(), np.uint8)
            path = self._path(number, "rows")
            length, total = _append(path, length, total, [names, *rows.values()])
        except OSError as error:
            raise cannot_write(path, error) from error
        arrays: list[NDArray[Any]] = []
        head = {
            "format": FORMAT,
            "version": VERSION,
            **self.deck.kept(),
            "call": dict(call),
            "batches": batches + 1,
            "length": length,
            "sum": total,
            "state": _encoded(state, arrays),
        }
        with replacing(self._path(number, "state")) as stream:
            _write_zip(stream, head, arrays)
            stream.flush()
            os.fsync(stream.fileno())
        self._lengths[number] = length, total, batches + 1

    def forget(self) -> None:
        """Remove them: the deck has come to its end."""
        if self._lengths:
            self._remove()

    def _path(self, number: int, suffix: str) -> Path:
        return self.folder / f"{number}.{suffix}"

    def _states(self) -> Iterator[Path]:
        if self.folder.is_symlink():  # what stands elsewhere is not replaced, nor removed
            raise InputError("io.folder-is-link", path=self.folder)
        yield from sorted(self.folder.glob("[0-9]*.state"))

    def _remove(self) -> None:
        """Remove the checkpoints, and their folder if nothing else stands there."""
        for path in (*self._states(), *self.folder.glob("[0-9]*.rows")):
            with suppress(OSError):
                path.unlink()
        with suppress(OSError):
            self.folder.rmdir()

    def _head(self, path: Path) -> dict[str, Any]:
        try:
            with zipfile.ZipFile(_plain(path)) as file:
                size = path.stat().st_size
                if sum(part.file_size for part in file.infolist()) > size:
                    raise ValueError(f"{size} bytes that unpack")
                head: dict[str, Any] = json.loads(file.read("head.json"))
            if head["format"] != FORMAT:
                raise ValueError(f"format {head['format']!r}")
            version, written_by = int(head["version"]), str(head["ssilang"])
            changed, given = self.deck.change_since(head), dict(head["given"])
        except DAMAGES as error:
            raise self._damaged(path, error) from error
        if version != VERSION or changed == "ssilang":
            raise InputError(
                "io.checkpoint-of-version",
                folder=self.folder, version=written_by, own=self.deck.version,
            )  # fmt: skip
        if changed == "deck":
            raise InputError("io.checkpoint-of-deck", folder=self.folder)
        if changed:
            names = changed_names(given, self.deck.given)
            before, now = (
                [f"{n}={d[n]}" if n in d else f"{n}" for n in names]
                for d in (given, self.deck.given)
            )
            raise InputError(
                "io.checkpoint-of-parameters", folder=self.folder, before=before, now=now
            )
        return head

    def _damaged(self, path: Path, error: Exception) -> InputError:
        return InputError("io.checkpoint-damaged", path=path, error=error)


def digest_of_file(path: Path) -> str:
    """What tells one file from another; '' of one that is gone."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def changed_names(before: Mapping[str, str], now: Mapping[str, str]) -> list[str]:
    """Names whose text or digest is another one, or that only one of the two has."""
    return sorted(n for n in before.keys() | now if before.get(n) != now.get(n))


# ---- what files hold -----------------------------------------------------------------------------


def _plain(path: Path) -> Path:
    """The path of a file that is no pipe and no folder."""
    if not path.is_file():
        raise OSError(f"{path.name}: no file")
    return path


def _encoded(value: Any, arrays: list[NDArray[Any]]) -> Any:
    """Numbers, words, lists and dictionaries for JSON; arrays by their number."""
    if isinstance(value, np.ndarray):
        arrays.append(value)
        return {_ARRAY: len(arrays) - 1}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return {name: _encoded(v, arrays) for name, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_encoded(v, arrays) for v in value]
    assert value is None or isinstance(value, bool | int | float | str), type(value)
    return value


def _decoded(value: Any, file: zipfile.ZipFile) -> Any:
    if isinstance(value, list):
        return [_decoded(v, file) for v in value]
    if not isinstance(value, dict):
        return value
    if _ARRAY in value:
        with file.open(f"{value[_ARRAY]}.npy") as stream:
            return np.lib.format.read_array(stream, allow_pickle=False)
    return {name: _decoded(v, file) for name, v in value.items()}


def _write_zip(stream: Any, head: dict[str, Any], arrays: list[NDArray[Any]]) -> None:
    """Not packed: numbers of a motion pack badly, and time counts."""
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED, True) as file:
        file.writestr("head.json", json.dumps(head))
        for number, array in enumerate(arrays):
            with file.open(f"{number}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, array, allow_pickle=False)


def _append(path: Path, length: int, total: int, arrays: Iterable[NDArray[Any]]) -> tuple[int, int]:
    """Write arrays behind the first `length` bytes of a file; its length then, and its CRC-32."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle = os.open(path, os.O_RDWR | os.O_CREAT | GUARDED, 0o666)
    with os.fdopen(handle, "r+b") as stream:
        stream.truncate(length)
        stream.seek(length)
        for array in arrays:
            np.lib.format.write_array(stream, array, allow_pickle=False)
        stream.flush()
        os.fsync(stream.fileno())
        end = stream.tell()
        stream.seek(length)
        return end, _summed(stream, end - length, total)


def _summed(stream: IO[bytes], count: int, total: int = 0) -> int:
    """The CRC-32 of the next `count` bytes, behind others whose one is `total`."""
    while piece := stream.read(min(count, 1 << 20)):
        count, total = count - len(piece), crc32(piece, total)
    return total


def _read_rows(path: Path, length: int, total: int, batches: int) -> list[Rows]:
    """The arrays of each batch by name; the names stand before them."""
    with path.open("rb") as stream:
        if _summed(stream, length) != total:
            raise ValueError(f"CRC-32 of the first {length} bytes")
        stream.seek(0)
        return [
            {
                name: np.lib.format.read_array(stream, allow_pickle=False)
                for name in json.loads(np.lib.format.read_array(stream).tobytes())
            }
            for _ in range(batches)
        ]
