"""The command line as a person calls it."""

import io
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from ssilang.cli.main import main


@dataclass
class Outcome:
    """What a command printed, and its exit code."""

    code: int
    out: str
    err: str


@pytest.fixture
def process(tmp_path):
    """Run `ssilang` as a process of its own, in a fresh folder."""

    def action(*arguments: str, stdin: str | bytes = "", **environment: str) -> Outcome:
        data = stdin.encode() if isinstance(stdin, str) else stdin
        done = subprocess.run(
            [sys.executable, "-m", "ssilang.cli.main", *arguments],
            input=data,
            capture_output=True,
            cwd=tmp_path,
            env={**os.environ, **environment},
            timeout=120,
            check=False,
        )
        return Outcome(done.returncode, done.stdout.decode(), done.stderr.decode())

    return action


@pytest.fixture
def ssilang(tmp_path, capsys, monkeypatch):
    """Call the entry point in this process, in a fresh folder."""
    monkeypatch.chdir(tmp_path)

    def action(*arguments: str, stdin: str | bytes = "") -> Outcome:
        data = stdin.encode() if isinstance(stdin, str) else stdin
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
        capsys.readouterr()
        code = main(arguments)
        captured = capsys.readouterr()
        return Outcome(code, captured.out, captured.err)

    return action


@pytest.fixture
def script(tmp_path):
    """Write a script; its name."""

    def action(text: str, name: str = "deck.ssi") -> str:
        Path(tmp_path / name).write_text(text, encoding="utf-8")
        return name

    return action
