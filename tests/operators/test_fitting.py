"""Functions through data and best points that are known: MOCA LEVM GANE, NUAG, EXCE."""

import numpy as np
import pytest
from script_runs import prog

from ssilang.kernel.curves.cloud import inverse_distance, moving_plane, on_grid

X = np.array([0.0, 0.5, 1.5, 2.0, 3.5])
Y = np.array([1.2, 0.7, 2.9, 3.1, 6.4])
W = np.array([1.0, 3.0, 0.5, 2.0, 1.0])


def test_moca_is_the_weighted_least_squares_whatever_the_first_parameters(found):
    script = (
        f"X = {prog(X)} ; Y = {prog(Y)} ; U = PROG 5*1. ; "
        f"P = MOCA (PROG 7. -2.) Y ((7. * U) - (2. * X)) U X 'POIDS' {prog(W)} ; "
        "Q = MOCA (PROG 0. 0.) Y (0. * X) U X ;"
    )
    J = np.column_stack([np.ones(5), X])
    weighed = np.linalg.lstsq(W[:, None] * J, W * Y, rcond=None)[0]
    assert found(script, "P").values == pytest.approx(weighed)
    assert found(script, "Q").values == pytest.approx(np.linalg.lstsq(J, Y, rcond=None)[0])


DECAY = (
    "DEBP FCT X1*LISTREEL P1*LISTREEL ; A1 = EXTR P1 1 ; B1 = EXTR P1 2 ; "
    "E1 = EXP (B1 * X1) ; Y1 = A1 * E1 ; D1 = PROG ; N1 = DIME X1 ; "
    "REPE B N1 ; D1 = D1 ET (PROG (EXTR E1 &B) ((EXTR X1 &B) * (EXTR Y1 &B))) ; FIN B ; "
    "FINP Y1 D1 ; "
)


def test_levm_finds_the_parameters_that_made_the_points(found):
    points = prog(2.5 * np.exp(-0.8 * X))
    script = DECAY + (
        f"P C = LEVM 'ABSC' {prog(X)} 'ORDO' {points} 'SIGM' {prog(W)} "
        "'PARA' (PROG 1. -0.1) 'PROC' FCT ;"
    )
    assert found(script, "P").values == pytest.approx([2.5, -0.8], rel=1e-6)
    assert found(script, "C") == pytest.approx(0.0, abs=1e-12)


def test_levm_gives_the_least_sum_of_noisy_points(found):
    from scipy.optimize import least_squares

    script = DECAY + (
        f"P C = LEVM 'PROC' FCT 'PARA' (PROG 1. 0.3) 'ABSC' {prog(X)} 'SIGM' {prog(W)} "
        f"'ORDO' {prog(Y)} ;"
    )
    best = least_squares(lambda p: W * (p[0] * np.exp(p[1] * X) - Y), [1.0, 0.3], xtol=1e-14)
    assert found(script, "P").values == pytest.approx(best.x, rel=1e-4)
    assert found(script, "C") == pytest.approx(2.0 * best.cost, rel=1e-8)


@pytest.mark.parametrize("damping", [0.0, 0.7])
def test_gane_solves_the_normal_equations(found, damping):
    script = (
        f"T = TABL 'VECTEUR' ; T . 0 = {prog(Y)} ; T . 1 = {prog(X)} ; T . 2 = {prog(W)} ; "
        f"H = GANE T 'AMOR' {damping} ; A = H . 1 ; B = H . 2 ; S = EGA H . 'SOUSTYPE' 'VECTEUR' ;"
    )
    J = np.column_stack([X, W])
    step = np.linalg.solve(J.T @ J + damping * np.eye(2), -J.T @ Y)
    assert [found(script, "A"), found(script, "B")] == pytest.approx(step)
    assert found(script, "S")


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


# Svanberg's cantilever of five hollow sections (1987): lightest under a bound of the deflection
CANTILEVER = """
LC1 = PROG 61. 37. 19. 7. 1. ; T = TABL ; T . 'METHODE' = MOT '{method}' ;
T . 'VXMIN' = TABL ; T . 'VXMAX' = TABL ; T . 'VX0' = TABL ; T . 'VCMAX' = TABL ;
T . 'VCMAX' . 1 = 1. ;
REPE A 5 ; T . 'VXMIN' . &A = 1. ; T . 'VXMAX' . &A = 10. ; T . 'VX0' . &A = {start} ; FIN A ;
REPE B 25 ;
  F1 = TABL 'VECTEUR' ; C1 = TABL 'VECTEUR' ; S1 = 0. ; D1 = 0. ;
  REPE C 5 ; X1 = T . 'VX0' . &C ; K1 = EXTR LC1 &C ; S1 = S1 + (0.0624 * X1) ;
    D1 = D1 + (K1 / (X1 ** 3)) ; F1 . &C = 0.0624 ; C1 . &C = -3. * K1 / (X1 ** 4) ; FIN C ;
  F1 . 0 = S1 ; C1 . 0 = D1 ; T . 'VF' = F1 ; T . 'MC' = TABL ; T . 'MC' . 1 = C1 ;
  T = EXCE T ;
FIN B ;
V1 = T . 'VX0' ; L1 = PROG (V1 . 1) (V1 . 2) (V1 . 3) (V1 . 4) (V1 . 5) ;
"""


@pytest.mark.parametrize("method", ["STA", "MOV"])
@pytest.mark.parametrize("start", [5.0, 2.0], ids=["holds", "misses the bound"])
def test_the_lightest_cantilever_is_found(found, method, start):
    sizes = found(CANTILEVER.format(method=method, start=start), "L1").values
    assert sizes == pytest.approx([6.016, 5.309, 4.494, 3.502, 2.153], abs=2e-3)
    assert 0.0624 * sizes.sum() == pytest.approx(1.340, abs=1e-3)


def test_moving_asymptotes_begin_at_those_of_t0(found):
    """Between 0 and 50 the half range around 5 leads to 0, where the deflection has no bound."""
    script = CANTILEVER.format(method="MOV", start=5.0).replace(
        "= 1. ; T . 'VXMAX' . &A = 10.", "= 0. ; T . 'VXMAX' . &A = 50."
    )
    sizes = found(
        script.replace("T . 'VXMIN' = TABL", "T . 'T0' = 2. / 3. ; T . 'VXMIN' = TABL"), "L1"
    ).values
    assert sizes == pytest.approx([6.016, 5.309, 4.494, 3.502, 2.153], abs=2e-3)
