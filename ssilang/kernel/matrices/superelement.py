"""Super-elements: a body condensed onto a few of its unknowns, and back.

With the master unknowns q imposed, the inner ones follow: `u = Phi q + u0`, where `Phi` (n, m) is
the response to unit masters and `u0` that of the loads with the masters held. Then `Phi^T K Phi` is
the stiffness that the masters feel, `Phi^T (f - K u0)` their loads, `Phi^T M Phi` their mass
(Guyan): the first two exact, the third an approximation that improves with the masters.
"""

from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    ConstraintRows,
    Numbering,
    assemble,
    constraint_matrix,
    field_to_vector,
    imposed_values,
    is_symmetric,
    numbering_of,
    outside,
    vector_to_field,
)
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.solvers.cholesky.elimination import Elimination, eliminate
from ssilang.kernel.solvers.cholesky.inverse import Inverse, invert
from ssilang.kernel.statics.linear import saddle_point
from ssilang.kernel.statics.linear_motion import singular, tied

LARGEST = 6000  # masters; the condensed matrix is full


@dataclass(frozen=True, eq=False)
class SuperElement:
    """A body seen from its master unknowns (SUPERELE)."""

    source: Matrix  # the stiffness that was condensed
    stiffness: Matrix  # one full element matrix on the masters, with the conditions that were kept
    numbering: Numbering  # of `source`, n unknowns
    masters: IntArray  # (m,) their indices in `numbering`
    # (a,) positions in `masters` of those that were asked for; the others are unknowns of kept
    # conditions
    asked: IntArray
    shapes: FloatArray  # (n, m) displacement for a unit of each master
    # of the inner unknowns, the masters being held by the last m rows of `rows`
    elimination: Elimination
    inverse: Inverse
    saddle: IntArray
    rows: ConstraintRows  # conditions inside (none if they were kept), then one row a master
    inner_rows: int  # how many of `rows` are conditions inside


def condense(
    matrix: Matrix, chosen: Matrix | NodeField | IntArray, inside: bool = False
) -> SuperElement:
    """Condense a stiffness onto some of its unknowns.

    Parameters
    ----------
    chosen : Matrix, NodeField or array of int
        Whose unknowns are masters; for nodes, all unknowns that the stiffness has there, for those
        of multipliers the unknowns of the conditions.
    inside : bool
        True: the conditions of the matrix hold inside, with the value zero or what a load says
        ('NOMU'). False: they are kept on the condensed matrix, and their unknowns are masters.

    Raises
    ------
    KernelError
        Without masters; with conditions inside that are unilateral or hold masters alone.
    SingularMatrixError
        If the inner unknowns can move with the masters held.
    """
    numbering = numbering_of(matrix)
    conditions = constraint_matrix(matrix, numbering)
    kept = np.zeros(numbering.size, bool)
    kept[_chosen_unknowns(numbering, chosen)] = True
    # multipliers of conditions stay with these, and their unknowns are masters
    tied_by = isinstance(chosen, np.ndarray) and np.isin(conditions.multipliers, chosen).any()
    if not kept.any() and (inside or not tied_by):
        raise KernelError("kernel.matrices.none-master-unknowns-unknown")
    asked = kept.copy()
    if not inside:
        for part in (conditions.C, conditions.D):
            kept[np.unique(part.indices)] = True
    elif (conditions.sense != 0).any() or not conditions.associated:
        raise KernelError("kernel.matrices.unilateral-non-associated-conditions")
    masters = np.flatnonzero(kept)
    if len(masters) > LARGEST:
        raise KernelError(
            "kernel.matrices.master-unknowns-make-too", n_masters=len(masters), largest=LARGEST
        )
    made = _made(matrix, numbering, masters, conditions if inside else None)
    return replace(made, asked=np.flatnonzero(asked[masters]))


def _chosen_unknowns(numbering: Numbering, chosen: Matrix | NodeField | IntArray) -> IntArray:
    if isinstance(chosen, Matrix):
        other = numbering_of(chosen)
        codes = np.array([numbering.code(u) for u in other.unknowns], dtype=np.int64)
        found = numbering.index(other.nodes, codes[other.codes])
    elif isinstance(chosen, NodeField):
        pairs = [numbering.index(v.nodes, numbering.code(k)) for k, v in chosen.components.items()]
        found = np.concatenate([np.empty(0, np.int64), *pairs])
    else:
        found = np.flatnonzero(np.isin(numbering.nodes, chosen))
    return found[found >= 0]


def _made(
    matrix: Matrix, numbering: Numbering, masters: IntArray, inside: ConstraintRows | None
) -> SuperElement:
    K = assemble(matrix, numbering)
    m, n = len(masters), numbering.size
    held = sp.csr_array((np.ones(m), (np.arange(m), masters)), shape=(m, n))
    inner = 0 if inside is None else len(inside.multipliers)
    C = held if inside is None else sp.csr_array(sp.vstack([inside.C, held]))
    rows = ConstraintRows(C, np.empty(0, np.int64), np.zeros(inner + m, np.int8), C)
    elimination = eliminate(C)
    saddle = np.flatnonzero(~elimination.eliminated)
    T = elimination.T
    inverse = invert(saddle_point(K, rows, T, saddle), is_symmetric(matrix))
    if inverse.singular:
        motions = T @ inverse.kernel[: len(elimination.masters)]
        bodies = tied(numbering, rows.C, K)
        raise singular("kernel.statics.loads-drive-motions", numbering, motions, bodies)
    values = np.zeros((inner + m, m))
    values[inner:] = np.eye(m)
    draft = SuperElement(
        matrix, matrix, numbering, masters, np.arange(m), np.empty((n, 0)), elimination, inverse,
        saddle, rows, inner,
    )  # fmt: skip
    shapes = _responses(draft, np.zeros((n, m)), values)[0]
    _free_masters(draft, shapes)
    full = shapes.T @ (K @ shapes)
    if is_symmetric(matrix):
        full = 0.5 * (full + full.T)
    block = _block(numbering, masters, full, "RIGIDITE", is_symmetric(matrix))
    relations = matrix.relations if inside is None else ()
    stiffness = Matrix(matrix.table, (block,), relations, matrix.kind)
    return replace(draft, stiffness=stiffness, shapes=shapes)


def _free_masters(element: SuperElement, shapes: FloatArray) -> None:
    """Refuse masters that a condition inside holds."""
    error = np.abs(shapes[element.masters] - np.eye(len(element.masters))).max(axis=0)
    error = np.maximum(error, np.abs(element.rows.C[: element.inner_rows] @ shapes).max(
        axis=0, initial=0.0))  # fmt: skip
    worst = int(np.argmax(error))
    if error[worst] > 1e-6:
        label = element.numbering.label(int(element.masters[worst]))
        raise KernelError("kernel.matrices.conditions-matrix-hold-master", label=label)


def _responses(
    element: SuperElement, forces: FloatArray, values: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Displacements (n, k) for forces (n, k) and values (rows, k), and the saddle's multipliers."""
    elimination, C = element.elimination, element.rows.C
    K = assemble(element.source, element.numbering)
    start = np.column_stack([elimination.particular(d) for d in values.T])
    left = values[element.saddle] - C[element.saddle] @ start
    z = element.inverse.solve(np.vstack([elimination.T.T @ (forces - K @ start), left]))
    count = len(elimination.masters)
    return start + elimination.T @ z[:count], z[count:]


def _block(
    numbering: Numbering, masters: IntArray, values: FloatArray, kind: str, symmetric: bool
) -> ElementMatrices:
    nodes, codes = numbering.nodes[masters], numbering.codes[masters]
    unknowns, duals = ([of[c] for c in codes] for of in (numbering.unknowns, numbering.duals))
    return ElementMatrices.of_one(numbering.table, nodes, unknowns, duals, values, kind, symmetric)


def _inner_values(element: SuperElement, load: NodeField) -> FloatArray:
    """Values of the rows (rows,) with the masters held: what the load imposes inside."""
    values = np.zeros(len(element.rows.sense))
    if element.inner_rows:
        nodes = constraint_matrix(element.source, element.numbering).multipliers
        values[: element.inner_rows] = imposed_values(load, nodes)
    return values


def _forces(element: SuperElement, load: NodeField) -> FloatArray:
    lost = outside(load, element.numbering)
    if lost:
        raise KernelError("kernel.matrices.super-element-no-unknown", lost=lost[:4])
    return field_to_vector(load, element.numbering)


def condensed_load(element: SuperElement, load: NodeField) -> NodeField:
    """Loads on the masters that do what `load` does on the body (SUPE 'CHARGE').

    Imposed values (FLX) of conditions that were kept go through.

    Raises
    ------
    KernelError
        If the body has no unknown for a force.
    """
    f = _forces(element, load)
    K = assemble(element.source, element.numbering)
    u0 = _responses(element, f[:, None], _inner_values(element, load)[:, None])[0][:, 0]
    values = element.shapes.T @ (f - K @ u0)
    field = vector_to_field(values, element.numbering.some(element.masters), dual=True)
    imposed = load.components.get("FLX")
    if imposed is None or element.inner_rows:
        return field
    return NodeField(field.table, {**field.components, "FLX": imposed}, "DISCRET")


def inner_displacement(
    element: SuperElement, masters: NodeField, load: NodeField | None = None
) -> NodeField:
    """Displacement of the whole body from that of its masters and its loads (SUPE 'DEPLA').

    Raises
    ------
    KernelError
        If the body has no unknown for a force.
    """
    numbering = element.numbering
    values = np.zeros(len(element.rows.sense))
    f = np.zeros(numbering.size)
    if load is not None:
        f, values = _forces(element, load), _inner_values(element, load)
    values[element.inner_rows :] = field_to_vector(masters, numbering, dual=False)[element.masters]
    u, saddle = _responses(element, f[:, None], values[:, None])
    conditions = constraint_matrix(element.source, numbering)
    if element.inner_rows:
        found = np.zeros(len(values))
        found[element.saddle] = saddle[:, 0]
        K = assemble(element.source, numbering)
        rest = f - K @ u[:, 0] - element.rows.C.T @ found
        found += element.elimination.multipliers(rest)
        pair = (conditions.multipliers, found[: element.inner_rows])
    else:
        pair = (conditions.multipliers, masters.values_at("LX", conditions.multipliers))
    return vector_to_field(u[:, 0], numbering, multipliers=pair)


def unit_shapes(element: SuperElement) -> FloatArray:
    """Displacement (n, a) for a unit of each master asked for, the kept conditions holding.

    With q = (qa, qb) the masters asked for and the others, and C the kept conditions, qb makes the
    energy stationary under `Cb qb = -Ca qa`. Conditions between masters asked for alone stay for
    the condensed body.

    Raises
    ------
    KernelError
        If the conditions hold a master that was asked for, or leave the others free to move.
    """
    asked = element.asked
    others = np.setdiff1d(np.arange(len(element.masters)), asked)
    if not len(others):
        return element.shapes
    K = element.stiffness.blocks[0].values[0]
    K = K / (np.abs(K).max() or 1.0)  # beside the conditions' coefficients
    rows = constraint_matrix(element.source, element.numbering)
    C, D = (np.asarray(part[:, element.masters].todense()) for part in (rows.C, rows.D))
    linked = (C[:, others] != 0.0).any(axis=1)
    C, D = C[linked], D[linked]
    zero = np.zeros((len(C), len(C)))
    system = np.block([[K[np.ix_(others, others)], D[:, others].T], [C[:, others], zero]])
    right = -np.vstack([K[np.ix_(others, asked)], C[:, asked]])
    if np.linalg.matrix_rank(system[:, : len(others)]) < len(others):
        raise KernelError("kernel.matrices.masters-leave-conditions-free")
    found = np.linalg.lstsq(system, right)[0]
    missed = np.abs(system @ found - right).max(axis=0)
    worst = int(np.argmax(missed))
    if missed[worst] > 1e-8 * max(np.abs(right).max(), np.abs(C).max(initial=0.0)):
        label = element.numbering.label(int(element.masters[asked[worst]]))
        raise KernelError("kernel.matrices.conditions-matrix-hold-master", label=label)
    q = np.zeros((len(element.masters), len(asked)))
    q[asked, np.arange(len(asked))] = 1.0
    q[others] = found[: len(others)]
    return element.shapes @ q


def condensed_mass(element: SuperElement, mass: Matrix) -> Matrix:
    """`T^T M T` on the masters asked for (SUPE 'MASSE'), T of `unit_shapes`.

    The conditions of `mass` do not count.

    Raises
    ------
    FieldError
        If the mass has unknowns that the stiffness lacks.
    """
    M = assemble(Matrix(mass.table, mass.blocks), element.numbering)
    shapes = unit_shapes(element)
    full = shapes.T @ (M @ shapes)
    symmetric = all(b.symmetric for b in mass.blocks)
    if symmetric:
        full = 0.5 * (full + full.T)
    kind = mass.blocks[0].kind if mass.blocks else "MASSE"
    masters = element.masters[element.asked]
    block = _block(element.numbering, masters, full, kind, symmetric)
    return Matrix(mass.table, (block,), (), mass.kind)


def shape_fields(element: SuperElement) -> list[NodeField]:
    """The displacement of the body for a unit of each master asked for, in their order."""
    return [vector_to_field(shape, element.numbering) for shape in unit_shapes(element).T]
