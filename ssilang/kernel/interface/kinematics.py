"""Kinematics of joints: local axes, interpolation of the jump and weights at each point.

The jump at a point is `w = R sum_i N_i (u_iU - u_iL)`, with R the rows (t1, [t2,] n) and n going
from L (soil) to U (structure). In 2D `n = (-t_y, t_x)` with t along the first side, so that n
points to the upper side when the sides are walked with the joint on the right hand (RACC). For a
joint of two points n goes from the first to the second node, and t is n turned by +90 degrees.
Traction is positive in tension; the force on the nodes is `B^T t`, on the left of equilibrium.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.interface.elements import JointElement, joint_element
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.messages.message import Sentence


@dataclass(frozen=True, eq=False)
class JointCells:
    """Joints of one zone, ready to give jumps."""

    zone: Zone
    element: JointElement
    upper: IntArray  # (n, m) facing nodes of the two sides, as made (not resolved)
    lower: IntArray
    shape: FloatArray  # (g, m) interpolation of the nodal jumps at the points
    frames: FloatArray  # (n, g, d, d) rows t1, [t2,] n
    weights: FloatArray  # (n, g) area of each point (times thickness, or 2 pi r); 1 of two points

    @property
    def operator(self) -> FloatArray:
        """`w = operator @ jumps`: array (n, g, d, m d), nodal jumps node by node."""
        n, g, d, _ = self.frames.shape
        product = np.einsum("gm,ngij->ngimj", self.shape, self.frames)
        return product.reshape(n, g, d, -1)


def joint_cells(zone: Zone, given: ZoneField | None = None) -> JointCells:
    """Local axes, interpolation and weights of a zone of joints.

    Parameters
    ----------
    given : ZoneField, optional
        Characteristics: DIM3 (thickness out of the plane), V1X V1Y V1Z and V2X V2Y V2Z (axes
        imposed by the user: for a joint of two points V1 is n and V2 is t1; for a surface V1 is
        t1).

    Raises
    ------
    MeshError
        If a joint has no area, both sides on the same nodes, or n pointing from U to L.
    """
    element = joint_element(zone)
    half = element_sides(zone)
    _refuse_merged(zone, *half)
    if element.face == "POI1":
        return _two_points(zone, element, given, *half)
    return _surface(zone, element, given, *half)


def element_sides(zone: Zone) -> tuple[IntArray, IntArray]:
    """Upper and lower nodes (n, m) each, as made."""
    raw = zone.cells.raw
    m = raw.shape[1] // 2
    return (raw[:, 1:], raw[:, :1]) if zone.element == "JOI1" else (raw[:, :m], raw[:, m:])


def _refuse_merged(zone: Zone, upper: IntArray, lower: IntArray) -> None:
    resolve = zone.cells.nodes.resolve
    merged = (resolve(upper) == resolve(lower)).all(axis=1)
    if merged.any():
        raise MeshError(
            "kernel.interface.joint-both-sides-same", cells=_cells(merged), element=zone.element
        )


def _cells(wrong: np.ndarray) -> Sentence:
    first = int(np.flatnonzero(wrong)[0]) + 1
    return Sentence("kernel.interface.cells", first=first, more=int(wrong.sum()) - 1)


# --- two points ------------------------------------------------------------------------------


def _two_points(
    zone: Zone,
    element: JointElement,
    given: ZoneField | None,
    upper: IntArray,
    lower: IntArray,
) -> JointCells:
    d, n_cells = element.dimension, len(upper)
    x = _positions(zone, upper, d)[:, 0] - _positions(zone, lower, d)[:, 0]
    axis = user_axis(given, "V1", n_cells, d)
    length = np.linalg.norm(x, axis=1)
    if axis is None:
        if not (length > 0).all():
            raise MeshError("kernel.interface.joint-joi1-no-length", cells=_cells(length == 0))
        axis = x
    normal = _unit(axis)
    facing = np.einsum("ni,ni->n", normal, x) < -0.5 * length
    if "JOINT_SDM" in zone.behaviour and (facing & (length > 0)).any():
        raise MeshError("kernel.interface.joint-joi1-normal-goes", cells=_cells(facing))
    frames = _frames_from_normal(normal, user_axis(given, "V2", n_cells, d))[:, None]
    return JointCells(zone, element, upper, lower, np.ones((1, 1)), frames, np.ones((n_cells, 1)))


def _frames_from_normal(normal: FloatArray, second: FloatArray | None) -> FloatArray:
    """Rows (t, n) in 2D, t being n turned by +90 degrees; (t1, t2, n) in 3D."""
    if normal.shape[1] == 2:
        return np.stack([np.stack([-normal[:, 1], normal[:, 0]], 1), normal], axis=1)
    if second is None:  # the global axis that is least along n
        second = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
    t1 = _unit(second - np.einsum("ni,ni->n", second, normal)[:, None] * normal)
    return np.stack([t1, np.cross(normal, t1), normal], axis=1)


# --- surfaces --------------------------------------------------------------------------------


def _surface(
    zone: Zone,
    element: JointElement,
    given: ZoneField | None,
    upper: IntArray,
    lower: IntArray,
) -> JointCells:
    rule = support_rule(zone.element, "RIGIDITE")
    N = shape_functions(element.face, rule.points)
    dN = shape_gradients(element.face, rule.points)
    d = element.dimension
    x_u, x_l = _positions(zone, upper, d), _positions(zone, lower, d)
    middle = (x_u + x_l) / 2
    tangents = np.einsum("gma,nmi->ngai", dN, middle)
    area, frames = _surface_frames(tangents, user_axis(given, "V1", len(upper), d))
    size = np.abs(middle - middle[:, :1]).max(axis=(1, 2)) ** (d - 1)
    flat = (area <= 1e-12 * size[:, None]).any(axis=1)
    if flat.any():
        raise MeshError("kernel.interface.joint-no-area", cells=_cells(flat), element=zone.element)
    _refuse_reversed(zone, frames[:, :, -1], np.einsum("gm,nmi->ngi", N, x_u - x_l), size)
    normal = frames[:, :, -1]  # turns round between points where corners are in a wrong order
    folded = (np.einsum("ngi,ni->ng", normal, normal[:, 0]) <= 0.0).any(axis=1)
    if folded.any():
        told = {"cells": _cells(folded), "element": zone.element}
        raise MeshError("kernel.interface.joint-folded-part-negative", **told)
    weights = area * rule.weights * _thickness(zone, given, N, middle)
    _refuse_negative(zone, weights)
    return JointCells(zone, element, upper, lower, N, frames, weights)


def _surface_frames(tangents: FloatArray, axis: FloatArray | None) -> tuple[FloatArray, FloatArray]:
    """Area density (n, g) and frames (n, g, d, d) from tangents (n, g, d - 1, d)."""
    d = tangents.shape[-1]
    j1 = tangents[:, :, 0]
    if d == 2:
        area = np.linalg.norm(j1, axis=-1)
        t = _unit(j1) if axis is None else _unit(np.broadcast_to(axis[:, None], j1.shape))
        return area, np.stack([t, np.stack([-t[..., 1], t[..., 0]], -1)], axis=2)
    product = np.cross(j1, tangents[:, :, 1])
    area = np.linalg.norm(product, axis=-1)
    n = _unit(product)
    first = j1 if axis is None else np.broadcast_to(axis[:, None], j1.shape)
    t1 = _unit(first - np.sum(first * n, axis=-1, keepdims=True) * n)
    return area, np.stack([t1, np.cross(n, t1), n], axis=2)


def _refuse_reversed(zone: Zone, normal: FloatArray, gap: FloatArray, size: FloatArray) -> None:
    length = size ** (1 / max(normal.shape[-1] - 1, 1))
    wrong = (np.sum(normal * gap, axis=-1) < -1e-9 * length[:, None]).any(axis=1)
    if wrong.any():
        raise MeshError(
            "kernel.interface.joint-normal-goes-first", cells=_cells(wrong), element=zone.element
        )


def _refuse_negative(zone: Zone, weights: FloatArray) -> None:
    largest = weights.max(axis=1, keepdims=True)  # a node on the axis of revolution has none
    negative: NDArray[np.bool_] = np.asarray(
        ((weights < -1e-12 * np.abs(largest)) | (largest <= 0.0)).any(axis=1)
    )
    if negative.any():
        axisymmetric = zone.mode is Mode.AXISYMMETRIC
        told = {"cells": _cells(negative), "element": zone.element, "axisymmetric": axisymmetric}
        raise MeshError("kernel.interface.joint-negative-area", **told)


def _thickness(
    zone: Zone, given: ZoneField | None, N: FloatArray, middle: FloatArray
) -> FloatArray:
    """2 pi r in axisymmetry, else DIM3 (default 1), shape (n, g) or broadcast to it."""
    if zone.mode is Mode.AXISYMMETRIC:
        return 2 * np.pi * np.einsum("gm,nm->ng", N, middle[:, :, 0])
    thickness = point_values(given, "DIM3", len(middle), N)
    return np.ones((1, 1)) if thickness is None else thickness


# --- values given by the user ----------------------------------------------------------------


def point_values(
    given: ZoneField | None, name: str, n_cells: int, shape: FloatArray
) -> FloatArray | None:
    """A component at the joint's points (n, g), None if it is not given.

    Values constant in the cell are repeated; values at the cell's nodes, or at those of one side,
    are interpolated, as the mean of both sides; values at as many points as the joint has are
    taken as they are.
    """
    if given is None or name not in given:
        return None
    values, support = given.numbers(name)
    g, m = shape.shape
    values = np.broadcast_to(values, (n_cells, values.shape[1]))
    if values.shape[1] == 2 * m and support == "NOEUD":
        values = (values[:, :m] + values[:, m:]) / 2
    if values.shape[1] == m > 1 and support == "NOEUD":
        return values @ shape.T
    if values.shape[1] in (1, g):
        return np.broadcast_to(values, (n_cells, g)).copy()
    raise MaterialError(
        "kernel.interface.joint-parameter-cell-fit", name=name, n_values=values.shape[1], g=g
    )


def user_axis(given: ZoneField | None, name: str, n_cells: int, d: int) -> FloatArray | None:
    """An axis imposed by components such as V1X V1Y V1Z, shape (n, d), None if not given."""
    if given is None or not any(name + c in given for c in "XYZ"[:d]):
        return None
    axis = np.zeros((n_cells, d))
    for i, c in enumerate("XYZ"[:d]):
        if name + c in given:
            axis[:, i] = given.numbers(name + c)[0].mean(axis=1)
    if not (np.linalg.norm(axis, axis=1) > 0).all():
        raise MeshError("kernel.interface.direction-joint-zero-vector", name=name)
    return axis


def _positions(zone: Zone, raw: IntArray, d: int) -> FloatArray:
    nodes = zone.cells.nodes
    return nodes.coordinates[nodes.resolve(raw)][..., :d]


def _unit(v: FloatArray) -> FloatArray:
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(size > 0, size, 1.0)
