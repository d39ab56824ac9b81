"""LIRE and ACQU: values, procedures and meshes from files beside the script."""

from pathlib import Path

import pytest
from together import together

from ssilang.cli.run import RunOptions, RunResult, run_file
from ssilang.kernel.curves.curve import Curve
from ssilang.language.values import Table


def run(text: str, folder: Path, **files: str) -> RunResult:
    for name, content in files.items():
        (folder / name.replace("_", ".")).write_text(content)
    (folder / "deck.ssi").write_text(text)
    return run_file(folder / "deck.ssi", RunOptions(output_directory=folder / "out"))


def values(result: RunResult, *names: str) -> list[object]:
    assert result.exit_code == 0, result.message
    return [result.session.root.find(n) for n in names]


def test_columns_and_lines_of_a_table(tmp_path):
    text = (
        "A = LIRE 'CSV' 'x.csv' 'DEBU' 2 ; B = LIRE 'CSV' 'x.csv' 'DEBU' 2 'LIGN' ; "
        "C = LIRE 'CSV' 'y.txt' 'SEPA' ',' ;"
    )
    result = run(text, tmp_path, x_csv="t;u\n0.;1.\n2.;3.\n", y_txt="5,6\n")
    a, b, c = values(result, "A", "B", "C")
    assert isinstance(a, Table)
    assert isinstance(b, Table)
    assert isinstance(c, Table)
    assert [list(t.get(2).values) for t in (a, b, c)] == [[1.0, 3.0], [2.0, 3.0], [6.0]]


def test_a_suffix_is_put_behind_a_name_that_is_no_file(tmp_path):
    text = "A = LIRE 'CSV' 'x' ; B = LIRE 'CSV' 'y' ;"
    found = values(run(text, tmp_path, x_csv="1;2\n", y="3;4\n", y_csv="5;6\n"), "A", "B")
    assert [list(t.get(1).values) for t in found] == [[1.0], [3.0]]  # type: ignore[attr-defined]


def test_values_of_the_manual_s_kind(tmp_path):
    text = (
        "OPTI ACQU 'v.txt' ; ACQU I*ENTIER MM*MOT J*FLOTTANT ; ACQU K*ENTIER ; "
        "ACQU LL*LISTENTI 5 LR*LISTREEL 2 ; ACQU A B ; C = ACQU 'BRUT' ;"
    )
    content = "1 ' is less than ' 2\n2 times 3\n1 2 3\n4 5 6.5 1D3\nfree 1.5\nall of this\n"
    found = values(
        run(text, tmp_path, v_txt=content), *["I", "MM", "J", "K", "LL", "LR", "A", "B", "C"]
    )
    assert found[:4] == [1, " is less than ", 2.0, 2]
    assert [list(x.values) for x in found[4:6]] == [[1, 2, 3, 4, 5], [6.5, 1000.0]]  # type: ignore[attr-defined]
    assert found[6:] == ["FREE", 1.5, "all of this"]


def test_names_that_exist_are_given_new_values(tmp_path):
    text = "I = 5 ; X = PROG 1. ; OPTI ACQU 'v.txt' ; ACQU I*ENTIER X*FLOTTANT ;"
    assert values(run(text, tmp_path, v_txt="7 8\n"), "I", "X") == [7, 8.0]


def test_procedures_of_a_file(tmp_path):
    library = (
        "$$$$ DOUBLE\nDEBP DOUBLE A*ENTIER ; B = 2 * A ; FINP B ;\n$$$$ ONE\nDEBP ONE ; FINP 1 ;\n"
    )
    text = "LIRE 'PROC' 'lib.procedur' ; X = DOUBLE 4 ;"
    assert values(run(text, tmp_path, lib_procedur=library), "X") == [8]
    only = "LIRE 'PROC' 'lib.procedur' ONE ; X = EXIS DOUBLE ; Y = ONE ;"
    assert values(run(only, tmp_path), "Y") == [1]


def test_statements_become_a_procedure(tmp_path):
    text = "T = TABL ; LIRE 'PROC' 'part.dgibi' FILL ; FILL ; X = T . 1 ;"
    assert values(run(text, tmp_path, part_dgibi="T . 1 = 3 ;\n"), "X") == [3]


def test_triangles_and_universal_files(tmp_path):
    stl = "solid s\n" + "facet normal 0 0 1\nouter loop\n" + "".join(
        f"vertex {x} {y} 0\n" for x, y in ((0, 0), (1, 0), (0, 1))
    ) + "endloop\nendfacet\nendsolid\n"  # fmt: skip
    unv = (
        "    -1\n  2411\n 1 1 1 11\n 0. 0. 0.\n 2 1 1 11\n 2. 0. 0.\n    -1\n"
        "    -1\n  2412\n 1 11 1 1 7 2\n 0 1 1\n 1 2\n    -1\n"
        "    -1\n  2467\n 1 0 0 0 0 0 0 1\nbase\n 8 1 0 0\n    -1\n"
    )
    text = (
        "OPTI DIME 3 ; M = LIRE 'STL' 's.stl' ; A = MESU M 'SURF' ; "
        "T = LIRE 'UNV' 'm.unv' ; N = NBEL (T . 'base') ; P = NBNO (T . 'NOEUDS') ;"
    )
    result = run(text, tmp_path, s_stl=stl, m_unv=unv)
    assert values(result, "A", "N", "P") == [0.5, 1, 2]
    high, text = unv.replace("2. 0. 0.", "2. 0. 5."), "OPTI DIME 2 ; T = LIRE 'UNV' 'm.unv' ;"
    result = run(
        f"{text} D = VALE 'DIME' ; Z = COOR 3 (T . 'NOEUDS' POIN 2) ;", tmp_path, m_unv=high
    )
    assert values(result, "D", "Z") == [3, 5.0]


def test_files_of_other_folders_are_refused(tmp_path):
    (tmp_path / "deck").mkdir()
    (tmp_path / "secret.csv").write_text("1;2\n")
    result = run("A = LIRE 'CSV' '../secret.csv' ;", tmp_path / "deck")
    assert result.exit_code == 1
    assert result.errors[0].code == "forbidden-path"
    (tmp_path / "deck" / "deck.ssi").write_text("A = LIRE 'CSV' '../secret.csv' ;")
    options = RunOptions(output_directory=tmp_path / "out", allowed=[tmp_path])
    assert run_file(tmp_path / "deck" / "deck.ssi", options).exit_code == 0


@together(
    "text, said",
    [
        ("A = LIRE 'CSV' 'none.csv' ;", "no such file"),
        ("A = LIRE 'MDE' 'v.txt' ;", "did you mean 'MED'?"),
        ("A = LIRE 'v.txt' ;", "no mesh is known by the ending '.txt'"),
        ("A = LIRE 'v.mhs' ;", "did you mean '.msh'?"),
        ("OPTI ACQU 'v.txt' ; ACQU I*ENTIER ;", "'word' is no number"),
        ("OPTI ACQU 'v.txt' ; ACQU I*MAILLAGE ;", "'MAILLAGE' cannot be read"),
        ("OPTI ACQU 'v.txt' ; ACQU L*LISTREEL ;", "number of values must follow"),
        ("OPTI ACQU 'v.txt' ; ACQU A B C ;", "all have been read"),
    ],
)
def test_what_is_wrong_is_said(text, said, tmp_path):
    result = run(text, tmp_path, v_txt="word 2\n", v_mhs="")
    assert result.exit_code == 1
    assert said in result.message


# ---- ground motions

AT2 = """A DATABASE OF RECORDS
SOMEWHERE, 1/2/1990, A STATION WHOSE NAME IS LONG AND WHOSE LINE IS LONGER, 0901
ACCELERATION TIME SERIES IN UNITS OF G
{sizes}
   .1000000E-01  -.2000000E-01   .3000000E-01
  -.4000000E-01-.5000000E-01 0.
"""


@together("sizes", ["NPTS=   6, DT=   .0050 SEC,", "    6    0.0050    NPTS, DT"])
def test_a_record_of_peer_in_metres(tmp_path, sizes):
    result = run("E = LIRE 'PEER' 'a.AT2' 10. ;", tmp_path, a_AT2=AT2.format(sizes=sizes))
    (curve,) = values(result, "E")
    assert isinstance(curve, Curve)
    assert curve.title == AT2.split("\n")[1][:72]
    (part,) = curve.parts
    assert list(part.abscissas) == pytest.approx([0.0, 0.005, 0.01, 0.015, 0.02, 0.025])
    assert list(part.ordinates) == pytest.approx([0.1, -0.2, 0.3, -0.4, -0.5, 0.0])
    assert (part.abscissa_name, part.ordinate_name) == ("TEMP", "ACCE")


ASC = """EVENT_NAME: SOMEWHERE
EVENT_DATE_YYYYMMDD: 20200102
STATION_CODE: ABC
STREAM: HNE
SAMPLING_INTERVAL_S: 0.005
NDATA: {count}
UNITS: {unit}
DATA_TYPE: ACCELERATION
USER5:
1.5
-20.25
3.0E1
"""


def test_a_record_of_esm_in_metres(tmp_path):
    content = ASC.format(count=3, unit="cm/s^2")
    result = run("E = LIRE 'ESM' 'a.ASC' 0.01 ;", tmp_path, a_ASC=content)
    (curve,) = values(result, "E")
    assert isinstance(curve, Curve)
    (part,) = curve.parts
    assert list(part.abscissas) == pytest.approx([0.0, 0.005, 0.01])
    assert list(part.ordinates) == pytest.approx([0.015, -0.2025, 0.3])
    assert (part.ordinate_name, curve.title) == ("ACCE", "SOMEWHERE ABC HNE")
    assert result.session.warnings == []


@together(
    "unit, code", [("cm/s^2", ["record-not-in-si"]), ("", ["record-without-unit"]), ("m/s^2", [])]
)
def test_units_of_a_record_of_esm_are_told(tmp_path, unit, code):
    content = ASC.format(count=3, unit=unit)
    result = run("E = LIRE 'ESM' 'a.ASC' ;", tmp_path, a_ASC=content)
    assert [w.code.rpartition(".")[2] for w in result.session.warnings] == code


# ---- COSMOS, tables with titles

COSMOS = """Corrected acceleration  (Format v01.20 with 13 text lines) Src: made
Somewhere of 2 January 1990
{text}
 100 Integer-header values follow on  10 lines, Format= (10I8)
{integers}
 100 Real-header values follow on  20 lines, Format= (5F15.6)
{reals}
   1 Comment line(s) follow, each starting with a "|":
| made for a test
{count} acceleration pts, approx   0 secs, units=cm/sec2 (04),Format=(8f10.5)
   1.00000 -20.00000   3.50000-400.00000   5.00000   6.00000   7.00000   8.00000
   9.00000 -10.00000
End-of-data for Chan  1 acceleration
"""


def cosmos(count: int = 10, step: float = 0.005, version: str = "v01.20") -> str:
    reals = [-999.0] * 100
    reals[33] = step
    lines = ["".join(f"{x:15.6f}" for x in reals[i : i + 5]) for i in range(0, 100, 5)]
    text = COSMOS.format(
        text="\n".join(["-"] * 11), integers="\n".join(["    -999" * 10] * 10),
        reals="\n".join(lines), count=count,
    )  # fmt: skip
    return text.replace("v01.20", version)


def test_a_record_of_cosmos_whose_numbers_touch(tmp_path):
    result = run("E = LIRE 'COSMOS' 'a.V2' 'SI' ;", tmp_path, a_V2=cosmos())
    (curve,) = values(result, "E")
    (part,) = curve.parts
    assert list(part.ordinates) == pytest.approx(
        [0.01, -0.2, 0.035, -4.0, 0.05, 0.06, 0.07, 0.08, 0.09, -0.1]
    )
    assert part.abscissas[-1] == pytest.approx(0.045)
    assert (part.ordinate_name, curve.title) == ("ACCE", "Somewhere of 2 January 1990")
    assert result.session.warnings == []


def test_several_records_of_cosmos(tmp_path):
    both = cosmos() + cosmos(step=0.01)
    result = run("E = LIRE 'COSMOS' 'a.V2' 1. ; F = LIRE 'COSMOS' 'a.V2' 'CANAL' 2 1. ;", tmp_path,
                 a_V2=both)  # fmt: skip
    first, second = values(result, "E", "F")
    assert (first.parts[0].abscissas[1], second.parts[0].abscissas[1]) == (0.005, 0.01)
    assert [w.code for w in result.session.warnings] == ["operators.files.several-channels"]
    result = run("E = LIRE 'COSMOS' 'a.V2' 'CANAL' 3 1. ;", tmp_path, a_V2=both)
    assert [e.code for e in result.errors] == ["operators.files.no-such-channel"]


@together(
    "content, numbers, names",
    [
        (
            "time (s);ax (cm/s2);vel_y [mm/s]\n0.;0.;0.\n0.1;5.;7.\n",
            [0.05, 0.007],
            ["ACCE", "VITE"],
        ),
        ("# made\nt [ms], a [g]\n0, 0\n100, 0.5\n", [4.905], ["ACCE"]),
        ("T_s displ_cm\n0 0\n0.1 3\n", [0.03], ["DEPL"]),
        ("t\tacc in cm/sec/sec\n0\t0\n0.1\t-2\n", [-0.02], ["ACCE"]),
    ],
)
def test_a_table_with_titles_in_metres(tmp_path, content, numbers, names):
    result = run("E = LIRE 'SIGNAL' 'a.csv' 'SI' ;", tmp_path, a_csv=content)
    (curve,) = values(result, "E")
    assert [p.ordinates[1] for p in curve.parts] == pytest.approx(numbers)
    assert [p.ordinate_name for p in curve.parts] == names
    units = {"ACCE": "m/s2", "VITE": "m/s", "DEPL": "m"}
    assert [p.units for p in curve.parts] == [("s", units[n]) for n in names]
    assert curve.parts[0].abscissas[1] == pytest.approx(0.1)


def test_a_table_without_units_is_told_and_taken_as_it_is(tmp_path):
    result = run("E = LIRE 'SIGNAL' 'a.csv' ;", tmp_path, a_csv="0. 1.\n0.1 5.\n")
    assert values(result, "E")[0].parts[0].ordinates[1] == 5.0
    assert values(result, "E")[0].parts[0].units == ("", "")
    assert [w.code for w in result.session.warnings] == ["operators.files.record-without-unit"]
    result = run("OPTI 'UNIT' 'N-MM' ; E = LIRE 'SIGNAL' 'a.csv' 'SI' ;", tmp_path,
                 a_csv="t (s);a (g)\n0;1\n0.1;2\n")  # fmt: skip
    assert values(result, "E")[0].parts[0].units == ("", "")  # they are not those of the deck
    assert [w.code for w in result.session.warnings] == ["operators.files.record-in-other-units"]
    result = run("E = LIRE 'SIGNAL' 'a.csv' 'SI' ;", tmp_path, a_csv="0. 1.\n0.1 5.\n")
    assert "the record names no unit" in result.message
    result = run("E = LIRE 'SIGNAL' 'a.csv' 2. 'SI' ;", tmp_path, a_csv="t (s);a (g)\n0;1\n1;2\n")
    assert result.errors[0].code == "operators.files.factor-and-si"
    result = run("E = LIRE 'SIGNAL' 'a.csv' 'SI' ;", tmp_path, a_csv="t (s);a (ft)\n0;1\n1;2\n")
    assert "no factor to SI is known of the unit ft" in result.message


BROKEN = {
    ("PEER", "a_AT2"): [
        (AT2.format(sizes="NPTS= 7, DT= .005 SEC"), "line 4 says 7 values, the file holds 6"),
        (AT2.format(sizes="six values"), "line 4 has no 'NPTS= ..., DT= ... SEC'"),
        (AT2.format(sizes="NPTS= 6, DT= 0 SEC"), "line 4 has no"),
        (AT2.format(sizes="NPTS= 6, DT= .005") + "end", "line 7: 'end' is no number"),
        ("1. 2. 3.", "line 4 has no"),
    ],
    ("ESM", "a_ASC"): [
        (ASC.format(count=4, unit="g"), "NDATA says 4 values, the file holds 3"),
        (ASC.format(count=3, unit="g") + "end", "line 13: 'end' is no number"),
        ("1.5\n2.5\n", "the head has no 'SAMPLING_INTERVAL_S: ...'"),
        (ASC.format(count=3, unit="g").replace("0.005", "soon"), "the head has no"),
    ],
    ("COSMOS", "a_V2"): [
        (cosmos(version="v01.00"), "version 01.00 of the COSMOS format, 1.20 is read"),
        ("1. 2.\n", "no version of the COSMOS format"),
        (cosmos(count=11), "says 11 values, 10 follow"),
        (cosmos(step=-999.0), "the 34th of the 100 reals"),
        (cosmos(step=1.0), "0 s, says the line above the values, their step makes 10 s"),
        (cosmos().replace("acceleration pts", "raw counts pts"), "no line says how many"),
        (cosmos().replace("Real-header", "Other"), "34th of the 100 reals"),
    ],
    ("SIGNAL", "a_csv"): [
        ("t (s);a (g)\n0.;1.\n0.;2.\n", "line 3: the time is not above"),
        ("t (h);a (g)\n0.;1.\n1.;2.\n", "'t (h)' names no unit of time"),
        ("t;a\n0.;1.\n0.1;x\n", "line 3: 'x' is no number"),
        ("t;a\n0.;1.\n0.1;1.;2.\n", "line 3: 3 cells, the first line of numbers has 2"),
        ("a\n0.\n1.\n", "no two lines of numbers in two columns"),
    ],
}


@together("asked, told", [(of, row) for of, rows in BROKEN.items() for row in rows])
def test_a_broken_file_says_where(tmp_path, asked, told):
    (kind, name), (content, said) = asked, told
    ending = name.replace("_", ".")
    result = run(f"E = LIRE '{kind}' '{ending}' ;", tmp_path, **{name: content})
    assert result.exit_code == 1
    assert said in result.message
    assert "Traceback" not in result.message
