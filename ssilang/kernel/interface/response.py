"""Forces and stiffness of an interface as functions of its jumps, compiled."""

from __future__ import annotations

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.interface.laws.point_laws import point_energies, respond


@compiled
def local_jumps(pairs: IntArray, B: FloatArray, delta: FloatArray, w: FloatArray) -> None:
    """Local jumps w (n_points, d) from pair jumps delta (size,)."""
    n, d, _ = B.shape
    for p in range(n):
        for i in range(d):
            total = 0.0
            for a in range(pairs.shape[1]):
                for j in range(d):
                    total += B[p, i, a * d + j] * delta[pairs[p, a] * d + j]
            w[p, i] = total


@compiled
def interface_forces(
    pairs: IntArray, B: FloatArray, weights: FloatArray, t: FloatArray, f: FloatArray
) -> None:
    """Forces f (size,) on the pair jumps from local tractions t (n_points, d)."""
    n, d, _ = B.shape
    for i in range(f.shape[0]):
        f[i] = 0.0
    for p in range(n):
        for i in range(d):
            force = weights[p] * t[p, i]
            if force != 0.0:
                for a in range(pairs.shape[1]):
                    for j in range(d):
                        f[pairs[p, a] * d + j] += force * B[p, i, a * d + j]


@compiled
def interface_stiffness(
    pairs: IntArray, B: FloatArray, weights: FloatArray, D: FloatArray, K: FloatArray
) -> None:
    """Dense stiffness K (size, size) from local tangents D (n_points, d, d)."""
    n, d, _ = B.shape
    for row in range(K.shape[0]):
        for column in range(K.shape[1]):
            K[row, column] = 0.0
    for p in range(n):
        for i in range(d):
            for j in range(d):
                value = weights[p] * D[p, i, j]
                if value != 0.0:
                    _add_product(pairs[p], B[p, i], B[p, j], value, d, K)


@compiled
def _add_product(
    pairs: IntArray, left: FloatArray, right: FloatArray, value: float, d: int, K: FloatArray
) -> None:
    for a in range(pairs.shape[0]):
        for i in range(d):
            row = pairs[a] * d + i
            part = value * left[a * d + i]
            if part != 0.0:
                for b in range(pairs.shape[0]):
                    for j in range(d):
                        K[row, pairs[b] * d + j] += part * right[b * d + j]


@apart
@compiled
def interface_response(
    pairs: IntArray,
    B: FloatArray,
    weights: FloatArray,
    codes: IntArray,
    p: FloatArray,
    delta: FloatArray,
    state: FloatArray,
    w: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
    f: FloatArray,
) -> None:
    """Jumps, tractions, new states, tangents and forces at the pair jumps delta, in place."""
    local_jumps(pairs, B, delta, w)
    respond(codes, w, state, p, t, new, D)
    interface_forces(pairs, B, weights, t, f)


@compiled
def interface_energies(
    codes: IntArray,
    p: FloatArray,
    weights: FloatArray,
    w: FloatArray,
    t: FloatArray,
    state: FloatArray,
) -> tuple[float, float]:
    """Stored energy and energy lost so far of the whole interface (joules)."""
    stored, lost = 0.0, 0.0
    for i in range(w.shape[0]):
        kept, gone = point_energies(codes[i], w[i], t[i], state[i], p[i])
        stored += weights[i] * kept
        lost += weights[i] * gone
    return stored, lost
