"""Series over time: file names, the list of times, parts, interruption."""

from pathlib import Path

import meshio
import numpy as np
import pytest
from refusing import refusal

from ssilang.io.errors import OutputError
from ssilang.io.vtk import Encoding, Part, SeriesWriter
from ssilang.io.vtk.series import read_pvd
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def bar() -> tuple[Mesh, NodeField]:
    table = NodeTable()
    ids = table.add(np.array([[0.0], [1.0], [3.0]]))
    mesh = Mesh.of(table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))
    return mesh, NodeField.of(table, ids, {"UX": np.array([0.0, 0.5, 1.0])})


def scaled(field: NodeField, by: float) -> NodeField:
    part = field.components["UX"]
    return NodeField.of(field.table, part.nodes, {"UX": by * part.values})


def test_each_step_is_a_file_and_the_list_has_its_time(tmp_path: Path) -> None:
    mesh, field = bar()
    times = [0.0, 0.1, 0.30000000000000004]
    with SeriesWriter(tmp_path / "run" / "bar.vtk", Encoding.TEXT) as series:
        for t in times:
            series.write(t, mesh, {"": scaled(field, t)})
    entries = read_pvd(tmp_path / "run" / "bar.pvd")
    assert [e.time for e in entries] == times
    assert [e.file for e in entries] == ["bar.0001.vtu", "bar.0002.vtu", "bar.0003.vtu"]
    for t, e in zip(times, entries, strict=True):
        written = (tmp_path / "run" / e.file).read_text()
        assert ('format="ascii"' in written, 'format="binary"' in written) == (True, False)
        read = meshio.read(tmp_path / "run" / e.file)
        assert np.array_equal(read.point_data["displacement"][:, 0], t * np.array([0.0, 0.5, 1.0]))


def test_parts_are_separate_files_named_after_them(tmp_path: Path) -> None:
    mesh, field = bar()
    with SeriesWriter(tmp_path / "two") as series:
        series.write_parts(1.0, {"soil": Part(mesh, {"": field}), "a/b": Part(mesh)})
    assert [(e.part, e.file) for e in read_pvd(tmp_path / "two.pvd")] == [
        ("soil", "two.0001.soil.vtu"),
        ("a/b", "two.0001.a_b.vtu"),
    ]


def test_a_resumed_series_goes_on_after_its_last_step(tmp_path: Path) -> None:
    mesh, field = bar()
    with SeriesWriter(tmp_path / "r") as series:
        series.write(1.0, mesh, {"": field})
    with SeriesWriter(tmp_path / "r", resume=True) as series:
        series.write(2.0, mesh, {"": field})
    assert [e.file for e in read_pvd(tmp_path / "r.pvd")] == ["r.0001.vtu", "r.0002.vtu"]


def test_finished_steps_stay_listed_after_an_error(tmp_path: Path) -> None:
    mesh, field = bar()
    with SeriesWriter(tmp_path / "e") as series:
        series.write(1.0, mesh, {"": field})
        with pytest.raises(OutputError, match="time 1"):
            series.write(1.0, mesh, {"": field})
    assert len(read_pvd(tmp_path / "e.pvd")) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["e.0001.vtu", "e.pvd"]


def test_an_error_in_a_field_leaves_no_half_step(tmp_path: Path) -> None:
    mesh, field = bar()

    class Broken(NodeField):
        def values_at(self, name, nodes, default=0.0):  # type: ignore[no-untyped-def]
            raise RuntimeError("stop")

    with SeriesWriter(tmp_path / "h") as series:
        series.write(0.0, mesh, {"": field})
        with pytest.raises(RuntimeError, match="stop"):
            series.write(1.0, mesh, {"": Broken(field.table, field.components)})
    assert sorted(p.name for p in tmp_path.iterdir()) == ["h.0001.vtu", "h.pvd"]


def test_parts_may_not_change_within_a_series(tmp_path: Path) -> None:
    mesh, _ = bar()
    with SeriesWriter(tmp_path / "p") as series:
        series.write_parts(1.0, {"soil": Part(mesh)})
        with pytest.raises(OutputError, match="soil"):
            series.write_parts(2.0, {"rock": Part(mesh)})


def test_a_series_whose_files_are_gone_is_not_listed(tmp_path: Path) -> None:
    mesh, field = bar()
    for gone, again in (("bar.0002.vtu", True), ("bar.0001.vtu", False)):
        series = SeriesWriter(tmp_path / "bar")
        series.write(0.0, mesh, {"": field})
        series.write(1.0, mesh, {"": field})
        (tmp_path / gone).unlink()
        if again:  # the file before is looked for at each step, all of them at the end
            with refusal(OutputError, "io.series-files-gone"):
                series.write(2.0, mesh, {"": field})
        with refusal(OutputError, "io.series-files-gone") as refused:
            series.close()
        assert refused.value.data["names"] == [gone]
        assert not (tmp_path / "bar.pvd").exists()
        kept, later = series.position(), SeriesWriter(tmp_path / "bar")
        with pytest.raises(OutputError, check=lambda e: e.code == "io.series-files-gone"):
            later.go_back(kept)
        (tmp_path / gone).touch()
        later.go_back(kept)
        assert later.files == series.files
        assert later.last_time == 1.0


def test_a_step_is_accepted_later_and_with_the_same_parts(tmp_path: Path) -> None:
    mesh, field = bar()
    with SeriesWriter(tmp_path / "two") as series:
        assert series.accepts(-5.0, ("soil",))
        series.write_parts(1.0, {"soil": Part(mesh, {"": field})})
        assert series.accepts(1.5, ("soil",))
        assert not series.accepts(1.0, ("soil",))
        assert not series.accepts(1.5, ("wall",))
        assert not series.accepts(1.5, ("soil", "wall"))
