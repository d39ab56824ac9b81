"""What is wrong in a text, by the Lark grammar."""

import re
from functools import lru_cache

from lark import Lark, UnexpectedInput

from ssilang.language.say.errors import SsiError
from ssilang.language.text.reader import Reader, Unsound
from ssilang.language.text.source import STATEMENT_END, STRING, Source, Span
from ssilang.resources import resource

MAX_ERRORS = 20


@lru_cache(maxsize=1)
def _parser() -> Lark:
    text = resource("grammar", "ssi.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", lexer="basic", cache=False)


def words_of_grammar() -> list[tuple[str, str]]:
    """Names and regular expressions of the terminals, in the order in which they are tried."""
    ordered = sorted(
        _parser().terminals,
        key=lambda t: (-t.priority, -t.pattern.max_width, -len(t.pattern.value), t.name),
    )
    return [(t.name, t.pattern.to_regexp()) for t in ordered]


def errors_of(source: Source, text: str, reader: Reader) -> list[SsiError]:
    """What is wrong in a text that the reader refuses, by the grammar; at most `MAX_ERRORS`."""
    errors: list[SsiError] = []
    while len(errors) < MAX_ERRORS:
        try:
            reader.read(source, text)
            break
        except SsiError as problem:
            error, text = problem, _with_zero(text, problem.span)
        except Unsound:
            error, text = _explain(source, text, _refusal(text))
        errors.append(error)
    return errors


def _refusal(text: str) -> UnexpectedInput:
    """Where the grammar refuses a text."""
    try:
        _parser().parse(text)
    except UnexpectedInput as problem:
        return problem
    raise AssertionError("the reader refuses what the grammar takes")


def _with_zero(text: str, span: Span | None) -> str:
    """The text with 0 in the place of a number that cannot be read."""
    assert span is not None
    return text[: span.start] + "0".ljust(span.end - span.start) + text[span.end :]


def _explain(source: Source, text: str, problem: UnexpectedInput) -> tuple[SsiError, str]:
    """The error of one bad statement, and the text with that statement blanked."""
    offset = problem.pos_in_stream
    ended = getattr(getattr(problem, "token", None), "type", "") == "$END"
    at_end = ended or offset is None or offset < 0 or offset >= len(text)
    place = len(text) if at_end else int(offset or 0)
    begin, end = 0, len(text)
    for m in STATEMENT_END.finditer(text):
        if m.group() != ";":
            continue
        if m.start() < place:
            begin = m.end()
        elif m.start() >= place:
            end = m.end()
            break
    begin += len(text[begin:]) - len(text[begin:].lstrip())
    error = _syntax_error(source, text, begin, min(place, len(text)), end)
    blank = "".join(ch if ch == "\n" else " " for ch in text[begin:end])
    return error, text[:begin] + blank + text[end:]


def _syntax_error(source: Source, text: str, begin: int, place: int, end: int) -> SsiError:
    statement = text[begin:end]
    head = Span(source, begin, min(end, begin + len(statement.split("\n")[0])))
    bare = re.sub(STRING, lambda m: " " * len(m.group()), statement)
    quote = bare.find("'")
    if quote >= 0:
        early = re.search(r"'[^'\n]*'(?=\w)", statement)
        opened = _first_opened(text, begin + quote)
        if early is not None and begin + early.end() - 1 < opened:
            place = begin + early.end() - 1
            return SsiError("early-quote", Span(source, place, place + 1), text=early.group())
        return SsiError("unclosed-string", Span(source, opened, opened + 1))
    if place < len(text) and text[place] == "=":
        return _second_equal(source, text, begin, place)
    if bare.count("(") != bare.count(")"):
        return _unbalanced(source, bare, begin)
    if place >= len(text.rstrip()):
        return SsiError("missing-semicolon", head)
    before = bare[: place - begin].rstrip()[-1:]
    if before in (".", "%"):
        return SsiError("nothing-behind", Span(source, place, place + 1), sign=before)
    found = text[place]
    return SsiError("syntax", Span(source, place, place + 1), found=found, meant=_SET.get(found))


_SET: dict[str, str] = {
    **dict.fromkeys("\u2012\u2013\u2014\u2212", "-"),
    **dict.fromkeys("\u2018\u2019\u201c\u201d", "'"),
}
"""Signs that are set in print, and those that are typed."""


def _first_opened(text: str, last: int) -> int:
    """Where the quote was opened that nothing closes; `last` is the odd one of the text.

    All texts behind it are turned inside out: it opens the first that runs over the end of a
    statement and of a line.
    """
    for m in re.finditer(STRING, text[:last]):
        if re.search(r";[^\S\n]*\n", m.group()):
            return m.start()
    return last


def _second_equal(source: Source, text: str, begin: int, place: int) -> SsiError:
    """The error for an = where there can be none: no name before it, a comparison, a second one."""
    span = Span(source, place, place + 1)
    before = text[begin:place]
    if not before.strip():
        return SsiError("no-target", span)
    comparison = before.count("(") > before.count(")") or text[place + 1 : place + 2] == "="
    if comparison or before.split()[0].upper() == "SI":
        return SsiError("equal-comparison", span)
    return SsiError("second-equal", span)


def _unbalanced(source: Source, bare: str, begin: int) -> SsiError:
    opened: list[int] = []
    for i, ch in enumerate(bare):
        if ch == "(":
            opened.append(i)
        elif ch == ")":
            if not opened:
                return SsiError("extra-paren", Span(source, begin + i, begin + i + 1))
            opened.pop()
    return SsiError("unclosed-paren", Span(source, begin + opened[-1], begin + opened[-1] + 1))
