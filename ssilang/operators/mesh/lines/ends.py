"""What operators that draw lines read: ends, numbers of elements, mesh sizes."""

from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.families import Family, family_of
from ssilang.kernel.mesh.lines import lines
from ssilang.kernel.mesh.lines.curves import Arc, Polynomial
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.queries.measure import cell_measures
from ssilang.language.vocabulary.terms import CELLS_ALONG
from ssilang.operators.prelude import *

__all__ = [
    "ANGLE", "AXIS", "COUNT", "END", "SIZES", "START", "Cuts", "Ends", "Sizes", "axis_of",
    "chosen_family", "count_and_angle", "cuts_of", "drawn", "drawn_between", "drawn_from",
    "ends_of", "positions", "warn_of_flat_cells",
]  # fmt: skip

COUNT = opt(
    "count",
    "ENTIER",
    en="number of elements, graded by the mesh sizes if negative; without it these decide",
    range=CELLS_ALONG,
)
ANGLE = opt("angle", "FLOTTANT", en="angle", unit="deg", usual=between(-360.0, 360.0))
SIZES = key(
    "sizes",
    ("DINI", "DFIN"),
    arg("size", "FLOTTANT", unit="m", usual=NOT_NEGATIVE),
    repeated=True,
    en="mesh size at the start, at the end, in place of the one there; 0 beside a negative number",
)
Sizes = Sequence[tuple[str, float]]
START = arg("start", "POINT", "MAILLAGE", en="start, or a line to go on")
END = opt(
    "end", "POINT", "MAILLAGE", en="end, or a line to reach; without it the line START is closed"
)

FLAT = 1e-12  # size of a cell that has none, beside that of its mesh
AXIS = many("axis", "POINT", at_least=1, en="centre, or in space two points of the axis")


@dataclass(frozen=True)
class Cuts:
    """Number of elements, 0 if not given, and the mesh sizes given for the ends."""

    count: int = 0
    first: float | None = None
    last: float | None = None

    def sizes(self, densities: tuple[float, float]) -> tuple[float, float]:
        """The given sizes, else those of the two ends."""
        first, last = densities
        return (
            first if self.first is None else self.first,
            last if self.last is None else self.last,
        )


def cuts_of(count: int | None, sizes: Sizes) -> Cuts:
    """What `COUNT` and `SIZES` have read; the sign of a size counts for nothing."""
    said = {end: abs(size) for end, size in sizes}
    return Cuts(count or 0, said.get("DINI"), said.get("DFIN"))


def count_and_angle(call: Call, count: int | None, angle: float | None) -> tuple[int, float]:
    """What `COUNT` and `ANGLE` have read: an integer alone is the angle."""
    if angle is not None:
        return count or 0, angle
    if count is None:
        raise call.missing(("FLOTTANT",))
    return 0, float(count)


def axis_of(call: Call, points: Sequence[Point]) -> tuple[FloatArray, FloatArray]:
    """Origin and direction that `AXIS` has read: in the plane the direction is its normal."""
    needed = 2 if workspace(call.session).dimension == 3 else 1
    if len(points) < needed:
        raise call.missing(("POINT",))
    if len(points) > needed:
        raise call.error(
            "operators.mesh.axis-points", points[-1], needed=needed, n_points=len(points)
        )
    origin = points[0].coordinates.copy()
    if needed == 1:
        return origin, np.array([0.0, 0.0, 1.0])
    return origin, points[1].coordinates - origin


def chosen_family(ws: Workspace) -> Family:
    """Cells that go with OPTI ELEM.

    Raises
    ------
    MeshError
        If it was not set.
    """
    if not ws.element:
        raise MeshError("operators.mesh.no-element-type")
    return family_of(ws.element)


@dataclass(frozen=True)
class Ends:
    """Where a new line starts and ends, and the lines that it continues on either side."""

    start: int
    end: int
    before: Mesh | None = None
    after: Mesh | None = None


def ends_of(call: Call, first: Point | Mesh, second: Point | Mesh | None) -> Ends:
    """Ends from one or two points or lines; a line alone is closed from its end to its start."""
    if second is None:
        if isinstance(first, Point):
            raise call.missing(("POINT",))
        start, end = lines.line_ends(first)
        return Ends(end, start, first)
    start = first.node if isinstance(first, Point) else lines.line_ends(first)[1]
    end = second.node if isinstance(second, Point) else lines.line_ends(second)[0]
    before = first if isinstance(first, Mesh) else None
    return Ends(start, end, before, second if isinstance(second, Mesh) else None)


def positions(ws: Workspace, *nodes: int) -> list[FloatArray]:
    """Copies of the coordinates of nodes."""
    return [ws.nodes.coordinates[n].copy() for n in nodes]


def warn_of_flat_cells(call: Call, made: Mesh) -> None:
    """Warn of new cells without length or area, and of quadrangles whose sides cross.

    One cell without length may be a spring or a joint between points.
    """
    sizes = np.concatenate([cell_measures(b) for b in made.blocks])
    extent = float(np.ptp(made.nodes.coordinates[made.sorted_node_ids], axis=0).max(initial=0.0))
    flat = int((np.abs(sizes) <= FLAT * extent**made.dimension).sum())
    if flat > 1:
        call.warn("operators.mesh.cells-without-size", count=flat, of=len(sizes))
    crossed = sum(
        int(_crossed(b).sum())
        for b in made.blocks
        if len(b.kind.corners) == 4 and b.kind.dimension == 2
    )
    if crossed:
        call.warn("operators.mesh.cells-that-cross", count=crossed, of=len(sizes))


def _crossed(block: CellBlock) -> NDArray[np.bool_]:
    """Quadrangles (n,) whose halves, along either diagonal, lie on opposite sides."""
    x = block.coordinates[:, list(block.kind.corners)]
    products = []
    for y in (x, np.roll(x, -1, axis=1)):
        across = y[:, 2] - y[:, 0]
        one, other = np.cross(y[:, 1] - y[:, 0], across), np.cross(across, y[:, 3] - y[:, 0])
        products.append((one * other).sum(axis=1))
    return (products[0] < 0.0) & (products[1] < 0.0)


def drawn(call: Call, ends: Ends, curve: lines.CurveMap, length: float, cuts: Cuts) -> Mesh:
    """The line along a curve between the ends, joined to the lines on either side."""
    ws = workspace(call.session)
    lines.different_nodes(ws.nodes, ends.start, ends.end)
    parts = subdivide(
        length, *cuts.sizes(lines.end_sizes(ws.nodes, ends.start, ends.end)), cuts.count
    )
    quadratic = chosen_family(ws).quadratic
    line = lines.mesh_curve(ws.nodes, curve, ends.start, ends.end, parts, quadratic, ws.colour)
    warn_of_flat_cells(call, line)
    pieces = [m for m in (ends.before, line, ends.after) if m is not None]
    return union(*pieces, as_given=True)


def drawn_between(
    call: Call,
    start: Point | Mesh,
    end: Point | Mesh | None,
    shape: Callable[[FloatArray, FloatArray], Arc | Polynomial],
    cuts: Cuts,
) -> Mesh:
    """The line between two ends along the curve that their positions say."""
    ends = ends_of(call, start, end)
    curve = shape(*positions(workspace(call.session), ends.start, ends.end))
    return drawn(call, ends, curve, curve.length, cuts)


def drawn_from(
    call: Call,
    start: Point | Mesh,
    way: Callable[[FloatArray], tuple[lines.CurveMap, float]],
    cuts: Cuts,
    last_size: float | None = None,
    closed: bool = False,
) -> Mesh:
    """The line from a point, or from the end of a line, which it goes on.

    Parameters
    ----------
    way : callable
        The curve and its length from the position (3,) of its start.
    last_size : float, optional
        Mesh size at the end; by default that of the start.
    closed : bool
        Whether the line comes back to its first node.
    """
    ws = workspace(call.session)
    before = start if isinstance(start, Mesh) else None
    first = start.node if isinstance(start, Point) else lines.line_ends(start)[1]
    curve, length = way(positions(ws, first)[0])
    size = float(ws.nodes.density[first])
    sizes = cuts.sizes((size, size if last_size is None else last_size))
    parts = subdivide(length, *sizes, cuts.count)
    quadratic = chosen_family(ws).quadratic
    line = lines.mesh_curve(
        ws.nodes, curve, first, first if closed else None, parts, quadratic, ws.colour
    )
    warn_of_flat_cells(call, line)
    return line if before is None else union(before, line, as_given=True)
