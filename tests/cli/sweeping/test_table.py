"""The table of a sweep: names out of order, values that runs do not have, types that differ."""

import pyarrow.parquet as pq
from together import together

from ssilang.cli.sweeping import table
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
