"""The table of a sweep, its joined histories, its processes: names and types in no order."""

import csv
import json
import os

import pyarrow as pa
import pyarrow.parquet as pq
from together import together

from ssilang.cli.sweeping import pool, table
from ssilang.cli.sweeping.histories import join_histories
from ssilang.cli.sweeping.pool import elsewhere
from ssilang.io.plots import figure
from ssilang.io.plots.graphs import curves

ROWS = [
    {"run": 1, "ZED": 4, "AMP": "x;y", "exit_code": 0, "top": 1.5, "n": 3, "MOTION": "/a/q.txt"},
    {"run": 2, "ZED": -1, "AMP": 2, "exit_code": 1, "late": None, "n": 2.5, "MOTION": "b.at2"},
    {"run": 3, "ZED": 2, "AMP": "x;y", "exit_code": 0, "top": 0.5, "late": 7, "MOTION": "/a/q.txt"},
]
NAMES = ["run", "ZED", "AMP", "exit_code", "top", "n", "MOTION", "late"]


def test_columns_stand_under_their_heads(tmp_path):
    assert table.columns_of(ROWS) == NAMES
    table.write_table(ROWS, tmp_path / "t.parquet")
    found = pq.read_table(tmp_path / "t.parquet")
    assert found.column_names == NAMES
    assert found.to_pydict() == {
        "run": [1, 2, 3], "ZED": [4, -1, 2], "AMP": ["x;y", "2", "x;y"], "exit_code": [0, 1, 0],
        "top": [1.5, None, 0.5], "n": [3.0, 2.5, None], "late": [None, None, 7],
        "MOTION": ["/a/q.txt", "b.at2", "/a/q.txt"],
    }  # fmt: skip
    table.write_plain_table(ROWS, tmp_path / "t.csv")
    assert (tmp_path / "t.csv").read_text() == (
        "run;ZED;AMP;exit_code;top;n;MOTION;late\n"
        '1;4;"x;y";0;1.5;3;/a/q.txt;\n2;-1;2;1;;2.5;b.at2;\n3;2;"x;y";0;0.5;;/a/q.txt;7\n'
    )


@together("off, idle", [(0.0, ["H"]), (1e-12, ["H"]), (1e-7, [])])
def test_figures_that_differ_by_rounding_depend_on_nothing(off, idle):
    rows = [
        {"run": k, "H": h, "A": a, "exit_code": 0, "drift": 0.026589610919016 * a * (1 + off * h)}
        for k, (h, a) in enumerate((h, a) for h in (5.0, 10.0, 20.0) for a in (1.0, 2.0))
    ]
    assert table.idle_names(rows, ["H", "A"]) == idle


@together("swept", [("MOTION", "ZED", "AMP"), ("AMP", "ZED", "MOTION"), ("AMP",)])
def test_pictures_have_a_curve_a_combination_in_the_order_of_the_axis(swept, tmp_path, monkeypatch):
    drawn = {}

    def draw(curve, options):
        drawn[curve.title] = (options.x_title, options.y_title, [
            (p.legend, p.abscissas.tolist(), p.ordinates.tolist()) for p in curve.parts
        ])  # fmt: skip
        return curve.title

    monkeypatch.setattr(curves, "draw_curves", draw)
    monkeypatch.setattr(figure, "save_figure", lambda made, path: path)
    paths = table.draw_figures(ROWS, swept, tmp_path)
    if "ZED" not in swept:  # nothing that is a number was swept
        assert paths == []
        return
    others = [n for n in swept if n != "ZED"]
    label = ", ".join("q" if n == "MOTION" else "AMP = x;y" for n in others)
    assert drawn["top"] == ("ZED", "top", [(label, [2, 4], [0.5, 1.5])])
    assert drawn["late"] == ("ZED", "late", [(label, [2], [7])])
    assert drawn["n"][2][0] == (label, [4], [3])
    assert drawn["n"][2][1][1:] == ([-1], [2.5])
    assert list(drawn) == ["top", "n", "late"]
    assert [p.name for p in paths] == ["top.png", "n.png", "late.png"]


SWEPT = ("ZETA", "MU", "ALFA", "CAS", "FLAG")  # neither sorted nor of one kind
VALUES = [(2, 3, "dense", 7, True), (0.5, -1, "1", 8, False), (9.0, 0, "x", 9, True)]
HISTORY = {"time": [0.0, 0.1, 0.3], "MU": [1.5, -2.5, 4.0], "b": [7.0, 8.0, 9.0]}


def rows_in(folder, suffix):
    """Three runs that wrote a table, one that failed, one whose columns are others."""
    rows = []
    for i, values in enumerate([*VALUES, VALUES[0], VALUES[1]]):
        run = folder / "runs" / f"r{i}"
        run.mkdir(parents=True)
        columns = {k: [10.0 * i + x for x in v] for k, v in HISTORY.items()}
        if i == 4:
            columns["c"] = columns.pop("b")
        if suffix == "csv":
            lines = [list(columns), *zip(*columns.values(), strict=True)]
            (run / "h.csv").write_text("\n".join(";".join(map(str, x)) for x in lines) + "\n")
        else:
            pq.write_table(pa.table(columns), run / "h.parquet")
        (run / "summary.json").write_text(json.dumps({"files": [{"path": f"h.{suffix}"}]}))
        named = dict(zip(SWEPT, values, strict=True))
        rows.append({"run": i + 1, "folder": run.name, "exit_code": int(i == 3), **named})
    return rows


@together("suffix", ["csv", "parquet"])
def test_swept_values_stand_under_their_own_names(tmp_path, suffix):
    joined = join_histories(rows_in(tmp_path, suffix), SWEPT, tmp_path)
    (path,) = joined.files
    assert (path, joined.others) == (tmp_path / "histories" / f"h.{suffix}", 1)
    if suffix == "csv":
        with path.open() as stream:
            found = list(csv.DictReader(stream, delimiter=";"))
    else:
        found = pq.read_table(path).to_pylist()
    assert len(found) == 9
    for i, values in enumerate(VALUES):
        for k in range(3):
            row = found[3 * i + k]
            given = {"run": i + 1, **dict(zip(SWEPT, values, strict=True))}
            given["MU (sweep)"] = given.pop("MU")
            own = {name: 10.0 * i + HISTORY[name][k] for name in HISTORY}
            assert set(row) == {*given, *own}
            for name, value in (given | own).items():
                if isinstance(value, bool):
                    assert row[name] in (value, "VRAI" if value else "FAUX"), name
                elif name == "ALFA":
                    assert row[name] == value
                else:
                    assert float(row[name]) == value, name


@together("before", [None, "0", "yes"])
def test_processes_import_nothing_from_the_working_folder(before, monkeypatch):
    name = "PYTHONSAFEPATH"
    monkeypatch.delenv(name, raising=False)
    if before is not None:
        monkeypatch.setenv(name, before)
    with elsewhere():
        assert os.environ[name] == "1"
    assert os.environ.get(name) == before


@together(
    "tasks, forks, way", [(7, True, "run_here"), (8, True, "run_grown"), (9, False, "run_here")]
)
def test_the_others_wait_for_the_first_run_where_they_are_many(tasks, forks, way, monkeypatch):
    asked = []
    for name in ("run_here", "run_grown"):
        monkeypatch.setattr(pool, name, lambda *given, name=name: asked.append((name, *given)))
    monkeypatch.setattr(pool, "CAN_FORK", forks)
    pool.run_all(range(tasks), 2, str)
    assert asked == [(way, range(tasks), 2, str)]
