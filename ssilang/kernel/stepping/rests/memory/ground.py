"""The linear body that joints alone hold, and of which nobody asks results: the ground as a rule.

Where the joints are all that bodies have in common, a motion asks of the largest one for the motion
of its side of the joints and no more.
"""

from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, BoolArray, FloatArray, IntArray
from ssilang.kernel.base.scientific import sp
from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import Supernode, supernodes
from ssilang.kernel.solvers.factor import FIRST_FIT
from ssilang.kernel.stepping.effective import effective_matrix, effective_of
from ssilang.kernel.stepping.newmark import Newmark, newmark_of
from ssilang.kernel.stepping.problem.constraints import split_damping
from ssilang.kernel.stepping.problem.initial import joint_state
from ssilang.kernel.stepping.problem.loading import Loading
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.reduced.basis import NoReduction

TOLD_BY = 4  # motions that tell grounds apart
REST = 1e-3  # of the joints' forces: what may be out of balance where a motion starts


@dataclass(frozen=True, eq=False)
class Ground:
    """A body and its part of the jumps, for steps of one length."""

    problem: Problem
    T: sp.csr_array  # (n, r) motions of the problem that are the body's
    loads: IntArray  # (k,) loads that act on it

    @cached_property
    def dt(self) -> float:
        """The step."""
        return float(np.median(np.diff(self.problem.times)))

    @cached_property
    def newmark(self) -> Newmark:
        """Coefficients of the scheme."""
        return newmark_of(self.problem.scheme, self.dt)

    @cached_property
    def loading(self) -> tuple[FloatArray, FloatArray]:
        """Forces (r, k) of norm one, and factors (n_steps + 1, k) of these, less the first ones."""
        p = self.problem
        forces = self.T.T @ p.loading.forces[:, self.loads]
        size = np.maximum(np.linalg.norm(forces, axis=0), np.finfo(float).tiny)
        factors = p.loading.at(p.times)[:, self.loads]
        return forces / size, (factors - factors[0]) * size

    @cached_property
    def J(self) -> sp.csr_array:  # noqa: N802
        """Its part (q, r) of the jumps."""
        return sp.csr_array(self.problem.interface.J @ self.T)

    @cached_property
    def places(self) -> FloatArray:
        """Of its pairs (q / d, dimension), each with d jumps."""
        joints, numbering = self.problem.interface, self.problem.numbering
        at = joints.J.indices[joints.J.indptr[: -1 : joints.dimension]]
        return numbering.table.coordinates[numbering.nodes[at]]

    @cached_property
    def _seen(self) -> FloatArray:
        """Motions (r, `TOLD_BY`) by which grounds and loads are told apart."""
        return np.random.default_rng(0).standard_normal((self.T.shape[1], TOLD_BY))

    @cached_property
    def mark(self) -> FloatArray:
        """Numbers that tell it and the scheme from others, but for rounding."""
        p, s = self.problem, self.problem.scheme
        x = self.T @ self._seen
        forms = [np.einsum("ij,ij->j", x, A @ x) for A in (p.M, p.C, p.K)]
        jumps = np.random.default_rng(1).standard_normal(self.J.shape[0]) @ (self.J @ self._seen)
        sizes = [*self.J.shape, s.alpha_m, s.alpha_f, s.beta, s.gamma]
        return np.concatenate([sizes, *forms, jumps])

    @property
    def loads_mark(self) -> FloatArray:
        """The same of its loads."""
        return (self.loading[0].T @ self._seen).ravel()

    @cached_property
    def steps(self) -> "GroundSteps":
        """What stepping it takes.

        Raises
        ------
        NoReduction
            If it has no factor by dissection.
        """
        p = self.problem
        constraints = copy(p.constraints)
        constraints.T = constraints.V = self.T
        none = interface_of((), None, p.numbering)
        alone = replace(p, constraints=constraints, interface=none, solver=FIRST_FIT)
        A = effective_matrix(alone, self.dt)
        inverse = effective_of(alone, A, self.dt, 1.0, free=True, least=0).inverse
        factor = inverse.factor
        if inverse.singular or not isinstance(factor, DissectedFactor):
            raise NoReduction("kernel.stepping.memory-no-factor")
        order = factor.tree.order
        scaling = sp.csr_array(sp.csc_array(sp.diags_array(inverse.scale))[:, order])
        T = sp.csr_array(self.T @ scaling)
        M, C, K = (sp.csr_array(T.T @ X @ T) for X in (p.M, p.C, p.K))
        alpha, beta, rest = split_damping(C, M, K)
        L = tuple(supernodes(factor.panels, SINGLE))
        few = (X.astype(SINGLE) for X in (M, rest, sp.csr_array(self.J @ scaling)))
        forces = np.asarray(scaling.T @ self.loading[0], SINGLE)
        mark = np.append(self.mark, self.loads_mark)
        return GroundSteps(mark, L, alpha, beta, self.newmark, forces, *few)


@dataclass(frozen=True, eq=False)
class GroundSteps:
    """A body in the order of its factor, single precision."""

    mark: FloatArray  # of the ground and its loads
    factor: tuple[Supernode, ...]  # of the step's matrix
    alpha: float  # the damping is `alpha M + beta K + rest`
    beta: float
    newmark: Newmark
    forces: FloatArray  # (r, k) of each load, of norm one
    M: sp.csr_array  # (r, r)
    rest: sp.csr_array
    J: sp.csr_array  # (q, r) its part of the jumps


def alike(one: FloatArray, other: FloatArray) -> bool:
    """Whether two marks are those of one thing."""
    return one.shape == other.shape and np.allclose(one, other, rtol=1e-8, atol=1e-8)


@dataclass(frozen=True, eq=False)
class Parts:
    """A problem without its ground, and the ground."""

    near: Problem
    ground: Ground
    rows: IntArray  # (p,) unknowns of the problem on the ground's side of the joints
    back: sp.csr_array  # (p, q) these from the ground's part of the jumps


def parts_of(problem: Problem, asked: BoolArray) -> Parts:
    """A problem in two; `asked` (n,) are the unknowns of which results are wanted.

    Raises
    ------
    NoReduction
        If no body hangs on by joints alone, starts at rest on supports that rest, and has no more
        asked of it than the motion of its joints.
    """
    p, T, joints = problem, problem.constraints.T, problem.interface
    coupled = sp.csr_array(T.T @ (abs(p.K) + abs(p.M) + abs(p.C)) @ T)
    count, body = sp.csgraph.connected_components(coupled, directed=False)
    far = body == np.argmax(np.bincount(body, minlength=1))
    own = sp.csr_array(T[:, far])
    rows = np.flatnonzero(np.diff(own.indptr))
    if count < 2 or not joints.J[:, rows].nnz:
        raise NoReduction("kernel.stepping.memory-one-body")
    if p.loading.imposed.any():
        raise NoReduction("kernel.stepping.memory-supports-move")
    touched, back = _back(sp.csr_array(joints.J[:, rows]), rows)
    outside = np.setdiff1d(rows[asked[rows]], touched)
    if len(outside):
        node = p.numbering.table.told(int(p.numbering.nodes[outside[0]]))
        raise NoReduction("kernel.stepping.memory-results-asked", node=node)
    held = joints.J.T @ joint_state(p).f
    load = p.loading.forces @ p.loading.at(p.times[:1])[0]
    left = own.T @ (p.K @ p.u + held - load)
    if p.v[rows].any() or np.linalg.norm(left) > REST * np.linalg.norm(own.T @ held):
        raise NoReduction("kernel.stepping.memory-not-at-rest")
    keep = np.ones(p.numbering.size)
    keep[rows] = 0.0
    constraints, others = copy(p.constraints), sp.diags_array(keep)
    constraints.T = constraints.V = sp.csr_array(T[:, ~far])
    K, M, C = (sp.csr_array(others @ A) for A in (p.K, p.M, p.C))
    for A in (K, M, C):
        A.eliminate_zeros()  # most of what was read
    loads, above = (np.flatnonzero(p.loading.forces[x].any(axis=0)) for x in (rows, keep > 0.0))
    loading = Loading(
        p.loading.forces[:, above] * keep[:, None], p.loading.imposed[:, above],
        tuple(p.loading.curves[i] for i in above),
    )  # fmt: skip
    near = replace(
        p, constraints=constraints, loading=loading, K=K, M=M, C=C, solver=FIRST_FIT,
        contact=replace(p.contact, imposed=p.contact.imposed[:, above]),
    )  # fmt: skip
    return Parts(near, Ground(p, own, loads), touched, back)


def _back(J: sp.csr_array, rows: IntArray) -> tuple[IntArray, sp.csr_array]:
    """Unknowns that have jumps of their own, and these unknowns from the jumps."""
    gram = sp.csr_array(J.T @ J)
    alone = np.flatnonzero((np.diff(gram.indptr) == 1) & (gram.diagonal() > 0.0))
    return rows[alone], sp.csr_array(sp.diags_array(1.0 / gram.diagonal()[alone]) @ J[:, alone].T)
