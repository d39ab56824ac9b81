"""The table of a sweep as a page reads it, and the marks of a verdict's figures."""

import re

from refusing import refusal
from together import together

from ssilang.io.errors import InputError
from ssilang.report.sweep_table import is_sweep, link_to, read_sweep, real, short
from ssilang.report.verdict import is_endless, verdict_html

TITLES = "run;ZED;AMP;exit_code;seconds;error;folder;top;late"


@together("turned", [False, True])
def test_columns_by_their_titles(tmp_path, turned):
    rows = ["1;4;x;0;0.5;;a;1.5;", '2;-1;"y;z";1;2;broken;b;;7;beyond', "3;2"]
    lines = [TITLES, *(reversed(rows) if turned else rows)]
    (tmp_path / "sweep.csv").write_text("\n".join(lines) + "\n")
    assert not is_sweep(tmp_path)
    (tmp_path / "runs").mkdir()
    assert is_sweep(tmp_path)
    sweep = read_sweep(tmp_path)
    assert (sweep.swept, sweep.figures) == (["ZED", "AMP"], ["top", "late"])
    by_run = {r["run"]: r for r in sweep.rows}
    assert [r["run"] for r in sweep.rows] == (["3", "2", "1"] if turned else ["1", "2", "3"])
    assert [by_run[n]["AMP"] for n in "123"] == ["x", "y;z", ""]
    assert [by_run[n]["late"] for n in "123"] == ["", "7", ""]
    assert set(by_run["3"]) == set(TITLES.split(";"))


@together(
    "text, code",
    [
        (TITLES, "report.not-a-sweep"),
        (TITLES.replace("folder;", "") + "\n1;2\n", "report.not-a-sweep"),
        (TITLES.replace("run;", "") + "\n1;2\n", "report.not-a-sweep"),
        (None, "report.damaged"),
    ],
)
def test_a_table_that_is_none(tmp_path, text, code):
    if text is not None:
        (tmp_path / "sweep.csv").write_text(text)
    with refusal(InputError, code):
        read_sweep(tmp_path)


def test_pages_of_runs_and_values_as_they_are_shown(tmp_path):
    for name in (
        "runs/A=1_é/output.txt",
        "runs/B/report.html",
        "runs/B/output.txt",
        "x/output.txt",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert [link_to(tmp_path, n) for n in ("B", "A=1_é", "none", "", "../x")] == [
        "runs/B/report.html", "runs/A%3D1_%C3%A9/output.txt", "", "", ""
    ]  # fmt: skip
    assert [short(v) for v in ("/a/b.AT2", "0.5", "c.txt")] == ["b.AT2", "0.5", "c.txt"]
    assert [real(v) for v in ("-1.5e3", "", "nan", "inf", "x")] == [-1500.0, *[None] * 4]


def _told(code, **data):
    return code + "".join(f"/{v}" for v in data.values())


def _verdict(scale, **more):
    peaks = {"RENVERSEMENT": 0.9, "TAUX": 0.9, "PART": 0.25, "GLISSEMENT": 1500.0, "MOMENT": None}
    return {
        "peaks": {n: {"value": v and v * scale, "time": i + 0.5}
                  for i, (n, v) in enumerate(peaks.items())},
        "left": {"ROTATION": 0.125, "ENFONCEMENT": -0.25}, "area": 12.5, "capacity": None,
        "friction": 0.75, "floors": [], **more,
    }  # fmt: skip


def _rows(html):
    found = [re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", r) for r in re.findall(r"<tr>.*?</tr>", html)]
    return {cells[0]: cells[1:] for cells in found if cells}


class _Results:
    def __init__(self, *verdicts):
        self.summary = {"statistics": {"verdicts": list(verdicts)}}


@together("scale, turning, use", [(1, "bad", "good"), (1.2, "good", "bad")])
def test_figures_stand_beside_their_words_and_are_marked_by_their_limit(scale, turning, use):
    rows = _rows(verdict_html(_Results(_verdict(scale)), [], _told))
    assert f'class="{turning}"' in rows["stdlib.bilanssi-renversement"][0]
    assert f'class="{use}"' in rows["stdlib.bilanssi-taux"][0]
    assert rows["stdlib.bilanssi-glissement"][1] == "3.5"
    sliding = rows["stdlib.bilanssi-glissement"][0]
    assert sliding == '<b class="good">> 1000</b>'
    assert rows["stdlib.bilanssi-part"] == [f"{0.25 * scale:g}", "2.5"]
    assert rows["stdlib.bilanssi-left-rotation"][0] == "0.125"
    assert rows["stdlib.bilanssi-left-enfoncement"][0].lstrip("-\u2212") == "0.25"
    assert (rows["report.area"][0], rows["report.friction"][0]) == ("12.5", "0.75")
    assert "report.capacity" not in rows


def test_two_footings_are_numbered_and_floors_have_their_own_columns():
    floors = [
        {"floor": 3, "component": "UZ", "damping": "0.05", "acceleration": 7.5, "frequency": 2.5},
        {"floor": 1, "component": "UX", "damping": "0.02", "acceleration": 1.5, "frequency": 8.5},
    ]
    html = verdict_html(_Results(_verdict(1), _verdict(1, floors=floors)), [], _told)
    assert re.findall(r"<h3>(.*?)</h3>", html) == [
        "report.footing-number/1", "report.footing-number/2"
    ]  # fmt: skip
    rows = _rows(html)
    assert rows["report.floor-head"] == [
        "report.component", "report.damping", "report.acceleration", "report.frequency"
    ]  # fmt: skip
    assert (rows["3"], rows["1"]) == (["UZ", "0.05", "7.5", "2.5"], ["UX", "0.02", "1.5", "8.5"])
    assert "<h3>" not in verdict_html(_Results(_verdict(1)), [], _told)


@together(
    "name, value, endless",
    [
        ("GLISSEMENT_2", 1000.0, True),
        ("RENVERSEMENT", 999.0, False),
        ("TAUX", 2000.0, False),
        ("RENVERSEMENT_12", 5000.0, True),
        ("MOMENT", 1e9, False),
    ],
)
def test_factors_cut_at_their_top(name, value, endless):
    assert is_endless(name, value) is endless
