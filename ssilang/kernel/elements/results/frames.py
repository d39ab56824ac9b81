"""Local frames at the points of a field in cells, and tensors seen in them."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.catalog import ELEMENTS, support_rule
from ssilang.kernel.elements.results.tensors import as_components, tensor
from ssilang.kernel.elements.shapes.reference import shape_functions
from ssilang.kernel.elements.shells.mindlin import quadrangle_frames
from ssilang.kernel.elements.shells.plate import plate_frames
from ssilang.kernel.elements.solids.solid import kinematics
from ssilang.kernel.elements.solids.solid_moduli import material_axes
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Zone


def unit(v: FloatArray) -> FloatArray:
    """Vectors (..., d) of length one.

    Raises
    ------
    FieldError
        If one is zero.
    """
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    if (size <= 0).any():
        raise FieldError("kernel.elements.vector-radius-frame-zero")
    found: FloatArray = v / size
    return found


def fixed_frame(first: FloatArray, second: FloatArray | None) -> FloatArray:
    """Frame (3, 3), rows: along `first`, in the plane of both, normal to them.

    Without `second` the third axis is that of z.
    """
    x = unit(first)
    z = unit(np.array([0.0, 0.0, 1.0]) if second is None else np.cross(x, second))
    return np.stack([x, np.cross(z, x), z])


def points_of(zone: Zone, support: Support) -> FloatArray:
    """Coordinates (n_cells, n_points, 3) of the points of a support."""
    kind = ELEMENTS[zone.element]
    rule = support_rule(zone.element, support)
    shapes = shape_functions(kind.reference or kind.cell_type, rule.points)
    found: FloatArray = np.einsum("pk,ckd->cpd", shapes, zone.cells.coordinates)
    return found


def polar_frames(x: FloatArray, centre: FloatArray) -> FloatArray:
    """Frames (..., 3, 3), rows: radius in the plane, its quarter turn, z."""
    radius = (x - centre) * [1.0, 1.0, 0.0]
    r = unit(radius)
    z = np.broadcast_to(np.array([0.0, 0.0, 1.0]), r.shape)
    return np.stack([r, np.cross(z, r), z], axis=-2)


def cylindrical_frames(x: FloatArray, centre: FloatArray, on_axis: FloatArray) -> FloatArray:
    """Frames (..., 3, 3), rows: radius, circumference, axis."""
    z = unit(on_axis - centre)
    out = x - centre
    r = unit(out - (out @ z)[..., None] * z)
    along = np.broadcast_to(z, r.shape)
    return np.stack([r, np.cross(along, r), along], axis=-2)


def spherical_frames(x: FloatArray, centre: FloatArray, on_axis: FloatArray) -> FloatArray:
    """Frames (..., 3, 3), rows: radius, meridian southwards, parallel eastwards."""
    r = unit(x - centre)
    east = unit(np.cross(unit(on_axis - centre), r))
    return np.stack([r, np.cross(east, r), east], axis=-2)


def torus_frames(
    x: FloatArray, centre: FloatArray, on_axis: FloatArray, on_circle: FloatArray
) -> FloatArray:
    """Frames (..., 3, 3), rows: along the large circle, along the small one, out of the torus.

    The small circles have their centres at the distance of `on_circle` from the axis, and at its
    height along it.
    """
    large = cylindrical_frames(x, centre, on_axis)
    axis = unit(on_axis - centre)
    height = (on_circle - centre) @ axis
    radius = np.linalg.norm(on_circle - centre - height * axis)
    middle = centre + height * axis + radius * large[..., 0, :]
    outward = unit(x - middle)
    around = large[..., 1, :]
    return np.stack([around, np.cross(outward, around), outward], axis=-2)


def given_rotations(
    zone: Zone, rotations: CellField, support: Support, transposed: bool
) -> FloatArray:
    """Matrices (n_cells, n_points, 3, 3) of a field of components UX,X UX,Y ... (or transposed).

    Out of the plane, where a flat zone has no components, they are those of the identity.
    """
    seen, names = zone_field(zone, rotations), kinematics(zone).gradient
    values = seen.matrix(names, support)
    d = round(len(names) ** 0.5)
    R = np.zeros((len(values), values.shape[-1], 3, 3))
    R[..., 2, 2] = 1.0
    R[..., :d, :d] = np.moveaxis(values.reshape(len(values), d, d, -1), -1, 1)
    return np.swapaxes(R, -1, -2) if transposed else R


SHELL_FRAMES = {"plate": plate_frames, "mindlin": quadrangle_frames}
"""Own frames of flat shells; their parameters V1X V1Y are cosines in them."""


def material_frames(zone: Zone, material: CellField, support: Support) -> FloatArray:
    """Axes of orthotropy (n_cells or 1, n_points or 1, 3, 3), global components."""
    parameters = zone_field(zone, material)
    own = SHELL_FRAMES.get(ELEMENTS[zone.element].family)
    if own is None:
        return material_axes(parameters, support)
    frames = own(zone)[0][:, None]
    c, s = (parameters.at(n, support)[..., None] for n in ("V1X", "V1Y"))
    first = c * frames[..., 0, :] + s * frames[..., 1, :]
    second = c * frames[..., 1, :] - s * frames[..., 0, :]
    third = np.broadcast_to(frames[..., 2, :], first.shape)
    return np.stack([first, second, third], axis=-2)


def seen_in(zone: Zone, field: CellField, frames: FloatArray) -> CellFieldBlock:
    """Stresses or strains of a continuous zone in frames (..., 3, 3), rows being the axes."""
    T, support, strains = tensor(zone, field)
    turned = frames @ T @ np.swapaxes(frames, -1, -2)
    table = kinematics(zone)
    names = table.strains if strains else table.stresses
    values = as_components(turned, len(names), strains)
    components = {n: np.ascontiguousarray(values[:, i]) for i, n in enumerate(names)}
    return CellFieldBlock(zone.cells, components, support, zone.element, zone.constituent)
