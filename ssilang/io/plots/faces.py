"""Faces of a layer given to the painter: plain, shaded, or coloured by bands."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ssilang.io.plots.bands import Levels, cut_bands, cut_lines
from ssilang.io.plots.cutting import nodal_means, section_of
from ssilang.io.plots.painter import CLEAR, Painter
from ssilang.io.plots.palette import shade
from ssilang.io.plots.patches import Faces, all_faces, pieces
from ssilang.io.plots.stage import Inks
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import Plane
from ssilang.kernel.base.arrays import FloatArray

if TYPE_CHECKING:
    from ssilang.io.plots.layers import Layer, PictureOptions

_PAPER = np.ones(3)
_DEFAULT_FILL = np.array([0.72, 0.76, 0.81])


def add_faces(
    painter: Painter, faces: list[Faces], layer: "Layer", options: "PictureOptions", size: float
) -> None:
    """Add the faces in their own colours.

    In the plane they are tinted lightly, in full with FACE; in space only their edges are seen
    unless hidden parts are taken away (white faces) or faces are filled (shaded).
    """
    positions = layer.positions()
    for f in faces:
        if f.kind == "POI1":
            continue
        points = _shrunk(positions[f.nodes], options.shrink)
        inks = _inks(f, layer)
        if f.kind.startswith("SEG"):
            painter.add(points, edge=inks, width=1.1 if layer.outline else 1.8, rank=2)
        elif layer.outline:
            painter.add(points, edge=inks, width=0.8, rank=2)
        else:
            fill, edge = _paint(f, inks, painter.view.solid, options)
            width = _edge_width(points, painter, size) if layer.edges else 0.0
            light = "shaded" if options.filled in ("FACE", "FACB") else ""
            painter.add(points, fill, edge, width, rank=1, light=light)


def add_points(painter: Painter, faces: list[Faces], layer: "Layer", levels: Levels | None) -> None:
    """Add cells of one node, as dots."""
    for f in faces:
        if f.kind != "POI1":
            continue
        inks = _inks(f, layer)
        if layer.field is not None and levels is not None:
            inks = levels.rgba(values_on(f, layer.field, layer.component)[:, 0])
        painter.add_dots(layer.positions()[f.nodes[:, 0]], inks, 4.25)


def _paint(f: Faces, inks: Inks, solid: bool, options: "PictureOptions") -> tuple[Any, Inks]:
    """Inks of faces and of their edges."""
    edge = inks.copy()
    if options.filled:
        plain = (f.colours == 0)[:, None] & (inks[:, :3].max(axis=1) < 0.2)[:, None]
        base = np.where(plain, _DEFAULT_FILL, 0.25 * _PAPER + 0.75 * inks[:, :3])
        fill = np.column_stack([base, np.ones(len(base))])
        edge[:, :3] = 0.45 * fill[:, :3] if options.filled == "FACE" else 1.0
        return fill, edge
    if solid:
        return ((1.0, 1.0, 1.0, 1.0) if options.hidden else CLEAR), edge
    return _mixed(inks, 0.10), edge


def _inks(f: Faces, layer: "Layer") -> Inks:
    from matplotlib.colors import to_rgba

    own = f.colours if layer.colour is None else np.full(len(f.nodes), layer.colour)
    table = {int(c): to_rgba(shade(int(c))) for c in np.unique(own)}
    return np.array([table[int(c)] for c in own], dtype=float).reshape(-1, 4)


def _mixed(inks: Inks, share: float) -> Inks:
    rgb = (1 - share) * _PAPER + share * inks[:, :3]
    return np.column_stack([rgb, np.ones(len(rgb))])


def _edge_width(points: FloatArray, painter: Painter, size: float) -> float:
    """Thin lines for fine meshes, none where they would fill the picture."""
    flat = painter.view.project(points)
    cell = float(np.median(np.ptp(flat, axis=1).max(axis=1))) / max(size, 1e-300)
    return float(np.clip(60 * cell, 0.15, 0.8))


def _shrunk(points: FloatArray, ratio: float | None) -> FloatArray:
    if ratio is None:
        return points
    centre = points.mean(axis=1, keepdims=True)
    return np.asarray(centre + ratio * (points - centre))


def band_values(prepared: "list[tuple[Layer, list[Faces]]]") -> FloatArray | None:
    """All nodal values of the coloured layers, None if no layer is coloured."""
    parts = [
        values_on(f, layer.field, layer.component).ravel()
        for layer, faces in prepared
        if layer.field is not None
        for f in faces
    ]
    if not parts and not any(layer.field is not None for layer, _ in prepared):
        return None
    return np.concatenate([*parts, np.empty(0)])


def add_bands(
    painter: Painter,
    faces: list[Faces],
    layer: "Layer",
    levels: Levels,
    options: "PictureOptions",
    size: float,
) -> None:
    """Add the faces coloured by a field; faces without a value are grey."""
    assert layer.field is not None
    positions = layer.positions()
    count = sum(len(f.nodes) for f in faces)
    for f in faces:
        if f.kind == "POI1":
            continue
        values = values_on(f, layer.field, layer.component)
        known = np.isfinite(values).all(axis=1)
        points = positions[f.nodes]
        painter.add(points[~known], (0.93, 0.94, 0.95, 1.0), (0.6, 0.6, 0.6, 1.0), 0.3)
        if not known.any():
            continue
        shape, parts = pieces(f.kind, _cuts(f.kind, count))
        where = np.einsum("pk,nkd->npd", shape, points[known])
        what = values[known] @ shape.T
        where = where[:, parts].reshape(-1, parts.shape[1], 3)
        what = what[:, parts].reshape(-1, parts.shape[1])
        if f.kind.startswith("SEG"):
            # a dark rim, so that pale values are seen
            painter.add(where, edge=(0.25, 0.27, 0.3, 1.0), width=4.3, rank=2)
            painter.add(where, edge=levels.rgba(what.mean(axis=1)), width=3.2, rank=3)
            continue
        _add_pieces(painter, where, what, levels, options.iso)
        if layer.edges:
            width = 0.55 * _edge_width(points, painter, size)
            painter.add(points[known], edge=(0.1, 0.1, 0.1, 0.55), width=width, rank=1)


def add_section(
    painter: Painter, layer: "Layer", plane: Plane, levels: Levels | None, options: "PictureOptions"
) -> None:
    """Add what a plane cuts of a layer, in its colours or coloured by its field."""
    from matplotlib.colors import to_rgb

    positions = layer.positions()
    values = None
    if layer.field is not None and levels is not None:
        every = all_faces(layer.mesh)
        values = nodal_means(every, layer.field, layer.component, len(positions))
    for dimension in (3, 2):
        points, found, colours = section_of(layer.mesh, plane, positions, values, dimension)
        if found is not None and levels is not None:
            known = np.isfinite(found).all(axis=1)
            if dimension == 3:
                _add_pieces(painter, points[known], found[known], levels, options.iso, "")
            else:
                inks = levels.rgba(found[known].mean(axis=1))
                painter.add(points[known], edge=inks, width=3.2, rank=3)
            continue
        base = np.array([to_rgb(shade(int(c))) for c in colours]).reshape(-1, 3)
        paint = _mixed(np.where((colours == 0)[:, None], _DEFAULT_FILL, base), 0.75)
        painter.add(points, paint, paint, 0.35 if dimension == 3 else 1.8)


def _add_pieces(
    painter: Painter,
    where: FloatArray,
    what: FloatArray,
    levels: Levels,
    iso: str,
    light: str = "tinted",
) -> None:
    if iso != "LIGNE":
        bands, _, row = cut_bands(where, what, levels.bounds)
        colours = levels.rgba((levels.bounds[:-1] + levels.bounds[1:]) / 2)[row]
        # in the plane a hairline closes the gaps that smoothing leaves between the bands
        seam = CLEAR if painter.view.solid else colours
        painter.add(bands, colours, seam, 0.35, light=light)
    elif painter.view.solid:
        painter.add(where, (1.0, 1.0, 1.0, 1.0))
    if iso != "SURFACE":
        lines, _, row = cut_lines(where, what, levels.bounds)
        ink = (0.0, 0.0, 0.0, 0.8) if iso == "SULI" else levels.rgba(levels.bounds)[row]
        painter.add(lines, edge=ink, width=1.0, rank=1)


def _cuts(kind: str, count: int) -> int:
    """Pieces along a side of a face, fewer where there are many faces."""
    if kind.startswith("SEG"):
        return 8
    if count > 8_000:
        return 1
    return 2 if kind in ("QUA4", "TRI3") else 4
