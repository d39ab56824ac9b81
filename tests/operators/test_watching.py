"""Largest values of a motion, bodies that leave the ground; supports on lines made twice."""

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.statics.linear import reactions
from ssilang.language.say.diagnostics import sentence

OSCILLATOR = """
OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; T = TABL ;
T . 'RIGI' = (RIGI 'DEPL' 100. P1) ET (BLOQ 'UY' P1) ;
T . 'MASS' = MASS 'DEPL' 1. P1 ;
T . 'CHAR' = CHAR 'MECA' (FORC 'FX' 1. P1) (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 0.4 ; T . 'PAS_SAUVES' = 'FINAL' ;
T . 'EXTREMES' = VRAI ;
"""

BLOCK = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
C = DROI 4 (0. 0.) (1. 0.) ; SOL = C TRAN 2 (0. -1.) ;
A = DROI 4 (0. 0.) (1. 0.) ; BLOC = A TRAN 2 (0. 1.) ;
J = RACC 0.01 A C ; M = MODE (SOL ET BLOC) 'MECANIQUE' 'ELASTIQUE' ;
MA = MATE M 'YOUN' 1.E9 'NU' 0. 'RHO' 2000. ;
MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; AJ = MATE MJ 'KN' 1.E8 'KS' 1.E8 ;
T = TABL ; T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ;
T . 'RIGI' = (RIGI M MA) ET (BLOQ 'DEPL' (COTE 3 SOL)) ; T . 'MASS' = MASS M MA ;
T . 'CHAR' = CHAR 'MECA' ((T . 'MASS') * (MANU 'CHPO' BLOC 1 'UY' {g}))
  (EVOL MANU (PROG 0. 9.) (PROG 1. 1.)) ;
T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 2.E-4 0.2 ; T . 'EXTREMES' = VRAI ;
"""


@pytest.mark.parametrize("loop", ["", "T . 'NEWTON_COMPLET' = VRAI ;", "T . 'REDUCTION' = 1.E-6 ;"])
def test_the_peak_of_an_oscillator_is_found_though_its_step_is_not_kept(loop):
    result = ran(OSCILLATOR + loop + "R = DYNAMIC T ;")
    table = result.session.root.find("T").get("RESULTATS_EXTREMES")
    peak = table.get("DEPL").get("UX")
    assert peak.get("VALEUR") == pytest.approx(0.02, rel=1e-5)  # 2 F/k
    assert peak.get("TEMPS") == pytest.approx(np.pi / 10.0, abs=1.1e-3)
    assert peak.get("POINT").coordinates[:2].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("step", ["", "T . 'CONSERVATIF' = VRAI ;"])
def test_extremes_are_those_of_all_steps_kept(step):
    result = ran(
        BLOCK.format(g=-9.81).replace("2.E-4", "4.E-4")
        + step
        + "T . 'PAS_SAUVES' = 1 ; R = DYNAMIC T ;"
    )
    table = result.session.root.find("T").get("RESULTATS_EXTREMES")
    kept = [row for place, row in result.session.root.find("R").items() if type(place) is int]
    lowest = min(float(row.get("DEPL").components["UY"].values.min()) for row in kept)
    assert table.get("DEPL").get("UY").get("VALEUR") == pytest.approx(lowest, rel=1e-12)
    pressure = min(float(b.components["SMN"].min()) for r in kept
                   for b in r.get("CONTRAINTES").blocks)  # fmt: skip
    assert table.get("COMPRESSION").get("VALEUR") == pytest.approx(pressure, rel=1e-12)
    assert table.get("COMPRESSION").get("COORDONNEES").values[1] == 0.0
    matrix = result.session.root.find("T").get("RIGI")
    forces = np.array([reactions(matrix, r.get("DEPL")).components["FY"].values for r in kept])
    peak = forces.ravel()[np.abs(forces).argmax()]
    assert table.get("REACTIONS").get("FY").get("VALEUR") == pytest.approx(peak, rel=1e-9)


UNASKED = {
    "on modes": OSCILLATOR,
    "on a spring's line": OSCILLATOR + "T . 'BETA' = 0.3 ;",
    "reduced": BLOCK.format(g=-9.81) + "T . 'REDUCTION' = 1.E-2 ;",
    "large": BLOCK.format(g=-9.81),
}


@pytest.mark.parametrize("text", UNASKED.values(), ids=UNASKED)
def test_extremes_that_nobody_asked_for_are_there_when_they_are_read(text):
    asked = ran(text + "R = DYNAMIC T ;").session.root.find("T").get("RESULTATS_EXTREMES")
    later = "T . 'EXTREMES' = FAUX ; R = DYNAMIC T ; X = T . 'RESULTATS_EXTREMES' ;"
    read = "U = X . 'DEPL' . 'UX' . 'VALEUR' ; F = X . 'REACTIONS' . 'FY' . 'VALEUR' ;"
    found = ran(text + later + read).session.root.find
    assert found("U") == asked.get("DEPL").get("UX").get("VALEUR")
    assert found("F") == asked.get("REACTIONS").get("FY").get("VALEUR")
    words = [str(i).rstrip() for i, _ in found("X").items()]
    assert words == [str(i).rstrip() for i, _ in asked.items()]


def test_extremes_of_forces_that_a_procedure_adds_must_be_asked_for():
    push = (
        "DEBP CHARMECA TAB1*TABLE T1*FLOTTANT ; R = TABL ; R . 'ADDI_FNL' = FORC 'FX' 1. P1 ; "
        "FINP R ; T . 'CHARMECA' = VRAI ; "
    )
    asked = ran(OSCILLATOR + push + "R = DYNAMIC T ;").session.root.find("T")
    peak = asked.get("RESULTATS_EXTREMES").get("DEPL").get("UX")
    assert peak.get("VALEUR") == pytest.approx(0.04, rel=1e-5)
    text = OSCILLATOR + push + "T . 'EXTREMES' = FAUX ; R = DYNAMIC T ;"
    assert not ran(text).session.root.find("T").has("RESULTATS_EXTREMES")


@together("g, warned", [("9.81", True), ("-9.81", False)])
def test_a_structure_that_leaves_the_ground_for_good_is_told(g, warned):
    result = ran(BLOCK.format(g=g) + "R = DYNAMIC T ;")
    codes = [w.code for w in result.session.warnings]
    assert ("operators.dynamics.left-for-good" in codes) is warned


HEAD = """OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; DENS 0.5 ;
P1 = 0. 0. ; P2 = 2. 0. ; P3 = 2. 1. ; P4 = 0. 1. ;
"""
BODY = """MO = MODE SOL 'MECANIQUE' ; MA = MATE MO 'YOUN' 1.E7 'NU' 0.3 'RHO' 2000. ;
RI = RIGI MO MA ;
"""
TWICE = HEAD + "SOL = DALL (P1 D P2) (P2 D P3) (P3 D P4) (P4 D P1) ;" + BODY + "BAS = P1 D P2 ;"
ONCE = HEAD + "BAS = P1 D P2 ; SOL = DALL BAS (P2 D P3) (P3 D P4) (P4 D P1) ;" + BODY
SOLVE = "U = RESO (RI ET (BLOQ 'DEPL' BAS)) (FORC 'FX' 1. P3) ;"


def warnings(text: str) -> list[str]:
    result = ran(text)
    return [sentence(w, "en")[0] for w in result.session.warnings]


def test_a_line_made_twice_is_told() -> None:
    (told,) = warnings(TWICE + SOLVE)
    assert told.startswith("3 nodes that conditions hold have no stiffness")
    assert "0.5 0 0" in told


@together(
    "deck",
    [
        ONCE + SOLVE,
        TWICE + "ELIM 1.E-6 BAS SOL ; " + SOLVE,
        TWICE + "RI = RI ET (RELA 'ENSE' 'UX' BAS) ; " + SOLVE,
    ],
)
def test_nodes_that_are_joined_or_meant_are_not(deck: str) -> None:
    assert not [w for w in warnings(deck) if "stiffness" in w]


def test_modes_and_time_steps_tell_it_too() -> None:
    modes = TWICE + "T = VIBR 'PROC' (PROG 10.) (RI ET (BLOQ 'DEPL' BAS)) (MASS MO MA) ;"
    steps = (
        TWICE + "T = TABL ; T . 'RIGI' = RI ET (BLOQ 'DEPL' BAS) ; T . 'MASS' = MASS MO MA ;"
        "T . 'TEMPS_CALCULES' = PROG 0. 0.01 ; R = DYNAMIC T ;"
    )
    loads = (
        TWICE + "T = TABL ; T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MA ;"
        "T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' BAS ; T . 'TEMPS_CALCULES' = PROG 0. 1. ;"
        "T . 'CHARGEMENT' = CHAR 'MECA' (FORC 'FX' 1. P3) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;"
        "PASAPAS T ;"
    )
    for deck in (modes, steps, loads):
        assert any("3 nodes that conditions hold" in w for w in warnings(deck))


def test_a_grounded_joint_is_meant() -> None:
    deck = HEAD + (
        "SOL = DALL (P1 D P2) (P2 D P3) (P3 D P4) (P4 D P1) ;" + BODY + "Q1 = P1 PLUS (0. 0.) ;"
        "Q2 = P2 PLUS (0. 0.) ; J = (Q1 D 1 P1) ET (Q2 D 1 P2) ; "
        "MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ; "
        "AJ = MATE MJ 'KN' 1.E7 'KS' 1.E7 'V1X' 1. 'V1Y' 0. ;"
        "T = TABL ; T . 'MODELE' = MJ ; T . 'CARACTERISTIQUES' = AJ ;"
        "T . 'RIGI' = RI ET (BLOQ 'DEPL' (Q1 ET Q2)) ; T . 'MASS' = MASS MO MA ;"
        "T . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-4 1.E-3 ; R = DYNAMIC T ;"
    )
    assert not [w for w in warnings(deck) if "hold nothing" in w]


@together("place, lost", [("(2. 1.)", 1), ("P3", 0)])
def test_a_velocity_beside_the_body_is_told(place: str, lost: int) -> None:
    deck = ONCE + (
        "T = TABL ; T . 'RIGI' = RI ET (BLOQ 'DEPL' BAS) ; T . 'MASS' = MASS MO MA ;"
        f"T . 'VITE' = MANU 'CHPO' {place} 1 'UX' 1. ; T . 'DEPL' = T . 'VITE' * 0. ;"
        "T . 'TEMPS_CALCULES' = PROG 0. 0.01 ; R = DYNAMIC T ;"
    )
    told = [w for w in warnings(deck) if "'VITE' moves what no matrix has" in w]
    assert len(told) == lost
