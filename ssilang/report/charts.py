"""Curves of a report: which there are, with titles, axes and units."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ssilang.io.recording import plain
from ssilang.kernel.base.arrays import FloatArray
from ssilang.language.vocabulary.unit_systems import SYSTEMS, UnitSystem
from ssilang.messages.message import Teller
from ssilang.report.html import codes, text
from ssilang.report.results import Calculation, Results

MOST_COLUMNS = 12
"""Columns of a table that one picture shows."""


@dataclass(frozen=True)
class Line:
    """A curve by its name."""

    name: str
    x: FloatArray
    y: FloatArray
    points: bool = False
    """Whether points stand alone."""


@dataclass(frozen=True)
class Chart:
    """One picture of curves."""

    # 'verdict', 'footing', 'energy', 'curves', 'tables', 'sweep', 'fragility' or 'floors'
    group: str
    title: str
    x: str  # names of the axes with their units
    y: str
    lines: list[Line]
    log: tuple[bool, bool] = (False, False)  # whether the axes are logarithmic
    loop: bool = field(default=False)

    def told(self) -> dict[str, Any]:
        """The picture as the page's data."""
        return {
            "title": self.title,
            "x": self.x,
            "y": self.y,
            "log": list(self.log),
            "loop": self.loop or not all(_rises(line.x) for line in self.lines),
            "lines": [
                {
                    "name": line.name, "x": plain(line.x, 6), "y": plain(line.y, 6),
                    "points": line.points,
                }
                for line in self.lines
            ],
        }  # fmt: skip


def _rises(x: FloatArray) -> bool:
    return bool((np.diff(x) > 0.0).all() and np.isfinite(x).all())


def charts_of(results: Results, told: Teller) -> list[Chart]:
    """All pictures of curves."""
    units = results.summary.get("units") or {}
    system = SYSTEMS.get(str(units.get("system", "")))
    made: list[Chart] = []
    for i, calculation in enumerate(results.calculations, 1):
        name = f"{calculation.name} {i}" if len(results.calculations) > 1 else ""
        made += _Of(calculation, name, system, told).charts()
    made += [c for d in results.drawings if (c := _drawing(d, "curves")) is not None]
    made += [c for v in results.verdicts for d in v if (c := _drawing(d, "verdict")) is not None]
    for name, columns in results.tables.items():
        made += _table(name, columns)
    return made


@dataclass(frozen=True)
class _Of:
    """Pictures of a calculation."""

    calculation: Calculation
    name: str
    system: UnitSystem | None
    told: Teller

    def charts(self) -> list[Chart]:
        """Footings, then energies."""
        if len(self.calculation.columns.get("time", ())) < 2:
            return []
        made = [c for k in range(len(self.calculation.footings)) for c in self._footing(k)]
        return [*made, *self._energies()]

    def _axis(self, code: str, unit: str) -> str:
        """A name with its unit, where the deck names its units."""
        said = self.told(code)
        if self.system is None or not unit:
            return said
        return f"{said} ({self.system.written(unit)})"

    def _title(self, code: str, k: int = -1) -> str:
        parts = [self.told(code), self.name]
        if k >= 0 and len(self.calculation.footings) > 1:
            parts.append(self.told("report.footing-number", number=k + 1))
        return " · ".join(p for p in parts if p)

    def _footing(self, k: int) -> list[Chart]:
        columns, footing = self.calculation.columns, self.calculation.footings[k]
        pairs = footing["kind"] == "pairs"
        time, axis = columns["time"], self._axis("report.time", "s")
        made = []
        for name, code, unit, scale in (
            ("share", "report.share", "", 100.0),
            ("pressure", "report.toe-force" if pairs else "report.toe-pressure",
             "N" if pairs else "Pa", 1.0),
            ("opening", "report.footing-opening", "m", 1.0),
            ("force", "report.force", "N", 1.0),
        ):  # fmt: skip
            values = columns.get(f"{name}_{k + 1}")
            if values is None:
                continue
            line = Line(self.told(code), time, scale * values)
            shown = self._axis(code, unit) if unit else f"{self.told(code)} (%)"
            made.append(Chart("footing", self._title(code, k), axis, shown, [line]))
        loops = []
        for direction in footing["axes"]:
            turn = columns.get(f"rotation_{direction}_{k + 1}")
            moment = columns.get(f"moment_{direction}_{k + 1}")
            if turn is not None and moment is not None:
                name = self.told("report.about", axis=direction)
                loops.append(Line(name, turn, moment))
        if loops:
            x, y = self._axis("report.rotation", ""), self._axis("report.moment", "N.m")
            title = self._title("report.loops", k)
            made.append(Chart("footing", title, f"{x} (rad)", y, loops, loop=True))
            turns = [Line(line.name, time, line.x) for line in loops]
            title = self._title("report.rotation", k)
            made.append(Chart("footing", title, axis, f"{x} (rad)", turns))
        return made

    def _energies(self) -> list[Chart]:
        columns = self.calculation.columns
        lines = [
            Line(self.told(code), columns["time"], columns[word])
            for word, code in codes()["energies"].items()
            if word in columns and np.abs(columns[word]).max() > 0.0
        ]
        if not lines:
            return []
        axis = self._axis("report.time", "s")
        title = self._title("report.energies")
        return [Chart("energy", title, axis, self._axis("report.energy", "J"), lines)]


def charts_html(charts: Sequence[Chart], group: str, told: Teller) -> str:
    """Where the page draws the pictures of a group; nothing without any."""
    figures = [
        f'<figure class=chart data-chart="{i}"><figcaption>{text(c.title)}</figcaption>'
        "<div class=plot></div></figure>"
        for i, c in enumerate(charts)
        if c.group == group
    ]
    head = f"<p class=note>{text(told('report.zoom'))}</p>"
    return f"{head}<div class=charts>{''.join(figures)}</div>" if figures else ""


def _drawing(told: dict[str, Any], group: str) -> Chart | None:
    """A picture that the deck drew, or that its verdict has."""
    lines = [
        Line(c["name"] or str(i), _numbers(c["x"]), _numbers(c["y"]))
        for i, c in enumerate(told["curves"], 1)
    ]
    if not lines:
        return None
    title = told["title"] or (told["files"] or [""])[0]
    log = (bool(told["log"][0]), bool(told["log"][1]))
    return Chart(group, title, told["x"], told["y"], lines, log, loop=told.get("loop", False))


def _numbers(values: list[float | None]) -> FloatArray:
    return np.array([math.nan if v is None else v for v in values], float)


def _table(name: str, columns: dict[str, FloatArray]) -> list[Chart]:
    """Pictures of a table against its first column, one for each kind of quantity."""
    first, *others = columns
    groups: dict[str, list[str]] = {}
    for title in others:
        groups.setdefault(re.split(r"[_ ]", title)[0], []).append(title)
    return [
        Chart(
            "tables", f"{name}: {kind}", first, kind,
            [Line(t, columns[first], columns[t]) for t in titles[:MOST_COLUMNS]],
        )
        for kind, titles in groups.items()
    ]  # fmt: skip
