"""What lies inside lines, surfaces and volumes: DEDA INCL."""

from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.queries.select import inside_contour, inside_volume
from ssilang.kernel.mesh.queries.signed_distance import before_triangles
from ssilang.kernel.mesh.volumes.tetrahedralize import ray_inside
from ssilang.operators.mesh.selection.boundaries import not_empty
from ssilang.operators.prelude import *


@operator("DEDA", family="mesh")
def deda(
    session: Session,
    point: Point = Arg("POINT", en="point"),
    mesh: Mesh = Arg("MAILLAGE", en="closed line or closed surface"),
    tolerance: float = Opt(
        "FLOTTANT", default=0.0, en="distance still inside", unit="m", range=NOT_NEGATIVE
    ),
) -> bool:
    """Whether a point is inside."""
    at = point.coordinates[None].copy()
    if workspace(session).dimension < 3:
        border = contour(mesh) if mesh.dimension == 2 else mesh
        return bool(inside_contour(at, border, strict=False, near=tolerance)[0])
    corners = [b.connectivity[:, list(b.kind.corners)] for b in mesh.blocks]
    if not corners or any(t.shape[1] != 3 for t in corners):
        raise MeshError("operators.mesh.closed-triangles-wanted")
    triangles = np.concatenate(corners)
    if ray_inside(at, mesh.nodes.coordinates, triangles)[0]:
        return True
    return bool(abs(before_triangles(at, mesh.nodes.coordinates, triangles)[0]) <= tolerance)


@operator("INCL", family="mesh", full_name="INCLUS")
def incl(
    call: Call,
    volume: bool = Flag("VOLU", en="inside volume cells"),
    mesh: Mesh = Arg("MAILLAGE", en="cells to pick from"),
    outer: Mesh = Arg("MAILLAGE", en="closed line, surface with such a contour, or volume cells"),
    how: str | None = Choice(
        ("STRI", "LARG", "BARY"), en="nodes on the border do not count, or do; or centres decide"
    ),
    allowed: bool = Flag("NOID", en="the result may be empty"),
    margin: float | None = Opt(
        "FLOTTANT",
        range=ANY_NUMBER,
        en="with 'VOLU' how far outside still counts, 1E-2 by default; below zero how near to the "
        "skin does not",
    ),
) -> Mesh:
    """Cells inside a contour (or the contour of a surface), or inside a volume."""
    if margin is not None and not volume:
        call.warn("operators.mesh.margin-without-volume", margin=margin)
    border = contour(outer) if not volume and outer.dimension == 2 else outer

    def inside(at: FloatArray) -> NDArray[np.bool_]:
        if volume:
            return inside_volume(at, outer, 1e-2 if margin is None else margin)
        return inside_contour(at, border, how == "STRI")

    def chosen(block: CellBlock) -> NDArray[np.bool_]:
        if how == "BARY":
            return inside(block.coordinates.mean(axis=1))
        good = inside(block.coordinates.reshape(-1, 3)).reshape(len(block), -1)
        return np.asarray((np.any if volume and how == "LARG" else np.all)(good, axis=1))

    return not_empty(take(mesh, chosen), allowed, "operators.mesh.no-cell-inside")
