"""Points and their nodes: NOEU CONF BARY."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.mesh.combine import poi1
from ssilang.operators.prelude import *


@operator("NOEU", arg("point", "POINT", en="point"), family="mesh", full_name="NOEUD")
def noeu(point: Point) -> int:
    """The number of a point's node."""
    return point.node + 1


@noeu.form(arg("number", "ENTIER", en="number of a node", range=POSITIVE))
def numbered(session: Session, call: Call, number: int) -> Point:
    """The point of a node."""
    nodes = workspace(session).nodes
    if not 1 <= number <= len(nodes):
        raise call.error("operators.mesh.no-such-node", number, number=number, n_nodes=len(nodes))
    return Point(nodes, number - 1)


@operator(
    "CONF",
    arg("first", "POINT", en="point that goes"),
    arg("second", "POINT", en="point that it becomes"),
    family="mesh",
    full_name="CONFONDRE",
)
def conf(first: Point, second: Point) -> None:
    """Merge two points."""
    if first.node != second.node:
        first.nodes.merge(np.array([second.node]), np.array([first.node]))


@operator(
    "BARY",
    arg("mesh", "MAILLAGE", "POINT", en="mesh, or point"),
    family="mesh",
    full_name="BARYCENTRE",
)
def bary(session: Session, mesh: Mesh | Point) -> Point:
    """Mean position of the nodes."""
    if isinstance(mesh, Point):
        return mesh
    ws = workspace(session)
    _not_empty(mesh)
    centre = ws.nodes.coordinates[mesh.node_ids].mean(axis=0)
    return Point(ws.nodes, int(ws.nodes.add(centre[None], ws.density)[0]))


@bary.form(said("ELEM"), arg("mesh", "MAILLAGE", en="cells"))
def centres_of_cells(session: Session, mesh: Mesh) -> Mesh:
    """Mean position of each cell's nodes."""
    ws = workspace(session)
    _not_empty(mesh)
    centres = np.concatenate([b.coordinates.mean(axis=1) for b in mesh.blocks])
    return poi1(ws.nodes, ws.nodes.add(centres, ws.density), ws.colour)


def _not_empty(mesh: Mesh) -> None:
    if not mesh.n_cells:
        raise MeshError("operators.mesh.no-barycentre")
