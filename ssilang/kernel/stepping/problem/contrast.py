"""How stiff joints are against the bodies that they join: a slip of units shows here."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.stepping.problem.problem import Problem

STRANGE = 1e8
"""Ratio that no joint needs: half of the digits are lost in the sum of both stiffnesses."""


def stiffness_contrast(problem: Problem) -> float | None:
    """Stiffness of the closed joints over that of the bodies at the same unknowns.

    Median over the unknowns that both have; None where there are none (bodies held by joints
    alone).
    """
    joints = problem.interface
    if joints is None:
        return None
    closed = np.diag(joints.closed_stiffness())
    of_joints = abs(joints.J).T @ closed
    of_bodies = problem.K.diagonal()
    both = (of_joints > 0.0) & (of_bodies > 0.0)
    if not both.any():
        return None
    return float(np.median(of_joints[both] / of_bodies[both]))
