"""What a mesh holds: NBEL NBNO MESU, REFE for its names; how points and meshes are listed."""

from ssilang.io.plots.palette import COLOURS
from ssilang.kernel.mesh.queries import measure
from ssilang.operators.dispatch import listing
from ssilang.operators.prelude import *


@operator("NBEL", family="mesh", empties=True)
def nbel(
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
    types: ListMots | None = Opt("LISTMOTS", en="types of cells", kind="element"),
) -> int | ListEnti:
    """Count cells, or cells by type."""
    if types is None:
        return mesh.n_cells
    wanted = [str(t).rstrip().upper() for t in types.values]
    return ListEnti([sum(len(b) for b in mesh.blocks if b.cell_type == t) for t in wanted])


@operator("NBNO", family="mesh")
def nbno(mesh: Mesh | Point = Arg("MAILLAGE", "POINT", en="mesh, or point")) -> int:
    """Count nodes."""
    return len(mesh.node_ids) if isinstance(mesh, Mesh) else 1


@operator("MESU", family="mesh", empties=True, full_name="MESURE")
def mesu(
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
    what: str | None = Choice(
        ("LONG", "SURF", "VOLU"), en="length, area, volume; by default as the cells are"
    ),
) -> float:
    """Measure a mesh."""
    asked = {"LONG": 1, "SURF": 2, "VOLU": 3}.get(what or "", mesh.dimension)
    if asked == mesh.dimension:
        return measure.total_measure(mesh)
    if (asked, mesh.dimension) == (2, 1):
        return measure.enclosed_area(mesh)
    if (asked, mesh.dimension) == (3, 2):
        return measure.enclosed_volume(mesh)
    raise MeshError("operators.mesh.no-such-measure", what=what, dimension=mesh.dimension)


@mesu.form(said("DENS"))
def sizes(mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> NodeField:
    """Field of mesh sizes."""
    ids, values = measure.node_sizes(mesh)
    return NodeField.of(mesh.nodes, ids, {"SCAL": values}, "DIFFUS")


@listing("POINT")
def list_point(point: Point, short: bool, say: Teller) -> str:
    """What LIST prints of a point."""
    x, y, z = point.coordinates
    return f"POINT {point.node + 1} : X={x:.5E} Y={y:.5E} Z={z:.5E} DENS={point.density:.5E}"


@listing("MAILLAGE")
def list_mesh(mesh: Mesh, short: bool, say: Teller) -> str:
    """What LIST prints of a mesh: a line a cell, or with 'RESU' a line a cell type."""
    lines = [
        say(
            "operators.mesh.listed",
            n_cells=mesh.n_cells,
            n_nodes=len(mesh.node_ids),
            n_types=len(mesh.blocks),
            n_sides=len(mesh.sides),
        )
    ]
    for block in mesh.blocks:
        lines.append(
            say(
                "operators.mesh.listed-block",
                count=len(block),
                cell_type=block.cell_type,
                n_nodes=block.kind.n_nodes,
            )
        )
        if short:
            continue
        rows = zip(block.colours.tolist(), (block.connectivity + 1).tolist(), strict=True)
        for k, (colour, row) in enumerate(rows, 1):
            lines.append(f"  {k:6d}  {COLOURS[colour]}  " + " ".join(f"{n:6d}" for n in row))
    return "\n".join(lines)


@operator("REFE", family="mesh")
def refe(
    small: Mesh = Arg("MAILLAGE", en="mesh"),
    large: Mesh = Arg("MAILLAGE", en="mesh that may hold it"),
) -> bool:
    """Whether a mesh is within another one."""
    return _inside(small, large)


@refe.form()
def names_within(session: Session, mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> ListMots:
    """Names of the meshes within a mesh."""
    values = session.frame.named().items()
    return ListMots(
        [n for n, v in values if isinstance(v, Mesh) and v is not mesh and _inside(v, mesh)]
    )


def _inside(small: Mesh, large: Mesh) -> bool:
    return bool(np.isin(small.sorted_node_ids, large.sorted_node_ids).all())
