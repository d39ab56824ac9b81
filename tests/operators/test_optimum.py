"""EXCE against problems whose best point is known."""

import pytest

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
