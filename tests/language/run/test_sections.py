"""What each section of the language says: scripts and what they come to (`test_sections.toml`)."""

import tomllib
from pathlib import Path

from together import together

SECTIONS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
ROWS = [row for section in SECTIONS.values() for row in section.values()]


@together("row", ROWS)
def test_a_script_comes_to_its_values_or_fails_at_its_place(run, fails, row):
    if "fails" in row:
        assert fails(row["say"]) == row["fails"]
        return
    script = run(row["say"])
    assert script.lines == row.get("lines", script.lines)
    for name in row.keys() - {"say", "lines"}:
        found, value = script[name], row[name]
        if isinstance(value, dict):
            assert script.kind(name) == value["kind"]
        elif isinstance(value, list):
            assert list(found.values) == value
        else:
            assert (found, isinstance(found, bool)) == (value, isinstance(value, bool))
