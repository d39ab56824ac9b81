"""The curve along which two simple surfaces cross, between two points of it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError

Gap = Callable[[FloatArray], FloatArray]
"""Positions (m, 3) -> signed distances (m,) to a surface."""

_STEPS = 100  # over the distance of the ends; lengths are then exact to about 1e-7
_MOST_STEPS = 60_000


@dataclass(frozen=True)
class CrossingCurve:
    """A curve on two surfaces, followed point by point.

    Attributes
    ----------
    gaps : pair of functions
        Signed distances to the surfaces.
    way : array (n,)
        Length from the start of the curve to each point.
    points : array (n, 3)
    """

    gaps: tuple[Gap, Gap]
    way: FloatArray
    points: FloatArray

    @property
    def length(self) -> float:
        """Length of the whole curve."""
        return float(self.way[-1])

    def __call__(self, fractions: FloatArray) -> FloatArray:
        """Positions (m, 3) at fractions (m,) of the length."""
        at = np.asarray(fractions) * self.length
        x = np.column_stack([np.interp(at, self.way, self.points[:, k]) for k in range(3)])
        inner = (at > 0.0) & (at < self.length)
        x[inner] = _on_both(self.gaps, x[inner], self.length)
        return x


def crossing_curve(
    gaps: tuple[Gap, Gap], start: FloatArray, end: FloatArray, length: float | None = None
) -> CrossingCurve:
    """The shortest way from a point to another along the crossing of two surfaces.

    Parameters
    ----------
    start, end : array (3,)
        On both surfaces.
    length : float or None
        Where to stop instead, on the way towards `end`.

    Raises
    ------
    MeshError
        If the surfaces touch without crossing, or the end is not reached.
    """
    reach = float(np.linalg.norm(end - start))
    if reach == 0.0:
        raise MeshError("kernel.mesh.two-ends-curve-same")
    for name, x in (("first", start), ("last", end)):
        off = max(abs(float(gap(x[None])[0])) for gap in gaps)
        if off > 1e-4 * reach:
            raise MeshError("kernel.mesh.point-away-surfaces", name=name, off=off)
    found = [
        path
        for sense in (1.0, -1.0)
        if (path := _followed(gaps, start, end, sense * reach / _STEPS)) is not None
    ]
    if not found:
        raise MeshError("kernel.mesh.crossing-surfaces-starts-first")
    shortest = min(found, key=lambda path: path.length)
    return shortest if length is None else _to_length(shortest, length)


def _followed(
    gaps: tuple[Gap, Gap], start: FloatArray, end: FloatArray, step: float
) -> CrossingCurve | None:
    """The curve from the start in one sense; None if it does not come to the end."""
    size = abs(step)
    tangent = _tangent(gaps, start, size) * np.sign(step)
    points = [start]
    for _ in range(_MOST_STEPS):
        here = points[-1]
        ahead = _on_both(gaps, (here + size * tangent)[None], size)[0]
        turned = _tangent(gaps, ahead, size)
        tangent = turned if float(turned @ tangent) > 0.0 else -turned
        arm = end - here
        passed = float((end - ahead) @ (ahead - here)) <= 0.0
        if passed and float(np.linalg.norm(arm)) < 1.5 * size:
            near = len(points) > 1 and float(np.linalg.norm(arm)) < 0.5 * size
            return _through(gaps, [*points[: len(points) - near], end])
        points.append(ahead)
        if len(points) > 10 and float(np.linalg.norm(ahead - start)) < 0.9 * size:
            return None  # round and back without meeting the end
    return None


def _through(gaps: tuple[Gap, Gap], points: list[FloatArray]) -> CrossingCurve:
    """The curve through points, each piece as long as the arc that the turns at its ends tell."""
    x = np.array(points)
    chords = np.linalg.norm(np.diff(x, axis=0), axis=1)
    if len(x) > 2:
        turns = np.linalg.norm(np.diff(np.diff(x, axis=0) / chords[:, None], axis=0), axis=1)
        bent = np.pad((2.0 * turns / (chords[1:] + chords[:-1])) ** 2, 1, mode="edge")
        chords = chords * (1.0 + chords**2 * (bent[1:] + bent[:-1]) / 48.0)
    return CrossingCurve(gaps, np.concatenate([[0.0], np.cumsum(chords)]), x)


def _to_length(curve: CrossingCurve, length: float) -> CrossingCurve:
    """The curve up to a length, shorter or longer than its own."""
    points, reached = list(curve.points), curve.length
    size = reached / (len(points) - 1)
    chord = points[-1] - points[-2]
    while reached < length and len(points) < _MOST_STEPS:
        ahead = points[-1] + size * chord / float(np.linalg.norm(chord))
        points.append(_on_both(curve.gaps, ahead[None], size)[0])
        chord = points[-1] - points[-2]
        reached += float(np.linalg.norm(chord))
    whole = _through(curve.gaps, points)
    kept = int(np.searchsorted(whole.way, length))
    points = [*whole.points[:kept], *whole(np.array([length / whole.length]))]
    return CrossingCurve(curve.gaps, np.append(whole.way[:kept], length), np.array(points))


def _slopes(gaps: tuple[Gap, Gap], x: FloatArray, size: float) -> FloatArray:
    """Gradients (m, 2, 3) of the distances at positions (m, 3)."""
    h = 1e-5 * size
    shifted = x + h * np.vstack([np.eye(3), -np.eye(3)])[:, None]
    off = np.array([gap(shifted.reshape(-1, 3)) for gap in gaps]).reshape(2, 2, 3, len(x))
    return np.moveaxis((off[:, 0] - off[:, 1]) / (2.0 * h), 2, 0)


def _on_both(gaps: tuple[Gap, Gap], x: FloatArray, size: float) -> FloatArray:
    """Positions brought onto both surfaces by the least moves (Newton)."""
    for _ in range(20):
        off = np.stack([gap(x) for gap in gaps], axis=1)
        if float(np.abs(off).max(initial=0.0)) < 1e-13 * size:
            break
        slopes = _slopes(gaps, x, size)
        gram = slopes @ np.swapaxes(slopes, 1, 2)
        x = x - np.einsum("mij,mi->mj", slopes, np.linalg.solve(gram, off[..., None])[..., 0])
    return x


def _tangent(gaps: tuple[Gap, Gap], x: FloatArray, size: float) -> FloatArray:
    one, two = _slopes(gaps, x[None], size)[0]
    along = np.cross(one, two)
    sine = float(np.linalg.norm(along))
    if sine < 1e-5:
        raise MeshError("kernel.mesh.two-surfaces-touch-without", x=x)
    return along / sine
