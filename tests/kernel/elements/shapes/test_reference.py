"""Shape functions of every cell, points and weights of rules: definitions, SciPy's, integrals."""

import itertools
from math import factorial

import numpy as np
import pytest
from scipy.special import roots_jacobi, roots_legendre
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes.quadrature import quadrature
from ssilang.kernel.elements.shapes.reference import (
    REFERENCE_CELLS,
    reference_cell,
    shape_functions,
    shape_gradients,
)
from ssilang.kernel.mesh.cells import CELL_TYPES

CELLS = ("TRI7", "QUA9", "PY13", "TE15", "PR21", "CU27")
EVERY = sorted(name for name, cell in REFERENCE_CELLS.items() if cell.nodes.shape[1])
QUADRATIC = {2: [(2, 0), (1, 1), (0, 2)], 3: [(2, 0, 0), (1, 0, 1), (0, 1, 1), (0, 0, 2)]}


@together("name", EVERY)
def test_each_function_is_one_at_its_node_alone(name: str) -> None:
    nodes = reference_cell(name).nodes
    assert len(nodes) == CELL_TYPES[name].n_nodes
    np.testing.assert_allclose(shape_functions(name, nodes), np.eye(len(nodes)), atol=1e-11)


@together("name", CELLS)
def test_the_last_node_of_a_face_is_its_middle(name: str) -> None:
    nodes = reference_cell(name).nodes
    for face, local in CELL_TYPES[name].faces:
        if face in ("TRI7", "QUA9"):
            corners = nodes[list(local[:-1:2])]
            np.testing.assert_allclose(corners.mean(axis=0), nodes[local[-1]], atol=1e-15)


@together("name", EVERY)
def test_linear_functions_are_reproduced(name: str) -> None:
    nodes = reference_cell(name).nodes
    points = np.random.default_rng(4).dirichlet(np.ones(len(nodes)), size=9) @ nodes
    shapes = shape_functions(name, points)
    np.testing.assert_allclose(shapes.sum(axis=1), 1.0)
    np.testing.assert_allclose(shapes @ nodes, points, atol=1e-12)


@together("name", CELLS)
def test_quadratic_functions_are_reproduced(name: str) -> None:
    nodes = reference_cell(name).nodes
    points = np.random.default_rng(1).uniform(0.05, 0.3, (7, nodes.shape[1]))
    shapes = shape_functions(name, points)
    np.testing.assert_allclose(shapes.sum(axis=1), 1.0)
    np.testing.assert_allclose(shapes @ nodes, points)
    for powers in QUADRATIC[nodes.shape[1]]:
        expected = np.prod(points**powers, axis=1)
        np.testing.assert_allclose(shapes @ np.prod(nodes**powers, axis=1), expected, atol=1e-14)


@together("name", EVERY)
def test_gradients_are_those_of_finite_differences(name: str) -> None:
    dimension = reference_cell(name).nodes.shape[1]
    points = np.random.default_rng(2).uniform(0.05, 0.3, (5, dimension))
    step = 1e-6
    sides = (shape_functions(name, points + step * e) for e in np.eye(dimension))
    other = (shape_functions(name, points - step * e) for e in np.eye(dimension))
    slopes = [(a - b) / (2 * step) for a, b in zip(sides, other, strict=True)]
    # central differences: rounding of 1e-16 over the step
    np.testing.assert_allclose(shape_gradients(name, points), np.stack(slopes, 2), atol=1e-9)


def test_cells_without_functions_say_so() -> None:
    with pytest.raises(MeshError, match="no shape functions"):
        reference_cell("PY19")


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
            assert found == pytest.approx(exact(shape, powers), rel=1e-14, abs=1e-15), powers


@pytest.mark.parametrize("shape", ["quadrangle", "hexahedron"])
def test_two_points_a_direction_follow_the_corners(shape):
    rule = quadrature(shape, {"quadrangle": 4, "hexahedron": 8}[shape])
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / np.sqrt(3.0)
    np.testing.assert_allclose(rule.points[:4, :2], corners, atol=1e-15)
    if shape == "hexahedron":
        np.testing.assert_allclose(rule.points[4:, :2], corners, atol=1e-15)
        np.testing.assert_allclose(rule.points[[0, 4], 2], [-(3**-0.5), 3**-0.5], atol=1e-15)
