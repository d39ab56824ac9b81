"""How points and meshes are listed."""

from __future__ import annotations

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.operators.dispatch import listing


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
