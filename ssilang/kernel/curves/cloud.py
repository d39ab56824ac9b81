"""Clouds (NUAGE): rows of named values, and functions that pass through them."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.scientific import interpolate


@dataclass(frozen=True, eq=False)
class Cloud:
    """Columns of equal length: numbers, or objects of one type a column.

    Parameters
    ----------
    columns : dict of str to tuple
        In order of definition.
    """

    columns: dict[str, tuple[object, ...]]

    def __len__(self) -> int:
        return max((len(c) for c in self.columns.values()), default=0)

    def joined(self, other: "Cloud") -> "Cloud":
        """The rows of this one, then those of a cloud of the same columns.

        Raises
        ------
        FieldError
            If the columns differ and neither cloud is empty.
        """
        if not self.columns or not other.columns:
            return other if not self.columns else self
        if set(self.columns) != set(other.columns):
            told = {"first": list(self.columns), "second": list(other.columns)}
            raise FieldError("kernel.curves.clouds-of-other-components", **told)
        return Cloud({k: (*v, *other.columns[k]) for k, v in self.columns.items()})

    def numbers(self, name: str) -> FloatArray:
        """A column of numbers, shape (n_rows,).

        Raises
        ------
        FieldError
            If there is no such column, or it holds objects.
        """
        if name not in self.columns:
            raise FieldError("kernel.curves.cloud-no-component", name=name, columns=self.columns)
        held = self.columns[name]
        if not all(isinstance(v, int | float) for v in held):
            raise FieldError("kernel.curves.component-cloud-holds-objects", name=name)
        return np.asarray(held, dtype=float)

    def rows(self, places: list[int]) -> "Cloud":
        """The cloud of some rows (0-based)."""
        return Cloud({k: tuple(v[i] for i in places) for k, v in self.columns.items()})


def inverse_distance(
    points: FloatArray, values: FloatArray, at: FloatArray, power: float, near: float
) -> FloatArray:
    """Shepard's mean of values (n, p), weights `distance ** -power`, at points (m, d).

    Within the distance `near` of a point of the cloud its own values are returned.
    """
    distance = np.linalg.norm(at[:, None, :] - points[None, :, :], axis=2)
    close = np.argmin(distance, axis=1)
    exact = distance[np.arange(len(at)), close] <= near
    with np.errstate(divide="ignore"):
        weights = np.where(distance > 0, distance, 1.0) ** -power
    weights = np.where(exact[:, None], 0.0, weights)
    weights[exact, close[exact]] = 1.0
    return weights @ values / weights.sum(axis=1, keepdims=True)


def moving_plane(
    points: FloatArray, values: FloatArray, at: FloatArray, gaussian: bool
) -> FloatArray:
    """Value at points (m, d) of the plane that fits values (n, p) best around each.

    Least squares weighted by exp(-x**2) or 1 / (1 + x), x being the distance over the mean
    distance between the points of the cloud.
    """
    spread = np.linalg.norm(points[:, None] - points[None], axis=2)
    scale = float(spread.sum() / max(len(points) * (len(points) - 1), 1)) or 1.0
    found = np.empty((len(at), values.shape[1]))
    for i, x in enumerate(at):
        gap = points - x
        r = np.linalg.norm(gap, axis=1) / scale
        weight = np.sqrt(np.exp(-(r**2)) if gaussian else 1.0 / (1.0 + r))
        basis = np.hstack((np.ones((len(points), 1)), gap))
        solution, *_ = np.linalg.lstsq(
            basis * weight[:, None], values * weight[:, None], rcond=None
        )
        found[i] = solution[0]
    return found


def on_grid(axes: list[FloatArray], values: FloatArray, at: FloatArray) -> FloatArray:
    """Multilinear interpolation at points (m, d) of values on a grid, first axis fastest.

    Points outside of the grid take the value at its border.
    """
    sizes = [len(a) for a in axes]
    if int(np.prod(sizes)) != len(values):
        told = {"grid": " x ".join(map(str, sizes)), "wanted": np.prod(sizes)}
        told |= {"n_values": len(values)}
        raise FieldError("kernel.curves.grid-nodes-needs-values", **told)
    if any(np.any(np.diff(a) <= 0) for a in axes):
        raise FieldError("kernel.curves.coordinates-grid-must-increase")
    table = values.reshape(sizes, order="F")
    inside = np.clip(at, [a[0] for a in axes], [a[-1] for a in axes])
    return interpolate.RegularGridInterpolator(axes, table)(inside)
