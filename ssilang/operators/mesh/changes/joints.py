"""Joint cells between meshes: RACC LIAI GENJ; TASS."""

from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.generators.interfaces import joint_mesh, joints_inside
from ssilang.operators.mesh.tolerance import DISTANCE, tolerance_of
from ssilang.operators.prelude import *


def _joint(
    session: Session, first: Mesh, second: Mesh, third: Mesh | None, far: float | None, part: bool
) -> Mesh:
    ws = workspace(session)
    if third is not None:
        raise MeshError("operators.mesh.joint-of-three")
    if np.isin(first.node_ids, second.node_ids).all():
        session.warn("operators.mesh.joint-on-itself", None)
    near = tolerance_of(ws, far, ws.nodes.coordinates[first.node_ids])
    return joint_mesh(first, second, max(near, 1e-300), part)


_PART = flag(
    "part", "PART", en="cells that face each other without fitting are left out, not refused"
)
_THIRD = opt("third", "MAILLAGE", en="a third, of porous joints, which is refused")


@operator("RACC", family="mesh", full_name="RACCORD")
def racc(
    session: Session,
    distance: float | None = DISTANCE,
    first: Mesh = Arg("MAILLAGE", en="line"),
    second: Mesh = Arg("MAILLAGE", en="line that faces it"),
    third: Mesh | None = _THIRD,
    part: bool = _PART,
) -> Mesh:
    """Joints between lines."""
    if first.dimension > 1:
        raise MeshError("operators.mesh.lines-wanted")
    return _joint(session, first, second, third, distance, part)


@operator("LIAI", family="mesh", full_name="LIAISON")
def liai(
    session: Session,
    distance: float | None = DISTANCE,
    first: Mesh = Arg("MAILLAGE", en="surface"),
    second: Mesh = Arg("MAILLAGE", en="surface that faces it"),
    third: Mesh | None = _THIRD,
    part: bool = _PART,
) -> Mesh:
    """Joints between surfaces."""
    if first.dimension < 2:
        raise MeshError("operators.mesh.surfaces-wanted")
    return _joint(session, first, second, third, distance, part)


@operator("GENJ", family="mesh")
def genj(
    session: Session,
    mesh: Mesh = Arg("MAILLAGE", en="surfaces or volumes"),
    distance: float | None = DISTANCE,
) -> Mesh:
    """Joints between the touching parts of a mesh."""
    ws = workspace(session)
    near = tolerance_of(ws, distance, ws.nodes.coordinates[mesh.node_ids])
    return joints_inside(mesh, max(near, 1e-300))


@operator("TASS", family="mesh", full_name="TASSER")
def tass(
    session: Session,
    meshes: tuple[Mesh, ...] = Many("MAILLAGE", en="meshes"),
    keep: bool = Flag("NOOP", en="accepted, without effect"),
) -> Mesh:
    """The nodes by number, which stay as they are."""
    nodes = workspace(session).nodes
    return poi1(nodes, np.unique(nodes.resolve(np.arange(len(nodes)))))
