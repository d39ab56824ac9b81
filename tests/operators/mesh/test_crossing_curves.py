"""INTE of two simple surfaces: circles, ellipses and a curve of Viviani, against their lengths."""

import numpy as np
import pytest
from scipy.special import ellipe, ellipeinc
from script_runs import found

SPACE = "OPTI DIME 3 ELEM SEG2 ; A = 1. 0. 0. ; B = 0. 1. 0. ; "


def line(text):
    mesh = found(SPACE + text, "L")
    block = mesh.blocks[0]
    chain = np.append(block.connectivity[:, 0], block.connectivity[-1, -1])
    return mesh.nodes.coordinates[chain]


def length(x):
    return np.linalg.norm(np.diff(x, axis=0), axis=1).sum()


QUARTERS = {
    "cylinder": "'CYLI' (0. 0. -1.) (0. 0. 1.)",
    "sphere": "'SPHE' (0. 0. 0.)",
    "cone": "'CONI' (0. 0. 3.) (0. 0. 0.)",
    "torus": "'TORI' (0. 0. 0.) (0. 0. 1.) (2. 0. 0.)",
}


@pytest.mark.parametrize("surface", QUARTERS)
def test_a_plane_across_the_axis_gives_equal_pieces_of_a_circle(surface):
    x = line(f"L = A INTE 12 {QUARTERS[surface]} 'PLAN' (-1. 0. 0.) B ;")
    np.testing.assert_allclose(np.linalg.norm(x, axis=1), 1.0, atol=1e-9)
    turned = np.arctan2(x[:, 1], x[:, 0])
    np.testing.assert_allclose(turned, np.linspace(0, np.pi / 2, 13), atol=1e-6)
    np.testing.assert_allclose(x[:, 2], 0.0, atol=1e-12)


def test_a_slanted_plane_cuts_an_ellipse_out_of_a_cylinder():
    x = line(
        "P = 1. 0. 1. ; Q = 0. 1. 0. ; L = P INTE 400 'CYLI' (0. 0. -1.) (0. 0. 1.) "
        "'PLAN' (-1. 0. -1.) Q ;"
    )
    np.testing.assert_allclose(np.hypot(x[:, 0], x[:, 1]), 1.0, atol=1e-9)
    np.testing.assert_allclose(x[:, 2], x[:, 0], atol=1e-9)
    assert length(x) == pytest.approx(2**0.5 * ellipe(0.5), rel=1e-5)


def test_sphere_and_cylinder_give_the_curve_of_viviani():
    """Sphere of radius 2, cylinder of radius 1 through its centre and its equator."""
    x = line(
        "P = 0. 0. 2. ; Q = 2. 0. 0. ; R = (2.**0.5) ; P = 1. 1. R ; "
        "L = P INTE 300 'SPHE' (0. 0. 0.) 'CYLI' (1. 0. 0.) (1. 0. 1.) 'LONG' 1. Q ;"
    )
    assert np.linalg.norm(x, axis=1) == pytest.approx(2.0, abs=1e-9)
    assert np.hypot(x[:, 0] - 1, x[:, 1]) == pytest.approx(1.0, abs=1e-9)
    # x = 1 + cos t, y = sin t, z = 2 sin(t/2); from t = pi/2 down
    t = 2 * np.arcsin(x[-1, 2] / 2)
    truth = 2**0.5 * 2 * (ellipeinc(np.pi / 4, 0.5) - ellipeinc(t / 2, 0.5))
    assert truth == pytest.approx(1.0, rel=1e-4)


def test_the_shorter_way_is_taken_and_length_goes_on_past_the_end():
    x = line("L = A INTE 50 'LONG' 3. 'SPHE' (0. 0. 0.) 'PLAN' (-1. 0. 0.) B ;")
    assert np.arctan2(x[-1, 1], x[-1, 0]) == pytest.approx(3.0, abs=1e-4)


def test_sizes_grade_the_curve_and_lines_are_continued():
    text = "L = A INTE 'DINI' 0.02 'DFIN' 0.2 'SPHE' (0. 0. 0.) 'PLAN' (-1. 0. 0.) B ;"
    steps = np.linalg.norm(np.diff(line(text), axis=0), axis=1)
    assert steps[0] == pytest.approx(0.02, rel=0.3)
    assert steps[-1] == pytest.approx(0.2, rel=0.3)
    closed = line("K = (-1. 0. 0.) DROI 4 A ; L = K INTE 20 'SPHE' (0. 0. 0.) 'PLAN' (0. 2. 0.) ; ")
    assert length(closed) > 4.9
    np.testing.assert_allclose(closed[0], closed[-1])
