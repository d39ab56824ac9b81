"""Spectra forth and back: PRNS RESPOWNS RESPOWSP ORBITE SIGNSYNT."""

import numpy as np
import pytest
from script_runs import found, ran
from together import together

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
    # by Gumbel's law two fractiles are searched for at each period: a third of them
    noise = NOISE.replace("'PAS' 0.02", "'PAS' 0.06") if law == "NEWG" else NOISE
    target, again = found(
        noise + f"E = PSRS S0 15. (PROG 0.05) LT '{quantity}' '{law}' 'PERI' ; F = E ;"
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


TABLE = (
    "SP0 = EVOL 'MANU' 'FREQ' (PROG 0.1 0.5 1. 2.5 5. 33. 50.) 'ACCE' "
    "(PROG 0.1 0.5 1. 2.5 2.5 1. 1.) ; T = TABL ; T . 'SEISME' = TABL ; "
    "T . 'SEISME' . 'SPECTRE' = SP0 ; T . 'SEISME' . 'AMORT' = 0.05 ; "
    "T . 'SEISME' . 'TYPSP' = 'ACCE' ; T . 'SIGNAL' = TABL ; T . 'SIGNAL' . 'NP' = 9 ; "
    "T . 'SIGNAL' . 'DUREE' = 5.12 ; T . 'NALEAT' = 3 ; T . 'FRCOUP' = 40. ; T . 'NBITER' = 6 ; "
)


def test_spectrum_of_the_signal_comes_near_the_reference():
    f, ratio = found(
        TABLE + "E = SIGNSYNT FABR T ; LF = PROG 1. PAS 0.5 30. ; "
        "S = SPO (E . 1) 'AMOR' (PROG 0.05) 'FREQ' LF 'ACCE' ; "
        "R = (EXTR S 'ORDO') / (IPOL LF SP0) ;",
        "LF", "R",
    )  # fmt: skip
    assert len(f) == 59
    # what six corrections leave between the lines of the transform
    assert np.sqrt(np.mean((ratio.values - 1) ** 2)) < 0.25
    assert ratio.values.min() > 0.5


def test_envelope_holds_and_signals_differ():
    first, second = found(
        TABLE + "T . 'SIGNAL' . 'ENVE' = 'PLATLIN' ; T . 'SIGNAL' . 'TDEBUT' = 1. ; "
        "T . 'SIGNAL' . 'TFIN' = 3. ; T . 'NBSIGN' = 2 ; E = SIGNSYNT 'FABR' T ; "
        "A = EXTR (E . 1) 'ORDO' ; B = EXTR (E . 2) 'ORDO' ;",
        "A", "B",
    )  # fmt: skip
    assert first.values[0] == 0
    assert abs(first.values[-1]) < 0.02 * np.abs(first.values).max()
    assert np.abs(first.values - second.values).max() > 0.1


def test_white_noise_has_unit_deviation_and_a_flat_spectrum():
    noise, module = found(
        "T = TABL ; T . 'NP' = 8 ; T . 'DELTAF' = 0.5 ; T . 'NALEAT' = 2 ; "
        "E = SIGNSYNT 'BLANC' T ; "
        "Y = EXTR E 'ORDO' ; M = EXTR (TFR 8 E 'MOPH') 'ORDO' 1 ;",
        "Y", "M",
    )  # fmt: skip
    assert np.sqrt(np.mean(noise.values**2)) == pytest.approx(1.0)
    np.testing.assert_allclose(module.values[1:-1], module.values[1], rtol=1e-9)
