"""INDI REFE, ENVE of spectra, SEIS and SIGS against closed forms."""

import numpy as np
import pytest

TRI = "OPTI DIME 2 ELEM TRI3 ; "
MODE = (
    "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L = DROI 8 (0. 0.) (2. 0.) ; "
    "MO = MODE L MECANIQUE ELASTIQUE BARR ; "
    "MA = MATE MO 'YOUN' 4. 'NU' 0. 'SECT' 3. 'RHO' 1. ; "
    "K = (RIGI MO MA) ET (BLOQ 'UX' (L POIN 'INIT')) ET (BLOQ 'UY' L) ; "
    "B = VIBR 'SIMU' 0.1 2 K (MASS MO MA) ; "
)


def test_equilateral_cells_are_the_best(found):
    height = 3**0.5 / 2
    a, s, a3, s3 = found(
        f"{TRI} T = MANU 'TRI3' (0. 0.) (1. 0.) (0.5 {height!r}) ; I = INDI T 'ASPE' 'SKEW' ; "
        "A = MAXI (EXCO I 'ASPE') ; S = MAXI (EXCO I 'SKEW') ; OPTI DIME 3 ; "
        "V = MANU 'TET4' (1. 1. 1.) (1. -1. -1.) (-1. 1. -1.) (-1. -1. 1.) ; "
        "J = INDI V 'SKEW' 'ASPE' ; A3 = MAXI (EXCO J 'ASPE') ; S3 = MAXI (EXCO J 'SKEW') ; ",
        "A", "S", "A3", "S3",
    )  # fmt: skip
    assert (a, a3) == pytest.approx((1.0, 1.0))
    assert (s, s3) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_right_triangle(found):
    a, s = found(
        TRI + "I = INDI (MANU 'TRI3' (0. 0.) (1. 0.) (0. 1.)) 'ASPE' 'SKEW' ; "
        "A = MAXI (EXCO I 'ASPE') ; S = MAXI (EXCO I 'SKEW') ;",
        "A", "S",
    )  # fmt: skip
    # longest edge sqrt 2, shortest height 1 / sqrt 2; circle of radius 1 / sqrt 2
    assert a == pytest.approx(np.sqrt(3))
    assert s == pytest.approx(1 - 0.5 / (3 * np.sqrt(3) / 4 * 0.5))


def test_folded_quadrangle(found):
    x, y = found(
        "OPTI DIME 3 ELEM QUA4 ; A = MANU 'QUA4' (0. 0. 0.) (1. 0. 0.) (1. 1. 0.) (0. 1. 0.) ; "
        "B = MANU 'QUA4' (0. 0. 0.) (1. 0. 0.) (0.5 0.5 1.E6) (0. 1. 0.) ; "
        "X = MAXI (INDI A 'PLAN') ; Y = MAXI (INDI B 'PLAN') ;",
        "X", "Y",
    )  # fmt: skip
    assert x == 100.0
    assert y == pytest.approx(50.0, abs=1e-3)  # folded by a right angle


def test_meshes_within_another(found):
    script = (
        "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; L1 = DROI 2 A (1. 0.) ; L2 = DROI 2 A (0. 1.) ; "
        "L3 = L1 ET L2 ; N = REFE L3 ; X = L1 REFE L3 ; Y = L1 REFE L2 ;"
    )
    names, x, y = found(script, "N", "X", "Y")
    assert [str(n) for n in names.values] == ["L1", "L2"]
    assert (x, y) == (True, False)


def test_envelope_of_spectra(found):
    script = (
        "T = TABL ; T . 1 = TABL ; T . 2 = TABL ; "
        "T . 1 . 'SPECTRE' = EVOL 'MANU' (PROG 1. 2. 3.) (PROG 1. 5. 1.) ; "
        "T . 1 . 'AMORTISSEMENT' = PROG 0.05 ; "
        "T . 2 . 'SPECTRE' = (EVOL 'MANU' (PROG 1. 3. 4.) (PROG 2. 2. 2.)) ET "
        "(EVOL 'MANU' (PROG 1. 3.) (PROG 9. 9.)) ; T . 2 . 'AMORTISSEMENT' = PROG 0.05 0.02 ; "
        "E = ENVE T ; S = E . 'SPECTRE' ; A = E . 'AMORTISSEMENT' ; "
    )
    s, a = found(script, "S", "A")
    assert a.values.tolist() == [0.02, 0.05]
    np.testing.assert_allclose(s.parts[0].ordinates, [9, 9])
    np.testing.assert_allclose(s.parts[1].abscissas, [1, 2, 3, 4])
    np.testing.assert_allclose(s.parts[1].ordinates, [2, 5, 2, 2])


def test_seismic_load_of_modes(found):
    script = MODE + (
        "E = EVOL 'MANU' (PROG 0. 1.) (PROG 0. 2.) ; C = SEIS E B 3. 'UX' ; "
        "F = TIRE C 0.5 'MECA' ; "
        "Q1 = B . 'MODES' . 1 . 'DEPLACEMENTS_GENERALISES' . 1 ; "
        "Q2 = B . 'MODES' . 2 . 'DEPLACEMENTS_GENERALISES' . 1 ; "
        "X1 = EXTR F 'FALF' (B . 'MODES' . 1 . 'POINT_REPERE') ; "
        "X2 = EXTR F 'FALF' (B . 'MODES' . 2 . 'POINT_REPERE') ; "
    )
    q1, q2, x1, x2 = found(script, "Q1", "Q2", "X1", "X2")
    assert (x1, x2) == pytest.approx((-3 * q1, -3 * q2))
    assert abs(q1) > 0


def test_stresses_of_modes(found):
    script = MODE + (
        "C = SIGS MO MA B ; S = C . 'MODES' . 2 . 'CONTRAINTE_MODALE' ; "
        "D = SIGM MO MA (B . 'MODES' . 2 . 'DEFORMEE_MODALE') ; X = MAXI (S - D) 'ABS' ; "
        "Y = MAXI S 'ABS' ; E = EXIS (B . 'MODES' . 2) 'CONTRAINTE_MODALE' ; "
    )
    difference, size, old = found(script, "X", "Y", "E")
    assert size > 0
    assert difference < 1e-12 * size
    assert old is False


def test_quality_in_a_metric_counts_shape_and_size(found):
    height = 3**0.5 / 2
    best, half, long, flat, right = found(
        f"{TRI} T = MANU 'TRI3' (0. 0.) (2. 0.) (1. {2 * height!r}) ; "
        "A = EXTR (INDI 'TOPO' T 2. 'LISTREEL') 1 ; B = MAXI (INDI 'TOPO' T 4.) ; "
        "C = MAXI (INDI 'TOPO' T 0.5) ; D = MAXI (INDI 'TOPO' (MANU 'TRI3' (0. 0.) (2. 0.) "
        "(1. 0.))) ; E = MAXI (INDI 'TOPO' (MANU 'TRI3' (0. 0.) (1. 0.) (0. 1.))) ;",
        "A", "B", "C", "D", "E",
    )  # fmt: skip
    assert (best, half, long) == pytest.approx((1.0, 0.5, 0.25))
    assert flat == pytest.approx(0.0, abs=1e-12)
    assert right == pytest.approx(4 * 3**0.5 * 0.5 / 4)  # 4 sqrt(3) area over squares of edges


def test_stretched_cell_is_the_best_in_its_metric(found):
    # (x, y) = (3 x', y'): equilateral of edge 1 in x', y'
    height = 3**0.5 / 2
    x, y = found(
        f"{TRI} T = MANU 'TRI3' (0. 0.) (3. 0.) (1.5 {height!r}) ; "
        f"G = MANU 'CHPO' T 3 'G11' {1 / 9!r} 'G21' 0. 'G22' 1. ; X = MAXI (INDI 'TOPO' T G) ; "
        "OPTI DIME 3 ; V = MANU 'TET4' (1. 1. 1.) (1. -1. -1.) (-1. 1. -1.) (-1. -1. 1.) ; "
        "Y = MAXI (INDI 'TOPO' V (MANU 'CHPO' V 1 'G' 0.125)) ; ",
        "X", "Y",
    )  # fmt: skip
    assert (x, y) == pytest.approx((1.0, 1.0))
