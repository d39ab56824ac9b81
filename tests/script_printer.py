"""From a parsed script back to its text; parsing that text gives the same tree again.

Comments and layout are not kept. Names are printed in capitals, one statement a line, blocks
indented by two blanks.
"""

from collections.abc import Callable, Iterable
from dataclasses import fields
from functools import cache
from typing import Any

from ssilang.language.text import tree
from ssilang.language.text.tree import _word as word_of
from ssilang.language.text.tree import heading, print_items

_IGNORED_FIELDS = frozenset({"span", "spelling", "cache"})


def print_script(script: tree.Script) -> str:
    """The whole script, ending with a line end."""
    return "".join(line + "\n" for line in _block(script.body, 0))


def _block(nodes: Iterable[tree.Node], depth: int) -> list[str]:
    lines: list[str] = []
    for node in nodes:
        lines += _NODES[type(node)](node, depth)
    return lines


def _line(text: str, depth: int) -> str:
    # a star or a library mark in the first column would be a comment
    shift = " " if depth == 0 and text.startswith(("*", "$$$$")) else "  " * depth
    return shift + text


def _statement(node: tree.Statement, depth: int) -> list[str]:
    text = print_items(node.items)
    if node.assigns:
        text = f"{print_items(node.targets)} = {text}"
    return [_line(f"{text} ;", depth)]


def _if(node: tree.If, depth: int) -> list[str]:
    head = f"SI {print_items(node.condition.items)} ;"
    lines = [_line(head, depth), *_block(node.then, depth + 1)]
    if node.otherwise:
        lines += [_line("SINON ;", depth), *_block(node.otherwise, depth + 1)]
    return [*lines, _line("FINSI ;", depth)]


def _loop(node: tree.Loop, depth: int) -> list[str]:
    name = word_of(node.name)
    head = " ".join(p for p in ("REPE", name, print_items(node.count)) if p)
    return [_line(f"{head} ;", depth), *_block(node.body, depth + 1), _line(f"FIN {name} ;", depth)]


def _definition(node: tree.Definition, depth: int) -> list[str]:
    first, last = ("DEBM", "FINM") if node.method else ("DEBP", "FINP")
    head = f"{first} {heading(node)}"
    end = " ".join(p for p in (last, print_items(node.results)) if p)
    return [_line(f"{head} ;", depth), *_block(node.body, depth + 1), _line(f"{end} ;", depth)]


_NODES: dict[type, Callable[[Any, int], list[str]]] = {
    tree.Statement: _statement,
    tree.If: _if,
    tree.Loop: _loop,
    tree.Definition: _definition,
}


def same_tree(a: Any, b: Any) -> bool:
    """Whether two trees (or parts of trees) say the same, wherever they stand in their texts."""
    pairs = [(a, b)]  # no recursion: parentheses may be nested by thousands
    while pairs:
        a, b = pairs.pop()
        if type(a) is not type(b):
            return False
        if isinstance(a, tuple):
            if len(a) != len(b):
                return False
            pairs += zip(a, b, strict=True)
        elif hasattr(a, "__dataclass_fields__"):
            pairs += ((getattr(a, n), getattr(b, n)) for n in _said(a.__class__))
        elif a != b:
            return False
    return True


@cache
def _said(kind: Any) -> tuple[str, ...]:
    """Fields of a kind of node that say something."""
    return tuple(f.name for f in fields(kind) if f.name not in _IGNORED_FIELDS)
