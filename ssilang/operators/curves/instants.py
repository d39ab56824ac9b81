"""A nodal field of an instant of which only single values are asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import Numbering


@dataclass(frozen=True, slots=True, eq=False)
class InstantField:
    """Stands for a nodal field that no one has made yet.

    Attributes
    ----------
    numbering : Numbering
    vector : array (n,)
        Values of the unknowns.
    make : callable
        Makes the field, with what `vector` does not hold (multipliers).
    """

    numbering: Numbering
    vector: FloatArray
    make: Callable[[], NodeField]


def value_in_time(fields: list[NodeField | InstantField], name: str, node: int) -> FloatArray:
    """Values (n_fields,) of a component at a node; zero where it is not defined.

    Fields that are not made yet stay so if an unknown of theirs is asked for.
    """
    places: dict[int, int] = {}
    found = np.zeros(len(fields))
    at = np.asarray([node])
    for i, field in enumerate(fields):
        if isinstance(field, InstantField):
            key = id(field.numbering)
            if key not in places:
                places[key] = _place(field.numbering, name, node)
            if places[key] >= 0:
                found[i] = field.vector[places[key]]
                continue
            field = field.make()
        found[i] = field.values_at(name, at)[0]
    return found


def _place(numbering: Numbering, name: str, node: int) -> int:
    return numbering.index_of(node, name) if name in numbering.unknowns else -1


def components_in_time(fields: list[NodeField | InstantField]) -> set[str]:
    """Names of the components of all fields; those of one numbering have the same."""
    found: set[str] = set()
    seen: set[int] = set()
    for field in fields:
        if isinstance(field, InstantField):
            if id(field.numbering) in seen:
                continue
            seen.add(id(field.numbering))
            field = field.make()
        found.update(getattr(field, "components", ()))
    return found
