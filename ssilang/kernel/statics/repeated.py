"""Cells that stand twice in a matrix: a body copied and merged, or joined with itself."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix

SAME = 1e-9
"""Difference of the sums of two cells' matrices that is none."""
_POINTS = ("IMPEDANCE", "MODAL", "STATIQUE")


def repeated_cells(matrix: Matrix) -> IntArray:
    """First node (n,) of cells on the nodes, with the element and stiffness, of an earlier cell.

    Springs between points are left out: two side by side are meant.
    """
    groups: dict[tuple[object, ...], list[ElementMatrices]] = {}
    for block in matrix.blocks:
        zone = block.zone
        if zone is not None and zone.element != "JOI1" and not {*_POINTS} & {*zone.behaviour}:
            groups.setdefault((zone.element, zone.behaviour, zone.constituent), []).append(block)
    found = [_repeated(blocks) for blocks in groups.values()]
    found += [b.nodes[:, 0] for b in repeated_blocks(matrix) if b.zone is None]
    return np.concatenate(found) if found else np.zeros(0, np.int64)


def repeated_blocks(matrix: Matrix) -> list[ElementMatrices]:
    """Blocks that are there a second time: a matrix joined with itself."""
    known: set[tuple[int, int]] = set()
    again = []
    for block in matrix.blocks:
        key = id(block.raw_nodes), id(block.values)
        again += [block] if key in known else []
        known.add(key)
    return again


def _repeated(blocks: list[ElementMatrices]) -> IntArray:
    keys = np.concatenate([_keys(b.nodes) for b in blocks])
    order = np.argsort(keys, kind="stable")
    again = order[1:][keys[order][1:] == keys[order][:-1]]
    if not len(again):
        return np.zeros(0, np.int64)
    before = order[:-1][keys[order][1:] == keys[order][:-1]]
    sums = np.concatenate([np.trace(b.values, axis1=1, axis2=2) for b in blocks])
    same = np.abs(sums[again] - sums[before]) <= SAME * np.abs(sums[again])
    firsts: IntArray = np.concatenate([b.nodes[:, 0] for b in blocks])[again[same]]
    return firsts


def _keys(nodes: IntArray) -> IntArray:
    """A number for each cell, the same for the same nodes in any order."""
    odd = np.random.default_rng(0).integers(1, 2**62, nodes.shape[1]) * 2 + 1
    return np.asarray(np.sort(nodes, axis=1) @ odd, dtype=np.int64)
