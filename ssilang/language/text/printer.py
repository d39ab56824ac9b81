"""Items of a parsed script back to their text; parsing that text gives the same items again."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

from ssilang.language.text import tree

_PLAIN_WORD = re.compile(r"[^\W\d]\w*\Z|[@&!#$]\w+\Z")


def heading(node: tree.Definition) -> str:
    """Name and arguments of a procedure, as they are declared."""
    return " ".join([_word(node.name), *(_parameter(p) for p in node.parameters)])


def _parameter(p: tree.Parameter) -> str:
    text = _word(p.name)
    if p.type or p.optional:
        text += ("/" if p.optional else "*") + _word(p.type)
    return f"{text}*{_word(p.subtype)}" if p.subtype else text


# ---- items -----------------------------------------------------------------------------------


def print_items(items: Iterable[tree.Item]) -> str:
    """Items separated by blanks."""
    return " ".join(_item(i) for i in items)


def _item(item: tree.Item) -> str:
    return _ITEMS[type(item)](item)


def _number(item: tree.Number) -> str:
    return repr(item.value)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _word(text: str) -> str:
    return text if _PLAIN_WORD.match(text) and text == text.upper() else _quoted(text)


def _path(item: tree.Path) -> str:
    return " . ".join([_item(item.base), *(_item(i) for i in item.indices)])


def _attribute(item: tree.Attribute) -> str:
    base = "" if item.base is None else _item(item.base)
    return f"{base}%{_word(item.name)}"


_ITEMS: dict[type, Callable[[Any], str]] = {
    tree.Number: _number,
    tree.Name: lambda item: item.word,
    tree.Quoted: lambda item: _quoted(item.text),
    tree.Symbol: lambda item: item.text,
    tree.Paren: lambda item: f"({print_items(item.items)})",
    tree.Path: _path,
    tree.Attribute: _attribute,
}
