"""`ssilang check`: what can be said about a script without running it."""

import io
from collections.abc import Iterator
from typing import TextIO

from ssilang.cli.checking.kinds import assigned_names
from ssilang.cli.checking.sound import SoundStatements
from ssilang.cli.checking.walk import Checker
from ssilang.cli.run import RunOptions, allow_nesting, make_session
from ssilang.cli.terminal.screen import coloured
from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse


def check_file(source: Source, syntax_only: bool, language: str, out: TextIO) -> bool:
    """Check a script's file and print what is wrong with it; True if there are errors.

    Parameters
    ----------
    syntax_only : bool
        Look at the structure alone: statements, parentheses, quotes, blocks.
    """
    problems, names = check_source(source, syntax_only)
    for problem in _together(problems):
        out.write(coloured(render(problem, language, names), out) + "\n\n")
    return any(p.severity == "error" for p in problems)


def _together(problems: list[SsiError]) -> Iterator[SsiError]:
    """The problems, names that nothing reads in one."""
    unread = [p for p in problems if p.code == "unused-name"]
    for problem in problems:
        if problem.code != "unused-name" or len(unread) == 1:
            yield problem
        elif problem is unread[0]:
            lines = [p.span.source.position(p.span.start)[0] for p in unread if p.span is not None]
            names = [f"{p.data['name']} ({line})" for p, line in zip(unread, lines, strict=True)]
            yield SsiError("unused-names", problem.span, names=tuple(names))


def check_source(source: Source, syntax_only: bool = False) -> tuple[list[SsiError], set[str]]:
    """Errors and warnings of a script in the order of its text, and the names that it knows."""
    problems, names, _ = typed_source(source, syntax_only)
    return problems, names


def typed_source(
    source: Source, syntax_only: bool = False, sound: SoundStatements | None = None
) -> tuple[list[SsiError], set[str], dict[int, str]]:
    """As `check_source`, and the types that names get, by where the name stands.

    Parameters
    ----------
    sound : SoundStatements, optional
        What was found in this script before it was changed.
    """
    try:
        script = parse(source)
    except SeveralErrors as several:
        return several.errors, set(), {}
    except SsiError as error:
        return [error], set(), {}
    if syntax_only:
        return [], set(), {}
    session = make_session(source, RunOptions(), io.StringIO())
    checker = Checker(session, sound)
    allow_nesting(session.limits.recursion)
    try:
        names = assigned_names(script.body) | session.frame.names() | session.library.standard_names
        before = [*script.warnings, *script.unclosed]
        told = {e.span for e in before}
        after = [e for e in checker.check(script) if e.span not in told]
        return [*before, *after], names, checker.types
    except RecursionError:
        return [SsiError("nesting", None)], set(), {}
