"""Integration points on the faces of joints: Gauss, or at the nodes."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS

GAUSS = {"SEG2": 2, "SEG3": 3, "TRI3": 3, "TRI6": 7, "QUA4": 4, "QUA8": 9}
"""Points by face: no jump is without stiffness."""

NODAL_WEIGHTS = {
    "SEG2": (1.0, 1.0),
    "SEG3": (1 / 3, 4 / 3, 1 / 3),
    "TRI3": (1 / 6, 1 / 6, 1 / 6),
    "QUA4": (1.0, 1.0, 1.0, 1.0),
}
"""Weights of integration at the nodes; serendipity faces have negative ones and are left out."""


def face_rule(face: str, rule: str = "GAUSS") -> Rule:
    """Points and weights on a face, by name of the rule.

    Parameters
    ----------
    rule : 'GAUSS' or 'LOBATTO'
        Gauss is the more accurate for the resultant of a partly open footing; points at the
        nodes avoid oscillating tractions where a joint is much stiffer than its neighbours.

    Raises
    ------
    MaterialError
        If the face has no such rule.
    """
    cell = REFERENCE_CELLS[face]
    if rule == "GAUSS":
        return quadrature(cell.shape, GAUSS[face])
    if rule == "LOBATTO" and face in NODAL_WEIGHTS:
        return Rule(cell.nodes, np.array(NODAL_WEIGHTS[face]))
    raise MaterialError(
        "kernel.interface.joints-faces-no-integration",
        face=face,
        rule=rule,
        nodal_weights=NODAL_WEIGHTS,
    )
