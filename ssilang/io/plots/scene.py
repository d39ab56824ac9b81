"""Pictures of meshes, fields, deformed shapes and arrows (TRAC).

A picture is a list of layers seen from one or several eyes; each layer is a mesh, moved or not,
coloured by its own colours or by a field.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.io.plots import annotations as notes
from ssilang.io.plots.annotations import Ends
from ssilang.io.plots.bands import Levels, choose_levels
from ssilang.io.plots.cutting import behind
from ssilang.io.plots.faces import (
    add_bands,
    add_faces,
    add_points,
    add_section,
    band_values,
)
from ssilang.io.plots.figure import drawing, head
from ssilang.io.plots.labels import draw_categories, draw_tags
from ssilang.io.plots.layers import Layer, PictureOptions
from ssilang.io.plots.markup import to_mathtext
from ssilang.io.plots.painter import Painter
from ssilang.io.plots.patches import Faces, visible_faces
from ssilang.io.plots.stage import Stage
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import View, plane_view
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.deformed import Arrows

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def draw_scene(
    layers: Sequence[Layer],
    views: Sequence[View] = (),
    options: PictureOptions | None = None,
    arrows: Arrows | None = None,
    components: Sequence[str] = (),
    stage: Stage | None = None,
) -> "Figure":
    """A figure with one panel a view, or a component of the coloured layer.

    Parameters
    ----------
    stage : Stage, optional
        Draws what stands in space; one for several pictures spares its opening.

    Raises
    ------
    OutputError
        If there is nothing to draw.
    """
    options = options or PictureOptions()
    views = views or (plane_view(),)
    panels = [(v, c) for v in views for c in (components or ("",))]
    if not any(layer.mesh.n_cells for layer in layers) and arrows is None:
        raise OutputError("io.nothing-draw-mesh-empty")
    box = [sheet_bounds(layers, arrows, view, options) for view, _ in panels]
    width, height, rows, columns = _sheet(box[0], len(panels))
    stage = stage or Stage()
    with drawing(width, height) as figure:
        grid = figure.subplots(rows, columns, squeeze=False).ravel()
        for axes in grid[len(panels) :]:
            axes.set_axis_off()
        drawn = []
        for axes, (view, component), bounds in zip(grid, panels, box, strict=False):
            shown = [
                replace(layer, component=component) if component and layer.field else layer
                for layer in layers
            ]
            drawn.append(_Panel(axes, view, bounds, _prepared(shown, view, options), options))
            drawn[-1].begin()
            if component and len(panels) > 1:
                axes.set_title(component, fontsize=10.5)
        head(figure, options.title)
        foot = list(options.notes)
        if options.date:
            foot.append(datetime.now().strftime("%Y-%m-%d %H:%M"))
        if foot:
            figure.supxlabel("   ".join(foot), fontsize=8, color="#5b616a")
        if options.annotation is not None:
            draw_categories(figure, options.annotation)
        if any(view.solid for view in views):
            # photographs are taken pixel by pixel, so that places must be known
            figure.draw_without_rendering()
            figure.set_layout_engine(None)
        for panel in drawn:
            panel.finish(arrows, stage)
    return figure


def sheet_bounds(
    layers: Sequence[Layer], arrows: Arrows | None, view: View, options: PictureOptions
) -> FloatArray:
    """Lower and upper corner of what is shown on the sheet, shape (2, 2), with a margin."""
    if options.bounds is not None:
        return options.bounds
    if options.frame is not None:
        ids = options.frame.sorted_node_ids
        clouds = [view.project(options.frame.nodes.coordinates[ids])]
    else:
        clouds = [view.project(x.positions()[x.mesh.sorted_node_ids]) for x in layers]
        clouds += [view.project(part.origins) for part in (arrows.parts if arrows else ())]
        low, high = _corners(clouds)
        clouds += _arrow_clouds(layers, arrows, view, float(np.linalg.norm(high - low)))
    low, high = _corners(clouds)
    margin = 0.05 * max(float((high - low).max()), 1e-9)
    return np.stack([low - margin, high + margin])


def _corners(clouds: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    points = np.concatenate([c for c in clouds if len(c)] or [np.zeros((1, 2))])
    known = points[np.isfinite(points).all(axis=1)]
    if not len(known):
        known = np.zeros((1, 2))
    return known.min(axis=0), known.max(axis=0)


def _arrow_clouds(
    layers: Sequence[Layer], arrows: Arrows | None, view: View, size: float
) -> list[FloatArray]:
    """Tails and tips of all arrows."""
    sets: list[tuple[Arrows, FloatArray | None]] = [
        (x.arrows, x.positions()) for x in layers if x.arrows is not None
    ]
    if arrows is not None:
        sets.append((arrows, None))
    clouds = []
    for each, positions in sets:
        for part in each.parts:
            start, step = notes.arrow_ends(part, size, positions)
            clouds += [view.project(start), view.project(start + step)]
    return clouds


def _sheet(bounds: FloatArray, panels: int) -> tuple[float, float, int, int]:
    """Width and height in inches, rows and columns of panels."""
    extent = bounds[1] - bounds[0]
    columns = 1 if panels == 1 or (extent[0] > 2.5 * extent[1] and panels < 4) else 2
    rows = -(-panels // columns)
    width = 7.6 if columns == 1 else 5.0 * columns
    one = (width / columns - 1.2) * extent[1] / max(extent[0], 1e-300)
    return width, float(np.clip(one + 1.1, 2.4, 6.6 if rows == 1 else 4.6)) * rows, rows, columns


@dataclass(frozen=True, eq=False)
class _Panel:
    """One drawing of a picture: its axes, its eye, its sheet (2, 2), its layers with faces."""

    axes: "Axes"
    view: View
    bounds: FloatArray
    prepared: list[tuple[Layer, list[Faces]]]
    options: PictureOptions

    @cached_property
    def levels(self) -> Levels | None:
        """Levels of what colours the panel, None where nothing does."""
        values = band_values(self.prepared)
        if values is None:
            return None
        return choose_levels(values, self.options.level_count, self.options.levels)

    def begin(self) -> None:
        """All that takes place beside the drawing itself."""
        notes.frame(self.axes, self.view, self.bounds, self.options.axes)
        if self.levels is not None and self.options.legend:
            name = to_mathtext(self._legend_name())
            marked = bool(self._marks())
            notes.colour_bar(self.axes, self.levels, name, _range(self.prepared), marked)

    def _legend_name(self) -> str:
        """What the colours show: the component, with its unit if that is certain."""
        if self.options.legend_name:
            return self.options.legend_name
        name = next(x.component for x, _ in self.prepared if x.field is not None)
        unit = self.options.unit_of(name) if self.options.unit_of else ""
        return f"{name} ({unit})" if unit else name

    def finish(self, arrows: Arrows | None, stage: Stage) -> None:
        """The drawing, and the texts over it that are seen."""
        size = float(np.linalg.norm(self.bounds[1] - self.bounds[0]))
        painter = Painter(self.view)
        _paint(painter, self.prepared, self.levels, self.options, size)
        if arrows is not None:
            notes.add_arrows(painter, arrows, size, None)
        labels = notes.labels_of(self.view, self.prepared, self.options)
        photograph = None
        if self.view.solid:
            hides = self.options.hidden or self.options.filled or self.levels is not None
            deep = bool(hides and (labels.asked or self._marks()))
            taken = painter.photograph(self.axes, stage, self.bounds, deep)
            photograph = taken if deep else None
        else:
            painter.draw(self.axes)
        labels.write(self.axes, photograph, self.bounds)
        notes.mark_extremes(self.axes, self.view, self._marks(), photograph, self.bounds)
        if self.options.annotation is not None:
            draw_tags(self.axes, self.view, self.options.annotation, size)

    def _marks(self) -> Ends:
        """Where the extremes are marked: not on a section, which shows other values."""
        shown = self.levels is not None and self.options.legend
        return _ends(self.prepared) if shown and self.options.section is None else {}


def _prepared(
    layers: list[Layer], view: View, options: PictureOptions
) -> list[tuple[Layer, list[Faces]]]:
    """What is shown of the layers, with the faces that are drawn."""
    if options.beyond is not None:
        layers = [
            replace(layer, mesh=behind(layer.mesh, options.beyond, view, layer.positions()))
            for layer in layers
        ]
    return [(layer, _faces(layer, options)) for layer in layers]


def _paint(
    painter: Painter,
    prepared: list[tuple[Layer, list[Faces]]],
    levels: Levels | None,
    options: PictureOptions,
    size: float,
) -> None:
    """Give the painter all layers with their dots and arrows."""
    for layer, faces in prepared:
        if options.section is not None and layer.mesh.dimension > 1 and not layer.outline:
            add_section(painter, layer, options.section, levels, options)
        elif layer.field is not None and levels is not None:
            add_bands(painter, faces, layer, levels, options, size)
        else:
            add_faces(painter, faces, layer, options, size)
        add_points(painter, faces, layer, levels)
        if layer.arrows is not None:
            notes.add_arrows(painter, layer.arrows, size, layer.positions())


def _faces(layer: Layer, options: PictureOptions) -> list[Faces]:
    faces = visible_faces(layer.mesh)
    if options.only_colour is None or layer.outline:
        return faces
    kept = []
    for f in faces:
        mine = f.colours == options.only_colour
        if mine.any():
            kept.append(replace(f, nodes=f.nodes[mine], cells=f.cells[mine]))
    return kept


def _range(prepared: list[tuple[Layer, list[Faces]]]) -> tuple[float, float] | None:
    values = band_values(prepared)
    known = values[np.isfinite(values)] if values is not None else np.empty(0)
    return (float(known.min()), float(known.max())) if len(known) else None


_MOST_ENDS = 3  # nodes that share an extreme value


def _ends(prepared: list[tuple[Layer, list[Faces]]]) -> Ends:
    """Places (n, 3) of the least and of the largest value; none if they are at many nodes."""
    places, values = [np.empty((0, 3))], [np.empty(0)]
    for layer, faces in prepared:
        for f in faces if layer.field is not None else ():
            assert layer.field is not None
            found = values_on(f, layer.field, layer.component)
            known = np.isfinite(found)
            places.append(layer.positions()[f.nodes[known]])
            values.append(found[known])
    where, what = np.concatenate(places), np.concatenate(values)
    if not len(what) or np.ptp(what) <= 1e-12 * np.abs(what).max():
        return {}
    slack = 1e-6 * float(np.ptp(what))
    ends = {
        "min": np.unique(where[what <= what.min() + slack], axis=0),
        "max": np.unique(where[what >= what.max() - slack], axis=0),
    }
    return {name: points for name, points in ends.items() if len(points) <= _MOST_ENDS}
