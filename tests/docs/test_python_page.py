"""The Python shown in the manual runs, in order, and prints what the page says."""

import re
import shutil
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
_PAGE = (_ROOT / "docs/python.md").read_text(encoding="utf-8")
_SHOWN = re.findall(r"```python\n(.*?)```\s+prints\s+```\n(.*?)```", _PAGE, re.DOTALL)


def test_every_script_shows_what_it_prints():
    assert len(_SHOWN) == _PAGE.count("```python") >= 2


def test_the_scripts_of_the_page_print_what_it_says(capsys, tmp_path, monkeypatch):
    shutil.copy(_ROOT / "cases/starters/oscillator.ssi", tmp_path)
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "page"}
    for script, printed in _SHOWN:
        exec(compile(script, "docs/python.md", "exec"), names)
        assert capsys.readouterr().out == printed
    assert [p.name for p in tmp_path.iterdir()] == ["oscillator.ssi"]
