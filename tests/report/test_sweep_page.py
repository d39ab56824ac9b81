"""Sweeps: the page and its links, histories of all runs joined; runs' pages from Python."""

import csv
import io
import json
import re
import shutil

import numpy as np
import pyarrow.parquet as pq
import pytest

import ssilang
from ssilang.cli.main import main
from ssilang.cli.sweeping import histories
from ssilang.cli.sweeping.histories import join_histories
from ssilang.cli.sweeping.pool import run_alone
from ssilang.cli.sweeping.sweep import SweepOptions, sweep
from ssilang.report import sweep_page
from ssilang.report.sweep_table import KEPT, edited, read_sweep

DECK = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; AG = 1. ; NAME = 'a' ;
SI (AG > 3.5) ; ERRE 'too <b>strong</b>' ; FINSI ;
OPTI 'UNIT' 'SI' ;
P1 = 0. 0. ; P2 = 0. 1. ; L = D 1 P1 P2 ; M = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
A = MATE M 'YOUN' 400. 'NU' 0.2 'RHO' 0. 'SECT' 1. ; MS = MASS 'DEPL' 1. P2 ; T = TABL ;
T . 'RIGI' = (RIGI M A) ET (BLOQ 'UX' 'UY' P1) ET (BLOQ 'UX' P2) ; T . 'MASS' = MS ;
T . 'CHAR' = CHAR 'MECA' (FORC (0. AG) P2) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.01 0.3 ; T . 'PAS_SAUVES_CSV' = 2 ;
T . 'MAILLAGE_CSV' = P2 ; T . 'FICHIER_CSV' = NAME ; R = DYNAMIC T ;
SORT 'BILA' 'top' (MAXI (EXTR (EVOL 'TEMP' R 'DEPL' 'UY' P2) 'ORDO')) ;
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A sweep of six runs, two of which fail; half of them write CSV, the others Parquet."""
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "osc.ssi").write_text(DECK)
    given = ["AG=1,2,4", "NAME=a.csv,a.parquet"]
    options = SweepOptions(folder / "osc.ssi", given, out=folder / "out", jobs=1, report=True)
    out, err = io.StringIO(), io.StringIO()
    with pytest.MonkeyPatch.context() as patch:  # a process of its own costs a second
        patch.setattr("ssilang.cli.sweeping.sweep.run_all", lambda tasks, _: run_alone(tasks))
        assert sweep(options, out, err) == 1
    assert "2 failed" in out.getvalue()
    assert "2 joined histories" in out.getvalue()
    assert "columns" not in err.getvalue()
    return folder / "out"


def test_histories_of_all_runs_stand_in_one_table(made):
    with (made / "histories" / "a.csv").open(newline="") as file:
        rows = list(csv.DictReader(file, delimiter=";"))
    assert [r["run"] for r in rows[::16]] == ["1", "3"]  # those that ended well
    title = next(t for t in rows[0] if t.startswith("DEPL_UY"))
    assert title.endswith("(m)")
    w = 20.0
    assert len(rows) == 32
    for row in rows:  # a step on an oscillator at rest; the scheme is 0.3 % too slow
        still = float(row["AG"]) / w**2
        exact = still * (1.0 - np.cos(w * float(row["TEMP (s)"])))
        assert float(row[title]) == pytest.approx(exact, abs=0.02 * still)
    table = pq.read_table(made / "histories" / "a.parquet")
    assert table.column_names[:3] == ["run", "AG", "NAME"]
    assert (table["run"].to_pylist()[0], table["AG"].to_pylist()[-1]) == (2, 2)
    name = next(n for n in table.column_names if n.startswith("DEPL_UY"))
    assert table.schema.field(name).metadata[b"unit"] == b"m"
    np.testing.assert_allclose(table[name], [float(r[title]) for r in rows], rtol=1e-8)


def test_runs_with_other_columns_are_counted_and_large_tables_named(tmp_path, monkeypatch):
    rows = [{"run": i, "AG": i, "exit_code": 0, "folder": str(i)} for i in (1, 2, 3)]
    for row in rows:
        folder = tmp_path / "runs" / row["folder"]
        folder.mkdir(parents=True)
        (folder / "summary.json").write_text('{"files": [{"path": "h.csv"}, {"path": "t.csv"}]}')
        (folder / "h.csv").write_text(f"t;{'b' if row['run'] == 2 else 'a'}\n0;1\n1;{row['run']}\n")
        (folder / "t.csv").write_text("this;is\nno;table\n")
    joined = join_histories(rows, ["AG"], tmp_path)
    assert (joined.others, joined.files) == (1, [tmp_path / "histories" / "h.csv"])
    assert joined.files[0].read_text() == "run;AG;t;a\n1;1;0;1\n1;1;1;1\n3;3;0;1\n3;3;1;3\n"
    monkeypatch.setattr(histories, "MOST_BYTES", 30)
    assert join_histories(rows, ["AG"], tmp_path).large == ["h.csv", "t.csv"]


def test_the_page_has_the_runs_their_links_and_the_figures(made):
    page = (made / "report.html").read_text()
    assert "2 runs failed" in page
    assert re.findall(r"<li><b>([^<]*)</b>", page)[:3] == ["6", "1 … 4", "2"]
    assert "too &lt;b&gt;strong&lt;/b&gt;" in page
    links = re.findall(r'<a href="(runs/[^"]+)">', page)
    assert len(links) == 6
    assert all((made / link.replace("%3D", "=")).is_file() for link in links)
    (chart,) = json.loads(re.search(r'id="data-charts">(.*?)</script>', page, re.DOTALL)[1])
    assert (chart["x"], chart["title"]) == ("AG", "top")
    assert [line["name"] for line in chart["lines"]] == ["NAME = a.csv", "NAME = a.parquet"]
    assert chart["lines"][0]["y"] == pytest.approx([2 / 400.0, 4 / 400.0], rel=1e-2)


def test_the_page_is_made_again_in_french_and_damage_is_refused(
    made, tmp_path, capsys, monkeypatch
):
    """As long as pages are allowed to be."""
    monkeypatch.setattr(sweep_page, "MOST_RUNS", 4)
    monkeypatch.setattr(sweep_page, "MOST_LINES", 1)
    folder = shutil.copytree(made, tmp_path / "short")
    assert main(["report", str(folder), "--lang", "fr"]) == 0
    page = (folder / "report.html").read_text("utf-8")
    assert "2 calculs en échec" in page
    assert "Les 4 premiers calculs" in page
    assert len(re.findall(r'<a href="runs/', page)) == 4
    (chart,) = json.loads(re.search(r'id="data-charts">(.*?)</script>', page, re.DOTALL)[1])
    assert (chart["title"], len(chart["lines"])) == ("top (1 de plus dans sweep.csv)", 1)
    (tmp_path / "runs").mkdir()
    (tmp_path / "sweep.csv").write_text("run;AG\n1;2\n")
    assert main(["report", str(tmp_path)]) == 2
    assert "is not the table of a sweep" in capsys.readouterr().err


def test_an_edited_table_is_told(made, tmp_path):
    folder = shutil.copytree(made, tmp_path / "again")
    table, page = folder / "sweep.csv", folder / "report.html"
    assert main(["report", str(folder)]) == 0
    assert "is not what the run reported" not in page.read_text("utf-8")
    was = next(row["top"] for row in read_sweep(folder).rows if row["exit_code"] == "0")
    table.write_text(table.read_text("utf-8").replace(was, "9876.5", 1), "utf-8")
    assert main(["report", str(folder)]) == 0
    assert "1 row of sweep.csv (1) is not what the run reported" in page.read_text("utf-8")
    rows = read_sweep(folder).rows
    (folder / "runs" / rows[1]["folder"] / KEPT).write_text("{}")
    assert edited(read_sweep(folder)) == [rows[0]["run"], rows[1]["run"]]


def test_a_run_from_python_has_its_page():
    r = ssilang.run("SORT 'BILA' 'seven' 7. ;", report=True)
    assert "seven" in r.report.read_text()
    with pytest.raises(ssilang.Error, match="no report"):
        _ = ssilang.run("X = 1. ;").report
    with pytest.raises(ssilang.Error, match="needs a folder"):
        ssilang.sweep("osc.ssi", AG=1.0, report=True)


def test_a_browser_draws_the_figures_and_follows_a_link(made, browser):
    browser.open(made / "report.html", 390, 700)
    browser.until("!!document.querySelector('figure.chart').plot")
    assert browser.run("document.documentElement.scrollWidth") == 390
    browser.run("document.querySelector('#sweep a').click()")
    browser.until("!!document.querySelector('section#energy')")
    assert browser.console == []
    assert browser.requests == []
