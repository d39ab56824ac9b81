"""What operators refuse, for which reason and where: `test_refusals.toml` has the scripts."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
import script_runs

TOLD = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("code", TOLD["refused"])
def test_it_is_refused_for_its_reason_and_at_its_place(code, tmp_path):
    for script in TOLD["refused"][code]:
        result = script_runs.failed(TOLD["before"] + script + " ;", tmp_path)
        found = [error.code for error in result.errors if error.severity == "error"]
        assert found == [code], script
