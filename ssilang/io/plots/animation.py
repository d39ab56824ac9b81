"""Successive deformed shapes as an animated GIF."""

import io
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ssilang.io.atomic import replacing
from ssilang.io.plots.composition import Subjects, compose, with_scales
from ssilang.io.plots.figure import figure_bytes
from ssilang.io.plots.layers import PictureOptions
from ssilang.io.plots.scene import draw_scene, sheet_bounds
from ssilang.io.plots.stage import Stage
from ssilang.io.plots.values import component_names
from ssilang.io.plots.view import View
from ssilang.kernel.fields.deformed import Deformed, DeformedPart
from ssilang.kernel.fields.node_field import NodeField

FRAME_MILLISECONDS = 120
_BANDS = 14


def animation_frames(
    deformed: Deformed, subjects: Subjects, view: View, options: PictureOptions, stage: Stage
) -> list[bytes]:
    """One PNG a deformed shape, all on the same sheet, amplification and iso-values.

    Parameters
    ----------
    deformed : Deformed
        Its parts are the successive shapes.
    subjects : Subjects
        What else the picture holds; its own deformed shape is left out.
    """
    parts = with_scales(deformed.parts)
    whole = compose(replace(subjects, deformed=Deformed(parts)))
    bounds = sheet_bounds(whole.layers, whole.arrows, view, options)
    common = replace(options, bounds=bounds, levels=_common_levels(parts, options))
    frames = []
    for part in parts:
        made = compose(replace(subjects, deformed=Deformed((part,))))
        figure = draw_scene(made.layers, (view,), common, made.arrows, made.components, stage)
        frames.append(figure_bytes(figure, "png"))
    return frames


def _common_levels(parts: Sequence[DeformedPart], options: PictureOptions) -> np.ndarray | None:
    """Iso-values over the range of the nodal fields that the shapes carry."""
    fields = [p.field for p in parts if isinstance(p.field, NodeField)]
    if options.levels is not None or not fields:
        return options.levels
    values = np.concatenate([f.components[component_names(f)[0]].values for f in fields])
    low, high = float(values.min()), float(values.max())
    count = options.level_count or _BANDS
    return np.linspace(low, high, count) if high > low else None


def save_animation(frames: Sequence[bytes], path: Path, and_back: bool) -> Path:
    """Write frames (PNG) as an animated GIF that runs for ever.

    Parameters
    ----------
    and_back : bool
        Play them forwards and then backwards.
    """
    from PIL import Image

    order = [*range(len(frames))]
    if and_back:
        order += order[-2:0:-1]
    images = [
        Image.open(io.BytesIO(f)).convert("P", palette=Image.Palette.ADAPTIVE) for f in frames
    ]
    played = [images[k] for k in order]
    buffer = io.BytesIO()
    played[0].save(
        buffer,
        "GIF",
        save_all=True,
        append_images=played[1:],
        duration=FRAME_MILLISECONDS,
        loop=0,
        disposal=2,
    )
    with replacing(path) as stream:
        stream.write(buffer.getvalue())
    return path
