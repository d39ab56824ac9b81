"""Sums, products and functions of fields at nodes. A field counts as zero where it is absent."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import Nature, NodeField, NodeValues
from ssilang.kernel.mesh.nodes import NodeTable

Function = Callable[[Any], Any]
SCALAR = "SCAL"


def rebuilt(
    field: NodeField, components: Mapping[str, NodeValues], nature: Nature | None = None
) -> NodeField:
    """A field like `field` with other components."""
    return NodeField(
        field.table, components, field.nature if nature is None else nature, field.title
    )


def applied(field: NodeField, function: Function) -> NodeField:
    """The field of the values of a function `array -> array` on each component."""
    made = {
        k: NodeValues(v.nodes, np.asarray(function(v.values), dtype=float))
        for k, v in field.components.items()
    }
    return rebuilt(field, made)


def common_nature(a: Nature, b: Nature) -> Nature:
    """Nature of a sum or product: DISCRET wins over DIFFUS, undetermined over both."""
    if a == b:
        return a
    return "DISCRET" if a and b else ""


def _joined(a: NodeValues, b: NodeValues, factor: float) -> NodeValues:
    if a.nodes is b.nodes or np.array_equal(a.nodes, b.nodes):
        return NodeValues(a.nodes, a.values + factor * b.values)
    nodes = np.union1d(a.nodes, b.nodes)
    return NodeValues(nodes, a.at(nodes) + factor * b.at(nodes))


def added(a: NodeField, b: NodeField, factor: float = 1.0) -> NodeField:
    """`a + factor * b`, over the union of their supports."""
    made = dict(a.components)
    for name, part in b.components.items():
        mine = made.get(name)
        if mine is None:
            made[name] = NodeValues(part.nodes, factor * part.values)
        else:
            made[name] = _joined(mine, part, factor)
    nature = common_nature(a.nature, b.nature)
    if not a.components or not b.components:
        nature = (a if a.components else b).nature
    return rebuilt(a, made, nature)


def united(a: NodeField, b: NodeField, check: bool = True) -> NodeField:
    """Union of two fields (ET): discrete values add up, diffuse ones must agree.

    Raises
    ------
    FieldError
        If two values differ at a node of two fields that are not DISCRET (with `check`).
    """
    if a.components and b.components and a.nature != b.nature:
        told = {"nature": a.nature or "INDETERMINE", "nature_2": b.nature or "INDETERMINE"}
        raise FieldError("kernel.fields.fields-natures-cannot-joined", **told)
    if a.nature == "DISCRET" or not a.components or not b.components:
        return added(a, b)
    made = dict(a.components)
    for name, part in b.components.items():
        mine = made.get(name)
        made[name] = part if mine is None else _merged(a.table, name, mine, part, check)
    return rebuilt(a, made)


def _merged(table: NodeTable, name: str, a: NodeValues, b: NodeValues, check: bool) -> NodeValues:
    both, ia, ib = np.intersect1d(a.nodes, b.nodes, return_indices=True)
    gap = np.abs(a.values[ia] - b.values[ib])
    scale = np.maximum(np.abs(a.values[ia]), np.abs(b.values[ib]))
    wrong = np.flatnonzero(gap > 1e-6 * scale)
    if check and len(wrong):
        k = wrong[0]
        told = {"name": name, "values": a.values[ia[k]], "values_2": b.values[ib[k]]}
        told |= {"both": table.told(both[k])}
        raise FieldError("kernel.fields.component-field-node", **told)
    new = np.isin(b.nodes, a.nodes, invert=True)
    return _joined(a, NodeValues(b.nodes[new], b.values[new]), 1.0)


def _combined(a: NodeValues, b: NodeValues, function: Callable[[Any, Any], Any]) -> NodeValues:
    if a.nodes is b.nodes or np.array_equal(a.nodes, b.nodes):
        return NodeValues(a.nodes, function(a.values, b.values))
    both, ia, ib = np.intersect1d(a.nodes, b.nodes, return_indices=True)
    return NodeValues(both, function(a.values[ia], b.values[ib]))


def multiplied(a: NodeField, b: NodeField, divide: bool = False) -> NodeField:
    """Product (or quotient) of two fields, one of which has the only component SCAL.

    Without SCAL the fields must have the same components, which are taken one by one.

    Raises
    ------
    FieldError
        If neither rule applies, or a divisor is zero.
    """
    if divide and any(np.any(v.values == 0) for v in b.components.values()):
        raise FieldError("kernel.fields.field-divide-zero")
    run = np.divide if divide else np.multiply
    nature = common_nature(a.nature, b.nature)
    if list(b.components) == [SCALAR]:
        factor = b.components[SCALAR]
        return rebuilt(a, {k: _combined(v, factor, run) for k, v in a.components.items()}, nature)
    if list(a.components) == [SCALAR] and not divide:
        factor = a.components[SCALAR]
        return rebuilt(b, {k: _combined(factor, v, run) for k, v in b.components.items()}, nature)
    if set(a.components) == set(b.components):
        made = {k: _combined(v, b.components[k], run) for k, v in a.components.items()}
        return rebuilt(a, made, nature)
    raise FieldError("kernel.fields.field-field-not-defined", a=a.components, b=b.components)


def multiplied_by_names(
    a: NodeField,
    b: NodeField,
    names: tuple[Iterable[str], Iterable[str], Iterable[str]],
    divide: bool = False,
) -> NodeField:
    """Components of `a` times components of `b` under new names, pair by pair.

    Where one of the two is absent the product is zero and is left out.
    """
    run = np.divide if divide else np.multiply
    made: dict[str, NodeValues] = {}
    for left, right, name in zip(*names, strict=True):
        x, y = a.components.get(left), b.components.get(right)
        if x is None or y is None:
            continue
        part = _combined(x, y, run)
        made[name] = part if name not in made else _joined(made[name], part, 1.0)
    return rebuilt(a, made, common_nature(a.nature, b.nature))


def component(field: NodeField, name: str) -> NodeValues:
    """A component of a field; an error if it has none of that name."""
    found = field.components.get(name)
    if found is None:
        known = field.components
        raise FieldError("kernel.fields.field-no-component", name=name, known=known)
    return found


def renamed(field: NodeField, old: Iterable[str], new: Iterable[str]) -> NodeField:
    """Components `old` under the names `new`; the others keep theirs."""
    names = dict(zip(old, new, strict=True))
    made: dict[str, NodeValues] = {}
    for name, part in field.components.items():
        target = names.get(name, name)
        made[target] = part if target not in made else _joined(made[target], part, 1.0)
    return rebuilt(field, made)


def restricted(field: NodeField, nodes: IntArray) -> NodeField:
    """The field at those of `nodes` where it is defined."""
    wanted = np.unique(nodes)
    made: dict[str, NodeValues] = {}
    for name, part in field.components.items():
        kept = np.isin(part.nodes, wanted)
        if np.any(kept):
            made[name] = NodeValues(part.nodes[kept], part.values[kept])
    return rebuilt(field, made)


def scalar_product(
    a: NodeField, b: NodeField, left: Iterable[str], right: Iterable[str]
) -> NodeValues:
    """Sum at each node of the products of paired components, on the union of their nodes."""
    total = NodeValues(np.empty(0, dtype=np.int64), np.empty(0))
    for x, y in zip(left, right, strict=True):
        if x in a.components and y in b.components:
            total = _joined(total, _combined(a.components[x], b.components[y], np.multiply), 1.0)
    return total


def values_in_order(field: NodeField, names: Iterable[str], nodes: IntArray | None) -> FloatArray:
    """Values of components one behind the other, at `nodes` in their order or where defined."""
    parts = []
    for name in names:
        part = field.components.get(name)
        if part is None:
            parts.append(np.zeros(0 if nodes is None else len(nodes)))
        else:
            parts.append(part.values if nodes is None else part.at(nodes))
    return np.concatenate(parts) if parts else np.empty(0)
