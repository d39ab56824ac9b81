"""Forces and strains of flat shells seen in other axes of their surface.

The side of a shell that counts as upper stays the element's own: only the two axes in its surface
change.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.frames import SHELL_FRAMES, unit
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Zone


@dataclass(frozen=True, eq=False)
class SurfaceAxes:
    """What says the axes in a surface; vectors (..., 3), broadcast over cells and points.

    Attributes
    ----------
    first : the first axis is its projection
    toward : the second axis points to its side; where it is normal to the surface, `otherwise`
    normal : first x second points to its side (without it and `toward`: to the element's normal)
    """

    first: FloatArray
    toward: FloatArray | None = None
    otherwise: FloatArray | None = None
    normal: FloatArray | None = None


def is_flat_shell(zone: Zone) -> bool:
    """True for shells of flat cells."""
    return ELEMENTS[zone.element].family in SHELL_FRAMES


def shell_support(zone: Zone, field: CellField) -> Support:
    """Where a field of forces or strains stands."""
    return strains_or_stresses(zone, field)[2]


def shell_in_axes(zone: Zone, field: CellField, axes: SurfaceAxes) -> CellFieldBlock:
    """Forces or strains of a zone of flat shells in other axes."""
    names, values, support, strains = strains_or_stresses(zone, field)
    own = SHELL_FRAMES[ELEMENTS[zone.element].family](zone)[0][:, None]
    Q = _turn(own, axes)
    made = np.empty(np.broadcast_shapes(values.shape, (len(own), 1, Q.shape[1])))
    half = 0.5 if strains else 1.0
    for start in (0, 3):
        a, b, c = (values[:, start + i] for i in range(3))
        T = np.stack([np.stack([a, half * c], -1), np.stack([half * c, b], -1)], -2)
        seen = Q @ T @ np.swapaxes(Q, -1, -2)
        made[:, start], made[:, start + 1] = seen[..., 0, 0], seen[..., 1, 1]
        made[:, start + 2] = seen[..., 0, 1] / half
    if len(names) > 6:
        across = np.einsum("cpij,cjp->cip", Q, values[:, 6:8])
        made[:, 6:8] = across
    components = {n: np.ascontiguousarray(made[:, i]) for i, n in enumerate(names)}
    return CellFieldBlock(zone.cells, components, support, zone.element, zone.constituent)


def strains_or_stresses(
    zone: Zone, field: CellField
) -> tuple[tuple[str, ...], FloatArray, Support, bool]:
    """Names, values (n_cells, n_names, n_points) and points of what a field has of a zone.

    Last comes whether these are strains.
    """
    family = family_of(zone)
    seen = zone_field(zone, field)
    strains = any(n in seen for n in family.strain_names(zone))
    names = family.strain_names(zone) if strains else family.stress_names(zone)
    values, support = components_at_home(zone, field, names)
    return names, values, support, strains


def _turn(own: FloatArray, axes: SurfaceAxes) -> FloatArray:
    """Rows: the two axes by the element's own first two, (n_cells, n_points, 2, 2)."""
    inside = np.stack([np.sum(own[..., i, :] * axes.first, axis=-1) for i in (0, 1)], axis=-1)
    first = unit(inside)
    second = np.stack([-first[..., 1], first[..., 0]], axis=-1)
    if axes.normal is not None:
        sign = np.sign(np.sum(own[..., 2, :] * axes.normal, axis=-1))
    elif axes.toward is not None:
        otherwise = axes.toward if axes.otherwise is None else axes.otherwise
        along = np.sum(_global(own, second) * axes.toward, axis=-1)
        other = np.sum(_global(own, second) * otherwise, axis=-1)
        sign = np.sign(np.where(np.abs(along) > 1e-9 * np.linalg.norm(axes.toward), along, other))
    else:
        sign = np.ones(first.shape[:-1])
    return np.stack([first, sign[..., None] * second], axis=-2)


def _global(own: FloatArray, inside: FloatArray) -> FloatArray:
    """Vectors (n_cells, n_points, 3) of components along the first two own axes."""
    found: FloatArray = inside[..., :1] * own[..., 0, :] + inside[..., 1:] * own[..., 1, :]
    return found
