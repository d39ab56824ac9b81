"""What a run with `--report` leaves for its report: a folder `report` in the output folder.

`contents.json` says what there is: the deck's text and, under `calculations`, `drawings`,
`shapes` and `verdicts`, one entry a calculation, a picture of curves, a field or basis of modes,
the pictures of a footing's verdict. Of a calculation
there is `calculation_N.csv`, energies and footings in time, and `scene_N.vtkhdf`, some instants of
all that moves. All of it is of use without the report.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import write_text
from ssilang.kernel.base.arrays import FloatArray

FOLDER, CONTENTS = "report", "contents.json"
MOST_CALCULATIONS = 12
MOST_DRAWINGS = 24
MOST_VERDICTS = 6
MOST_POINTS = 4000
"""Points of a curve that are kept; of more, the extremes of equal stretches."""


@dataclass(eq=False)
class Recording:
    """What is taken down during a run."""

    folder: Path
    told: dict[str, Any]  # the deck: `name`, `text`
    # as `contents.json` has them; those beyond the most are only counted
    calculations: list[dict[str, Any]] = field(default_factory=list)
    drawings: list[dict[str, Any]] = field(default_factory=list)
    shapes: list[dict[str, Any]] = field(default_factory=list)
    verdicts: list[list[dict[str, Any]]] = field(default_factory=list)
    left_out: dict[str, int] = field(default_factory=lambda: {"calculations": 0, "drawings": 0})

    @property
    def takes_more(self) -> bool:
        """Whether another calculation is taken; it is counted if not."""
        if len(self.calculations) < MOST_CALCULATIONS:
            return True
        self.left_out["calculations"] += 1
        return False

    def table(self, columns: Mapping[str, FloatArray]) -> Path:
        """Write the histories of the calculation that is added next."""
        path = self.folder / f"calculation_{len(self.calculations) + 1}.csv"
        row = ";".join(["%.9g"] * len(columns))
        values = zip(*(c.tolist() for c in columns.values()), strict=True)
        write_text(path, "\n".join([";".join(columns), *(row % v for v in values)]) + "\n")
        return path

    def draw(self, drawing: Mapping[str, Any], curves: list[dict[str, Any]]) -> None:
        """Take down a picture of curves; `x` and `y` of each are arrays."""
        if len(self.drawings) >= MOST_DRAWINGS:
            self.left_out["drawings"] += 1
            return
        self.drawings.append(thinned_drawing(drawing, curves))

    def judge(self, pictures: list[dict[str, Any]]) -> None:
        """Take down the pictures of a verdict; beyond the most it is counted."""
        if len(self.verdicts) >= MOST_VERDICTS:
            self.left_out["drawings"] += len(pictures)
            return
        self.verdicts.append(pictures)

    def write(self) -> Path:
        """Write `contents.json`."""
        path = self.folder / CONTENTS
        told = {
            **self.told,
            "calculations": self.calculations,
            "drawings": self.drawings,
            "shapes": self.shapes,
            "verdicts": self.verdicts,
            "left_out": self.left_out,
        }
        write_text(path, json.dumps(told, ensure_ascii=False) + "\n")
        return path


def thinned_drawing(drawing: Mapping[str, Any], curves: list[dict[str, Any]]) -> dict[str, Any]:
    """A picture whose curves, `x` and `y` arrays, have few points."""
    made = [{**curve, **_thinned(curve["x"], curve["y"])} for curve in curves]
    return {**drawing, "curves": made}


def _thinned(x: FloatArray, y: FloatArray) -> dict[str, list[float | None]]:
    """A curve of at most so many points, its extremes among them."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    if len(x) > MOST_POINTS:
        edges = np.linspace(0, len(x), MOST_POINTS // 2 + 1).astype(int).tolist()
        low = [int(a + np.nanargmin(np.r_[y[a:b], np.inf])) for a, b in pairwise(edges)]
        high = [int(a + np.nanargmax(np.r_[y[a:b], -np.inf])) for a, b in pairwise(edges)]
        kept = np.unique([0, *low, *high, len(x) - 1]).clip(0, len(x) - 1)
        x, y = x[kept], y[kept]
    return {"x": plain(x), "y": plain(y)}


def plain(values: FloatArray, digits: int = 7) -> list[float | None]:
    """Numbers for JSON, null for those that are none."""
    found = np.asarray(values).tolist()
    return [float(f"{v:.{digits}g}") if math.isfinite(v) else None for v in found]
