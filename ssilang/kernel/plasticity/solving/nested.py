"""Compiled passes over zones that yield by nested surfaces (`materials.plastic.iwan`).

Nearly all points flow at all times, on the first of their surfaces; those that stay inside a part's
surface cost a comparison.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fused
from ssilang.kernel.materials.plastic.iwan import (
    LOST,
    STRAIN,
    Nested,
    locked_over,
    surfaces_point,
)
from ssilang.kernel.plasticity.solving.blocks import (
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


@compiled_fused
def _returned(
    nested: Nested, at: int, x: int, space: Space, old: FloatArray, new: FloatArray, tangent: bool
) -> float:
    """The law at a point, lane x: its stress in `space.s`; how far it is beyond a surface at most.

    Internal variables go to `new` (m, k) if it has rows, the tangent to the first rows of
    `space.point` if it is asked for.
    """
    room, trial = space.point, space.trial
    for i in range(6):
        room[STRAIN, i] = space.e[i, x]
    trace = trial[0, x] + trial[1, x] + trial[2, x]
    most = surfaces_point(nested, at, trace, old, new, room, tangent)
    for i in range(6):
        space.s[i, x] = trial[i, x] - room[LOST, i]
    return most


@compiled_fused
def flow_over(cells: Cells, nested: Nested, step: Step, force: FloatArray, space: Space) -> None:
    """Add to `force` (n,) what flow takes away from the forces in a step.

    All its strain has a stress: `step.freed` has no rows, and no variables are kept.
    """
    m, n_lanes, start = len(cells.weights), cells.terms.shape[2], step.start
    old = start.points.variables
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        trial_stresses(start, first, n, space)
        for x in range(n):
            _returned(nested, first + x, x, space, old, step.freed, False)
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
    components, old, tangent, work = cells.components, start.points.variables, len(D) > 0, 0.0
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        strains(cells, block, first, n, step, space)
        trial_stresses(start, first, n, space)
        for x in range(n):
            at = first + x
            most = _returned(nested, at, x, space, old, new.variables, tangent)
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
        found = np.empty(len(self.cells.weights))
        locked_over(self.law, start.points.variables, found)
        return float(found @ self.cells.weights)
