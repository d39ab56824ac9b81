"""Cables that slide in a body with friction (FROCABLE, the law of BPEL 99).

Along a cable of tension T the friction is `dT = T (f d alpha + phi d s)`, alpha its angle. At a
node between two straight bars it is taken of their mean tension, with the angle between them and
half of their lengths; across the cable the nodes follow the body.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.contact.rows import Friction
from ssilang.kernel.matrices.matrix import Relations
from ssilang.kernel.matrices.relations import joined, rows_from_table
from ssilang.kernel.matrices.tied_relations import held, sliding
from ssilang.kernel.mesh.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Bars:
    """Bars of a cable."""

    cells: IntArray  # (n, 2)
    stiffness: FloatArray  # (n,) E S / L
    tension: FloatArray  # (n,) at zero displacement
    angular: FloatArray  # (n,) f (1/rad)
    linear: FloatArray  # (n,) phi (1/m)


@dataclass(frozen=True, eq=False)
class CableRelations:
    """Relations that keep a cable in its sheath, and its friction."""

    ties: Relations
    friction: Friction


@dataclass(frozen=True, eq=False)
class _Ends:
    """Both ends of each bar: its node and the other one (2 n,), bar, direction along the cable."""

    node: IntArray
    other: IntArray
    bar: IntArray
    tangent: FloatArray
    length: FloatArray


def cable_relations(
    line: Mesh, bars: Bars, body: Mesh, unknowns: tuple[str, ...]
) -> CableRelations:
    """Ties and friction of a cable in a body.

    Raises
    ------
    MeshError
        If the cable branches, or no node of it lies in the body.
    """
    x = line.nodes.coordinates[:, : len(unknowns)]
    ends = _ends(line, x, bars.cells)
    slips, nodes = _slips(line, body, unknowns, ends)
    limits, offset = _limits(line, bars, ends, nodes, unknowns)
    none = np.zeros(len(nodes))
    rubbing = Friction(slips, 1, none, none, np.zeros(0, np.int64), limits, offset)
    return CableRelations(sliding(line, body, unknowns), rubbing)


def _ends(line: Mesh, x: FloatArray, cells: IntArray) -> _Ends:
    node, other = cells.T.ravel(), cells[:, ::-1].T.ravel()
    counts = np.bincount(node)
    if (counts > 2).any():
        at = line.nodes.told(int(np.argmax(counts)))
        raise MeshError("kernel.contact.cable-branches-node", at=at)
    along = x[cells[:, 1]] - x[cells[:, 0]]
    length = np.linalg.norm(along, axis=1)
    tangent = np.tile(along / length[:, None], (2, 1))
    bar = np.tile(np.arange(len(cells)), 2)
    return _Ends(node, other, bar, tangent, length[bar])


def _slips(
    line: Mesh, body: Mesh, unknowns: tuple[str, ...], ends: _Ends
) -> tuple[Relations, IntArray]:
    """Rows of the slips along the mean direction at each node in the body, and these nodes."""
    tangents = np.zeros((int(ends.node.max()) + 1, len(unknowns)))
    # bars that run against each other at a node: the second is turned round
    first = np.full(len(tangents), -1)
    first[ends.node[::-1]] = np.arange(len(ends.node))[::-1]
    turn = np.where(np.einsum("nd,nd->n", ends.tangent, ends.tangent[first[ends.node]]) < 0, -1, 1)
    np.add.at(tangents, ends.node, turn[:, None] * ends.tangent)
    own = np.setdiff1d(np.unique(ends.node), body.sorted_node_ids)
    rows, nodes = [], []
    for inside, table, weights in held(own, body, 1e-5):
        way = tangents[own[inside]]
        way = way / np.linalg.norm(way, axis=1, keepdims=True)
        values = (way[:, :, None] * weights[:, None, :]).reshape(len(table), -1)
        names = tuple(u for u in unknowns for _ in range(table.shape[1]))
        rows.append(rows_from_table(line.nodes, np.tile(table, (1, len(unknowns))), names, values))
        nodes.append(own[inside])
    if not rows:
        raise MeshError("kernel.contact.no-node-cable-lies")
    return joined(rows), np.concatenate(nodes)


def _limits(
    line: Mesh, bars: Bars, ends: _Ends, nodes: IntArray, unknowns: tuple[str, ...]
) -> tuple[Relations, FloatArray]:
    """Rows of `sum over the bars of a node of c T`, T their tensions, and values at rest."""
    at = np.full(int(ends.node.max()) + 1, -1)
    at[nodes] = np.arange(len(nodes))
    place, d = at[ends.node], len(unknowns)
    share = bars.linear[ends.bar] * 0.5 * ends.length + 0.5 * _angles(ends, bars)
    count = np.bincount(ends.node)[ends.node]
    # mean tension times the whole of the node: half of it from each bar, all of it at an end
    whole = np.bincount(ends.node, share)[ends.node] / count
    stiff = whole * bars.stiffness[ends.bar]
    inside = place >= 0
    pulled = (whole * bars.tension[ends.bar])[inside]
    offset = np.bincount(place[inside], pulled, len(nodes)).astype(np.float64)
    rows = _stretches(ends, nodes, place, stiff, d)
    names = tuple(u for u in unknowns for _ in range(4))
    table = np.tile(rows[0], (1, d))
    return rows_from_table(line.nodes, table, names, rows[1].reshape(len(nodes), -1)), offset


def _angles(ends: _Ends, bars: Bars) -> FloatArray:
    """f times the angle between the bars at the node of each end (2 n,); zero at a cable's end."""
    order = np.argsort(ends.node, kind="stable")
    same = np.flatnonzero(ends.node[order][1:] == ends.node[order][:-1])
    one, two = order[same], order[same + 1]
    away = np.where(np.arange(len(ends.node)) < len(ends.node) // 2, 1.0, -1.0)
    out = away[:, None] * ends.tangent
    # outward directions of a straight cable are opposite
    cosine = np.clip(-np.einsum("nd,nd->n", out[one], out[two]), -1.0, 1.0)
    angle = np.zeros(len(ends.node))
    angle[one] = angle[two] = np.arccos(cosine)
    angle[angle < 1e-7] = 0.0  # rounding of the cosine
    return angle * bars.angular[ends.bar]


def _stretches(
    ends: _Ends, nodes: IntArray, place: IntArray, stiff: FloatArray, d: int
) -> tuple[IntArray, FloatArray]:
    """Nodes (k, 4) and coefficients (k, d, 4): up to two bars at each of the nodes."""
    table = np.repeat(nodes[:, None], 4, axis=1)
    values = np.zeros((len(nodes), d, 4))
    away = np.where(np.arange(len(ends.node)) < len(ends.node) // 2, 1.0, -1.0)
    for half in range(2):  # the first, then the second bar of each node
        on = np.flatnonzero((place >= 0) & _nth(ends.node, half))
        k = place[on]
        table[k, 2 * half], table[k, 2 * half + 1] = ends.other[on], ends.node[on]
        pull = (stiff[on] * away[on])[:, None] * ends.tangent[on]
        values[k, :, 2 * half] += pull
        values[k, :, 2 * half + 1] -= pull
    return table, values


def _nth(node: IntArray, n: int) -> NDArray[np.bool_]:
    """Which entries are the n-th of their value, 0 or 1."""
    order = np.argsort(node, kind="stable")
    again = np.concatenate([[False], node[order][1:] == node[order][:-1]])
    found = np.zeros(len(node), bool)
    found[order] = again if n else ~again
    return found
