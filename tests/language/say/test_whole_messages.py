"""Whole messages of a run: the sentence with its figures, the place, the cure, who called.

`test_whole_messages.toml` has the scripts; what a reader would point at is marked in them.
"""

import tomllib
from pathlib import Path

from together import together

from ssilang.cli.run import run_text

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
