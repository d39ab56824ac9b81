"""What every solver of sparse systems gives, takes, and raises."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray

if TYPE_CHECKING:
    from ssilang.kernel.solvers.petsc.client import PetscServer


class Factor(Protocol):
    """A factorised matrix; `solve` takes (n,) or (n, k)."""

    name: str

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, same shape as b."""
        ...


@dataclass(frozen=True)
class Solver:
    """Which solver takes the systems of a calculation.

    Attributes
    ----------
    name : str or None
        The one asked for; None for the first that suits.
    petsc : PetscServer or None
        The run's server of PETSc, if it has one.
    """

    name: str | None = None
    petsc: PetscServer | None = field(default=None, compare=False)

    @classmethod
    def of(cls, asked: Solver | str | None) -> Solver:
        """The solver with a name, if only that is said."""
        return asked if isinstance(asked, Solver) else cls(asked)


FIRST_FIT = Solver()
"""None is asked for."""


@dataclass(frozen=True, eq=False)
class Ordering:
    """What helps to order the unknowns of a matrix.

    Attributes
    ----------
    points : array (n, d)
        Coordinates of the unknowns.
    last : array of int
        Unknowns to be eliminated last, together.
    rigid : array (n, k) or None
        Rigid motions of the unknowns, for multigrid.
    """

    points: FloatArray
    last: IntArray
    rigid: FloatArray | None = None

    def of(self, kept: IntArray) -> Ordering:
        """The ordering of some of the unknowns (increasing)."""
        place = np.full(len(self.points), -1, np.int64)
        place[kept] = np.arange(len(kept))
        last = place[self.last]
        rigid = None if self.rigid is None else self.rigid[kept]
        return Ordering(self.points[kept], last[last >= 0], rigid)

    def scaled(self, scale: FloatArray) -> Ordering:
        """The ordering of the unknowns `u / scale`."""
        rigid = None if self.rigid is None else self.rigid / scale[:, None]
        return Ordering(self.points, self.last, rigid)


class SingularFactorError(Exception):
    """A solver met an exactly zero pivot; `cholesky.inverse` turns it into a message."""
