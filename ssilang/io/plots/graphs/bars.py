"""Bars of a histogram (curves of type HIST)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.plots.graphs.line_style import Line
from ssilang.io.plots.markup import to_mathtext

if TYPE_CHECKING:
    from matplotlib.axes import Axes


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
        _name_bar(panel, line)


def _name_bar(panel: Axes, line: Line) -> None:
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
