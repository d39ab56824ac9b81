"""Histories at nodes: displacement, velocity, acceleration, reactions of relations, joints.

Forces in time: sums of named supports and relations, found while a loop steps; of footings.

What footings carry is made of each instant that an observer is given.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.interface.interface import interface_field, point_history, state_field
from ssilang.kernel.matrices.assembly import MULTIPLIER, vector_to_field
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.track import Rows, Track, balance_of, rows_of_snapshot


@dataclass(frozen=True, eq=False)
class Forces:
    """Sums of what conditions push by: linear in the reactions of a few unknowns."""

    at: IntArray  # (p,) unknowns that the equalities hold
    # (p, m) the sums from the forces of the equalities on these; zero for unilateral ones
    forces: sp.csr_array
    contact: sp.csr_array  # (m, size) the sums from the reactions of the unilateral relations

    def values(self, rows: Rows) -> FloatArray:
        """The sums (k, m)."""
        found = np.zeros((len(rows), self.contact.shape[0]))
        pushed, contact = rows.tap.contact, rows.problem.contact
        if len(self.at):
            rest = rows.reactions(balance_of(rows.problem, self.at))
            if contact:
                rest = rest - pushed @ contact.pushing[:, self.at]
            found += rest @ self.forces
        return found + pushed @ self.contact.T if contact else found


@dataclass(frozen=True, eq=False)
class Followed(Forces):
    """Multipliers LX of some relations: what reactions of a few unknowns make of them."""

    nodes: IntArray  # (m,) their nodes, increasing


def followed_of(problem: Problem, nodes: IntArray) -> Followed:
    """The relations whose multipliers are among some nodes."""
    p, contact = problem, problem.contact
    equal = np.flatnonzero(np.isin(p.multipliers, nodes))
    one_sided = np.flatnonzero(np.isin(contact.multipliers, nodes))
    whole = np.concatenate([p.multipliers[equal], contact.multipliers[one_sided]])
    first, m = len(equal), len(whole)
    columns = sp.csr_array(sp.hstack([_pushers(p, equal), sp.csc_array((p.K.shape[0], m - first))]))
    places = (first + np.arange(m - first), one_sided)
    pushed = sp.csr_array((-contact.sense[one_sided], places), shape=(m, contact.size))
    at, order = np.flatnonzero(np.diff(columns.indptr)), np.argsort(whole, kind="stable")
    return Followed(at, columns[at][:, order], pushed[order], whole[order])


def resultants_of(problem: Problem, nodes: IntArray) -> dict[str, Forces]:
    """Sum of the forces on the body of the relations with these multipliers, by dual name.

    Frictions of unilateral relations are forces of theirs. Only names by which they push.
    """
    p, numbering, contact = problem, problem.numbering, problem.contact
    equal = np.flatnonzero(np.isin(p.multipliers, nodes))
    forces = sp.csr_array(-_pushers(p, equal) @ p.constraints.D[equal])
    held, width = np.flatnonzero(np.isin(contact.multipliers, nodes)), contact.friction.width
    places = np.flatnonzero(np.isin(contact.friction.normal, held))
    slips = (places[:, None] * width + np.arange(width)).ravel()
    held = np.concatenate([held, len(contact) + slips])
    found = {}
    for code, dual in enumerate(numbering.duals):
        one = sp.csc_array((numbering.codes == code).astype(float)[:, None])
        own, total = sp.csr_array(forces @ one), (contact.pushing[held] @ one).toarray()[:, 0]
        places = np.zeros(len(held), int), held
        pushed = sp.csr_array((total, places), shape=(1, contact.size))
        if own.count_nonzero() or pushed.count_nonzero():
            at = np.flatnonzero(np.diff(own.indptr))
            found[dual] = Forces(at, sp.csr_array(own[at]), pushed)
    return found


def _pushers(problem: Problem, rows: IntArray) -> sp.csc_array:
    """Columns (n, m) whose products with the forces of equalities are some multipliers LX.

    Most relations hold one unknown, and are alone to do so.
    """
    D = problem.constraints.D
    alone = np.bincount(D.indices, minlength=D.shape[1]) == 1
    entries = np.diff(D.indptr)
    found: list[tuple[Any, FloatArray]] = []
    for row in rows.tolist():
        first = D.indptr[row]
        if entries[row] == 1 and alone[D.indices[first]] and D.data[first] != 0.0:
            found.append((D.indices[first : first + 1], -1.0 / D.data[first : first + 1]))
            continue
        column = -problem.constraints.pushers(np.array([row]))[:, 0]
        at = np.flatnonzero(column)
        found.append((at, column[at]))
    starts = np.cumsum([0, *(len(at) for at, _ in found)])
    at = np.concatenate([np.zeros(0, np.int64), *(at for at, _ in found)])
    values = np.concatenate([np.zeros(0), *(x for _, x in found)])
    return sp.csc_array((values, at, starts), shape=(D.shape[1], len(rows)))


@dataclass(eq=False)
class NodeHistories(Track):
    """What is kept at some nodes, as fields of single instants or as histories.

    Attributes
    ----------
    nodes : array or None
        Increasing; None: all.
    """

    unknowns: IntArray = field(init=False)
    problem: Problem = field(kw_only=True)
    nodes: IntArray | None = field(kw_only=True, default=None)
    _ends: list[int] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        p = self.problem
        if self.nodes is None:
            self.shown = self.unknowns = np.arange(p.numbering.size)
            return
        self.shown = np.flatnonzero(np.isin(p.numbering.nodes, self.nodes))
        at = self.followed.at
        near = balance_of(p, at).near if len(at) else at
        self.unknowns = np.union1d(self.shown, near)

    @cached_property
    def followed(self) -> Followed:
        """Relations whose multipliers are among the nodes."""
        assert self.nodes is not None
        return followed_of(self.problem, self.nodes)

    # ---- single instants

    def instant(self, row: int) -> Rows:
        """One of the instants kept, as rows."""
        if len(self._ends) != len(self.pieces):
            self._ends = np.cumsum([len(rows) for rows in self.pieces]).tolist()
        piece = bisect_right(self._ends, row)
        rows = self.pieces[piece]
        place = row - (self._ends[piece - 1] if piece else 0)
        return rows.chosen(np.arange(len(rows)) == place, self.unknowns)

    def node_field(self, row: int, name: str) -> NodeField:
        """`u`, `v` or `a` of an instant; displacements with multipliers LX."""
        rows, numbering = self.instant(row), self.problem.numbering
        if self.nodes is None:
            if name == "u":
                return rows.snapshot(0).displacement
            return vector_to_field(rows.values(name)[0], numbering)
        places = np.searchsorted(self.unknowns, self.shown)
        values, codes = rows.values(name, places)[0], numbering.codes[self.shown]
        nodes = numbering.nodes[self.shown]
        parts = {
            numbering.unknowns[code]: NodeValues(nodes[codes == code], values[codes == code])
            for code in np.unique(codes).tolist()
        }
        if name == "u" and len(self.followed.nodes):
            parts[MULTIPLIER] = NodeValues(self.followed.nodes, self.followed.values(rows)[0])
        return NodeField(numbering.table, parts, "DIFFUS")

    def cell_field(self, row: int, name: str) -> CellField:
        """`jump`, `traction` or `variables` of the joints at an instant."""
        joints = self.problem.interface
        w, t, state = (x[0] for x in self.instant(row).joints)
        if name == "variables":
            return state_field(joints, state, w, t)
        return interface_field(joints, w if name == "jump" else t, name)

    # ---- histories

    def history(self, name: str, component: str, node: int) -> FloatArray | None:
        """`u`, `v` or `a` (n_rows,) of a component at a node; None if it is not kept there."""
        if name == "u" and component == MULTIPLIER:
            return self._multiplier(node)
        if component not in self.problem.numbering.unknowns:
            return None
        place = np.array([self.problem.numbering.index_of(node, component)])
        if not np.isin(place, self.shown)[0]:
            return None
        return self.values(name, place)[:, 0]

    def _multiplier(self, node: int) -> FloatArray | None:
        if self.nodes is not None and not np.isin(node, self.nodes):
            return None
        one = followed_of(self.problem, np.array([node]))
        if not len(one.nodes):
            return None
        return np.concatenate([one.values(rows)[:, 0] for rows in self.pieces])

    def point_history(
        self, name: str, component: str, zone: int, cell: int, point: int
    ) -> FloatArray | None:
        """History of a component of `cell_field` at a point (from 0) of a cell of a zone."""
        joints = self.problem.interface
        parts = [
            point_history(joints, rows.joints, name, component, (zone, cell, point))
            for rows in self.pieces
        ]
        kept = [p for p in parts if p is not None]
        return np.concatenate(kept) if kept and len(kept) == len(parts) else None


MOST = 8
"""Footings that are followed."""


@dataclass(eq=False)
class FootingHistories(Track):
    """Loads of footings at the times it wants; rows are let go at once."""

    footings: Sequence[Footing] = field(kw_only=True)
    left_out: int = field(default=0, kw_only=True)  # smaller footings, which nobody follows
    kept: list[list[Loads]] = field(init=False)  # of each footing, in order of time
    instants: list[FloatArray] = field(default_factory=list, init=False)
    keeps: ClassVar[bool] = False

    def __post_init__(self) -> None:
        self.kept = [[] for _ in self.footings]

    def receive(self, snapshot: Snapshot) -> None:
        """Take one whole instant, of a problem that may have unknowns of its own."""
        self.instants.append(np.array([snapshot.time]))
        for footing, kept in zip(self.footings, self.kept, strict=True):
            u = snapshot.u[footing.unknowns]
            kept.append(footing.loads(snapshot.w[None], snapshot.t[None], u[None]))

    def take(self, rows: Rows) -> None:
        """Take instants."""
        self.instants.append(rows.times)
        joints = rows.joints
        for footing, kept in zip(self.footings, self.kept, strict=True):
            places = np.searchsorted(rows.unknowns, footing.unknowns)
            kept.append(footing.loads(joints.w, joints.t, rows.values("u", places)))

    @property
    def times(self) -> FloatArray:
        """Of all instants."""
        return np.concatenate([np.zeros(0), *self.instants])

    def found(self, number: int) -> Loads:
        """The loads of a footing in time."""
        return Loads(*(np.concatenate(x) for x in zip(*self.kept[number], strict=True)))

    def content(self) -> list[Any]:
        """What a checkpoint keeps: the loads so far."""
        return [self.times, *(x for i in range(len(self.kept)) for x in self._so_far(i))]

    def restore(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        times, *loads = kept
        self.instants = [np.asarray(times)] if len(times) else []
        size = len(Loads._fields)
        self.kept = [
            [Loads(*map(np.asarray, loads[i * size : (i + 1) * size]))] if len(times) else []
            for i in range(len(self.footings))
        ]

    def _so_far(self, number: int) -> Sequence[FloatArray]:
        return self.found(number) if self.kept[number] else [np.zeros(0)] * len(Loads._fields)


def footing_histories(problem: Problem, wanted: BoolArray) -> FootingHistories | None:
    """The observer of a problem's largest footings; None where it has no joints."""
    if not problem.interface:
        return None
    every = footings_of(problem.interface, problem.numbering)
    footings, left = every[:MOST], len(every[MOST:])
    held = [np.zeros(0, np.int64), *(f.unknowns for f in footings)]
    return FootingHistories(
        wanted, np.unique(np.concatenate(held)), footings=footings, left_out=left
    )


@dataclass(eq=False)
class ForceHistories(Track):
    """Sums of the forces of named relations on the body.

    Only the sums are kept: rows of all that acts on what they hold would be many numbers.
    """

    unknowns: IntArray = field(init=False)
    problem: Problem = field(kw_only=True)
    named: dict[str, IntArray] = field(kw_only=True)  # multiplier nodes of each name
    keeps: ClassVar[bool] = False
    _steps: list[IntArray] = field(init=False, default_factory=list)
    _sums: list[FloatArray] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        self._maps = self._of(self.problem)
        at = [np.zeros(0, np.int64), *(forces.at for forces in self._maps.values())]
        held = np.unique(np.concatenate(at))
        near = balance_of(self.problem, held).near if len(held) else held
        self.unknowns = near.astype(np.int64)

    def _of(self, problem: Problem) -> dict[tuple[str, str], Forces]:
        """Sums by name and component."""
        return {
            (name, dual): forces
            for name, nodes in self.named.items()
            for dual, forces in resultants_of(problem, nodes).items()
        }

    def receive(self, snapshot: Snapshot) -> None:
        """Take one whole instant; where the problem changes, of its own relations."""
        if snapshot.problem is self.problem:
            super().receive(snapshot)
            return
        maps, every = self._of(snapshot.problem), np.arange(len(snapshot.u))
        rows = rows_of_snapshot(snapshot, every)
        self._add(rows, {key: maps[key] for key in self._maps if key in maps})

    def take(self, rows: Rows) -> None:
        """Sum the forces of some instants."""
        self._add(rows, self._maps)

    def _add(self, rows: Rows, maps: dict[tuple[str, str], Forces]) -> None:
        none = np.zeros((len(rows), 1))
        found = [maps[key].values(rows) if key in maps else none for key in self._maps]
        self._steps.append(rows.steps_taken)
        self._sums.append(np.hstack([none[:, :0], *found]))

    @property
    def times(self) -> FloatArray:
        """Of the instants kept."""
        return self.problem.times[self._whole()[0]]

    @property
    def histories(self) -> dict[tuple[str, str], FloatArray]:
        """Sum (n_rows,) by name and component."""
        sums = self._whole()[1]
        return {key: sums[:, i].copy() for i, key in enumerate(self._maps)}

    def _whole(self) -> tuple[IntArray, FloatArray]:
        steps = np.concatenate([np.zeros(0, np.int64), *self._steps])
        return steps, np.concatenate([np.zeros((0, len(self._maps))), *self._sums])

    def content(self) -> list[Any]:
        """What a checkpoint keeps: the sums so far."""
        return list(self._whole())

    def restore(self, kept: list[Any]) -> None:
        """Go on from a checkpoint."""
        steps, sums = kept
        self._steps, self._sums = [np.asarray(steps)], [np.asarray(sums)]
