"""What a run takes down for its report: what is kept of long curves, what is only counted."""

import json

import numpy as np
import pytest

from ssilang.io import recording
from ssilang.io.recording import Recording, thinned_drawing


def test_long_curves_keep_their_extremes_and_ends(monkeypatch):
    monkeypatch.setattr(recording, "MOST_POINTS", 20)
    x = np.linspace(-3.0, 7.0, 101)
    y = np.sin(3 * x) + x
    y[[37, 64]] = -50.0, 90.0
    y[[12, 13]] = np.nan
    made = thinned_drawing(
        {"title": "t"}, [{"name": "b", "x": x, "y": y}, {"name": "a", "x": x[:3], "y": y[:3]}]
    )
    long, short = made["curves"]
    assert (made["title"], long["name"], short["name"]) == ("t", "b", "a")
    assert short["x"] == pytest.approx(x[:3], rel=1e-6)
    assert short["y"] == pytest.approx(y[:3], rel=1e-6)
    assert len(long["x"]) <= 22
    assert (long["x"][0], long["x"][-1]) == (-3.0, 7.0)
    places = [int(np.argmin(abs(x - v))) for v in long["x"]]
    assert places == sorted(set(places))
    assert [v for v in long["y"] if v is not None] == pytest.approx(y[places], rel=1e-6)
    for edge in range(10):  # ten equal stretches: each has its lowest and highest point
        at = slice(edge * 101 // 10, (edge + 1) * 101 // 10)
        for extreme in (np.nanmin(y[at]), np.nanmax(y[at])):
            assert extreme == pytest.approx(
                min(long["y"], key=lambda v: abs(v - extreme)), rel=1e-6
            )


def test_a_curve_as_long_as_allowed_stays_whole(monkeypatch):
    monkeypatch.setattr(recording, "MOST_POINTS", 5)
    y = np.array([1.0, np.inf, -2.0, np.nan, 1 / 3])
    (curve,) = thinned_drawing({}, [{"x": np.arange(5), "y": y}])["curves"]
    assert curve == {"x": [0, 1, 2, 3, 4], "y": [1.0, None, -2.0, None, 0.3333333]}


def test_what_is_beyond_the_most_is_counted(tmp_path, monkeypatch):
    for name, most in (("MOST_CALCULATIONS", 2), ("MOST_DRAWINGS", 3), ("MOST_VERDICTS", 1)):
        monkeypatch.setattr(recording, name, most)
    made = Recording(tmp_path, {"name": "deck", "text": "é ;"})
    taken = []
    for i in range(5):
        taken.append(made.takes_more)
        if taken[-1]:
            made.table({"t": np.array([0.0, i]), "b": np.array([1 / 3, -2e-30])})
            made.calculations.append({"number": i})
        made.draw({"title": f"{i}"}, [])
    made.judge([{"title": "first"}, {"title": "second"}])
    made.judge([{"title": "third"}, {"title": "fourth"}])
    read = json.loads(made.write().read_text(encoding="utf-8"))
    assert taken == [True, True, False, False, False]
    assert (read["name"], read["text"]) == ("deck", "é ;")
    assert read["calculations"] == [{"number": 0}, {"number": 1}]
    assert [d["title"] for d in read["drawings"]] == ["0", "1", "2"]
    assert [[d["title"] for d in v] for v in read["verdicts"]] == [["first", "second"]]
    assert read["left_out"] == {"calculations": 3, "drawings": 2 + 2}
    assert read["shapes"] == []
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "calculation_1.csv", "calculation_2.csv", "contents.json"
    ]  # fmt: skip
    assert (tmp_path / "calculation_2.csv").read_text() == "t;b\n0;0.333333333\n1;-2e-30\n"
