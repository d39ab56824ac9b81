"""One compiled pass over the elements of a zone: strains, law, forces, and the tangents if asked.

For laws that are rows of numbers (`materials.plastic.cone_rows`) in bodies without held stresses.
Nothing of the size of all points is made but the state itself.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled_fused, compiled_inline
from ssilang.kernel.materials.plastic.cone_rows import (
    ConeColumn,
    ConeRows,
    cone_point,
    cone_rows,
)
from ssilang.kernel.plasticity.points import PlasticPoints, PointState

_NO_TANGENTS = np.zeros((0, 0, 0))


class Cells(NamedTuple):
    """What a pass reads of a zone.

    Attributes
    ----------
    terms : array (n_cells, n_points, n_terms)
        Terms of the strain operator that are not zero everywhere, strain after strain.
    start : array (n_strains + 1,)
        Where those of each strain begin.
    rows : array (n_terms,)
        The row of the element vector that each belongs to.
    weights : array (n_cells, n_points)
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
        np.ascontiguousarray(points.B[:, strain, :, row].transpose(1, 2, 0)),
        np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        row.astype(np.int64),
        np.ascontiguousarray(points.weights),
        places,
        np.array(points.components, np.int64),
    )


class Points(NamedTuple):
    """State of all points: stress, plastic strain (m, 6), internal variables (m, k)."""

    stress: FloatArray
    plastic: FloatArray
    variables: FloatArray


class Space(NamedTuple):
    """Working space of a pass: compiled code that makes arrays counts references to all of them.

    Displacements and forces (n_rows,) of an element, its matrix, strains (6,) of a point and room
    (6, 6) for its law.
    """

    u: FloatArray
    f: FloatArray
    K: FloatArray
    e: FloatArray
    point: FloatArray


def _space(n_rows: int) -> Space:
    return Space(
        np.zeros(n_rows), np.zeros(n_rows), np.zeros((n_rows, n_rows)), np.zeros(6),
        np.zeros((6, 6)),
    )  # fmt: skip


@compiled_inline
def _trial(c: FloatArray, old: FloatArray, e: FloatArray, s: FloatArray) -> None:
    """Elastic stress s (6,) after strains e (6,)."""
    G = c[ConeColumn.SHEAR]
    volume = e[0] + e[1] + e[2]
    mean = c[ConeColumn.BULK] * volume - 2.0 / 3.0 * G * volume
    for i in range(3):
        s[i] = old[i] + mean + 2.0 * G * e[i]
        s[3 + i] = old[3 + i] + G * e[3 + i]


@compiled_inline
def _strained(c: FloatArray, s: FloatArray, e: FloatArray) -> None:
    """Elastic strains e (6,) of stresses s (6,)."""
    G = c[ConeColumn.SHEAR]
    mean = (s[0] + s[1] + s[2]) / 3.0
    own = mean / (3.0 * c[ConeColumn.BULK])
    for i in range(3):
        e[i] = own + (s[i] - mean) / (2.0 * G)
        e[3 + i] = s[3 + i] / G


@compiled_inline
def _returned(
    cone: ConeRows, at: int, e: FloatArray, old: Points, room: FloatArray, tangent: bool
) -> float:
    """The law at a point: stress room[0] after strains e (6,), room[5] without flow; its strain."""
    row, s, trial = cone.of[at], room[0], room[5]
    _trial(cone.rows[row], old.stress[at], e, trial)
    moves = old.variables.shape[1] > 1
    for i in range(6):
        s[i] = trial[i] - old.variables[at, 1 + i] if moves else trial[i]
    before = old.variables[at, 0]
    p = cone_point(cone, row, s, before, room[1], room[2], tangent)
    if moves:
        for i in range(6):
            s[i] += old.variables[at, 1 + i]
    return p


@compiled_inline
def _point(
    cone: ConeRows, at: int, e: FloatArray, old: Points, new: Points, room: FloatArray,
    tangent: bool,
) -> float:  # fmt: skip
    """The law at a point: its new state; twice the work of the step.

    `room` (6, 6) is working space: s, N, t, differences, strains, s without flow.
    """
    p, c = _returned(cone, at, e, old, room, tangent), cone.rows[cone.of[at]]
    s, N, d, before = room[0], room[1], room[3], old.variables[at, 0]
    new.variables[at, 0] = p
    if old.variables.shape[1] > 1:
        H = c[ConeColumn.KINEMATIC] * (p - before) / 1.5
        for i in range(6):
            new.variables[at, 1 + i] = old.variables[at, 1 + i] + (H * N[i] if p > before else 0.0)
    work = 0.0
    for i in range(6):
        work += (old.stress[at, i] + s[i]) * e[i]
        d[i] = s[i] - old.stress[at, i]
        new.stress[at, i] = s[i]
        new.plastic[at, i] = old.plastic[at, i]
    if p > before:
        _strained(c, d, room[4])
        for i in range(6):
            new.plastic[at, i] += e[i] - room[4, i]
    return work


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


@compiled_inline
def _strain(cells: Cells, k: int, j: int, u: FloatArray, e: FloatArray) -> None:
    """Strains e (6,) of a point j of cell k that moves by u (n_rows,)."""
    start, rows = cells.start, cells.rows
    for a in range(len(cells.components)):
        total = 0.0
        for i in range(start[a], start[a + 1]):
            total += cells.terms[k, j, i] * u[rows[i]]
        e[cells.components[a]] = total


@compiled_fused
def flow_over(
    cells: Cells, cone: ConeRows, old: Points, du: FloatArray, which: IntArray, force: FloatArray,
    space: Space,
) -> None:  # fmt: skip
    """Add to `force` (n,) what flow takes away from the forces of some cells in a step du (n,)."""
    n_rows = cells.places.shape[1]
    n_points, n_strains = cells.weights.shape[1], len(cells.components)
    u, e, room = space.u, space.e, space.point
    start, rows, components = cells.start, cells.rows, cells.components
    for k in which:
        for r in range(n_rows):
            u[r] = du[cells.places[k, r]]
        for j in range(n_points):
            at = k * n_points + j
            _strain(cells, k, j, u, e)
            p = _returned(cone, at, e, old, room, False)
            if p == old.variables[at, 0]:
                continue
            for a in range(n_strains):
                value = cells.weights[k, j] * (room[0, components[a]] - room[5, components[a]])
                for i in range(start[a], start[a + 1]):
                    force[cells.places[k, rows[i]]] += cells.terms[k, j, i] * value


@compiled_fused
def pass_over(
    cells: Cells, cone: ConeRows, old: Points, du: FloatArray, freed: FloatArray, new: Points,
    force: FloatArray, D: FloatArray, beyond: FloatArray, space: Space,
) -> float:  # fmt: skip
    """The state after a step du (n,) of displacement, its forces added to `force` (n,).

    Parameters
    ----------
    freed : array (m, 6)
        Strain of the step without stress, or no rows.
    D : array (m, n_strains, n_strains)
        Filled with the tangents, unless it has no rows.
    beyond : array (n_cells,)
        How far stresses without flow are beyond their surfaces at most, of the stresses at play.

    Returns
    -------
    work : float
        Of the stresses over the step (average of both ends).
    """
    n_cells, n_rows = cells.places.shape
    n_points, n_strains = cells.weights.shape[1], len(cells.components)
    u, f, e, room = space.u, space.f, space.e, space.point
    terms, start, rows, places = cells.terms, cells.start, cells.rows, cells.places
    components, weights, stress = cells.components, cells.weights, new.stress
    work, tangent = 0.0, len(D) > 0
    for k in range(n_cells):
        for r in range(n_rows):
            u[r] = du[places[k, r]]
            f[r] = 0.0
        beyond[k] = -1.0
        for j in range(n_points):
            at = k * n_points + j
            _strain(cells, k, j, u, e)
            if len(freed):
                for i in range(6):
                    e[i] -= freed[at, i]
            # law
            w = weights[k, j]
            work += 0.5 * w * _point(cone, at, e, old, new, room, tangent)
            beyond[k] = max(beyond[k], room[2, 5])
            if tangent:
                _tangent(room[1], room[2], components, D[at])
            # forces
            for a in range(n_strains):
                value = w * stress[at, components[a]]
                for i in range(start[a], start[a + 1]):
                    f[rows[i]] += terms[k, j, i] * value
            if len(freed):
                for i in range(6):
                    e[i] = 0.0
        for r in range(n_rows):
            force[places[k, r]] += f[r]
    return work


@compiled_fused
def add_stiffness(
    cells: Cells, D: FloatArray, slots: NDArray[np.int32], data: FloatArray, space: Space
) -> None:
    """Add the element matrices of tangents (m, n_strains, n_strains) to the terms of a matrix.

    `slots` (n_cells, n_rows, n_rows) says which term each entry is part of.
    """
    n_cells, n_rows = cells.places.shape
    n_points, n_strains = cells.weights.shape[1], len(cells.components)
    terms, start, rows, weights = cells.terms, cells.start, cells.rows, cells.weights
    K, left = space.K, space.f
    for k in range(n_cells):
        for r in range(n_rows):
            for c in range(n_rows):
                K[r, c] = 0.0
        for j in range(n_points):
            at, w = k * n_points + j, weights[k, j]
            for a in range(n_strains):
                if start[a] == start[a + 1]:
                    continue
                for c in range(n_rows):
                    left[c] = 0.0
                for b in range(n_strains):
                    value = w * D[at, a, b]
                    for i in range(start[b], start[b + 1]):
                        left[rows[i]] += value * terms[k, j, i]
                for i in range(start[a], start[a + 1]):
                    value, r = terms[k, j, i], rows[i]
                    for c in range(n_rows):
                        K[r, c] += value * left[c]
        for r in range(n_rows):
            for c in range(n_rows):
                data[slots[k, r, c]] += K[r, c]


def _points(state: PointState) -> Points:
    return Points(state.stress, state.plastic, state.variables)


def _room_for(state: PointState) -> Points:
    return Points(
        np.empty_like(state.stress), np.empty_like(state.plastic), np.empty_like(state.variables)
    )


class Passed(NamedTuple):
    """What a pass gives: state, work over the step, `beyond` (n_cells,) as `pass_over` says."""

    points: Points
    work: float
    beyond: FloatArray


class ZonePass:
    """The passes of a zone."""

    def __init__(self, points: PlasticPoints, cone: ConeRows, places: NDArray[np.int32]) -> None:
        self.cells, self.cone = cells_of(points, places), cone
        self._space = _space(places.shape[1])

    def respond(
        self, old: PointState, du: FloatArray, freed: FloatArray, force: FloatArray,
        D: FloatArray = _NO_TANGENTS,
    ) -> Passed:  # fmt: skip
        """What a step du (n,) leads to; the zone's forces are added to `force` (n,)."""
        new, beyond = _room_for(old), np.empty(len(self.cells.weights))
        before = _points(old)
        work = pass_over(
            self.cells, self.cone, before, du, freed, new, force, D, beyond, self._space
        )
        return Passed(new, work, beyond)

    def flow(self, old: PointState, du: FloatArray, which: IntArray, force: FloatArray) -> None:
        """Add to `force` what flow takes away from the forces of cells `which` in a step."""
        flow_over(self.cells, self.cone, _points(old), du, which, force, self._space)

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
    return None if cone is None else ZonePass(points, cone, places)
