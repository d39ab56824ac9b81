"""DEDU without keyword: meshes and displacements that follow some nodes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.changes.follow import followed
from ssilang.kernel.mesh.changes.transform import NodeCopier
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.run.call import Call
from ssilang.operators.mesh.moves import displacements


def following(call: Call, objects: Sequence[Any]) -> tuple[Mesh, NodeCopier] | NodeField:
    """The mesh to copy and how its nodes go, or the displacement of all its nodes."""
    even = call.keyword(("REGU",)) is not None
    if [type(v) for v in objects] in ([Mesh, NodeField], [NodeField, Mesh]):
        return _extended(*sorted(objects, key=lambda v: isinstance(v, NodeField)))
    meshes = [*objects, *call.all("MAILLAGE")]
    even = even or call.keyword(("REGU",)) is not None
    if len(meshes) != 3 or not all(isinstance(m, Mesh) for m in meshes):
        raise call.bad("DEDU wants three meshes, or 'TRAN' or 'ROTA'", hint="DEDU GEO1 OLD NEW")
    mesh, old, new = meshes
    target = corresponding_nodes(old, new)
    masters = old.node_ids
    nodes, places = followed(mesh, masters, mesh.nodes.coordinates[target], even)
    kept = dict(zip(masters.tolist(), target.tolist(), strict=True))

    def moved(ids: IntArray) -> FloatArray:
        return places[np.searchsorted(nodes, ids)]

    return mesh, NodeCopier(mesh.nodes, by_node=moved, copies=kept)


def _extended(mesh: Mesh, field: NodeField) -> NodeField:
    """The displacement of all nodes of a mesh from that of some, harmonic in between."""
    given = field.node_ids
    start = mesh.nodes.coordinates
    nodes, places = followed(mesh, given, start[given] + displacements(field, given))
    motion = places - start[nodes]
    axes = ("UR", "UZ") if "UR" in field.components else ("UX", "UY", "UZ")
    kept = {n: motion[:, k] for k, n in enumerate(axes) if n in field.components}
    return NodeField.of(mesh.nodes, nodes, kept, "DIFFUS")
