"""How much a mesh holds: NBEL NBNO MESU."""

from __future__ import annotations

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.queries.measure import (
    enclosed_area,
    enclosed_volume,
    node_sizes,
    total_measure,
)
from ssilang.language.registry import Help, arg, choice, operator, opt, said
from ssilang.language.values import ListEnti, ListMots


@operator(
    "NBEL",
    arg("mesh", "MAILLAGE", en="mesh"),
    opt("types", "LISTMOTS", en="types of cells", kind="element"),
    family="mesh",
    help=Help(
        en="Number of cells of a mesh; with a list of cell types, a list of their numbers.",
        syntax="RESU1 = NBEL GEO1 (LMOTS1) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; LIST (NBEL (DROI 4 (0. 0.) (1. 0.))) ;",),
    ),
)
def nbel(mesh: Mesh, types: ListMots | None) -> int | ListEnti:
    """Count cells, or cells by type."""
    if types is None:
        return mesh.n_cells
    wanted = [str(t).rstrip().upper() for t in types.values]
    return ListEnti([sum(len(b) for b in mesh.blocks if b.cell_type == t) for t in wanted])


@operator(
    "NBNO",
    arg("mesh", "MAILLAGE", "POINT", en="mesh, or point"),
    family="mesh",
    help=Help(
        en="Number of nodes of a mesh.",
        syntax="N1 = NBNO GEO1 ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; LIST (NBNO (DROI 4 (0. 0.) (1. 0.))) ;",),
    ),
)
def nbno(mesh: Mesh | Point) -> int:
    """Count nodes."""
    return len(mesh.node_ids) if isinstance(mesh, Mesh) else 1


@operator(
    "MESU",
    arg("mesh", "MAILLAGE", en="mesh"),
    choice(
        "what", ("LONG", "SURF", "VOLU"), en="length, area, volume; by default as the cells are"
    ),
    family="mesh",
    full_name="MESURE",
    help=Help(
        en="Length, area or volume of a mesh; 'SURF' of a closed line: the area inside; 'VOLU' of "
        "a closed surface: the volume inside; 'DENS': field of mesh sizes (component SCAL).",
        syntax="FLOT1 = MESU GEO1 ('LONG'|'SURF'|'VOLU') ; CHPO1 = MESU GEO1 'DENS' ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; LIST (MESU (DROI 4 (0. 0.) (1. 0.))) ;",
            ("OPTI DIME 2 ELEM SEG2 ;\nLIST (MAXI (MESU 'DENS' (DROI 4 (0. 0.) (1. 0.)))) ;"),
        ),
    ),
)
def mesu(mesh: Mesh, what: str | None) -> float:
    """Measure a mesh."""
    asked = {"LONG": 1, "SURF": 2, "VOLU": 3}.get(what or "", mesh.dimension)
    if asked == mesh.dimension:
        return total_measure(mesh)
    if (asked, mesh.dimension) == (2, 1):
        return enclosed_area(mesh)
    if (asked, mesh.dimension) == (3, 2):
        return enclosed_volume(mesh)
    raise MeshError("operators.mesh.no-such-measure", what=what, dimension=mesh.dimension)


@mesu.form(said("DENS"), arg("mesh", "MAILLAGE", en="mesh"))
def sizes(mesh: Mesh) -> NodeField:
    """Field of mesh sizes."""
    ids, values = node_sizes(mesh)
    return NodeField.of(mesh.nodes, ids, {"SCAL": values}, "DIFFUS")
