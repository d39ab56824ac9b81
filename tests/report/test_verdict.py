"""@BILANSSI's verdict in summary.json and in the report."""

import json
import re

import numpy as np
import pytest
from together import together

from ssilang.cli.run import run_text


def test_the_summary_has_the_figures_of_the_histories(verdict_run):
    summary = json.loads((verdict_run / "summary.json").read_text())
    assert summary["exit_code"] == 0
    (verdict,) = summary["statistics"]["verdicts"]
    rows = np.genfromtxt(verdict_run / "report" / "calculation_1.csv", delimiter=";", names=True)
    peaks = verdict["peaks"]
    assert peaks["PART"]["value"] == pytest.approx(rows["share_1"].min(), abs=1e-6)
    assert peaks["PRESSION"]["value"] == pytest.approx(rows["pressure_1"].max(), rel=1e-6)
    assert peaks["TAUX"]["value"] == pytest.approx(rows["pressure_1"].max() / 2e5, rel=1e-6)
    when = rows["time"][rows["pressure_1"].argmax()]
    assert peaks["PRESSION"]["time"] == pytest.approx(when)
    assert verdict["left"]["ROTATION"] == pytest.approx(rows["rotation_z_1"][-1], rel=1e-6)
    (floor,) = verdict["floors"]
    assert (floor["component"], floor["damping"], verdict["friction"]) == ("UX", "5 %", 0.7)


def test_the_report_has_them_with_their_limits_marked(verdict_run):
    page = (verdict_run / "report.html").read_text()
    part = re.search(r'<section id="verdict">(.*?)</section>', page, re.DOTALL)[1]
    verdict = json.loads((verdict_run / "summary.json").read_text())["statistics"]["verdicts"][0]
    assert "bilan de la semelle" in part
    use = verdict["peaks"]["TAUX"]["value"]
    assert use > 1.0
    assert f'<b class="bad">{use:.5g}</b>' in part
    assert part.count("data-chart=") == 4
    charts = json.loads(re.search(r'id="data-charts">(.*?)</script>', page, re.DOTALL)[1])
    titles = [c["title"] for c in charts]
    floor = charts[titles.index("plancher 1, UX")]
    assert floor["log"] == [True, False]
    assert [line["name"] for line in floor["lines"]] == ["5 %", "5 %, élargi"]
    assert max(floor["lines"][0]["y"]) == pytest.approx(
        verdict["floors"][0]["acceleration"], rel=1e-5
    )
    pressure = charts[titles.index("pression sous l'arête (la plus grande)")]
    assert max(pressure["lines"][0]["y"]) == pytest.approx(
        verdict["peaks"]["PRESSION"]["value"], rel=1e-5
    )


@together("given", [{}, {"FROTTEMENT": 0.7}, {"CAPACITE": 2e5},
                                   {"FROTTEMENT": 0.4, "CAPACITE": 3e5}])  # fmt: skip
def test_friction_and_capacity_are_told_each_by_itself(given):
    tables = "G = TABL ; F = TABL ; F . 'PICS' = TABL ; F . 'RESIDUS' = TABL ; F . 'AIRE' = 12. ; "
    entries = "".join(f"G . '{name}' = {value} ; " for name, value in given.items())
    run = run_text(tables + entries + "ZBIL G F ;")
    (verdict,) = run.session.statistics["verdicts"]
    told = (verdict["area"], verdict["friction"], verdict["capacity"])
    assert told == (12.0, given.get("FROTTEMENT"), given.get("CAPACITE"))
