"""What each section of the language says: scripts and what they come to (`test_sections.toml`)."""

import tomllib
from pathlib import Path

import pytest
from script_runs import failed
from together import together

from ssilang.language.values import type_of

SECTIONS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
VALUES = SECTIONS.pop("values")
ROWS = [(name, row) for name, section in SECTIONS.items() for row in section.values()]
ROWS += [
    ("values", {"say": f"{VALUES['before']} x = {phrase} ;", "X": value})
    for phrase, value in VALUES.items()
    if phrase != "before"
]


@together("section, row", ROWS, by=lambda row: row[0])
def test_a_script_comes_to_its_values_or_fails_at_its_place(run, tmp_path, section, row):
    if "fails" in row:
        result = failed(row["say"], tmp_path)
        assert [e.code for e in result.errors] == [row["fails"]] * row.get("times", 1)
        assert row.get("told", "") in result.message
        return
    script = run(row["say"])
    assert script.lines == row.get("lines", script.lines)
    warned = [[w.code, w.span.text] for w in script.result.session.warnings]
    assert warned == row.get("warns", warned)
    for name in row.keys() - {"say", "lines", "warns"}:
        found, value = script[name], row[name]
        if isinstance(value, dict):
            assert script.kind(name) == value["kind"]
        elif isinstance(value, list):
            assert list(found.values) == value
        elif isinstance(value, float):
            assert (type_of(found), found) == ("FLOTTANT", pytest.approx(value, abs=1e-12))
        else:
            assert (found, script.kind(name)) == (value, type_of(value))
