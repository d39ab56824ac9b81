"""FORC MOME PRES FSUR CNEQ: nodal forces of loads."""

from ssilang.kernel.elements.loads import loads
from ssilang.kernel.elements.results.supports import model_on_mesh
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.mesh.queries.quality import repeated_cells
from ssilang.operators.matrices.element import joined
from ssilang.operators.matrices.supports import static_links
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import MODEL

FORCES = ("FX", "FY", "FZ", "FR", "FT")
MOMENTS = ("MX", "MY", "MZ", "MT", "MR")


_PLACE = arg("place", "MAILLAGE", "POINT", en="nodes that share it")


def _shared(call: Call, values: Mapping[str, float], place: Mesh | Point) -> NodeField:
    """Values by component, shared equally by the nodes of a place."""
    nodes = place.sorted_node_ids
    if not len(nodes):
        raise call.error("operators.statics.empty-mesh-for-force", place)
    parts = {n: np.full(len(nodes), v / len(nodes)) for n, v in values.items()}
    return NodeField.of(place.nodes, nodes, parts, "DISCRET")


def _by_vector(call: Call, vector: Point, names: tuple[str, ...], place: Mesh | Point) -> NodeField:
    usual = tuple(dual_of(n) for n in names)
    values = dict(zip(usual, vector.coordinates[: len(usual)], strict=True))
    return _shared(call, values, place)


def _by_name(names: tuple[str, ...], unit: str) -> Any:
    value = arg("value", "FLOTTANT", unit=unit, range=ANY_NUMBER)
    return Key(names, value, optional=False, repeated=True, en="components")


@operator("FORC", family="load", full_name="FORCE")
def forc(
    call: Call, vector: Point = Arg("POINT", en="force", unit="N"), place: Mesh | Point = _PLACE
) -> NodeField:
    """A force by its vector."""
    return _by_vector(call, vector, NODE_TRANSLATIONS[workspace(call.session).mode], place)


@forc.form()
def named_forces(
    call: Call,
    values: list[tuple[str, float]] = _by_name(FORCES, "N"),
    place: Mesh | Point = _PLACE,
) -> NodeField:
    """A force by its components."""
    return _shared(call, dict(values), place)


@forc.form()
def unit_forces(call: Call, table: Table = Arg("TABLE", en="table LIAISONS_STATIQUES")) -> None:
    """FORCE in each entry of a table LIAISONS_STATIQUES: one, at its point."""
    nodes = workspace(call.session).nodes
    links = static_links(table)
    for entry, point, component in links:
        if not isinstance(point, Point) or not component:
            raise call.error("operators.statics.entry-wants-point-and-unknown", table)
        at, one = np.array([point.node]), np.ones(1)
        entry.set("FORCE", NodeField.of(nodes, at, {component: one}, "DISCRET"))
    if not links:
        raise call.error("operators.statics.no-numbered-entry", table)


@operator("MOME", family="load", full_name="MOMENT")
def mome(
    call: Call,
    vector: Point = Arg("POINT", en="moment, in space", unit="N m"),
    place: Mesh | Point = _PLACE,
) -> NodeField:
    """A moment by its vector."""
    mode = workspace(call.session).mode
    if mode is not Mode.THREE_DIMENSIONAL:
        raise call.error("operators.statics.no-moment-by-vector")
    return _by_vector(call, vector, NODE_ROTATIONS[mode], place)


@mome.form()
def named_moments(
    call: Call,
    values: list[tuple[str, float]] = _by_name(MOMENTS, "N m"),
    place: Mesh | Point = _PLACE,
) -> NodeField:
    """A moment by its components."""
    return _shared(call, dict(values), place)


_PRESSURE = arg(
    "value",
    "CHPOINT",
    "MCHAML",
    "FLOTTANT",
    en="pressure, by its number or as a field",
    unit="Pa",
    range=ANY_NUMBER,
)
_OF_SHELLS = many("fields", "MCHAML", en="parameters of shells: DIM3 counts in plane stress")
_FACES = opt("faces", "MAILLAGE", en="sides")


@operator("PRES", family="load", full_name="PRESSION")
def pres(
    call: Call,
    model: Model = MODEL,
    kind: str | None = Choice(("MASS", "POUT"), en="on sides of continuous elements, the default"),
    load: Chosen = OneOf(
        group("plain", _PRESSURE, _FACES),
        group(
            "named",
            arg("name", "MOT", en="name of the component, for a model CHARGEMENT"),
            arg("value", "FLOTTANT", "MCHAML", en="pressure", unit="Pa", range=ANY_NUMBER),
            _FACES,
        ),
    ),
) -> NodeField | CellField:
    """Pressure on sides of continuous elements, or the field of a model of loads."""
    value, faces = load["value"], load["faces"]
    if all(z.formulation == "CHARGEMENT" for z in model.zones) and kind is None:
        return _of_loads(call, model, load.values.get("name"), value, faces)
    if load.word == "named":
        raise call.missing(("FLOTTANT", "CHPOINT", "MCHAML"))
    return _on_faces(call, model, value, faces)


def _on_faces(
    call: Call, model: Model, value: NodeField | CellField | float, faces: Mesh | None
) -> NodeField:
    if isinstance(value, CellField):
        value = loads.on_sides(model, value)
    return loads.pressure(model, _sides(call, model, value, faces), value)


def _sides(call: Call, model: Model, load: object, faces: Mesh | None) -> Mesh:
    """The sides of a load, else those whose nodes its field has; told where some stand twice."""
    if faces is None:
        if not isinstance(load, NodeField | CellField):
            raise call.missing(("MAILLAGE",))
        faces = loads.loaded_faces(model, load)
    if count := repeated_cells(faces).n_cells:
        call.warn("operators.statics.sides-twice", faces, count=count)
    return faces


@pres.form(said("COQU"))
def along_normals(
    model: Model = MODEL,
    value: NodeField | CellField | float = _PRESSURE,
    side: str = Choice(("NORM",), optional=False, en="along the normal"),
    fields: tuple[CellField, ...] = _OF_SHELLS,
) -> NodeField:
    """Pressure along the normals of shells."""
    return loads.shell_load(model, value, material=_joined(fields))


@pres.form(said("COQU"))
def shell_pressure(
    model: Model = MODEL,
    value: NodeField | CellField | float = _PRESSURE,
    along: Point | None = Opt("POINT", en="vector on the side it pushes to"),
    towards: Point | None = Key("POIN", "POINT", en="point on the side it pushes to"),
    fields: tuple[CellField, ...] = _OF_SHELLS,
) -> NodeField:
    """Pressure on shells."""
    aim, point = (None if p is None else p.coordinates for p in (along, towards))
    return loads.shell_load(model, value, aim, point, _joined(fields))


@pres.form(said("SHB8"))
def brick_pressure(
    call: Call,
    model: Model = MODEL,
    value: NodeField | CellField | float = _PRESSURE,
    side: str | None = Choice(
        ("INTE", "EXTE"), en="face of the first four nodes, or of the last four"
    ),
) -> NodeField:
    """Pressure on shells of bricks."""
    return _on_faces(call, model, value, _brick_faces(call, model, side))


@pres.form(said("TUYA"))
def pressure_in_pipes(
    model: Model = MODEL,
    material: tuple[CellField, ...] = Many("MCHAML", at_least=1, en="parameters"),
) -> NodeField:
    """Pressure on the closed ends of pipes."""
    return loads.pipe_pressure(model, joined(material))


@pres.form(said("FISS"))
def crack_pressure(call: Call) -> NoReturn:
    """Pressure on sides of cracks: refused."""
    raise call.error("operators.statics.load-not-available", found="FISS")


def _of_loads(
    call: Call,
    model: Model,
    name: str | None,
    value: CellField | NodeField | float,
    faces: Mesh | None,
) -> CellField:
    """The field of pressure of a model of loads: a number or a field in cells."""
    if isinstance(value, NodeField):
        raise call.missing(("FLOTTANT", "MCHAML"))
    if faces is not None:
        model = model_on_mesh(model, faces)
    label = (name or "PRES").rstrip()
    blocks = []
    for zone in model.zones:
        if isinstance(value, CellField):
            seen = zone_field(zone, value)
            if len(seen.names) != 1:
                raise call.error("operators.statics.pressure-has-one-component", value)
            values, support = seen.raw(seen.names[0])
        else:
            values, support = np.full((len(zone.cells), 1), float(value)), "NOEUD"
        blocks.append(zone.block({label: values}, support))
    return CellField(tuple(blocks), "PRESSION")


def _brick_faces(call: Call, model: Model, side: str | None) -> Mesh | None:
    """The inner or outer face of shells of bricks: first or last four nodes."""
    if any(z.element != "SHB8" for z in model.zones):
        raise call.error("operators.statics.not-shb8", model)
    if side is None:
        return None
    nodes = slice(0, 4) if side == "INTE" else slice(4, 8)
    blocks = [CellBlock.make(z.cells.nodes, "QUA4", z.cells.raw[:, nodes]) for z in model.zones]
    return Mesh(model.mesh.nodes, tuple(blocks))


_DENSITY = arg("density", "CHPOINT", "POINT", en="force per area or length, as a vector or a field")
_THICKNESS = many("fields", "MCHAML", en="thickness in plane stress")


def _joined(fields: tuple[CellField, ...]) -> CellField | None:
    return joined(fields) if fields else None


def _values(density: NodeField | Point) -> NodeField | FloatArray:
    return density if isinstance(density, NodeField) else density.coordinates


@operator("FSUR", family="load")
def fsur(
    call: Call,
    model: Model = MODEL,
    kind: str | None = Choice(("MASS", "TUYA"), en="on sides of continuous elements, the default"),
    density: NodeField | Point = _DENSITY,
    faces: Mesh | None = _FACES,
    fields: tuple[CellField, ...] = _THICKNESS,
) -> NodeField:
    """Forces on sides of continuous elements."""
    sides = _sides(call, model, density, faces)
    return loads.traction(model, sides, _values(density), _joined(fields))


@fsur.form(said("COQU"))
def shell_forces(
    model: Model = MODEL,
    density: NodeField | Point = _DENSITY,
    fields: tuple[CellField, ...] = _OF_SHELLS,
) -> NodeField:
    """Forces on shells."""
    return loads.shell_load(model, _values(density), material=_joined(fields))


@fsur.form(said("POUT"))
def line_forces(
    model: Model = MODEL,
    density: NodeField | Point = _DENSITY,
    normal: Point | None = Key("PROJ", "POINT", en="vector normal to the plane of projection"),
) -> NodeField:
    """Forces along beams and bars."""
    return loads.line_load(model, _values(density), None if normal is None else normal.coordinates)


@operator("CNEQ", family="load")
def cneq(
    call: Call,
    model: Model = MODEL,
    force: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="force per volume", unit="N/m3"),
    fields: tuple[CellField, ...] = _THICKNESS,
) -> NodeField:
    """Volume forces."""
    if isinstance(force, NodeField):
        held = [np.isin(z.cells.connectivity, force.node_ids) for z in model.zones]
        if count := sum(int((at.any(axis=1) & ~at.all(axis=1)).sum()) for at in held):
            call.warn("operators.statics.force-in-part", force, count=count)
    return loads.body_force(model, force, joined(fields) if fields else None)
