"""Words for motions that meet no stiffness: rigid-body motions, and what is free in them."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.matrices.assembly import Numbering
from ssilang.kernel.mesh.nodes import FloatArray

_TRANSLATIONS = {"UX": 0, "UY": 1, "UZ": 2, "UR": 0}
_ROTATIONS = {"RX": 0, "RY": 1, "RZ": 2}
_NAMES = ("X", "Y", "Z")


def rigid_motions(numbering: Numbering) -> FloatArray:
    """Unit translations along X, Y, Z and small rotations about them at the origin, (n, 6).

    Rotations are about the mean of the nodes. In axisymmetric models the columns that are no
    rigid motions there simply fit nothing.
    """
    points = numbering.table.coordinates[numbering.nodes]
    points = points - points.mean(axis=0)
    motions = np.zeros((numbering.size, 6))
    for name, axis in _TRANSLATIONS.items():
        at = numbering.where(name) if name in numbering.unknowns else np.empty(0, np.int64)
        motions[at, axis] = 1.0
        for turn in range(3):
            unit = np.eye(3)[turn]
            motions[at, 3 + turn] = np.cross(unit, points[at])[:, axis]
    for name, axis in _ROTATIONS.items():
        if name in numbering.unknowns:
            motions[numbering.where(name), 3 + axis] = 1.0
    return motions


def describe_motions(numbering: Numbering, motions: FloatArray) -> tuple[str, str]:
    """Message and hint for free motions (n, p) of a system.

    Each basic rigid motion that lies in their span is named; what remains is named by the
    unknowns that move most.
    """
    span = np.linalg.qr(motions)[0]
    rigid = rigid_motions(numbering)
    size = np.linalg.norm(rigid, axis=0)
    outside = np.linalg.norm(rigid - span @ (span.T @ rigid), axis=0)
    named = [
        f"{'translation along' if k < 3 else 'rotation about'} {_NAMES[k % 3]}"
        for k in np.flatnonzero(size > 0.0)
        if outside[k] < 1e-6 * size[k]
    ]
    count = motions.shape[1]
    what = "free motion" if count == 1 else "free motions"
    message = f"the matrix is singular: the loads drive {count} {what}"
    if named:
        message += " (" + ", ".join(named) + ")"
    return message, "not held: " + _most_moved(numbering, span) + "; hold it with BLOQ or RELA"


def _most_moved(numbering: Numbering, span: FloatArray, limit: int = 6) -> str:
    """Labels of the unknowns that move most, one for each motion, at most `limit`."""
    rest = span.copy()
    labels = []
    for _ in range(min(limit, span.shape[1])):
        size = np.linalg.norm(rest, axis=1)
        row = int(np.argmax(size > (1.0 - 1e-6) * size.max()))
        labels.append(numbering.label(row))
        direction = rest[row] / (np.linalg.norm(rest[row]) or 1.0)
        rest = rest - np.outer(rest @ direction, direction)
    more = span.shape[1] - len(labels)
    return ", ".join(labels) + (f" and {more} more" if more > 0 else "")
