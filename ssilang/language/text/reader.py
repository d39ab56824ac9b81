"""The quick way from text to statements: one regular expression and a table of small steps.

The words are those of the grammar file, whose terminals make the expression; the steps know how
they join. Sound scripts are read about three times as fast as by Lark; at all others the reader
gives up, and Lark says what is wrong. A test holds it to the tree of the grammar, for every deck.
"""

import math
import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial

from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Source, Span

NAME_LENGTH = 24  # objects' names keep 24 characters
LARGEST = 2**63 - 1  # what 64 bits hold
LONGEST = len(str(LARGEST))


class Unsound(Exception):
    """The text does not follow the grammar."""


def name_of(text: str, span: Span) -> tree.Name:
    """A bare word."""
    return tree.Name(text.upper()[:NAME_LENGTH], text, span)


def quoted_of(text: str, span: Span) -> tree.Quoted:
    """A string with its quotes."""
    return tree.Quoted(_unquoted(text), span)


def _unquoted(text: str) -> str:
    """What a string says; over a line end it is joined with one blank."""
    text = text[1:-1].replace("''", "'")
    return " ".join(part.rstrip() for part in text.split("\n")) if "\n" in text else text


def integer_of(text: str, span: Span) -> tree.Number:
    """A whole number; 'long-integer' is raised beyond what 64 bits hold."""
    digits = len(text.lstrip("+-0"))
    if digits > LONGEST or abs(int(text)) > LARGEST:
        raise SsiError("long-integer", span, digits=digits)
    return tree.Number(int(text), span)


def real_of(text: str, span: Span) -> tree.Number:
    """A real number, with E or D before its exponent; 'long-real' beyond what 64 bits hold."""
    value = float(text.upper().replace("D", "E").rstrip(" ."))
    if math.isinf(value):
        raise SsiError("long-real", span, text=text[:40])
    return tree.Number(value, span)


def symbol_of(text: str, span: Span) -> tree.Symbol:
    """An operator written with signs."""
    return tree.Symbol(text.upper(), span)


def attribute_name(text: str) -> str | int:
    """What an attribute is called that `text` writes, a number or with or without quotes."""
    if text.isascii() and text.isdigit():
        return int(text)
    return (_unquoted(text) if text.startswith("'") else text).upper()


def statement_of(targets: tuple[tree.Item, ...] | None, items: list[tree.Item]) -> tree.Statement:
    """A statement from the items on both sides of its `=`; targets None without `=`."""
    first = targets[0] if targets else items[0]
    last = items[-1] if items else (targets or items)[-1]
    span = Span(first.span.source, first.span.start, last.span.end)
    return tree.Statement(targets or (), tuple(items), span, assigns=targets is not None)


_Maker = Callable[[str, Span], tree.Item]
_Step = Callable[[str, int, int], None]
_Dotted = dict[int, list[tree.Item]]  # indices behind items, by the items' places


class _Assembly:
    """Joins tokens to items and statements; raises `Unsound` where they do not fit."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.statements: list[tree.Statement] = []
        self.items: list[tree.Item] = []
        self.targets: tuple[tree.Item, ...] | None = None
        self.dotted: _Dotted = {}
        self.outer: list[tuple[list[tree.Item], _Dotted, str, int]] = []  # of open parentheses
        self.sign = 0  # where the % of an own attribute stands
        self.joint = ""  # what ends just before: '.', '%' or 'own'
        self.steps: dict[str, _Step] = {
            "WORD": partial(self._leaf, name_of),
            "STRING": partial(self._leaf, quoted_of),
            "INTEGER": partial(self._leaf, integer_of),
            "FLOAT": partial(self._leaf, real_of),
            "SYMBOL": self._symbol,
            "LPAR": self._open,
            "RPAR": self._close,
            "_DOT": self._dot,
            "PERCENT": self._percent,
            "OWN": self._own,
            "_EQUAL": self._equal,
            "_SEMICOLON": self._end,
        }

    def _leaf(self, make: _Maker, text: str, start: int, end: int) -> None:
        item = make(text, Span(self.source, start, end))
        if self.joint:
            self._join(item)
        else:
            self.items.append(item)

    def _join(self, item: tree.Item) -> None:
        """An index behind a dot, or an attribute's name behind %."""
        joint, self.joint = self.joint, ""
        if joint == ".":
            self.dotted.setdefault(len(self.items) - 1, []).append(item)
            return
        whole = isinstance(item, tree.Number) and isinstance(item.value, int)
        if not (whole or isinstance(item, tree.Name | tree.Quoted)):
            raise Unsound
        base_of = None if joint == "own" else self.items.pop()
        start = base_of.span.start if base_of else self.sign
        span = Span(self.source, start, item.span.end)
        self.items.append(tree.Attribute(base_of, attribute_name(item.span.text), span))

    def _symbol(self, text: str, start: int, end: int) -> None:
        self._free()
        self.items.append(symbol_of(text, Span(self.source, start, end)))

    def _open(self, text: str, start: int, end: int) -> None:
        self.outer.append((self.items, self.dotted, self.joint, start))
        self.items, self.dotted, self.joint = [], {}, ""

    def _close(self, text: str, start: int, end: int) -> None:
        self._free()
        if not self.outer:
            raise Unsound
        inner = self._taken()
        self.items, self.dotted, self.joint, opened = self.outer.pop()
        if not self.joint:
            self.items.append(tree.Paren(inner, Span(self.source, opened, end)))
        elif inner:
            self._join(tree.Paren(inner, Span(self.source, opened, end)))
        else:
            raise Unsound

    def _dot(self, text: str, start: int, end: int) -> None:
        self._free()
        if not self.items or isinstance(self.items[-1], tree.Symbol):
            raise Unsound
        self.joint = "."

    def _percent(self, text: str, start: int, end: int) -> None:
        self._free()
        if not self.items or isinstance(self.items[-1], tree.Symbol | tree.Attribute):
            raise Unsound
        if len(self.items) - 1 in self.dotted:
            raise Unsound
        self.joint = "%"

    def _own(self, text: str, start: int, end: int) -> None:
        self._free()
        self.joint, self.sign = "own", start

    def _equal(self, text: str, start: int, end: int) -> None:
        self._free()
        if self.outer or self.targets is not None or not self.items:
            raise Unsound
        self.targets, self.items = self._taken(), []

    def _end(self, text: str, start: int, end: int) -> None:
        self._free()
        if self.outer:
            raise Unsound
        if self.items or self.targets:
            self.statements.append(statement_of(self.targets, [*self._taken()]))
        self.items, self.targets = [], None

    def _taken(self) -> tuple[tree.Item, ...]:
        """The items so far; those that dots follow as paths, each made once."""
        for at, indices in self.dotted.items():
            span = self.items[at].span.to(indices[-1].span)
            self.items[at] = tree.Path(self.items[at], tuple(indices), span)
        self.dotted = {}
        return tuple(self.items)

    def _free(self) -> None:
        if self.joint:
            raise Unsound


class Reader:
    """Reads sound scripts.

    Parameters
    ----------
    words : iterable of (name, regular expression)
        The terminals of the grammar, in the order in which they are tried.
    """

    def __init__(self, words: Iterable[tuple[str, str]], ignored: str = "IGNORED") -> None:
        ordered = list(words)
        blank = dict(ordered)[ignored]
        words = [w for w in ordered if w[0] != ignored]
        self._kinds = [name for name, _ in words]
        tokens = "|".join(f"({pattern})" for _, pattern in words)
        # the first group is what is passed over, once and for all; a possessive quantifier would
        # say that too, but Python 3.11.2 then loses groups
        passed = f"(?=((?:{blank})*))\\1"
        self._token = re.compile(f"{passed}(?:{tokens})")
        self._blank = re.compile(passed)

    def read(self, source: Source, text: str) -> list[tree.Statement]:
        """The statements of `text`, the code of `source` or its beginning.

        Raises
        ------
        Unsound
            If the text does not follow the grammar.
        SsiError
            'long-integer', 'long-real'.
        """
        assembly = _Assembly(source)
        steps = [assembly.steps[kind] for kind in self._kinds]
        match, at = self._token.match, 0
        while (m := match(text, at)) is not None:
            group = m.lastindex or 2
            start, at = m.span(group)
            steps[group - 2](m[group], start, at)
        rest = self._blank.match(text, at)
        if assembly.items or assembly.targets or assembly.outer or assembly.joint:
            raise Unsound
        if rest is None or rest.end() < len(text):
            raise Unsound
        return assembly.statements

    def tokens(self, text: str, at: int = 0) -> Iterator[tuple[str, int, int]]:
        """Kind, start and end of each token from a place on, in a text that may be unsound.

        Characters that begin no token are passed over; a quote that nothing closes, or nothing
        before the end of a statement and of its line, opens a string up to the end of the line.
        """
        while at < len(text):
            m = self._token.match(text, at)
            if m is None:
                blank = self._blank.match(text, at)
                start = blank.end() if blank is not None else at
                if start >= len(text):
                    return
                at = _line_end(text, start) if text[start] == "'" else start + 1
                if text[start] == "'":
                    yield "STRING", start, at
                continue
            group = m.lastindex or 2
            start, at = m.span(group)
            kind = self._kinds[group - 2]
            if kind == "STRING" and _RUNS_AWAY.search(m[group]):
                at = _line_end(text, start)
            yield kind, start, at


_RUNS_AWAY = re.compile(r";[^\S\n]*\n")
"""The end of a statement and of a line, inside of a string."""


def _line_end(text: str, start: int) -> int:
    end = text.find("\n", start)
    return len(text) if end < 0 else end
