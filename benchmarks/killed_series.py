"""What a kill leaves of a .vtkhdf: states of the file between two writes, read by VTK.

    python benchmarks/killed_series.py [states [instants]]

A run that is killed leaves what its last write made of the file. Both writers put the same series
down, h5py as its documents advise (values first, `NSteps` last, flushed before and after), all
writes are kept, and states of the file in the middle of the series are read in processes of their
own: right values at the last step that the file tells of, wrong ones, or a reader that dies.
h5py comes with `pip install h5py`; without it, this project's writer is looked at alone.
"""

import io
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from ssilang.io.vtk import vtkhdf
from ssilang.io.vtk.growing import GrowingFile
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

NODES = 200
SAID = ("right", "wrong or none", "the reader dies")
Writes = list[tuple[int, bytes]]


def values_at(step: int) -> np.ndarray:
    """What the nodes have at a step."""
    return np.cos(step + np.arange(float(NODES)))


def own_writes(path: Path, instants: int) -> Writes:
    """What this project's writer writes, in order."""
    log: Writes = []

    class Logged(GrowingFile):
        def put(self, address: int, data: bytes) -> None:
            log.append((address, bytes(data)))
            super().put(address, data)

    vtkhdf.GrowingFile = Logged  # type: ignore[misc]
    table = NodeTable()
    ids = table.add(np.arange(float(NODES))[:, None])
    mesh = Mesh.of(table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))
    with vtkhdf.VtkHdfWriter(path) as series:
        for i in range(instants):
            series.write(float(i), mesh, {"": NodeField.of(table, ids, {"T": values_at(i)})})
    return log


class Memory(io.BytesIO):
    """A file that h5py writes to; it keeps what was written where."""

    def __init__(self) -> None:
        super().__init__()
        self.log: Writes = []

    def write(self, data: Any) -> int:
        self.log.append((self.tell(), bytes(data)))
        return super().write(data)


def h5py_writes(instants: int) -> Writes:
    """What h5py writes."""
    import h5py

    memory = Memory()
    file = h5py.File(memory, "w")
    group = file.create_group("VTKHDF")
    group.attrs["Version"] = np.array([2, 0])
    group.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
    ends = np.arange(NODES, dtype=np.int64)
    group["Points"] = np.stack([np.arange(float(NODES)), np.zeros(NODES), np.zeros(NODES)], axis=1)
    group["Connectivity"], group["Offsets"] = ends, np.arange(NODES + 1)
    group["Types"] = np.ones(NODES, dtype=np.uint8)
    for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
        group[name] = np.array([NODES])
    steps = group.create_group("Steps")
    steps.attrs["NSteps"] = 0
    rows = {"NumberOfParts": 1, "PartOffsets": 0, "PointOffsets": 0}
    pairs = {"CellOffsets": 0, "ConnectivityIdOffsets": 0}
    sets: dict[str, Any] = {
        **{n: steps.create_dataset(n, (0,), "i8", maxshape=(None,)) for n in rows},
        **{n: steps.create_dataset(n, (0, 1), "i8", maxshape=(None, 1)) for n in pairs},
        "Values": steps.create_dataset("Values", (0,), "f8", maxshape=(None,)),
        "T": group.create_dataset(
            "PointData/T", (0,), "f8", maxshape=(None,), chunks=(NODES,), compression=1
        ),
        "start": steps.create_dataset("PointDataOffsets/T", (0,), "i8", maxshape=(None,)),
    }
    for i in range(instants):
        new = {**rows, **pairs, "Values": float(i), "start": i * NODES, "T": values_at(i)}
        for name, value in new.items():
            count = NODES if name == "T" else 1
            sets[name].resize((i + 1) * count, 0)
            sets[name][i * count :] = value
        file.flush()
        steps.attrs.modify("NSteps", i + 1)
        file.flush()
    return memory.log


def states(log: Writes, count: int) -> Iterator[bytes]:
    """The file after each of so many writes in the middle of them."""
    image, first = bytearray(), (len(log) - count) // 2
    for i, (address, data) in enumerate(log):
        image.extend(bytes(max(0, address + len(data) - len(image))))
        image[address : address + len(data)] = data
        if first <= i < first + count:
            yield bytes(image)


def read(path: Path) -> int:
    """0 if VTK finds the right values at the last step of which the file tells."""
    vtk.vtkObject.GlobalWarningDisplayOff()
    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(path))
    if not reader.CanReadFile(str(path)):
        return 1
    reader.UpdateInformation()
    step = reader.GetNumberOfSteps() - 1
    reader.SetStep(step)
    reader.Update()
    array = reader.GetOutput() and reader.GetOutput().GetPointData().GetArray("T")
    return int(not array or not np.array_equal(vtk_to_numpy(array), values_at(step)))


def found(path: Path) -> str:
    """What a process of its own finds in a file."""
    child = os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        os._exit(read(path))
    _, status = os.waitpid(child, 0)
    return SAID[os.WEXITSTATUS(status)] if os.WIFEXITED(status) else SAID[2]


def main() -> None:
    """Print a line for each writer."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    instants = int(sys.argv[2]) if len(sys.argv) > 2 else 80
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "state.vtkhdf"
        logs = {"ssilang": own_writes(Path(name) / "s", instants)}
        try:
            logs["h5py"] = h5py_writes(instants)
        except ImportError:
            print("h5py is not installed: left out")
        for label, log in logs.items():
            told: Counter[str] = Counter()
            for image in states(log, count):
                path.write_bytes(image)
                told[found(path)] += 1
            print(f"{label}: " + ", ".join(f"{told[s]} {s}" for s in SAID))


if __name__ == "__main__":
    main()
