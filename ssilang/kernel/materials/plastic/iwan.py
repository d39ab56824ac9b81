"""Cyclic soil by nested surfaces: Iwan's parts side by side, von Mises in each.

The soil is a bundle of elastic, perfectly plastic parts that share the strain. In simple shear the
first loading follows a polygon through the points of a curve of G/Gmax, unloading and reloading
twice that polygon (Masing); the volume stays elastic. W. D. Iwan, On a class of models for the
yielding behavior of continuous and composite systems, J. Appl. Mech. 34 (1967) 612-617; in space,
surfaces of von Mises one inside the other as in Z. Mroz (1967) and J. H. Prevost (1978). The parts
have associated flow and no hardening: dissipation is never negative, the tangent symmetric.

Where pressure counts, all strengths are in proportion to it: cones one inside the other, with flow
that keeps the volume; the modulus stays.
"""

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fused
from ssilang.kernel.materials.plastic.backbone import Backbones, backbones, break_points
from ssilang.kernel.materials.plastic.response import PointParameters, Response

CURVE = "GGAM"
"""The parameter: a curve of G/Gmax over the shear strain."""
PRESSURE = "PREF"
"""The pressure at which the curve holds."""
LEAST = 0.01
"""Share of the strengths that no loss of pressure takes away: a stiffness is left in tension."""
_COMPONENTS = ("XX", "YY", "XY", "XZ", "YZ")
"""Of each part's deviator; ZZ is what brings the trace to zero."""
PART, BY_FACTOR, STRAIN, LOST, ROWS = 6, 7, 8, 9, 10
"""Rows of a point's room behind the tangent: deviator of a part, stresses by the factor of the
strengths, strain of the step (given), stress that flow takes away; their number."""


class Nested(NamedTuple):
    """Parts side by side at the points of a zone.

    Attributes
    ----------
    strains, shares : array (n_curves, n)
        Shear strain at which each part yields, and its share of the modulus.
    which : array (m,)
        Curve of each point.
    moduli : array (3, m)
        Shear and bulk modulus, pressure at which the curve holds (0: it holds at any).
    """

    strains: FloatArray
    shares: FloatArray
    which: IntArray
    moduli: FloatArray


def check(parameters: PointParameters) -> None:
    """Refuse curves that no soil has."""
    for curve in parameters.curves[CURVE][0]:
        break_points(curve)


def variables(parts: Backbones) -> tuple[str, ...]:
    """EPSE, then the deviators of the parts: XX01 YY01 XY01 XZ01 YZ01 XX02 ..."""
    n = parts.shares.shape[1]
    inner = [f"{c}{i:02d}" for i in range(1, n + 1) for c in _COMPONENTS]
    return ("EPSE", *inner)


def parts_of(parameters: PointParameters) -> Backbones:
    """The parts that the curves ask for."""
    return backbones(*parameters.curves[CURVE])


def nested_of(parts: Backbones, parameters: PointParameters) -> Nested:
    """The parts of a zone's points."""
    shear = parameters.shear
    pressure = parameters.values.get(PRESSURE, np.zeros(len(shear)))
    moduli = np.stack([shear, parameters.bulk, pressure])
    return Nested(parts.strains, parts.shares, parts.which, moduli)


def respond(
    parts: Backbones,
    parameters: PointParameters,
    stress: FloatArray,
    strain: FloatArray,
    variables: FloatArray,
) -> Response:
    """The deviator is the sum over the parts; variables EPSE and the parts' deviators.

    A stress that no part bears (given from outside) stays as it is.
    """
    after, inner, tangent = stress.copy(), variables.copy(), np.empty((len(stress), 6, 6))
    nested, room = nested_of(parts, parameters), np.empty((ROWS, 6))
    _return(nested, np.ascontiguousarray(strain), after, inner, tangent, room)
    return Response(after, inner, tangent)


@compiled_fused
def _return(
    nested: Nested,
    strain: FloatArray,
    stress: FloatArray,
    variables: FloatArray,
    tangent: FloatArray,
    room: FloatArray,
) -> None:
    """A step of strain (m, 6): stress (m, 6) and variables (m, k) are brought up to date."""
    for at in range(len(strain)):
        G, B, s = nested.moduli[0, at], nested.moduli[1, at], stress[at]
        volume = strain[at, 0] + strain[at, 1] + strain[at, 2]
        mean = (B - 2.0 / 3.0 * G) * volume
        for j in range(6):
            room[STRAIN, j] = strain[at, j]
            s[j] += mean + 2.0 * G * strain[at, j] if j < 3 else G * strain[at, j]
        surfaces_point(nested, at, s[0] + s[1] + s[2], variables, variables, room, True)
        for j in range(6):
            s[j] -= room[LOST, j]
            for k in range(6):
                tangent[at, j, k] = room[j, k]


@compiled_fused
def _factor(pressure: float, bulk: float, trace: float) -> tuple[float, float]:
    """Factor of the strengths under a trial stress, its derivative by the trace of the strain."""
    if pressure <= 0.0:
        return 1.0, 0.0
    share = -trace / (3.0 * pressure)
    if share > LEAST:
        return share, -bulk / pressure
    return LEAST, 0.0


@compiled_fused
def surfaces_point(
    nested: Nested,
    at: int,
    trace: float,
    old: FloatArray,
    new: FloatArray,
    room: FloatArray,
    tangent: bool,
) -> float:
    """The return at a point: how far it is beyond a surface at most, 1 where a part flows.

    Part i, of shear modulus G_i, has a deviator s_i with `s_i : s_i <= 2 (G_i c_i f)^2`: radial
    return, exact where the strain goes straight.

    Parameters
    ----------
    trace : float
        Of the stress without flow.
    old, new : array (m, k)
        Internal variables; `new` may be `old`, and is filled if it has rows.
    room : array (ROWS, 6)
        STRAIN is read, LOST filled; with `tangent` the first six rows are the tangent.
    """
    G, B, pressure = nested.moduli[0, at], nested.moduli[1, at], nested.moduli[2, at]
    curve, D, kept = nested.which[at], room, len(new) > 0
    e, lost = room[STRAIN], room[LOST]
    mean = (e[0] + e[1] + e[2]) / 3.0
    exx, eyy, exy, exz, eyz = e[0] - mean, e[1] - mean, e[3], e[4], e[5]
    factor, rate = _factor(pressure, B, trace)
    pxx = pyy = pxy = pxz = pyz = 0.0
    stiff, most = 0.0, -1.0
    if tangent:
        for j in range(6):
            D[BY_FACTOR, j] = 0.0
            for k in range(6):
                D[j, k] = 0.0
    for i in range(nested.shares.shape[1]):
        own = nested.shares[curve, i] * G
        if own == 0.0:
            continue
        place = 1 + 5 * i
        txx = old[at, place] + 2.0 * own * exx
        tyy = old[at, place + 1] + 2.0 * own * eyy
        txy = old[at, place + 2] + own * exy
        txz = old[at, place + 3] + own * exz
        tyz = old[at, place + 4] + own * eyz
        tzz = -txx - tyy
        square = txx * txx + tyy * tyy + tzz * tzz
        square += 2.0 * (txy * txy + txz * txz + tyz * tyz)
        first = own * nested.strains[curve, i]
        limit, left = first * factor, 1.0
        if square > 2.0 * limit * limit:
            size = math.sqrt(0.5 * square)
            left = limit / size
            gone = 1.0 - left
            pxx += gone * txx
            pyy += gone * tyy
            pxy += gone * txy
            pxz += gone * txz
            pyz += gone * tyz
            most = 1.0
            if tangent:
                D[PART, 0], D[PART, 1], D[PART, 2] = txx, tyy, tzz
                D[PART, 3], D[PART, 4], D[PART, 5] = txy, txz, tyz
                turning, rise = own * left / (size * size), first / size
                for j in range(6):
                    D[BY_FACTOR, j] += rise * D[PART, j]
                    for k in range(j + 1):
                        D[j, k] -= turning * D[PART, j] * D[PART, k]
        elif most < 0.0:
            most = max(most, (square - 2.0 * limit * limit) / (square + 2.0 * limit * limit))
        stiff += 2.0 * own * left
        if kept:
            new[at, place], new[at, place + 1] = left * txx, left * tyy
            new[at, place + 2], new[at, place + 3] = left * txy, left * txz
            new[at, place + 4] = left * tyz
    lost[0], lost[1], lost[2] = pxx, pyy, -pxx - pyy
    lost[3], lost[4], lost[5] = pxy, pxz, pyz
    if kept:
        plastic = pxx * pxx + pyy * pyy + (pxx + pyy) * (pxx + pyy)
        plastic += 2.0 * (pxy * pxy + pxz * pxz + pyz * pyz)
        new[at, 0] = old[at, 0] + math.sqrt(plastic / 6.0) / G
    if tangent:
        for j in range(6):
            for k in range(j):
                D[k, j] = D[j, k]
        for j in range(3):
            for k in range(3):
                D[j, k] += B - stiff / 3.0
            D[j, j] += stiff
            D[j + 3, j + 3] += 0.5 * stiff
        if rate != 0.0:
            for j in range(6):
                for k in range(3):
                    D[j, k] += D[BY_FACTOR, j] * rate
    return most


def locked(
    parts: Backbones, parameters: PointParameters, stress: FloatArray, variables: FloatArray
) -> FloatArray:
    """Elastic energy (m,) of the parts beyond that of the stress that they make together."""
    found = np.empty(len(stress))
    locked_over(nested_of(parts, parameters), np.ascontiguousarray(variables), found)
    return found


@compiled_fused
def locked_over(nested: Nested, v: FloatArray, found: FloatArray) -> None:
    """`locked` of internal variables v (m, k), into `found` (m,)."""
    for at in range(len(found)):
        xx = yy = xy = xz = yz = own = 0.0
        for i in range(nested.shares.shape[1]):
            share, place = nested.shares[nested.which[at], i], 1 + 5 * i
            if share <= 0.0:
                continue
            a, b, c = v[at, place], v[at, place + 1], v[at, place + 2]
            d, e = v[at, place + 3], v[at, place + 4]
            square = a * a + b * b + (a + b) * (a + b) + 2.0 * (c * c + d * d + e * e)
            own += square / share
            xx += a
            yy += b
            xy += c
            xz += d
            yz += e
        together = xx * xx + yy * yy + (xx + yy) * (xx + yy)
        together += 2.0 * (xy * xy + xz * xz + yz * yz)
        found[at] = 0.25 * (own - together) / nested.moduli[0, at]


def slid_last(
    parts: Backbones,
    parameters: PointParameters,
    stress: FloatArray,
    plastic: FloatArray,
    variables: FloatArray,
) -> FloatArray:
    """Slip (m, 5) of the last part to yield, in shear strains over its threshold.

    Other than before a run where the strain was beyond the last point of the curve on the way.
    """
    last = np.array([np.flatnonzero(share)[-1] for share in parts.shares])[parts.which]
    m = np.arange(len(stress))
    bears = variables[:, 1:].reshape(len(stress), -1, 5)[m, last]
    own = parts.shares[parts.which, last] * parameters.shear
    kept = [0, 1, 3, 4, 5]
    mean = np.array([1.0, 1.0, 0.0, 0.0, 0.0]) / 3.0
    elastic = stress[:, kept] - stress[:, :3].sum(axis=1)[:, None] * mean
    flown = plastic[:, kept] - plastic[:, :3].sum(axis=1)[:, None] * mean
    flown[:, 2:] *= 0.5
    slip = elastic / (2.0 * parameters.shear)[:, None] + flown - bears / (2.0 * own)[:, None]
    return 2.0 * slip / parts.strains[parts.which, last][:, None]
