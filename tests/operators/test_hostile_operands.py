"""Senseless operands end in a message that says what is wrong, never in a defect."""

import pytest
from script_runs import session_after

from ssilang.cli.run import execute
from ssilang.language.say.diagnostics import sentence
from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source

OBJECTS = """
OPTI 'DIME' 3 'ELEM' 'CUB8' 'MODE' 'TRID' ; DENS 0.5 ;
A = 0. 0. 0. ; B = 1. 0. 0. ; E = 0. 1. 0. ; L1 = DROI 2 A B ; W1 = L1 TRAN 2 E ;
MO = MODE L1 'MECANIQUE' 'BARR' ; MA = MATE MO 'YOUN' 2. 'NU' 0. 'RHO' 1. 'SECT' 1. ;
R1 = RIGI MO MA ; U1 = MANU 'CHPO' L1 1 'UX' 2. ; MZ = VIDE 'MAILLAGE' ;
T1 = PROG 0. 'PAS' 0.1 1. ; EV = EVOL 'MANU' 'T' T1 'A' T1 ; P0 = PROG ; K1 = MOTS 'UX' 'UY' ;
"""


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_after(OBJECTS, tmp_path_factory.mktemp("hostile"))


@pytest.mark.parametrize(
    ("statement", "says"),
    [
        ("X = BRUI 'BLAN' 'POIS' 7 2 -1", "skip >= 0"),
        ("X = SPO EV 'AMOR' 0.05 'FREQ' P0 'DEPL'", "one frequency"),
        ("X = SIAR EV 1. 'ACCE' 'NPOI' -1", "n_instants > 0"),
        ("X = IPOL 0.5 T1 P0 'SPLI'", "as many"),
        ("X = LIGN 'TRAN' 3 B E 0.5", "no angle"),
        ("X = LIGN 'ROTA' 3 W1 A E 20.", "mesh"),
        ("X = RELA 'GLIS' A W1", "line"),
        ("X = LECT (T1 * 1.E30)", "64 bits"),
        ("X = LECT ((PROG 0.) / (PROG 0.))", "64 bits"),
        ("X = RAFF (PROG 0. 1. 1.E9) 0.5", "too long"),
        ("X = RAFF (PROG 0. 1.) 1000000000", "too long"),
        ("X = RAFF ((PROG 0.) / (PROG 0.)) 0.5", "finite"),
    ],
)
def test_senseless_operands_are_refused_in_words(session, statement, says):
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", statement + " ;"))
    assert caught.value.code != "internal"
    assert says in sentence(caught.value, "en")[0]


def test_crossing_of_a_very_long_surface_ends(session):
    """Its triangles are flat to rounding: the walk around a hole may come back to itself."""
    surfaces = (
        "OPTI ELEM TRI3 ; LA = DROI 2 (0. 0. 0.) (1.E9 0. 0.) ; SA = LA TRAN 2 (0. 2. 0.) ; "
        "LB = DROI 2 (-1. 1.1 -1.) (3. 1.1 -1.) ; SB = LB TRAN 2 (0. 0. 2.) ; OPTI ELEM CUB8 ; "
    )
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", surfaces + "C D L M = INTE 'GEOM' SA SB ;"))
    assert caught.value.code != "internal"


def test_sum_of_squares_joins_fields_of_one_kind(session):
    with pytest.raises(SsiError) as caught:
        execute(session, Source("statement", "X = XTX 2. U1 MA 3. ;"))
    assert caught.value.code == "excess" or caught.value.code == "wrong-argument"


def test_an_empty_mesh_has_no_connected_parts(session):
    for parts in ("CCON MZ", "CCON 'STR1' MZ", "PART 'CONN' 'NESC' MZ"):
        execute(session, Source("statement", f"X = DIME ({parts}) ;"))
        assert session.root.find("X") == 0


def test_no_free_motion_means_no_projected_solution(session):
    with pytest.raises(SsiError) as caught:
        execute(
            session,
            Source("statement", "X N M = RESO (MASS MO MA) (MANU 'CHPO' L1 1 'SCAL' 2.) 'ENSE' ;"),
        )
    assert caught.value.code != "internal"
