"""Fields given at nodes (CHPOINT): one sparse vector per component."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.mesh.nodes import NodeTable

Nature = Literal["", "DIFFUS", "DISCRET"]


@dataclass(frozen=True, slots=True, eq=False)
class NodeValues:
    """One component: increasing node numbers (n,) and their values (n,)."""

    nodes: IntArray
    values: FloatArray

    @classmethod
    def summed(cls, nodes: IntArray, values: FloatArray) -> "NodeValues":
        """Values of any shape at nodes that may repeat, added up at each node."""
        ids, place = np.unique(nodes, return_inverse=True)
        sums = np.bincount(place.ravel(), values.ravel(), len(ids))
        return cls(ids, sums.astype(np.float64))

    def at(self, nodes: IntArray, default: float = 0.0) -> FloatArray:
        """Values at `nodes`, in their shape, `default` where the component is not defined."""
        if len(self.nodes) == 0:
            return np.full(nodes.shape, default)
        place = np.minimum(np.searchsorted(self.nodes, nodes), len(self.nodes) - 1)
        return np.where(self.nodes[place] == nodes, self.values[place], default)


class _Current:
    """Components of a field, on the nodes that survive merges (ELIM) whenever they are read."""

    def __get__(self, field: "NodeField | None", owner: type) -> Mapping[str, NodeValues]:
        if field is None:
            raise AttributeError  # dataclasses read it as: there is no default
        held, version = field.__dict__, field.table.version
        found: Mapping[str, NodeValues] = held["components"]
        if held.get("merges", 0) != version:
            found = {name: field.surviving(name, part) for name, part in found.items()}
            held.update(components=found, merges=version)
        return found

    def __set__(self, field: "NodeField", components: Mapping[str, NodeValues]) -> None:
        field.__dict__.update(components=components, merges=0)


@dataclass(frozen=True, eq=False)
class NodeField:
    """A field at nodes.

    Components need not share their support: a node where a component is absent is not a zero.

    Parameters
    ----------
    components : mapping of str to NodeValues
        In order of first appearance; names have at most 8 characters (UX, UY, UZ, RX, RY, RZ,
        UR, FX, FY, LX, FLX, SCAL ...).
    nature : '', 'DIFFUS' or 'DISCRET'
        DIFFUS: samples of a continuous field (displacement); DISCRET: lumped quantities that add
        up (force). Decides what the union of two fields does where both are defined.
    title : str
        Free text (CHAN 'TITR').
    """

    table: NodeTable
    components: Mapping[str, NodeValues] = cast("Any", _Current())
    nature: Nature = ""
    title: str = ""

    @classmethod
    def of(
        cls,
        table: NodeTable,
        nodes: IntArray,
        values: Mapping[str, FloatArray],
        nature: Nature = "",
    ) -> "NodeField":
        """A field whose components all live on `nodes` (n,), unique, in any order."""
        order = np.argsort(nodes, kind="stable")
        ids = np.asarray(nodes, dtype=np.int64)[order]
        return cls(
            table,
            {k: NodeValues(ids, np.asarray(v, dtype=float)[order]) for k, v in values.items()},
            nature,
        )

    @property
    def node_ids(self) -> IntArray:
        """Nodes where at least one component is defined, increasing, shape (n,)."""
        parts = list({id(c.nodes): c.nodes for c in self.components.values()}.values())
        if len(parts) == 1:
            return parts[0]
        return np.unique(np.concatenate(parts)) if parts else np.empty(0, dtype=np.int64)

    def stands_on(self, node: int) -> bool:
        """Whether a component is defined at a node."""
        for part in self.components.values():
            place = np.searchsorted(part.nodes, node)
            if place < len(part.nodes) and part.nodes[place] == node:
                return True
        return False

    def values_at(self, name: str, nodes: IntArray, default: float = 0.0) -> FloatArray:
        """Values of component `name` at `nodes`, in their shape; `default` where absent."""
        part = self.components.get(name)
        return np.full(nodes.shape, default) if part is None else part.at(nodes, default)

    def surviving(self, name: str, part: NodeValues) -> NodeValues:
        """A component on the nodes that survive merges; discrete values of one node add up.

        Raises
        ------
        FieldError
            If two values of a field that is not DISCRET differ at a node.
        """
        now = self.table.resolve(part.nodes)
        if np.array_equal(now, part.nodes):
            return part
        order = np.lexsort((now != part.nodes, now))  # survivors first: their values are kept
        nodes, first, counts = np.unique(now[order], return_index=True, return_counts=True)
        given = part.values[order]
        if self.nature == "DISCRET":
            return NodeValues(nodes, np.add.reduceat(given, first))
        kept = np.repeat(given[first], counts)
        apart = np.abs(given - kept) > 1e-6 * np.maximum(abs(given), abs(kept))
        for k in np.flatnonzero(apart):
            told = {"name": name, "values": kept[k], "values_2": given[k]}
            told["both"] = self.table.told(now[order][k])
            raise FieldError("kernel.fields.merged-values-differ", **told)
        return NodeValues(nodes, given[first])
