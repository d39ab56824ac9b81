"""Fields given at nodes (CHPOINT): one sparse vector per component."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.mesh.nodes import NodeTable

Nature = Literal["", "DIFFUS", "DISCRET"]


@dataclass(frozen=True, slots=True, eq=False)
class NodeValues:
    """One component: increasing node numbers (n,) and their values (n,)."""

    nodes: IntArray
    values: FloatArray

    def at(self, nodes: IntArray, default: float = 0.0) -> FloatArray:
        """Values at `nodes`, in their shape, `default` where the component is not defined."""
        if len(self.nodes) == 0:
            return np.full(nodes.shape, default)
        place = np.minimum(np.searchsorted(self.nodes, nodes), len(self.nodes) - 1)
        return np.where(self.nodes[place] == nodes, self.values[place], default)


@dataclass(frozen=True, eq=False)
class NodeField:
    """A field at nodes.

    Components need not share their support: a node where a component is absent is not a zero.

    Parameters
    ----------
    table : NodeTable
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
    components: Mapping[str, NodeValues]
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
        parts = [c.nodes for c in self.components.values()]
        return np.unique(np.concatenate(parts)) if parts else np.empty(0, dtype=np.int64)

    def values_at(self, name: str, nodes: IntArray, default: float = 0.0) -> FloatArray:
        """Values of component `name` at `nodes`, in their shape; `default` where absent."""
        part = self.components.get(name)
        return np.full(nodes.shape, default) if part is None else part.at(nodes, default)

    def after_merges(self) -> "NodeField":
        """The field on the nodes that survive merges (ELIM); itself if none of its nodes is gone.

        Of two values on nodes that became one, discrete ones add up; of others the one of the
        surviving node is kept.
        """
        if self.table.version == 0:
            return self
        made = {name: self._surviving(part) for name, part in self.components.items()}
        if all(made[name] is part for name, part in self.components.items()):
            return self
        return replace(self, components=made)

    def _surviving(self, part: NodeValues) -> NodeValues:
        now = self.table.resolve(part.nodes)
        if np.array_equal(now, part.nodes):
            return part
        # survivors first, so that their values are those kept
        order = np.argsort(now != part.nodes, kind="stable")
        nodes, first, place = np.unique(now[order], return_index=True, return_inverse=True)
        values = part.values[order][first]
        if self.nature == "DISCRET":
            weights = part.values[order]
            values = np.asarray(np.bincount(place.ravel(), weights, len(nodes)), dtype=float)
        return NodeValues(nodes, values)
