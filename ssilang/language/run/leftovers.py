"""What is wrong with a phrase that leaves operands which nothing reads."""

import re
from collections.abc import Mapping, Sequence

from ssilang.language.registry import find_operator
from ssilang.language.run.call import Operand
from ssilang.language.say.errors import SsiError
from ssilang.language.text import tree
from ssilang.language.text.source import Span
from ssilang.language.values import ANNULE, Mot, type_of

_JOINED = frozenset({"RIGIDITE", "MAILLAGE", "MMODEL", "MCHAML", "CHARGEME", "EVOLUTIO"})
"""Types of which ET makes one object of two."""


def is_call(left: Sequence[Operand]) -> bool:
    """Whether leftovers begin with a bare unknown word before others: a misspelt call."""
    if len(left) < 2:
        return False
    first = left[0]
    return isinstance(first.value, Mot) and not first.result and not first.name


def is_named_object(operand: Operand) -> bool:
    """Whether an operand is an object that a name holds, neither a scalar nor a word."""
    return bool(operand.name) and not isinstance(operand.value, bool | int | float | Mot)


def is_operator(item: tree.Item, word: object) -> bool:
    """Whether an item is the bare word of an operator: `&i. EGA 1`."""
    return isinstance(item, tree.Name) and find_operator(str(word)) is not None


def leftover_error(
    left: Sequence[Operand], later: Mapping[str, Span], taken: Sequence[Operand] = ()
) -> SsiError | None:
    """The error for operands that nothing read, None if there are none.

    Parameters
    ----------
    left : sequence of Operand
    taken : sequence of Operand
        Those before them, which names on the left of = have taken.
    later : mapping
        Names that the script gives a value to somewhere, with the place where it does.
    """
    left = [o for o in left if o.value is not ANNULE]
    if not left:
        return None
    refused = next((o.refusal for o in left if o.refusal), None)
    if refused is not None:
        return refused
    words = [o for o in left if isinstance(o.value, Mot) and not o.name and not o.result]
    unread = next((o for o in words if find_operator(str(o.value)) is not None), None)
    # what begins a statement can only be meant as what it calls
    called = words and (not _quoted(words[0]) or not _words_before(words[0].span))
    if unread is not None and not (_quoted(unread) and called):
        before = next((o for o in left if isinstance(o.value, Mot)), unread)
        name = "" if before is unread else before.span.text
        return SsiError("unread-operator", unread.span, name=str(unread.value), before=name)
    every = (*taken, *left)
    hidden = next((o for o in every if o.name and find_operator(o.name) is not None), None)
    if hidden is not None and len(every) > 1:
        return SsiError(
            "hidden-operator", hidden.span, name=hidden.name, found=type_of(hidden.value)
        )
    if words:
        return _unknown_word(words[0], later)
    return _excess(left[0], every)


def _quoted(operand: Operand) -> bool:
    """Whether a word stands in quotes: behind an unknown one that calls it is its keyword."""
    return operand.span.text[:1] == "'"


def _unknown_word(operand: Operand, later: Mapping[str, Span]) -> SsiError:
    name = str(operand.value)
    place, own = later.get(name.upper()), operand.span
    if place is not None and place.start > own.start and place.source is own.source:
        line = place.source.position(place.start)[0]
        return SsiError("set-later", operand.span, name=name, line=line)
    return SsiError("unknown-operator", operand.span, name=name)


def _excess(operand: Operand, every: Sequence[Operand]) -> SsiError:
    text = operand.span.text
    given = [o for o in every if o.result and o.span == operand.span]
    if operand.result and len(given) > 1:
        types = [type_of(o.value) for o in given]
        return SsiError("results-in-excess", operand.span, caller=text, types=types)
    if isinstance(operand.value, int | float) and text[:1] in ("-", "+"):
        return SsiError("glued-sign", operand.span, number=text, sign=text[0], rest=text[1:])
    caller = _called_with_parentheses(operand.span)
    bare = all(type(o.value) in (int, float) and not o.name for o in every)
    joined = type_of(operand.value) in _JOINED and any(
        o is not operand and o.result and type_of(o.value) == type_of(operand.value) for o in every
    )
    kind = "parentheses" if caller else "numbers" if bare and len(every) > 1 else "order"
    kind = "join" if joined and not caller else kind
    told = {"found": type_of(operand.value), "name": operand.name, "kind": kind, "caller": caller}
    begins = next(iter(_words_before(operand.span)), "")
    return SsiError("excess", operand.span, **told, begins=begins)


def _called_with_parentheses(place: Span) -> str:
    """The operator whose operands a parenthesis glued to it holds, `DROI(4 P1 P2)`, '' if none."""
    depth, code = 0, place.source.code[: place.start]
    for i in range(len(code) - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(code[i], 0)
        if depth < 0:
            found = re.search(r"\w+$", code[:i])
            known = found is not None and find_operator(found[0].upper()) is not None
            return found[0].upper() if found and known else ""
        if code[i] == ";":
            break
    return ""


def _words_before(span: Span) -> list[str]:
    """Words of a statement before a place in it."""
    return span.source.code[: span.start].rpartition(";")[2].split()
