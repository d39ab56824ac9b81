"""Axes of orthotropy (and of joints) from directions, as parameters V1X V1Y V1Z V2X V2Y V2Z."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.results.frames import is_thin_shell, points_of, shell_frames
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.elasticity import two_axes
from ssilang.kernel.materials.model import Mode, Zone


@dataclass(frozen=True, eq=False)
class Directions:
    """What a script says of the axes.

    Attributes
    ----------
    first, second : array (3,); second is None where one vector is enough
        Vectors, or with `radial` points: the centre, or two points of the axis.
    angle : float
        Turn about the third axis, degrees.
    outside : array (3,), optional
        Side of a shell to which its normal counts positive for the angle.
    roll : float
        Turn of the second and third axis about the first, degrees.
    """

    first: FloatArray
    second: FloatArray | None
    radial: bool = False
    angle: float = 0.0
    outside: FloatArray | None = None
    roll: float = 0.0


def axis_parameters(zone: Zone, given: Directions) -> tuple[dict[str, FloatArray], Support]:
    """Parameters V1X ... V2Z (n_cells, n_points) and the support they stand on.

    Raises
    ------
    MaterialError
        If a vector is missing, zero or parallel to the other.
    """
    if is_thin_shell(zone):
        return _on_shell(zone, given), "GRAVITE"
    if family_name(zone) == "joint" and zone.element != "JOI1" and given.second is None:
        return _on_joint(zone, given), "GRAVITE"
    flat = zone.mode is not Mode.THREE_DIMENSIONAL
    support: Support = "RIGIDITE" if given.radial else "GRAVITE"
    if given.radial:
        first, second = _radial(zone, given, flat)
    else:
        n = len(zone.cells)
        first = np.broadcast_to(given.first, (n, 1, 3))
        second = _second(given, flat, first)
    v1, v2 = _turned(two_axes(first, second), given.angle)
    if given.roll:
        v2, _ = _turned((v2, np.cross(v1, v2)), given.roll)
    out = {f"V{i}{a}": v[..., k] for i, v in ((1, v1), (2, v2)) for k, a in enumerate("XYZ")}
    return out, support


def _on_shell(zone: Zone, given: Directions) -> dict[str, FloatArray]:
    """Cosines V1X V1Y of the first axis in the own frame of each shell cell."""
    frames = shell_frames(zone)
    vector = np.broadcast_to(given.first, (len(frames), 3))
    if given.radial:
        vector = zone.cells.coordinates.mean(axis=1) - given.first
    inside = np.einsum("cij,cj->ci", frames[:, :2], vector)
    size = np.linalg.norm(inside, axis=1)
    if (size <= 1e-9 * np.linalg.norm(vector, axis=1)).any():
        raise MaterialError("kernel.materials.direction-orthotropy-normal-shell")
    angle = np.arctan2(inside[:, 1], inside[:, 0])
    sign = np.ones(len(frames))
    if given.outside is not None:
        sign = np.sign(frames[:, 2] @ given.outside)
    angle = angle + sign * np.radians(given.angle)
    return {"V1X": np.cos(angle)[:, None], "V1Y": np.sin(angle)[:, None]}


def _on_joint(zone: Zone, given: Directions) -> dict[str, FloatArray]:
    """First axis in the surface of a joint, turned about its normal."""
    half = zone.cells.kind.n_nodes // 2
    x = zone.cells.coordinates[:, :half][:, [c for c in zone.cells.kind.corners if c < half]]
    if zone.mode is not Mode.THREE_DIMENSIONAL:
        normal = np.broadcast_to(np.array([0.0, 0.0, 1.0]), (len(x), 3))
    else:
        normal = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    first = np.broadcast_to(given.first, (len(x), 3))[:, None]
    v1, _ = _turned(two_axes(first, np.cross(normal[:, None], first)), given.angle)
    return {f"V1{a}": v1[..., k] for k, a in enumerate("XYZ")}


def _second(given: Directions, flat: bool, first: FloatArray) -> FloatArray:
    if given.second is not None:
        return np.broadcast_to(given.second, first.shape)
    if not flat:
        raise MaterialError("kernel.materials.space-two-vectors-show")
    return np.stack([-first[..., 1], first[..., 0], np.zeros_like(first[..., 0])], axis=-1)


def _radial(zone: Zone, given: Directions, flat: bool) -> tuple[FloatArray, FloatArray]:
    x = points_of(zone, "RIGIDITE")
    if flat:
        first = given.first - x
        return first, np.stack([-first[..., 1], first[..., 0], 0 * first[..., 0]], axis=-1)
    if given.second is None:
        raise MaterialError("kernel.materials.space-radial-needs-two")
    axis = given.second - given.first
    along = axis / max(float(np.linalg.norm(axis)), 1e-300)
    out = x - given.first
    radius = out - (out @ along)[..., None] * along
    return np.broadcast_to(along, radius.shape), -radius


def _turned(frame: tuple[FloatArray, FloatArray], angle: float) -> tuple[FloatArray, FloatArray]:
    v1, v2 = frame
    quarter = round(angle / 90.0)
    exact = {0: (1.0, 0.0), 1: (0.0, 1.0)}.get(quarter) if angle == 90.0 * quarter else None
    c, s = exact or (np.cos(np.radians(angle)), np.sin(np.radians(angle)))
    return c * v1 + s * v2, c * v2 - s * v1
