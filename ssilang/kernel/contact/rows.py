"""Unilateral relations (MINI, MAXI) of a time-stepping problem.

All rows are written `gap = G u - d >= 0` with a reaction p >= 0 that pushes by `G^T p` (by other
rows, `D^T p`, for relations with a dual); rows of sense -1 (MAXI) are turned round. Places with
friction push by their slips besides.

Friction of a time-stepping problem on its numbering: slips, limits, what sticks.

Slips of a step are `H du`; the friction tau pushes by `H^T tau`. Its limit is `coefficient p +
constant` of the unilateral row it belongs to while that is closed, or the value of the row
`watched` (a tension times a coefficient) where it belongs to none.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.assembly import ConstraintRows, Numbering, constraint_matrix
from ssilang.kernel.matrices.matrix import Matrix, Relations

BoolArray = NDArray[np.bool_]
TOUCHING = 1e-11  # of the largest gap or displacement, which solvers leave: closed at the start


@dataclass(frozen=True, eq=False)
class ContactRows:
    """Unilateral conditions on one numbering; false where there are none, and nothing rubs."""

    G: sp.csr_array  # (m, n) rows times their sense
    sense: FloatArray  # (m,) +1 MINI, -1 MAXI
    multipliers: IntArray  # (m,) multiplier nodes
    imposed: FloatArray  # (m, k) imposed values times the sense, by load curve
    friction: "FrictionRows"  # places that rub; forces are the reactions p (m,) and the frictions
    # (m, n) rows that the reactions push by, times the sense; None: those of G
    dual: sp.csr_array | None = None

    def __len__(self) -> int:
        return len(self.sense)

    def __bool__(self) -> bool:
        return self.size > 0

    @cached_property
    def pushing(self) -> sp.csr_array:
        """Rows (size, n) that all forces push by."""
        return _stacked(self.G if self.dual is None else self.dual, self.friction.H)

    @cached_property
    def seen(self) -> sp.csr_array:
        """Rows of gaps, slips and watched tensions."""
        return _stacked(self.G, self.friction.H, self.friction.watched)

    @property
    def size(self) -> int:
        """Number of reactions and frictions."""
        return self.pushing.shape[0]

    @property
    def associated(self) -> bool:
        """Whether reactions push by the rows of the gaps."""
        return self.dual is None

    def at_rest(self, u: FloatArray, gaps: FloatArray) -> FloatArray:
        """What `seen` has of its own in a step from u (n,) with gaps (m,) before it moves."""
        f = self.friction
        return np.concatenate([gaps, np.zeros(f.H.shape[0]), f.offset + f.watched @ u])

    def gaps(self, u: FloatArray, factors: FloatArray) -> FloatArray:
        """Gaps (..., m) at displacement u (n,) and load factors (..., k)."""
        return self.G @ u - factors @ self.imposed.T

    def closed(self, forces: FloatArray) -> BoolArray:
        """Rows (m,) that push."""
        return forces[: len(self)] > 0.0

    def work(self, forces: FloatArray, du: FloatArray, dc: FloatArray) -> float:
        """Work of moving stops and of dual rows for mean forces in a step (frictions: see rubbed).

        `du` (n,) and `dc` are the increments of displacement and load factors.
        """
        p = forces[: len(self)]
        found = float(p @ (self.imposed @ dc))
        return found if self.dual is None else found + float(p @ (self.dual @ du - self.G @ du))

    def rubbed(self, forces: FloatArray, du: FloatArray) -> float:
        """Energy lost by friction in a step of mean forces (size,)."""
        return -float(forces[len(self) :] @ (self.friction.H @ du))

    def sticking(self, forces: FloatArray, u: FloatArray) -> BoolArray:
        """Places that hold by friction."""
        return self.friction.sticking(forces[: len(self)], forces[len(self) :], u)

    def penalty_energy(self, gaps: FloatArray, coefficient: float | None) -> float:
        """Energy stored in the springs of a penalty at gaps (m,)."""
        return 0.5 * (coefficient or 0.0) * float(np.sum(np.minimum(gaps, 0.0) ** 2))

    def lagrange(self, forces: FloatArray) -> FloatArray:
        """Multipliers LX (m,) of the rows as solutions carry them: K u + C^T LX = F."""
        return -self.sense * forces[: len(self)]


def _stacked(*parts: sp.csr_array) -> sp.csr_array:
    return sp.csr_array(sp.vstack(parts))


def split_rows(
    rows: ConstraintRows,
    imposed: FloatArray,
    friction: "tuple[Friction, ...]",
    numbering: Numbering,
) -> tuple[ConstraintRows, FloatArray, ContactRows]:
    """Equalities with their imposed values (n_rows, k), and unilateral rows with what rubs."""
    unilateral = rows.sense != 0
    keep, turn = np.flatnonzero(~unilateral), np.flatnonzero(unilateral)
    C = sp.csr_array(rows.C[keep])
    D = C if rows.associated or _same(C, rows.D[keep]) else sp.csr_array(rows.D[keep])
    equalities = ConstraintRows(C, rows.multipliers[keep], rows.sense[keep], D)
    sense = rows.sense[turn].astype(float)
    turned = sp.diags_array(sense)
    own = rows.associated or _same(rows.C[turn], rows.D[turn])
    contact = ContactRows(
        sp.csr_array(turned @ rows.C[turn]),
        sense,
        rows.multipliers[turn],
        sense[:, None] * imposed[turn],
        friction_rows(friction, numbering, rows.multipliers[turn]),
        None if own else sp.csr_array(turned @ rows.D[turn]),
    )
    return equalities, imposed[keep], contact


def _same(C: sp.csr_array, D: sp.csr_array) -> bool:
    return bool(abs(C - D).sum() == 0.0)


@dataclass(frozen=True, eq=False)
class Friction:
    """Places that rub, on nodes of a mesh.

    Attributes
    ----------
    slip : Relations
        Slips of the places, `width` rows each, place by place.
    width : int
        1 in the plane and for cables, 2 in space.
    coefficient, constant : arrays (k,)
        Limit of the friction force: `coefficient p + constant` where the unilateral relation of
        the place pushes with p > 0.
    raw_normals : array (k,)
        Multiplier nodes of these relations; empty with `tension`.
    tension : Relations or None
        Instead: rows whose positive values (with `offset`) are the limits.
    offset : array (k,)
    """

    slip: Relations
    width: int
    coefficient: FloatArray
    constant: FloatArray
    raw_normals: IntArray
    tension: Relations | None
    offset: FloatArray

    @property
    def normals(self) -> IntArray:
        """Multiplier nodes of the unilateral relations, after merges."""
        return self.slip.table.resolve(self.raw_normals)


STICKING = 1e-9
"""Share of its limit that a friction must stay under to hold."""


@dataclass(frozen=True, eq=False)
class FrictionRows:
    """Places that rub; false without any."""

    H: sp.csr_array  # (k d, n) slips, d rows a place
    width: int  # d, 1 in the plane, 2 in space
    normal: IntArray  # (k,) unilateral row of each place, -1 for none
    coefficient: FloatArray  # (k,)
    constant: FloatArray  # (k,)
    watched: sp.csr_array  # (k, n) rows whose values are the limits where `normal` is -1
    offset: FloatArray  # (k,) values of these at zero displacement

    def __bool__(self) -> bool:
        return len(self.normal) > 0

    def sticking(self, pushes: FloatArray, tau: FloatArray, u: FloatArray) -> BoolArray:
        """Places (k,) whose friction tau (k d,) stays under its limit."""
        own = self.normal >= 0
        limit = np.where(own, 0.0, self.offset + self.watched @ u)
        p = pushes[self.normal[own]]
        bound = self.coefficient[own] * p + self.constant[own]
        limit[own] = np.where(p > 0.0, bound, 0.0)
        size = np.linalg.norm(tau.reshape(-1, self.width), axis=1)
        return (limit > 0.0) & (size < (1.0 - STICKING) * limit)


def friction_rows(
    parts: tuple[Friction, ...], numbering: Numbering, multipliers: IntArray
) -> FrictionRows:
    """Friction on a numbering; `multipliers` (m,) are those of the unilateral rows in order."""
    n, none = numbering.size, [np.zeros(0)]
    H, watched, normal = [sp.csr_array((0, n))], [sp.csr_array((0, n))], [np.zeros(0, np.int64)]
    order = np.argsort(multipliers)
    for part in parts:
        rows = constraint_matrix(Matrix(part.slip.table, (), (part.slip,)), numbering)
        H.append(rows.C)
        k = len(part.coefficient)
        if part.tension is None:
            place = np.searchsorted(multipliers, part.normals, sorter=order)
            normal.append(order[place].astype(np.int64))
            watched.append(sp.csr_array((k, n)))
        else:
            normal.append(np.full(k, -1))
            found = constraint_matrix(Matrix(part.slip.table, (), (part.tension,)), numbering)
            watched.append(found.C)
    return FrictionRows(
        sp.csr_array(sp.vstack(H)),
        parts[0].width if parts else 1,
        np.concatenate(normal),
        np.concatenate(none + [p.coefficient for p in parts]),
        np.concatenate(none + [p.constant for p in parts]),
        sp.csr_array(sp.vstack(watched)),
        np.concatenate(none + [p.offset for p in parts]),
    )
