"""summary.json: what a run did, for machines.

Keys: `deck` (path), `deck_digest` (SHA-256 of its text), `version`, `exit_code`, `seconds`,
`statements`, `peak_memory_mb`, `files` (list of {`path` relative to the folder of the summary,
`bytes`}), `warnings` and `errors` (lists of {`code`, `line`, `text`}), `pictures` (paths of those
among the files), `figures` (numbers, a list of {`name`, `value`, `expected`, `tolerance`, `ok`}:
what SORT 'BILA' reported, the last three null where nothing was expected), `units` (the system of
OPTI 'UNIT' and its units of length, force, mass, time, stress and energy; null without that
option), `statistics` (what procedures and solvers left in `session.statistics`; under `petsc`, if
it solved, its `command`, versions, `ranks` and `hosts`, a list of {`host`, `ranks`,
`peak_memory_mb`, `free_memory_mb`}).
"""

import json
import math
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ssilang import __version__
from ssilang.io.atomic import inside, write_text
from ssilang.io.run_output import RunOutput
from ssilang.language.run.session import Session
from ssilang.language.say.diagnostics import sentence
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.operators.workspace import workspace
from ssilang.report.records import read_json
from ssilang.system import peak_memory

NAME = "summary.json"
_PICTURES = frozenset({".png", ".svg", ".pdf", ".eps", ".ps"})


def write_summary(
    session: Session, source: Source, output: RunOutput, errors: list[SsiError], exit_code: int
) -> Path:
    """Write the summary of a finished run into its output folder."""
    path = output.directory / NAME
    units = workspace(session).units
    files = [_file(p, output.directory) for p in output.files if p.is_file()]
    n_bytes = peak_memory()
    made = {
        "deck": deck_name(source),
        "deck_digest": source.digest,
        "version": __version__,
        "exit_code": exit_code,
        "seconds": round(time.perf_counter() - session.started, 3),
        "statements": session.evaluator.statement_count,
        "peak_memory_mb": None if n_bytes is None else round(n_bytes / 2**20, 1),
        "files": files,
        "warnings": [_message(w, session.language) for w in session.warnings],
        "errors": [_message(e, session.language) for e in errors],
        "pictures": [p.as_posix() for p in pictures_among(Path(f["path"]) for f in files)],
        "figures": [vars(check) for check in session.checks],
        "units": None if units is None else {"system": units.name, **units.base()},
        "statistics": session.statistics,
    }
    write_text(path, json.dumps(plain(made), indent=2, ensure_ascii=False) + "\n")
    return path


def deck_name(source: Source) -> str:
    """What a summary calls a deck."""
    return str(source.path) if source.path is not None else source.name


def deck_of(folder: Path) -> str:
    """The deck whose summary stands in a folder; empty without one that can be read."""
    try:
        return str(read_json(inside(folder, NAME) or Path())["deck"])  # a folder is no summary
    except (OSError, ValueError, LookupError, TypeError):
        return ""


def _file(path: Path, base: Path) -> dict[str, Any]:
    inside = path.is_relative_to(base)
    return {
        "path": (path.relative_to(base) if inside else path).as_posix(),
        "bytes": path.stat().st_size,
    }


def _message(error: SsiError, language: str) -> dict[str, Any]:
    line = None
    if error.span is not None:
        line = error.span.source.position(error.span.start)[0]
    return {"code": error.code, "line": line, "text": sentence(error, language, ())[0]}


def pictures_among(files: Iterable[Path]) -> list[Path]:
    """Those of a run's files that are pictures."""
    return [p for p in files if p.suffix in _PICTURES]


def plain(value: Any) -> Any:
    """The value in types that JSON has: arrays as lists, numbers that are none as null."""
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(v) for v in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, bool | int):
        return value
    return str(value)
