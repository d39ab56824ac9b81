"""DEDU: copies that follow some nodes, or go through the map between two meshes."""

from ssilang.kernel.elements.results import supports
from ssilang.kernel.fields.deformed import displacements, moving_components
from ssilang.kernel.matrices.relations import blocked
from ssilang.kernel.mesh.boundary import contour, envelope
from ssilang.kernel.mesh.changes.transform import NodeCopier, followed, mapping_between
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes
from ssilang.kernel.statics.mesh_adaptation import UNKNOWNS, adapted
from ssilang.operators.mesh.copies.images import GEOMETRIC, Copier
from ssilang.operators.mesh.copies.maps import rotation_matrix
from ssilang.operators.mesh.metrics import metric_at
from ssilang.operators.prelude import *

_EVEN = flag("even", "REGU", en="inner nodes then go to the mean of their neighbours")
_SHARE, _ABOVE_ONE = Range(0.0, 1.0), Range(1.0, open_low=True)
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
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="surfaces in the plane, or volumes"),
    conditions: Matrix | None = Opt("RIGIDITE", en="conditions; without, its boundary stays"),
    imposed: NodeField | None = Opt("CHPOINT", en="their values", unit="m"),
    metric: CellField | NodeField | None = Key(
        "METR", "MCHAML", "CHPOINT", en="metric G11 G21 G22 ... in length^-2"
    ),
    space: Model | str | None = Opt("MMODEL", "MOT", en="of the metric"),
    density: NodeField | None = Key("DENS", "CHPOINT", en="sizes wanted", unit="m"),
    theta: float = Key("THET", "FLOTTANT", default=0.2, range=_SHARE, en="regular against equal"),
    gamma: float = Key("GAMM", "FLOTTANT", default=2.0, range=_ABOVE_ONE, en="power of both"),
    most: int = Key("NITM", "ENTIER", default=40, range=POSITIVE, en="most steps"),
    accelerated: bool = Key("ACVG", "LOGIQUE", default=True, en="accepted, without effect"),
    axis: int | None = Key("IDIR", "ENTIER", en="the one direction of the motion", range=POSITIVE),
    solving: Table | None = Key("TINV", "TABLE", en="accepted, without effect"),
) -> NodeField:
    """Displacement that makes cells regular and equal in a metric."""
    d = workspace(call.session).dimension
    if mesh.dimension != d:
        raise MeshError("kernel.mesh.cells-type-cannot-follow", cell_type=mesh.blocks[0].cell_type)
    if conditions is None:
        skin = contour(mesh) if d == 2 else envelope(mesh)
        rows = blocked(mesh.nodes, skin.sorted_node_ids, UNKNOWNS[:d])
        conditions = Matrix(mesh.nodes, (), (rows,))
    if isinstance(metric, CellField):
        if not isinstance(space, Model):
            raise call.missing(("MMODEL",))
        metric = supports.nodal_of_cells(space, metric, "MOYE")
    if density is not None:
        name = next(iter(density.components))
        ids = mesh.sorted_node_ids
        metric = NodeField.of(mesh.nodes, ids, {"G": density.values_at(name, ids) ** -2}, "DIFFUS")
    tables = [b.connectivity for b in mesh.blocks]
    metrics = [metric_at(call, t, 1.0 if metric is None else metric).mean(axis=1) for t in tables]
    directions = tuple(range(d)) if axis is None else (axis - 1,)
    return adapted(mesh, metrics, theta, gamma, conditions, imposed, directions, most)


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
