"""What DYNAMIC warns of where a motion enters: how strong it is, in which frame, what it meets.

A load shakes where it is the mass times an acceleration of the whole; supports move as one where
their imposed values are those of a translation.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.interface.family import displacement_names
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.stepping.problem.bodies import FREE, ROUNDING, loose_bodies
from ssilang.kernel.stepping.problem.loading import nodal_terms
from ssilang.kernel.stepping.problem.plausibility import AXES
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.stepping.problem.problem import Inputs, Problem

GRAVITY = 9.81  # m/s2
STRONG = 3.0  # g; more than the ground of any earthquake but one
WEIGHT = (0.05, 3.0)  # g; what pulls down
SAME = 1e-6  # of a force, that is rounding
LEVELS = 3  # heights of a side; a base has one
NAMES = {"ACCE": "ACCE", "VITE": "VITE", "VELO": "VITE", "DEPL": "DEPL", "DISP": "DEPL"}
"""What a curve is of, by the first letters of the name of its ordinates."""


def warn_of_shaking(entries: Entries, problem: Problem, inputs: Inputs) -> None:
    """Warn of motions that are no earthquake's, of what damps or holds what they should move."""
    if not {*AXES} & {*problem.numbering.unknowns}:
        return
    for find in (_motions, _moved_base, _sides, _bridged, _held_footings):
        for code, told in find(entries, problem, inputs):
            entries.warn(code, **told)


Told = Iterator[tuple[str, dict[str, Any]]]


def _translations(problem: Problem) -> FloatArray:
    """The model's translations (n, d) by one along the axes that it has."""
    there = [a for a in AXES if a in problem.numbering.unknowns]
    return np.column_stack([problem.numbering.codes == problem.numbering.code(a) for a in there])


def _shares(parts: FloatArray, wholes: FloatArray) -> FloatArray:
    """What makes each of `wholes` (n, k) of `parts` (n, d): (d, k), nought where nothing does."""
    shares = np.linalg.lstsq(parts, wholes, rcond=None)[0]
    off = np.abs(parts @ shares - wholes).max(axis=0, initial=0.0)
    return np.where(off > SAME * np.abs(wholes).max(axis=0, initial=0.0), 0.0, shares)


def accelerations(problem: Problem) -> FloatArray:
    """Of the loads that are the mass times one, it (d, k); nought for the others."""
    T = problem.constraints.T
    along = T.T @ (problem.M @ _translations(problem).astype(float))
    return _shares(along, T.T @ problem.loading.forces)


def _motions(entries: Entries, problem: Problem, inputs: Inputs) -> Told:
    terms = [(p, t) for p in inputs.load.parts for t in nodal_terms(p)] if inputs.load else []
    found, factors = accelerations(problem), problem.loading.at(problem.times)
    changing = np.ptp(factors, axis=0) > 0.0
    sizes = np.linalg.norm(found, axis=0) * np.abs(factors).max(axis=0)
    system = workspace(entries.call.session).units
    known = [s for s in sizes[~changing] for g in (1.0, 1e3) if abs(s / g / GRAVITY - 1.0) < 0.01]
    rests = problem.contact is None and not (problem.u.any() or problem.v.any())
    g = GRAVITY / system.length if system else known[0] if known else np.inf
    for k, (part, _) in enumerate(terms):
        curve = part.time.parts[0] if part.time is not None else None
        kind = "" if curve is None else NAMES.get(curve.ordinate_name.strip().upper()[:4], "")
        shakes = changing[k] and sizes[k] > 0.0
        told = {"name": part.name, "value": sizes[k], "times": sizes[k] / g}
        of = {"name": part.name, "velocities": kind == "VITE"}
        if shakes and sizes[k] > STRONG * g:
            yield "operators.dynamics.shaken-strongly", {**told, "most": STRONG}
        if shakes and curve is not None and curve.units[1] == "g":
            yield "operators.dynamics.shaken-in-g", told
        if shakes and kind in ("VITE", "DEPL"):
            yield "operators.dynamics.shaken-by-others", of
        if kind in ("VITE", "ACCE") and problem.loading.imposed[:, k].any():
            yield "operators.dynamics.imposed-by-others", of
        shaken = any(changing[n] and sizes[n] > 0.0 for n in range(len(terms)))
        if shaken and rests and not changing[k] and found[-1, k] and len(found) > 1:
            yield "operators.dynamics.weight-dropped", told
        down = abs(found[-1, k]) * np.abs(factors[:, k]).max() if len(found) > 1 else 0.0
        if system and not changing[k] and down and not WEIGHT[0] < down / g < WEIGHT[1]:
            yield "operators.dynamics.weight-unusual", {**told, "wanted": g, "unit": system.written("m/s2")}


def _base(problem: Problem) -> FloatArray:
    """Translations (d, k) of all supports that imposed values that change make; nought else."""
    rows, imposed = problem.constraints.C, problem.loading.imposed
    changing = np.ptp(problem.loading.at(problem.times), axis=0) > 0.0
    return _shares(rows @ _translations(problem).astype(float), imposed * changing)


def _moved_base(_: Entries, problem: Problem, __: Inputs) -> Told:
    base, T, translations = _base(problem), problem.constraints.T, _translations(problem)
    changing = np.ptp(problem.loading.at(problem.times), axis=0) > 0.0
    if not base.any():
        return
    if (np.abs(base).sum(axis=1) * np.abs(accelerations(problem) * changing).sum(axis=1)).any():
        yield "operators.dynamics.shaken-twice", {}
    moved = translations @ base
    braked, pulled = (T.T @ (m @ moved) for m in (problem.C, problem.M))
    size = np.abs(problem.C.diagonal()).max(initial=0.0)
    for k in np.flatnonzero(np.abs(braked).max(axis=0, initial=0.0) > ROUNDING * size):
        if _shares(pulled[:, k : k + 1], braked[:, k : k + 1]).any():
            yield "operators.dynamics.damped-against-ground", {}
            return


def _sides(_: Entries, problem: Problem, __: Inputs) -> Told:
    """Rollers along the shaking: held that way and free to move up, at several heights."""
    numbering, T = problem.numbering, problem.constraints.T
    changing = np.ptp(problem.loading.at(problem.times), axis=0) > 0.0
    shaken = (np.abs(accelerations(problem) * changing) + np.abs(_base(problem))).max(
        axis=1, initial=0.0
    )
    names = [a for a in AXES if a in numbering.unknowns]
    fixed = np.asarray(abs(T).sum(axis=1)).ravel() <= FREE
    upward = numbering.code(names[-1])
    rising = numbering.nodes[(numbering.codes == upward) & ~fixed]
    for axis in [
        a for a, s in zip(names[:-1], shaken, strict=False) if s > SAME * shaken.max(initial=0.0)
    ]:
        held = numbering.nodes[(numbering.codes == numbering.code(axis)) & fixed]
        nodes = held[np.isin(held, rising)]
        heights = numbering.table.coordinates[nodes, len(names) - 1]
        if len(np.unique(heights.round(9))) >= LEVELS:
            node = numbering.table.told(int(nodes[0]))
            yield "operators.dynamics.sides-held", {"axis": axis, "count": len(nodes), "node": node}


def _bridged(_: Entries, problem: Problem, inputs: Inputs) -> Told:
    """Dashpots to the ground, along the normal of joints, on bodies that these alone hold."""
    joints = problem.interface
    if joints is None or inputs.damping is None:
        return
    if not loose_bodies(problem, np.zeros((joints.n_points, joints.dimension))):
        return
    alone = [b for b in inputs.damping.blocks if b.zone is None and b.nodes.shape[1] == 1]
    for joint in joints.joints:
        upper = joint.zone.cells.nodes.resolve(joint.upper).ravel()
        along = _normal(joint)
        for block in alone:
            place = block.unknowns.index(along) if along in block.unknowns else -1
            there = np.isin(block.nodes[:, 0], upper) & (block.values[:, place, place] > 0.0)
            if block.kind != "MASSE" and place >= 0 and there.any():
                node = block.table.told(int(block.nodes[there.argmax(), 0]))
                yield "operators.dynamics.joints-bridged", {"axis": along, "node": node}
                return


def _held_footings(_: Entries, problem: Problem, inputs: Inputs) -> Told:
    """Joints that supports keep from opening, sides of joints that they hold like a structure."""
    joints = problem.interface
    if joints is None or problem.loading.imposed.any() or not joints.n_points:
        return
    left = abs(joints.J @ problem.constraints.T).max(axis=1).toarray().reshape(-1, joints.dimension)
    moving = (left > ROUNDING)[joints.pairs].reshape(joints.n_points, 1, -1)
    moves = ((np.abs(joints.B) > ROUNDING) & moving).any(axis=2)
    if not moves.any():
        yield "operators.dynamics.joints-held", {}
        return
    if not moves[:, -1].any():
        yield "operators.dynamics.joints-closed", {}
    for joint in joints.joints:
        upper = joint.zone.cells.nodes.resolve(joint.upper).ravel()
        for relations in inputs.stiffness.relations:
            several = np.diff(relations.row_start) > 1
            tied = relations.nodes[np.repeat(several, np.diff(relations.row_start))]
            upper = np.union1d(upper, tied) if np.isin(upper, tied).any() else upper
        along = _normal(joint)
        turning = {f"R{a[1]}" for a in AXES} - {f"R{along[1]}"}
        for row, name in zip(*_held(inputs.stiffness), strict=True):
            if row in upper and name in {along, *turning} and row not in joint.lower:
                node = problem.numbering.table.told(int(row))
                yield "operators.dynamics.footing-held", {"node": node, "name": name}
                return


def _normal(joint: JointCells) -> str:
    """The displacement along which a joint opens, most."""
    normal = np.abs(joint.frames[..., -1, :]).reshape(-1, joint.frames.shape[-1]).mean(axis=0)
    return displacement_names(joint.zone)[int(normal.argmax())]


def _held(matrix: Matrix) -> tuple[list[int], list[str]]:
    """Nodes and unknowns of the equalities of one term."""
    nodes, names = [], []
    for r in matrix.relations:
        first = r.row_start[:-1][(np.diff(r.row_start) == 1) & (r.sense == 0)]
        nodes += r.nodes[first].tolist()
        names += [r.unknowns[k] for k in first]
    return nodes, names
