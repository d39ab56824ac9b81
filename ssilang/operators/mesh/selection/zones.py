"""PART and CCON: a mesh taken apart into a table of zones."""

from ssilang.kernel.mesh.queries.partition import balanced, connected, scattered, separated
from ssilang.operators.prelude import *

_FREE = flag("free", "NESC", en="the table has no sub-type")
_MESH = main("mesh", "MAILLAGE", en="mesh")
_COUNT = arg("count", "ENTIER", range=POSITIVE, en="number of parts")


@operator("PART", said("CONN"), family="mesh", full_name="PARTITION")
def part(mesh: Mesh = _MESH, free: bool = _FREE) -> Table:
    """Parts joined by common nodes."""
    return _table(connected(mesh), free)


@part.form(said("SEPA"))
def separated_parts(
    call: Call,
    mesh: Mesh = _MESH,
    branching: list[str] = Key(
        ("FACE", "LIGN"), repeated=True, en="sides of more than two cells separate"
    ),
    separator: Mesh | None = Key("MAIL", "MAILLAGE", en="sides within these cells separate"),
    turn: Chosen | None = Cases(
        {
            "ANGL": (
                opt(
                    "angle",
                    "FLOTTANT",
                    range=between(0.0, 180.0),
                    default=20.0,
                    en="least angle",
                    unit="deg",
                ),
            )
        },
        en="sides where normals or tangents turn separate",
    ),
    folded: bool = Flag("TELQ", en="cells of opposite senses are taken as folded"),
    free: bool = _FREE,
) -> Table:
    """Parts joined by common sides, but those that separate."""
    said: dict[str, Any] = {"by_branching": True} if branching else {}
    if separator is not None:
        said["separator"] = separator
    if turn is not None:
        said |= {"angle": turn["angle"], "folded": folded}
    if not said:
        raise call.error("operators.mesh.nothing-separates")
    return _table(separated(mesh, **said), free)


@part.form(said("OPTI"))
def equal_parts(
    mesh: Mesh = _MESH,
    count: int = Opt("ENTIER", range=POSITIVE, default=2, en="number of parts, a power of 2"),
    free: bool = _FREE,
) -> Table:
    """Parts of equal size."""
    return _table(balanced(mesh, count), free)


@part.form(said("ARLE"), of=("MAILLAGE",))
def dealt_out(mesh: Mesh = _MESH, count: int = _COUNT, free: bool = _FREE) -> Table:
    """Cells dealt out in turn."""
    return _table(scattered(mesh, count), free)


@part.form(
    main("model", "MMODEL", en="model"),
    _COUNT,
    _FREE,
)
@part.form(said("ARLE"), arg("model", "MMODEL", en="model"), _COUNT, _FREE, of=("MMODEL",))
def dealt_out_model(model: Model, count: int, free: bool) -> Table:
    """Models whose cells are dealt out in turn, zone by zone."""
    made: list[list[Zone]] = [[] for _ in range(count)]
    for zone in model.zones:
        for place, mesh in enumerate(scattered(Mesh(zone.cells.nodes, (zone.cells,)), len(made))):
            made[place] += [replace(zone, cells=cells) for cells in mesh.blocks]
    return _table([Model(tuple(zones)) for zones in made if zones], free)


def _table(zones: Sequence[Mesh | Model], free: bool) -> Table:
    return Table.numbered(zones, "" if free else "ESCLAVE")


@operator("CCON", family="mesh")
def ccon(
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
    strict: str | None = Choice(
        ("STR1", "STR2"), en="points of more than two lines, edges of more than two cells separate"
    ),
) -> Table:
    """Connected parts."""
    return _table(separated(mesh, by_branching=True) if strict else connected(mesh), True)
