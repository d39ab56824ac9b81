"""Where the eye stands: from space to the sheet."""

from dataclasses import dataclass

import numpy as np

from ssilang.io.errors import OutputError
from ssilang.kernel.base.arrays import FloatArray

# from the front right, slightly above: three faces of a box are seen
DEFAULT_DIRECTION = np.array([1.0, -2.0, 0.9])


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane in space: a point of it (3,) and its unit normal (3,)."""

    origin: FloatArray
    normal: FloatArray

    @classmethod
    def through(cls, a: FloatArray, b: FloatArray, c: FloatArray) -> "Plane":
        """The plane through three points.

        Raises
        ------
        OutputError
            If they lie on a line.
        """
        normal = np.cross(b - a, c - a)
        length = float(np.linalg.norm(normal))
        if length <= 1e-12 * float(np.linalg.norm(b - a) * np.linalg.norm(c - a)):
            raise OutputError("io.three-points-plane-lie")
        return cls(a, normal / length)

    def height(self, points: FloatArray) -> FloatArray:
        """Signed distance of points (..., 3) from the plane."""
        return (points - self.origin) @ self.normal


@dataclass(frozen=True, eq=False)
class View:
    """A parallel projection."""

    # (3, 3) rows: to the right on the sheet, upwards on the sheet, towards the eye
    axes: FloatArray
    solid: bool = True  # True for a view in space, False for the plane x, y

    def project(self, points: FloatArray) -> FloatArray:
        """Sheet coordinates (..., 2) of points (..., 3)."""
        return points @ self.axes[:2].T

    def depth(self, points: FloatArray) -> FloatArray:
        """How near points (..., 3) are to the eye; larger is nearer."""
        return points @ self.axes[2]


def plane_view() -> View:
    """The plane x, y."""
    return View(np.eye(3), solid=False)


def view_along(direction: FloatArray, upright: FloatArray | None = None) -> View:
    """The view from far away in `direction` (3,).

    Parameters
    ----------
    upright : array (3,), optional
        What goes upwards on the sheet; z by default, y if one looks along z.

    Raises
    ------
    OutputError
        If `upright` is along `direction`.
    """
    towards = np.asarray(direction, dtype=float)
    length = np.linalg.norm(towards)
    towards = (
        DEFAULT_DIRECTION / np.linalg.norm(DEFAULT_DIRECTION) if length == 0 else (towards / length)
    )
    up = np.array([0.0, 0, 1]) if abs(towards[2]) < 1 - 1e-9 else np.array([0.0, 1, 0])
    if upright is not None:
        up = upright
    right = np.cross(up, towards)
    width = float(np.linalg.norm(right))
    if width <= 1e-9 * float(np.linalg.norm(up)):
        raise OutputError("io.upright-along-view")
    right /= width
    return View(np.stack([right, np.cross(towards, right), towards]))
