"""LIRE 'MESH' and SORT 'MESH': files of meshio's own writers, of Gmsh, by hand, and our own."""

import importlib
import sys
from pathlib import Path

import meshio
import numpy as np
import pytest
from meshio import _mesh
from together import together

from ssilang.cli.run import RunOptions, RunResult, run_file
from ssilang.io.errors import InputError
from ssilang.io.mesh_files import abaqus
from ssilang.kernel.mesh.changes.degree import middle_places
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.values import Table
from ssilang.system import keep_from_closed_pipes


def there(library: str) -> bool:
    return importlib.util.find_spec(library) is not None


def run(text: str, folder: Path) -> RunResult:
    (folder / "deck.ssi").write_text(text)
    return run_file(folder / "deck.ssi", RunOptions(output_directory=folder))


def parts(result: RunResult, name: str = "T") -> dict[str, Mesh]:
    assert result.exit_code == 0, result.message
    table = result.session.root.find(name)
    assert isinstance(table, Table)
    return {str(i): v for i, v in table.items()}


# ---- cells as VTK describes them -----------------------------------------------------------------

BOTTOM, TOP = [(0, 1), (1, 2), (2, 3), (3, 0)], [(4, 5), (5, 6), (6, 7), (7, 4)]
SQUARE = [(0, 0), (3, 0), (3, 2), (0, 2)]
BRICK = np.array([(*p, z) for z in (0, 4) for p in SQUARE], float)
WEDGE = np.array([(*p, z) for z in (0, 4) for p in SQUARE[:3]], float)
PYRAMID = np.array([*((*p, 0) for p in SQUARE), (1, 1, 4)], float)
TETRA = np.array([*((*p, 0) for p in SQUARE[:3]), (1, 1, 4)], float)
RING = [(0, 1), (1, 2), (2, 0)]
CELLS = {  # corners, edges of the middles in VTK's order, volume
    "tetra": (TETRA, [], 4.0),
    "tetra10": (TETRA, [*RING, (0, 3), (1, 3), (2, 3)], 4.0),
    "pyramid": (PYRAMID, [], 8.0),
    "pyramid13": (PYRAMID, [*BOTTOM, (0, 4), (1, 4), (2, 4), (3, 4)], 8.0),
    "wedge": (WEDGE, [], 12.0),
    "wedge15": (WEDGE, [*RING, (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)], 12.0),
    "hexahedron": (BRICK, [], 24.0),
    "hexahedron20": (BRICK, [*BOTTOM, *TOP, *((i, i + 4) for i in range(4))], 24.0),
}


def one_cell(kind: str, turned: bool = False) -> meshio.Mesh:
    """A cell with the first face's nodes round it; the mirror image is described inside out."""
    corners, edges, _ = CELLS[kind]
    points = np.vstack([corners, *(corners[list(e)].mean(axis=0) for e in edges)])
    if turned:
        points = points * [-1.0, 1.0, 1.0]
    return meshio.Mesh(points, [(kind, np.arange(len(points))[None, :])])


@pytest.fixture(autouse=True)
def _quadratic_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    for kind in ("wedge15", "pyramid13"):  # forgotten by meshio 5.3
        monkeypatch.setitem(_mesh.topological_dimension, kind, 3)


WRITERS = {
    "gmsh22.msh": "gmsh22", "gmsh41.msh": "gmsh", "x.med": "med", "x.vtu": "vtu", "x.vtk": "vtk",
    "x.bdf": "nastran", "x.mesh": "medit", "x.inp": "abaqus",
}  # fmt: skip
_NOT_WRITTEN = {  # meshio's writers have no such cell, or get it wrong
    "medit": {k for k in CELLS if k[-1].isdigit()},
    "abaqus": {"pyramid", "pyramid13"},
    "nastran": {"pyramid13", "pyramid", "tetra10", "wedge15", "hexahedron20"},
}


@pytest.mark.parametrize("name", WRITERS)
def test_cells_that_meshio_writes_have_their_nodes_in_their_places(name, tmp_path):
    writer = WRITERS[name]
    if writer == "med" and not there("h5py"):
        pytest.skip("h5py is not installed")
    kinds = [k for k in CELLS if k not in _NOT_WRITTEN.get(writer, ())]
    text = "OPTI DIME 3 ;"
    for kind in kinds:
        for turned in (False, True):
            file = f"{kind}{int(turned)}{name}"
            one_cell(kind, turned).write(tmp_path / file, file_format=writer)
            text += f"T{kind[:2]}{len(kind)}{int(turned)} = LIRE '{file}' ;"
    result = run(text, tmp_path)
    for kind in kinds:
        for turned in (0, 1):
            (block,) = parts(result, f"T{kind[:2]}{len(kind)}{turned}".upper())["MAILLAGE"].blocks
            x = block.coordinates[0]
            assert signed_volume(block) == pytest.approx(CELLS[kind][2])
            for middle, a, b in middle_places(block.cell_type) if CELLS[kind][1] else ():
                np.testing.assert_allclose(x[middle], (x[a] + x[b]) / 2, atol=1e-7)


def signed_volume(block) -> float:
    """By the divergence theorem over the faces, which look outwards."""
    total = 0.0
    for _, face in block.kind.faces:
        corners = [n for n in face if n in block.kind.corners]
        p = block.coordinates[0][corners]
        for i in range(1, len(p) - 1):
            total += np.linalg.det(p[[0, i, i + 1]]) / 6
    return total


def test_complete_cells_keep_the_nodes_of_their_faces(tmp_path):
    corners = BRICK
    edges = CELLS["hexahedron20"][1]
    faces = [(0, 3, 7, 4), (1, 2, 6, 5), (0, 1, 5, 4), (3, 2, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7)]
    middles = [corners[list(e)].mean(axis=0) for e in (*edges, *faces, range(8))]
    points = np.vstack([corners, *middles])
    for turned in (1.0, -1.0):
        mesh = meshio.Mesh(points * [turned, 1, 1], [("hexahedron27", np.arange(27)[None, :])])
        mesh.write(tmp_path / f"m{turned:.0f}.msh", file_format="gmsh22")
    text = "OPTI DIME 3 ; T = LIRE 'm1.msh' ; U = LIRE 'm-1.msh' ; V = MESU (U . 'MAILLAGE') ;"
    result = run(text, tmp_path)
    for name in "TU":
        (block,) = parts(result, name)["MAILLAGE"].blocks
        x, kind = block.coordinates[0], block.kind
        assert block.cell_type == "CU27"
        for _, face in kind.faces:
            np.testing.assert_allclose(
                x[face[-1]], x[[n for n in face if n in kind.corners]].mean(0)
            )
    assert result.session.root.find("V") == pytest.approx(24.0)


# ---- named parts ---------------------------------------------------------------------------------


def two_squares() -> meshio.Mesh:
    """Two squares over a line, as meshio has them."""
    points = np.array([(x, y) for y in (0, 1) for x in (0, 1, 2)], float)
    quads = np.array([(0, 1, 4, 3), (1, 2, 5, 4)])
    return meshio.Mesh(points, [("quad", quads), ("line", np.array([(0, 1), (1, 2)]))])


def lengths(found: dict[str, Mesh], *names: str) -> list[object]:
    return [[(b.cell_type, len(b)) for b in found[n].blocks] for n in names]


def test_physical_groups_of_both_versions(tmp_path):
    mesh = two_squares()
    mesh.points = np.column_stack([mesh.points, np.zeros(6)])
    names = {"left": np.array([1, 2]), "base": np.array([7, 1])}
    tags = [np.array([1, 5]), np.array([7, 7])]
    data = {"gmsh:physical": tags, "gmsh:geometrical": tags}
    made = meshio.Mesh(mesh.points, mesh.cells, cell_data=data, field_data=names)
    made.write(tmp_path / "m.msh", file_format="gmsh22")
    found = parts(run("OPTI DIME 2 ; T = MAILLER 'm.msh' ;", tmp_path))
    assert lengths(found, "left", "base", "physical_2D_5", "MAILLAGE", "@SEG2") == [
        [("QUA4", 1)], [("SEG2", 2)], [("QUA4", 1)], [("QUA4", 2), ("SEG2", 2)], [("SEG2", 2)],
    ]  # fmt: skip
    assert found["NOEUDS"].n_cells == 6


def test_numbers_of_cells_name_parts(tmp_path):
    mesh = two_squares()
    mesh.cell_data = {"MaterialIds": [np.array([0, 3]), np.array([3, 3])]}
    mesh.points = np.column_stack([mesh.points, np.zeros(6)])
    mesh.write(tmp_path / "m.vtu")
    found = parts(run("OPTI DIME 2 ; T = LIRE 'm.vtu' ;", tmp_path))
    assert lengths(found, "MaterialIds_0", "MaterialIds_3") == [
        [("QUA4", 1)], [("QUA4", 1), ("SEG2", 2)]
    ]  # fmt: skip


def test_names_of_our_own_vtu_files(tmp_path):
    text = (
        "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (2. 0.) ; SOIL = L TRAN 2 (0. 1.) ; "
        "RAFT = L TRAN 1 (0. -1.) ; ALL1 = SOIL ET RAFT ; OPTI SORT 'm' ; SORT 'VTK ' ALL1 ; "
        "T = LIRE 'm.vtu' ;"
    )
    found = parts(run(text, tmp_path))
    assert lengths(found, "SOIL", "RAFT") == [[("QUA4", 8)], [("QUA4", 4)]]


ABAQUS = """*HEADING
** a comment
*NODE, NSET=low
1, 0., 0.
2, 1., 0.
*NODE
3, 1., 1.
4, 0., 1.D0
5, 2., 0.
6, 2., 1.
*Element, type=cpe4r
10, 1, 2, 3, 4
*ELEMENT, TYPE=CPS4,
ELSET=right
20, 2, 5, 6,
3
*ELEMENT, TYPE=CONN3D2, ELSET=links
30, 1, 2
31, 1, 3
*ELEMENT, TYPE=STRI3, ELSET=ramp
40, 5, 3, 4
*ELEMENT, TYPE=S
41, 1
*ELSET, ELSET=both, GENERATE
10, 20, 10
*ELSET, ELSET=Again
both
*NSET, NSET=LOW
5,
*INCLUDE, INPUT=more.inc
"""


def test_sets_of_an_abaqus_deck(tmp_path):
    (tmp_path / "m.inp").write_text(ABAQUS)
    (tmp_path / "more.inc").write_text("*NSET, NSET=top\n3, 4, 6\n")
    result = run("OPTI DIME 2 ; T = LIRE 'm.inp' ;", tmp_path)
    found = parts(result)
    assert lengths(found, "right", "both", "Again", "low", "top", "ramp") == [
        [("QUA4", 1)], [("QUA4", 2)], [("QUA4", 2)], [("POI1", 3)], [("POI1", 3)], [("TRI3", 1)],
    ]  # fmt: skip
    assert found["right"].blocks[0].coordinates[0].mean(axis=0) == pytest.approx([1.5, 0.5, 0.0])
    told = [w for w in result.session.warnings if w.code == "operators.files.cells-left-out"]
    assert [w.data["told"] for w in told] == [["2 CONN3D2", "1 S"]]


@together("old, new, said", [
    ("*NODE\n3", "*NGEN\n3", "*NGEN"),
    ("10, 1, 2, 3, 4", "10, 1, 2, 3, 9", "m.inp cannot be read as ABAQUS: 9\n"),
    ("5, 6,\n3", "5, 6", "m.inp cannot be read as ABAQUS: *ELEMENT, TYPE=CPS4\n"),
    ("*HEADING", "*INCLUDE, INPUT=m.inp", "m.inp cannot be read as ABAQUS: *INCLUDE\n"),
    (ABAQUS, "*HEADING", "m.inp holds no nodes"),
    ("both\n", "none\n", "m.inp cannot be read as ABAQUS: 'NONE'\n"),
    ("both\n", "again\n", "m.inp cannot be read as ABAQUS: again\n"),
    ("more.inc", "/etc/passwd", "/etc/passwd is outside"),
    ("more.inc", "m.inp", "two elements bear the number 10"),
    ("*HEADING", "*PART, NAME=a\n*PART, NAME=b", "m.inp has several *PART"),
])  # fmt: skip
def test_an_abaqus_deck_that_is_not_read_says_why(old, new, said, tmp_path):
    (tmp_path / "m.inp").write_text(ABAQUS.replace(old, new))
    (tmp_path / "more.inc").write_text("*NSET, NSET=top\n3, 4, 6\n")
    assert said in run("OPTI DIME 2 ; T = LIRE 'm.inp' ;", tmp_path).message


@together("most, last, said", [
    ((5, 0), 2, ""), ((4, 0), 2, r"\*ELSET near"), ((0, 2), 2, ""), ((0, 1), 2, r"\*ELSET near"),
    ((9, 9), 3, ""), ((9, 9), 4, "FAR, GENERATE"),
])  # fmt: skip
def test_members_of_sets_are_counted(most, last, said, tmp_path, monkeypatch):
    """Two of one set, and again with one more in the set that names it: five, of three nodes."""
    monkeypatch.setattr(abaqus, "_MOST", most)
    rows = ["*NODE", "1,", "2, 1.", "3, 2.", "*NSET, NSET=near", "FAR", "3"]
    rows += ["*NSET, NSET=far, GENERATE", f"1, {last}"]
    (tmp_path / "m.inp").write_text("\n".join(rows))
    if said:
        with pytest.raises(InputError, match=said):
            abaqus.read_abaqus(tmp_path / "m.inp", Path)
    else:
        found = abaqus.read_abaqus(tmp_path / "m.inp", Path)
        nodes = {name: part.nodes.tolist() for name, part in found.parts.items()}
        assert nodes == {"near": [0, 1, 2], "far": [0, 1, 2][:last]}


# ---- out and back --------------------------------------------------------------------------------

_OUT = """
OPTI DIME 2 ELEM QUA8 MODE PLAN DEFO ;
T1 = MAILLER 'SOL' 8. 4. 'SEMELLE' 4. 1. 'TAILLE' 1. 'ELEMENT' 'QUA8' 'SOUDE' ;
DEPL (T1 . 'SOL') 'PLUS' (0.1 * ((COOR 2 (T1 . 'SOL')) * (COOR 2 (T1 . 'SOL'))) NOMC 'UX') ;
OPTI SORT 'm.{e}' ; SORT 'MESH' T1 ;
"""
_BACK = """
T = LIRE 'm.{e}' ; S = T . 'SOL' ;
MO1 = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA1 = MATE MO1 'YOUN' 3.E7 'NU' 0.25 ;
C1 = CONT S ; X1 Y1 = COOR C1 ;
UX1 = (2.E-4 * X1) + (1.E-4 * Y1) ; UY1 = (-3.E-4 * Y1) ;
BL1 = (BLOQ 'UX' C1) ET (BLOQ 'UY' C1) ;
F1 = DEPI BL1 ((NOMC 'UX' UX1) ET (NOMC 'UY' UY1)) ;
U1 = RESO ((RIGI MO1 MA1) ET BL1) F1 ;
E1 = EPSI MO1 U1 ;
EX1 = MAXI (ABS ((EXCO 'EPXX' E1) - 2.E-4)) ; EY1 = MAXI (ABS ((EXCO 'EPYY' E1) + 3.E-4)) ;
G1 = MAXI (ABS ((EXCO 'GAXY' E1) - 1.E-4)) ;
"""


@pytest.mark.parametrize("ending", ["msh", "med", "inp"])
def test_a_mesh_that_went_out_and_came_back_passes_the_patch_test(ending, tmp_path):
    if ending == "med" and not there("h5py"):
        pytest.skip("h5py is not installed")
    result = run((_OUT + _BACK).replace("{e}", ending), tmp_path)
    found = parts(result)
    wanted = parts(result, "T1")
    assert max(result.session.root.find(n) for n in ("EX1", "EY1", "G1")) < 1e-15
    for name, part in wanted.items():
        if isinstance(part, Mesh) and name != "TOTAL":
            assert sorted(lengths(found, name)[0]) == sorted(lengths(wanted, name)[0]), name
        elif name in ("CENTRE", "BORD_DROIT"):
            (at,) = found[name].blocks[0].coordinates[:, 0]
            np.testing.assert_allclose(at, part.coordinates, atol=1e-12)


def test_named_meshes_and_points_are_groups_that_meshio_reads(tmp_path):
    text = (
        "OPTI DIME 3 ELEM CUB8 ; P1 = 0. 0. 0. ; S = (DROI 2 P1 (2. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
        "V = S VOLU 1 'TRAN' (0. 0. 3.) ; F1 = FACE 2 V ; OTHER = MANU 'POI1' (9. 9. 9.) ; "
        "OPTI SORT 'm.msh' ; SORT 'MESH' V ;"
    )
    assert run(text, tmp_path).exit_code == 0
    read = meshio.read(tmp_path / "m.msh", "gmsh")
    assert {n: int(d) for n, (_, d) in read.field_data.items()} == {
        "V": 3, "F1": 2, "S": 2, "P1": 0
    }  # fmt: skip
    tag, _ = read.field_data["F1"]
    faces = np.vstack([
        b.data[t == tag] for b, t in zip(read.cells, read.cell_data["gmsh:physical"], strict=True)
        if b.type == "quad"
    ])  # fmt: skip
    assert read.points[np.unique(faces)][:, 2].tolist() == [3.0] * 6


@pytest.mark.skipif(not there("h5py"), reason="h5py is not installed")
def test_solids_of_med_turn_the_way_that_salome_describes_them(tmp_path):
    import h5py

    text = (
        "OPTI DIME 3 ELEM CUB8 SORT 'm' ; S = (DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
        "V = S VOLU 1 'TRAN' (0. 0. 1.) ; SORT 'MED' V ; T = LIRE 'm.med' ;"
    )
    result = run(text, tmp_path)
    with h5py.File(tmp_path / "m.med") as file:
        (step,) = file["ENS_MAA/mesh"].values()
        bricks = step["MAI/HE8"]
        x = step["NOE/COO"][()].reshape(3, -1).T[bricks["NOD"][()] - 1]
        assert bricks.attrs["GEO"] == 308
    # MED's brick: the second, third and fourth node turn the other way round than VTK's
    assert np.linalg.det([x[1] - x[0], x[3] - x[0], x[4] - x[0]]) == pytest.approx(-1.0)
    (block,) = parts(result)["@CUB8"].blocks
    assert signed_volume(block) == pytest.approx(1.0)


# ---- nothing in silence --------------------------------------------------------------------------


def test_cells_without_a_counterpart_and_collapsed_ones_are_counted(tmp_path):
    points = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1), (2, 2)], float)
    cells = [
        ("quad", np.array([(0, 1, 2, 3), (1, 4, 5, 5)])),
        ("line4", np.array([(0, 1, 2, 3)])),
        ("vertex", np.array([[6]])),
    ]
    flat = np.column_stack([points, np.zeros(7)])
    meshio.Mesh(flat, cells).write(tmp_path / "m.msh", file_format="gmsh22")
    result = run("OPTI DIME 2 ; T = LIRE 'm.msh' ;", tmp_path)
    found = parts(result)
    assert lengths(found, "@QUA4", "@TRI3", "@POI1") == [
        [("QUA4", 1)],
        [("TRI3", 1)],
        [("POI1", 1)],
    ]
    told = {w.code.split(".")[-1]: w.data for w in result.session.warnings}
    assert told["cells-left-out"]["told"] == ["1 line4"]
    assert (told["cells-collapsed"]["count"], told["cells-collapsed"]["left"]) == (1, 0)


def test_polygons_of_vtk(tmp_path):
    angle = np.arange(6) * np.pi / 3
    points = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    meshio.Mesh(points, [("polygon", np.arange(6)[None, :])]).write(tmp_path / "m.vtu")
    found = parts(run("OPTI DIME 2 ; T = LIRE 'm.vtu' ;", tmp_path))
    assert lengths(found, "MAILLAGE") == [[("POL6", 1)]]


BDF = """$ bulk data
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
CQUAD4,1,7,1,2,3,4
CONM2,9,1,,5.
RBE2,10,1,123,2
ENDDATA
"""


@together(
    "change, code",
    [
        (("", ""), ""),
        (("ENDDATA", ""), "io.mesh-file-cut"),
        (("GRID,2,,", "GRID,2,5,"), "io.nastran-coordinate-system"),
        (("1,2,3,4", "1,2,3,8"), "io.no-readable-mesh-file"),
    ],
)
def test_bulk_data(change, code, tmp_path):
    (tmp_path / "m.bdf").write_text(BDF.replace(*change) if change[0] else BDF)
    result = run("OPTI DIME 2 ; T = LIRE 'm.bdf' ;", tmp_path)
    assert [e.code for e in result.errors] == ([code] if code else [])
    if not code:
        assert lengths(parts(result), "ref_7") == [[("QUA4", 1)]]
        (told,) = result.session.warnings
        assert told.data["told"] == ["1 CONM2", "1 RBE2"]


def test_a_mesh_in_space_is_not_read_in_the_plane(tmp_path):
    one_cell("tetra").write(tmp_path / "m.vtu")
    result = run("OPTI DIME 2 ; T = LIRE 'm.vtu' ;", tmp_path)
    assert [e.code for e in result.errors] == ["operators.files.mesh-not-of-dimension"]
    assert "OPTI DIME 3" in result.message


def test_a_library_that_is_missing_is_named_with_its_line(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "h5py", None)
    (tmp_path / "m.med").write_bytes(b"\x89HDF")
    deck = "OPTI DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; "
    for text in ("T = LIRE 'm.med' ;", deck + "OPTI SORT 'n.med' ; SORT 'MESH' S ;"):
        result = run(text, tmp_path)
        assert [e.code for e in result.errors] == ["io.mesh-library-missing"]
        assert "pip install 'ssilang[med]'" in result.message


def test_endings_and_names_that_are_not_written(tmp_path):
    deck = "OPTI DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; "
    result = run(deck + "OPTI SORT 'n.bdf' ; SORT 'MESH' S ;", tmp_path)
    assert "SORT 'NAS' writes that" in result.message
    result = run(deck + "OPTI SORT 'n' ; SORT 'MESH' S ;", tmp_path)
    assert "endings that it writes: .msh .med .inp" in result.message
    table = "T = TABL ; T . 'a,b' = S ; OPTI SORT 'n.inp' ; SORT 'MESH' T ;"
    assert "can be called 'a,b'" in run(deck + table, tmp_path).message
    assert not (tmp_path / "n.inp").exists()


# ---- Gmsh itself ---------------------------------------------------------------------------------

GEO = """
Point(1) = {-6, -4, 0, 2}; Point(2) = {6, -4, 0, 2}; Point(3) = {6, 0, 0, 2};
Point(4) = {-6, 0, 0, 2}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("soil") = {1}; Physical Curve("base") = {1};
Physical Curve("round") = {1, 2, 3, 4}; Physical Point("corner") = {3};
Mesh.ElementOrder = 2;
"""


@pytest.fixture
def gmsh():
    module = pytest.importorskip("gmsh", reason="gmsh is not installed")
    module.initialize([], interruptible=False)
    module.option.setNumber("General.Terminal", 0)
    yield module
    module.finalize()
    keep_from_closed_pipes()


@pytest.mark.parametrize("order", [1, 2])
def test_what_gmsh_itself_writes_is_read(gmsh, order, tmp_path):
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 3)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [1], name="body")
    gmsh.model.addPhysicalGroup(2, [5], name="base")
    gmsh.option.setNumber("Mesh.MeshSizeMin", 1.0)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 1.0)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(order)
    text, cell = "OPTI DIME 3 ;", {1: "@TET4", 2: "@TE10"}[order]
    endings = [e for e in ("msh", "inp", "bdf", "vtk", "unv", "med", "mesh")
               if (e != "med" or there("h5py")) and (e != "mesh" or order == 1)]  # fmt: skip
    for ending in endings:
        gmsh.write(str(tmp_path / f"m.{ending}"))
        text += f"T{ending} = LIRE 'm.{ending}' ; V{ending} = MESU (T{ending} . '{cell}') ;"
        if ending in ("msh", "inp", "unv", "med"):
            text += (
                f"B{ending} = MESU (T{ending} . 'base') ; W{ending} = MESU (T{ending} . 'body') ;"
            )
    result = run(text, tmp_path)
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    assert [find(f"V{e}".upper()) for e in endings] == pytest.approx([3.0] * len(endings))
    named = [e for e in endings if e in ("msh", "inp", "unv", "med")]
    assert [find(f"B{e}".upper()) for e in named] == pytest.approx([1.0] * len(named))
    assert [find(f"W{e}".upper()) for e in named] == pytest.approx([3.0] * len(named))


@pytest.mark.parametrize("ending", ["msh", "med"])
def test_gmsh_reads_what_is_written(gmsh, ending, tmp_path):
    if ending == "med" and not there("h5py"):
        pytest.skip("h5py is not installed")
    text = (
        "OPTI DIME 3 ELEM CU20 ; S = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
        f"V = S VOLU 1 'TRAN' (0. 0. 3.) ; OPTI SORT 'm.{ending}' ; SORT 'MESH' V ;"
    )
    assert run(text, tmp_path).exit_code == 0
    gmsh.open(str(tmp_path / f"m.{ending}"))
    groups = {(d, gmsh.model.getPhysicalName(d, t)) for d, t in gmsh.model.getPhysicalGroups()}
    assert groups == {(2, "S"), (3, "V")}
    (kind,), (cells,), _ = gmsh.model.mesh.getElements(3)
    assert gmsh.model.mesh.getElementProperties(kind)[0] == "Hexahedron 20"
    # the scaled Jacobian of an upright brick is 1; turned inside out, or with middles astray, less
    assert gmsh.model.mesh.getElementQualities(cells, "minSJ") == pytest.approx(1.0)
    assert sum(gmsh.model.mesh.getElementQualities(cells, "volume")) == pytest.approx(3.0)


@pytest.mark.skipif(not there("gmsh"), reason="gmsh is not installed")
def test_mailler_has_gmsh_mesh_a_script(tmp_path):
    (tmp_path / "box.geo").write_text(GEO)
    text = (
        "OPTI DIME 2 ; T = MAILLER 'box.geo' ; A = MESU (T . 'soil') ; B = MESU (T . 'base') ; "
        "C = MESU (T . 'round') ; X = COOR 1 ((T . 'corner') POIN 1) ;"
    )
    result = run(text, tmp_path)
    found = parts(result)
    assert [result.session.root.find(n) for n in "ABCX"] == pytest.approx([48.0, 12.0, 32.0, 6.0])
    assert {b.cell_type for b in found["soil"].blocks} == {"TRI6"}
    (tmp_path / "box.geo").write_text(GEO.replace("Point(4)", "Point(4"))
    assert [e.code for e in run(text, tmp_path).errors] == ["io.no-readable-mesh-file"]
