"""The part of bodies that yields, or may in a step, and what of a factor a solve for it reads.

Flow loads the unknowns of few cells, and asks for the motion of these alone. On the elimination
tree both stand on the way from the cells' supernodes to the root: forward and backward solves
need no others, and are exact there.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity.bulk import Answer, Bulk
from ssilang.kernel.plasticity.solving.blocks import ZonePass
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.multifrontal import Panels

NEAR = -0.12
"""Cells whose stresses are further inside their surfaces are left out (of the stresses at play)."""
MISSED = -0.04
"""A part is made anew when it lacks cells that are nearer than this,"""
LARGE = 2.0
"""or has this many times the cells that it needs."""


@dataclass(frozen=True, eq=False)
class Part:
    """Cells, and the unknowns that they have.

    Attributes
    ----------
    passes : tuple of ZonePass
        Over the cells of each zone; none for all cells.
    unknowns : array (a,)
    T : csr array (a, m)
        Their motions by scaled independent unknowns.
    places : array (m,)
        Where these stand in the order of elimination.
    runs : array (k, 2)
        Supernodes from their own to the root: first and behind the last of those in a row.
    """

    passes: tuple[ZonePass, ...]
    unknowns: IntArray
    T: sp.csr_array
    places: IntArray
    runs: IntArray


def whole_part(T: sp.csr_array, factor: DissectedFactor | None) -> Part:
    """All cells; T (n, r) has its columns in the order of elimination."""
    count = 0 if factor is None else len(factor.panels.first) - 1
    runs = np.array([[0, count]], dtype=np.int64)
    return Part((), np.arange(T.shape[0]), T, np.arange(T.shape[1]), runs)


def part_of(bulk: Bulk, cells: tuple[IntArray, ...], T: sp.csr_array, panels: Panels) -> Part:
    """The part that some cells of each zone make."""
    marked = np.zeros(bulk.size, bool)
    for of_zone, own in zip(bulk.places, cells, strict=True):
        marked[of_zone[own]] = True
    unknowns = np.flatnonzero(marked)
    rows = sp.csr_array(T[unknowns])
    used = np.zeros(T.shape[1], bool)
    used[rows.indices] = True
    places = np.flatnonzero(used)
    new = np.cumsum(used) - 1
    columns, shape = new[rows.indices].astype(np.int32), (len(unknowns), len(places))
    own_T = sp.csr_array((rows.data, columns, rows.indptr), shape=shape)
    nodes = np.zeros(len(panels.first) - 1, bool)
    nodes[np.searchsorted(panels.first, places, side="right") - 1] = True
    _up_to_the_root(panels.first, panels.ptr, panels.rows, nodes)
    ends = np.flatnonzero(np.diff(np.concatenate([[0], nodes.view(np.int8), [0]])))
    pairs = zip(bulk.passes, cells, strict=True)
    passes = tuple(whole.of(own) for whole, own in pairs if whole is not None)
    runs = ends.reshape(-1, 2).astype(np.int64)
    return Part(passes, unknowns, own_T, places, runs)


@compiled
def _up_to_the_root(first: IntArray, ptr: IntArray, rows: IntArray, marked: np.ndarray) -> None:
    """Mark the supernodes above those that are marked."""
    last = len(first) - 2
    for s in range(last):
        if marked[s] and ptr[s + 1] > ptr[s]:
            row, low, high = rows[ptr[s]], s, last
            while low < high:
                middle = (low + high + 1) // 2
                if first[middle] <= row:
                    low = middle
                else:
                    high = middle - 1
            marked[low] = True
    marked[last] = True


def cells_nearer(bulk: Bulk, beyond: tuple[FloatArray | None, ...], than: float) -> IntArray:
    """Cells, numbered through all zones, that are nearer to yielding than a limit."""
    found, begin = [np.zeros(0, np.int64)], 0
    for places, own in zip(bulk.places, beyond, strict=True):
        assert own is not None
        found.append(begin + np.flatnonzero(own > than))
        begin += len(places)
    return np.concatenate(found)


def by_zone(bulk: Bulk, cells: IntArray) -> tuple[IntArray, ...]:
    """Cells that are numbered through all zones, zone by zone."""
    ends = np.cumsum([0, *(len(p) for p in bulk.places)])
    at = np.searchsorted(cells, ends)
    return tuple(cells[a:b] - e for a, b, e in zip(at, at[1:], ends, strict=False))


def cells_for_the_next(bulk: Bulk, cells: IntArray, answer: Answer) -> IntArray:
    """The cells that the next step should have: the same unless they lack some, or are many."""
    near = cells_nearer(bulk, answer.beyond, NEAR)
    needed = cells_nearer(bulk, answer.beyond, MISSED)
    lacks = not np.isin(needed, cells, assume_unique=True).all()
    return near if lacks or len(cells) > LARGE * len(near) else cells
