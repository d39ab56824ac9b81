"""Numbering of unknowns, assembly to sparse matrices, vectors from and to nodal fields.

Everything that solves a system goes the same way::

    numbering = numbering_of(stiffness, mass, damping)      # one numbering for all
    K, M = assemble(stiffness, numbering), assemble(mass, numbering)
    rows = constraint_matrix(stiffness, numbering)          # C u = d, apart from K
    f = field_to_vector(forces, numbering)                  # dual names: FX, MZ ...
    d = imposed_values(forces, rows.multipliers)            # component FLX
    u = vector_to_field(vector, numbering)                  # primal names: UX, RZ ...

The multipliers (LX) are no unknowns of the numbering: they stand in `ConstraintRows`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError, KernelError
from ssilang.kernel.base.sparse import assemble_triplets, sp
from ssilang.kernel.fields.node_field import Nature, NodeField, NodeValues
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations, dual_of
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.messages.message import Sentence

MULTIPLIER = "LX"
IMPOSED = "FLX"


@dataclass(frozen=True, eq=False)
class Numbering:
    """Index of each unknown (node, name), nodes increasing, names in `unknowns`' order.

    Parameters
    ----------
    unknowns, duals : tuple of str, length n_names
        Primal names ('UX', 'RZ' ...) and their duals ('FX', 'MZ' ...).
    nodes : array (n,)
        Node of each unknown.
    codes : array (n,)
        Name of each unknown, as an index into `unknowns`.
    version : int
        Version of the node table that it was made for.
    """

    table: NodeTable
    unknowns: tuple[str, ...]
    duals: tuple[str, ...]
    nodes: IntArray
    codes: IntArray
    version: int

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.nodes)

    def code(self, name: str) -> int:
        """Index of a primal name in `unknowns`, -1 if the system has no such unknown."""
        return self.unknowns.index(name) if name in self.unknowns else -1

    def index(self, nodes: IntArray, codes: IntArray | int) -> IntArray:
        """Indices of the unknowns (node, code), -1 where there is none; shapes broadcast."""
        wanted = np.asarray(nodes, dtype=np.int64) * len(self.unknowns) + codes
        wanted = np.where(np.asarray(codes) < 0, -1, wanted)
        if self.size == 0:
            return np.full(wanted.shape, -1, dtype=np.int64)
        keys = self.nodes * len(self.unknowns) + self.codes
        if wanted.size >= self.size and keys[-1] < 4 * self.size:  # a list of places pays
            places = np.full(keys[-1] + 2, -1, dtype=np.int64)
            places[keys] = np.arange(self.size)
            return places[np.clip(wanted, -1, keys[-1] + 1)]
        place = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        return np.where(keys[place] == wanted, place, -1)

    def index_of(self, node: int, name: str) -> int:
        """Index of one unknown, -1 if there is none."""
        return int(self.index(np.asarray([node]), self.code(name))[0])

    def where(self, name: str) -> IntArray:
        """Indices of all unknowns called `name`, by increasing node."""
        return np.flatnonzero(self.codes == self.code(name))

    def some(self, which: IntArray | BoolArray) -> Numbering:
        """Of some of the unknowns alone."""
        return replace(self, nodes=self.nodes[which], codes=self.codes[which])

    def name(self, index: int) -> str:
        """Name of one unknown: 'UX'."""
        return self.unknowns[self.codes[index]]

    def told(self, values: NDArray[Any]) -> str:
        """The node, as messages name it, of the largest of values (n,), or the first of a mask."""
        return self.table.told(self.nodes[values.argmax()])

    def label(self, index: int) -> Sentence:
        """'UX at node 12 (0. 4.)' (node counted from 1, as scripts see it)."""
        return unknown_label(self.table, self.name(index), self.nodes[index])


def unknown_label(table: NodeTable, name: str, node: int) -> Sentence:
    """'UX at node 12 (0. 4.)' for node 11."""
    return Sentence("kernel.matrices.unknown-at-node", name=name, node=table.told(node))


class ConstraintRows(NamedTuple):
    """Conditions of a matrix on one numbering: `C u = d`, `>= d` or `<= d`.

    Attributes
    ----------
    C : csr array (n_rows, n_unknowns)
    multipliers : array (n_rows,)
        Multiplier node of each row (component LX in solutions, FLX in second members).
    sense : array (n_rows,) of int8
        0 equality, +1 `C u >= d` (MINI), -1 `C u <= d` (MAXI).
    D : csr array (n_rows, n_unknowns)
        How the multipliers enter equilibrium, `K u + D^T LX = F`; it is `C` itself but for
        non-associated relations.
    """

    C: sp.csr_array
    multipliers: IntArray
    sense: NDArray[np.int8]
    D: sp.csr_array

    @property
    def associated(self) -> bool:
        """True if D is C: the system is symmetric when K is."""
        return self.D is self.C


def numbering_of(*matrices: Matrix) -> Numbering:
    """One numbering for all unknowns of the matrices, their relations' included.

    Kept in the first matrix's cache; made again if nodes were merged since.

    Raises
    ------
    FieldError
        If no matrix is given.
    """
    if not matrices:
        raise FieldError("kernel.matrices.numbering-needs-least-matrix")
    first = matrices[0]
    key = "numbering:" + ",".join(str(id(m)) for m in matrices)
    kept = first.cache.get(key)
    if isinstance(kept, _Kept) and kept.numbering.version == first.table.version:
        return kept.numbering
    numbering = _make_numbering(first.table, matrices)
    first.cache[key] = _Kept(matrices, numbering)  # the references keep the ids from being reused
    return numbering


@dataclass(frozen=True)
class _Kept:
    matrices: tuple[Matrix, ...]
    numbering: Numbering


def _make_numbering(table: NodeTable, matrices: tuple[Matrix, ...]) -> Numbering:
    duals = _dual_names(matrices)
    names = {name: code for code, name in enumerate(duals)}
    used = np.zeros((len(table), len(names)), bool)
    for block in (b for m in matrices for b in m.blocks):
        nodes = block.nodes
        for unknown in names:
            rows = [i for i, u in enumerate(block.unknowns) if u == unknown]
            used[nodes[:, block.local[rows]], names[unknown]] = True
    for relation in (r for m in matrices for r in m.relations):
        for part in _with_dual(relation):
            used[part.nodes, _codes(part.unknowns, names)] = True
    flat = np.flatnonzero(used)
    n = max(len(names), 1)
    return Numbering(table, tuple(duals), tuple(duals.values()), flat // n, flat % n, table.version)


def _dual_names(matrices: tuple[Matrix, ...]) -> dict[str, str]:
    """Primal name -> dual name, in order of first appearance."""
    duals: dict[str, str] = {}
    for block in (b for m in matrices for b in m.blocks):
        for unknown, dual in zip(block.unknowns, block.duals, strict=True):
            duals.setdefault(unknown, dual)
    for relation in (r for m in matrices for r in m.relations):
        for part in _with_dual(relation):
            for unknown in dict.fromkeys(part.unknowns):
                duals.setdefault(unknown, dual_of(unknown))
    return duals


def _with_dual(relation: Relations) -> tuple[Relations, ...]:
    return (relation,) if relation.dual is None else (relation, relation.dual)


def _codes(unknowns: tuple[str, ...], names: Mapping[str, int]) -> IntArray:
    return np.fromiter((names.get(u, -1) for u in unknowns), dtype=np.int64, count=len(unknowns))


# --- matrices --------------------------------------------------------------------------------


def block_indices(block: ElementMatrices, numbering: Numbering) -> IntArray:
    """Index of each row of each element matrix, shape (n, m)."""
    codes = np.array([numbering.code(u) for u in block.unknowns], dtype=np.int64)
    return numbering.index(block.nodes[:, block.local], codes)


def assemble(matrix: Matrix, numbering: Numbering | None = None) -> sp.csr_array:
    """Sum of the element blocks as CSR (n, n) on `numbering` (default: the matrix's own).

    Relations are not in it, see `constraint_matrix`. Kept in the matrix's cache for the last
    numbering used.

    Raises
    ------
    FieldError
        If the matrix has an unknown that the numbering lacks.
    """
    numbering = numbering or numbering_of(matrix)
    kept = matrix.cache.get("assembled")
    if isinstance(kept, tuple) and kept[0] is numbering:
        stored: sp.csr_array = kept[1]
        return stored
    assembled = assemble_blocks(matrix.blocks, numbering)
    matrix.cache["assembled"] = (numbering, assembled)
    return assembled


MANY_TERMS = 2_000_000
"""Element terms from which the compiled assembly pays for loading the compiler."""


def assemble_blocks(blocks: Iterable[ElementMatrices], numbering: Numbering) -> sp.csr_array:
    """Sum of element blocks as CSR (n, n), duplicates summed, indices sorted."""
    kept = tuple(blocks)
    places = [_places(block, numbering) for block in kept]
    return assemble_terms(places, [b.values for b in kept], numbering.size)


def assemble_terms(
    places: list[NDArray[np.int32]], values: list[FloatArray], n: int
) -> sp.csr_array:
    """Sum of element matrices (n_cells, m, m) at places (n_cells, m) as CSR, indices sorted."""
    if sum(v.size for v in values) > MANY_TERMS:
        from ssilang.kernel.matrices.gathered_rows import assemble_rows

        return assemble_rows(places, values, n)
    return assemble_triplets(places, values, n)


def _places(block: ElementMatrices, numbering: Numbering) -> NDArray[np.int32]:
    places = block_indices(block, numbering).astype(np.int32)
    if places.size and places.min() < 0:
        raise FieldError("kernel.matrices.matrix-unknowns-numbering-lacks")
    return places


NEGATIVE = 1e-12
"""Share of the largest mass up to which a negative one is rounding."""


def negative_mass(
    mass: sp.csr_array, numbering: Numbering, but: tuple[str, ...] = ()
) -> tuple[Sentence, float] | None:
    """The unknown whose motion the most negative mass resists, and that mass; None without.

    Unknowns with the names `but` are not looked at.
    """
    diagonal = mass.diagonal()
    for name in but:
        diagonal[numbering.where(name)] = 0.0
    if diagonal.size == 0 or diagonal.min() >= -NEGATIVE * np.abs(diagonal).max():
        return None
    worst = int(np.argmin(diagonal))
    return numbering.label(worst), float(diagonal[worst])


def may_be_positive(matrix: sp.csr_array) -> bool:
    """Whether a symmetric matrix has no negative diagonal term and no negative 2 x 2 minor."""
    diagonal = matrix.diagonal()
    if diagonal.size and diagonal.min() < -NEGATIVE * np.abs(diagonal).max():
        return False
    # a_ii a_jj - a_ij^2 negative by more than rounding: of both signs, whatever the diagonal
    terms, diagonal = matrix.tocoo(), np.abs(matrix.diagonal())
    off = terms.row != terms.col
    squares = terms.data[off] ** 2
    products = diagonal[terms.row[off]] * diagonal[terms.col[off]]
    floor = (NEGATIVE * np.abs(matrix.data).max(initial=0.0)) ** 2
    return not (squares > (1.0 + 1e-9) * products + floor).any()


def refuse_negative_mass(
    mass: sp.csr_array, numbering: Numbering, but: tuple[str, ...] = ()
) -> None:
    """Refuse a mass matrix that resists the motion of some unknown with a negative mass.

    Unknowns with the names `but` may.
    """
    found = negative_mass(mass, numbering, but)
    if found is not None:
        raise KernelError("kernel.matrices.mass-negative", unknown=found[0], mass=found[1])


def is_symmetric(matrix: Matrix) -> bool:
    """True if every block is declared symmetric and every relation is associated."""
    blocks = all(b.symmetric for b in matrix.blocks)
    return blocks and all(r.dual is None for r in matrix.relations)


def constraint_matrix(matrix: Matrix, numbering: Numbering | None = None) -> ConstraintRows:
    """The matrix's relations as rows on `numbering` (default: the matrix's own).

    Relations that stand twice in the matrix (same multiplier nodes) count once. Terms of a row
    on the same unknown (merged nodes) are summed. Not scaled: rows are as the script gave them.

    Raises
    ------
    FieldError
        If a relation has an unknown that the numbering lacks.
    """
    numbering = numbering or numbering_of(matrix)
    seen = {id(r): r for r in matrix.relations}
    parts = tuple(seen.values())
    multipliers = _joined([r.multipliers for r in parts])
    sense = np.concatenate([r.sense for r in parts] or [np.empty(0, np.int8)]).astype(np.int8)
    C = _stack(parts, numbering)
    associated = all(r.dual is None for r in parts)
    D = C if associated else _stack(tuple(r.dual or r for r in parts), numbering)
    _, first = np.unique(multipliers, return_index=True)
    if len(first) == len(multipliers):
        return ConstraintRows(C, multipliers, sense, D)
    keep = np.sort(first)
    kept = C[keep]
    return ConstraintRows(kept, multipliers[keep], sense[keep], kept if associated else D[keep])


def _joined(parts: list[IntArray]) -> IntArray:
    return np.concatenate(parts) if parts else np.empty(0, dtype=np.int64)


def _stack(parts: tuple[Relations, ...], numbering: Numbering) -> sp.csr_array:
    names = {name: code for code, name in enumerate(numbering.unknowns)}
    rows, columns, values, start = [], [], [np.empty(0)], 0
    for part in parts:
        rows.append(start + np.repeat(np.arange(len(part)), np.diff(part.row_start)))
        columns.append(numbering.index(part.nodes, _codes(part.unknowns, names)))
        values.append(part.coefficients)
        start += len(part)
    places = _joined(columns)
    if places.size and places.min() < 0:
        raise FieldError("kernel.matrices.relation-unknowns-numbering-lacks")
    shape = (start, numbering.size)
    stacked = sp.coo_array((np.concatenate(values), (_joined(rows), places)), shape=shape).tocsr()
    stacked.sum_duplicates()
    return stacked


# --- fields ----------------------------------------------------------------------------------


def field_to_vector(
    field: NodeField, numbering: Numbering, dual: bool = True, absent: float = 0.0
) -> FloatArray:
    """Values of a nodal field at each unknown, shape (n,), `absent` where it has none.

    Parameters
    ----------
    dual : bool
        True: a second member, read by dual names (FX, MZ); False: a displacement (UX, RZ).

    Notes
    -----
    Values at nodes or of components outside the numbering are left out; `outside` finds them.
    """
    names = numbering.duals if dual else numbering.unknowns
    vector = np.full(numbering.size, absent)
    for code, name in enumerate(names):
        part = field.components.get(name)
        if part is not None:
            places = numbering.index(part.nodes, code)
            found = places >= 0
            vector[places[found]] = part.values[found]
    return vector


def outside(field: NodeField, numbering: Numbering, dual: bool = True) -> list[Sentence]:
    """Labels ('FX at node 3') of non-zero values that no unknown of the numbering takes."""
    names = numbering.duals if dual else numbering.unknowns
    special = (IMPOSED, MULTIPLIER)
    lost: list[Sentence] = []
    for name, part in field.components.items():
        if name in special and name not in names:
            continue
        code = names.index(name) if name in names else -1
        missing = (numbering.index(part.nodes, code) < 0) & (part.values != 0.0)
        lost += [unknown_label(field.table, name, node) for node in part.nodes[missing]]
    return lost


def imposed_values(field: NodeField, multipliers: IntArray) -> FloatArray:
    """Imposed values d of the rows, from the field's component FLX, shape (n_rows,)."""
    return field.values_at(IMPOSED, multipliers)


def imposed_outside(field: NodeField, multipliers: IntArray) -> int:
    """Number of imposed values, not nought, whose conditions are none of these."""
    part = field.components.get(IMPOSED)
    if part is None:
        return 0
    return int(np.isin(part.nodes[part.values != 0.0], multipliers, invert=True).sum())


def vector_to_field(
    vector: FloatArray,
    numbering: Numbering,
    dual: bool = False,
    multipliers: tuple[IntArray, FloatArray] | None = None,
) -> NodeField:
    """A nodal field from a vector (n,): displacement (DIFFUS), or forces (DISCRET) with `dual`.

    `multipliers` (nodes, values) adds the component LX, FLX with `dual`.
    """
    names = numbering.duals if dual else numbering.unknowns
    parts: dict[str, NodeValues] = {}
    for code, name in enumerate(names):
        chosen = numbering.codes == code
        if chosen.any():
            parts[name] = NodeValues(numbering.nodes[chosen], np.asarray(vector)[chosen])
    if multipliers is not None and len(multipliers[0]):
        order = np.argsort(multipliers[0], kind="stable")
        name = IMPOSED if dual else MULTIPLIER
        parts[name] = NodeValues(multipliers[0][order], np.asarray(multipliers[1])[order])
    nature: Nature = "DISCRET" if dual else "DIFFUS"
    return NodeField(numbering.table, parts, nature)
