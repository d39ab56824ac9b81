"""The Python shown in the manual runs and prints what the page says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

_PAGE = (Path(__file__).resolve().parents[2] / "docs/python.md").read_text(encoding="utf-8")
_SHOWN = re.findall(r"```python\n(.*?)```\s+prints\s+```\n(.*?)```", _PAGE, re.DOTALL)


def test_every_script_shows_what_it_prints():
    assert len(_SHOWN) == _PAGE.count("```python") >= 2


@pytest.mark.parametrize(("script", "printed"), _SHOWN, ids=["kernel", "script"])
def test_script_prints_what_the_page_says(script, printed, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(compile(script, "docs/python.md", "exec"), {"__name__": "page"})
    assert capsys.readouterr().out == printed
