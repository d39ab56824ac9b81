"""Polygons gathered from several layers and drawn from far to near."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.plots.view import View
from ssilang.kernel.base.arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Colours = NDArray[np.float64]  # (n, 4) red green blue opacity
CLEAR = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class _Batch:
    """Polygons added together: corners on the sheet (n, k, 2), depths (n,), inks (n, 4), width."""

    corners: FloatArray
    depth: FloatArray
    face: Colours
    edge: Colours
    width: float


@dataclass
class Painter:
    """Collects polygons (segments are polygons of two points) for one view."""

    view: View
    _batches: list[_Batch] = field(default_factory=list)

    def add(
        self,
        points: FloatArray,
        face: Any = CLEAR,
        edge: Any = CLEAR,
        width: float = 0.0,
        lift: float = 0.0,
        depth: FloatArray | None = None,
    ) -> None:
        """Add polygons (n, k, 3); colours are one for all or (n, 4).

        `lift` moves them nearer; `depth` (n,) replaces that of their middles (pieces of a face
        have the depth of the face, so that its edges are drawn over all of them).
        """
        n = len(points)
        if n == 0:
            return
        if depth is None:
            depth = self.view.depth(points).mean(axis=1)
        corners = self.view.project(points)
        self._batches.append(_Batch(corners, depth + lift, _rows(face, n), _rows(edge, n), width))

    def draw(self, axes: Axes) -> None:
        """Draw what was added: in space farthest first, in the plane in the order of adding."""
        if self._batches:
            draw = self._draw_sorted if self.view.solid else self._draw_together
            draw(axes)

    def _draw_sorted(self, axes: Axes) -> None:
        from matplotlib.collections import PolyCollection

        batches = self._batches
        order = np.argsort(np.concatenate([b.depth for b in batches]), kind="stable")
        corners = [polygon for b in batches for polygon in b.corners]
        widths = np.concatenate([np.full(len(b.corners), b.width) for b in batches])
        axes.add_collection(
            PolyCollection(
                [corners[i] for i in order],
                facecolors=np.concatenate([b.face for b in batches])[order],
                edgecolors=np.concatenate([b.edge for b in batches])[order],
                linewidths=widths[order],
                joinstyle="round",
                capstyle="round",
            ),
            autolim=False,
        )

    def _draw_together(self, axes: Axes) -> None:
        """One path for all polygons of a batch that have the same ink: they do not overlap."""
        from matplotlib.collections import PathCollection

        paths, faces, edges, widths = [], [], [], []
        for b in self._batches:
            inks, group = np.unique(np.hstack([b.face, b.edge]), axis=0, return_inverse=True)
            for i, ink in enumerate(inks):
                paths.append(_compound(b.corners[group.ravel() == i]))
                faces.append(ink[:4])
                edges.append(ink[4:])
                widths.append(b.width)
        axes.add_collection(
            PathCollection(
                paths,
                facecolors=faces,
                edgecolors=edges,
                linewidths=widths,
                joinstyle="round",
                capstyle="round",
            ),
            autolim=False,
        )


def _compound(polygons: FloatArray) -> Any:
    """One path of many polygons (n, k, 2); those of two points stay open."""
    from matplotlib.path import Path

    n, k, _ = polygons.shape
    codes = [Path.MOVETO] + [Path.LINETO] * (k - 1)
    if k > 2:
        polygons = np.concatenate([polygons, polygons[:, :1]], axis=1)
        codes = [*codes, Path.CLOSEPOLY]
    return Path(polygons.reshape(-1, 2), np.tile(np.array(codes, dtype=np.uint8), n))


def _rows(colour: Any, n: int) -> Colours:
    return np.broadcast_to(np.asarray(colour, dtype=float), (n, 4))
