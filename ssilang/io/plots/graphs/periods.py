"""Periods along the upper side of what is drawn against frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.plots.graphs.line_style import Line
from ssilang.kernel.curves.curve import CurvePart

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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
