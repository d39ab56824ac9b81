"""PRNS and RESPOWNS: spectra of modulated signals, forth and back."""

import numpy as np
from script_runs import found

MODULATION = (
    "M1 = EVOL 'MANU' 'TEMP' (PROG 0. 2. 8. 10.) 'MODU' (PROG 0. 1. 1. 0.) ;"
    "M2 = EVOL 'MANU' 'TEMP' (PROG 0. 4. 8. 10.) 'MODU' (PROG 0. 1. 1. 0.) ; MM = M1 ET M2 ;"
    "LB = PROG 0.2 3. 25. ; LT = PROG 0.08 0.15 0.3 0.6 1.2 2.5 ;"
    "S0 = EVOL 'MANU' 'FREQ' (PROG 0.2 1. 5. 25.) 'DSP' (PROG 0.1 1. 0.8 0.05) ;"
)


def test_words_stand_in_any_order():
    script = MODULATION + (
        "A = PRNS S0 MM LB 0.02 LT 'DEPL' 'FREQ' 'NBPR' 4 'TPLU' 3. ROUG ;"
        "B = PRNS S0 MM LB 'FREQ' 'NBPR' 4 LT 'TPLU' 3. 0.02 'DEPL' ;"
    )
    a, b = found(script, "A", "B")
    np.testing.assert_array_equal(a.parts[0].ordinates, b.parts[0].ordinates)
    np.testing.assert_allclose(a.parts[0].abscissas[0], 1.0 / 2.5)
