"""Every deck of `cases/` runs and passes; spoilt, it says so and the run fails.

That its checks can fail is a deck's own: what costs more than a glance is tried again when the deck
changes, or what spoils it. `spoilt.toml` has the digest of those that failed as they should.
"""

import hashlib
import json
import os
import re
import tomllib
from pathlib import Path

import pytest

from ssilang.language.run.session import Check
from ssilang.operators.drawing import pictures, scenes
from ssilang.operators.files import writing

from .comparisons import COMPARISONS
from .running import CASES, DECKS, run_changed, run_deck

CHANGES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
SPOILT = [(deck, *change) for deck, change in CHANGES["spoilt"].items()]
SMALLER, SHORTER = CHANGES["smaller"], CHANGES["shorter"]


def name_of(deck: Path) -> str:
    return str(deck.relative_to(CASES))


@pytest.fixture
def in_one_format(unplaced: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Curves are drawn as SVG alone, scenes as PNG: what is drawn is the same."""
    asked = pictures.picture_formats
    monkeypatch.setattr(pictures, "picture_formats", lambda *given: asked(*given)[-1:])


@pytest.mark.long
@pytest.mark.usefixtures("in_one_format")
@pytest.mark.parametrize("deck", DECKS, ids=name_of)
def test_deck_runs_within_its_tolerances_and_agrees_with_the_reference(deck, tmp_path):
    smaller = SMALLER.get(name_of(deck))
    result = run_changed(deck, tmp_path, *smaller) if smaller else run_deck(deck, tmp_path)
    assert result.exit_code == 0, result.message
    assert "checks within tolerance" in result.output
    compare = COMPARISONS.get(name_of(deck))
    if compare is not None:
        compare(result)


@pytest.fixture
def undrawn(unsaved: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures cost some decks half of their time; the deck as it is draws them."""
    monkeypatch.setattr(scenes, "_draw_files", lambda *_: None)


class _NoticedError(BaseException):
    """A check is out of tolerance: what comes behind it is not waited for."""


def noted(name: str, value: float, expected: float, tolerance: float) -> Check:
    """What @VERIFIE leaves for the summary: its tolerance is that of the difference."""
    if not abs(value - expected) <= tolerance:
        raise _NoticedError(name)
    return Check(name, value, expected, tolerance)


def spoiling(deck: str, old: str, new: str) -> list[tuple[str, str]]:
    """All changes of a deck's spoilt twin."""
    return [(old, new), *SMALLER.get(deck, []), *SHORTER.get(deck, [])]


def digest(deck: str, old: str, new: str) -> str:
    """What a deck and its changes are known by."""
    text = (CASES / deck).read_text(encoding="utf-8") + json.dumps(spoiling(deck, old, new))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


TRIED_FILE = Path(__file__).with_name("spoilt.toml")
TRIED = tomllib.loads(TRIED_FILE.read_text(encoding="utf-8"))
DUE = [twin for twin in SPOILT if TRIED.get(twin[0]) != digest(*twin)]


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize(("deck", "old", "new"), DUE, ids=lambda x: x if "/" in x else "")
def test_spoilt_deck_fails_on_its_own_checks(deck, old, new, tmp_path, monkeypatch):
    changes = spoiling(deck, old, new)
    if deck.startswith("basics/"):
        result = run_changed(CASES / deck, tmp_path, *changes)
        assert result.exit_code == 1
        assert "out of tolerance" in result.message
    else:
        monkeypatch.setattr(writing, "Check", noted)
        with pytest.raises(_NoticedError):
            run_changed(CASES / deck, tmp_path, *changes)
    if deck in TRIED and "SSILANG_UPDATE" in os.environ:
        TRIED[deck] = digest(deck, old, new)
        lines = (f'"{d}" = "{h}"\n' for d, h in TRIED.items())
        TRIED_FILE.write_text("".join(lines), encoding="utf-8")
    elif deck in TRIED:
        pytest.fail(f"it failed as it should: SSILANG_UPDATE=1 writes that to {TRIED_FILE.name}")


def test_every_deck_has_a_spoilt_twin():
    assert {d for d, _, _ in SPOILT} == {name_of(d) for d in DECKS}
    assert {d for d, _, _ in SPOILT} >= {*TRIED}


def test_the_table_of_decks_names_every_deck():
    table = (CASES / "README.md").read_text(encoding="utf-8")
    missing = [d.stem for d in DECKS if f"| `{d.stem}` |" not in table]
    assert not missing


def test_pictures_of_the_pages_exist_and_are_small():
    for page in CASES.rglob("README.md"):
        text = page.read_text(encoding="utf-8")
        for name in re.findall(r"\]\((pictures/[^)]+)\)", text):
            assert (page.parent / name).stat().st_size < 60_000, name
