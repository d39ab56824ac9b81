"""EVOL 'TEMP' reads the table of DYNAMIC by the name of a quantity."""

import numpy as np
import pytest
from script_runs import ran
from together import together

FREE_MASS = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPU 'DEPL' 1.E-9 P) ; T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'DEPL' = MANU 'CHPO' P 2 'UX' 0. 'UY' 0. ;
T1 . 'VITE' = MANU 'CHPO' P 2 'UX' 3. 'UY' 0. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T2 = DYNAMIC T1 ;"""


@together("word, last", [("'DEPL'", 3.0), ("'VITE'", 3.0), ("", 3.0)])
def test_quantity_of_the_steps_is_drawn_in_time(word, last):
    result = ran(
        f"{FREE_MASS} E = EVOL 'TEMP' T2 {word} 'UX' P ; LT = EXTR E 'ABSC' ; LU = EXTR E 'ORDO' ;"
    )
    t, u = (result.session.root.find(n).values for n in ("LT", "LU"))
    assert t == pytest.approx(np.linspace(0.0, 1.0, 11))
    assert u[-1] == pytest.approx(last, rel=1e-8)


HELD = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 1 P Q ; T1 = TABL ;
MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; MA = MATE MO 'YOUN' 4. 'NU' 0. 'SECT' 1. 'RHO' 1. ;
BL = (BLOQ 'UX' P) ET (BLOQ 'UY' L) ;
T1 . 'RIGI' = (RIGI MO MA) ET BL ; T1 . 'MASS' = MASS 'DEPL' 1. L ;
T1 . 'VITE' = MANU 'CHPO' Q 1 'UX' 3. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T2 = DYNAMIC T1 ;
"""
MADE = "REPE B1 11 ; CH = T2 . &B1 . 'DEPL' ; X = MAXI CH ; FIN B1 ;"


@pytest.mark.parametrize("what", ["'UX' Q", "'UY' Q", "'UX' P", "(MOTS 'UX' 'UY') L"])
def test_curves_are_the_same_before_and_after_fields_are_made(found, what):
    curves = f"E = EVOL 'TEMP' T2 'DEPL' {what} ;"
    before = found(HELD + curves, "E")
    after = found(HELD + MADE + curves, "E")
    assert len(before.parts) == len(after.parts)
    for one, other in zip(before.parts, after.parts, strict=True):
        assert np.array_equal(one.ordinates, other.ordinates)
    if what == "'UX' Q":  # average acceleration of sqrt(4 N/m / 1 kg), cos of the step's angle
        angle = 2.0 * np.arctan(2.0 * 0.1 / 2.0)
        exact = 1.5 * np.sin(angle * np.arange(11))
        assert before.parts[0].ordinates == pytest.approx(exact, abs=1e-12)


def test_a_multiplier_in_time_is_the_force_of_its_support(found):
    table = found(HELD, "T2")
    nodes = [set(table.get(3).get("DEPL").components[name].nodes) for name in ("LX", "UX")]
    at = 1 + min(nodes[0] - nodes[1])
    one = found(HELD + f"E = EVOL 'TEMP' T2 'DEPL' 'LX' (NOEU {at}) ;", "E")
    assert np.abs(one.parts[0].ordinates).max() > 1.0
