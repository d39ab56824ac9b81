"""Errors of a run said in French, and whole messages: figures, place, cure, who called.

`test_whole_messages.toml` has the scripts; what a reader would point at is marked in them.
"""

import io
import tomllib
from pathlib import Path

from together import together

from ssilang.cli.run import RunOptions, run_source, run_text
from ssilang.language.say.diagnostics import render
from ssilang.language.text.source import Source

ROWS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["whole"]


@together("row", ROWS)
def test_a_message_says_what_where_and_how_to_mend_it(row):
    text, _, told = row.partition("\n>> ")
    said, *behind = told.split("\n")
    before, _, rest = text.partition("«")
    place, _, after = rest.partition("»")
    script = before + place + after
    line, column = before.count("\n"), len(before) - before.rfind("\n")
    shown = script.split("\n")[line]
    marks = " " * (column - 1) + "^" * len(place.split("\n")[0])
    wanted = [
        said, f"  --> script:{line + 1}:{column}", "  |", f"{line + 1} | {shown}", f"  | {marks}",
        *(f"  {more}" for more in behind),
    ]  # fmt: skip
    assert run_text(script).message.rstrip("\n").split("\n") == wanted


_PLATE = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; P1 = 0. 0. ; L1 = DROI 2 P1 (1. 0.) ; "
    "S1 = L1 TRAN 2 (0. 1.) ; MO1 = MODE S1 MECANIQUE ELASTIQUE ; "
)


@together(
    "script, sentences",
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
