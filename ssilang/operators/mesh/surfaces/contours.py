"""Surfaces inside contours and cuts of them: SURF DALL COUP FUIT ISOV."""

from ssilang.kernel.fields.isovalue import isovalue
from ssilang.kernel.mesh.changes.degree import linear
from ssilang.kernel.mesh.changes.split import split_quadrangles
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.surfaces import charts
from ssilang.kernel.mesh.surfaces.analytic import (
    PolynomialSurface,
    mesh_polynomial_surface,
)
from ssilang.kernel.mesh.surfaces.fill import split_contour
from ssilang.kernel.mesh.surfaces.grid import grid_surface, matching_sides, sides_in_order
from ssilang.kernel.mesh.surfaces.surface import contour_chart_data, fill_surface
from ssilang.operators.mesh.lines.ends import chosen_family
from ssilang.operators.mesh.selection.sets import as_mesh
from ssilang.operators.prelude import *

_CENTRE = arg("centre", "POINT", en="centre")
_APEX = arg("apex", "POINT", en="apex")
_FIRST = arg("first", "POINT", en="point of the axis")
_AXIS = arg("axis", "POINT", en="other point of the axis")
_CIRCLE = arg("circle", "POINT", en="centre of a small circle")
_SHAPES = {
    "PLANE": (),
    "SPHERIQUE": (_CENTRE,),
    "CYLINDRIQUE": (_FIRST, _AXIS),
    "CONIQUE": (_APEX, _AXIS),
    "TORIQUE": (_CENTRE, _AXIS, _CIRCLE),
}
_SHAPE_EN = "what the surface lies on"
# chart of the contour's positions and the points behind the word
_CHARTS: dict[str, Callable[..., charts.Chart]] = {
    "SPHERIQUE": charts.sphere_chart,
    "CYLINDRIQUE": charts.cylinder_chart,
    "CONIQUE": charts.cone_chart,
    "TORIQUE": charts.torus_chart,
}


def _curved_chart(shape: Chosen, boundary: FloatArray) -> charts.Chart:
    points = [p.coordinates.copy() for p in shape.values.values()]
    return _CHARTS[shape.word](boundary, *points)


@operator("SURF", family="mesh", full_name="SURFACE")
def surf(
    session: Session,
    sizes: NodeField | None = Opt("CHPOINT", en="mesh sizes to respect, one component", unit="m"),
    contour: Mesh = Arg("MAILLAGE", en="closed lines"),
    shape: Chosen | None = Cases(_SHAPES, en=_SHAPE_EN),
    criterion: float | None = Opt(
        "FLOTTANT",
        range=NOT_NEGATIVE,
        en="how far the lines may leave their plane, a share of their extent, 1E-3 by default",
    ),
) -> Mesh:
    """Mesh the inside of a contour."""
    boundary, segments = contour_chart_data(contour)
    if shape is None or shape.word == "PLANE":
        chart = charts.plane_chart(
            boundary, segments, 1e-3 if criterion is None else abs(criterion)
        )
    else:
        chart = _curved_chart(shape, boundary)
    ws = workspace(session)
    family = chosen_family(ws)
    surface = family.surface or ("TRI6" if family.quadratic else "TRI3")
    return fill_surface(contour, chart, surface, ws.colour, _wanted_sizes(sizes))


def _wanted_sizes(field: NodeField | None) -> tuple[FloatArray, FloatArray] | None:
    if field is None:
        return None
    part = next(iter(field.components.values()))
    return field.table.coordinates[part.nodes].copy(), part.values


@operator("DALL", family="mesh", full_name="DALLER")
def dall(
    session: Session,
    side1: Mesh = Arg("MAILLAGE", en="first side"),
    side2: Mesh = Arg("MAILLAGE", en="second side"),
    side3: Mesh = Arg("MAILLAGE", en="third side"),
    side4: Mesh = Arg("MAILLAGE", en="fourth side"),
    shape: Chosen | None = Cases({**_SHAPES, "QUELCONQUE": ()}, en=_SHAPE_EN),
) -> Mesh:
    """Make a grid on four sides."""
    ws = workspace(session)
    ordered = sides_in_order([side1, side2, side3, side4])
    chart = None
    if shape is not None and shape.word in _CHARTS:
        boundary, _ = contour_chart_data(union(*ordered, as_given=True))
        chart = _curved_chart(shape, boundary)
    surface = chosen_family(ws).need_surface()
    if matching_sides(ordered):
        made = grid_surface(ordered, chart, ws.colour)
        return split_quadrangles(made) if surface.startswith("TRI") else made
    contour = union(*ordered, as_given=True)
    if chart is None:
        chart = charts.plane_chart(*contour_chart_data(contour))
    made = fill_surface(contour, chart, surface, ws.colour)
    return Mesh(made.nodes, made.blocks, ordered)


_POLYNOMIAL = (
    said("POLYNOME"),
    arg("columns", "ENTIER", range=POSITIVE, en="number of columns of points"),
    arg("rows", "ENTIER", range=POSITIVE, en="number of rows of points"),
    many("points", "POINT", en="P1 P2 P3 ..., row by row"),
    key(
        "limits",
        "PARAMETRE",
        arg("u1", "FLOTTANT", range=ANY_NUMBER),
        arg("u2", "FLOTTANT", range=ANY_NUMBER),
        arg("v1", "FLOTTANT", range=ANY_NUMBER),
        arg("v2", "FLOTTANT", range=ANY_NUMBER),
        default=(0.0, 1.0, 0.0, 1.0),
        en="where U and V begin and end",
    ),
    flag("regular", "REGULIER", en="nodes even along the sides"),
)


@dall.form(*_POLYNOMIAL)
@surf.form(*_POLYNOMIAL)
def polynomial_surface(
    call: Call,
    columns: int,
    rows: int,
    points: Sequence[Point],
    limits: tuple[float, float, float, float],
    regular: bool,
) -> Mesh:
    """The surface of a polynomial in U and V."""
    ws = workspace(call.session)
    if columns < 1 or rows < 1 or columns * rows < 2:
        raise call.error("operators.mesh.too-few-rows", columns, columns=columns, rows=rows)
    if len(points) < columns * rows:
        raise call.missing(("POINT",))
    if len(points) > columns * rows:
        told = {"columns": columns, "rows": rows, "needed": columns * rows, "n_points": len(points)}
        raise call.error("operators.mesh.too-many-points", points[-1], **told)
    table = np.array([p.coordinates for p in points]).reshape(rows, columns, 3)
    shape = PolynomialSurface(table, limits[:2], limits[2:])
    surface = chosen_family(ws).need_surface()
    return mesh_polynomial_surface(ws.nodes, shape, ws.density, surface, regular, ws.colour)


@operator("COUP", family="mesh", full_name="COUPER")
def coup(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="mesh in space"),
    p1: Point = Arg("POINT", en="point of the plane"),
    p2: Point = Arg("POINT", en="second point of the plane"),
    p3: Point = Arg("POINT", en="third point of the plane"),
) -> Mesh:
    """Section by a plane."""
    a, b, c = (p.coordinates for p in (p1, p2, p3))
    normal = np.cross(b - a, c - a)
    size = float(np.linalg.norm(normal))
    if size <= 1e-12 * max(float((b - a) @ (b - a)), float((c - a) @ (c - a))):
        raise call.error("operators.mesh.no-plane", p3)
    flat = linear(mesh)
    blocks = []
    for cells in flat.blocks:
        height = (cells.coordinates - a) @ (normal / size)
        blocks.append(CellFieldBlock(cells, {"SCAL": height}, "NOEUD"))
    return isovalue(CellField(tuple(blocks), ""), 0.0)


@operator("FUIT", family="mesh")
def fuit(
    contour: Mesh = Arg("MAILLAGE", en="closed contour of SEG2"),
    first: Mesh | Point = Arg("MAILLAGE", "POINT", en="where the segment may begin"),
    second: Mesh | Point = Arg("MAILLAGE", "POINT", en="where it may end"),
) -> tuple[Mesh, Mesh, Mesh]:
    """Cut a contour in two."""
    return split_contour(contour, as_mesh(first), as_mesh(second))


_SIDES = {"EGAL": 0, "EGINFE": -1, "EGSUPE": 1}


@operator("ISOV", family="mesh", full_name="ISOVALEUR")
def isov(
    field: CellField = Arg("MCHAML", en="field at nodes, one component"),
    side: str = Choice(
        tuple(_SIDES),
        default="EGAL",
        en="places of the value, the default, or of smaller or larger ones",
    ),
    value: float = Arg("FLOTTANT", en="value", range=ANY_NUMBER),
) -> Mesh:
    """Isovalue, or part on one side of it."""
    return isovalue(field, value, _SIDES[side])
