"""Floor spectra of all runs of a sweep: the median, and what 16 and 84 % of the runs stay below."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ssilang.io.file_names import inside
from ssilang.kernel.base.arrays import FloatArray
from ssilang.messages.message import Teller
from ssilang.report import records
from ssilang.report.charts import Chart, Line
from ssilang.report.records import read_record
from ssilang.report.sweep_table import MOTION, RUNS, Sweep

FRACTILES = (50, 16, 84)
LEAST = 3
"""Runs of which fractiles are shown."""
MOST_SETTINGS = 4
"""Combinations of what was swept in one picture."""


@dataclass
class Floor:
    """Spectra of one floor at one damping, by what was set: arrays (n_runs, n_frequencies)."""

    frequencies: tuple[float, ...]
    spectra: dict[str, list[FloatArray]] = field(default_factory=dict)
    others: int = 0
    """Runs at other frequencies, left out."""


Key = tuple[int, int, str, str]
"""Number of the verdict and of the floor, component, damping."""


def floor_charts(sweep: Sweep, told: Teller) -> list[Chart]:
    """A picture a floor and damping."""
    made = []
    floors = _floors(sweep)
    for (verdict, floor, component, damping), found in floors.items():
        title = told("report.floor", number=floor, component=component) + f", {damping}"
        if verdict > 1:
            title += f" · {told('report.footing-number', number=verdict)}"
        if found.others:
            title += f" ({told('report.sweep-other-frequencies', count=found.others)})"
        left = len(found.spectra) - MOST_SETTINGS
        if left > 0:
            title += f" ({told('report.sweep-lines-left', count=left)})"
        lines = [
            line for setting, spectra in list(found.spectra.items())[:MOST_SETTINGS]
            for line in _lines(found, setting, np.array(spectra), told)
        ]  # fmt: skip
        axis = f"{told('report.acceleration')} (m/s2)"
        made.append(Chart("floors", title, told("report.frequency"), axis, lines, (True, False)))
    return made


def _lines(floor: Floor, setting: str, spectra: FloatArray, told: Teller) -> Iterator[Line]:
    name = f"{setting}, " if setting else ""
    frequencies = np.array(floor.frequencies)
    for share in FRACTILES if len(spectra) >= LEAST else FRACTILES[:1]:
        said = told("report.sweep-median", count=len(spectra)) if share == 50 else f"{share} %"
        yield Line(name + said, frequencies, np.percentile(spectra, share, axis=0))


def _floors(sweep: Sweep) -> dict[Key, Floor]:
    """Spectra that the runs' summaries have."""
    found: dict[Key, list[tuple[str, tuple[float, ...], FloatArray]]] = {}
    names = [n for n in sweep.swept if n != MOTION]
    names = [n for n in names if len({row[n] for row in sweep.rows}) > 1]
    for row in sweep.rows:
        setting = ", ".join(f"{n} = {row[n]}" for n in names)
        for key, frequencies, values in _spectra(sweep, row):
            found.setdefault(key, []).append((setting, frequencies, values))
    floors = {}
    for key, all_ in sorted(found.items()):
        usual = Counter(f for _, f, _ in all_).most_common(1)[0][0]
        floors[key] = Floor(usual, others=sum(f != usual for _, f, _ in all_))
        for setting, frequencies, values in all_:
            if frequencies == usual:
                floors[key].spectra.setdefault(setting, []).append(values)
    return floors


def _spectra(
    sweep: Sweep, row: dict[str, str]
) -> Iterator[tuple[Key, tuple[float, ...], FloatArray]]:
    """Of one run that ended well."""
    name = f"{RUNS}/{row['folder']}/summary.json"
    if row["exit_code"] != "0" or inside(sweep.folder, name) is None:
        return
    try:
        summary = read_record(sweep.folder / name, records.SUMMARY)
    except (OSError, ValueError):
        return
    for number, verdict in enumerate(summary["statistics"].get("verdicts", []), 1):
        for floor in verdict["floors"]:
            x, y = floor.get("frequencies", []), floor.get("accelerations", [])
            if len(x) > 1 and len(x) == len(y):
                key = (number, floor["floor"], floor["component"], floor["damping"])
                yield key, tuple(x), np.array(y, float)
