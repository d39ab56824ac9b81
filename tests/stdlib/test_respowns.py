"""PRNS and RESPOWNS: spectra of modulated signals, forth and back."""

import numpy as np
from script_runs import found
from together import together

MODULATION = (
    "M1 = EVOL 'MANU' 'TEMP' (PROG 0. 2. 8. 10.) 'MODU' (PROG 0. 1. 1. 0.) ;"
    "M2 = EVOL 'MANU' 'TEMP' (PROG 0. 4. 8. 10.) 'MODU' (PROG 0. 1. 1. 0.) ; MM = M1 ET M2 ;"
    "LB = PROG 0.2 3. 25. ; LT = PROG 0.08 0.15 0.3 0.6 1.2 2.5 ;"
    "S0 = EVOL 'MANU' 'FREQ' (PROG 0.2 1. 5. 25.) 'DSP' (PROG 0.1 1. 0.8 0.05) ;"
)


@together(
    "quantity, more",
    [("'ACCE' 'PERI'", ""), ("'VITE' 'FREQ'", "T1 . 'GPRP' = 'VITE' ; T1 . 'GPAB' = 'FREQ' ;"
      " T1 . 'FFPS' = PROG 0.2 0.4 0.8 1.5 3. 5. 8. 12. 25. ;")],
)  # fmt: skip
def test_the_power_found_gives_the_spectrum_back(quantity, more):
    script = MODULATION + (
        f"R0 = PRNS S0 MM LB LT {quantity} 'TPLU' 5. 'NBIN' 4 ; T1 = TABL ; T1 . 'TTRS' = LT ;"
        f"{more}"
        "T1 . 'TPLU' = 5. ; T1 . 'NBIN' = 4 ; T1 . 'JHAN' = 2 ; T1 . 'EMAX' = 5.E-3 ;"
        "S1 = RESPOWNS R0 MM LB T1 ; "
        f"R1 = PRNS S1 MM LB LT {quantity} 'TPLU' 5. 'NBIN' 4 ;"
    )
    asked, made, density = found(script, "R0", "R1", "S1")
    np.testing.assert_allclose(made.parts[0].ordinates, asked.parts[0].ordinates, rtol=0.03)
    assert (len(density.parts[0].abscissas) == 9) == bool(more)


def test_words_stand_in_any_order():
    script = MODULATION + (
        "A = PRNS S0 MM LB 0.02 LT 'DEPL' 'FREQ' 'NBPR' 4 'TPLU' 3. ROUG ;"
        "B = PRNS S0 MM LB 'FREQ' 'NBPR' 4 LT 'TPLU' 3. 0.02 'DEPL' ;"
    )
    a, b = found(script, "A", "B")
    np.testing.assert_array_equal(a.parts[0].ordinates, b.parts[0].ordinates)
    np.testing.assert_allclose(a.parts[0].abscissas[0], 1.0 / 2.5)
