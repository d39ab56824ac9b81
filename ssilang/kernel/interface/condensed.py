"""Equilibrium of a step on the jumps alone, where all but the interface is linear.

`A x + c J^T (f(delta_0 + J x) - f_0) = r` with A factorised once (A includes `J^T R J`, R being a
stiffness that keeps it regular, taken back here). With the compliance `S = J A^-1 J^T`,

    y + S h = y_0 ,   h = c (f(delta_0 + y) - f_0) - R y ,   y = J x ,   y_0 = J A^-1 r

and then `x = A^-1 r - A^-1 J^T h`.
"""

from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.interface.copies import add_product, add_symmetric_product, largest
from ssilang.kernel.interface.response import InterfaceState, Trial
from ssilang.kernel.solvers.low_rank import NONE, LowRank, add_low_rank_product

LAST_DIGITS = 1e-12  # of the largest jump, increment or traction: what double precision leaves


class Condensed(NamedTuple):
    """What all but the interface is to the interface."""

    S: FloatArray  # (q, q) compliance
    R: FloatArray  # (q, q) stiffness that it holds in excess (no rows: none)
    c: float  # share of the end of the step in its equilibrium
    half: bool = False  # of S is read: it is symmetric, and large
    blocks: LowRank = NONE  # S where it is so large that its blocks are read in its place
    tolerance: float = LAST_DIGITS  # residual of the jumps that is left, of the largest one


FREE = np.zeros((0, 0))  # nothing is held in excess


def condensed_of(S: FloatArray, c: float, R: FloatArray = FREE, half: bool = False) -> Condensed:
    """The condensed interface of a compliance and of what it holds in excess, if anything."""
    return Condensed(np.ascontiguousarray(S), R if R.any() else FREE, c, half)


@compiled_fast
def residual(condensed: Condensed, now: InterfaceState, trial: Trial) -> float:
    """`h = c (f - f_0) - R y` and `r = y - y_0 + S h` of the trial; the largest |r|."""
    S, R, y, h, r = condensed.S, condensed.R, trial.y, trial.h, trial.r
    for i in range(len(h)):
        h[i] = condensed.c * (trial.f[i] - now.f[i])
        r[i] = y[i] - trial.y0[i]
    add_product(-1.0, R, y, h)  # of no rows: nothing
    if len(condensed.blocks.values):
        add_low_rank_product(condensed.blocks, False, h, r)
    elif condensed.half:
        add_symmetric_product(S, h, r)
    else:
        add_product(1.0, S, h, r)
    return largest(r)
