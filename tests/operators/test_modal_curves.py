"""EVOL 'RECO' and 'PJBA' on a mass on a spring, whose mode is known."""

import numpy as np

from ssilang.cli.run import run_text

MODE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ; M1 = MASS 'UX' 4. P1 ; "
    "T1 = VIBR 'SIMU' 1. 1 K1 M1 ; "
    "Q1 = MANU 'CHPO' (T1 . 'MODES' . 1 . 'POINT_REPERE') 1 'ALFA' 3. ; "
    "LT = PROG 0. 1. 5. ; LQ = SUIT Q1 (Q1 * 2.) (Q1 * -1.) ; "
    "SH = EXTR (T1 . 'MODES' . 1 . 'DEFORMEE_MODALE') 'UX' P1 ; "
)


def test_recombined_curve_is_the_shape_times_the_contributions(found):
    curve, shape = found(MODE + "E = EVOL 'RECO' LQ LT T1 'UX' P1 ;", "E", "SH")
    part = curve.parts[0]
    np.testing.assert_allclose(part.ordinates, np.array([3, 6, -3]) * shape)
    assert part.abscissas.tolist() == [0, 1, 5]


def test_projection_is_the_product_with_the_shape(found):
    plain, weighted, shape = found(
        MODE + "LU = RECO LQ T1 ; A = EVOL 'PJBA' LU LT T1 ; B = EVOL 'PJBA' LU LT T1 1 M1 ;",
        "A", "B", "SH",
    )  # fmt: skip
    u = np.array([3, 6, -3]) * shape
    np.testing.assert_allclose(plain.parts[0].ordinates, u * shape)
    np.testing.assert_allclose(weighted.parts[0].ordinates, 4 * u * shape)


def test_recombined_reactions_are_those_of_the_recombined_displacement(found):
    beam = (
        "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P1 = 0. 0. ; P2 = 3. 0. ; L = DROI 6 P1 P2 ; "
        "MO = MODE L MECANIQUE ELASTIQUE POUT ; "
        "MA = MATE MO 'YOUN' 2.E11 'NU' 0.3 'RHO' 7800. 'SECT' 1.E-2 'INRZ' 1.E-5 ; "
        "B = BLOQ 'DEPL' 'ROTA' P1 ; K = (RIGI MO MA) ET B ; T = VIBR 'SIMU' 1. 3 K (MASS MO MA) ; "
        "T1 = T . 'MODES' ; REAC B T1 ; "
        "Q = (MANU 'CHPO' (T1 . 1 . 'POINT_REPERE') 'ALFA' 2.) + "
        "(MANU 'CHPO' (T1 . 2 . 'POINT_REPERE') 'ALFA' -0.5) ; "
    )
    moment, whole, other = found(
        beam + "R = RECO Q T 'REAC' ; A = EXTR R 'MZ' P1 ; "
        "R2 = REAC B (RECO Q T) ; D = EXTR R2 'MZ' P1 ; E = MAXI 'ABS' (R - R2) ;",
        "A", "D", "E",
    )  # fmt: skip
    assert abs(moment) > 1.0
    np.testing.assert_allclose(moment, whole)
    assert other < 1e-9 * abs(moment)


def test_a_point_that_no_mode_has_is_still_and_told(tmp_path):
    text = MODE + "P2 = 1. 0. ; E = EVOL 'RECO' LQ LT T1 'UX' P2 ;"
    session = run_text(text, output_directory=tmp_path).session
    assert session.root.find("E").parts[0].ordinates.tolist() == [0.0, 0.0, 0.0]
    assert [w.code for w in session.warnings] == ["operators.curves.zero-at-node"]
