"""AVS UCD, Abaqus and Nastran: read back by meshio, by ourselves and by hand."""

import meshio
import numpy as np
import pytest
from meshio._mesh import topological_dimension
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.io.errors import InputError, OutputError
from ssilang.io.mesh_files.avs import avs_lines, read_avs, structure_of
from ssilang.io.mesh_files.decks import abaqus_lines, nastran_lines
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


def test_vtk_reads_what_is_written(tmp_path):
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


def test_structures_follow_one_another_with_their_time(tmp_path):
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


def test_values_stay_with_their_cells_and_components(tmp_path):
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
def test_quadratic_cells_keep_their_order(kind, tmp_path):
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
def test_a_damaged_file_is_refused(rest, said, tmp_path):
    path = tmp_path / "x.inp"
    path.write_text(f"2 0 1 0 0\n1 0. 0. 0.\n{rest}")
    with pytest.raises(InputError, match=said):
        read_avs(path)


def test_a_field_that_does_not_cover_the_mesh_is_refused():
    mesh, _, cells = mixed()
    with pytest.raises(OutputError, match="cover"):
        structure_of(mesh, None, CellField(cells.blocks[:1]))


VOLUMES = {
    kind: f"OPTI DIME 3 ELEM {kind} ; S = (DROI 2 (0. 0. 0.) (2. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
    + volume
    for kind, volume in (
        ("CUB8", "V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("CU20", "V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("PRI6", "OPTI ELEM TRI3 ; S = SURF (CONT S) ; V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("PR15", "OPTI ELEM TRI6 ; S = SURF (CONT S) ; V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("TET4", "OPTI ELEM CUB8 ; V = CHAN 'TET4' (S VOLU 1 'TRAN' (0. 0. 3.)) ;"),
        ("TE10", "OPTI ELEM CUB8 ; V = CHAN 'TE10' (CHAN 'TET4' (S VOLU 1 'TRAN' (0. 0. 3.))) ;"),
    )
}


def middles_off_their_places(points, rows, edges):
    """Largest distance of a middle node from the middle of its two corners."""
    found = [points[rows[:, m]] - points[rows[:, [a, b]]].mean(axis=1) for m, a, b in edges]
    return max(np.abs(f).max() for f in found)


BOTTOM, TOP = [(0, 1), (1, 2), (2, 3), (3, 0)], [(4, 5), (5, 6), (6, 7), (7, 4)]
BOX = [*BOTTOM, *TOP, (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
TETRA = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
EDGES = {
    "hexahedron20": [(8 + i, *e) for i, e in enumerate(BOX)],
    "wedge15": [(6 + i, *e) for i, e in enumerate(WEDGE)],
    "tetra10": [(4 + i, *e) for i, e in enumerate(TETRA)],
}
"""Middles in meshio's order, that of VTK: bottom, top, between."""


def volume(points, kind, rows):
    corners = points[rows[:, {"h": [0, 1, 3, 4], "w": [0, 1, 2, 3], "t": [0, 1, 2, 3]}[kind[0]]]]
    sides = corners[:, 1:] - corners[:, :1]
    part = {"h": 1.0, "w": 2.0, "t": 6.0}[kind[0]]
    return np.linalg.det(sides).sum() / part


@together("kind", VOLUMES)
@together("word, suffix", [("ABAQ", ".inp"), ("NAS", ".bdf")])
def test_meshio_reads_the_same_volumes(monkeypatch, tmp_path, kind, word, suffix):
    monkeypatch.setitem(topological_dimension, "wedge15", 3)  # meshio 5.3 has forgotten it
    text = VOLUMES[kind] + f"OPTI SORT 'box' ; SORT '{word}' V ; N = NBEL V ; P = NBNO V ;"
    result = ran(text, tmp_path)
    read = meshio.read(tmp_path / f"box{suffix}", "abaqus" if word == "ABAQ" else "nastran")
    assert len(read.points) == result.session.root.find("P")
    assert sum(len(b.data) for b in read.cells) == result.session.root.find("N")
    assert sum(volume(read.points, b.type, b.data) for b in read.cells) == pytest.approx(6.0)
    for block in read.cells:
        if block.type in EDGES:
            off = middles_off_their_places(read.points, block.data, EDGES[block.type])
            assert off < 1e-12
    assert {b.type for b in read.cells} <= {"hexahedron", "wedge", "tetra", *EDGES}


@together("mode, name", [("PLAN CONT", "CPS8"), ("PLAN DEFO", "CPE8"), ("AXIS", "CAX8")])
def test_surfaces_are_what_the_mode_says(tmp_path, mode, name):
    text = f"OPTI DIME 2 MODE {mode} ELEM QUA8 SORT 'plate' ; "
    text += "S = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; T = MANU 'TRI6' (3. 0.) (4. 0.) (5. 0.) "
    text += "(4. 1.) (3. 2.) (3. 1.) ; SORT 'ABAQ' (S ET T) ;"
    assert run_text(text, tmp_path).exit_code == 0
    lines = (tmp_path / "plate.inp").read_text().splitlines()
    at = lines.index(f"*ELEMENT, TYPE={name}, ELSET=E1")
    nodes = {f[0]: np.array(f[1:], float) for f in (line.split(",") for line in lines[2:at])}
    firsts = [lines[i + 1].split(",")[0] for i, s in enumerate(lines) if s.startswith("*ELEMENT")]
    assert firsts == ["1", "2"]
    corners = [nodes[n.strip()] for n in lines[at + 1].split(",")[1:5]]
    middles = [nodes[n.strip()] for n in lines[at + 1].split(",")[5:9]]
    for i in range(4):
        np.testing.assert_allclose(middles[i], (corners[i] + corners[(i + 1) % 4]) / 2)


def test_cells_without_an_entry_are_refused(tmp_path):
    text = "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; S = VIDE 'MAILLAGE' ;"
    result = run_text(text, tmp_path)
    line, empty = (result.session.root.find(n) for n in "LS")
    with pytest.raises(OutputError, match="no SEG2"):
        abaqus_lines(line, "CPE")
    with pytest.raises(OutputError, match="no mesh without cells"):
        nastran_lines(empty)


@together("word, near", [("FER", ""), ("NSA", "did you mean 'NAS'?")])
def test_formats_that_are_not_written_are_named(tmp_path, word, near):
    result = run_text(
        f"OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; SORT '{word}' L ;", tmp_path
    )
    assert f"'{word}' is no format of meshes that SORT writes" in result.message
    assert near in result.message
    assert "NAS ABAQ" in result.message
