"""Concrete that cracks: the scalar damage of Mazars.

Mazars (1986, "A description of micro- and macroscale damage of concrete structures", Eng. Fracture
Mech. 25) and Mazars and Pijaudier-Cabot (1989, J. Eng. Mech. 115): with the elastic moduli E,

    s = (1 - D) E e ,  e~ = sqrt(sum <e_i>^2) ,  D = at^BETA Dt(e~) + ac^BETA Dc(e~)

over the principal strains e_i; D grows only while e~ is larger than ever before (and KTR0), and
never sinks. Dt and Dc are 1 - KTR0 (1 - A) / e~ - A exp(-B (e~ - KTR0)) with A and B of tension and
of compression; at is the part of the extensions that tensile stresses make,

    at = sum over e_i > 0 of et_i e_i / e~^2 ,  et = C <E e> ,  ac = 1 - at

Where ATRA is negative, Dt has no stress left in the end and a work of fracture instead: up to -10
the stress sinks as exp(-BTRA (e~ - KTR0)), below it is a line that ends at the strain BTRA.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import PointParameters, Response

REQUIRED = ("KTR0", "ATRA", "BTRA", "ACOM", "BCOM")
VARIABLES = ("D", "EPTI")
"""Damage, largest equivalent strain so far."""
DEFAULTS = {"BETA": 1.06}
MOST = 1 - 1e-9
"""Largest damage: the strain is found again from the stress."""
_LINE, _LEAST = -10.0, 1e-15


def _left(
    k: FloatArray, a: FloatArray, b: FloatArray, e: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """What a curve leaves of the stress at equivalent strains (m,), and its slope."""
    tail, rest = np.exp(b * (k - e)), np.maximum(b - e, 0.0)
    line, span = a < _LINE, np.where(a < _LINE, b - k, 1.0) * e
    left = np.select([line, a < 0], [k * rest / span, k / e * tail], k * (1 - a) / e + a * tail)
    slopes = [-k * b * (rest > 0) / span, -k * tail * (1 / e + b)]
    return left, np.select([line, a < 0], slopes, -k * (1 - a) / e - a * b * tail * e) / e


def _opened(p: PointParameters, e: FloatArray, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The part `at` (m,) of principal strains (m, 3), and its derivatives (m, 3)."""
    axes = slice(3), slice(3)
    stiff, soft = (matrix[:, *axes] for matrix in (p.moduli, p.compliance))
    effective = np.einsum("mij,mj->mi", stiff, e)
    made = np.einsum("mij,mj->mi", soft, np.maximum(effective, 0.0))
    turned = np.einsum("mij,mjk->mik", soft, (effective > 0)[..., None] * stiff)
    wide = np.maximum(e, 0.0)
    part = np.vecdot(made, wide) / size**2
    slope = np.einsum("mi,mik->mk", wide, turned) + (e > 0) * made - 2 * part[:, None] * wide
    return np.clip(part, _LEAST, 1 - _LEAST), slope / size[:, None] ** 2


def _grown(p: PointParameters, e: FloatArray, size: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Damage (m,) of a loading, and its derivatives by the principal strains (m, 3)."""
    tension, fall = _left(p["KTR0"], p["ATRA"], p["BTRA"], size)
    pressure, sink = _left(p["KTR0"], p["ACOM"], p["BCOM"], size)
    (at, slope), beta = _opened(p, e, size), p["BETA"]
    turn = beta * ((1 - tension) * at ** (beta - 1) - (1 - pressure) * (1 - at) ** (beta - 1))
    along = -(at**beta * fall + (1 - at) ** beta * sink) / size
    found = at**beta * (1 - tension) + (1 - at) ** beta * (1 - pressure)
    return found, along[:, None] * np.maximum(e, 0.0) + turn[:, None] * slope


def respond(
    p: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Mazars' damage (see the head of this module)."""
    damage, reached = variables.T
    whole = np.einsum("mij,mj->mi", p.compliance, stress) / (1 - damage)[:, None] + strain
    effective = np.einsum("mij,mj->mi", p.moduli, whole)
    half = whole * [1, 1, 1, 0.5, 0.5, 0.5]
    e, axes = np.linalg.eigh(half[:, [[0, 3, 4], [3, 1, 5], [4, 5, 2]]])
    size = np.linalg.norm(np.maximum(e, 0.0), axis=1)
    rows = np.flatnonzero(size > np.maximum(reached, p["KTR0"]))
    found, slope = _grown(p.at(rows), e[rows], size[rows])
    slope = slope * ((found > damage[rows]) & (found < MOST))[:, None]
    now = damage.copy()
    now[rows] = np.clip(found, damage[rows], MOST)
    first, second = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
    by_strain = np.einsum("mk,mik->mi", slope, axes[rows][:, first] * axes[rows][:, second])
    tangent = (1 - now)[:, None, None] * p.moduli
    tangent[rows] -= effective[rows][:, :, None] * by_strain[:, None, :]
    kept = np.column_stack([now, np.maximum(reached, size)])
    return Response((1 - now)[:, None] * effective, kept, tangent, strain)


def locked(p: PointParameters, stress: FloatArray, variables: FloatArray) -> FloatArray:
    """What damaged matter stores beyond the energy of YOUN and NU at its stress (m,), J/m3."""
    damage = variables[:, 0]
    return np.asarray(p.elastic_energy(stress) * damage / (1 - damage))


def check(p: PointParameters) -> None:
    """Refuse a softening that begins beyond its end."""
    line = p["ATRA"] < _LINE
    require("MAZARS", p, {"KTR0 < BTRA": ~line | (p["KTR0"] < p["BTRA"])})
