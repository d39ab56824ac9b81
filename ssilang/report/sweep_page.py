"""The page of a sweep: a table of runs that leads to theirs, figures over what was swept."""

from string import Template
from urllib.parse import quote

from ssilang import __version__
from ssilang.io.atomic import inside
from ssilang.messages.message import Teller, teller
from ssilang.report import fragilities, sweep_table
from ssilang.report.charts import Chart, Line, charts_html
from ssilang.report.html import asset, codes, json_in_page, number, section, table, text

MOST_RUNS = 5000
"""Rows of the table."""
MOST_LINES = 12
"""Curves of a picture."""


def sweep_page(sweep: sweep_table.Sweep, language: str) -> str:
    """The page.

    Parameters
    ----------
    language : 'en' or 'fr'
    """
    told = teller(language)
    asked = fragilities.asked_of(sweep.folder)
    fits = [] if asked is None else fragilities.fits_of(sweep, asked)
    charts = [
        *fragilities.fragility_charts(sweep, fits, told),
        *fragilities.floor_charts(sweep, told),
        *_charts(sweep, told),
    ]
    fragility = "" if asked is None else fragilities.fragility_html(sweep, fits, charts, told)
    body = [
        _head(sweep, told),
        section("fragility", told("report.fragility"), fragility),
        section("floors", told("report.sweep-floors"), charts_html(charts, "floors", told)),
        section("figures", told("report.sweep-figures"), charts_html(charts, "sweep", told)),
        section("warnings", told("report.warnings"), _warnings(sweep, told)),
        section("sweep", told("report.sweep-runs"), _runs(sweep, told)),
        section("histories", told("report.sweep-histories"), _histories(sweep, told)),
    ]
    return Template(asset("page.html")).substitute(
        language=language,
        title=text(sweep.folder.name),
        version=text(__version__),
        style=asset("uPlot.min.css") + asset("page.css"),
        body="\n".join(b for b in body if b),
        charts=json_in_page([c.told() for c in charts]),
        scenes="[]",
        blobs="",
        words=json_in_page({w: told(codes()["words"][w]) for w in ("all", "zoomIn", "zoomOut")}),
        vtk="",
        uplot=asset("uPlot.iife.min.js") if charts else "",
        script=asset("charts.js"),
        licences=text(asset("uPlot.LICENSE")),
        made=text(told("report.made")),
        licence_title=text(told("report.licences")),
    )


def _head(sweep: sweep_table.Sweep, told: Teller) -> str:
    failed = sum(row["exit_code"] != "0" for row in sweep.rows)
    state = ("bad", told("report.sweep-failed", count=failed)) if failed else (
        "good", told("report.sweep-ran"))  # fmt: skip
    if runs := sweep_table.edited(sweep):
        state = "bad", told("report.sweep-edited", count=len(runs), runs=runs[:MOST_LINES])
    seconds = sum(sweep_table.real(row["seconds"]) or 0.0 for row in sweep.rows)
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


def _span(sweep: sweep_table.Sweep, name: str) -> str:
    """Values of a name: both ends of numbers, how many words."""
    values = list(dict.fromkeys(row[name] for row in sweep.rows))
    numbers = [x for v in values if (x := sweep_table.real(v)) is not None]
    if len(numbers) == len(values):
        low, high = f"{min(numbers):g}", f"{max(numbers):g}"
        return low if low == high else f"{low} … {high}"
    return sweep_table.short(values[0]) if len(values) == 1 else str(len(values))


def _warnings(sweep: sweep_table.Sweep, told: Teller) -> str:
    """What runs were warned of."""
    found = [
        told("cli.sweep-warning", **vars(w))
        for w in sweep_table.warnings_of(sweep.folder, sweep.rows)
    ]
    return f"<ul>{''.join(f'<li>{text(t)}' for t in found)}</ul>" if found else ""


def _runs(sweep: sweep_table.Sweep, told: Teller) -> str:
    """The table of runs; the number of each leads to its report, or to what it printed."""
    heads = ["", *sweep.swept, *sweep.figures, told("report.seconds"), told("report.sweep-error")]
    rows = []
    for row in sweep.rows[:MOST_RUNS]:
        name = text(row["run"])
        link = sweep_table.link_to(sweep.folder, row["folder"])
        error = f'<b class="bad">{text(row["error"])}</b>' if row["exit_code"] != "0" else ""
        rows.append(
            [
                f'<a href="{link}">{name}</a>' if link else name,
                *(text(sweep_table.short(row[n])) for n in sweep.swept),
                *(number(sweep_table.real(row[n])) or text(row[n]) for n in sweep.figures),
                number(sweep_table.real(row["seconds"])),
                error,
            ]
        )
    note = ""
    if len(sweep.rows) > MOST_RUNS:
        note = f"<p class=note>{text(told('report.sweep-rows-left', count=MOST_RUNS))}</p>"
    plain = [i for i in range(1, len(heads) - 1) if heads[i] != sweep_table.MOTION]
    return note + table(heads, rows, [0, *plain])


def _histories(sweep: sweep_table.Sweep, told: Teller) -> str:
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


def _charts(sweep: sweep_table.Sweep, told: Teller) -> list[Chart]:
    """One picture a figure over the first name that takes several numbers."""
    axis = next((n for n in sweep.swept if _varies(sweep, n)), None)
    if axis is None:
        return []
    others = [n for n in sweep.swept if n != axis]
    made = []
    for figure in sweep.figures:
        groups = sweep_table.grouped(sweep.rows, axis, figure, others)
        lines = [Line(label or figure, x, y) for label, (x, y) in groups.items()]
        left = len(lines) - MOST_LINES
        title = figure if left <= 0 else f"{figure} ({told('report.sweep-lines-left', count=left)})"
        if lines:
            made.append(Chart("sweep", title, axis, figure, lines[:MOST_LINES]))
    return made


def _varies(sweep: sweep_table.Sweep, name: str) -> bool:
    values = {sweep_table.real(row[name]) for row in sweep.rows}
    return None not in values and len(values) > 1
