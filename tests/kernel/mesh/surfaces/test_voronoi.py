"""Voronoi partitions: areas against sampling and closed forms, Euler's relation."""

import numpy as np
import pytest
from scipy.spatial import cKDTree
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.surfaces.voronoi import OUTSIDE, voronoi_partition

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
ANGLE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]])


def ring(n):
    return np.column_stack([np.arange(n), np.roll(np.arange(n), -1)])


def areas(partition, n):
    a, b = partition.points[partition.edges.T]
    halves = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    made = np.zeros(n)
    for column, sign in ((0, 1.0), (1, -1.0)):
        owner = partition.owners[:, column]
        np.add.at(made, owner[owner != OUTSIDE], sign * halves[owner != OUTSIDE])
    return made


@together("n", [1, 2, 5, 60])
def test_cells_hold_what_is_nearest_to_their_germ(n):
    rng = np.random.default_rng(3)
    germs = rng.random((n, 2))
    partition = voronoi_partition(germs, np.zeros(n), SQUARE, ring(4))
    counted = np.bincount(cKDTree(germs).query(rng.random((100_000, 2)))[1], minlength=n) / 1e5
    np.testing.assert_allclose(areas(partition, n), counted, atol=5e-3)
    assert len(partition.points) - len(partition.edges) + n == 1


def test_a_contour_in_the_other_sense_and_not_convex_is_filled_by_the_cells():
    germs = np.random.default_rng(1).random((40, 2))
    partition = voronoi_partition(germs, np.zeros(40), ANGLE, ring(6)[:, ::-1])
    assert areas(partition, 40).sum() == pytest.approx(3.0, rel=1e-12)
    assert len(partition.points) - len(partition.edges) + 40 == 1


def test_a_grid_of_germs_gives_its_squares():
    x = np.arange(0.05, 1.0, 0.1)
    germs = np.stack(np.meshgrid(x, x), axis=-1).reshape(-1, 2)
    partition = voronoi_partition(germs, np.zeros(100), SQUARE, ring(4))
    np.testing.assert_allclose(areas(partition, 100), 0.01, rtol=1e-10)
    assert (len(partition.points), len(partition.edges)) == (121, 220)


def test_a_weight_moves_the_edge_by_the_difference_of_squares_over_twice_the_distance():
    germs = np.array([[0.3, 0.5], [0.7, 0.5]])
    partition = voronoi_partition(germs, np.array([0.3, 0.1]), SQUARE, ring(4))
    place = 0.5 + (0.3**2 - 0.1**2) / (2 * 0.4)
    np.testing.assert_allclose(areas(partition, 2), [place, 1 - place], rtol=1e-12)


@together("n", [2, 30])
@together("size, shift", [(1.0, 1e4), (1e8, -7.0), (1e-3, 0.2)])
def test_cells_of_any_size_and_far_from_the_origin_keep_their_digits(n, size, shift):
    germs = np.random.default_rng(2).random((n, 2))
    near = voronoi_partition(germs, np.zeros(n), SQUARE, ring(4))
    far = voronoi_partition(size * germs + shift, np.zeros(n), size * SQUARE + shift, ring(4))
    moved = type(far)((far.points - shift) / size, far.edges, far.owners)
    np.testing.assert_allclose(areas(moved, n), areas(near, n), rtol=1e-7)
    assert (len(far.points), len(far.edges)) == (len(near.points), len(near.edges))


@together(
    "germs, weights, told",
    [
        ([[0.5, 0.5], [1.5, 0.5]], [0.0, 0.0], "outside"),
        ([[0.5, 0.5], [0.5, 0.5]], [0.0, 0.0], "same place"),
        ([[0.5, 0.5], [0.5, 0.5 + 5e-10]], [0.0, 0.0], "same place"),
        ([[0.4, 0.5], [0.6, 0.5]], [0.5, 0.0], "differ by too much"),
    ],
)
def test_germs_that_have_no_cell_are_refused(germs, weights, told):
    with pytest.raises(MeshError, match=told):
        voronoi_partition(np.array(germs), np.array(weights), SQUARE, ring(4))
