"""RESPOWSP against the spectra it has to give back; ORBITE draws its pictures."""

import numpy as np
import pytest
from script_runs import found, ran

# a density like that of a filtered noise, and its response spectrum
NOISE = (
    "LF = PROG 0.1 'PAS' 0.05 25. ; LD = (((LF * LF / -9.) + 1.) ** 2) + (LF * LF * (0.8 / 9.)) ;"
    "S0 = EVOL 'MANU' 'FREQ' LF 'DSP' ((LF * LF * 0.09 + 1.) / LD) ;"
    "LT = PROG 0.06 'PAS' 0.02 1.5 ; T = TABL ;"
)


@pytest.mark.parametrize(
    ("quantity", "abscissa", "law"),
    [("ACCE", "PERI", "CRAM"), ("VITE", "FREQ", "CRAM"), ("ACCE", "PERI", "NEWG")],
)
def test_density_gives_its_spectrum_back(quantity, abscissa, law):
    target, again = found(
        NOISE + f"E = PSRS S0 15. (PROG 0.05) LT '{quantity}' '{law}' 'PERI' ; F = E ;"
        + ("F = FREQPERI E ;" if abscissa == "FREQ" else "")
        + f"T . 'GPRP' = '{quantity}' ; T . 'GPAB' = '{abscissa}' ; T . 'DIST' = '{law}' ;"
        "T . 'TTRS' = LT ; S = RESPOWSP F 15. (PROG 0.05) T ;"
        f"R = PSRS S 15. (PROG 0.05) LT '{quantity}' '{law}' 'PERI' ;",
        "E", "R",
    )  # fmt: skip
    ratio = np.asarray(again.parts[0].ordinates) / np.asarray(target.parts[0].ordinates)
    assert np.sqrt(((ratio - 1) ** 2).mean()) < 0.01


def test_density_is_found_where_the_spectrum_says_it():
    exact, value = found(
        NOISE + "E = PSRS S0 15. (PROG 0.02) LT 'ACCE' 'CRAM' 'PERI' ; T . 'TTRS' = LT ;"
        "T . 'EMAX' = 2.E-3 ; T . 'JMAX' = 40 ; T . 'JHAN' = 3 ;"
        "S = RESPOWSP E 15. (PROG 0.02) T ;",
        "S0", "S",
    )  # fmt: skip
    f = np.linspace(1.2, 6, 30)
    a, b = (np.interp(f, c.parts[0].abscissas, c.parts[0].ordinates) for c in (exact, value))
    np.testing.assert_allclose(b, a, rtol=0.15)


def test_two_dampings_are_met_together():
    target, again, density = found(
        NOISE + "E = PSRS S0 15. (PROG 0.02 0.1) LT 'ACCE' 'CRAM' 'PERI' ; T . 'TTRS' = LT ;"
        "T . 'FRCO' = 21. ;"
        "S = RESPOWSP E 15. (PROG 0.02 0.1) T ;"
        "R = PSRS S 15. (PROG 0.02 0.1) LT 'ACCE' 'CRAM' 'PERI' ;",
        "E", "R", "S",
    )  # fmt: skip
    assert density.parts[0].abscissas[[0, -1]] == pytest.approx([1.0 / 15.0, 21.0])
    for a, b in zip(target.parts, again.parts, strict=True):
        ratio = np.asarray(b.ordinates) / np.asarray(a.ordinates)
        assert np.sqrt(((ratio - 1) ** 2).mean()) < 0.02


def test_a_picture_every_few_points(tmp_path):
    ran(
        "T = PROG 0. PAS 6. 360. ; E1 = EVOL 'ROUG' 'MANU' (COS T) (SIN (T * 2.)) ;"
        "E2 = EVOL 'MANU' (PROG -1. 1.) (PROG 0. 0.) ; T1 = TABL ; T1 . 'PAS' = 25 ;"
        "T1 . 'XBOR' = '-2. 1.5' ; T1 . 'TITX' = 'un deux' ; T1 . 'QUEUE' = 'INFINIE' ;"
        "T1 . 'CARR' = FAUX ; T1 . 'EVOL_FIXE' = E2 ; T1 . 'TITRE' = 'essai' ;"
        "T1 . 'TEMPS_CALCULES' = T ; ORBITE (E1 ET (E1 * 0.5)) T1 ;",
        output_directory=tmp_path,
    )
    assert sorted(p.suffix for p in tmp_path.glob("*essai*")) == [".png"] * 2 + [".svg"] * 2
