"""Values that no calculation can use: numbers that are not finite, curves without content, fields
that lie elsewhere than the model they are given with, stresses with those of a temperature."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ssilang.kernel.curves.curve import Curve, Load
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel

Field = NodeField | CellField
_HANDED = {
    "BSIG": {"stress": "force"}, "RESO": {"force": "motion"}, "SIGM": {"motion": "whole"},
    "EXCO": {"whole": "whole"}, "ET": {"force": "force", "motion": "motion", "whole": "whole"},
    "+": {"force": "force", "motion": "motion"}, "*": {"force": "force", "motion": "motion"},
}  # fmt: skip
"""What operators make of what a temperature left: forces, displacements, stresses of the whole
strain. Whatever else is done with these, such as taking the stress of THET from them, clears it."""
_HOLD: tuple[tuple[type, str], ...] = ((Curve, "parts"), (Model, "zones"), (Mesh, "blocks"))
"""What objects are empty without."""
_READ = frozenset(("MAXI", "MINI", "PRIN", "VMIS", "TRAC", "EXTR", "EVOL", "LIST", "INVA"))


def flaw_of(value: object) -> str:
    """Code of the refusal of a value, '' if it is sound."""
    if any(isinstance(value, kind) and not getattr(value, held) for kind, held in _HOLD):
        return "entry-empty"
    if not all(np.isfinite(v).all() for v in _numbers_in(value)):
        return "entry-not-finite"
    return ""


def apart(values: Sequence[object]) -> list[Any]:
    """The fields that have no node of the model beside them."""
    model = next((v for v in values if isinstance(v, Model) and v.zones), None)
    if model is None:
        return []
    own = {id(z.cells) for z in model.zones}
    lying = [(f, n) for f in values if isinstance(f, Field) and (n := _nodes_of(f, own))]
    reached = np.zeros(len(model.mesh.nodes), bool)
    for block in model.mesh.blocks if lying else ():
        reached[block.connectivity] = True
    return [f for f, nodes in lying if not any(reached[n].any() for n in nodes)]


def follow(call: Call, name: str, results: object) -> None:
    """Warn where stresses of the whole strain are read from which no temperature was taken."""
    heated = call.session.workspace.heated
    if name != "THET" and not heated:
        return
    made: list[Any] = [
        f for f in (results if isinstance(results, tuple) else (results,)) if f is not None
    ]
    if name == "THET":
        heated.update(
            dict.fromkeys(made, "stress") | {b.cells: "cells" for f in made for b in f.blocks}
        )
    kinds = {heated.get(o.value, "") for o in call.used if isinstance(o.value, Field)}
    if "whole" in kinds and name in _READ:
        call.warn("operators.statics.heat-in-stress")
        heated.clear()
    for kind in kinds & _HANDED.get(name, {}).keys():
        for field in (f for f in made if isinstance(f, Field)):
            if isinstance(field, NodeField) or any(b.cells in heated for b in field.blocks):
                heated[field] = _HANDED[name][kind]


def other_values(first: CellField, second: CellField) -> list[str]:
    """Components of which two fields have other values in the same cells."""
    pairs = ((a, b) for a in first.blocks for b in second.blocks if a.cells is b.cells)
    return [
        name
        for a, b in pairs
        for name in a.components.keys() & b.components.keys()
        if (a.element, a.constituent) == (b.element, b.constituent)
        and not np.array_equal(a.components[name], b.components[name])
    ]


def _nodes_of(field: Field, own: set[int]) -> list[Any]:
    """Nodes of a field; none are looked for where it plainly stands in some cells of its model."""
    if isinstance(field, CellField):
        inside = any(id(b.cells) in own for b in field.blocks)
        return [] if inside else [b.cells.connectivity for b in field.blocks]
    return [part.nodes for part in field.components.values()]


def _numbers_in(value: object) -> list[Any]:
    """The numbers that an object holds, as arrays."""
    if isinstance(value, float):
        return [value]
    if isinstance(value, ListReel):
        return [np.asarray(value.values, dtype=float)]
    if isinstance(value, NodeField):
        return [p.values for p in value.components.values()]
    if isinstance(value, CellField):
        parts = (v for b in value.blocks for v in b.components.values())
        return [v for v in parts if v.dtype.kind == "f"]
    if isinstance(value, Matrix):
        return [b.values for b in value.blocks] + [r.coefficients for r in value.relations]
    if isinstance(value, Curve):
        return [a for p in value.parts for a in (p.abscissas, p.ordinates)]
    if isinstance(value, Load):
        held = [h for p in value.parts for h in (p.space, p.time, *(f for _, f in p.steps))]
        return [n for h in held for n in _numbers_in(h)]
    return []
