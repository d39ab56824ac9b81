"""Problems of scripts for programs: as JSON, and as notes beside the lines of a change."""

import json
from collections.abc import Iterable
from typing import Any, TextIO

from ssilang.cli.editor.problems import Fix, Problem, find_problems
from ssilang.language.text.source import Source


def report(
    sources: Iterable[Source], form: str, syntax_only: bool, language: str, out: TextIO
) -> bool:
    """Print the problems of scripts in the form 'json' or 'github'; True if there are errors."""
    found = [
        (source, problem)
        for source in sources
        for problem in find_problems(source, language, syntax_only).problems
    ]
    if form == "json":
        made = [_record(source, problem) for source, problem in found]
        out.write(json.dumps(made, ensure_ascii=False, indent=2) + "\n")
    else:
        out.writelines(_note(source, problem) + "\n" for source, problem in found)
    return any(problem.severity == "error" for _, problem in found)


def _record(source: Source, problem: Problem) -> dict[str, Any]:
    """A problem; lines and columns from 1, the end column behind the last character."""
    return {
        "file": source.name,
        **_place(source, problem),
        "severity": problem.severity,
        "code": problem.code,
        "message": problem.text,
        "hint": problem.hint,
        "fixes": [
            {"title": fix.title, **_place(source, fix), "text": fix.text} for fix in problem.fixes
        ],
    }


def _place(source: Source, part: Problem | Fix) -> dict[str, int]:
    (line, column), (last, behind) = source.position(part.start), source.position(part.end)
    return {"line": line, "column": column, "end_line": last, "end_column": behind}


def _note(source: Source, problem: Problem) -> str:
    """A command of GitHub's workflows: it shows the message beside the line."""
    line, column = source.position(problem.start)
    last, behind = source.position(problem.end)
    place = f"file={_property(source.name)},line={line},endLine={last},col={column}"
    if last == line:  # columns of several lines are not shown
        place += f",endColumn={behind}"
    message = "\n".join(p for p in (problem.text, problem.hint) if p)
    level = "notice" if problem.severity == "note" else problem.severity
    return f"::{level} {place},title={_property(problem.code)}::{_data(message)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
