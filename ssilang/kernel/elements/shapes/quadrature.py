"""Quadrature rules on the reference domains."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Rule:
    """Points (n_points, dim) and weights (n_points,) on a reference domain."""

    points: FloatArray
    weights: FloatArray

    def __len__(self) -> int:
        return len(self.weights)


def _line(n: int) -> Rule:
    x, w = np.polynomial.legendre.leggauss(n)
    return Rule(x[:, None], w)


def _towards_a_point(n: int, k: int) -> tuple[FloatArray, FloatArray]:
    """Gauss points and weights (n,) on [-1, 1] for the weight (1 - x)^k, by Golub and Welsch 1969.

    The points are the eigenvalues of the matrix of the recurrence of Jacobi's polynomials, the
    weights the squares of the first parts of its vectors (SciPy takes long to import).
    """
    if k == 0:
        return np.polynomial.legendre.leggauss(n)
    j = np.arange(n)
    diagonal = -(k**2) / ((2 * j + k) * (2 * j + k + 2))
    i = j[1:]
    beside = 2 * i * (i + k) / ((2 * i + k) * np.sqrt((2.0 * i + k) ** 2 - 1))
    x, vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))
    return x, 2.0 ** (k + 1) / (k + 1) * vectors[0] ** 2


def _product(*rules: Rule) -> Rule:
    """Tensor product; the first factor varies fastest."""
    points, weights = rules[0].points, rules[0].weights
    for rule in rules[1:]:
        m = len(rule)
        points = np.column_stack(
            [np.tile(points, (m, 1)), np.repeat(rule.points, len(weights), axis=0)]
        )
        weights = np.outer(rule.weights, weights).ravel()
    return Rule(points, weights)


def _quadrangle(n: int) -> Rule:
    """Gauss product; with 2 x 2 the points follow the corners' order."""
    rule = _product(_line(n), _line(n))
    if n != 2:
        return rule
    order = [0, 1, 3, 2]
    return Rule(rule.points[order], rule.weights[order])


def _hexahedron(n: int) -> Rule:
    """A cube of points, or 5 on the line between the centres of the first and last faces."""
    if n == 5:
        return _product(_quadrangle(1), _line(5))
    side = round(n ** (1 / 3))
    return _product(_quadrangle(side), _line(side))


def _triangle_symmetric(*orbits: tuple[float, float]) -> Rule:
    """Points (a, a), (1 - 2a, a), (a, 1 - 2a) for each (a, weight); a = 1/3 is one point."""
    points, weights = [], []
    for a, w in orbits:
        b = 1 - 2 * a
        orbit = [(a, a)] if abs(a - b) < 1e-12 else [(a, a), (b, a), (a, b)]
        points += orbit
        weights += [w / 2] * len(orbit)
    return Rule(np.array(points), np.array(weights))


def _triangle(n: int) -> Rule:
    """1 point (degree 1), 3 (degree 2) or 7 (degree 5, Radon 1948)."""
    root = np.sqrt(15.0)
    rules = {
        1: ((1 / 3, 1.0),),
        3: ((1 / 6, 1 / 3),),
        7: (
            (1 / 3, 9 / 40),
            ((6 - root) / 21, (155 - root) / 1200),
            ((6 + root) / 21, (155 + root) / 1200),
        ),
    }
    return _triangle_symmetric(*rules[n])


def _tetrahedron(n: int) -> Rule:
    """1 point (degree 1), 4 (degree 2) or 27 (conical product, degree 5)."""
    if n == 1:
        return Rule(np.full((1, 3), 0.25), np.array([1 / 6]))
    if n == 4:
        a, b = (5 - np.sqrt(5.0)) / 20, (5 + 3 * np.sqrt(5.0)) / 20
        points = np.array([(a, a, a), (b, a, a), (a, b, a), (a, a, b)])
        return Rule(points, np.full(4, 1 / 24))
    # collapsed cube of 3^3 points: exact up to degree 5 (Stroud 1971)
    (x, wx), (y, wy), (z, wz) = (_towards_a_point(3, k) for k in (0, 1, 2))
    u, v, t = ((1 + r) / 2 for r in (x, y, z))
    grid_t, grid_v, grid_u = np.meshgrid(t, v, u, indexing="ij")
    points = np.column_stack(
        [
            (grid_u * (1 - grid_v) * (1 - grid_t)).ravel(),
            (grid_v * (1 - grid_t)).ravel(),
            grid_t.ravel(),
        ]
    )
    weights = (wz[:, None, None] / 8 * wy[None, :, None] / 4 * wx[None, None, :] / 2).ravel()
    return Rule(points, weights)


def _pyramid(n: int) -> Rule:
    """Gauss on the section times Gauss-Jacobi along the height."""
    if n == 1:
        return Rule(np.array([[0.0, 0.0, 0.25]]), np.array([4 / 3]))
    section = _quadrangle(n)
    r, w = _towards_a_point(n, 2)
    z = (1 + r) / 2
    points = np.vstack([np.column_stack([section.points * (1 - h), np.full(n * n, h)]) for h in z])
    return Rule(points, np.concatenate([section.weights * weight / 8 for weight in w]))


def _prism(n: int) -> Rule:
    layers = {1: (1, 1), 6: (3, 2), 21: (7, 3)}[n]
    return _product(_triangle(layers[0]), _line(layers[1]))


def _polygon(sides: int, n: int) -> Rule:
    """One point; one on the way to each corner (degree 2 at least); or, in each triangle between
    the centre and a side, those of the triangle.
    """
    turn = 2.0 * np.pi / sides
    area = 0.5 * np.sin(turn)
    if n == sides:  # at the mean square of the distance from the centre
        angle = turn * np.arange(n)
        ring = np.sqrt((2.0 + np.cos(turn)) / 6.0)
        return Rule(ring * np.column_stack([np.cos(angle), np.sin(angle)]), np.full(n, area))
    if n == 1:
        return Rule(np.zeros((1, 2)), np.array([sides * area]))
    own = _triangle(n // sides)
    edge = np.array([[1.0, 0.0], [np.cos(turn), np.sin(turn)]])
    first = own.points @ edge
    points = [first @ _turned(k * turn) for k in range(sides)]
    return Rule(np.concatenate(points), np.tile(own.weights * 2.0 * area, sides))


def _turned(angle: float) -> FloatArray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s], [-s, c]])


_RULES: dict[str, Callable[[int], Rule]] = {
    "point": lambda n: Rule(np.zeros((1, 0)), np.ones(1)),
    "line": _line,
    "triangle": _triangle,
    "quadrangle": lambda n: _quadrangle(round(n**0.5)),
    "tetrahedron": _tetrahedron,
    "prism": _prism,
    "pyramid": lambda n: _pyramid(1 if n == 1 else round(n ** (1 / 3))),
    "hexahedron": _hexahedron,
}


@cache
def quadrature(shape: str, n_points: int) -> Rule:
    """The rule with `n_points` points on the domain `shape` (see `ReferenceCell`).

    Points are ordered like the nodes where both are as many (2 x 2, 2 x 2 x 2, 3 on a triangle).
    """
    if shape.startswith("polygon"):
        return _polygon(int(shape[len("polygon") :]), n_points)
    return _RULES[shape](n_points)
