"""What every solver of sparse systems gives, takes, and raises."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray

if TYPE_CHECKING:
    from ssilang.kernel.solvers.petsc.client import PetscServer


RESIDUAL = 1e-12
"""What a direct solver leaves of a second member, or little more."""
FINEST, COARSEST = 1e-14, 1e-4
"""Tolerances between which an iteration may be asked for."""


class Factor(Protocol):
    """A factorised matrix; `solve` takes (n,) or (n, k)."""

    name: str

    def solve(self, b: FloatArray) -> FloatArray:
        """Solution of A x = b, same shape as b."""


@dataclass(frozen=True)
class Solver:
    """Which solver takes the systems of a calculation.

    Attributes
    ----------
    name : str or None
        The one asked for; None for the first that suits.
    petsc : PetscServer or None
        The run's server of PETSc, if it has one.
    tolerance : float
        Norm of the residual, of that of the second member, at which multigrid ends.
    """

    name: str | None = None
    petsc: "PetscServer | None" = field(default=None, compare=False)
    tolerance: float = RESIDUAL

    @classmethod
    def of(cls, asked: "Solver | str | None") -> "Solver":
        """The solver with a name, if only that is said."""
        return asked if isinstance(asked, Solver) else cls(asked)


FIRST_FIT = Solver()
"""None is asked for."""


@dataclass(frozen=True, eq=False)
class Ordering:
    """What helps to order the unknowns of a matrix."""

    points: FloatArray  # (n, d) coordinates of the unknowns
    last: IntArray  # unknowns to be eliminated last, together
    rigid: FloatArray | None = None  # (n, k) rigid motions of the unknowns, for multigrid
    # (n,) node of each unknown, for multigrid: unknowns side by side of one node go together
    nodes: IntArray | None = None
    # whether a few solves follow rather than thousands: the factor must then pay at once
    once: bool = False

    def of(self, kept: IntArray) -> "Ordering":
        """The ordering of some of the unknowns (increasing)."""
        place = np.full(len(self.points), -1, np.int64)
        place[kept] = np.arange(len(kept))
        last = place[self.last]
        rigid = None if self.rigid is None else self.rigid[kept]
        nodes = None if self.nodes is None else self.nodes[kept]
        return Ordering(self.points[kept], last[last >= 0], rigid, nodes, self.once)

    def scaled(self, scale: FloatArray) -> "Ordering":
        """The ordering of the unknowns `u / scale`."""
        rigid = None if self.rigid is None else self.rigid / scale[:, None]
        return replace(self, rigid=rigid)


class SingularFactorError(Exception):
    """A solver met an exactly zero pivot; `cholesky.inverse` turns it into a message."""
