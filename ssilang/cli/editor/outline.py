"""The shape of a script: its outline, what can be folded, what each word is (for colours)."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, get_args

from ssilang.cli.editor.document import Document
from ssilang.cli.editor.tokens import Kind, Phrase
from ssilang.language.registry import find_operator
from ssilang.language.text.tree import BLOCKS

CONTROL = frozenset({*BLOCKS, *BLOCKS.values(), "SINO", "QUIT", "ITER"})

Colour = Literal[
    "comment", "keyword", "function", "string", "number", "operator", "variable", "property",
    "parameter",
]  # fmt: skip
COLOURS: tuple[Colour, ...] = get_args(Colour)
_NUMBERS = frozenset({"INTEGER", "FLOAT"})
_COMMENT = re.compile(r"^(?:\*|\$\$\$\$).*$", re.MULTILINE)


@dataclass
class Part:
    """A procedure, loop or name in the outline, with what is inside of it."""

    name: str
    kind: Kind
    start: int
    end: int
    name_start: int
    name_end: int
    inner: "list[Part]" = field(default_factory=list)


def outline(document: Document) -> list[Part]:
    """Procedures with their arguments and names, loops, and the first place of each name."""
    top: list[Part] = []
    stack: list[Part] = []
    seen: set[tuple[int, str]] = set()
    ends = {b.start: b.end for b in _blocks(document)}
    for o in document.names.found:
        while stack and o.start > stack[-1].end:
            stack.pop()
        if not o.defines:
            continue
        inside = stack[-1].inner if stack else top
        if o.kind in ("procedure", "loop"):
            end = ends.get(o.whole.start, o.whole.end)
            part = Part(o.name.lstrip("&"), o.kind, o.whole.start, end, o.start, o.end)
            inside.append(part)
            stack.append(part)
        elif (o.scope, o.name) not in seen:
            seen.add((o.scope, o.name))
            inside.append(Part(o.name, o.kind, o.whole.start, o.whole.end, o.start, o.end))
    return top


@dataclass(frozen=True, slots=True)
class Block:
    """A block of statements, from the start of its first one to the end of its last one."""

    start: int
    end: int
    depth: int


def _blocks(document: Document) -> Iterator[Block]:
    """Procedures, loops and conditions that are closed."""
    stack: list[Phrase] = []
    for phrase in document.phrases:
        word = phrase.cut.first_word
        if word in BLOCKS:
            stack.append(phrase)
        elif word in BLOCKS.values() and (word != "FIN" or len(phrase.cut.tokens) > 1):
            while stack and BLOCKS[stack[-1].cut.first_word] != word:
                stack.pop()
            if stack:
                opened = stack.pop()
                yield Block(opened.start, phrase.end, len(stack))


def folds(document: Document) -> Iterator[tuple[int, int, str]]:
    """First line, last line (from 0) and kind of what can be folded."""
    line = document.source.position
    for block in _blocks(document):
        first, last = line(block.start)[0] - 1, line(block.end)[0] - 1
        if last > first:
            yield first, last, "region"
    for phrase in document.phrases:
        first, last = line(phrase.start)[0] - 1, line(phrase.end)[0] - 1
        if last > first + 1:
            yield first, last, "region"
    lines = [line(m.start())[0] - 1 for m in _COMMENT.finditer(document.source.text)]
    start = before = -2
    for number in [*lines, -2]:
        if number != before + 1:
            if before > start >= 0:
                yield start, before, "comment"
            start = number
        before = number


def colours(
    document: Document, start: int = 0, end: int | None = None
) -> list[tuple[int, int, Colour]]:
    """Start, end and colour of each word and comment, in the order of the text or of its part."""
    text, defined = document.source.text, document.names.defined
    end = len(text) if end is None else end
    found: list[tuple[int, int, Colour]] = [
        (m.start(), m.end(), "comment") for m in _COMMENT.finditer(text, start, end)
    ]
    for phrase in document.within(start, end):
        at, before = phrase.start, ""
        kinds = {n.start: n.kind for n in phrase.cut.names if n.name in defined}
        for i, token in enumerate(phrase.cut.tokens):
            colour: Colour | None = None
            if token.kind == "STRING":
                colour = "property" if before == "_DOT" else "string"
            elif token.kind in _NUMBERS:
                colour = "number"
            elif token.kind == "SYMBOL":
                colour = "operator"
            elif token.kind == "WORD":
                colour = _of_word(token.name, i, before, kinds.get(token.start), document)
            if colour is not None and start <= at + token.start < end:
                found.append((at + token.start, at + token.end, colour))
            before = token.kind
    return sorted(found)


def _of_word(
    word: str, place: int, before: str, kind: Kind | None, document: Document
) -> Colour | None:
    if place == 0 and word[:4].rstrip() in CONTROL:
        return "keyword"
    if kind is not None:
        return {"procedure": "function", "parameter": "parameter"}.get(kind, "variable")  # type: ignore[return-value]
    if before in ("_DOT", "PERCENT", "OWN"):
        return "property"
    if word in document.procedures or find_operator(word) is not None:
        return "function"
    return None
