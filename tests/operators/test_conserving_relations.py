"""CONSERVATIF with contact relations, as a script asks for it."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.language.say.diagnostics import sentence

# a rigid block on two stops, tilted, its weight pulling it back: rocks for ever
BLOCK = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; PC = 0. 0. ;
R = (BLOQ 'UX' PC) ET (RELA 'MINI' 'UY' PC + 1.5 'RZ' PC) ET (RELA 'MINI' 'UY' PC - 1.5 'RZ' PC) ;
T = TABL ; T . 'RIGI' = R ; T . 'MASS' = (MASS 'DEPL' 1.E5 PC) ET (MASS 'ROTA' 8.E5 PC) ;
T . 'DEPL' = (MANU 'CHPO' PC 1 'UY' 0.015) ET (MANU 'CHPO' PC 1 'RZ' 0.01) ;
T . 'CHAR' = CHAR 'MECA' (FORC (0. -9.81E5) PC) (EVOL 'MANU' (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-3 3. ; T . 'CONSERVATIF' = VRAI ;
"""
END = """ T2 = DYNAMIC T ; LE = T . 'ENERGIES' . 'ECART' ; LC = T . 'ENERGIES' . 'CINETIQUE' ;
LTH = EXTR (EVOL 'TEMP' T2 'DEPL' 'RZ' PC) 'ORDO' ; """


@pytest.mark.parametrize("method", ["LAGRANGE", "AUGMENTE", "UZAWA", "PENALITE"])
def test_a_rocking_block_keeps_its_energy_whatever_the_method(found, method):
    extra = f"T . 'CONTACT' = MOT '{method}' ; T . 'COEFFICIENT' = 1.E9 ; "
    if method == "UZAWA":
        extra = "T . 'CONTACT' = MOT 'UZAWA' ; "
    gap, kinetic, theta = found(BLOCK + extra + END, "LE", "LC", "LTH")
    assert np.abs(gap.values).max() <= 1e-10 * kinetic.values.max()
    assert np.abs(theta.values).max() <= 0.0100001
    assert (theta.values < -1e-3).any()
    assert (theta.values > 1e-3).any()


@pytest.mark.parametrize(
    ("entry", "warned"), [("", False), ("FAUX", False), ("VRAI", True), ("MOT 'RIGIDITE'", True)]
)
def test_a_velocity_correction_beside_it_has_no_effect_and_is_warned_of(entry, warned):
    text = BLOCK.replace("2.E-3 3.", "1.E-3 0.1") + (
        f"T . 'VITEUNIL' = {entry} ; " if entry else ""
    )
    result = ran(text + END)
    said = " ".join(sentence(w, "en")[0] for w in result.session.warnings)
    assert ("'VITEUNIL' has no effect" in said) is warned


@together(
    "entries, told",
    [
        ("", False),
        ("T . 'CONSERVATIF' = VRAI ; ", False),
        ("T . 'VITEUNIL' = FAUX ; ", True),
        ("T . 'CONTACT' = MOT 'PENALITE' ; T . 'COEFFICIENT' = 1.E9 ; ", True),
    ],
)
def test_energy_that_impacts_create_is_told_in_every_method(entries, told):
    """The block gains more than it had: measured by what it was given, not by its later fall."""
    text = BLOCK.replace("T . 'CONSERVATIF' = VRAI ;", entries).replace("2.E-3 3.", "1.E-2 3.")
    result = run_text(text + END)
    codes = [w.code for w in result.session.warnings]
    assert ("operators.dynamics.impacts-change-energy" in codes) is told, codes
    share = result.session.statistics["calculations"][0]["energy_imbalance"]
    assert (share > 0.3) is told


@pytest.mark.parametrize("stiffness", [4.0e6, 1.0e6])
def test_the_energy_that_a_run_closes_with_is_what_impacts_leave(stiffness):
    """A mass that a record drives against a stop: off for single steps, and back behind them."""
    result = run_text(
        "OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ; P = 0. 0. ; "
        f"K = APPU 'UX' {stiffness} P ; MS = MASS 'DEPL' 1.E5 P ; STOP = BLOQ 'UX' 'MAXI' P ; "
        "T = TABL ; T . 'RIGI' = K ET STOP ET (BLOQ 'UY' P) ; T . 'MASS' = MS ; "
        "T . 'AMOR' = 0.6 * MS ; LT = PROG 0. PAS 0.005 8. ; "
        "LA = 2. * LT * (EXP (-0.5 * LT)) * (SIN (396. * LT)) ; "
        "T . 'CHAR' = (CHAR 'DIMP' (DEPI STOP 0.02) (EVOL 'MANU' (PROG 0. 99.) (PROG 1. 1.))) ET "
        "(CHAR 'MECA' (MS * (MANU 'CHPO' P 1 'UX' -1.)) (EVOL 'MANU' 'TEMP' LT 'ACCE' LA)) ; "
        "T . 'TEMPS_CALCULES' = PROG 0. PAS 1.E-3 8. ; DYNAMIC T ; E = T . 'ENERGIES' . 'ECART' ;"
    )
    off = np.abs(result.session.root.find("E").values)
    (line,) = result.session.statistics["calculations"]
    assert line["energy_imbalance"] < 0.05
    assert line["energy_imbalance_joules"] < 0.3 * off.max()
    assert line["energy_imbalance_joules"] >= np.median(off[len(off) // 2 :]) * 0.5
    assert not result.session.warnings
