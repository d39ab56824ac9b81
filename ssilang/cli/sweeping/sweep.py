"""The command: plan the runs, skip those that are done, run the rest, write the table."""

import os
import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

from ssilang.cli.run import deck_of, refuse_unknown, values_lost, write_report
from ssilang.cli.sweeping.given import Case, GivenError, cases_of, folder_names
from ssilang.cli.sweeping.histories import Joined, join_histories
from ssilang.cli.sweeping.pool import (
    can_share,
    dask_installed,
    one_thread,
    run_all,
    run_alone,
    run_on_cluster,
)
from ssilang.cli.sweeping.table import (
    draw_figures,
    figures_in,
    idle_names,
    write_plain_table,
    write_table,
)
from ssilang.cli.sweeping.worker import Row, Task, row_of
from ssilang.io.atomic import resolved
from ssilang.io.checkpoint import digest_of_file
from ssilang.io.errors import OutputError
from ssilang.io.ground_motions.suite import motion_in, peaks_apart, units_named, vertical
from ssilang.io.run_output import link_to
from ssilang.io.tables import is_there
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import first_assignments
from ssilang.messages.message import Sentence, Teller, sentence, teller
from ssilang.operators.session.progress import ProgressLine
from ssilang.report.fragilities import (
    ASKED,
    Asked,
    amiss,
    fits_of,
    read_limits,
    rows_of,
    unknown,
)
from ssilang.report.sweep_table import MOTION, read_sweep, unscaled, usual_intensities, warnings_of
from ssilang.system import system_reason

TABLE, PLAIN_TABLE, FITS = "sweep.parquet", "sweep.csv", "fragility.csv"


@dataclass
class SweepOptions:
    """What the command line, or Python, says of a sweep."""

    deck: Path
    settings: list[str] = field(default_factory=list)
    motions: Path | None = None
    out: Path | None = None
    jobs: int = 0  # 0: one a core
    scheduler: str = ""
    allowed: list[Path] = field(default_factory=list)
    language: str = "en"
    report: bool = False
    """Whether each run and the sweep leave a report."""
    fragility: list[str] = field(default_factory=list)
    """Limits, as `NAME>VALUE`: the sweep leaves a page with their fragilities."""
    intensity: list[str] = field(default_factory=list)
    """Figures that are intensities; none: those that are known as such."""

    @property
    def folder(self) -> Path:
        """Where runs, tables and pictures go."""
        return resolved(self.out or Path("results") / f"{self.deck.stem}_sweep")


_IN_SI = re.compile(r"\bLIRE\b[^;]*\bSI\b", re.IGNORECASE)
"""Records that a script reads in SI."""


def sweep(options: SweepOptions, out: TextIO, err: TextIO) -> int:
    """Run a sweep; returns the exit code: 1 if a run failed, 2 for a wrong command.

    Runs that an earlier sweep of the same folder finished are taken from there.
    """
    try:
        return _swept(options, out, err)
    except OutputError as problem:
        told = SsiError.of(problem, None)
    except SsiError as error:
        told = error
    err.write(render(told, options.language) + "\n")
    return 2


def _swept(options: SweepOptions, out: TextIO, err: TextIO) -> int:
    """The exit code of a sweep that could be made."""
    asked = _asked(options)
    link = None if options.out else link_to(Path("results") / f"{options.deck.stem}_sweep")
    if link is not None:
        raise SsiError("io.folder-is-link", None, path=link)
    cases = _checked_cases(options, err)
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        told = {"path": options.folder, "reason": system_reason(fault)}
        raise SsiError("cli.out-no-folder", None, **told) from None
    rows = run_cases(cases, options, out, err)
    made = write_results(rows, list(cases[0].values), options.folder)
    _tell_left(made, options.language, err)
    _tell_warnings(rows, list(cases[0].values), options, err)
    missing = _judge(options, asked, err)
    if options.report:
        out.write(write_reports(rows, options) + "\n")
    elif asked.limits:
        out.write(write_report(options.folder, options.language) + "\n")
    out.write(sentence("cli.swept", made, options.language) + "\n")
    return 2 if missing else 1 if made["failed"] else 0


def _asked(options: SweepOptions) -> Asked:
    """Limits and intensities of the command.

    Raises
    ------
    SsiError
        For one that cannot be read, or intensities without any.
    """
    limits = []
    for text in options.fragility:
        if not (found := read_limits(text)):
            raise SsiError("cli.not-a-limit", None, text=text)
        limits += found
    if options.intensity and not limits:
        raise SsiError("cli.intensity-without-fragility", None, names=options.intensity)
    return Asked(limits, options.intensity)


def _judge(options: SweepOptions, asked: Asked, err: TextIO) -> bool:
    """Leave what was asked for beside the table, and the fits; whether a name is unknown."""
    if not asked.limits:
        for name in (ASKED, FITS):
            (options.folder / name).unlink(missing_ok=True)
        return False
    asked.write(options.folder)
    made = read_sweep(options.folder)
    fits = fits_of(made, asked)
    write_plain_table(rows_of(fits), options.folder / FITS)
    if all(row["exit_code"] != "0" for row in made.rows):
        return False
    for found in amiss(made, fits):
        err.write(render(SsiError.of(found, None), options.language) + "\n")
    return _tell_unknown(asked, [*made.figures, *made.swept], options, err)


def _tell_unknown(asked: Asked, names: Sequence[str], options: SweepOptions, err: TextIO) -> bool:
    """Tell which figures no run has; whether there are any."""
    missing = unknown(asked, names)
    for problem in missing:
        err.write(render(SsiError.of(problem, None), options.language) + "\n")
    return bool(missing)


def run_cases(cases: Sequence[Case], options: SweepOptions, out: TextIO, err: TextIO) -> list[Row]:
    """Rows of all cases, in order; those that the folder has are not run again.

    Raises
    ------
    SsiError
        If the script cannot be read, does not have a name that is given a value, or a run would
        write into a folder that is a link.
    """
    source = read_source(options.deck)
    _check_names(source, cases[0].values, options, err)
    _tell_motions(cases, source, options.language, err)
    tasks = [
        _task(case, options, options.folder / "runs" / name)
        for case, name in zip(cases, folder_names(cases), strict=True)
    ]
    places = (options.folder / "runs", options.folder / "histories", *(t.folder for t in tasks))
    if link := next(filter(Path.is_symlink, places), None):
        raise SsiError("io.folder-is-link", None, path=link)
    found = {task.number: row_of(task, deck_of(source, task.values)) for task in tasks}
    rows = {number: row for number, row in found.items() if isinstance(row, dict)}
    reasons = [why for why in found.values() if isinstance(why, Sentence)]
    count = Counter(map(str, reasons))
    for text, why in {str(why): why for why in reasons}.items():
        told = {"count": count[text], "reason": why}
        err.write(sentence("cli.runs-again", told, options.language) + "\n")
    if rows:
        done = sentence("cli.runs-done", {"done": len(rows), "total": len(tasks)}, options.language)
        out.write(done + "\n")
    waiting = [task for task in tasks if task.number not in rows]
    asked, named = _asked(options), bool(rows)
    for row in _progress(_run(waiting, options, err), len(waiting), teller(options.language), err):
        rows[row["run"]] = row
        if row["exit_code"] == 0 and not named:  # not only in the morning
            named = True
            _tell_unknown(asked, list(row), options, err)
        if row["exit_code"] != 0:
            failure = {"number": row["run"], "error": row["error"], "folder": row["folder"]}
            err.write(sentence("cli.run-failed", failure, options.language) + "\n")
    return [rows[k] for k in sorted(rows)]


def _check_names(
    source: Source, values: Collection[str], options: SweepOptions, err: TextIO
) -> None:
    """Refuse a name that the script does not have, tell of one that it does not read.

    A script that cannot be read says so in each run.
    """
    with suppress(SeveralErrors):
        body = parse(source).body
        assigned = first_assignments(body)
        for _, told in values_lost(source, body, values):
            err.write(sentence("cli.value-lost", told, options.language) + "\n")
        for name in values:
            if name not in assigned:
                refuse_unknown(name, source, assigned)
            if len(re.findall(rf"\b{re.escape(name)}\b", source.code, re.IGNORECASE)) < 2:
                err.write(sentence("cli.value-unread", {"name": name}, options.language) + "\n")


def _checked_cases(options: SweepOptions, err: TextIO) -> list[Case]:
    left: list[Path] = []
    try:
        if options.scheduler and not dask_installed():
            raise GivenError("cli.cluster-needs-dask-distributed")
        cases = cases_of(options.settings, options.motions, left)
    except GivenError as problem:
        raise SsiError.of(problem, None) from problem
    if left:
        told = {"count": len(left), "names": [p.name for p in left]}
        err.write(sentence("cli.files-no-motions", told, options.language) + "\n")
    return cases


def _tell_motions(cases: Sequence[Case], source: Source, language: str, err: TextIO) -> None:
    """Name motions whose files hold the same, and those whose numbers are in other units."""
    paths = dict.fromkeys(Path(str(c.values[MOTION])) for c in cases if MOTION in c.values)
    read, known = {p: motion_in(p) for p in paths}, dict[object, list[str]]()
    for path, m in read.items():
        held = digest_of_file(path) if m is None else m.motion
        known.setdefault(held, []).append(path.name)
    told: list[tuple[str, dict[str, object]]] = [
        ("cli.same-motions", {"names": names}) for names in known.values() if len(names) > 1
    ]
    motions = {p.name: m for p, m in read.items() if m is not None}
    if 0 < len(upward := vertical(motions)) < len(motions):
        told.append(("cli.motions-vertical", {"names": upward}))
    in_si = _IN_SI.search(source.code) is not None
    if not in_si and (units := units_named(motions)):
        told.append(("cli.motions-of-other-units", {"units": [*map(" ".join, units.items())]}))
    elif peaks := peaks_apart(motions, in_si):
        told.append(("cli.motions-far-apart", {"names": [*peaks], "peak": max(peaks.values())}))
    for code, data in told:
        err.write(sentence(code, data, language) + "\n")


def _task(case: Case, options: SweepOptions, folder: Path) -> Task:
    allowed = tuple(map(resolved, options.allowed))
    deck = options.deck.resolve()
    return Task(
        case.number, deck, folder, case.values, allowed, options.language, report=options.report
    )


def _run(tasks: list[Task], options: SweepOptions, err: TextIO) -> Iterator[dict[str, Any]]:
    if options.scheduler:
        return run_on_cluster(tasks, options.scheduler)
    jobs = options.jobs or os.cpu_count() or 1
    one_thread()
    if tasks and not can_share():
        err.write(sentence("cli.sweep-in-one-process", {}, options.language) + "\n")
        return run_alone(tasks)
    return run_all(tasks, max(min(jobs, len(tasks)), 1))


def _progress(
    rows: Iterator[dict[str, Any]], total: int, told: Teller, err: TextIO
) -> Iterator[dict[str, Any]]:
    """The same rows, with a line of progress at a terminal."""
    line = ProgressLine(told("cli.runs"), told, err)
    for done, row in enumerate(rows, start=1):
        line(done, total)
        yield row
    line.close()


def write_results(rows: list[Row], swept: list[str], folder: Path) -> dict[str, object]:
    """Write tables and pictures; what to say of them."""
    table = folder / PLAIN_TABLE
    write_plain_table(rows, table)
    if is_there():
        table = folder / TABLE
        write_table(rows, table)
    pictures = draw_figures(rows, swept, folder)
    joined = join_histories(rows, swept, folder)
    failed = sum(row["exit_code"] != 0 for row in rows)
    return {
        "figures": len(figures_in(rows, swept)),
        "runs": len(rows),
        "failed": failed,
        "table": table,
        "pictures": len(pictures),
        "joined": joined,
        "histories": len(joined.files),
    }


def _tell_left(made: dict[str, object], language: str, err: TextIO) -> None:
    """Name what was not joined."""
    joined = made["joined"]
    assert isinstance(joined, Joined)
    if not made["figures"] and made["failed"] != made["runs"]:
        err.write(sentence("cli.sweep-without-figures", {}, language) + "\n")
    if joined.others:
        told = {"count": joined.others}
        err.write(sentence("cli.histories-other-columns", told, language) + "\n")
    if joined.large:
        err.write(sentence("cli.histories-too-large", {"names": joined.large}, language) + "\n")


def _tell_warnings(
    rows: Sequence[Row], swept: list[str], options: SweepOptions, err: TextIO
) -> None:
    """What runs were warned of, once each; names whose values change nothing."""
    told = [("cli.sweep-warning", vars(w)) for w in warnings_of(options.folder, rows)]
    script = options.deck.read_text(encoding="utf-8", errors="replace")
    done = [row for row in rows if row["exit_code"] == 0]
    idle = [name for name in idle_names(done, swept) if not _chooses(name, script)]
    told += [("cli.value-idle", {"name": name}) for name in idle]
    figures = figures_in(done, swept)
    known = options.intensity or usual_intensities(figures)
    told += unscaled(options.folder, done, swept, figures, known)
    for code, data in told:
        err.write(sentence(code, data, options.language) + "\n")


def _chooses(name: str, script: str) -> bool:
    """Whether a script reads a number to compare it alone: it chooses a way to the same figures."""
    read, compared = rf"\b{re.escape(name)}\b", r"(?:EGA|NEG|>EG|<EG|>|<)"
    reads, given, asks = (
        len(re.findall(pattern, script, re.IGNORECASE))
        for pattern in (read, rf"{read}\s*=", rf"{read}\s*{compared}|{compared}\s*{read}")
    )
    return 0 < asks == reads - given


def write_reports(rows: Sequence[Row], options: SweepOptions) -> str:
    """Write the sweep's report, and those of runs of an earlier sweep that left none."""
    for row in rows:
        folder = options.folder / "runs" / str(row["folder"])
        if (folder / "summary.json").is_file() and not (folder / "report.html").is_file():
            write_report(folder, options.language)
    return write_report(options.folder, options.language)
