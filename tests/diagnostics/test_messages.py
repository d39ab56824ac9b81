"""Whole messages of broken scripts, as their reader sees them.

Each script of `scripts/` has its message beside it, in English (`.en.txt`) and in French
(`.fr.txt`): its error, or the warnings of a script that runs to its end. `accepted/` has, under
the same name, the script as it should be: it runs without a word. After a deliberate change of
wording, write the messages anew with `SSILANG_UPDATE=1 python -m pytest tests/diagnostics` and
read every line of the difference.
"""

import io
import os
from pathlib import Path

from together import together

from ssilang.cli.run import RunOptions, RunResult, run_source
from ssilang.language.text.source import Source

_SCRIPTS = Path(__file__).with_name("scripts")
_ACCEPTED = Path(__file__).with_name("accepted")
_UPDATE = bool(os.environ.get("SSILANG_UPDATE"))
_CASES = [(p.stem, language) for language in ("en", "fr") for p in sorted(_SCRIPTS.glob("*.ssi"))]


def run(script: Path, language: str, folder: Path) -> tuple[RunResult, str]:
    """How a copy of the script ends, and the warnings that were shown on the way."""
    text = script.read_text(encoding="utf-8")
    path = folder / script.name
    path.write_text(text, encoding="utf-8")
    options = RunOptions(output_directory=folder / "out", language=language)
    shown = io.StringIO()
    result = run_source(Source(script.name, text, path), options, io.StringIO(), shown)
    return result, shown.getvalue().rstrip("\n")


def message_of(name: str, language: str, folder: Path) -> str:
    """What running the script writes: its error, without one its warnings."""
    inner = folder / "scripts"
    inner.mkdir()
    result, shown = run(_SCRIPTS / f"{name}.ssi", language, inner)
    assert shown
    message = result.message if result.exit_code == 1 else shown
    return message.replace(str(inner), "FOLDER").replace(str(folder), "ABOVE") + "\n"


@together("name, language", _CASES, by=lambda c: c[1])
def test_message(name, language, tmp_path):
    found = message_of(name, language, tmp_path)
    pinned = _SCRIPTS / f"{name}.{language}.txt"
    if _UPDATE:
        pinned.write_text(found, encoding="utf-8")
    assert found == pinned.read_text(encoding="utf-8")


@together("name", sorted(p.stem for p in _ACCEPTED.glob("*.ssi")))
def test_the_script_as_it_should_be_runs_without_a_word(name, tmp_path):
    assert (_SCRIPTS / f"{name}.ssi").is_file()
    result, shown = run(_ACCEPTED / f"{name}.ssi", "en", tmp_path)
    assert (result.exit_code, shown) == (0, "")


def test_there_are_at_least_sixty_broken_scripts():
    assert len(list(_SCRIPTS.glob("*.ssi"))) >= 60


@together("name", sorted(p.stem for p in _SCRIPTS.glob("*.ssi")))
def test_no_message_shows_the_inside_of_the_program(name):
    text = (_SCRIPTS / f"{name}.en.txt").read_text(encoding="utf-8")
    for sign in ("Traceback", "defect of ssilang", "numpy", "{", "None"):
        assert sign not in text
