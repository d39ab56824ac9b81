"""The page of a report: what a folder of results holds as one HTML file that asks for nothing.

What is text stands in the file as HTML, so that it prints and needs no script; curves and scenes
stand in it as data, drawn by uPlot and vtk.js, which are in the file too.
"""

import base64
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from ssilang.io.atomic import write_text
from ssilang.kernel.base.arrays import FloatArray
from ssilang.language.vocabulary.unit_systems import SYSTEMS
from ssilang.messages.message import Teller, teller
from ssilang.report.charts import charts_html, charts_of
from ssilang.report.html import (
    Colours,
    asset,
    codes,
    deck_html,
    json_in_page,
    number,
    section,
    table,
    text,
)
from ssilang.report.results import Results, read_results
from ssilang.report.scenes import SceneError, guarded_scene
from ssilang.report.sweep_page import sweep_page
from ssilang.report.sweep_table import is_sweep, read_sweep
from ssilang.report.verdict import verdict_html

LARGEST = 20_000_000
"""Bytes of a report."""
PICTURES = 3_000_000
"""Bytes of the pictures that it holds."""
MOST_SCENES = 8


def page_of(results: Results, language: str, colours: Colours) -> str:
    """The page.

    Parameters
    ----------
    language : 'en' or 'fr'
    colours : callable
        Start, end and colour of the words of a deck.
    """
    told = teller(language)
    charts = charts_of(results, told)
    found = results.summary.get("warnings", ())
    rows = [
        f"<li>{text(told('report.line', line=w['line']) if w['line'] else '')} {text(w['text'])}"
        for w in found
    ]
    sections = [
        section("checks", told("report.checks"), _checks(results, told)),
        section("warnings", told("report.warnings"), f"<ul>{''.join(rows)}</ul>" if rows else ""),
    ]
    pictures, groups = _pictures(results, told), codes()["sections"].items()
    rest = [
        section("verdict", told("report.verdict"), verdict_html(results, charts, told)),
        *[section(g, told(c), charts_html(charts, g, told)) for g, c in groups],
        section("largest", told("report.largest"), _largest(results, told)),
        section("pictures", told("report.pictures"), pictures),
        section("runs", told("report.calculations"), _calculations(results, told)),
        section("deck", told("report.deck"), _deck(results, colours, told)),
        section("files", told("report.files"), _files(results)),
    ]
    data = json_in_page([c.told() for c in charts])
    other = "".join([*sections, *rest])
    held = ("vtk.js", "uPlot.iife.min.js", "charts.js", "scene.js", "page.css", "page.html")
    room = LARGEST - sum(len(x.encode()) for x in (other, data, *map(asset, held)))
    scenes, faults = _scenes(results, room, told)
    viewer = section("scene", told("report.scene"), _viewer(scenes, faults, told))
    body = [_head(results, told), sections[0], sections[1], viewer, *rest]
    return Template(asset("page.html")).substitute(
        language=language,
        title=text(_name(results)),
        version=text(results.summary.get("version", "")),
        style=asset("uPlot.min.css") + asset("page.css"),
        body="\n".join(b for b in body if b),
        charts=data,
        scenes=json_in_page([scene for scene, _ in scenes]),
        blobs="\n".join(
            f'<script type="application/octet-stream" id="scene-{i}">{packed}</script>'
            for i, (_, packed) in enumerate(scenes)
        ),
        words=json_in_page({w: told(code) for w, code in codes()["words"].items()}),
        vtk=asset("vtk.js") if scenes else "",
        uplot=asset("uPlot.iife.min.js") if charts else "",
        script=asset("charts.js") + asset("scene.js"),
        licences=text(asset("uPlot.LICENSE") + "\n" + asset("vtk.js.LICENSE")),
        made=text(told("report.made")),
        licence_title=text(told("report.licences")),
    )


# ---- pieces --------------------------------------------------------------------------------------


def _head(results: Results, told: Teller) -> str:
    summary = results.summary
    code = summary.get("exit_code")
    failed = [f for f in summary.get("figures", ()) if f["ok"] is False]
    judged = [f for f in summary.get("figures", ()) if f["ok"] is not None]
    state, word = "good", told("report.ran")
    if not summary:
        state, word = "bad", told("report.not-ended")
    elif code != 0:
        state, word = "bad", told("report.failed", code=code)
    lines = [
        f"<header><h1>{text(_name(results))}</h1>",
        f'<p class="state {state}">{text(word)}</p>',
    ]
    for error in summary.get("errors", ()):
        place = told("report.line", line=error["line"]) if error["line"] else ""
        lines.append(f'<p class="error">{text(place)} {text(error["text"])}</p>')
    cards = []
    if judged:
        good = f"{len(judged) - len(failed)} / {len(judged)}"
        cards.append((told("report.checks-held"), good, "bad" if failed else "good"))
    runs = _runs(results)
    off = [c for c in runs if c.get("energy_imbalance_from")]
    moving = [c for c in off if not c.get("static")]  # in statics it is one of load steps, no fault
    if worst := max((c.get("energy_imbalance") or 0.0 for c in moving or runs), default=0.0):
        mark = "warn" if moving else "" if off else "good"
        cards.append((told("report.energy-imbalance"), f"{100.0 * worst:.2g} %", mark))
    openings = _all(results, "opening_")
    openings += [
        np.array([x["value"]])
        for c in results.calculations for x in c.largest
        if x["kind"] == "OUVERTURE" and x["value"] is not None
    ]  # fmt: skip
    if openings:
        system = SYSTEMS.get(str((summary.get("units") or {}).get("system", "")))
        unit = "" if system is None else system.written("m")
        top = f"{max(float(v.max()) for v in openings):.4g} {unit}"
        cards.append((told("report.largest-opening"), top.strip(), ""))
    shares = _all(results, "share_")
    if shares:
        least = min(float(v.min()) for v in shares)
        cards.append((told("report.least-contact"), f"{100.0 * least:.3g} %", ""))
    count = len(summary.get("warnings", ()))
    if summary:
        cards.append((told("report.warnings"), str(count), "warn" if count else ""))
        cards.append((told("report.duration"), f"{summary.get('seconds', 0.0):.3g} s", ""))
    lines.append("<ul class=cards>")
    lines += [f'<li class="{m}"><b>{text(v)}</b> <span>{text(n)}</span></li>' for n, v, m in cards]
    lines.append("</ul>")
    lines.append(f"<p class=facts>{text(_facts(results, told))}</p>")
    lines += [f"<p class=note>{text(note)}</p>" for note in _notes(results, told)]
    return "\n".join([*lines, "</header>"])


def _all(results: Results, name: str) -> list[FloatArray]:
    """Histories of all footings by the beginning of their titles."""
    return [
        values
        for calculation in results.calculations
        for title, values in calculation.columns.items()
        if title.startswith(name) and len(values)
    ]


def _name(results: Results) -> str:
    """The deck's, without its folder."""
    return Path(results.deck).name or results.folder.name


def _facts(results: Results, told: Teller) -> str:
    summary = results.summary
    if not summary:
        return ""
    parts = [results.deck, f"ssilang {summary['version']}"]
    parts.append(told("report.statements", count=summary.get("statements", 0)))
    if summary.get("peak_memory_mb"):
        parts.append(told("report.memory", size=summary["peak_memory_mb"]))
    units = summary.get("units")
    if units:
        named = ", ".join(str(v) for k, v in units.items() if k != "system")
        parts.append(told("report.units", system=units["system"], units=named))
    else:
        parts.append(told("report.no-units"))
    return " · ".join(parts)


def _notes(results: Results, told: Teller) -> list[str]:
    notes = []
    if not results.recorded:
        notes.append(told("report.not-recorded"))
    left = results.left_out
    if left.get("calculations") or left.get("drawings"):
        notes.append(told("report.left-out", **left))
    if count := sum(c.footings_left for c in results.calculations):
        notes.append(told("report.footings-left", count=count))
    if results.unread:
        notes.append(told("report.unread", names=results.unread))
    return notes


def _runs(results: Results) -> list[dict[str, Any]]:
    statistics = results.summary.get("statistics", {})
    return statistics.get("calculations", [])


def _checks(results: Results, told: Teller) -> str:
    figures = results.summary.get("figures", ())
    if not figures:
        return ""
    marks = {True: told("report.held"), False: told("report.missed"), None: ""}
    rows = [
        (
            text(f["name"]), number(f["value"]), number(f["expected"]), number(f["tolerance"]),
            _meter(f),
            f'<b class="{"good" if f["ok"] else "bad"}">{text(marks[f["ok"]])}</b>',
        )
        for f in figures
    ]  # fmt: skip
    heads = [told(c) if c else "" for c in codes()["heads"]["checks"]]
    return table(heads, rows, (1, 2, 3))


def _meter(figure: dict[str, Any]) -> str:
    """How much of its tolerance a figure takes."""
    known = None not in (figure.get("value"), figure.get("expected"))
    if figure["ok"] is None or not figure["tolerance"] or not known:
        return ""
    part = abs(figure["value"] - figure["expected"]) / figure["tolerance"]
    return f'<meter min=0 max=1 high=1 value="{min(part, 1.0):.3g}"></meter> {100.0 * part:.3g} %'


def _largest(results: Results, told: Teller) -> str:
    rows = []
    kinds = {kind: told(code) for kind, code in codes()["kinds"].items()}
    for i, calculation in enumerate(results.calculations, 1):
        found = sorted(calculation.largest, key=lambda x: list(kinds).index(x["kind"]))
        for peak in found:
            if peak["value"] == 0.0 and peak["component"]:
                continue
            name = f"{kinds[peak['kind']]} {peak['component']}".strip()
            place = " ".join(f"{x:.4g}" for x in peak["place"])
            rows.append(
                (
                    text(f"{calculation.name} {i}"), text(name), number(peak["value"]),
                    number(peak["time"]), text(place),
                )
            )  # fmt: skip
    if not rows:
        return ""
    heads = list(map(told, codes()["heads"]["largest"]))
    return table(heads, rows, (2, 3))


def _calculations(results: Results, told: Teller) -> str:
    rows = [
        (
            text(f"{c.get('procedure', '')} {i}"), number(c.get("unknowns")),
            number(c.get("interface_unknowns")), number(c.get("steps")), text(c.get("method", "")),
            text(c.get("solver", "")), number(c.get("most_interface_iterations")),
            number(c.get("energy_imbalance")), number(c.get("seconds")),
        )
        for i, c in enumerate(_runs(results), 1)
    ]  # fmt: skip
    if not rows:
        return ""
    heads = list(map(told, codes()["heads"]["calculations"]))
    return table(heads, rows, (1, 2, 3, 6, 7, 8))


def _deck(results: Results, colours: Colours, told: Teller) -> str:
    if not results.text:
        return f"<p class=note>{text(told('report.deck-gone'))}</p>"
    lines = [m["line"] for m in results.summary.get("errors", ()) if m["line"]]
    return deck_html(results.text, colours, lines)


def _files(results: Results) -> str:
    rows = [
        (text(f["path"]), f"{f['bytes'] / 1000.0:,.1f} kB")
        for f in results.summary.get("files", ())
    ]
    if not rows:
        return ""
    return "<details>" + "<summary>" + str(len(rows)) + "</summary>" + table(
        ("", ""), rows, (1,)
    ) + "</details>"  # fmt: skip


def _pictures(results: Results, told: Teller) -> str:
    made, left, room = [], 0, PICTURES
    for path in results.pictures:
        try:
            data = path.read_bytes() if path.stat().st_size <= room else b""
        except OSError:
            data = b""
        if not data or len(data) > room:
            left += 1
            continue
        room -= len(data)
        encoded = base64.b64encode(data).decode()
        made.append(
            f'<figure><img alt="{text(path.name)}" src="data:image/png;base64,{encoded}">'
            f"<figcaption>{text(path.name)}</figcaption></figure>"
        )
    if left:
        made.append(f"<p class=note>{text(told('report.pictures-left', count=left))}</p>")
    return f"<div class=charts>{''.join(made)}</div>" if made else ""


# ---- scenes --------------------------------------------------------------------------------------

Scene = tuple[dict[str, Any], str]


def _scenes(results: Results, room: int, told: Teller) -> tuple[list[Scene], list[str]]:
    """What can be shown, with its data, and why the rest cannot."""
    wanted: list[tuple[str, str, Any, list[float]]] = [
        (f"{c.name} {i}", "motion", c.scene, [])
        for i, c in enumerate(results.calculations, 1)
        if c.scene is not None
    ]
    wanted += [
        (told("report.modes", name=s.name) if s.kind == "modes" else s.name, s.kind, s.scene,
         s.frequencies)
        for s in results.shapes
    ]  # fmt: skip
    if not wanted:
        wanted = [(p.name, "motion", p, []) for p in results.series]
    made: list[Scene] = []
    faults = []
    each = int(0.98 * room / max(min(len(wanted), MOST_SCENES), 1))
    for name, kind, path, frequencies in wanted[:MOST_SCENES]:
        try:
            scene, packed = guarded_scene(path, each)
        except SceneError as problem:
            faults.append(told(problem.code, **problem.data))
            continue
        shown = name or told("report.mesh")
        if scene["left_out"]:
            count = scene["left_out"]
            faults.append(told("report.instants-left", name=path.name, count=count))
        made.append(({"name": shown, "kind": kind, "frequencies": frequencies, **scene}, packed))
    if len(wanted) > MOST_SCENES:
        faults.append(told("report.scenes-left", count=len(wanted) - MOST_SCENES))
    return made, faults


def _viewer(scenes: list[Scene], faults: list[str], told: Teller) -> str:
    notes = "".join(f"<p class=note>{text(f)}</p>" for f in dict.fromkeys(faults))
    if not scenes:
        return notes
    words = {w: text(told(code)) for w, code in codes()["viewer"].items()}
    options = "".join(
        f"<option value={i}>{text(s['name'])}</option>" for i, (s, _) in enumerate(scenes)
    )
    return notes + Template(asset("viewer.html")).substitute(options=options, **words)


NAME = "report.html"


def make_report(folder: Path, language: str, colours: Colours) -> Path:
    """Write the report of a folder, of a run or a sweep, into it.

    Parameters
    ----------
    language : 'en' or 'fr'
    colours : callable
        Start, end and colour of the words of a deck.

    Raises
    ------
    InputError, OutputError
        If no run has left anything there, or it cannot be written.
    """
    path = folder / NAME
    if is_sweep(folder):
        write_text(path, sweep_page(read_sweep(folder), language))
    else:
        write_text(path, page_of(read_results(folder), language, colours))
    return path
