"""What is wrong with joints, bodies and motions is said where it is, with the figure."""

import pytest

from ssilang.cli.run import run_text
from ssilang.language.say.diagnostics import sentence

BODY = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;
SOL = 0. -1. ; P = 0. 0. ; J = MANU 'SEG2' SOL P ;
MO = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
MA = MATE MO 'KN' 1000. 'KS' 0. ;
T1 = TABL ;
T1 . 'RIGI' = (BLOQ 'UX' 'UY' SOL) ET (BLOQ 'UX' P) ;
T1 . 'CHAR' = CHAR 'MECA' (FORC (0. 1.) P) (EVOL 'MANU' (PROG 0. 1.) (PROG -1. 1.)) ;
T1 . 'MODELE' = MO ; T1 . 'CARACTERISTIQUES' = MA ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 0.1 1. ;
"""
SIDES = """
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;
A = DROI 2 (0. 0.) (1. 0.) ; B = A PLUS (0. 0.) ; J = RACC 1.E-6 A B ;
"""


@pytest.fixture
def outcome(tmp_path):
    def run(text):
        result = run_text(text, output_directory=tmp_path)
        assert "defect of ssilang" not in result.message
        return result

    return run


def test_missing_mass_is_warned_of(outcome):
    down = BODY.replace("PROG -1. 1.", "PROG -1. -1.")
    warned = "no mass and only joints hold it"
    result = outcome(down + "T2 = DYNAMIC T1 ;")
    assert result.exit_code == 0
    assert any(warned in w for w in messages(result))
    result = outcome(down + "T1 . 'MASS' = MASS 'DEPL' 1. P ; T2 = DYNAMIC T1 ;")
    assert not any(warned in w for w in messages(result))


def messages(result):
    return [" ".join(sentence(w, "en")) for w in result.session.warnings]


def test_wrong_unit_of_a_stiffness_is_warned_of(outcome):
    text = (
        SIDES
        + """
    S = B TRAN 1 (0. -1.) ; MS = MODE S 'MECANIQUE' 'ELASTIQUE' ;
    AS = MATE MS 'YOUN' 5.E7 'NU' 0.3 ; MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
    T = TABL ; T . 'MODELE' = MS ET MJ ;
    T . 'CARACTERISTIQUES' = AS ET (MATE MJ 'KN' {0} 'KS' {0}) ;
    T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' 'UY' (COTE 3 S)) ET (BLOQ 'UX' A) ;
    T . 'CHARGEMENT' = CHAR 'MECA' (FORC (0. -1.) A) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ;
    T . 'TEMPS_CALCULES' = PROG 1. ; PASAPAS T ;
    """.replace("MATE MJ 'KN' {} 'KS' 1.E9", "MATE MJ 'KN' {0} 'KS' {0}").replace("ELEM", "ELEM")
    )
    text = text.replace("S = B TRAN", "OPTI ELEM QUA4 ; S = B TRAN")
    for stiffness, warned in (("1.E9", False), ("1.E18", True)):
        result = outcome(text.format(stiffness))
        assert result.exit_code == 0, result.message
        said = " ".join(messages(result))
        assert ("check their units" in said) is warned
        assert ("condition number of the stiffness with closed joints" in said) is warned
        assert ("is as stiff as the bodies" in said) is warned


def test_a_matrix_of_two_unit_systems_is_warned_of_by_its_condition_number(outcome):
    text = """OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 1 P Q ; M = MODE L
    'MECANIQUE' 'ELASTIQUE' 'BARR' ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 1. ;
    K = (RIGI M A) ET (BLOQ 'UY' L) ET (APPU 'UX' {} P) ; U = RESO K (FORC (1. 0.) Q) ;
    U = RESO K (FORC (2. 0.) Q) ;"""
    result = outcome(text.format("2.E5"))
    assert messages(result) == []
    result = outcome(text.format("2.E-1"))
    (said,) = messages(result)
    assert "condition number of the matrix" in said
    assert "the softest 2.0e-01 (UX at node 1)" in said


@pytest.mark.parametrize("bad", ["nan", "inf", "-1.E999"])
def test_gap_in_a_motion_file_is_refused_with_its_line(outcome, tmp_path, bad):
    (tmp_path / "m.txt").write_text(f"0.0 1.0\n0.01 {bad}\n0.02 3.0\n")
    result = outcome(f"OPTI ACQU '{tmp_path}/m.txt' ; ACQU L1*'LISTREEL' 6 ;")
    assert result.exit_code == 1
    assert f"m.txt, line 2: '{bad}' is no number" in result.message
    (tmp_path / "m.csv").write_text(f"0.0;1.0\n0.01;{bad}\n0.02;3.0\n")
    result = outcome(f"A B = LIRE 'CSV' '{tmp_path}/m.csv' 'SEPA' ';' ;")
    assert result.exit_code == 1
    assert f"m.csv, line 2: '{bad}' is no finite number" in result.message


BLOCK = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
C = DROI 4 (0. 0.) (1. 0.) ; SOL = C TRAN 2 (0. -1.) ;
A = DROI 4 (0. 0.) (1. 0.) ; BLOC = A TRAN 2 (0. 1.) ;
J = RACC 0.01 {sides} ;
MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; AJ = MATE MJ 'KN' 1.E9 'KS' 1.E9 ;
M = MODE (SOL ET BLOC) 'MECANIQUE' 'ELASTIQUE' ; MA = MATE M 'YOUN' 1.E9 'NU' {nu} 'RHO' 2000. ;
T = TABL ; T . 'MODELE' = M ET MJ ; T . 'CARACTERISTIQUES' = MA ET AJ ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' (COTE 3 SOL) ;
T . 'CHARGEMENT' = CHAR 'MECA' ((MASS M MA) * (MANU 'CHPO' BLOC 1 'UY' {g})) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. ;
"""


WALKS = [("A C", False), ("(INVE A) C", True), ("C A", True), ("(INVE C) A", False)]
"""What RACC or LIAI is given, and whether the joint opens under its block's weight."""


@pytest.mark.parametrize(("sides", "swapped"), WALKS)
def test_swapped_sides_are_warned_of(outcome, sides, swapped):
    result = outcome(BLOCK.format(sides=sides, g="-9.81", nu="0.") + "PASAPAS T ;")
    assert any("its sides are swapped" in w for w in messages(result)) is swapped


@pytest.mark.parametrize(("sides", "swapped"), WALKS)
def test_swapped_sides_of_faces_are_warned_of_too(outcome, sides, swapped):
    text = f"""
    OPTI DIME 3 ELEM CUB8 ;
    C = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) ; SOL = C VOLU 'TRAN' 1 (0. 0. -1.) ;
    V = C VOLU 'TRAN' 1 (0. 0. 1.) ; BLOC A = PLUS V C (0. 0. 0.) ; J = LIAI {sides} ;
    MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ; AJ = MATE MJ 'KN' 1.E9 'KS' 1.E9 ;
    M = MODE (SOL ET BLOC) 'MECANIQUE' 'ELASTIQUE' ; MA = MATE M 'YOUN' 1.E9 'NU' 0. 'RHO' 1. ;
    T = TABL ; T . 'MODELE' = M ET MJ ; T . 'CARACTERISTIQUES' = MA ET AJ ;
    T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' (FACE 2 SOL) ;
    T . 'CHARGEMENT' = CHAR 'MECA' ((MASS M MA) * (MANU 'CHPO' BLOC 1 'UZ' -9.81)) ;
    T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ;
    """
    result = outcome(text)
    assert any("its sides are swapped" in w for w in messages(result)) is swapped
    assert result.exit_code == int(swapped)


POINTS = """
OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ;
C = DROI 1 (0. 0.) (1. 0.) ; SOL = C TRAN 1 (0. -1.) ;
A = DROI 1 (0. 0.) (1. 0.) ; BLOC = A TRAN 1 (0. 1.) ;
C1 = C POIN 'INIT' ; C2 = C POIN 'FINA' ; A1 = A POIN 'INIT' ; A2 = A POIN 'FINA' ;
J = (MANU 'SEG2' {first}) ET (MANU 'SEG2' {second}) ;
MJ = MODE J 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' 'JOI1' ;
AJ = MATE MJ 'KN' 1.E9 'KS' 1.E9 'DIRECTION' (0. {way}) ;
M = MODE (SOL ET BLOC) 'MECANIQUE' 'ELASTIQUE' ; MA = MATE M 'YOUN' 1.E9 'NU' 0. 'RHO' 2000. ;
T = TABL ; T . 'MODELE' = M ET MJ ; T . 'CARACTERISTIQUES' = MA ET AJ ;
T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' (COTE 3 SOL) ;
T . 'CHARGEMENT' = CHAR 'MECA' ((MASS M MA) * (MANU 'CHPO' BLOC 1 'UY' -9.81)) ;
T . 'TEMPS_CALCULES' = PROG 0. 1. ; PASAPAS T ;
"""


@pytest.mark.parametrize(
    ("first", "second", "way", "swapped"),
    [
        ("C1 A1", "C2 A2", "1.", False),
        ("C1 A1", "C2 A2", "-1.", True),
        ("A1 C1", "A2 C2", "-1.", False),
        ("A1 C1", "A2 C2", "1.", True),
    ],
)
def test_a_joint_of_two_points_is_turned_by_its_direction_or_its_points(
    outcome, first, second, way, swapped
):
    result = outcome(POINTS.format(first=first, second=second, way=way))
    assert any("its sides are swapped" in w for w in messages(result)) is swapped
    assert result.exit_code == int(swapped)


def test_the_same_block_stands_where_it_is_pressed(outcome):
    result = outcome(BLOCK.format(sides="A C", g="-9.81", nu="0.") + "PASAPAS T ;")
    assert result.exit_code == 0
