"""Supports that hold nothing: their nodes lie on nodes of the body instead of being them.

A line made twice (once for the mesh, once more for its support) has nodes of its own at the same
places; conditions on these leave the body free, and the solution is wrong without an error.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.graph import parts_of
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.elements.solids.kinematics import harmonic
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.nodes import NodeTable

RINGS, MOVES = ("UR", "UT", "UZ"), {0: ("UZ",), 1: ("UR", "UT")}
"""Unknowns of revolution, and by the harmonic those that its axis has; beyond, it is at rest."""
NEAR = 1e-6
"""Distance below which two nodes are at the same place, as a part of the body's extent."""


@dataclass(frozen=True)
class DoubledSupports:
    """Held nodes without stiffness, and the nodes with stiffness at the same places."""

    held: IntArray  # (n,) nodes
    body: IntArray  # (n,) nodes, pairwise at the same place


def doubled_supports(matrix: Matrix, used: IntArray | None = None) -> DoubledSupports | None:
    """Nodes that conditions of one term hold, without stiffness, on nodes that have some.

    Parameters
    ----------
    used : array (n,) of node numbers, optional
        Nodes that something else than the stiffness needs (joints with a law).

    Returns
    -------
    DoubledSupports or None
        None if there are no such nodes. A node that a condition of several terms names too (a
        rigid base below unilateral relations) is meant, and left out.
    """
    if not matrix.blocks or not matrix.relations:
        return None
    stiff = np.zeros(len(matrix.table), dtype=bool)  # flags: no sorting of a body's nodes
    for block in matrix.blocks:
        stiff[block.nodes] = True
    terms = terms_of(matrix)
    loose = np.setdiff1d(terms.nodes[terms.alone], terms.nodes[~terms.alone])
    loose = loose[~stiff[loose]]
    if used is not None:
        loose = np.setdiff1d(loose, used)
    if not len(loose):
        return None
    above, below = lying_on(matrix.table, loose, np.flatnonzero(stiff))
    return DoubledSupports(above, below) if len(above) else None


def springs_apart(matrix: Matrix, used: IntArray) -> IntArray:
    """Nodes where springs to the ground stand beside the cells of a matrix, but for `used`."""
    alone, joined = np.zeros((2, len(matrix.table)), dtype=bool)
    for block in matrix.blocks:
        if block.unknowns[0][0] in "UR":  # not of modes
            (alone if block.nodes.shape[1] == 1 else joined)[block.nodes] = True
    cells = joined.any()
    for relations in matrix.relations:
        joined[relations.nodes] = True
    joined[used] = True
    return np.flatnonzero(alone & ~joined & cells)


def idle_nodes(blocks: Iterable[ElementMatrices], matrix: Matrix) -> IntArray:
    """First node (n,) of each block that acts on what conditions of one term hold alone.

    Parameters
    ----------
    matrix : Matrix
        That has the conditions.
    """
    terms = terms_of(matrix)
    held = terms.alone & (terms.sense == 0)
    at = {n: terms.nodes[held & (terms.names == n)] for n in np.unique(terms.names[held]).tolist()}
    found = []
    for block in blocks if at else ():
        acts = np.diagonal(block.values, axis1=1, axis2=2) != 0.0
        rows = zip(block.unknowns, block.nodes[:, block.local].T, acts.T, strict=True)
        if acts.any() and all(np.isin(n[a], at.get(u, n[:0])).all() for u, n, a in rows):
            found.append(block.nodes[0, 0])
    return np.array(found, np.int64)


def stops_held(matrix: Matrix) -> IntArray:
    """Nodes (n,) of one-sided conditions that others hold both ways, all of a BLOQ along a way."""
    terms, found = terms_of(matrix), [np.zeros(0, np.int64)]
    both = terms.alone & (terms.sense == 0)
    held = {*zip(terms.nodes[both].tolist(), terms.names[both].tolist(), strict=True)}
    for r in matrix.relations:
        first = r.row_start[:-1][(np.diff(r.row_start) == 1) & (r.sense != 0)].tolist()
        for name in {r.unknowns[k] for k in first}:
            nodes = [int(r.nodes[k]) for k in first if r.unknowns[k] == name]
            found += [np.array(nodes)] if {(n, name) for n in nodes} <= held else []
    return np.concatenate(found)


def clamped_alone(matrix: Matrix) -> IntArray:
    """The node (1,) of plates that is clamped, where no other is held and springs bear some."""
    terms, springs = terms_of(matrix), [b.nodes for b in matrix.blocks if b.raw_nodes.shape[1] == 1]
    zoned = [(b.nodes, b.zone) for b in matrix.blocks if b.zone and "RX" in b.unknowns]
    plates = [nodes for nodes, zone in zoned if zone.cells.kind.dimension == 2]
    if not plates or not springs:
        return terms.nodes[:0]
    own = np.unique(np.concatenate([n.ravel() for n in plates]))
    held: IntArray = terms.nodes[terms.alone & (terms.sense == 0) & np.isin(terms.nodes, own)]
    borne = int(np.isin(np.concatenate([n.ravel() for n in springs]), own).sum())
    return held[: int(len(held) > PLANE and (held == held[0]).all() and borne >= PLANE)]


def held_on_axis(matrix: Matrix) -> IntArray:
    """Nodes (n,) of most of the axis, held along what moves there, free along what is at rest."""
    cells = [b for b in matrix.blocks if b.zone and b.zone.mode is Mode.FOURIER]
    if not cells:
        return np.zeros(0, np.int64)
    assert cells[0].zone is not None
    own, terms = np.unique(np.concatenate([b.nodes.ravel() for b in cells])), terms_of(matrix)
    radii = np.abs(matrix.table.coordinates[own, 0])
    axis, moves = own[radii <= NEAR * radii.max()], MOVES.get(harmonic(cells[0].zone), ())
    held = {u: np.isin(axis, terms.nodes[terms.alone & (terms.names == u)]) for u in RINGS}
    along = np.any([axis < 0, *(held[u] for u in moves)], axis=0)
    across = np.all([axis >= 0, *(held[u] for u in RINGS if u not in moves)], axis=0)
    wrong: IntArray = axis[along & ~across]
    return wrong if len(wrong) > max(1, len(axis) // 2) else wrong[:0]


def held_nowhere(matrix: Matrix) -> set[str]:
    """Unknowns that conditions of one term hold, and no element, of a model, nor other one has."""
    terms = terms_of(matrix)
    known = {u for b in matrix.blocks for u in b.unknowns} | {*terms.names[~terms.alone].tolist()}
    modelled = matrix.blocks and all(b.zone for b in matrix.blocks)
    return {*terms.names[terms.alone].tolist()} - known if modelled else set()


def lying_on(table: NodeTable, nodes: IntArray, others: IntArray) -> tuple[IntArray, IntArray]:
    """The `nodes` at the place of one of `others`, and these (n,), pairwise."""
    if not len(nodes) or not len(others):
        return nodes[:0], others[:0]

    points = table.coordinates
    near = NEAR * float(np.ptp(points[others], axis=0).max())
    distance, nearest = spatial.KDTree(points[others]).query(points[nodes])
    at: IntArray = np.asarray(nearest)
    found = np.flatnonzero(np.asarray(distance) <= near)
    return nodes[found], others[at[found]]


@dataclass(frozen=True)
class Terms:
    """Terms of all conditions of a matrix (n,): node, unknown, whether it stands alone, sense."""

    nodes: IntArray
    names: NDArray[np.str_]
    alone: BoolArray
    sense: IntArray


def terms_of(matrix: Matrix) -> Terms:
    """The terms of a matrix' conditions, joined once."""
    kept = matrix.cache.get("terms")
    if isinstance(kept, Terms):
        return kept
    none = np.zeros(0, int)
    nodes, alone, sense, names = [none], [none], [none], list[str]()
    for r in matrix.relations:
        count = np.diff(r.row_start)
        nodes.append(r.nodes)
        names += r.unknowns
        alone.append(np.repeat(count == 1, count))
        sense.append(np.repeat(r.sense, count))
    every = np.concatenate(nodes), np.array(names, np.str_)
    made = Terms(*every, np.concatenate(alone) > 0, np.concatenate(sense))
    matrix.cache["terms"] = made
    return made


PLANE = 3
"""Conditions, or nodes, that a plate in space wants at least to be clamped, or borne."""
SAME = 1e-9
"""Difference of the sums of two cells' matrices that is none."""
_POINTS = ("IMPEDANCE", "MODAL", "STATIQUE")


def repeated_cells(matrix: Matrix) -> IntArray:
    """First node (n,) of cells on the nodes, with the element and values, of an earlier cell.

    Springs between points and masses at them are left out: two side by side are meant.
    """
    groups: dict[tuple[object, ...], list[ElementMatrices]] = {}
    for block in matrix.blocks:
        zone = block.zone
        if zone is not None and zone.element != "JOI1" and not {*_POINTS} & {*zone.behaviour}:
            groups.setdefault((zone.element, zone.behaviour, zone.constituent), []).append(block)
        elif _heavy_cells(block):
            groups.setdefault(block.unknowns, []).append(block)
    found = [_repeated(blocks) for blocks in groups.values()]
    found += [b.nodes[:, 0] for b in repeated_blocks(matrix) if not (b.zone or _heavy_cells(b))]
    return np.concatenate(found) if found else np.zeros(0, np.int64)


def _heavy_cells(block: ElementMatrices) -> bool:
    return block.zone is None and block.kind == "MASSE" and block.raw_nodes.shape[1] > 1


def repeated_blocks(matrix: Matrix) -> list[ElementMatrices]:
    """Blocks that are there a second time: a matrix joined with itself."""
    known: set[tuple[int, int]] = set()
    again = []
    for block in matrix.blocks:
        key = id(block.raw_nodes), id(block.values)
        again += [block] if key in known else []
        known.add(key)
    return again


def _repeated(blocks: list[ElementMatrices]) -> IntArray:
    keys = np.concatenate([face_keys(b.nodes) for b in blocks])
    order = np.argsort(keys, kind="stable")
    again = order[1:][keys[order][1:] == keys[order][:-1]]
    if not len(again):
        return np.zeros(0, np.int64)
    before = order[:-1][keys[order][1:] == keys[order][:-1]]
    # sums of diagonals that tell the unknowns apart, whatever the order of a cell's nodes
    weights = [1.0 + np.array([b.unknowns.index(n) for n in b.unknowns]) for b in blocks]
    diagonals = [np.diagonal(b.values, axis1=1, axis2=2) for b in blocks]
    sums = np.concatenate([d @ w for d, w in zip(diagonals, weights, strict=True)])
    same = np.abs(sums[again] - sums[before]) < SAME * np.abs(sums[again])
    firsts: IntArray = np.concatenate([b.nodes[:, 0] for b in blocks])[again[same]]
    return firsts


def face_keys(nodes: IntArray) -> IntArray:
    """A number for each cell or face, the same for the same nodes in any order."""
    odd = np.random.default_rng(0).integers(1, 2**62, nodes.shape[1]) * 2 + 1
    return np.asarray(np.sort(nodes, axis=1) @ odd, dtype=np.int64)


def bodies_apart(matrix: Matrix, zones: Iterable[Zone] = ()) -> IntArray:
    """Nodes (n,) of bodies at the places of another body's, with nothing between the two.

    Bodies are cells that hang together by nodes, joints, conditions of several terms or matrices
    without cells. Points that stand for springs or modes are none.

    Parameters
    ----------
    zones : zones
        Joints and bodies that yield, whose law stands beside the matrix.
    """
    cells = [(matrix.table.resolve(z.cells.raw), not is_joint(z)) for z in zones]
    cells += [(b.nodes, b.zone is not None) for b in matrix.blocks]
    body = bodies_of_nodes(matrix, [n for n, _ in cells])
    solid = [n.ravel() for n, own in cells if own and n.shape[1] > 1]
    nodes = np.unique(np.concatenate([np.zeros(0, np.int64), *solid]))
    if len(np.unique(body[nodes])) < 2:
        return nodes[:0]
    found = _met(matrix.table.coordinates, nodes, body[nodes])
    return found if len(found) > 1 else found[:0]  # that meet in a single node are seldom one


def ends_apart(matrix: Matrix) -> IntArray:
    """Ends (n,) of lines at the place of another node of their body, which nothing joins there."""
    cells, lines, joined = _lines_of(matrix)
    if not lines:
        return joined[:0]
    counts = np.bincount(np.concatenate([b.nodes.ravel() for b in cells]))
    nodes = np.unique(np.concatenate([b.nodes.ravel() for b in lines]))
    points, found = matrix.table.coordinates, list[int]()
    loose = (counts[nodes] == 1) & ~np.isin(nodes, joined)
    body = bodies_of_nodes(matrix, [b.nodes for b in cells])[nodes]
    near = NEAR * float(np.ptp(points[nodes], axis=0).max())
    for place in _met(points, nodes, np.arange(len(nodes))).tolist() if loose.any() else ():
        here = np.linalg.norm(points[nodes] - points[place], axis=1) <= near
        if (here & loose).any() and len(np.unique(body[here])) == 1:
            found.append(int(nodes[(here & loose).argmax()]))
    return np.array(found, np.int64)


def feet_free(matrix: Matrix, joints: Iterable[Zone]) -> IntArray:
    """Feet (n,) of frames that nothing holds, as high as one that a support, spring or joint holds.

    A foot is a node that all its cells stand upon, beams alone.
    """
    cells, lines, joined = _lines_of(matrix)
    beams = [b for b in lines if b.zone and b.zone.element in ("POUT", "TIMO")]
    if not beams:
        return joined[:0]
    heights = matrix.table.coordinates[:, 1 + ("UZ" in beams[0].unknowns)]
    ends = np.concatenate([b.nodes[:, [0, -1]] for b in beams])
    low, high = np.take_along_axis(ends, heights[ends].argsort(axis=1), axis=1).T
    near = NEAR * float(np.ptp(heights[ends]))
    flat = low[heights[high] - heights[low] <= near]
    others = [b.nodes.ravel() for b in cells if b not in beams]
    feet = np.setdiff1d(low, np.concatenate([high, flat, *others]))
    own = [z.cells.connectivity.ravel() for z in joints]
    held = np.isin(feet, np.concatenate([joined, *own]))
    level = [np.abs(heights[feet[held]] - h).min(initial=np.inf) for h in heights[feet[~held]]]
    return np.asarray(feet[~held][np.array(level) <= near], np.int64)


def _lines_of(
    matrix: Matrix,
) -> tuple[list[ElementMatrices], list[ElementMatrices], IntArray]:
    """Cells, lines among them, and the nodes (n,) that springs, joints or conditions have."""
    cells = [b for b in matrix.blocks if b.zone and b.nodes.shape[1] > 1 and not is_joint(b.zone)]
    joined = [b.nodes.ravel() for b in matrix.blocks if b not in cells]
    joined += [np.zeros(0, np.int64), *(r.nodes for r in matrix.relations)]
    lines = [b for b in cells if b.zone and b.zone.cells.kind.dimension == 1]
    return cells, lines, np.concatenate(joined)


def beside_joints(matrix: Matrix, joints: Iterable[Zone]) -> IntArray:
    """Nodes (n,) in the plane of surface joints, on nodes of another body, that no joint has.

    None where they are fewer than a joint's side has: an edge of two bodies, no face.
    """
    faces = [z.cells.connectivity for z in joints if z.element != "JOI1"]
    others = [b for b in matrix.blocks if b.zone is None or not is_joint(b.zone)]
    solid = [b.nodes for b in others if b.zone is not None and b.nodes.shape[1] > 1]
    if not faces or not solid:
        return np.zeros(0, np.int64)
    points, joined = matrix.table.coordinates, np.unique(np.concatenate([x.ravel() for x in faces]))
    middle = points[joined].mean(axis=0)
    _, sizes, axes = np.linalg.svd(points[joined] - middle, full_matrices=False)
    flat = axes[sizes <= NEAR * sizes[0]]
    body = bodies_of_nodes(matrix, [b.nodes for b in others])
    nodes = np.setdiff1d(np.concatenate([x.ravel() for x in solid]), joined)
    off = np.abs((points[nodes] - middle) @ flat.T).max(axis=1, initial=0.0)
    nodes = nodes[(off <= NEAR * sizes[0]) & (len(flat) > 0)]
    found = _met(points, nodes, body[nodes]) if len(nodes) else nodes
    return found if len(found) >= min(x.shape[1] for x in faces) // 2 else nodes[:0]


def bodies_of_nodes(matrix: Matrix, tables: Iterable[IntArray]) -> IntArray:
    """The body (n,) of each node: cells (m, k) of the tables and conditions tie theirs together."""
    links = [np.stack([np.repeat(t[:, 0], t.shape[1] - 1), t[:, 1:].ravel()]) for t in tables]
    for relations in matrix.relations:
        firsts = relations.nodes[relations.row_start[:-1]]
        links.append(np.stack([np.repeat(firsts, np.diff(relations.row_start)), relations.nodes]))
    return parts_of(len(matrix.table), *links)


def _met(coordinates: FloatArray, nodes: IntArray, own: IntArray) -> IntArray:
    """Those of the nodes (n,), of the bodies `own`, at whose place one of another body is."""
    points = coordinates[nodes]
    near, found = NEAR * float(np.ptp(points, axis=0).max()), [nodes[:0]]
    for shift in (0.25, 0.75):  # a search tree's library would cost every start of a motion 0.2 s
        grid = np.floor(points / near + shift)
        _, first, cell = np.unique(grid, axis=0, return_index=True, return_inverse=True)
        ends = np.full((2, len(first)), own[first])
        np.minimum.at(ends[0], cell.ravel(), own)
        np.maximum.at(ends[1], cell.ravel(), own)
        found.append(nodes[first[ends[0] < ends[1]]])
    return np.unique(np.concatenate(found))
