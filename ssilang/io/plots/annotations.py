"""What stands around and over a picture: arrows, numbers, names, frame, colour bar."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.plots.bands import Levels
from ssilang.io.plots.painter import Painter
from ssilang.io.plots.palette import shade
from ssilang.io.plots.patches import Faces
from ssilang.io.plots.stage import Photograph
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import View
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.deformed import ArrowPart, Arrows, round_down

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ssilang.io.plots.layers import Layer, PictureOptions

_HALO_WIDTH = 2.0
_MOST_LABELS = 2000


def arrow_ends(
    part: ArrowPart, size: float, positions: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Tails and steps in space, (n, 3) each, of the arrows long enough to be seen.

    Those that stand at nodes follow `positions` (all nodes of the table).
    """
    origins = part.origins
    if positions is not None and part.nodes is not None:
        origins = positions[part.nodes]
    length = np.linalg.norm(part.vectors, axis=1)
    seen = length > 0.03 * length.max(initial=0.0)
    scale = _arrow_scale(part, size)
    start, step = origins[seen], part.vectors[seen] * scale
    if not part.heads:
        return start - step / 2, step
    # a negative amplification: the arrow comes from outside and its tip is at the point
    return (start + step, -step) if scale < 0 else (start, step)


def add_arrows(painter: Painter, arrows: Arrows, size: float, positions: FloatArray | None) -> None:
    """Add arrows to what a panel shows."""
    from matplotlib.colors import to_rgba

    for part in arrows.parts:
        ink = to_rgba(shade(part.colour))
        painter.add_arrows(*arrow_ends(part, size, positions), ink, part.heads)


def _arrow_scale(part: ArrowPart, size: float) -> float:
    if part.scale is not None:
        return part.scale
    longest = float(np.linalg.norm(part.vectors, axis=1).max()) if len(part.vectors) else 0.0
    return round_down(0.12 * size / longest) if longest > 0 and size > 0 else 1.0


@dataclass
class Labels:
    """Numbers, values and names for one panel; those that the eye sees are written."""

    view: View
    asked: list[tuple[FloatArray, list[str], str, int]] = field(default_factory=list)

    def add(
        self, places: FloatArray, texts: list[str], colour: str = "#1b1f24", size: int = 7
    ) -> None:
        """Add texts at places (n, 3)."""
        self.asked.append((places, texts, colour, size))

    def write(self, axes: "Axes", photograph: Photograph | None, bounds: FloatArray) -> None:
        """Write what is seen on a photograph of the sheet `bounds`; all without one."""
        from matplotlib.patheffects import withStroke

        halo = [withStroke(linewidth=_HALO_WIDTH, foreground="white")]
        for places, texts, colour, size in self.asked:
            flat, seen = self.view.project(places), np.ones(len(places), dtype=bool)
            if photograph is not None:
                seen = photograph.shows(flat, self.view.depth(places), bounds)
            for row in np.flatnonzero(seen)[:_MOST_LABELS]:
                x, y = flat[row]
                axes.text(
                    x, y, texts[row], fontsize=size, color=colour, ha="center", va="center",
                    path_effects=halo, zorder=5, clip_on=True,
                )  # fmt: skip


def labels_of(
    view: View, prepared: "list[tuple[Layer, list[Faces]]]", options: "PictureOptions"
) -> Labels:
    """Node numbers, cell numbers, values and names, as asked for."""
    made = Labels(view)
    for layer, faces in prepared:
        positions = layer.positions()
        if options.node_numbers:
            ids = np.unique(np.concatenate([f.nodes.ravel() for f in faces] or [np.empty(0, int)]))
            made.add(positions[ids], [str(i + 1) for i in ids], "#14316b")
        if options.cell_numbers:
            for f in faces:
                made.add(positions[f.nodes].mean(axis=1), [str(i + 1) for i in f.cells], "#8b4a1b")
        if options.point_values and layer.field is not None:
            for f in faces:
                _add_values(made, layer, f, positions)
    for name, mesh in options.labels:
        ids = mesh.sorted_node_ids
        if len(ids):
            made.add(mesh.nodes.coordinates[ids].mean(axis=0)[None], [name], "#7a1fa2", 9)
    return made


def _add_values(made: Labels, layer: "Layer", f: Faces, positions: FloatArray) -> None:
    assert layer.field is not None
    values = values_on(f, layer.field, layer.component).ravel()
    ids, first = np.unique(f.nodes.ravel(), return_index=True)
    known = np.isfinite(values[first])
    made.add(positions[ids[known]], [f"{v:.4g}" for v in values[first][known]])


def frame(axes: "Axes", view: View, bounds: FloatArray, names: tuple[str, str]) -> None:
    """Limits, equal scales; coordinates along the sides in the plane, a triad in space.

    `names` stand at the two sides of the plane, if they say something.
    """
    axes.set_xlim(*bounds[:, 0])
    axes.set_ylim(*bounds[:, 1])
    axes.set_aspect("equal", adjustable="box")
    if view.solid:
        axes.set_axis_off()
        _triad(axes, view)
        return
    axes.tick_params(length=3, labelsize=8)
    axes.set_xlabel(names[0], fontsize=8)
    axes.set_ylabel(names[1], fontsize=8)
    for side in ("top", "right", "left", "bottom"):
        axes.spines[side].set_color("#c9ced4")


def _triad(axes: "Axes", view: View) -> None:
    """The directions x, y, z in the lower left corner."""
    corner = axes.inset_axes((0.0, 0.0, 0.13, 0.13))
    corner.set_axis_off()
    corner.set_aspect("equal")
    corner.set_xlim(-1.25, 1.25)
    corner.set_ylim(-1.25, 1.25)
    for name, tip in zip("xyz", view.project(np.eye(3)), strict=True):
        if np.linalg.norm(tip) < 0.05:
            continue
        style: Any = {"arrowstyle": "-|>", "color": "#4a4f57", "lw": 0.9, "shrinkA": 0}
        corner.annotate("", tip, (0.0, 0.0), arrowprops=style)
        x, y = tip * (1 + 0.25 / np.linalg.norm(tip))
        corner.text(x, y, name, fontsize=8, color="#4a4f57", ha="center", va="center")


Ends = dict[str, FloatArray]
"""Places (n, 3) of the least ('min') and the largest ('max') value."""


def mark_extremes(
    axes: "Axes", view: View, ends: Ends, photograph: Photograph | None, bounds: FloatArray
) -> None:
    """Mark where the extreme values are, if they are seen."""
    for name, marker in (("min", "v"), ("max", "^")):
        places = ends.get(name, np.empty((0, 3)))
        flat = view.project(places)
        if photograph is not None:
            flat = flat[photograph.shows(flat, view.depth(places), bounds)]
        if len(flat):
            axes.plot(
                *flat.T, linestyle="none", marker=marker, markersize=7, zorder=6,
                markerfacecolor="white", markeredgecolor="#1b1f24", markeredgewidth=1.0,
                clip_on=False, gid=name,
            )  # fmt: skip


def colour_bar(
    axes: "Axes",
    levels: Levels,
    name: str,
    extremes: tuple[float, float] | None,
    marked: bool,
) -> None:
    """The colour bar with the name of what is shown and its extremes, with their marks if any."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.ticker import FuncFormatter

    wide = axes.get_xlim()[1] - axes.get_xlim()[0] > 2.2 * (axes.get_ylim()[1] - axes.get_ylim()[0])
    bounds = levels.bounds
    every = max(1, -(-len(bounds) // (8 if wide else 12)))
    bar = axes.figure.colorbar(
        ScalarMappable(levels.norm, levels.colours), ax=axes,
        orientation="horizontal" if wide else "vertical", ticks=bounds[::every], fraction=0.06,
        pad=0.03 if not wide else 0.06, aspect=30 if wide else 26, shrink=0.9,
    )  # fmt: skip
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(labelsize=8, length=2.5)
    # each mark says its whole value: a common power of ten would stand inside the label below
    bar.formatter = FuncFormatter(lambda value, _: f"{value:.4g}")
    text = name
    if extremes is not None:
        low, high = ("\u25bd ", "\u25b3 ") if marked else ("", "")
        text += f"    {low}min {extremes[0] + 0.0:.4g}   {high}max {extremes[1] + 0.0:.4g}"
    bar.set_label(text, fontsize=9)
