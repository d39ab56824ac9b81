"""@CIBLE and @ACCORD against closed forms, and spectra computed by themselves."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.modal.oscillator import spectrum


def found(text, *names):
    result = ran(text)
    got = [result.session.root.find(name) for name in names]
    return [*got, [w.code for w in result.session.warnings]]


TARGET = "T = TABL ; T . 'CODE' = '{code}' ; T . 'FREQUENCES' = PROG {f} ; {more} E = @CIBLE T ;"


@together("code, more, values", [
        # corners of type 1, ground B: S 1.2, TB 0.15, TC 0.5, TD 2 s
        ("EC8", "T . 'AG' = 2. ; T . 'SOL' = 'B' ;",
         {1e12: 2.4, 1 / 0.075: 4.2, 1 / 0.3: 6.0, 1.0: 3.0, 0.25: 6.0 * 0.5 * 2 / 16}),
        ("EC8", "T . 'AG' = 1. ; T . 'SOL' = 'D' ; T . 'TYPE' = 2 ; T . 'AMORTISSEMENT' = 0.1 ;",
         {1e12: 1.8, 5.0: 4.5 * np.sqrt(2 / 3), 1.0: 4.5 * np.sqrt(2 / 3) * 0.3}),
        ("EC8", "T . 'AG' = 1. ; T . 'SOL' = 'A' ; T . 'COMPOSANTE' = 'VERT' ;",
         {1e12: 0.9, 10.0: 2.7, 2.0: 2.7 * 0.3, 0.5: 2.7 * 0.15 / 4}),
        # TS 0.6 s, T0 0.12 s
        ("ASCE7", "T . 'SDS' = 1. ; T . 'SD1' = 0.6 ; T . 'TL' = 8. ;",
         {1e12: 0.4 * 9.81, 1 / 0.06: 0.7 * 9.81, 4.0: 9.81, 0.5: 0.3 * 9.81,
          0.1: 0.6 * 8 / 100 * 9.81}),
    ])  # fmt: skip
def test_spectra_of_codes_at_and_between_their_corners(code, more, values):
    text = TARGET.format(code=code, f=" ".join(f"{f:.12g}" for f in sorted(values)), more=more)
    curve, _ = found(text, "E")
    np.testing.assert_allclose(
        curve.parts[0].ordinates, [values[f] for f in sorted(values)], rtol=1e-8
    )


SUITE = """
LT = PROG 0. PAS 0.02 12. ; B = (SIN (LT * 15.)) ** 2 ;
A = EVOL 'MANU' 'TEMP' LT 'ACCE'
  (B * ((SIN (LT * 500.)) + (COS (LT * 1250.)) + (SIN (LT * 220.)))) ;
C = EVOL 'MANU' 'TEMP' LT 'ACCE' (B * ((COS (LT * 410.)) + (COS (LT * 900.)) + (SIN (LT * 260.)))) ;

T = TABL ; T . 'SIGNAUX' = TABL ; T . 'PERIODES' = PROG 0.15 2. ;
"""


def test_multiples_of_one_record_get_the_factors_that_undo_them():
    text = f"""{SUITE}
    T . 'CIBLE' = SPO A 'AMOR' 0.05 'FREQ' (PROG 0.5 PAS 0.001 7.) 'ACCE' ;
    T . 'SIGNAUX' . 1 = 4. * A ; T . 'SIGNAUX' . 2 = 0.5 * A ; S = @ACCORD T ;
    T . 'PLANCHER' = 1.5 ; U = @ACCORD T ; T . 'CIBLE' = 100. * (T . 'CIBLE') ; V = @ACCORD T ;
    """
    table, higher, _, warnings = found(text, "S", "U", "V")
    np.testing.assert_allclose(table.get("FACTEURS").values, [0.25, 2.0], rtol=1e-4)
    assert np.abs(table.get("RAPPORT").parts[0].ordinates - 1.0).max() < 2e-3
    least = higher.get("RAPPORT").parts[0].ordinates.min()
    assert least == pytest.approx(1.5, rel=1e-9)
    assert warnings == ["stdlib.accord-far", "stdlib.accord-far"]


def test_a_suite_matched_by_wavelets_has_the_target_and_its_mean_stays_above_the_floor():
    text = f"""{SUITE}
    T . 'CIBLE' = EVOL 'MANU' 'FREQ' (PROG 0.3 2. 10.) 'ACCE' (PROG 1. 5. 5.) ;
    T . 'SIGNAUX' . 1 = A ; T . 'SIGNAUX' . 2 = C ; T . 'METHODE' = 'ONDELETTES' ;
    T . 'PLANCHER' = 0.95 ; T . 'TOLERANCE' = 0.12 ; S = @ACCORD T ;
    """
    table, warnings = found(text, "S")
    assert warnings == []
    f = np.geomspace(0.5, 1 / 0.15, 60)
    wanted = np.interp(f, [0.3, 2.0, 10.0], [1.0, 5.0, 5.0])
    got = []
    for i in (1, 2):
        part = table.get("SIGNAUX").get(i).parts[0]
        got.append(spectrum(part.abscissas, part.ordinates, f, 0.05, "ACCE"))
        assert np.abs(got[-1] / wanted - 1.0).max() < 0.13 / 0.95
        told = table.get("SPECTRES").get(i).parts[0]
        np.testing.assert_allclose([told.abscissas, told.ordinates], [f, got[-1]], rtol=1e-6)
    mean = np.mean(got, axis=0)
    assert (mean / wanted).min() > 0.95 - 1e-6
    np.testing.assert_allclose(table.get("MOYENNE").parts[0].ordinates, mean, rtol=1e-6)
