"""Sweeps: values, all runs in one table, failures, resumption, motions, clusters."""

import io
import os

import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ssilang.cli.sweeping.given import GivenError, cases_of, parse_setting, parse_values
from ssilang.cli.sweeping.pool import run_here
from ssilang.cli.sweeping.sweep import SweepOptions, sweep
from ssilang.cli.sweeping.worker import Task

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


def test_a_range_of_reals_has_both_ends_without_drift():
    assert parse_values("0.1:1.0:0.1") == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]


def test_values_have_the_types_of_the_language():
    assert parse_setting("a=1,2.5,1.D-3,VRAI,mot") == ("A", [1, 2.5, 1e-3, True, "mot"])


@pytest.mark.parametrize("text", ["AG", "=3", "AG=", "1X=2", "A=1:0:1", "A=0:1:0"])
def test_what_cannot_be_read_is_refused(text):
    with pytest.raises(GivenError):
        cases_of([text], None)


def test_all_combinations_come_in_order():
    cases = cases_of(["A=1,2", "B=x,y"], None)
    assert [tuple(c.values.values()) for c in cases] == [
        (1, "x"), (1, "y"), (2, "x"), (2, "y"),
    ]  # fmt: skip


def test_a_sweep_makes_one_table_and_reports_failures(deck, tmp_path):
    out = tmp_path / "out"
    options = SweepOptions(deck, ["AG=0.5,0.9", "N=1,2"], out=out, jobs=2)
    code, said, wrong = run(options)
    assert code == 1
    assert "4 runs, 2 failed" in said
    assert wrong.count("too strong") == 2
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
    with pytest.raises(SystemExit) as stopped:
        main([str(deck), "--set", "AG=1,2"])
    assert stopped.value.code == 2
