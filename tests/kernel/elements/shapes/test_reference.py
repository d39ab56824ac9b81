"""Shape functions of every cell: one at their node, what they reproduce, true gradients."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import MeshError
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


def test_faces_of_the_pyramid_have_the_functions_of_their_cells() -> None:
    # a neighbour sees the same values on the common face: QUA8 below, TRI6 beside
    points = np.random.default_rng(3).uniform(0.0, 0.5, (6, 2))
    base = np.column_stack([points, np.zeros(6)])
    expected = shape_functions("QUA8", points)
    np.testing.assert_allclose(shape_functions("PY13", base)[:, :8], expected, atol=1e-14)
    np.testing.assert_allclose(shape_functions("PY13", base)[:, 8:], 0.0, atol=1e-14)
    local = list(CELL_TYPES["PY13"].faces[1][1])
    corners = reference_cell("PY13").nodes[local[::2]]
    s, t = points.T
    side = corners[0] + np.outer(s, corners[1] - corners[0]) + np.outer(t, corners[2] - corners[0])
    found = shape_functions("PY13", side)
    np.testing.assert_allclose(found[:, local], shape_functions("TRI6", points), atol=1e-13)
    assert np.abs(np.delete(found, local, axis=1)).max() < 1e-13


def test_cells_without_functions_say_so() -> None:
    with pytest.raises(MeshError, match="no shape functions"):
        reference_cell("PY19")
