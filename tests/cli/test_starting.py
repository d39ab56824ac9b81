"""`ssilang new` and `ssilang completion`: what one meets before the first deck."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ssilang.cli.starters import starters, summary

ROOT = Path(__file__).parents[2]


def test_starters_are_listed_written_and_never_replaced(ssilang, tmp_path):
    listed = ssilang("new")
    assert listed.code == 0
    assert [line.split()[0] for line in listed.out.splitlines()] == sorted(starters())
    deck = tmp_path / "mine.ssi"
    made = ssilang("new", "oscillator", str(deck))
    assert (made.code, str(deck) in made.out) == (0, True)
    assert deck.read_bytes() == starters()["oscillator"].read_bytes()
    deck.write_text("mine")
    again = ssilang("new", "oscillator", str(deck))
    assert (again.code, deck.read_text()) == (1, "mine")
    assert "is there already" in again.err


def test_a_starter_that_does_not_exist_names_the_near_one(ssilang):
    outcome = ssilang("new", "towr")
    assert outcome.code == 2
    assert "did you mean tower?" in outcome.err
    assert "vouliez-vous dire tower" in ssilang("new", "towr", "--lang", "fr").err


@pytest.mark.parametrize("path", starters().values(), ids=lambda p: p.stem)
def test_starters_are_commented_and_pass_the_checker(path, ssilang):
    text = path.read_text(encoding="utf-8")
    assert len(summary(path)) > 20
    assert sum(line.startswith("*") for line in text.splitlines()) >= 8
    assert ssilang("check", str(path)).out == ""


# ---- shells -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def scripts(tmp_path_factory):
    """The completion of each shell, in a file; `ssilang` on the path."""
    folder = tmp_path_factory.mktemp("shells")
    command = folder / "ssilang"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m ssilang.cli.main "$@"\n')
    command.chmod(0o755)
    paths = f"{folder}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PATH": paths}
    for shell in ("bash", "zsh", "fish"):
        made = subprocess.run(
            [str(command), "completion", shell], env=environment, capture_output=True, check=True
        )
        (folder / shell).write_bytes(made.stdout)
    return folder, environment


def offered(scripts, *words: str) -> set[str]:
    """What bash offers for the last of some words."""
    folder, environment = scripts
    line = " ".join(f"'{w}'" for w in words)
    text = f"source {folder}/bash; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _ssilang"
    text += '; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(
        ["bash", "-c", text], env=environment, cwd=ROOT / "cases", capture_output=True, text=True
    )
    assert not done.stderr
    return set(done.stdout.split())


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_offers_commands_options_words_and_scripts(scripts):
    assert offered(scripts, "ssilang", "ch") == {"check"}
    assert offered(scripts, "ssilang", "format", "--d") == {"--diff"}
    assert "JOINT_SDM" in offered(scripts, "ssilang", "help", "joint_s")
    assert offered(scripts, "ssilang", "basics/cant") == {"basics/cantilever.ssi"}
    assert offered(scripts, "ssilang", "check", "READ") == set()


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_read_theirs(shell, scripts):
    folder, environment = scripts
    if shutil.which(shell) is None:
        pytest.skip(f"needs {shell}")
    done = subprocess.run([shell, "-n", str(folder / shell)], env=environment, capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
