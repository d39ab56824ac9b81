"""Drawings of curves: what stands on the axes."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from together import together

from ssilang.io.errors import OutputError
from ssilang.io.plots.figure import Pictures, slug
from ssilang.io.plots.graphs.curves import CurveOptions, draw_bars, draw_curves
from ssilang.io.plots.graphs.line_style import Line, LineStyle, parse_style
from ssilang.io.plots.markup import to_mathtext
from ssilang.io.plots.palette import shade
from ssilang.kernel.curves.curve import Curve, CurvePart


def curve(*colours: int) -> Curve:
    t = np.linspace(0.0, 2.0, 11)
    parts = [CurvePart(t, (i + 1) * t, "time", "u", f"no {i}", c) for i, c in enumerate(colours)]
    return Curve(tuple(parts), "A title")


def test_titles_are_those_of_the_first_curve() -> None:
    figure = draw_curves(curve(0))
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time", "u")
    assert figure.get_suptitle() == "A title"
    assert axes.get_legend() is None
    one, other = (curve(0).parts[0].measured("s", unit) for unit in ("", "m"))
    for parts, titles in (((one,), ("time (s)", "u")), ((one, other), ("time", "u")),
                          ((other, other), ("time (s)", "u (m)"))):  # fmt: skip
        (axes,) = draw_curves(Curve(parts), CurveOptions(written=str)).axes
        assert (axes.get_xlabel(), axes.get_ylabel()) == titles


def test_bars_that_are_their_own_outline_are_filled() -> None:
    figure = Figure()
    panel, x, y = figure.subplots(), np.array([1.0, 1, 4, 4]), np.array([0.0, 3, 3, 0])
    draw_bars(panel, Line(0, x, y, "#123456", "b", LineStyle(), 1.0))
    ((filled,), (rim,)) = panel.patches, panel.lines
    assert filled.get_xy()[:4].tolist() == rim.get_xydata().tolist() == np.c_[x, y].tolist()
    assert (to_hex(filled.get_facecolor()), rim.get_color()) == ("#123456", "#123456")


def test_titles_of_the_options_come_first() -> None:
    options = CurveOptions(title="T", x_title="X_{1}", y_title="50 % $")
    (axes,) = (figure := draw_curves(curve(0), options)).axes
    assert figure.get_suptitle() == "T"
    assert axes.get_xlabel() == to_mathtext("X_{1}")
    assert axes.get_ylabel() == r"50 % \$"


def test_a_long_title_takes_several_lines() -> None:
    title = "word " * 15 + "x_{1}"
    lines = draw_curves(curve(0), CurveOptions(title=title)).get_suptitle().split("\n")
    assert len(lines) == 2
    assert lines[1].endswith(to_mathtext("x_{1}"))
    assert max(map(len, lines)) < 80


def test_curves_without_a_colour_get_different_ones() -> None:
    (axes,) = draw_curves(curve(0, 1, 0, 0)).axes
    colours = [to_hex(line.get_color()) for line in axes.lines]
    assert colours[1] == shade("BLEU")
    assert len(set(colours)) == 4
    (axes,) = draw_curves(curve(0, 0)).axes
    assert len({line.get_color() for line in axes.lines}) == 2


def test_a_single_curve_is_in_the_default_ink() -> None:
    (axes,) = draw_curves(curve(0)).axes
    assert to_hex(axes.lines[0].get_color()) == shade(0)
    (with_axes,) = draw_curves(curve(0), CurveOptions(axes=True)).axes
    drawn = [(line.get_xdata()[:], line.get_ydata()[:]) for line in with_axes.lines]
    zeros = [[list(map(float, d)) for d in pair] for pair in drawn if len(pair[0]) == 2]
    assert zeros == [[[0.0, 1.0], [0.0, 0.0]], [[0.0, 0.0], [0.0, 1.0]]]
    assert len(axes.lines) == 1
    for log, left in (({"log_x": True}, zeros[:1]), ({"log_y": True}, zeros[1:])):
        (scaled,) = draw_curves(curve(0), CurveOptions(axes=True, **log)).axes
        drawn = [(line.get_xdata()[:], line.get_ydata()[:]) for line in scaled.lines]
        assert [[list(map(float, d)) for d in p] for p in drawn if len(p[0]) == 2] == left


def test_bounds_and_logarithms() -> None:
    (axes,) = draw_curves(curve(0), CurveOptions(x_limits=(2.0, 0.5), log_y=True)).axes
    assert axes.get_xlim() == (0.5, 2.0)
    assert axes.get_yscale() == "log"


def test_graduations_and_their_format() -> None:
    options = CurveOptions(
        x_limits=(0.0, 2.0), x_step=-0.5, x_format="(F5.1)", y_limits=(0.0, 3.0), y_step=1.5,
        y_format="(E9.2)",
    )  # fmt: skip
    figure = draw_curves(curve(0), options)
    figure.canvas.draw()
    texts = [t.get_text() for t in figure.axes[0].get_xticklabels()]
    assert texts[1:-1] == ["0.0", "0.5", "1.0", "1.5", "2.0"]  # without those beyond the ends
    texts = [t.get_text() for t in figure.axes[0].get_yticklabels()]
    assert texts[1:-1] == ["0.00E+00", "1.50E+00", "3.00E+00"]


def test_too_many_graduations_are_refused() -> None:
    with pytest.raises(OutputError, match="too many"):
        draw_curves(curve(0), CurveOptions(x_step=1e-6))


def test_separate_frames_hold_the_chosen_curves() -> None:
    figure = draw_curves(curve(1, 2, 4), CurveOptions(separate=True, chosen=(1, 3)))
    assert [len(a.lines) for a in figure.axes] == [1, 1]
    assert figure.axes[1].lines[0].get_ydata()[-1] == 6.0


def test_a_curve_that_is_not_there_cannot_be_chosen() -> None:
    with pytest.raises(OutputError, match="curve 3 is asked for, the evolution has 2"):
        draw_curves(curve(0, 0), CurveOptions(chosen=(3,)))


def test_a_name_pas_de_legende_is_left_out() -> None:
    options = CurveOptions(legend="NE", names={2: "PAS DE LEGENDE"})
    legend = draw_curves(curve(0, 0), options).axes[0].get_legend()
    assert legend is not None
    assert [t.get_text() for t in legend.get_texts()] == ["no 0"]


@together("count, place", [(2, 8), (9, 8), (10, 2)])
def test_names_stand_over_the_curves_or_beside_them_where_they_are_many(count: int, place: int):
    legend = draw_curves(curve(*[0] * count)).axes[0].get_legend()
    assert legend is not None
    assert (legend._loc, len(legend.get_texts())) == (place, count)  # lower center, upper left


def test_names_stand_where_they_are_put_and_not_of_bars_alone() -> None:
    options = CurveOptions(legend="XY", legend_at=(1.5, 2.0), y_title_at_end=True)
    (axes,) = draw_curves(curve(0), options).axes
    assert (axes.get_xlim(), axes.get_ylim()) != ((0.0, 1.0), (0.0, 1.0))
    at = axes.get_legend().get_bbox_to_anchor().p0
    np.testing.assert_allclose(at, axes.transData.transform((1.5, 2.0)))
    assert (axes.yaxis.label.get_ha(), axes.xaxis.label.get_ha()) == ("right", "center")
    bars = CurvePart([1.0, 2.0], [3.0, 5.0], legend="b", kind="HIST")
    for parts, named in (((bars, bars), False), ((bars, curve(0).parts[0]), True)):
        (axes,) = draw_curves(Curve(parts)).axes
        assert (axes.get_legend() is not None) == named


def test_one_point_is_a_dot_or_its_marker() -> None:
    alone = Curve((CurvePart([1.0], [2.0]),))
    for style, marker in (({}, "o"), ({1: parse_style("MARQ CARR")}, "s")):
        (axes,) = draw_curves(alone, CurveOptions(styles=style)).axes
        assert axes.lines[0].get_marker() == marker
    few = Curve((CurvePart(np.arange(4.0), np.arange(4.0)),))
    style = parse_style("LABEL here REGU")
    assert len(draw_curves(few, CurveOptions(styles={1: style})).axes[0].texts) == 4


def test_styles_of_the_table() -> None:
    style = parse_style("TIRC MARQ L PLEIN ROND REGU")
    assert (style.marker, style.marker_size, style.solid, style.few_markers) == ("o", 8, True, True)
    (axes,) = draw_curves(curve(0), CurveOptions(styles={1: style})).axes
    assert axes.lines[0].get_marker() == "o"
    assert axes.lines[0].get_markevery().tolist() == [0, 2, 4, 6, 8, 10]
    with pytest.raises(OutputError, match="'ROUND' is no marker"):
        parse_style("MARQ ROUND")


@together(
    "style, marker, unread",
    [
        ("MARQ TRIA", "v", ()),
        ("MARQ XXL TRIB REGU", "^", ()),
        ("MARQ POIN POIN", ".", ()),
        ("marq tria titr m1", "v", ("TITR", "M1")),
    ],
)
def test_older_markers_are_drawn_and_idle_words_kept_apart(style, marker, unread) -> None:
    found = parse_style(style)
    assert (found.marker, found.unread) == (marker, unread)
    (axes,) = draw_curves(curve(0), CurveOptions(styles={1: found})).axes
    assert axes.lines[0].get_marker() == marker


@together("style, rows", [("", range(11)), (" REGU", [0, 2, 4, 6, 8, 10])])
def test_points_have_the_label_of_their_style(style: str, rows: Sequence[int]) -> None:
    given = {2: parse_style("LABEL here" + style)}
    (axes,) = draw_curves(curve(0, 0), CurveOptions(styles=given)).axes
    t = np.linspace(0.0, 2.0, 11)[rows]
    assert [text.get_text() for text in axes.texts] == ["here"] * len(rows)
    np.testing.assert_allclose([text.xy for text in axes.texts], np.stack([t, 2.0 * t], axis=1))


@together("word, end", [("TRID", 5.0), ("TRIU", -2.0)])
def test_triangles_of_bars_stand_at_the_middle_of_their_curve(word: str, end: float) -> None:
    bars = Curve((CurvePart([1.0, 2.0, 4.0], [3.0, 5.0, -2.0], legend="shares"),), kind="HIST")
    (axes,) = draw_curves(bars, CurveOptions(styles={1: parse_style(f"MARQ {word}")})).axes
    (text,) = axes.texts
    assert (text.get_text(), text.xy) == ("shares", (2.5, end))
    assert [bar.get_width() for bar in axes.patches] == pytest.approx([0.96] * 3)


def test_abscissas_that_are_words_stand_below_the_axis() -> None:
    words = ("one", "two ", "last")
    part = CurvePart(np.array([1.0, 2.0, 3.0]), np.array([4.0, 1.0, 2.0]), abscissa_words=words)
    (axes,) = draw_curves(Curve((part,))).axes
    assert [(t.get_position()[0], t.get_text()) for t in axes.get_xticklabels()] == [
        (1.0, "one"), (2.0, "two"), (3.0, "last")
    ]  # fmt: skip


def test_only_the_span_is_drawn() -> None:
    (axes,) = draw_curves(curve(0), CurveOptions(spans={1: (3, 5)})).axes
    assert np.allclose(axes.lines[0].get_xdata(), [0.4, 0.6, 0.8])


def test_dashes_are_those_of_the_curve_s_segments_whatever_part_is_drawn() -> None:
    """Eleven points, ten dashes; of points 3 to 5 the segments are the third and the fourth."""
    options = CurveOptions(spans={1: (3, 5)}, dash_codes={1: [1, 1, 0, 3, *[1] * 6]})
    (axes,) = draw_curves(curve(0), options).axes
    (whole,) = draw_curves(curve(0), CurveOptions(dash_codes={1: [*[0] * 3, *[3] * 7]})).axes
    (drawn,), (both,) = axes.collections, whole.collections
    assert [len(p.vertices) for p in drawn.get_paths()] == [2, 2]
    assert drawn.get_linestyle() == both.get_linestyle()  # full, then TIRL
    assert drawn.get_linestyle()[0] != drawn.get_linestyle()[1]


def test_extremes_are_written() -> None:
    (axes,) = draw_curves(curve(0, 0), CurveOptions(extremes=True)).axes
    assert axes.get_title(loc="right") == "min 0    max 4"


def test_extremes_are_marked_where_they_are() -> None:
    t = np.linspace(0.0, 1.0, 11)
    parts = (CurvePart(t, t - 0.2, colour=1), CurvePart(t, -(t**2), colour=2))
    (axes,) = draw_curves(Curve(parts), CurveOptions(extremes=True)).axes
    marks = [(tuple(c.get_offsets()[0]), to_hex(c.get_facecolor()[0])) for c in axes.collections]
    assert marks == [((1.0, -1.0), shade(2)), ((1.0, 0.8), shade(1))]


def several(*functions: Any) -> Curve:
    t = np.linspace(0.0, 2.0, 41)
    names = ["exact", *(f"way {i}" for i in range(1, len(functions)))]
    pairs = zip(functions, names, strict=True)
    return Curve(tuple(CurvePart(t, f(t), "t", "u", n, i + 1) for i, (f, n) in enumerate(pairs)))


def test_curves_that_lie_on_each_other_show_what_differs() -> None:
    near = several(np.sin, lambda t: 1.004 * np.sin(t), np.cos)
    upper, lower = draw_curves(near).axes
    assert [line.get_label() for line in upper.lines] == ["exact", "way 1", "way 2"]
    assert lower.get_ylabel() == "\u2212 exact"
    assert (lower.get_xlabel(), upper.get_xlabel()) == ("t", "")
    zero, gap = lower.lines  # the third curve is seen without help
    assert to_hex(gap.get_color()) == shade(2)
    assert np.allclose(gap.get_ydata(), 0.004 * np.sin(gap.get_xdata()))
    assert set(zero.get_ydata()) == {0.0}


def test_differences_are_taken_at_the_points_of_the_coarser_curve() -> None:
    """A curve of few points is no chord: a parabola against its own points differs by nothing."""
    fine, coarse = np.linspace(0.0, 2.0, 401), np.linspace(0.0, 2.0, 5)
    parts = (CurvePart(coarse, coarse**2), CurvePart(fine, fine**2 + 0.01))
    _, lower = draw_curves(Curve(parts)).axes
    gap = lower.lines[1]
    assert np.allclose(gap.get_xdata(), coarse)
    assert np.allclose(gap.get_ydata(), 0.01, atol=2e-5)


@together(
    "other, asked, frames",
    [
        (np.cos, None, 1),
        (np.cos, True, 2),
        (lambda t: 1.004 * np.sin(t), False, 1),
        (np.sin, None, 1),  # nothing differs
        (lambda t: np.sin(t) + 1e-12, None, 1),  # rounding
    ],
)
def test_when_differences_have_a_frame(other: Any, asked: bool | None, frames: int) -> None:
    figure = draw_curves(several(np.sin, other), CurveOptions(difference=asked))
    assert len(figure.axes) == frames


def test_loops_have_no_differences() -> None:
    t = np.linspace(0.0, 6.0, 50)
    parts = tuple(CurvePart(np.cos(t), a * np.sin(t)) for a in (1.0, 1.001))
    assert len(draw_curves(Curve(parts), CurveOptions(difference=True)).axes) == 1


@together("shift, frames", [(2.9, 2), (3.1, 1), (-2.9, 2), (-3.1, 1)])
def test_curves_that_share_less_than_half_have_no_differences(shift: float, frames: int) -> None:
    t = np.linspace(0.0, 6.0, 61)
    parts = (CurvePart(t, np.sin(t)), CurvePart(t + shift, np.cos(t + shift)))
    figure = draw_curves(Curve(parts), CurveOptions(difference=True))
    assert len(figure.axes) == frames
    if frames == 2:
        x, y = figure.axes[1].lines[1].get_data()
        assert (x.min(), x.max()) == pytest.approx((max(shift, 0.0), 6.0 + min(shift, 0.0)))
        assert np.allclose(y, np.cos(x) - np.sin(x))


def test_a_legend_says_what_looks_alike_once() -> None:
    t = np.linspace(0.0, 2.0, 5)
    parts = [CurvePart(t, (i + 1) * t, legend=n) for i, n in enumerate(("one", "two", "x", "x"))]
    cross = parse_style("NOLI MARQ CROI")
    options = CurveOptions(styles={3: cross, 4: cross}, legend="NE")
    inked = Curve(tuple(dataclasses.replace(p, colour=8) for p in parts))
    legend = draw_curves(inked, options).axes[0].get_legend()
    assert [x.get_text() for x in legend.get_texts()] == ["one", "two", "x"]


@pytest.mark.parametrize("log", [True, False])
def test_frequencies_of_a_spectrum_have_their_periods_above(log: bool) -> None:
    f = np.geomspace(0.2, 40.0, 60)
    plain = tuple(CurvePart(f, a / f, "FREQ", "ACCE", str(a)) for a in (1, 2))
    made = Curve(tuple(part.measured("Hz") for part in plain))
    figures = [draw_curves(c, CurveOptions(log_x=log)) for c in (made, Curve(plain))]
    for figure in figures:
        figure.draw_without_rendering()
    (panel,), (bare,) = (figure.axes for figure in figures)
    (upper,) = panel.child_axes
    above, right_above = (axes.get_legend().get_window_extent().y0 for axes in (panel, bare))
    assert above > upper.get_tightbbox().y1
    assert right_above < bare.bbox.y1 + 0.1 * bare.bbox.height
    assert upper.get_xlabel() == "T (s)"
    periods = upper.get_xticks()
    assert len(periods) > 3
    for period in periods:
        place = panel.transData.transform((1.0 / period, 0.0))[0]
        assert upper.transData.transform((period, 0.0))[0] == pytest.approx(place)
    assert not bare.child_axes  # of a signal in time


def test_pictures_are_numbered_and_svg_keeps_its_words(tmp_path: Path) -> None:
    pictures = Pictures(tmp_path / "new")
    pictures.save(draw_curves(curve(0)), "Été 1", ("png", "svg"))
    pictures.save(draw_curves(curve(0)), "Été 1")
    names = ["0001_ete-1.png", "0001_ete-1.svg", "0002_ete-1.png"]
    assert [p.name for p in pictures.files] == names
    root = ElementTree.parse(tmp_path / "new" / "0001_ete-1.svg").getroot()
    texts = {t.text for t in root.iter("{http://www.w3.org/2000/svg}text")}
    assert {"A title", "time", "u"} <= texts


def test_names_of_files_are_plain() -> None:
    assert slug("a/../b  ç%") == "a-b-c"


def test_powers_on_axes_are_read_once_for_all_pictures_and_numbers_never(tmp_path: Path) -> None:
    read, misses = MathTextParser._parse_cached, []
    read.cache_clear()
    Pictures(tmp_path).save(draw_curves(curve(0)), "u", ("png", "svg"))
    assert read.cache_info().misses == 0
    f = np.array([0.3, 2.0, 50.0])
    for name in "01":
        pictures = Pictures(tmp_path / name)
        made = draw_curves(Curve((CurvePart(f, 1e3 / f, "x"),)), CurveOptions(log_x=True))
        pictures.save(made, "u", ("png", "svg"))
        misses.append(read.cache_info().misses)
    assert misses[0] == misses[1] > 3
    one, two = (sorted((tmp_path / name).iterdir()) for name in "01")
    assert [p.read_bytes() for p in one] == [p.read_bytes() for p in two]
