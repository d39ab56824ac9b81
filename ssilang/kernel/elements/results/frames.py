"""Local frames at the points of a field in cells, and tensors seen in them.

Forces and strains of flat shells seen in other axes of their surface.

The side of a shell that counts as upper stays the element's own: only the two axes in its surface
change.

Local axes among the parameters of beams, pipes and joints of two points, turned by a motion.

The axes of a beam or pipe turn by the mean of the rotations of its nodes: a rotation vector of any
size. What lies along the line needs none of this, since it follows the nodes themselves. Those of a
joint turn with the segment between its nodes: about it by the part along it of that mean, then the
shortest way to where the segment goes; where both nodes are at one place, by the mean.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.elements.catalog import (
    BEAMS,
    FLAT_SHELLS,
    THIN_SHELLS,
    family_name,
    support_shapes,
)
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.results import tensors
from ssilang.kernel.elements.shells.flat_shell import flat_frames
from ssilang.kernel.elements.shells.thick_shell import ThickShell
from ssilang.kernel.elements.solids.kinematics import as_components
from ssilang.kernel.elements.solids.solid import kinematics
from ssilang.kernel.elements.solids.solid_moduli import material_axes
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.mesh.mesh import Point


def unit(v: FloatArray) -> FloatArray:
    """Vectors (..., d) of length one; an error where one is zero."""
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    if (size <= 0).any():
        raise FieldError("kernel.elements.vector-radius-frame-zero")
    return v / size


def fixed_frame(first: FloatArray, second: FloatArray | None) -> FloatArray:
    """Frame (3, 3), rows: along `first`, in the plane of both, normal to them.

    Without `second` the third axis is that of z.
    """
    x = unit(first)
    z = unit(np.array([0.0, 0.0, 1.0]) if second is None else np.cross(x, second))
    return np.stack([x, np.cross(z, x), z])


def points_of(zone: Zone, support: Support) -> FloatArray:
    """Coordinates (n_cells, n_points, 3) of the points of a support."""
    shapes = support_shapes(zone.element, support)
    return np.einsum("pk,ckd->cpd", shapes, zone.cells.coordinates[:, : shapes.shape[1]])


def polar_frames(x: FloatArray, centre: FloatArray) -> FloatArray:
    """Frames (..., 3, 3), rows: radius in the plane, its quarter turn, z."""
    return cylindrical_frames(x, centre, centre + np.array([0.0, 0.0, 1.0]))


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


def is_thin_shell(zone: Zone) -> bool:
    """True for shells of section forces, whose axes of orthotropy are given in their own frames."""
    return family_name(zone) in THIN_SHELLS


def shell_frames(zone: Zone) -> FloatArray:
    """Own frames (n, 3, 3) of shells, rows being the axes; COQ2: along, around, normal."""
    if zone.element != "COQ2":
        return flat_frames(zone)[0]
    along = unit(np.diff(zone.cells.coordinates[:, :2], axis=1)[:, 0])
    around = np.broadcast_to([0.0, 0.0, 1.0], along.shape)
    return np.stack([along, around, np.cross(along, around)], axis=1)


def material_frames(zone: Zone, material: CellField, support: Support) -> FloatArray:
    """Axes of orthotropy (n_cells or 1, n_points or 1, 3, 3), global components."""
    parameters = zone_field(zone, material)
    if not is_thin_shell(zone):
        return material_axes(parameters, support)
    frames = shell_frames(zone)[:, None]
    c, s = (parameters.at(n, support)[..., None] for n in ("V1X", "V1Y"))
    first = c * frames[..., 0, :] + s * frames[..., 1, :]
    second = c * frames[..., 1, :] - s * frames[..., 0, :]
    third = np.broadcast_to(frames[..., 2, :], first.shape)
    return np.stack([first, second, third], axis=-2)


def seen_in(zone: Zone, field: CellField, frames: FloatArray) -> CellFieldBlock:
    """Stresses or strains of a continuous zone in frames (..., 3, 3), rows being the axes."""
    T, support, strains = tensors.tensor(zone, field)
    turned = frames @ T @ np.swapaxes(frames, -1, -2)
    names = tensors.names_seen(zone, field)[0]
    values = as_components(turned, len(names), strains)
    return cell_block(zone, names, values, support)


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
    return family_name(zone) in FLAT_SHELLS


def shell_in_axes(
    zone: Zone, field: CellField, axes: SurfaceAxes, material: CellField | None = None
) -> CellFieldBlock:
    """Forces or strains of a zone of flat shells, stresses of thick ones, in other axes.

    The own axes of thick ones depend on the thickness: `material` has it.
    """
    names, values, support, strains = strains_or_stresses(zone, field)
    thick = family_of(zone)
    if isinstance(thick, ThickShell):
        own = thick.frames(zone, zone_field(zone, material), support)
    else:
        own = flat_frames(zone)[0][:, None]
    Q = _turn(own, axes)
    made = np.empty(np.broadcast_shapes(values.shape, (len(own), 1, Q.shape[1])))
    half = 0.5 if strains else 1.0
    blocks = range(0, len(names) // 3 * 3, 3)
    for start in blocks:
        a, b, c = (values[:, start + i] for i in range(3))
        T = np.stack([np.stack([a, half * c], -1), np.stack([half * c, b], -1)], -2)
        seen = Q @ T @ np.swapaxes(Q, -1, -2)
        made[:, start], made[:, start + 1] = seen[..., 0, 0], seen[..., 1, 1]
        made[:, start + 2] = seen[..., 0, 1] / half
    if len(names) > blocks.stop:
        made[:, blocks.stop :] = np.einsum("cpij,cjp->cip", Q, values[:, blocks.stop :])
    return cell_block(zone, names, made, support)


def strains_or_stresses(
    zone: Zone, field: CellField
) -> tuple[tuple[str, ...], FloatArray, Support, bool]:
    """Names, values (n_cells, n_names, n_points) and points of what a field has of a zone.

    Last comes whether these are strains.
    """
    names, strains = tensors.names_seen(zone, field)
    values, support = tensors.components_at_home(zone, field, names)
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
    return inside[..., :1] * own[..., 0, :] + inside[..., 1:] * own[..., 1, :]


FOLLOWING = "LIE"
"""Of the option FRAME of JOI1: its axes follow."""
_VECTORS = (("VX", "VY", "VZ"), ("V1X", "V1Y", "V1Z"), ("V2X", "V2Y", "V2Z"))


def following_axes(model: Model, material: CellField, motion: NodeField) -> CellField:
    """The parameters with the axes of the model's beams, pipes and bound joints turned.

    Parameters
    ----------
    motion : NodeField
        Its rotations RX RY RZ [rad] count; those that it lacks are zero.
    """
    blocks = list(material.blocks)
    for zone in model.zones:
        if not _turns(zone):
            continue
        for i, block in enumerate(blocks):
            if block.cells is zone.cells and block.element in ("", zone.element):
                blocks[i] = _turned(block, _turns_of(zone, motion))
    return CellField(tuple(blocks), material.title)


def _turns(zone: Zone) -> bool:
    if zone.element == "JOI1":
        return zone.options.get("FRAME") == FOLLOWING
    return family_name(zone) in BEAMS


def _turns_of(zone: Zone, motion: NodeField) -> FloatArray:
    """Turns of the cells' axes, (n, 3, 3); the nodes stand where the motion has taken them."""
    nodes, ends = zone.cells.connectivity, zone.cells.coordinates
    mean = np.zeros((len(nodes), 3))
    for i, name in enumerate(("RX", "RY", "RZ")):
        if name in motion.components:
            mean[:, i] = motion.values_at(name, nodes).mean(axis=1)
    turning = spatial.transform.Rotation.from_rotvec
    plain = turning(mean)
    if zone.element != "JOI1":
        return plain.as_matrix()
    starts = ends - displacements(motion)[nodes]
    before, after = starts[:, 1] - starts[:, 0], ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    apart = lengths > 0.0
    axis = before / np.where(apart, np.linalg.norm(before, axis=1), 1.0)[:, None]
    about = turning(np.vecdot(mean, axis)[:, None] * axis)
    across = np.cross(before, after)
    sine = np.linalg.norm(across, axis=1)
    back = (sine == 0.0) & (np.vecdot(before, after) < 0.0)  # any axis across the segment does
    across[back] = np.cross(before[back], np.eye(3)[np.abs(before[back]).argmin(axis=1)])
    size = np.linalg.norm(across, axis=1)
    angle = np.arctan2(sine, np.vecdot(before, after))
    swing = turning(across * (angle / np.where(size > 0.0, size, 1.0))[:, None])
    return np.where(apart[:, None, None], (swing * about).as_matrix(), plain.as_matrix())


def _turned(block: CellFieldBlock, turn: FloatArray) -> CellFieldBlock:
    made = dict(block.components)
    for names in _VECTORS:
        if any(n in made for n in names):
            made.update(_turned_columns(made, names, turn))
    if "VECT" in made:
        made["VECT"] = _turned_points(block, made["VECT"], turn)
    return replace(block, components=made)


def _turned_columns(
    components: dict[str, NDArray[Any]], names: tuple[str, ...], turn: FloatArray
) -> dict[str, FloatArray]:
    """Three columns of cosines, turned; absent ones count as zero and are added."""
    given = [
        np.asarray(components[n], float) if n in components else np.zeros((1, 1)) for n in names
    ]
    shape = np.broadcast_shapes(*(g.shape for g in given), (len(turn), 1))
    v = np.stack([np.broadcast_to(g, shape) for g in given], axis=-1)
    moved = np.einsum("cij,cpj->cpi", turn, v)
    return {n: moved[..., i] for i, n in enumerate(names)}


def _turned_points(block: CellFieldBlock, values: NDArray[Any], turn: FloatArray) -> NDArray[Any]:
    """Vectors kept as points: new points, one for cells that turn alike."""
    flat = np.asarray(values, dtype=object).reshape(len(values), -1)[:, 0]
    rows = [point.coordinates for point in flat]
    moved = np.einsum("cij,cj->ci", turn, np.broadcast_to(np.array(rows), (len(turn), 3)))
    different, place = np.unique(moved.round(14), axis=0, return_inverse=True)
    table = block.cells.nodes
    points = [Point(table, int(n)) for n in table.add(different)]
    made = np.empty((len(turn), 1), dtype=object)
    made[:, 0] = [points[k] for k in place.ravel()]
    return made
