"""Compiled passes over zones that yield by nested surfaces (`materials.plastic.iwan`).

Nearly all points flow at all times, on the first of their surfaces; those that stay inside a part's
surface cost a comparison.
"""

import math
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fused
from ssilang.kernel.materials.plastic.backbone import Backbones
from ssilang.kernel.materials.plastic.iwan import LEAST, PRESSURE
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.plasticity.solving.blocks import (
    BULK,
    SHEAR,
    Cells,
    Points,
    Space,
    Start,
    Step,
    ZonePass,
    forces,
    points_of,
    strains,
    stressed,
    trial_stresses,
)

PART, BY_FACTOR = 6, 7
"""Rows of `Space.point` behind the tangent: deviator of a part, stresses by the factor."""


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


def nested_of(parts: Backbones, parameters: PointParameters) -> Nested:
    """The parts of a zone's points."""
    shear = parameters.shear
    pressure = parameters.values.get(PRESSURE, np.zeros(len(shear)))
    moduli = np.stack([shear, parameters.bulk, pressure])
    return Nested(parts.strains, parts.shares, parts.which, moduli)


@compiled_fused
def _factor(start: Start, at: int, x: int, space: Space) -> tuple[float, float]:
    """Factor of the strengths, and its derivative by the trace of the strain."""
    pressure = start.given[2, at]
    if pressure <= 0.0:
        return 1.0, 0.0
    share = -(space.trial[0, x] + space.trial[1, x] + space.trial[2, x]) / (3.0 * pressure)
    if share > LEAST:
        return share, -start.given[BULK, at] / pressure
    return LEAST, 0.0


@compiled_fused
def _returned(
    nested: Nested, start: Start, at: int, x: int, space: Space, new: FloatArray, tangent: bool
) -> float:
    """The law at a point, lane x: its stress in `space.s`; how far it is beyond a surface at most.

    Internal variables go to `new` (m, k) if it has rows, the tangent to the first rows of
    `space.point` if it is asked for.
    """
    G, curve, old = start.given[SHEAR, at], nested.which[at], start.points.variables
    e, D, kept = space.e, space.point, len(new) > 0
    mean = (e[0, x] + e[1, x] + e[2, x]) / 3.0
    exx, eyy, exy, exz, eyz = e[0, x] - mean, e[1, x] - mean, e[3, x], e[4, x], e[5, x]
    factor, rate = _factor(start, at, x, space)
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
            lost = 1.0 - left
            pxx += lost * txx
            pyy += lost * tyy
            pxy += lost * txy
            pxz += lost * txz
            pyz += lost * tyz
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
    s, trial = space.s, space.trial
    s[0, x], s[1, x] = trial[0, x] - pxx, trial[1, x] - pyy
    s[2, x], s[3, x] = trial[2, x] + pxx + pyy, trial[3, x] - pxy
    s[4, x], s[5, x] = trial[4, x] - pxz, trial[5, x] - pyz
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
                D[j, k] += start.given[BULK, at] - stiff / 3.0
            D[j, j] += stiff
            D[j + 3, j + 3] += 0.5 * stiff
        if rate != 0.0:
            for j in range(6):
                for k in range(3):
                    D[j, k] += D[BY_FACTOR, j] * rate
    return most


@compiled_fused
def flow_over(cells: Cells, nested: Nested, step: Step, force: FloatArray, space: Space) -> None:
    """Add to `force` (n,) what flow takes away from the forces in a step.

    All its strain has a stress: `step.freed` has no rows, and no variables are kept.
    """
    m, n_lanes, start = len(cells.weights), cells.terms.shape[2], step.start
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        trial_stresses(start, first, n, space)
        for x in range(n):
            _returned(nested, start, first + x, x, space, step.freed, False)
        for i in range(6):
            for x in range(n):
                space.s[i, x] -= space.trial[i, x]
        forces(cells, block, first, n, force, space)


@compiled_fused
def pass_over(
    cells: Cells, nested: Nested, step: Step, new: Points, force: FloatArray, D: FloatArray,
    beyond: FloatArray, space: Space,
) -> float:  # fmt: skip
    """The state after a step, its forces added to `force` (n,).

    Parameters
    ----------
    new : Points
        Plastic strains are those of the start, and changed where points flow.
    D : array (m, n_strains, n_strains)
        Filled with the tangents, unless it has no rows.
    beyond : array (n_cells,)
        How far stresses are beyond a surface at most, 1 where a part flows.

    Returns
    -------
    work : float
        Of the stresses over the step (average of both ends).
    """
    m, p, n_lanes, start = len(cells.weights), points_of(cells), cells.terms.shape[2], step.start
    components, tangent, work = cells.components, len(D) > 0, 0.0
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        trial_stresses(start, first, n, space)
        for x in range(n):
            at = first + x
            most = _returned(nested, start, at, x, space, new.variables, tangent)
            cell = at // p
            beyond[cell] = most if x % p == 0 else max(beyond[cell], most)
            G = start.given[SHEAR, at]
            for i in range(6):
                lost = space.trial[i, x] - space.s[i, x]
                new.plastic[i, at] += lost / (2.0 * G if i < 3 else G)
            if tangent:
                for a in range(len(components)):
                    for b in range(len(components)):
                        D[at, a, b] = space.point[components[a], components[b]]
        work += stressed(cells, start, first, n, new, space)
        forces(cells, block, first, n, force, space)
    return work


@compiled_fused
def locked_over(cells: Cells, nested: Nested, start: Start) -> float:
    """Elastic energy of the parts beyond that of the stresses that they make together."""
    v, total = start.points.variables, 0.0
    for at in range(len(cells.weights)):
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
        total += cells.weights[at] * 0.25 * (own - together) / start.given[SHEAR, at]
    return total


class NestedPass(ZonePass):
    """The passes of a zone that yields by nested surfaces; its internal variables go by points."""

    law: Nested
    pass_over = staticmethod(pass_over)
    pass_flow_over = staticmethod(flow_over)

    def of(self, which: IntArray) -> "NestedPass":
        """A pass over some cells: it reads their points of the zone's states."""
        cells, points = self.some(which)
        own = self.law
        moduli = np.ascontiguousarray(own.moduli[:, points])
        return NestedPass(cells, own._replace(which=own.which[points], moduli=moduli), points)

    def given(self, points: Points) -> FloatArray:
        """Moduli, pressure at which the curves hold."""
        return self.law.moduli

    def variables(self, values: FloatArray) -> FloatArray:
        """Internal variables (m, k)."""
        return np.ascontiguousarray(values if self._points is None else values[self._points])

    def kept(self, variables: FloatArray) -> FloatArray:
        """Internal variables (m, k)."""
        return variables

    def locked(self, start: Start) -> float:
        """Energy of the parts beyond that of the stresses."""
        return locked_over(self.cells, self.law, start)
