"""Scenes of a report: what one sees of a VTK series, made small.

The surface of the bodies, edges of their elements, the upper sides of joints; displacements and a
few fields at some instants, in 16 bits of the largest value, as differences from one instant to the
next, deflated. pyvista reads the series and finds the surface.
"""

import base64
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.atomic import inside
from ssilang.io.errors import InputError, OutputError
from ssilang.io.vtk.library import pyvista
from ssilang.io.vtk.series import read_pvd
from ssilang.io.vtk.silence import silent
from ssilang.io.vtk.vtkhdf import opened_hdf
from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.system import in_bounds

FRAMES = 60
MOST_PARTS = 1000
"""Files of one instant."""
_ROOM, _DENSEST, _LONGEST = 10**9, 50, 600.0
"""What a series may take: bytes, and times the bytes of its files; seconds."""
LARGEST = 32767
"""Of a number in 16 bits; the one below its negative says that there is none."""
_UPPER = {9: (0, 1), 30: (0, 1), 3: (0, 1), 13: (0, 1, 2), 31: (0, 1, 2), 12: (0, 1, 2, 3)}
"""Corners of the upper side of a joint, by VTK's type of its cell (`io/vtk/grid.py`)."""


class SceneError(Exception):
    """A series that cannot be shown: `code` of the catalogue and its data."""

    def __init__(self, code: str, **data: object) -> None:
        super().__init__(code)
        self.code, self.data = code, data


_DAMAGED = (
    ArithmeticError, AttributeError, LookupError, MemoryError, RuntimeError, TypeError, ValueError,
)  # fmt: skip
"""Whatever a damaged file makes of its arrays."""
_ARRAYS = (
    "points", "triangles", "lines", "vertices", "edges", "joint_points", "joint_triangles",
    "joint_lines",
)  # fmt: skip
"""What a scene's shape has: `points`, and numbers of them."""


@dataclass(frozen=True)
class _Steps:
    """Instants of a series: their times, and what reads one."""

    times: FloatArray
    grid: Callable[[int], Any]


def guarded_scene(path: Path, most_bytes: int) -> tuple[dict[str, Any], str]:
    """As `packed_scene`, in a process of its own: VTK makes what a file declares, or ends.

    A few kB may declare more than all memory.
    """
    with suppress(ImportError):  # shared with the forks
        import pyvista  # noqa: F401
    size = sum(p.stat().st_size for p in path.parent.glob("*") if p.is_file())
    look = partial(packed_scene, path, most_bytes)
    found = in_bounds(look, _ROOM + _DENSEST * size, _LONGEST, SceneError)
    if found is None:
        raise SceneError("report.series-damaged", name=path.name)
    scene: tuple[dict[str, Any], str] = found
    return scene


def packed_scene(path: Path, most_bytes: int) -> tuple[dict[str, Any], str]:
    """What a page needs to know of a series, and its arrays as text of at most so many bytes.

    Raises
    ------
    SceneError
        If the series cannot be read, or holds nothing to see.
    """
    try:
        with silent():
            return _fitting(path, most_bytes)
    except _DAMAGED:
        raise SceneError("report.series-damaged", name=path.name) from None


def _fitting(path: Path, most_bytes: int) -> tuple[dict[str, Any], str]:
    """As many instants as so many bytes hold."""
    steps = _opened(path)
    frames = FRAMES
    while True:
        told, text = _packed(path, steps, frames)
        if len(text) <= most_bytes or frames == 1:
            return told, text
        frames = max(1, min(frames - 1, int(0.9 * frames * most_bytes / len(text))))


def _packed(path: Path, steps: _Steps, most: int) -> tuple[dict[str, Any], str]:
    count = len(steps.times)
    wanted = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
    first = next((g for i in wanted if (g := steps.grid(int(i))).n_cells), None)
    if first is None:
        raise SceneError("report.nothing-to-see", name=path.name)
    shape, frames, chosen = _Shape(first), [], []
    for i in wanted.tolist():
        grid = steps.grid(i)
        if shape.has_mesh_of(grid):  # one that is damaged, or has another mesh, is left out
            frames.append(shape.fields(grid))
            chosen.append(i)
    arrays: dict[str, NDArray[Any]] = {
        n: getattr(shape, n).astype("<f4" if n == "points" else "<u4") for n in _ARRAYS
    }
    fields = []
    for name in [n for n in frames[0] if all(n in frame for frame in frames)]:
        values = np.stack([frame[name] for frame in frames])
        there = np.isfinite(values)  # in 16 bits
        largest = float(np.abs(values[there]).max(initial=0.0))
        scale = largest / LARGEST if largest > 0.0 else 1.0
        numbers = np.full(values.shape, -LARGEST - 1, "<i2")
        numbers[there] = np.rint(values[there] / scale).astype("<i2")
        arrays[f"field:{name}"] = np.diff(numbers, axis=0, prepend=np.zeros_like(numbers[:1]))
        kept = values[np.isfinite(values)]
        low, high = (float(kept.min()), float(kept.max())) if kept.size else (0.0, 0.0)
        fields.append({"name": name, "scale": scale, "low": low, "high": high})
    blob, places = b"", {}
    for name, array in arrays.items():
        blob += b"\0" * (-len(blob) % 4)
        places[name] = [len(blob), int(array.size)]
        blob += array.tobytes()
    told = {
        "times": [float(f"{t:.7g}") for t in steps.times[chosen]],
        "flat": shape.flat,
        "left_out": len(wanted) - len(chosen),
        "arrays": places,
        "fields": fields,
    }
    return told, base64.b64encode(zlib.compress(blob, 9)).decode()


class _Shape:
    """What one sees of a grid.

    Attributes
    ----------
    points : array (n, 3)
        Those of the surface, then those of joints.
    triangles, lines, vertices, edges : arrays
        Rows of points of the surface, of bars, of lone points, of the elements' edges.
    joint_points : array (m,)
        Rows of `points` that the corners of joints stand at, joint by joint.
    joint_triangles, joint_lines : arrays
        Places in `joint_points`.
    """

    def __init__(self, grid: Any) -> None:
        self._size, self._types = grid.n_points, np.asarray(grid.celltypes).copy()
        found = np.zeros(grid.n_cells, bool)  # joints: cells that have an opening or a traction
        for name in ("opening", "traction"):
            values = grid.cell_data.get(name)
            if values is not None:
                found |= np.isfinite(np.asarray(values, float).reshape(len(found), -1)).any(axis=1)
        self.joints = found & np.isin(grid.celltypes, list(_UPPER))
        self.bodies = np.flatnonzero(~self.joints)
        grid.point_data["_row"] = np.arange(grid.n_points)
        self.flat = bool(np.ptp(grid.points[:, 2]) == 0.0 if grid.n_points else True)
        empty = np.zeros(0, np.int64)
        self.triangles = self.lines = self.vertices = self.edges = empty
        rows = empty
        if len(self.bodies):
            part = grid.extract_cells(self.bodies)
            surface = part.extract_surface(
                pass_pointid=False, pass_cellid=False, nonlinear_subdivision=0,
                algorithm="dataset_surface",
            )  # fmt: skip
            rows = np.asarray(surface.point_data["_row"], np.int64)
            faces = surface.triangulate()
            self.triangles = faces.faces.reshape(-1, 4)[:, 1:].ravel()
            self.lines = _pairs(surface.GetLines())
            self.vertices = _cells_of(surface.GetVerts())[1]
            self.edges = _edges_of(surface)
        corners = list(_corners(grid, self.joints))
        flat = np.array([p for c in corners for p in c], np.int64)
        self.rows = np.concatenate([rows, np.setdiff1d(flat, rows)])
        place = np.zeros(grid.n_points, np.int64)
        place[self.rows] = np.arange(len(self.rows))
        self.joint_points = place[flat]
        self.points = np.asarray(grid.points, float)[self.rows]
        self.sizes = np.array([len(c) for c in corners], np.int64)
        starts = np.concatenate([[0], np.cumsum(self.sizes)])[:-1]
        triangles: list[int] = []
        lines: list[int] = []
        for start, size in zip(starts.tolist(), self.sizes.tolist(), strict=True):
            if size == 2:
                lines += [start, start + 1]
            for k in range(2, size):
                triangles += [start, start + k - 1, start + k]
        self.joint_triangles, self.joint_lines = np.array(triangles, int), np.array(lines, int)

    def has_mesh_of(self, grid: Any) -> bool:
        """Whether a grid has the cells of the first one."""
        return grid.n_points == self._size and np.array_equal(grid.celltypes, self._types)

    def fields(self, grid: Any) -> dict[str, FloatArray]:
        """Displacement (n 3,), and what points (n,) and joints (m,) have at an instant."""
        size = grid.n_points
        u = grid.point_data.get("displacement")
        if u is None or len(u) != size:
            u = np.zeros((size, 3))
        found = {"displacement": np.nan_to_num(np.asarray(u, float))[self.rows].ravel()}
        stress = grid.cell_data.get("stress")
        if stress is not None and stress.ndim == 2 and stress.shape[1] == 6:
            s = self._at_points(grid, np.asarray(stress, float))
            found["stress_vertical"] = s[:, 1 if self.flat else 2]
            found["stress_mises"] = _mises(s)
        for name, array, sign in (("opening", "opening", 1.0), ("pressure", "traction", -1.0)):
            values = grid.cell_data.get(array)
            if values is not None and len(self.sizes):
                normal = values[:, 0] if values.ndim == 2 else values
                found[name] = np.repeat(sign * np.asarray(normal, float)[self.joints], self.sizes)
        return found

    def _at_points(self, grid: Any, values: FloatArray) -> FloatArray:
        """Means of the cells around each point of the surface; nan where none has a value."""
        offset, nodes = _cells_of(grid.GetCells())
        cell = np.repeat(np.arange(grid.n_cells), np.diff(offset))
        whole = np.asarray(np.isfinite(values).all(axis=1))
        there = whole[cell]
        nodes, cell = nodes[there], cell[there]
        count = np.bincount(nodes, minlength=grid.n_points)
        columns = [np.bincount(nodes, c[cell], minlength=grid.n_points) for c in values.T]
        with np.errstate(invalid="ignore", divide="ignore"):
            mean: FloatArray = (np.stack(columns, axis=1) / count[:, None])[self.rows]
        return mean


def _mises(s: FloatArray) -> FloatArray:
    """Von Mises' stress of tensors (n, 6): XX YY ZZ XY YZ XZ."""
    x, y, z, xy, yz, xz = s.T
    return np.sqrt(
        0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3.0 * (xy**2 + yz**2 + xz**2)
    )


def _cells_of(cells: Any) -> tuple[IntArray, IntArray]:
    """Where the points of each cell begin in the list of all, and that list."""
    offset = pyvista.convert_array(cells.GetOffsetsArray())
    return np.asarray(offset), np.asarray(pyvista.convert_array(cells.GetConnectivityArray()))


def _corners(grid: Any, joints: BoolArray) -> Iterator[tuple[int, ...]]:
    """Points of the upper side of each joint."""
    offset, nodes = _cells_of(grid.GetCells())
    for cell in np.flatnonzero(joints).tolist():
        local = nodes[offset[cell] : offset[cell + 1]]
        yield tuple(int(local[k]) for k in _UPPER[int(grid.celltypes[cell])])


def _edges_of(surface: Any) -> IntArray:
    """Pairs of points that the sides of the faces join, each once."""
    faces = pyvista.PolyData(surface.points, faces=surface.faces)
    return faces.extract_all_edges().lines.reshape(-1, 3)[:, 1:].ravel()


def _pairs(lines: Any) -> IntArray:
    """Segments of VTK's polylines."""
    offset, nodes = _cells_of(lines)
    first = np.setdiff1d(np.arange(len(nodes)), offset[1:] - 1)
    return np.stack([nodes[first], nodes[first + 1]], axis=1).ravel()


# ---- reading -------------------------------------------------------------------------------------


def _opened(path: Path) -> _Steps:
    """A series to read."""
    try:
        import pyvista  # noqa: F401
    except ImportError as missing:
        raise SceneError("report.no-pyvista", problem=missing) from None
    if not path.is_file():
        raise SceneError("report.series-gone", name=path.name)
    steps = (_of_hdf if path.suffix == ".vtkhdf" else _of_list)(path)
    if not len(steps.times):
        raise SceneError("report.nothing-to-see", name=path.name)
    if not np.isfinite(steps.times).all():
        raise SceneError("report.series-damaged", name=path.name)
    return steps


def _of_hdf(path: Path) -> _Steps:
    try:
        reader, times = opened_hdf(path)
    except InputError:
        raise SceneError("report.series-damaged", name=path.name) from None

    def grid(step: int) -> Any:
        reader.SetStep(step)
        reader.Update()
        return _one(pyvista.wrap(reader.GetOutputDataObject(0)))

    return _Steps(np.array(times, float), grid)


def _of_list(path: Path) -> _Steps:
    try:
        entries = read_pvd(path)
    except (OSError, ValueError, InputError, OutputError):
        raise SceneError("report.series-damaged", name=path.name) from None
    files: dict[float, dict[str, None]] = {}  # each once
    for entry in entries:
        if entry.file.endswith(".vtu"):
            files.setdefault(entry.time, {})[entry.file] = None
    times = sorted(files)

    def grid(step: int) -> Any:
        names = list(files[times[step]])
        if len(names) > MOST_PARTS:
            raise SceneError("report.series-damaged", name=path.name)
        parts = {p.resolve(): p for n in names if (p := inside(path.parent, n))}
        return _one(pyvista.MultiBlock([pyvista.read(p) for p in parts.values()]))

    return _Steps(np.array(times, float), grid)


def _one(data: Any) -> Any:
    """One grid of what was read."""
    if not hasattr(data, "combine"):
        return data.copy(deep=False)
    blocks = [b for b in data if b is not None and b.n_cells]
    if not blocks:
        return data.combine(merge_points=False)
    for kind in ("point_data", "cell_data"):  # what one part lacks the others would lose
        widths = {n: getattr(b, kind)[n].shape[1:] for b in blocks for n in getattr(b, kind)}
        for block in blocks:
            arrays, size = getattr(block, kind), getattr(block, "n_" + kind[:-5] + "s")
            for name, width in widths.items():
                if name not in arrays:
                    arrays[name] = np.full((size, *width), np.nan)
    return type(data)(blocks).combine(merge_points=False)
