"""Linear statics with conditions: `K u + C^T LX = F`, `C u = d` (or >=, <=).

Equalities are eliminated where they can be (`solvers.elimination`), the rest join the matrix as
a saddle point. Unilateral conditions are found by active sets on the flexibility of their rows,
from one factorisation. Reactions come from the residual.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base import errors
from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.solvers.active_set.complementarity import ContactProblem, solve_contact
from ssilang.kernel.solvers.backends import MULTIGRID, SuperLUFactor, dissection_pays, goes_to_petsc
from ssilang.kernel.solvers.cholesky.elimination import Elimination, eliminate
from ssilang.kernel.solvers.cholesky.inverse import Inverse, invert
from ssilang.kernel.solvers.factor import FIRST_FIT, Ordering, Solver
from ssilang.kernel.statics import linear_motion
from ssilang.kernel.statics.doubled import lying_on
from ssilang.kernel.waves.matched_layer import refuse_layer_at_rest

BALANCED = 1e-7  # work of the loads on a free motion (of norms 1) taken for rounding
FEW = 8  # unilateral conditions, a solve for each: more of them want a factor
MET = 1e-7  # mismatch of a redundant condition, relative to the largest displacement


@dataclass(frozen=True, slots=True)
class SolveOptions:
    """What RESO's words change."""

    unilateral: bool = True  # False takes MINI and MAXI conditions for equalities ('NOUNIL')
    eliminate: bool = True  # False keeps every condition in a saddle point ('ELIM' 0)
    # True leaves out the loads that work on free motions instead of refusing them ('NOID')
    project: bool = False
    stabilise: bool = False  # True adds to the diagonal until the matrix is positive ('STAB')
    solver: Solver = FIRST_FIT  # which solver takes the system


@dataclass(frozen=True, eq=False)
class Solution:
    """Displacement u (n,), multipliers (n_rows,) in the rows' order, active unilateral rows."""

    u: FloatArray
    multipliers: FloatArray
    active: BoolArray
    iterations: int = 0


@dataclass(eq=False)
class LinearSystem:
    """A matrix with its conditions, factorised once."""

    numbering: assembly.Numbering
    K: sp.csr_array  # (n, n) stiffness
    rows: assembly.ConstraintRows  # conditions
    elimination: Elimination  # of the equalities that are eliminated
    saddle: IntArray  # rows that stand in the saddle point
    contact: IntArray  # rows that may be active or not
    inverse: Inverse  # of `[T^T K T, T^T D^T; C T, 0]` with the saddle rows
    last_active: BoolArray | None = None
    _flexibility: FloatArray | None = field(default=None, repr=False)

    # --- the reduced system, unknowns z = (masters, multipliers of the saddle rows)

    @property
    def lost(self) -> bool:
        """Whether the factor went with the process that held it."""
        return bool(getattr(self.inverse.factor, "lost", False))

    @property
    def n_masters(self) -> int:
        """Number of displacements that stay after elimination."""
        return len(self.elimination.masters)

    def _contact_columns(self, D: sp.csr_array) -> FloatArray:
        """Rows of `D T` at the contact rows as columns (n_masters + n_saddle, n_contact)."""
        part = (D[self.contact] @ self.elimination.T).T.toarray()
        return np.vstack([part, np.zeros((len(self.saddle), len(self.contact)))])

    @property
    def free_motions(self) -> FloatArray:
        """Displacements (n, p) that meet no stiffness."""
        return self.elimination.T @ self.inverse.kernel[: self.n_masters]

    def solve(self, f: FloatArray, d: FloatArray, project: bool = False) -> Solution:
        """Solution for forces f (n,) and imposed values d (n_rows,).

        Raises
        ------
        SingularMatrixError
            If the loads work on a free motion.
        KernelError
            If redundant conditions contradict each other.
        ConvergenceError
            If unilateral conditions find no equilibrium.
        """
        start = self.elimination.particular(d)
        free = self.elimination.T.T @ (f - self.K @ start)
        left = d[self.saddle] - self.rows.C[self.saddle] @ start
        b = np.concatenate([free, left])
        if len(self.contact):
            z, contact, active, iterations = self._solve_contact(b, d, start)
        else:
            z = self.inverse.solve(self._balanced(b, project))
            contact, active, iterations = np.empty(0), np.empty(0, bool), 0
        u = start + self.elimination.T @ z[: self.n_masters]
        self._check_redundant(u, d)
        multipliers = np.zeros(len(d))
        multipliers[self.saddle] = z[self.n_masters :]
        multipliers[self.contact] = contact
        residual = f - self.K @ u - self.rows.D.T @ multipliers
        multipliers += self.elimination.multipliers(residual)
        on = self.rows.sense == 0
        on[self.contact] = active
        return Solution(u, multipliers, on, iterations)

    def _balanced(self, b: FloatArray, project: bool) -> FloatArray:
        if not self.inverse.singular:
            return b
        work = self.inverse.work(b)
        if project:
            return self.inverse.without_work(b)
        excited = np.abs(work) > BALANCED
        if excited.any():
            motions = self.free_motions[:, excited]
            bodies = linear_motion.tied(self.numbering, self.rows.C, self.K)
            raise linear_motion.singular(
                "kernel.statics.loads-drive-motions", self.numbering, motions, bodies
            )
        return b

    def _solve_contact(
        self, b: FloatArray, d: FloatArray, start: FloatArray
    ) -> tuple[FloatArray, FloatArray, BoolArray, int]:
        """Reduced solution, multipliers of the contact rows, active rows."""
        sign = self.rows.sense[self.contact].astype(float)
        equality = sign == 0.0
        sign[equality] = 1.0
        C = self._contact_columns(self.rows.C).T
        D = self._contact_columns(self.rows.D)
        kernel = self.inverse.kernel
        z = self.inverse.solve(b)
        gap = C @ z + self.rows.C[self.contact] @ start - d[self.contact]
        if self._flexibility is None:
            self._flexibility = C @ self.inverse.solve(D)
        problem = ContactProblem(
            sign[:, None] * self._flexibility * sign,
            sign * gap,
            sign[:, None] * (C @ kernel),
            sign[:, None] * (D.T @ kernel),
            kernel.T @ b,
            equality,
        )
        try:
            found = solve_contact(problem, self.last_active)
        except errors.ConvergenceError as failure:
            raise self._loose(failure) from None
        self.last_active = found.active
        reaction = sign * found.p
        z = self.inverse.solve(b + D @ reaction) + kernel @ found.a
        return z, -reaction, found.active, found.iterations

    def _loose(self, failure: errors.ConvergenceError) -> errors.ConvergenceError:
        """The failure with the motions that only contact holds."""
        if not self.inverse.singular:
            return failure
        bodies = linear_motion.tied(self.numbering, self.rows.C[self.saddle], self.K)
        named = linear_motion.named_motions(self.numbering, self.free_motions, bodies)
        return errors.ConvergenceError(
            "kernel.statics.held-by-contact-alone", failure=failure, motions=named
        )

    def _check_redundant(self, u: FloatArray, d: FloatArray) -> None:
        mismatch = self.elimination.mismatch(u, d)
        size = np.abs(u).max(initial=0.0) + np.abs(d / self.elimination.scale).max(initial=0.0)
        if mismatch.max(initial=0.0) > MET * size:
            worst = int(np.argmax(mismatch))
            terms = self.rows.C[[worst]]
            names = [self.numbering.label(i) for i in terms.indices[:6]]
            raise errors.KernelError(
                "kernel.statics.conditions-contradict-cannot-take", names=names, d=d[worst]
            )


def linear_system(matrix: Matrix, options: SolveOptions = SolveOptions()) -> LinearSystem:
    """The matrix prepared for solving, kept in its cache for the options.

    Raises
    ------
    KernelError
        If the matrix is empty, holds values that are not finite, or a matched layer alone.
    """
    refuse_layer_at_rest(matrix)
    key = f"linear:{options}"
    numbering = assembly.numbering_of(matrix)
    kept = matrix.cache.get(key)
    if isinstance(kept, LinearSystem) and kept.numbering is numbering and not kept.lost:
        return kept
    system = _prepare(matrix, numbering, options)
    matrix.cache[key] = system
    return system


def _prepare(matrix: Matrix, numbering: assembly.Numbering, options: SolveOptions) -> LinearSystem:
    if numbering.size == 0:
        raise errors.KernelError("kernel.statics.matrix-empty-nothing-solve")
    K = assembly.assemble(matrix, numbering)
    rows = assembly.constraint_matrix(matrix, numbering)
    equality = (rows.sense == 0) | (not options.unilateral)
    lawful = equality & _associated_rows(rows)
    elimination = eliminate(rows.C, lawful & options.eliminate)
    left = ~elimination.eliminated & equality
    saddle, contact = np.flatnonzero(left), np.flatnonzero(~equality)
    reduced = saddle_point(K, rows, elimination.T, saddle)
    symmetric = assembly.is_symmetric(matrix)
    if options.stabilise:
        reduced = stabilised(reduced, len(elimination.masters))
    order = None
    if symmetric and len(saddle) == 0:
        order = _ordering(numbering, elimination, options.solver, len(contact) <= FEW)
    inverse = invert(reduced, symmetric, options.solver, order)
    return LinearSystem(numbering, K, rows, elimination, saddle, contact, inverse)


def _ordering(
    numbering: assembly.Numbering, elimination: Elimination, solver: Solver, once: bool
) -> Ordering | None:
    """Places of the unknowns left, where a solver that goes by them is the best there is."""
    n = len(elimination.masters)
    if solver.name != MULTIGRID and not goes_to_petsc(solver, n) and not dissection_pays(n):
        return None
    nodes = numbering.nodes[elimination.masters]
    rigid = linear_motion.rigid_motions(numbering)[elimination.masters]
    points = numbering.table.coordinates[nodes]
    return Ordering(points, np.zeros(0, np.int64), rigid, nodes, once)


def _associated_rows(rows: assembly.ConstraintRows) -> BoolArray:
    if rows.associated:
        return np.ones(len(rows.sense), bool)
    difference = abs(rows.C - rows.D).sum(axis=1)
    same: BoolArray = np.asarray(difference).ravel() == 0.0
    return same


def saddle_point(
    K: sp.csr_array, rows: assembly.ConstraintRows, T: sp.csr_array, saddle: IntArray
) -> sp.csr_array:
    """K (n, n) on the motions u = T z, with the saddle rows of the conditions below."""
    reduced = sp.csr_array(T.T @ K @ T)
    if len(saddle) == 0:
        return reduced
    right, below = rows.D[saddle] @ T, rows.C[saddle] @ T
    return sp.csr_array(sp.block_array([[reduced, right.T], [below, None]], format="csr"))


def stabilised(A: sp.csr_array, n: int) -> sp.csr_array:
    """A with its first n diagonal terms raised until those n unknowns are positive definite.

    The amount is the least power of ten (times the diagonal) from 1e-6 on that leaves no negative
    pivot; a positive matrix comes back as it is.
    """
    size = np.abs(A.diagonal()[:n])
    size = np.where(size > 0.0, size, size.max(initial=0.0) or 1.0)
    for amount in (0.0, *(10.0**e for e in range(-6, 3))):
        added = np.zeros(A.shape[0])
        added[:n] = amount * size
        raised = sp.csr_array(A + sp.diags_array(added))
        try:
            if SuperLUFactor(raised[:n, :n], True).negative_pivots() == 0:
                return raised
        except errors.SingularFactorError:
            continue
    return raised


def solve(
    matrix: Matrix,
    loads: Sequence[NodeField],
    options: SolveOptions = SolveOptions(),
) -> list[NodeField]:
    """Displacement fields (with LX at the multipliers) for each second member.

    A second member holds forces by dual names and imposed values FLX at the multipliers.

    Raises
    ------
    As `LinearSystem.solve`.
    """
    system = linear_system(matrix, options)
    solutions = []
    for load in loads:
        f = assembly.field_to_vector(load, system.numbering)
        if not options.project:
            _taken(load, system.numbering)
        d = assembly.imposed_values(load, system.rows.multipliers)
        wrong = np.flatnonzero(~np.isfinite(f))
        if len(wrong) or not np.isfinite(d).all():
            at = [system.numbering.label(int(i)) for i in wrong[:1]]
            raise errors.KernelError("kernel.statics.load-not-finite", at=at)
        found = system.solve(f, d, options.project)
        pair = (system.rows.multipliers, found.multipliers)
        solutions.append(assembly.vector_to_field(found.u, system.numbering, multipliers=pair))
    return solutions


def _taken(load: NodeField, numbering: assembly.Numbering) -> None:
    """Refuse forces that no unknown of the matrix takes."""
    lost = assembly.outside(load, numbering)
    if lost:
        strange = np.setdiff1d(load.node_ids, numbering.nodes)
        above, below = lying_on(load.table, strange, np.unique(numbering.nodes))
        told = {"lost": lost[:4], "more": len(lost[4:]), "n_above": len(above)}
        first = [load.table.told(n[0]) if len(above) else None for n in (above, below)]
        code = "kernel.statics.matrix-no-unknown-force"
        raise errors.KernelError(code, above=first[0], below=first[1], **told)


def reactions(matrix: Matrix, solution: NodeField) -> NodeField:
    """Forces that the conditions in the matrix apply on the body, `-C^T LX` (REAC).

    Only the relations of the matrix count; the field is empty if it has none.

    Raises
    ------
    KernelError
        If the solution lacks multipliers of the relations; a field without components is zero.
    """
    numbering = assembly.numbering_of(matrix)
    rows = assembly.constraint_matrix(matrix, numbering)
    _require_multipliers(rows, numbering, solution)
    multipliers = solution.values_at(assembly.MULTIPLIER, rows.multipliers)
    forces = -(rows.D.T @ multipliers)
    used = np.diff(sp.csc_array(rows.D).indptr) > 0
    return assembly.vector_to_field(forces[used], numbering.some(used), dual=True)


def _require_multipliers(
    rows: assembly.ConstraintRows, numbering: assembly.Numbering, solution: NodeField
) -> None:
    part = solution.components.get(assembly.MULTIPLIER)
    there = np.empty(0, dtype=np.int64) if part is None else part.nodes
    missing = np.flatnonzero(~np.isin(rows.multipliers, there))
    if not len(missing) or not solution.components:
        return
    held = rows.C[[int(missing[0])]].indices
    told = {"missing": len(missing), "n_rows": len(rows.multipliers), "others": len(there)}
    at = [numbering.label(int(i)) for i in held[:1]]
    raise errors.KernelError("kernel.statics.solution-without-multipliers", at=at, **told)


def product(matrix: Matrix, field_: NodeField) -> NodeField:
    """The field of forces `K u` (and C^T LX, C u at the multipliers), by dual names."""
    numbering = assembly.numbering_of(matrix)
    rows = assembly.constraint_matrix(matrix, numbering)
    u = assembly.field_to_vector(field_, numbering, dual=False)
    multipliers = field_.values_at("LX", rows.multipliers)
    forces = assembly.assemble(matrix, numbering) @ u + rows.D.T @ multipliers
    return assembly.vector_to_field(
        forces, numbering, dual=True, multipliers=(rows.multipliers, rows.C @ u)
    )
