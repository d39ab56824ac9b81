"""A deck says that PETSc solves: same results, what ran where in the summary, plain refusals."""

import json
import os
import signal
from pathlib import Path

import numpy as np
import pytest
from petsc_there import COMMAND, environment, ranks

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.text.source import Source

HEAD = "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;"
ASKED = "OPTI 'SOLVEUR' 'PETSC' ;"
MODEL = """
MAI = MAILLER 'SOL' 24. 10. 'SEMELLE' 4. 'STRUCTURE' 4. 8. 'TAILLE' 1. 2. ;
SOL = MAI . 'SOL' ; BLOC = MAI . 'STRUCTURE' ;
MOS = MODE SOL 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ;
MAS = MATE MOS 'YOUN' 1.2E8 'NU' 0.33 'RHO' 2000. ;
MOB = MODE BLOC 'MECANIQUE' 'ELASTIQUE' 'ISOTROPE' ;
MAB = MATE MOB 'YOUN' 3.E10 'NU' 0.2 'RHO' 2400. ;
MOJ = MODE (MAI . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI2' ;
MAJ = MATE MOJ 'KN' 2.E8 'KS' 2.E8 ;
BLO = (BLOQ 'UX' 'UY' (MAI . 'BASE')) ET (BLOQ 'UY' (MAI . 'COTES')) ;
RIG = (RIGI MOS MAS) ET (RIGI MOB MAB) ET BLO ;
RIJ = RIG ET (RIGI MOJ MAJ) ;
MM = (MASS MOB MAB) ET (MASS MOS MAS) ;
UNX = MANU 'CHPO' (SOL ET BLOC) 2 'UX' 1. 'UY' 0. ;
UNY = MANU 'CHPO' BLOC 2 'UX' 0. 'UY' 1. ;
POID = (MASS MOB MAB) * UNY * -9.81 ;
DEP0 = RESO RIJ POID ;
PTOP = MAI . 'SOMMET' ;
X1 = EXTR DEP0 'UY' PTOP ;
"""
MOTION = """
LTP = PROG 0. 'PAS' 0.01 0.3 ;
EVP = EVOL 'MANU' LTP (-2.5 * (SIN (720. * LTP))) ;
TAB1 = TABL ;
TAB1 . 'DEPL' = DEP0 ;
TAB1 . 'CHAR' = (CHAR 'MECA' POID (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)))
  ET (CHAR 'MECA' (MM * UNX * -1.) EVP) ;
TAB1 . 'RIGI' = RIG ; TAB1 . 'MASS' = MM ;
TAB1 . 'MODELE' = MOJ ; TAB1 . 'CARACTERISTIQUES' = MAJ ;
TAB1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.02 0.3 ;
TAB1 . 'NEWTON_COMPLET' = FULL0 ;
TAB2 = DYNAMIC TAB1 ;
EV1 = EVOL 'TEMP' TAB2 'DEPL' 'UX' PTOP ;
L1 = EXTR EV1 'ORDO' ;
EV2 = (EVOL 'TEMP' TAB2 'DEPL' 'UY' (MAI . 'BORD_GAUCHE')) ;
L2 = EXTR EV2 'ORDO' ;
"""
there = pytest.mark.usefixtures("petsc_is_there")


@pytest.fixture(autouse=True)
def _mpi(monkeypatch):
    monkeypatch.delenv("SSILANG_PETSC", raising=False)
    for name, value in environment().items():
        monkeypatch.setenv(name, value)


def run(text, folder, command=COMMAND, **options):
    """The run of a script, its messages, its summary."""
    out, err = _Text(), _Text()
    made = RunOptions(folder, petsc=command, summary=True, quiet=True, **options)
    result = run_source(Source("script", text), made, out, err)
    return result, json.loads((folder / "summary.json").read_text())


class _Text(list):
    write = list.append

    def flush(self):
        pass

    def isatty(self):
        return False


def values(result, *names):
    assert result.exit_code == 0, result.message
    found = [result.session.root.find(name) for name in names]
    return [np.asarray(getattr(v, "values", v), dtype=float) for v in found]


@there
def test_modes_and_multipliers_by_petsc_and_the_summary_names_versions_and_machines(tmp_path):
    script = f"""{MODEL}
U2 = RESO RIJ POID 'ELIM' 0 ; X2 = EXTR U2 'UY' PTOP ;
T1 = VIBR 'PROC' (PROG 0. 8.) (LECT 2 2) RIJ MM ;
F1 = T1 . 'MODES' . 1 . 'FREQUENCE' ; F4 = T1 . 'MODES' . 4 . 'FREQUENCE' ;
"""
    own, _ = run(HEAD + script, tmp_path / "own", "")
    petsc, summary = run(HEAD + ASKED + script, tmp_path / "petsc")
    names = ("X1", "X2", "F1", "F4")
    np.testing.assert_allclose(values(petsc, *names), values(own, *names), rtol=1e-9)
    told = summary["statistics"]["petsc"]
    assert told["command"] == COMMAND
    assert told["petsc"].count(".") == 2
    assert told["ranks"] == sum(host["ranks"] for host in told["hosts"]) == 2
    assert all(host["peak_memory_mb"] > 10.0 and host["host"] for host in told["hosts"])
    assert not ranks()  # they ended with the run


@there
def test_a_free_body_is_named_as_by_other_solvers(tmp_path):
    script = MODEL.replace("ET BLO ;", ";").replace("DEP0 =", "DEP1 =").split("PTOP")[0]
    own, _ = run(HEAD + script, tmp_path / "own", "")
    petsc, _ = run(HEAD + ASKED + script, tmp_path / "petsc")
    assert own.exit_code == petsc.exit_code == 1
    assert own.errors[0].code == petsc.errors[0].code == "kernel.statics.loads-drive-motions"
    (first, _), (second, _) = (r.message.split("\n", 1) for r in (own, petsc))
    assert first == second


def lose_a_rank(patch, solve):
    """The last rank is killed at a solve, by its number."""
    from ssilang.kernel.solvers.petsc import client

    ask, asked = client._Line.ask, []

    def lose(line, message, *arguments, **more):
        asked.append(message["do"])
        if message["do"] == "solve" and asked.count("solve") == solve:
            os.kill(ranks()[-1], signal.SIGKILL)
        return ask(line, message, *arguments, **more)

    patch.setattr(client._Line, "ask", lose)


@there
@pytest.mark.parametrize("full", ["FAUX", "VRAI"])
def test_a_block_lifts_off_alike_on_petsc_though_a_rank_is_lost_on_the_way(
    tmp_path, monkeypatch, full
):
    """The run ends with a message and a checkpoint, and goes on from there."""
    from ssilang.operators.dynamics import checkpoints

    script = MODEL + MOTION.replace("FULL0", full)
    script = script.replace("TAB2 =", "TAB1 . 'REPRISE' = TABL ; TAB1 . 'PAS_SAUVES' = 1 ; TAB2 =")
    own, _ = run(HEAD + script, tmp_path / "own", "")
    script = HEAD + ASKED + script
    # as of a large model
    monkeypatch.setattr(checkpoints, "stride_of", lambda done, *_: 8 - done % 8)
    with monkeypatch.context() as patched:
        lose_a_rank(patched, 32)
        ended, summary = run(script, tmp_path / "ended")
    assert ended.exit_code == 1
    codes = [w["code"] for w in summary["warnings"]]
    assert "operators.dynamics.checkpoint-left" in codes  # none was due: ten minutes between them
    assert [e["code"] for e in summary["errors"]] == ["kernel.solvers.petsc-ended"]
    assert "a process or a machine was lost" in ended.message
    assert "defect" not in ended.message
    assert summary["statistics"]["petsc"]["ranks"] == 2
    resumed, summary = run(script, tmp_path / "ended", resume=True)
    assert resumed.exit_code == 0, resumed.message
    assert "operators.dynamics.resumed" in [w["code"] for w in summary["warnings"]]
    assert {s["solver"] for s in summary["statistics"]["systems"]} == {"PETSc MUMPS"}
    (motion,) = summary["statistics"]["calculations"]
    assert motion["solver"] == ("PETSC" if full == "VRAI" else "PETSc MUMPS")
    for here, there_ in zip(
        values(own, "X1", "L1", "L2"), values(resumed, "X1", "L1", "L2"), strict=True
    ):
        np.testing.assert_allclose(there_, here, atol=1e-9 * np.abs(here).max())
    assert values(own, "L2")[0].max() > 1e-4  # it does lift off


@there
def test_a_run_that_goes_on_after_a_lost_rank_starts_petsc_again(tmp_path, monkeypatch):
    lose_a_rank(monkeypatch, 5)
    script = HEAD + "OPTI ERRE IGNORE ;" + ASKED + MODEL + "DEP0 = RESO RIJ POID ;"
    script += "X2 = EXTR DEP0 'UY' PTOP ;"
    petsc, _ = run(script, tmp_path / "petsc")
    own, _ = run(HEAD + MODEL, tmp_path / "own", "")
    assert petsc.session.root.find("X2") == pytest.approx(own.session.root.find("X1"), rel=1e-9)


def test_a_deck_that_asks_for_petsc_without_a_command_is_refused(tmp_path):
    result, _ = run(HEAD + ASKED, tmp_path, "")
    assert result.exit_code == 1
    assert "solver PETSC runs behind a command" in result.message
    assert "SSILANG_PETSC" in result.message


def test_a_command_that_is_not_there_is_told_at_the_statement_that_needs_it(tmp_path):
    result, _ = run(HEAD + ASKED + MODEL, tmp_path, "no-such-launcher -n 2 python3")
    assert result.exit_code == 1
    assert "no-such-launcher, which is not there" in result.message
    assert "DEP0 = RESO RIJ POID" in result.message


def test_the_environment_gives_the_command(monkeypatch):
    monkeypatch.setenv("SSILANG_PETSC", "mpirun -n 7 python3")
    assert RunOptions().petsc == "mpirun -n 7 python3"
    assert RunOptions(petsc="").petsc == ""


def test_a_small_run_with_a_command_starts_nothing(tmp_path):
    result, summary = run(HEAD + MODEL, tmp_path, "no-such-launcher")
    assert result.exit_code == 0, result.message
    assert "petsc" not in summary["statistics"]


def test_the_option_is_read_back_and_its_words_are_checked(tmp_path):
    result, _ = run("X = VALE 'SOLV' ; OPTI SOLVEUR AUTO ; Y = VALE 'SOLV' ;", tmp_path, "")
    assert [str(result.session.root.find(n)) for n in "XY"] == ["AUTO", "AUTO"]
    result, _ = run("OPTI 'SOLVEUR' 'PETC' ;", tmp_path, "")
    assert "PETSC" in result.message


def test_the_command_line_takes_the_command(tmp_path, monkeypatch):
    from ssilang.cli.main import main

    monkeypatch.chdir(tmp_path)
    script = tmp_path / "case.ssi"
    script.write_text(HEAD + ASKED + "FIN ;")
    out = ["--out", str(tmp_path / "out"), "-q"]
    assert main(["run", str(script), *out]) == 1
    assert main(["run", str(script), *out, "--petsc", "mpirun -n 2 python3"]) == 0
    assert not Path("results").exists()
