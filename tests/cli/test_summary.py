"""summary.json and the files of a run, fine or failed."""

import io
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from together import together

from ssilang.cli.run import RunOptions, run_file, run_source
from ssilang.cli.summary import plain
from ssilang.io.run_output import RunOutput
from ssilang.language.text.source import Source
from ssilang.operators.dynamics.reports import ENERGY_LIMIT

SCRIPT = """
X = PROG 1. 2. ;
OPTI SORT 'a.csv' ; SORT 'EXCE' X ;
SORT 'BILA' 'sum' 3. 3.1 0.2 ; SORT 'BILA' 'low' 2.7 3.1 0.2 ; SORT 'BILA' 'count' 2 ;
SORT 'BILA' 'limit' -3.5 -3.25 0.25 ;
"""


def run(folder: Path, text: str) -> dict[str, Any]:
    (folder / "deck.ssi").write_text(text)
    run_file(folder / "deck.ssi", RunOptions(output_directory=folder / "out", summary=True))
    made: dict[str, Any] = json.loads((folder / "out" / "summary.json").read_text())
    return made


def test_files_figures_and_statistics_are_listed(tmp_path, monkeypatch):
    monkeypatch.setattr("ssilang.cli.summary.peak_memory", lambda: 5 * 2**18)
    made = run(tmp_path, SCRIPT)
    assert made["peak_memory_mb"] == 1.2
    assert made["exit_code"] == 0
    assert made["deck"] == str(tmp_path / "deck.ssi")
    assert made["files"] == [{"path": "a.csv", "bytes": 8}]
    assert [(f["name"], f["value"], f["ok"]) for f in made["figures"]] == [
        ("sum", 3.0, True),
        ("low", 2.7, False),
        ("count", 2.0, None),
        ("limit", -3.5, True),
    ]
    assert made["seconds"] > 0
    assert made["statements"] == 7


def test_a_warning_of_every_turn_is_shown_once_and_counted(tmp_path):
    text = (
        "OPTI DIME 2 ELEM SEG2 ; C = MANU 'CHPO' (DROI 2 (0. 0.) (1. 0.)) 1 'X' -1. ;\n"
        "REPE B 5 ; D = C ** 0.5 ; FIN B ; D = C ** 0.5 ;\n"
    )
    options, err = RunOptions(output_directory=tmp_path, summary=True), io.StringIO()
    result = run_source(Source("deck.ssi", text), options, io.StringIO(), err)
    told = err.getvalue()
    assert len(result.session.warnings) == 6
    assert told.count("have no power 0.5") == 2  # at two places
    again = "of them again, at the same place with other figures at most: not shown)"
    assert f"6 warnings (4 {again}" in told
    text = (
        "OPTI DIME 2 ELEM SEG2 ; L = D 1 (0. 0.) (1. 0.) ; MO = MODE L MECANIQUE ELASTIQUE POUT ;\n"
        "REPE B 5 ; A = MATE MO 'YOUN' 3.E10 'NU' 0.2 'SECT' 1. 'INRZ' (1.E9 * &B) ; FIN B ;\n"
        "A = MATE MO 'YOUN' 3.E10 'NU' 0.2 'SECT' 1. 'INRZ' 1.E9 ;\n"
    )
    err = io.StringIO()
    run_source(Source("deck.ssi", text), options, io.StringIO(), err)
    shown = [line.split()[3] for line in err.getvalue().splitlines() if "INRZ = " in line]
    assert shown == ["1e+09", "2e+09", "1e+09"]  # two of the loop, one of another place
    assert f"6 warnings (3 {again}" in err.getvalue()


def test_a_failed_run_says_where_and_keeps_whole_files(tmp_path):
    made = run(tmp_path, SCRIPT + "SORT 'CHAI' 'more' ;\nY = X . 3 ;\nSORT 'CHAI' 'never' ;\n")
    assert made["exit_code"] == 1
    (error,) = made["errors"]
    assert (error["code"], error["line"]) == ("not-a-table", 7)
    assert (tmp_path / "out" / "a.csv").read_text() == "1.0\n2.0\nmore\n"
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["a.csv", "summary.json"]


def test_numbers_that_are_none_are_null():
    given = {"a": np.float64("nan"), 1: [np.int64(3), float("inf")], "c": np.array([1.5]), "d": {2}}
    assert json.dumps(plain(given)) == '{"a": null, "1": [3, null], "c": [1.5], "d": [2]}'


def test_an_output_folder_that_cannot_be_made_is_an_error(tmp_path):
    (tmp_path / "out").write_text("a file")
    (tmp_path / "deck.ssi").write_text(SCRIPT)
    options = RunOptions(output_directory=tmp_path / "out", summary=True)
    result = run_file(tmp_path / "deck.ssi", options)
    assert result.exit_code == 1
    assert "cannot be written" in result.message


def test_a_folder_that_holds_the_results_of_another_deck_is_told(tmp_path):
    said = []
    for name in ("a.ssi", "a.ssi", str(tmp_path / "a.ssi"), "b.ssi"):
        err = io.StringIO()
        options = RunOptions(output_directory=tmp_path / "out", summary=True)
        run_source(Source(name, "X = 1 ;"), options, io.StringIO(), err)
        said.append("a.ssi" in err.getvalue())
    assert said == [False, False, False, True]


@pytest.mark.parametrize("kind", ["pipe", "nested", "link", "list"])
def test_what_is_no_summary_in_a_folder_of_results_holds_nobody_up(kind, tmp_path):
    out, err = tmp_path / "out", io.StringIO()
    out.mkdir()
    (tmp_path / "secret").write_text('{"deck": "another"}')
    if kind == "pipe":
        os.mkfifo(out / "summary.json")
    elif kind == "link":
        (out / "summary.json").symlink_to(tmp_path / "secret")
    else:
        (out / "summary.json").write_text("[" * 100_000 if kind == "nested" else "[1]")
    options = RunOptions(output_directory=out, summary=True)
    result = run_source(Source("a.ssi", "X = 1 ;"), options, io.StringIO(), err)
    assert (result.exit_code, "another" in err.getvalue()) == (0, False)
    assert json.loads((out / "summary.json").read_text())["deck"] == "a.ssi"
    assert (tmp_path / "secret").read_text() == '{"deck": "another"}'


def test_a_run_with_a_summary_holds_its_folder_before_it_writes(tmp_path):
    other, out = RunOutput(tmp_path, tmp_path), io.StringIO()
    other.hold()
    options = RunOptions(output_directory=tmp_path, summary=True)
    result = run_source(Source("deck", "MESS 'runs' ;"), options, out, io.StringIO())
    other.release()
    assert [e.code for e in result.errors] == ["io.folder-in-use"]
    assert (out.getvalue(), list(tmp_path.iterdir())) == ("", [])


def test_the_command_writes_below_results(tmp_path):
    (tmp_path / "deck.ssi").write_text(SCRIPT)
    command = [sys.executable, "-m", "ssilang.cli.main", "deck.ssi"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    folder = tmp_path / "results" / "deck"
    assert (done.returncode, done.stderr) == (0, f"1 file in {folder}, 0 warnings\n")
    names = sorted(p.name for p in (tmp_path / "results" / "deck").iterdir())
    assert names == ["a.csv", "summary.json"]


@pytest.mark.skipif(os.name != "posix", reason="signals of one system")
def test_an_interruption_inside_procedures_names_the_line_of_the_script(tmp_path):
    script = (
        "DEBP INNER ; REPE B ; SORT 'CHAI' &B ; FIN B ; FINP ;\n"
        "DEBP OUTER ; INNER ; FINP ;\nOPTI SORT 'a.txt' ;\nOUTER ;\n"
    )
    (tmp_path / "deck.ssi").write_text(script)
    command = [sys.executable, "-m", "ssilang.cli.main", "deck.ssi", "--out", "out"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        while not (tmp_path / "out" / "a.txt").exists():
            assert process.poll() is None
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        told = process.communicate(timeout=30)[1]
    assert "error: interrupted" in told
    assert "deck.ssi:1:" in told
    assert "deck.ssi:2:" in told
    assert "deck.ssi:4:" in told
    lines = (tmp_path / "out" / "a.txt").read_text().splitlines()
    assert lines == [str(i + 1) for i in range(len(lines))]


@pytest.mark.skipif(os.name != "posix", reason="imports are counted on one system")
def test_heavy_libraries_are_not_loaded_before_they_are_used(tmp_path):
    heavy = "matplotlib meshio pyvista PIL numba scipy.special scipy.interpolate scipy.linalg"
    code = (
        "import sys; from ssilang.cli.run import run_text; run_text('X = 1 ;'); "
        f"print(sorted(set('{heavy}'.split()) & set(sys.modules)))"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "[]"


def test_energy_from_nowhere_is_told_beside_the_largest_and_in_joules(tmp_path):
    """A unit mass on a spring of 100 N/m under 1 N: the work of 0.02 m at its peak, the end."""
    made = run(
        tmp_path,
        """OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; T = TABL ;
        T . 'RIGI' = RIGI 'DEPL' 100. P1 ; T . 'MASS' = MASS 'DEPL' 1. P1 ;
        T . 'CHAR' = CHAR 'MECA' (FORC 'FX' 1. P1) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
        T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.314 ; R = DYNAMIC T ;""",
    )
    (line,) = made["statistics"]["calculations"]
    largest = line["energy_imbalance_joules"] / line["energy_imbalance"]
    assert largest == pytest.approx(0.02, rel=1e-4)
    assert 0.0 < line["energy_imbalance"] < 1e-9


# ---- energies out of balance: a unit mass falls 1 mm under 10 N onto a joint of 1e6 N/m

FALL = """OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P1 = 0. 0. ; P2 = 0. 1. ; L = DROI 1 P1 P2 ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MA = MATE MO 'KN' 1.E6 'KS' 0. ;
T = TABL ; T . 'RIGI' = (BLOQ 'DEPL' P1) ET (BLOQ 'UX' P2) ; T . 'MASS' = MASS 'DEPL' 1. P2 ;
T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ; T . 'DEPL' = MANU 'CHPO' P2 1 'UY' 1.E-3 ;
T . 'CHAR' = CHAR 'MECA' (FORC (0. -10.) P2) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' {step} 0.03 ; {scheme}R = DYNAMIC T ;
"""
PULL = """OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P1 = 0. 0. ; P2 = 0. 1. ; L = DROI 1 P1 P2 ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MA = MATE MO 'KN' 900. 'KS' 0. ;
T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;
T . 'BLOCAGES_MECANIQUES' = (BLOQ 'DEPL' P1) ET (BLOQ 'UX' P2) ET (RIGI 'DEPL' 100. P2) ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC (0. 10.) P2) (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. -1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. 2. ; PASAPAS T ;
"""
SWAY = """OPTI DIME 2 MODE PLAN DEFO ; P2 = 0. 1. ; T = TABL ; LT = PROG 0. 'PAS' 1. 12. ;
T . 'BLOCAGES_MECANIQUES' = (RELA 'MINI' 'UX' P2) ET (BLOQ 'UY' P2) ET (RIGI 'DEPL' 100. P2) ;
T . 'CHARGEMENT' = CHAR 'MECA' (FORC (-5. 0.) P2) (EVOL 'MANU' LT ((3. * (COS (180. * LT))) - 1.)) ;
T . 'TEMPS_CALCULES' = LT ; PASAPAS T ;
"""


def closing(tmp_path: Path, deck: str, language: str = "en") -> tuple[str, dict[str, Any]]:
    told, options = io.StringIO(), RunOptions(tmp_path, language=language, summary=True)
    assert run_source(Source("deck", deck), options, io.StringIO(), told).exit_code == 0
    return told.getvalue(), json.loads((tmp_path / "summary.json").read_text())


@together("language, expected", [
        ("en", ("warning: DYNAMIC: energies are out of balance by ", "likely: a step too long for "
                "the joint", "2 warnings, energies out of balance by ")),
        ("fr", ("avertissement : DYNAMIC : les énergies ont un écart de ", "sans doute : un pas "
                "trop long pour le joint", "2 avertissements, écart des énergies de ")),
    ])  # fmt: skip
def test_a_motion_whose_energies_are_out_of_balance_ends_with_a_warning(
    tmp_path, language, expected
):
    """The step is three times the contact's half period: energy comes from nowhere."""
    told, made = closing(tmp_path, FALL.format(step="0.01", scheme=""), language)
    for part in expected:
        assert part in told
    assert told.splitlines()[-1].split(", ")[-1].startswith(expected[-1].split(", ")[-1])
    codes = [w["code"] for w in made["warnings"]]
    assert codes[-1] == "operators.dynamics.energies-out-of-balance"
    (line,) = made["statistics"]["calculations"]
    assert line["energy_imbalance"] > ENERGY_LIMIT
    assert len(line["energy_imbalance_from"]) == 1


@together("step, scheme", [("2.E-5", ""), ("0.01", "T . 'CONSERVATIF' = VRAI ; ")])
def test_energies_in_balance_end_without_one(tmp_path, step, scheme):
    told, made = closing(tmp_path, FALL.format(step=step, scheme=scheme))
    assert ", energy within " in told.splitlines()[-1]
    assert "out of balance" not in told
    assert "energy_imbalance_from" not in made["statistics"]["calculations"][0]


def test_the_scheme_s_own_damping_is_named_beside_the_step(tmp_path):
    told, _ = closing(tmp_path, FALL.format(step="0.01", scheme="T . 'RHO_INF' = 0.5 ; "))
    assert "a step too long for the joint" in told
    assert "the scheme's own damping (ALPHA_F, RHO_INF, GAMMA)" in told


@together("deck, share", [(PULL, 0.9), (SWAY, 0.5)])
def test_load_steps_that_are_long_for_what_opens_are_no_warning(tmp_path, deck, share):
    """Pressed by 10 N onto 1000 N/m, then pulled to 0.1 m of 100 N/m in one step.

    At the end 0.5 J is stored; to -10 mm the work is 0.05 J, then along the straight line
    0: the balance is open by 0.45 of 0.5 J. Six times from 10 N against a rigid stop to 20 N
    away from it: 2 J are stored in 100 N/m, and 1 J is the work of 5 N along 0.2 m.
    """
    told, made = closing(tmp_path, deck)
    assert told.splitlines()[-1].endswith("0 warnings")
    assert made["statistics"]["calculations"][0]["energy_imbalance"] == pytest.approx(share)
    assert made["warnings"] == []
