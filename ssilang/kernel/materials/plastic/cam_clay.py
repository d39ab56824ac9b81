"""Modified Cam-Clay: an ellipse in pressure and deviator that grows with the plastic compression.

The equations of Borja and Lee (1990, "Cam-Clay plasticity, part I", Comput. Methods Appl. Mech.
Eng. 78), p = -tr(s) / 3 and v positive in compression, q von Mises' stress:

    f = q^2 / M^2 + p (p - pc) ,  associated flow ,  pc = P0 exp((1 + E0) vp / (LAMD - KAPA)) ,
    p = p0 exp((1 + E0) ve / KAPA) ,  s = 2 G1 ee

with the void ratio E0 of the start in all of them (small strains), and a constant shear modulus:
the elasticity has an energy, so that no elastic cycle gives work. The backward Euler equations keep
pressure, hardening and surface exact at the end of a step; two unknowns are left, the plastic
compression v of the step and its multiplier phi:

    v = phi (2 p(v) - pc(v)) ,  q = q trial / (1 + 6 G1 phi / M^2) ,  f(q, p(v), pc(v)) = 0

For each phi the first has one root (its slope in v is above 1). Below `LEAST` of P0 the bulk
modulus stays what it is there, so that a clay may begin without stress.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.conditions import require
from ssilang.kernel.materials.plastic.response import (
    DEVIATOR,
    UNIT,
    PointParameters,
    Response,
    mises,
)

REQUIRED = ("E0", "M", "P0", "KAPA", "LAMD", "G1")
VARIABLES = ("EPSE", "VPLA")
"""Cumulated plastic strain; plastic volume lost, compression positive."""
LEAST = 0.01
TURNS = 60
PRECISION = 1e-13
FARTHEST = 60.0
"""Largest exponent: Newton's method on a whole model may try steps that are far too long."""


@dataclass(frozen=True, eq=False)
class Clay:
    """Constants (m,): stiffness and hardening by strain, least pressure, shear modulus, M^2."""

    soft: FloatArray
    hard: FloatArray
    least: FloatArray
    shear: FloatArray
    square: FloatArray

    def at(self, rows: IntArray) -> "Clay":
        """The same for some of the points."""
        return Clay(*(getattr(self, n)[rows] for n in ("soft", "hard", "least", "shear", "square")))

    def pressure(self, strain: FloatArray) -> FloatArray:
        """Pressure of an elastic compression counted from the least pressure."""
        x = np.minimum(self.soft * strain, FARTHEST)
        return np.asarray(self.least * np.where(x > 0, np.exp(np.maximum(x, 0.0)), 1 + x))

    def strain(self, pressure: FloatArray) -> FloatArray:
        """The inverse of `pressure`."""
        ratio = pressure / self.least
        log = np.log(np.maximum(ratio, 1.0))
        return np.asarray(np.where(ratio > 1, log, ratio - 1) / self.soft)

    def bulk(self, pressure: FloatArray) -> FloatArray:
        """Bulk modulus."""
        return np.asarray(self.soft * np.maximum(pressure, self.least))


def clay_of(p: PointParameters) -> Clay:
    """Constants of the law."""
    volume = 1 + p["E0"]
    hard = volume / (p["LAMD"] - p["KAPA"])
    return Clay(volume / p["KAPA"], hard, LEAST * p["P0"], p["G1"], p["M"] ** 2)


@dataclass(frozen=True, eq=False)
class Ends:
    """The end of a plastic step, (m,) each: p, pc, q, v, phi."""

    pressure: FloatArray
    limit: FloatArray
    shear: FloatArray
    lost: FloatArray
    phi: FloatArray


def _at_multiplier(
    c: Clay, phi: FloatArray, reach: FloatArray, limit: FloatArray, tried: FloatArray, v: FloatArray
) -> Ends:
    """The step for given multipliers: v by Newton's method inside a bracket."""
    low, high = np.full(len(phi), -np.inf), np.full(len(phi), np.inf)
    for _ in range(TURNS):
        p, pc = c.pressure(reach - v), limit * np.exp(np.clip(c.hard * v, -FARTHEST, FARTHEST))
        rest = v - phi * (2 * p - pc)
        slope = 1 + phi * (2 * c.bulk(p) + c.hard * pc)
        low, high = np.where(rest < 0, v, low), np.where(rest > 0, v, high)
        step = v - rest / slope
        both = np.isfinite(low) & np.isfinite(high)
        outside = both & ((step <= low) | (step >= high)) & (rest != 0)
        step = np.where(outside, 0.5 * (np.where(both, low, 0) + np.where(both, high, 0)), step)
        moved = np.abs(step - v).max(initial=0.0)
        v = step
        if moved <= PRECISION * 1e-2:
            break
    p, pc = c.pressure(reach - v), limit * np.exp(np.clip(c.hard * v, -FARTHEST, FARTHEST))
    return Ends(p, pc, tried / (1 + 6 * c.shear * phi / c.square), v, phi)


def _slopes(c: Clay, e: Ends) -> tuple[FloatArray, ...]:
    """Derivatives of the equation for v and of the surface, by v and by phi, and of q by phi."""
    push = 2 * e.pressure - e.limit
    bulk, growth = c.bulk(e.pressure), c.hard * e.limit
    dq = -e.shear * 6 * c.shear / (c.square + 6 * c.shear * e.phi)
    vv, fv = 1 + e.phi * (2 * bulk + growth), -push * bulk - e.pressure * growth
    return vv, -push, fv, 2 * e.shear / c.square * dq, dq


def _returned(c: Clay, reach: FloatArray, limit: FloatArray, tried: FloatArray) -> Ends:
    """The end of a step that leaves the surface: phi by Newton's method inside a bracket."""
    n = len(reach)
    size = c.pressure(reach) ** 2 + limit**2 + tried**2 / c.square
    low, high, v = np.zeros(n), np.full(n, np.inf), np.zeros(n)
    phi = np.zeros(n)
    for _ in range(2 * TURNS):
        ends = _at_multiplier(c, phi, reach, limit, tried, v)
        v, rest = ends.lost, ends.shear**2 / c.square + ends.pressure * (ends.pressure - ends.limit)
        done = np.abs(rest) <= PRECISION * size
        if done.all():
            break
        low, high = np.where(rest > 0, phi, low), np.where(rest < 0, phi, high)
        vv, vp, fv, fp, _ = _slopes(c, ends)
        df = fp - fv * vp / vv
        step = phi - rest / np.where(df < 0, df, -np.inf)
        middle = np.where(np.isfinite(high), 0.5 * (low + high), np.maximum(2 * low, 1e-6 / limit))
        inside = (step > low) & (step < high) & (df < 0)
        phi = np.where(done, phi, np.where(inside, step, middle))
    return ends


def respond(
    parameters: PointParameters, stress: FloatArray, strain: FloatArray, variables: FloatArray
) -> Response:
    """Modified Cam-Clay (see the head of this module)."""
    c = clay_of(parameters)
    _, before = mises(stress)
    start = c.strain(-stress[:, :3].sum(axis=1) / 3)
    reach = start - strain[:, :3].sum(axis=1)
    own = before + 2 * c.shear[:, None] * (strain @ DEVIATOR)
    tried, _ = mises(own)
    limit = parameters["P0"] * np.exp(c.hard * variables[:, 1])
    p = c.pressure(reach)
    over = tried**2 / c.square + p * (p - limit)
    found = own - p[:, None] * UNIT
    tangent = 2 * c.shear[:, None, None] * DEVIATOR
    tangent = tangent + c.bulk(p)[:, None, None] * np.outer(UNIT, UNIT)
    elastic, kept = strain.copy(), variables.copy()
    rows = np.flatnonzero(over > PRECISION * (p**2 + limit**2 + tried**2 / c.square))
    if len(rows):
        some = c.at(rows)
        ends = _returned(some, reach[rows], limit[rows], tried[rows])
        a = 1 + 6 * some.shear * ends.phi / some.square
        own = own[rows] / a[:, None]
        found[rows] = own - ends.pressure[:, None] * UNIT
        flow = (3 * ends.phi / some.square)[:, None] * own - (ends.lost / 3)[:, None] * UNIT
        square = (flow[:, :3] ** 2).sum(axis=1) + 2 * (flow[:, 3:] ** 2).sum(axis=1)
        kept[rows, 0] += np.sqrt(2 / 3 * square)
        kept[rows, 1] += ends.lost
        flow[:, 3:] *= 2.0  # engineering shears
        elastic[rows] -= flow
        tangent[rows] = _tangent(some, ends, own * a[:, None], tried[rows])
    return Response(found, kept, tangent, elastic)


def _tangent(c: Clay, e: Ends, own: FloatArray, tried: FloatArray) -> FloatArray:
    """Derivative of the stress by the step of strain: arrays (m, 6, 6)."""
    a = 1 + 6 * c.shear * e.phi / c.square
    # unknowns v and phi; what a compression dE and a rise of q trial change in both equations
    (vv, vp, fv, fp, q_phi), bulk = _slopes(c, e), c.bulk(e.pressure)
    ve, fe, fq = -2 * e.phi * bulk, -vp * bulk, 2 * e.shear / c.square / a
    det = vv * fp - vp * fv
    v_e, phi_e = -(fp * ve - vp * fe) / det, -(vv * fe - fv * ve) / det
    v_q, phi_q = vp * fq / det, -vv * fq / det
    p_e, p_q = bulk * (1 - v_e), -bulk * v_q
    q_e, q_q = q_phi * phi_e, 1 / a + q_phi * phi_q
    n = own / np.where(tried > 0, tried, 1.0)[:, None]
    turn = 3 * c.shear[:, None] * n  # q trial by strain
    outer = np.einsum("mi,mj->mij", n, (q_q - 1 / a)[:, None] * turn - q_e[:, None] * UNIT)
    round_ = np.einsum("i,mj->mij", UNIT, p_e[:, None] * UNIT - p_q[:, None] * turn)
    return np.asarray((2 * c.shear / a)[:, None, None] * DEVIATOR + outer + round_)


def locked(p: PointParameters, stress: FloatArray, variables: FloatArray) -> FloatArray:
    """What the elasticity stores beyond the energy of YOUN and NU (m,), J/m3."""
    c = clay_of(p)
    q, _ = mises(stress)
    pressure = -stress[:, :3].sum(axis=1) / 3
    inner = np.minimum(pressure, c.least)
    volume = inner**2 / (2 * c.soft * c.least) + np.maximum(pressure - c.least, 0.0) / c.soft
    linear = 0.5 * np.einsum("mi,mij,mj->m", stress, p.compliance, stress)
    return np.asarray(volume + q**2 / (6 * c.shear) - linear)


def check(p: PointParameters) -> None:
    """Refuse clay without an ellipse, or with a cohesion."""
    if (p["COHE"] != 0).any():
        worst = np.abs(p["COHE"]).max()
        raise MaterialError("kernel.materials.clay-cohesion", value=worst).about("COHE")
    require("CAM_CLAY", p, {"E0 >= 0": p["E0"] >= 0, "KAPA < LAMD": p["KAPA"] < p["LAMD"]})
