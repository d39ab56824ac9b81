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


def _tension(p: PointParameters, strain: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Damage of tension at equivalent strains (m,), and its slope."""
    start, a, b = p["KTR0"], p["ATRA"], p["BTRA"]
    whole = np.where(a < 0, 1.0, a)
    damage, slope = _softened(start, whole, b, strain)
    tail = start / strain * np.exp(b * (start - strain))
    left = start * np.maximum(b - strain, 0.0) / strain / np.where(b > start, b - start, 1.0)
    fall = np.where(strain < b, start * b / strain**2 / np.where(b > start, b - start, 1.0), 0.0)
    kinds = [a < _LINE, a < 0]
    return (
        np.select(kinds, [1 - left, 1 - tail], damage),
        np.select(kinds, [fall, tail * (1 / strain + b)], slope),
    )


def _softened(
    start: FloatArray, a: FloatArray, b: FloatArray, strain: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mazars' evolution (m,), and its slope."""
    tail = a * np.exp(b * (start - strain))
    return 1 - start * (1 - a) / strain - tail, start * (1 - a) / strain**2 + b * tail


def _stretched(
    p: PointParameters, e: FloatArray, size: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The part `at` (m,) of principal strains (m, 3), and its derivatives (m, 3)."""
    nu, shear = p["NU"][:, None], p.shear[:, None]
    lame = (2 * p.shear * p["NU"] / (1 - 2 * p["NU"]))[:, None]
    effective = lame * e.sum(axis=1, keepdims=True) + 2 * shear * e
    tensile = np.maximum(effective, 0.0)
    young = p["YOUN"][:, None]
    made = ((1 + nu) * tensile - nu * tensile.sum(axis=1, keepdims=True)) / young
    open_ = np.maximum(e, 0.0)
    part = np.vecdot(made, open_) / size**2
    # d made_i / d e_k, stresses above zero alone
    active = (effective > 0).astype(float)
    own = active[:, :, None] * (lame[:, :, None] + 2 * shear[:, :, None] * np.eye(3))
    turned = ((1 + nu[..., None]) * own - nu[..., None] * own.sum(axis=1, keepdims=True)) / young[
        ..., None
    ]
    slope = np.einsum("mi,mik->mk", open_, turned) + np.where(e > 0, made, 0.0)
    slope = slope / size[:, None] ** 2 - 2 * part[:, None] * open_ / size[:, None] ** 2
    return part, slope


def respond(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Mazars' damage (see the head of this module)."""
    p, moduli = parameters, parameters.moduli
    whole = np.einsum("mij,mj->mi", p.compliance, stress) / (1 - variables[:, :1]) + strain
    half = whole * [1, 1, 1, 0.5, 0.5, 0.5]
    e, axes = np.linalg.eigh(half[:, [[0, 3, 4], [3, 1, 5], [4, 5, 2]]])
    size = np.linalg.norm(np.maximum(e, 0.0), axis=1)
    kept = variables.copy()
    kept[:, 1] = np.maximum(variables[:, 1], size)
    tangent = (1 - variables[:, 0])[:, None, None] * moduli
    rows = np.flatnonzero((size > variables[:, 1]) & (size > p["KTR0"]))
    if len(rows):
        some = p.at(rows)
        dt, dt_slope = _tension(some, size[rows])
        dc, dc_slope = _softened(some["KTR0"], some["ACOM"], some["BCOM"], size[rows])
        at, at_slope = _stretched(some, e[rows], size[rows])
        at = np.clip(at, _LEAST, 1 - _LEAST)
        beta, ac = some["BETA"], 1 - at
        found = at**beta * dt + ac**beta * dc
        grown = (found > variables[rows, 0]) & (found < MOST)
        kept[rows, 0] = np.clip(found, variables[rows, 0], MOST)
        by_size = at**beta * dt_slope + ac**beta * dc_slope
        turn = beta * (dt * at ** (beta - 1) - dc * ac ** (beta - 1))
        slope = (
            by_size[:, None] * np.maximum(e[rows], 0.0) / size[rows, None]
            + turn[:, None] * at_slope
        )
        slope *= grown[:, None]
        first, second = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
        by_strain = np.einsum("mk,mik->mi", slope, axes[rows][:, first] * axes[rows][:, second])
        effective = np.einsum("mij,mj->mi", moduli[rows], whole[rows])
        tangent[rows] = (1 - kept[rows, 0])[:, None, None] * moduli[rows]
        tangent[rows] -= effective[:, :, None] * by_strain[:, None, :]
    made = (1 - kept[:, :1]) * np.einsum("mij,mj->mi", moduli, whole)
    return Response(made, kept, tangent, strain)


def locked(p: PointParameters, stress: FloatArray, variables: FloatArray) -> FloatArray:
    """What damaged matter stores beyond the energy of YOUN and NU at its stress (m,), J/m3."""
    damage = variables[:, 0]
    return np.asarray(p.elastic_energy(stress) * damage / (1 - damage))


def check(p: PointParameters) -> None:
    """Refuse a softening that begins beyond its end.

    Raises
    ------
    MaterialError
        Naming what must hold.
    """
    line = p["ATRA"] < _LINE
    require("MAZARS", p, {"KTR0 < BTRA": ~line | (p["KTR0"] < p["BTRA"])})
