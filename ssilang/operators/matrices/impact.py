"""IMPO: sides in contact; possible links in the plane, relations of those that touch."""

from ssilang.kernel.contact import touching
from ssilang.kernel.matrices.relations import in_space
from ssilang.kernel.mesh.combine import union
from ssilang.operators.matrices.relations import length_of
from ssilang.operators.matrices.supports import as_matrix
from ssilang.operators.models.contact import contact_model, sides_in
from ssilang.operators.prelude import *
from ssilang.operators.statics.pasapas_contact import sides_of

_SIZE = arg("size", "FLOTTANT", en="radius, or width", unit="m", range=POSITIVE)
_ANGLE = arg(
    "angle", "FLOTTANT", en="from the axis to the side", unit="deg",
    range=Range(0.0, 90.0, open_low=True, open_high=True),
)  # fmt: skip


@operator("IMPO", said("IMPA"), family="relations", full_name="IMPOSE")
def impo(
    call: Call,
    master: Mesh = Key("MAIT", "MAILLAGE", optional=False, en="line of segments"),
    slave: Mesh | Point = Key(
        "ESCL",
        "MAILLAGE",
        "POINT",
        optional=False,
        en="line that comes to touch it, or point of a rigid projectile",
    ),
) -> Mesh:
    """All links that lines, or a line and a projectile, can have."""
    if workspace(call.session).mode.dimension != 2:
        raise call.error("operators.matrices.impo-in-the-plane", master)
    if isinstance(slave, Point):
        slave = slave.mesh
    return touching.possible_links(master, slave)


@impo.form(said("IMPA"))
def of_touching(
    call: Call,
    links: Mesh = Arg("MAILLAGE", en="possible links, by IMPO 'IMPA' 'MAIT'"),
    nose: Chosen | None = Cases(
        {
            "HEMI": [_SIZE],
            "PLAT": [_SIZE],
            "CONE": [_SIZE, key("angle", "ANGL", _ANGLE, optional=False)],
        },
        en="nose of the projectile: half a circle, flat, or a cone",
    ),
    axis: Point | None = Key("VECT", "POINT", en="axis of the projectile, out of its nose"),
) -> Matrix | Annule:
    """Relations of the nodes that touch now."""
    kinds = {b.cell_type for b in links.blocks}
    if not kinds <= {touching.OF_LINES, touching.OF_PROJECTILE}:
        raise call.error("operators.matrices.impo-wants-links", links)
    shot = touching.OF_PROJECTILE in kinds
    if shot and (nose is None or axis is None):
        raise call.error("operators.matrices.projectile-without-nose", links)
    if not shot and (nose is not None or axis is not None):
        raise call.error("operators.matrices.nose-without-projectile", links)
    names = in_space(workspace(call.session).mode)
    found = touching.touching(links, (names[0], names[1]), _nose(call, nose, axis))
    return ANNULE if found is None else as_matrix(found)  # EXIS tells


def _nose(call: Call, nose: Chosen | None, axis: Point | None) -> touching.Nose | None:
    if nose is None or axis is None:
        return None
    vector = axis.coordinates[:2]
    unit = vector / length_of(call, axis, vector)
    angle = np.radians(nose["angle"]) if nose.word == "CONE" else 0.0
    return touching.Nose(nose.word, unit, nose["size"], float(angle))


_SIDES = (
    arg("master", "MAILLAGE", en="first side"),
    arg("slave", "MAILLAGE", en="second side"),
)


@impo.form(
    said("MAIL"),
    choice("method", ("SYME", "MESC", "FAIB"), default="SYME", en="as of MODE 'CONTACT'"),
    opt("reach", "FLOTTANT", unit="m", range=POSITIVE, en="cells farther apart are left out"),
    opt(
        "least",
        "FLOTTANT",
        unit="m",
        range=NOT_NEGATIVE,
        en="changes nothing: sides that face away never touch",
    ),
    *_SIDES,
)
def of_sides(
    call: Call, method: str, reach: float | None, least: float | None, master: Mesh, slave: Mesh
) -> Mesh:
    """Mesh of two sides, of which MODE 'CONTACT' makes a model."""
    if least is not None:
        call.warn("operators.matrices.least-distance-unused", least)
    if reach is not None:
        master, slave = touching.within(master, slave, reach)
    workspace(call.session).sides.append((master, slave, method))
    return union(master, slave)


@impo.form(said("BLOC"), arg("mesh", "MAILLAGE", en="mesh of two sides, by IMPO 'MAIL'"))
def of_mesh(call: Call, mesh: Mesh) -> tuple[NodeField, Matrix]:
    """Gaps and relations of the sides of a mesh as they lie now."""
    return _gaps_and_relations(call, sides_in(call, mesh))


@impo.form(*_SIDES)
def of_two(call: Call, master: Mesh, slave: Mesh) -> tuple[NodeField, Matrix]:
    """Gaps and relations of two sides as they lie now."""
    return _gaps_and_relations(call, [(master, slave, "SYME")])


def _gaps_and_relations(
    call: Call, sides: list[tuple[Mesh, Mesh, str]]
) -> tuple[NodeField, Matrix]:
    found = sides_of(contact_model(call, sides, False, workspace(call.session)), None, {})
    if found.matrix is None or found.gaps is None:
        raise call.error("operators.matrices.sides-do-not-face", sides[0][1])
    return found.gaps, found.matrix
