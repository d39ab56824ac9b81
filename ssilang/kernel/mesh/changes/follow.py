"""Meshes that follow some of their nodes, and nodes put in the middle of their neighbours."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.graph import entries, parts_of
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.mesh.boundary import contour, edges, envelope
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.queries.select import simplices


def followed(
    mesh: Mesh, masters: IntArray, places: FloatArray, even: bool = False
) -> tuple[IntArray, FloatArray]:
    """Nodes (n,) of a mesh and where they go (n, 3) when some of them go to given places.

    The displacement of the others is harmonic (each component solves Laplace's equation by linear
    elements), so that a homogeneous motion of the boundary is followed exactly.

    Parameters
    ----------
    masters : array (m,); places : array (m, 3)
        Nodes and where they go; masters outside the mesh do not count.
    even : bool
        True: then each inner node that is no master goes to the mean of its neighbours.

    Raises
    ------
    MeshError
        Without masters in the mesh, if a part of it has none, or for cells that have neither
        area nor volume.
    """
    nodes = mesh.sorted_node_ids
    xyz = mesh.nodes.coordinates[nodes]
    if not len(nodes):
        raise MeshError("kernel.mesh.mesh-empty-no-nodes")
    place = np.searchsorted(nodes, masters)
    here = nodes[np.minimum(place, len(nodes) - 1)] == masters
    held, target = place[here], places[here]
    if not len(held):
        raise MeshError("kernel.mesh.none-master-nodes-belongs")
    fixed = np.zeros(len(nodes), bool)
    fixed[held] = True
    motion = np.zeros((len(nodes), 3))
    motion[held] = target - xyz[held]
    motion = _solved(_stiffness(mesh, nodes), motion, fixed)
    moved = xyz + motion
    if even:
        skin = envelope(mesh) if mesh.dimension == 3 else contour(mesh)
        rim = np.isin(nodes, skin.node_ids)
        moved = _solved(_graph(mesh, nodes), moved, fixed | rim)
    return nodes, moved


def _solved(A: sp.csr_array, values: FloatArray, fixed: np.ndarray) -> FloatArray:
    """Values (n, 3) with A values = 0 at the rows that are not fixed."""
    from scipy.sparse.linalg import splu

    free = np.flatnonzero(~fixed)
    if not len(free):
        return values
    known = np.flatnonzero(fixed)
    part = parts_of(len(values), entries(A))
    if len(np.unique(part[known])) <= part.max():
        raise MeshError("kernel.mesh.part-mesh-no-master")
    found = splu(sp.csc_array(A[free][:, free])).solve(-(A[free][:, known] @ values[known]))
    result = values.copy()
    result[free] = found
    return result


def _stiffness(mesh: Mesh, nodes: IntArray) -> sp.csr_array:
    """Stiffness (n, n) of Laplace's equation on the simplices of the cells."""
    rows, columns, terms = [], [], []
    for block in mesh.blocks:
        if block.kind.dimension < 2 or block.kind.joint or block.kind.degree > 1:
            raise MeshError("kernel.mesh.cells-type-cannot-follow", cell_type=block.cell_type)
        for local in simplices(block):
            table = block.connectivity[:, list(local)]
            local_terms = _simplex_terms(block, table)
            where = np.searchsorted(nodes, table)
            k = table.shape[1]
            rows.append(np.repeat(where, k, axis=1).ravel())
            columns.append(np.tile(where, (1, k)).ravel())
            terms.append(local_terms.ravel())
    size = (len(nodes), len(nodes))
    triplets = np.concatenate(terms), (np.concatenate(rows), np.concatenate(columns))
    return sp.coo_array(triplets, shape=size).tocsr()


def _simplex_terms(block: CellBlock, table: IntArray) -> FloatArray:
    """Stiffness (n, k, k) of triangles or tetrahedra (n, k)."""
    x = block.nodes.coordinates[table]
    edges = x[:, 1:] - x[:, :1]
    gram = edges @ edges.transpose(0, 2, 1)
    size = np.sqrt(np.maximum(np.linalg.det(gram), 0.0))
    flat = size <= 1e-14 * np.linalg.norm(edges, axis=-1).prod(axis=-1)
    if flat.any():
        raise MeshError(
            "kernel.mesh.cells-type-flat", n_flat=int(flat.sum()), cell_type=block.cell_type
        )
    inner = np.linalg.inv(gram)
    whole = np.zeros((len(table), table.shape[1], table.shape[1]))
    whole[:, 1:, 1:] = inner
    whole[:, 0, 1:] = -inner.sum(axis=1)
    whole[:, 1:, 0] = whole[:, 0, 1:]
    whole[:, 0, 0] = inner.sum(axis=(1, 2))
    scaled: FloatArray = size[:, None, None] * whole
    return scaled


def _graph(mesh: Mesh, nodes: IntArray) -> sp.csr_array:
    """Number of neighbours on the diagonal, -1 for each neighbour."""
    pairs = np.concatenate([b.connectivity for b in edges(mesh).blocks])
    i, j = np.searchsorted(nodes, pairs).T
    ones = np.ones(len(i))
    links = sp.coo_array((ones, (i, j)), shape=(len(nodes), len(nodes))).tocsr()
    links = links + links.T
    return sp.csr_array(sp.diags_array(np.asarray(links.sum(axis=1)).ravel()) - links)
