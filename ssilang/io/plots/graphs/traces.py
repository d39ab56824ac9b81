"""What options of a drawing of curves leave in its figure: those without a trace were in vain."""

from collections.abc import Callable
from typing import Any


def seen(figure: Any, option: str) -> bool:
    """Whether an option of `CurveOptions` that was asked for shows in a figure of curves."""
    panels = figure.axes
    return any(_LEAVES[option](panel, len(panels)) for panel in panels)


def _crosses(panel: Any, _: int) -> bool:
    """Whether an axis through the origin lies within the frame."""
    spans = ((panel.get_xscale(), panel.get_xlim()), (panel.get_yscale(), panel.get_ylim()))
    return any(scale != "log" and min(ends) <= 0.0 <= max(ends) for scale, ends in spans)


def _steps(panel: Any, axis: str) -> bool:
    from matplotlib.ticker import MultipleLocator

    return isinstance(getattr(panel, axis).get_major_locator(), MultipleLocator)


def _counts(panel: Any, _: int) -> bool:
    """Whether abscissas are numbers: words stand at places of their own."""
    from matplotlib.ticker import FixedLocator

    return not isinstance(panel.xaxis.get_major_locator(), FixedLocator)


_LEAVES: dict[str, Callable[[Any, int], bool]] = {
    "legend": lambda panel, _: panel.get_legend() is not None,
    "difference": lambda panel, count: count > 1 and panel.get_ylabel()[:1] == "\u2212",
    "separate": lambda panel, count: count > 1 or bool(panel.get_title("left")),
    "x_title_at_end": lambda panel, _: bool(panel.get_xlabel()),
    "y_title_at_end": lambda panel, _: bool(panel.get_ylabel()),
    "x_step": lambda panel, _: _steps(panel, "xaxis"),
    "y_step": lambda panel, _: _steps(panel, "yaxis"),
    "x_format": _counts,
    "axes": _crosses,
    "extremes": lambda panel, _: bool(panel.get_title("right")),
}
"""Whether a frame, of so many, shows what each asks for."""
