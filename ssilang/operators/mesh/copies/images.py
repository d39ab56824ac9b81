"""Moved copies of objects: PLUS MOIN TOUR SYME HOMO AFFI PROJ."""

from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.matrices.matrix import Relations
from ssilang.kernel.mesh.changes import transform
from ssilang.kernel.mesh.generators.sweep import corresponding_nodes
from ssilang.kernel.mesh.surfaces.surface import facet_shape
from ssilang.operators.fields.turning import turned_cell_field, turned_node_field
from ssilang.operators.mesh.copies.maps import *
from ssilang.operators.mesh.tolerance import IN_PLANE, IN_SPACE
from ssilang.operators.prelude import *

GEOMETRIC = ("POINT", "MAILLAGE", "CHPOINT", "MCHAML", "MMODEL", "TABLE")


def displacement_names(ws: Workspace) -> tuple[str, ...]:
    """Displacement components of the mode in force."""
    if ws.mode in (Mode.AXISYMMETRIC, Mode.FOURIER):
        return ("UR", "UZ")
    return ("UX", "UY", "UZ")[: ws.dimension]


class Copier:
    """Copies of objects of any kind whose nodes go through one `NodeCopier`."""

    def __init__(self, nodes: transform.NodeCopier, rotation: FloatArray | None = None) -> None:
        self.nodes = nodes
        self.rotation = rotation
        self._blocks: dict[int, tuple[CellBlock, CellBlock]] = {}
        self._zones: dict[int, tuple[Zone, Zone]] = {}

    def block(self, block: CellBlock) -> CellBlock:
        """Copy of a block, the same one each time it is met."""
        made = self._blocks.get(id(block))
        if made is None:
            made = self._blocks[id(block)] = (block, self.nodes.block(block))
        return made[1]

    def mesh(self, mesh: Mesh) -> Mesh:
        """Copy of a mesh with its sides."""
        blocks = tuple(self.block(b) for b in mesh.blocks)
        return Mesh(mesh.nodes, blocks, tuple(self.mesh(s) for s in mesh.sides))

    def node_field(self, field: NodeField) -> NodeField:
        """The field on the copied nodes, vectors turned by the rotation if there is one."""
        parts: dict[str, NodeValues] = {}
        for name, part in field.components.items():
            nodes = self.nodes.of_nodes(part.nodes)
            parts |= NodeField.of(field.table, nodes, {name: part.values}).components
        made = NodeField(field.table, parts, field.nature)
        return made if self.rotation is None else turned_node_field(made, self.rotation)

    def cell_field(self, field: CellField) -> CellField:
        """The field on the copied cells, tensors turned by the rotation if there is one."""
        blocks = tuple(replace(b, cells=self.block(b.cells)) for b in field.blocks)
        made = CellField(blocks, field.title)
        return made if self.rotation is None else turned_cell_field(made, self.rotation)

    def zone(self, zone: Zone) -> Zone:
        """The zone on the copied cells, the same one in models and matrices."""
        made = self._zones.get(id(zone))
        if made is None:
            made = self._zones[id(zone)] = (zone, replace(zone, cells=self.block(zone.cells)))
        return made[1]

    def model(self, model: Model) -> Model:
        """The model on the copied cells."""
        return Model(tuple(self.zone(z) for z in model.zones))

    def matrix(self, matrix: Matrix) -> Matrix:
        """The matrix between the unknowns of the copied nodes; relations get multipliers anew."""
        blocks = tuple(
            replace(
                b,
                raw_nodes=self.nodes.of_nodes(b.nodes),
                zone=None if b.zone is None else self.zone(b.zone),
            )
            for b in matrix.blocks
        )
        relations = tuple(self.relations(r) for r in matrix.relations)
        return Matrix(matrix.table, blocks, relations, matrix.kind)

    def relations(self, rows: Relations) -> Relations:
        """Relations between the unknowns of the copied nodes."""
        return replace(
            rows,
            raw_nodes=self.nodes.of_nodes(rows.nodes),
            raw_multipliers=self.nodes.of_nodes(rows.multipliers),
            dual=None if rows.dual is None else self.relations(rows.dual),
        )

    def table(self, table: Table) -> Table:
        """A table of copies, indices kept."""
        made = Table()
        for index, value in table.items():
            if type(value) not in _COPIES and index != "SOUSTYPE":
                told = {"index": index, "found": type_of(value)}
                raise MeshError("operators.mesh.copied-table-holds", **told)
            made.set(index, self(value) if type(value) in _COPIES else value)
        return made

    def __call__(self, value: Any) -> Any:
        return _COPIES[type(value)](self, value)


_COPIES: dict[type, Any] = {
    Point: lambda c, p: c.nodes.point(p),
    Mesh: Copier.mesh,
    NodeField: Copier.node_field,
    CellField: Copier.cell_field,
    Model: Copier.model,
    Matrix: Copier.matrix,
    Table: Copier.table,
}


def copies(
    call: Call,
    objects: Sequence[Any],
    image: transform.PointMap,
    rotation: FloatArray | None = None,
) -> tuple[Any, ...]:
    """Copies of all objects through one map."""
    if not objects:
        raise call.missing(GEOMETRIC)
    copier = Copier(transform.NodeCopier(workspace(call.session).nodes, image), rotation)
    return tuple(copier(v) for v in objects)


def _shifted(
    call: Call, objects: Sequence[Any], by: Point | NodeField, sign: float
) -> tuple[Any, ...]:
    """Copies moved by a vector, or whose nodes move by a field of displacements."""
    if not objects:
        raise call.missing(("POINT", "CHPOINT"))
    if isinstance(by, Point):
        made = copies(call, objects, transform.shift(sign * by.coordinates.copy()))
        ws = workspace(call.session)
        for value in made:
            if isinstance(value, Point):  # a point that is made has the density in force
                ws.nodes.density[value.node] = ws.density
        return made
    nodes, field = workspace(call.session).nodes, by
    for value in objects:
        if isinstance(value, Matrix):
            raise call.error("operators.mesh.matrix-moved-by-field", value)

    def moved(ids: IntArray) -> FloatArray:
        return nodes.coordinates[ids] + sign * displacements(field, ids)

    copier = Copier(transform.NodeCopier(nodes, by_node=moved))
    return tuple(copier(v) for v in objects)


def _objects(leaving: int, *left: str, types: Sequence[str] = GEOMETRIC) -> Any:
    return many(
        "objects", *types, leaving=leaving, left=left, en="objects to copy", range=ANY_NUMBER
    )


_SHIFTED = (
    _objects(1, "POINT", "CHPOINT", types=(*GEOMETRIC, "RIGIDITE")),
    arg(
        "by",
        "POINT",
        "CHPOINT",
        en="vector, or displacements",
        unit="m",
    ),
)


@operator("PLUS", *_SHIFTED, gives=Like("objects"), family="mesh")
def plus(call: Call, objects: Sequence[Any], by: Point | NodeField) -> tuple[Any, ...]:
    """Copy and move."""
    return _shifted(call, objects, by, 1.0)


@operator("MOIN", *_SHIFTED, gives=Like("objects"), family="mesh", full_name="MOINS")
def moin(call: Call, objects: Sequence[Any], by: Point | NodeField) -> tuple[Any, ...]:
    """Copy and move backwards."""
    return _shifted(call, objects, by, -1.0)


@moin.form()
def motion(
    session: Session,
    after: Mesh = Arg("MAILLAGE", en="mesh after the motion"),
    before: Mesh = Arg("MAILLAGE", en="mesh before it"),
) -> NodeField:
    """The displacements between two meshes."""
    target = corresponding_nodes(before, after)
    ids = before.node_ids
    xyz = before.nodes.coordinates
    gap = xyz[target] - xyz[ids]
    names = displacement_names(workspace(session))
    return NodeField.of(
        before.nodes, ids, {name: gap[:, k] for k, name in enumerate(names)}, "DIFFUS"
    )


@operator("TOUR", gives=Like("objects"), when=IN_PLANE, family="mesh", full_name="TOURNER")
def tour(
    call: Call,
    objects: Sequence[Any] = _objects(1, "POINT"),
    angle: float = ANGLE,
    centre: Point = Arg("POINT", en="centre"),
) -> tuple[Any, ...]:
    """Copy and turn about a point."""
    if workspace(call.session).dimension == 1:
        raise call.error("operators.mesh.no-turn-on-line")
    return _turned(call, objects, angle, centre.coordinates.copy(), np.array([0.0, 0.0, 1.0]))


@tour.form(gives=Like("objects"), when=IN_SPACE)
def turned_about_axis(
    call: Call,
    objects: Sequence[Any] = _objects(2, "POINT"),
    angle: float = ANGLE,
    first: Point = Arg("POINT", en="point of the axis"),
    second: Point = Arg("POINT", en="other point of the axis"),
) -> tuple[Any, ...]:
    """Copy and turn about an axis."""
    origin = first.coordinates.copy()
    return _turned(call, objects, angle, origin, second.coordinates - origin)


def _turned(
    call: Call, objects: Sequence[Any], angle: float, origin: FloatArray, axis: FloatArray
) -> tuple[Any, ...]:
    return copies(call, objects, transform.turn(angle, origin, axis), rotation_matrix(angle, axis))


@operator(
    "SYME",
    said("POINT"),
    _objects(1, "POINT"),
    *MIRRORS["POINT"],
    gives=Like("objects"),
    family="mesh",
    full_name="SYMETRIE",
)
def syme(call: Call, objects: Sequence[Any], centre: Point) -> tuple[Any, ...]:
    """Copy and mirror about a point."""
    return copies(call, objects, transform.mirror_point(*positions((centre,))))


@syme.form(said("DROIT"), _objects(2, "POINT"), *MIRRORS["DROIT"], gives=Like("objects"))
def mirrored_about_line(
    call: Call, objects: Sequence[Any], point: Point, second: Point
) -> tuple[Any, ...]:
    """Copy and mirror about a line."""
    return copies(call, objects, transform.mirror_line(*positions((point, second))))


@syme.form(said("PLAN"), _objects(3, "POINT"), *MIRRORS["PLAN"], gives=Like("objects"))
def mirrored_about_plane(
    call: Call, objects: Sequence[Any], point: Point, second: Point, third: Point
) -> tuple[Any, ...]:
    """Copy and mirror about a plane."""
    return copies(call, objects, transform.mirror_plane(*positions((point, second, third))))


@operator("HOMO", gives=Like("objects"), family="mesh", full_name="HOMOTHETIE")
def homo(
    call: Call,
    objects: Sequence[Any] = _objects(1, "POINT"),
    ratio: float = RATIO,
    fixed: Point = FIXED,
) -> tuple[Any, ...]:
    """Copy and scale."""
    return copies(call, objects, transform.scaling(ratio, fixed.coordinates.copy()))


@operator("AFFI", gives=Like("objects"), family="mesh", full_name="AFFINITE")
def affi(
    call: Call,
    objects: Sequence[Any] = _objects(2, "POINT"),
    ratio: float = RATIO,
    fixed: Point = FIXED,
    towards: Point = DIRECTION,
) -> tuple[Any, ...]:
    """Copy and stretch."""
    return copies(call, objects, transform.affinity(ratio, *positions((fixed, towards))))


@operator("PROJ", *RAYS, _objects(0), gives=Like("objects"), family="mesh", full_name="PROJETER")
def proj(
    call: Call, rays: tuple[str, Point], surface: Chosen, objects: Sequence[Any]
) -> tuple[Any, ...]:
    """Copy and project, as it is said how the rays go."""
    return copies(call, objects, projection_of(*rays, surface))


@proj.form(_objects(1, "POINT"), *VECTOR, gives=Like("objects"))
def projected_along(
    call: Call, objects: Sequence[Any], vector: Point, surface: Chosen
) -> tuple[Any, ...]:
    """Copy and project along a vector."""
    return copies(call, objects, projection_of("CYLI", vector, surface))


@proj.form(RAYS[0], _objects(1, "MAILLAGE"), gives=Like("objects"))
def projected_on_mesh(
    call: Call,
    rays: tuple[str, Point],
    objects: Sequence[Any],
    goal: Mesh = Arg("MAILLAGE", en="mesh on which they go"),
) -> tuple[Any, ...]:
    """Copy and project on a mesh."""
    return copies(call, objects, projection_on(*rays, facet_shape(goal)))
