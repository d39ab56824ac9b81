"""The two iterations of an interface, each with room of its own, behind one call."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.interface.factors import iterate_cached, workspace
from ssilang.kernel.interface.newton import iterate_interface


def solve_interface(*given):
    """`iterate_interface` of its arguments from pairs to h: turns and residual."""
    n = len(given[12])  # the increment y
    room = [np.empty(n) for _ in range(3)] + [np.empty((n, n)) for _ in range(2)]
    return iterate_interface(*given, *room)


def solve_cached(*given):
    """The same by the iteration that keeps its factors."""
    state, y, w = given[10], given[12], given[13]
    return iterate_cached(*given, *workspace(len(y), w, state)[4:])
