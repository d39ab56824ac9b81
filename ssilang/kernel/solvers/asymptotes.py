"""A step of the method of moving asymptotes: least value under conditions, by convex shares.

Each function is replaced by `r + sum_i p_i / (U_i - x_i) + q_i / (x_i - L_i)`, which has its value
and slopes at the present point; what is sought is the least of that problem (K. Svanberg, Int. J.
Num. Meth. Eng. 24, 1987). It is separable: for given multipliers each variable has a closed form,
and the multipliers are found as the greatest value of the dual function. `least_linear` takes
tangents in place of the shares.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.scientific import optimize

LIMIT = 0.1
"""Share of the way to an asymptote that a step leaves free."""


@dataclass(frozen=True, eq=False)
class Shares:
    """Functions (m + 1, the first to be least) over variables (n,) as convex shares.

    Attributes
    ----------
    p, q : arrays (m + 1, n)
        Weights of the upper and the lower asymptotes.
    r : array (m + 1,)
        What is left, the conditions' bounds taken off: condition j holds where its value is <= 0.
    lower, upper : arrays (n,)
        Asymptotes.
    low, high : arrays (n,)
        Bounds of the step.
    """

    p: FloatArray
    q: FloatArray
    r: FloatArray
    lower: FloatArray
    upper: FloatArray
    low: FloatArray
    high: FloatArray

    def values(self, x: FloatArray) -> FloatArray:
        """The functions at x."""
        found: FloatArray = self.r + self.p @ (1.0 / (self.upper - x))
        return found + self.q @ (1.0 / (x - self.lower))

    def nearest(self, multipliers: FloatArray, x: FloatArray) -> FloatArray:
        """The variables of the least Lagrangian; those that meet no function stay at x."""
        weights = np.concatenate([[1.0], multipliers])
        p, q = np.sqrt(weights @ self.p), np.sqrt(weights @ self.q)
        free = p + q > 0.0
        best: FloatArray = x.copy()
        best[free] = (p * self.lower + q * self.upper)[free] / (p + q)[free]
        return np.minimum(np.maximum(best, self.low), self.high)


def shares(
    x: FloatArray,
    values: FloatArray,
    slopes: FloatArray,
    bounds: tuple[FloatArray, FloatArray],
    asymptotes: tuple[FloatArray, FloatArray],
) -> Shares:
    """Convex shares of functions with `values` (m + 1,) and `slopes` (m + 1, n) at x (n,)."""
    lower, upper = asymptotes
    p = np.maximum(slopes, 0.0) * (upper - x) ** 2
    q = np.maximum(-slopes, 0.0) * (x - lower) ** 2
    r = values - p @ (1.0 / (upper - x)) - q @ (1.0 / (x - lower))
    low = np.maximum(bounds[0], lower + LIMIT * (x - lower))
    high = np.minimum(bounds[1], upper - LIMIT * (upper - x))
    return Shares(p, q, r, lower, upper, low, high)


def least(problem: Shares, x: FloatArray, ceiling: FloatArray) -> FloatArray:
    """The variables (n,) of the least first function under the conditions.

    `ceiling` (m,) bounds the multipliers: a condition whose multiplier gets there is given up,
    which is what a slack variable of that cost does. Infinite where the condition must hold.
    """
    count = len(ceiling)
    if count == 0:
        return problem.nearest(np.zeros(0), x)

    def dual(multipliers: FloatArray) -> tuple[float, FloatArray]:
        values = problem.values(problem.nearest(multipliers, x))
        return -float(values[0] + multipliers @ values[1:]), -values[1:]

    found = optimize.minimize(
        dual,
        np.zeros(count),
        jac=True,
        method="L-BFGS-B",
        bounds=[(0.0, None if np.isinf(c) else c) for c in ceiling],
        options={"maxiter": 1000, "ftol": 1e-15, "gtol": 1e-12},
    )
    return problem.nearest(found.x, x)


def least_linear(
    x: FloatArray,
    values: FloatArray,
    slopes: FloatArray,
    bounds: tuple[FloatArray, FloatArray],
    ceiling: FloatArray,
) -> FloatArray:
    """The variables (n,) of the least first tangent under those of the conditions, in bounds.

    Conditions of finite `ceiling` (m,) may be missed at that cost (a slack variable each).
    """
    soft = np.flatnonzero(np.isfinite(ceiling))
    slack = np.zeros((len(ceiling), len(soft)))
    slack[soft, np.arange(len(soft))] = -1.0
    found = optimize.linprog(
        np.concatenate([slopes[0], ceiling[soft]]),
        A_ub=np.hstack([slopes[1:], slack]) if len(ceiling) else None,
        b_ub=slopes[1:] @ x - values[1:] if len(ceiling) else None,
        bounds=[*zip(*bounds, strict=True), *[(0.0, None)] * len(soft)],
    )
    return np.asarray(found.x, dtype=float)[: len(x)]  # bounds make that there is one
