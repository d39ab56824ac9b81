"""SORT: VTK, CSV, text, AVS, figures."""

from pathlib import Path

import meshio
import numpy as np
from script_runs import failed, ran, refused
from together import together

from ssilang.cli.run import RunResult
from ssilang.io.vtk.series import read_pvd
from tests.operators.test_drawing_scenes import PLATE as SHEET

PLATE = SHEET + "OPTI SORT 'out' ; "


def run(text: str, folder: Path) -> RunResult:
    return ran(PLATE + text, folder)


def names(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


def test_one_mesh_is_one_file(tmp_path):
    run("SORT 'VTK ' S U SG 'stress' ;", tmp_path)
    assert names(tmp_path) == ["out.pvd", "out.vtu"]
    read = meshio.read(tmp_path / "out.vtu")
    assert np.allclose(read.point_data["U"][:, 1], -0.02 * read.points[:, 0])
    # plane strain, EPXX = 0.01 and GAXY = -0.02
    stress = read.cell_data["stress"][0]
    assert np.allclose(stress[:, 0], 1e9 * 0.7 / (1.3 * 0.4) * 0.01)
    assert np.allclose(stress[:, 3], 1e9 / 2.6 * -0.02)


def test_times_make_a_series(tmp_path):
    run(
        "REPE B 3 ; SORT 'VTK ' S 'soil' L 'base' (U * &B) 'u' 'TEMP' (0.5 * &B) ; FIN B ;",
        tmp_path,
    )
    entries = read_pvd(tmp_path / "out.pvd")
    assert [(e.time, e.part) for e in entries[::2]] == [(0.5, "soil"), (1.0, "soil"), (1.5, "soil")]
    assert entries[-1].file == "out.0003.base.vtu"
    read = meshio.read(tmp_path / "out.0003.soil.vtu")
    assert np.allclose(read.point_data["u"][:, 0], 0.03 * read.points[:, 0])


def test_an_earlier_time_begins_anew(tmp_path):
    run("SORT 'VTK ' S 'TEMP' 1. ; SORT 'VTK ' S 'TEMP' 2. ; SORT 'VTK ' S 'TEMP' 1.5 ;", tmp_path)
    assert [e.time for e in read_pvd(tmp_path / "out.pvd")] == [1.5]


def test_a_series_of_another_run_is_gone_on_with(tmp_path):
    run("SORT 'VTK ' S 'TEMP' 1. ;", tmp_path)
    run("SORT 'VTK ' S 'TEMP' 2. 'SUIT' ;", tmp_path)
    assert [e.time for e in read_pvd(tmp_path / "out.pvd")] == [1.0, 2.0]
    run("SORT 'VTK ' S 'TEMP' 3. 'NOUV' ;", tmp_path)
    assert [e.time for e in read_pvd(tmp_path / "out.pvd")] == [3.0]


def test_no_list_on_demand_and_text(tmp_path):
    run("SORT 'VTK ' S 'TEMP' 1. 'NPVD' 'FORM' ;", tmp_path)
    assert names(tmp_path) == ["out.0001.0001.vtu"]
    assert "ascii" in (tmp_path / "out.0001.0001.vtu").read_text()


def test_tables_name_their_objects(tmp_path):
    run("T = TABL ; T . 'PART' = S ; T . 1 = L ; T . 'DEPL' = U ; SORT 'VTK ' T ;", tmp_path)
    assert names(tmp_path) == ["out.0001.1.vtu", "out.0001.PART.vtu", "out.pvd"]
    assert "DEPL" in meshio.read(tmp_path / "out.0001.1.vtu").point_data


def test_a_field_may_be_called_temp(tmp_path):
    run("SORT 'VTK ' S X 'TEMP' 'TEMP' 4. ;", tmp_path)
    assert "TEMP" in meshio.read(tmp_path / "out.0001.0001.vtu").point_data


def test_curves_and_lists_in_columns(tmp_path):
    text = (
        "OPTI SORT 'c.csv' ; E = EVOL 'MANU' 'time' (PROG 0. 1.) 'u' (PROG 2. 3.) ; "
        "T = TABL ; T . 'n' = LECT 7 8 9 ; SORT 'EXCE' E T (MOTS 'AA') 'SEPA' 'VIRG' ;"
    )
    run(text, tmp_path)
    lines = (tmp_path / "c.csv").read_text().splitlines()
    assert lines == ["time,u,n,", "0.0,2.0,7,AA", "1.0,3.0,8,", ",,9,"]


def test_text_lines_append_until_the_file_is_named_again(tmp_path):
    text = "OPTI SORT 'n.txt' ; SORT 'CHAI' 'a' 1 ; SORT 'CHAI' 'b' ;"
    run(text, tmp_path)
    assert (tmp_path / "n.txt").read_text() == "a1\nb\n"
    run(text + "OPTI SORT 'n.txt' ; SORT 'CHAI' 'c' ;", tmp_path)
    assert (tmp_path / "n.txt").read_text() == "c\n"


def test_values_of_avs_are_those_of_their_cells_where_kinds_alternate(tmp_path):
    points = [(1, 0, 0), (2, 1, 0), (3, 2, 0), (4, 0, 1), (5, 1, 1), (6, 2, 1)]
    lines = [
        "6 4 0 2 0", *(f"{n} {x} {y} 0" for n, x, y in points),
        "10 1 tri 1 2 4", "4 1 quad 2 3 6 5", "7 1 tri 2 5 4", "2 1 quad 1 2 5 4",
        "2 1 1", "HEAT, -", "COLD, -", "10 1.5 -1", "4 2.5 -2", "7 3.5 -3", "2 4.5 -4",
    ]  # fmt: skip
    (tmp_path / "m.inp").write_text("\n".join(lines) + "\n")
    text = "OPTI LECT 'm.inp' ; T = LIRE 'AVS' ; G = T . 'LEMCHAML' ; M = T . 'LEMAILLA' ;"
    root = run(text, tmp_path).session.root
    seen = {
        (block.cells.cell_type, name): values.ravel().tolist()
        for block in root.find("G").blocks
        for name, values in block.components.items()
    }
    assert seen == {
        ("TRI3", "HEAT"): [1.5, 3.5], ("TRI3", "COLD"): [-1.0, -3.0],
        ("QUA4", "HEAT"): [2.5, 4.5], ("QUA4", "COLD"): [-2.0, -4.0],
    }  # fmt: skip
    assert [b.cell_type for b in root.find("M").blocks] == [
        b.cells.cell_type for b in root.find("G").blocks
    ]


def test_a_matrix_with_its_conditions_as_matrix_market(tmp_path):
    from scipy.io import mmread

    text = (
        "K = (RIGI MO MA) ET (BLOQ 'DEPL' L) ; F = FORC 'FY' 3. (S POIN 'PROC' (2. 1.)) ; "
        "V = RESO K F ; SORT 'MAT ' 'MM' 'ASSE' K 'TITR' 'plate' 'INCO' 'GEOM' ; "
    )
    found = run(text, tmp_path).session.root
    matrix = mmread(tmp_path / "out.mm").toarray()
    n = 2 * 15 + 2 * 5
    assert matrix.shape == (n, n)
    inco = (tmp_path / "out.inco").read_text().splitlines()
    geom = np.loadtxt(tmp_path / "out.geom")
    names = inco[-2].split()
    unknowns = [tuple(map(int, line.split())) for line in inco[:n]]
    # the second member by the list of unknowns, and RESO's own solution at each of them
    load, solution = np.zeros(n), np.zeros(n)
    for row, (node, component) in enumerate(unknowns):
        number, name = int(geom[node - 1, 3]) - 1, names[component - 1]
        solution[row] = found.find("V").values_at(name, np.array([number]))[0]
        if name == "UY" and np.allclose(geom[node - 1, :2], [2.0, 1.0]):
            load[row] = 3.0
    assert np.allclose(matrix @ solution, load, atol=1e-6)
    for word, made in {"INCO": ["inco", "mm"], "GEOM": ["geom", "mm"]}.items():
        (alone := tmp_path / word).mkdir()
        run(f"K = RIGI MO MA ; SORT 'MAT ' 'MM' 'ASSE' '{word}' K ;", alone)
        assert sorted(path.suffix[1:] for path in alone.glob("out.*")) == made


def test_figures_go_to_the_session(tmp_path):
    checks = run("SORT 'BILA' 'a' 2 ; SORT 'BILA' 'b' 1. 2. 0.5 ;", tmp_path).session.checks
    assert [(c.name, c.value, c.expected, c.tolerance) for c in checks] == [
        ("a", 2.0, None, None),
        ("b", 1.0, 2.0, 0.5),
    ]


@together(
    "text, said",
    [
        ("SORT 'VTK ' U ;", "MAILLAGE"),
        ("SORT 'VTKX' U ;", "VTK"),
        ("OPTI SORT '../evil' ; SORT 'VTK ' S ;", "outside the script's folder"),
        ("OPTI SORT '/tmp/evil.csv' ; SORT 'EXCE' (PROG 1.) ;", "--allow /tmp"),
        ("SORT 'EXCE' (PROG 1.) 'SEPA' 'POINT' ;", "SEPA"),
        ("SORT 'VTK ' S 'SUIT' 'TEMP' 1. ;", "no such file"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_written(text, said, tmp_path):
    result = failed(PLATE + text, tmp_path / "out")
    assert said.lower() in result.message.lower()
    assert not (tmp_path / "out").exists()


def steps_of(path: Path) -> list[object]:
    """What VTK reads of each step of a .vtkhdf."""
    from vtkmodules.vtkIOHDF import vtkHDFReader

    from tests.io.vtk.test_vtkhdf import step_of

    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    return [step_of(reader, step) for step in range(reader.GetNumberOfSteps())]


def test_times_go_to_one_file_on_demand(tmp_path):
    # said once, the series goes on as it began
    run(
        "SORT 'VTK ' S (U * 1) 'u' 'VTKHDF' 'TEMP' 0.5 ; SORT 'VTK ' S (U * 2) 'u' 'TEMP' 1. ; "
        "SORT 'VTK ' S (U * 3) 'u' 'TEMP' 2. 'VTKHDF' ;",
        tmp_path,
    )
    assert names(tmp_path) == ["out.vtkhdf"]
    steps = steps_of(tmp_path / "out.vtkhdf")
    assert len(steps) == 3
    for i, grid in enumerate(steps, start=1):
        assert np.allclose(grid.point_data["u"][:, 0], 0.01 * i * grid.points[:, 0])
        assert grid.n_cells == 8


def test_one_file_begins_anew_and_gives_way_to_files(tmp_path):
    one = "SORT 'VTK ' S 'VTKHDF' 'TEMP' {} {} ; "
    run(one.format("1.", "") + one.format("2.", "") + one.format("3.", "'NOUV'"), tmp_path)
    assert len(steps_of(tmp_path / "out.vtkhdf")) == 1
    run(one.format("1.", "") + "SORT 'VTK ' S 'VTU' 'TEMP' 2. ;", tmp_path)
    assert names(tmp_path) == ["out.0001.0001.vtu", "out.pvd", "out.vtkhdf"]


@together("word", ["FORM", "BINA", "SUIT", "NPVD"])
def test_words_of_files_are_refused_for_one_file(tmp_path, word):
    assert f"'{word}' is for .vtu files" in refused(
        PLATE + f"SORT 'VTK ' S 'TEMP' 1. '{word}' 'VTKHDF' ;", tmp_path
    )
    assert names(tmp_path) == []


def test_another_mesh_in_one_file_is_refused(tmp_path):
    text = "SORT 'VTK ' S 'VTKHDF' 'TEMP' 1. ; SORT 'VTK ' L 'VTKHDF' 'TEMP' 2. ;"
    assert "out.vtkhdf has one mesh for all its steps" in refused(PLATE + text, tmp_path)
    assert len(steps_of(tmp_path / "out.vtkhdf")) == 1


def test_cells_have_the_names_that_the_script_gives_them(tmp_path):
    run(
        "UP = TRAN (DROI 4 (0. 1.) (2. 1.)) 1 (0. 1.5) ; ALL = S ET UP ; T = TABL ; "
        "T . 'TOP' = UP ; OUBL UP ; SORT 'VTK ' ALL ; "
        "OPTI SORT 'two' ; SORT 'VTK ' S 'low' ALL 'whole' ;",
        tmp_path,
    )
    read = meshio.read(tmp_path / "out.vtu")
    told = {name: value[0] for name, value in read.field_data.items()}
    names_of = {value: name for name, value in told.items() if name.startswith("group_")}
    height = read.points[read.cells[0].data][:, :, 1].mean(axis=1)
    for at, number in zip(height, read.cell_data["group"][0], strict=True):
        assert names_of[number] == ("group_S" if at < 1 else "group_TOP")
    assert set(read.cell_data["material"][0][height < 1]) == {told["material_MO"]}
    assert set(read.cell_data["material"][0][height > 1]) == {0}
    assert "part" not in read.cell_data
    read = meshio.read(tmp_path / "two.0001.whole.vtu")
    assert set(read.cell_data["part"][0]) == {read.field_data["part_whole"][0]} == {2}
