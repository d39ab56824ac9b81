"""Names of a script: where they get values, where they are read, what is defined in what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from ssilang.cli.editor.tokens import CLOSES, OPENS, Phrase, Token

Kind = Literal["variable", "parameter", "procedure", "loop"]

_BEGINS = {"DEBP": "FINP", "DEBM": "FINM"}
_READERS = frozenset({"ACQU", "ARGU", "LIRE", "NOMM", "OBTE"})
"""Operators that give values to the names behind them."""


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A name at a place of the text.

    Attributes
    ----------
    scope : int
        Which procedure of the script it stands in, counted from 1; 0 outside of all.
    whole : Phrase
        The statement around it.
    """

    name: str
    start: int
    end: int
    scope: int
    kind: Kind
    defines: bool
    whole: Phrase


@dataclass(frozen=True)
class Names:
    """All occurrences, in the order of the text."""

    found: tuple[Occurrence, ...]

    def at(self, offset: int) -> Occurrence | None:
        """The name under the cursor."""
        return next((o for o in self.found if o.start <= offset <= o.end), None)

    def alike(self, of: Occurrence) -> list[Occurrence]:
        """All occurrences of what a name means: of a procedure's own name within it only."""
        owner = self._owner(of)
        return [o for o in self.found if o.name == of.name and self._owner(o) == owner]

    def definitions(self, of: Occurrence) -> list[Occurrence]:
        """Where the thing gets values."""
        return [o for o in self.alike(of) if o.defines]

    def visible(self, scope: int) -> dict[str, Occurrence]:
        """First definitions of the names that can be read in a scope, its own before others."""
        seen: dict[str, Occurrence] = {}
        for o in sorted(self.found, key=lambda o: self._owner(o) != scope):
            if o.defines and self._owner(o) in (0, scope):
                seen.setdefault(o.name, o)
        return seen

    @cached_property
    def _own(self) -> frozenset[tuple[int, str]]:
        """Names that get values in a scope."""
        return frozenset((o.scope, o.name) for o in self.found if o.defines)

    def _owner(self, o: Occurrence) -> int:
        """The procedure that a name belongs to, 0 for the script's own."""
        return o.scope if (o.scope, o.name) in self._own and o.kind != "procedure" else 0


def names_of(phrases: Sequence[Phrase]) -> Names:
    """The names of a script: those that get a value somewhere, procedures, loops."""
    found: list[Occurrence] = []
    scope = count = 0
    for phrase in phrases:
        word = phrase.first_word
        if word in _BEGINS:
            count += 1
            scope = count
            found += _heading(phrase, scope)
        else:
            found += _statement(phrase, word, scope)
        if word in _BEGINS.values():
            scope = 0
    defined = {o.name for o in found if o.defines}
    return Names(tuple(o for o in found if o.name in defined))


def _heading(phrase: Phrase, scope: int) -> Iterator[Occurrence]:
    """A procedure's own name, and those of its arguments: `NAME*TYPE*SUBTYPE`, `NAME/TYPE`."""
    before = ""
    for i, token in enumerate(phrase.tokens[1:]):
        if token.is_word and (i == 0 or before not in ("*", "/")):
            kind: Kind = "parameter" if i else "procedure"
            yield _occurrence(token, scope if i else 0, kind, True, phrase)
        before = token.text


def _statement(phrase: Phrase, word: str, scope: int) -> Iterator[Occurrence]:
    equal, depth = phrase.equal, 0
    for i, token in enumerate(phrase.tokens):
        depth += (token.kind == OPENS) - (token.kind == CLOSES)
        before = phrase.tokens[i - 1].kind if i else ""
        if token.kind != "WORD" or before == "PERCENT":
            continue
        behind = phrase.tokens[i + 1].kind if i + 1 < len(phrase.tokens) else ""
        whole = before != "_DOT" and behind not in ("_DOT", "PERCENT")
        if word == "REPE" and i == 1:
            yield _occurrence(token, scope, "loop", True, phrase, "&" + token.name)
        elif word == "FIN" and i == 1:
            yield _occurrence(token, scope, "loop", False, phrase, "&" + token.name)
        elif token.name.startswith("&"):
            yield _occurrence(token, scope, "loop", False, phrase)
        else:
            target = equal is not None and i < equal and not depth and whole
            read = word in _READERS and i > 0 and whole
            yield _occurrence(token, scope, "variable", target or read, phrase)


def _occurrence(
    token: Token, scope: int, kind: Kind, defines: bool, phrase: Phrase, name: str = ""
) -> Occurrence:
    start = token.start + (token.kind == "STRING" or (kind == "loop" and token.text[0] == "&"))
    end = token.end - (token.kind == "STRING")
    return Occurrence(name or token.name, start, end, scope, kind, defines, phrase)
