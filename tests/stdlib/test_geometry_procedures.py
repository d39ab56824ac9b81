"""@CDG @TOTAL @HELICE @CIRCONS BOITE MOYESPEC @STAT FZERO QUADRATU CONVT PECHE: closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import found, ran
from together import together

_HELIX = "OPTI DIME 3 ELEM {element} ; P0 = 0. 0. 0. ; VZ = 0. 0. 3. ; PA = 1. 0. 0. ; "


@together("turns, count", [(1.0, 40), (0.5, 30)])
def test_helix_of_a_point_has_its_length_and_end(turns, count):
    script = _HELIX.format(element="SEG2") + (
        f"P2 L2 = @HELICE PA 'POIN' P0 VZ 0.5 {360 * turns} {count} ; "
        "X = MESU L2 ; A B C = COOR P2 ; N = NBEL L2 ;"
    )
    length, a, b, c, n = found(script, "X", "A", "B", "C", "N")
    chord = 2 * math.sin(math.pi * turns / count)
    assert n == count
    assert length == pytest.approx(count * math.hypot(chord, 0.5 * turns / count), rel=1e-9)
    assert (a, b, c) == pytest.approx((math.cos(2 * math.pi * turns), 0.0, 0.5 * turns), abs=1e-9)


@settings(max_examples=25, deadline=None)
@given(st.floats(-0.4, 1.4), st.floats(-0.4, 1.4))
def test_inside_of_a_folded_contour_agrees_with_its_formula(x, y):
    """An L: the unit square without its upper right quarter."""
    near = min(abs(x), abs(y), abs(x - 1), abs(y - 1), abs(x - 0.5), abs(y - 0.5)) < 1e-6
    if near:
        return
    inside = (0 < x < 1 and 0 < y < 1) and not (x > 0.5 and y > 0.5)
    answer = found(
        "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; C = PA DROI 2 (1. 0.) DROI 2 (1. 0.5) DROI 2 "
        f"(0.5 0.5) DROI 1 (0.5 1.) DROI 1 (0. 1.) DROI 1 PA ; R = DEDANS ({x:.9f} {y:.9f}) C ;",
        "R",
    )
    assert bool(answer) == inside


def test_circle_and_sphere_are_as_far_from_all_corners():
    x, y, r = found(
        "OPTI DIME 2 ; T = MANU 'TRI3' (0. 0.) (2. 1.) (-1. 3.) ; P R = @CIRCONS T ; "
        "X Y = COOR P ;",
        "X", "Y", "R",
    )  # fmt: skip
    distances = [math.hypot(x - a, y - b) for a, b in ((0, 0), (2, 1), (-1, 3))]
    assert np.allclose(distances, r, rtol=1e-12)
    *centre, radius = found(
        "OPTI DIME 3 ; T = MANU 'TET4' (0. 0. 0.) (2. 1. 0.) (-1. 3. 0.5) (0. 0.5 4.) ; "
        "P R = @CIRCONS T ; X Y Z = COOR P ;",
        "X", "Y", "Z", "R",
    )  # fmt: skip
    corners = np.array([(0, 0, 0), (2, 1, 0), (-1, 3, 0.5), (0, 0.5, 4)])
    assert np.allclose(np.linalg.norm(corners - centre, axis=1), radius, rtol=1e-12)


def test_regression_line_is_that_of_least_squares():
    x, y = np.array([0, 1.85, 4.65, 7, 10, 11]), np.array([2.25, 2.0, 1.75, 1.4, 1.0, 0.8])
    lists = [" ".join(repr(float(v)) for v in values) for values in (x, y)]
    values = found(
        f"XM EX YM EY A B R = @STAT (PROG {lists[0]}) (PROG {lists[1]}) ;",
        "XM", "EX", "YM", "EY", "A", "B", "R",
    )  # fmt: skip
    slope, level = np.polyfit(x, y, 1)
    expected = (x.mean(), x.std(), y.mean(), y.std(), slope, level, np.corrcoef(x, y)[0, 1])
    assert values == pytest.approx(expected, rel=1e-10)


@together("count", range(21))
def test_palette_has_different_colours_that_the_picture_knows(count):
    colours = [str(c).strip() for c in found(f"L = @PALETTE {count} ;", "L").values]
    assert len(set(colours)) == len(colours) == count


def test_field_values_follow_the_mesh():
    script = "OPTI DIME 2 ELEM SEG2 ; L = (0. 0.) DROI 4 (2. 0.) ; K = L ELEM (LECT 1 2) ; "
    script += "A = CHPR0 ((COOR 1 K) + 1.) (INVE L) ;"
    assert list(found(script, "A").values) in ([1.0, 1.5, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 1.5, 1.0])


def test_curve_goes_to_a_file_of_two_columns(tmp_path):
    result = ran(
        "E = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 1. 4.) ; @EXCEL1 E 'curve.csv' ; MESS 'after' ;",
        output_directory=tmp_path,
    )
    assert result.output.split()[-1] == "after"
    lines = next(tmp_path.rglob("curve.csv")).read_text().split("\n")
    rows = [[float(v) for v in line.split(";")] for line in lines if line.strip()]
    assert rows == [[0.0, 0.0], [1.0, 1.0], [2.0, 4.0]]
