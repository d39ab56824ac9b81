"""BORN: values cut at bounds."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import (
    Chosen,
    Help,
    Like,
    arg,
    each,
    either,
    group,
    main,
    opt,
    select,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListReel
from ssilang.language.vocabulary.terms import ANY_NUMBER, POSITIVE

BORN = shared(
    "BORN",
    "numbers",
    Help(
        en="Values cut at an upper bound ('MAXIMUM'), a lower one ('MINIMUM') or both ('COMPRIS'). "
        "Of a field, component by component; of curves, curve by curve: those named are kept.",
        syntax="OBJ2 = BORN OBJ1 ((MOT1 | N1) 'MAXIMUM' X2 | 'MINIMUM' X1 | 'COMPRIS' X1 X2) ... ;",
    ),
    full_name="BORNER",
)
_HIGH = arg("high", "ENTIER", "FLOTTANT", en="upper bound", range=ANY_NUMBER)
_LOW = arg("low", "ENTIER", "FLOTTANT", en="lower bound", range=ANY_NUMBER)
_BOUND = select(
    "bound",
    {"MAXIMUM": [_HIGH], "MINIMUM": [_LOW], "COMPRIS": [_LOW, _HIGH]},
    optional=False,
    en="bounds of the values",
)


def _ends(bound: Chosen) -> tuple[float, float]:
    return bound.values.get("low", -np.inf), bound.values.get("high", np.inf)


@BORN.form(main("value", "LISTENTI", "LISTREEL", en="list"), _BOUND, gives=Like("value"))
def _clipped_list(value: ListEnti | ListReel, bound: Chosen) -> Any:
    return type(value)(np.clip(value.values, *_ends(bound)))


@BORN.form(
    main("value", "EVOLUTIO", en="curves"),
    each(
        "bounds",
        opt("curve", "ENTIER", en="number of a curve, 1 if none", range=POSITIVE),
        _BOUND,
        at_least=1,
    ),
)
def _clipped_curves(call: Call, value: Curve, bounds: list[tuple[int | None, Chosen]]) -> Curve:
    return _clipped_curve(call, value, [(who, *_ends(bound)) for who, bound in bounds])


@BORN.form(
    main("value", "CHPOINT", "MCHAML", en="field"),
    each(
        "bounds",
        either(
            "one",
            group("only", _BOUND),
            group(
                "named",
                arg("component", "MOT", en="component", kind="component"),
                _BOUND,
            ),
        ),
        at_least=1,
    ),
    gives=Like("value"),
)
def _clipped_fields(call: Call, value: NodeField | CellField, bounds: list[Chosen]) -> Any:
    wanted = []
    for one in bounds:
        name = one.values.get("component")
        who = None if name is None else str(name).rstrip()
        wanted.append((who, *_ends(one["bound"])))
    return _clipped_field(call, value, wanted)


def _clipped_curve(call: Call, value: Curve, wanted: list[tuple[Any, float, float]]) -> Curve:
    parts: list[CurvePart] = []
    for who, low, high in wanted:
        place = 1 if who is None else who
        if not 1 <= place <= len(value.parts):
            raise call.error(
                "operators.numbers.no-such-curve", n_parts=len(value.parts), place=place
            )
        part = value.parts[place - 1]
        parts.append(
            CurvePart(
                part.abscissas,
                np.clip(part.ordinates, low, high),
                part.abscissa_name,
                part.ordinate_name,
                part.legend,
                part.colour,
            )
        )
    return Curve(tuple(parts), value.title, value.kind)


def _clipped_field(call: Call, value: Any, wanted: list[tuple[Any, float, float]]) -> Any:
    node = isinstance(value, NodeField)
    names = list(value.components) if node else cell_algebra.component_names(value)
    made = None
    for who, low, high in wanted:
        if who is None and len(names) != 1:
            raise call.error("operators.numbers.which-component", names=names)
        name = names[0] if who is None else who

        def clip(x: Any, low: float = low, high: float = high) -> Any:
            return np.clip(x, low, high)

        if node:
            only = node_algebra.rebuilt(value, {name: node_algebra.component(value, name)})
            part: Any = node_algebra.applied(only, clip)
            made = part if made is None else node_algebra.united(made, part)
        else:
            part = cell_algebra.applied(cell_algebra.extracted(value, [name], [name]), clip)
            made = part if made is None else cell_algebra.united(made, part)
    return made
