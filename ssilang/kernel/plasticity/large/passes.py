"""One compiled pass over the elements of a zone: strains, law, forces, and the tangents if asked.

For laws that are rows of numbers (`materials.plastic.cone_rows`) in bodies without held stresses.
Nothing of the size of all points is made but the state itself.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import (
    compiled_fast,
    compiled_fused,
    compiled_inline,
)
from ssilang.kernel.materials.plastic.cone_rows import (
    ConeColumn,
    ConeRows,
    cone_point,
    cone_rows,
    strength_at,
)
from ssilang.kernel.plasticity.points import PlasticPoints, PointState

_NO_TANGENTS, _NO_ROWS = np.zeros((0, 0, 0)), np.zeros((0, 6))
LANES = 32
"""Points that are worked on together, those of whole cells."""
SURE = -1e-9
"""Stresses that are further inside their surface (of those at play) are not asked if they flow."""
SHEAR, BULK, ALPHA, BETA, STRENGTH = range(5)
"""Rows of `Start.given`."""


class Cells(NamedTuple):
    """What a pass reads of a zone, whose cells stand in blocks of some `LANES` points.

    Attributes
    ----------
    terms : array (n_blocks, n_terms, n_lanes)
        Terms of the strain operator that are not zero everywhere, strain after strain.
    start : array (n_strains + 1,)
        Where those of each strain begin.
    rows : array (n_terms,)
        The row of the element vector that each belongs to.
    weights : array (m,)
    places : array (n_cells, n_rows)
        Unknowns.
    components : array (n_strains,)
        Where the strains stand in the tensor XX YY ZZ XY XZ YZ.
    """

    terms: FloatArray
    start: IntArray
    rows: IntArray
    weights: FloatArray
    places: NDArray[np.int32]
    components: IntArray


def cells_of(points: PlasticPoints, places: NDArray[np.int32]) -> Cells:
    """A zone as passes read it."""
    strain, row = np.nonzero(points.B.any(axis=(0, 2)))
    counts = np.bincount(strain, minlength=points.B.shape[1])
    return Cells(
        _in_blocks(points.B[:, strain, :, row].transpose(1, 0, 2)),
        np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        row.astype(np.int64),
        np.ascontiguousarray(points.weights).ravel(),
        places,
        np.array(points.components, np.int64),
    )


def _in_blocks(terms: FloatArray) -> FloatArray:
    """Terms (n_cells, n_terms, n_points) as blocks (n_blocks, n_terms, n_lanes); zeros fill up."""
    n, t, p = terms.shape
    own = max(LANES // p, 1)
    made = np.zeros((-(-n // own), t, own, p))
    block, at = np.divmod(np.arange(n), own)
    made[block, :, at] = terms
    return made.reshape(len(made), t, own * p)


def some_cells(cells: Cells, which: IntArray) -> Cells:
    """Some cells of a zone as a zone."""
    n_cells, p = len(cells.places), _points_of_a_cell(cells)
    blocks, t, lanes = cells.terms.shape
    block, at = np.divmod(which, lanes // p)
    terms = cells.terms.reshape(blocks, t, lanes // p, p)[block, :, at]
    weights = cells.weights.reshape(n_cells, p)[which].ravel()
    return cells._replace(terms=_in_blocks(terms), weights=weights, places=cells.places[which])


def _points_of_a_cell(cells: Cells) -> int:
    return len(cells.weights) // max(len(cells.places), 1)


class Points(NamedTuple):
    """State of all points: stress, plastic strain (6, m), internal variables (k, m)."""

    stress: FloatArray
    plastic: FloatArray
    variables: FloatArray


class Start(NamedTuple):
    """What a step begins with.

    Attributes
    ----------
    points : Points
    given : array (5, m)
        Shear and bulk modulus, coefficients of trace and q on the surface, strength.
    """

    points: Points
    given: FloatArray


class Space(NamedTuple):
    """Working space of a pass: compiled code that makes arrays counts references to all of them.

    Displacements and forces (n_rows, n_lanes) of the cells of a block; strains, stresses without
    flow and stresses (6, n_lanes), how far the former are beyond their surfaces (n_lanes,); an
    element's matrix, and its rows; room (6, 6) for the law of a point.
    """

    u: FloatArray
    f: FloatArray
    e: FloatArray
    trial: FloatArray
    s: FloatArray
    beyond: FloatArray
    K: FloatArray
    left: FloatArray
    point: FloatArray


def _space(cells: Cells) -> Space:
    rows, lanes = cells.places.shape[1], cells.terms.shape[2]
    return Space(
        np.zeros((rows, lanes)), np.zeros((rows, lanes)), np.zeros((6, lanes)),
        np.zeros((6, lanes)), np.zeros((6, lanes)), np.zeros(lanes), np.zeros((rows, rows)),
        np.zeros(rows), np.zeros((6, 6)),
    )  # fmt: skip


@compiled_fused
def prepare(cone: ConeRows, p: FloatArray, given: FloatArray) -> None:
    """Fill `given` (5, m) of `Start` for cumulated strains p (m,)."""
    for at in range(len(p)):
        c = cone.rows[cone.of[at]]
        given[SHEAR, at], given[BULK, at] = c[ConeColumn.SHEAR], c[ConeColumn.BULK]
        given[ALPHA, at], given[BETA, at] = c[ConeColumn.ALPHA], c[ConeColumn.BETA]
        given[STRENGTH, at] = strength_at(cone, cone.of[at], p[at])[0]


@compiled_fused
def _strains(
    cells: Cells, block: int, first: int, n: int, du: FloatArray, freed: FloatArray, space: Space
) -> None:
    """Strains of the points `first` to `first + n` of a block in a step du of displacement."""
    rows, start, places, p = cells.rows, cells.start, cells.places, _points_of(cells)
    for r in range(len(space.u)):
        u = space.u[r]
        for k in range(n // p):
            value = du[places[first // p + k, r]]
            for j in range(p):
                u[k * p + j] = value
    for a in range(len(cells.components)):
        e = space.e[cells.components[a]]
        for x in range(n):
            e[x] = 0.0
        for i in range(start[a], start[a + 1]):
            u, term = space.u[rows[i]], cells.terms[block, i]
            for x in range(n):
                e[x] += term[x] * u[x]
    if len(freed):
        for i in range(6):
            for x in range(n):
                space.e[i, x] -= freed[first + x, i]


@compiled_inline
def _points_of(cells: Cells) -> int:
    return len(cells.weights) // len(cells.places)


@compiled_fused
def _elastic(start: Start, first: int, n: int, space: Space) -> None:
    """Stresses without flow, and how far they are beyond their surfaces."""
    end, old = first + n, start.points.stress
    G, B = start.given[SHEAR, first:end], start.given[BULK, first:end]
    e0, e1, e2 = space.e[0], space.e[1], space.e[2]
    e3, e4, e5 = space.e[3], space.e[4], space.e[5]
    t0, t1, t2 = space.trial[0], space.trial[1], space.trial[2]
    t3, t4, t5 = space.trial[3], space.trial[4], space.trial[5]
    s0, s1, s2 = old[0, first:end], old[1, first:end], old[2, first:end]
    s3, s4, s5 = old[3, first:end], old[4, first:end], old[5, first:end]
    for x in range(n):
        volume = e0[x] + e1[x] + e2[x]
        mean = B[x] * volume - 2.0 / 3.0 * G[x] * volume
        t0[x] = s0[x] + mean + 2.0 * G[x] * e0[x]
        t1[x] = s1[x] + mean + 2.0 * G[x] * e1[x]
        t2[x] = s2[x] + mean + 2.0 * G[x] * e2[x]
    for x in range(n):
        t3[x] = s3[x] + G[x] * e3[x]
        t4[x] = s4[x] + G[x] * e4[x]
        t5[x] = s5[x] + G[x] * e5[x]
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
def _tangent(N: FloatArray, t: FloatArray, components: IntArray, D: FloatArray) -> None:
    """Tangent (n_strains, n_strains) from its factors (`cone_point`)."""
    for a in range(len(components)):
        i = components[a]
        for b in range(len(components)):
            j = components[b]
            value = t[2] * N[i] * N[j]
            if i < 3:
                value += t[3] * N[j]
            if j < 3:
                value += t[4] * N[i]
            if i < 3 and j < 3:
                value += t[0] - t[1] / 3.0
            if i == j:
                value += t[1] if i < 3 else 0.5 * t[1]
            D[a, b] = value


@compiled_fused
def flow_over(
    cells: Cells, cone: ConeRows, start: Start, du: FloatArray, nothing: FloatArray,
    force: FloatArray, space: Space,
) -> None:  # fmt: skip
    """Add to `force` (n,) what flow takes away from the forces in a step du (n,).

    `nothing` has no rows.
    """
    m, p, n_lanes = len(cells.weights), _points_of(cells), cells.terms.shape[2]
    first_term, rows, components = cells.start, cells.rows, cells.components
    moves = len(start.points.variables) > 1
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        _strains(cells, block, first, n, du, nothing, space)
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
    cells: Cells, cone: ConeRows, start: Start, du: FloatArray, freed: FloatArray, new: Points,
    force: FloatArray, D: FloatArray, beyond: FloatArray, space: Space,
) -> float:  # fmt: skip
    """The state after a step du (n,) of displacement, its forces added to `force` (n,).

    Parameters
    ----------
    freed : array (m, 6)
        Strain of the step without stress, or no rows.
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
    m, p, n_lanes = len(cells.weights), _points_of(cells), cells.terms.shape[2]
    variables, tangent, work = start.points.variables, len(D) > 0, 0.0
    moves = len(variables) > 1
    for block in range(len(cells.terms)):
        first = block * n_lanes
        n = min(n_lanes, m - first)
        _strains(cells, block, first, n, du, freed, space)
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
                _tangent(space.point[1], space.point[2], cells.components, D[at])
            space.beyond[x] = 1.0
        if moves:
            for i in range(6):
                for x in range(n):
                    if space.beyond[x] < SURE:
                        space.s[i, x] = space.trial[i, x]
        work += _stressed(cells, start, first, n, new, space)
        _forces(cells, block, first, n, force, space)
    return work


@compiled_fast
def _stressed(cells: Cells, start: Start, first: int, n: int, new: Points, space: Space) -> float:
    """Keep the stresses of a block; the work of the step."""
    w, total = cells.weights[first : first + n], 0.0
    for i in range(6):
        s, e = space.s[i], space.e[i]
        old, kept = start.points.stress[i, first : first + n], new.stress[i, first : first + n]
        work = 0.0
        for x in range(n):
            work += w[x] * (old[x] + s[x]) * e[x]
            kept[x] = s[x]
        total += work
    return 0.5 * total


@compiled_fast
def energy(cells: Cells, start: Start) -> float:
    """Elastic energy of the stresses."""
    s, total = start.points.stress, 0.0
    for x in range(len(cells.weights)):
        trace = s[0, x] + s[1, x] + s[2, x]
        square = s[0, x] * s[0, x] + s[1, x] * s[1, x] + s[2, x] * s[2, x]
        square += 2.0 * (s[3, x] * s[3, x] + s[4, x] * s[4, x] + s[5, x] * s[5, x])
        own = (square - trace * trace / 3.0) / (4.0 * start.given[SHEAR, x])
        total += cells.weights[x] * (own + trace * trace / (18.0 * start.given[BULK, x]))
    return total


@compiled_fused
def _forces(cells: Cells, block: int, first: int, n: int, force: FloatArray, space: Space) -> None:
    """Add the forces of a block's cells."""
    w, p, start = cells.weights[first : first + n], _points_of(cells), cells.start
    for r in range(len(space.f)):
        f = space.f[r]
        for x in range(n):
            f[x] = 0.0
    for a in range(len(cells.components)):
        s, value = space.s[cells.components[a]], space.beyond
        for x in range(n):
            value[x] = w[x] * s[x]
        for i in range(start[a], start[a + 1]):
            f, term = space.f[cells.rows[i]], cells.terms[block, i]
            for x in range(n):
                f[x] += term[x] * value[x]
    for k in range(n // p):
        for r in range(len(space.f)):
            total = 0.0
            for j in range(p):
                total += space.f[r, k * p + j]
            force[cells.places[first // p + k, r]] += total


@compiled_fused
def add_stiffness(
    cells: Cells, D: FloatArray, slots: NDArray[np.int32], data: FloatArray, space: Space
) -> None:
    """Add the element matrices of tangents (m, n_strains, n_strains) to the terms of a matrix.

    `slots` (n_cells, n_rows, n_rows) says which term each entry is part of.
    """
    n_cells, n_rows = cells.places.shape
    n_points, n_strains, n_lanes = _points_of(cells), len(cells.components), cells.terms.shape[2]
    start, rows = cells.start, cells.rows
    K, left = space.K, space.left
    for k in range(n_cells):
        for r in range(n_rows):
            for c in range(n_rows):
                K[r, c] = 0.0
        for j in range(n_points):
            at = k * n_points + j
            w, terms, x = cells.weights[at], cells.terms[at // n_lanes], at % n_lanes
            for a in range(n_strains):
                if start[a] == start[a + 1]:
                    continue
                for c in range(n_rows):
                    left[c] = 0.0
                for b in range(n_strains):
                    value = w * D[at, a, b]
                    for i in range(start[b], start[b + 1]):
                        left[rows[i]] += value * terms[i, x]
                for i in range(start[a], start[a + 1]):
                    value, r = terms[i, x], rows[i]
                    for c in range(n_rows):
                        K[r, c] += value * left[c]
        for r in range(n_rows):
            for c in range(n_rows):
                data[slots[k, r, c]] += K[r, c]


class Passed(NamedTuple):
    """What a pass gives: state, work over the step, `beyond` (n_cells,) as `pass_over` says."""

    stress: FloatArray
    plastic: FloatArray
    variables: FloatArray
    work: float
    beyond: FloatArray


class ZonePass:
    """The passes of a zone, or of some of its cells: those of `points`.

    States hold arrays (m, 6) whose columns passes read one after the other; those that they make
    are kept by columns.
    """

    def __init__(self, cells: Cells, cone: ConeRows, points: IntArray | None = None) -> None:
        self.cells, self.cone, self._points = cells, cone, points
        self._space = _space(cells)
        self._last: tuple[PointState, Start] | None = None

    def of(self, which: IntArray) -> ZonePass:
        """A pass over some cells: it reads their points of the zone's states."""
        p = _points_of_a_cell(self.cells)
        points: IntArray = (which[:, None] * p + np.arange(p)).ravel()
        return ZonePass(
            some_cells(self.cells, which), self.cone._replace(of=self.cone.of[points]), points
        )

    def start(self, old: PointState) -> Start:
        """A state as passes read it."""
        if self._last is not None and self._last[0] is old:
            return self._last[1]
        own = Points(*(self._read(x) for x in (old.stress, old.plastic, old.variables)))
        start = Start(own, np.empty((5, own.stress.shape[1])))
        prepare(self.cone, own.variables[0], start.given)
        self._last = (old, start)
        return start

    def _read(self, values: FloatArray) -> FloatArray:
        own = values.T if self._points is None else values.T[:, self._points]
        return np.ascontiguousarray(own)

    def stored(self, state: PointState) -> float:
        """Elastic energy."""
        return energy(self.cells, self.start(state))

    def respond(
        self, old: PointState, du: FloatArray, freed: FloatArray, force: FloatArray,
        D: FloatArray = _NO_TANGENTS,
    ) -> Passed:  # fmt: skip
        """What a step du (n,) leads to; the zone's forces are added to `force` (n,)."""
        start, beyond = self.start(old), np.empty(len(self.cells.places))
        before = start.points
        new = Points(np.empty_like(before.stress), before.plastic.copy(), before.variables.copy())
        work = pass_over(
            self.cells, self.cone, start, du, freed, new, force, D, beyond, self._space
        )
        return Passed(new.stress.T, new.plastic.T, new.variables.T, work, beyond)

    def flow(self, old: PointState, du: FloatArray, force: FloatArray) -> None:
        """Add to `force` (n,) what flow takes away from the forces in a step du (n,)."""
        if len(self.cells.places):
            flow_over(self.cells, self.cone, self.start(old), du, _NO_ROWS, force, self._space)

    def add_tangent(
        self, old: PointState, du: FloatArray, freed: FloatArray, slots: NDArray[np.int32],
        data: FloatArray,
    ) -> None:  # fmt: skip
        """The zone's tangent of that step into the terms of a matrix."""
        s = len(self.cells.components)
        D = np.empty((len(old.stress), s, s))
        self.respond(old, du, freed, np.zeros_like(du), D)
        add_stiffness(self.cells, D, slots, data, self._space)


def zone_pass(points: PlasticPoints, places: NDArray[np.int32]) -> ZonePass | None:
    """The compiled passes of a zone, None where its law or stresses have none."""
    cone = None if points.held else cone_rows(points.law, points.parameters)
    return None if cone is None else ZonePass(cells_of(points, places), cone)
