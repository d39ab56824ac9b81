"""Pictures of meshes, fields, deformed shapes and arrows (TRAC).

A picture is a list of layers seen from one or several eyes; each layer is a mesh, moved or not,
coloured by its own colours or by a field.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.io.plots import annotations as notes
from ssilang.io.plots.cutting import behind
from ssilang.io.plots.faces import add_bands, add_faces, add_section, band_values
from ssilang.io.plots.figure import drawing, head
from ssilang.io.plots.labels import draw_annotation
from ssilang.io.plots.layers import Layer, PictureOptions
from ssilang.io.plots.levels import Levels, choose_levels
from ssilang.io.plots.markup import to_mathtext
from ssilang.io.plots.painter import Painter
from ssilang.io.plots.palette import shade
from ssilang.io.plots.patches import Faces, visible_faces
from ssilang.io.plots.view import Plane, View, plane_view
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
) -> Figure:
    """A figure with one panel a view, or a component of the coloured layer.

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
    with drawing(width, height) as figure:
        grid = figure.subplots(rows, columns, squeeze=False).ravel()
        for axes in grid[len(panels) :]:
            axes.set_axis_off()
        for axes, (view, component), bounds in zip(grid, panels, box, strict=False):
            shown = [_with_component(layer, component) for layer in layers]
            _draw_panel(figure, axes, shown, view, options, arrows, bounds)
            if component and len(panels) > 1:
                axes.set_title(component, fontsize=10.5)
        _caption(figure, options)
    return figure


def _with_component(layer: Layer, component: str) -> Layer:
    return replace(layer, component=component) if component and layer.field else layer


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
            start, step = notes.arrow_ends(view, part, size, positions)
            clouds += [start, start + step]
    return clouds


def _sheet(bounds: FloatArray, panels: int) -> tuple[float, float, int, int]:
    """Width and height in inches, rows and columns of panels."""
    extent = bounds[1] - bounds[0]
    columns = 1 if panels == 1 or (extent[0] > 2.5 * extent[1] and panels < 4) else 2
    rows = -(-panels // columns)
    width = 7.6 if columns == 1 else 5.0 * columns
    one = (width / columns - 1.2) * extent[1] / max(extent[0], 1e-300)
    return width, float(np.clip(one + 1.1, 2.4, 6.6 if rows == 1 else 4.6)) * rows, rows, columns


def _draw_panel(
    figure: Figure,
    axes: Axes,
    layers: list[Layer],
    view: View,
    options: PictureOptions,
    arrows: Arrows | None,
    bounds: FloatArray,
) -> None:
    painter = Painter(view)
    if options.beyond is not None:
        layers = [_behind(layer, options.beyond, view) for layer in layers]
    prepared = [(layer, _faces(layer, options)) for layer in layers]
    levels = _levels(prepared, options)
    size = float(np.linalg.norm(bounds[1] - bounds[0]))
    for layer, faces in prepared:
        if options.section is not None and layer.mesh.dimension == 3 and not layer.outline:
            add_section(painter, layer, options.section, levels, options)
        elif layer.field is not None and levels is not None:
            add_bands(painter, faces, layer, levels, options, size)
        else:
            add_faces(painter, faces, layer, options, size)
    painter.draw(axes)
    for layer, faces in prepared:
        _draw_points(axes, view, layer, faces, levels, options)
        if layer.arrows is not None:
            notes.draw_arrows(axes, view, layer.arrows, size, layer.positions())
    if arrows is not None:
        notes.draw_arrows(axes, view, arrows, size, None)
    notes.write_numbers(axes, view, prepared, options)
    if options.annotation is not None:
        draw_annotation(axes, view, options.annotation, size)
    notes.frame(axes, view, bounds, options.axes)
    if levels is not None and options.legend:
        name = options.legend_name or next(x.component for x in layers if x.field is not None)
        notes.colour_bar(figure, axes, levels, to_mathtext(name), _range(prepared))


def _behind(layer: Layer, plane: Plane, view: View) -> Layer:
    return replace(layer, mesh=behind(layer.mesh, plane, view, layer.positions()))


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


def _levels(prepared: list[tuple[Layer, list[Faces]]], options: PictureOptions) -> Levels | None:
    values = band_values(prepared)
    if values is None:
        return None
    return choose_levels(values, options.level_count, options.levels)


def _range(prepared: list[tuple[Layer, list[Faces]]]) -> tuple[float, float] | None:
    values = band_values(prepared)
    known = values[np.isfinite(values)] if values is not None else np.empty(0)
    return (float(known.min()), float(known.max())) if len(known) else None


def _draw_points(
    axes: Axes,
    view: View,
    layer: Layer,
    faces: list[Faces],
    levels: Levels | None,
    options: PictureOptions,
) -> None:
    """Cells of one node, as dots."""
    from ssilang.io.plots.values import values_on

    for f in faces:
        if f.kind != "POI1":
            continue
        x, y = view.project(layer.positions()[f.nodes[:, 0]]).T
        colours: Any
        if layer.field is not None and levels is not None:
            colours = levels.rgba(values_on(f, layer.field, layer.component)[:, 0])
        else:
            own = f.colours if layer.colour is None else np.full(len(f.nodes), layer.colour)
            colours = [shade(int(c)) for c in own]
        axes.scatter(x, y, s=18, c=colours, zorder=3, linewidths=0)


def _caption(figure: Figure, options: PictureOptions) -> None:
    head(figure, options.title)
    foot = list(options.notes)
    if options.date:
        foot.append(datetime.now().strftime("%Y-%m-%d %H:%M"))
    if foot:
        figure.supxlabel("   ".join(foot), fontsize=8, color="#5b616a")
