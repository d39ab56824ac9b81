"""What `ssilang check` says of a text, with what would mend it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import cast

from ssilang.cli.check import typed_source
from ssilang.cli.checking.sound import SoundStatements
from ssilang.language.say.diagnostics import sentence, suggestion
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.messages.message import Sentence, teller


@dataclass(frozen=True, slots=True)
class Fix:
    """A change of the text that mends a problem: `text` in place of start:end."""

    title: str
    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Problem:
    """Something wrong at a place, said in the language asked for."""

    code: str
    severity: str
    start: int
    end: int
    text: str
    hint: str
    fixes: tuple[Fix, ...]


@dataclass(frozen=True, slots=True)
class Findings:
    """Problems of a text, and the types of what its names are given, by the place of the name."""

    problems: tuple[Problem, ...]
    types: dict[int, str]


def find_problems(
    source: Source,
    language: str,
    syntax_only: bool = False,
    sound: SoundStatements | None = None,
) -> Findings:
    """Everything that can be said of a script without running it, or of its structure alone.

    Parameters
    ----------
    sound : SoundStatements, optional
        What was found in this script before it was changed, which is brought up to date.
    """
    found, names, types = typed_source(source, syntax_only, sound)
    return Findings(tuple(_problems(found, names, source, language)), types)


def _problems(
    errors: list[SsiError], names: set[str], source: Source, language: str
) -> Iterator[Problem]:
    for error in errors:
        span = error.span
        start, end = (span.start, span.end) if span is not None else (0, 0)
        if span is not None and span.source is not source:
            start = end = 0
        text, hint = sentence(error, language, names)
        fixes = tuple(_fixes(error, names, source, language))
        yield Problem(error.code, error.severity, start, max(end, start), text, hint, fixes)


# ---- what would mend it ------------------------------------------------------------------------


def _fixes(error: SsiError, names: set[str], source: Source, language: str) -> Iterator[Fix]:
    span, told = error.span, teller(language)
    if span is None or span.source is not source:
        return
    if error.code == "unclosed-string":
        word = re.compile(r"'[\w@]*").match(source.code, span.start)
        at = word.end() if word is not None else span.end
        yield Fix(told("cli.fix-quote"), at, at, "'")
    elif error.code == "missing-semicolon":
        at = len(source.code.rstrip())
        yield Fix(told("cli.fix-semicolon"), at, at, " ;")
    elif error.code == "unclosed-paren":
        at = _before_semicolon(source.code, span.start)
        yield Fix(told("cli.fix-parenthesis"), at, at, ")")
    elif error.code == "extra-paren":
        yield Fix(told("cli.fix-remove"), span.start, span.end, "")
    elif error.code == "decimal-comma":
        point = span.text.replace(",", ".")
        yield Fix(told("cli.fix-replace", near=point), span.start, span.end, point)
    if "begins_line" in error.data:
        yield from _semicolon_before(error, source, language)
    yield from _near(error, names, language)


def _before_semicolon(code: str, start: int) -> int:
    at = code.find(";", start)
    return len(code[: at if at >= 0 else len(code)].rstrip())


def _semicolon_before(error: SsiError, source: Source, language: str) -> Iterator[Fix]:
    """A semicolon at the end of the line above the operator that begins one."""
    line = cast(int, cast(Sentence, error.data["begins_line"]).data["line"])
    at = len(source.code[: source.offset(line, 1)].rstrip())
    yield Fix(teller(language)("cli.fix-semicolon"), at, at, " ;")


def _near(error: SsiError, names: set[str], language: str) -> Iterator[Fix]:
    """The near word in place of the one at the error, with the quotes that stand there."""
    span = error.span
    assert span is not None
    near, given = suggestion(error, names), span.text
    found = re.search(r"'([^']*)'\s*$|([@&!]?[^\W\d]\w*)\s*$", given)
    if not near or found is None:
        return
    group = 1 if found.group(1) is not None else 2
    start, end = span.start + found.start(group), span.start + found.end(group)
    if near.upper() != found.group(group).upper():
        yield Fix(teller(language)("cli.fix-replace", near=near), start, end, near)
