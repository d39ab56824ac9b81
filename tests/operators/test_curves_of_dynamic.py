"""EVOL 'TEMP' reads the table of DYNAMIC by the name of a quantity."""

import numpy as np
import pytest

from ssilang.cli.run import run_text

FREE_MASS = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; T1 = TABL ;
T1 . 'RIGI' = (APPU 'DEPL' 1.E-9 P) ; T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'DEPL' = MANU 'CHPO' P 2 'UX' 0. 'UY' 0. ;
T1 . 'VITE' = MANU 'CHPO' P 2 'UX' 3. 'UY' 0. ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ; T1 . 'PAS_SAUVES' = 'TOUS' ;
T2 = DYNAMIC T1 ;"""


@pytest.mark.parametrize(("word", "last"), [("'DEPL'", 3.0), ("'VITE'", 3.0), ("", 3.0)])
def test_quantity_of_the_steps_is_drawn_in_time(word, last):
    result = run_text(
        f"{FREE_MASS} E = EVOL 'TEMP' T2 {word} 'UX' P ; LT = EXTR E 'ABSC' ; LU = EXTR E 'ORDO' ;"
    )
    assert result.exit_code == 0, result.message
    t, u = (result.session.root.find(n).values for n in ("LT", "LU"))
    assert t == pytest.approx(np.linspace(0.0, 1.0, 11))
    assert u[-1] == pytest.approx(last, rel=1e-8)
