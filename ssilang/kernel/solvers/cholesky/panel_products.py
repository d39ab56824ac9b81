"""Products with the panels of a factor, in vectors of eight numbers.

Panels are small, some 16 by 40: of loops that a compiler makes vectors of, half of the time goes to
the rests. Here a rest is a vector with a mask. `panel_code` writes them.
"""

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.written import written

CODE = "ssilang.kernel.solvers.cholesky.panel_code"


@written(CODE)
def times_lower(values: FloatArray, pos: int, w: int, x: FloatArray, at: int) -> None:
    """b = I b: w numbers b of x from `at` on, lower I (w, w) in values from pos on."""
    block, b = values[pos : pos + w * w].reshape(w, w), x[at : at + w]
    b[:] = block @ b


@written(CODE)
def times_upper(values: FloatArray, pos: int, w: int, x: FloatArray, at: int) -> None:
    """b = I^T b, as `times_lower`."""
    block, b = values[pos : pos + w * w].reshape(w, w), x[at : at + w]
    b[:] = block.T @ b


@written(CODE)
def subtract(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    """y -= P^T b with P (w, m) in values from pos on; b and y are in x, from `at` and `to` on."""
    P = values[pos : pos + w * m].reshape(w, m)
    x[to : to + m] -= P.T @ x[at : at + w]


@written(CODE)
def subtract_transposed(
    values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int
) -> None:
    """b -= P y, as `subtract`."""
    P = values[pos : pos + w * m].reshape(w, m)
    x[at : at + w] -= P @ x[to : to + m]
