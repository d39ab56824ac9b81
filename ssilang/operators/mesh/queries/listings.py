"""How points and meshes are listed."""

from __future__ import annotations

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.messages.message import Teller
from ssilang.operators.dispatch import listing


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
