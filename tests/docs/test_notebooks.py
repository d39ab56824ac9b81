"""The notebooks of the manual: a study in Python runs; `tests/jupyter` runs that in Gibiane."""

import os
import re
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")

_DOCS = Path(__file__).resolve().parents[2] / "docs"


def notebook(name):
    return nbformat.read(_DOCS / f"{name}.ipynb", as_version=4)


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
        printed = "".join(o["text"] for o in cell.outputs if o["output_type"] == "stream")
        assert capsys.readouterr().out == printed
    table = names["table"]
    assert len(table) == 8
    assert table["exit_code"].eq(0).all()


@pytest.mark.parametrize("name", ["first_uplift", "uplift_study"])
def test_notebooks_are_small_and_have_their_outputs(name):
    assert (_DOCS / f"{name}.ipynb").stat().st_size < 300_000
    ran = [c for c in notebook(name).cells if c.cell_type == "code"]
    assert any("image/png" in o.get("data", {}) for c in ran for o in c.outputs)
    assert [c.execution_count for c in ran] == list(range(1, len(ran) + 1))
