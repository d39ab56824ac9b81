"""The numbers of pages are those of the runs: every cell and curve of made-up results.

No two values are alike, nothing is in order, and there are two of everything.
"""

import base64
import json
import re
import zlib
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyvista

from ssilang.messages.message import teller
from ssilang.report.charts import charts_of
from ssilang.report.html import deck_html
from ssilang.report.page import page_of
from ssilang.report.results import Calculation, Results
from ssilang.report.scenes import packed_scene
from ssilang.report.sweep_page import sweep_page
from ssilang.report.sweep_table import Sweep, read_sweep

TOLD = teller("en")
TIME = np.array([0.0, 0.5, 1.5, 4.0])


class Tables(HTMLParser):
    """Texts of the cells of each section's tables, row by row; links as [text](address)."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.rows: dict[str, list[list[str]]] = {}
        self.numbers: dict[str, list[int]] = {}
        self._now, self._in = "", False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        if tag in ("section", "header"):
            self._now = told.get("id") or tag
        if tag == "tr":
            self.rows.setdefault(self._now, []).append([])
        if tag in ("th", "td"):
            self._in = True
            row = self.rows[self._now][-1]
            if told.get("class") == "number" and tag == "th":
                self.numbers.setdefault(self._now, []).append(len(row))
            row.append("")
        if tag == "a" and self._in:
            self.rows[self._now][-1][-1] += f"({told['href']})"

    def handle_endtag(self, tag: str) -> None:
        self._in = self._in and tag not in ("th", "td")

    def handle_data(self, data: str) -> None:
        if self._in:
            self.rows[self._now][-1][-1] += data


def _footings(shift: float) -> dict[str, Any]:
    """Histories of two footings, the second on pairs of nodes and without a pressure."""
    names = ["share_1", "pressure_1", "opening_1", "force_1", "rotation_z_1", "moment_z_1"]
    names += ["share_2", "opening_2", "force_2", "rotation_x_2", "moment_x_2", "rotation_y_2"]
    names += ["moment_y_2", "pressure_2", "CINETIQUE", "ELASTIQUE", "DISSIPEE", "ECART"]
    rng = np.random.default_rng(int(shift))
    columns = {"time": TIME + shift} | {n: rng.normal(size=4).cumsum() for n in names}
    columns["share_1"] = np.array([0.9, 0.25, 0.5, 0.75]) - 0.01 * shift
    columns["share_2"] = np.array([1.0, 0.75, 0.35, 0.6])
    columns["DISSIPEE"] *= 0.0  # nothing is lost: no curve
    return columns


def _results(folder: Path) -> Results:
    footings = [{"kind": "cells", "axes": ["z"]}, {"kind": "pairs", "axes": ["x", "y"]}]
    peaks = [
        {"kind": "DEPL", "component": "UX", "value": 0.125, "time": 1.5, "place": [3.0, -1.0]},
        {"kind": "OUVERTURE", "component": "", "value": 7.5, "time": 0.5, "place": [1.0, 2.0]},
        {"kind": "DEPL", "component": "UY", "value": 0.0, "time": 0.0, "place": [0.0, 0.0]},
    ]
    runs = [
        {"procedure": "DYNAMIC", "unknowns": 10, "interface_unknowns": 4, "steps": 30,
         "method": "m1", "solver": "s1", "most_interface_iterations": 5, "seconds": 0.5,
         "energy_imbalance": 0.02, "energy_imbalance_from": 1.0},
        {"procedure": "PASAPAS", "unknowns": 11, "steps": 2, "seconds": 0.25, "static": True,
         "energy_imbalance": 0.5, "energy_imbalance_from": 1.0},
    ]  # fmt: skip
    figures = [
        {"name": "b", "value": 2.5, "expected": 2.0, "tolerance": 2.0, "ok": True},
        {"name": "a", "value": 9.0, "expected": 4.0, "tolerance": 1.0, "ok": False},
        {"name": "c", "value": 3.0, "expected": None, "tolerance": None, "ok": None},
    ]
    summary = {
        "exit_code": 0, "version": "1.2", "statements": 17, "peak_memory_mb": 41, "seconds": 3.25,
        "units": {"system": "KN-M", "length": "m", "force": "kN"}, "figures": figures,
        "statistics": {"calculations": runs}, "errors": [],
        "warnings": [{"line": 3, "text": "w3"}, {"line": None, "text": "w"}],
        "files": [{"path": "z.csv", "bytes": 2500}, {"path": "a.png", "bytes": 700}],
    }  # fmt: skip
    tables = {
        "t.csv": {"TEMP": TIME, "UY_2": 3.0 * TIME, "UX_1": TIME - 1.0, "UX 4": -TIME},
        "s.csv": {"Q": -TIME, "V": TIME**2},
    }
    drawings = [
        {"title": "", "files": ["p.png"], "x": "X", "y": "Y", "log": [False, True],
         "curves": [{"name": "", "x": [2.0, 1.0], "y": [None, 5.0]},
                    {"name": "n", "x": [0.0], "y": [6.0]}]},
        {"title": "none", "files": [], "x": "", "y": "", "log": [False, False], "curves": []},
    ]  # fmt: skip
    calculations = [
        Calculation("DYNAMIC", _footings(1.0), footings, 2, peaks, None),
        Calculation("PASAPAS", _footings(2.0), footings[:1], 1, peaks[:1], None),
        Calculation("SHORT", {"time": TIME[:1]}, [], 0, [], None),
    ]
    left = {"calculations": 3, "drawings": 4}
    return Results(
        folder, summary, "/x/d.ssi", "A = 1 ;\n* <b> ;", True, calculations, drawings,
        tables=tables, left_out=left, unread=["bad.csv"],
    )  # fmt: skip


def test_curves_hold_the_histories_of_each_footing_and_table(tmp_path):
    results = _results(tmp_path)
    first, second = (c.columns for c in results.calculations[:2])
    found = {(c.group, c.title): c for c in charts_of(results, TOLD)}
    wanted: dict[tuple[str, str], tuple[Any, ...]] = {}

    def footing(title: str, x: str, y: str, *lines: tuple[str, Any, Any]) -> None:
        wanted["footing", title] = (x, y, *lines)

    for name, c, k in (("DYNAMIC 1", first, 1), ("DYNAMIC 1", first, 2), ("PASAPAS 2", second, 1)):
        on = f"{name} · footing {k}" if name == "DYNAMIC 1" else name
        t = c["time"]
        force = ("largest force of a joint", "kN") if k == 2 else ("toe pressure (largest)", "kPa")
        for key, title, unit, scale in (
            ("share", "share in contact", "%", 100.0), ("pressure", *force, 1.0),
            ("opening", "largest opening", "m", 1.0),
            ("force", "normal force on the soil", "kN", 1.0),
        ):  # fmt: skip
            line = (title, t, scale * c[f"{key}_{k}"])
            footing(f"{title} · {on}", "time (s)", f"{title} ({unit})", line)
        axes = "xy" if k == 2 else "z"
        turns = [(f"about {a}", c[f"rotation_{a}_{k}"]) for a in axes]
        loops = [(n, x, c[f"moment_{n[-1]}_{k}"]) for n, x in turns]
        footing(f"moment against rotation · {on}", "rotation (rad)", "moment (kN.m)", *loops)
        footing(f"rotation · {on}", "time (s)", "rotation (rad)", *((n, t, x) for n, x in turns))
    for name, c in (("DYNAMIC 1", first), ("PASAPAS 2", second)):
        words = {"kinetic": "CINETIQUE", "elastic": "ELASTIQUE", "imbalance": "ECART"}
        lines = [(n, c["time"], c[w]) for n, w in words.items()]
        wanted["energy", f"energies · {name}"] = ("time (s)", "energy (kJ)", *lines)
    wanted["curves", "p.png"] = ("X", "Y", ("1", [2, 1], [np.nan, 5]), ("n", [0], [6]))
    wanted["tables", "t.csv: UY"] = ("TEMP", "UY", ("UY_2", TIME, 3.0 * TIME))
    wanted["tables", "t.csv: UX"] = (
        "TEMP", "UX", ("UX_1", TIME, TIME - 1.0), ("UX 4", TIME, -TIME),
    )  # fmt: skip
    wanted["tables", "s.csv: V"] = ("Q", "V", ("V", -TIME, TIME**2))
    assert set(found) == set(wanted)
    for key, (x, y, *lines) in wanted.items():
        chart = found[key]
        assert (chart.x, chart.y) == (x, y), key
        assert [line.name for line in chart.lines] == [name for name, _, _ in lines], key
        for line, (_, a, b) in zip(chart.lines, lines, strict=True):
            np.testing.assert_array_equal(line.x, a, str(key))
            np.testing.assert_array_equal(line.y, b, str(key))
        assert chart.told()["loop"] == (
            "moment against" in key[1] or key[1] in ("p.png", "s.csv: V")
        )
    assert found["curves", "p.png"].told()["lines"][0]["y"] == [None, 5.0]
    assert found["curves", "p.png"].log == (False, True)


def test_tables_and_cards_hold_what_the_summary_holds(tmp_path):
    page = page_of(_results(tmp_path), "en", lambda text: [])
    rows = Tables(page).rows
    assert rows["checks"][1:] == [
        ["b", "2.5", "2", "2", " 25 %", "held"], ["a", "9", "4", "1", " 500 %", "missed"],
        ["c", "3", "", "", "", ""],
    ]  # fmt: skip
    assert rows["largest"][1:] == [
        ["DYNAMIC 1", "opening of joints", "7.5", "0.5", "1 2"],
        ["DYNAMIC 1", "displacement UX", "0.125", "1.5", "3 -1"],
        ["PASAPAS 2", "displacement UX", "0.125", "1.5", "3 -1"],
    ]
    assert rows["runs"][1:] == [
        ["DYNAMIC 1", "10", "4", "30", "m1", "s1", "5", "0.02", "0.5"],
        ["PASAPAS 2", "11", "", "2", "", "", "", "0.5", "0.25"],
    ]
    assert Tables(page).numbers["runs"] == [1, 2, 3, 6, 7, 8]
    head = page[page.index("<header>") : page.index("</header>")]
    cards = re.findall(r'<li class="(\w*)"><b>(.*?)</b> <span>(.*?)</span>', head)
    both = [c.columns for c in _results(tmp_path).calculations[:2]]
    opening = max(7.5, *(c[f"opening_{k}"].max() for c in both for k in (1, 2)))
    assert cards == [
        ("bad", "1 / 2", "checks within tolerance"), ("warn", "2 %", "energy imbalance"),
        ("", f"{opening:.4g} m", "largest opening"), ("", "23 %", "least share in contact"),
        ("warn", "2", "warnings"), ("", "3.25 s", "duration"),
    ]  # fmt: skip
    for part in (
        "d.ssi</h1>", "17 statements", "41 MB", "KN-M: m, kN", "3 smaller footings", "bad.csv",
        "3 further calculations, 4 further pictures",
    ):  # fmt: skip
        assert part in head, part
    assert "2.5 kB" in page
    assert "0.7 kB" in page


def test_pictures_are_held_as_long_as_there_is_room(tmp_path, monkeypatch):
    monkeypatch.setattr("ssilang.report.page.PICTURES", 10)
    results = _results(tmp_path)
    results.pictures[:] = [tmp_path / f"{n}.png" for n in ("b", "a", "gone", "e", "c")]
    for name, size in (("b", 6), ("a", 5), ("e", 0), ("c", 4)):
        (tmp_path / f"{name}.png").write_bytes(name.encode() * size)
    page = page_of(results, "en", lambda text: [])
    held = re.findall('<img alt="(.*?)" src="data:image/png;base64,(.*?)">', page)
    assert [(n, base64.b64decode(d)) for n, d in held] == [("b.png", b"bbbbbb"), ("c.png", b"cccc")]
    assert TOLD("report.pictures-left", count=3) in page


def test_a_deck_is_shown_as_it_is_written():
    deck = "A = 1 ;\n* <b>\n\nTITR 'two\nlines' ;"
    at = deck.index("'two")
    spans = [(8, 13, "c"), (9, 10, "inside"), (at, len(deck) - 2, "s")]
    lines = re.findall(
        r'<li id="line-(\d+)"(.*?)><code>(.*?)</code>', deck_html(deck, lambda t: spans, [3])
    )
    assert [n for n, _, _ in lines] == ["1", "2", "3", "4", "5"]
    assert [n for n, wrong, _ in lines if wrong] == ["3"]
    assert [code for _, _, code in lines] == [
        "A = 1 ;", '<i class="c">* &lt;b&gt;</i>', " ", 'TITR <i class="s">\'two</i>',
        "<i class=\"s\">lines'</i> ;",
    ]  # fmt: skip
    assert deck_html("A\n" * 20_001, lambda t: []).count("<li") == 20_000


SWEPT = """run;ZED;AMP;exit_code;top;drift;seconds;error;folder
1;4;x;0;40;0.5;1.5;;z4
2;4;y;0;41;;0.25;;no
3;-1;x;0;10;0.75;2;;z1
4;2;x;3;;;0.5;too <b>;z2
5;-1;y;0;11;0.25;1;;a/b
"""


@pytest.fixture
def swept(tmp_path: Path) -> Sweep:
    (tmp_path / "sweep.csv").write_text(SWEPT)
    for name, file in (
        ("z4", "report.html"),
        ("z1", "output.txt"),
        ("a", "x"),
        ("z2", "report.html"),
    ):
        (tmp_path / "runs" / name).mkdir(parents=True)
        (tmp_path / "runs" / name / file).write_text("")
    (tmp_path / "histories").mkdir()
    for name in ("b.csv", "a c.csv"):
        (tmp_path / "histories" / name).write_text("x" * (1500 if name == "b.csv" else 20))
    return read_sweep(tmp_path)


def test_a_sweep_shows_each_run_under_its_heads(swept):
    """Names out of order of the alphabet, values out of order, a run that failed."""
    page = sweep_page(swept, "en")
    found = Tables(page)
    head, *rows = found.rows["sweep"]
    assert head[:5] == ["", "ZED", "AMP", "top", "drift"]
    assert rows == [
        ["(runs/z4/report.html)1", "4", "x", "40", "0.5", "1.5", ""],
        ["2", "4", "y", "41", "", "0.25", ""],
        ["(runs/z1/output.txt)3", "-1", "x", "10", "0.75", "2", ""],
        ["(runs/z2/report.html)4", "2", "x", "", "", "0.5", "too <b>"],
        ["5", "-1", "y", "11", "0.25", "1", ""],
    ]
    assert found.numbers["sweep"] == [0, 1, 2, 3, 4, 5]
    assert found.rows["histories"][1:] == [
        ["(histories/a%20c.csv)a c.csv", "0.0 kB"], ["(histories/b.csv)b.csv", "1.5 kB"],
    ]  # fmt: skip
    charts = json.loads(re.search(r'id="data-charts">(.*?)</script>', page, re.DOTALL)[1])  # type: ignore[index]
    shown = [
        (c["title"], c["x"], [(n["name"], n["x"], n["y"]) for n in c["lines"]]) for c in charts
    ]
    assert shown == [
        ("top", "ZED", [("AMP = x", [-1, 4], [10, 40]), ("AMP = y", [-1, 4], [11, 41])]),
        ("drift", "ZED", [("AMP = x", [-1, 4], [0.75, 0.5]), ("AMP = y", [-1], [0.25])]),
    ]
    cards = re.findall(r"<li><b>(.*?)</b> <span>(.*?)</span>", page)
    assert [v for v, _ in cards] == ["5", "-1 … 4", "2", "5.25 s"]
    assert "1 run failed" in page


def test_a_scene_holds_every_kind_of_cell_and_all_instants(tmp_path):
    """Bars, triangles, a quadrangle, a lone point and joints of two and four nodes on a side."""
    points = np.random.default_rng(3).normal(size=(24, 3))
    bar, line_joint = [0, 1], [2, 3, 4, 5]
    cells = {
        "vertex": [6], "line": bar, "triangle": [7, 8, 9], "quad": [10, 11, 12, 13],
        "next": [11, 22, 23, 12],
        "line_joint": line_joint, "solid_joint": [14, 15, 16, 17, 18, 19, 20, 21],
    }  # fmt: skip
    kinds = [1, 3, 5, 9, 9, 9, 12]
    flat = np.concatenate([[len(c), *c] for c in cells.values()])
    opening = np.array([np.nan] * 5 + [0.25, -0.5])
    stress = np.random.default_rng(4).normal(size=(7, 6))
    stress[:2], stress[2, 3], stress[5:] = np.nan, np.nan, np.nan  # one component misses in a cell
    frames = []
    for step in range(3):
        grid = pyvista.UnstructuredGrid(flat, kinds, points)
        grid.point_data["displacement"] = (step + 1.0) * points[:, ::-1]
        grid.cell_data["opening"] = (step + 1.0) * opening
        grid.cell_data["stress"] = (step - 1.0) * stress
        grid.cell_data["traction"] = np.stack([-3.0 * (step + 1.0) * opening] * 3, axis=1) * [
            1.0,
            7.0,
            9.0,
        ]
        grid.save(tmp_path / f"s{step}.vtu")
        frames.append(f'<DataSet timestep="{0.5 * step * step}" file="s{step}.vtu"/>')
    pvd = tmp_path / "s.pvd"
    pvd.write_text(
        '<?xml version="1.0"?><VTKFile type="Collection" version="0.1"><Collection>'
        + "".join(frames[::-1]) + "</Collection></VTKFile>"
    )  # fmt: skip
    told, packed = packed_scene(pvd, 10**6)
    blob = zlib.decompress(base64.b64decode(packed))

    def array(name: str, kind: str) -> Any:
        at, size = told["arrays"][name]
        return np.frombuffer(blob, kind, size, at)

    assert told["times"] == [0.0, 0.5, 2.0]
    assert not told["flat"]
    place = array("points", "<f4").reshape(-1, 3)
    node = [int(np.argmin(np.abs(points - p).sum(axis=1))) for p in place]
    joint = array("joint_points", "<u4")

    def sets(name: str, size: int, through: Any = None) -> list[tuple[int, ...]]:
        rows = array(name, "<u4")
        rows = rows if through is None else through[rows]
        return sorted(tuple(sorted(node[i] for i in row)) for row in rows.reshape(-1, size))

    assert sets("vertices", 1) == [(6,)]
    assert sets("lines", 2) == [(0, 1)]
    triangles = sets("triangles", 3)
    assert triangles[0] == (7, 8, 9)
    assert sorted({n for t in triangles[1:] for n in t}) == [10, 11, 12, 13, 22, 23]
    assert len(triangles) == 5
    assert sets("edges", 2) == [
        (7, 8), (7, 9), (8, 9), (10, 11), (10, 13), (11, 12), (11, 22), (12, 13), (12, 23),
        (22, 23),
    ]  # fmt: skip
    assert [node[i] for i in joint] == [2, 3, 14, 15, 16, 17]
    assert sets("joint_lines", 2, joint) == [(2, 3)]
    assert sets("joint_triangles", 3, joint) == [(14, 15, 16), (14, 16, 17)]
    values = {}
    for field in told["fields"]:
        kept = array(f"field:{field['name']}", "<i2").reshape(3, -1)
        numbers = np.cumsum(kept, axis=0, dtype=np.int16)
        values[field["name"]] = np.where(numbers == -32768, np.nan, numbers * field["scale"])
    means = np.full((24, 6), np.nan)
    means[[10, 13]], means[[22, 23]] = stress[3], stress[4]
    means[[11, 12]] = 0.5 * (stress[3] + stress[4])
    x, y, z, xy, yz, xz = means[node].T
    tensors = np.moveaxis(np.array([[x, xy, xz], [xy, y, yz], [xz, yz, z]]), -1, 0)
    rest = tensors - np.trace(tensors, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3.0
    mises = np.sqrt(1.5 * (rest**2).sum(axis=(1, 2)))
    np.testing.assert_allclose(values["stress_vertical"], [-z, 0.0 * z, z], atol=1e-3)
    np.testing.assert_allclose(values["stress_mises"], [mises, 0.0 * z, mises], atol=1e-3)
    moved = values["displacement"].reshape(3, -1, 3)
    for step in range(3):
        np.testing.assert_allclose(moved[step], (step + 1) * place[:, ::-1], atol=1e-3)
        for name, factor in (("opening", 1.0), ("pressure", 3.0)):
            want = factor * (step + 1) * np.repeat([0.25, -0.5], [2, 4])
            np.testing.assert_allclose(values[name][step], want, atol=1e-3)
    fields = {f["name"]: (f["low"], f["high"]) for f in told["fields"]}
    assert fields["opening"] == (-1.5, 0.75)
    for step in range(3):  # components that are none of a tensor's six are not shown
        grid.cell_data["stress"] = np.zeros((7, 3))
        grid.save(tmp_path / f"s{step}.vtu")
    assert [f["name"] for f in packed_scene(pvd, 10**6)[0]["fields"]] == [
        n for n in fields if "stress" not in n
    ]
