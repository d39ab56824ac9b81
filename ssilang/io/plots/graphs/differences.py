"""Curves that lie on each other: what still differs, for a frame of its own."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ssilang.io.plots.graphs.line_style import Line

# of the range of the curve they are measured from: the pen hides less than the first share, and
# curves further away than the second are told apart without help
_HIDDEN, _APART = 0.015, 0.05
_NOISE = 1e-7
_FEWEST = 3  # points
_MOST = 9  # curves


def differences(lines: Sequence[Line], asked: bool | None) -> list[Line]:
    """Curves less the first one, where some of them lie on it to the eye.

    Parameters
    ----------
    asked : bool, optional
        True: all curves that can be compared, however far they are; False: none.

    Returns
    -------
    list of Line
        Empty if there is nothing to show. Values stand at the points of the curve that has fewer
        of them; the other is linear in between.
    """
    if asked is False or not 2 <= len(lines) <= _MOST:
        return []
    first, *others = lines
    known = first.y[np.isfinite(first.y)]
    reach = float(np.ptp(known)) if len(known) else 0.0
    made = [found for line in others if (found := _less(line, first)) is not None]
    if asked:
        return made
    near = [line for line in made if _size(line) <= _APART * reach]
    sizes = [_size(line) for line in near]
    if not sizes or min(sizes) > _HIDDEN * reach or max(sizes) <= _NOISE * reach:
        return []
    return near


def _size(line: Line) -> float:
    return float(np.abs(line.y).max())


def _less(line: Line, first: Line) -> Line | None:
    """A curve less the first where both are; None if that is not half of it."""
    if not all(_runs(x) for x in (line, first)):
        return None
    sparse, other, sign = (line, first, 1.0) if len(line.x) <= len(first.x) else (first, line, -1.0)
    low, high = max(line.x[0], first.x[0]), min(line.x[-1], first.x[-1])
    kept = (sparse.x >= low) & (sparse.x <= high)
    if kept.sum() < max(_FEWEST, 0.5 * len(sparse.x)):
        return None
    x = sparse.x[kept]
    gap = sign * (sparse.y[kept] - np.interp(x, other.x, other.y))
    return replace(line, x=x, y=gap, codes=None)


def _runs(line: Line) -> bool:
    """Whether it goes from left to right, number by number."""
    finite = np.isfinite(line.x).all() and np.isfinite(line.y).all()
    return bool(len(line.x) >= _FEWEST and finite and (np.diff(line.x) > 0).all())
