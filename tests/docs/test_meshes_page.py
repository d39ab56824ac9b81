"""The page of meshes: its Python runs and prints what it says, its table is that of the code."""

import importlib.util
import re
from pathlib import Path

import pytest

from ssilang.io.mesh_files.writing import WRITTEN
from ssilang.operators.files.meshes import ENDINGS
from ssilang.system import keep_from_closed_pipes

_PAGE = (Path(__file__).resolve().parents[2] / "docs/meshes.md").read_text(encoding="utf-8")


def test_the_table_names_every_ending_and_what_is_written():
    rows = [line for line in _PAGE.splitlines() if line.startswith("| ") and "`." in line]
    shown = {e for row in rows for e in re.findall(r"`(\.\w+)`", row.split("|")[2])}
    assert shown == set(ENDINGS)
    written = {e for r in rows if "'MESH'" in r for e in re.findall(r"`(\.\w+)`", r.split("|")[2])}
    assert set(WRITTEN) == written - {".rmed"}


@pytest.mark.skipif(importlib.util.find_spec("gmsh") is None, reason="gmsh is not installed")
def test_a_block_meshed_by_gmsh_rocks(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    script, printed = re.findall(r"```python\n(.*?)```\s+prints\s+```\n(.*?)```", _PAGE, re.DOTALL)[
        0
    ]
    assert len(script.splitlines()) <= 40
    exec(compile(script, "docs/meshes.md", "exec"), {"__name__": "page"})
    keep_from_closed_pipes()
    assert capsys.readouterr().out == printed
