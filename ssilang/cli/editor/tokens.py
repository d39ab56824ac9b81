"""A script's text as tokens and statements, sound or not: what there is while one types.

What stands in a statement does not depend on where it stands: after a change, those in front of it
and behind it are taken over, and only what lies between is read.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from ssilang.language.text.parser import quick_reader
from ssilang.language.text.reader import NAME_LENGTH

OPENS, CLOSES = "LPAR", "RPAR"
BEGINS = {"DEBP": "FINP", "DEBM": "FINM"}
_READERS = frozenset({"ACQU", "ARGU", "LIRE", "NOMM", "OBTE"})
"""Operators that give values to the names behind them."""

Kind = Literal["variable", "parameter", "procedure", "loop"]


class Token(NamedTuple):
    """A word, string, number or sign of a text, and where it stands."""

    kind: str
    text: str
    start: int
    end: int

    @property
    def name(self) -> str:
        """The word as the language compares it: in capitals, without quotes."""
        bare = self.text[1:].removesuffix("'") if self.kind == "STRING" else self.text
        return bare.upper()[:NAME_LENGTH] if self.kind == "WORD" else bare.upper().rstrip()

    @property
    def is_word(self) -> bool:
        """Whether it may name something: a bare or a quoted word."""
        return self.kind in ("WORD", "STRING")


class Name(NamedTuple):
    """A name in a statement; `heading`: it is the procedure's own, and stands outside of it."""

    name: str
    start: int
    end: int
    kind: Kind
    defines: bool
    heading: bool = False


@dataclass(frozen=True, eq=False)
class Cut:
    """A statement wherever it stands: all places count from its first letter.

    Attributes
    ----------
    end : int
        Where its semicolon (or the text) ends.
    """

    tokens: tuple[Token, ...]
    end: int
    closed: bool

    @cached_property
    def first_word(self) -> str:
        """First four letters of the word that it begins with, '' if a value is assigned."""
        first = self.tokens[0]
        return first.name[:4].rstrip() if first.is_word and self.equal is None else ""

    @cached_property
    def equal(self) -> int | None:
        """Which of its tokens is the = of an assignment."""
        depth = 0
        for i, token in enumerate(self.tokens):
            depth += (token.kind == OPENS) - (token.kind == CLOSES)
            if token.kind == "_EQUAL" and depth <= 0:
                return i
        return None

    @cached_property
    def whole(self) -> bool:
        """Whether it stays what it is when the text behind it changes: all strings are closed."""
        return self.closed and not any(
            t.kind == "STRING" and t.text.count("'") % 2 for t in self.tokens
        )

    @cached_property
    def names(self) -> tuple[Name, ...]:
        """The words that may be names of the script: all bare ones but attributes."""
        begins = self.first_word in BEGINS
        return tuple(_heading(self) if begins else _statement(self))

    @cached_property
    def defined(self) -> tuple[Name, ...]:
        """Those of them that get a value."""
        return tuple(name for name in self.names if name.defines)


@dataclass(frozen=True)
class Phrase:
    """A statement, and where it stands."""

    start: int
    cut: Cut

    @cached_property
    def tokens(self) -> tuple[Token, ...]:
        """Its tokens, where they stand in the text."""
        at = self.start
        return tuple(Token(kind, text, at + a, at + b) for kind, text, a, b in self.cut.tokens)

    @property
    def end(self) -> int:
        """Where its semicolon (or the text) ends."""
        return self.start + self.cut.end


def phrases_of(code: str, before: Sequence[Phrase] = (), older: str = "") -> list[Phrase]:
    """The statements of a text, the unfinished one at its end included.

    Parameters
    ----------
    before, older
        The statements of the text as it was, and that text.
    """
    alike, shift = _alike(code, older), len(code) - len(older)
    behind = len(code) - min(_alike(code[::-1], older[::-1]), min(len(code), len(older)) - alike)
    ends = [p.end for p in before]
    broken = next((i for i, p in enumerate(before) if not p.cut.whole), len(before))
    found = list(before[: min(broken, bisect_right(ends, alike))])
    held: list[tuple[str, int, int]] = []
    for token in quick_reader().tokens(code, found[-1].end if found else 0):
        if token[0] != "_SEMICOLON":
            held.append(token)
            continue
        end = token[2]
        if held:
            found.append(_phrase(code, held, end, True))
        held = []
        if end >= behind:
            i = bisect_left(ends, end - shift)
            if i < len(ends) and ends[i] == end - shift and before[i].cut.closed:
                return found + [Phrase(p.start + shift, p.cut) for p in before[i + 1 :]]
    if held:
        found.append(_phrase(code, held, held[-1][2], False))
    return found


def _phrase(code: str, tokens: Sequence[tuple[str, int, int]], end: int, closed: bool) -> Phrase:
    at = tokens[0][1]
    cut = tuple(Token(kind, code[a:b], a - at, b - at) for kind, a, b in tokens)
    return Phrase(at, Cut(cut, end - at, closed))


def _alike(text: str, other: str) -> int:
    """How many letters two texts begin with alike."""
    most = min(len(text), len(other))
    return bisect_right(range(most), False, key=lambda i: text[: i + 1] != other[: i + 1])


def _heading(cut: Cut) -> Iterator[Name]:
    """A procedure's own name, and those of its arguments: `NAME*TYPE*SUBTYPE`, `NAME/TYPE`."""
    before = ""
    for i, token in enumerate(cut.tokens[1:]):
        if token.is_word and (i == 0 or before not in ("*", "/")):
            quotes = token.kind == "STRING"
            kind: Kind = "parameter" if i else "procedure"
            yield Name(token.name, token.start + quotes, token.end - quotes, kind, True, i == 0)
        before = token.text


def _statement(cut: Cut) -> Iterator[Name]:
    equal, word, depth = cut.equal, cut.first_word, 0
    for i, token in enumerate(cut.tokens):
        depth += (token.kind == OPENS) - (token.kind == CLOSES)
        before = cut.tokens[i - 1].kind if i else ""
        if token.kind != "WORD" or before in ("PERCENT", "OWN"):
            continue
        behind = cut.tokens[i + 1].kind if i + 1 < len(cut.tokens) else ""
        whole = before != "_DOT" and behind not in ("_DOT", "PERCENT")
        if i == 1 and word in ("REPE", "FIN"):
            yield _loop(token, word == "REPE")
        elif token.text[0] == "&":
            yield _loop(token, False)
        else:
            target = equal is not None and i < equal and not depth and whole
            read = word in _READERS and i > 0 and whole
            yield Name(token.name, token.start, token.end, "variable", target or read)


def _loop(token: Token, defines: bool) -> Name:
    name = "&" + token.name.removeprefix("&")
    return Name(name, token.start + (token.text[0] == "&"), token.end, "loop", defines)
