"""RAFF on meshes: cells divided to sizes wanted; the relations of their hanging nodes."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.families import family_of
from ssilang.kernel.matrices.relations import joined, rows_from_table
from ssilang.kernel.mesh.changes.local_refinement import divided_to_sizes, parted
from ssilang.operators.matrices.supports import as_matrix
from ssilang.operators.prelude import *


def refined(mesh: Mesh, sizes: NodeField) -> Mesh:
    """The mesh divided to the sizes of a field of one component.

    Raises
    ------
    MeshError
        If the field has several components, lacks at a node, or for cells that are not divided.
    """
    if len(sizes.components) != 1:
        raise MeshError("operators.mesh.one-size-wanted", n_components=len(sizes.components))
    cells, ties = parted(mesh)
    if ties:
        raise MeshError("operators.mesh.refined-before")
    wanted = sizes.values_at(next(iter(sizes.components)), cells.node_ids, np.nan)
    if np.isnan(wanted).any():
        node = mesh.nodes.told(cells.node_ids[np.isnan(wanted)][0])
        raise MeshError("operators.mesh.no-size-at-node", node=node)
    return divided_to_sizes(cells, wanted)


def tie_relations(model: Model, table: NodeTable) -> Matrix:
    """Each hanging node moves as the mean of the nodes that it follows, unknown by unknown."""
    names = dict.fromkeys(u for z in model.zones for u in family_of(z).layout(z).unknowns)
    parts = []
    for block in model.ties:
        nodes = block.connectivity
        masters = nodes.shape[1] - 1
        row = np.concatenate([[1.0], np.full(masters, -1.0 / masters)])
        coefficients = np.broadcast_to(row, nodes.shape)
        parts += [
            rows_from_table(table, nodes, (name,) * nodes.shape[1], coefficients) for name in names
        ]
    return as_matrix(joined(parts)) if parts else Matrix(table)
