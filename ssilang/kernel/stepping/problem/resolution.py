"""Whether a step resolves contact: the half period of the mass that a joint carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.stepping.problem.bodies import bodies_of, translation
from ssilang.kernel.stepping.problem.problem import Problem

STEPS_WANTED = 30
"""Steps per contact: at 32 the energy error of an impact is 0.05 %, at 10 some 7 %."""

SAME_DIGITS = 5e-3  # half of the last of three digits


@dataclass(frozen=True)
class Resolution:
    """Contact time `T_c = pi sqrt(m/k)` and largest step of a problem."""

    contact_time: float
    dt: float

    @property
    def wanted_dt(self) -> float:
        """Largest step that resolves contact."""
        return self.contact_time / STEPS_WANTED

    @property
    def resolved(self) -> bool:
        """Whether the step is short enough, in the three digits in which both are told."""
        return self.dt <= self.wanted_dt * (1 + SAME_DIGITS)


def contact_resolution(problem: Problem) -> Resolution | None:
    """Contact time of the joints all together, None without joints or mass.

    k is the stiffness of all joints closed under a uniform normal jump, m the mass of the bodies
    on their two sides, `1/m = 1/m_1 + 1/m_2`, moving as a whole along the mean normal (fixed
    nodes count for nothing). Bodies without mass do not count: they ring whatever the step.
    """
    joints = problem.interface
    if joints is None or problem.M.nnz == 0:
        return None
    opening = _uniform_opening(joints.pairs, joints.B, joints.size)
    force = joints.closed_stiffness() @ opening
    k = float(opening @ force)
    if k <= 0.0:
        return None
    label, motion = bodies_of(problem), translation(problem, opening.reshape(-1, joints.dimension))
    push = (joints.J.T @ (force / k)) * motion
    mass = motion * (problem.M @ motion)
    count = int(label.max()) + 1
    pushes = np.bincount(label, push, count)
    masses = np.bincount(label, mass, count)
    moving = (masses > 0.0) & (np.abs(pushes) > 1e-9)
    mobility = float(np.sum(pushes[moving] ** 2 / masses[moving]))
    if mobility <= 0.0:
        return None
    dt = float(np.diff(problem.times).max())
    return Resolution(float(np.pi / np.sqrt(k * mobility)), dt)


def _uniform_opening(pairs: IntArray, B: FloatArray, size: int) -> FloatArray:
    """Pair jumps (size,) of a unit opening along the mean normals at the pairs."""
    d = B.shape[1]
    total = np.zeros((size // d, d))
    normals = B[:, -1].reshape(len(B), -1, d)
    np.add.at(total, pairs, normals)
    length = np.linalg.norm(total, axis=1, keepdims=True)
    opening: FloatArray = (total / np.where(length > 0, length, 1.0)).ravel()
    return opening
