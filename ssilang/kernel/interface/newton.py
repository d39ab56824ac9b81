"""Exact solution of a problem that is linear but for its interface, on the interface alone.

`A x + c J^T (f(delta_0 + J x) - f_0) = r` with A factorised once (A includes `J^T R J`, R being a
stiffness that keeps it regular, taken back here). With the compliance `S = J A^-1 J^T`,

    y + S (c (f(delta_0 + y) - f_0) - R y) = y_0 ,   y = J x ,  y_0 = J A^-1 r

is solved for y by semi-smooth Newton; the law is piecewise smooth, so two or three turns reach
rounding errors.
"""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.columns import CLOSED_SHEAR, FROT, FU, HELD, OPEN_SHEAR, SHEAR
from ssilang.kernel.interface.response import interface_response, interface_stiffness

TOLERANCE = 1e-12  # of the largest jump or increment: what double precision leaves
PLAIN_TURNS = 12  # turns without line search
HOLDING_TURN = 16  # turn from which shear that jumps with the opening is held
MOST_TURNS = 60
ACCEPTED = 1e-9  # residual at which an iteration that only rounding errors move is accepted


@compiled
def solve_dense(A: FloatArray, b: FloatArray) -> bool:
    """Solve A x = b in place (b becomes x, A is lost); False if a pivot vanishes."""
    n = b.shape[0]
    top = 0.0
    for i in range(n):
        for j in range(n):
            top = max(top, abs(A[i, j]))
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(A[i, k]) > abs(A[pivot, k]):
                pivot = i
        if abs(A[pivot, k]) <= 1e-15 * top:
            return False
        if pivot != k:
            for j in range(k, n):
                A[k, j], A[pivot, j] = A[pivot, j], A[k, j]
            b[k], b[pivot] = b[pivot], b[k]
        inverse = 1.0 / A[k, k]
        for i in range(k + 1, n):
            factor = A[i, k] * inverse
            if factor != 0.0:
                for j in range(k + 1, n):
                    A[i, j] -= factor * A[k, j]
                b[i] -= factor * b[k]
    for k in range(n - 1, -1, -1):
        total = b[k]
        for j in range(k + 1, n):
            total -= A[k, j] * b[j]
        b[k] = total / A[k, k]
    return True


@compiled
def largest(v: FloatArray) -> float:
    top = 0.0
    for i in range(v.shape[0]):
        top = max(top, abs(v[i]))
    return top


@compiled
def _residual(
    S: FloatArray,
    R: FloatArray,
    c: float,
    y: FloatArray,
    y0: FloatArray,
    f: FloatArray,
    f0: FloatArray,
    h: FloatArray,
    r: FloatArray,
) -> float:
    """h = c (f - f0) - R y and r = y - y0 + S h; returns max |r|."""
    n = y.shape[0]
    for i in range(n):
        total = c * (f[i] - f0[i])
        for j in range(n):
            total -= R[i, j] * y[j]
        h[i] = total
    size = 0.0
    for i in range(n):
        total = y[i] - y0[i]
        for j in range(n):
            total += S[i, j] * h[j]
        r[i] = total
        size = max(size, abs(total))
    return size


@compiled
def _newton_matrix(S: FloatArray, K: FloatArray, R: FloatArray, c: float, A: FloatArray) -> None:
    """A = 1 + S (c K - R); K (overwritten) is sparse for few points."""
    n = S.shape[0]
    for k in range(n):
        for j in range(n):
            K[k, j] = c * K[k, j] - R[k, j]
    for i in range(n):
        for j in range(n):
            A[i, j] = 0.0
        A[i, i] = 1.0
    for k in range(n):
        for j in range(n):
            value = K[k, j]
            if value != 0.0:
                for i in range(n):
                    A[i, j] += S[i, k] * value


@compiled
def release_shear(state: FloatArray, new: FloatArray) -> None:
    """End of an iteration: no shear is held any more."""
    for i in range(state.shape[0]):
        state[i, HELD] = 0.0
        new[i, HELD] = 0.0


@compiled
def hold_shear(codes: IntArray, p: FloatArray, t: FloatArray, state: FloatArray) -> bool:
    """Hold the shear of points that lose it at once on opening; True if there are any.

    `t` are the tractions at the start of the step.
    """
    found, normal = False, t.shape[1] - 1
    for i in range(state.shape[0]):
        if codes[i] == 1 and p[i, FROT] < 0.0 and p[i, SHEAR] != 1.0 and p[i, FU] == 0.0:
            state[i, HELD] = CLOSED_SHEAR if t[i, normal] < 0.0 else OPEN_SHEAR
            found = True
    return found


@apart
@compiled
def iterate_interface(
    pairs: IntArray,
    B: FloatArray,
    weights: FloatArray,
    codes: IntArray,
    p: FloatArray,
    S: FloatArray,
    R: FloatArray,
    c: float,
    delta0: FloatArray,
    f0: FloatArray,
    state: FloatArray,
    y0: FloatArray,
    y: FloatArray,
    w: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    f: FloatArray,
    h: FloatArray,
    r: FloatArray,
    dy: FloatArray,
    delta: FloatArray,
    K: FloatArray,
    A: FloatArray,
) -> tuple[int, float]:
    """Increment y of the jumps (start value on entry), tractions, new states, forces.

    Parameters
    ----------
    r, dy, delta, K, A : arrays (size,), (size, size)
        Room for the iteration.
    h : array (size,)
        On return `c (f - f0) - R y`, the load that corrects the linear solution:
        `x = A^-1 r - A^-1 J^T h`.

    Returns
    -------
    turns : int
        Newton turns, negative if it did not converge, 0 if the interface lost its stiffness.
    residual : float
        Of the last turn, relative to the jumps.
    """
    n = y.shape[0]
    for i in range(n):
        delta[i] = delta0[i] + y[i]
    interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
    size = _residual(S, R, c, y, y0, f, f0, h, r)
    scale = max(largest(y0), largest(delta0), 1e-300)
    for turn in range(1, MOST_TURNS + 1):
        scale = max(scale, largest(y))
        if turn == HOLDING_TURN:
            interface_response(pairs, B, weights, codes, p, delta0, state, w, t, new, D, f)
            if hold_shear(codes, p, t, state):
                for i in range(n):
                    y[i] = y0[i]
                    delta[i] = delta0[i] + y[i]
            interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
            size = _residual(S, R, c, y, y0, f, f0, h, r)
        if size <= TOLERANCE * scale:
            release_shear(state, new)
            return turn, size / scale
        interface_stiffness(pairs, B, weights, D, K)
        _newton_matrix(S, K, R, c, A)
        for i in range(n):
            dy[i] = -r[i]
        if not solve_dense(A, dy):
            release_shear(state, new)
            return 0, size / scale
        before, length = size, 1.0
        for halving in range(12):
            for i in range(n):
                y[i] += length * dy[i]
                delta[i] = delta0[i] + y[i]
            interface_response(pairs, B, weights, codes, p, delta, state, w, t, new, D, f)
            size = _residual(S, R, c, y, y0, f, f0, h, r)
            if turn <= PLAIN_TURNS or size < before or halving == 11:
                break
            for i in range(n):
                y[i] -= length * dy[i]
            length *= 0.5
        if length * largest(dy) <= 1e-14 * scale and size <= ACCEPTED * scale:
            release_shear(state, new)
            return turn, size / scale
    release_shear(state, new)
    return -MOST_TURNS, size / scale
