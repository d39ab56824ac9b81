"""The model of the page for users of OpenSees: the same answer from both programs."""

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from ssilang.cli.run import RunOptions, run_file

_PAGE = (Path(__file__).resolve().parents[2] / "docs" / "opensees.md").read_text(encoding="utf-8")
_FOUND = (0.292983, 0.127958)
"""Drift and uplift that OpenSeesPy 3.7 finds with this record."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    t = np.arange(1000) * 0.01
    pulse = 0.35 * np.sin(2.2 * np.pi * t) * np.exp(-(((t - 4.0) / 2.0) ** 2))
    values = pulse + 0.1 * np.sin(6.2 * np.pi * t)
    lines = ["".join(f"{v:15.7E}" for v in row) for row in values.reshape(-1, 5)]
    head = ["made for a test", "sines", "ACCELERATION IN UNITS OF G", "NPTS= 1000, DT= .0100 SEC"]
    (tmp_path / "motion.AT2").write_text("\n".join([*head, *lines]) + "\n")
    return tmp_path


def printed(text: str) -> list[float]:
    return [float(v) for v in re.findall(r"\d\.\d+[Ee][-+]\d+", text)]


def test_the_deck_finds_what_opensees_finds(folder: Path) -> None:
    (script,) = re.findall(r"```ssi\n(.*?)```", _PAGE, re.DOTALL)
    (folder / "rock.ssi").write_text(script)
    result = run_file(folder / "rock.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    assert printed(result.output) == pytest.approx(_FOUND, rel=1e-5)
    assert all(f"{v:.5f}" in _PAGE for v in _FOUND)


@pytest.mark.skipif(find_spec("openseespy") is None, reason="the extra bench is not installed")
def test_the_other_program_finds_it_too(folder: Path) -> None:
    (script,) = re.findall(r"```python\n(.*?)```", _PAGE, re.DOTALL)
    run = subprocess.run(
        [sys.executable, "-c", script], cwd=folder, capture_output=True, text=True, check=True
    )
    assert printed(run.stdout) == pytest.approx(_FOUND, rel=1e-5)
