"""PROI: fields in cells projected on other supports."""

from ssilang.kernel.elements.results.projection import Lost, by_least_squares, on_mesh, on_model
from ssilang.operators.prelude import *

_FIELDS = many("fields", "MCHAML", at_least=1, en="field at nodes")


_SUPPORT = choice(
    "support",
    ("NOEUDS", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES"),
    en="points of the result on a model, its nodes by default",
)
_MODEL = arg("place", "MMODEL", en="where to")
_MESH = arg("place", "MAILLAGE", en="where to")
_COUNT = opt(
    "count", "ENTIER", default=3, en="integration points in each direction", range=POSITIVE
)


_TOLERANCE = opt(
    "tolerance",
    "FLOTTANT",
    range=NOT_NEGATIVE,
    default=1e-5,
    en="how far outside of a cell a point counts, relative to the cell",
)


@operator("PROI", family="fields")
def proi(
    call: Call,
    place: Model = _MODEL,
    fields: tuple[CellField, ...] = _FIELDS,
    support: str | None = _SUPPORT,
    tolerance: float = _TOLERANCE,
) -> CellField:
    """Projection on a model."""
    points, lost = "NOEUD" if support in (None, "NOEUDS") else support, Lost()
    made = on_model(fields[-1], place, cast(Support, points), tolerance, lost)
    _tell(call, fields[-1], lost, "operators.fields.projected-zero-outside")
    return made


def _tell(call: Call, field: CellField, lost: Lost, code: str) -> None:
    """Warn of points outside of a field's cells, and raise the flag that SOUC reads."""
    count = sum(len(x) for x in lost)
    if count:
        first = next(x[0] for x in lost if len(x))
        call.warn(code, count=count, at=field.blocks[0].cells.nodes.shown(first))
        call.session.doubt()


@proi.form()
def proi_on_mesh(
    call: Call,
    place: Mesh = _MESH,
    fields: tuple[CellField, ...] = _FIELDS,
    support: str | None = _SUPPORT,
    tolerance: float = _TOLERANCE,
) -> NodeField:
    """Projection on a mesh."""
    made = on_mesh(fields[-1], place, tolerance, lost := Lost())
    _tell(call, fields[-1], lost, "operators.fields.projected-nowhere-outside")
    return made


@proi.form(said("MINI"))
def proi_by_least_squares(
    call: Call,
    place: Model = _MODEL,
    fields: tuple[CellField, ...] = _FIELDS,
    count: int = _COUNT,
    tolerance: float = _TOLERANCE,
) -> CellField:
    """Projection on a model by least squares."""
    made = by_least_squares(fields[-1], place, count, tolerance, lost := Lost())
    _tell(call, fields[-1], lost, "operators.fields.projected-zero-outside")
    return made


@proi.form(said("MINI"))
def proi_by_least_squares_on_mesh(call: Call, place: Mesh = _MESH) -> NoReturn:
    """Only a model has the elements that least squares need."""
    raise call.error("operators.fields.mini-needs-a-model", place)


@proi.form(said("POLY"))
def proi_by_polynomials(call: Call) -> NoReturn:
    """Not built."""
    raise call.error("operators.fields.poly-not-available")
