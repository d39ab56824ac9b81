"""The normal SDM law on arrays, in closed form by Lambert's function.

Independent of the compiled iteration of `sdm_law`; the tests hold one against the other.
"""

from __future__ import annotations

import numpy as np

from ssilang.kernel.mesh.nodes import FloatArray


def normal_arrays(
    w: FloatArray,
    xi_n: FloatArray,
    k: FloatArray,
    fu: FloatArray,
    gf: FloatArray,
    fc: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Traction, new xi and dt/dw of the normal law at many points (all arrays (n,)).

    Softening solves `k (w - xi) = FU exp(-a xi)`, a = FU/GF, by
    `w - xi = -W0(-(a FU/k) exp(-a w))/a` with the principal branch of Lambert's function, which
    is real because KN > FU^2/GF.
    """
    from scipy.special import lambertw

    w, xi_n, k, fu, gf, fc = np.broadcast_arrays(w, xi_n, k, fu, gf, fc)
    a = np.divide(fu, gf, out=np.zeros(w.shape), where=fu > 0)
    soften = (w > xi_n) & (k * (w - xi_n) > fu * np.exp(-a * xi_n))
    free = soften & (fu == 0)
    damaged = soften & (fu > 0)
    xi = np.where(free, w, xi_n).astype(float)
    rate = a[damaged]
    argument = -(rate * fu[damaged] / k[damaged]) * np.exp(-rate * w[damaged])
    xi[damaged] = w[damaged] + lambertw(argument, 0).real / rate
    strength = fu * np.exp(-a * xi)
    below = -fc + k * xi_n
    line = np.divide(-k * fc, below, out=np.zeros(w.shape), where=below > 0)
    closed, opened = (w <= xi_n) & (k * w <= fc), w > xi_n
    slope = np.where(opened | closed, k, line).astype(float)
    slope[free] = 0.0
    slope[damaged] = (-k * a * strength / (k - a * strength))[damaged]
    t = np.where(closed, k * w, slope * (w - xi_n))
    t = np.where(soften, strength, t)
    return t, xi, slope
