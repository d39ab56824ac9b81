"""COLI SOMT: linear combinations of fields and lists, the sum of a field."""

from __future__ import annotations

from typing import Any

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import (
    Help,
    arg,
    many,
    operator,
    shared,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListReel, Table
from ssilang.language.vocabulary.terms import ANY_NUMBER

COLI = shared(
    "COLI",
    "fields",
    Help(
        en="Linear combination: fields each followed by its coefficient, or a list of fields (or "
        "a table 1 .. N of fields or lists) with a list of coefficients.",
        syntax="CHP1 = COLI CHP2 X2 CHP3 X3 ... ; OBJ1 = COLI LCHP1 | TAB1 LREE1 ;",
    ),
    full_name="COLINEAIRE",
)


@COLI.form(
    arg("held", "LISTCHPO", "TABLE", en="fields, or a table 1 .. N of fields or lists"),
    arg("factors", "LISTREEL", en="coefficients", range=ANY_NUMBER),
    gives="CHPOINT|MCHAML|LISTREEL",
)
def _combine_held(call: Call, held: ListChpo | Table, factors: ListReel) -> Any:
    numbers = factors.values.tolist()
    if isinstance(held, ListChpo):
        return _combined(call, list(held.values), numbers)
    return _combined(call, [held.get(i) for i in range(1, len(numbers) + 1)], numbers)


@COLI.form(
    many("objects", "CHPOINT", "MCHAML", at_least=1, en="fields"),
    many("factors", "FLOTTANT", en="coefficients", range=ANY_NUMBER),
    gives="CHPOINT|MCHAML",
)
def _combine_fields(call: Call, objects: tuple[Any, ...], factors: tuple[float, ...]) -> Any:
    return _combined(call, list(objects), list(factors))


def _combined(call: Call, objects: list[Any], factors: list[float]) -> Any:
    if not objects or len(objects) != len(factors):
        raise call.error(
            "operators.lists.coefficient-count", n_objects=len(objects), n_factors=len(factors)
        )
    if all(isinstance(o, ListReel) for o in objects):
        if len({len(o) for o in objects}) > 1:
            raise call.error("operators.lists.lengths-differ")
        return ListReel(sum(f * o.values for f, o in zip(factors, objects, strict=True)))
    kinds = {type(o) for o in objects}
    if len(kinds) > 1 or not kinds <= {NodeField, CellField}:
        raise call.error("operators.lists.nothing-to-combine")
    algebra: Any = node_algebra if isinstance(objects[0], NodeField) else cell_algebra
    total = algebra.applied(objects[0], lambda v: v * factors[0])
    for factor, field in zip(factors[1:], objects[1:], strict=True):
        total = algebra.added(total, field, factor)
    return total


@operator(
    "SOMT",
    arg("field", "CHPOINT", en="field of one component"),
    family="fields",
    help=Help(
        en="Sum of the values of a field of a single component (SCAL, most often).",
        syntax="X1 = SOMT CHPO1 ;",
    ),
)
def somt(field: NodeField) -> float:
    """Sum values."""
    if len(field.components) != 1:
        raise KernelError("operators.lists.single-component")
    return float(next(iter(field.components.values())).values.sum())
