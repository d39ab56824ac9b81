"""Steps whose matrices and loads a caller makes as the motion goes.

At the start and before each step the driver sees the state and gives what to add at the end of
the step: forces, imposed values, stiffness, damping, relations. Matrices are factorised again
only when they change.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.contact.rows import BoolArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.stepping.choose import Case, Choice, RenewableLoop, choose, refuse_combinations
from ssilang.kernel.stepping.problem.constraints import constraints_of
from ssilang.kernel.stepping.problem.loading import Loading
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.state import Motion


@dataclass(frozen=True, eq=False)
class Additions:
    """What acts at one instant beside the problem itself."""

    stiffness: Matrix | None = None  # added to K
    damping: Matrix | None = None  # added to C
    operator: Matrix | None = None  # its stiffness is added to K, its relations to the conditions
    force: NodeField | None = None  # forces by dual names; imposed values FLX at multipliers
    imposed: NodeField | None = None

    @property
    def matrices(self) -> tuple[Matrix | None, Matrix | None, Matrix | None]:
        """The three matrices."""
        return self.stiffness, self.damping, self.operator


@dataclass(frozen=True, eq=False)
class State:
    """Displacement, velocity, acceleration (n,) at one instant."""

    time: float
    u: FloatArray
    v: FloatArray
    a: FloatArray


Driver = Callable[[float, State, Problem], Additions]
"""`driver(t, state, problem)`: additions at t, from the state at the start of the step."""


class Drive:
    """A problem and its driver, step by step."""

    def __init__(self, problem: Problem, driver: Driver, full_newton: bool) -> None:
        self.problem = self._given = problem
        self.driver, self._full = driver, full_newton
        refuse_combinations(problem, full_newton)
        self._last = Additions()
        self._time = float(problem.times[0])
        self._choice: Choice | None = None
        self._made_of: tuple[object, ...] = ()

    def start(self) -> Problem:
        """The problem at the first instant."""
        p = self._given
        state = State(self._time, p.u, p.v, np.zeros_like(p.u))
        self._last = self.driver(self._time, state, p)
        first = changed(p, Additions(), self._last)
        curves = p.loading.curves + ((np.zeros(1), np.ones(1)),) * 2
        self.problem = replace(first, loading=replace(first.loading, curves=curves))
        return self.problem

    def choice(
        self, motion: Motion, dt: float, time: float, factors: FloatArray, closed: BoolArray
    ) -> tuple[Choice, FloatArray]:
        """The loop of the step that ends at `time`, and its load factors (2, k + 2)."""
        state = State(self._time, motion.u.copy(), motion.v.copy(), motion.a.copy())
        new = self.driver(time, state, self._given)
        self.problem = changed(self._given, self._last, new)
        made_of = (dt, *new.matrices)
        same = len(made_of) == len(self._made_of) and all(
            a is b or a == b for a, b in zip(made_of, self._made_of, strict=True)
        )
        if self._choice is None or not same:
            case = Case(self.problem, motion, dt, self._full, closed)
            self._choice = choose(case, renewable=True)
            self._made_of = made_of
        cast(RenewableLoop, self._choice.loop).renew(self.problem)
        self._last, self._time = new, time
        return self._choice, np.hstack([factors, np.eye(2)])


def changed(problem: Problem, start: Additions, end: Additions) -> Problem:
    """The problem of a step with what is added at its start and end.

    Its loading has two more columns, the additions at the start and at the end.

    Raises
    ------
    KernelError
        For unknowns that the problem lacks, and for unilateral relations.
    """
    K = _plus(problem, problem.K, end.stiffness, end.operator)
    C = _plus(problem, problem.C, end.damping)
    problem = _with_relations(problem, end.operator)
    loading = problem.loading
    multipliers = problem.multipliers
    forces = np.column_stack([loading.forces, _force(problem, start), _force(problem, end)])
    imposed = np.column_stack(
        [loading.imposed, _imposed(start, multipliers), _imposed(end, multipliers)]
    )
    contact = problem.contact
    values = [contact.sense * _imposed(a, contact.multipliers) for a in (start, end)]
    contact = replace(contact, imposed=np.column_stack([contact.imposed, *values]))
    loading = Loading(forces, imposed, loading.curves)
    return replace(problem, K=K, C=C, loading=loading, contact=contact)


def _plus(problem: Problem, own: sp.csr_array, *more: Matrix | None) -> sp.csr_array:
    """A matrix of the problem with those that are added; itself where none is."""
    for matrix in more:
        if matrix is not None and matrix.blocks:
            own = sp.csr_array(own + _added(problem, matrix))
    return own


def _added(problem: Problem, matrix: Matrix) -> sp.csr_array:
    bare = replace(matrix, relations=(), cache={})
    own = assembly.numbering_of(bare)
    keys = set(zip(problem.numbering.nodes.tolist(), _names(problem.numbering), strict=True))
    lost = [k for k in zip(own.nodes.tolist(), _names(own), strict=True) if k not in keys]
    if lost:
        raise KernelError(
            "kernel.stepping.matrix-added-during-calculation",
            lost=lost[0][1],
            lost_2=matrix.table.told(lost[0][0]),
        )
    return assembly.assemble(bare, problem.numbering)


def _names(numbering: object) -> list[str]:
    return [numbering.unknowns[c] for c in numbering.codes]  # type: ignore[attr-defined]


def _with_relations(problem: Problem, operator: Matrix | None) -> Problem:
    """The problem with the relations of a matrix among its conditions."""
    if operator is None or not operator.relations:
        return problem
    rows = assembly.constraint_matrix(replace(operator, blocks=(), cache={}), problem.numbering)
    if rows.sense.any():
        raise KernelError("kernel.stepping.unilateral-relations-mini-maxi")
    held = problem.constraints
    C = sp.csr_array(sp.vstack([held.C, rows.C], format="csr"))
    D = C
    if not (held.associated and rows.associated):
        D = sp.csr_array(sp.vstack([held.D, rows.D], format="csr"))
    multipliers = np.concatenate([problem.multipliers, rows.multipliers])
    sense = np.zeros(len(multipliers), np.int8)
    extra = np.zeros((len(rows.multipliers), problem.loading.imposed.shape[1]))
    loading = replace(problem.loading, imposed=np.vstack([problem.loading.imposed, extra]))
    constraints = constraints_of(assembly.ConstraintRows(C, multipliers, sense, D), problem.small)
    return replace(problem, constraints=constraints, multipliers=multipliers, loading=loading)


def _force(problem: Problem, additions: Additions) -> FloatArray:
    found = np.zeros(problem.numbering.size)
    for given in (additions.force, additions.imposed):
        if given is None:
            continue
        lost = assembly.outside(given, problem.numbering)
        if lost:
            raise KernelError("kernel.stepping.force-added-on-missing-unknowns", lost=lost[0])
        found += assembly.field_to_vector(given, problem.numbering)
    if not np.isfinite(found).all():
        raise KernelError("kernel.stepping.force-added-during-calculation")
    return found


def _imposed(additions: Additions, multipliers: IntArray) -> FloatArray:
    found = np.zeros(len(multipliers))
    for given in (additions.force, additions.imposed):
        if given is not None:
            found += assembly.imposed_values(given, multipliers)
    return found
