"""EVOL 'RECO' and 'PJBA': curves in time of modal contributions, and of what they recombine to."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.curve import Curve, CurvePart
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.modal.basis import work
from ssilang.kernel.statics.linear import product
from ssilang.language.call import Call
from ssilang.language.values import ListEnti, Table
from ssilang.operators.curves.making import KINDS, history, names_in_time, nodes_named
from ssilang.operators.dispatch import extend_help
from ssilang.operators.modal.basis import Shape, shapes_of
from ssilang.operators.workspace import workspace

_MODE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ; "
    "T1 = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 4. P1) ; "
    "Q1 = MANU 'CHPO' (T1 . 'MODES' . 1 . 'POINT_REPERE') 1 'ALFA' 3. ; "
)


def _basis(call: Call, shapes_wanted: int | None = None) -> list[Shape]:
    operand = next((o for o in call.operands if isinstance(o.value, Table)), None)
    if operand is None:
        raise call.missing(("TABLE",))
    call.operands.remove(operand)
    return shapes_of(call, operand.value)[:shapes_wanted]


def contributions(fields: list[Any], shapes: list[Shape]) -> FloatArray:
    """Values ALFA or BETA at the marks of the shapes, shape (n_fields, n_shapes)."""
    return np.asarray(
        [
            [float(f.values_at(s.unknown, np.array([s.mark.node]))[0]) for s in shapes]
            for f in fields
        ]
    )


def _recombined(call: Call, colours: list[int]) -> Curve:
    fields, times, _ = history(call)
    steps = call.read("LISTENTI")
    shapes = _basis(call)
    count = call.optional("ENTIER")
    shapes = shapes[:count]
    if steps is not None:
        places = _places(call, steps.value, len(fields))
        fields, times = [fields[i] for i in places], times[places]
    known = [s.field for s in shapes]
    names = names_in_time(call, known)
    support = call.read("POINT", "MAILLAGE")
    if support is None:
        raise call.missing(("POINT", "MAILLAGE"))
    names = names or names_in_time(call, known)
    if not names:
        raise call.missing(("MOT",))
    weights = contributions(fields, shapes)
    parts: list[CurvePart] = []
    for name in names:
        for node in nodes_named(support.value):
            shape = np.asarray([float(f.values_at(name, np.array([node]))[0]) for f in known])
            colour = colours[len(parts) % len(colours)]
            parts.append(CurvePart(times, weights @ shape, "TEMP", name, name, colour))
    return Curve(tuple(parts), workspace(call.session).title)


def _places(call: Call, steps: ListEnti, count: int) -> list[int]:
    places = [int(i) - 1 for i in steps.values]
    if any(not 0 <= i < count for i in places):
        raise call.bad(f"there are {count} steps", steps)
    return places


def _projected(call: Call, colours: list[int]) -> Curve:
    fields, times, _ = history(call)
    steps = call.read("LISTENTI") if _lists_before_table(call) else None
    shapes = _basis(call)
    chosen = call.read("ENTIER", "LISTENTI")
    matrix = call.optional("RIGIDITE")
    if steps is not None:
        places = _places(call, steps.value, len(fields))
        fields, times = [fields[i] for i in places], times[places]
    numbers = list(range(1, len(shapes) + 1))
    if chosen is not None:
        value = chosen.value
        numbers = [int(i) for i in value.values] if isinstance(value, ListEnti) else [value]
        if any(not 1 <= i <= len(shapes) for i in numbers):
            raise call.bad(f"the basis has {len(shapes)} shapes", value)
    parts = []
    for k, number in enumerate(numbers):
        shape = shapes[number - 1].field
        dual = shape if matrix is None else product(matrix, shape)
        values = np.asarray([_work(dual, f, matrix is None) for f in fields])
        legend = f"{shapes[number - 1].unknown} {number}"
        colour = colours[k % len(colours)]
        parts.append(CurvePart(times, values, "TEMP", shapes[number - 1].unknown, legend, colour))
    return Curve(tuple(parts), workspace(call.session).title)


def _work(dual: NodeField, field: NodeField, same_names: bool) -> float:
    return float(work(dual, field, same_names=same_names))


def _lists_before_table(call: Call) -> bool:
    """Whether a list of integers stands before the table of the basis."""
    for operand in call.operands:
        if isinstance(operand.value, Table):
            return False
        if isinstance(operand.value, ListEnti):
            return True
    return False


KINDS["RECO"] = _recombined
KINDS["PJBA"] = _projected
extend_help(
    "EVOL",
    "EVOL1 = EVOL (COUL) 'RECO' LCHP1 LREE1 TBAS1 (N1) COMP | LCOMP GEO1 ;\n"
    "EVOL1 = EVOL (COUL) 'PJBA' LCHP1 LREE1 | TAB1 (MOT1) (LENT1) TBAS1 (N1 | LENT2) (RIG1) ;",
    "RECO gives components at points from modal contributions in time; PJBA the projections of "
    "fields in time on the shapes of a basis.",
    "RECO donne des composantes en des points à partir de contributions modales en temps ; PJBA "
    "les projections de champs en temps sur les déformées d'une base.",
    (
        _MODE + "LIST (EVOL 'RECO' (SUIT Q1 (Q1 * 2.)) (PROG 0. 1.) T1 'UX' P1) ;",
        _MODE + "U = RECO Q1 T1 ; LIST (EVOL 'PJBA' (SUIT U (U * 2.)) (PROG 0. 1.) T1) ;",
    ),
)
