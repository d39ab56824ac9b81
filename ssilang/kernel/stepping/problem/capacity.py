"""What presses on ground that yields, against what the ground bears."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.interface.bed import Bed
from ssilang.kernel.interface.family import displacement_names
from ssilang.kernel.stepping.problem.bodies import FREE, ROUNDING, bodies_of
from ssilang.kernel.stepping.problem.problem import Problem


@dataclass(frozen=True)
class Overload:
    """A footing whose loads press more than its ground bears.

    Attributes
    ----------
    node : int
    pressing, capacity : float
        Forces (N).
    """

    node: int
    pressing: float
    capacity: float


def overloads(problem: Problem, factors: FloatArray) -> list[Overload]:
    """Macro-elements whose ground bears less than the loads on the body above press.

    Bodies that something else holds, or several macro-elements, are left out: how they share the
    loads is not known beforehand.

    Parameters
    ----------
    factors : array (n_loads,)
        Of the loads at an instant.
    """
    joints = problem.interface
    if joints is None or not joints.beds:
        return []
    label = bodies_of(problem)
    force = problem.loading.forces @ factors
    held = [label[_above(problem, bed)[0]] for bed in joints.beds]
    found = []
    for bed, body in zip(joints.beds, held, strict=True):
        motion = np.where(label == body, _translation(problem, bed), 0.0)
        resisting = motion @ (problem.K @ motion)
        natural = motion**2 @ abs(problem.K.diagonal())
        if held.count(body) > 1 or abs(resisting) > ROUNDING * natural:
            continue
        pressing = -float(motion @ force)
        if pressing > bed.capacity:
            node = int(problem.numbering.nodes[_above(problem, bed)[0]])
            found.append(Overload(node, pressing, bed.capacity))
    return found


def _above(problem: Problem, bed: Bed) -> list[int]:
    """Displacements of a macro-element's upper node."""
    assert problem.interface is not None
    joints, cell = problem.interface.cell_of(bed)
    node = int(joints.zone.cells.nodes.resolve(joints.upper[cell]).ravel()[0])
    return [problem.numbering.index_of(node, name) for name in displacement_names(joints.zone)]


def _translation(problem: Problem, bed: Bed) -> FloatArray:
    """Motion (n,) of all that is not fixed along the normal of a macro-element."""
    assert problem.interface is not None
    joints, cell = problem.interface.cell_of(bed)
    motion = np.zeros(problem.numbering.size)
    for name, value in zip(
        displacement_names(joints.zone), joints.frames[cell, 0, -1], strict=True
    ):
        motion[problem.numbering.where(name)] = value
    fixed = np.asarray(abs(problem.constraints.T).sum(axis=1)).ravel() <= FREE
    return np.where(fixed, 0.0, motion)


# How stiff joints are against the bodies that they join: a slip of units shows here.

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
