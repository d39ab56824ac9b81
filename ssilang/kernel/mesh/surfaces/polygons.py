"""Triangles joined into convex polygons round some of their nodes."""

from __future__ import annotations

from collections import deque

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray

MOST_SIDES = 12
FLATTEST = 0.05
"""Least sine of the angle between two sides in a row."""


def join_triangles(points: FloatArray, triangles: IntArray, fixed: int) -> dict[int, IntArray]:
    """Polygons by number of sides, and the triangles that are left.

    Parameters
    ----------
    points : array (m, 2)
    triangles : array (t, 3)
        Anticlockwise.
    fixed : int
        The first points lie on the contour and stay.

    Returns
    -------
    dict of int to array (n, sides)
        Node numbers anticlockwise. The nodes in the middle of polygons are in none of them.

    Notes
    -----
    In a regular net of triangles every third node, taken in rings from the first one, is the
    middle of a hexagon and no triangle is left.
    """
    ring = _rings(triangles)
    taken = np.zeros(len(points), dtype=bool)  # in a polygon's middle, or beside one
    used: set[int] = set()
    found: dict[int, list[list[int]]] = {}
    for node in _in_rings(ring, fixed):
        around = ring[node]
        corners = _closed([pair for _, pair in around])
        if taken[node] or corners is None or not 4 < len(corners) <= MOST_SIDES:
            continue
        if any(t in used for t, _ in around) or not _convex(points[corners]):
            continue
        used.update(t for t, _ in around)
        taken[corners] = True
        found.setdefault(len(corners), []).append(corners)
    rest = [t for t in range(len(triangles)) if t not in used]
    tables = {n: np.array(rows, dtype=np.int64) for n, rows in sorted(found.items())}
    if rest:
        tables = {3: triangles[rest]} | tables
    return tables


def _rings(triangles: IntArray) -> dict[int, list[tuple[int, tuple[int, int]]]]:
    """For each node its triangles and the side of each that faces it."""
    ring: dict[int, list[tuple[int, tuple[int, int]]]] = {}
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for node, side in ((a, (b, c)), (b, (c, a)), (c, (a, b))):
            ring.setdefault(node, []).append((t, side))
    return ring


def _in_rings(ring: dict[int, list[tuple[int, tuple[int, int]]]], fixed: int) -> list[int]:
    """Inner nodes, each followed by those two sides away: the middles of a regular net first."""
    order: list[int] = []
    seen: set[int] = set()
    for start in sorted(n for n in ring if n >= fixed):
        queue = deque([start])
        while queue:
            node = queue.popleft()
            if node in seen or node < fixed:
                continue
            seen.add(node)
            order.append(node)
            near = {p for _, pair in ring[node] for p in pair}
            queue += sorted(_across(ring, node) - near)
    return order


def _across(ring: dict[int, list[tuple[int, tuple[int, int]]]], node: int) -> set[int]:
    """Nodes that face this one over a side of its ring: the middles of neighbouring hexagons."""
    facing = set()
    for t, (p, q) in ring[node]:
        for other, (a, b) in ring[p]:
            if other != t and q in (a, b):
                facing.add(a + b - q)
    return facing - {node}


def _closed(sides: list[tuple[int, int]]) -> list[int] | None:
    """Corners in order when the sides form one loop."""
    following = dict(sides)
    start = sides[0][0]
    corners = [start]
    while len(corners) <= len(sides):
        step = following.get(corners[-1])
        if step is None:
            return None
        if step == start:
            return corners if len(corners) == len(sides) else None
        corners.append(step)
    return None


def _convex(corners: FloatArray) -> bool:
    way = np.roll(corners, -1, axis=0) - corners
    way /= np.linalg.norm(way, axis=1)[:, None]
    before = np.roll(way, 1, axis=0)
    turn = before[:, 0] * way[:, 1] - before[:, 1] * way[:, 0]
    return bool(turn.min() > FLATTEST)
