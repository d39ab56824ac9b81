"""Elimination of conditions `C u = d`, and of small negative groups before a Cholesky factor.

A condition gives one of its unknowns (the slave) by the others: `u = T q + P d`, where q are the
unknowns that stay. `T^T K T` is then as symmetric and positive as K on the admissible motions.

Rows fall into stages, so that slaves are found by back-substitution from the last stage to the
first; the transposed walk, from the first to the last, gives the multipliers:

1. rows that own an unknown no other row has ("peeled"): divide by its coefficient;
2. what is left, by connected groups of rows: QR with column pivoting chooses slaves, finds
   redundant rows and shares the multipliers among them (least norm);
3. rows of one unknown (supports), last because their unknowns are known outright.
"""

from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.graph import chains, parts_of
from ssilang.kernel.base.scientific import csgraph, la, sp
from ssilang.kernel.solvers.backends import factorise
from ssilang.kernel.solvers.factor import Factor, Ordering, Solver

LARGEST_GROUP = 1200  # rows; a dense QR of that size takes about a second
LARGEST_FILL = 40_000  # products of the terms that one row spreads through T^T K T
SMALL = 1e-12  # relative to the largest term of the row (rows are scaled to 1)


@dataclass(frozen=True, eq=False)
class _Stage:
    """Rows, their slaves, and `inverse` (n_slaves, n_rows) with u_S = inverse (d - ...)."""

    rows: IntArray
    slaves: IntArray
    inverse: sp.csr_array


@dataclass(eq=False)
class Elimination:
    """Outcome of `eliminate`."""

    C: sp.csr_array  # (n_rows, n) the rows as given, scaled to a largest term of one
    scale: FloatArray  # (n_rows,) `C = rows / scale`
    # (n_rows,) rows that are dealt with; the others (too full, or in too large a group) are left to
    # the caller
    eliminated: BoolArray
    masters: IntArray  # (r,) unknowns that stay
    T: sp.csr_array  # (n, r)
    stages: list[_Stage] = field(default_factory=list)

    def particular(self, d: FloatArray) -> FloatArray:
        """A displacement (n,) with zero masters that meets the eliminated rows for values d."""
        u = np.zeros(self.C.shape[1])
        scaled = d / self.scale
        for stage in reversed(self.stages):
            u[stage.slaves] = stage.inverse @ (scaled[stage.rows] - self.C[stage.rows] @ u)
        return u

    def multipliers(self, residual: FloatArray) -> FloatArray:
        """Multipliers (n_rows,) with `rows^T lambda = residual` (n,) at the slaves.

        Zero for the rows left to the caller, whose part must be taken off the residual before.
        """
        found = np.zeros(self.C.shape[0])
        rest = residual.astype(float, copy=True)
        for stage in self.stages:
            found[stage.rows] = stage.inverse.T @ rest[stage.slaves]
            rest -= self.C[stage.rows].T @ found[stage.rows]
        return found / self.scale

    def mismatch(self, u: FloatArray, d: FloatArray) -> FloatArray:
        """How far each eliminated row is from being met, shape (n_rows,), in scaled units."""
        gap = np.abs(self.C @ u - d / self.scale)
        return np.where(self.eliminated, gap, 0.0)


def eliminate(rows: sp.csr_array, wanted: BoolArray | None = None) -> Elimination:
    """Choose slaves for the rows (m, n) and express them by the unknowns that stay.

    Parameters
    ----------
    wanted : array (m,) of bool, optional
        Rows to eliminate (default all).
    """
    scale = _largest(rows)
    scale[scale == 0.0] = 1.0
    C = sp.csr_array(sp.diags_array(1.0 / scale) @ rows)
    C.data[np.abs(C.data) < SMALL] = 0.0
    C.eliminate_zeros()
    todo = np.ones(C.shape[0], bool) if wanted is None else wanted.copy()
    fixed = _support_stages(C, todo)
    peeled = _peeled_stages(C, todo, fixed)
    group = _group_stage(C, todo, fixed, peeled)
    stages = [*peeled, *group, *reversed(fixed)]
    eliminated = np.zeros(C.shape[0], bool)
    for stage in stages:
        eliminated[stage.rows] = True
    empty = _open_terms(C, _taken(C, fixed)) == 0
    eliminated |= empty & (np.ones_like(empty) if wanted is None else wanted)
    masters, T = _transformation(C, stages)
    return Elimination(C, scale, eliminated, masters, T, stages)


def _largest(rows: sp.csr_array) -> FloatArray:
    if 0 in rows.shape:
        return np.zeros(rows.shape[0])
    top = abs(rows).max(axis=1)
    return np.asarray(top.toarray(), dtype=float).ravel()


def _taken(C: sp.csr_array, stages: list[_Stage]) -> BoolArray:
    taken = np.zeros(C.shape[1], bool)
    for stage in stages:
        taken[stage.slaves] = True
    return taken


def _open_terms(C: sp.csr_array, taken: BoolArray) -> IntArray:
    """Number of terms of each row whose unknowns are not taken."""
    return (abs(C) > 0).astype(np.int64) @ (~taken).astype(np.int64)


def _diagonal(values: FloatArray) -> sp.csr_array:
    return sp.csr_array(sp.diags_array(1.0 / values))


def _support_stages(C: sp.csr_array, todo: BoolArray) -> list[_Stage]:
    """Rows of one open unknown, again and again; takes them out of `todo`."""
    stages: list[_Stage] = []
    taken = np.zeros(C.shape[1], bool)
    row_of = np.repeat(np.arange(C.shape[0]), np.diff(C.indptr))
    while True:
        single = todo & (_open_terms(C, taken) == 1)
        terms = single[row_of] & ~taken[C.indices]
        rows, slaves = row_of[terms], C.indices[terms].astype(np.int64)
        order = np.lexsort((rows, -np.abs(C.data[terms]), slaves))
        _, first = np.unique(slaves[order], return_index=True)
        pick = order[first]
        if len(pick) == 0:
            todo &= _open_terms(C, taken) > 0  # what is now empty is redundant
            return stages
        stages.append(_Stage(rows[pick], slaves[pick], _diagonal(C.data[terms][pick])))
        taken[slaves[pick]] = True
        todo[rows[pick]] = False


def _peeled_stages(C: sp.csr_array, todo: BoolArray, fixed: list[_Stage]) -> list[_Stage]:
    """Rows with an unknown of their own, peeled off layer by layer."""
    stages: list[_Stage] = []
    taken = _taken(C, fixed)
    row_of = np.repeat(np.arange(C.shape[0]), np.diff(C.indptr))
    light = _open_terms(C, taken) ** 2 <= LARGEST_FILL
    while True:
        open_term = todo[row_of] & ~taken[C.indices]
        uses = np.bincount(C.indices[open_term], minlength=C.shape[1])
        own = open_term & (uses[C.indices] == 1) & light[row_of] & (np.abs(C.data) > 0.1)
        terms = np.flatnonzero(own)
        order = np.lexsort((C.indices[terms], -np.abs(C.data[terms]), row_of[terms]))
        _, first = np.unique(row_of[terms][order], return_index=True)
        pick = terms[order[first]]
        if len(pick) == 0:
            return stages
        rows, slaves = row_of[pick], C.indices[pick].astype(np.int64)
        stages.append(_Stage(rows, slaves, _diagonal(C.data[pick])))
        taken[slaves] = True
        todo[rows] = False


def _group_stage(
    C: sp.csr_array, todo: BoolArray, fixed: list[_Stage], peeled: list[_Stage]
) -> list[_Stage]:
    """What is left, group by group, by QR with column pivoting (one stage for all groups)."""
    taken = _taken(C, fixed + peeled)
    rows = np.flatnonzero(todo & (_open_terms(C, taken) ** 2 <= LARGEST_FILL))
    if len(rows) == 0:
        return []
    part = C[rows][:, ~taken]
    columns = np.flatnonzero(~taken)
    label = parts_of(len(rows), chains(sp.csr_array(part.T)))
    order = np.argsort(label, kind="stable")
    groups = np.split(order, np.cumsum(np.bincount(label))[:-1])
    pieces = [_one_group(part, rows, columns, g) for g in groups if len(g) <= LARGEST_GROUP]
    pieces = [p for p in pieces if len(p.slaves)]
    if not pieces:
        return []
    own, slaves = (
        np.concatenate(x) for x in zip(*((p.rows, p.slaves) for p in pieces), strict=True)
    )
    inverse = sp.csr_array(sp.block_diag([p.inverse for p in pieces], format="csr"))
    return [_Stage(own, slaves, inverse)]


def _one_group(part: sp.csr_array, rows: IntArray, columns: IntArray, group: IntArray) -> _Stage:
    block = part[group]
    used = np.unique(block.indices)
    Q, R, pivots = la.qr(block[:, used].toarray(), mode="economic", pivoting=True)
    diagonal = np.abs(np.diag(R))
    rank = int(np.sum(diagonal > 1e-10 * diagonal[0]))
    inverse = la.solve_triangular(R[:rank, :rank], Q[:, :rank].T)
    return _Stage(rows[group], columns[used[pivots[:rank]]], sp.csr_array(inverse))


def _transformation(C: sp.csr_array, stages: list[_Stage]) -> tuple[IntArray, sp.csr_array]:
    """Masters and T (n, r), from the last stage to the first."""
    n = C.shape[1]
    masters = np.flatnonzero(~_taken(C, stages))
    r = len(masters)
    T = sp.csr_array((np.ones(r), (masters, np.arange(r))), shape=(n, r))
    for stage in reversed(stages):
        slaves = -(stage.inverse @ (C[stage.rows] @ T))
        slaves.data[np.abs(slaves.data) < SMALL] = 0.0
        slaves.eliminate_zeros()
        k = len(stage.slaves)
        place = sp.csr_array((np.ones(k), (stage.slaves, np.arange(k))), shape=(n, k))
        T = sp.csr_array(T + place @ slaves)
    return masters, T


LARGEST = 12
"""Unknowns of a group."""


class SmallGroupsFactor:
    """Factor of A (n, n), symmetric, whose unknowns `groups` (m,) are in small negative groups.

    Raises
    ------
    SingularFactorError
        If a group is large or not negative, or what is left is not positive.
    """

    def __init__(
        self,
        A: sp.csr_array,
        groups: IntArray,
        solver: Solver | str | None = None,
        ordering: Ordering | None = None,
    ) -> None:
        self._groups = groups
        self._rest = np.setdiff1d(np.arange(A.shape[0]), groups)
        self._inverse = _inverse_of_groups(sp.csr_array(A[groups][:, groups]))
        self._ties = sp.csr_array(A[groups][:, self._rest])
        self._across = sp.csr_array(self._ties.T)
        left = A[self._rest][:, self._rest] - self._across @ self._inverse @ self._ties
        part = None if ordering is None else ordering.of(self._rest.astype(np.int64))
        self.inner: Factor = factorise(sp.csr_array(left), True, solver, part)
        self.name = f"{self.inner.name} + 3 x 3"

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b."""
        x = np.empty_like(b, dtype=float)
        own = self._inverse @ b[self._groups]
        rest = self.inner.solve(b[self._rest] - self._across @ own)
        x[self._rest] = rest
        x[self._groups] = own - self._inverse @ (self._ties @ rest)
        return x


def _inverse_of_groups(A: sp.csr_array) -> sp.csr_array:
    """Inverse (m, m) of a matrix of small negative blocks."""
    count, label = csgraph.connected_components(A, directed=False)
    size = np.bincount(label, minlength=count)
    if size.max(initial=0) > LARGEST:
        raise SingularFactorError("a group of unknowns is large")
    order = np.argsort(label, kind="stable")
    first = np.concatenate([[0], np.cumsum(size)[:-1]])
    place = np.empty(len(label), np.int64)
    place[order] = np.arange(len(label)) - np.repeat(first, size)
    blocks = np.zeros((count, size.max(initial=0), size.max(initial=0)))
    terms = sp.coo_array(A)
    rows, columns = terms.coords
    np.add.at(blocks, (label[rows], place[rows], place[columns]), terms.data)
    spare = np.arange(blocks.shape[1]) >= size[:, None]
    group, at = np.nonzero(spare)
    blocks[group, at, at] = -1.0
    try:
        np.linalg.cholesky(-blocks)
    except np.linalg.LinAlgError as error:
        raise SingularFactorError(str(error)) from None
    inverse = np.linalg.inv(blocks)
    group, i, j = np.nonzero(inverse * ~(spare[:, :, None] | spare[:, None, :]))
    member = np.full(blocks.shape[:2], -1)
    member[label, place] = np.arange(len(label))
    found = sp.coo_array(
        (inverse[group, i, j], (member[group, i], member[group, j])), shape=A.shape
    )
    return sp.csr_array(found)
