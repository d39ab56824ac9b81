"""TRIA 'TOPO': boundaries filled with simplices, in the plane and in space."""

import pytest
from script_runs import ran
from together import together

SQUARE = (
    "OPTI DIME 2 ELEM TRI3 ; A = 0. 0. ; B = 3. 0. ; C = 3. 2. ; D1 = 0. 2. ; "
    "L = (DROI 9 A B) ET (DROI 5 B C) ET (DROI 9 C D1) ET (DROI 5 D1 A) ; T = TABL ; "
)
BOX = (
    "OPTI DIME 3 ELEM TRI3 ; L = DROI 3 (0. 0. 0.) (2. 0. 0.) ; S = L TRAN 2 (0. 1. 0.) ; "
    "OPTI ELEM TET4 ; V = S VOLU 2 TRAN (0. 0. 1.) ; S = ENVE V ; OPTI ELEM TRI3 ; "
    "S = CHAN TRI3 S ; T = TABL ; "
)


def root_of(text: str):
    return ran(text).session.root


def test_a_hole_stays_empty():
    text = SQUARE + (
        "E = 1. 0.5 ; F = 2. 0.5 ; G = 2. 1.5 ; H = 1. 1.5 ; L2 = (DROI 3 E F) ET (DROI 3 F G) ET "
        "(DROI 3 G H) ET (DROI 3 H E) ; X = MESU (TRIA 'TOPO' (L ET L2)) ; "
        "Y = MESU (TRIA 'TOPO' 'NOAJ' (L ET L2)) ;"
    )
    root = root_of(text)
    assert (root.find("X"), root.find("Y")) == pytest.approx((5.0, 5.0))


@together("script, name, volume", [(SQUARE, "L", 6.0), (BOX, "S", 2.0)])
def test_the_table_gets_what_the_mesher_found(script, name, volume):
    root = root_of(
        script + f"M = TRIA 'TOPO' {name} T ; X = MESU M ; Q = INDI 'TOPO' M ; Y = MINI Q ; "
        "Z = MAXI Q ; N = NBEL (T . 'curtopo') ; NM = NBEL M ;"
    )
    table = root.find("T")
    assert root.find("X") == pytest.approx(volume)
    assert table.get("dvol") == pytest.approx(0.0, abs=1e-12)
    assert (table.get("nnul"), root.find("N")) == (0, root.find("NM"))
    assert (table.get("miq"), table.get("maq")) == pytest.approx((root.find("Y"), root.find("Z")))
    assert table.get("miq") <= table.get("moq") <= table.get("maq")
