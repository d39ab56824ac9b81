"""A script's text as tokens and phrases, sound or not: what there is while one types."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ssilang.language.text.parser import quick_reader
from ssilang.language.text.reader import NAME_LENGTH

OPENS, CLOSES = "LPAR", "RPAR"


@dataclass(frozen=True, slots=True)
class Token:
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


@dataclass(frozen=True, slots=True)
class Phrase:
    """The tokens of a statement, and where its semicolon (or the text) ends."""

    tokens: tuple[Token, ...]
    end: int
    closed: bool

    @property
    def start(self) -> int:
        """Where its first token stands."""
        return self.tokens[0].start

    @property
    def first_word(self) -> str:
        """First four letters of the word that it begins with, '' if a value is assigned."""
        first = self.tokens[0]
        return first.name[:4].rstrip() if first.is_word and self.equal is None else ""

    @property
    def equal(self) -> int | None:
        """Which of its tokens is the = of an assignment."""
        depth = 0
        for i, token in enumerate(self.tokens):
            depth += (token.kind == OPENS) - (token.kind == CLOSES)
            if token.kind == "_EQUAL" and depth <= 0:
                return i
        return None


def tokens_of(code: str) -> list[Token]:
    """The tokens of a text."""
    return [Token(k, code[a:b], a, b) for k, a, b in quick_reader().tokens(code)]


def phrases_of(tokens: Sequence[Token]) -> Iterator[Phrase]:
    """The statements of a text, the unfinished one at its end included."""
    held: list[Token] = []
    for token in tokens:
        if token.kind != "_SEMICOLON":
            held.append(token)
            continue
        if held:
            yield Phrase(tuple(held), token.end, True)
        held = []
    if held:
        yield Phrase(tuple(held), held[-1].end, False)
