"""SIGNSYNT: accelerograms near a spectrum, white noise."""

import numpy as np
import pytest
from script_runs import found

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
