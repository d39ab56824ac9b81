"""Points and weights of the quadrature rules against SciPy's, and exact integrals."""

import itertools
from math import factorial

import numpy as np
import pytest
from scipy.special import roots_jacobi, roots_legendre
from together import together

from ssilang.kernel.elements.shapes.quadrature import quadrature


@together("n", [1, 2, 3, 4, 5])
def test_points_of_a_line_are_those_of_legendre(n: int) -> None:
    rule = quadrature("line", n)
    points, weights = roots_legendre(n)
    np.testing.assert_allclose(rule.points[:, 0], points, atol=4e-16)
    np.testing.assert_allclose(rule.weights, weights, rtol=2e-15)


@pytest.mark.parametrize("n", [2, 3])
def test_heights_of_a_pyramid_s_points_are_those_of_jacobi(n: int) -> None:
    rule = quadrature("pyramid", n**3)
    roots, weights = roots_jacobi(n, 2, 0)
    heights, layers = rule.points[:, 2].reshape(n, -1), rule.weights.reshape(n, -1)
    np.testing.assert_allclose(heights, np.tile((1 + roots)[:, None] / 2, n * n), atol=4e-16)
    np.testing.assert_allclose(layers.sum(1), 4 * weights / 8, rtol=2e-15)


@together("powers", [p for p in itertools.product(range(6), repeat=3) if sum(p) < 6])
def test_the_conical_rule_integrates_polynomials_of_degree_5(powers: tuple[int, ...]) -> None:
    rule = quadrature("tetrahedron", 27)
    i, j, k = powers
    exact = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)
    found = rule.weights @ np.prod(rule.points**powers, axis=1)
    assert found == pytest.approx(exact, rel=1e-14)


def exact(shape: str, powers: tuple[int, ...]) -> float:
    """The integral of x^i y^j z^k over a reference domain, in closed form."""
    i, j, k = (*powers, 0, 0)[:3]
    even = [2.0 / (p + 1) if p % 2 == 0 else 0.0 for p in (i, j, k)]  # over [-1, 1]
    if shape in ("line", "quadrangle", "hexahedron"):
        return float(np.prod(even[: len(powers)]))
    if shape in ("triangle", "prism"):
        area = factorial(i) * factorial(j) / factorial(i + j + 2)
        return area if shape == "triangle" else area * even[2]
    if shape == "tetrahedron":
        return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)
    # a pyramid's section at height z is (1 - z) [-1, 1]^2
    along = factorial(k) * factorial(i + j + 2) / factorial(i + j + k + 3)
    return even[0] * even[1] * along


@together(
    "shape, n_points, degree",
    [
        ("line", 1, 1), ("line", 2, 3), ("line", 3, 5), ("line", 5, 9),
        ("triangle", 1, 1), ("triangle", 3, 2), ("triangle", 7, 5),
        ("quadrangle", 1, 1), ("quadrangle", 4, 3), ("quadrangle", 9, 5),
        ("tetrahedron", 1, 1), ("tetrahedron", 4, 2), ("tetrahedron", 27, 5),
        ("prism", 1, 1), ("prism", 6, 2), ("prism", 21, 5),
        ("pyramid", 1, 1), ("pyramid", 8, 3), ("pyramid", 27, 5),
        ("hexahedron", 1, 1), ("hexahedron", 8, 3), ("hexahedron", 27, 5),
    ],
)  # fmt: skip
def test_rules_integrate_polynomials_of_their_degree(shape, n_points, degree):
    rule = quadrature(shape, n_points)
    assert len(rule) == n_points
    dimension = rule.points.shape[1]
    for powers in itertools.product(range(degree + 1), repeat=dimension):
        if sum(powers) <= degree:
            found = rule.weights @ np.prod(rule.points**powers, axis=1)
            assert found == pytest.approx(exact(shape, powers), rel=1e-13, abs=1e-15), powers


@pytest.mark.parametrize("shape", ["quadrangle", "hexahedron"])
def test_two_points_a_direction_follow_the_corners(shape):
    rule = quadrature(shape, {"quadrangle": 4, "hexahedron": 8}[shape])
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / np.sqrt(3.0)
    np.testing.assert_allclose(rule.points[:4, :2], corners, atol=1e-15)
    if shape == "hexahedron":
        np.testing.assert_allclose(rule.points[4:, :2], corners, atol=1e-15)
        np.testing.assert_allclose(rule.points[[0, 4], 2], [-(3**-0.5), 3**-0.5], atol=1e-15)
