"""The return to nested surfaces: parts side by side that share the strain, compiled."""

import math

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled

KEPT = 5
"""Stresses XX YY XY XZ YZ that are kept of each part; ZZ is what brings the trace to zero."""


@compiled
def return_to_surfaces(
    moduli: FloatArray,
    thresholds: FloatArray,
    shares: FloatArray,
    which: IntArray,
    strain: FloatArray,
    strength: FloatArray,
    stress: FloatArray,
    variables: FloatArray,
    tangent: FloatArray,
    scratch: FloatArray,
) -> None:
    """One step of strain at m points; `stress` and `variables` are brought up to date.

    Part i, of shear modulus G_i, has a deviator s_i with `s_i : s_i <= 2 (G_i c_i f)^2`: radial
    return, exact where the strain goes straight.

    Parameters
    ----------
    moduli : array (m, 2)
        Shear and bulk modulus.
    thresholds, shares : array (n_curves, n)
        Shear strain c_i at which a part yields, share G_i / G of the modulus.
    which : array (m,)
        Curve of each point.
    strain : array (m, 6)
        Step, with engineering shears.
    strength : array (m, 2)
        Factor f of the strengths at the end of the step, and its derivative by the trace of the
        strain.
    stress : array (m, 6)
    variables : array (m, 1 + 5 n)
        Cumulated plastic strain, then the deviators of the parts.
    tangent : array (m, 6, 6)
    scratch : array (2, 6)
        Deviator of a part, and the stresses by the factor f.
    """
    t, by_factor = scratch[0], scratch[1]
    for m in range(len(strain)):
        G, K, curve = moduli[m, 0], moduli[m, 1], which[m]
        D = tangent[m]
        trace = strain[m, 0] + strain[m, 1] + strain[m, 2]
        for j in range(6):
            by_factor[j] = 0.0
            for k in range(6):
                D[j, k] = 0.0
        # change of the deviator, plastic deviator times 2 G, 2 G of the parts as they now stand
        dxx = dyy = dxy = dxz = dyz = 0.0
        pxx = pyy = pxy = pxz = pyz = 0.0
        stiff = 0.0
        for i in range(shares.shape[1]):
            own = shares[curve, i] * G
            if own == 0.0:
                continue
            place = 1 + 5 * i
            old = variables[m, place : place + 5]
            t[0] = old[0] + 2.0 * own * (strain[m, 0] - trace / 3.0)
            t[1] = old[1] + 2.0 * own * (strain[m, 1] - trace / 3.0)
            t[2] = -t[0] - t[1]
            for j in range(3, 6):
                t[j] = old[j - 1] + own * strain[m, j]
            square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2]
            square += 2.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5])
            limit = own * thresholds[curve, i] * strength[m, 0]
            left = 1.0
            if square > 2.0 * limit * limit:
                size = math.sqrt(0.5 * square)
                left = limit / size
                turning = own * left / (size * size)
                rise = own * thresholds[curve, i] / size
                for j in range(6):
                    by_factor[j] += rise * t[j]
                    for k in range(6):
                        D[j, k] -= turning * t[j] * t[k]
                lost = 1.0 - left
                pxx += lost * t[0]
                pyy += lost * t[1]
                pxy += lost * t[3]
                pxz += lost * t[4]
                pyz += lost * t[5]
            stiff += 2.0 * own * left
            dxx += left * t[0] - old[0]
            dyy += left * t[1] - old[1]
            dxy += left * t[3] - old[2]
            dxz += left * t[4] - old[3]
            dyz += left * t[5] - old[4]
            old[0], old[1], old[2] = left * t[0], left * t[1], left * t[3]
            old[3], old[4] = left * t[4], left * t[5]
        plastic = pxx * pxx + pyy * pyy + (pxx + pyy) * (pxx + pyy)
        plastic += 2.0 * (pxy * pxy + pxz * pxz + pyz * pyz)
        variables[m, 0] += math.sqrt(plastic / 6.0) / G
        stress[m, 0] += K * trace + dxx
        stress[m, 1] += K * trace + dyy
        stress[m, 2] += K * trace - dxx - dyy
        stress[m, 3] += dxy
        stress[m, 4] += dxz
        stress[m, 5] += dyz
        for j in range(3):
            for k in range(3):
                D[j, k] += K - stiff / 3.0
            D[j, j] += stiff
            D[j + 3, j + 3] += 0.5 * stiff
        if strength[m, 1] != 0.0:
            for j in range(6):
                for k in range(3):
                    D[j, k] += by_factor[j] * strength[m, 1]
