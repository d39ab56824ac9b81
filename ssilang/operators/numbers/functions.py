"""Functions of one number on numbers, lists, curves and fields: ABS SIN EXP LOG ATG ..."""

import math
from importlib import import_module

from ssilang.kernel.base.scientific import special
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.mesh.mesh import same_cells
from ssilang.operators.prelude import *

Function = Callable[[Any], Any]
OPERANDS = ("ENTIER", "FLOTTANT", "LISTENTI", "LISTREEL", "EVOLUTIO", "CHPOINT", "MCHAML")


def mapped(function: Function, value: Any) -> Any:
    """A function `array -> array` on the values of a number, list, curve or field.

    A function that gives integers makes an ENTIER or LISTENTI of an ENTIER or LISTENTI.
    """
    if isinstance(value, int | float):
        return np.asarray(function(np.asarray(value))).item()
    if isinstance(value, ListEnti | ListReel):
        result = np.asarray(function(value.values))
        return ListEnti(result) if result.dtype == np.int64 else ListReel(result)
    if isinstance(value, Curve):
        parts = (
            replace(p, ordinates=np.asarray(function(p.ordinates), dtype=float))
            for p in value.parts
        )
        return replace(value, parts=tuple(parts))
    if isinstance(value, NodeField):
        return node_algebra.applied(value, function)
    assert isinstance(value, CellField)
    return cell_algebra.applied(value, lambda x: _of_cells(function, x), objects=True)


def _of_cells(function: Function, values: Any) -> Any:
    """The function of what cells hold: numbers, or curves and lists one by one."""
    if values.dtype != object:
        return function(values)
    made = np.empty_like(values)
    for place, held in np.ndenumerate(values):
        if not isinstance(held, Curve | ListReel | ListEnti):
            raise KernelError("operators.numbers.no-function-of", kind=type_of(held))
        made[place] = mapped(function, held)
    return made


def _within(name: str, function: Function, low: float, high: float, strict: bool) -> Function:
    """A function that refuses arguments outside of an interval."""

    def run(x: Any) -> Any:
        bad = (x <= low) if strict else (x < low - 1e-12)
        bad = bad | (x > high + 1e-12) | np.isnan(x)
        if np.any(bad):
            worst = np.atleast_1d(x)[np.atleast_1d(bad)][0]
            raise _outside(name, worst, low, high, strict)
        return function(np.clip(x, low, high) if not strict else x)

    return run


def _outside(name: str, worst: float, low: float, high: float, strict: bool) -> KernelError:
    if strict:
        return KernelError("operators.numbers.argument-above", name=name, worst=worst, low=low)
    if high == np.inf:
        return KernelError("operators.numbers.argument-at-least", name=name, worst=worst, low=low)
    return KernelError(
        "operators.numbers.argument-between", name=name, worst=worst, low=low, high=high
    )


def _degrees(function: Function) -> Function:
    return lambda x: np.degrees(function(x))


def _special(name: str) -> Function:
    """A function of scipy, which is imported when it is first used."""
    return lambda x: getattr(import_module("scipy.special"), name)(x)


def _sign(x: Any) -> Any:
    """-1 below zero, else 1, in the type of the argument."""
    return np.where(x < 0, -1, 1).astype(np.asarray(x).dtype)


_FUNCTIONS: dict[str, Function] = {
    "ABS": np.abs,
    "SIGN": _sign,
    "SIN": lambda x: np.sin(np.radians(x)),
    "COS": lambda x: np.cos(np.radians(x)),
    "TAN": lambda x: np.tan(np.radians(x)),
    "ASIN": _degrees(_within("ASIN", np.arcsin, -1, 1, False)),
    "ACOS": _degrees(_within("ACOS", np.arccos, -1, 1, False)),
    "SINH": np.sinh,
    "COSH": np.cosh,
    "TANH": np.tanh,
    "ASIH": np.arcsinh,
    "ACOH": _within("ACOH", np.arccosh, 1, np.inf, False),
    "ATAH": _within("ATAH", np.arctanh, -1, 1, False),
    "EXP": np.exp,
    "LOG": _within("LOG", np.log, 0, np.inf, True),
    "ERF": _special("erf"),
    "ERFC": _special("erfc"),
}
_INTEGERS_STAY = frozenset({"ABS", "SIGN"})


_VALUE = arg("value", *OPERANDS, en="argument", range=CARRIED)
_ANGLE = arg("value", *OPERANDS, en="angle", unit="deg", range=CARRIED, usual=CARRIED)
_REALS = "FLOTTANT|LISTREEL|EVOLUTIO|CHPOINT|MCHAML"


def _run(name: str, function: Function, value: Any, axis: str | None) -> Any:
    if axis and not isinstance(value, Curve):
        raise KernelError("operators.numbers.axis-of-curve", axis=axis, kind=type_of(value))
    if axis == "ABSC":
        parts = (replace(p, abscissas=function(p.abscissas)) for p in value.parts)
        return replace(value, parts=tuple(parts))
    if name not in _INTEGERS_STAY and isinstance(value, int | ListEnti):
        value = float(value) if isinstance(value, int) else ListReel(value.values)
    return mapped(function, value)


def _is_part_of_pi(number: float) -> bool:
    parts = number / math.pi * _PARTS
    return 0.0 < abs(parts) < _MOST_PARTS and abs(parts - round(parts, 2)) <= 1e-11 * abs(parts)


def _of_angle(name: str, function: Function, call: Call, value: Any, axis: str | None) -> Any:
    """A function of degrees; numbers that are all short parts of PI were meant in radians."""
    given = value.values[value.values != 0.0] if isinstance(value, ListReel) else [value]
    if isinstance(value, float | ListReel) and len(given) and all(map(_is_part_of_pi, given)):
        told = {"name": name, "value": float(given[0]), "degrees": math.degrees(given[0])}
        call.warn("operators.numbers.angle-in-radians", value, **told)
    return _run(name, function, value, axis)


_PARTS, _MOST_PARTS = 720.0, 1e4  # of PI, so that the angles which scripts write are short
_ANGLES = ("SIN", "COS", "TAN")
_AXIS = choice("axis", ("ABSC", "ORDO"), en="of the abscissas of a curve, or of its ordinates")


for _name, _function in _FUNCTIONS.items():
    operator(
        _name,
        _ANGLE if _name in _ANGLES else _VALUE,
        _AXIS,
        gives=Like("value") if _name in _INTEGERS_STAY else _REALS,
        family="functions",
    )(partial(_of_angle if _name in _ANGLES else _run, _name, _function))


@operator("IFRE", family="functions")
def ifre(
    limit: float = Arg("FLOTTANT", en="upper limit, in radians", range=NOT_NEGATIVE),
) -> tuple[float, float]:
    """Fresnel's integrals by those of `pi u^2 / 2`, `t = pi u^2 / 2`."""
    sine, cosine = special.fresnel(np.sqrt(2.0 * limit / np.pi))
    return float(cosine), float(sine)


@operator("ATG", gives=_REALS, family="functions")
def atg(
    call: Call,
    first: Any = Arg(*OPERANDS, en="tangent, or numerator", range=CARRIED),
    second: Any = Opt(*OPERANDS, en="denominator", range=CARRIED),
    axis: str | None = _AXIS,
) -> Any:
    """Arc tangent of one or two objects."""
    if second is None:
        return _run("ATG", _degrees(np.arctan), first, axis)
    if axis:
        raise KernelError("operators.numbers.axis-of-curve", axis=axis, kind=type_of(second))
    if isinstance(first, int | float) and isinstance(second, int | float):
        return float(np.degrees(np.arctan2(first, second)))
    if isinstance(first, ListReel | ListEnti) and isinstance(second, ListReel | ListEnti):
        if len(first) != len(second):
            raise call.error(
                "operators.numbers.list-lengths", second, n_first=len(first), n_second=len(second)
            )
        return ListReel(np.degrees(np.arctan2(first.values, second.values)))
    if isinstance(first, NodeField) and isinstance(second, NodeField):
        made = {}
        for name, part in second.components.items():
            top = first.values_at(name, part.nodes)
            made[name] = replace(part, values=np.degrees(np.arctan2(top, part.values)))
        return node_algebra.rebuilt(second, made)
    if isinstance(first, CellField) and isinstance(second, CellField):
        return _angle_of_cells(call, first, second)
    raise call.error("operators.numbers.two-of-one-kind", second)


def _angle_of_cells(call: Call, first: CellField, second: CellField) -> CellField:
    blocks = []
    for block in second.blocks:
        other = next((b for b in first.blocks if same_cells(b.cells, block.cells)), None)
        if other is None:
            raise call.error("operators.numbers.fields-on-other-cells", second)
        made = {
            k: np.degrees(np.arctan2(_part(other, k), cell_algebra.numeric(k, v)))
            for k, v in block.components.items()
        }
        blocks.append(cell_algebra.rebuilt(block, made))
    return CellField(tuple(blocks), second.title)


def _part(block: CellFieldBlock, name: str) -> Any:
    """A component of a block, zero where it is absent."""
    return cell_algebra.numeric(name, block.components.get(name, np.zeros((1, 1))))
