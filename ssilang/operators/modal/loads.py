"""SEIS SIGS: seismic loads on modal bases, stresses of modes."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.curves.curve import Curve, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Model
from ssilang.language.registry import arg, choice, many, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Mot, Table
from ssilang.language.vocabulary.terms import ANY_NUMBER
from ssilang.operators.matrices.element import joined, present
from ssilang.operators.modal.basis import shapes_in
from ssilang.operators.tables.indices import copied

_AXES = ("UX", "UY", "UZ")


@operator(
    "SEIS",
    arg("curve", "EVOLUTIO", en="acceleration of the ground"),
    arg("table", "TABLE", en="basis"),
    arg("factor", "FLOTTANT", en="factor", range=ANY_NUMBER),
    choice("direction", _AXES, optional=False, en="direction of the ground"),
    family="modal",
    full_name="SEISME",
)
def seis(call: Call, curve: Curve, table: Table, factor: float, direction: str) -> Load:
    """Seismic load."""
    shapes = [s for s in shapes_in(table) if s.unknown == "ALFA"]
    if not shapes:
        raise call.error("operators.modal.table-without-modes", table)
    values = {}
    for shape in shapes:
        along = shape.entry.get(Mot("DEPLACEMENTS_GENERALISES"))
        number = along.get(_AXES.index(direction) + 1) if isinstance(along, Table) else None
        if not isinstance(number, int | float):
            raise call.error("operators.modal.mode-no-generalised-displacements", table)
        values[shape.mark.node] = -factor * float(number)
    nodes = np.array(sorted(values))
    part = NodeValues(nodes, np.array([values[int(n)] for n in nodes]))
    field = NodeField(shapes[0].mark.nodes, {"FALF": part}, "DISCRET")
    return Load((LoadPart("MECA", field, curve),))


@operator(
    "SIGS",
    arg("model", "MMODEL", en="model"),
    many("material", "MCHAML", at_least=1, en="parameters"),
    arg("table", "TABLE", en="shapes"),
    family="modal",
    full_name="SIGSOL",
)
def sigs(call: Call, model: Model, material: tuple[CellField, ...], table: Table) -> Table:
    """Stresses of modes."""
    made, found = with_stresses(present(call, model), joined(material), table)
    if not found:
        raise call.error("operators.modal.no-mode-no-shape", table)
    return made


def with_stresses(model: Model, material: CellField, table: Table) -> tuple[Table, int]:
    """The table, and those in it, copied with the stresses; and how many were computed."""
    made, found = copied(table), 0
    for shape, entry in (("DEFORMEE_MODALE", "CONTRAINTE_MODALE"), ("DEFORMEE", "CONTRAINTE")):
        field = table.get(Mot(shape))
        if isinstance(field, NodeField):
            blocks = tuple(families.stress(z, material, field) for z in model.zones)
            made.set(Mot(entry), CellField(blocks, "CONTRAINTES"))
            return made, 1
    for index, value in table.items():
        if isinstance(value, Table):
            inner, count = with_stresses(model, material, value)
            found += count
            if count:
                made.set(index, inner)
    return made, found
