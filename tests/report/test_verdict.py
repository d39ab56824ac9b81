"""@BILANSSI's verdict in summary.json and in the report."""

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest
from together import together

from ssilang.cli.run import run_text
from ssilang.report.verdict import is_endless, verdict_html


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


def test_figures_of_two_footings_are_marked_by_their_limits():
    """At a limit nothing is bad; factors that are cut at their top have no value."""
    peaks = {"TAUX": 1.0, "RENVERSEMENT": 1000.0, "GLISSEMENT": 0.5, "PART": 0.25}
    first = {
        "peaks": {n: {"value": v, "time": i + 0.5} for i, (n, v) in enumerate(peaks.items())},
        "left": {"ENFONCEMENT": 0.125},
        "area": 6.0,
        "capacity": None,
        "friction": 0.0,
    }
    floors = [
        {"floor": 3, "component": "UY", "damping": "2 %", "acceleration": 7.0, "frequency": 4.0}
    ]
    others = {"TAUX": 1.5, "RENVERSEMENT": None, "GLISSEMENT": 1.0, "ROTATION": None}
    second = {
        "peaks": {n: {"value": v, "time": 2.0} for n, v in others.items()},
        "left": {},
        "area": 7.0,
        "capacity": 300.0,
        "friction": None,
    }
    verdicts = [first | {"floors": floors}, second | {"floors": []}]

    def rows(*shown):
        results = SimpleNamespace(summary={"statistics": {"verdicts": [*shown]}})
        page = verdict_html(
            results, [], lambda code, **data: code + "".join(map(str, data.values()))
        )
        cells = [re.findall("<td.*?>(.*?)</td>", row) for row in re.findall("<tr>.*?</tr>", page)]
        return page, [row[1:] for row in cells if row]

    page, found = rows(*verdicts)
    assert re.findall("<h3>(.*?)</h3>", page) == [
        "report.footing-number1",
        "report.footing-number2",
    ]
    assert found == [
        ['<b class="good">1</b>', "0.5"], ['<b class="good">> 1000</b>', "1.5"],
        ['<b class="bad">0.5</b>', "2.5"], ["0.25", "3.5"], ["0.125", ""], ["6", ""], ["0", ""],
        ["UY", "2 %", "7", "4"],
        ['<b class="bad">1.5</b>', "2"], ["", "2"], ['<b class="good">1</b>', "2"], ["", "2"],
        ["7", ""], ["300", ""],
    ]  # fmt: skip
    assert "<h3>" not in rows(verdicts[1])[0]
    assert is_endless("GLISSEMENT_2", 1000.0)
    assert not is_endless("TAUX_2", 1000.0)


@together("given", [{}, {"FROTTEMENT": 0.7}, {"CAPACITE": 2e5},
                                   {"FROTTEMENT": 0.4, "CAPACITE": 3e5}])  # fmt: skip
def test_friction_and_capacity_are_told_each_by_itself(given):
    tables = "G = TABL ; F = TABL ; F . 'PICS' = TABL ; F . 'RESIDUS' = TABL ; F . 'AIRE' = 12. ; "
    entries = "".join(f"G . '{name}' = {value} ; " for name, value in given.items())
    run = run_text(tables + entries + "ZBIL G F ;")
    (verdict,) = run.session.statistics["verdicts"]
    told = (verdict["area"], verdict["friction"], verdict["capacity"])
    assert told == (12.0, given.get("FROTTEMENT"), given.get("CAPACITE"))
