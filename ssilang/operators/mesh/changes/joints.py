"""Joint cells between meshes: RACC LIAI GENJ; TASS."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.generators.interfaces import joint_mesh, joints_inside
from ssilang.operators.mesh.tolerance import DISTANCE, tolerance_of
from ssilang.operators.prelude import *


def _joint(session: Session, first: Mesh, second: Mesh, distance: float | None, part: bool) -> Mesh:
    ws = workspace(session)
    if np.isin(first.node_ids, second.node_ids).all():
        session.warn("operators.mesh.joint-on-itself", None)
    near = tolerance_of(ws, distance, ws.nodes.coordinates[first.node_ids])
    return joint_mesh(first, second, max(near, 1e-300), part)


_PART = flag(
    "part", "PART", en="cells that face each other without fitting are left out, not refused"
)


@operator(
    "RACC",
    DISTANCE,
    arg("first", "MAILLAGE", en="line"),
    arg("second", "MAILLAGE", en="line that faces it"),
    _PART,
    family="mesh",
    full_name="RACCORD",
)
def racc(session: Session, distance: float | None, first: Mesh, second: Mesh, part: bool) -> Mesh:
    """Joints between lines."""
    if first.dimension > 1:
        raise MeshError("operators.mesh.lines-wanted")
    return _joint(session, first, second, distance, part)


@operator(
    "LIAI",
    DISTANCE,
    arg("first", "MAILLAGE", en="surface"),
    arg("second", "MAILLAGE", en="surface that faces it"),
    _PART,
    family="mesh",
    full_name="LIAISON",
)
def liai(session: Session, distance: float | None, first: Mesh, second: Mesh, part: bool) -> Mesh:
    """Joints between surfaces."""
    if first.dimension < 2:
        raise MeshError("operators.mesh.surfaces-wanted")
    return _joint(session, first, second, distance, part)


@operator("GENJ", arg("mesh", "MAILLAGE", en="surfaces or volumes"), DISTANCE, family="mesh")
def genj(session: Session, mesh: Mesh, distance: float | None) -> Mesh:
    """Joints between the touching parts of a mesh."""
    ws = workspace(session)
    near = tolerance_of(ws, distance, ws.nodes.coordinates[mesh.node_ids])
    return joints_inside(mesh, max(near, 1e-300))


@operator(
    "TASS",
    many("meshes", "MAILLAGE", en="meshes"),
    flag("keep", "NOOP", en="accepted, without effect"),
    family="mesh",
    full_name="TASSER",
)
def tass(session: Session, meshes: tuple[Mesh, ...], keep: bool) -> Mesh:
    """The nodes by number, which stay as they are."""
    nodes = workspace(session).nodes
    return poi1(nodes, np.unique(nodes.resolve(np.arange(len(nodes)))))
