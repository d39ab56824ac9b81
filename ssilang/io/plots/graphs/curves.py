"""Pictures of curves (DESS).

Bars of a histogram (curves of type HIST).

Periods along the upper side of what is drawn against frequencies.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.io.plots.figure import drawing, head
from ssilang.io.plots.graphs.differences import differences
from ssilang.io.plots.graphs.line_style import DASHES, Line, LineStyle
from ssilang.io.plots.labels import formatted
from ssilang.io.plots.markup import to_mathtext
from ssilang.io.plots.palette import CYCLE, index_of, shade
from ssilang.kernel.curves.curve import Curve, CurvePart

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_WIDTH = 1.6
_WIDTHS = (2.4, 1.3)  # of the first and the last curve: those that coincide are all seen
NO_LEGEND = "PAS DE LEGENDE"
_CORNERS: dict[str, Any] = {
    "NO": "upper left",
    "NE": "upper right",
    "SO": "lower left",
    "SE": "lower right",
}


@dataclass(frozen=True)
class CurveOptions:
    """Options of a drawing of curves; what is None is chosen from the data.

    Attributes
    ----------
    legend : None, 'NO', 'NE', 'SO', 'SE', 'EXT', 'XY' or ''
        None: a legend appears when several curves have names; '' stands for 'EXT'.
    legend_at : (float, float), optional
        Upper left corner of the legend in axis units, for 'XY'.
    x_format, y_format : str, optional
        Fortran format of the axis numbers, such as '(F5.1)' or '(I4)'.
    styles, names : mapping of int to LineStyle, str
        By curve number from 1; a name replaces the curve's own.
    spans : mapping of int to (int or None, int or None)
        First and last point drawn, from 1.
    dash_codes : mapping of int to sequence of int
        Dash of each segment: 0 full, 1 to 5 as TIRR TIRC TIRL TIRM POIN.
    difference : bool, optional
        A second frame shows the curves less the first: True always, False never, None where some
        lie on it to the eye.
    written : function, optional
        What stands for an SI unit in the units of the data; without it the names of the curves
        carry no units.
    """

    log_x: bool = False
    log_y: bool = False
    grid: str | None = None
    grey_grid: bool = False
    square: bool = False
    x_limits: tuple[float, float] | None = None
    y_limits: tuple[float, float] | None = None
    x_step: float | None = None
    y_step: float | None = None
    extremes: bool = False
    date: bool = False
    separate: bool = False
    chosen: tuple[int, ...] = ()
    title: str | None = None
    x_title: str | None = None
    y_title: str | None = None
    x_title_at_end: bool = False
    y_title_at_end: bool = False
    x_format: str | None = None
    y_format: str | None = None
    axes: bool = False
    legend: str | None = None
    legend_at: tuple[float, float] | None = None
    styles: Mapping[int, LineStyle] = field(default_factory=dict)
    names: Mapping[int, str] = field(default_factory=dict)
    spans: Mapping[int, tuple[int | None, int | None]] = field(default_factory=dict)
    dash_codes: Mapping[int, Any] = field(default_factory=dict)
    difference: bool | None = None
    written: Callable[[str], str] | None = None


def draw_curves(curve: Curve, options: CurveOptions | None = None) -> Figure:
    """A figure of all curves.

    Raises
    ------
    OutputError
        If there is no curve, or a chosen number does not exist.
    """
    options = options or CurveOptions()
    lines = _lines(curve, options)
    rows = len(lines) if options.separate else 1
    gaps = [] if _one_frame(curve, options) else differences(lines, options.difference)
    shape = (5.6, 5.6) if options.square else (7.2, 4.4)
    height = shape[1] * (1.35 if gaps else 1 if rows == 1 else 0.45 * rows + 0.2)
    with drawing(shape[0], height) as figure:
        ratios = [2.6, 1.0] if gaps else [1.0] * rows
        panels = figure.subplots(len(ratios), 1, sharex=True, squeeze=False, height_ratios=ratios)[
            :, 0
        ]
        for i, panel in enumerate(panels[:rows]):
            _draw_panel(panel, lines[i : i + 1] if options.separate else lines, curve, options)
        if gaps:
            _draw_gaps(panels[-1], gaps, panels[0], lines[0], options)
        for panel in panels[:-1]:
            panel.set_xlabel("")
        title = curve.title if options.title is None else options.title
        head(figure, title)
        if options.date:
            stamp = datetime.now().strftime("%Y-%m-%d %H:%M")
            figure.text(0.995, 0.005, stamp, ha="right", va="bottom", fontsize=7, color="#777777")
    return figure


def _one_frame(curve: Curve, options: CurveOptions) -> bool:
    """Whether the drawing has no place for differences."""
    bars = "HIST" in (curve.kind, *(p.kind for p in curve.parts))
    chosen = options.separate or options.square or options.log_y or options.y_limits is not None
    return bars or (chosen and not options.difference) or options.separate


def _draw_gaps(
    panel: Axes, gaps: list[Line], over: Axes, first: Line, options: CurveOptions
) -> None:
    """The frame of differences, under the curves and in their inks."""
    panel.axhline(0.0, color=first.colour, lw=0.9, zorder=1.5)
    for line in gaps:
        _draw_line(panel, line)
    panel.grid(True)
    panel.set_axisbelow(True)
    panel.set_xlabel(over.get_xlabel(), loc="right" if options.x_title_at_end else "center")
    panel.set_ylabel("\u2212 " + to_mathtext(first.name or str(first.number)))
    panel.tick_params(axis="y", labelsize=8)
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)


def _lines(curve: Curve, options: CurveOptions) -> list[Line]:
    count = len(curve.parts)
    numbers = options.chosen or tuple(range(1, count + 1))
    bad = [n for n in numbers if not 1 <= n <= count]
    if bad:
        raise OutputError("io.curve-asked-evolution", bad=bad[0], count=count)
    colours = _colours([curve.parts[n - 1].colour for n in numbers])
    widths = np.linspace(*_WIDTHS, len(numbers)) if len(numbers) > 1 else [_WIDTH]
    return [
        _line(curve.parts[n - 1], n, colour, float(width), options)
        for n, colour, width in zip(numbers, colours, widths, strict=True)
    ]


def _colours(given: list[int]) -> list[str]:
    """Shades of curves: their own; those without one get, if several, colours not yet used."""
    if given.count(0) < 2:
        return [shade(c, ink=True) for c in given]
    turns = cycle([c for c in CYCLE if index_of(c) not in given] or CYCLE)
    return [shade(c or next(turns), ink=True) for c in given]


def _line(part: CurvePart, number: int, colour: str, width: float, options: CurveOptions) -> Line:
    first, last = options.spans.get(number, (None, None))
    cut = slice(None if first is None else first - 1, last)
    codes = options.dash_codes.get(number)
    return Line(
        number, np.asarray(part.abscissas, dtype=float)[cut],
        np.asarray(part.ordinates, dtype=float)[cut], colour,
        options.names.get(number, part.legend).strip(), options.styles.get(number, LineStyle()),
        width, None if codes is None else codes[cut.start :], part.kind,
    )  # fmt: skip


def _draw_panel(panel: Axes, lines: list[Line], curve: Curve, options: CurveOptions) -> None:
    if options.log_x:
        panel.set_xscale("log", nonpositive="mask")
    if options.log_y:
        panel.set_yscale("log", nonpositive="mask")
    for line in lines:
        bars = "HIST" in (line.kind, curve.kind)
        draw_bars(panel, line) if bars else _draw_line(panel, line)
    _frame(panel, options)
    _titles(panel, [curve.parts[line.number - 1] for line in lines], options)
    if options.extremes:
        _extremes(panel, lines)
    periods = add_periods(panel, [curve.parts[line.number - 1] for line in lines], lines)
    _legend(panel, lines, options, 1.16 if periods else 1.0)


def _draw_line(panel: Axes, line: Line) -> None:
    style = line.style
    if style.fill:
        paint = "white" if style.fill_white else line.colour
        opacity = 1.0 if style.fill_white else 0.25
        order = 2.0 - 1e-3 * line.number if not style.fill_white else 2.0 + 1e-2 * line.number
        _fill(panel, line, facecolor=paint, alpha=opacity, lw=0, zorder=order)
    drawn = _pen(line) | {"label": line.name, "zorder": 2.0 + 1e-2 * line.number + 5e-3}
    if style.marker is not None and style.few_markers:
        drawn["markevery"] = np.unique(np.linspace(0, max(len(line.x) - 1, 0), 6).astype(int))
    if line.codes is not None:
        _draw_segments(panel, line)
        drawn["linestyle"] = "none"
    if len(line.x) == 1 and style.marker is None:
        drawn |= {"marker": "o", "markerfacecolor": line.colour}
    panel.plot(line.x, line.y, **drawn)
    if style.label and len(line.x):
        _label_points(panel, line)


def _fill(panel: Axes, line: Line, **style: Any) -> None:
    """Fill down to zero, or to the lower end of a logarithmic axis."""
    from matplotlib.collections import PolyCollection

    base = 1e-300 if panel.get_yscale() == "log" else 0.0
    known = np.isfinite(line.x) & np.isfinite(line.y)
    x, y = line.x[known], np.maximum(line.y[known], base) if base else line.y[known]
    if len(x) < 2:
        return
    around = np.column_stack([[x[0], *x, x[-1]], [base, *y, base]])
    panel.add_collection(PolyCollection([around], **style), autolim=base == 0.0)


def _draw_segments(panel: Axes, line: Line) -> None:
    from matplotlib.collections import LineCollection

    codes = np.asarray(line.codes, dtype=int)[: max(len(line.x) - 1, 0)]
    dashes = list(DASHES.values())
    # runs of equal code are drawn in one piece, so that the dashes do not start anew
    starts = np.flatnonzero(np.diff(codes, prepend=-1))
    ends = np.append(starts[1:], len(codes))
    points = np.column_stack([line.x, line.y])
    panel.add_collection(
        LineCollection(
            [points[a : b + 1] for a, b in zip(starts, ends, strict=True)],
            colors=line.colour,
            linewidths=line.width,
            linestyles=[dashes[codes[a] % len(dashes)] for a in starts],
            zorder=2.0 + 1e-2 * line.number,
        )
    )


def _label_points(panel: Axes, line: Line) -> None:
    few = line.style.few_markers and len(line.x) > 6
    rows = np.linspace(0, len(line.x) - 1, 6).astype(int) if few else range(len(line.x))
    for i in rows:
        panel.annotate(
            to_mathtext(line.style.label), (line.x[i], line.y[i]), textcoords="offset points",
            xytext=(3, 3), fontsize=8, color=line.colour,
        )  # fmt: skip


def _frame(panel: Axes, options: CurveOptions) -> None:
    if options.x_limits:
        panel.set_xlim(*sorted(options.x_limits))
    if options.y_limits:
        panel.set_ylim(*sorted(options.y_limits))
    for axis, step, form, log in (
        (panel.xaxis, options.x_step, options.x_format, options.log_x),
        (panel.yaxis, options.y_step, options.y_format, options.log_y),
    ):
        _graduate(axis, step, form, log)
    if options.grid is not None:
        colour = "#c9ced4" if options.grey_grid else "#5b616a"
        dash: Any = DASHES.get(options.grid, "-")
        panel.grid(True, color=colour, linestyle=dash, linewidth=0.6)
    else:
        panel.grid(True)
    panel.set_axisbelow(True)
    if options.axes:
        for line, log in ((panel.axhline, options.log_y), (panel.axvline, options.log_x)):
            if not log:
                line(0.0, color="#4a4f57", lw=0.9, zorder=1.5)
    if options.square:
        panel.set_box_aspect(1)
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)


def _graduate(axis: Any, step: float | None, form: str | None, log: bool) -> None:
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    if log:
        return
    if step:
        low, high = sorted(axis.get_view_interval())
        if (high - low) / abs(step) > 200:
            raise OutputError("io.graduations-every-axis-too", step=step, low=low, high=high)
        axis.set_major_locator(MultipleLocator(abs(step)))
    if form:
        axis.set_major_formatter(FuncFormatter(lambda value, _: formatted(form, value)))


def _titles(panel: Axes, parts: list[CurvePart], options: CurveOptions) -> None:
    first = parts[0] if parts else None
    x, y = (first.abscissa_name, first.ordinate_name) if first else ("", "")
    if options.written is not None and len({p.units for p in parts}) == 1:
        x, y = (
            f"{name.strip()} ({options.written(unit)})" if unit else name
            for name, unit in zip((x, y), parts[0].units, strict=True)
        )
    x = options.x_title if options.x_title is not None else x
    y = options.y_title if options.y_title is not None else y
    panel.set_xlabel(to_mathtext(x.strip()), loc="right" if options.x_title_at_end else "center")
    panel.set_ylabel(to_mathtext(y.strip()), loc="top" if options.y_title_at_end else "center")
    if first is not None and first.abscissa_words:
        panel.set_xticks(first.abscissas, [w.strip() for w in first.abscissa_words])


def _extremes(panel: Axes, lines: list[Line]) -> None:
    y = np.concatenate([line.y[np.isfinite(line.y)] for line in lines] or [np.empty(0)])
    if len(y) == 0:
        return
    panel.set_title(
        f"min {y.min():.5g}    max {y.max():.5g}", loc="right", fontsize=9, fontweight="normal"
    )
    for marker, place in (("v", np.nanargmin), ("^", np.nanargmax)):
        tops = [line for line in lines if np.isfinite(line.y).any()]
        ends = [line.y[place(line.y)] for line in tops]
        line = tops[int(place(ends))]
        row = int(place(line.y))
        panel.scatter(
            line.x[row], line.y[row], s=34, marker=marker, c=line.colour, edgecolors="white",
            linewidths=0.8, zorder=4,
        )  # fmt: skip


def _legend(panel: Axes, lines: list[Line], options: CurveOptions, top: float = 1.0) -> None:
    named = [line for line in lines if line.name and line.name.upper() != NO_LEGEND]
    usual = len(lines) > 1 and not all(line.kind == "HIST" for line in lines)
    if not named or (options.legend is None and not usual and not options.separate):
        return
    named = list({_look(line): line for line in reversed(named)}.values())[::-1]
    handles = [_handle(line) for line in named]
    texts = [to_mathtext(line.name) for line in named]
    place = options.legend
    if place is None and options.separate:
        panel.set_title(texts[0], loc="left", fontsize=9, fontweight="normal")
    elif place is None and len(named) <= 9:
        # beside the curves: inside, it would hide a part of them
        rows: dict[str, Any] = {"loc": "lower center", "ncols": min(len(named), 3)}
        panel.legend(handles, texts, bbox_to_anchor=(0.5, top), frameon=False, **rows)
    elif place in _CORNERS:
        panel.legend(handles, texts, loc=_CORNERS[place])
    elif place == "XY" and options.legend_at is not None:
        panel.legend(
            handles,
            texts,
            loc="upper left",
            bbox_to_anchor=options.legend_at,
            bbox_transform=panel.transData,
        )
    else:
        panel.legend(handles, texts, loc="upper left", bbox_to_anchor=(1.01, 1.0))


def _look(line: Line) -> tuple[object, ...]:
    """What its line of the legend says: the same for several curves is said once."""
    style = line.style
    return line.name, line.colour, style.marker, style.solid, str(style.dash) if style.line else ""


def _handle(line: Line) -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], **_pen(line))


def _pen(line: Line) -> dict[str, Any]:
    """How matplotlib draws a curve and its line of the legend."""
    style = line.style
    return {
        "color": line.colour, "linewidth": line.width, "marker": style.marker,
        "linestyle": style.dash if style.line else "none", "markersize": style.marker_size,
        "markerfacecolor": line.colour if style.solid else "white", "markeredgewidth": 1.2,
    }  # fmt: skip


def draw_bars(panel: Axes, line: Line) -> None:
    """A bar at each abscissa; a curve that goes up and down (as @HISTOGR makes) is its own outline.

    The markers TRIU and TRID stand under and over the middle of the curve, with its name.
    """
    if len(line.x) and np.any(np.diff(line.x) <= 0):
        panel.fill(line.x, line.y, facecolor=line.colour, alpha=0.75, lw=0)
        panel.plot(line.x, line.y, color=line.colour, lw=0.8)
    else:
        width = np.min(np.diff(line.x)) if len(line.x) > 1 else 1.0
        drawn: dict[str, Any] = {"color": line.colour, "edgecolor": line.colour, "alpha": 0.75}
        panel.bar(line.x, line.y, width=0.96 * width, **drawn)
    if line.style.marker in ("v", "^") and len(line.x):
        over = line.style.marker == "v"
        end = float(np.max(line.y) if over else np.min(line.y))
        panel.annotate(
            to_mathtext(line.name),
            (float(np.mean([np.min(line.x), np.max(line.x)])), end),
            xytext=(0, 9 if over else -9),
            textcoords="offset points",
            ha="center",
            va="bottom" if over else "top",
            fontsize=8,
            arrowprops={"arrowstyle": "-|>", "lw": 0.6, "color": line.colour, "shrinkB": 1},
        )


_PERIODS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
_APART = 0.05  # of the width


def add_periods(panel: Axes, parts: Sequence[CurvePart], lines: Sequence[Line]) -> bool:
    """Mark round periods, if all curves have frequencies in Hz; whether that was done."""
    if not parts or any(p.units[0] != "Hz" or p.kind for p in parts):
        return False
    if sum(int((line.x > 0).sum()) for line in lines) < 2:
        return False
    kept = _seen(*panel.get_xlim(), log=panel.get_xscale() == "log")
    if len(kept) < 2:
        return False
    upper = panel.secondary_xaxis("top", functions=(_turned, _turned))
    upper.set_xticks(kept, [f"{t:g}" for t in kept])
    upper.set_xticks([], minor=True)
    upper.tick_params(labelsize=8, length=3)
    upper.set_xlabel("T (s)", fontsize=8, loc="left", labelpad=2)
    upper.spines["top"].set_color("#c9ced4")
    return True


def _seen(low: float, high: float, *, log: bool) -> list[float]:
    """Round periods within the bounds of the frequencies, none over another."""
    scale = np.log if log else np.asarray
    kept, last = [], np.inf
    for t in _PERIODS:  # from high frequencies to low ones
        along = float((scale(1.0 / t) - scale(low)) / (scale(high) - scale(low)))
        if 0.0 <= along <= 1.0 and last - along > _APART:
            kept.append(t)
            last = along
    return kept


def _turned(values: Any) -> Any:
    """Periods of frequencies, and back; an axis may begin below zero."""
    values = np.asarray(values, dtype=float)
    return 1.0 / np.where(values == 0.0, 1e-12, values)
