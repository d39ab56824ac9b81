"""A series over time in one file (.vtkhdf): the mesh once, fields step by step.

Source: "VTKHDF format specification", docs.vtk.org: an UnstructuredGrid with the group `Steps`,
which says of each step where its values begin; a MultiBlockDataSet of such grids for named parts.

A step counts as soon as `NSteps` says so, and VTK's reader trusts that `Steps/Values` is as long.
Both change in one commit, behind everything else that the step has.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.errors import InputError, OutputError
from ssilang.io.vtk import hdf5
from ssilang.io.vtk.grid import DataArray, Grid
from ssilang.io.vtk.growing import (
    Column,
    GrowingFile,
    Repeated,
    Stack,
    group_header,
    write_once,
)
from ssilang.io.vtk.labels import Labels
from ssilang.io.vtk.series import Part, Series

_ONE = [hdf5.attribute("Version", (2, 0)), hdf5.attribute("Type", "UnstructuredGrid")]
_SEVERAL = [hdf5.attribute("Version", (2, 2)), hdf5.attribute("Type", "MultiBlockDataSet")]
"""What the file says it holds: a grid, or several."""
COMPONENT = ":"
"""Between the name of an array and that of a component, in the field data."""


class VtkHdfWriter(Series):
    """Writes one .vtkhdf for all steps; it is whole after each of them.

    Attributes and checks: see `Series`. An older file of that name is replaced at the first step.

    Raises
    ------
    OutputError
        If a time does not grow, parts or meshes change from one step to the next, or the file is
        gone or cannot be written.
    """

    one_file = True

    def __init__(self, base: Path, *, constants: Mapping[str, float] | None = None) -> None:
        super().__init__(base, constants)
        self.path = self.base.with_name(self.base.name + ".vtkhdf")
        self._times: Column | None = None
        self._parts: dict[str, _OneGrid] = {}

    @property
    def last_time(self) -> float | None:
        """Time of the last step, None before the first."""
        return self._times.last if self._times else None

    @property
    def part_names(self) -> tuple[str, ...]:
        """Names of the parts."""
        return tuple(self._parts)

    def _write(self, time: float, parts: Mapping[str, Part]) -> None:
        grids = {name: self.grid(name, part) for name, part in parts.items()}
        if self._times is None:
            self._begin(grids, parts)
        self._check(grids)
        assert self._times is not None
        for name, grid in grids.items():
            self._parts[name].write(grid, len(self._times))
        self._times.append(time)
        for repeated in self._repeated.values():
            repeated.lengthen(len(self._times))
        self._file.commit(self._root())
        if self.path not in self.files:
            self.files.append(self.path)

    def close(self) -> None:
        """Let the file go; nothing is left to be written."""
        if self._times is not None:
            self._file.close()

    release = close

    def _begin(self, grids: Mapping[str, Grid], parts: Mapping[str, Part]) -> None:
        file = self._file = GrowingFile(self.path)
        self._times = Column(file, "<f8", kept=False)
        self._repeated = {
            "ones": Repeated(file, 1),
            "zeros": Repeated(file, 0),
            "zeros1": Repeated(file, 0, 1),
            "ones2": Repeated(file, 1, 2),
        }
        names = {k: v for part in parts.values() for k, v in part.labels.names.items()}
        self._told = _Told(file, self._repeated, {**self.constants, **names})
        self._parts = {
            name: _OneGrid(file, self._repeated, grid, parts[name].labels, self._told)
            for name, grid in grids.items()
        }

    def _check(self, grids: Mapping[str, Grid]) -> None:
        if not self._file.is_there:
            raise OutputError("io.series-files-gone", path=self.path, names=[self.path.name])
        for name, grid in grids.items():
            part, path = self._parts[name], self.path.name
            if not part.has_mesh_of(grid):
                shown = f" ({name})" if name else ""
                raise OutputError("io.series-mesh-changed", part=shown, path=path)
            if bad := part.misfits(grid):
                raise OutputError("io.series-array-changed", names=bad, path=path)

    def _root(self) -> int:
        """Write the headers that say how many steps there are; address of the root's."""
        file, times = self._file, self._times
        assert times is not None
        values, count = file.add(times.header()), len(times)
        if tuple(self._parts) == ("",):
            top = self._parts[""].header(values, count, _ONE)
        else:
            top = self._blocks(values, count)
        return group_header(file, {"VTKHDF": top})

    def _blocks(self, values: int, count: int) -> int:
        names = _link_names(tuple(self._parts))
        links = {}
        for i, (name, part) in enumerate(self._parts.items()):
            said = [*_ONE, hdf5.attribute("Index", i)]
            links[names[name]] = part.header(values, count, said)
        if not self._assembly:
            soft = [
                hdf5.soft_link(name, i, f"/VTKHDF/{name}") for i, name in enumerate(names.values())
            ]
            self._assembly = self._file.add(hdf5.header(hdf5.group(soft)))
        links["Assembly"] = self._assembly
        return group_header(self._file, links, _SEVERAL)

    _assembly = 0


def _link_names(names: tuple[str, ...]) -> dict[str, str]:
    """Names of parts as a path can have them, each once."""
    made: dict[str, str] = {}
    for name in names:
        plain = re.sub(r"[/.]", "_", name) or "_"
        while plain in (*made.values(), "Assembly"):
            plain += "_"
        made[name] = plain
    return made


class _Fields:
    """The arrays of nodes or of cells: blocks of rows, and where each step's begin."""

    def __init__(self, file: GrowingFile) -> None:
        self._file = file
        self._stacks: dict[str, Stack] = {}
        self._starts: dict[str, Column] = {}
        self._nowhere: dict[str, int] = {}  # row of the block without values
        self.fixed: dict[str, int] = {}
        self.columns: dict[str, tuple[str, ...]] = {}  # names of the components of arrays
        self.links_changed = False

    def write(self, arrays: Mapping[str, DataArray], step: int) -> None:
        """Add a step; an array that it, or a step before, does not have is NaN there."""
        for name, array in arrays.items():
            if name not in self._stacks and array.values.size:
                values = _plain(array.values)
                self._stacks[name] = Stack(self._file, values.shape, values.dtype)
                self._starts[name] = Column(self._file, "<i8")
                for _ in range(step):
                    self._starts[name].append(self._gap(name))
                self.links_changed = True
                self.columns[name] = array.columns
        for name, stack in self._stacks.items():
            found = arrays.get(name)
            row = self._gap(name) if found is None else stack.append(_plain(found.values))
            self._starts[name].append(row)

    def links(self) -> tuple[dict[str, int], dict[str, int]]:
        """Addresses of the arrays, and of where their steps begin, by name."""
        self.links_changed = False
        arrays = {name: stack.address for name, stack in self._stacks.items()}
        starts = {name: column.address for name, column in self._starts.items()}
        return {**self.fixed, **arrays}, starts

    def shapes(self) -> dict[str, tuple[int, ...]]:
        """Shape of each array of a step."""
        return {name: stack.shape for name, stack in self._stacks.items()}

    def _gap(self, name: str) -> int:
        if name not in self._nowhere:
            stack = self._stacks[name]
            self._nowhere[name] = stack.append(np.full(stack.shape, np.nan, stack.dtype))
        return self._nowhere[name]


def _plain(values: NDArray[np.generic]) -> NDArray[np.generic]:
    """Real numbers as the file has them."""
    return np.ascontiguousarray(values, dtype="<f4" if values.dtype == np.float32 else "<f8")


class _OneGrid:
    """One grid of the file: its mesh, its fields, the groups that lead to them."""

    def __init__(
        self,
        file: GrowingFile,
        repeated: Mapping[str, Repeated],
        grid: Grid,
        labels: Labels,
        told: "_Told",
    ) -> None:
        self._file, self._repeated, self._grid, self._told = file, repeated, grid, told
        self._points = _Fields(file)
        self._cells = _Fields(file)
        self._cells.fixed = {k: write_once(file, v) for k, v in labels.numbers.items()}
        self._mesh = _mesh_links(file, grid)
        self._rest: tuple[int, list[bytes]] | None = None
        self._steps_rest: tuple[int, list[bytes]] | None = None

    def has_mesh_of(self, grid: Grid) -> bool:
        """Whether a grid's mesh is this one."""
        mine = self._grid
        pairs = [(getattr(grid, k), getattr(mine, k)) for k in ("points", "connectivity", "types")]
        return all(a is b or np.array_equal(a, b) for a, b in pairs)

    def misfits(self, grid: Grid) -> list[str]:
        """Names of the arrays whose widths are not those of the steps before."""
        return [
            name
            for mine, arrays in (
                (self._points.shapes(), grid.point_data),
                (self._cells.shapes(), grid.cell_data),
            )
            for name, array in _plain_names(arrays).items()
            if mine.get(name, array.values.shape) != array.values.shape
        ]

    def write(self, grid: Grid, step: int) -> None:
        """Add the fields of a step."""
        self._points.write(_plain_names(grid.point_data), step)
        self._cells.write(_plain_names(grid.cell_data), step)

    def header(self, values: int, count: int, said: list[bytes]) -> int:
        """Write the grid's header for so many steps, whose times stand at `values`."""
        if self._rest is None or self._points.links_changed or self._cells.links_changed:
            self._link()
        assert self._rest is not None
        assert self._steps_rest is not None
        file = self._file
        steps = hdf5.header(
            [hdf5.attribute("NSteps", count), *_first("Values", values, self._steps_rest)],
            self._steps_rest,
        )
        top = [*said, *_first("Steps", file.add(steps), self._rest)]
        return file.add(hdf5.header(top, self._rest))

    def _link(self) -> None:
        """Write the groups that stay as they are while no array is added."""
        file, ones, zeros = self._file, self._repeated["ones"], self._repeated["zeros"]
        point_links, point_starts = self._points.links()
        cell_links, cell_starts = self._cells.links()
        cell_starts |= dict.fromkeys(self._cells.fixed, zeros.address)
        told, told_steps = self._told.groups({**self._points.columns, **self._cells.columns})
        steps = {
            "NumberOfParts": ones.address,
            "PartOffsets": zeros.address,
            "PointOffsets": zeros.address,
            "CellOffsets": self._repeated["zeros1"].address,
            "ConnectivityIdOffsets": self._repeated["zeros1"].address,
            "PointDataOffsets": group_header(file, point_starts),
            "CellDataOffsets": group_header(file, cell_starts),
            **told_steps,
        }
        groups = {
            **self._mesh,
            "PointData": group_header(file, point_links),
            "CellData": group_header(file, cell_links),
            "FieldData": told,
        }
        self._rest = _behind(file, groups)
        self._steps_rest = _behind(file, steps)


class _Told:
    """Numbers that hold for all steps, by name: the field data of all grids.

    The format has no names for the components of an array: `displacement:UX` is 1 where UX is its
    first.
    """

    def __init__(
        self, file: GrowingFile, repeated: Mapping[str, Repeated], told: Mapping[str, float]
    ) -> None:
        self._file = file
        self._made = {_plain_name(name): self._number(value) for name, value in told.items()}
        self._columns: dict[int, int] = {}
        self._zeros, self._ones = repeated["zeros"].address, repeated["ones2"].address

    def groups(self, columns: Mapping[str, tuple[str, ...]]) -> tuple[int, dict[str, int]]:
        """Write the groups of a grid: address of its field data, and of where steps find them.

        Parameters
        ----------
        columns : mapping of str to tuple of str
            Names of the components of each array.
        """
        made = dict(self._made)
        for array, names in columns.items():
            for k, name in enumerate(names, 1):
                if k not in self._columns:
                    self._columns[k] = self._number(k)
                made.setdefault(f"{array}{COMPONENT}{_plain_name(name)}", self._columns[k])
        return group_header(self._file, made), {
            "FieldDataOffsets": group_header(self._file, dict.fromkeys(made, self._zeros)),
            "FieldDataSizes": group_header(self._file, dict.fromkeys(made, self._ones)),
        }

    def _number(self, value: float) -> int:
        return self._file.add(hdf5.header(hdf5.compact(np.array([value], dtype="<f8"))))


def _mesh_links(file: GrowingFile, grid: Grid) -> dict[str, int]:
    """Write the mesh; addresses of its datasets by name."""
    counts = {
        "NumberOfPoints": len(grid.points),
        "NumberOfCells": len(grid.types),
        "NumberOfConnectivityIds": len(grid.connectivity),
    }
    small = {
        name: file.add(hdf5.header(hdf5.compact(np.array([count], dtype="<i8"))))
        for name, count in counts.items()
    }
    return {
        **small,
        "Points": write_once(file, grid.points.astype("<f8")),
        "Connectivity": write_once(file, grid.connectivity.astype("<i8")),
        "Offsets": write_once(file, np.concatenate([[0], grid.offsets]).astype("<i8")),
        "Types": write_once(file, grid.types),
    }


def _behind(file: GrowingFile, links: Mapping[str, int]) -> tuple[int, list[bytes]]:
    """Write links for which a group's header has a place further on; there, and what they are."""
    made = [hdf5.hard_link(name, 1 + i, address) for i, (name, address) in enumerate(links.items())]
    return file.add(b"".join(made)), made


def _first(name: str, address: int, rest: tuple[int, list[bytes]]) -> list[bytes]:
    """The messages of a group whose first link is this one, and the others stand further on."""
    return hdf5.group([hdf5.hard_link(name, 0, address)], 1 + len(rest[1]))


def _plain_name(name: str) -> str:
    """A name as a path can have it."""
    return re.sub(r"[/.]", "_", name)


def _plain_names(arrays: Mapping[str, DataArray]) -> dict[str, DataArray]:
    return {_plain_name(name): array for name, array in arrays.items()}


def opened_hdf(path: Path) -> tuple[Any, list[float]]:
    """VTK's reader of a .vtkhdf, and its instants: pyvista gives no times of these files.

    Raises
    ------
    InputError
        If VTK knows at once that it is none.
    """
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    if not reader.CanReadFile(str(path)):
        raise InputError("io.not-viewed-no-points", path=path)
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    held, steps = reader.GetOutputInformation(0), vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return reader, list(held.Get(steps) if held.Has(steps) else ()) or [0.0]
