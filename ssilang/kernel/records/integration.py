"""Velocities and displacements of accelerograms, and the correction that brings them to rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.errors import FieldError


def _trapezoids(values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Running integral along the first axis, 0 at the start."""
    found = np.zeros(values.shape)
    np.cumsum(0.5 * step * (values[1:] + values[:-1]), axis=0, out=found[1:])
    return found


def integrated(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Velocity and displacement of accelerations at a constant step, at rest at the start.

    Parameters
    ----------
    acceleration : array (n, ...)
    linear : bool
        False: trapezoids twice. True: the exact motion of an acceleration linear in the steps.

    Returns
    -------
    velocity, displacement : arrays like `acceleration`
    """
    v = _trapezoids(acceleration, step)
    if not linear:
        return v, _trapezoids(v, step)
    more = step * v[:-1] + step**2 / 6.0 * (2.0 * acceleration[:-1] + acceleration[1:])
    d = np.zeros(acceleration.shape)
    np.cumsum(more, axis=0, out=d[1:])
    return v, d


def displacement_integral(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> NDArray[np.float64]:
    """Integral of the displacement over the record, by the rule that gave the displacement."""
    v, d = integrated(acceleration, step, linear)
    if not linear:
        return np.asarray(_trapezoids(d, step)[-1])
    a = acceleration
    pieces = step * d[:-1] + step**2 / 2.0 * v[:-1] + step**3 / 24.0 * (3.0 * a[:-1] + a[1:])
    return np.asarray(pieces.sum(axis=0))


def end_rows(n: int, step: float, linear: bool = False) -> NDArray[np.float64]:
    """Rows (3, n) whose products with an acceleration are the final velocity, the final
    displacement and the integral of the displacement.

    The rules are linear and do not change with time: a unit at one sample gives what a unit at
    sample 1 gives in a record shortened by its delay. The two ends are computed on their own.
    """
    pulse = np.zeros(n)
    pulse[1] = 1.0
    v, d = integrated(pulse, step, linear)
    rows = np.empty((3, n))
    inner = np.arange(1, n - 1)
    rows[0, inner], rows[1, inner] = v[n - inner], d[n - inner]
    # after the pulse the displacement is linear in time: so is the integral's second difference
    left = n - 1.0 - inner
    start = displacement_integral(pulse[:3], step, linear)
    rows[2, inner] = start + d[2] * step * (left - 1) + v[2] * step**2 * (left - 1) ** 2 / 2.0
    for place in (0, n - 1):
        pulse[:] = 0.0
        pulse[place] = 1.0
        v, d = integrated(pulse, step, linear)
        rows[:, place] = v[-1], d[-1], displacement_integral(pulse, step, linear)
    return rows


def brought_to_rest(
    acceleration: NDArray[np.float64], step: float, linear: bool = False
) -> NDArray[np.float64]:
    """The nearest acceleration (least squares) that ends at rest: final velocity, final
    displacement and mean displacement are zero.

    Raises
    ------
    FieldError
        With fewer than four points.
    """
    n = len(acceleration)
    if n < 4:
        raise FieldError("kernel.records.record-correct-needs-four", n=n)
    rows = end_rows(n, step, linear)
    basis, _ = np.linalg.qr((rows / np.linalg.norm(rows, axis=1)[:, None]).T)
    return np.asarray(acceleration - basis @ (basis.T @ acceleration))
