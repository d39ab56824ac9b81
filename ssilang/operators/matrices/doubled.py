"""The warning that a support holds nodes beside the body: lines made twice."""

from __future__ import annotations

from typing import Any

from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.matrix import Matrix

_KEY = "doubled supports"


def warn_doubled_supports(
    session: Any, span: Any, operator: str, matrix: Matrix, model: Model | None = None
) -> None:
    """Warn, once a matrix, of held nodes without stiffness that lie on nodes of the body.

    Nodes of `model` (joints whose law stands beside the matrix) are used and not warned of.
    """
    from ssilang.kernel.statics.doubled import doubled_supports

    if _KEY in matrix.cache:
        return
    used = None if model is None or not model.zones else model.mesh.node_ids
    matrix.cache[_KEY] = found = doubled_supports(matrix, used)
    if found is None:
        return
    x, y, z = matrix.table.coordinates[found.held[0]]
    session.warn(
        "operators.matrices.held-nodes-without-stiffness",
        span,
        operator=operator,
        n_held=len(found.held),
        x=x,
        y=y,
        z=z,
    )
