"""Cells of a zone in blocks of some points: what compiled passes over them have in common.

Loops over the points of a block are loops over neighbours in memory. Nothing of the size of all
points is made but the state itself.
"""

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.apart import apart
from ssilang.kernel.base.compiled.compiler import (
    compiled_fast,
    compiled_fused,
    compiled_inline,
)
from ssilang.kernel.plasticity.points import PlasticPoints, PointState

NO_TANGENTS, NO_ROWS = np.zeros((0, 0, 0)), np.zeros((0, 6))
LANES = 32
"""Points that are worked on together, those of whole cells."""
SHEAR, BULK = 0, 1
"""Rows of `Start.given` that all laws have."""


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
        np.ascontiguousarray(places),  # as those of one cell are: one kind of code
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
    n_cells, p = len(cells.places), points_of_a_cell(cells)
    blocks, t, lanes = cells.terms.shape
    block, at = np.divmod(which, lanes // p)
    terms = cells.terms.reshape(blocks, t, lanes // p, p)[block, :, at]
    weights = cells.weights.reshape(n_cells, p)[which].ravel()
    places = cells.places[which]
    return cells._replace(terms=_in_blocks(terms), weights=weights, places=places)


def points_of_a_cell(cells: Cells) -> int:
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
    given : array (k, m)
        Shear and bulk modulus, and what else the law has.
    """

    points: Points
    given: FloatArray


class Step(NamedTuple):
    """A step that passes answer.

    Attributes
    ----------
    du : array (n,)
        Displacement.
    freed : array (m, 6)
        Strain without stress, or no rows.
    """

    start: Start
    du: FloatArray
    freed: FloatArray


class Space(NamedTuple):
    """Working space of a pass: compiled code that makes arrays counts references to all of them.

    Displacements and forces (n_rows, n_lanes) of the cells of a block; strains, stresses without
    flow and stresses (6, n_lanes), how far the former are beyond their surfaces (n_lanes,); an
    element's matrix, and its rows; room (10, 6) for the law of a point.
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
        np.zeros(rows), np.zeros((10, 6)),
    )  # fmt: skip


@apart
@compiled_fused
def strains(cells: Cells, block: int, first: int, n: int, step: Step, space: Space) -> None:
    """Strains of the points `first` to `first + n` of a block."""
    rows, start, places, p = cells.rows, cells.start, cells.places, points_of(cells)
    for r in range(len(space.u)):
        u = space.u[r]
        for k in range(n // p):
            value = step.du[places[first // p + k, r]]
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
    if len(step.freed):
        for i in range(6):
            for x in range(n):
                space.e[i, x] -= step.freed[first + x, i]


@compiled_inline
def points_of(cells: Cells) -> int:
    return len(cells.weights) // len(cells.places)


@compiled_fused
def trial_stresses(start: Start, first: int, n: int, space: Space) -> None:
    """Stresses of a block without flow."""
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


@apart
@compiled_fast
def stressed(cells: Cells, start: Start, first: int, n: int, new: Points, space: Space) -> float:
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


@apart
@compiled_fused
def forces(cells: Cells, block: int, first: int, n: int, force: FloatArray, space: Space) -> None:
    """Add the forces of a block's cells."""
    w, p, start = cells.weights[first : first + n], points_of(cells), cells.start
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
    n_points, n_strains, n_lanes = points_of(cells), len(cells.components), cells.terms.shape[2]
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

    pass_over: ClassVar[Callable[..., float]]
    pass_flow_over: ClassVar[Callable[..., None]]

    def __init__(self, cells: Cells, law: Any, points: IntArray | None = None) -> None:
        self.cells, self.law, self._points = cells, law, points
        self.space = _space(cells)
        self._last: tuple[PointState, Start] | None = None

    # ---- what laws differ in

    def of(self, which: IntArray) -> "ZonePass":
        """A pass over some cells: it reads their points of the zone's states."""
        raise NotImplementedError

    def given(self, points: Points) -> FloatArray:
        """What of `Start` is no state."""
        raise NotImplementedError

    def variables(self, values: FloatArray) -> FloatArray:
        """Internal variables (m, k) of the pass's points as it reads them."""
        return self._read(values)

    def over(
        self, step: Step, new: Points, force: FloatArray, D: FloatArray, beyond: FloatArray
    ) -> float:
        """The law's `pass_over`."""
        return self.pass_over(self.cells, self.law, step, new, force, D, beyond, self.space)

    def flow_over(self, step: Step, force: FloatArray) -> None:
        """Add what flow takes away from the forces."""
        self.pass_flow_over(self.cells, self.law, step, force, self.space)

    def kept(self, variables: FloatArray) -> FloatArray:
        """Internal variables (m, k) of what a pass has made."""
        return variables.T

    def locked(self, start: Start) -> float:
        """Energy beyond that of the stresses."""
        return 0.0

    # ---- what they have in common

    def some(self, which: IntArray) -> tuple[Cells, IntArray]:
        """Some cells, and their points."""
        p = points_of_a_cell(self.cells)
        points: IntArray = (which[:, None] * p + np.arange(p)).ravel()
        return some_cells(self.cells, which), points

    def start(self, old: PointState) -> Start:
        """A state as passes read it."""
        if self._last is not None and self._last[0] is old:
            return self._last[1]
        own = Points(self._read(old.stress), self._read(old.plastic), self.variables(old.variables))
        start = Start(own, self.given(own))
        self._last = (old, start)
        return start

    def _read(self, values: FloatArray) -> FloatArray:
        own = values.T if self._points is None else values.T[:, self._points]
        return np.ascontiguousarray(own)

    def stored(self, state: PointState) -> float:
        """Elastic energy, with what the law locks in."""
        start = self.start(state)
        return energy(self.cells, start) + self.locked(start)

    def respond(
        self, old: PointState, du: FloatArray, freed: FloatArray, force: FloatArray,
        D: FloatArray = NO_TANGENTS,
    ) -> Passed:  # fmt: skip
        """What a step du (n,) leads to; the zone's forces are added to `force` (n,).

        D (m, n_strains, n_strains) is filled with the tangents if it has rows.
        """
        start, beyond = self.start(old), np.empty(len(self.cells.places))
        before = start.points
        new = Points(np.empty_like(before.stress), before.plastic.copy(), before.variables.copy())
        work = self.over(Step(start, du, freed), new, force, D, beyond)
        return Passed(new.stress.T, new.plastic.T, self.kept(new.variables), work, beyond)

    def flow(self, old: PointState, du: FloatArray, force: FloatArray) -> None:
        """Add to `force` (n,) what flow takes away from the forces in a step du (n,)."""
        if len(self.cells.places):
            self.flow_over(Step(self.start(old), du, NO_ROWS), force)

    def blank_tangents(self, wanted: bool = True) -> FloatArray:
        """Room for the tangents (m, n_strains, n_strains), or for none."""
        if not wanted:
            return NO_TANGENTS
        s = len(self.cells.components)
        return np.empty((len(self.cells.weights), s, s))

    def add_tangent(
        self, old: PointState, du: FloatArray, freed: FloatArray, slots: NDArray[np.int32],
        data: FloatArray,
    ) -> None:  # fmt: skip
        """The zone's tangent of that step into the terms of a matrix."""
        D = self.blank_tangents()
        self.respond(old, du, freed, np.zeros_like(du), D)
        self.add_stiffness(D, slots, data)

    def add_stiffness(self, D: FloatArray, slots: NDArray[np.int32], data: FloatArray) -> None:
        """The zone's stiffness with tangents D into the terms of a matrix."""
        add_stiffness(self.cells, D, slots, data, self.space)
