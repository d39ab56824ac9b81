"""Shape functions of every cell: one at their node, constants and slopes met, gradients true."""

import numpy as np
import pytest

from ssilang.kernel.elements.shapes.reference import (
    REFERENCE_CELLS,
    shape_functions,
    shape_gradients,
)

CELLS = sorted(name for name, cell in REFERENCE_CELLS.items() if cell.nodes.shape[1])
RNG = np.random.default_rng(11)


def points_inside(name: str) -> np.ndarray:
    """Points (20, dim) inside the cell, away from the tip of a pyramid."""
    nodes = REFERENCE_CELLS[name].nodes
    shares = RNG.dirichlet(np.ones(len(nodes)), size=20)
    return shares @ nodes


@pytest.mark.parametrize("name", CELLS)
def test_gradients_are_those_of_the_functions(name):
    points, h = points_inside(name), 1e-5
    found = shape_gradients(name, points)
    for axis in range(points.shape[1]):
        step = h * np.eye(points.shape[1])[axis]
        difference = (
            shape_functions(name, points + step) - shape_functions(name, points - step)
        ) / (2 * h)
        slopes = found[:, axis] if found.shape[1] == points.shape[1] else found[:, :, axis]
        np.testing.assert_allclose(slopes, difference, atol=2e-8)


@pytest.mark.parametrize("name", CELLS)
def test_functions_are_one_at_their_node_and_zero_at_the_others(name):
    nodes = REFERENCE_CELLS[name].nodes
    np.testing.assert_allclose(shape_functions(name, nodes), np.eye(len(nodes)), atol=1e-11)


@pytest.mark.parametrize("name", CELLS)
def test_linear_fields_are_met(name):
    nodes, points = REFERENCE_CELLS[name].nodes, points_inside(name)
    slopes = RNG.uniform(-1, 1, nodes.shape[1])
    np.testing.assert_allclose(
        shape_functions(name, points) @ (2.0 + nodes @ slopes), 2.0 + points @ slopes, atol=1e-12
    )
