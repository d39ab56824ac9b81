"""`+ - * / **` on every type that has them: dispatch by pairs of types."""

import operator as python
from typing import TypeVar

from ssilang.kernel.base.powers import real_power
from ssilang.language.registry import SCALAR_RULES
from ssilang.messages.message import Said
from ssilang.operators.prelude import *

Rule = Callable[[Any, Any], Any]

RULES: Filled[tuple[str, str, str], Rule] = Filled("rules")
"""(sign, left type, right type) -> function; modules of other families add theirs by `rule`."""

CallRule = Callable[[Call, str, Any, Any], Any]
CALL_RULES: Filled[tuple[str, str, str], CallRule] = Filled("rules that read more")
"""The same for rules that read more than two operands."""


Body = TypeVar("Body", bound=Callable[[str, Any, Any], Any])


def rule(signs: str, left: str, right: str) -> Callable[[Body], Body]:
    """Decorator: what signs (blank separated) do on a pair of types, a function `(sign, a, b)`."""

    def add(body: Body) -> Body:
        for sign in signs.split():
            RULES[sign, left, right] = partial(body, sign)
        return body

    return add


CallBody = TypeVar("CallBody", bound=Callable[["Call", str, Any, Any], Any])


def rule_with_call(signs: str, left: str, right: str) -> Callable[[CallBody], CallBody]:
    """Decorator: as `rule` for a function `(call, sign, a, b)` that reads further operands."""

    def add(body: CallBody) -> CallBody:
        for sign in signs.split():
            CALL_RULES[sign, left, right] = body
        return body

    return add


def _tabulated(signs: str, left: str, right: str, make: Callable[[str], Rule]) -> None:
    for sign in signs.split():
        RULES[sign, left, right] = make(sign)


_INTEGER_BITS = 4096  # far more than any count; keeps a loop of squares from filling the memory


def _integer_divide(a: int, b: int) -> int:
    """Quotient of integers, cut towards zero."""
    quotient = abs(a) // abs(b)
    return quotient if (a >= 0) == (b >= 0) else -quotient


def _integer_power(a: int, b: int) -> int:
    if b > 0 and b * a.bit_length() > _INTEGER_BITS:
        raise OverflowError
    return int(a**b) if b >= 0 else int(float(a) ** b)


def _integer_product(a: int, b: int) -> int:
    if a.bit_length() + b.bit_length() > _INTEGER_BITS:
        raise OverflowError
    return a * b


def _real_power(a: float, b: float) -> float:
    value = a**b
    return float(real_power(a, b)) if isinstance(value, complex) else float(value)


def _held(run: Rule) -> Rule:
    """The same on single reals; what no real can hold goes the long way, as a power's does."""

    def checked(a: float, b: float) -> float:
        value: float = run(a, b)
        # no finite number differs from itself: infinite operands may give infinite results
        if value - value != 0.0 and a - a == 0.0 and b - b == 0.0:
            raise OverflowError
        return value

    return checked


def _unbounded(sign: str) -> Rule:
    """A sign on single reals: what no real can hold is infinite, and numpy says so."""

    def found(a: float, b: float) -> float:
        try:
            return float(_REAL[sign](a, b))
        except OverflowError:
            return float(_ARRAY[sign](np.float64(a), np.float64(b)))

    return found


_INTEGER: dict[str, Rule] = {
    "+": python.add, "-": python.sub, "*": _integer_product,
    "/": _integer_divide, "**": _integer_power,
}  # fmt: skip
_REAL: dict[str, Rule] = {
    "+": _held(python.add), "-": _held(python.sub), "*": _held(python.mul),
    "/": _held(python.truediv), "**": _real_power,
}  # fmt: skip
_ARRAY: dict[str, Rule] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "**": real_power,
}  # fmt: skip
SIGNS = "+ - * / **"


def _scalar_rule(sign: str) -> Rule:
    integer, real = _INTEGER[sign], _REAL[sign]

    def run(a: Any, b: Any) -> Any:
        kinds = type(a), type(b)
        if kinds == (int, int):
            return integer(a, b)
        if bool in kinds:
            raise TypeError("LOGIQUE")
        return real(a, b)

    return run


def _list_rule(sign: str) -> Rule:
    compute = _ARRAY[sign]

    def run(a: Any, b: Any) -> Any:
        x, y = getattr(a, "values", a), getattr(b, "values", b)
        if isinstance(x, np.ndarray) and isinstance(y, np.ndarray) and len(x) != len(y):
            raise NoResultError("operators.numbers.list-lengths", n_first=len(x), n_second=len(y))
        if all(isinstance(v, int) or getattr(v, "dtype", None) == np.int64 for v in (x, y)):
            return ListEnti(_integer_arrays(sign, np.asarray(x), np.asarray(y)))
        return ListReel(compute(np.asarray(x, dtype=float), np.asarray(y, dtype=float)))

    return run


_LARGEST = 2**63 - 1  # of an item of a list of integers, whatever its sign: ABS stays one


def _integer_arrays(sign: str, x: Any, y: Any) -> Any:
    """Lists of integers by the rules of single ones; what 64 bits cannot hold is an error."""
    if sign in "+-*" and _stays_small(sign, x, y):
        return _ARRAY[sign](x, y)
    if sign == "/" and object not in (x.dtype, y.dtype) and np.all(y != 0):
        quotient = x // y  # cut downwards
        return quotient + ((quotient < 0) & (quotient * y != x))
    made = np.vectorize(_INTEGER[sign], otypes=[object])(x, y)
    if made.size and max(made.max(), -made.min()) > _LARGEST:
        raise NoResultError("operators.numbers.list-integer-too-large")
    return made.astype(np.int64)


def _stays_small(sign: str, x: Any, y: Any) -> bool:
    """Whether sums, or products, of two lists of integers keep far from what 64 bits hold."""
    if object in (x.dtype, y.dtype):
        return False
    large, other = (float(np.max(np.abs(v.astype(float)), initial=0.0)) for v in (x, y))
    return (large * other if sign == "*" else large + other) < 2.0**62


for _sign in SIGNS.split():
    SCALAR_RULES[_sign] = _scalar_rule(_sign)
for _a in ("ENTIER", "FLOTTANT"):
    for _b in ("ENTIER", "FLOTTANT"):
        _tabulated(SIGNS, _a, _b, _INTEGER.__getitem__ if _a == _b == "ENTIER" else _unbounded)
for _a in ("LISTENTI", "LISTREEL"):
    for _b in ("ENTIER", "FLOTTANT", "LISTENTI", "LISTREEL"):
        _tabulated(SIGNS, _a, _b, _list_rule)
        if _b in ("ENTIER", "FLOTTANT"):
            _tabulated(SIGNS, _b, _a, _list_rule)


def compute(sign: str, call: Call) -> Any:
    """Read two operands and combine them.

    Raises
    ------
    SsiError
        'no-rule' when the types do not go together, 'arithmetic' for a division by zero or an
        integer past its bound.
    """
    left = call.read("*")
    if left is not None and not call.operands and type_of(left.value) == "TABLE":
        return _sum_of_table(sign, call, left.value)
    right = call.read("*") if left is not None else None
    if left is None or right is None:
        raise SsiError("two-operands", call.span, operator=sign)
    types = type_of(left.value), type_of(right.value)
    reading = CALL_RULES.get((sign, *types))
    found = RULES.get((sign, *types))
    if found is None and reading is None:
        raise SsiError(
            "no-rule", left.span.to(right.span), operator=sign, left=types[0], right=types[1]
        )
    senseless: list[str] = []
    place = left.span.to(right.span)
    try:
        # a result past all reals is infinite; lists may be divided by zero
        with np.errstate(
            over="call", divide="call", invalid="call", call=lambda kind, _: senseless.append(kind)
        ):
            if reading is not None:
                result = reading(call, sign, left.value, right.value)
            else:
                assert found is not None
                result = found(left.value, right.value)
    except (ArithmeticError, ValueError, TypeError) as problem:
        raise SsiError("arithmetic", place, operator=sign, reason=_reason(problem)) from None
    if "overflow" in senseless:
        call.session.warn("operators.numbers.past-reals", place, sign=sign)
    elif senseless and isinstance(result, ListReel):
        _warn_of_zeros(call, place, sign, result)
    return result


def _warn_of_zeros(call: Call, span: Span, sign: str, result: ListReel) -> None:
    """Say which items of a list are infinite, or no numbers."""
    bad = np.flatnonzero(~np.isfinite(result.values))
    if len(bad):
        data = {"sign": sign, "count": len(bad), "item": int(bad[0]) + 1}
        value = float(result.values[bad[0]])
        call.session.warn("operators.numbers.list-not-finite", span, value=value, **data)


def _reason(problem: Exception) -> Said:
    if isinstance(problem, NoResultError):
        return problem
    if isinstance(problem, ZeroDivisionError):
        return Sentence("division-by-zero")
    too_large = isinstance(problem, OverflowError | FloatingPointError)
    return Sentence("too-large" if too_large else "no-value")


def _sum_of_table(sign: str, call: Call, table: Table) -> Any:
    """`+ TAB1`: sum of the objects at the integer indices of a table."""
    values = [v for index, v in table.items() if type(index) is int]
    if sign != "+" or not values:
        raise SsiError("two-operands", call.span, operator=sign)
    total = values[0]
    for value in values[1:]:
        types = type_of(total), type_of(value)
        reading, found = CALL_RULES.get((sign, *types)), RULES.get((sign, *types))
        if reading is not None:
            total = reading(call, sign, total, value)
        elif found is not None:
            total = found(total, value)
        else:
            raise SsiError("no-rule", call.span, operator=sign, left=types[0], right=types[1])
    return total


for _sign in ("+", "-", "*", "/", "**"):
    operator(
        _sign,
        arg("left", en="what stands before it"),
        arg("right", en="what stands behind it"),
        gives=ANY,
        family="arithmetic",
        reads_itself="the types of its two operands choose a rule, which may read more",
    )(lambda call, s=_sign: compute(s, call))
