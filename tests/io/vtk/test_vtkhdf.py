"""Series in one file, read by VTK's own reader: values, parts, gaps, interruption, replacement."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import pyvista
from refusing import refusal
from together import together
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkFieldData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from ssilang.io.errors import OutputError
from ssilang.io.vtk import Part, SeriesWriter
from ssilang.io.vtk.grid import ORDERS
from ssilang.io.vtk.growing import GrowingFile
from ssilang.io.vtk.hdf5 import BRANCHES
from ssilang.io.vtk.labels import Labels, labels_of
from ssilang.io.vtk.vtkhdf import VtkHdfWriter, _link_names
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def opened(path: Path) -> vtkHDFReader:
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    return reader


def times_of(reader: vtkHDFReader) -> list[float]:
    """Times as the pipeline says them; VTK names them only if there are several."""
    steps = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    return list(reader.GetOutputInformation(0).Get(steps) or ())


def step_of(reader: vtkHDFReader, step: int) -> pyvista.DataObject:
    reader.SetStep(step)
    reader.Update()
    made = reader.GetOutput().NewInstance()
    made.DeepCopy(reader.GetOutput())
    return pyvista.wrap(made)


def arrays_of(data: vtkFieldData) -> dict[str, np.ndarray]:
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return {a.GetName(): vtk_to_numpy(a) for a in arrays}


def assert_same_grid(one: pyvista.UnstructuredGrid, two: pyvista.UnstructuredGrid) -> None:
    """The same mesh and the same arrays to the last bit."""
    assert np.array_equal(one.points, two.points)
    assert one.points.dtype == two.points.dtype
    assert np.array_equal(one.cell_connectivity, two.cell_connectivity)
    ends = [vtk_to_numpy(g.GetCells().GetOffsetsArray()) for g in (one, two)]
    assert np.array_equal(*ends)
    assert np.array_equal(one.celltypes, two.celltypes)
    for mine, theirs in (
        (one.GetPointData(), two.GetPointData()),
        (one.GetCellData(), two.GetCellData()),
    ):
        a, b = arrays_of(mine), arrays_of(theirs)
        assert set(a) == set(b)
        for name, values in a.items():
            assert values.dtype == b[name].dtype
            assert values.tobytes() == b[name].tobytes(), name


def all_cells() -> tuple[Mesh, CellField]:
    """One cell of each kind that can be written, at random places, with a stress in each."""
    table, rng = NodeTable(), np.random.default_rng(0)
    blocks = []
    for name in ORDERS:
        ids = table.add(rng.random((CELL_TYPES[name].n_nodes, 3)))
        blocks.append(CellBlock.make(table, name, ids[None, :]))
    columns = ("SMXX", "SMYY", "SMZZ", "SMXY", "SMYZ", "SMXZ")
    parts = tuple(
        CellFieldBlock(b, {c: rng.normal(size=(1, 4)) for c in columns}, "STRESSES") for b in blocks
    )
    return Mesh(table, tuple(blocks)), CellField(parts, "CONTRAINTES")


def moving(mesh: Mesh, seed: int) -> NodeField:
    ids = mesh.sorted_node_ids
    rng = np.random.default_rng(seed)
    names = ("UX", "UY", "UZ", "TEMP")
    return NodeField.of(mesh.nodes, ids, {c: rng.normal(size=len(ids)) for c in names})


def scaled(field: CellField, by: float) -> CellField:
    blocks = tuple(
        CellFieldBlock(b.cells, {c: by * v for c, v in b.components.items()}, b.support)
        for b in field.blocks
    )
    return CellField(blocks, field.title)


def bar(count: int = 3) -> Mesh:
    table = NodeTable()
    ids = table.add(np.arange(float(count))[:, None])
    return Mesh.of(table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))


def test_all_cells_and_fields_are_those_of_the_series_of_files(tmp_path):
    mesh, stress = all_cells()
    times = [0.0, 0.1, 0.30000000000000004, 1.0 / 3.0]
    labels = labels_of(mesh, {"group": {"a": mesh.blocks[:3], "b": mesh.blocks[2:5]}})
    constants = {"unit_m": 1.0}
    for writer in (
        SeriesWriter(tmp_path / "s", constants=constants),
        VtkHdfWriter(tmp_path / "s", constants=constants),
    ):
        with writer:
            for i, t in enumerate(times):
                part = Part(mesh, {"": moving(mesh, i)}, {"": scaled(stress, i - 1.5)}, labels)
                writer.write_parts(t, {"": part})
    reader = opened(tmp_path / "s.vtkhdf")
    assert times_of(reader) == times
    for i in range(len(times)):
        one = step_of(reader, i)
        two = pyvista.read(tmp_path / f"s.{i + 1:04d}.vtu")
        assert_same_grid(one, two)
        assert one.point_data["displacement"].shape[1] == 3
        assert one.cell_data["stress"].shape[1] == 6
        assert one.field_data["unit_m"] == [1.0]
        assert one.field_data["group_b"] == [2.0]


@pytest.mark.parametrize("count", [1, 2, BRANCHES, BRANCHES + 1, BRANCHES**2 + 3])
def test_every_step_is_found_however_many_there_are(tmp_path, count):
    mesh = bar()
    with VtkHdfWriter(tmp_path / "long") as series:
        for i in range(count):
            field = NodeField.of(mesh.nodes, mesh.sorted_node_ids, {"T": np.full(3, float(i))})
            series.write(0.5 * i, mesh, {"": field})
    reader = opened(tmp_path / "long.vtkhdf")
    assert times_of(reader) == ([0.5 * i for i in range(count)] if count > 1 else [])
    looked_at = range(count) if count < 200 else (0, 1, 63, 64, 4095, 4096, count - 1)
    for i in looked_at:
        assert step_of(reader, i).point_data["T"].tolist() == [float(i)] * 3


def test_pyvista_reads_the_file_by_its_name(tmp_path):
    mesh = bar()
    with VtkHdfWriter(tmp_path / "p.vtu") as series:
        series.write(1.0, mesh, {"": moving(mesh, 0)})
    assert series.files == [tmp_path / "p.vtkhdf"]
    assert pyvista.read(tmp_path / "p.vtkhdf").n_cells == 2


def test_arrays_that_come_late_or_leave_out_a_step_are_nan_there(tmp_path):
    mesh = bar()
    given = [None, {"u": 1}, {"u": 2, "w": 3}, {"w": 4}, {"u": 5, "w": 6}]
    with VtkHdfWriter(tmp_path / "late") as series:
        for i, seeds in enumerate(given):
            fields = {n: moving(mesh, s) for n, s in (seeds or {}).items()}
            series.write(float(i), mesh, fields)
    reader = opened(tmp_path / "late.vtkhdf")
    for i, seeds in enumerate(given):
        grid = step_of(reader, i)
        for name in ("u", "w"):
            if seeds and name in seeds:
                expected = moving(mesh, seeds[name]).components["UX"].values
                assert np.array_equal(grid.point_data[name][:, 0], expected)
            else:
                assert np.isnan(grid.point_data[name]).all()


def test_named_parts_are_blocks_of_their_own_arrays(tmp_path):
    soil, block = bar(4), bar(3)
    with VtkHdfWriter(tmp_path / "two") as series:
        for i in range(3):
            parts = {
                "soil": Part(soil, {"": moving(soil, i)}),
                "a/b": Part(block, {"velocity": moving(block, 10 + i)}),
            }
            series.write_parts(float(i), parts)
    reader = opened(tmp_path / "two.vtkhdf")
    assert times_of(reader) == [0.0, 1.0, 2.0]
    for i in range(3):
        blocks = step_of(reader, i)
        assert blocks.keys() == ["soil", "a_b"]
        assert [b.n_points for b in blocks] == [4, 3]
        expected = moving(block, 10 + i).components["UY"].values
        assert np.array_equal(blocks["a_b"].point_data["velocity"][:, 1], expected)
        assert "velocity" not in blocks["soil"].point_data


def test_the_file_is_smaller_than_the_series_and_has_the_mesh_once(tmp_path):
    mesh = bar(2000)
    for writer in (SeriesWriter(tmp_path / "s"), VtkHdfWriter(tmp_path / "s")):
        with writer:
            for i in range(20):
                field = NodeField.of(mesh.nodes, mesh.sorted_node_ids, {"T": np.full(2000, i)})
                writer.write(float(i), mesh, {"": field})
    files = sum(p.stat().st_size for p in tmp_path.glob("*.vtu"))
    assert (tmp_path / "s.vtkhdf").stat().st_size < files / 5


@together("how", ["mesh", "gone", "array", "moved", "parts", "time"])
def test_what_cannot_follow_is_refused_and_the_file_stays_whole(tmp_path, how):
    mesh = bar()
    path = tmp_path / "r.vtkhdf"
    series = VtkHdfWriter(tmp_path / "r")
    for t in (0.0, 1.0):
        series.write(t, mesh, {"": moving(mesh, int(t))})
    codes = {
        "time": "io.step-time-comes-after",
        "parts": "io.series-parts-step-brings",
        "mesh": "io.series-mesh-changed",
        "moved": "io.series-mesh-changed",
        "array": "io.series-array-changed",
        "gone": "io.series-files-gone",
    }
    table = NodeTable()
    ids = table.add(np.array([[0.0], [1.0], [2.5]]))
    moved = Mesh.of(table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))
    if how == "gone":
        path.unlink()
    steps = {
        "time": (1.0, {"": Part(mesh)}),
        "parts": (2.0, {"x": Part(mesh)}),
        "mesh": (2.0, {"": Part(bar(4))}),
        "moved": (2.0, {"": Part(moved)}),
        "array": (2.0, {"": Part(mesh, {"TEMP": moving(mesh, 3)})}),
        "gone": (2.0, {"": Part(mesh)}),
    }
    with refusal(OutputError, codes[how]):
        series.write_parts(*steps[how])
    series.close()
    if how != "gone":
        assert times_of(opened(path)) == [0.0, 1.0]


def test_an_error_in_a_field_leaves_no_half_step(tmp_path):
    mesh = bar()

    class Broken(NodeField):
        def values_at(self, name, nodes, default=0.0):  # type: ignore[no-untyped-def]
            raise RuntimeError("stop")

    field = moving(mesh, 0)
    with VtkHdfWriter(tmp_path / "h") as series:
        series.write(0.0, mesh, {"": field})
        with pytest.raises(RuntimeError, match="stop"):
            series.write(1.0, mesh, {"u": field, "": Broken(field.table, field.components)})
        series.write(2.0, mesh, {"": field})
    assert times_of(opened(tmp_path / "h.vtkhdf")) == [0.0, 2.0]
    assert [p.name for p in tmp_path.iterdir()] == ["h.vtkhdf"]


def test_an_older_file_is_replaced_when_the_first_step_is_whole(tmp_path):
    mesh, path = bar(), tmp_path / "o.vtkhdf"
    path.write_bytes(b"older")
    series = VtkHdfWriter(tmp_path / "o")
    assert path.read_bytes() == b"older"
    for i in range(2):
        series.write(float(i), mesh, {"": field_of_step(mesh, i)})
    reader = opened(path)  # while it is being written
    for i in range(2, 200):
        series.write(float(i), mesh, {"": field_of_step(mesh, i)})
    assert len(times_of(opened(path))) == 200
    for i in range(2):
        assert np.array_equal(step_of(reader, i).point_data["T"], np.cos(i + np.arange(3)))
    series.close()
    assert [p.name for p in tmp_path.iterdir()] == ["o.vtkhdf"]


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with refusal(OutputError, "io.cannot-written"):
        VtkHdfWriter(tmp_path / "file" / "x").write(0.0, bar())


def test_a_full_disk_is_told_and_leaves_the_steps_before(tmp_path, monkeypatch):
    mesh, real, left = bar(), os.pwrite, [40]

    def full(handle: int, data: bytes, at: int) -> int:
        left[0] -= 1
        if left[0] < 0:
            raise OSError(28, "No space left on device")
        return real(handle, data, at)

    series = VtkHdfWriter(tmp_path / "f")
    series.write(0.0, mesh, {"": moving(mesh, 0)})
    series.write(0.5, mesh, {"": moving(mesh, 1)})
    monkeypatch.setattr(os, "pwrite", full)

    def go_on() -> None:
        for i in range(1, 20):
            series.write(float(i), mesh, {"": moving(mesh, i)})

    with pytest.raises(OutputError, match="no space is left") as refused:
        go_on()
    assert refused.value.code == "io.cannot-written"
    series.close()
    assert len(times_of(opened(tmp_path / "f.vtkhdf"))) >= 2


class Logged(GrowingFile):
    """Keeps what is written where, in order."""

    log: list[tuple[int, bytes]]

    def put(self, address: int, data: bytes) -> None:
        Logged.log.append((address, bytes(data)))
        super().put(address, data)


def field_of_step(mesh: Mesh, step: int) -> NodeField:
    return NodeField.of(
        mesh.nodes, mesh.sorted_node_ids, {"T": np.cos(step + np.arange(mesh.sorted_node_ids.size))}
    )


# what a process of its own finds in a file: steps and values of the last one, or that it dies
LOOK = """
import sys, numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader
for line in sys.stdin:
    path = line.strip()
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    steps = reader.GetNumberOfSteps()
    for step in (0, steps // 2, steps - 1):
        reader.SetStep(step)
        reader.Update()
        values = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("T"))
        assert np.array_equal(values, np.cos(step + np.arange(len(values)))), (path, step)
    print(steps, len(values), flush=True)
"""


def found_in(paths: list[Path]) -> list[tuple[int, int]]:
    """Numbers of steps and of nodes of each file, whose values must be right."""
    done = subprocess.run(
        [sys.executable, "-c", LOOK],
        input="".join(f"{p}\n" for p in paths),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    lines = done.stdout.split("\n")[:-1]
    return [(int(a), int(b)) for a, b in (line.split() for line in lines)]


def test_every_state_of_the_file_is_whole(tmp_path, monkeypatch):
    """What stands on the disk after any write, from the first commit on, can be read."""
    Logged.log = []
    monkeypatch.setattr("ssilang.io.vtk.vtkhdf.GrowingFile", Logged)
    mesh, count = bar(5), BRANCHES + 3
    with VtkHdfWriter(tmp_path / "w") as series:
        for i in range(count):
            late = {"late": field_of_step(mesh, i)} if i > 60 else {}
            series.write(float(i), mesh, {"": field_of_step(mesh, i), **late})
    image, paths, commits = bytearray(), [], 0
    states, root = [], b""
    for address, data in Logged.log:
        image.extend(bytes(max(0, address + len(data) - len(image))))
        image[address : address + len(data)] = data
        if address == 0:  # where the root's header stands
            commits += data[64:72] != root
            root = data[64:72]
        if 0 < commits < 3 or commits > 58:  # a tree's node fills up at 64, arrays come at 61
            path = tmp_path / f"{len(paths)}.vtkhdf"
            path.write_bytes(image)
            paths.append(path)
            states.append(commits)
    assert len(paths) > 100
    found = found_in(paths)
    assert [steps for steps, _ in found] == states
    assert {nodes for _, nodes in found} == {5}


WRITE = """
import sys, pathlib
sys.path[:0] = {paths!r}
import numpy as np
from ssilang.io.vtk.vtkhdf import VtkHdfWriter
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
table = NodeTable()
ids = table.add(np.arange(2000.0)[:, None])
mesh = Mesh.of(table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))
with VtkHdfWriter(pathlib.Path(sys.argv[1])) as series:
    for i in range(1000000):
        series.write(float(i), mesh, {{"": NodeField.of(table, ids, {{"T": np.cos(i + ids)}})}})
        if i == 0:
            print("begun", flush=True)
"""


def test_a_killed_process_leaves_its_last_whole_step(tmp_path):
    rng = np.random.default_rng(int(os.environ.get("KILL_SEED", "5")))
    script = WRITE.format(paths=sys.path)
    paths = []
    for i in range(int(os.environ.get("KILLS", "6"))):
        path = tmp_path / f"k{i}.vtkhdf"
        process = subprocess.Popen(
            [sys.executable, "-c", script, str(path)], stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        assert process.stdout.readline() == "begun\n"
        time.sleep(rng.uniform(0.0, 0.3))
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        paths.append(path)
    found = found_in(paths)
    assert all(nodes == 2000 and steps >= 1 for steps, nodes in found)
    assert max(steps for steps, _ in found) > 3
    assert set(tmp_path.iterdir()) == set(paths)


def test_the_smallest_named_set_names_a_cell(tmp_path):
    mesh = bar(6)
    (block,) = mesh.blocks
    whole = mesh.blocks
    left = (CellBlock.make(mesh.nodes, "SEG2", block.connectivity[:3]),)
    turned = (CellBlock.make(mesh.nodes, "SEG2", block.connectivity[2:3, ::-1]),)
    elsewhere = (CellBlock.make(mesh.nodes, "SEG2", np.array([[0, 2]])),)
    told = {"group": {"ALL": whole, "LEFT": left, "ONE": turned, "FAR": elsewhere}}
    labels = labels_of(mesh, told, (2, "beam"))
    assert labels.numbers["group"].tolist()[2:] == [3, 1, 1]
    assert labels.numbers["part"].tolist() == [2] * 5
    assert labels.names == {
        "group_ALL": 1.0, "group_LEFT": 2.0, "group_ONE": 3.0, "part_beam": 2.0,
    }  # fmt: skip
    assert labels_of(mesh, {"group": {}}) == Labels()
    growing = {"group": {"ONE": turned, "LEFT": left, "ALSO": left, "ALL": whole}}
    assert labels_of(mesh, growing).numbers["group"].tolist() == [2, 2, 1, 4, 4]
    twice = Mesh.of(mesh.nodes, "SEG2", block.connectivity[[2, 4, 2, 4]])  # in one place
    both = {"group": {"ALL": twice.blocks, "ONE": turned}}
    assert labels_of(twice, both).numbers["group"].tolist() == [2, 1, 2, 1]


def test_parts_have_names_of_their_own_that_a_path_can_have():
    names = ("a/b", "a.b", "Assembly", "", "a_b", "_")
    made = _link_names(names)
    assert [*made] == [*names]
    assert [*made.values()] == ["a_b", "a_b_", "Assembly_", "_", "a_b__", "__"]
