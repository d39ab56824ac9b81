"""Sweeps: values, all runs in one table, failures, resumption, motions, clusters."""

import csv
import ctypes
import gc
import io
import os
import signal
import sys
import time
import weakref
from dataclasses import replace
from multiprocessing.context import SpawnContext
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st
from left_behind import closed_pipes_end_it

import ssilang
from ssilang.cli.run import run_text
from ssilang.cli.sweeping import worker
from ssilang.cli.sweeping.given import parse_values
from ssilang.cli.sweeping.pool import run_grown, run_here
from ssilang.cli.sweeping.sweep import SweepOptions, sweep
from ssilang.cli.sweeping.worker import Task, row_anyhow
from ssilang.system import keep_from_closed_pipes

pytestmark = pytest.mark.usefixtures("one_after_the_other")

DECK = """OPTI DIME 2 ELEM SEG2 ;
AG = 0.3 ; N = 4 ; MOTION = 'none' ;
SI (AG > 0.85) ; ERRE 'too strong' ; FINSI ;
T = TABL ;
@VERIFIE T 'square' (AG * AG * N) 0. 100. ;
AG = 2. ;
@VERIFIE T 'later value' AG 2. 1.E-9 ;
"""


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "case.ssi"
    path.write_text(DECK)
    return path


def run(options):
    out, err = io.StringIO(), io.StringIO()
    code = sweep(options, out, err)
    return code, out.getvalue(), err.getvalue()


@given(st.integers(-50, 50), st.integers(1, 20), st.integers(1, 30))
def test_a_range_of_integers_has_both_ends(first, step, count):
    last = first + step * (count - 1)
    assert parse_values(f"{first}:{last}:{step}") == list(range(first, last + 1, step))


def test_a_sweep_makes_one_table_and_reports_failures(deck, tmp_path):
    out = tmp_path / "out"
    options = SweepOptions(deck, ["AG=0.5,0.9", "N=1,2"], out=out, jobs=2)
    code, said, wrong = run(options)
    assert code == 1
    assert "4 runs, 2 failed" in said
    assert sum("too strong" in line for line in wrong.splitlines()) == 2
    rows = pq.read_table(out / "sweep.parquet").to_pylist()
    assert [(r["AG"], r["N"], r["exit_code"]) for r in rows] == [
        (0.5, 1, 0), (0.5, 2, 0), (0.9, 1, 1), (0.9, 2, 1),
    ]  # fmt: skip
    assert [r["square"] for r in rows] == [0.25, 0.5, None, None]
    assert {r["later value"] for r in rows} == {2.0, None}
    assert (out / "square.png").read_bytes()[:4] == b"\x89PNG"


def test_a_sweep_goes_on_where_it_stopped(deck, tmp_path):
    out = tmp_path / "out"
    run(SweepOptions(deck, ["AG=0.1,0.2"], out=out, jobs=1))
    made = {p: p.stat().st_mtime_ns for p in out.glob("runs/*/row.json")}
    assert len(made) == 2
    next(iter(made)).unlink()
    code, said, _ = run(SweepOptions(deck, ["AG=0.1,0.2,0.3"], out=out, jobs=1))
    assert code == 0
    assert "1 of 3 runs are done already" in said
    kept = [p for p, at in made.items() if p.stat().st_mtime_ns == at]
    assert len(kept) == 1
    assert len(pq.read_table(out / "sweep.parquet")) == 3


def test_values_put_in_front_number_the_runs_anew(deck, tmp_path):
    out = tmp_path / "out"
    run(SweepOptions(deck, ["AG=0.2,0.3"], out=out, jobs=1))
    code, said, _ = run(SweepOptions(deck, ["AG=0.1,0.2,0.3"], out=out, jobs=1))
    assert code == 0
    assert "2 of 3 runs are done already" in said
    rows = pq.read_table(out / "sweep.parquet").to_pylist()
    assert [(r["run"], r["AG"]) for r in rows] == [(1, 0.1), (2, 0.2), (3, 0.3)]
    assert [r["square"] for r in rows] == pytest.approx([0.04, 0.16, 0.36])  # AG**2 N, N = 4


def test_each_motion_is_a_run_that_may_read_its_file(tmp_path):
    motions = tmp_path / "motions"
    motions.mkdir()
    for name, top in (("a.csv", 1.5), ("b.csv", 2.5)):
        (motions / name).write_text(f"0. 0.\n1. {top}\n")
    folder = tmp_path / "deck"
    folder.mkdir()
    deck = folder / "case.ssi"
    deck.write_text(
        "OPTI 'ACQU' MOTION ; ACQU A1*FLOTTANT B1*FLOTTANT A2*FLOTTANT B2*FLOTTANT ;\n"
        "T = TABL ; @VERIFIE T 'peak' B2 0. 10. ;\n"
    )
    options = SweepOptions(deck, motions=motions, out=tmp_path / "out", jobs=1)
    code, _, wrong = run(options)
    assert code == 0, wrong
    rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    assert [r["peak"] for r in rows] == [1.5, 2.5]
    # a file that is changed, and one that is put in front, are runs of their own
    (motions / "b.csv").write_text("0. 0.\n1. 4.5\n")
    (motions / "_.csv").write_text("0. 0.\n1. 5.5\n")
    code, said, _ = run(options)
    assert code == 0
    assert "1 of 3 runs are done already" in said
    rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    assert [(r["run"], r["peak"]) for r in rows] == [(1, 5.5), (2, 1.5), (3, 4.5)]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="names there are characters")
def test_motions_whose_names_are_no_utf_8_are_runs_that_are_kept(tmp_path):
    folder = os.fsencode(tmp_path) + b"/m\xff"
    os.mkdir(folder)
    for name, top in ((b"a\xfe.csv", 1.5), (b"a\xff.csv", 2.5)):
        with open(folder + b"/" + name, "w", encoding="ascii") as file:
            file.write(f"0.;0.\n1.;{top}\n")
    deck = tmp_path / "case.ssi"
    deck.write_text("A = LIRE 'SIGNAL' MOTION 1. ; SORT 'BILA' 'peak' (MAXI (EXTR A 'ORDO')) ;")
    motions, limits = Path(os.fsdecode(folder)), ["peak>2"]
    options = SweepOptions(deck, motions=motions, out=tmp_path / "out", jobs=1, fragility=limits)
    code, _, wrong = run(options)
    assert code == 0, wrong
    rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    assert [r["peak"] for r in rows] == [1.5, 2.5]
    assert [r["MOTION"][-11:] for r in rows] == [r"a\udcfe.csv", r"a\udcff.csv"]
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "the table was edited" not in page
    assert "2 of 2 runs are done already" in run(options)[1]


@pytest.mark.skipif(os.name != "posix", reason="names of one system")
@pytest.mark.parametrize("control", ["\x1b[2J", "\x9b2J", "\u202e", "\nerror: x"])
def test_names_of_motions_steer_no_terminal(tmp_path, control):
    motions = tmp_path / "motions"
    motions.mkdir()
    for name in ("a", "b"):
        (motions / f"{name}{control}.csv").write_text("0. 0.\n1. 1.5\n")
    (motions / f"note{control}.txt").write_text("of somebody\n")
    deck = tmp_path / f"case{control}.ssi"
    deck.write_text("A = LIRE 'SIGNAL' MOTION 1. ; SORT 'BILA' 'peak' (MAXI (EXTR A 'ORDO')) ;")
    code, told, wrong = run(SweepOptions(deck, motions=motions, out=tmp_path / "out", jobs=1))
    assert code == 0
    assert "left out, no motion: note" in wrong
    assert "hold the same" in wrong
    assert control not in told + wrong


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
def test_motions_that_lead_out_of_their_folder_are_refused(tmp_path):
    motions, private = tmp_path / "motions", tmp_path / "private"
    for folder in (motions, private):
        folder.mkdir()
    (private / "theirs.csv").write_text("0. 0.\n1. 2.5\n")
    (motions / "a.csv").write_text("0. 0.\n1. 1.5\n")
    (motions / "b.csv").symlink_to(motions / "a.csv")
    deck = tmp_path / "case.ssi"
    deck.write_text("A = LIRE 'SIGNAL' MOTION 1. ; SORT 'BILA' 'peak' (MAXI (EXTR A 'ORDO')) ;")
    options = SweepOptions(deck, motions=motions, out=tmp_path / "out", jobs=1)
    assert run(options)[0] == 0
    rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    assert [(r["peak"], r["folder"]) for r in rows] == [(1.5, "a"), (1.5, "b")]
    (motions / "c.csv").symlink_to(private / "theirs.csv")
    code, _, wrong = run(options)
    assert code == 2
    assert "c.csv is a link out of" in wrong
    with pytest.raises(ssilang.Error, match="is a link out of"):
        ssilang.sweep(deck, records=motions)
    link = tmp_path / "named"  # by the user, as the folder itself
    link.symlink_to(private)
    assert run(replace(options, motions=link))[0] == 0


def test_files_that_are_no_motions_are_told_once_and_left(tmp_path):
    folder = tmp_path / "motions"
    folder.mkdir()
    (folder / "m1.AT2").write_text("PEER\nACCELERATION\nNPTS= 2, DT= 0.1 SEC\n  1.0E-3 -.2D0\n")
    (folder / "m2.csv").write_text("time;value\n0.;1.\n")
    (folder / "notes 1.md").write_text("# Records\nof 2024, 12 of them\n")
    (folder / "map.png").write_bytes(b"\x89PNG\0\n1 2 3\n")
    deck = tmp_path / "case.ssi"
    deck.write_text(
        "MOTION = 'none' ; AG = 1. ; T = TABL ; @VERIFIE T 'ag' AG 0. 10. ; MESS MOTION ;"
    )
    options = SweepOptions(deck, ["AG=0.5,0.75"], folder, tmp_path / "out", jobs=1)
    code, _, wrong = run(options)
    assert code == 0
    assert wrong.splitlines()[0] == "left out, no motions: map.png, notes 1.md"
    runs = sorted(p.name for p in (tmp_path / "out" / "runs").iterdir())
    assert runs == ["AG=0.5_m1", "AG=0.5_m2", "AG=0.75_m1", "AG=0.75_m2"]
    for name in ("m1.AT2", "m2.csv"):
        (folder / name).unlink()
    code, _, wrong = run(options)
    assert code == 2
    assert "no ground motion" in wrong


def test_another_script_makes_the_runs_of_a_folder_anew(deck, tmp_path):
    options = SweepOptions(deck, ["AG=0.2"], out=tmp_path / "out", jobs=1)
    run(options)
    deck.write_text(DECK.replace("AG * AG * N", "AG"))
    code, said, _ = run(options)
    assert code == 0
    assert "done already" not in said
    assert pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()[0]["square"] == 0.2
    deck.write_text("AG = 1. ; ERRE 'wrong' ;")  # a run that fails leaves no row of the one before
    assert run(options)[0] == 1
    deck.write_text(DECK)
    assert "done already" not in run(options)[1]


def _archive(folder, value):
    text = f"OPTI DIME 2 ELEM SEG2 ; A = {value} ; OPTI 'SAUV' 'data.sauv' ; SAUV A ;"
    run_text(text, output_directory=folder)


INPUTS = {
    "procedure": (
        "@p.ssi",
        lambda p, x: p.write_text(f"DEBP @P ; FINP {x} ;\n"),
        "A = @P ;",
    ),
    "csv": (
        "data.csv",
        lambda p, x: p.write_text(f"{x}\n"),
        "OPTI 'ACQU' 'data.csv' ; ACQU A*FLOTTANT ;",
    ),
    "mesh": (
        "data.inp",
        lambda p, x: p.write_text(f"*NODE\n1, 0, 0\n2, {x}, 0\n*ELEMENT, TYPE=T2D2\n1, 1, 2\n"),
        "M = LIRE 'ABAQ' 'data.inp' ; A = MESU (M . 'MAILLAGE') ;",
    ),
    "archive": (
        "data.sauv",
        lambda p, x: _archive(p.parent, x),
        "OPTI 'REST' 'data.sauv' ; REST ;",
    ),
    "procedure that stands before the library's": (
        "@verifie.ssi",
        lambda p, x: x < 2.0 or p.write_text(
            "DEBP @VERIFIE T*TABLE N*MOT A*FLOTTANT B*FLOTTANT C*FLOTTANT ; "
            "SORT 'BILA' N (2. * A) B C ; FINP ;"
        ),
        "A = 1. ;",
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", INPUTS)
def test_runs_whose_inputs_changed_are_made_again(kind, tmp_path):
    name, write, read = INPUTS[kind]
    write(tmp_path / name, 1.0)
    deck = tmp_path / "case.ssi"
    deck.write_text(
        f"OPTI DIME 2 ELEM SEG2 ; N = 1 ; T = TABL ; {read} @VERIFIE T 'value' (A * N) 0. 9. ;"
    )
    options = SweepOptions(deck, ["N=1,2"], out=tmp_path / "out", jobs=1)

    def values():
        code, said, wrong = run(options)
        assert code == 0, wrong
        rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
        return [r["value"] for r in rows], said + wrong

    assert values()[0] == [1.0, 2.0]
    assert "2 of 2 runs are done already" in values()[1]
    write(tmp_path / name, 2.0)
    found, said = values()
    assert found == [2.0, 4.0]
    assert f"2 runs again: {name} has changed" in said
    assert "done already" not in said


def test_runs_of_another_version_are_made_again(deck, tmp_path):
    options = SweepOptions(deck, ["AG=0.2"], out=tmp_path / "out", jobs=1)
    run(options)
    row = tmp_path / "out" / "runs" / "AG=0.2" / "row.json"
    row.write_text(row.read_text().replace(f'"{ssilang.__version__}"', '"9.9"'))
    assert "1 run again: made by ssilang 9.9" in run(options)[2]
    row.write_text('{"key": "1", "row": {"exit_code": 0}}')  # of a version that kept less
    assert "1 run again: what was left does not say" in run(options)[2]


def test_a_file_that_changes_during_its_run_holds_for_no_later_one(tmp_path):
    deck = tmp_path / "case.ssi"
    (tmp_path / "data.csv").write_text("1.\n")
    os.utime(tmp_path / "data.csv", (time.time() + 1000.0,) * 2)
    deck.write_text("N = 1 ; OPTI 'ACQU' 'data.csv' ; ACQU A*FLOTTANT ; SORT 'BILA' 'n' (FLOT N) ;")
    options = SweepOptions(deck, ["N=1"], out=tmp_path / "out", jobs=1)
    assert run(options)[2] == ""
    assert "1 run again: data.csv has changed" in run(options)[2]


def figures(table):
    """Rows of a table without what the clock says."""
    with table.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream, delimiter=";"))
    return [{k: v for k, v in row.items() if k != "seconds"} for row in rows]


@pytest.mark.parametrize(
    ("before", "after"),
    [('"square"', '"sqare"'), ("2.0", "NaN"), ("2.0", '"two"'), ('"AG": 1', '"AG": 3'), ("{", "[")],
)
def test_rows_that_were_changed_are_made_again(deck, tmp_path, before, after):
    """A figure renamed, no number any more, of another value: what is kept is as it was written."""
    options = SweepOptions(deck, ["AG=0.1", "N=1"], out=tmp_path / "out", jobs=1)
    deck.write_text("AG = 1. ; N = 1 ; T = TABL ; @VERIFIE T 'square' (2. * AG * N) 0. 9. ;")
    options = replace(options, settings=["AG=1,2", "N=1"])
    run(options)
    table = figures(tmp_path / "out" / "sweep.csv")
    row = next(iter(sorted((tmp_path / "out").glob("runs/*/row.json"))))
    text = row.read_text()
    row.write_text(text.replace(before, after))
    assert row.read_text() != text
    _, said, wrong = run(options)
    assert "1 of 2 runs are done already" in said
    assert "1 run again: " in wrong
    assert figures(tmp_path / "out" / "sweep.csv") == table


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes with a name")
@pytest.mark.parametrize("name", ["row.json", "summary.json"])
@pytest.mark.parametrize("left", ["pipe", "deep", "elsewhere"])
def test_what_a_stranger_left_in_a_folder_of_runs_holds_up_nothing(deck, tmp_path, name, left):
    """A pipe is not waited for, brackets within brackets, or a link, are no row: the run again."""
    options = SweepOptions(deck, ["AG=0.1,0.2", "N=1"], out=tmp_path / "out", jobs=1)
    run(options)
    table = figures(tmp_path / "out" / "sweep.csv")
    record = min((tmp_path / "out").glob(f"runs/*/{name}"))
    record.rename(tmp_path / "kept")
    if left == "pipe":
        os.mkfifo(record)
    elif left == "deep":
        record.write_text("[" * 100_000 + "]" * 100_000)
    else:
        record.symlink_to(tmp_path / "kept")
    code, said, wrong = run(options)
    assert code == 0
    assert ("1 of 2 runs" in said) == ("again" in wrong) == (name == "row.json")
    assert figures(tmp_path / "out" / "sweep.csv") == table
    assert (tmp_path / "kept").is_file()


@pytest.mark.parametrize("name", ["sweep.csv", "sweep.parquet", "report.html"])
def test_what_cannot_be_written_of_a_sweep_is_told(deck, tmp_path, name):
    (tmp_path / "out" / name).mkdir(parents=True)
    options = SweepOptions(deck, ["AG=0.1,0.2", "N=1"], out=tmp_path / "out", jobs=1, report=True)
    code, _, wrong = run(options)
    assert code == 2
    assert f"{name} cannot be written" in wrong


@pytest.mark.parametrize("place", ["runs", "runs/AG=0.2_N=1", "histories"])
def test_folders_of_a_sweep_that_lead_elsewhere_are_refused(deck, tmp_path, place):
    options = SweepOptions(deck, ["AG=0.1,0.2", "N=1"], out=tmp_path / "out", jobs=1)
    (tmp_path / "elsewhere").mkdir()
    link = tmp_path / "out" / place
    link.parent.mkdir(parents=True)
    link.symlink_to(tmp_path / "elsewhere")
    code, _, wrong = run(options)
    assert code == 2
    assert f"{link.name} is a link to another place" in wrong
    assert not list((tmp_path / "elsewhere").iterdir())


@pytest.mark.parametrize(
    ("peaks", "reads", "told"),
    [
        ((0.2, 0.4, 3.5), "", ["c.csv"]),  # m/s2 beside g
        ((0.2, 2.9, 3.5), "", ["a.csv"]),
        ((0.2, 0.4, 1.5), "", []),
        ((0.2, 3.5), "", []),
        ((0.2, 0.4, 0.35), " 'SI'", []),
    ],
)
def test_motions_of_other_units_are_told_by_their_peaks(deck, tmp_path, peaks, reads, told):
    (tmp_path / "m").mkdir()
    for name, peak in zip("abc", peaks, strict=False):
        (tmp_path / "m" / f"{name}.csv").write_text(f"t;a\n0;0\n1;{-peak}\n")
    deck.write_text(f"MOTION = 'a.csv' ; E = LIRE 'SIGNAL' MOTION{reads} ;")
    options = SweepOptions(deck, [], motions=tmp_path / "m", out=tmp_path / "out", jobs=1)
    lines = [line for line in run(options)[2].splitlines() if "far apart" in line]
    assert [line.split()[0] for line in lines] == told


def test_what_makes_a_sweep_useless_is_told(deck, tmp_path):
    motions = tmp_path / "motions"
    motions.mkdir()
    kinds = {"a.csv": ("g", ""), "b.csv": ("g", "2;0\n"), "c_UP.csv": ("cm/s^2", "")}
    for name, (unit, more) in kinds.items():
        (motions / name).write_text(f"t (s);a ({unit})\n0;0\n1;1\n{more}")
    deck.write_text(
        "AG = 1. ; MOTION = 'a.csv' ; MESS MOTION ; H = 1. ;\n"
        "H = H + 1. ; B = 1. ;\nB = 2. ; MESS B ;"
    )
    options = SweepOptions(
        deck, ["AG=0.1", "B=3.", "H=4."], motions=motions, out=tmp_path / "out", jobs=1
    )
    code, _, wrong = run(options)
    assert code == 0
    assert "a value is given to AG, and the script does not read it again" in wrong
    assert [line.split()[0] for line in wrong.splitlines() if "line 3 gives" in line] == ["B"]
    assert "H is set from outside" not in wrong
    assert "a.csv and b.csv hold the same motion" in wrong
    assert "different units (a.csv G, b.csv G and c_UP.csv CM/S2)" in wrong
    assert "c_UP.csv is a vertical component among horizontal ones" in wrong
    assert "no run has a figure" in wrong
    deck.write_text(
        "N = 1 ; SI (N EGA 2) ; MESS 'the other way' ; FINSI ; AG = 1. ; B = 1. ;\n"
        "X = SPO (EVOL 'MANU' (PROG 0. 1.) (PROG AG B)) 'AMOR' (B * 5.) "
        "'FREQ' (PROG 1.) 'ACCE' ; SORT 'BILA' 'twice' (2. * AG) ;"
    )
    given = ["AG=1.,2.", "B=3.,4.", "N=1,2"]
    code, _, wrong = run(replace(options, settings=given, motions=None, report=True))
    said = wrong.splitlines()
    assert (code, sum("8 runs were warned" in line for line in said) > 0) == (0, True)
    assert [line.split(":")[0] for line in said if "no figure" in line] == [
        "no figure depends on B"
    ]
    assert "8 runs were warned" in (options.out / "report.html").read_text()
    code, _, wrong = run(replace(options, out=deck))
    assert (code, f"{deck} cannot be the folder of a sweep" in wrong) == (2, True)
    code, _, wrong = run(replace(options, settings=["MOTION=a"]))
    assert (code, "MOTION is set twice" in wrong) == (2, True)


def test_a_peak_that_what_is_swept_does_not_scale_is_told(tmp_path):
    """The motion is A times a sine of 2 m/s2, PGA the sine's; K moves the drift alone."""
    path = tmp_path / "case.ssi"
    path.write_text("""OPTI DIME 2 ELEM SEG2 ; A = 1. ; B = 1. ; C = 400. ;
    LT = PROG 0. PAS 0.01 1. ; E = EVOL 'MANU' 'TEMP' LT 'ACCE' (2. * (SIN (LT * 720.))) ;
    P = 0. 0. ; M = MASS 'UX' 1. P ; T = TABL ; T . 'RIGI' = RIGI 'UX' C P ; T . 'MASS' = M ;
    T . 'CHAR' = CHAR 'MECA' (M * (MANU 'CHPO' P 1 'UX' -1.)) (A * B * E) ;
    T . 'TEMPS_CALCULES' = LT ; T . 'PAS_SAUVES' = 1 ; R = DYNAMIC T ;
    SORT 'BILA' 'drift' (MAXI (ABS (EXTR (EVOL 'TEMP' R 'DEPL' 'UX' P) 'ORDO'))) ;
    SORT 'BILA' 'PGA' (MAXI (EXTR (B * E) 'ORDO')) ;""")
    settings = ["A=1.,2.", "B=1.,2.", "C=400.,500."]
    _, _, wrong = run(SweepOptions(path, settings, out=tmp_path / "o", jobs=1))
    assert "PGA does not change with A, as the motions" in wrong
    assert wrong.count("does not change") == 1


def test_the_table_is_a_csv_file_too(deck, tmp_path, monkeypatch):
    out = tmp_path / "out"
    run(SweepOptions(deck, ["AG=0.5,0.9", "N=1"], out=out, jobs=1))
    with (out / "sweep.csv").open(newline="") as stream:
        plain = list(csv.DictReader(stream, delimiter=";"))
    rows = pq.read_table(out / "sweep.parquet").to_pylist()
    assert [list(r) for r in plain] == [list(r) for r in rows]
    for mine, theirs in zip(plain, rows, strict=True):
        for name, value in theirs.items():
            if isinstance(value, float):
                assert float(mine[name]) == value
            else:
                assert mine[name] == ("" if value is None else str(value))
    # without the library that writes Parquet, it is all there is
    monkeypatch.setattr("ssilang.cli.sweeping.sweep.is_there", lambda: False)
    _, said, _ = run(SweepOptions(deck, ["AG=0.5"], out=tmp_path / "plain", jobs=1))
    assert "sweep.csv" in said
    assert not (tmp_path / "plain" / "sweep.parquet").exists()


def dies_once(task: Task) -> dict[str, object]:
    """Kills its process for the second run."""
    if task.number == 2:
        os._exit(3)
    return {"run": task.number, "exit_code": 0, "folder": ""}


def test_a_process_that_dies_costs_its_own_run_alone(tmp_path):
    tasks = [Task(i, tmp_path / "x.ssi", tmp_path / str(i), {}) for i in range(1, 5)]
    rows = sorted(run_here(tasks, 2, dies_once), key=lambda r: r["run"])
    assert [r["exit_code"] for r in rows] == [0, 1, 0, 0]
    assert "lost" in rows[1]["error"]


@pytest.mark.skipif(sys.platform != "linux", reason="signals are looked up in /proc")
def test_a_process_that_dies_ends_no_caller_whose_pipes_a_library_let_end_it(tmp_path):
    """The pool writes what waits to pipes whose readers are no more: Gmsh leaves that deadly."""
    try:
        ctypes.CDLL(None).signal(signal.SIGPIPE, 0)
        assert closed_pipes_end_it()
        assert [r["exit_code"] for r in run_here(some_tasks(tmp_path, 1), 1, remembers)] == [0]
        assert not closed_pipes_end_it()
    finally:
        keep_from_closed_pipes()


SEEN: list[int] = []


def remembers(task: Task) -> dict[str, object]:
    """Says which run was made first in the memory of its process, and in which process."""
    SEEN.append(task.number)
    return {"run": task.number, "exit_code": 0, "first": SEEN[0], "process": os.getpid()}


def fails_first(task: Task) -> dict[str, object]:
    """As `remembers`; the first run leaves nothing."""
    return {"run": 1, "exit_code": 1, "first": 2} if task.number == 1 else remembers(task)


def dies_first(task: Task) -> dict[str, object]:
    """Kills its process for the first run."""
    if task.number == 1:
        os._exit(3)
    return {"run": task.number, "exit_code": 0, "folder": ""}


def raises(task: Task) -> dict[str, object]:
    """Fails outside the script."""
    if task.number == 2:
        raise OSError("disk full")
    return {"run": task.number, "exit_code": 0, "folder": ""}


def some_tasks(tmp_path, count):
    return [Task(i, tmp_path / "x.ssi", tmp_path / str(i), {}) for i in range(1, count + 1)]


@pytest.mark.parametrize(("work", "first"), [(remembers, 1), (fails_first, 2)])
def test_later_runs_begin_with_the_memory_of_the_first_that_ended_well(tmp_path, work, first):
    rows = list(run_grown(some_tasks(tmp_path, 9), 2, work))
    assert sorted(r["run"] for r in rows) == list(range(1, 10))
    assert {r["first"] for r in rows} == {first}
    others = {r["process"] for r in rows if r["run"] > first}
    assert rows[first - 1]["process"] not in others
    assert len(others) <= 2


@pytest.mark.parametrize(("work", "lost"), [(dies_once, 2), (dies_first, 1), (raises, 2)])
def test_a_trunk_or_a_fork_that_dies_costs_its_own_run_alone(tmp_path, work, lost):
    rows = sorted(run_grown(some_tasks(tmp_path, 6), 2, work), key=lambda r: r["run"])
    assert [r["run"] for r in rows] == list(range(1, 7))
    assert [r["run"] for r in rows if r["exit_code"]] == [lost]


def test_what_a_run_of_a_fork_leaves_is_gone_before_the_next(tmp_path, monkeypatch):
    left = []

    def work(task):
        session = SimpleNamespace(arrays=np.zeros(3))
        session.itself = session  # a cycle, as a session is: nobody but the collector sees it
        left.append(weakref.ref(session.arrays))
        return {}

    monkeypatch.setattr(worker, "gc", gc)  # what is there of other tests is frozen, as of the trunk
    assert row_anyhow(Task(1, tmp_path, tmp_path, {}), work) == {}
    assert left[0]() is None


def test_a_sweep_that_is_left_ends_its_processes(tmp_path):
    rows = run_grown(some_tasks(tmp_path, 6), 2, remembers)
    made = next(rows)
    rows.close()
    with pytest.raises(ProcessLookupError):
        os.kill(int(made["process"]), 0)


UPLIFT = """OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
MOTION = 'none' ; T0 = LIRE 'CSV' MOTION ;
P1 = 0. 0. ; P2 = 4. 0. ; FOO = DROI 8 P1 P2 ; GRO = FOO PLUS (0. -1.) ;
JOI = MANU 'SEG2' (POIN 1 GRO) (POIN 1 FOO) ;
REPE BJ 8 ; I = &BJ + 1 ; JOI = JOI ET (MANU 'SEG2' (POIN I GRO) (POIN I FOO)) ; FIN BJ ;
MOF = MODE FOO 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
MAF = MATE MOF 'YOUN' 3.E10 'NU' 0.2 'RHO' 0. 'SECT' 1. 'INRY' 0.1 'INRZ' 0.1 ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MAJ = MATE MOJ 'KN' 4.E6 'KS' 0. ;
MAS = MASS 'DEPL' 2.E3 FOO ;
T1 = TABL ; T1 . 'RIGI' = (RIGI MOF MAF) ET (BLOQ 'UX' 'UY' GRO) ET (BLOQ 'UX' P1) ;
T1 . 'MASS' = MAS ; T1 . 'MODELE' = MOJ ; T1 . 'CARACTERISTIQUES' = MAJ ;
UP = MANU 'CHPO' (POIN 1 FOO) 1 'FY' 1.E5 ;
DOWN = MAS * (MANU 'CHPO' FOO 1 'UY' -9.81) ;
T1 . 'CHAR' = (CHAR 'MECA' DOWN) ET (CHAR 'MECA' UP (EVOL 'MANU' (T0 . 1) (T0 . 2))) ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-3 'NPAS' 100 ; T1 . 'PAS_SAUVES' = 1 ;
T2 = DYNAMIC T1 ; LU = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P1) 'ORDO' ;
@VERIFIE T1 'highest' (MAXI LU) -10. 100. ; @VERIFIE T1 'lowest' (MINI LU) -10. 100. ;
"""


def test_motions_on_a_shared_model_move_as_in_runs_of_their_own(tmp_path):
    from ssilang.cli.run import RunOptions, run_file

    (tmp_path / "motions").mkdir()
    deck = tmp_path / "uplift.ssi"
    deck.write_text(UPLIFT)
    for i in range(5):
        rows = "".join(f"{t};{(1 + i) * t * (1 - t)}\n" for t in (0.0, 0.05, 0.1, 0.2))
        (tmp_path / "motions" / f"m{i}.csv").write_text(rows)
    options = SweepOptions(deck, motions=tmp_path / "motions", out=tmp_path / "out", jobs=1)
    assert run(options)[0] == 0
    together = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    for row in together:
        alone = RunOptions(
            output_directory=tmp_path / "alone",
            allowed=[tmp_path],
            given={"MOTION": row["MOTION"]},
        )
        checks = {c.name: c.value for c in run_file(deck, alone).session.checks}
        assert row["highest"] == pytest.approx(checks["highest"], rel=1e-12)
        assert row["lowest"] == pytest.approx(checks["lowest"], rel=1e-12)
    assert len({row["highest"] for row in together}) == 5


def test_a_dask_cluster_gives_the_same_table(deck, tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:
        options = SweepOptions(
            deck, ["AG=0.5,0.6"], out=tmp_path / "out", scheduler=cluster.scheduler_address
        )
        code, _, wrong = run(options)
    assert code == 0, wrong
    rows = pq.read_table(tmp_path / "out" / "sweep.parquet").to_pylist()
    assert [r["square"] for r in rows] == [1.0, 1.44]


def test_wrong_commands_end_with_2(deck, tmp_path):
    code, _, wrong = run(SweepOptions(deck, out=tmp_path))
    assert code == 2
    assert "--set NAME=VALUES" in wrong


def test_run_takes_one_value_of_a_name(deck, tmp_path, capsys):
    from ssilang.cli.main import main

    assert main([str(deck), "--set", "AG=0.9", "--out", str(tmp_path / "o")]) == 1
    assert "too strong" in capsys.readouterr().err
    assert main([str(deck), "--set", "AG=0.4", "--out", str(tmp_path / "o")]) == 0
    for settings, said in (
        (["AG=1,2"], "AG gets several"),
        (["AG=1", "--set", "ag=2"], "AG is set twice"),
    ):
        with pytest.raises(SystemExit) as stopped:
            main([str(deck), "--set", *settings])
        assert (stopped.value.code, said in capsys.readouterr().err) == (2, True)


def test_where_processes_cannot_share_the_runs_go_one_after_the_other(deck, monkeypatch):
    """As without /dev/shm; the rows are those of several processes."""
    options = [
        SweepOptions(deck, ["AG=0.1,0.9,0.2", "N=3,1"], out=deck.parent / name, jobs=2)
        for name in ("usual", "closed", "absent")
    ]
    expected, _, _ = run(options[0])
    for problem, alone in zip(
        (PermissionError(13, "closed"), ImportError("no sem_open")), options[1:], strict=True
    ):

        def lock(self, problem=problem):
            raise problem

        monkeypatch.setattr(SpawnContext, "Lock", lock)
        code, _, err = run(alone)
        assert code == expected == 1  # one value is too strong
        assert "the runs go one after the other" in err
    texts = [(o.folder / "sweep.csv").read_text() for o in options]
    tables = [list(csv.DictReader(io.StringIO(text), delimiter=";")) for text in texts]
    for row in (row for table in tables for row in table):
        del row["seconds"], row["folder"]
    assert tables[0] == tables[1] == tables[2]
    assert len(tables[0]) == 6
