"""The SDM law on arrays, its normal part in closed form by Lambert's function.

Independent of the compiled iteration of `sdm_law`; the tests hold one against the other.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray


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
    w, xi_n, k, fu, gf, fc = np.broadcast_arrays(w, xi_n, k, fu, gf, fc)
    a = np.divide(fu, gf, out=np.zeros(w.shape), where=fu > 0)
    soften = (w > xi_n) & (k * (w - xi_n) > fu * np.exp(-a * xi_n))
    free = soften & (fu == 0)
    damaged = soften & (fu > 0)
    xi = np.where(free, w, xi_n).astype(float)
    if damaged.any():
        from scipy.special import lambertw  # takes longer to import than most scripts to run

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


def shear_arrays(
    w: FloatArray,
    slip: FloatArray,
    damage: FloatArray,
    stiffness: FloatArray,
    tn: FloatArray,
    xi: FloatArray,
    fu: FloatArray,
    gf: FloatArray,
    friction: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Shear tractions and new slips (n, d - 1) of the law at many points.

    Parameters
    ----------
    w, slip, stiffness : arrays (n, d - 1)
        Shear jumps, slips of the last step, and stiffness KS1[, KS2].
    damage : array (n,)
        Share of the shear stiffness that cohesive tension had taken in the last step.
    tn, xi : arrays (n,)
        Normal traction and largest opening at the end of the step, of `normal_arrays`.
    fu, gf, friction : arrays (n,)
        Friction below zero says that none bounds the shear.

    Notes
    -----
    A closed point (tn < 0) holds `k (w - slip)` up to Coulomb's bound, and slips by the rest. An
    open one loses its shear: its slip follows its jump. In cohesive tension the stiffness fades as
    the strength; closing takes over the shear that is left, as a slip. Directions without
    stiffness have nothing to relieve, and no slip.
    """
    taken = np.where((stiffness > 0.0) & (tn < 0.0)[:, None], damage[:, None], 0.0)
    slip = slip + taken * (w - slip)
    trial = stiffness * (w - slip)
    size = np.linalg.norm(trial, axis=1)
    bound = np.where(friction >= 0.0, -friction * tn, np.inf)
    slides = (tn < 0.0) & (size > bound)
    ratio = np.divide(bound, size, out=np.ones(len(size)), where=slides)
    decay = np.divide(fu * xi, gf, out=np.zeros(len(tn)), where=fu > 0)
    left = np.where(tn < 0.0, ratio, np.where(fu > 0, np.exp(-decay), 0.0))
    relieved = np.where(slides, 1.0 - ratio, (tn >= 0.0) & (fu == 0.0))[:, None] * (w - slip)
    return left[:, None] * trial, slip + np.where(stiffness > 0.0, relieved, 0.0)
