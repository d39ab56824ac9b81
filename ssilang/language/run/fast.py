"""Short way for phrases of scalars: names, numbers and table entries joined by signs.

Such a phrase is turned once into nested closures. When an operand turns out not to be a scalar,
or an operation fails, `Slow` is raised and the evaluator runs the phrase the general way, which
also makes the error message; reading operands has no effects, so nothing is done twice.
"""

from collections.abc import Callable, Sequence
from typing import Any

from ssilang.language.registry import SCALAR_RULES
from ssilang.language.run.scopes import Frame
from ssilang.language.text import tree
from ssilang.language.values import Table

Value = Callable[[Frame], Any]
_LONGEST = 199  # items of a phrase; each sign is one more closure in depth
_SCALARS = frozenset({int, float, bool})


class Slow(Exception):
    """The phrase must be run the general way."""


def compile_phrase(items: Sequence[tree.Item]) -> Value | None:
    """A function that computes the phrase for a frame, None if its shape does not allow it."""
    if len(items) % 2 == 0 or len(items) > _LONGEST:
        return None
    if not all(isinstance(i, tree.Symbol | tree.Name) for i in items[1::2]):
        return None
    value = _operand(items[0])
    for sign, item in zip(items[1::2], items[2::2], strict=True):
        rule = SCALAR_RULES.get(sign.text) if isinstance(sign, tree.Symbol | tree.Name) else None
        right = _operand(item)
        if value is None or rule is None or right is None:
            return None
        guard = sign.text if isinstance(sign, tree.Name) else ""
        value = _binary(rule, value, right, guard)
    if value is None or (len(items) == 1 and not isinstance(items[0], tree.Paren)):
        return None
    return value


def _operand(item: tree.Item) -> Value | None:
    if isinstance(item, tree.Number):
        number = item.value
        return lambda frame: number
    if isinstance(item, tree.Name):
        return _name(item.text)
    if isinstance(item, tree.Paren):
        return compile_phrase(item.items) or (
            _operand(item.items[0])
            if len(item.items) == 1 and isinstance(item.items[0], tree.Name | tree.Number)
            else None
        )
    if isinstance(item, tree.Path):
        return _path(item)
    return None


def _name(text: str) -> Value:
    def run(frame: Frame) -> Any:
        value = frame.variables.get(text)
        if value is None:
            value = frame.find(text)
        if type(value) in _SCALARS:
            return value
        raise Slow

    return run


def _path(item: tree.Path) -> Value | None:
    if not isinstance(item.base, tree.Name) or len(item.indices) != 1:
        return None
    base, index = item.base.text, item.indices[0]
    if isinstance(index, tree.Number):
        fixed: Any = index.value
    elif isinstance(index, tree.Quoted):
        fixed = index.text
    elif isinstance(index, tree.Name):
        fixed = None
    else:
        return None
    name = index.text if isinstance(index, tree.Name) else ""

    def run(frame: Frame) -> Any:
        table = frame.find(base)
        if type(table) is not Table:
            raise Slow
        where = fixed
        if name:
            where = frame.find(name)
            if where is None:
                where = name
        value = table.get(where)
        if type(value) in _SCALARS:
            return value
        raise Slow

    return run


def _binary(rule: Callable[[Any, Any], Any], left: Value, right: Value, guard: str) -> Value:
    def run(frame: Frame) -> Any:
        try:
            return rule(left(frame), right(frame))
        except (ArithmeticError, ValueError, TypeError):
            raise Slow from None

    def guarded(frame: Frame) -> Any:
        if frame.find(guard) is not None:  # a variable hides the operator of its name
            raise Slow
        return run(frame)

    return guarded if guard else run
