"""Drawings of curves: what stands on the axes."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.colors import to_hex

from ssilang.io.errors import OutputError
from ssilang.io.plots.figure import Pictures, slug
from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves
from ssilang.io.plots.graphs.line_style import parse_style
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


def test_a_single_curve_is_in_the_default_ink() -> None:
    (axes,) = draw_curves(curve(0)).axes
    assert to_hex(axes.lines[0].get_color()) == shade(0)


def test_bounds_and_logarithms() -> None:
    (axes,) = draw_curves(curve(0), CurveOptions(x_limits=(2.0, 0.5), log_y=True)).axes
    assert axes.get_xlim() == (0.5, 2.0)
    assert axes.get_yscale() == "log"


def test_graduations_and_their_format() -> None:
    options = CurveOptions(x_limits=(0.0, 2.0), x_step=0.5, x_format="(F5.1)")
    figure = draw_curves(curve(0), options)
    figure.canvas.draw()
    texts = [t.get_text() for t in figure.axes[0].get_xticklabels()]
    assert texts[1:-1] == ["0.0", "0.5", "1.0", "1.5", "2.0"]  # without those beyond the ends


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


def test_styles_of_the_table() -> None:
    style = parse_style("TIRC MARQ L PLEIN ROND REGU")
    assert (style.marker, style.marker_size, style.solid, style.few_markers) == ("o", 8, True, True)
    (axes,) = draw_curves(curve(0), CurveOptions(styles={1: style})).axes
    assert axes.lines[0].get_marker() == "o"
    assert len(axes.lines[0].get_markevery()) == 6
    with pytest.raises(OutputError, match="'ROUND' is no marker"):
        parse_style("MARQ ROUND")


def test_only_the_span_is_drawn() -> None:
    (axes,) = draw_curves(curve(0), CurveOptions(spans={1: (3, 5)})).axes
    assert np.allclose(axes.lines[0].get_xdata(), [0.4, 0.6, 0.8])


def test_extremes_are_written() -> None:
    (axes,) = draw_curves(curve(0, 0), CurveOptions(extremes=True)).axes
    assert axes.get_title(loc="right") == "min 0    max 4"


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
