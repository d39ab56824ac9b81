"""What a panel shows, gathered from its layers: drawn as paths in the plane, by VTK in space."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.plots.stage import Darts, Dots, Inks, Photograph, Polygons, Stage, Thing
from ssilang.io.plots.view import View
from ssilang.kernel.base.arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CLEAR = (0.0, 0.0, 0.0, 0.0)
_FINER = 2  # pixels of a photograph both ways in one of the picture: see `_halved`


@dataclass(frozen=True, eq=False)
class _Batch:
    """Polygons added together: corners (n, k, 3), inks (n, 4), and how they are drawn."""

    points: FloatArray
    face: Inks
    edge: Inks
    width: float
    rank: int
    light: str


@dataclass
class Painter:
    """Collects polygons (segments are polygons of two points), dots and arrows for one view."""

    view: View
    _batches: list[_Batch] = field(default_factory=list)
    _others: list[Thing] = field(default_factory=list)

    def add(
        self,
        points: FloatArray,
        face: Any = CLEAR,
        edge: Any = CLEAR,
        width: float = 0.0,
        rank: int = 0,
        light: str = "",
    ) -> None:
        """Add polygons (n, k, 3); colours are one for all or (n, 4).

        In the plane what is added later lies over what came before; in space what is nearer,
        and of lines in one place that of the higher `rank`. `light` is that of `Polygons`.
        """
        n = len(points)
        if n:
            inks = _rows(face, n), _rows(edge, n)
            self._batches.append(_Batch(points, *inks, width, rank, light))

    def add_dots(self, points: FloatArray, inks: Any, width: float) -> None:
        """Add dots (n, 3) of `width` points on the sheet."""
        if len(points):
            self._others.append(Dots(points, _rows(inks, len(points)), width))

    def add_arrows(self, start: FloatArray, step: FloatArray, ink: Any, heads: bool) -> None:
        """Add arrows from `start` along `step`, (n, 3) each, or strokes without heads."""
        if not len(start):
            return
        if heads or not self.view.solid:
            self._others.append(Darts(start, step, np.asarray(ink, dtype=float), heads))
        else:
            self.add(np.stack([start, start + step], axis=1), edge=ink, width=1.8, rank=3)

    def draw(self, axes: "Axes") -> None:
        """Draw what was added in the plane, in the order of adding."""
        if self._batches:
            _draw_paths(axes, self.view, self._batches)
        for thing in self._others:
            if isinstance(thing, Dots):
                x, y = self.view.project(thing.points).T
                axes.scatter(x, y, s=thing.width**2, c=thing.inks, zorder=3, linewidths=0)
            elif isinstance(thing, Darts):
                _draw_darts(axes, self.view, thing)

    def photograph(self, axes: "Axes", stage: Stage, bounds: FloatArray, deep: bool) -> Photograph:
        """Draw what was added in space: the sheet `bounds`, which fills the axes.

        `deep` asks for the depths of the photograph too.
        """
        place = axes.get_window_extent()
        rows, columns = (max(round(n), 1) for n in (place.height, place.width))
        things = [*self._others, *_gathered(x for b in self._batches for x in _things(b))]
        seen = stage.photograph(
            things, self.view.axes, bounds, (_FINER * columns, _FINER * rows),
            _FINER * axes.figure.dpi / 72.0, deep,
        )  # fmt: skip
        # each pixel is the mean of four
        wide = seen.image.astype(np.uint16)
        pairs = wide[0::2] + wide[1::2]
        _put_pixels(axes, ((pairs[:, 0::2] + pairs[:, 1::2] + 2) >> 2).astype(np.uint8), bounds)
        return seen


def _put_pixels(axes: "Axes", image: NDArray[np.uint8], bounds: FloatArray) -> None:
    """Show an image that has as many pixels as the axes: matplotlib need not make them anew."""
    from matplotlib.image import AxesImage

    class Pixels(AxesImage):
        def make_image(
            self, renderer: Any, magnification: float = 1.0, unsampled: bool = False
        ) -> Any:
            box, (rows, columns) = self.axes.bbox, image.shape[:2]
            sizes = round(box.height * magnification), round(box.width * magnification)
            if sizes != (rows, columns):  # of another resolution, in files of vectors
                return super().make_image(renderer, magnification, unsampled)
            opaque = np.full((rows, columns, 1), 255, dtype=np.uint8)
            lines = np.concatenate([image, opaque], axis=2)[::-1]
            return np.ascontiguousarray(lines), round(box.x0), round(box.y0), None

    (left, low), (right, high) = bounds
    shown = Pixels(axes, extent=(left, right, low, high), interpolation="nearest", zorder=1)
    shown.set_data(image)
    shown.set_clip_path(axes.patch)
    axes.add_image(shown)


def _things(batch: _Batch) -> Iterator[Polygons]:
    """Faces and edges of a batch, those that have an ink."""
    k = batch.points.shape[1]
    painted = batch.face[:, 3] > 0
    if k > 2 and painted.any():
        yield Polygons(*_flat(batch.points[painted], batch.face[painted]), light=batch.light)
    lined = (batch.edge[:, 3] > 0) & (batch.width > 0)
    if lined.any():
        points = batch.points[lined]
        ends = np.stack([points, np.roll(points, -1, axis=1)], axis=2)
        ends = ends[:, :1] if k == 2 else ends
        inks = np.repeat(batch.edge[lined], ends.shape[1], axis=0)
        yield Polygons(ends.reshape(-1, 2, 3), inks, batch.width, batch.rank)


def _gathered(things: Iterable[Polygons]) -> Iterator[Polygons]:
    """Those that are drawn alike put together: each costs VTK as much as a thousand polygons."""
    alike: dict[Any, list[Polygons]] = {}
    for x in things:
        alike.setdefault((x.points.shape[1], x.width, x.rank, x.light), []).append(x)
    for (_, *how), several in alike.items():
        points = np.concatenate([x.points for x in several])
        yield Polygons(points, np.concatenate([x.inks for x in several]), *how)


def _flat(polygons: FloatArray, inks: Inks) -> tuple[FloatArray, Inks]:
    """Polygons of more than four corners (n, k, 3) as triangles about their middles."""
    k = polygons.shape[1]
    if k <= 4:
        return polygons, inks
    middle = np.broadcast_to(polygons.mean(axis=1, keepdims=True), polygons.shape)
    parts = np.stack([middle, polygons, np.roll(polygons, -1, axis=1)], axis=2)
    inks = np.repeat(inks, k, axis=0)
    parts = parts.reshape(-1, 3, 3)
    real = (parts[:, 1] != parts[:, 2]).any(axis=1)  # corners of a band may coincide
    return parts[real], inks[real]


def _draw_paths(axes: "Axes", view: View, batches: list[_Batch]) -> None:
    """One path for all polygons of a batch that have the same ink: they do not overlap."""
    from matplotlib.collections import PathCollection

    paths, faces, edges, widths = [], [], [], []
    for b in batches:
        inks, group = np.unique(np.hstack([b.face, b.edge]), axis=0, return_inverse=True)
        corners = view.project(b.points)
        for i, ink in enumerate(inks):
            paths.append(_compound(corners[group.ravel() == i]))
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


def _draw_darts(axes: "Axes", view: View, darts: Darts) -> None:
    axes.quiver(
        *view.project(darts.start).T,
        *view.project(darts.step).T,
        angles="xy",
        scale_units="xy",
        scale=1.0,
        color=darts.ink,
        width=0.0035,
        headwidth=3.6 if darts.heads else 0,
        headlength=4.6 if darts.heads else 0,
        headaxislength=4.2 if darts.heads else 0,
        zorder=4,
    )


def _rows(colour: Any, n: int) -> Inks:
    return np.broadcast_to(np.asarray(colour, dtype=float), (n, 4))
