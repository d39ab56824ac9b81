"""CHARMECA: what a procedure adds to matrices and loads at each step of DYNAMIC."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

BASE = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
P = 0. 0. ; S = 0. -1. ; J = MANU 'SEG2' S P ;
MO = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; MA = MATE MO 'KN' 900. 'KS' 0. ;
T1 = TABL ;
T1 . 'RIGI' = (APPU 'UY' 4. P) ET (BLOQ 'UX' P) ET (BLOQ 'UX' 'UY' S) ;
T1 . 'MASS' = MASS 'DEPL' 1. P ;
T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = MA ;
T1 . 'DEPL' = MANU 'CHPO' P 1 'UY' 0.1 ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.005 2. ; T1 . 'PAS_SAUVES' = 1 ;
"""
COARSE = BASE.replace("0.005", "0.02")
"""Where two ways are compared that give the same at any step."""
RUN = """
T2 = DYNAMIC T1 ; LU = EXTR (EVOL 'TEMP' T2 'DEPL' 'UY' P) 'ORDO' ;
LEC = T1 . 'ENERGIES' . 'ECART' ;
"""
EVO = " EVF = EVOL 'MANU' (PROG 0. 1. 2.) (PROG -1. 2. -3.) ; "
SCHEMES = ["", "T1 . 'ALPHA_F' = 0.1 ;", "T1 . 'RHO_INF' = 0.7 ;", "T1 . 'CONSERVATIF' = VRAI ;",
           "T1 . 'BETA' = 0.3 ; T1 . 'GAMMA' = 0.55 ;", "T1 . 'NEWTON_COMPLET' = VRAI ;",
           "T1 . 'PAS_ADAPTE' = VRAI ;"]  # fmt: skip


def procedure(*entries):
    body = "".join(f" TC . '{word}' = {value} ;" for word, value in entries)
    head = "T1 . 'CHARMECA' = VRAI ; DEBP CHARMECA T0*TABLE TI*FLOTTANT ; TC = TABL ;"
    return f"{head}{body} FINP TC ; "


def lists(found, script):
    u, gap = found(script + RUN, "LU", "LEC")
    return u.values, gap.values


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_force_of_time_is_the_load_of_that_curve(found, scheme):
    load = "T1 . 'CHAR' = CHAR 'MECA' (FORC (0. 1.) P) EVF ; "
    given, _ = lists(found, COARSE + scheme + EVO + load)
    force = "FORC (0. (IPOL TI (PROG 0. 1. 2.) (PROG -1. 2. -3.))) P"
    made, gap = lists(found, COARSE + scheme + procedure(("ADDI_FNL", force)))
    assert np.abs(given).max() > 0.09
    assert np.abs(made - given).max() <= 1e-12
    if "CONSERVATIF" in scheme:
        assert np.abs(gap).max() <= 1e-12


def test_the_state_that_it_is_given_is_that_of_the_step(found):
    load = "T1 . 'CHAR' = CHAR 'MECA' (FORC (0. 1.) P) EVF ; "
    kept = procedure(("ADDI_CNL", "APPU 'UY' 0.4 P")).replace(
        "TC = TABL ;", "TC = TABL ; T1 . 'SEEN' = T0 . 'ETAT' ;"
    )
    words = ("DEPL", "VITE", "ACCE")
    last = "".join(
        f"S{w} = EXTR (T1 . 'SEEN' . '{w}') 'UY' P ; "
        f"C{w} = EXTR (EVOL 'TEMP' T2 '{w}' 'UY' P) 'ORDO' ; " for w in words
    )  # fmt: skip
    t, *pairs = found(
        COARSE + EVO + load + kept + RUN + "TS = T1 . 'SEEN' . 'TEMP' ; " + last,
        "TS", *(name + w for w in words for name in "SC"),
    )  # fmt: skip
    for seen, curve in zip(pairs[::2], pairs[1::2], strict=True):
        assert seen == pytest.approx(curve.values[round(t / 0.02)], rel=1e-9)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_constant_matrices_are_those_of_the_table(found, scheme):
    both = "T1 . 'RIGI' = (T1 . 'RIGI') ET (APPU 'UY' 30. P) ; T1 . 'AMOR' = APPU 'UY' 0.4 P ; "
    given, _ = lists(found, COARSE + scheme + both)
    added = "XK = APPU 'UY' 20. P ; XM = APPU 'UY' 10. P ; XC = APPU 'UY' 0.4 P ; " + procedure(
        ("ADDI_KNL", "XK"), ("ADDI_MATRICE", "XM"), ("ADDI_CNL", "XC")
    )
    made, _ = lists(found, COARSE + scheme + added)
    assert np.abs(made - given).max() <= 1e-11


def duffing(found, steps, entry):
    script = BASE.replace("'KN' 900.", "'KN' 1.E-9").replace("0.005 2.", f"{0.7 / steps} 0.7")
    state = " U0 = EXTR (T0 . 'ETAT' . 'DEPL') 'UY' P ;"
    made = procedure(entry).replace("TC = TABL ;", "TC = TABL ;" + state)
    return lists(found, script + made)[0]


@pytest.mark.parametrize(
    "entry",
    [
        ("ADDI_FNL", "FORC (0. (-500. * (U0 ** 3))) P"),
        ("ADDI_KNL", "APPU 'UY' (500. * (U0 ** 2)) P"),
    ],
)
def test_a_duffing_oscillator_converges_to_its_motion(found, entry):
    exact = solve_ivp(
        lambda t, y: [y[1], -4 * y[0] - 500 * y[0] ** 3], (0, 0.7), [0.1, 0.0], rtol=1e-10,
        atol=1e-12, t_eval=[0.7],
    ).y[0, -1]  # fmt: skip
    errors = [abs(duffing(found, n, entry)[-1] - exact) for n in (60, 240)]
    assert errors[1] <= 2e-2 * 0.1
    assert errors[1] <= 0.3 * errors[0]  # the state is that of the step's start: first order


def test_a_support_may_come_and_be_driven(found):
    body = "TC . 'ADDI_MATRICE' = B1 ; TC . 'ADDI_SECOND' = DEPI B1 (0.1 * TI) ;"
    body = f"SI (TI > 1.) ; {body} FINSI ;"
    made = procedure().replace("TC = TABL ;", "TC = TABL ; " + body)
    u, _ = lists(found, COARSE + "B1 = BLOQ 'UY' P ; " + made)
    free, _ = lists(found, COARSE)
    times = np.arange(101) * 0.02
    held = times > 1.0 + 1e-9
    assert np.abs(u[~held] - free[~held]).max() <= 1e-12
    assert u[held] == pytest.approx(0.1 * times[held], rel=1e-12)


def test_a_stop_is_driven_as_by_the_load(found):
    stop = COARSE + "ST = BLOQ 'MINI' 'UY' P ; T1 . 'RIGI' = (T1 . 'RIGI') ET ST ; "
    curve = "(EVOL 'MANU' (PROG 0. 2.) (PROG 0. 0.16))"
    given, _ = lists(found, stop + f"T1 . 'CHAR' = CHAR 'DIMP' (DEPI ST 1.) {curve} ; ")
    made, _ = lists(found, stop + procedure(("ADDI_SECOND", "DEPI ST (0.08 * TI)")))
    assert (given > 0.1).sum() > 40
    assert np.abs(made - given).max() <= 1e-12


def test_reactions_of_an_added_support_stand_in_the_results(found):
    made = procedure(("ADDI_MATRICE", "B1"))
    script = COARSE + "B1 = BLOQ 'UY' P ; T1 . 'DEPL' = 0. * (T1 . 'DEPL') ; "
    script += "T1 . 'CHAR' = CHAR 'MECA' (FORC (0. -7.) P) EVF ; "
    flat = " EVF = EVOL 'MANU' (PROG 0. 2.) (PROG 1. 1.) ; "
    value = found(
        script.replace("T1 . 'CHAR'", flat + "T1 . 'CHAR'") + made + RUN
        + " R1 = MAXI (REAC (T2 . 100 . 'DEPL') B1) ;",
        "R1",
    )  # fmt: skip
    assert value == pytest.approx(7.0, rel=1e-9)
