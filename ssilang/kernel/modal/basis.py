"""Projection on shapes and recombination: `F* = X^T F`, `K* = X^T K X`, `u = X q`.

Stiffness, mass and damping on the motions that the conditions allow.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices import assembly
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations, dual_of
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers.cholesky.elimination import Elimination, eliminate
from ssilang.kernel.solvers.factor import FIRST_FIT, Ordering, Solver
from ssilang.kernel.statics.linear_motion import rigid_motions

MULTIPLIERS = ("LX", "FLX")


def work(force: NodeField, shape: NodeField, same_names: bool = False) -> float:
    """Sum of the products of forces (FX ...) and displacements (UX ...) at the nodes of both.

    `same_names` multiplies components of equal names instead.
    """
    total = 0.0
    for name, part in shape.components.items():
        other = force.components.get(name if same_names else dual_of(name))
        if other is not None and name not in MULTIPLIERS:
            total += float(part.values @ other.at(part.nodes))
    return total


def combined(factors: Sequence[float], fields: Sequence[NodeField]) -> NodeField:
    """Linear combination of fields; a component absent at a node counts as zero."""
    parts: dict[str, NodeValues] = {}
    for name in dict.fromkeys(n for f in fields for n in f.components):
        nodes = np.unique(
            np.concatenate([f.components[name].nodes for f in fields if name in f.components])
        )
        total = np.zeros(len(nodes))
        for factor, field in zip(factors, fields, strict=True):
            total += factor * field.values_at(name, nodes)
        parts[name] = NodeValues(nodes, total)
    return NodeField(fields[0].table, parts, fields[0].nature)


def projected_matrix(
    matrix: Matrix,
    shapes: Sequence[NodeField],
    marks: IntArray,
    unknowns: Sequence[str],
    duals: Sequence[str],
) -> Matrix:
    """`X^T K X` as one element matrix on the points that mark the shapes (n,)."""
    numbering = assembly.numbering_of(matrix)
    X = np.stack([assembly.field_to_vector(s, numbering, dual=False) for s in shapes], axis=1)
    values: FloatArray = X.T @ (assembly.assemble(matrix, numbering) @ X)
    symmetric = all(b.symmetric for b in matrix.blocks)
    return on_marks(matrix.table, values, marks, unknowns, duals, matrix.kind, symmetric)


def on_marks(
    table: NodeTable,
    values: FloatArray,
    marks: IntArray,
    unknowns: Sequence[str],
    duals: Sequence[str],
    kind: str,
    symmetric: bool = True,
) -> Matrix:
    """Values (n, n) as one element matrix on the points that mark n shapes; symmetrised if so."""
    if symmetric:
        values = 0.5 * (values + values.T)
    block = ElementMatrices.of_one(table, marks, unknowns, duals, values, kind, symmetric)
    return Matrix(table, (block,), (), kind)


def projected_relations(
    matrix: Matrix, shapes: Sequence[NodeField], marks: IntArray, unknowns: Sequence[str]
) -> Matrix:
    """Conditions on the body as conditions `C X q = d` on the participations q.

    Rows that no shape touches are left out; multipliers stay those of the body's conditions.
    """
    rows = assembly.constraint_matrix(matrix)
    numbering = assembly.numbering_of(matrix)
    X = np.stack([assembly.field_to_vector(s, numbering, dual=False) for s in shapes], axis=1)
    values = rows.C @ X
    small = 1e-12 * np.abs(values).max(initial=0.0)
    kept = np.flatnonzero((np.abs(values) > small).any(axis=1))
    terms = [np.flatnonzero(np.abs(values[i]) > small) for i in kept]
    counts = np.array([len(t) for t in terms], dtype=np.int64)
    flat = np.concatenate(terms) if terms else np.zeros(0, dtype=np.int64)
    found = Relations(
        matrix.table,
        np.concatenate([[0], np.cumsum(counts)]),
        marks[flat],
        tuple(unknowns[i] for i in flat.tolist()),
        values[np.repeat(kept, counts), flat],
        rows.multipliers[kept],
        rows.sense[kept],
    )
    return Matrix(matrix.table, (), (found,), matrix.kind)


def static_complement(
    static: NodeField,
    shapes: Sequence[NodeField],
    works: Sequence[float],
    stiffnesses: Sequence[float],
) -> NodeField:
    """What modes leave out of a static response: `u - sum (work_i / k_i) shape_i`."""
    factors = [1.0, *(-w / k for w, k in zip(works, stiffnesses, strict=True))]
    return combined(factors, [static, *shapes])


@dataclass(frozen=True, eq=False)
class ReducedProblem:
    """Matrices on the unknowns q that stay, `u = T q`, with the conditions `S q = 0` left over."""

    numbering: assembly.Numbering
    stiffness: sp.csr_array  # (n, n) on `numbering`, for reactions
    mass: sp.csr_array  # (n, n) on `numbering`, for generalised masses
    K: sp.csr_array  # (r, r)
    M: sp.csr_array  # (r, r)
    C: sp.csr_array | None  # (r, r) damping
    S: sp.csr_array  # (m, r) conditions too full to be eliminated
    T: sp.csr_array  # (n, r)
    symmetric: bool
    elimination: Elimination
    multipliers: IntArray  # (n_rows,) multiplier nodes of all conditions
    solver: Solver = FIRST_FIT  # which solver takes `K - s M`

    @property
    def size(self) -> int:
        """Number of unknowns that stay."""
        return int(self.K.shape[0])

    def bordered(self, A: sp.csr_array) -> sp.csr_array:
        """`[A S^T; S 0]`, or A itself if no condition is left."""
        if self.S.shape[0] == 0:
            return A
        return sp.csr_array(sp.block_array([[A, self.S.T], [self.S, None]], format="csr"))

    @property
    def ordering(self) -> Ordering:
        """Places of the unknowns that stay, for solvers that go by them."""
        own = np.asarray(abs(self.T).argmax(axis=0)).ravel()
        points = self.numbering.table.coordinates[self.numbering.nodes[own]]
        rigid = None
        if self.solver.petsc is not None:  # it may have no memory for a factor
            rigid = rigid_motions(self.numbering)[own]
        return Ordering(points, np.zeros(0, np.int64), rigid)

    def restricted(self, kept: IntArray) -> "ReducedProblem":
        """The problem with only the unknowns `kept` (k,), the others held at zero."""
        return replace(
            self,
            K=sp.csr_array(self.K[kept][:, kept]),
            M=sp.csr_array(self.M[kept][:, kept]),
            C=None if self.C is None else sp.csr_array(self.C[kept][:, kept]),
            S=sp.csr_array(self.S[:, kept]),
            T=sp.csr_array(self.T[:, kept]),
        )

    def reactions(self, u: FloatArray, eigenvalue: float) -> FloatArray:
        """Multipliers (n_rows,) that balance `(K - lambda M) u` at the eliminated unknowns."""
        return self.elimination.multipliers(eigenvalue * (self.mass @ u) - self.stiffness @ u)


def reduced_problem(
    stiffness: Matrix,
    mass: Matrix,
    damping: Matrix | None = None,
    solver: Solver = FIRST_FIT,
) -> ReducedProblem:
    """Eliminate the conditions of all matrices (unilateral ones taken for equalities).

    Raises
    ------
    KernelError
        If the matrices have no unknown, a condition is non-associated, or a mass is negative.
    """
    parts = [stiffness, mass] if damping is None else [stiffness, mass, damping]
    held = {id(r): r for m in parts for r in m.relations}
    if any(r.dual is not None for r in held.values()):
        raise KernelError("kernel.modal.modes-non-associated-relations")
    all_rows = Matrix(stiffness.table, (), tuple(held.values()))
    numbering = assembly.numbering_of(*parts)
    if numbering.size == 0:
        raise KernelError("kernel.modal.matrix-empty-nothing-solve")
    rows = assembly.constraint_matrix(all_rows, numbering)
    elimination = eliminate(rows.C)
    T = elimination.T
    K, M = assembly.assemble(stiffness, numbering), assembly.assemble(mass, numbering)
    C = None if damping is None else sp.csr_array(T.T @ assembly.assemble(damping, numbering) @ T)
    if mass.inertial and not (M.diagonal() > 0.0).any():
        assembly.refuse_negative_mass(M, numbering)  # a buckling load in its place has both signs
    left = np.flatnonzero(~elimination.eliminated)
    return ReducedProblem(
        numbering,
        K,
        M,
        sp.csr_array(T.T @ K @ T),
        sp.csr_array(T.T @ M @ T),
        C,
        sp.csr_array(rows.C[left] @ T),
        T,
        assembly.is_symmetric(stiffness) and assembly.is_symmetric(mass),
        elimination,
        rows.multipliers,
        solver,
    )
