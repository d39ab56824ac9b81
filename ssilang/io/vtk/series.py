"""Series of .vtu files over time, gathered in a .pvd.

Files are called as Cast3M's SORT 'VTK ' calls them: NAME.xxxx.yyyy.vtu, step number and part.
"""

import re
import time as clock
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any, Self
from xml.etree import ElementTree

from ssilang.io.atomic import write_text
from ssilang.io.errors import InputError, OutputError
from ssilang.io.vtk.grid import DataArray, Grid, bare_grid, with_fields
from ssilang.io.vtk.labels import Labels
from ssilang.io.vtk.vtu import Encoding, quoteattr, write_vtu
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh

_EXTENSIONS = (".pvd", ".vtu", ".vtk", ".vtkhdf")
_LIST_EVERY = 2.0  # seconds between two updates of the .pvd: a long run stays linear in time


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh with its fields by name at one instant; see `grid_of` for the names."""

    mesh: Mesh
    point_fields: Mapping[str, NodeField] = field(default_factory=dict)
    cell_fields: Mapping[str, CellField] = field(default_factory=dict)
    labels: Labels = field(default_factory=Labels)


class Series(ABC):
    """Steps of named parts over time, in files that begin with one name.

    Use it as a context manager, or call `close`.

    Parameters
    ----------
    base : Path
        Directory and name without extension; an extension of VTK's is dropped.
    constants : mapping of str to float, optional
        Field data of each file.

    Attributes
    ----------
    files : list of Path
        What has been written.
    labels : dict of str to (Mesh, Labels)
        Meshes of the parts of the last step, and what their cells are called.
    one_file : bool
        Whether all steps are in one file.
    """

    one_file = False

    def __init__(self, base: Path, constants: Mapping[str, float] | None = None) -> None:
        self.base = strip_extension(base)
        self.constants = constants or {}
        self.files: list[Path] = []
        self.labels: dict[str, tuple[Mesh, Labels]] = {}
        self._bare: dict[str, tuple[Mesh, int, Grid]] = {}

    @property
    @abstractmethod
    def last_time(self) -> float | None:
        """Time of the last step, None before the first."""

    @property
    @abstractmethod
    def part_names(self) -> tuple[str, ...]:
        """Names of the parts of the last step."""

    def write_parts(self, time: float, parts: Mapping[str, Part]) -> None:
        """Write a step of several named parts ('': the only one).

        Raises
        ------
        OutputError
            If it cannot follow the step before, or cannot be written.
        """
        self._check_next(time, tuple(parts))
        self._write(time, parts)
        self.labels = {name: (part.mesh, part.labels) for name, part in parts.items()}

    @abstractmethod
    def _write(self, time: float, parts: Mapping[str, Part]) -> None:
        """Write a step that can follow."""

    @abstractmethod
    def close(self) -> None:
        """Finish what is written."""

    def position(self) -> Any:
        """How far the series is, for `go_back`, in plain values; None if it cannot go on later."""
        return None

    def go_back(self, position: Any) -> None:
        """Go on from where an earlier run was: what it wrote stands."""
        raise NotImplementedError

    def release(self) -> None:
        """Let go of what is held open: another series takes this one's place."""
        return

    def accepts(self, time: float, parts: tuple[str, ...]) -> bool:
        """Whether a step at that time with these parts can follow."""
        later = self.last_time is None or time > self.last_time
        return later and (self.last_time is None or self.part_names == parts)

    def _check_next(self, time: float, parts: tuple[str, ...]) -> None:
        if self.last_time is None:
            return
        if time <= self.last_time:
            raise OutputError("io.step-time-comes-after", time=time, last_time=self.last_time)
        if self.part_names != parts:
            old, new = ", ".join(self.part_names), ", ".join(parts)
            raise OutputError("io.series-parts-step-brings", old=old, new=new)

    def grid(self, name: str, part: Part) -> Grid:
        """The grid of a part; what the mesh of the step before has is not made again."""
        mesh = part.mesh
        before, version, bare = self._bare.get(name, (None, 0, None))
        if bare is None or before is not mesh or version != mesh.nodes.version:
            bare = bare_grid(mesh)
            self._bare[name] = (mesh, mesh.nodes.version, bare)
        return with_fields(bare, mesh, part.point_fields, part.cell_fields)

    def write(
        self,
        time: float,
        mesh: Mesh,
        point_fields: Mapping[str, NodeField] | None = None,
        cell_fields: Mapping[str, CellField] | None = None,
    ) -> None:
        """Write a step of one part."""
        self.write_parts(time, {"": Part(mesh, point_fields or {}, cell_fields or {})})

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


class SeriesWriter(Series):
    """Writes one .vtu a part and step, and the .pvd that lists them.

    Each file appears whole; if the run breaks, the .pvd lists the steps that were finished.

    Parameters
    ----------
    base, constants
        See `Series`.
    resume : bool
        Go on after the last step of the .pvd that is there.
    listed : bool
        False: no .pvd is written.

    Raises
    ------
    OutputError
        If a time does not grow, the parts change from one step to the next, or files of the
        series are gone.
    """

    def __init__(
        self,
        base: Path,
        encoding: Encoding = Encoding.ZIP,
        *,
        resume: bool = False,
        listed: bool = True,
        constants: Mapping[str, float] | None = None,
    ) -> None:
        super().__init__(base, constants)
        self.encoding = encoding
        self.listed = listed
        self._entries = read_pvd(self.list_path) if resume else []
        self._listed_at = clock.monotonic()

    @property
    def list_path(self) -> Path:
        """The .pvd file."""
        return self.base.with_name(self.base.name + ".pvd")

    @property
    def last_time(self) -> float | None:
        """Time of the last step, None before the first."""
        return self._entries[-1].time if self._entries else None

    @property
    def part_names(self) -> tuple[str, ...]:
        """Names of the parts of the last step."""
        return tuple(e.part for e in self._entries if e.time == self.last_time)

    def write_single(self, part: Part) -> None:
        """Write the only file of a series: BASE.vtu, without a step's number."""
        path = self.base.with_name(self.base.name + ".vtu")
        write_vtu(path, self._labelled("", part), self.encoding, constants=self._told(part))
        self.files.append(path)
        self._entries = [Entry(0.0, "", path.name)]
        self.close()

    def position(self) -> Any:
        """Its steps."""
        return [[e.time, e.part, e.file] for e in self._entries]

    def go_back(self, position: Any) -> None:
        """The files of these steps stand.

        Raises
        ------
        OutputError
            If files are gone.
        """
        self._entries = [Entry(time, part, file) for time, part, file in position]
        self._check(self._entries)
        self.files = [self.base.parent / e.file for e in self._entries]

    def _write(self, time: float, parts: Mapping[str, Part]) -> None:
        self._check(self._entries[-1:])
        number = len({e.time for e in self._entries}) + 1
        made = [self._write_part(time, number, name, part) for name, part in parts.items()]
        self._entries += made
        if self.listed and clock.monotonic() - self._listed_at > _LIST_EVERY:
            self._list()

    def close(self) -> None:
        """Write the .pvd."""
        if self._entries and self.listed:
            self._list()

    def _write_part(self, time: float, number: int, name: str, part: Part) -> "Entry":
        tag = re.sub(r"[^\w\-]+", "_", name)
        suffix = f".{number:04d}.{tag}" if tag else f".{number:04d}"
        path = self.base.with_name(f"{self.base.name}{suffix}.vtu")
        write_vtu(path, self._labelled(name, part), self.encoding, time, self._told(part))
        self.files.append(path)
        return Entry(time, name, path.name)

    def _labelled(self, name: str, part: Part) -> Grid:
        grid = self.grid(name, part)
        grid.cell_data.update((what, DataArray(n)) for what, n in part.labels.numbers.items())
        return grid

    def _told(self, part: Part) -> dict[str, float]:
        return {**self.constants, **part.labels.names}

    def _check(self, entries: "list[Entry]") -> None:
        """Check that files of the series are still there."""
        gone = [e.file for e in entries if not (self.base.parent / e.file).is_file()]
        if gone:
            raise OutputError("io.series-files-gone", path=self.list_path, names=gone[:3])

    def _list(self) -> None:
        self._check(self._entries)
        write_pvd(self.list_path, self._entries)
        self._listed_at = clock.monotonic()
        if self.list_path not in self.files:
            self.files.append(self.list_path)


def strip_extension(path: Path) -> Path:
    """`path` without an extension of VTK's."""
    return path.with_suffix("") if path.suffix.lower() in _EXTENSIONS else path


# The list of a series' files and times (.pvd), which ParaView opens as one data set.


@dataclass(frozen=True, slots=True)
class Entry:
    """One file of a series: time, part name, file name relative to the .pvd."""

    time: float
    part: str
    file: str


def write_pvd(path: Path, entries: list[Entry]) -> None:
    """Write the collection `path`, whole or not at all."""
    numbers = {name: i for i, name in enumerate(dict.fromkeys(e.part for e in entries))}
    lines = [
        f'<DataSet timestep="{e.time!r}" group="" part="{numbers[e.part]}"'
        f" name={quoteattr(e.part)} file={quoteattr(e.file)}/>"
        for e in entries
    ]
    body = "\n".join(lines)
    write_text(
        path,
        '<?xml version="1.0"?>\n'
        '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f"<Collection>\n{body}\n</Collection>\n</VTKFile>\n",
    )


def read_pvd(path: Path) -> list[Entry]:
    """The entries of a collection.

    Raises
    ------
    InputError
        If the file is absent or no collection.
    """
    try:
        root = ElementTree.parse(path).getroot()
        return [
            Entry(float(e.attrib["timestep"]), e.attrib.get("name", ""), e.attrib["file"])
            for e in root.iter("DataSet")
        ]
    except (OSError, ElementTree.ParseError, KeyError, ValueError) as error:
        raise InputError("io.not-readable-pvd-collection", path=path, error=error) from error
