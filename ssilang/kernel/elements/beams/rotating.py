"""Matrices of bodies seen from a turning frame, and gyroscopic coupling of turning beams.

In a frame that turns at w, `M a + C v + (K + K_w) u = f`: K_w = integral rho N^T W^2 N with W the
matrix of the cross product by w (centrifugal forces that follow the displacement); a changing w
adds the integral rho N^T dW/dt N (Euler); C is the integral 2 rho N^T W N (Coriolis). Shells count
by the translations of their middle surface.
"""

from dataclasses import replace
from itertools import product

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import catalog
from ssilang.kernel.elements.beams.beam import keep, to_global
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import element_matrices
from ssilang.kernel.elements.solids.kinematics import cross_matrix, on_diagonal
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices

TRANSLATIONS = ("UX", "UY", "UZ")
_OF_REVOLUTION = ("UR", "UT", "UZ")
_SCALAR_MASS = (*catalog.BODY_FAMILIES, *catalog.FLAT_SHELLS, *catalog.BARS, "thick", "timoshenko")
"""Families whose mass couples each translation with itself only, all in the same way."""
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)


def inertia_coupling(
    zone: Zone, material: CellField, coupling: FloatArray, kind: str = "RIGIDITE"
) -> ElementMatrices:
    """Integral of rho N^T A N for a matrix A (3, 3) between the translations.

    Parameters
    ----------
    coupling : array (3, 3)
        W^2 for the centrifugal stiffness, dW/dt for Euler's, 2 W for Coriolis' damping; in bodies
        of revolution along the radius, the circumference and the axis, and diagonal.
    kind : str
        Subtype of the matrix.

    Raises
    ------
    FieldError
        For elements whose inertia is not made of translations, and for what couples a harmonic
        with its antisymmetric part in bodies of revolution.
    """
    turning = zone.mode in (Mode.AXISYMMETRIC, Mode.FOURIER)
    names = _OF_REVOLUTION if turning else TRANSLATIONS
    if turning and np.any(coupling != np.diag(np.diag(coupling))):
        raise FieldError("kernel.elements.turning-frame-couples-two")
    parameters = zone_field(zone, material)
    name = catalog.family_name(zone)
    if name in catalog.CUBIC_BEAMS:
        values, layout = _cubic(zone, parameters, coupling), family_of(zone).layout(zone)
    elif name in _SCALAR_MASS:
        mass, layout = family_of(zone).mass_values(zone, parameters)
        values = np.zeros_like(mass)
        rows = [np.flatnonzero([u == name for u in layout.unknowns]) for name in names]
        for (a, own), (b, other) in product(enumerate(rows), repeat=2):
            if len(own) and len(other):
                # the scalar mass between two nodes, read off one and the same unknown
                values[:, own[:, None], other] = coupling[a, b] * mass[:, own[:, None], own]
    else:
        raise FieldError("kernel.elements.element-no-matrices-turning", element=zone.element)
    symmetric = bool(np.array_equal(coupling, coupling.T))
    block = element_matrices(zone, layout, values, kind, keep_zone=False)
    return replace(block, symmetric=symmetric)


def _cubic(zone: Zone, parameters: ZoneField, coupling: FloatArray) -> FloatArray:
    """The same for beams of cubic deflection, the mass on their line."""
    frame = beam_frame(zone, parameters)
    linear, _ = family_of(zone).linear_mass(zone, parameters)  # type: ignore[attr-defined]
    local = np.zeros((len(linear), 12, 12))
    A = frame.axes @ coupling @ np.swapaxes(frame.axes, 1, 2)
    for s, w in zip(0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS, strict=True):
        N, _ = _shapes(float(s), frame.lengths, True)
        scale = (w * linear * frame.lengths)[:, None, None]
        local += scale * (np.swapaxes(N, 1, 2) @ A @ N)
    return to_global(keep(local, zone), frame.rotation(zone))


def _shapes(s: float, L: FloatArray, cubic: bool) -> tuple[FloatArray, FloatArray]:
    """Translations and rotations (n_cells, 3, 12) at the share s of beams, local axes."""
    n = len(L)
    N, R = np.zeros((n, 3, 12)), np.zeros((n, 3, 12))
    for start, share in ((0, 1.0 - s), (6, s)):
        N[:, 0, start] = R[:, 0, start + 3] = share
        if not cubic:
            N[:, 1, start + 1] = N[:, 2, start + 2] = share
            R[:, 1, start + 4] = R[:, 2, start + 5] = share
    if cubic:
        H = np.array(
            [1 - 3 * s**2 + 2 * s**3, s - 2 * s**2 + s**3, 3 * s**2 - 2 * s**3, s**3 - s**2]
        )
        D = np.array([6 * s**2 - 6 * s, 1 - 4 * s + 3 * s**2, 6 * s - 6 * s**2, 3 * s**2 - 2 * s])
        for k, power in enumerate((0, 1, 0, 1)):
            column = (1, 5, 7, 11)[k]
            other, sign = (2, 4, 8, 10)[k], (1.0, -1.0, 1.0, -1.0)[k]
            N[:, 1, column] = H[k] * L**power
            N[:, 2, other] = sign * H[k] * L**power
            R[:, 2, column] = D[k] * L ** (power - 1)
            R[:, 1, other] = -sign * D[k] * L ** (power - 1)
    return N, R


def corotational(zone: Zone, damping: ElementMatrices, material: CellField) -> ElementMatrices:
    """Circulatory stiffness of a damping that turns with beams at OMEG about their axis.

    The damping C resists velocities seen in the turning frame, `C (v - w x u)`: to C stands beside
    it the stiffness -C W, W the cross product by w on translations and on rotations.

    Raises
    ------
    FieldError
        For other elements than beams in space.
    """
    if catalog.family_name(zone) not in catalog.BEAMS or zone.mode is not Mode.THREE_DIMENSIONAL:
        raise FieldError("kernel.elements.corotational-damping-beams-space", element=zone.element)
    parameters = zone_field(zone, material)
    axes = beam_frame(zone, parameters).axes
    W = cross_matrix(parameters.each("OMEG", 1.0)[:, None] * axes[:, 0])
    values = -damping.values @ on_diagonal(W, damping.values.shape[1] // 3)
    return replace(damping, values=values, kind="RIGIDITE", zone=None, symmetric=False)


def gyroscopic(zone: Zone, material: CellField) -> ElementMatrices:
    """Gyroscopic coupling of beams that turn at OMEG (rad/s) about their own axis x, fixed frame.

    A section of polar mass moment I per length that tilts at ty', tz' needs the moments
    `I OMEG tz'` about y and `-I OMEG ty'` about z: an antisymmetric matrix on the velocities.

    Raises
    ------
    FieldError
        For other elements than beams in space.
    """
    name = catalog.family_name(zone)
    if name not in catalog.BEAMS or zone.mode is not Mode.THREE_DIMENSIONAL:
        raise FieldError("kernel.elements.gyroscopic-coupling-beams-space", element=zone.element)
    family, parameters = family_of(zone), zone_field(zone, material)
    frame = beam_frame(zone, parameters)
    _, moments = family.linear_mass(zone, parameters)  # type: ignore[attr-defined]
    local = np.zeros((len(frame.lengths), 12, 12))
    scale = parameters.each("OMEG", 1.0) * moments[:, 0] * frame.lengths
    for s, w in zip(0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS, strict=True):
        _, R = _shapes(float(s), frame.lengths, name in catalog.CUBIC_BEAMS)
        y, z = R[:, 1], R[:, 2]
        turn = y[:, :, None] * z[:, None, :] - z[:, :, None] * y[:, None, :]
        local += (w * scale)[:, None, None] * turn
    values = to_global(local, frame.rotation(zone))
    block = element_matrices(zone, family.layout(zone), values, "AMORTISSEMENT", keep_zone=False)
    return replace(block, symmetric=False)
