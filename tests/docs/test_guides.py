"""The scripts shown in the README and the guide to uplift run."""

import re
from pathlib import Path

import pytest
from script_runs import ran

_ROOT = Path(__file__).resolve().parents[2]
_SCRIPTS = [
    pytest.param(script, id=f"{page}-{number}")
    for page in ("README.md", "docs/uplift.md")
    for number, script in enumerate(
        re.findall(r"```ssi\n(.*?)```", (_ROOT / page).read_text(encoding="utf-8"), re.DOTALL), 1
    )
]


def test_there_are_scripts():
    assert len(_SCRIPTS) >= 2


@pytest.mark.parametrize("script", _SCRIPTS)
def test_script_runs(script, tmp_path):
    ran(script, output_directory=tmp_path)
    if "PAS_SAUVES_VTK" in script:
        assert [*tmp_path.glob("*.pvd"), *tmp_path.glob("*.vtkhdf")]
        assert list(tmp_path.glob("*.png"))
