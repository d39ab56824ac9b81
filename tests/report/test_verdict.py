"""@BILANSSI's verdict in summary.json and report; records of a page; runs that were resumed."""

import copy
import json
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from together import together

from ssilang.cli.run import RunOptions, RunResult, run_text
from ssilang.operators.dynamics.checkpoints import KeptCalculation
from ssilang.report.records import RecordError, kinds, read_record
from ssilang.report.verdict import is_endless, verdict_html
from tests.operators.test_checkpoints import EVERY, ROCKING


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


DECK = ROCKING + EVERY + "T2 = DYNAMIC T ;"


def run(folder: Path, report: bool = True, resume: bool = False) -> RunResult:
    return run_text(DECK, options=RunOptions(folder, report=report, resume=resume))


@pytest.fixture
def ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a run that was interrupted behind its fortieth step."""
    reached = KeptCalculation.reached

    def end(self: KeptCalculation, done: int, state: Any) -> None:
        if done >= 40:
            raise KeyboardInterrupt
        reached(self, done, state)

    with monkeypatch.context() as patched:
        patched.setattr(KeptCalculation, "reached", end)
        assert run(tmp_path / "ended").exit_code == 1
    return tmp_path / "ended"


def test_the_report_is_that_of_an_undisturbed_run(ended: Path, tmp_path: Path) -> None:
    whole, table = tmp_path / "whole", "report/calculation_1.csv"
    assert run(whole).exit_code == 0
    assert len((ended / table).read_text().split("\n")) < 50  # what it had
    assert run(ended, resume=True).exit_code == 0
    for name in (table, "report/scene_1.vtkhdf"):
        assert (ended / name).read_bytes() == (whole / name).read_bytes(), name


def test_going_on_without_the_report_is_refused(ended: Path) -> None:
    result = run(ended, report=False, resume=True)
    assert result.exit_code == 1
    assert "was made with --report" in result.message
    assert "--resume --report" in result.message


VALUES = {"text": "t", "a number": 0.5, "a count": 2, "true or false": True}
VALUES["two of true or false"] = [False, True]


def whole(kind, wrong, place=""):
    """A value of a kind with two of everything; `wrong` gets places of what it holds."""
    if isinstance(kind, str) and kind[0] == "@":
        return whole(kinds()[kind[1:]], wrong, place)
    if isinstance(kind, str):
        wrong.append(place)
        return VALUES.get(kind.removesuffix("?"), "DEPL")
    if isinstance(kind, list):
        return [whole(kind[0], wrong, f"{place}[{i}]") for i in range(2)]
    inner = dict.fromkeys(sorted(kind["only"]), kind["each"]) if "only" in kind else kind
    names = [(n.removesuffix("?"), k) for n, k in inner.items()]
    return {n: whole(k, wrong, f"{place}.{n}".lstrip(".")) for n, k in names}


def at(record, place):
    """What holds a place, and its last step."""
    steps = [
        int(s) if s.isdigit() else s for s in place.replace("]", "").replace("[", ".").split(".")
    ]
    for step in steps[:-1]:
        record = record[step]
    return record, steps[-1]


@pytest.mark.parametrize("name", ["summary", "fragility", "contents"])
def test_a_wrong_value_is_told_by_its_place(name, tmp_path):
    kind, places = kinds()[name], []
    record, path = whole(kind, places), tmp_path / "r.json"
    path.write_text(json.dumps(record | {"more": 1}))
    assert read_record(path, name) == record | {"more": 1}
    for place in places:
        for bad, held in (({"odd": 1}, "dict"), (None, "None")):
            changed = copy.deepcopy(record)
            holder, last = at(changed, place)
            holder[last] = bad
            path.write_text(json.dumps(changed))
            try:
                found = read_record(path, name)
            except RecordError as refused:
                told = str(refused)
                assert told.startswith(f"{place}: {held} != "), (told, place)
            else:  # null says nothing: what may miss, or is not there
                assert bad is None
                holder, last = at(found, place)
                assert holder[last] is None if isinstance(last, int) else holder.get(last) is None
    needed = [n for n in kind if not n.endswith("?")]
    for one in needed:
        path.write_text(json.dumps({n: v for n, v in record.items() if n != one}))
        with pytest.raises(RecordError, match=f"^{one} = "):
            read_record(path, name)
