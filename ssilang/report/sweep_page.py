"""The page of a sweep: a table of runs that leads to theirs, figures over what was swept."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from string import Template
from urllib.parse import quote

import numpy as np

from ssilang.io.errors import InputError
from ssilang.io.file_names import inside
from ssilang.messages.message import Teller, teller
from ssilang.report.charts import Chart, Line, charts_html
from ssilang.report.html import asset, json_in_page, number, section, table, text
from ssilang.report.records import MOST_BYTES

TABLE, RUNS = "sweep.csv", "runs"
MOST_RUNS = 5000
"""Rows of the table."""
MOST_LINES = 12
"""Curves of a picture."""


@dataclass(frozen=True)
class Sweep:
    """A folder of a sweep: rows of its table by title, as they are written.

    Attributes
    ----------
    swept, figures : lists of str
        Titles of what was given and of what runs reported.
    """

    folder: Path
    rows: list[dict[str, str]]
    swept: list[str]
    figures: list[str]


def is_sweep(folder: Path) -> bool:
    """Whether a folder has the table and the runs of a sweep."""
    return inside(folder, TABLE) is not None and (folder / RUNS).is_dir()


def read_sweep(folder: Path) -> Sweep:
    """Read the table of a sweep.

    Raises
    ------
    InputError
        If it is damaged.
    """
    path = folder / TABLE
    try:
        if path.stat().st_size > MOST_BYTES:
            raise ValueError(f"more than {MOST_BYTES // 10**6} MB")
        with path.open(encoding="utf-8", newline="") as file:
            reader = csv.DictReader(file, delimiter=";")
            rows = [{k: v or "" for k, v in row.items() if k} for row in reader]
            titles = list(reader.fieldnames or [])
    except (OSError, ValueError, csv.Error) as problem:
        raise InputError("report.damaged", path=path, problem=problem) from None
    if not {"run", "exit_code", "seconds", "error", "folder"} <= set(titles) or not rows:
        raise InputError("report.not-a-sweep", path=path)
    swept = list(takewhile(lambda t: t != "exit_code", titles[1:]))
    own = {"run", "exit_code", "seconds", "error", "folder", *swept}
    return Sweep(folder, rows, swept, [t for t in titles if t not in own])


def sweep_page(sweep: Sweep, language: str) -> str:
    """The page.

    Parameters
    ----------
    language : 'en' or 'fr'
    """
    from ssilang import __version__

    told = teller(language)
    charts = _charts(sweep, told)
    body = [
        _head(sweep, told),
        section("figures", told("report.sweep-figures"), charts_html(charts, "sweep", told)),
        section("sweep", told("report.sweep-runs"), _runs(sweep, told)),
        section("histories", told("report.sweep-histories"), _histories(sweep, told)),
    ]
    words = {
        "all": "report.show-all", "zoomIn": "report.zoom-in", "zoomOut": "report.zoom-out",
    }  # fmt: skip
    return Template(asset("page.html")).substitute(
        language=language,
        title=text(sweep.folder.name),
        version=text(__version__),
        style=asset("uPlot.min.css") + asset("page.css"),
        body="\n".join(b for b in body if b),
        charts=json_in_page([c.told() for c in charts]),
        scenes="[]",
        blobs="",
        words=json_in_page({w: told(code) for w, code in words.items()}),
        vtk="",
        uplot=asset("uPlot.iife.min.js") if charts else "",
        script=asset("charts.js"),
        licences=text(asset("uPlot.LICENSE")),
        made=text(told("report.made")),
        licence_title=text(told("report.licences")),
    )


def _head(sweep: Sweep, told: Teller) -> str:
    failed = sum(row["exit_code"] != "0" for row in sweep.rows)
    state = ("bad", told("report.sweep-failed", count=failed)) if failed else (
        "good", told("report.sweep-ran"))  # fmt: skip
    seconds = sum(_real(row["seconds"]) or 0.0 for row in sweep.rows)
    cards = [
        (told("report.sweep-runs"), str(len(sweep.rows))),
        *((name, _span(sweep, name)) for name in sweep.swept),
        (told("report.sweep-seconds"), f"{seconds:.3g} s"),
    ]
    shown = "".join(f"<li><b>{text(v)}</b> <span>{text(n)}</span></li>" for n, v in cards)
    return (
        f"<header><h1>{text(sweep.folder.name)}</h1>"
        f'<p class="state {state[0]}">{text(state[1])}</p><ul class=cards>{shown}</ul></header>'
    )


def _span(sweep: Sweep, name: str) -> str:
    """Values of a name: both ends of numbers, how many words."""
    values = list(dict.fromkeys(row[name] for row in sweep.rows))
    numbers = [x for v in values if (x := _real(v)) is not None]
    if len(numbers) == len(values):
        low, high = f"{min(numbers):g}", f"{max(numbers):g}"
        return low if low == high else f"{low} … {high}"
    return _short(values[0]) if len(values) == 1 else str(len(values))


def _short(value: str) -> str:
    """A motion's path by its name, other values as they are."""
    return Path(value).name if "/" in value or "\\" in value else value


def _runs(sweep: Sweep, told: Teller) -> str:
    """The table of runs; the number of each leads to its report, or to what it printed."""
    heads = ["", *sweep.swept, *sweep.figures, told("report.seconds"), told("report.sweep-error")]
    rows = []
    for row in sweep.rows[:MOST_RUNS]:
        name = text(row["run"])
        link = _link(sweep.folder, row["folder"])
        error = f'<b class="bad">{text(row["error"])}</b>' if row["exit_code"] != "0" else ""
        rows.append(
            [
                f'<a href="{link}">{name}</a>' if link else name,
                *(text(_short(row[n])) for n in sweep.swept),
                *(number(_real(row[n])) or text(row[n]) for n in sweep.figures),
                number(_real(row["seconds"])),
                error,
            ]
        )
    note = ""
    if len(sweep.rows) > MOST_RUNS:
        note = f"<p class=note>{text(told('report.sweep-rows-left', count=MOST_RUNS))}</p>"
    plain = [i for i in range(1, len(heads) - 1) if heads[i] != "MOTION"]
    return note + table(heads, rows, [0, *plain])


def _link(folder: Path, run: str) -> str:
    """Where a run's page stands, seen from the sweep's folder; '' if it has none."""
    for name in ("report.html", "output.txt"):
        if run and inside(folder / RUNS, f"{run}/{name}") is not None:
            return text(f"{RUNS}/{quote(run)}/{name}")
    return ""


def _histories(sweep: Sweep, told: Teller) -> str:
    """Joined tables."""
    folder = sweep.folder / "histories"
    found = sorted(p for p in folder.glob("*") if inside(sweep.folder, f"histories/{p.name}"))
    rows = [
        (
            f'<a href="{text(quote(f"histories/{p.name}"))}">{text(p.name)}</a>',
            f"{p.stat().st_size / 1000.0:,.1f} kB",
        )
        for p in found
    ]
    if not rows:
        return ""
    return f"<p class=note>{text(told('report.sweep-joined'))}</p>" + table(("", ""), rows, (1,))


def _charts(sweep: Sweep, told: Teller) -> list[Chart]:
    """One picture a figure over the first name that takes several numbers."""
    axis = next((n for n in sweep.swept if _varies(sweep, n)), None)
    if axis is None:
        return []
    others = [n for n in sweep.swept if n != axis]
    made = []
    for figure in sweep.figures:
        groups: dict[str, list[tuple[float, float]]] = {}
        for row in sweep.rows:
            x, y = _real(row[axis]), _real(row[figure])
            if x is not None and y is not None:
                groups.setdefault(_label(row, others), []).append((x, y))
        lines = [
            Line(label or figure, *np.array(sorted(points)).T) for label, points in groups.items()
        ]
        left = len(lines) - MOST_LINES
        title = figure if left <= 0 else f"{figure} ({told('report.sweep-lines-left', count=left)})"
        if lines:
            made.append(Chart("sweep", title, axis, figure, lines[:MOST_LINES]))
    return made


def _label(row: dict[str, str], names: Sequence[str]) -> str:
    parts = [Path(row[n]).stem if n == "MOTION" else f"{n} = {row[n]}" for n in names]
    return ", ".join(parts)


def _varies(sweep: Sweep, name: str) -> bool:
    values = {_real(row[name]) for row in sweep.rows}
    return None not in values and len(values) > 1


def _real(value: str) -> float | None:
    try:
        found = float(value)
    except ValueError:
        return None
    return found if math.isfinite(found) else None
