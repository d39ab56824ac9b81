"""Diagonal matrices from full ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix


def lumped_matrix(matrix: Matrix, kept: tuple[str, ...] = ()) -> Matrix:
    """Sum of each row on the diagonal; unknowns in `kept` keep their diagonal term instead."""
    return replace(matrix, blocks=tuple(_lumped(b, kept) for b in matrix.blocks), cache={})


def _lumped(block: ElementMatrices, kept: tuple[str, ...]) -> ElementMatrices:
    n, m, _ = block.values.shape
    rows = block.values.sum(axis=2)
    own = np.einsum("cii->ci", block.values)
    diagonal = np.where([u in kept for u in block.unknowns], own, rows)
    values = np.zeros((n, m, m))
    values[:, np.arange(m), np.arange(m)] = diagonal
    return replace(block, values=values)
