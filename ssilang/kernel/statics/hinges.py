"""Beams and shells that end on single nodes of a solid: their rotation is held by nothing there.

A solid has no rotations. A beam that shares one node with it hands over forces, no moment: it
turns about that node like on a hinge, and a tower that was to be clamped has a mechanism, or the
bending of a mast hinged at its foot.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix

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
    solids = [b for b in matrix.blocks if _is_solid(b)]
    slender = [b for b in matrix.blocks if _is_slender(b)]
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
    for relations in matrix.relations:
        for node, name in zip(relations.nodes, relations.unknowns, strict=True):
            if name in held:
                held[name][node] = True
    for zone in joints:
        for name in ROTATIONS:
            held[name][matrix.table.resolve(zone.cells.raw)] = True
    there = {u for b in slender for u in b.unknowns if u in held}
    loose = {name: found[~held[name][found]] for name in ROTATIONS if name in there}
    nodes = np.unique(np.concatenate(list(loose.values()))) if loose else found[:0]
    if not len(nodes):
        return None
    return Hinge(nodes, tuple(n for n, at in loose.items() if len(at)), bool(shell[nodes[0]]))


def _dimension(block: ElementMatrices) -> int:
    return 0 if block.zone is None else block.zone.cells.kind.dimension


def _is_solid(block: ElementMatrices) -> bool:
    zone = block.zone
    return (
        zone is not None
        and not is_joint(zone)
        and zone.cells.kind.dimension >= 2
        and not any(u in ROTATIONS for u in block.unknowns)
    )


def _is_slender(block: ElementMatrices) -> bool:
    zone = block.zone
    return (
        zone is not None
        and not is_joint(zone)
        and zone.cells.kind.dimension in (1, 2)
        and any(u in ROTATIONS for u in block.unknowns)
    )
