"""Histories of stress, the unknowns of a matched layer beside its displacements.

The layer is stiffness, mass and damping together: one of them alone is no ground of any kind.
"""

from __future__ import annotations

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.matrices.matrix import Matrix

HISTORIES = ("HXX", "HYY", "HXY")
"""Their inertia is negative."""


def has_histories(matrix: Matrix | None) -> bool:
    """Whether a matrix has such unknowns."""
    blocks = () if matrix is None else matrix.blocks
    return any(HISTORIES[0] in b.unknowns for b in blocks)


def refuse_parts_of_layer(
    stiffness: Matrix | None, mass: Matrix | None, damping: Matrix | None
) -> None:
    """Refuse a motion with some of a layer's matrices only.

    Raises
    ------
    KernelError
        Naming what is missing.
    """
    given = {"RIGI": stiffness, "MASS": mass, "AMOR": damping}
    missing = [name for name, matrix in given.items() if not has_histories(matrix)]
    if 0 < len(missing) < len(given):
        raise KernelError("kernel.waves.part-of-matched-layer", missing=missing)


def refuse_layer_at_rest(matrix: Matrix) -> None:
    """Refuse to solve with a layer's stiffness alone (a sum with mass and damping is a step's).

    Raises
    ------
    KernelError
    """
    kinds = {b.kind for b in matrix.blocks if HISTORIES[0] in b.unknowns}
    if kinds == {"RIGIDITE"}:
        raise KernelError("kernel.waves.matched-layer-at-rest")
