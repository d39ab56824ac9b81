"""Fragilities and floor spectra on a sweep's page: names, bad runs, ties, few runs, other units."""

import csv
import io
import json
import re

import numpy as np
import pytest
from scipy import stats
from together import together

from ssilang.cli.main import main
from ssilang.cli.sweeping.sweep import SweepOptions, sweep
from ssilang.messages.message import teller
from ssilang.report import fragilities
from ssilang.report.fragilities import (
    Asked,
    Limit,
    amiss,
    fits_of,
    floor_charts,
    fragility_charts,
    fragility_html,
    intensities_of,
    read_limits,
)
from ssilang.report.sweep_table import Sweep
from tests.report.conftest import VERDICT

pytestmark = pytest.mark.usefixtures("one_after_the_other")
TOLD = teller("en")


def sweep_of(folder, rows, swept=("AG", "MOTION"), figures=("drift", "PGA")):
    """A sweep whose rows are numbers, or None; failed ones have no drift."""
    made = []
    for number, row in enumerate(rows, 1):
        failed = row.pop("failed", False)
        made.append(
            {"run": str(number), "exit_code": "1" if failed else "0", "seconds": "1.0",
             "error": "bad" if failed else "", "folder": f"r{number}",
             **{n: str(v) for n, v in row.items()}}
        )  # fmt: skip
    return Sweep(folder, made, list(swept), list(figures))


def suite(n=12, scales=(1, 2, 4)):
    """Records whose capacity in AG is lognormal; drift is AG over it."""
    capacity = 2.0 * np.exp(0.5 * stats.norm.ppf((np.arange(n) + 0.5) / n))
    return [
        {"AG": a, "MOTION": f"/m/{i}.txt", "drift": float(a / c), "PGA": float(a)}
        for a in scales for i, c in enumerate(capacity)
    ]  # fmt: skip


@together(
    "said, found",
    [
        ("drift>0.01", [Limit("drift", False, 0.01)]),
        (" PART < .5 , 1e-1", [Limit("PART", True, 0.5), Limit("PART", True, 0.1)]),
        ("floor at 6 m > 2", [Limit("floor at 6 m", False, 2.0)]),
        ("drift", []),
        ("drift>", []),
        (">2", []),
        ("drift>a", []),
        ("drift>1,", []),
        ("drift>nan", []),
    ],
)
def test_limits_are_read(said, found):
    assert read_limits(said) == found


def test_an_intensity_that_a_scale_leaves_as_it_was_is_told(tmp_path):
    rows = suite()
    for row in rows:
        row["PGA"] = row["PGA"] / row["AG"]
    chosen = [{**row, "PGV": row["AG"] ** 2} for row in rows]  # AG chooses records of one peak
    scaled = [{**row, "PGV": row["AG"] * (1 + i % 12)} for i, row in enumerate(rows)]
    both, pages = ["PGA", "PGV"], []
    for own, names in ((rows, ["PGA"]), (suite(), ["PGA"]), (chosen, both), (scaled, both)):
        made = sweep_of(tmp_path, own, figures=["drift", *names])
        asked = Asked(read_limits("drift>1"), names)
        pages.append(
            "PGA does not change with AG" in fragility_html(made, fits_of(made, asked), [], TOLD)
        )
    assert pages == [True, False, False, True]


def test_an_intensity_that_a_stiffness_leaves_as_it_was_is_not(tmp_path):
    """Told where the motions change with what was swept, as the runs' summaries say."""
    told = []
    for scales in (True, False):
        rows = suite()
        for number, row in enumerate(rows, 1):
            row["PGA"] = float(row["MOTION"][3:-4]) + 1.0
            (run := tmp_path / "runs" / f"r{number}").mkdir(parents=True, exist_ok=True)
            peak = row["PGA"] * (row["AG"] if scales else 1.0)
            summary = {"version": "", "deck": "", "seconds": 1.0, "files": [], "figures": [],
                       "warnings": [], "errors": [],
                       "statistics": {"calculations": [{"motions": [peak]}]}}  # fmt: skip
            (run / "summary.json").write_text(json.dumps(summary))
        made = sweep_of(tmp_path, rows)
        asked = Asked(read_limits("drift>1"), ["PGA"])
        page = fragility_html(made, fits_of(made, asked), [], TOLD)
        told.append("PGA does not change with AG" in page)
        assert "PGA changes with AG" not in page
    assert told == [True, False]


@together(
    "drift, peak, told",
    [("same", 1.0, True), ("same", 0.0, False), ("scaled", 1.0, False), ("scaled", 0.0, False)],
)
def test_an_intensity_that_alone_is_scaled_is_told_where_motions_stay(tmp_path, drift, peak, told):
    """A load made before its motion is scaled; not a figure that a linear model leaves the same."""
    rows = suite()
    for number, row in enumerate(rows, 1):
        row["drift"] /= row["AG"] if drift == "same" else 1.0
        motion = float(row["MOTION"][3:-4]) + 1.0
        (run := tmp_path / "runs" / f"r{number}").mkdir(parents=True, exist_ok=True)
        moved = [motion * (1.0 if peak else row["AG"])]
        summary = {"version": "", "deck": "", "seconds": 1.0, "files": [], "figures": [],
                   "warnings": [], "errors": [],
                   "statistics": {"calculations": [{"motions": moved}]}}  # fmt: skip
        (run / "summary.json").write_text(json.dumps(summary))
    made = sweep_of(tmp_path, rows)
    page = fragility_html(made, fits_of(made, Asked(read_limits("drift>1"), ["PGA"])), [], TOLD)
    assert ("PGA changes with AG, and neither" in page) == told


def test_counts_and_cloud_of_known_capacities_and_the_run_that_governs(tmp_path):
    rows = suite()
    made = sweep_of(tmp_path, rows[::-1])  # names and numbers out of order
    counts, cloud = fits_of(made, Asked(read_limits("drift>1"), ["PGA"]))
    assert (counts.found.runs, counts.exceeded) == (36, sum(r["drift"] > 1 for r in rows))
    assert counts.found.median == pytest.approx(2.0, rel=0.05)
    assert cloud.found.median == pytest.approx(2.0, rel=1e-6)
    assert cloud.found.dispersion == pytest.approx(0.5, rel=0.07)
    assert float(counts.worst["drift"]) == max(r["drift"] for r in rows)
    below = fits_of(made, Asked(read_limits("drift<1"), ["PGA"]))[0]
    assert below.problem.code == "kernel.records.fragility-falls"
    assert float(below.worst["drift"]) == min(r["drift"] for r in rows)


def test_standard_errors_are_those_of_records(tmp_path):
    """Each run thrice, as three records, tells more; the same record again does not."""
    rows = suite()
    copies = [{**r, "MOTION": f"{k}{r['MOTION']}"} for k in range(3) for r in rows]
    again = [dict(r) for _ in range(3) for r in rows]
    asked = Asked(read_limits("drift>1"), ["PGA"])
    one, more, same = (
        fits_of(sweep_of(tmp_path, [dict(r) for r in s]), asked)[0].found
        for s in (rows, copies, again)
    )
    assert more.median == pytest.approx(one.median)
    assert more.median_error == pytest.approx(one.median_error / 3**0.5, rel=0.05)
    assert same.median_error == pytest.approx(one.median_error, rel=1e-6)


def test_few_records_have_no_errors_on_the_page(tmp_path):
    made = sweep_of(tmp_path, suite(n=4, scales=[1, 1.5, 2.5, 4]))
    page = fragility_html(made, fits_of(made, Asked(read_limits("drift>1"), ["PGA"])), [], TOLD)
    assert page.count("fewer than 5 records: no error") == 2
    assert "nan" not in page


def test_points_of_a_picture_are_the_shares_that_were_counted(tmp_path):
    made = sweep_of(tmp_path, suite()[::-1])
    fits = fits_of(made, Asked(read_limits("drift>1"), ["PGA"]))
    curves, cloud = fragility_charts(made, fits, TOLD)
    points, counted, _ = curves.lines
    assert points.points
    assert points.x.tolist() == [1, 2, 4]
    assert points.y == pytest.approx([1 / 12, 0.5, 11 / 12])
    assert (np.diff(counted.x) > 0).all()
    assert np.interp(fits[0].found.median, counted.x, counted.y) == pytest.approx(0.5, abs=0.01)
    assert cloud.log == (True, True)
    assert len(cloud.lines[0].x) == 36


def test_a_bad_run_is_left_out_and_counted_and_one_of_other_units_is_named(tmp_path):
    rows = suite()
    rows[5] = {**rows[5], "failed": True, "drift": "", "PGA": ""}
    rows[7] = {**rows[7], "PGA": 9.81 * rows[7]["PGA"]}
    rows[9] = {**rows[9], "drift": ""}
    made = sweep_of(tmp_path, rows)
    fits = fits_of(made, Asked(read_limits("drift>1"), ["PGA"]))
    page = fragility_html(made, fits, [], TOLD)
    assert fits[0].runs == 34
    assert "1 run that failed is left out" in page
    assert "1 run without drift or PGA left out" in page
    assert "Run 8: its PGA is 9.81 times" in page
    assert "12 records come at several settings" in page
    assert page.count("times the median") == 1


@together(
    "rows, said",
    [
        (suite()[:1], "three runs at least, found 1"),
        (suite(scales=[0.1])[:3], "none of 3 runs exceeds"),
        (suite(n=3, scales=[4, 8]), "all of 6 runs exceed"),
        ([{**r, "drift": 0.0} for r in suite()], "a logarithm, not 0"),
        ([{**r, "PGA": 1.0} for r in suite()], "several intensities, all are 1"),
        ([{**r, "drift": ""} for r in suite()], "three runs at least, found 0"),
    ],
)
def test_what_cannot_be_fitted_stands_in_its_row(tmp_path, rows, said):
    made = sweep_of(tmp_path, [dict(r) for r in rows])
    fits = fits_of(made, Asked(read_limits("drift>1"), ["PGA"]))
    assert said in fragility_html(made, fits, fragility_charts(made, fits, TOLD), TOLD)


def shares(rows):
    """The same runs with the share in contact, which falls where the drift grows."""
    return [{**r, "PART": 1.0 / (1.0 + r["drift"])} for r in rows]


WITHOUT = [{**r, "drift": max(r["drift"] - 1.0, 0.0)} for r in suite()]


@together(
    "rows, figure, limit, said",
    [
        (suite(), "drift", "drift<1", "grows with PGA: drift > 1"),
        (suite(), "drift", "drift<90", "grows with PGA: drift > 90"),
        (shares(suite()), "PART", "PART>0.5", "falls with PGA: PART < 0.5"),
        (suite(n=3), "drift", "drift>1000", "another unit"),
        (suite(n=3, scales=[4, 8]), "drift", "drift>0.001", "another unit"),
        (shares(suite()), "PART", "PART<0.001", "another unit"),
        ([{**r, "PGA": 1.0} for r in suite()], "drift", "drift>1", "all are 1"),
        (suite(), "drift", "drift>0", "another limit"),
        # sound
        (suite(), "drift", "drift>1", ""),
        (suite(scales=[0.1, 0.15]), "drift", "drift>1", ""),
        (shares(suite()), "PART", "PART<0.5", ""),
        (WITHOUT, "drift", "drift>0.5", ""),
        (suite(n=1, scales=[1, 2, 4, 8]), "drift", "drift>1", ""),
        ([{"AG": a, "MOTION": "/m", "drift": max(0.0, a - 1.5), "PGA": a} for a in (1.0, 2.0, 3.0)],
         "drift", "drift>1", ""),
    ],
)  # fmt: skip
def test_limits_that_nothing_comes_near_or_passes_the_other_way_are_told(
    tmp_path, rows, figure, limit, said
):
    made = sweep_of(tmp_path, [dict(r) for r in rows], figures=(figure, "PGA"))
    found = [str(f) + f.hint for f in amiss(made, fits_of(made, Asked(read_limits(limit), [])))]
    assert len(found) == bool(said)
    assert said in "".join(found)


def test_factors_at_their_top_are_no_demands_of_a_cloud(tmp_path):
    rows = [{**r, "GLISSEMENT": 1.0 / r["drift"]} for r in suite()]
    rows[11]["GLISSEMENT"] = 1000.0
    made = sweep_of(tmp_path, rows, figures=("GLISSEMENT", "PGA"))
    counts, cloud = fits_of(made, Asked(read_limits("GLISSEMENT<1"), []))
    assert counts.found.median == pytest.approx(2.0, rel=0.05)
    assert cloud.problem.code == "kernel.records.fragility-demand"


def test_intensities_are_those_known_else_what_was_swept(tmp_path):
    known = sweep_of(tmp_path, suite(), figures=("drift", "SA(T1)", "Sadness", "pgv_x", "PGA"))
    assert intensities_of(known, Asked([], [])) == ["SA(T1)", "pgv_x", "PGA"]
    plain = sweep_of(tmp_path, suite(), swept=("MOTION", "PGA", "AG"), figures=("drift",))
    assert intensities_of(plain, Asked([], [])) == ["PGA"]
    words = sweep_of(tmp_path, suite(), swept=("MOTION",), figures=("drift",))
    assert intensities_of(words, Asked([], [])) == []
    assert "--intensity" in fragility_html(words, [], [], TOLD)


# --- floors --------------------------------------------------------------------------------------


@pytest.mark.parametrize("record", ["MOTION", "SEED"])
def test_floor_spectra_are_fractiles_of_the_runs_by_what_was_set(tmp_path, monkeypatch, record):
    """A number may choose the record, too: PGA stays then, other intensities do not."""
    at = int(record != "MOTION")  # the second footing's
    rng = np.random.default_rng(6)
    rows, spectra = suite(n=5, scales=[2, 1]), rng.lognormal(size=(10, 4))
    for number, row in enumerate(rows):
        row[record], row["PGV"] = row.pop("MOTION"), row["AG"] * (1.0 + number % 5)
        row["PGA"] *= 1.0 + 3e-16 * (number % 2)  # rounding of what scales
    made = sweep_of(tmp_path, rows, ("AG", record), ("drift", "PGA", "PGV"))
    for number, values in enumerate(spectra, 1):
        folder = tmp_path / "runs" / f"r{number}"
        folder.mkdir(parents=True)
        f = [1.0, 2.0, 4.0, 8.0] if number != 3 else [1.0, 2.0, 4.0, 9.0]
        floor = {"floor": 1, "component": "UX", "damping": "5 %", "acceleration": 1.0,
                 "frequency": 1.0, "frequencies": f, "accelerations": values.tolist()}  # fmt: skip
        verdict = {"area": 1.0, "capacity": None, "friction": None, "peaks": {}, "left": {}}
        told = {"version": "", "deck": "", "seconds": 1.0, "files": [], "figures": [],
                "warnings": [], "errors": [],
                "statistics": {"verdicts": [{**verdict, "floors": [floor] * (k == at)}
                                            for k in range(at + 1)]}}  # fmt: skip
        (folder / "summary.json").write_text(json.dumps(told))
    (tmp_path / "runs" / "r10" / "summary.json").write_text("{")
    (chart,) = floor_charts(made, TOLD)
    assert "1 run at other frequencies left out" in chart.title
    assert ("footing 2" in chart.title) == bool(at)
    lines = {line.name: line.y for line in chart.lines}
    assert list(lines) == [
        "AG = 2, median of 4", "AG = 2, 16 %", "AG = 2, 84 %",
        "AG = 1, median of 4", "AG = 1, 16 %", "AG = 1, 84 %",
    ]  # fmt: skip
    kept = spectra[[0, 1, 3, 4]]
    assert lines["AG = 2, median of 4"] == pytest.approx(np.median(kept, axis=0))
    assert lines["AG = 2, 16 %"] == pytest.approx(np.percentile(kept, 16, axis=0))
    monkeypatch.setattr(fragilities, "MOST_SETTINGS", 1)
    (short,) = floor_charts(made, TOLD)
    assert [line.name for line in short.lines] == list(lines)[:3]
    assert short.title == f"{chart.title} (1 more in sweep.csv)"


# --- the command ---------------------------------------------------------------------------------

DECK = """
AG = 1. ; MOTION = 'none' ; A = EXTR (LIRE 'SIGNAL' MOTION 1.) 'ORDO' ;
SORT 'BILA' 'PGA' (AG * (MAXI (ABS A))) ; SORT 'BILA' 'drift' (AG * (SOMM A)) ;
"""


@pytest.fixture
def case(tmp_path):
    """A script, nine records at steps of their own whose sums scatter, and one that is damaged."""
    (tmp_path / "case.ssi").write_text(DECK)
    (tmp_path / "motions").mkdir()
    for i, z in enumerate(stats.norm.ppf((np.arange(9) + 0.5) / 9)):
        step, last = 0.005 * (1 + i % 3), np.exp(0.4 * z)
        rows = [f"{k * step:g};{v:.12g}" for k, v in enumerate([0.0, 1.0, last - 1.0, 0.0])]
        (tmp_path / "motions" / f"m{i}.csv").write_text("\n".join(["t;a", *rows]) + "\n")
    (tmp_path / "motions" / "m9.csv").write_text("t;a\n0;1\n1;x\n0.5;2\n")
    return tmp_path


def run(case, limits, *more, ag="AG=0.6,1,1.6"):
    out, err = io.StringIO(), io.StringIO()
    options = SweepOptions(
        case / "case.ssi", [ag], case / "motions", case / "out", jobs=1,
        fragility=list(limits), intensity=list(more),
    )  # fmt: skip
    return sweep(options, out, err), out.getvalue(), err.getvalue()


@pytest.mark.usefixtures("unsaved")
def test_a_suite_ends_in_its_page_and_other_limits_run_nothing_again(case, capsys):
    code, out, err = run(case, ["drift>1"])
    assert code == 1  # the damaged record's runs
    assert err.count("failed") == 3
    with (case / "out" / "fragility.csv").open(newline="") as file:
        counts = next(csv.DictReader(file, delimiter=";"))
    assert (counts["intensity"], counts["runs"]) == ("PGA", "27")
    assert float(counts["median"]) == pytest.approx(1.0, rel=0.1)
    page = (case / "out" / "report.html").read_text()
    assert "3 runs that failed are left out" in page
    link = re.search(r'27</td><td><a href="(runs/[^"]+)">', page)[1]
    assert (case / "out" / link.replace("%3D", "=")).is_file()
    code, out, err = run(case, ["drift>1.5", "drift<0.7"], "AG")
    assert "27 of 30" in out
    assert "drift grows with AG: drift > 0.7" in err
    assert main(["report", str(case / "out"), "--lang", "fr"]) == 0
    page = (case / "out" / "report.html").read_text()
    assert "maximum de vraisemblance" in page
    assert "drift&nbsp;&gt;&nbsp;1.5" in page
    (case / "out" / "fragility.json").write_text('{"limits": 1, "intensities": []}')
    assert main(["report", str(case / "out")]) == 2
    assert "fragility.json" in capsys.readouterr().err


def test_a_browser_draws_curves_and_clouds(case, browser):
    run(case, ["drift>1", "drift<1"])
    browser.open(case / "out" / "report.html", 900, 900)
    browser.until("!!document.querySelector('#fragility figure.chart').plot")
    drawn = "document.querySelectorAll('#fragility figure.chart canvas').length"
    browser.run("document.querySelector('#fragility figure:last-of-type').scrollIntoView()")
    browser.until(f"{drawn} === document.querySelectorAll('#fragility figure.chart').length")
    labels = "[...document.querySelectorAll('#fragility figure.chart')].map(f =>"
    labels += " f.plot.axes.map(a => a._values.filter(v => v).length))"
    assert all(count >= 2 for axes in browser.run(labels) for count in axes)
    link = browser.run("document.querySelector('#fragility a').href")
    assert link.startswith((case / "out" / "runs").as_uri())
    assert browser.console == []


@pytest.mark.usefixtures("unsaved")
def test_without_limits_nothing_of_an_earlier_command_stays(case):
    run(case, ["drift>1"])
    out, err = io.StringIO(), io.StringIO()
    sweep(
        SweepOptions(case / "case.ssi", ["AG=0.6,1,1.6"], case / "motions", case / "out", jobs=1),
        out,
        err,
    )
    assert not list((case / "out").glob("fragility*"))


def test_unknown_names_are_told_with_the_near_one_after_the_first_run(case):
    code, _, err = run(case, ["drfit>1"], ag="AG=1")
    assert code == 2
    assert (
        err.count("no run has a figure drfit (did you mean drift?)") == 2
    )  # first, and at the end
    assert err.index("drfit") < err.index("run 10 failed")
    assert "(did you mean drift?)" in (case / "out" / "report.html").read_text()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (["--fragility", "drift"], "in quotes"),
        (["--intensity", "PGA"], "goes with --fragility"),
    ],
)
def test_commands_that_cannot_be_are_refused_before_any_run(case, given, said, capsys):
    command = ["sweep", str(case / "case.ssi"), "--set", "AG=1,2", "--out", str(case / "out")]
    assert main([*command, *given]) == 2
    assert said in capsys.readouterr().err
    assert not (case / "out" / "runs").exists()


@pytest.mark.usefixtures("unsaved")
def test_peaks_of_the_verdict_and_floors_are_figures_of_the_table(tmp_path):
    (tmp_path / "strip.ssi").write_text("AG = 1. ;" + VERDICT.replace("(5.E5 0.)", "(AG 0.)"))
    options = SweepOptions(
        tmp_path / "strip.ssi", ["AG=2.E5,5.E5,3.E5,4.E5"], out=tmp_path / "out", jobs=1,
        fragility=["PART<0.7", "PLANCHER_1>6"],
    )  # fmt: skip
    err = io.StringIO()
    assert sweep(options, io.StringIO(), err) == 0, err.getvalue()
    with (tmp_path / "out" / "sweep.csv").open(newline="") as file:
        rows = list(csv.DictReader(file, delimiter=";"))
    for row in rows:
        path = tmp_path / "out" / "runs" / row["folder"] / "summary.json"
        (verdict,) = json.loads(path.read_text())["statistics"]["verdicts"]
        for name, peak in verdict["peaks"].items():
            assert float(row[name]) == peak["value"]
        (floor,) = verdict["floors"]
        assert float(row["PLANCHER_1"]) == pytest.approx(floor["accelerations"][-1], rel=0.2)
    parts = [float(r["PART"]) for r in sorted(rows, key=lambda r: float(r["AG"]))]
    assert parts == sorted(parts, reverse=True)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "PART&nbsp;&lt;&nbsp;0.7" in page
    charts = json.loads(re.search(r'id="data-charts">(.*?)</script>', page, re.DOTALL)[1])
    assert any(c["title"].startswith("floor 1, UX") for c in charts)
