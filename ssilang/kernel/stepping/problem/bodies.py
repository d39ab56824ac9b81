"""The bodies of a problem, and which of them joints alone hold."""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.family import displacement_names, has_rotations
from ssilang.kernel.statics.linear_motion import tied, without_pairs
from ssilang.kernel.stepping.problem.problem import Problem

ROUNDING = 1e-9  # stiffness against a translation, relative to the diagonal

_KNOWN: WeakKeyDictionary[Problem, IntArray] = WeakKeyDictionary()
"""Bodies of problems that are still there: several looks at a start need them."""


@dataclass(frozen=True)
class LooseBody:
    """A body that nothing but joints holds along their normal."""

    node: int  # one of its nodes at a joint
    mass: float  # that moves with it
    open_points: int  # of the joints at the body, those without compression
    points: int  # of the joints at the body, all


def bodies_of(problem: Problem) -> IntArray:
    """Number of the body of each unknown: what stiffness, mass and relations tie together.

    The unknowns of one node belong together.
    """
    if problem not in _KNOWN:
        joints, K = problem.interface, problem.K
        turning = [j for j in joints.joints if has_rotations(j.zone)]
        if turning:  # whose turns or shear stand in the stiffness
            sides = [np.stack([j.lower, j.upper]).reshape(2, -1) for j in turning]
            K = without_pairs(K, problem.numbering, *np.concatenate(sides, axis=1))
        _KNOWN[problem] = tied(problem.numbering, problem.constraints.C, K, problem.M)
    return _KNOWN[problem]


def held(problem: Problem) -> BoolArray:
    """Which unknowns (n,) the conditions leave no motion."""
    return np.asarray(abs(problem.constraints.T).sum(axis=1)).ravel() <= ROUNDING


def translation(problem: Problem, normals: FloatArray) -> FloatArray:
    """Motion (n,) of everything that is not fixed along the mean of normals (n_pairs, d)."""
    mean = normals.mean(axis=0)
    mean = mean / (np.linalg.norm(mean) or 1.0)
    motion = np.zeros(problem.numbering.size)
    zone = problem.interface.joints[0].zone
    for name, value in zip(displacement_names(zone), mean, strict=True):
        motion[problem.numbering.where(name)] = value
    return np.where(held(problem), 0.0, motion)


def loose_bodies(problem: Problem, t: FloatArray) -> list[LooseBody]:
    """Bodies that only joints hold along the mean normal, at tractions t (n_points, d)."""
    joints = problem.interface
    if not joints:
        return []
    d = joints.dimension
    normals = joints.B[:, -1].reshape(joints.n_points, -1, d)
    motion = translation(problem, normals.reshape(-1, d))
    label = bodies_of(problem)
    count = int(label.max()) + 1
    resisting = np.bincount(label, motion * (problem.K @ motion), count)
    natural = np.bincount(label, motion**2 * abs(problem.K.diagonal()), count)
    moving = np.bincount(label, motion**2, count) > 0.0
    mass = np.bincount(label, motion * (problem.M @ motion), count)
    loose = moving & (np.abs(resisting) <= ROUNDING * natural)
    at_point = _bodies_at_points(problem, label, count, normals)
    opened = t[:, -1] >= 0.0
    found = []
    for body in np.flatnonzero(loose & at_point.any(axis=0)):
        here = at_point[:, body]
        found.append(
            LooseBody(
                _node_at_joint(problem, label == body),
                float(mass[body]),
                int((here & opened).sum()),
                int(here.sum()),
            )
        )
    return found


def _bodies_at_points(
    problem: Problem, label: IntArray, count: int, normals: FloatArray
) -> NDArray[np.bool_]:
    """Which bodies each joint point touches, (n_points, n_bodies)."""
    joints = problem.interface
    d, n = joints.dimension, joints.n_points
    member = sp.csr_array((np.ones(len(label)), (np.arange(len(label)), label)))
    touched = (abs(joints.J) @ member).toarray().reshape(-1, d, member.shape[1])
    rows: NDArray[np.bool_] = touched.sum(axis=1) > 0.0
    used = (normals != 0.0).any(axis=2)  # padded pairs have no share
    found = np.zeros((n, count), bool)
    for k in range(joints.pairs.shape[1]):
        found |= rows[joints.pairs[:, k]] & used[:, k : k + 1]
    return found


def _node_at_joint(problem: Problem, mine: NDArray[np.bool_]) -> int:
    columns = np.unique(problem.interface.J.indices)
    return int(problem.numbering.nodes[columns[mine[columns]]].min())


def full_uplift(problem: Problem, t: FloatArray) -> LooseBody | None:
    """A body without mass whose joints are all open, None if there is none."""
    return next(
        (b for b in loose_bodies(problem, t) if b.mass == 0.0 and b.open_points == b.points), None
    )
