"""Powers of real numbers, roots of odd order of negative ones included."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import NoResultError


def real_power(base: Any, exponent: Any) -> NDArray[np.float64]:
    """``base ** exponent`` elementwise; (-8) ** (1/3) is -2.

    Raises
    ------
    NoResultError
        If a negative number is raised to a power that is neither an integer nor the inverse of
        an odd integer.
    """
    x, power = np.broadcast_arrays(np.asarray(base, dtype=float), np.asarray(exponent, dtype=float))
    low = (x < 0) & (power != np.round(power))
    if not low.any():
        return np.asarray(np.power(x, power), dtype=float)
    order = 1.0 / power[low]
    odd = (np.abs(order - np.round(order)) <= 1e-12 * np.abs(order)) & (np.round(order) % 2 == 1)
    if not odd.all():
        worst = np.flatnonzero(~odd)[0]
        raise NoResultError(
            "kernel.base.no-real-power", number=x[low][worst], power=power[low][worst]
        )
    roots = np.power(np.abs(x), power)
    return np.where(low, -roots, np.power(np.where(low, 1.0, x), power))
