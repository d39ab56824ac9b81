"""Sentences of the kernel said in French."""

import ast
import io
from pathlib import Path

import pytest

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.say.diagnostics import render
from ssilang.language.say.translations import in_french, templates
from ssilang.language.text.source import Source

_ROOT = Path(__file__).resolve().parents[3] / "ssilang"
_PLATE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; L1 = DROI 2 P1 (1. 0.) ; "
    "S1 = L1 TRAN 2 (0. 1.) ; MO1 = MODE S1 MECANIQUE ELASTIQUE ; "
)


def _literals():
    """All texts of the program, with {} for what is filled in."""
    for path in _ROOT.rglob("*.py"):
        if path.is_relative_to(_ROOT / "messages"):
            continue  # what stands there has its French beside it
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.JoinedStr):
                yield "".join(
                    str(v.value) if isinstance(v, ast.Constant) else "{}" for v in node.values
                )
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value


def _windows(english, size=4):
    """Runs of four words of the longest fixed part of a template."""
    words = max(english.split("{}"), key=len).strip(" :'").split()
    return [" ".join(words[i : i + size]) for i in range(max(len(words) - size + 1, 1))]


def test_every_template_is_a_sentence_that_the_program_says():
    said = "\n".join(_literals())
    lost = [e for e, _ in templates() if not any(w in said for w in _windows(e))]
    assert not lost


@pytest.mark.parametrize(("english", "french"), templates())
def test_both_languages_carry_the_same_figures(english, french):
    count = english.count("{}")
    figures = [f"<{i}>" for i in range(count)]
    assert french.count("{}") == count
    assert in_french(english.format(*figures)) == french.format(*figures)


def test_a_sentence_without_template_stays():
    assert in_french("something else went wrong") == "something else went wrong"


@pytest.mark.parametrize(
    ("script", "sentences"),
    [
        (
            _PLATE + "MA1 = MATE MO1 YOUN 1. NU 0.3 ; R = RIGI MO1 MA1 ; F = FORC FX 1. P1 ; "
            "U = RESO R F ;",
            ("la matrice est singulière : ", "translation suivant", "non tenu : "),
        ),
        (
            _PLATE + "MA1 = MATE MO1 YOUN 1. ; R = RIGI MO1 MA1 ;",
            ("le paramètre NU manque pour l'élément QUA4", "sont donnés : YOUN"),
        ),
        ("L = PROG 1000000000 * 1. ;", ("trop long", "cherchez un pas")),
    ],
)
def test_errors_of_a_run_are_told_in_french(script, sentences, tmp_path):
    options = RunOptions(tmp_path)
    result = run_source(Source("deck", script), options, io.StringIO(), io.StringIO())
    text = render(result.errors[0], "fr")
    assert all(s in text for s in sentences), text
    assert "singular" in render(result.errors[0]) or "singulière" not in text
