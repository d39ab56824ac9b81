"""Points and weights of the quadrature rules against SciPy's, and exact integrals."""

from __future__ import annotations

import itertools
from math import factorial

import numpy as np
import pytest
from scipy.special import roots_jacobi, roots_legendre

from ssilang.kernel.elements.shapes.quadrature import quadrature


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5])
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


@pytest.mark.parametrize("powers", [p for p in itertools.product(range(6), repeat=3) if sum(p) < 6])
def test_the_conical_rule_integrates_polynomials_of_degree_5(powers: tuple[int, ...]) -> None:
    rule = quadrature("tetrahedron", 27)
    i, j, k = powers
    exact = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3)
    found = rule.weights @ np.prod(rule.points**powers, axis=1)
    assert found == pytest.approx(exact, rel=1e-14)
