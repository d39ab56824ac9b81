"""Matrices of the linear zones of a model, modes and static shapes together."""

from __future__ import annotations

from collections.abc import Callable

from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix


def linear_blocks(
    zones: list[tuple[Zone, CellField]],
    kind: str,
    make: Callable[[Zone, CellField], ElementMatrices],
) -> list[ElementMatrices]:
    """What `make` gives for each zone, and one block for all MODAL and STATIQUE ones.

    Parameters
    ----------
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.
    """
    blocks = [make(z, m) for z, m in zones if not is_shape(z)]
    if any(is_shape(z) for z, _ in zones):
        shapes = shape_matrix(tuple(z for z, _ in zones), zones[0][1], kind)
        blocks += [] if shapes is None else [shapes]
    return blocks
