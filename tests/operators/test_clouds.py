"""NUAG, its parts, and functions through clouds."""

import numpy as np
import pytest

from ssilang.kernel.curves.cloud import inverse_distance, moving_plane, on_grid

CLOUD = "N = NUAG 'COMP' 'X' 0. 1. 2. 'COMP' 'Y' 5. 9. 6. ; "


def test_both_ways_to_write_a_cloud_give_the_same(found):
    a, b = found(CLOUD + "M = NUAG 'X'*'FLOTTANT' 'Y'*'FLOTTANT' 0. 5. 1. 9. 2. 6. ;", "N", "M")
    assert a.columns == b.columns


def test_moving_plane_reproduces_a_plane_and_shepard_a_constant():
    points = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1], [0.4, 0.7]])
    at = np.array([[0.3, 0.2], [0.9, 0.8]])
    plane = (1 + 2 * points[:, 0] - 3 * points[:, 1])[:, None]
    for gaussian in (True, False):
        made = moving_plane(points, plane, at, gaussian)
        np.testing.assert_allclose(made[:, 0], 1 + 2 * at[:, 0] - 3 * at[:, 1], rtol=1e-12)
    assert inverse_distance(points, 0 * plane + 7, at, 2.0, 0.0) == pytest.approx(7.0)
    np.testing.assert_allclose(inverse_distance(points, plane, points, 1.0, 0.0), plane)


def test_grid_of_three_axes_is_linear_in_each():
    axes = [np.array([0.0, 1, 3]), np.array([0.0, 2]), np.array([-1.0, 0, 4])]
    x, y, z = np.meshgrid(*axes, indexing="ij")
    values = (x + 2 * y - z + x * y * z).ravel(order="F")
    at = np.array([[0.5, 1.0, -0.5], [2.0, 0.3, 3.0]])
    # trilinear interpolation is exact for x y z inside each cell
    expected = at[:, 0] + 2 * at[:, 1] - at[:, 2] + at.prod(axis=1)
    np.testing.assert_allclose(on_grid(axes, values, at), expected, rtol=1e-12)


def test_clouds_are_joined_row_by_row(found, refused):
    more = CLOUD + "M = NUAG 'COMP' 'Y' 7. 'COMP' 'X' 4. ; "
    assert found(more + "J = N ET M ;", "J").columns == {"X": (0, 1, 2, 4), "Y": (5, 9, 6, 7)}
    assert found(more + "J = (VIDE 'NUAGE') ET N ;", "J").columns == found(CLOUD, "N").columns
    assert "X Y and Z" in refused(CLOUD + "J = N «ET» (NUAG 'COMP' 'Z' 7.) ;")
