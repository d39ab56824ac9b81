"""Pages whose scripts, Python, figures and notebooks run and give what the pages say."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from script_runs import ran

from ssilang.cli.run import RunOptions, run_file
from ssilang.io.mesh_files.writing import WRITTEN
from ssilang.operators.files.meshes import ENDINGS
from ssilang.system import keep_from_closed_pipes

_ROOT = Path(__file__).resolve().parents[2]
_DOCS = _ROOT / "docs"
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


_PAGE = (_DOCS / "faq.md").read_text(encoding="utf-8")
_DECK = re.findall(r"```ssi\n(.*?)```", _PAGE, re.DOTALL)[0]


def row(start: str) -> list[str]:
    line = next(t for t in _PAGE.splitlines() if t.startswith(f"| {start} |"))
    return [cell.strip() for cell in line.strip("|").split("|")]


@cache
def found(**changed: str) -> list[float]:
    deck = _DECK
    for name, value in changed.items():
        deck = re.sub(rf"{name} = \S+ ;", f"{name} = {value} ;", deck, count=1)
    result = ran(deck)
    return [result.session.root.find(n) for n in ("LIFT", "ACCE", "ERR1")]


def test_the_step_costs_energy_before_displacement():
    for start, changed in (("2 ms", {"DT0": "2.E-3"}), ("1 ms", {})):
        lift, _, error = found(**changed)
        _, told_lift, told_error = row(start)
        assert f"{1e3 * lift:.2f} mm" == told_lift
        assert error == pytest.approx(float(told_error), rel=0.05)
    lift, _, error = found(CONSERVE="VRAI")
    assert row("1 ms, `CONSERVATIF = VRAI`")[1] == f"{1e3 * lift:.2f} mm"
    assert error < 1e-11


def test_a_stiffer_joint_rings_more_and_lifts_the_same():
    soft, hard = found(), found(KN0="2.E9")
    assert row("average acceleration")[1] == f"{1e3 * hard[0]:.2f} mm"
    assert abs(hard[0] / soft[0] - 1) < 0.08
    assert hard[1] > 2 * soft[1]


_MESHES = (_DOCS / "meshes.md").read_text(encoding="utf-8")


def test_the_table_names_every_ending_and_what_is_written():
    rows = [line for line in _MESHES.splitlines() if line.startswith("| ") and "`." in line]
    shown = {e for row in rows for e in re.findall(r"`(\.\w+)`", row.split("|")[2])}
    assert shown == set(ENDINGS)
    written = {e for r in rows if "'MESH'" in r for e in re.findall(r"`(\.\w+)`", r.split("|")[2])}
    assert set(WRITTEN) == written - {".rmed"}


@pytest.mark.skipif(importlib.util.find_spec("gmsh") is None, reason="gmsh is not installed")
def test_a_block_meshed_by_gmsh_rocks(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    script, printed = re.findall(
        r"```python\n(.*?)```\s+prints\s+```\n(.*?)```", _MESHES, re.DOTALL
    )[0]
    assert len(script.splitlines()) <= 40
    exec(compile(script, "docs/meshes.md", "exec"), {"__name__": "page"})
    keep_from_closed_pipes()
    assert capsys.readouterr().out == printed


def notebook(name):
    nbformat = pytest.importorskip("nbformat")
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


_OPENSEES = (_DOCS / "opensees.md").read_text(encoding="utf-8")
_FOUND = (0.292983, 0.127958)
"""Drift and uplift that OpenSeesPy 3.7 finds with this record."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    t = np.arange(1000) * 0.01
    pulse = 0.35 * np.sin(2.2 * np.pi * t) * np.exp(-(((t - 4.0) / 2.0) ** 2))
    values = pulse + 0.1 * np.sin(6.2 * np.pi * t)
    lines = ["".join(f"{v:15.7E}" for v in row) for row in values.reshape(-1, 5)]
    head = ["made for a test", "sines", "ACCELERATION IN UNITS OF G", "NPTS= 1000, DT= .0100 SEC"]
    (tmp_path / "motion.AT2").write_text("\n".join([*head, *lines]) + "\n")
    return tmp_path


def printed(text: str) -> list[float]:
    return [float(v) for v in re.findall(r"\d\.\d+[Ee][-+]\d+", text)]


def test_the_deck_finds_what_opensees_finds(folder: Path) -> None:
    (script,) = re.findall(r"```ssi\n(.*?)```", _OPENSEES, re.DOTALL)
    (folder / "rock.ssi").write_text(script)
    result = run_file(folder / "rock.ssi", RunOptions(output_directory=folder / "out"))
    assert result.exit_code == 0, result.message
    assert printed(result.output) == pytest.approx(_FOUND, rel=1e-5)
    assert all(f"{v:.5f}" in _OPENSEES for v in _FOUND)


@pytest.mark.skipif(find_spec("openseespy") is None, reason="the extra bench is not installed")
def test_the_other_program_finds_it_too(folder: Path) -> None:
    (script,) = re.findall(r"```python\n(.*?)```", _OPENSEES, re.DOTALL)
    run = subprocess.run(
        [sys.executable, "-c", script], cwd=folder, capture_output=True, text=True, check=True
    )
    assert printed(run.stdout) == pytest.approx(_FOUND, rel=1e-5)


_PYTHON = (_DOCS / "python.md").read_text(encoding="utf-8")
_SHOWN = re.findall(r"```python\n(.*?)```\s+prints\s+```\n(.*?)```", _PYTHON, re.DOTALL)


def test_every_script_shows_what_it_prints():
    assert len(_SHOWN) == _PYTHON.count("```python") >= 2


def test_the_scripts_of_the_page_print_what_it_says(capsys, tmp_path, monkeypatch):
    shutil.copy(_ROOT / "cases/starters/oscillator.ssi", tmp_path)
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "page"}
    for script, printed in _SHOWN:
        exec(compile(script, "docs/python.md", "exec"), names)
        assert capsys.readouterr().out == printed
    assert [p.name for p in tmp_path.iterdir()] == ["oscillator.ssi"]
