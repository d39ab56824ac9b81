"""PASAPAS along a path: indirect control (PILOTAGE_INDIRECT) and automatic one (AUTOMATIQUE)."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import LoadPart
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import Numbering, field_to_vector
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel, Mot, Table
from ssilang.language.vocabulary.terms import ANY_NUMBER
from ssilang.operators.statics.path_controls import (
    AutomaticControl,
    indirect_control,
    strain_parameters,
    strain_points,
)
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.driven_load import Trace
    from ssilang.kernel.plasticity.following import Control, PathRun
    from ssilang.kernel.plasticity.run import BulkRun
    from ssilang.kernel.stepping.run import History

DRIVEN = ("DEPLACEMENTS_PILOTES", "FORCES_PILOTEES")


def control_asked(entries: Entries) -> str:
    """'PILOTAGE_INDIRECT', 'AUTOMATIQUE', or nothing."""
    asked = [w for w in ("PILOTAGE_INDIRECT", "AUTOMATIQUE") if entries.flag(w)]
    if len(asked) > 1:
        raise entries.error("operators.statics.two-controls")
    if asked and entries.flag("DYNAMIQUE"):
        raise entries.error("operators.statics.only-in-statics", asked=asked[0])
    return asked[0] if asked else ""


def driven_parts(entries: Entries) -> list[LoadPart]:
    """The loads of unknown size, behind all others."""
    if control_asked(entries) != "PILOTAGE_INDIRECT":
        return []
    found = [(w, entries.get(w)) for w in DRIVEN]
    parts = [
        LoadPart("DIMP" if word == DRIVEN[0] else "MECA", field)
        for word, field in found
        if field is not None
    ]
    if not parts:
        raise entries.error("operators.statics.which-load-is-controlled")
    return parts


def follow(entries: Entries, run: BulkRun) -> History:
    """Step along the path; fills COEFFICIENT_DE_PILOTAGE where the control is indirect."""
    from ssilang.kernel.plasticity.driven_load import history_of

    started = time.perf_counter()
    try:
        if control_asked(entries) == "AUTOMATIQUE":
            path, trace = _automatic(entries, run)
        else:
            path, trace = _indirect(entries, run)
            entries.table.set(Mot("COEFFICIENT_DE_PILOTAGE"), ListReel(np.array(trace.parameters)))
    finally:
        for observer in run.observers:
            observer.close()
    return history_of(path, trace, time.perf_counter() - started)


def _indirect(entries: Entries, run: BulkRun) -> tuple[PathRun, Trace]:
    from ssilang.kernel.plasticity.driven_load import follow_directions

    curve = entries.needed("PARAMETRE_DE_PILOTAGE")
    asked = np.diff([curve.at(float(t)) for t in run.problem.times])
    if not asked.all():
        k = int(np.flatnonzero(asked == 0.0)[0])
        raise entries.error("operators.statics.control-does-not-change", k=k + 1)
    control_of = indirect_control(entries, run.problem.numbering)
    return follow_directions(run, len(driven_parts(entries)), asked, control_of)


def _automatic(entries: Entries, run: BulkRun) -> tuple[PathRun, Trace]:
    from ssilang.kernel.plasticity.driven_load import follow_time

    asked = entries.get("AUTOCRIT")
    most = entries.get("AUTOPAS") or entries.default("AUTOPAS")
    every = entries.get("AUTORESU") or entries.default("AUTORESU")
    if asked <= 0.0 or most < 1 or every < 1:
        raise entries.error("operators.statics.control-not-positive")
    model = entries.needed("MODELE")
    material = entries.get("CARACTERISTIQUES") or CellField((), "CARACTERISTIQUES")

    def control_of(path: PathRun) -> Control:
        numbering = run.problem.numbering
        return AutomaticControl(entries, numbering, asked, path.elastic, model, material)

    path, trace = follow_time(run, control_of, most, every)
    if trace.unfinished:
        entries.warn("operators.statics.path-ends-early", most=most, times=trace.times[-1])
    return path, trace


@operator(
    "ZPIL",
    arg("table", "TABLE", en="table of PILOINDI"),
    arg("start", "CHPOINT", en="displacement", unit="m"),
    arg("du", "CHPOINT", en="step so far", unit="m"),
    arg("rest", "CHPOINT", en="step by the residual", unit="m"),
    arg("unit", "CHPOINT", en="step by the load", unit="m"),
    arg("asked", "FLOTTANT", en="strain asked for", range=ANY_NUMBER),
    family="statics",
    help=Help(
        en="Equation of strains behind PILOINDI, which is the procedure to call.",
        syntax="FLOT2 = ZPIL TAB1 CHPO1 CHPO2 CHPO3 CHPO4 FLOT1 ;",
    ),
)
def zpil(
    call: Call,
    table: Table,
    start: NodeField,
    du: NodeField,
    rest: NodeField,
    unit: NodeField,
    asked: float,
) -> float:
    """Of the parameters that fulfil the equation, the one nearest zero."""
    entries = Entries(call, table, "PILOINDI")
    numbering = _numbering_of((start, du, rest, unit))
    u0, u1, u2, u3 = (field_to_vector(f, numbering, dual=False) for f in (start, du, rest, unit))
    points = strain_points(entries, numbering)
    found = strain_parameters(points, u0, u1 + u2, u3, asked)
    if not found:
        raise entries.error("operators.statics.controlled-load-strains-nothing")
    return min(found, key=abs)


def _numbering_of(fields: Sequence[NodeField]) -> Numbering:
    """All unknowns of fields of displacement."""
    names = tuple(dict.fromkeys(n for f in fields for n in f.components))
    nodes, codes = [], []
    for code, name in enumerate(names):
        own = [f.components[name].nodes for f in fields if name in f.components]
        there = np.unique(np.concatenate(own))
        nodes.append(there)
        codes.append(np.full(len(there), code, dtype=np.int64))
    if not names:
        raise FieldError("operators.statics.empty-fields")
    table = fields[0].table
    numbers, places = np.concatenate(nodes), np.concatenate(codes)
    order = np.lexsort((places, numbers))
    return Numbering(table, names, names, numbers[order], places[order], table.version)
