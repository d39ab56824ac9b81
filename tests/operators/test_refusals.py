"""What operators refuse, why, where and in which words: scripts of `test_refusals.toml`."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
import script_runs

ROWS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def assert_refused(script, code, said, folder):
    result = script_runs.failed(script, folder)
    assert [error.code for error in result.errors if error.severity == "error"] == [code], script
    for words in said:
        assert words in result.message


@pytest.mark.parametrize("code", ROWS["refused"])
def test_it_is_refused_for_its_reason_and_at_its_place(code, tmp_path):
    for script in ROWS["refused"][code]:
        assert_refused(ROWS["before"] + script + " ;", code, (), tmp_path)


@pytest.mark.parametrize("name", ROWS["told"])
def test_it_is_told(name, tmp_path):
    group = ROWS["told"][name]
    for code, script, *said in group["rows"]:
        assert_refused(group["before"] + script, code, said, tmp_path)
