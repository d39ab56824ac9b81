"""Runs of a sweep that go side by side: as alone, whatever one of them does."""

import io
import json
import os
import time

import pyarrow.parquet as pq
import pytest

from ssilang.cli.sweeping.gathering import gathered, run_together
from ssilang.cli.sweeping.pool import run_here
from ssilang.cli.sweeping.sweep import SweepOptions, sweep
from ssilang.cli.sweeping.worker import Task, run_task
from ssilang.kernel.stepping import choose, effective
from ssilang.kernel.stepping.problem import problem

MODEL = """OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; AG = 1. ; CASE = 0 ;
SI (CASE EGA 2) ; ERRE 'wrong from the start' ; FINSI ;
P1 = 0. 0. ; P2 = 4. 0. ; FOO = DROI 8 P1 P2 ; GRO = FOO PLUS (0. -1.) ;
JOI = MANU 'SEG2' (POIN 1 GRO) (POIN 1 FOO) ;
REPE BJ 8 ; I = &BJ + 1 ; JOI = JOI ET (MANU 'SEG2' (POIN I GRO) (POIN I FOO)) ; FIN BJ ;
MOF = MODE FOO 'MECANIQUE' 'ELASTIQUE' 'POUT' ;
MAF = MATE MOF 'YOUN' 3.E10 'NU' 0.2 'RHO' 0. 'SECT' 1. 'INRY' 0.1 'INRZ' 0.1 ;
MOJ = MODE JOI 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MAJ = MATE MOJ 'KN' 4.E6 'KS' 0. ;
MAS = MASS 'DEPL' 2.E3 FOO ;
UP = MANU 'CHPO' (POIN 1 FOO) 1 'FY' 1.E5 ;
DOWN = MAS * (MANU 'CHPO' FOO 1 'UY' -9.81) ;
TI = PROG 0. 'PAS' 2.E-3 'NPAS' 100 ; EV = EVOL 'MANU' TI (AG * (SIN (2000. * TI))) ;
CHA = (CHAR 'MECA' DOWN) ET (CHAR 'MECA' UP EV) ;
BAS = BLOQ 'UX' 'UY' GRO ; RIG = (RIGI MOF MAF) ET BAS ET (BLOQ 'UX' P1) ;
"""
DYNAMIC = """T1 = TABL ; T1 . 'RIGI' = RIG ; T1 . 'MASS' = MAS ; T1 . 'MODELE' = MOJ ;
T1 . 'CARACTERISTIQUES' = MAJ ; T1 . 'CHAR' = CHA ; T1 . 'TEMPS_CALCULES' = TI ;
T1 . 'PAS_SAUVES' = 1 ;
T1 . 'RELATIONS_SAUVEES' = TABL ; T1 . 'RELATIONS_SAUVEES' . 'BASE' = BAS ;
SI (CASE EGA 5) ; T1 . 'PAS_SAUVES' = 0 ; FINSI ;
T2 = DYNAMIC T1 ; LU = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P1) 'ORDO' ;
SI (CASE EGA 3) ; ERRE 'wrong at the end' ; FINSI ;
SI (CASE EGA 4) ; T2 = DYNAMIC T1 ; LU = 2. * LU ; FINSI ;
@VERIFIE T1 'highest' (MAXI LU) -10. 100. ; @VERIFIE T1 'lowest' (MINI LU) -10. 100. ;
TA = T2 . 7 ; @VERIFIE T1 'one' (MAXI (TA . 'DEPL')) -10. 100. ;
@VERIFIE T1 'instants' (DIME T2) 0. 1000. ;
@VERIFIE T1 'work' (EXTR (T1 . 'ENERGIES' . 'EXTERIEURE') 100) 0. 1.E9 ;
FB = T1 . 'RESULTATS_RELATIONS' . 'BASE' ;
@VERIFIE T1 'pressed' (MAXI (FB . 'FY')) 1. 1.E9 ; @VERIFIE T1 'lifted' (MINI (FB . 'FY')) -1. 1. ;
"""
PASAPAS = """T1 = TABL ; T1 . 'DYNAMIQUE' = VRAI ; T1 . 'MODELE' = MOF ET MOJ ;
T1 . 'CARACTERISTIQUES' = MAF ET MAJ ; T1 . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' 'UY' GRO)
ET (BLOQ 'UX' P1) ; T1 . 'MASSE_CONSTANTE' = MAS ; T1 . 'CHARGEMENT' = CHA ;
T1 . 'TEMPS_CALCULES' = TI ; PASAPAS T1 ;
LU = EXTR (EVOL 'TEMP' T1 'DEPLACEMENTS' 'UY' P1) 'ORDO' ;
@VERIFIE T1 'highest' (MAXI LU) -10. 100. ; @VERIFIE T1 'lowest' (MINI LU) -10. 100. ;
"""
FOOTING = """OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; AG = 1. ; PS = 0. 0. ; PC = 0. 1. ; T1 = TABL ;
L1 = DROI 16 (-8. 0.) (8. 0.) ; S = L1 TRAN 12 (0. -6.) ; MID = L1 POIN 'DROI' PS (0. 1.) 2.1 ;
MS = MODE S 'MECANIQUE' 'ELASTIQUE' ; A = MATE MS 'YOUN' 3.E7 'NU' 0.3 'RHO' 1800. ;
OPTI ELEM SEG2 ; M = MODE (MANU 'SEG2' PS PC) 'MECANIQUE' 'ELASTIQUE' 'MACRO_SEMELLE' 'JOI1' ;
T1 . 'MODELE' = M ; T1 . 'CARACTERISTIQUES' = MATE M 'KN' 4.E8 'KS' 2.E8 'LARG' 4. 'COHE' 5.E4 ;
T1 . 'RIGI' = (RIGI MS A) ET (BLOQ 'DEPL' (COTE 3 S)) ET (RELA 'CORI' 'DEPL' 'ROTA' PS MID) ;
T1 . 'MASS' = (MASS MS A) ET (MASS 'DEPL' 4.E4 PC) ET (MASS 'ROTA' 2.E5 PC) ;
TI = PROG 0. 'PAS' 5.E-3 'NPAS' 80 ; EV = EVOL 'MANU' TI (AG * (SIN (1500. * TI))) ;
T1 . 'CHAR' = (CHAR 'MECA' (FORC (0. -4.E5) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.))) ET
 (CHAR 'MECA' ((FORC (5.E4 0.) PC) ET (MOME 'MZ' 4.E5 PC)) EV) ;
T1 . 'TEMPS_CALCULES' = TI ; T1 . 'PAS_SAUVES' = 1 ; T2 = DYNAMIC T1 ;
V1 = T2 . 81 . 'VARIABLES_INTERNES' ; LU = EXTR (EVOL 'TEMP' T2 'DEPL' 'RZ' PC) 'ORDO' ;
@VERIFIE T1 'highest' (MAXI LU) -10. 100. ; @VERIFIE T1 'lowest' (MINI LU) -10. 100. ;
@VERIFIE T1 'settled' (EXTR V1 'TASS' 1 1 1) 1. 1. ;
@VERIFIE T1 'lost' (EXTR V1 'EPER' 1 1 1) 1.E6 1.E6 ;
"""
FIGURES = ("highest", "lowest", "one", "instants", "work", "pressed", "lifted", "settled", "lost")


@pytest.fixture(autouse=True)
def _in_the_loop_of_large_models(monkeypatch):
    """Which alone takes several motions; models that are small in tests would have another."""
    monkeypatch.setattr(choose, "RULES", choose.only("dissection"))
    monkeypatch.setattr(effective, "SMALL", 0)
    monkeypatch.setattr(problem, "SMALL", 0)


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "case.ssi"
    path.write_text(MODEL + DYNAMIC)
    return path


def tasks_of(deck, folder, values):
    return [
        Task(i, deck, folder / f"r{i}", given) for i, given in enumerate(values, start=1)
    ]  # fmt: skip


def together_of(row, folder):
    summary = json.loads((folder / row["folder"] / "summary.json").read_text())
    return [c["together"] for c in summary["statistics"]["calculations"]]


def assert_same_figures(rows, alone):
    for a, b in zip(rows, alone, strict=True):
        assert a["exit_code"] == b["exit_code"] == 0, a["error"]
        for name in FIGURES:
            if name in b:
                assert a[name] == pytest.approx(b[name], rel=1e-11), name


@pytest.mark.parametrize("procedure", [DYNAMIC, PASAPAS])
def test_runs_that_meet_find_what_they_find_alone(tmp_path, procedure):
    deck = tmp_path / "case.ssi"
    deck.write_text(MODEL + procedure)
    values = [{"AG": 0.4 + 0.3 * i} for i in range(5)]
    rows = run_together(tasks_of(deck, tmp_path / "a", values))
    assert_same_figures(rows, [run_task(t) for t in tasks_of(deck, tmp_path / "b", values)])
    assert len({row["highest"] for row in rows}) == 5
    for row in rows:
        assert together_of(row, tmp_path / "a") == [5]


def test_footings_that_yield_go_side_by_side(tmp_path):
    deck = tmp_path / "case.ssi"
    deck.write_text(FOOTING)
    values = [{"AG": 1.0 + i} for i in range(3)]
    rows = run_together(tasks_of(deck, tmp_path / "a", values))
    assert_same_figures(rows, [run_task(t) for t in tasks_of(deck, tmp_path / "b", values)])
    assert 0.0 < rows[0]["settled"] < rows[1]["settled"] < rows[2]["settled"]
    assert [together_of(row, tmp_path / "a") for row in rows] == [[3]] * 3


def test_runs_that_fail_before_or_behind_the_integration_leave_the_others(deck, tmp_path):
    """Wrong before, behind, in a second integration of its own, in what it asks for."""
    values = [{"AG": 0.4 + 0.1 * i, "CASE": i} for i in range(7)]
    rows = run_together(tasks_of(deck, tmp_path / "a", values))
    assert [row["exit_code"] for row in rows] == [0, 0, 1, 1, 0, 1, 0]
    assert "wrong from the start" in rows[2]["error"]
    assert "wrong at the end" in rows[3]["error"]
    good = [0, 1, 4, 6]
    alone = [run_task(t) for t in tasks_of(deck, tmp_path / "b", [values[i] for i in good])]
    assert_same_figures([rows[i] for i in good], alone)
    assert together_of(rows[0], tmp_path / "a") == [5]
    assert together_of(rows[4], tmp_path / "a") == [5, 1]


def test_other_models_do_not_mix(deck, tmp_path):
    text = (
        deck.read_text()
        .replace("'KN' 4.E6", "'KN' KN")
        .replace("CASE = 0 ;", "CASE = 0 ; KN = 1. ;")
    )
    deck.write_text(text)
    values = [{"KN": kn, "AG": ag} for kn in (4e6, 5e6) for ag in (0.5, 0.8)]
    rows = run_together(tasks_of(deck, tmp_path / "a", values))
    assert_same_figures(rows, [run_task(t) for t in tasks_of(deck, tmp_path / "b", values)])
    assert [together_of(row, tmp_path / "a") for row in rows] == [[2]] * 4


def dies_in_company(task):
    """Kills its process for the third run, wherever it is."""
    if task.number == 3:
        os._exit(3)
    return {"run": task.number, "exit_code": 0, "alone": task.meeting is None, "folder": ""}


def test_a_run_that_kills_its_process_costs_itself_alone(tmp_path):
    tasks = [Task(i, tmp_path / "x.ssi", tmp_path / str(i), {}) for i in range(1, 9)]
    rows = sorted(run_here(tasks, 2, dies_in_company, together=4), key=lambda r: r["run"])
    assert [r["run"] for r in rows] == list(range(1, 9))
    assert [r["run"] for r in rows if r["exit_code"]] == [3]


def raises(task):
    """Fails outside the script."""
    if task.number == 2:
        raise OSError("disk full")
    return {"run": task.number, "exit_code": 0, "folder": ""}


def test_a_run_that_raises_is_a_row(tmp_path):
    rows = run_together(tasks_of(tmp_path / "x.ssi", tmp_path, [{}] * 3), raises)
    assert [r["exit_code"] for r in rows] == [0, 1, 0]
    assert "disk full" in rows[1]["error"]


def test_batches_keep_all_jobs_busy():
    tasks = list(range(10))
    assert gathered(tasks, 2, 8) == [(0, 1, 2, 3, 4), (5, 6, 7, 8, 9)]
    assert [len(b) for b in gathered(tasks, 1, 4)] == [3, 3, 4]
    assert [len(b) for b in gathered(list(range(199)), 4, 8)].count(7) == 25
    assert len(gathered(list(range(199)), 4, 8)) == 28
    assert [len(b) for b in gathered(tasks, 4, 1)] == [1] * 10
    assert gathered([], 4, 8) == []


def run(options):
    out, err = io.StringIO(), io.StringIO()
    return sweep(options, out, err), out.getvalue(), err.getvalue()


def test_a_sweep_goes_on_where_a_batch_was_killed(deck, tmp_path):
    out = tmp_path / "out"
    first = SweepOptions(deck, ["AG=0.3:0.8:0.1"], out=out, jobs=1)
    assert run(first)[0] == 0
    table = pq.read_table(out / "sweep.parquet").to_pylist()
    for path in sorted(out.glob("runs/*/row.json"))[:4]:  # as a kill in the middle leaves it
        path.unlink()
    code, said, wrong = run(first)
    assert code == 0, wrong
    assert "2 of 6 runs are done already" in said
    again = pq.read_table(out / "sweep.parquet").to_pylist()
    assert [r["highest"] for r in again] == pytest.approx([r["highest"] for r in table], rel=1e-11)


def test_a_dask_cluster_takes_batches(deck, tmp_path):
    distributed = pytest.importorskip("distributed")
    settings = ["AG=0.5:0.7:0.1", "CASE=0,2"]
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:
        address = cluster.scheduler_address
        code, _, wrong = run(SweepOptions(deck, settings, out=tmp_path / "c", scheduler=address))
    assert code == 1
    assert wrong.count("wrong from the start") == 3
    rows = pq.read_table(tmp_path / "c" / "sweep.parquet").to_pylist()
    assert [r["exit_code"] for r in rows] == [0, 1] * 3
    assert [together_of(r, tmp_path / "c" / "runs") for r in rows if not r["exit_code"]] == [
        [3]
    ] * 3


def test_together_1_runs_each_alone(deck, tmp_path):
    options = SweepOptions(deck, ["AG=0.5,0.6"], out=tmp_path / "o", jobs=1, together=1)
    assert run(options)[0] == 0
    for row in pq.read_table(tmp_path / "o" / "sweep.parquet").to_pylist():
        assert together_of(row, tmp_path / "o" / "runs") == [1]


def test_seconds_of_a_run_are_its_own(monkeypatch, tmp_path):
    """By a clock that stands still unless a run works: its own work, and its share of the rest."""
    now = [100.0]

    def integrated(problems, observers, progress):
        now[0] += 6.0
        return [f"history of {p}" for p in problems]

    def work(task):
        began = now[0]
        now[0] += 10.0 * task.number  # before it meets the others
        history = task.meeting.integrate(task.number, [], None)
        now[0] += task.number
        return {"history": history, "seconds": now[0] - began - task.meeting.away()}

    monkeypatch.setattr("ssilang.cli.sweeping.gathering.perf_counter", lambda: now[0])
    monkeypatch.setattr("ssilang.kernel.stepping.run_many.integrate_together", integrated)
    rows = run_together(tasks_of(tmp_path / "x.ssi", tmp_path, [{}, {}, {}]), work)
    assert [r["history"] for r in rows] == ["history of 1", "history of 2", "history of 3"]
    assert [r["seconds"] for r in rows] == [11.0 + 2.0, 22.0 + 2.0, 33.0 + 2.0]


def test_seconds_of_runs_that_meet_add_up(deck, tmp_path):
    """Rows and summaries leave out what a run waited for the others."""
    began = time.perf_counter()
    rows = run_together(tasks_of(deck, tmp_path, [{"AG": 0.1 * i} for i in range(1, 5)]))
    lasted = time.perf_counter() - began
    assert sum(r["seconds"] for r in rows) < 1.05 * lasted + 0.1
    for row in rows:
        summary = json.loads((tmp_path / row["folder"] / "summary.json").read_text())
        assert summary["seconds"] == pytest.approx(row["seconds"], abs=0.25 * lasted)
