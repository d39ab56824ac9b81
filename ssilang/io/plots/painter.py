"""Polygons gathered from several layers and drawn from far to near."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.plots.view import View
from ssilang.kernel.mesh.nodes import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Colours = NDArray[np.float64]  # (n, 4) red green blue opacity
CLEAR = (0.0, 0.0, 0.0, 0.0)


@dataclass
class Painter:
    """Collects polygons (segments are polygons of two points) for one view."""

    view: View
    _outlines: list[FloatArray] = field(default_factory=list)
    _depths: list[FloatArray] = field(default_factory=list)
    _inks: list[tuple[Colours, Colours, FloatArray]] = field(default_factory=list)

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
        self._outlines.extend(self.view.project(points))
        if depth is None:
            depth = self.view.depth(points).mean(axis=1)
        self._depths.append(depth + lift)
        self._inks.append((_rows(face, n), _rows(edge, n), np.full(n, width)))

    def draw(self, axes: Axes) -> None:
        """Draw what was added, farthest first; in the plane, in the order of adding."""
        from matplotlib.collections import PolyCollection

        if not self._outlines:
            return
        depth = np.concatenate(self._depths)
        order = np.argsort(depth, kind="stable") if self.view.solid else np.arange(len(depth))
        face, edge, width = (
            np.concatenate(parts)[order] for parts in zip(*self._inks, strict=True)
        )
        axes.add_collection(
            PolyCollection(
                [self._outlines[i] for i in order],
                facecolors=face,
                edgecolors=edge,
                linewidths=width,
                joinstyle="round",
                capstyle="round",
            ),
            autolim=False,
        )


def _rows(colour: Any, n: int) -> Colours:
    return np.broadcast_to(np.asarray(colour, dtype=float), (n, 4))
