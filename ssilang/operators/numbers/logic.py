"""ET OU NON on logical values; MULT."""

from __future__ import annotations

from typing import Any

from ssilang.language.registry import SCALAR_RULES, arg, operator
from ssilang.language.vocabulary.terms import ANY_NUMBER, NOT_ZERO
from ssilang.operators.dispatch import union


def _both(a: Any, b: Any) -> bool:
    if type(a) is not bool or type(b) is not bool:
        raise TypeError("not LOGIQUE")
    return a and b


def _either(a: Any, b: Any) -> bool:
    if type(a) is not bool or type(b) is not bool:
        raise TypeError("not LOGIQUE")
    return a or b


SCALAR_RULES["ET"] = _both
SCALAR_RULES["OU"] = _either
union(("LOGIQUE", "LOGIQUE"))(_both)


@operator(
    "OU",
    arg("first", "LOGIQUE", en="logical value"),
    arg("second", "LOGIQUE", en="another one"),
    family="comparisons",
)
def ou(first: bool, second: bool) -> bool:
    """Disjunction."""
    return first or second


@operator("NON", arg("value", "LOGIQUE", en="logical value"), family="comparisons")
def non(value: bool) -> bool:
    """Negation."""
    return not value


@operator(
    "MULT",
    arg("first", "ENTIER", en="integer", range=ANY_NUMBER),
    arg("second", "ENTIER", en="divisor", range=NOT_ZERO),
    family="comparisons",
    full_name="MULTIPLE",
)
def mult(first: int, second: int) -> bool:
    """Divisibility."""
    return first == 0 if second == 0 else first % second == 0
