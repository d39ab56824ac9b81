"""The pages on adding things: their diffs apply to the program, and their scripts then say so."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]
_DOCS = _ROOT / "docs"
PAGES = sorted(_DOCS.glob("adding_*.md"))
_FIRST = "adding_an_operator.md"  # another page goes on from it


def block(page: Path, kind: str) -> str:
    """The one block of a page in a language."""
    (found,) = re.findall(rf"```{kind}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    return str(found)


@pytest.fixture(scope="module")
def changed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the program with the diffs of all pages."""
    if shutil.which("git") is None:
        pytest.skip("git is not installed")
    copy = tmp_path_factory.mktemp("changed")
    for part in ("ssilang", "stdlib", "grammar"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(_ROOT / part, copy / part, ignore=ignored)
    for page in sorted(PAGES, key=lambda p: p.name != _FIRST):
        applied = subprocess.run(
            ["git", "apply", "-"], input=block(page, "diff").encode(), cwd=copy,
            capture_output=True, check=False,
        )  # fmt: skip
        assert applied.returncode == 0, f"{page.name}: {applied.stderr.decode()}"
    return copy


def test_there_is_a_page_for_each_thing_that_is_added():
    assert len(PAGES) == 5
    assert all(page.name in (_DOCS / "README.md").read_text(encoding="utf-8") for page in PAGES)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_script_of_a_page_says_what_the_page_says(page: Path, changed: Path, tmp_path: Path):
    (tmp_path / "case.ssi").write_text(block(page, "ssi"), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-P", "-m", "ssilang.cli.main", "case.ssi"],
        cwd=tmp_path, capture_output=True, text=True, check=False, encoding="utf-8",
        # compiling the laws anew for one point takes a minute
        env={**os.environ, "PYTHONPATH": str(changed), "NUMBA_DISABLE_JIT": "1"},
    )  # fmt: skip
    written = sorted((tmp_path / "results").rglob("*.txt"))
    said = written[0].read_text(encoding="utf-8") if written else done.stdout or done.stderr
    assert said.rstrip() == block(page, "text").rstrip()
    assert ("error" in said) == (done.returncode != 0)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_files_that_a_page_names_are_there(page: Path, changed: Path):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    named = set(re.findall(r"`((?:ssilang|stdlib|tests)/[\w./]*)`", text))
    assert named
    assert not [n for n in named if not (_ROOT / n).exists() and not (changed / n).exists()]
