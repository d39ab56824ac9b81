"""Runs with --report that were ended and gone on with."""

from pathlib import Path
from typing import Any

import pytest

from ssilang.cli.run import RunOptions, RunResult, run_text
from ssilang.operators.dynamics.checkpoints import KeptCalculation
from tests.operators.test_checkpoints import EVERY, ROCKING

DECK = ROCKING + EVERY + "T2 = DYNAMIC T ;"


def run(folder: Path, report: bool = True, resume: bool = False) -> RunResult:
    return run_text(DECK, options=RunOptions(folder, report=report, resume=resume))


@pytest.fixture
def ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a run that was interrupted behind its fortieth step."""
    reached = KeptCalculation.reached

    def end(self: KeptCalculation, done: int, state: Any) -> None:
        if done >= 40:
            raise KeyboardInterrupt
        reached(self, done, state)

    with monkeypatch.context() as patched:
        patched.setattr(KeptCalculation, "reached", end)
        assert run(tmp_path / "ended").exit_code == 1
    return tmp_path / "ended"


def test_the_report_is_that_of_an_undisturbed_run(ended: Path, tmp_path: Path) -> None:
    whole, table = tmp_path / "whole", "report/calculation_1.csv"
    assert run(whole).exit_code == 0
    assert len((ended / table).read_text().split("\n")) < 50  # what it had
    assert run(ended, resume=True).exit_code == 0
    for name in (table, "report/scene_1.vtkhdf"):
        assert (ended / name).read_bytes() == (whole / name).read_bytes(), name


def test_going_on_without_the_report_is_refused(ended: Path) -> None:
    result = run(ended, report=False, resume=True)
    assert result.exit_code == 1
    assert "was made with --report" in result.message
    assert "--resume --report" in result.message
