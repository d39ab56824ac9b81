"""MAXI MINI on numbers, lists and fields (curves are in curve_items)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListReel
from ssilang.operators.dispatch import MAXI, MINI

_NUMBERS = ("ENTIER", "FLOTTANT")
_LISTS = ("LISTREEL", "LISTENTI")


def _absolute(call: Call) -> bool:
    return call.keyword(("ABS",)) is not None


def _of_numbers(call: Call, first: Any, largest: bool) -> Any:
    absolute = _absolute(call)
    values = [first, *call.all(*_NUMBERS)]
    absolute = _absolute(call) or absolute
    if absolute:
        values = [abs(v) for v in values]
    found = max(values) if largest else min(values)
    return found if all(isinstance(v, int) for v in values) else float(found)


def _of_lists(call: Call, first: Any, largest: bool) -> Any:
    absolute = _absolute(call)
    lists = [first, *call.all(*_LISTS)]
    absolute = _absolute(call) or absolute
    arrays = [np.abs(v.values) if absolute else v.values for v in lists]
    if len(arrays) == 1:
        if not len(arrays[0]):
            raise call.error("operators.fields.list-empty", first)
        return (arrays[0].max() if largest else arrays[0].min()).item()
    if len({len(a) for a in arrays}) > 1:
        raise call.error(
            "operators.fields.list-lengths-differ", lengths=[str(len(a)) for a in arrays]
        )
    best = (np.maximum if largest else np.minimum).reduce(arrays)
    return ListEnti(best) if all(isinstance(v, ListEnti) for v in lists) else ListReel(best)


def _components(call: Call, known: list[str]) -> tuple[bool, list[str]]:
    """Whether absolute values are meant, and the components to look at."""
    absolute, names = False, known
    while (said := call.keyword(("ABS", "AVEC", "SANS"))) is not None:
        if said == "ABS":
            absolute = True
            continue
        operand = call.read("LISTMOTS", "MOT", after=call.keyword_end)
        if operand is None:
            raise call.missing(("LISTMOTS",))
        value = operand.value
        listed = [value] if isinstance(value, str) else value.values
        words = {str(w).rstrip() for w in listed}
        names = [n for n in known if (n in words) == (said == "AVEC")]
        if not names:
            raise call.error("operators.fields.no-component-left", value, known=known)
    return absolute, names


def _of_arrays(call: Call, arrays: list[Any], absolute: bool, largest: bool) -> float:
    arrays = [a for a in arrays if a.size]
    if not arrays:
        raise call.error("operators.fields.field-empty")
    values = [np.abs(a) if absolute else a for a in arrays]
    return float(max(v.max() for v in values) if largest else min(v.min() for v in values))


def _of_node_fields(call: Call, first: NodeField, largest: bool) -> Any:
    absolute, names = _components(call, list(first.components))
    others = call.all("CHPOINT")
    if not others:
        if not names:
            raise call.error("operators.fields.field-empty", first)
        arrays = [first.components[n].values for n in names]
        return _of_arrays(call, arrays, absolute or _absolute(call), largest)
    absolute = _absolute(call) or absolute
    run = np.maximum if largest else np.minimum
    made = node_algebra.applied(first, np.abs) if absolute else first
    for other in others:
        made = _pairwise(made, node_algebra.applied(other, np.abs) if absolute else other, run)
    return made


def _pairwise(a: NodeField, b: NodeField, run: Any) -> NodeField:
    made = {}
    for name, part in a.components.items():
        other = b.components.get(name)
        if other is None or not np.array_equal(other.nodes, part.nodes):
            raise KernelError("operators.fields.fields-do-not-match")
        made[name] = type(part)(part.nodes, run(part.values, other.values))
    return node_algebra.rebuilt(a, made)


def _of_cell_fields(call: Call, field: CellField, largest: bool) -> float:
    known = [
        n
        for n in cell_algebra.component_names(field)
        if any(n in b.components and b.components[n].dtype != object for b in field.blocks)
    ]
    absolute, names = _components(call, known)
    return _of_arrays(call, cell_algebra.values_of(field, names), absolute, largest)


for _operator, _largest, _en, _fr in (
    (MAXI, True, "largest", "plus grande"),
    (MINI, False, "smallest", "plus petite"),
):
    _name = _operator.name
    _operator.on(
        *_NUMBERS,
        syntax=f"X1 = {_name} ('ABS') X2 X3 ... ;",
        en=f"Of numbers: the {_en}.",
        fr=f"De nombres : la {_fr}.",
        examples=(f"LIST ({_name} 3. -7. 5.) ;",),
    )(lambda call, value, w=_largest: _of_numbers(call, value, w))  # type: ignore[misc]
    _operator.on(
        *_LISTS,
        syntax=f"X1 = {_name} LIS1 ('ABS') ; LIS4 = {_name} ('ABS') LIS1 LIS2 ... ;",
        en=f"Of a list: the {_en} value; of several, item by item.",
        fr=f"D'une liste : la {_fr} valeur ; de plusieurs, terme à terme.",
        examples=(f"LIST ({_name} (PROG 3. -7. 5.) 'ABS') ;",),
    )(lambda call, value, w=_largest: _of_lists(call, value, w))  # type: ignore[misc]
    _operator.on(
        "CHPOINT",
        syntax=f"X1 = {_name} CHP1 ('ABS') ('AVEC' | 'SANS' LMOT1) ; CHPO4 = {_name} CHPO1 CHPO2 ;",
        en=f"Of a field: the {_en} value, of all components or 'AVEC' / 'SANS' some; of several "
        "fields at nodes, value by value.",
        fr=f"D'un champ : la {_fr} valeur, de toutes les composantes ou 'AVEC' / 'SANS' certaines "
        "; de plusieurs champs par points, valeur par valeur.",
        examples=(
            f"OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; LIST ({_name} (COOR 1 L)) ;",
        ),
    )(lambda call, value, w=_largest: _of_node_fields(call, value, w))  # type: ignore[misc]
    _operator.on("MCHAML")(
        lambda call, value, w=_largest: _of_cell_fields(call, value, w)  # type: ignore[misc]
    )
