"""DEDU: copies that follow some nodes, or go through the map between two meshes."""

from ssilang.kernel.fields.deformed import displacements, moving_components
from ssilang.kernel.mesh.changes.transform import NodeCopier, followed, mapping_between
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes
from ssilang.operators.mesh.copies.images import GEOMETRIC, Copier
from ssilang.operators.mesh.copies.maps import rotation_matrix
from ssilang.operators.prelude import *

_EVEN = flag("even", "REGU", en="inner nodes then go to the mean of their neighbours")
_BEFORE = arg("before", "MAILLAGE", en="mesh before")
_AFTER = arg("after", "MAILLAGE", en="mesh after, of the same structure")
_OBJECTS = many("objects", *GEOMETRIC, leaving=2, left=("MAILLAGE",), en="objects to copy")


@operator("DEDU", family="mesh", full_name="DEDUIRE")
def dedu(
    mesh: Mesh = Arg("MAILLAGE", en="linear surfaces or volumes"),
    masters: Mesh = Arg("MAILLAGE", en="its master nodes"),
    goal: Mesh = Arg("MAILLAGE", en="what these become"),
    even: bool = _EVEN,
) -> Mesh:
    """Copy a mesh that follows its master nodes."""
    target = corresponding_nodes(masters, goal)
    ids = masters.node_ids
    nodes, places = followed(mesh, ids, mesh.nodes.coordinates[target], even)
    kept = dict(zip(ids.tolist(), target.tolist(), strict=True))

    def moved(ids: IntArray) -> FloatArray:
        return places[np.searchsorted(nodes, ids)]

    return Copier(NodeCopier(mesh.nodes, by_node=moved, copies=kept)).mesh(mesh)


@dedu.form(said("ADAP"))
def dedu_adap(
    call: Call, mesh: Mesh | None = Opt("MAILLAGE", en="linear surfaces or volumes")
) -> NoReturn:
    """To a metric: its functional is not published."""
    raise call.error("operators.mesh.functional-not-published")


@dedu.form()
def extended(
    mesh: Mesh = Arg("MAILLAGE", en="linear surfaces or volumes"),
    field: NodeField = Arg("CHPOINT", en="displacements of some of its nodes", unit="m"),
    even: bool = _EVEN,
) -> NodeField:
    """The displacement of all nodes of a mesh from that of some, harmonic in between."""
    given = field.node_ids
    start = mesh.nodes.coordinates
    nodes, places = followed(mesh, given, start[given] + displacements(field, given), even)
    motion = places - start[nodes]
    axes = enumerate(moving_components(field))
    kept = {n: motion[:, k] for k, n in axes if n in field.components}
    return NodeField.of(mesh.nodes, nodes, kept, "DIFFUS")


@dedu.form(said("TRAN"), gives=Like("objects"))
def through_map(
    objects: Sequence[Any] = _OBJECTS, before: Mesh = _BEFORE, after: Mesh = _AFTER
) -> tuple[Any, ...]:
    """Copy through the map between two meshes."""
    return _copied(objects, before, after, None)


@dedu.form(said("ROTA"), gives=ANY)
def through_turn(
    call: Call,
    angle: float = Arg("FLOTTANT", en="angle by which vectors turn", unit="deg", range=ANY_NUMBER),
    objects: Sequence[Any] = _OBJECTS,
    before: Mesh = _BEFORE,
    after: Mesh = _AFTER,
) -> tuple[Any, ...]:
    """The same, vectors and tensors turning; the last points are those of the axis."""
    count = 1 if workspace(call.session).dimension < 3 else 2
    points = [v for v in objects if isinstance(v, Point)][-count:]
    if len(points) < count:
        raise call.missing(("POINT",))
    others = [v for v in objects if not any(v is p for p in points)]
    axis = points[1].coordinates - points[0].coordinates if count == 2 else np.eye(3)[2]
    return _copied(others, before, after, rotation_matrix(angle, axis))


def _copied(
    objects: Sequence[Any], before: Mesh, after: Mesh, rotation: FloatArray | None
) -> tuple[Any, ...]:
    if not objects:
        raise MeshError("operators.mesh.nothing-to-copy")
    copier = Copier(mapping_between(before, after), rotation)
    return tuple(copier(v) for v in objects)
