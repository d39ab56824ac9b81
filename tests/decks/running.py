"""Runs decks of `cases/`, as they are or changed."""

import shutil
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.cli.run import RunOptions, RunResult, run_file

CASES = Path(__file__).parents[2] / "cases"
DECKS = sorted(CASES.rglob("*.ssi"))


def run_deck(path: Path, out: Path) -> RunResult:
    """Run a deck, its files going to `out`."""
    return run_file(path, RunOptions(output_directory=out))


def run_changed(path: Path, out: Path, *changes: tuple[str, str]) -> RunResult:
    """Run a copy of a deck in which each `(old, new)`, `old` found exactly once, is replaced."""
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {path.name}"
        text = text.replace(old, new)
    if (path.parent / "motions").is_dir():  # records that decks of the folder read
        shutil.copytree(path.parent / "motions", out / "motions", dirs_exist_ok=True)
    copy = out / path.name
    copy.write_text(text, encoding="utf-8")
    return run_deck(copy, out / "results")


def variable(result: RunResult, name: str) -> Any:
    """An object of the deck."""
    found = result.session.root.find(name)
    assert found is not None, f"the deck has no {name}"
    return found


def numbers(result: RunResult, name: str) -> np.ndarray:
    """A list of reals of the deck."""
    return np.asarray(variable(result, name).values, dtype=float)
