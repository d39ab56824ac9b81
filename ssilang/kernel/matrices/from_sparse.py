"""A sparse matrix over a numbering of unknowns as a sum of small element matrices."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix


def matrix_from_sparse(
    A: sp.csr_array, numbering: Numbering, kind: str = "RIGIDITE", symmetric: bool = True
) -> Matrix:
    """The matrix with these terms: one element of two nodes a term, of one on the diagonal.

    Parameters
    ----------
    A : csr array (n, n)
    symmetric : bool
        True: only the lower triangle is read.
    """
    terms = A.tocoo()
    i, j, v = terms.row.astype(np.int64), terms.col.astype(np.int64), terms.data
    kept = (v != 0.0) & ((i >= j) | (not symmetric))
    i, j, v = i[kept], j[kept], v[kept]
    blocks = []
    pairs = numbering.codes[i] * len(numbering.unknowns) + numbering.codes[j]
    for pair in np.unique(pairs):
        mine = pairs == pair
        names = divmod(int(pair), len(numbering.unknowns))
        for same in (True, False):
            chosen = mine & ((i == j) == same)
            if chosen.any():
                place = (i[chosen], j[chosen])
                blocks.append(_block(numbering, names, place, v[chosen], kind, symmetric))
    return Matrix(numbering.table, tuple(blocks), (), kind)


def _block(
    numbering: Numbering,
    names: tuple[int, int],
    place: tuple[IntArray, IntArray],
    values: FloatArray,
    kind: str,
    symmetric: bool,
) -> ElementMatrices:
    i, j = (numbering.nodes[p] for p in place)
    codes: tuple[int, ...] = names
    if np.array_equal(place[0], place[1]):
        codes = names[:1]
        nodes, matrices = i[:, None], values[:, None, None]
    else:
        nodes = np.column_stack([i, j])
        matrices = np.zeros((len(values), 2, 2))
        matrices[:, 0, 1] = values
        if symmetric:
            matrices[:, 1, 0] = values
    return ElementMatrices(
        numbering.table,
        nodes,
        np.arange(len(codes)),
        tuple(numbering.unknowns[c] for c in codes),
        tuple(numbering.duals[c] for c in codes),
        matrices,
        kind,
        None,
        symmetric,
    )
