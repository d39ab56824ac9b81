"""The scripts of the page on many runs: records are read, and the deck runs under one."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from ssilang.cli.run import RunOptions, run_file

_PAGE = (Path(__file__).resolve().parents[2] / "docs" / "sweep.md").read_text(encoding="utf-8")
_READING, _ROCKING = re.findall(r"```ssi\n(.*?)```", _PAGE, re.DOTALL)
_STEP = 0.01


@pytest.fixture
def pulse() -> np.ndarray:
    """Acceleration in g at steps of 0.01 s: one sine of 0.5 g and 1 s, then rest."""
    t = _STEP * np.arange(400)
    return np.where(t < 1.0, 0.5 * np.sin(2 * np.pi * t), 0.0)


@pytest.fixture
def folder(tmp_path: Path, pulse: np.ndarray) -> Path:
    head = [
        "a test",
        "one sine",
        "ACCELERATION IN UNITS OF G",
        f"NPTS= {len(pulse)}, DT= {_STEP} SEC",
    ]
    rows = ["".join(f"{v:16.8E}" for v in row) for row in pulse.reshape(-1, 5)]
    (tmp_path / "motions").mkdir()
    for name in ("motion.AT2", "motions/m1.AT2"):
        (tmp_path / name).write_text("\n".join([*head, *rows]) + "\n")
    table = [f"{_STEP * i:.2f},{9.81 * v:.9g}" for i, v in enumerate(pulse)]
    (tmp_path / "motion.csv").write_text("\n".join(["time (s),acceleration (m/s2)", *table]) + "\n")
    return tmp_path


def test_both_files_give_the_same_record(folder: Path, pulse: np.ndarray) -> None:
    (folder / "read.ssi").write_text(_READING)
    result = run_file(folder / "read.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    for name in ("ACCE", "ACCE2"):
        assert find(name).parts[0].ordinates == pytest.approx(9.81 * pulse, abs=1e-7)
    assert find("PGA") == pytest.approx(9.81 * np.abs(pulse).max(), rel=1e-7)
    # above the pulse's frequencies an oscillator follows the ground
    spectrum = find("SPEC").parts[0].ordinates
    assert spectrum[-1] == pytest.approx(find("PGA"), rel=0.05)


def test_the_deck_rocks_and_lifts_its_edges(folder: Path) -> None:
    (folder / "rocking.ssi").write_text(_ROCKING)
    result = run_file(folder / "rocking.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    find = result.session.root.find
    settled = 9.81 * (3e4 + 3 * 2e3) / 2 / 5e7
    up = find("UY").values
    assert up[0] == pytest.approx(-settled, rel=0.2)
    assert up.max() > settled
