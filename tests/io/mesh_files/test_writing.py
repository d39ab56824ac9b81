"""Meshes with named parts written, and read back by meshio alone."""

from pathlib import Path

import meshio
import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.io.errors import OutputError
from ssilang.io.mesh_files.file_mesh import FileMesh, Part
from ssilang.io.mesh_files.reading import Asked, mesh_with_fields, read_mesh_file
from ssilang.io.mesh_files.writing import WRITTEN, write_mesh_file

POINTS = np.random.default_rng(3).normal(size=(24, 3))
# numbers that do not grow, kinds not in the order of their dimension, two kinds of surfaces
FLAT = {
    "QUA4": [[7, 2, 9, 4], [11, 0, 3, 8]],
    "SEG2": [[9, 2], [0, 3], [5, 1]],
    "TRI3": [[6, 10, 1], [2, 7, 5], [3, 0, 11]],
    "POI1": [[5]],
}
SOLID = {"CUB8": [[8, 3, 1, 6, 15, 12, 10, 9]], "TET4": [[16, 18, 17, 22]], "SEG3": [[1, 20, 4]]}
PARTS = {
    "ZONE": {"TRI3": [2, 0], "QUA4": [1]},
    "AROUND": {"SEG2": [2, 0]},
    "BOTH": {"TRI3": [0, 1]},  # shares a cell with ZONE
    "MIXED": {"QUA4": [0], "SEG2": [1]},
}
CASES = {
    "flat": (FLAT, PARTS, {"ENDS": [11, 4]}),
    "bare": ({"TRI3": [[2, 1, 5]]}, {}, {}),
    "solid": (SOLID, {"BODY": {"TET4": [0], "CUB8": [0]}, "EDGE": {"SEG3": [0]}}, {}),
    "points": ({"SEG2": [[3, 1]]}, {}, {"HEAD": [5, 3, 0], "FOOT": [1]}),
}
# MED describes solids the other way round; whoever reads a mesh turns it
TURNED = {"CUB8": [0, 3, 2, 1, 4, 7, 6, 5], "TET4": [0, 2, 1, 3]}
ORDERS = {"SEG3": [0, 2, 1]}  # middles last, as VTK has them


def _mesh(case: str) -> FileMesh:
    cells, parts, ends = CASES[case]
    made = {n: Part({k: np.array(r) for k, r in p.items()}) for n, p in parts.items()}
    made |= {n: Part({}, np.array(nodes)) for n, nodes in ends.items()}
    return FileMesh(POINTS, {k: np.array(t) for k, t in cells.items()}, made)


def _names_of_cells(mesh: FileMesh) -> dict[tuple[str, tuple[int, ...]], set[str]]:
    """Names of the parts of each cell, by its type and nodes."""
    found = {(k, tuple(r)): set() for k, t in mesh.cells.items() for r in t.tolist()}
    for name, part in mesh.parts.items():
        for k, rows in part.cells.items():
            for row in np.asarray(rows).tolist():
                found[k, tuple(mesh.cells[k][row].tolist())].add(name)
    return found


def _nodes_of_parts(mesh: FileMesh) -> dict[str, list[int]]:
    return {n: sorted(p.nodes.tolist()) for n, p in mesh.parts.items() if len(p.nodes)}


@together("case", CASES)
@together("ending", WRITTEN)
def test_what_is_written_is_read_again(tmp_path: Path, ending: str, case: str) -> None:
    path, mesh = tmp_path / f"m{ending}", _mesh(case)
    write_mesh_file(path, mesh, 3)
    read = read_mesh_file(path, WRITTEN[ending], Asked())
    assert np.allclose(read.points, POINTS, rtol=1e-15)
    sets, wanted = _names_of_cells(read), _names_of_cells(mesh)
    if ending == ".med":
        wanted = {(k, tuple(c[i] for i in TURNED.get(k, range(len(c))))): names
                  for (k, c), names in wanted.items()}  # fmt: skip
    if ending == ".msh":  # names of what is below a part's dimension say it; points are cells
        sets = {c: {n.removesuffix("_1D") for n in names} for c, names in sets.items()}
        sets = {c: n for c, n in sets.items() if c[0] != "POI1"}
        wanted = {c: n for c, n in wanted.items() if c[0] != "POI1"}
        ends = {n: sorted(read.cells["POI1"][p.cells["POI1"], 0].tolist())
                for n, p in read.parts.items() if "POI1" in p.cells}  # fmt: skip
        assert ends == _nodes_of_parts(mesh)
    else:
        if ending == ".inp":  # has points in sets alone
            wanted = {c: n for c, n in wanted.items() if c[0] != "POI1"}
        assert _nodes_of_parts(read) == _nodes_of_parts(mesh)
    assert sets == wanted


@together("case", CASES)
def test_meshio_finds_groups_of_gmsh(tmp_path: Path, case: str) -> None:
    path, mesh = tmp_path / "m.msh", _mesh(case)
    write_mesh_file(path, mesh, 2)
    read = meshio.read(path)
    assert np.allclose(read.points, POINTS)
    dimensions = [b.dim for b in read.cells]
    assert dimensions == sorted(dimensions)
    cells, parts, ends = CASES[case]
    for name, part in parts.items():
        most = max({"SEG2": 1, "SEG3": 1, "TRI3": 2, "QUA4": 2}.get(k, 3) for k in part)
        for kind, rows in part.items():
            d = {"SEG2": 1, "SEG3": 1, "TRI3": 2, "QUA4": 2}.get(kind, 3)
            tag, dimension = read.field_data[name if d == most else f"{name}_{d}D"]
            assert dimension == d
            wanted = {tuple(cells[kind][r][i] for i in ORDERS.get(kind, range(8))
                            if i < len(cells[kind][r])) for r in rows}  # fmt: skip
            found = {
                tuple(row)
                for block, tags in zip(read.cells, read.cell_data["gmsh:physical"], strict=True)
                for row, t in zip(block.data.tolist(), tags.tolist(), strict=True)
                if t == tag and len(row) == len(cells[kind][0])
            }
            assert found == wanted
    for name, nodes in ends.items():
        tag, dimension = read.field_data[name]
        assert dimension == 0
        blocks = zip(read.cells, read.cell_data["gmsh:physical"], strict=True)
        found = [n for b, tags in blocks if b.type == "vertex" for n in b.data[tags == tag, 0]]
        assert found == nodes
    assert all((t >= 1).all() for t in read.cell_data["gmsh:geometrical"])
    count = sum(len(t) for t in cells.values())
    inside = {(k, r) for p in parts.values() for k, rows in p.items() for r in rows}
    told = sum(len(r) for p in parts.values() for r in p.values()) + sum(map(len, ends.values()))
    assert sum(len(b.data) for b in read.cells) == count - len(inside) + told


def test_med_has_a_family_for_each_set_of_groups(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "m.med"
    write_mesh_file(path, _mesh("flat"), 2)
    read = meshio.read(path)
    assert np.allclose(read.points, POINTS[:, :2])
    tags = {
        b.type: t.tolist() for b, t in zip(read.cells, read.cell_data["cell_tags"], strict=True)
    }
    names = {k: [set(read.cell_tags.get(t, ())) for t in row] for k, row in tags.items()}
    assert names == {
        "quad": [{"MIXED"}, {"ZONE"}],
        "line": [{"AROUND"}, {"MIXED"}, {"AROUND"}],
        "triangle": [{"ZONE", "BOTH"}, {"BOTH"}, {"ZONE"}],
        "vertex": [set()],
    }
    assert max(t for row in tags.values() for t in row) == 0  # cells below, nodes above nought
    nodes = [i for i, t in enumerate(read.point_data["point_tags"]) if t > 0]
    assert nodes == [4, 11]
    with h5py.File(path) as file:
        (step,) = file["ENS_MAA/mesh"].values()
        shapes = {name: int(group.attrs["GEO"]) for name, group in step["MAI"].items()}
    assert shapes == {"QU4": 204, "SE2": 102, "TR3": 203, "PO1": 1}


def test_solids_of_med_are_the_other_way_round(tmp_path: Path) -> None:
    write_mesh_file(tmp_path / "m.med", _mesh("solid"), 3)
    read = {b.type: b.data.tolist() for b in meshio.read(tmp_path / "m.med").cells}
    assert read["hexahedron"] == [[8, 6, 1, 3, 15, 9, 10, 12]]
    assert read["tetra"] == [[16, 17, 18, 22]]
    assert read["line3"] == [[1, 4, 20]]


@together("plane, names", [("CPE", ("CPE4", "B21", "CPE3")),
                                              ("", ("S4", "B31", "S3"))])  # fmt: skip
def test_abaqus_deck_line_by_line(tmp_path: Path, plane: str, names: tuple[str, ...]) -> None:
    write_mesh_file(tmp_path / "m.inp", _mesh("flat"), 2, plane)
    lines = (tmp_path / "m.inp").read_text().splitlines()
    quad, line, triangle = names
    at = lines.index(f"*ELEMENT, TYPE={quad}")
    assert lines[at + 1 : at + 3] == ["1, 8, 3, 10, 5", "2, 12, 1, 4, 9"]
    assert lines[at + 3 : at + 7] == [
        f"*ELEMENT, TYPE={line}", "3, 10, 3", "4, 1, 4", "5, 6, 2"
    ]  # fmt: skip
    assert lines[at + 7 : at + 9] == [f"*ELEMENT, TYPE={triangle}", "6, 7, 11, 2"]
    sets = dict(zip(lines[at + 11 :: 2], lines[at + 12 :: 2], strict=True))
    assert sets == {
        '*ELSET, ELSET="ZONE"': "2, 6, 8",
        '*ELSET, ELSET="AROUND"': "3, 5",
        '*ELSET, ELSET="BOTH"': "6, 7",
        '*ELSET, ELSET="MIXED"': "1, 4",
        '*NSET, NSET="ENDS"': "5, 12",
    }


def test_points_of_a_part_are_nodes_of_an_abaqus_set(tmp_path: Path) -> None:
    cells = {"POI1": np.array([[8], [2], [5]]), "SEG2": np.array([[0, 4]])}
    parts = {
        "AT": Part({"POI1": np.array([2, 0])}, np.array([1])),
        "L": Part({"SEG2": np.array([0])}),
    }
    write_mesh_file(tmp_path / "m.inp", FileMesh(POINTS, cells, parts), 2, "CPE")
    lines = (tmp_path / "m.inp").read_text().splitlines()
    assert lines[-4:] == ['*NSET, NSET="AT"', "2, 6, 9", '*ELSET, ELSET="L"', "1"]


@together(
    "ending, cells, part, code",
    [
        (".msh", {"JOI2": [[0, 1, 2, 3]]}, "A", "io.mesh-cells-not-written"),
        (".med", {"JOI2": [[0, 1, 2, 3]]}, "A", "io.mesh-cells-not-written"),
        (".inp", {"JOI2": [[0, 1, 2, 3]]}, "A", "io.mesh-cells-not-written"),
        (".msh", {"SEG2": [[0, 1]]}, 'A"B', "io.mesh-part-name"),
        (".med", {"SEG2": [[0, 1]]}, "SÉISME", "io.mesh-part-name"),
        (".med", {"SEG2": [[0, 1]]}, "A" * 81, "io.mesh-part-name"),
        (".inp", {"SEG2": [[0, 1]]}, "A,B", "io.mesh-part-name"),
    ],
)
def test_what_a_format_has_not(tmp_path: Path, ending: str, cells: dict, part: str, code: str):
    tables = {k: np.array(t) for k, t in cells.items()}
    mesh = FileMesh(POINTS, tables, {part: Part({k: np.array([0]) for k in tables})})
    with refusal(OutputError, code):
        write_mesh_file(tmp_path / f"m{ending}", mesh, 3)
    assert not list(tmp_path.iterdir())


def test_pictures_of_other_formats_know_the_last_part(tmp_path: Path) -> None:
    write_mesh_file(tmp_path / "m.inp", _mesh("flat"), 3)
    read = mesh_with_fields(tmp_path / "m.inp", "ABAQUS")
    parts = list(read_mesh_file(tmp_path / "m.inp", "ABAQUS", Asked()).parts)
    told = {b.type: [parts[int(n) - 1] for n in row]
            for b, row in zip(read.cells, read.cell_data["part"], strict=True)}  # fmt: skip
    assert told == {
        "quad": ["MIXED", "ZONE"],
        "line": ["AROUND", "MIXED", "AROUND"],
        "triangle": ["BOTH", "BOTH", "ZONE"],
    }
