"""Joints whose two sides are swapped: they open where the bodies beside them come together.

A joint of zero thickness between two lines or faces at the same place has its normal from the order
of its nodes alone. Which body stands on which side is seen from the cells that share its nodes.

Beams and shells that end on single nodes of a solid: their rotation is held by nothing there.

A solid has no rotations. A beam that shares one node with it hands over forces, no moment: it
turns about that node like on a hinge, and a tower that was to be clamped has a mechanism, or the
bending of a mast hinged at its foot.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.interface import is_macro, joint_zones
from ssilang.kernel.interface.kinematics import JointCells, joint_cells
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.interface.laws.parameter_table import joint_parameters
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.statics.doubled import bodies_of_nodes, terms_of

_SAME_PLACE = 1e-6
_DRAWN = 5e-3  # of a joint's size: a gap that is more than a way to draw the joint
AGAINST = -0.1
"""Cosine of the normal with the way from lower to upper body, below which sides are swapped."""


@dataclass(frozen=True)
class SwappedJoints:
    """A zone of joints that is the wrong way round."""

    middle: FloatArray  # (3,)
    points: bool  # whether they are joints of two points, whose direction was given
    overlap: float  # how far the sides lie inside each other (m); at 0 the order of nodes decides


def swapped_joints(
    stiffness: Matrix, model: Model | None, characteristics: CellField | None
) -> tuple[SwappedJoints, ...]:
    """Each zone of joints all of whose cells have their bodies the wrong way round.

    Bodies are cells of `stiffness` that hold all nodes of a side; of surface joints with no such
    cells, or with cells along their own plane (a footing of beams), what is tied to the sides.
    """
    found = []
    for joints in made_joints(model, characteristics):
        if is_macro(joints.zone):
            continue
        cosine, middle = _cosines(joints, stiffness)
        if len(cosine) and (cosine < AGAINST).all():
            found.append(SwappedJoints(middle, joints.zone.element == "JOI1", _overlap(joints)))
    return tuple(found)


def made_joints(model: Model | None, characteristics: CellField | None) -> Iterator[JointCells]:
    """The joints of a model's zones."""
    zones = () if model is None else joint_zones(model)
    return (joint_cells(z, zone_field(z, characteristics)) for z in zones)


def drawn_gaps(
    model: Model | None, characteristics: CellField | None
) -> Iterator[tuple[int, float]]:
    """A node of each zone of surface joints whose sides lie apart, and how far (m)."""
    for joints in made_joints(model, characteristics):
        if joints.zone.element != "JOI1":
            table = joints.zone.cells.nodes
            upper = table.resolve(joints.upper)
            size = float(np.ptp(table.coordinates[upper].reshape(-1, 3), axis=0).max())
            if (gap := _overlap(joints)) > _DRAWN * size:
                yield int(upper.min()), gap


def repeated_joints(model: Model | None, characteristics: CellField | None) -> IntArray:
    """Upper node (n,) of joints on the nodes of others, with their law, axes and parameters."""
    groups: dict[object, list[FloatArray]] = {}
    for joints in made_joints(model, characteristics) if characteristics is not None else ():
        zone, resolve = joints.zone, joints.zone.cells.nodes.resolve
        parts = [resolve(joints.upper), resolve(joints.lower), joints.frames.round(9)]
        given = zone_field(zone, characteristics)
        if law_of(zone.behaviour).linear:
            parts.append(family_of(zone).moduli(zone, given, "RIGIDITE"))
        else:
            parts.append(joint_parameters(joints, given))
        rows = np.hstack([p.reshape(len(joints.upper), -1) for p in parts]).astype(float)
        groups.setdefault((zone.element, zone.behaviour), []).append(rows)
    found = [np.zeros(0, np.int64)]
    for rows in map(np.concatenate, groups.values()):
        kinds, times = np.unique(rows, axis=0, return_counts=True)
        found.append(kinds[times > 1, 0].astype(np.int64))
    return np.concatenate(found)


def inclinations(
    model: Model | None, characteristics: CellField | None
) -> Iterator[tuple[int, float]]:
    """Upper node of each macro-element, and its normal's angle with the upward axis (degrees)."""
    for joints in made_joints(model, characteristics):
        if is_macro(joints.zone):
            nodes = joints.zone.cells.nodes.resolve(joints.upper).ravel()
            cosines = np.clip(joints.frames[:, 0, -1, -1], -1.0, 1.0)
            yield from zip(nodes.tolist(), np.degrees(np.arccos(cosines)).tolist(), strict=True)


def _overlap(joints: JointCells) -> float:
    """Largest distance of the sides of a joint, 0 if it is rounding beside its size."""
    points = joints.zone.cells.nodes.coordinates
    resolve = joints.zone.cells.nodes.resolve
    upper, lower = points[resolve(joints.upper)], points[resolve(joints.lower)]
    gap = float(np.linalg.norm(upper - lower, axis=-1).max())
    size = float(np.ptp(upper.reshape(-1, 3), axis=0).max())
    return gap if gap > _SAME_PLACE * size else 0.0


def _cosines(joints: JointCells, stiffness: Matrix) -> tuple[FloatArray, FloatArray]:
    """Cosine of each joint that has bodies beside it, and the middle (3,) of all joints."""
    resolve, points = joints.zone.cells.nodes.resolve, stiffness.table.coordinates
    upper, lower = resolve(joints.upper), resolve(joints.lower)
    d = joints.frames.shape[-1]
    way = np.zeros((len(upper), 3))
    for side, sign in ((upper, 1.0), (lower, -1.0)):
        centre = points[side].mean(axis=1)
        there, mean = _beside(side, upper, lower, stiffness)
        way[there] += sign * (mean - centre)[there]
    if joints.zone.element != "JOI1" and np.allclose(way, 0.0):
        way = _way_between_tied(upper, lower, stiffness)
    size = np.linalg.norm(way, axis=1)
    normal = joints.frames[:, :, -1, :].mean(axis=1)
    some = size > 0
    cosine = (way[some, :d] * normal[some]).sum(axis=1) / size[some]
    middle: FloatArray = points[upper].mean(axis=(0, 1))
    return cosine, middle


def _beside(
    side: IntArray, upper: IntArray, lower: IntArray, stiffness: Matrix
) -> tuple[NDArray[np.bool_], FloatArray]:
    """Whether cells hold all nodes of a side, not those of both, and their mean centre (n, 3)."""
    points = stiffness.table.coordinates
    n, m = side.shape
    count, total = np.zeros(n), np.zeros((n, 3))
    sides = _incidence(side, len(points))
    for block in stiffness.blocks:
        cells = block.nodes
        at_nodes = _incidence(cells, len(points)).T
        held = sides @ at_nodes
        if not (held.data == m).any():
            continue
        both = _incidence(np.hstack([upper, lower]), len(points)) @ at_nodes
        whole = sp.csr_array(held.multiply(held == m))
        whole = sp.csr_array(whole - whole.multiply(both == 2 * m))
        whole.data[:] = np.minimum(whole.data, 1.0)
        count += np.asarray(whole.sum(axis=1)).ravel()
        total += whole @ points[cells].mean(axis=1)
    there = count > 0
    mean = np.zeros((n, 3))
    mean[there] = total[there] / count[there, None]
    return there, mean


def _way_between_tied(upper: IntArray, lower: IntArray, stiffness: Matrix) -> FloatArray:
    """Way (n, 3) from lower to upper body: what is tied to all nodes of a side."""
    points = stiffness.table.coordinates
    others = [b.nodes for b in stiffness.blocks if b.zone is None or not is_joint(b.zone)]
    body = bodies_of_nodes(stiffness, others)
    count = np.maximum(np.bincount(body), 1)
    middles = np.column_stack([np.bincount(body, x) / count for x in points.T])
    tied = np.zeros((2, len(upper), 3))
    for side, way in zip((upper, lower), tied, strict=True):
        whole = (body[side] == body[side][:, :1]).all(axis=1)
        way[whole] = (middles[body[side]] - points[side]).mean(axis=1)[whole]
    apart = (body[upper] != body[lower]).all(axis=1)
    between: FloatArray = (apart[:, None] * (tied[0] - tied[1])).round(9)
    return between


def _incidence(rows: IntArray, n_nodes: int) -> sp.csr_array:
    """One where a row names a node, (n_rows, n_nodes)."""
    n, m = rows.shape
    shape = (n, n_nodes)
    return sp.csr_array((np.ones(n * m), (np.repeat(np.arange(n), m), rows.ravel())), shape=shape)


ROTATIONS = ("RX", "RY", "RZ", "RT")


@dataclass(frozen=True)
class Hinge:
    """Nodes (n,) of a solid where a beam (or shell) ends, and the rotations that only it holds."""

    nodes: IntArray
    rotations: tuple[str, ...]
    shell: bool


def hinges(matrix: Matrix, joints: Iterable[Zone] = ()) -> Hinge | None:
    """Ends of beams and shells on solids whose rotation no relation and nothing else holds.

    A node where two beams meet, or where a cell of a shell lies on the solid with all its nodes,
    is none.

    Parameters
    ----------
    joints : zones
        Joints whose law stands beside the matrix: they hold the rotations of their nodes.
    """
    solids = [b for b in matrix.blocks if _dimension(b) >= 2 and not _turns(b)]
    slender = [b for b in matrix.blocks if _dimension(b) in (1, 2) and _turns(b)]
    if not solids or not slender:
        return None
    n = len(matrix.table)
    solid = np.zeros(n, dtype=bool)
    for block in solids:
        solid[block.nodes] = True
    ends, whole = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)
    count = {1: np.zeros(n, dtype=np.int64), 2: np.zeros(n, dtype=np.int64)}
    for block in slender:
        nodes = block.nodes
        on = solid[nodes]
        ends[nodes[on & ~on.all(axis=1, keepdims=True)]] = True
        whole[nodes[on.all(axis=1)]] = True
        np.add.at(count[_dimension(block)], nodes.ravel(), 1)
    beam, shell = (count[1] == 1) & (count[2] == 0), (count[1] == 0) & (count[2] > 0)
    found = np.flatnonzero(ends & ~whole & (beam | shell))
    return _not_held(matrix, slender, joints, found, shell) if len(found) else None


def _not_held(
    matrix: Matrix,
    slender: list[ElementMatrices],
    joints: Iterable[Zone],
    found: IntArray,
    shell: NDArray[np.bool_],
) -> Hinge | None:
    own = {id(b) for b in slender}
    held = {name: np.zeros(len(matrix.table), dtype=bool) for name in ROTATIONS}
    for block in matrix.blocks:
        for column, name in zip(block.local, block.unknowns, strict=True):
            if name in held and id(block) not in own:
                held[name][block.nodes[:, column]] = True
    terms = terms_of(matrix)
    for name, there in held.items():
        there[terms.nodes[terms.names == name]] = True
        for zone in joints:
            there[matrix.table.resolve(zone.cells.raw)] = True
    known = {u for b in slender for u in b.unknowns}
    loose = {name: found[~there[found]] for name, there in held.items() if name in known}
    nodes = np.unique(np.concatenate(list(loose.values()))) if loose else found[:0]
    if not len(nodes):
        return None
    return Hinge(nodes, tuple(n for n, at in loose.items() if len(at)), bool(shell[nodes[0]]))


def _dimension(block: ElementMatrices) -> int:
    """Of its cells, 0 of joints and matrices without cells."""
    cells = block.zone is not None and not is_joint(block.zone)
    return block.zone.cells.kind.dimension if cells and block.zone is not None else 0


def _turns(block: ElementMatrices) -> bool:
    return any(u in ROTATIONS for u in block.unknowns)
