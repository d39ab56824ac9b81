"""Triangles cut into bands: areas and lines against closed forms; titles as matplotlib's text."""

import numpy as np
import pytest
from together import together

from ssilang.io.plots.bands import choose_levels, cut_bands, cut_lines
from ssilang.io.plots.markup import LONGEST, to_mathtext


def areas(polygons: np.ndarray) -> np.ndarray:
    x, y = polygons[..., 0], polygons[..., 1]
    return 0.5 * np.abs(np.sum(x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1))


def test_bands_fill_each_triangle() -> None:
    rng = np.random.default_rng(3)
    points, values = rng.normal(size=(50, 3, 2)), rng.normal(size=(50, 3))
    polygons, owner, _ = cut_bands(points, values, np.linspace(-2, 2, 9))
    total = np.bincount(owner, areas(polygons), minlength=50)
    assert np.allclose(total, areas(points))


def test_area_of_a_band_of_a_linear_field() -> None:
    # value x on the unit right triangle: the part x < a has the area a - a^2/2
    points, values = np.array([[(0.0, 0), (1, 0), (0, 1)]]), np.array([[0.0, 1, 0]])
    polygons, _, band = cut_bands(points, values, np.array([0.0, 0.25, 0.5, 1.0]))
    found = np.bincount(band, areas(polygons))
    below = [a - a * a / 2 for a in (0.25, 0.5, 1.0)]
    assert np.allclose(found, np.diff([0.0, *below]))


def test_iso_line_lies_on_its_level() -> None:
    points, values = np.array([[(0.0, 0), (2, 0), (0, 2)]]), np.array([[0.0, 2.0, 2.0]])
    lines, _, level = cut_lines(points, values, np.array([0.5, 1.0, 3.0]))
    assert list(level) == [0, 1]
    assert np.allclose(lines.sum(axis=2), np.array([[0.5, 0.5], [1.0, 1.0]]))


def test_a_uniform_triangle_is_one_band_and_has_no_line() -> None:
    points, values = np.array([[(0.0, 0), (1, 0), (0, 1)]]), np.full((1, 3), 0.7)
    polygons, _, band = cut_bands(points, values, np.array([0.0, 0.5, 1.0]))
    assert list(band) == [1]
    assert areas(polygons)[0] == pytest.approx(0.5)
    assert len(cut_lines(points, values, np.array([0.0, 0.5, 1.0]))[0]) == 0


def test_levels_are_round_numbers_next_to_the_extremes() -> None:
    bounds = choose_levels(np.array([0.13, 0.87, np.nan])).bounds
    assert bounds[0] <= 0.13 < bounds[1]
    assert bounds[-2] < 0.87 <= bounds[-1]
    assert np.allclose(bounds * 100, np.round(bounds * 100))


def test_number_of_levels_and_levels_by_hand() -> None:
    values = np.array([-1.0, 3.0])
    assert np.allclose(choose_levels(values, 4).bounds, [-1, 0, 1, 2, 3])
    # values beyond the levels given have bands of their own
    assert np.allclose(choose_levels(values, None, np.array([0.0, 2.0])).bounds, [-1, 0, 2, 3])


@together("size", [1.0, 2e-6, 3e7])
def test_colours_of_both_signs_meet_at_white(size: float) -> None:
    levels = choose_levels(size * np.array([-1.0, 1.0]), 20)
    blue, middle, red = levels.rgba(size * np.array([-0.99, 0.01, 0.99]))
    assert blue[2] > blue[0] + 0.2
    assert red[0] > red[2] + 0.2
    assert middle[:3].min() > 0.9


def test_one_value_is_one_band() -> None:
    assert len(choose_levels(np.full(5, 2.0)).bounds) == 2


@together(
    "written, drawn",
    [
        ("plain $ text", r"plain \$ text"),
        (r"\a and \W", "α and Ω"),
        ("u_{i}", r"u$\mathregular{{}_{i}}$"),
        ("x" * LONGEST, "x" * LONGEST),
        ("x" * 300_000, "x" * (LONGEST - 1) + "…"),
    ],
)
def test_a_text_is_drawn_with_its_scripts_as_far_as_there_is_room(written, drawn):
    assert to_mathtext(written) == drawn
