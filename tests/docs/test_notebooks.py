"""The notebooks of the manual run, and show what they hold."""

from __future__ import annotations

import asyncio
import os
import re
from pathlib import Path

import pytest

import ssilang
from ssilang.jupyter.__main__ import install

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

_DOCS = Path(__file__).resolve().parents[2] / "docs"


def notebook(name):
    return nbformat.read(_DOCS / f"{name}.ipynb", as_version=4)


def shown(outputs):
    """Texts of a cell's outputs, and the kinds of its data; nothing of what says progress."""
    streams = [o["text"] for o in outputs if o["output_type"] == "stream"]
    errors = ["\n".join(o["traceback"]) for o in outputs if o["output_type"] == "error"]
    data = [o["data"] for o in outputs if "data" in o and o["data"] != {"text/plain": ""}]
    return "".join(streams), errors, [(sorted(d), d["text/plain"]) for d in data]


def test_first_uplift_shows_what_it_holds(tmp_path, monkeypatch):
    install(str(tmp_path), "en")
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path / "share/jupyter"))
    monkeypatch.setenv("PYTHONPATH", str(Path(ssilang.__file__).parents[1]))
    kept, made = notebook("first_uplift"), notebook("first_uplift")
    for cell in made.cells:
        cell.pop("outputs", None)
        if cell.cell_type == "code":
            cell.outputs = []
    client = nbclient.NotebookClient(
        made, timeout=60, allow_errors=True, resources={"metadata": {"path": str(tmp_path)}}
    )
    asyncio.run(client.async_execute())
    assert [shown(c.get("outputs", [])) for c in made.cells] == [
        shown(c.get("outputs", [])) for c in kept.cells
    ]
    assert sum(len(shown(c.get("outputs", []))[1]) for c in kept.cells) == 1  # the one shown


def test_the_study_prints_what_it_holds(tmp_path, monkeypatch, capsys):
    """Its cells as a script, since Python's own kernel is not ours to test."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(os.environ, "MPLBACKEND", "Agg")
    names: dict[str, object] = {}
    for cell in notebook("uplift_study").cells:
        if cell.cell_type != "code":
            continue
        file = re.match(r"%%writefile (\S+)\n", cell.source)
        if file:
            (tmp_path / file[1]).write_text(cell.source[file.end() :])
            continue
        exec(cell.source.replace('"oscillator.ssi", U0=[', '"oscillator.ssi", jobs=1, U0=['), names)
        assert capsys.readouterr().out == shown(cell.outputs)[0]
    table = names["table"]
    assert len(table) == 8
    assert table["exit_code"].eq(0).all()


@pytest.mark.parametrize("name", ["first_uplift", "uplift_study"])
def test_notebooks_are_small_and_have_their_outputs(name):
    assert (_DOCS / f"{name}.ipynb").stat().st_size < 300_000
    ran = [c for c in notebook(name).cells if c.cell_type == "code"]
    assert any("image/png" in o.get("data", {}) for c in ran for o in c.outputs)
    assert [c.execution_count for c in ran] == list(range(1, len(ran) + 1))
