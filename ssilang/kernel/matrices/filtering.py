"""Filters: matrices whose product with a field is a weighted mean over neighbours."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    Numbering,
)
from ssilang.kernel.matrices.from_sparse import matrix_from_sparse
from ssilang.kernel.matrices.matrix import Matrix


def filter_weights(
    weights: NodeField, radius: float, power: float, least: float, unknown: str, dual: str
) -> Matrix:
    """Matrix whose product with a field is its weighted mean over the neighbours of each node.

    Row i has `(1 - d_ij / radius)^power w_j` over their sum, for nodes nearer than the radius;
    terms not above `least` are dropped (after the division).
    """
    from scipy.spatial import cKDTree

    names = list(weights.components)
    if len(names) != 1:
        raise FieldError("kernel.matrices.component-weights-needed", names=names)
    part = weights.components[names[0]]
    n = len(part.nodes)
    if radius > 0.0:
        points = weights.table.coordinates[part.nodes]
        tree = cKDTree(points)
        near = tree.sparse_distance_matrix(tree, radius, output_type="coo_matrix")
        i = np.concatenate([near.row, np.arange(n)]).astype(np.int64)
        j = np.concatenate([near.col, np.arange(n)]).astype(np.int64)
        d = np.concatenate([near.data, np.zeros(n)])
        own = (near.row == near.col).nonzero()[0]
        kept = np.ones(len(i), bool)
        kept[own] = False
        i, j, d = i[kept], j[kept], d[kept]
        values = np.maximum(1.0 - d / radius, 0.0) ** power * part.values[j]
        shares = sp.coo_array((values, (i, j)), shape=(n, n)).tocsr()
    else:
        shares = sp.csr_array(sp.diags_array(part.values.copy()))
    total: FloatArray = np.asarray(shares.sum(axis=1)).ravel()
    if (total == 0.0).any():
        raise FieldError("kernel.matrices.weights-around-node-zero")
    W = sp.csr_array(sp.diags_array(1.0 / total) @ shares)
    W.data[W.data <= least] = 0.0
    codes = np.zeros(n, dtype=np.int64)
    numbering = Numbering(weights.table, (unknown,), (dual,), part.nodes, codes, 0)
    return matrix_from_sparse(W, numbering, "RIGIDITE", False)
