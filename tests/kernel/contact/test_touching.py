"""Noses of projectiles: gaps and normals against points laid densely on their outline."""

import numpy as np
from together import together

from ssilang.kernel.contact.touching import Nose


def outline(shape, size, angle):
    """Points of a nose whose foremost one is the origin, out of it along x."""
    s = np.linspace(-1.0, 1.0, 20001)
    if shape == "HEMI":
        return size * np.column_stack([np.cos(1.5 * s) - 1.0, np.sin(1.5 * s)])
    y = 0.5 * size * s
    return np.column_stack([-np.abs(y) / np.tan(angle) if shape == "CONE" else 0.0 * y, y])


@together("shape, angle", [("HEMI", 0.0), ("PLAT", 0.0), ("CONE", 0.5)])
def test_gaps_and_normals_are_those_of_the_nearest_point_of_the_outline(shape, angle):
    """Turned, seen from both sides of its axis and of its outline."""
    size, turn = 2.0, 0.7
    to = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    places = np.array([[0.1, 0.3], [-0.1, -0.4], [-0.45, 0.35], [0.05, -0.6]])
    ways = places[:, None] - outline(shape, size, angle)
    way = ways[np.arange(4), np.linalg.norm(ways, axis=2).argmin(axis=1)]
    x, y = places.T
    inner = {"HEMI": np.hypot(x + size, y) < size, "PLAT": x < 0.0,
             "CONE": x < -np.abs(y) / np.tan(angle or 1.0)}[shape]  # fmt: skip
    signs = np.where(inner, -1.0, 1.0)
    normals, gaps = Nose(shape, to[:, 0], size, angle).touched(places @ to.T)
    np.testing.assert_allclose(gaps, signs * np.hypot(*way.T), atol=1e-6)
    np.testing.assert_allclose(normals * gaps[:, None], way @ to.T, atol=2e-4)
    far = np.array([[-0.1, 1.3], [-3.0, 0.1]])[: 1 + (shape == "HEMI")]
    beside = np.isinf(Nose(shape, to[:, 0], size, angle).touched(far @ to.T)[1])
    assert beside.tolist() == ([False, True] if shape == "HEMI" else [True])
