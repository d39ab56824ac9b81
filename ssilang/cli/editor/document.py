"""A script as an editor sees it: tokens, phrases and names, what procedure a table is for."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ssilang.cli.editor.names import Names
from ssilang.cli.editor.tokens import CLOSES, OPENS, Phrase, Token, phrases_of
from ssilang.language.registry import Operator, find_operator, keywords_of
from ssilang.language.run.library import Library
from ssilang.language.text.source import Source
from ssilang.language.vocabulary import words_of
from ssilang.language.vocabulary.entries import Declaration, TableEntry
from ssilang.late_imports import without_collections


@dataclass(frozen=True)
class Place:
    """What stands at an offset of a text.

    Attributes
    ----------
    token : Token or None
        The token that the offset stands in, or right behind.
    operator : Operator or None
        The operator that a word there belongs to: the last one before it in its parentheses.
    procedure : str
        The procedure that the phrase calls, '' if none.
    path : tuple of Token
        Base and indices before the token, when it is an index of a table.
    before : tuple of Token
        The tokens of the statement up to it.
    """

    phrase: Phrase | None
    token: Token | None
    operator: Operator | None = None
    procedure: str = ""
    path: tuple[Token, ...] = ()
    before: tuple[Token, ...] = ()


@dataclass(frozen=True)
class Document:
    """A text and its statements; made anew at each change."""

    source: Source
    phrases: Sequence[Phrase] = field(repr=False)
    procedures: frozenset[str] = field(default=frozenset(), repr=False)

    @classmethod
    def of(
        cls,
        text: str,
        path: Path | None = None,
        procedures: frozenset[str] = frozenset(),
        before: "Document | None" = None,
    ) -> "Document":
        """The document of a text with any kind of line ends; `before`: it as it was."""
        plain = text.replace("\r\n", "\n").replace("\r", "\n")
        source = Source(str(path) if path else "script", plain, path)
        phrases, older = (before.phrases, before.source.code) if before is not None else ([], "")
        with without_collections():
            return cls(source, phrases_of(source.code, phrases, older), procedures)

    @cached_property
    def lines(self) -> list[str]:
        """The lines of the text, as the protocol's positions count them."""
        return self.source.text.split("\n")

    @cached_property
    def names(self) -> Names:
        """The names of the script."""
        return Names(self.phrases)

    @cached_property
    def _starts(self) -> list[int]:
        return [p.start for p in self.phrases]

    def within(self, start: int, end: int) -> Sequence[Phrase]:
        """The statements of a part of the text, those too that only reach into it."""
        first = max(0, bisect_right(self._starts, start) - 1)
        return self.phrases[first : bisect_right(self._starts, end)]

    def phrase_at(self, offset: int) -> Phrase | None:
        """The statement that an offset stands in: from its first token to its semicolon."""
        i = bisect_right(self._starts, offset) - 1
        if i < 0:
            return None
        phrase = self.phrases[i]
        return None if phrase.cut.closed and offset >= phrase.end else phrase

    def place(self, offset: int) -> Place:
        """What stands at an offset."""
        phrase = self.phrase_at(offset)
        if phrase is None:
            return Place(None, None)
        token = next((t for t in phrase.tokens if t.start <= offset <= t.end and t.is_word), None)
        end = token.start if token is not None else offset
        before = tuple(t for t in phrase.tokens if t.end <= end)
        operator, procedure = self._owner(before, phrase)
        return Place(phrase, token, operator, procedure, _path(before), before)

    def _owner(self, before: tuple[Token, ...], phrase: Phrase) -> tuple[Operator | None, str]:
        """Operator and procedure that the word behind these tokens belongs to."""
        stack: list[tuple[Operator | None, str]] = [(None, "")]
        equal = phrase.cut.equal
        for i, token in enumerate(before):
            is_index = i > 0 and before[i - 1].kind == "_DOT"
            if token.kind == OPENS:
                stack.append((None, ""))
            elif token.kind == CLOSES and len(stack) > 1:
                stack.pop()
            elif token.is_word and (equal is None or i > equal) and not is_index:
                stack[-1] = self._next_owner(stack[-1], token)
        return stack[-1]

    def _next_owner(
        self, owner: tuple[Operator | None, str], token: Token
    ) -> tuple[Operator | None, str]:
        if token.kind == "WORD" and token.name in self.procedures:
            return None, token.name
        if owner[0] is not None and knows(owner[0], token.name):
            return owner
        defined = token.kind == "WORD" and token.name in self.names.defined
        found = None if defined else find_operator(token.name)
        named = found is not None and (token.kind == "WORD" or len(token.name) > 1)
        return (found, "") if named and found is not None and token.name[0].isalpha() else owner


def knows(operator: Operator, word: str) -> bool:
    """Whether a word is a keyword of an operator, or one that it takes of the vocabulary."""
    short = word[:4].rstrip()
    return any(w.rstrip()[:4] == short for w in (*keywords_of(operator), *words_of(operator.name)))


def _path(before: tuple[Token, ...]) -> tuple[Token, ...]:
    """Base and indices in front of a dot at the end, the base first."""
    found: list[Token] = []
    i = len(before)
    while i >= 2 and before[i - 1].kind == "_DOT":
        token = before[i - 2]
        if not token.is_word and token.kind != "INTEGER":
            return ()
        found.append(token)
        i -= 2
    return tuple(reversed(found))


Holder = tuple[Declaration, str]
"""A declaration, and the name of the argument that a table is."""


def holders(table: str, document: Document, library: Library) -> list[Holder]:
    """The procedures that the script gives a table to; else those that have all its entries."""
    called = list(_called(table, document, library))
    return called or list(suiting(_given(document).get(table, set()), library))


def entries_at(
    path: Sequence[Token], document: Document, library: Library
) -> list[tuple[Declaration, TableEntry]]:
    """The entries that an index behind a path may be."""
    found = []
    for declaration, argument in holders(path[0].name, document, library) if path else ():
        place = (argument, *(t.name for t in path[1:]))
        found += [(declaration, e) for e in declaration.inside(place).values()]
    return found


def _called(table: str, document: Document, library: Library) -> Iterator[Holder]:
    """Procedures in whose calls the name stands, as which of their tables."""
    declared = set(library.declared_names)
    given = _given(document)
    for phrase in document.phrases:
        names = [t for t in phrase.cut.tokens if t.kind == "WORD"]
        for i, token in enumerate(names):
            if token.name not in declared or token.name in given:
                continue
            behind = [t.name for t in names[i + 1 :] if t.name in given]
            declaration = library.declared(token.name)
            if declaration is None or table not in behind:
                continue
            at = behind.index(table)
            if at < len(declaration.arguments):
                yield declaration, declaration.arguments[at].name


def _given(document: Document) -> dict[str, set[str]]:
    """Indices of each table that the script makes or gives values to."""
    found: dict[str, set[str]] = {}
    for phrase in document.phrases:
        cut, equal = phrase.cut, phrase.cut.equal or 0
        tokens, value = cut.tokens[:equal], cut.tokens[equal + 1 : equal + 2]
        if len(tokens) >= 3 and tokens[1].kind == "_DOT":
            found.setdefault(tokens[0].name, set()).add(tokens[2].name)
        elif len(tokens) == 1 and value and value[0].name in ("TABL", "TABLE"):
            found.setdefault(tokens[0].name, set())
    return found


def suiting(indices: set[str], library: Library) -> Iterator[Holder]:
    """Procedures and operators whose tables have all of some indices, if there are any."""
    given = indices - {"SOUSTYPE"}
    for name in library.declared_names if given else ():
        declaration = library.declared(name)
        for argument in declaration.arguments if declaration is not None else ():
            assert declaration is not None
            if all(index in declaration.inside((argument.name,)) for index in given):
                yield declaration, argument.name
