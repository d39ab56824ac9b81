"""CHAN between supports of fields in cells, REDU and EXTR of models and fields in cells."""

from ssilang.kernel.elements.results import supports
from ssilang.kernel.fields.cell_algebra import united
from ssilang.operators.dispatch import CHAN, COOR, REDU
from ssilang.operators.prelude import *

SUPPORTS: tuple[Support, ...] = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")


_TITLE = opt("title", "MOT", en="sub-type of the result")
_MODEL = arg("model", "MMODEL", en="model")
_SOURCE = arg("field", "CHPOINT", "MCHAML", en="field")


def _trimmed(title: str | None) -> str | None:
    return None if title is None else str(title).rstrip()


def placed(
    model: Model, field: NodeField | CellField, support: Support, title: str | None = None
) -> CellField:
    """A field at the points of a support of a model's cells."""
    if isinstance(field, NodeField):
        return supports.cells_of_nodal(model, field, support, title or "")
    return supports.moved(model, field, support, title)


@CHAN.form(said(*SUPPORTS))
def chan_support(
    word: str,
    model: Model = _MODEL,
    field: NodeField | CellField = _SOURCE,
    title: str | None = _TITLE,
) -> CellField:
    """Another support."""
    return placed(model, field, cast(Support, word), _trimmed(title))


@CHAN.form(said("CHAM"))
def chan_cells(
    call: Call,
    field: NodeField | CellField = _SOURCE,
    place: Model | Mesh = Arg("MMODEL", "MAILLAGE", en="model or mesh"),
    support: str = Choice(SUPPORTS, default="NOEUD", en="points of the result"),
    title: str | None = _TITLE,
) -> CellField:
    """Nodal field to field in cells."""
    if isinstance(place, Mesh):
        if support != "NOEUD":
            call.warn("operators.fields.mesh-has-nodes-alone", support=support)
        return supports.cells_of_mesh(place, cast(NodeField, field), _trimmed(title) or "")
    return placed(place, field, cast(Support, support), _trimmed(title))


@CHAN.form(said("CHPO"))
def chan_nodal(
    call: Call,
    model: Model | None = Opt("MMODEL", en="model"),
    field: NodeField | CellField = _SOURCE,
    rule: str = Choice(
        ("MOYE", "SOMM", "SUPP"),
        default="MOYE",
        en="mean (default) or sum of the cells around, or a new node at each point",
    ),
) -> NodeField:
    """Field in cells to nodal field."""
    if isinstance(field, NodeField):
        return field
    if rule == "SUPP":
        return supports.values_at_points(field)
    if model is None:
        raise call.missing(("MMODEL",))
    return supports.nodal_of_cells(model, field, "SOMM" if rule == "SOMM" else "MOYE")


@REDU.form()
def redu_model(
    model: Model = Main("MMODEL", en="model"), mesh: Mesh = Arg("MAILLAGE", en="cells that stay")
) -> Model:
    """Model on a mesh."""
    return supports.model_on_mesh(model, mesh)


_STRICT = flag(
    "strict", "STRI", en="of models of mixtures: changes nothing here")  # fmt: skip


@REDU.form()
def redu_behind_model(
    model: Model = Main("MMODEL", en="model"),
    field: CellField = Arg("MCHAML", en="field"),
    strict: bool = _STRICT,
) -> CellField:
    """Field in cells, given behind the model that restricts it."""
    return supports.field_on_model(field, model)


@REDU.form(
    main("field", "MCHAML", en="field"),
    arg("support", "MAILLAGE", "MMODEL", en="cells that stay"),
    _STRICT,
)
def redu_cells(field: CellField, support: Mesh | Model, strict: bool = False) -> CellField:
    """Field in cells on a mesh or model."""
    if isinstance(support, Mesh):
        return supports.field_on_mesh(field, support)
    return supports.field_on_model(field, support)


@REDU.form(gives="TABLE")
def redu_dealt(
    call: Call,
    field: CellField = Main("MCHAML", en="field in cells"),
    table: Table = Arg("TABLE", en="models or meshes"),
) -> Table:
    """Field in cells on each part of a model."""
    made = Table("ESCLAVE")
    for index, part in table.items():
        if isinstance(part, Model | Mesh):
            made.set(index, redu_cells(field, part))
    if len(made) == 1:
        raise call.error("operators.fields.table-of-models", table)
    return made


@REDU.form()
def redu_table(
    call: Call, table: Table = Main("TABLE", en="table ESCLAVE of fields"), model: Model = _MODEL
) -> CellField:
    """The fields of a table on a model."""
    fields = [v for k, v in table.items() if isinstance(k, int) and isinstance(v, CellField)]
    if not fields:
        raise call.error("operators.fields.table-of-fields", table)
    return supports.field_on_model(reduce(united, fields), model)


_POINTS = main("field", "MCHAML", en="field in cells")


@COOR.form()
def coor_cells(
    call: Call,
    field: CellField = _POINTS,
    axis: int = Arg("ENTIER", en="axis, from 1", range=POSITIVE),
) -> CellField:
    """One coordinate as a field in cells."""
    if not 1 <= axis <= workspace(call.session).dimension:
        raise call.error("operators.fields.no-coordinate", axis, wanted=axis)
    return _coordinates(field, (axis - 1,))[0]


def _coordinates(field: CellField, axes: Iterable[int]) -> tuple[CellField, ...]:
    where = supports.point_coordinates(field)
    return tuple(
        CellField(
            tuple(replace(b, components={"SCAL": x[..., axis]}) for b, x in where), "SCALAIRE"
        )
        for axis in axes
    )


def _in(dimension: int) -> When:
    return When(lambda s: workspace(s).dimension == dimension, f"in {dimension}D")


for _dimension in (1, 2, 3):
    COOR.form(_POINTS, when=_in(_dimension), gives=("MCHAML",) * _dimension)(
        partial(_coordinates, axes=range(_dimension))
    )
