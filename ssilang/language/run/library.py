"""Procedures that come from files: the deck's folder, then the standard library."""

import math
import os
from collections.abc import Sequence
from functools import cache, cached_property
from pathlib import Path

from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Definition, Item, Name, Quoted, Script
from ssilang.language.values import Procedure
from ssilang.language.vocabulary.entries import Declaration, declared_names, read_declaration
from ssilang.resources import resource

_SUFFIXES = (".ssi", ".procedur", ".dgibi")


@cache
def standard_procedures() -> dict[str, Path]:
    """Name to file of the standard library's procedures; looked for once a process."""
    return {p.stem.upper(): p for p in sorted(resource("stdlib").glob("*.ssi"))}


@cache
def _standard(path: Path, _changed: float) -> Script:
    """A file of the standard library, read once a process: nobody changes a tree."""
    return parse(read_source(path))


class Library:
    """Finds and loads procedures on first mention of their name.

    Parameters
    ----------
    folder : Path
        Folder of the script, searched for names that begin with @.
    allowed : sequence of Path
        Further folders to which links may lead from there.

    Attributes
    ----------
    standard_files : dict
        Files of the standard library's procedures by name.
    """

    def __init__(self, folder: Path, allowed: Sequence[Path] = ()) -> None:
        self._folder = folder
        self._allowed = allowed
        self._loaded: dict[str, Procedure | None] = {}
        self._files: dict[str, tuple[Path, float]] = {}  # of what is loaded, and its last change
        self.standard_files = standard_procedures()
        self.standard_names = frozenset(self.standard_files)
        self._declared: dict[str, Declaration | None] = {}
        self.read: list[Path] = []  # files beside the script, and those that could stand there

    @cached_property
    def declared_names(self) -> list[str]:
        """Procedures and operators whose tables are declared."""
        return declared_names()

    def declared(self, name: str) -> Declaration | None:
        """What is declared of the tables of a procedure or operator, None if nothing is."""
        if name not in self._declared:
            self._declared[name] = read_declaration(name) if name in self.declared_names else None
        return self._declared[name]

    def is_own(self, name: str) -> bool:
        """Whether the standard library has a procedure that scripts are not meant to replace."""
        declared = self.declared(name)
        return name in self.standard_names and (declared is None or not declared.replaceable)

    def find(self, name: str) -> Procedure | None:
        """The procedure of that name, loaded if it is not yet, None if there is none."""
        if name not in self._loaded:
            if (path := self._path(name)) is not None:
                self._load(path)
            self._loaded.setdefault(name, None)
        return self._loaded[name]

    def called(self, items: Sequence[Item]) -> Sequence[Item]:
        """The phrase; a procedure that stands in quotes before its operands is read as called."""
        first = items[0] if len(items) > 1 else None
        if isinstance(first, Quoted) and first.text in self.standard_names:
            return [Name(first.text, first.text, first.span), *items[1:]]
        return items

    def look_again(self) -> None:
        """Forget what may have changed on the disk: other files, and names that none had."""
        self.read.clear()
        self._loaded = {name: p for name, p in self._loaded.items() if p and self._stands(name)}

    def _stands(self, name: str) -> bool:
        """Whether a procedure is still what was read."""
        path, changed = self._files[name]
        if _last_change(path) != changed or self._path(name) not in (None, path):
            return False
        if path not in self.standard_files.values() and path not in self.read:
            self.read.append(path)
        return True

    def _path(self, name: str) -> Path | None:
        if name.startswith("@"):
            stems = dict.fromkeys((name, name.lower()))
            paths = [self._folder / (stem + suffix) for suffix in _SUFFIXES for stem in stems]
            # False for a name that no file can have
            if (found := next(filter(os.path.isfile, paths), None)) is not None:
                return self._inside(found)
            if name in self.standard_names:  # one of these would stand before the library's
                self.read += [path for path in paths if path not in self.read]
        return self.standard_files.get(name)

    def _inside(self, path: Path) -> Path:
        """A file beside the script, if it is no link that leads out of the folder."""
        real = path.resolve()
        if any(real.is_relative_to(f.resolve()) for f in (self._folder, *self._allowed)):
            return path
        raise SsiError("forbidden-path", None, path=str(real), folder=str(real.parent))

    def _load(self, path: Path) -> None:
        changed, standard = _last_change(path), path in self.standard_files.values()
        if not standard:
            self.read.append(path)
        try:
            script = _standard(path, changed) if standard else parse(read_source(path))
        except SeveralErrors as several:  # as of a statement that went wrong: the first
            raise several.errors[0] from None
        for node in script.body:
            if isinstance(node, Definition):
                origin = "stdlib" if standard else str(path)
                self._loaded[node.name] = Procedure(node.name, node, origin)
                self._files[node.name] = path, changed


def _last_change(path: Path) -> float:
    """When a file was written last, NaN where it is not there any more."""
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return math.nan
