"""Fragilities of a sweep: which were asked for, what its runs tell, and how the page shows it.

Floor spectra of all runs: the median, and what 16 and 84 % of the runs stay below.
"""

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from ssilang.io.atomic import inside, write_text
from ssilang.io.errors import InputError
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.fragility import LEAST_RECORDS, Fragility, of_cloud, of_exceedances
from ssilang.language.search import nearest_told
from ssilang.messages.message import Refusal, Teller
from ssilang.report.charts import Chart, Line, charts_html
from ssilang.report.html import table, text
from ssilang.report.records import read_record
from ssilang.report.sweep_table import (
    MOTION,
    Sweep,
    chooses_records,
    link_to,
    real,
    summary_of,
    unscaled,
    usual_intensities,
)
from ssilang.report.verdict import is_endless

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
    done, known = _done(sweep), usual_intensities(sweep.figures)
    names = [n for n in sweep.swept if n != MOTION and len({row[n] for row in sweep.rows}) > 1]
    names = [n for n in names if not chooses_records(done, sweep.swept, n, known)]
    found: dict[Key, list[Spectrum]] = {}
    for row in sweep.rows:
        setting = ", ".join(f"{n} = {row[n]}" for n in names)
        for key, frequencies, values in _spectra(sweep, row):
            found.setdefault(key, []).append((setting, frequencies, values))
    return [_chart(key, spectra, told) for key, spectra in sorted(found.items())]


def _done(sweep: Sweep) -> list[dict[str, str]]:
    """Rows of the runs that ended well."""
    return [row for row in sweep.rows if row["exit_code"] == "0"]


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
    summary = summary_of(sweep.folder, row["folder"]) if row["exit_code"] == "0" else {}
    for number, verdict in enumerate(summary.get("statistics", {}).get("verdicts", []), 1):
        for floor in verdict["floors"]:
            x, y = floor.get("frequencies", []), floor.get("accelerations", [])
            if len(x) > 1 and len(x) == len(y):
                key = (number, floor["floor"], floor["component"], floor["damping"])
                yield key, tuple(x), np.array(y, float)


ASKED = "fragility.json"
"""What a sweep was asked for, beside its table."""
_LIMIT = re.compile(r"\s*(.+?)\s*([<>])\s*([^<>]+)")
_FEWEST = 5
"""Runs of which one may be told to stand apart."""
_APART = 8.0
"""Times another intensity: less than g over m/s2, more than most records of a suite differ by."""
_CURVE = 101
_FAR = 30.0
"""Times the demand that comes nearest: degrees over radians, and no line goes on so far."""
_GOES = 0.7
"""Correlation of logarithms by which a demand goes one way with the intensity."""
_TELL_LEVEL = "kernel.records.fragility-separated", "kernel.records.fragility-no-scatter"
_METHODS = {"counts": "report.fragility-counts", "cloud": "report.fragility-cloud"}
_HEADS = (
    "report.fragility-limit", "report.fragility-intensity", "report.fragility-method",
    "report.fragility-median", "report.fragility-interval", "report.fragility-dispersion",
    "report.fragility-error", "report.fragility-exceeded", "report.fragility-governs",
)  # fmt: skip


@dataclass(frozen=True)
class Limit:
    """A figure's value beyond which a run exceeds."""

    figure: str
    below: bool
    value: float

    def __str__(self) -> str:
        """As it is written."""
        return f"{self.figure} {'<' if self.below else '>'} {self.value:g}"


@dataclass(frozen=True)
class Asked:
    """Limits, and names of the intensities; none: those that the table has."""

    limits: list[Limit]
    intensities: list[str]

    def write(self, folder: Path) -> None:
        """Leave it in a sweep's folder, for its page."""
        said = {"limits": [str(x) for x in self.limits], "intensities": self.intensities}
        write_text(folder / ASKED, json.dumps(said, ensure_ascii=False) + "\n")


@dataclass(frozen=True)
class Fit:
    """A fragility that was asked for: found, or why there is none."""

    limit: Limit
    intensity: str
    method: str  # 'counts' or 'cloud'
    found: Fragility | None
    problem: Refusal | None
    worst: dict[str, str]  # row of the run with the largest demand, or the least
    exceeded: int
    runs: int


def read_limits(said: str) -> list[Limit]:
    """`NAME>VALUE`, `NAME<VALUE`, or several values between commas; [] if it is none."""
    parts = _LIMIT.fullmatch(said)
    values = [real(v) for v in parts[3].split(",")] if parts else []
    if parts is None or None in values:
        return []
    return [Limit(parts[1], parts[2] == "<", v) for v in values if v is not None]


def asked_of(folder: Path) -> Asked | None:
    """What a sweep was asked for; None if nothing, or what stands there is none.

    Raises
    ------
    InputError
        If it is damaged.
    """
    if inside(folder, ASKED) is None:
        return None
    try:
        said = read_record(folder / ASKED, "fragility")
    except (OSError, ValueError) as problem:
        raise InputError("report.damaged", path=folder / ASKED, problem=problem) from None
    limits = [limit for each in said["limits"] for limit in read_limits(each)]
    return Asked(limits, said["intensities"]) if limits else None


def unknown(asked: Asked, known: Sequence[str]) -> list[Refusal]:
    """Names that no run reports."""
    names = dict.fromkeys([*(x.figure for x in asked.limits), *asked.intensities])
    return [_unknown(name, known) for name in names if name not in known]


def _unknown(name: str, known: Sequence[str]) -> Refusal:
    return Refusal("report.fragility-unknown", name=name, **nearest_told(name, known))


def fits_of(sweep: Sweep, asked: Asked) -> list[Fit]:
    """Each limit by each intensity, by counts and by a cloud."""
    return [
        _fit(sweep, limit, intensity, method)
        for limit in dict.fromkeys(asked.limits)
        for intensity in intensities_of(sweep, asked)
        for method in _METHODS
    ]


def intensities_of(sweep: Sweep, asked: Asked) -> list[str]:
    """Names that were asked for, else those that are known as such, else what was swept."""
    if asked.intensities:
        return list(dict.fromkeys(asked.intensities))
    usual = usual_intensities(sweep.figures)
    swept = [n for n in sweep.swept if len({real(row[n]) for row in sweep.rows}) > 1]
    return usual or [n for n in swept if all(real(row[n]) is not None for row in sweep.rows)][:1]


def _fit(sweep: Sweep, limit: Limit, intensity: str, method: str) -> Fit:
    known = [*sweep.figures, *sweep.swept]
    for name in (limit.figure, intensity):
        if name not in known:
            return Fit(limit, intensity, method, None, _unknown(name, known), {}, 0, 0)
    rows, x, d = _sample(sweep, limit.figure, intensity)
    beyond = (d < limit.value) if limit.below else (d > limit.value)
    worst = rows[int(np.argmin(d) if limit.below else np.argmax(d))] if rows else {}
    records = None
    if MOTION in sweep.swept:
        records = np.unique([row[MOTION] for row in rows], return_inverse=True)[1]
    found, problem = None, None
    try:
        if method == "counts":
            found = of_exceedances(x, beyond.astype(float), np.ones(len(x)), records)
        else:
            found = of_cloud(x, d, limit.value, below=limit.below, records=records)
    except FieldError as refused:
        problem = refused
    return Fit(limit, intensity, method, found, problem, worst, int(beyond.sum()), len(rows))


def amiss(sweep: Sweep, fits: Sequence[Fit]) -> Iterator[Refusal]:
    """Limits far from what any run demands, and those for which neither method has found a fit.

    But for those whose median lies between two runs, which is told with them.
    """
    for counts, cloud in zip(fits[::2], fits[1::2], strict=True):
        limit, name = counts.limit, counts.intensity
        _, x, d = _sample(sweep, limit.figure, name) if counts.runs else ([], *np.ones((2, 0)))
        with np.errstate(divide="ignore", invalid="ignore"):
            off = np.abs(np.log(d / limit.value))
            goes = float(np.corrcoef(np.log(x), np.log(d))[0, 1]) if len(x) > 1 else 0.0
        told = {"limit": str(limit), "figure": limit.figure, "intensity": name}
        known = [fit.problem.code for fit in (counts, cloud) if fit.problem is not None]
        far = limit.value > 0.0 and np.log(_FAR) < off.min(initial=np.inf) < np.inf
        if far and counts.exceeded in (0, counts.runs) and (goes < 0.0) == limit.below:
            yield Refusal("report.fragility-far", **told, nearest=float(d[off.argmin()]))
        elif len(d) and len(known) == 2 and not {*known} & {*_TELL_LEVEL}:
            turned = str(replace(limit, below=not limit.below)) * (abs(goes) > _GOES)
            turned *= (goes < 0.0) != limit.below
            told |= {"reason": counts.problem, "turned": turned, "grows": goes > 0.0}
            yield Refusal("report.fragility-not-found", **told)


def _sample(
    sweep: Sweep, figure: str, intensity: str
) -> tuple[list[dict[str, str]], FloatArray, FloatArray]:
    """Runs that ended well and have both, their intensities and demands."""
    kept = [
        (row, x, np.inf if is_endless(figure, d) else d)
        for row in _done(sweep)
        if (x := real(row[intensity])) is not None and (d := real(row[figure])) is not None
    ]
    rows = [row for row, _, _ in kept]
    return rows, np.array([x for _, x, _ in kept]), np.array([d for _, _, d in kept])


def rows_of(fits: Iterable[Fit]) -> list[dict[str, object]]:
    """A table for machines."""
    return [
        {
            "limit": str(fit.limit), "intensity": fit.intensity, "method": fit.method,
            "runs": fit.runs, "exceeded": fit.exceeded, "governs": fit.worst.get("run"),
            **(asdict(fit.found) if fit.found else {}),
        }
        for fit in fits
    ]  # fmt: skip


def fragility_html(sweep: Sweep, fits: list[Fit], charts: Sequence[Chart], told: Teller) -> str:
    """The table of fragilities, what is to be known of it, and where its pictures go."""
    if not fits:
        return f'<p class="bad">{text(told("report.fragility-no-intensity"))}</p>'
    notes = "".join(f"<p class=note>{text(n)}</p>" for n in _notes(sweep, fits, told))
    heads = [told(code) for code in _HEADS]
    rows = [_row(sweep, fit, told) for fit in fits]
    return notes + table(heads, rows, (5, 6)) + charts_html(charts, "fragility", told)


def _row(sweep: Sweep, fit: Fit, told: Teller) -> list[str]:
    shown = ["", "", "", ""]
    if (f := fit.found) is not None:
        low, high = f.bounds()
        shown = [f"{f.median:.4g}", f"{low:.4g} … {high:.4g}", f"{f.dispersion:.3g}",
                 f"{f.dispersion_error:.2g}"]  # fmt: skip
        if np.isnan(f.median_error):
            shown[1], shown[3] = text(told("report.fragility-few", count=LEAST_RECORDS)), ""
        if fit.method == "cloud" and fit.exceeded in (0, fit.runs):
            shown[1] += f" ({text(told('report.fragility-beyond'))})"
    elif fit.problem is not None:
        shown[0] = text(told(fit.problem.code, **fit.problem.data))
    run = text(fit.worst.get("run", ""))
    link = link_to(sweep.folder, fit.worst["folder"]) if fit.worst else ""
    method = text(told(_METHODS[fit.method]))
    return [
        text(fit.limit).replace(" ", "&nbsp;"), text(fit.intensity), method, *shown,
        f"{fit.exceeded} / {fit.runs}", f'<a href="{link}">{run}</a>' if link else run,
    ]  # fmt: skip


def _notes(sweep: Sweep, fits: list[Fit], told: Teller) -> Iterator[str]:
    failed = sum(row["exit_code"] != "0" for row in sweep.rows)
    if failed:
        yield told("report.fragility-failed", count=failed)
    lacking = {(f.limit.figure, f.intensity): len(sweep.rows) - failed - f.runs for f in fits}
    for (figure, intensity), count in lacking.items():
        if 0 < count < len(sweep.rows) - failed:
            yield told("report.fragility-lacking", count=count, figure=figure, intensity=intensity)
    if MOTION in sweep.swept:
        count = len({row[MOTION] for row in sweep.rows})
        if count < len(sweep.rows):
            yield told("report.fragility-records", count=count)
    names = [n for n in dict.fromkeys(fit.intensity for fit in fits) if n in sweep.figures]
    for name in names:
        for run, ratio in _apart(sweep, name):
            yield told("report.fragility-apart", run=run, name=name, ratio=ratio)
    judged = [*names, *(fit.limit.figure for fit in fits)]
    for code, data in unscaled(sweep.folder, _done(sweep), sweep.swept, judged, names):
        yield told(code, **data)


def _apart(sweep: Sweep, name: str) -> Iterator[tuple[str, float]]:
    """Runs whose intensity is far from that of the others with the same settings, and how far."""
    groups: dict[tuple[str, ...], list[tuple[str, float]]] = {}
    for row in _done(sweep):
        if (x := real(row[name])) is not None and x > 0.0:
            key = tuple(row[n] for n in sweep.swept if n != MOTION)
            groups.setdefault(key, []).append((row["run"], np.log(x)))
    for group in groups.values():
        values = np.array([x for _, x in group])
        off = values - np.median(values)
        room = max(np.log(_APART), 4.0 * 1.4826 * float(np.median(np.abs(off))))
        if len(group) >= _FEWEST:
            yield from ((run, np.exp(o)) for (run, _), o in zip(group, off, strict=True)
                        if abs(o) > room)  # fmt: skip


def fragility_charts(sweep: Sweep, fits: list[Fit], told: Teller) -> list[Chart]:
    """Of each figure and intensity: the curves with what was counted, and the cloud."""
    made = []
    pairs: dict[tuple[str, str], list[Fit]] = {}
    for fit in fits:
        if fit.runs:
            pairs.setdefault((fit.limit.figure, fit.intensity), []).append(fit)
    for (figure, intensity), own in pairs.items():
        _, x, d = _sample(sweep, figure, intensity)
        lines = [line for fit in own for line in _lines(fit, x, d, told)]
        if lines:
            title = told("report.fragility-of", figure=figure, intensity=intensity)
            made.append(Chart("fragility", title, intensity, told("report.fragility-share"), lines))
        if (x > 0.0).all() and (d > 0.0).all() and np.isfinite(d).all():
            order = np.argsort(x, kind="stable")
            ends = np.array([x.min(), x.max()])
            limits = dict.fromkeys(fit.limit for fit in own)
            points = Line(told("report.sweep-runs"), x[order], d[order], points=True)
            cloud = [points, *(Line(str(m), ends, np.full(2, m.value)) for m in limits)]
            title = told("report.fragility-cloud-of", figure=figure, intensity=intensity)
            made.append(Chart("fragility", title, intensity, figure, cloud, (True, True)))
    return made


def _lines(fit: Fit, x: FloatArray, d: FloatArray, told: Teller) -> Iterator[Line]:
    """What was counted at each intensity, and the fit."""
    if fit.method == "counts":
        beyond = (d < fit.limit.value) if fit.limit.below else (d > fit.limit.value)
        levels, which = np.unique(x, return_inverse=True)
        shares = np.bincount(which, beyond.astype(float)) / np.bincount(which)
        yield Line(f"{fit.limit}, {told('report.sweep-runs')}", levels, shares, points=True)
    if (f := fit.found) is not None:
        low = max(x.min() / 3.0, min(x.min(), f.median * np.exp(-2.0 * f.dispersion)))
        high = min(x.max() * 3.0, max(x.max(), f.median * np.exp(2.0 * f.dispersion)))
        steep = f.median * np.exp(f.dispersion * np.linspace(-3.0, 3.0, _CURVE))
        grid = np.union1d(np.linspace(low, high, _CURVE), steep[(steep > low) & (steep < high)])
        method = told(_METHODS[fit.method])
        yield Line(f"{fit.limit}, {method}", grid, f.probability(grid))
