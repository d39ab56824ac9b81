"""VARI: fields that follow a law of variation, parameters that depend on a field."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.curves.algebra import interpolated
from ssilang.kernel.elements.results.supports import cells_of_nodal, moved
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_field import Support
from ssilang.operators.curves.words import one_part
from ssilang.operators.prelude import *

_SUPPORTS = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")


def argument_name(names: list[str], part: CurvePart) -> str:
    """The component that a law is a function of: its abscissa's name, or the only one.

    Raises
    ------
    FieldError
        If the field has several components and none bears the name.
    """
    wanted = part.abscissa_name.strip()
    if wanted in names:
        return wanted
    if len(names) == 1:
        return names[0]
    raise FieldError("operators.fields.no-component-is-abscissa", names=names, wanted=wanted)


_SUPPORT = choice("support", _SUPPORTS, default="RIGIDITE", en="points of the result")
_LAW = arg("curve", "EVOLUTIO", en="law of variation")


@operator("VARI", family="fields", full_name="VARIATION")
def vari(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    field: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="what the law depends on"),
    curve: Curve = _LAW,
    support: str = _SUPPORT,
) -> CellField:
    """Evaluate a law in cells."""
    part = one_part(call, curve)
    placed = _placed(model, field, cast(Support, support))
    name = argument_name(cell_algebra.component_names(placed), part)
    one = cell_algebra.extracted(placed, [name], ["SCAL"])
    made = cell_algebra.applied(one, lambda v: interpolated(part.abscissas, part.ordinates, v))
    return CellField(made.blocks, "SCALAIRE")


@vari.form()
def vari_at_nodes(
    call: Call,
    field: NodeField = Arg("CHPOINT", en="what the law depends on"),
    curve: Curve = _LAW,
    target: str | None = Opt("MOT", en="component of the result, else the name of the ordinate"),
) -> NodeField:
    """Evaluate a law at nodes."""
    part = one_part(call, curve)
    name = part.ordinate_name.strip() if target is None else target.rstrip()
    given = field.components[argument_name(list(field.components), part)]
    values = interpolated(part.abscissas, part.ordinates, given.values)
    return node_algebra.rebuilt(field, {name or "SCAL": NodeValues(given.nodes, values)})


def _placed(model: Model, field: NodeField | CellField, support: Support) -> CellField:
    if isinstance(field, NodeField):
        return cells_of_nodal(model, field, support)
    return moved(model, field, support, None)


@vari.form(said("NUAG"))
def vari_of_parameters(
    model: Model = Arg("MMODEL", en="model"),
    laws: CellField = Arg("MCHAML", en="parameters, curves among them"),
    given: CellField | NodeField = Arg("MCHAML", "CHPOINT", en="fields that the curves depend on"),
    support: str = _SUPPORT,
    title: str | None = Opt("MOT", en="sub-type of the result"),
) -> CellField:
    """Parameters given by curves as numbers."""
    at = cast(Support, support)
    fields = _placed(model, given, at)
    blocks = [_evaluated(block, fields, at) for block in laws.blocks]
    return CellField(tuple(blocks), laws.title if title is None else title.rstrip())


def _evaluated(block: CellFieldBlock, fields: CellField, support: Support) -> CellFieldBlock:
    if not any(v.dtype == object for v in block.components.values()):
        return block
    given = next((b for b in fields.blocks if cell_algebra.same_cells(b.cells, block.cells)), None)
    if given is None:
        raise FieldError("operators.fields.parameters-and-fields-apart")
    made: dict[str, NDArray[Any]] = {}
    for name, values in block.components.items():
        made[name] = _numbers(name, values, given) if values.dtype == object else values
    return CellFieldBlock(block.cells, made, support, given.element, block.constituent)


def _numbers(name: str, laws: NDArray[Any], given: CellFieldBlock) -> NDArray[Any]:
    """Values (n_cells, n_points) of laws (n_cells, 1) at those of the fields."""
    n_cells, n_points = len(given.cells), max(v.shape[1] for v in given.components.values())
    column = np.broadcast_to(laws[:, :1], (n_cells, 1))[:, 0]
    found = np.empty((n_cells, n_points))
    for law in {id(v): v for v in column}.values():
        if not isinstance(law, Curve):
            return laws
        part = law.parts[0]
        x = given.components[argument_name(list(given.components), part)]
        rows = np.array([v is law for v in column])
        values = interpolated(part.abscissas, part.ordinates, np.asarray(x, dtype=float))
        found[rows] = np.broadcast_to(values, (n_cells, n_points))[rows]
    return found
