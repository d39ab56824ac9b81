"""Simplices made better by local changes, towards a metric (Coupez, REEF 9(4), 2000).

One change does all: the cells around a node or an edge are taken out, and their hollow is filled
anew from one of its corners or from a new point. It stands if no cell is turned over, the measure
stays and the worst cells get better. That swaps, splits and takes away edges, in the plane as in
space. Outer faces that may change have a cell of no measure behind them, with the node OUTSIDE.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from itertools import combinations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.mesh.queries.quality import quality_in_metric

OUTSIDE = -1
_FLAT, _SAME = 1e-11, 1e-2
_NO_CELL = 1 << 30

Cell = tuple[int, ...]


def _faces(cell: Cell) -> Iterator[Cell]:
    """Faces of a cell, each turned so that a node of the cell before it gives the cell again."""
    for i in range(len(cell)):
        rest = cell[:i] + cell[i + 1 :]
        yield rest if i % 2 == 0 else (rest[1], rest[0], *rest[2:])


class Remeshing:
    """Cells on their way to the best that local changes give.

    Parameters
    ----------
    points : array (n, d)
    cells : array (n_cells, d + 1)
        Simplices of positive measure.
    metric : array (n, d, d) or None
        Edges e are wanted with e M e = 1; None: the shape alone counts.
    fixed : array (n_faces, d)
        Outer faces that stay.
    adding : bool
        False: no new points.
    """

    def __init__(
        self,
        points: FloatArray,
        cells: IntArray,
        metric: FloatArray | None,
        fixed: IntArray,
        adding: bool,
    ) -> None:
        self._points, self._metric = points, metric
        self.count, self.adding = len(points), adding
        self.cells: list[Cell | None] = []
        self.around: dict[int, set[int]] = defaultdict(set)
        kept = {frozenset(f) for f in fixed.tolist()}
        self._add(tuple(c) for c in cells.tolist())
        outer = self._hollow(range(len(cells)))
        self._add((OUTSIDE, f[1], f[0], *f[2:]) for f in outer if frozenset(f) not in kept)

    def found(self) -> tuple[FloatArray, FloatArray | None, IntArray]:
        """Points, their metric and the cells (n_cells, d + 1)."""
        metric = None if self._metric is None else self._metric[: self.count]
        cells = np.array([c for c in self.cells if c and OUTSIDE not in c])
        return self._points[: self.count], metric, cells

    def improve(self, passes: int) -> None:
        """Change cells until no change is one for the better, or `passes` are done."""
        touched = set(self.around) - {OUTSIDE}
        for _ in range(passes):
            again: set[int] = set()
            for size in (2, 1):
                for part in self._parts(touched, size):
                    again |= self._refilled(part)
            if not again:
                return
            touched = again - {OUTSIDE}

    def _parts(self, nodes: set[int], size: int) -> list[Cell]:
        """Nodes or edges of the cells around some nodes."""
        near = {k for n in nodes for k in self.around[n]}
        cells = [c for k in near if (c := self.cells[k])]
        found = {p for c in cells for p in combinations(sorted(set(c) - {OUTSIDE}), size)}
        return sorted(p for p in found if nodes.intersection(p))

    def _add(self, cells: Iterable[Cell]) -> None:
        for cell in cells:
            for node in cell:
                self.around[node].add(len(self.cells))
            self.cells.append(cell)

    def _hollow(self, taken: Iterable[int]) -> list[Cell]:
        """Faces that one alone of the cells has."""
        faces = [f for k in taken for f in _faces(self.cells[k] or ())]
        times = Counter(map(frozenset, faces))
        return [f for f in faces if times[frozenset(f)] == 1]

    def _refilled(self, part: Cell) -> set[int]:
        """Fill the hollow around a part better, and give its nodes; none if it is as good."""
        taken = sorted(set.intersection(*(self.around[n] for n in part)))
        old = [c for k in taken if (c := self.cells[k]) and OUTSIDE not in c]
        if not old:
            return set()
        faces = self._hollow(taken)
        corners = sorted({n for f in faces for n in f} - {OUTSIDE})
        volumes, levels = self._judged(np.array([old]))
        best, filling = sorted(levels[0].tolist()), None
        if self.adding:
            self._try_point(part if len(part) > 1 else corners)
            corners.append(self.count)
        stars = np.array([[(c, *f) for f in faces] for c in corners])
        real = np.array([[c not in f and OUTSIDE not in f for f in faces] for c in corners])
        stars[~real] = old[0]
        measures, levels = self._judged(stars)
        measures[~real], levels[~real] = 0.0, _NO_CELL
        whole = volumes.sum()
        fits = (np.where(real, measures, whole) > _FLAT * whole).all(axis=1)
        fits &= np.abs(measures.sum(axis=1) - whole) <= 1e-9 * whole
        for i in np.flatnonzero(fits):
            row = sorted(levels[i].tolist())
            length = max(len(row), len(best))
            row, best = (r + [_NO_CELL] * (length - len(r)) for r in (row, best))
            if row > best:
                best, filling = row, corners[i]
        if filling is None:
            return set()
        self.count += filling == self.count
        for k in taken:
            for node in self.cells[k] or ():
                self.around[node].discard(k)
            self.cells[k] = None
        self._add((filling, *f) for f in faces if filling not in f)
        return {n for f in faces for n in f} | {filling}

    def _try_point(self, near: Iterable[int]) -> None:
        """Write the middle of some points, and their mean metric, behind the last point."""
        rows = list(near)
        if self.count == len(self._points):
            self._points = np.concatenate([self._points, self._points])
            if self._metric is not None:
                self._metric = np.concatenate([self._metric, self._metric])
        self._points[self.count] = self._points[rows].mean(axis=0)
        if self._metric is not None:
            self._metric[self.count] = self._metric[rows].mean(axis=0)

    def _judged(self, cells: IntArray) -> tuple[FloatArray, IntArray]:
        """Measures (signed) and steps of quality of cells (..., d + 1)."""
        flat = cells.reshape(-1, cells.shape[-1])
        x = self._points[flat]
        metric = None if self._metric is None else self._metric[flat].mean(axis=1)
        quality = np.maximum(quality_in_metric(x, metric), 1e-300)
        steps = np.floor(np.log(quality) / np.log1p(_SAME)).astype(np.int64)
        measures = np.linalg.det(x[:, 1:] - x[:, :1])
        return measures.reshape(cells.shape[:-1]), steps.reshape(cells.shape[:-1])
