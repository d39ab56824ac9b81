"""One curve with its style, ready to draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.io.plots.graphs.line_style import LineStyle


@dataclass(frozen=True)
class Line:
    """One curve ready to draw."""

    number: int
    x: np.ndarray[Any, np.dtype[np.float64]]
    y: np.ndarray[Any, np.dtype[np.float64]]
    colour: str
    name: str
    style: LineStyle
    width: float
    codes: Any = None
    kind: str = ""
