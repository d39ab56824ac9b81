"""Compiled passes over zones whose law is a cone of revolution (`materials.plastic.cone`).

The law is asked point by point where stresses without flow pass their surface, and nowhere else.
"""

import math

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import compiled_fused, compiled_inline
from ssilang.kernel.materials.plastic.cone import (
    ConeColumn,
    ConeRows,
    cone_point,
    cone_tangent,
    strength_at,
)
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

SURE = -1e-9
"""Stresses that are further inside their surface (of those at play) are not asked if they flow."""
ALPHA, BETA, STRENGTH = 2, 3, 4
"""Rows of `Start.given`: coefficients of trace and q on the surface, strength."""


@compiled_fused
def prepare(cone: ConeRows, p: FloatArray, given: FloatArray) -> None:
    """Fill `given` (5, m) of `Start` for cumulated strains p (m,)."""
    for at in range(len(p)):
        c = cone.rows[cone.of[at]]
        given[SHEAR, at], given[BULK, at] = c[ConeColumn.SHEAR], c[ConeColumn.BULK]
        given[ALPHA, at], given[BETA, at] = c[ConeColumn.ALPHA], c[ConeColumn.BETA]
        given[STRENGTH, at] = strength_at(cone, cone.of[at], p[at])[0]


@apart
@compiled_fused
def _elastic(start: Start, first: int, n: int, space: Space) -> None:
    """Stresses without flow, from the surfaces' centres, and how far they are beyond them."""
    end = first + n
    trial_stresses(start, first, n, space)
    for i in range(6):
        s, t = space.s[i], space.trial[i]
        for x in range(n):
            s[x] = t[x]
    if len(start.points.variables) > 1:
        for i in range(6):
            s, centre = space.s[i], start.points.variables[1 + i, first:end]
            for x in range(n):
                s[x] -= centre[x]
    _beyond(start, first, n, space)


@compiled_fused
def _beyond(start: Start, first: int, n: int, space: Space) -> None:
    """How far stresses `space.s` are beyond their surfaces, of the stresses at play."""
    alpha, beta = start.given[ALPHA, first : first + n], start.given[BETA, first : first + n]
    K, found = start.given[STRENGTH, first : first + n], space.beyond
    s0, s1, s2 = space.s[0], space.s[1], space.s[2]
    s3, s4, s5 = space.s[3], space.s[4], space.s[5]
    for x in range(n):
        trace = s0[x] + s1[x] + s2[x]
        d0, d1, d2 = s0[x] - trace / 3.0, s1[x] - trace / 3.0, s2[x] - trace / 3.0
        square = d0 * d0 + d1 * d1 + d2 * d2
        square += 2.0 * (s3[x] * s3[x] + s4[x] * s4[x] + s5[x] * s5[x])
        q = beta[x] * math.sqrt(1.5 * square)
        size = abs(K[x]) + q + abs(alpha[x] * trace)
        found[x] = (alpha[x] * trace + q - K[x]) / (size + 1e-300)


@compiled_inline
def _returned(cone: ConeRows, start: Start, at: int, x: int, space: Space, tangent: bool) -> float:
    """The law at a point, lane x: its stress becomes one on the surface; its cumulated strain."""
    s, room, variables = space.s, space.point, start.points.variables
    for i in range(6):
        room[0, i] = s[i, x]
    p = cone_point(cone, cone.of[at], room[0], variables[0, at], room[1], room[2], tangent)
    for i in range(6):
        s[i, x] = room[0, i]
    return p


@compiled_inline
def _flowed(
    c: FloatArray, start: Start, at: int, x: int, p: float, new: Points, space: Space
) -> None:
    """State of a point, lane x, that has flowed to the cumulated strain p."""
    N, old = space.point[1], start.points
    H = c[ConeColumn.KINEMATIC] * (p - old.variables[0, at]) / 1.5
    new.variables[0, at] = p
    for i in range(1, len(old.variables)):
        new.variables[i, at] = old.variables[i, at] + H * N[i - 1]
    # what is elastic of the strain that made the stress without flow is lost from there to s
    G, mean = c[ConeColumn.SHEAR], 0.0
    for i in range(3):
        mean += (space.trial[i, x] - space.s[i, x]) / 3.0
    own = mean / (3.0 * c[ConeColumn.BULK])
    for i in range(3):
        lost = space.trial[i, x] - space.s[i, x]
        new.plastic[i, at] = old.plastic[i, at] + own + (lost - mean) / (2.0 * G)
        lost = space.trial[3 + i, x] - space.s[3 + i, x]
        new.plastic[3 + i, at] = old.plastic[3 + i, at] + lost / G


@compiled_fused
def flow_over(cells: Cells, cone: ConeRows, step: Step, force: FloatArray, space: Space) -> None:
    """Add to `force` (n,) what flow takes away from the forces in a step."""
    m, p, n_lanes, start = len(cells.weights), points_of(cells), cells.terms.shape[2], step.start
    first_term, rows, components = cells.start, cells.rows, cells.components
    moves = len(start.points.variables) > 1
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        _elastic(start, first, n, space)
        for x in range(n):
            at = first + x
            if space.beyond[x] < SURE:
                continue
            if _returned(cone, start, at, x, space, False) == start.points.variables[0, at]:
                continue
            for a in range(len(components)):
                i = components[a]
                value = space.s[i, x] - space.trial[i, x]
                value += start.points.variables[1 + i, at] if moves else 0.0
                value *= cells.weights[at]
                for t in range(first_term[a], first_term[a + 1]):
                    force[cells.places[at // p, rows[t]]] += cells.terms[block, t, x] * value


@compiled_fused
def pass_over(
    cells: Cells, cone: ConeRows, step: Step, new: Points, force: FloatArray, D: FloatArray,
    beyond: FloatArray, space: Space,
) -> float:  # fmt: skip
    """The state after a step, its forces added to `force` (n,).

    Parameters
    ----------
    new : Points
        Plastic strains and variables are those of the start, and changed where points flow.
    D : array (m, n_strains, n_strains)
        Filled with the tangents, unless it has no rows.
    beyond : array (n_cells,)
        How far stresses without flow are beyond their surfaces at most, of the stresses at play.

    Returns
    -------
    work : float
        Of the stresses over the step (average of both ends).
    """
    m, p, n_lanes, start = len(cells.weights), points_of(cells), cells.terms.shape[2], step.start
    variables, tangent, work = start.points.variables, len(D) > 0, 0.0
    moves = len(variables) > 1
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        _elastic(start, first, n, space)
        for k in range(n // p):
            most = -1.0
            for j in range(p):
                most = max(most, space.beyond[k * p + j])
            beyond[first // p + k] = most
        for x in range(n):
            at = first + x
            if space.beyond[x] < SURE and not tangent:
                continue
            grown = _returned(cone, start, at, x, space, tangent)
            if moves:
                for i in range(6):
                    space.s[i, x] += variables[1 + i, at]
            if grown > variables[0, at]:
                _flowed(cone.rows[cone.of[at]], start, at, x, grown, new, space)
            if tangent:
                cone_tangent(space.point[1], space.point[2], cells.components, D[at])
            space.beyond[x] = 1.0
        if moves:
            for i in range(6):
                for x in range(n):
                    if space.beyond[x] < SURE:
                        space.s[i, x] = space.trial[i, x]
        work += stressed(cells, start, first, n, new, space)
        forces(cells, block, first, n, force, space)
    return work


class ConePass(ZonePass):
    """The passes of a zone whose law is a cone."""

    law: ConeRows
    pass_over = staticmethod(pass_over)
    pass_flow_over = staticmethod(flow_over)

    def of(self, which: IntArray) -> "ConePass":
        """A pass over some cells: it reads their points of the zone's states."""
        cells, points = self.some(which)
        return ConePass(cells, self.law._replace(of=self.law.of[points]), points)

    def given(self, points: Points) -> FloatArray:
        """Moduli, coefficients of the surface, strength."""
        found = np.empty((5, points.stress.shape[1]))
        prepare(self.law, points.variables[0], found)
        return found
