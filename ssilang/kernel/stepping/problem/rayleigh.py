"""A damping matrix as a combination of mass and stiffness, and what is left of it."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.sparse import sp

TURNS = 30
ROUNDING = 1e-13  # of the size of a term: what is left below it is none
FEW = 0.5  # share of the terms of C that may be left


def split_damping(
    C: sp.csr_array, M: sp.csr_array, K: sp.csr_array
) -> tuple[float, float, sp.csr_array]:
    """alpha, beta and the rest of `C = alpha M + beta K + rest`, all (n, n).

    Found from the images of one vector, by least absolute differences, so that dashpots on less
    than half of the unknowns do not count. A damping that is no such combination is all rest.
    """
    n = C.shape[0]
    if C.nnz == 0:
        return 0.0, 0.0, C
    x = np.random.default_rng(0).uniform(0.5, 1.5, n)
    columns: FloatArray = np.column_stack([M @ x, K @ x])
    image: FloatArray = C @ x
    sizes = np.abs(columns).max(axis=0)
    columns = columns / np.where(sizes > 0.0, sizes, 1.0)
    weights = np.ones(n)
    for _ in range(TURNS):
        left = image - columns @ _least_squares(columns, image, weights)
        weights = 1.0 / np.maximum(np.abs(left), 1e-14 * np.abs(image).max())
    near = np.abs(left) <= 1e-8 * np.abs(image).max()
    found = _least_squares(columns[near], image[near], np.ones(int(near.sum())))
    alpha, beta = (float(v) for v in found / np.where(sizes > 0.0, sizes, 1.0))
    rest = sp.csr_array(C - alpha * M - beta * K)
    size = np.abs(alpha) * M.diagonal() + np.abs(beta) * K.diagonal() + np.abs(C.diagonal())
    rows = np.repeat(np.arange(n), np.diff(rest.indptr))
    small = np.abs(rest.data) <= ROUNDING * np.sqrt(np.abs(size[rows] * size[rest.indices]))
    rest.data[small] = 0.0
    rest.eliminate_zeros()
    return (alpha, beta, rest) if rest.nnz <= FEW * C.nnz else (0.0, 0.0, C)


def _least_squares(columns: FloatArray, image: FloatArray, weights: FloatArray) -> FloatArray:
    root = np.sqrt(weights)
    found = np.linalg.lstsq(columns * root[:, None], image * root, rcond=1e-12)[0]
    return np.asarray(found, dtype=np.float64)
