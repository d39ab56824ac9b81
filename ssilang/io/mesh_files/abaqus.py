"""Meshes in Abaqus decks (.inp): nodes, elements, sets.

Sources: the keywords *NODE, *ELEMENT, *NSET, *ELSET, *INCLUDE of Abaqus' manuals. Read here and
not by meshio, whose reader (5.3) knows one plane element, keeps the last *NODE block alone and
gives the sets of *ELEMENT lines to wrong elements as soon as one of these lines names no set.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ssilang.io.errors import InputError, text_of
from ssilang.io.mesh_files.file_mesh import FileMesh, Part, names_in, padded, refuse_doubles
from ssilang.io.vtk.grid import ORDERS

# family of elements (letters before the number of nodes) and that number -> cell type
_SOLIDS = {int(n.removeprefix("C3D")): kind for kind, n in names_in("solid").items()}
_SURFACES = {int(n): kind for kind, n in names_in("plane").items()}
_LINES = {2: "SEG2", 3: "SEG3"}
_NUMBERED = {
    "C3D": _SOLIDS, "DC3D": _SOLIDS, "AC3D": _SOLIDS,
    "CPE": _SURFACES, "CPS": _SURFACES, "CPEG": _SURFACES, "CAX": _SURFACES, "DC2D": _SURFACES,
    "DCAX": _SURFACES, "AC2D": _SURFACES, "S": _SURFACES, "STRI": _SURFACES, "DS": _SURFACES,
    "M3D": _SURFACES, "R3D": _SURFACES | {2: "SEG2"}, "SFM3D": _SURFACES, "R2D": _LINES,
    "T2D": _LINES, "T3D": _LINES,
}  # fmt: skip
# beams: the first digit is the space's, the second the shape functions'; cubic ones have two nodes
_BEAMS = {"1": "SEG2", "2": "SEG3", "3": "SEG2"}
_NAME = re.compile(r"([A-Z]+(?:[23]D)?)(\d+)")
_MIDDLE_SECOND = (0, 1, 2)  # of a line's three nodes the second is the middle one, as Cast3M's
_MOST = 10**7, 20  # members of all sets, and of sets for each node or element: one of both is met
_FILES = 1000  # that a deck includes
_GENERATED = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM")
"""Keywords that make nodes or elements, or move them, without their being written."""

_Member = str | int | range
"""What a line of a set names: another set, a number, numbers that are generated."""


@dataclass
class _Deck:
    """What has been read, by the deck's numbers."""

    points: dict[int, list[float]] = field(default_factory=dict)
    rows: dict[str, list[list[int]]] = field(default_factory=dict)
    place: dict[int, tuple[str, int]] = field(default_factory=dict)
    node_sets: dict[str, list[_Member]] = field(default_factory=dict)
    cell_sets: dict[str, list[_Member]] = field(default_factory=dict)
    left_out: dict[str, int] = field(default_factory=dict)
    unread: set[int] = field(default_factory=set)
    parts: int = 0


def read_abaqus(path: Path, allowed: Callable[[str], Path]) -> FileMesh:
    """Read a deck and those it includes.

    Parameters
    ----------
    allowed : function
        The path of an included file by its name, where it may be read.

    Raises
    ------
    InputError
        If it cannot be read, has no nodes, or makes some of them in ways that are not read.
    """
    deck = _Deck()
    try:
        _read(_blocks(path, allowed, []), deck, path.name)
        if not deck.points:
            raise InputError("io.mesh-file-empty", name=path.name, kind="ABAQUS")
        return _gathered(deck).sound(path.name, "ABAQUS")
    except (ValueError, LookupError, OverflowError, RecursionError) as error:
        raise InputError(
            "io.no-readable-mesh-file", name=path.name, kind="ABAQUS", error=error
        ) from error


def _blocks(
    path: Path, allowed: Callable[[str], Path], read: list[Path]
) -> Iterator[tuple[str, dict[str, str], list[str]]]:
    """Keyword, its parameters and its data lines, with included files in their place."""
    if len(read) > _FILES:
        raise ValueError("*INCLUDE")
    read.append(path)
    text = text_of(path, "latin-1")
    lines = [t for t in text.splitlines() if t.strip() and not t.startswith("**")]
    starts = [i for i, t in enumerate(lines) if t.startswith("*")]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        head, data = lines[start], lines[start + 1 : end]
        if head.rstrip().endswith(",") and data:  # a keyword line goes on
            head, data = head + data[0], data[1:]
        word, *said = (t.strip() for t in head[1:].split(","))
        parameters = {
            k.strip().upper(): v.strip().strip('"') for k, _, v in (t.partition("=") for t in said)
        }
        if word.upper() == "INCLUDE":
            yield from _blocks(allowed(parameters["INPUT"]), allowed, read)
        else:
            yield " ".join(word.upper().split()), parameters, data


def _read(blocks: Iterator[tuple[str, dict[str, str], list[str]]], deck: _Deck, name: str) -> None:
    for word, said, data in blocks:
        if word in _GENERATED or (word == "INSTANCE" and any(t.strip() for t in data)):
            raise InputError("io.abaqus-keyword-not-read", name=name, word=word)
        if word == "PART":
            deck.parts += 1
            if deck.parts > 1:
                raise InputError("io.abaqus-several-parts", name=name)
        elif word == "NODE":
            _read_nodes(said, data, deck, name)
        elif word == "ELEMENT":
            _read_cells(said, data, deck, name)
        elif word in ("NSET", "ELSET"):
            sets = deck.node_sets if word == "NSET" else deck.cell_sets
            _set(sets, said[word]).extend(_members("GENERATE" in said, data))


def _set(sets: dict[str, list[_Member]], name: str) -> list[_Member]:
    """The members of a set, whose name is written in any case."""
    known = next((n for n in sets if n.upper() == name.upper()), name)
    return sets.setdefault(known, [])


def _members(generated: bool, data: list[str]) -> Iterator[_Member]:
    for line in data:
        words = [t.strip().strip('"') for t in line.split(",") if t.strip()]
        if generated:
            first, last, step = ([int(t) for t in words] + [1])[:3]
            yield range(first, last + 1, step)
        else:
            yield from (int(t) if t.lstrip("-").isdigit() else t for t in words)


def _read_nodes(said: dict[str, str], data: list[str], deck: _Deck, name: str) -> None:
    members = _set(deck.node_sets, said["NSET"]) if "NSET" in said else []
    for line in data:
        number, *x = line.rstrip().rstrip(",").split(",")
        point = [float(t.upper().replace("D", "E") or 0) for t in x[:3]]
        known = deck.points.setdefault(int(number), point)
        refuse_doubles(name, [(int(number), known), (int(number), point)])
        members.append(int(number))


def _read_cells(said: dict[str, str], data: list[str], deck: _Deck, name: str) -> None:
    kind = said["TYPE"].upper()
    cell_type = _cell_type(kind)
    numbers = [int(t) for line in data for t in line.split(",") if t.strip()]
    members = _set(deck.cell_sets, said["ELSET"]) if "ELSET" in said else []
    if not cell_type:
        ended = [True, *(not line.rstrip().endswith(",") for line in data)]
        firsts = [int(t.split(",")[0]) for t, new in zip(data, ended, strict=False) if new]
        deck.left_out[kind] = deck.left_out.get(kind, 0) + len(firsts)
        deck.unread |= set(firsts)
        members += firsts
        return
    size = len(ORDERS[cell_type][1]) + 1
    if len(numbers) % size:
        raise ValueError(f"*ELEMENT, TYPE={kind}")
    rows = deck.rows.setdefault(cell_type, [])
    for i in range(0, len(numbers), size):
        number, row = numbers[i], (cell_type, len(rows))
        refuse_doubles(name, [(number, deck.place.setdefault(number, row)), (number, row)])
        rows.append(numbers[i + 1 : i + size])
        members.append(numbers[i])


def _cell_type(kind: str) -> str:
    """Cell type of an element, '' where it has none here."""
    found = _NAME.match(kind)
    if found is None:
        return ""
    family, digits = found.groups()
    if family == "B":
        return _BEAMS.get(digits[1:2], "")
    if family == "STRI":
        return {"3": "TRI3", "65": "TRI6"}.get(digits, "")
    return _NUMBERED.get(family, {}).get(int(digits), "")


def _gathered(deck: _Deck) -> FileMesh:
    row_of = {number: i for i, number in enumerate(deck.points)}
    width = max(len(x) for x in deck.points.values())
    points = np.array([x + [0.0] * (width - len(x)) for x in deck.points.values()])
    cells = {}
    for cell_type, rows in deck.rows.items():
        order = _MIDDLE_SECOND if cell_type == "SEG3" else np.argsort(ORDERS[cell_type][1])
        table = np.array([[row_of[n] for n in row] for row in rows], dtype=np.int64)
        cells[cell_type] = table.reshape(len(rows), -1)[:, order]
    parts: dict[str, Part] = {}
    numbers = _Numbers(deck.cell_sets, len(deck.place) + len(deck.unread))
    for name in deck.cell_sets:
        chosen: dict[str, list[int]] = {}
        for number in numbers[name]:
            if number not in deck.unread:
                cell_type, row = deck.place[number]
                chosen.setdefault(cell_type, []).append(row)
        parts[name] = Part({k: np.unique(rows) for k, rows in chosen.items()})
    numbers = _Numbers(deck.node_sets, len(deck.points))
    for name in deck.node_sets:
        nodes = [row_of[number] for number in numbers[name]]
        known = next((n for n in parts if n.upper() == name.upper()), name)
        parts[known] = Part(
            parts[known].cells if known in parts else {}, np.unique(np.array(nodes, np.int64))
        )
    return FileMesh(padded(points), cells, parts, deck.left_out)


class _Numbers:
    """The numbers in each set and in those that it names, each once."""

    def __init__(self, sets: dict[str, list[_Member]], count: int) -> None:
        self._sets = {name.upper(): members for name, members in sets.items()}
        self._count = count
        self._left = max(_MOST[0], _MOST[1] * count)
        self._found: dict[str, set[int] | None] = {}  # None of a set that is being read

    def __getitem__(self, name: str) -> set[int]:
        key = name.upper()
        if key not in self._found:
            self._found[key], found = None, set[int]()
            for member in dict.fromkeys(self._sets[key]):
                more = self[member] if isinstance(member, str) else member
                if isinstance(more, range) and len(more) > self._count:
                    raise ValueError(f"{name}, GENERATE")
                more = (more,) if isinstance(more, int) else more
                self._left -= len(more)
                if self._left < 0:
                    raise ValueError(f"*NSET, *ELSET {name}")
                found.update(more)
            self._found[key] = found
        known = self._found[key]
        if known is None:
            raise ValueError(name)
        return known
