"""Histories at nodes: displacement, velocity, acceleration, reactions of relations, joints."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.interface.interface import interface_field, point_history, state_field
from ssilang.kernel.matrices.assembly import MULTIPLIER, vector_to_field
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.track import Rows, Track, balance_of


@dataclass(frozen=True, eq=False)
class Followed:
    """Multipliers of some relations: what reactions of a few unknowns make of them.

    Attributes
    ----------
    nodes : array (m,)
        Their nodes, increasing.
    at : array (p,)
        Unknowns that the equalities hold.
    forces : array (p, m)
        Multipliers LX from the forces of the equalities on these; zero for unilateral ones.
    contact : array (m, size)
        LX from the reactions of the unilateral relations.
    """

    nodes: IntArray
    at: IntArray
    forces: FloatArray
    contact: FloatArray

    def values(self, rows: Rows) -> FloatArray:
        """LX (k, m)."""
        found = np.zeros((len(rows), len(self.nodes)))
        pushed, contact = rows.tap.contact, rows.problem.contact
        if len(self.at):
            rest = rows.reactions(balance_of(rows.problem, self.at))
            if contact is not None:
                rest = rest - pushed @ contact.pushing[:, self.at]
            found += rest @ self.forces
        return found if contact is None else found + pushed @ self.contact.T


def followed_of(problem: Problem, nodes: IntArray) -> Followed:
    """The relations whose multipliers are among some nodes."""
    p, contact = problem, problem.contact
    equal = np.flatnonzero(np.isin(p.multipliers, nodes))
    columns = -p.constraints.pushers(equal)
    at = np.flatnonzero(columns.any(axis=1))
    found = [p.multipliers[equal]]
    size = 0 if contact is None else contact.size
    pushed = [np.zeros((len(equal), size))]
    if contact is not None:
        one_sided = np.flatnonzero(np.isin(contact.multipliers, nodes))
        found.append(contact.multipliers[one_sided])
        pushed.append(-contact.sense[one_sided, None] * np.eye(size)[one_sided])
    forces = np.hstack([columns[at], np.zeros((len(at), sum(map(len, found[1:]))))])
    whole = np.concatenate(found)
    order = np.argsort(whole, kind="stable")
    return Followed(whole[order], at, forces[:, order], np.concatenate(pushed)[order])


@dataclass(eq=False)
class NodeTrack(Track):
    """What is kept at some nodes, as fields of single instants or as histories.

    Attributes
    ----------
    problem : Problem
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
        """Relations whose multipliers are among the nodes; all."""
        p, nodes = self.problem, self.nodes
        if nodes is None:
            nodes = p.multipliers
            if p.contact is not None:
                nodes = np.concatenate([nodes, p.contact.multipliers])
        return followed_of(p, nodes)

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

    def cell_field(self, row: int, name: str) -> CellField | None:
        """`jump`, `traction` or `variables` of the joints at an instant, None without joints."""
        joints = self.problem.interface
        if joints is None:
            return None
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
        all_ = self.followed
        chosen = np.flatnonzero(all_.nodes == node)
        if not len(chosen):
            return None
        one = chosen[:1]
        few = replace(
            all_, nodes=all_.nodes[one], forces=all_.forces[:, one], contact=all_.contact[one]
        )
        held = np.flatnonzero(few.forces[:, 0])
        few = replace(few, at=few.at[held], forces=few.forces[held])
        return np.concatenate([few.values(rows)[:, 0] for rows in self.pieces])

    def point_history(
        self, name: str, component: str, zone: int, cell: int, point: int
    ) -> FloatArray | None:
        """History of a component of `cell_field` at a point (from 0) of a cell of a zone."""
        joints = self.problem.interface
        if joints is None:
            return None
        parts = [
            point_history(joints, rows.joints, name, component, (zone, cell, point))
            for rows in self.pieces
        ]
        kept = [p for p in parts if p is not None]
        return np.concatenate(kept) if kept and len(kept) == len(parts) else None
