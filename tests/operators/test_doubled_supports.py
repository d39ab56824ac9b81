"""Supports on lines made twice."""

from script_runs import ran
from together import together

from ssilang.language.say.diagnostics import sentence

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
