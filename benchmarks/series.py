"""One .vtkhdf against a series of .vtu: seconds, bytes and files of 1 000 instants.

    OMP_NUM_THREADS=1 python benchmarks/series.py [instants [unknowns]]

A plane block of QUA4 with displacement, velocity and acceleration in its nodes and a stress in its
cells, as DYNAMIC writes them, that a decaying wave moves; mesh and fields are the same on both
sides. The two are written in turn, in slices, and timed by the processor; the last one is read back
with VTK and compared to the last bit. If h5py is installed, its own writer of the same arrays with
the same filters is timed too, flushed after each instant as a file must be that a kill may meet.
"""

import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.vtk import Part, SeriesWriter
from ssilang.io.vtk.grid import Grid, bare_grid, with_fields
from ssilang.io.vtk.vtkhdf import VtkHdfWriter
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

SLICES = 20
_COLUMNS = ("SMXX", "SMYY", "SMZZ", "SMXY")


def block(unknowns: int) -> Mesh:
    """A square mesh with about so many unknowns, two a node."""
    side = max(round((unknowns / 2) ** 0.5), 2)
    table = NodeTable()
    x, y = np.meshgrid(np.linspace(0.0, 10.0, side), np.linspace(0.0, 10.0, side), indexing="ij")
    ids = table.add(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(side, side)
    corners = (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:])
    return Mesh.of(table, "QUA4", np.stack([c.ravel() for c in corners], axis=1))


def part_at(mesh: Mesh, t: float) -> Part:
    """The fields of an instant: a wave that runs and decays."""
    ids = mesh.sorted_node_ids
    x, y = mesh.nodes.coordinates[ids, :2].T
    fields = {}
    for k, name in enumerate(("displacement", "velocity", "acceleration")):
        u = np.exp(-0.1 * t) * np.sin(x - 3.0 * t + k) * np.cos(0.3 * y)
        v = np.exp(-0.2 * t) * np.cos(y - 2.0 * t - k) * np.sin(0.2 * x)
        fields[name] = NodeField.of(mesh.nodes, ids, {"UX": u, "UY": v})
    cells = mesh.blocks[0]
    middle = mesh.nodes.coordinates[cells.connectivity].mean(axis=1)
    stress = {
        c: np.sin(middle[:, :1] - 3.0 * t + i) * np.cos(middle[:, 1:2] + 0.1 * np.arange(4.0))
        for i, c in enumerate(_COLUMNS)
    }
    return Part(mesh, fields, {"stress": CellField((CellFieldBlock(cells, stress, "STRESSES"),))})


class H5pyWriter:
    """The same arrays by h5py, flushed after each instant."""

    def __init__(self, path: Path) -> None:
        import h5py

        self._file: Any = h5py.File(path, "w")
        self._sets: dict[str, Any] = {}
        self._count = 0
        self._bare: Grid | None = None

    def write(self, t: float, part: Part) -> None:
        """Append an instant."""
        if self._bare is None:
            self._bare = bare_grid(part.mesh)
        grid = with_fields(self._bare, part.mesh, part.point_fields, part.cell_fields)
        arrays = {f"PointData/{n}": a.values for n, a in grid.point_data.items()}
        arrays |= {f"CellData/{n}": a.values for n, a in grid.cell_data.items()}
        arrays["Steps/Values"] = np.array([t])
        for name, values in arrays.items():
            if name not in self._sets:
                packed = {"compression": 1, "shuffle": True} if len(values) > 1 else {}
                self._sets[name] = self._file.create_dataset(
                    f"VTKHDF/{name}",
                    (0, *values.shape[1:]),
                    dtype=values.dtype,
                    maxshape=(None, *values.shape[1:]),
                    chunks=values.shape if len(values) > 1 else (64,),
                    **packed,
                )
            rows = len(values)
            self._sets[name].resize((self._count + 1) * rows, 0)
            self._sets[name][self._count * rows :] = values
        self._count += 1
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def write_all(write: Callable[[float, Part], None], times: list[float], parts: list[Part]) -> None:
    """Write these instants."""
    for t, part in zip(times, parts, strict=True):
        write(t, part)


def timed(action: Callable[[], None]) -> float:
    """Seconds of the processor."""
    began = time.process_time()
    action()
    return time.process_time() - began


def main() -> None:
    """Write all in turn, print the table, read back."""
    instants = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    mesh = block(int(sys.argv[2]) if len(sys.argv) > 2 else 7500)
    times = 0.01 * np.arange(instants)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = SeriesWriter(folder / "files" / "s")
        one = VtkHdfWriter(folder / "one" / "s")
        writers: dict[str, tuple[Callable[[float, Part], None], Callable[[], None], Path]] = {
            ".vtu and .pvd": (
                lambda t, part: files.write_parts(t, {"": part}),
                files.close,
                folder / "files",
            ),
            ".vtkhdf": (lambda t, part: one.write_parts(t, {"": part}), one.close, folder / "one"),
        }
        try:
            peer = H5pyWriter(folder / "h5py.h5")
            writers["h5py, flushed"] = (peer.write, peer.close, folder / "h5py.h5")
        except ImportError:
            print("h5py is not installed: left out")
        spent = dict.fromkeys(writers, 0.0)
        for chosen in np.array_split(times, min(SLICES, instants)):
            parts = [part_at(mesh, float(t)) for t in chosen]
            for label, (write, _, _) in writers.items():
                spent[label] += timed(partial(write_all, write, chosen.tolist(), parts))
        for label, (_, close, place) in writers.items():
            spent[label] += timed(close)
            report(label, spent[label], place, instants)
        print(f"last instant the same to the last bit: {same_end(folder, instants)}")


def report(label: str, seconds: float, place: Path, instants: int) -> None:
    """Print a line of the table."""
    found = [p for p in place.rglob("*") if p.is_file()] if place.is_dir() else [place]
    size = sum(p.stat().st_size for p in found)
    print(
        f"{label:>14}: {seconds:7.2f} s, {1e3 * seconds / instants:6.2f} ms an instant, "
        f"{size / 1e6:7.1f} MB in {len(found)} file{'s' * (len(found) > 1)}"
    )


def same_end(folder: Path, instants: int) -> bool:
    """Whether VTK reads the same of both at the last instant."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(folder / "one" / "s.vtkhdf"))
    reader.UpdateInformation()
    reader.SetStep(instants - 1)
    reader.Update()
    other = vtk.vtkXMLUnstructuredGridReader()
    other.SetFileName(str(folder / "files" / f"s.{instants:04d}.vtu"))
    other.Update()
    one, two = reader.GetOutput(), other.GetOutput()
    pairs = [
        (one.GetPointData().GetArray(n), two.GetPointData().GetArray(n))
        for n in ("displacement", "velocity", "acceleration")
    ]
    pairs.append((one.GetCellData().GetArray("stress"), two.GetCellData().GetArray("stress")))
    pairs.append((one.GetPoints().GetData(), two.GetPoints().GetData()))
    return all(np.array_equal(vtk_to_numpy(a), vtk_to_numpy(b)) for a, b in pairs)


if __name__ == "__main__":
    main()
