"""Surfaces swept by lines and volumes swept by surfaces, layer by layer.

Triangles between two lines, and cells joined to a point.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import contour
from ssilang.kernel.mesh.changes.degree import linear, quadratic
from ssilang.kernel.mesh.changes.split import split_quadrangles
from ssilang.kernel.mesh.combine import take, union
from ssilang.kernel.mesh.lines.curves import unit_vector
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.lines.subdivision import Subdivision
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import reversed_line

# base positions (m, 3) and one fraction of the way -> moved positions (m, 3)
Motion = Callable[[FloatArray, float], FloatArray]


@dataclass(frozen=True)
class Path:
    """How a mesh moves to sweep out a larger one.

    Attributes
    ----------
    length : float
        Mean length of the nodes' paths, against which mesh sizes count.
    last : array (m,) or None
        Existing nodes at the end, in the order of the base's `node_ids`; None creates them.
    """

    motion: Motion
    length: float
    last: IntArray | None = None


def translation(vector: FloatArray) -> Path:
    """A straight motion by `vector` (3,)."""
    return Path(lambda x, s: x + s * vector, float(np.linalg.norm(vector)))


def rotation(mesh: Mesh, angle: float, origin: FloatArray, axis: FloatArray) -> Path:
    """A turn by `angle` (degrees) about an axis through `origin`.

    Raises
    ------
    MeshError
        If the axis has no length.
    """
    unit = unit_vector(axis, "kernel.mesh.two-points-axis-rotation")
    arm = mean_position(mesh) - origin
    radius = float(np.linalg.norm(arm - arm @ unit * unit))

    def turn(x: FloatArray, s: float) -> FloatArray:
        return rotate(x, s * math.radians(angle), origin, unit)

    return Path(turn, radius * abs(math.radians(angle)))


def rotate(x: FloatArray, angle: float, origin: FloatArray, unit: FloatArray) -> FloatArray:
    """Positions (m, 3) turned by `angle` (radians) about the unit axis through `origin`."""
    arm = x - origin
    along = (arm @ unit)[:, None] * unit
    return origin + along + math.cos(angle) * (arm - along) + math.sin(angle) * np.cross(unit, arm)


def ruling(first: Mesh, second: Mesh) -> Path:
    """Straight lines between the corresponding nodes of two meshes of the same structure.

    Raises
    ------
    MeshError
        If cell types or numbers differ, or the nodes do not correspond one to one.
    """
    last = corresponding_nodes(first, second)
    goal = first.nodes.coordinates[last].copy()
    start = first.nodes.coordinates[first.node_ids]
    gap = np.linalg.norm(mean_position(second) - mean_position(first))
    length = float(np.linalg.norm(goal - start, axis=1).mean()) if first.dimension == 1 else gap
    return Path(lambda x, s: (1.0 - s) * x + s * goal, float(length), last)


def corresponding_nodes(first: Mesh, second: Mesh) -> IntArray:
    """Nodes of `second` in the order of `first.node_ids`, matched through the cells.

    Raises
    ------
    MeshError
        If the two meshes do not have the same structure.
    """
    ours = {b.cell_type: b.connectivity for b in first.blocks}
    theirs = {b.cell_type: b.connectivity for b in second.blocks}
    if {k: v.shape for k, v in ours.items()} != {k: v.shape for k, v in theirs.items()}:
        raise MeshError(
            "kernel.mesh.two-meshes-not-same", first=_summary(first), second=_summary(second)
        )
    if not first.blocks:
        return np.empty(0, dtype=np.int64)
    flat = np.concatenate([ours[b.cell_type].ravel() for b in first.blocks])
    image = np.concatenate([theirs[b.cell_type].ravel() for b in first.blocks])
    ids = first.node_ids
    target = np.zeros(int(flat.max()) + 1, dtype=np.int64)
    target[flat[::-1]] = image[::-1]
    return target[ids]


def sweep_line(
    line: Mesh,
    path: Path,
    cuts: Subdivision,
    surface: str,
) -> Mesh:
    """The surface that a line sweeps, with its four sides.

    Parameters
    ----------
    line : Mesh
        One block of SEG2 or SEG3.
    surface : str
        'QUA4', 'QUA8', 'TRI3' or 'TRI6'. Cells are quadratic if line and surface are.
    """
    block = line.single_block()
    if block.cell_type not in ("SEG2", "SEG3"):
        raise MeshError("kernel.mesh.line-needed-sweep-surface", cell_type=block.cell_type)
    quadratic = block.cell_type == "SEG3"
    layers = _Layers.build(line, path, cuts, quadratic)
    local = layers.local(block.connectivity)
    cells = _quadrangles(layers, local)
    colours = np.tile(block.colours, cuts.count)
    mesh = Mesh.of(line.nodes, "QUA8" if quadratic else "QUA4", cells, colours)
    if surface in ("QUA4", "TRI3"):
        mesh = linear(mesh)
    if surface.startswith("TRI"):
        mesh = split_quadrangles(mesh)
    end = Mesh.of(line.nodes, block.cell_type, layers.full[-1][local], block.colours)
    right = _upright(layers, int(local[-1, -1]), block.cell_type)
    left = _upright(layers, int(local[0, 0]), block.cell_type)
    return Mesh(mesh.nodes, mesh.blocks, (line, right, reversed_line(end), reversed_line(left)))


def sweep_surface(surface: Mesh, path: Path, cuts: Subdivision) -> Mesh:
    """The volume that a surface sweeps; sides: start face, end face, the faces around.

    Cells keep the order of the surface's nodes, start face first: where the motion goes against
    the surface's normal the volume cells are turned inside out, as they are in Cast3M.
    """
    quadratic = any(b.kind.degree == 2 for b in surface.blocks)
    layers = _Layers.build(surface, path, cuts, quadratic)
    blocks = tuple(_volume_block(layers, b, cuts) for b in surface.blocks)
    ends = []
    for b in surface.blocks:
        moved = layers.full[-1][layers.local(b.connectivity)]
        ends.append(CellBlock.make(b.nodes, b.cell_type, moved, b.colours))
    end = Mesh(surface.nodes, tuple(ends))
    border = contour(surface)
    around: tuple[Mesh, ...] = ()
    if border.n_cells:
        faces = []
        for block in border.blocks:
            cells = _quadrangles(layers, layers.local(block.connectivity))
            kind = "QUA8" if block.cell_type == "SEG3" else "QUA4"
            colours = np.tile(block.colours, cuts.count)
            faces.append(Mesh.of(border.nodes, kind, cells, colours))
        around = (union(*faces),)
    return Mesh(surface.nodes, blocks, (Mesh(surface.nodes, surface.blocks), end, *around))


def listed_cuts(values: FloatArray, length: float) -> Subdivision:
    """Layers at given positions (n,), scaled from their first and last to 0 and 1.

    Raises
    ------
    MeshError
        With fewer than two positions, or first equal to last.
    """
    if len(values) < 2 or values[0] == values[-1]:
        raise MeshError("kernel.mesh.list-layer-positions-needs")
    step = length / (len(values) - 1)
    return Subdivision((values - values[0]) / (values[-1] - values[0]), step, step)


def mean_density(mesh: Mesh) -> float:
    """Mean mesh size over the nodes of all cells (shared nodes count for each cell)."""
    return float(mesh.nodes.density[_cell_nodes(mesh)].mean())


def mean_position(mesh: Mesh) -> FloatArray:
    """Mean position over the nodes of all cells, shape (3,)."""
    return mesh.nodes.coordinates[_cell_nodes(mesh)].mean(axis=0)


def _cell_nodes(mesh: Mesh) -> IntArray:
    if not mesh.n_cells:
        raise MeshError("kernel.mesh.mesh-empty")
    return np.concatenate([b.connectivity.ravel() for b in mesh.blocks])


def _summary(mesh: Mesh) -> list[str]:
    return [f"{len(b)} {b.cell_type}" for b in mesh.blocks]


@dataclass(frozen=True)
class _Layers:
    """Node numbers of all layers: `full[k, i]` at the ends of layer k, `half[k, i]` in between."""

    nodes: NodeTable
    ids: IntArray
    full: IntArray
    half: IntArray

    @classmethod
    def build(cls, base: Mesh, path: Path, cuts: Subdivision, quadratic: bool) -> "_Layers":
        nodes, ids = base.nodes, base.node_ids
        start = nodes.coordinates[ids].copy()
        n, m = cuts.count, len(ids)
        full = np.empty((n + 1, m), dtype=np.int64)
        half = np.full((n, m), -1, dtype=np.int64)
        full[0] = ids
        corners = [b.connectivity[:, list(b.kind.corners)].ravel() for b in base.blocks]
        corner = np.isin(ids, np.concatenate(corners))
        slots = _slots(base, ids, corner if quadratic else None, n)
        if path.last is not None:
            full[n] = path.last
            slots = [s for s in slots if (s[0], s[1]) != ("full", n)]
        for kind, k, columns in slots:
            cut = float(cuts.middles[k] if kind == "half" else cuts.fractions[k])
            moved = path.motion(start, cut)[columns]
            made = nodes.add(moved, float(cuts.density(np.array(cut))))
            (half if kind == "half" else full)[k, columns] = made
        return cls(nodes, ids, full, half)

    def local(self, connectivity: IntArray) -> IntArray:
        """Column numbers of node numbers."""
        order = np.argsort(self.ids)
        return order[np.searchsorted(self.ids[order], connectivity)]


def _slots(
    base: Mesh, ids: IntArray, corner: BoolArray | None, n: int
) -> list[tuple[str, int, BoolArray]]:
    """Where nodes are made, in the order of their numbers: ('full' or 'half', level, columns).

    A surface over a line numbers its far side first, then the two lines beside it, then the
    inside, as Cast3M does; a volume goes layer by layer.
    """
    everything = np.ones(len(ids), bool)
    groups = [everything]
    slots: list[tuple[str, int, BoolArray]] = []
    levels = range(1, n + 1)
    if base.dimension == 1:
        used = np.bincount(
            np.concatenate([b.connectivity[:, [0, -1]].ravel() for b in base.blocks]),
            minlength=int(ids.max()) + 1,
        )
        ends = [ids == i for i in ids[used[ids] == 1]]
        groups = [*ends, ~np.isin(ids, ids[used[ids] == 1])]
        slots.append(("full", n, everything))
        levels = range(1, n)
    for group in groups:
        for k in range(1, n + 1):
            if corner is not None and (group & corner).any():
                slots.append(("half", k - 1, group & corner))
            if k in levels and group.any():
                slots.append(("full", k, group))
    return slots


def _quadrangles(layers: _Layers, local: IntArray) -> IntArray:
    """Connectivity of the quadrangles, layer by layer, on segments (n, 2 or 3) of columns."""
    a, b, middle, parts = local[:, 0], local[:, -1], local[:, 1], []
    for low, high, half in zip(layers.full[:-1], layers.full[1:], layers.half, strict=True):
        nodes = [low[a], low[middle], low[b], half[b], high[b], high[middle], high[a], half[a]]
        parts.append(np.column_stack(nodes[:: 1 if local.shape[1] == 3 else 2]))
    return np.concatenate(parts)


def _upright(layers: _Layers, column: int, cell_type: str) -> Mesh:
    full, half = layers.full[:, column], layers.half[:, column]
    columns = [full[:-1], half, full[1:]] if cell_type == "SEG3" else [full[:-1], full[1:]]
    return Mesh.of(layers.nodes, cell_type, np.column_stack(columns))


_VOLUMES = {"TRI3": "PRI6", "QUA4": "CUB8", "TRI6": "PR15", "QUA8": "CU20"}


def _volume_block(layers: _Layers, block: CellBlock, cuts: Subdivision) -> CellBlock:
    cell_type = _VOLUMES.get(block.cell_type)
    if cell_type is None:
        raise MeshError("kernel.mesh.no-volume-swept-cells", cell_type=block.cell_type)
    local = layers.local(block.connectivity)
    corners = local[:, list(block.kind.corners)]
    parts = []
    for k in range(cuts.count):
        between = [layers.half[k][corners]] if block.kind.degree == 2 else []
        parts.append(np.hstack([layers.full[k][local], *between, layers.full[k + 1][local]]))
    return CellBlock.make(
        block.nodes, cell_type, np.concatenate(parts), np.tile(block.colours, cuts.count)
    )


_CONES = {"POI1": "SEG2", "SEG2": "TRI3", "TRI3": "TET4", "QUA4": "PYR5"}


def stitch(first: Mesh, second: Mesh, colour: int = 0) -> Mesh:
    """Triangles between two lines described in the same sense, whatever their numbers of cells.

    SEG3 give TRI6. At each step the line goes on whose new triangle has the shorter new side.
    The sides go round: the first line, across, the second line back, across.
    """
    nodes = first.nodes
    a, b = (line_chain(linear(m)) for m in (first, second))
    table = _zip(nodes.coordinates[a], nodes.coordinates[b])
    ids = np.concatenate([a, b])[table]
    ids = ids[(ids != np.roll(ids, 1, axis=1)).all(axis=1)]  # the lines may share their ends
    if not len(ids):
        raise MeshError("kernel.mesh.two-lines-same-nothing")
    return _sewn(Mesh.of(nodes, "TRI3", ids, colour), (first, reversed_line(second)))


def _sewn(made: Mesh, lines: tuple[Mesh, ...], apex: int | None = None) -> Mesh:
    """A seam of TRI3, or of TRI6 along SEG3, with the lines and what leads across as its sides."""
    ends = [line_chain(line)[[0, -1]] for line in lines] + [[apex, apex]] * (apex is not None)
    across = [[ends[k][1], ends[k + 1 - len(ends)][0]] for k in range(len(ends))]
    closed = any(a == b for a, b in across)
    links = Mesh.of(made.nodes, "SEG2", np.array(across), made.blocks[0].colours[0])
    if lines[0].single_block().cell_type == "SEG3":
        links = quadratic(links)
        made = quadratic(made, union(*lines, *[links] * (not closed), as_given=True))
    if closed:
        return made
    ways = [take(links, lambda _, k=k: np.arange(len(across)) == k) for k in range(len(across))]
    sides = [side for pair in zip([*lines, None], ways, strict=False) for side in pair if side]
    return Mesh(made.nodes, made.blocks, tuple(sides))


def _zip(a: FloatArray, b: FloatArray) -> IntArray:
    """Triangles (t, 3) on points numbered along a, then along b."""
    i = j = 0
    n, m = len(a), len(b)
    rows = []
    while i < n - 1 or j < m - 1:
        along_a = np.linalg.norm(a[i + 1] - b[j]) if i < n - 1 else np.inf
        along_b = np.linalg.norm(a[i] - b[j + 1]) if j < m - 1 else np.inf
        if along_a <= along_b:
            rows.append((i, i + 1, n + j))
            i += 1
        else:
            rows.append((i, n + j + 1, n + j))
            j += 1
    return np.array(rows, dtype=np.int64)


def _follows(cells: IntArray) -> bool:
    return bool((cells[1:, 0] == cells[:-1, -1]).all())


def cone(mesh: Mesh, apex: int) -> Mesh:
    """Cells of `mesh` joined to a node: POI1 to SEG2, SEG2 to TRI3, TRI3 to TET4, QUA4 to PYR5.

    SEG3 give TRI6, whose new sides are straight. Cells that hold the node are left out. A line's
    triangles keep it and the two ways to the node as their sides.

    Raises
    ------
    MeshError
        For other types of cells, or when nothing is left.
    """
    away = take(mesh, lambda b: ~(b.connectivity == apex).any(axis=1))
    if away.dimension == 1 and len(away.blocks) == 1 and _follows(away.blocks[0].connectivity):
        flat = linear(away).single_block()
        table = np.column_stack([flat.connectivity, np.full(len(flat), apex)])
        made = Mesh.of(mesh.nodes, "TRI3", table, flat.colours)
        return _sewn(made, (mesh if len(flat) == mesh.n_cells else away,), apex)
    parts = []
    for block in away.blocks:
        if block.cell_type == "SEG3":
            line = Mesh(mesh.nodes, (block,))
            parts.append(quadratic(cone(linear(line), apex), line))
            continue
        name = _CONES.get(block.cell_type)
        if name is None:
            raise MeshError("kernel.mesh.cells-type-cannot-joined", cell_type=block.cell_type)
        tip = np.full((len(block), 1), apex)
        table = np.hstack([block.connectivity, tip])
        parts.append(Mesh.of(mesh.nodes, name, table, block.colours))
    if not parts:
        raise MeshError("kernel.mesh.no-cell-mesh-away")
    return union(*parts, as_given=True)
