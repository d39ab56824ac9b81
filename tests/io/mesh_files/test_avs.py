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
    assert [(k, m, len(t)) for k, m, t in second.cells] == [("QUA4", 1, 1), ("TRI3", 2, 2)]


BY_HAND = """# numbers in no order, kinds and materials in turn, a scalar before a vector
5 4 4 1 0
7 0 0 0\n3 1 0 0\n9 1 1 0\n2 0 1 0\n5 2 0 0
1 2 QUAD 7 3 9 2\n2 1 tri 3 5 9\n3 2 quad 3 9 2 7\n4 1 Tri 5 9 3
2 1 3\nP, Pa\nV , m/s
7 .5 1 2 3\n3 .6 4 5 6\n9 .7 7 8 9\n2 .8 0 0 1\n5 .9 1 0 0
1 1\nS, Pa
1 10\n2 20\n3 30\n4 40
"""


def test_values_stay_with_their_cells_and_components(tmp_path: Path) -> None:
    (tmp_path / "x.avs").write_text(BY_HAND)
    read = read_avs(tmp_path / "x.avs")
    assert read is not None
    assert [(k, m, rows.tolist()) for k, m, rows in read.cells] == [
        ("QUA4", 2, [[0, 1, 2, 3], [1, 2, 3, 0]]), ("TRI3", 1, [[1, 4, 2], [4, 2, 1]]),
    ]  # fmt: skip
    assert read.cell_values["S"].tolist() == [10, 30, 20, 40]
    assert {name: v.tolist() for name, v in read.node_values.items()} == {
        "P": [0.5, 0.6, 0.7, 0.8, 0.9], "V1": [1, 4, 7, 0, 1], "V2": [2, 5, 8, 0, 0],
        "V3": [3, 6, 9, 1, 0],
    }  # fmt: skip


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
