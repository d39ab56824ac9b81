"""Sweeps from Python: a DataFrame, from a script that has no guard; names and values refused."""

import json
import subprocess
import sys

import pytest
from together import together

import ssilang

DECK = """AG = 0.3 ; N = 4 ; MOTION = 'none' ;
SI (AG > 0.85) ; ERRE 'too strong' ; FINSI ;
TM = LIRE 'CSV' MOTION ;
SORT 'BILA' 'square' (AG * AG * N) ; SORT 'BILA' 'peak' (MAXI (TM . 1)) ;
"""
CALLER = """import warnings, ssilang
print("begins")
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    table = ssilang.sweep(
        "case.ssi", AG=[0.5, 0.9], N=2, records=["m1.csv", "m2.csv"], jobs=2
    )
print(table.to_json(orient="split"))
print(told[0].filename == __file__, told[0].message)
"""


def test_a_script_without_a_guard_gets_a_frame_and_leaves_nothing(tmp_path):
    (tmp_path / "case.ssi").write_text(DECK)
    (tmp_path / "caller.py").write_text(CALLER)
    for name, value in (("m1.csv", 1.5), ("m2.csv", 2.5)):
        (tmp_path / name).write_text(f"{value}\n0.5\n")
    before = {p.name for p in tmp_path.iterdir()}
    done = subprocess.run(
        [sys.executable, "caller.py"], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    assert done.returncode == 0, done.stderr
    begins, table, told = done.stdout.splitlines()
    assert begins == "begins"
    made = json.loads(table)
    head = ["AG", "N", "MOTION", "square", "peak", "exit_code", "seconds", "error", "warnings"]
    assert made["columns"] == head
    rows = [dict(zip(head, row, strict=True)) for row in made["data"]]
    assert [row["square"] for row in rows] == [0.5, 0.5, None, None]
    assert [row["peak"] for row in rows] == [1.5, 2.5, None, None]
    assert [row["exit_code"] for row in rows] == [0, 0, 1, 1]
    assert told.startswith("True 2 of 4 runs failed; the first: ")
    assert "too strong" in told
    assert {p.name for p in tmp_path.iterdir()} == before


@together(
    "given, said",
    [
        ({"AGG": [1.0]}, "did you mean AG"),
        ({"AG": [None]}, "AG takes numbers, words, True or False in a sweep, not NoneType"),
        ({}, "nothing to sweep"),
    ],
)
def test_what_cannot_be_swept_is_refused_before_anything_runs(tmp_path, given, said):
    (tmp_path / "case.ssi").write_text(DECK)
    with pytest.raises(ssilang.Error, match=said):
        ssilang.sweep(tmp_path / "case.ssi", **given)


def test_a_folder_that_is_asked_for_has_the_table_and_the_report(tmp_path):
    (tmp_path / "case.ssi").write_text(DECK)
    (tmp_path / "motions").mkdir()
    (tmp_path / "motions/m.csv").write_text("1.5\n0.5\n")
    given = {"out": tmp_path / "out", "report": True, "records": tmp_path / "motions"}
    made = ssilang.sweep(tmp_path / "case.ssi", N=[3, 2], AG=0.5, jobs=1, **given)
    assert made["square"].tolist() == [0.75, 0.5]
    for folder in made["folder"]:
        assert (tmp_path / "out/runs" / folder / "row.json").is_file()
    head = (tmp_path / "out/sweep.csv").read_text().splitlines()[0].split(";")
    assert {*made.columns} <= {*head}
    assert (tmp_path / "out/report.html").is_file()


def test_a_text_is_no_file_to_sweep():
    with pytest.raises(ssilang.Error, match="a sweep runs a file"):
        ssilang.sweep("X = 1 ;", X=[1, 2])
