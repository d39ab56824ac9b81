"""The parsed script: items, statements, blocks, each with its place in the source.

Items of a parsed script back to their text; parsing that text gives the same items again.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from ssilang.language.text.source import Span

if TYPE_CHECKING:
    from ssilang.language.say.errors import SsiError


BLOCKS = {"SI": "FINS", "REPE": "FIN", "DEBP": "FINP", "DEBM": "FINM"}
"""Words that open blocks, four letters of each, and those that close them."""


@dataclass(frozen=True, slots=True, eq=False)
class Number:
    """A literal ENTIER or FLOTTANT."""

    value: int | float
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Name:
    """A bare word, upper case in `text`, cut to what a name keeps; `spelling` as written."""

    text: str
    spelling: str
    span: Span

    @property
    def word(self) -> str:
        """All of it, upper case: what it says where no object bears the name."""
        return self.spelling.upper()


@dataclass(frozen=True, slots=True, eq=False)
class Quoted:
    """A string between quotes."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Symbol:
    """`+ - * / ** < > <EG >EG`: an operator written with signs."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Paren:
    """A parenthesised phrase."""

    items: "tuple[Item, ...]"
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """`base . index . index`."""

    base: "Item"
    indices: "tuple[Item, ...]"
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Attribute:
    """`base % name`; base None stands for the object that runs the method."""

    base: "Item | None"
    name: str | int
    span: Span


Item = Number | Name | Quoted | Symbol | Paren | Path | Attribute


def placed(item: Item, span: Span) -> Item:
    """The same item, said to stand at `span` (items that were parsed from a text)."""
    if isinstance(item, Paren):
        return Paren(tuple(placed(i, span) for i in item.items), span)
    if isinstance(item, Path):
        return Path(placed(item.base, span), tuple(placed(i, span) for i in item.indices), span)
    if isinstance(item, Attribute):
        return Attribute(None if item.base is None else placed(item.base, span), item.name, span)
    return replace(item, span=span)


def leaves(items: Iterable[Item]) -> Iterator[Item]:
    """Words, numbers and signs of a phrase, of its parentheses and indices too."""
    for item in items:
        if isinstance(item, Paren):
            yield from leaves(item.items)
        elif isinstance(item, Path):
            yield from leaves((item.base, *item.indices))
        elif isinstance(item, Attribute):
            yield from leaves(() if item.base is None else (item.base,))
        else:
            yield item


@dataclass(frozen=True, slots=True, eq=False)
class Statement:
    """`targets = items ;` (targets empty without `=`)."""

    targets: tuple[Item, ...]
    items: tuple[Item, ...]
    span: Span
    assigns: bool = False

    @property
    def first_word(self) -> str:
        """Upper-case text of the first item when it is a word and nothing is assigned."""
        if self.assigns or not self.items:
            return ""
        item = self.items[0]
        if isinstance(item, Name):
            return item.text
        return item.text if isinstance(item, Quoted) else ""


@dataclass(frozen=True, slots=True, eq=False)
class If:
    """SI ... SINON ... FINSI."""

    condition: Statement
    then: "tuple[Node, ...]"
    otherwise: "tuple[Node, ...]"
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Loop:
    """REPE name count ... FIN name."""

    name: str
    count: tuple[Item, ...]
    body: "tuple[Node, ...]"
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Parameter:
    """An argument of a procedure: `name*TYPE*SUBTYPE` (mandatory) or `name/TYPE` (optional)."""

    name: str
    type: str
    optional: bool
    subtype: str
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Definition:
    """DEBP ... FINP, or DEBM ... FINM when `method`."""

    name: str
    parameters: tuple[Parameter, ...]
    body: "tuple[Node, ...]"
    results: tuple[Item, ...]
    method: bool
    span: Span
    cache: dict[str, object] = field(default_factory=dict)


Node = Statement | If | Loop | Definition


@dataclass(frozen=True, slots=True, eq=False)
class Script:
    """A parsed and structured source.

    Attributes
    ----------
    unclosed : tuple of SsiError
        What opens blocks that are never closed, but in which FIN ends the run.
    warnings : tuple of SsiError
        What is read otherwise than it looks.
    """

    body: tuple[Node, ...]
    span: Span
    unclosed: "tuple[SsiError, ...]" = ()
    warnings: "tuple[SsiError, ...]" = ()


def first_assignments(nodes: tuple[Node, ...]) -> dict[str, Span]:
    """Where each name of a script first gets a value, or is defined; procedures' own left out."""
    found: dict[str, Span] = {}
    for node in nodes:
        if isinstance(node, Statement):
            inner = {t.text: t.span for t in node.targets if isinstance(t, Name)}
        elif isinstance(node, If):
            inner = first_assignments(node.then + node.otherwise)
        elif isinstance(node, Loop):
            inner = first_assignments(node.body)
        else:
            inner = {node.name: node.span}
        for name, span in inner.items():
            found.setdefault(name, span)
    return found


def given_again(nodes: tuple[Node, ...], name: str) -> Span | None:
    """Where a script gives a name a value behind its first one, and not from its own; blocks apart.

    What stands there holds whatever the first value was.
    """
    first, own = first_assignments(nodes).get(name), rf"(?<![\w@!&]){re.escape(name)}(?!\w)"
    for node in nodes if first is not None else ():
        targets = node.targets if isinstance(node, Statement) else ()
        again = [t.span for t in targets if isinstance(t, Name) and t.text == name]
        if again and again[0] != first and len(re.findall(own, node.span.text, re.I)) == 1:
            return again[0]
    return None


_PLAIN_WORD = re.compile(r"[^\W\d]\w*\Z|[@&!#$]\w+\Z")


def heading(node: Definition) -> str:
    """Name and arguments of a procedure, as they are declared."""
    return " ".join([_word(node.name), *(_parameter(p) for p in node.parameters)])


def _parameter(p: Parameter) -> str:
    text = _word(p.name)
    if p.type or p.optional:
        text += ("/" if p.optional else "*") + _word(p.type)
    return f"{text}*{_word(p.subtype)}" if p.subtype else text


# ---- items -----------------------------------------------------------------------------------


def print_items(items: Iterable[Item]) -> str:
    """Items separated by blanks."""
    return " ".join(_item(i) for i in items)


def _item(item: Item) -> str:
    return _ITEMS[type(item)](item)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _word(text: str) -> str:
    return text if _PLAIN_WORD.match(text) and text == text.upper() else _quoted(text)


def _path(item: Path) -> str:
    return " . ".join([_item(item.base), *(_item(i) for i in item.indices)])


def _attribute(item: Attribute) -> str:
    base = "" if item.base is None else _item(item.base)
    return f"{base}%{item.name if isinstance(item.name, int) else _word(item.name)}"


_ITEMS: dict[type, Callable[[Any], str]] = {
    Number: lambda item: repr(item.value),
    Name: lambda item: item.word,
    Quoted: lambda item: _quoted(item.text),
    Symbol: lambda item: item.text,
    Paren: lambda item: f"({print_items(item.items)})",
    Path: _path,
    Attribute: _attribute,
}
