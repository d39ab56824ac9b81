"""Help and refusals of the command line, in both languages."""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import ssilang
from ssilang.cli import main as main_module
from ssilang.cli.main import main
from ssilang.cli.usage import COMMANDS, parser
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError, unprinted
from ssilang.messages.message import find


def said(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[str, str]:
    with pytest.raises(SystemExit):
        main(words)
    told = capsys.readouterr()
    return told.out, told.err


@pytest.mark.parametrize("command", [(), *((c,) for c in COMMANDS)])
def test_help_is_in_the_language_asked_for(capsys, command):
    english, _ = said(capsys, *command, "--help")
    french, _ = said(capsys, *command, "--help", "--lang", "fr")
    assert english.startswith("usage: ssilang")
    assert french.startswith("utilisation : ssilang")
    assert "show this help" in english
    assert "affiche cette aide" in french
    assert "cli." not in english + french


def test_the_language_may_stand_first(capsys):
    assert said(capsys, "--lang", "fr", "--help") == said(capsys, "--help", "--lang=fr")
    assert said(capsys, "--lang=fr", "check", "-h") == said(capsys, "check", "-h", "--lang", "fr")


def _actions(of: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in of._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            yield from action._choices_actions
            for inner in action.choices.values():
                yield from _actions(inner)


def test_each_option_has_a_help_in_the_catalogue():
    helps = [a.help for a in _actions(parser([])) if not isinstance(a, argparse._SubParsersAction)]
    assert len(helps) > 40
    assert all(find(str(code)).fr for code in helps)


@pytest.mark.parametrize(
    ("words", "english", "french"),
    [
        (("check",), "the following arguments are required: files", "il manque les arguments"),
        (("check", "a", "--none"), "unrecognized arguments: --none", "arguments inconnus : --none"),
        (("run", "a", "--max-memory", "much"), "invalid int value: 'much'", "n'est pas un entier"),
        (("run", "a", "--max-memory", "20"), "20 is below the least value, 128", "inférieur à la"),
        (
            ("run", "a", "--max-recursion", "0"),
            "0 is below the least value, 1",
            "moindre valeur, 1",
        ),
        (("sweep", "a", "--jobs", "-1"), "-1 is below the least value, 0", "moindre valeur, 0"),
        (("run", "a", "--out"), "--out: expected one argument", "--out : il y faut une valeur"),
        (("run", "--max", "1"), "--max could match", "option ambiguë : --max peut être"),
        (("run", "--debug=1", "a"), "ignored explicit argument '1'", "la valeur '1' n'a pas"),
        (("run",), "run needs a file", "run demande un fichier"),
    ],
)
def test_wrong_usage_is_told_in_the_language_asked_for(capsys, words, english, french):
    _, told = said(capsys, *words)
    assert told.startswith("usage: ssilang")
    assert english in told
    command, *rest = words
    _, told = said(capsys, command, "--lang", "fr", *rest)
    assert told.startswith("utilisation : ssilang")
    assert french in told
    assert "erreur : " in told


def test_a_language_that_there_is_not_is_refused_in_english(capsys):
    _, told = said(capsys, "check", "--lang", "de", "a.ssi")
    assert "invalid choice: 'de'" in told
    assert "en" in told
    assert "fr" in told


def test_a_run_loads_no_words_of_usage(tmp_path):
    (tmp_path / "a.ssi").write_text("X = 1 ;\n")
    program = (
        "import sys; from ssilang.cli.main import main\n"
        "assert main(['a.ssi', '-q']) == 0\n"
        "assert 'tomllib' not in sys.modules"
    )
    root = str(Path(ssilang.__file__).parents[1])
    environment = {**os.environ, "PYTHONPATH": root}
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, env=environment)
    assert done.returncode == 0


@pytest.mark.parametrize(("language", "word"), [("en", "error"), ("fr", "erreur")])
@pytest.mark.parametrize("problem", [OSError(28, "No space left"), SsiError("cli.lsp-extra", None)])
def test_what_ends_the_program_is_told_once(capsys, monkeypatch, language, word, problem):
    silenced = []
    monkeypatch.setattr(main_module, "_silence", lambda: silenced.append(True))
    main_module._told(problem, language)
    told = capsys.readouterr()
    assert told.out == ""
    assert word in told.err.lower()
    said = problem if isinstance(problem, SsiError) else unprinted(problem)
    assert told.err == render(said, language) + "\n"
    assert silenced == [True]
