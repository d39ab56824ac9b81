"""Linear elastic moduli of continuous media, isotropic and orthotropic.

Component order is XX YY ZZ XY (XZ YZ), shear strains are engineering strains.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.model import Mode

# components of the full tensor that each hypothesis keeps
KEPT: dict[Mode, tuple[int, ...]] = {
    Mode.PLANE_STRAIN: (0, 1, 2, 3),
    Mode.PLANE_STRESS: (0, 1, 2, 3),
    Mode.GENERALISED_PLANE_STRAIN: (0, 1, 2, 3),
    Mode.AXISYMMETRIC: (0, 1, 2, 3),
    Mode.FOURIER: (0, 1, 2, 3, 4, 5),
    Mode.THREE_DIMENSIONAL: (0, 1, 2, 3, 4, 5),
    Mode.UNIDIMENSIONAL: (0, 1, 2),
}

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Axes of the six components of a symmetric tensor, in their order."""


def check_isotropic(young: FloatArray, poisson: FloatArray) -> None:
    """Refuse moduli that no stable material has: NU outside of -1 < NU < 0.5."""
    bad = (poisson <= -1) | (poisson >= 0.5)
    if bad.any():
        raise MaterialError(
            "kernel.materials.poisson-ratio-nu-outside",
            poisson=float(np.asarray(poisson)[bad].flat[0]),
            poisson_so_any=(np.abs(poisson - 0.5) < 0.01).any(),
        )
    if not np.isfinite(young).all():
        raise MaterialError("kernel.materials.young-modulus-youn-not")


def isotropic_compliance(young: FloatArray, poisson: FloatArray) -> FloatArray:
    """Compliance (..., 6, 6) from YOUN and NU (...)."""
    E, nu = np.broadcast_arrays(young, poisson)
    S = np.zeros((*E.shape, 6, 6))
    with np.errstate(divide="ignore"):
        for i in range(3):
            S[..., i, :3] = (-nu / E)[..., None]
            S[..., i, i] = 1 / E
            S[..., 3 + i, 3 + i] = 2 * (1 + nu) / E
    return S


def isotropic_moduli(young: FloatArray, poisson: FloatArray) -> FloatArray:
    """Moduli (..., 6, 6) from YOUN and NU (...)."""
    E, nu = np.broadcast_arrays(young, poisson)
    lame = E * nu / ((1 + nu) * (1 - 2 * nu))
    shear = E / (2 * (1 + nu))
    D = np.zeros((*E.shape, 6, 6))
    for i in range(3):
        D[..., i, :3] = lame[..., None]
        D[..., i, i] = lame + 2 * shear
        D[..., 3 + i, 3 + i] = shear
    return D


def two_axes(first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (..., 3) along `first`, and across it in the plane of both.

    Raises
    ------
    MaterialError
        If a vector is zero or parallel to the other.
    """
    third = np.cross(first, second)
    norms = [np.linalg.norm(v, axis=-1, keepdims=True) for v in (first, third)]
    if min(float(n.min()) for n in norms) <= 0:
        raise MaterialError("kernel.materials.vectors-axes-zero-parallel")
    v1, v3 = first / norms[0], third / norms[1]
    return v1, np.cross(v3, v1)


def orthotropic_compliance(constants: dict[str, FloatArray]) -> FloatArray:
    """Compliance (..., 6, 6) in the axes of orthotropy.

    Parameters
    ----------
    constants : mapping
        YG1 YG2 YG3 NU12 NU23 NU13 G12 G23 G13; strain 2 under stress 1 is -NU12 / YG1.
    """
    names = ("YG1", "YG2", "YG3", "NU12", "NU23", "NU13", "G12", "G23", "G13")
    E1, E2, E3, n12, n23, n13, G12, G23, G13 = np.broadcast_arrays(*(constants[n] for n in names))
    S = np.zeros((*E1.shape, 6, 6))
    for i, E in enumerate((E1, E2, E3)):
        S[..., i, i] = 1 / E
    for i, j, value in ((0, 1, n12 / E1), (1, 2, n23 / E2), (0, 2, n13 / E1)):
        S[..., i, j] = S[..., j, i] = -value
    for i, G in ((3, G12), (4, G13), (5, G23)):
        S[..., i, i] = 1 / G
    if np.linalg.eigvalsh(S).min() <= 0:
        raise MaterialError("kernel.materials.orthotropic-constants-not-stable")
    return S


def strain_rotation(axes: FloatArray) -> FloatArray:
    """Matrix (..., 6, 6) that takes strains from global axes to `axes`.

    Parameters
    ----------
    axes : array (..., 3, 3)
        Unit vectors as rows.
    """
    T = np.zeros((*axes.shape[:-2], 6, 6))
    for row, (i, j) in enumerate(PAIRS):
        a, b = axes[..., i, :], axes[..., j, :]
        factor = 0.5 if i == j else 1.0
        for column, (k, m) in enumerate(PAIRS):
            T[..., row, column] = factor * (a[..., k] * b[..., m] + a[..., m] * b[..., k])
    return T


def rotated_moduli(moduli: FloatArray, axes: FloatArray) -> FloatArray:
    """Moduli (..., 6, 6) given in `axes` (..., 3, 3), expressed in global axes."""
    T = strain_rotation(axes)
    return np.swapaxes(T, -1, -2) @ moduli @ T


def reduced_moduli(moduli: FloatArray, mode: Mode) -> FloatArray:
    """Moduli of one hypothesis from the full ones.

    In plane stress the out-of-plane row is condensed: SMZZ stays zero.
    """
    kept = list(KEPT[mode])
    D = moduli[..., kept, :][..., kept].copy()
    if mode is Mode.PLANE_STRESS:
        column = D[..., :, 2:3].copy()
        pivot = np.where(D[..., 2:3, 2:3] == 0, 1.0, D[..., 2:3, 2:3])
        D -= column * D[..., 2:3, :] / pivot
        D[..., 2, :] = 0
        D[..., :, 2] = 0
    return D
