"""Proper orthogonal decomposition of a series of nodal fields.

Sirovich, Quarterly of Applied Mathematics 45 (1987): of n fields on m unknowns, the modes are the
eigenvectors of the (m, m) correlation, or combinations of the fields by the eigenvectors of the
(n, n) one, which is smaller when fields are few. The eigenvalues are the same.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.fields.node_field import NodeField, NodeValues

Places = tuple[tuple[str, NDArray[np.int64]], ...]


def stacked(
    fields: Sequence[NodeField], names: Sequence[str] | None = None
) -> tuple[FloatArray, Places]:
    """Fields as rows (n, m), and the component and nodes of each stretch of columns.

    Multipliers (LX) never count.
    """
    known = [n for n in fields[0].components if n not in ("LX", "FLX")]
    if names is not None:
        known = [n for n in known if n in names]
    if not known:
        raise FieldError("kernel.fields.no-component-left-decompose")
    places = tuple((n, fields[0].components[n].nodes) for n in known)
    rows = [np.concatenate([f.values_at(n, nodes) for n, nodes in places]) for f in fields]
    return np.array(rows), places


def modes(
    series: FloatArray, count: int, by_snapshots: bool, metric: sp.csr_array | None = None
) -> tuple[FloatArray, FloatArray]:
    """Modes (k, m) of largest value 1 and their eigenvalues (k,), decreasing.

    Parameters
    ----------
    series : array (n, m)
    count : int
        Modes wanted; those without energy are left out.
    by_snapshots : bool
        Eigenvectors of the (n, n) correlation of the fields instead of the (m, m) one.
    metric : csr array (m, m), optional
        Matrix of the scalar product (a mass).
    """
    n = len(series)
    weighted = series if metric is None else (metric @ series.T).T
    if by_snapshots:
        values, vectors = np.linalg.eigh(series @ weighted.T / n)
        found = vectors.T @ series
    else:
        values, found = _by_unknowns(series, weighted, metric)
    order = np.argsort(values)[::-1]
    values, found = values[order], found[order]
    kept = values > 1e-12 * max(float(values[0]), 0.0)
    values, found = values[kept][:count], found[kept][:count]
    if not len(values):
        raise FieldError("kernel.fields.fields-no-energy-no")
    peak = found[np.arange(len(found)), np.abs(found).argmax(axis=1)]
    return found / peak[:, None], values


def _by_unknowns(
    series: FloatArray, weighted: FloatArray, metric: sp.csr_array | None
) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues and eigenvectors (as rows) of the correlation of the unknowns."""
    n = len(series)
    if metric is None:
        values, vectors = np.linalg.eigh(series.T @ series / n)
        return values, vectors.T
    # W R W x = a W x with R the correlation: symmetric, of the modes themselves
    W = metric.toarray()
    values, vectors = la.eigh(weighted.T @ weighted / n, W)
    return values, np.asarray(vectors.T)


def as_fields(rows: FloatArray, places: Places, like: NodeField) -> list[NodeField]:
    """Rows as nodal fields."""
    made = []
    for row in rows:
        start, parts = 0, {}
        for name, nodes in places:
            parts[name] = NodeValues(nodes, row[start : start + len(nodes)].copy())
            start += len(nodes)
        made.append(NodeField(like.table, parts, "DIFFUS"))
    return made
