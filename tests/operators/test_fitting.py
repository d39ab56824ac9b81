"""MOCA LEVM GANE against numpy's least squares and functions whose parameters are known."""

import numpy as np
import pytest
from script_runs import prog

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
