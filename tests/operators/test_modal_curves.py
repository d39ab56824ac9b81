"""EVOL 'RECO' and 'PJBA' on a mass on a spring, whose mode is known."""

import numpy as np

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
