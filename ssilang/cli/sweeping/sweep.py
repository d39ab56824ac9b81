"""The command: plan the runs, skip those that are done, run the rest, write the table."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

from ssilang.cli.sweeping.given import Case, GivenError, cases_of, folder_names
from ssilang.cli.sweeping.pool import dask_installed, one_thread, run_on_cluster
from ssilang.cli.sweeping.table import (
    can_write,
    draw_figures,
    write_plain_table,
    write_table,
)
from ssilang.cli.sweeping.trunk import run_all
from ssilang.cli.sweeping.worker import Task, row_of
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SsiError
from ssilang.messages.message import Teller, sentence, teller
from ssilang.system_reasons import system_reason

TABLE, PLAIN_TABLE = "sweep.parquet", "sweep.csv"
TOGETHER = 8
"""Runs that go side by side in a process: more gain little and hold more memory."""


@dataclass
class SweepOptions:
    """What the command line says of a sweep."""

    deck: Path
    settings: list[str] = field(default_factory=list)
    motions: Path | None = None
    out: Path | None = None
    jobs: int = 0  # 0: one a core
    scheduler: str = ""
    allowed: list[Path] = field(default_factory=list)
    language: str = "en"
    together: int = TOGETHER


def sweep(options: SweepOptions, out: TextIO, err: TextIO) -> int:
    """Run a sweep; returns the exit code: 1 if a run failed, 2 for a wrong command.

    Runs that an earlier sweep of the same folder finished are taken from there.
    """
    try:
        cases = _checked_cases(options, err)
        text = options.deck.read_text(encoding="utf-8", errors="replace")
    except GivenError as problem:
        err.write(render(SsiError.of(problem, None), options.language) + "\n")
        return 2
    except OSError as problem:
        lost = SsiError("missing-file", None, path=options.deck, reason=system_reason(problem))
        err.write(render(lost, options.language) + "\n")
        return 2
    folder = (options.out or Path("results") / f"{options.deck.stem}_sweep").resolve()
    tasks = [
        _task(case, options, folder / "runs" / name, case.key(text))
        for case, name in zip(cases, folder_names(cases), strict=True)
    ]
    rows = {task.number: row for task in tasks if (row := row_of(task)) is not None}
    if rows:
        done = sentence("cli.runs-done", {"done": len(rows), "total": len(tasks)}, options.language)
        out.write(done + "\n")
    waiting = [task for task in tasks if task.number not in rows]
    for row in _progress(_run(waiting, options), len(waiting), teller(options.language), err):
        rows[row["run"]] = row
        if row["exit_code"] != 0:
            failure = {"number": row["run"], "error": row["error"], "folder": row["folder"]}
            err.write(sentence("cli.run-failed", failure, options.language) + "\n")
    made = _finish([rows[k] for k in sorted(rows)], list(cases[0].values), folder)
    out.write(sentence("cli.swept", made, options.language) + "\n")
    return 1 if made["failed"] else 0


def _checked_cases(options: SweepOptions, err: TextIO) -> list[Case]:
    if options.scheduler and not dask_installed():
        raise GivenError("cli.cluster-needs-dask-distributed")
    left: list[Path] = []
    cases = cases_of(options.settings, options.motions, left)
    if left:
        told = {"count": len(left), "names": [p.name for p in left]}
        err.write(sentence("cli.files-no-motions", told, options.language) + "\n")
    return cases


def _task(case: Case, options: SweepOptions, folder: Path, key: str) -> Task:
    allowed = tuple(p.resolve() for p in options.allowed)
    deck = options.deck.resolve()
    return Task(case.number, deck, folder, case.values, allowed, options.language, key=key)


def _run(tasks: list[Task], options: SweepOptions) -> Iterator[dict[str, Any]]:
    if options.scheduler:
        return run_on_cluster(tasks, options.scheduler, options.together)
    jobs = options.jobs or os.cpu_count() or 1
    one_thread()
    return run_all(tasks, max(min(jobs, len(tasks)), 1), together=options.together)


def _progress(
    rows: Iterator[dict[str, Any]], total: int, told: Teller, err: TextIO
) -> Iterator[dict[str, Any]]:
    """The same rows, with a line of progress at a terminal."""
    from ssilang.operators.session.progress import ProgressLine

    line = ProgressLine(told("cli.runs"), told, err)
    for done, row in enumerate(rows, start=1):
        line(done, total)
        yield row
    line.close()


def _finish(rows: list[dict[str, Any]], swept: list[str], folder: Path) -> dict[str, object]:
    """Write tables and pictures; what to say of them."""
    table = folder / PLAIN_TABLE
    write_plain_table(rows, table)
    if can_write():
        table = folder / TABLE
        write_table(rows, table)
    pictures = draw_figures(rows, swept, folder)
    failed = sum(row["exit_code"] != 0 for row in rows)
    return {
        "runs": len(rows),
        "failed": failed,
        "table": table,
        "pictures": len(pictures),
    }
