"""Pictures of a page from columns whose numbers tell which they are; edges of surfaces."""

from types import SimpleNamespace

import numpy as np
import pyvista
from hypothesis import given
from hypothesis import strategies as st
from together import together

from ssilang.report.charts import Chart, Line, charts_html, charts_of
from ssilang.report.scenes import _cells_of, _edges_of, _pairs

TIME = np.array([0.0, 0.5, 2.0])


def _told(code, **data):
    return f"@{data['number']}" if "number" in data else code + "".join(data.values())


def _column(number):
    return np.array([number, -number, number + 0.25])


NAMES = ["force_2", "opening_1", "moment_Y_1", "share_2", "rotation_Y_1", "share_1", "pressure_2",
         "rotation_X_1", "moment_X_1", "moment_Z_2", "DISSIPEE", "CINETIQUE"]  # fmt: skip
COLUMNS = {n: _column(i + 1.0) for i, n in enumerate(NAMES)} | {
    "AMORTIE": np.zeros(3), "time": TIME
}  # fmt: skip
FOOTINGS = [{"kind": "pairs", "axes": ["Y", "X"]}, {"kind": "joint", "axes": ["Z"]}]


def _results(calculations=(), drawings=(), verdicts=(), tables=(), system="SI"):
    return SimpleNamespace(
        summary={"units": {"system": system}} if system else {}, calculations=list(calculations),
        drawings=list(drawings), verdicts=list(verdicts), tables=dict(tables),
    )  # fmt: skip


def _calculation(**changed):
    given = {"name": "DYNA", "columns": COLUMNS, "footings": FOOTINGS} | changed
    return SimpleNamespace(**given)


@together("title, y, names, factor", [
        ("report.share · @1", "report.share (%)", ["share_1"], 100),
        ("report.share · @2", "report.share (%)", ["share_2"], 100),
        ("report.toe-pressure · @2", "report.toe-pressure (Pa)", ["pressure_2"], 1),
        ("report.footing-opening · @1", "report.footing-opening (m)", ["opening_1"], 1),
        ("report.force · @2", "report.force (N)", ["force_2"], 1),
        ("report.rotation · @1", "report.rotation (rad)", ["rotation_Y_1", "rotation_X_1"], 1),
        ("report.energies", "report.energy (J)", ["CINETIQUE", "DISSIPEE"], 1),
    ])  # fmt: skip
def test_histories_of_footings_and_energies(title, y, names, factor):
    (chart,) = [c for c in charts_of(_results([_calculation()]), _told) if c.title == title]
    assert chart.y == y
    assert chart.x == "report.time (s)"
    assert not chart.told()["loop"]
    assert len(chart.lines) == len(names)
    for line, name in zip(chart.lines, names, strict=True):
        assert np.array_equal(line.x, TIME)
        assert np.array_equal(line.y, factor * COLUMNS[name])


def test_loops_are_moments_over_rotations_of_their_own_axis():
    charts = charts_of(_results([_calculation()]), _told)
    (loops,) = [c for c in charts if c.title.startswith("report.loops")]
    assert (loops.x, loops.y, loops.loop) == ("report.rotation (rad)", "report.moment (N.m)", True)
    assert [line.name for line in loops.lines] == ["report.aboutY", "report.aboutX"]
    for line, axis in zip(loops.lines, "YX", strict=True):
        assert np.array_equal(line.x, COLUMNS[f"rotation_{axis}_1"])
        assert np.array_equal(line.y, COLUMNS[f"moment_{axis}_1"])
    assert len(charts) == 8


def test_one_instant_is_no_history_and_two_calculations_are_numbered():
    short = _calculation(columns={n: v[:1] for n, v in COLUMNS.items()})
    assert charts_of(_results([short]), _told) == []
    one = _calculation(footings=FOOTINGS[1:], name="Z")
    titles = [c.title for c in charts_of(_results([one, _calculation(name="A")], system=""), _told)]
    assert "report.share · Z 1" in titles
    assert "report.share · A 2 · @1" in titles


def test_drawings_keep_their_axes_and_names():
    def drawing(title, **more):
        return {"title": title, "x": "f", "y": "a", "log": [True, False], "files": ["z.png"],
                "curves": [{"name": None, "x": [1, 2], "y": [3, None]},
                           {"name": "n", "x": [2, 1], "y": [5, 6]}]} | more  # fmt: skip

    results = _results(
        [], [drawing("Z"), drawing(""), drawing("gone", curves=[])], [[drawing("V", loop=True)]]
    )
    charts = charts_of(results, _told)
    assert [(c.title, c.group, c.log, c.loop) for c in charts] == [
        ("Z", "curves", (True, False), False), ("z.png", "curves", (True, False), False),
        ("V", "verdict", (True, False), True),
    ]  # fmt: skip
    told = charts[0].told()
    assert (told["x"], told["y"], told["log"], told["loop"]) == ("f", "a", [True, False], True)
    assert [(c["name"], c["x"], c["y"]) for c in told["lines"]] == [
        ("1", [1, 2], [3, None]), ("n", [2, 1], [5, 6])
    ]  # fmt: skip


def test_columns_of_a_table_by_their_kind():
    titles = ["T", "UZ_3", "RX 1", "UZ_1", *(f"F_{i}" for i in range(14))]
    columns = {t: _column(i) for i, t in enumerate(titles)}
    found = {c.title: c for c in charts_of(_results(tables={"h.csv": columns}), _told)}
    assert {t: [line.name for line in c.lines] for t, c in found.items()} == {
        "h.csv: UZ": ["UZ_3", "UZ_1"], "h.csv: RX": ["RX 1"],
        "h.csv: F": [f"F_{i}" for i in range(12)],
    }  # fmt: skip
    for chart in found.values():
        assert (chart.group, chart.x) == ("tables", "T")
        assert all(np.array_equal(line.x, columns["T"]) for line in chart.lines)
        assert all(np.array_equal(line.y, columns[line.name]) for line in chart.lines)


def test_places_of_a_group_on_the_page():
    charts = [Chart(g, f"<{g}{i}>", "x", "y", [Line("l", TIME, TIME)])
              for i, g in enumerate(["tables", "energy", "tables"])]  # fmt: skip
    html = charts_html(charts, "tables", _told)
    assert [f'data-chart="{i}"' in html for i in range(3)] == [True, False, True]
    assert "&lt;tables0&gt;" in html
    assert charts_html(charts, "floors", _told) == ""


FACE = st.integers(3, 6).flatmap(
    lambda n: st.lists(st.integers(0, 9), min_size=n, max_size=n, unique=True)
)


@given(st.lists(FACE, min_size=1, max_size=8))
def test_each_side_of_each_face_once(faces):
    surface = pyvista.PolyData(
        np.random.default_rng(1).normal(size=(10, 3)),
        faces=np.concatenate([[len(face), *face] for face in faces]),
    )
    wanted = {tuple(sorted((a, b))) for f in faces for a, b in zip(f, f[1:] + f[:1], strict=True)}
    found = _edges_of(surface).reshape(-1, 2)
    assert len(found) == len(wanted)
    assert {tuple(sorted(pair)) for pair in found.tolist()} == wanted


def test_no_faces_have_no_edges():
    assert _edges_of(pyvista.PolyData(np.zeros((2, 3)))).shape == (0,)


def test_lines_and_points_of_several_sizes_stand_one_behind_the_other():
    lines = pyvista.PolyData(np.eye(3), lines=[3, 0, 2, 1, 2, 1, 0]).GetLines()
    assert _pairs(lines).reshape(-1, 2).tolist() == [[0, 2], [2, 1], [1, 0]]
    points = pyvista.PolyData(np.eye(3), verts=[2, 2, 0, 1, 1]).GetVerts()
    assert _cells_of(points)[1].tolist() == [2, 0, 1]
