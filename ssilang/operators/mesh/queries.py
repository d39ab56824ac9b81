"""What a mesh holds: COOR NBEL NBNO MESU; how points and meshes are listed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.zone_fields import carry
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.mesh.boundary import chained
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.queries.measure import (
    enclosed_area,
    enclosed_volume,
    node_sizes,
    total_measure,
)
from ssilang.language.registry import Help, arg, choice, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListMots
from ssilang.operators.dispatch import COOR, listing
from ssilang.operators.workspace import workspace


def _axes(call: Call) -> tuple[int, ...]:
    """Numbers of the coordinates that are asked, from 0; the dimension stands for the density."""
    dimension = max(workspace(call.session).dimension, 1)
    number = call.optional("ENTIER")
    if number is None:
        return tuple(range(dimension))
    if not 1 <= number <= dimension + 1:
        raise call.bad(f"coordinate {number} is asked in dimension {dimension}", number)
    return (number - 1,)


def _column(call: Call, nodes: NodeTable, axis: int) -> FloatArray:
    """One coordinate, or the density, of all nodes."""
    if axis >= max(workspace(call.session).dimension, 1):
        return nodes.density
    column: FloatArray = nodes.coordinates[:, axis]
    return column


def _one_or_all(values: list[Any]) -> Any:
    return values[0] if len(values) == 1 else tuple(values)


@COOR.on(
    "POINT",
    syntax="X1 (Y1 (Z1)) = COOR (N1) POIN1 ;",
    en="Of a point: one coordinate (number DIME + 1 is the density), or all of them.",
    fr="D'un point : une coordonnée (la DIME + 1 ième est la densité), ou toutes.",
    examples=("OPTI DIME 2 ; X Y = COOR (1. 2.) ; LIST Y ;",),
)
def point_coordinates(call: Call, point: Point) -> Any:
    """Coordinates of a point."""
    node = point.node
    return _one_or_all([float(_column(call, point.nodes, a)[node]) for a in _axes(call)])


@COOR.on(
    "MAILLAGE",
    syntax="CHPO1 ... = COOR (N1) GEO1 ('CURV') ;",
    en="Of a mesh or a nodal field: nodal fields of component SCAL; 'CURV': the length along a "
    "line from its start.",
    fr="D'un maillage ou d'un champ par points : champs par points de composante SCAL ; 'CURV' : "
    "abscisse curviligne d'une ligne.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; X = COOR 1 L ; LIST (MAXI X) ;",
    ),
)
def mesh_coordinates(call: Call, mesh: Mesh) -> Any:
    """Coordinates of a mesh's nodes."""
    axes = _axes(call)
    if call.keyword(("CURV",)) is not None:
        return curvilinear(mesh)
    ids = mesh.sorted_node_ids
    return _one_or_all(
        [
            NodeField.of(mesh.nodes, ids, {"SCAL": _column(call, mesh.nodes, a)[ids]}, "DIFFUS")
            for a in axes
        ]
    )


def curvilinear(line: Mesh) -> NodeField:
    """Length along a line from its start, at its nodes; a closed line starts with its first cell.

    Raises
    ------
    MeshError
        If the mesh is not one line.
    """
    chain = line_chain(chained(line))
    xyz = line.nodes.coordinates[chain]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(xyz, axis=0), axis=1))])
    if chain[0] == chain[-1]:
        chain, length = chain[:-1], length[:-1]
    return NodeField.of(line.nodes, chain, {"SCAL": length}, "DIFFUS")


@COOR.on("CHPOINT")
def field_coordinates(call: Call, field: NodeField) -> Any:
    """Coordinates of the nodes that support a field."""
    ids = field.node_ids
    return _one_or_all(
        [
            NodeField.of(field.table, ids, {"SCAL": _column(call, field.table, a)[ids]}, "DIFFUS")
            for a in _axes(call)
        ]
    )


@COOR.on(
    "MMODEL",
    syntax="CHAM1 ... = COOR (N1) MODL1 ;",
    en="Of a model: cell fields at nodes.",
    fr="D'un modèle : champs par éléments aux noeuds.",
)
def model_coordinates(call: Call, model: Model) -> Any:
    """Coordinates of the cells' nodes of a model."""
    return _one_or_all([_model_axis(call, model, a) for a in _axes(call)])


@COOR.on("MCHAML", en="Of a cell field: cell fields, at the same points.")
def cell_field_coordinates(call: Call, field: CellField) -> Any:
    """Coordinates of the points that carry a cell field."""
    return _one_or_all([_field_axis(call, field, a) for a in _axes(call)])


def _field_axis(call: Call, field: CellField, axis: int) -> CellField:
    blocks = []
    for b in field.blocks:
        values = _column(call, b.cells.nodes, axis)[b.cells.connectivity]
        if b.support != "NOEUD":
            values = carry(values, b.element, "NOEUD", b.support)
        blocks.append(replace(b, components={"SCAL": values}))
    return CellField(tuple(blocks), "SCALAIRE")


def _model_axis(call: Call, model: Model, axis: int) -> CellField:
    blocks = tuple(
        CellFieldBlock(
            z.cells,
            {"SCAL": _column(call, z.cells.nodes, axis)[z.cells.connectivity]},
            element=z.element,
            constituent=z.constituent,
        )
        for z in model.zones
    )
    return CellField(blocks, "SCALAIRE")


@operator(
    "NBEL",
    arg("mesh", "MAILLAGE"),
    opt("types", "LISTMOTS"),
    family="mesh",
    help=Help(
        en="Number of cells of a mesh; with a list of cell types, a list of their numbers.",
        fr="Nombre d'éléments d'un maillage ; avec une liste de types, la liste de leurs nombres.",
        syntax="RESU1 = NBEL GEO1 (LMOTS1) ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; LIST (NBEL (DROI 4 (0. 0.) (1. 0.))) ;",),
    ),
)
def nbel(mesh: Mesh, types: ListMots | None) -> Any:
    """Count cells."""
    if types is None:
        return mesh.n_cells
    wanted = [str(t).rstrip().upper() for t in types.values]
    return ListEnti([sum(len(b) for b in mesh.blocks if b.cell_type == t) for t in wanted])


@operator(
    "NBNO",
    arg("mesh", "MAILLAGE", "POINT"),
    family="mesh",
    help=Help(
        en="Number of nodes of a mesh.",
        fr="Nombre de noeuds d'un maillage.",
        syntax="N1 = NBNO GEO1 ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; LIST (NBNO (DROI 4 (0. 0.) (1. 0.))) ;",),
    ),
)
def nbno(mesh: Mesh | Point) -> int:
    """Count nodes."""
    return len(mesh.node_ids) if isinstance(mesh, Mesh) else 1


@operator(
    "MESU",
    arg("mesh", "MAILLAGE"),
    choice("what", ("LONG", "SURF", "VOLU", "DENS")),
    family="mesh",
    full_name="MESURE",
    help=Help(
        en="Length, area or volume of a mesh; 'SURF' of a closed line: the area inside; 'VOLU' of "
        "a closed surface: the volume inside; 'DENS': field of mesh sizes (component SCAL).",
        fr="Longueur, aire ou volume d'un maillage ; 'SURF' d'une ligne fermée : l'aire intérieure "
        "; 'VOLU' d'une surface fermée : le volume intérieur ; 'DENS' : champ des tailles de "
        "maille.",
        syntax="FLOT1 = MESU GEO1 ('LONG'|'SURF'|'VOLU') ; CHPO1 = MESU GEO1 'DENS' ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; LIST (MESU (DROI 4 (0. 0.) (1. 0.))) ;",),
    ),
)
def mesu(mesh: Mesh, what: str | None) -> Any:
    """Measure a mesh."""
    if what == "DENS":
        ids, sizes = node_sizes(mesh)
        return NodeField.of(mesh.nodes, ids, {"SCAL": sizes}, "DIFFUS")
    asked = {"LONG": 1, "SURF": 2, "VOLU": 3}.get(what or "", mesh.dimension)
    if asked == mesh.dimension:
        return total_measure(mesh)
    if (asked, mesh.dimension) == (2, 1):
        return enclosed_area(mesh)
    if (asked, mesh.dimension) == (3, 2):
        return enclosed_volume(mesh)
    raise MeshError(f"{what} of a mesh of dimension {mesh.dimension} has no meaning")


@listing("POINT")
def list_point(point: Point, form: str) -> str:
    """What LIST prints of a point."""
    x, y, z = point.coordinates
    return f"POINT {point.node + 1} : X={x:.5E} Y={y:.5E} Z={z:.5E} DENS={point.density:.5E}"


@listing("MAILLAGE")
def list_mesh(mesh: Mesh, form: str) -> str:
    """What LIST prints of a mesh: a line a cell, or with 'RESU' a line a cell type."""
    lines = [
        f"MAILLAGE : {mesh.n_cells} element(s), {len(mesh.node_ids)} noeud(s), "
        f"{len(mesh.blocks)} type(s), {len(mesh.sides)} reference(s)"
    ]
    for block in mesh.blocks:
        lines.append(f" {len(block)} element(s) {block.cell_type} de {block.kind.n_nodes} noeud(s)")
        if form:
            continue
        rows = zip(block.colours.tolist(), (block.connectivity + 1).tolist(), strict=True)
        for k, (colour, row) in enumerate(rows, 1):
            lines.append(f"  {k:6d}  {COLOURS[colour]}  " + " ".join(f"{n:6d}" for n in row))
    return "\n".join(lines)
