"""Ways to find the reactions of unilateral conditions from their flexibility.

All solve `g = q + W p`. Lagrange (see `complementarity`), augmented Lagrangian and Uzawa reach
the exact conditions `g >= 0, p >= 0, p . g = 0`; penalty gives `p = c max(0, -g)`.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray
from ssilang.kernel.base.errors import ConvergenceError, KernelError
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact

MOST_SWEEPS = 200_000
TOLERANCE = 1e-13  # change of the reactions in a sweep, relative


@dataclass(frozen=True, eq=False)
class Reactions:
    """Reactions p (m,), active rows, iterations taken."""

    p: FloatArray
    active: BoolArray
    iterations: int


def lagrange(
    W: FloatArray, q: FloatArray, coefficient: float | None, start: BoolArray | None
) -> Reactions:
    """Exact multipliers by active sets; the coefficient has no meaning."""
    m = len(q)
    none = np.zeros((m, 0))
    problem = ContactProblem(W, q, none, none, np.zeros(0), np.zeros(m, bool))
    found = solve_contact(problem, start)
    return Reactions(np.maximum(found.p, 0.0), found.active, found.iterations)


def penalty(
    W: FloatArray, q: FloatArray, coefficient: float | None, start: BoolArray | None
) -> Reactions:
    """`p = c max(0, -g)`: rows with a flexibility 1/c added; an error without a positive c."""
    if coefficient is None or not coefficient > 0.0:
        raise KernelError("kernel.solvers.penalty-needs-coefficient")
    return lagrange(W + np.eye(len(q)) / coefficient, q, None, start)


def augmented(
    W: FloatArray, q: FloatArray, coefficient: float | None, start: BoolArray | None
) -> Reactions:
    """Augmented Lagrangian, all unknowns at once: rows with `p - c g > 0` are closed.

    Newton's method on `p = max(0, p - c g)` is the active set of `lagrange` whatever c: g is zero
    on closed rows and p on open ones (Hintermueller, Ito and Kunisch 2002).

    Raises
    ------
    KernelError
        If the coefficient is not positive.
    """
    if coefficient is not None and not coefficient > 0.0:
        raise KernelError("kernel.solvers.augmentation-must", c=coefficient)
    return lagrange(W, q, None, start)


def uzawa(
    W: FloatArray, q: FloatArray, coefficient: float | None, start: BoolArray | None
) -> Reactions:
    """Uzawa's sweeps `p <- max(0, p - c g)`, c < 2/(largest eigenvalue of W) for convergence.

    Raises
    ------
    KernelError
        For a coefficient that cannot converge; names the largest that can.
    ConvergenceError
        If the reactions still change after the last sweep.
    """
    largest = float(np.linalg.eigvalsh(0.5 * (W + W.T))[-1]) if len(W) else 1.0
    c = coefficient if coefficient is not None else 1.0 / largest
    if not 0.0 < c < 2.0 / largest:
        raise KernelError(
            "kernel.solvers.uzawa-coefficient-not-converge", c=c, largest=2.0 / largest
        )
    p = np.zeros(len(q))
    for sweep in range(1, MOST_SWEEPS + 1):
        new = np.maximum(0.0, p - c * (q + W @ p))
        change = np.abs(new - p).max(initial=0.0)
        p = new
        if change <= TOLERANCE * p.max(initial=0.0):
            # freed of what the iteration left over, if the active rows are the right ones
            active = p > 0.0
            found = lagrange(W, q, None, active)
            right = np.array_equal(found.active, active)
            return Reactions(found.p if right else p, active, sweep)
    raise ConvergenceError(
        "kernel.solvers.uzawa-sweeps-did-not",
        most_sweeps=MOST_SWEEPS,
        change=change,
        largest=1.8 / largest,
    )


Method = Callable[[FloatArray, FloatArray, "float | None", "BoolArray | None"], Reactions]

METHODS: dict[str, Method] = {
    "LAGRANGE": lagrange,
    "PENALITE": penalty,
    "AUGMENTE": augmented,
    "UZAWA": uzawa,
}
"""Methods by the word that scripts use."""
