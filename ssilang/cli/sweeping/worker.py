"""One run of a sweep, in a process of its own."""

import gc
import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ssilang.cli.sweeping.given import Value
from ssilang.io.atomic import inside, write_text
from ssilang.messages.message import Sentence
from ssilang.report.sweep_table import KEPT, MOTION

if TYPE_CHECKING:
    from ssilang.cli.run import RunResult
    from ssilang.io.checkpoint import Deck

AGAIN = {"ssilang": "cli.again-version", "deck": "cli.again-deck", "given": "cli.again-values"}
"""Why a run is made again, by what was another one when its row was left."""


@dataclass(frozen=True)
class Task:
    """What a worker needs; all of it can be sent to another machine that sees the same files."""

    number: int
    deck: Path
    folder: Path
    values: dict[str, Value]
    allowed: tuple[Path, ...] = ()
    language: str = "en"
    limits: dict[str, Any] = field(default_factory=dict)
    report: bool = False
    """Whether the run leaves its report."""


Row = dict[str, Any]
Work = Callable[[Task], Row]


def run_task(task: Task) -> Row:
    """Run the deck with the task's values; returns its row of the table.

    The run's folder gets what the deck writes, its `summary.json`, `output.txt` (what it printed
    and its messages) and, when all is done, its row.
    """
    from ssilang.cli.run import RunOptions, run_file
    from ssilang.kernel.solvers.backends import keep_factors
    from ssilang.language.run.session import Limits
    from ssilang.operators.dynamics.verdicts import figures_of

    keep_factors(4)
    allowed = [*task.allowed]
    if MOTION in task.values:
        allowed.append(Path(str(task.values[MOTION])).parent)
    options = RunOptions(
        output_directory=task.folder,
        shared=task.folder.parents[1],
        allowed=allowed,
        language=task.language,
        summary=True,
        report=task.report,
        limits=Limits(**task.limits),
        given=dict(task.values),
    )
    (task.folder / KEPT).unlink(missing_ok=True)  # of another script, or a run that failed
    started, wall = time.perf_counter(), time.time()
    result = run_file(task.deck, options)
    write_text(task.folder / "output.txt", result.output + result.message + "\n")
    told = [w for w in result.session.warnings if w.severity == "warning"]
    row: Row = {
        "run": task.number,
        **task.values,
        "exit_code": result.exit_code,
        "seconds": round(time.perf_counter() - started, 3),
        "error": result.message.partition("\n")[0],
        "warnings": " ".join(sorted({w.code for w in told if not w.code.startswith("cli.")})),
        **figures_of(result.session.statistics.get("verdicts", [])),
        **{check.name: check.value for check in result.session.checks},
        "folder": task.folder.name,
    }
    row = _written(row)
    kept = {**_inputs(result, wall), "row": row, "seal": _seal(row)}
    write_text(task.folder / KEPT, json.dumps(kept) + "\n")
    return row


def _written(row: Row) -> Row:
    r"""A row as tables hold it: names of files that are no UTF-8 have `\udcff` where that is."""
    texts = {k: v.encode("utf-8", "backslashreplace") for k, v in row.items() if isinstance(v, str)}
    return {**row, **{name: text.decode() for name, text in texts.items()}}


def _inputs(result: "RunResult", started: float) -> dict[str, Any]:
    """What a run computed with; a file that changed meanwhile holds for no later run."""
    from ssilang.operators.files.outputs import digests_of_read, run_output

    output = run_output(result.session)
    files = digests_of_read(result.session)
    for name in files:
        path = output.inputs / name
        if path.is_file() and path.stat().st_mtime > started:
            files[name] = "changed"
    return {**output.deck().kept(), "files": files} if output.deck is not None else {}


def row_of(task: Task, deck: "Deck") -> Row | Sentence | None:
    """The row of a run that ended well, with its number in this sweep.

    Returns
    -------
    dict, Sentence or None
        Why it does not hold any more, if what the run computed with has changed; None without one.
    """
    from ssilang.io.checkpoint import changed_names, digest_of_file
    from ssilang.report.records import read_json

    if not os.path.lexists(task.folder / KEPT):
        return None
    try:
        kept = read_json(inside(task.folder, KEPT) or Path())  # a folder is no row
        row: Row = kept["row"]
        if kept["seal"] != _seal(row):
            return Sentence("cli.again-changed")
        if row["exit_code"] != 0:
            return None
        if changed := deck.change_since(kept):
            told = {"before": str(kept["ssilang"]), "now": deck.version}
            return Sentence(AGAIN[changed], **told)
        inputs = task.deck.parent
        now = {name: digest_of_file(inputs / name) for name in kept["files"]}
        files = changed_names(kept["files"], now)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return Sentence("cli.again-unknown")
    return Sentence("cli.again-files", files=files) if files else {**row, "run": task.number}


def _seal(row: Row) -> str:
    """What tells that nobody changed a row since it was written."""
    return sha256(json.dumps(row, sort_keys=True).encode()).hexdigest()


def row_anyhow(task: Task, work: Work = run_task) -> Row:
    """Row of a run; what the work raises is the row's error."""
    try:
        return work(task)
    except Exception as problem:
        return lost_row(task, str(problem))
    finally:
        if gc.get_freeze_count():  # of a fork: few objects hold all arrays of a run, in cycles
            gc.collect()


def lost_row(task: Task, reason: str) -> Row:
    """The row of a run whose process died."""
    told = {"exit_code": 1, "seconds": None, "error": f"the run was lost: {reason}"}
    return _written({"run": task.number, **task.values, **told, "folder": task.folder.name})
