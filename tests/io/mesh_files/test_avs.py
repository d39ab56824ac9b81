"""AVS UCD files: read back by meshio and by ourselves."""

from pathlib import Path

import numpy as np
import pytest
from together import together

from ssilang.io.errors import InputError, OutputError
from ssilang.io.mesh_files.avs import avs_lines, read_avs, structure_of
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def mixed() -> tuple[Mesh, NodeField, CellField]:
    table = NodeTable()
    table.add(np.array([[9.0, 9.0]]))  # a node that is not of the mesh
    ids = table.add(np.array([(0.0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1)]))
    quads = CellBlock.make(table, "QUA4", ids[[[0, 1, 2, 3]]])
    triangles = CellBlock.make(table, "TRI3", ids[[[1, 4, 5], [1, 5, 2]]])
    field = NodeField.of(table, ids, {"UX": np.arange(6.0) / 7.0, "UY": -np.arange(6.0)})
    cells = CellField(
        (
            CellFieldBlock(quads, {"S": np.array([[1.0, 3.0]])}),
            CellFieldBlock(triangles, {"S": np.array([[5.0], [7.0]])}),
        )
    )
    return Mesh(table, (quads, triangles)), field, cells


def test_vtk_reads_what_is_written(tmp_path: Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    mesh, field, cells = mixed()
    path = tmp_path / "m.avs"
    path.write_text("\n".join(avs_lines(structure_of(mesh, field, cells))) + "\n")
    read = pyvista.AVSucdReader(path).read()
    assert np.allclose(read.points[:, :2], mesh.nodes.coordinates[1:, :2])
    assert list(read.celltypes) == [9, 5, 5]
    assert list(read.get_cell(1).point_ids) == [1, 4, 5]
    assert np.allclose(read.point_data["UX"], np.arange(6.0) / 7.0)
    assert np.allclose(read.cell_data["S"], [2.0, 5.0, 7.0])


def test_structures_follow_one_another_with_their_time(tmp_path: Path) -> None:
    mesh, field, _ = mixed()
    path = tmp_path / "two.inp"
    lines = avs_lines(structure_of(mesh, field, None, 1.5)) + avs_lines(structure_of(mesh))
    path.write_text("# made by a test\n" + "\n".join(lines))
    first, second, third, fourth = (read_avs(path, i) for i in range(4))
    assert first is not None
    assert second is not None
    assert third is fourth is None
    assert first.model_values == {"time": 1.5}
    assert np.array_equal(first.node_values["UX"], np.arange(6.0) / 7.0)
    assert second.node_values == {}
    assert [(k, len(t)) for k, _, t in second.cells] == [("QUA4", 1), ("TRI3", 2)]


@together("kind", ["SEG3", "QUA8", "CU20", "TE10"])
def test_quadratic_cells_keep_their_order(kind: str, tmp_path: Path) -> None:
    from ssilang.kernel.mesh.cells import CELL_TYPES

    table = NodeTable()
    n = CELL_TYPES[kind].n_nodes
    ids = table.add(np.random.default_rng(0).normal(size=(n, 3)))
    path = tmp_path / "q.inp"
    path.write_text("\n".join(avs_lines(structure_of(Mesh.of(table, kind, ids[None, :])))))
    read = read_avs(path)
    assert read is not None
    assert np.array_equal(read.cells[0][2], np.arange(n)[None, :])


@together("rest, said", [("", r"x\.inp is cut"), ("2 1. 0. 0.\n1 1\nV, m\n1 2.\n2 nan\n", "NaN")])
def test_a_damaged_file_is_refused(rest: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "x.inp"
    path.write_text(f"2 0 1 0 0\n1 0. 0. 0.\n{rest}")
    with pytest.raises(InputError, match=said):
        read_avs(path)


def test_a_field_that_does_not_cover_the_mesh_is_refused() -> None:
    mesh, _, cells = mixed()
    with pytest.raises(OutputError, match="cover"):
        structure_of(mesh, None, CellField(cells.blocks[:1]))
