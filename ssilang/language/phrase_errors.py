"""Errors of phrases that run and give the wrong thing: held words, names without a result."""

from __future__ import annotations

from collections.abc import Sequence

from ssilang.language import tree
from ssilang.language.call import Operand
from ssilang.language.errors import SsiError
from ssilang.language.session import PREDEFINED


def tell_held_word(error: SsiError, operand: Operand) -> None:
    """Add the word to an error of its operator if the script holds it and does not write it."""
    written = operand.span.text
    if PREDEFINED.get(written.upper()) == operand.value:
        return
    if not operand.result and written.strip("'").upper()[:4] != str(operand.value).upper()[:4]:
        error.data.setdefault("held_word", (str(operand.value), written))


def no_result(
    targets: Sequence[tree.Item], target: tree.Item, count: int, wanted: str = ""
) -> SsiError:
    """The error of a name on the left of = that gets nothing.

    Where the last name stands alone on a later line than the others, the statement before it has
    lost its `;`, and the error says so.
    """
    last = targets[-1].span
    line = last.source.position(last.start)[0]
    before = [t.span for t in targets if t.span.source.position(t.span.start)[0] < line]
    if before and len(targets) == len(before) + 1:
        whole = before[0].to(before[-1])
        return SsiError("unended-statement", whole, name=last.text, line=line)
    return SsiError("no-result", target.span, count=count, wanted=wanted, name=target.span.text)
