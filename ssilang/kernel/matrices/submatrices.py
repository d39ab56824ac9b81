"""Parts of a matrix: nodes, their mesh, unknowns, diagonal, halves, blocks by name or by mesh."""

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.assembly import Numbering, assemble, constraint_matrix, numbering_of
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.messages.message import Teller


def together(*matrices: Matrix) -> Matrix:
    """Sum of matrices and their relations (ET); what stands twice counts once only if a relation.

    The kind is that of the first matrix that has element blocks.
    """
    blocks = tuple(b for m in matrices for b in m.blocks)
    relations = {id(r): r for m in matrices for r in m.relations}
    kind = next((m.kind for m in matrices if m.blocks), matrices[0].kind)
    return Matrix(matrices[0].table, blocks, tuple(relations.values()), kind)


def relation_nodes(matrix: Matrix) -> IntArray:
    """Nodes that the relations act on, increasing."""
    return _joined([r.nodes for r in matrix.relations])


def multiplier_nodes(matrix: Matrix, unilateral: bool = False) -> IntArray:
    """Multiplier nodes, increasing; only those of MINI and MAXI rows if `unilateral`."""
    return _joined(
        [r.multipliers[r.sense != 0] if unilateral else r.multipliers for r in matrix.relations]
    )


def _joined(parts: list[IntArray]) -> IntArray:
    return np.unique(np.concatenate([np.empty(0, np.int64), *parts]))


def support_mesh(matrix: Matrix) -> Mesh:
    """Cells under the element blocks where known, lines under pairs of nodes, else points."""
    blocks: dict[int, CellBlock] = {}
    loose = [np.empty(0, np.int64)]
    for block in matrix.blocks:
        cells = _cells_of(block)
        if cells is None:
            loose.append(block.nodes.ravel())
        else:
            blocks.setdefault(id(block.zone.cells) if block.zone else id(block), cells)
    held = [np.unique(np.concatenate([*loose, relation_nodes(matrix)]))]
    known = [b.connectivity.ravel() for b in blocks.values()]
    points = np.setdiff1d(held[0], np.concatenate([np.empty(0, np.int64), *known]))
    found = tuple(blocks.values())
    if len(points):
        found = (*found, CellBlock.make(matrix.table, "POI1", points[:, None]))
    return Mesh(matrix.table, found)


def _cells_of(block: ElementMatrices) -> CellBlock | None:
    if block.zone is not None:
        return block.zone.cells
    if block.raw_nodes.shape[1] != 2:
        return None
    return CellBlock.make(block.table, "SEG2", block.nodes)


def diagonal(matrix: Matrix) -> NodeField:
    """Diagonal terms by unknown; zero at multipliers."""
    numbering = numbering_of(matrix)
    values = assemble(matrix, numbering).diagonal()
    parts: dict[str, NodeValues] = {}
    for code, name in enumerate(numbering.unknowns):
        chosen = numbering.codes == code
        parts[name] = NodeValues(numbering.nodes[chosen], values[chosen])
    points = multiplier_nodes(matrix)
    if len(points):
        parts["LX"] = NodeValues(points, np.zeros(len(points)))
    return NodeField(matrix.table, parts, "DIFFUS")


def symmetric_part(matrix: Matrix, sign: float) -> Matrix:
    """`(A + sign A^T) / 2` of the element matrices: sign 1 symmetric, -1 antisymmetric.

    Relations belong to the symmetric part.
    """
    blocks = []
    for block in matrix.blocks:
        if block.symmetric and sign < 0.0:
            continue
        values = 0.5 * (block.values + sign * np.swapaxes(block.values, 1, 2))
        blocks.append(replace(block, values=values, symmetric=sign > 0.0))
    return Matrix(matrix.table, tuple(blocks), matrix.relations if sign > 0.0 else (), matrix.kind)


def named_part(matrix: Matrix, primal: set[str], dual: set[str]) -> Matrix:
    """Terms from the unknowns `primal` to the equations `dual`, the others zero.

    Relations are kept if 'LX' or 'FLX' is asked for.
    """
    blocks = []
    for block in matrix.blocks:
        columns = np.array([u in primal for u in block.unknowns])
        rows = np.array([d in dual for d in block.duals])
        if not (rows.any() and columns.any()):
            continue
        used = rows | columns
        mask = (rows[:, None] & columns[None, :])[np.ix_(used, used)]
        blocks.append(
            replace(
                block,
                local=block.local[used],
                unknowns=tuple(u for u, k in zip(block.unknowns, used, strict=True) if k),
                duals=tuple(d for d, k in zip(block.duals, used, strict=True) if k),
                values=block.values[:, used][:, :, used] * mask,
                symmetric=block.symmetric and bool((rows == columns).all()),
                part=(tuple(sorted(primal)), tuple(sorted(dual))),
            )
        )
    relations = matrix.relations if {"LX"} & primal or {"FLX"} & dual else ()
    return Matrix(matrix.table, tuple(blocks), relations, matrix.kind)


def on_mesh(matrix: Matrix, mesh: Mesh) -> Matrix:
    """Element matrices on the cells of the mesh, and relations whose nodes are all in it."""
    keys = {tuple(row) for b in mesh.blocks for row in np.sort(b.connectivity, axis=1).tolist()}
    blocks = []
    for block in matrix.blocks:
        rows = np.sort(block.nodes, axis=1).tolist()
        keep = np.array([tuple(row) in keys for row in rows], dtype=bool)
        if keep.any():
            blocks.append(block.some(keep))
    inside = mesh.sorted_node_ids
    relations = [r for r in (_rows_inside(p, inside) for p in matrix.relations) if len(r)]
    return Matrix(matrix.table, tuple(blocks), tuple(relations), matrix.kind)


def _rows_inside(part: Relations, inside: IntArray) -> Relations:
    """Rows whose nodes are all in `inside`; the part itself if all are."""
    there = np.isin(part.nodes, inside)
    there |= np.isin(np.repeat(part.multipliers, np.diff(part.row_start)), inside)
    keep = np.minimum.reduceat(there, part.row_start[:-1]) if len(part) else np.empty(0, bool)
    return part if keep.all() else chosen_rows(part, keep.astype(bool))


def chosen_rows(part: Relations, keep: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Relations:
    """The rows of relations where `keep` (n_rows,) is true."""
    counts = np.diff(part.row_start)
    terms = np.repeat(keep, counts)
    return Relations(
        part.table,
        np.concatenate([[0], np.cumsum(counts[keep])]).astype(np.int64),
        part.raw_nodes[terms],
        tuple(u for u, k in zip(part.unknowns, terms, strict=True) if k),
        part.coefficients[terms],
        part.raw_multipliers[keep],
        part.sense[keep],
        None if part.dual is None else chosen_rows(part.dual, keep),
    )


def unknown_names(matrix: Matrix, dual: bool = False) -> list[str]:
    """Names of the unknowns (or equations), 'LX' ('FLX') last if there are relations."""
    numbering = numbering_of(matrix)
    names = list(numbering.duals if dual else numbering.unknowns)
    parts = [b.part[dual] for b in matrix.blocks if b.part]
    if len(parts) == len(matrix.blocks) and not matrix.relations:
        names = [n for n in names if any(n in part for part in parts)]
    if matrix.relations:
        names.append("FLX" if dual else "LX")
    return names


def renamed(
    matrix: Matrix, primal: dict[str, str], dual: dict[str, str], symmetric: bool
) -> Matrix:
    """Unknowns and equations under other names; relations follow the unknowns' names."""
    blocks = tuple(
        replace(
            b,
            unknowns=tuple(primal.get(u, u) for u in b.unknowns),
            duals=tuple(dual.get(d, d) for d in b.duals),
            symmetric=symmetric,
            zone=None,
            part=None,
        )
        for b in matrix.blocks
    )
    relations = tuple(
        replace(r, unknowns=tuple(primal.get(u, u) for u in r.unknowns)) for r in matrix.relations
    )
    return Matrix(matrix.table, blocks, relations, matrix.kind)


def with_own_multipliers(matrix: Matrix) -> Matrix:
    """The same conditions with multiplier nodes of their own, where the others' are."""

    def moved(relations: Relations) -> Relations:
        places = matrix.table.coordinates[relations.multipliers].copy()
        made = matrix.table.add(places)
        dual = relations.dual and replace(relations.dual, raw_multipliers=made)
        return replace(relations, raw_multipliers=made, dual=dual)

    return replace(matrix, relations=tuple(moved(r) for r in matrix.relations), cache={})


def listed(matrix: Matrix, say: Teller, values: bool = True) -> list[str]:
    """Lines that describe the element matrices and the relations, with their first values."""
    lines = [say("kernel.matrices.listed", kind=matrix.kind, count=len(matrix.blocks))]
    for block in matrix.blocks:
        lines.append(
            say(
                "kernel.matrices.listed-block",
                count=len(block.values),
                size=len(block.unknowns),
                names=list(dict.fromkeys(block.unknowns)),
                symmetric=block.symmetric,
            )
        )
        if values:
            lines += [_shown(block, i, say) for i in range(min(len(block.values), 3))]
    if matrix.relations:
        rows = constraint_matrix(matrix)
        signs = {0: "=", 1: ">=", -1: "<="}
        numbering = numbering_of(matrix)
        lines.append(say("kernel.matrices.listed-conditions", count=len(rows.multipliers)))
        for i, node in enumerate(rows.multipliers[: 20 if values else 0]):
            row = rows.C[[i]]
            terms = " ".join(
                f"{v:+.6g} {_unknown(numbering, int(j), say)}"
                for j, v in zip(row.indices[:12], row.data[:12], strict=True)
            )
            more = " ..." if row.nnz > 12 else ""
            multiplier = say("kernel.matrices.listed-multiplier", node=node + 1)
            lines.append(f"    {terms}{more} {signs[int(rows.sense[i])]} d, {multiplier}")
    return lines


def _unknown(numbering: Numbering, j: int, say: Teller) -> str:
    """'UX at node 12'."""
    node = int(numbering.nodes[j]) + 1
    return say("kernel.matrices.unknown-at-node", name=numbering.name(j), node=node)


def _shown(block: ElementMatrices, i: int, say: Teller) -> str:
    rows = [say("kernel.matrices.listed-nodes", nodes=[int(n) + 1 for n in block.nodes[i]])]
    if block.values.shape[1] <= 12:
        rows += ["      " + " ".join(f"{v:12.5E}" for v in row) for row in block.values[i]]
    return "\n".join(rows)
