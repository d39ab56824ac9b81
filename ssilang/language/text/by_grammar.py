"""Text to statements by the Lark grammar: all that is wrong in it, and sound texts slowly."""

import re
from functools import lru_cache
from typing import Any

from lark import Lark, Token, Transformer, UnexpectedInput

from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text import reader, tree
from ssilang.language.text.source import STATEMENT_END, STRING, Source, Span
from ssilang.resources import resource

MAX_ERRORS = 20


class _Builder(Transformer[Token, Any]):
    """Turns grammar rules into tree nodes; `source` is set before each parse."""

    source: Source

    def _span(self, first: Any, last: Any) -> Span:
        start = first.start_pos if isinstance(first, Token) else first.span.start
        end = last.end_pos if isinstance(last, Token) else last.span.end
        return Span(self.source, start or 0, end or 0)

    def word(self, c: list[Token]) -> tree.Name:
        return reader.name_of(str(c[0]), self._span(c[0], c[0]))

    def string(self, c: list[Token]) -> tree.Quoted:
        return reader.quoted_of(str(c[0]), self._span(c[0], c[0]))

    def integer(self, c: list[Token]) -> tree.Number:
        return reader.integer_of(str(c[0]), self._span(c[0], c[0]))

    def real(self, c: list[Token]) -> tree.Number:
        return reader.real_of(str(c[0]), self._span(c[0], c[0]))

    def symbol(self, c: list[Token]) -> tree.Symbol:
        return reader.symbol_of(str(c[0]), self._span(c[0], c[0]))

    def items(self, c: list[Any]) -> tuple[tree.Item, ...]:
        return tuple(c)

    def paren(self, c: list[Any]) -> tree.Paren:
        items = c[0]
        span = self._span(items[0], items[-1])
        text = self.source.code
        start = text.rfind("(", 0, span.start)
        end = text.find(")", span.end)
        return tree.Paren(items, Span(self.source, start, end + 1))

    def empty_paren(self, c: list[Token]) -> tree.Paren:
        return tree.Paren((), self._span(c[0], c[1]))

    def path(self, c: list[Any]) -> tree.Path:
        return tree.Path(c[0], tuple(c[1:]), self._span(c[0], c[-1]))

    def attribute(self, c: list[Any]) -> tree.Attribute:
        return tree.Attribute(c[0], reader.attribute_name(c[2]), self._span(c[0], c[2]))

    def own_attribute(self, c: list[Any]) -> tree.Attribute:
        return tree.Attribute(None, reader.attribute_name(c[1]), self._span(c[0], c[1]))

    def empty(self, c: list[Any]) -> None:
        return None

    def plain(self, c: list[Any]) -> tree.Statement:
        return reader.statement_of(None, c[0])

    def assignment(self, c: list[Any]) -> tree.Statement:
        return reader.statement_of(c[0], c[1])

    def empty_assignment(self, c: list[Any]) -> tree.Statement:
        return reader.statement_of(c[0], [])

    def start(self, c: list[Any]) -> list[tree.Statement]:
        return [s for s in c if s is not None]


@lru_cache(maxsize=1)
def _parser() -> tuple[Lark, _Builder]:
    builder = _Builder()
    text = resource("grammar", "ssi.lark").read_text(encoding="utf-8")
    lark = Lark(text, parser="lalr", lexer="basic", transformer=builder, cache=False)
    return lark, builder


def words_of_grammar() -> list[tuple[str, str]]:
    """Names and regular expressions of the terminals, in the order in which they are tried."""
    ordered = sorted(
        _parser()[0].terminals,
        key=lambda t: (-t.priority, -t.pattern.max_width, -len(t.pattern.value), t.name),
    )
    return [(t.name, t.pattern.to_regexp()) for t in ordered]


def parse_by_grammar(source: Source, text: str) -> list[tree.Statement]:
    """The statements of a text by the grammar alone; errors as in `parse_statements`."""
    lark, builder = _parser()
    builder.source = source
    errors: list[SsiError] = []
    while True:
        try:
            statements: list[tree.Statement] = lark.parse(text)  # type: ignore[assignment]
        except (UnexpectedInput, SsiError) as problem:
            if isinstance(problem, SsiError):
                error, text = problem, _with_zero(text, problem.span)
            else:
                error, text = _explain(source, text, problem)
            errors.append(error)
            if len(errors) >= MAX_ERRORS:
                break
            continue
        break
    if errors:
        raise SeveralErrors(errors)
    return statements


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
