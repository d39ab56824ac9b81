"""Floor spectra of all runs of a sweep: the median, and what 16 and 84 % of the runs stay below."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from ssilang.io.file_names import inside
from ssilang.kernel.base.arrays import FloatArray
from ssilang.messages.message import Teller
from ssilang.report import records
from ssilang.report.charts import Chart, Line
from ssilang.report.records import read_record
from ssilang.report.sweep_table import MOTION, RUNS, Sweep

FRACTILES = (16, 84)
LEAST = 3
"""Runs of which fractiles are shown."""
MOST_SETTINGS = 4
"""Combinations of what was swept in one picture."""


Key = tuple[int, int, str, str]
"""Number of the verdict and of the floor, component, damping."""
Spectrum = tuple[str, tuple[float, ...], FloatArray]
"""What was set, frequencies and accelerations (n,) of a run."""


def floor_charts(sweep: Sweep, told: Teller) -> list[Chart]:
    """A picture a floor and damping."""
    names = [n for n in sweep.swept if n != MOTION and len({row[n] for row in sweep.rows}) > 1]
    found: dict[Key, list[Spectrum]] = {}
    for row in sweep.rows:
        setting = ", ".join(f"{n} = {row[n]}" for n in names)
        for key, frequencies, values in _spectra(sweep, row):
            found.setdefault(key, []).append((setting, frequencies, values))
    return [_chart(key, spectra, told) for key, spectra in sorted(found.items())]


def _chart(key: Key, spectra: list[Spectrum], told: Teller) -> Chart:
    """Fractiles of a floor's spectra, of runs at the frequencies that most have."""
    usual = Counter(f for _, f, _ in spectra).most_common(1)[0][0]
    groups: dict[str, list[FloatArray]] = {}
    for setting, frequencies, values in spectra:
        if frequencies == usual:
            groups.setdefault(setting, []).append(values)
    verdict, floor, component, damping = key
    title = told("report.floor", number=floor, component=component) + f", {damping}"
    if verdict > 1:
        title += f" · {told('report.footing-number', number=verdict)}"
    if others := len(spectra) - sum(map(len, groups.values())):
        title += f" ({told('report.sweep-other-frequencies', count=others)})"
    if (left := len(groups) - MOST_SETTINGS) > 0:
        title += f" ({told('report.sweep-lines-left', count=left)})"
    lines = [
        Line(f"{setting}, {said}" if setting else said, np.array(usual), values)
        for setting, group in list(groups.items())[:MOST_SETTINGS]
        for said, values in _fractiles(np.array(group), told)
    ]
    axis = f"{told('report.acceleration')} (m/s2)"
    return Chart("floors", title, told("report.frequency"), axis, lines, (True, False))


def _fractiles(spectra: FloatArray, told: Teller) -> Iterator[tuple[str, FloatArray]]:
    yield told("report.sweep-median", count=len(spectra)), np.median(spectra, axis=0)
    if len(spectra) >= LEAST:
        yield from ((f"{share} %", np.percentile(spectra, share, axis=0)) for share in FRACTILES)


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
