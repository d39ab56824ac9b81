"""EGA NEG < > <EG >EG give a LOGIQUE, ET OU NON join them; MULT."""

import math
import operator as python

from ssilang.language.registry import SCALAR_RULES
from ssilang.operators.dispatch import union
from ssilang.operators.prelude import *

_NUMBERS = (int, float)


def _equal_scalars(a: Any, b: Any) -> bool:
    """Equality of scalars; the second number is converted to the type of the first."""
    kinds = type(a), type(b)
    if bool in kinds:
        if kinds != (bool, bool):
            raise TypeError("LOGIQUE")
        return bool(a == b)
    cut = kinds == (int, float) and math.isfinite(b)
    return bool(a == int(b)) if cut else bool(a == b)


def _of(logical: bool, rule: Callable[[Any, Any], bool]) -> Callable[[Any, Any], bool]:
    """A rule of logical values alone, or of other values alone."""

    def run(a: Any, b: Any) -> bool:
        if (type(a) is bool) is not logical or (type(b) is bool) is not logical:
            raise TypeError("LOGIQUE")
        return rule(a, b)

    return run


SCALAR_RULES["EGA"] = _equal_scalars
SCALAR_RULES["NEG"] = lambda a, b: not _equal_scalars(a, b)
_ORDERS: dict[str, Callable[[Any, Any], bool]] = {
    "<": python.lt, ">": python.gt, "<EG": python.le, ">EG": python.ge,
}  # fmt: skip
for _sign, _compare in _ORDERS.items():
    SCALAR_RULES[_sign] = _of(False, _compare)


_FIRST = arg("first", en="what stands before it")
_SECOND = arg("second", en="what stands behind it")


def _no_rule(call: Call, sign: str, first: Any, second: Any) -> SsiError:
    span = call.used[0].span.to(call.used[1].span)
    return SsiError("no-rule", span, operator=sign, left=type_of(first), right=type_of(second))


def equal(sign: str, call: Call, a: Any, b: Any, tolerance: float | None) -> bool:
    """Whether two objects are equal, reals and points within a tolerance."""
    if type(a) in _NUMBERS and type(b) in _NUMBERS:
        if tolerance is not None:
            return bool(abs(a - (int(b) if type(a) is int else b)) <= tolerance)
        return _equal_scalars(a, b)
    kinds = type_of(a), type_of(b)
    if isinstance(a, str) and isinstance(b, str):
        kept = len(a + b) + 1 if tolerance is None else tolerance
        if kept < 1 or kept % 1:
            raise call.error("operators.numbers.letters-compared", kept, value=kept)
        return a[: int(kept)].rstrip() == b[: int(kept)].rstrip()
    if "MOT" in kinds and {*kinds} & {"ENTIER", "FLOTTANT", "LOGIQUE"}:
        # they differ, which is told since the word may be a name misspelt
        call.session.warn(
            "operators.numbers.word-and-number",
            call.span,
            operator=sign,
            word=(a if isinstance(a, str) else b).rstrip(),
        )
        return False
    if kinds[0] != kinds[1] and {*kinds} != {"LISTENTI", "LISTREEL"}:
        raise _no_rule(call, sign, a, b)
    if isinstance(a, Point) and isinstance(b, Point):
        return _same_place(call, a, b, tolerance)
    if isinstance(a, ListMots):
        words = [[str(w).rstrip() for w in v.values] for v in (a, b)]
        return words[0] == words[1]
    if isinstance(a, ListReel | ListEnti):
        if len(a) != len(b):
            return False
        return bool(np.all(np.abs(a.values - b.values) <= (tolerance or 0.0)))
    return bool(a == b) if isinstance(a, bool) else a is b


def _same_place(call: Call, a: Point, b: Point, tolerance: float | None) -> bool:
    if tolerance is None:
        tolerance = max(a.density, b.density) / 10 or workspace(call.session).density / 10
    return bool(np.linalg.norm(a.coordinates - b.coordinates) <= tolerance)


def _told(sign: str, call: Call, first: Any, second: Any, tolerance: float | None) -> bool:
    return equal(sign, call, first, second, tolerance) == (sign == "EGA")


for _sign in ("EGA", "NEG"):
    operator(
        _sign,
        _FIRST,
        _SECOND,
        opt("tolerance", "FLOTTANT", range=NOT_NEGATIVE, en="tolerance; of words, letters counted"),
        gives="LOGIQUE",
        family="comparisons",
        full_name=_sign,
    )(partial(_told, _sign))


def _compare_numbers(sign: str, call: Call, first: Any, second: Any) -> bool:
    if type(first) not in _NUMBERS or type(second) not in _NUMBERS:
        raise _no_rule(call, sign, first, second)
    return _ORDERS[sign](first, second)


for _sign in _ORDERS:
    operator(_sign, _FIRST, _SECOND, gives="LOGIQUE", family="comparisons")(
        partial(_compare_numbers, _sign)
    )


SCALAR_RULES["ET"] = union(("LOGIQUE", "LOGIQUE"))(_of(True, python.and_))
SCALAR_RULES["OU"] = _of(True, python.or_)


@operator("OU", family="comparisons")
def ou(
    first: bool = Arg("LOGIQUE", en="logical value"),
    second: bool = Arg("LOGIQUE", en="another one"),
) -> bool:
    """Disjunction."""
    return first or second


@operator("NON", family="comparisons")
def non(value: bool = Arg("LOGIQUE", en="logical value")) -> bool:
    """Negation."""
    return not value


@operator("MULT", family="comparisons", full_name="MULTIPLE")
def mult(
    first: int = Arg("ENTIER", en="integer", range=ANY_NUMBER),
    second: int = Arg("ENTIER", en="divisor", range=NOT_ZERO),
) -> bool:
    """Divisibility."""
    return first == 0 if second == 0 else first % second == 0
