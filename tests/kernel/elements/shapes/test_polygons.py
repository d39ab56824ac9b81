"""Meshes of polygons and Wachspress' element on them."""

import numpy as np
import pytest
from script_runs import found
from together import together

from ssilang.kernel.elements.shapes.geometry import cell_geometry
from ssilang.kernel.elements.shapes.polygons import (
    SIDES,
    polygon_excess,
    polygon_functions,
    regular_polygon,
)
from ssilang.kernel.elements.shapes.quadrature import quadrature

PLATE = (
    "OPTI DIME 2 ELEM POLY MODE PLAN CONT ; A = 0. 0. ; B = 2. 0. ; C = 2. 1. ; D = 0. 1. ; "
    "L = (A DROI {n} B DROI {m} C DROI {n} D DROI {m} A) ; S = SURF L 'PLANE' ; "
)


@together("n", sorted(SIDES.values()))
def test_functions_are_positive_inside_and_the_excess_is_the_distance_beyond_a_side(n: int) -> None:
    corners = regular_polygon(n)
    inside = 0.6 * corners @ np.array([[0.8, 0.6], [-0.6, 0.8]]) + 0.1
    assert polygon_functions(n, inside).min() > 0.0
    middles = (corners + np.roll(corners, -1, axis=0)) / 2  # beyond one side by as much as inside
    across = np.linalg.norm(middles[0])
    for share in (0.0, 1.0, 1.7):
        excess = polygon_excess(n, share * middles)
        assert excess.max(axis=1) == pytest.approx((share - 1.0) * across, abs=1e-12)
    assert len({*polygon_excess(n, 1.7 * middles).argmax(axis=1)}) == n


@together("n", sorted(SIDES.values()))
def test_rules_have_the_area_the_centre_and_the_second_moments_of_a_polygon(n: int) -> None:
    corners = regular_polygon(n)
    after = np.roll(corners, -1, axis=0)
    areas = 0.5 * (corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0])
    sums = np.stack([corners, after, corners + after])
    moments = np.einsum("n,kni,knj->ij", areas / 12.0, sums, sums)
    for per_side in (1, 3, 7):
        rule = quadrature(f"polygon{n}", per_side * n)
        assert rule.weights.sum() == pytest.approx(areas.sum())
        assert rule.weights @ rule.points == pytest.approx(np.zeros(2), abs=1e-14)
        squares = np.einsum("p,pi,pj->ij", rule.weights, rule.points, rule.points)
        assert squares == pytest.approx(moments, abs=1e-14)
    one = quadrature(f"polygon{n}", 1)
    assert (*one.points[0], one.weights[0]) == pytest.approx((0.0, 0.0, areas.sum()))


def test_gauss_theorem_holds_in_a_crooked_polygon() -> None:
    """Area by the shoelace formula; the integral of a linear field's gradient times anything."""
    corners = regular_polygon(6) + 0.15 * np.random.default_rng(3).normal(size=(6, 2))
    x, y = corners.T
    area = 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    for turned in (corners, corners[::-1]):
        made = cell_geometry("POL6", turned[None], quadrature("polygon6", 6))
        assert made.volumes.sum() == pytest.approx(area, rel=1e-13)
        gradient = np.einsum("pdk,k->pd", made.gradients[0], turned @ [2.0, -3.0] + 1.0)
        assert gradient == pytest.approx(np.tile([2.0, -3.0], (6, 1)))
        # the mean gradient of one corner's function: half the opposite diagonal, turned
        mean = np.einsum("p,pd->d", made.volumes[0], made.gradients[0, :, :, 1])
        way = turned[2] - turned[0]
        sense = 1.0 if turned is corners else -1.0
        assert mean == pytest.approx(0.5 * sense * np.array([way[1], -way[0]]))


def test_polygons_fill_the_contour_and_keep_its_sides() -> None:
    area, sides, most, kinds, kept = found(
        PLATE.format(n=12, m=6)
        + "Q = MESU S ; C1 = CONT S ; N1 = NBEL C1 ; P1 = NBEL (C1 INTE L) ; "
        "H = NBEL (ELEM S 'POL6') ; T = ELEM S 'TYPE' ;",
        "Q", "N1", "H", "T", "P1",
    )  # fmt: skip
    assert area == pytest.approx(2.0)
    assert sides == kept == 36
    assert most > 10
    assert set(kinds.values) <= {"TRI3", *SIDES}


def test_constant_strains_are_exact_on_any_mesh_of_polygons() -> None:
    """Patch test: the rim moved by a linear field, all stresses those of the field."""
    stress, error = found(
        PLATE.format(n=9, m=5)
        + "MO = MODE S MECANIQUE ELASTIQUE POLY ; MA = MATE MO 'YOUN' 100. 'NU' 0.25 ; "
        "X Y = COOR S ; UL = (NOMC 'UX' ((0.01 * X) + (0.02 * Y))) ET "
        "(NOMC 'UY' ((-0.03 * X) + (0.005 * Y))) ; BL = BLOQ 'DEPL' L ; "
        "U = RESO ((RIGI MO MA) ET BL) (DEPI BL (REDU UL L)) ; "
        "SG = SIGM MO MA U ; XM = MAXI SG ; D = MAXI (ABS ((EXCO 'UX' U) - (EXCO 'UX' UL))) ; "
        "E1 = (MAXI (EXCO 'SMXX' SG)) - (MINI (EXCO 'SMXX' SG)) ;"
        "S1 = MAXI (EXCO 'SMXX' SG) ;",
        "S1", "E1",
    )  # fmt: skip
    assert stress == pytest.approx(100.0 / (1 - 0.25**2) * (0.01 + 0.25 * 0.005), rel=1e-10)
    assert abs(error) < 1e-11


def tip(n: int, m: int) -> float:
    """Strain energy of pure bending against the exact one: relative error."""
    energy = found(
        PLATE.format(n=n, m=m)
        + "MO = MODE S MECANIQUE ELASTIQUE POLY ; MA = MATE MO 'YOUN' 1. 'NU' 0.3 ; "
        "RI = RIGI MO MA ; X Y = COOR S ; Y = Y - 0.5 ; "
        "U = (NOMC 'UX' (-1. * X * Y)) ET (NOMC 'UY' ((0.5 * X * X) + (0.15 * Y * Y))) ; "
        "BL = BLOQ 'DEPL' L ; V = RESO (RI ET BL) (DEPI BL (REDU U L)) ; "
        "SG = SIGM MO MA V ; W = ENER MO SG (EPSI MO V) ; E1 = 0.5 * (INTG MO W) ;",
        "E1",
    )
    return abs(energy / (0.5 * 2.0 / 12.0) - 1.0)


def test_bending_converges_with_the_square_of_the_size() -> None:
    coarse, fine = tip(8, 4), tip(32, 16)
    assert fine < 2e-2
    assert fine < coarse / 9.0
    assert tip(16, 8) < coarse / 2.5
