"""TABLO2D TABLO3D MONTAGNE @AFEVOZT FILC INT_COMP @SOLVMEC."""

import pytest
from script_runs import found, ran
from together import together

from tests.windows import needs_window


def drawn(script, folder):
    return ran(script, output_directory=folder), sorted(folder.rglob("*.png"))


_STATE = "OPTI DIME 2 MODE PLAN CONT ELEM SEG3 ; "
_SAME = "A = EGA (VALE 'MODE') 'PLANCONT' ; B = EGA (VALE 'ELEM') 'SEG3' ; C = VALE 'DIME' ;"


@pytest.mark.parametrize(
    "call",
    [
        "TABLO2D 2 3 (PROG 1. 2. 3. 6. 5. 4.) 'Six values' ;",
        "TABLO2D 'LOGA' 2 2 (PROG 1. -1000. 0. 10.) ;",
        "TABLO2D 1 1 (PROG 3.) ;",
        "TABLO3D 'LINE' 2 3 (PROG 1. 2. 3. 6. 5. 4.) 'Six values' ;",
        "TABLO3D 'ZLOG' 0. FAUX 2 2 (PROG 1. -1000. 0. 10.) ;",
        "TABLO3D 1 1 (PROG 3.) ;",
    ],
)
@needs_window
def test_tables_are_drawn_and_leave_the_options_alone(call, tmp_path):
    result, pictures = drawn(_STATE + call + _SAME, tmp_path)
    assert len(pictures) == 1
    assert [result.session.root.find(n) for n in "ABC"] == [True, True, 2]


@pytest.mark.parametrize("word", ["'VOLUME'", "'VOLUME' 'CACHE'", "'FLECHE'", "'SUPER'"])
@needs_window
def test_reliefs_are_drawn_and_leave_the_options_alone(word, tmp_path):
    script = (
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA8 ; S = ((0. 0.) DROI 3 (2. 0.)) TRAN 3 (0. 2.) ; "
        f"OPTI ELEM SEG3 ; Z = (COOR 1 S) * (COOR 2 S) ; MONTAGNE Z S 0.5 'TITRE' 'Hill' {word} ; "
    )
    result, pictures = drawn(script + _SAME, tmp_path)
    assert [p.name for p in pictures] == ["0001_hill.png"]
    assert [result.session.root.find(n) for n in "ABC"] == [True, True, 2]


_CURVES = (
    "OPTI DIME 2 ELEM QUA4 ; T = TABL ; T . 'TEMPS' = PROG 0. 1. 4. ; Z = PROG 0. 'PAS' 0.5 2. ; "
    "REPE B 3 ; X = EXTR (T . 'TEMPS') &B ; T . &B = EVOL 'MANU' Z ((3. * Z) + X) ; FIN B ; "
)


@together(
    "words, width, height, slope",
    [
        ("", (0.0, 2.0), (0.0, 2.0), (2.0, 3.0)),
        ("'HORIZONTAL' -0.5", (0.0, 2.0), (-1.0, 0.0), (3.0, -4.0)),
        ("'VERTICAL' 2.", (0.0, 4.0), (0.0, 2.0), (1.0, 3.0)),
    ],
)
def test_curves_become_a_field_in_time_and_place(words, width, height, slope):
    """Ordinate 3 z + t: linear in both directions of the mesh."""
    script = _CURVES + (
        f"M C = @AFEVOZT T {words} ; X = COOR 1 C ; Y = COOR 2 C ; XA = MINI X ; XB = MAXI X ; "
        f"YA = MINI Y ; YB = MAXI Y ; D = MAXI (ABS (C - ({slope[0]} * X) - ({slope[1]} * Y))) ; "
        "N = NBEL (ELEM M 'SEG2') ; A = MESU (ELEM M 'TRI3') ; E = EGA (VALE 'ELEM') 'QUA4' ;"
    )
    script = script.replace("COOR 1 C", "COOR 1 M").replace("COOR 2 C", "COOR 2 M")
    xa, xb, ya, yb, error, lines, area, kept = found(
        script, "XA", "XB", "YA", "YB", "D", "N", "A", "E"
    )
    assert (xa, xb, ya, yb) == pytest.approx((*width, *height))
    assert error == pytest.approx(0.0, abs=1e-12)
    assert lines == 12
    assert area == pytest.approx((xb - xa) * (yb - ya))
    assert kept is True


def test_solvmec_follows_large_displacements():
    """A bar pulled to 1.5 times its length, NU 0: S = E (1.5^2 - 1) / 2 and F = 1.5 S A."""
    text = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ; S = ((0. 0.) DROI 1 (1. 0.)) TRAN 1 (0. 1.) ; "
        "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; D = BLOQ 'UX' (COTE 2 S) ; T = TABL ; "
        "T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MATE MO 'YOUN' 10. 'NU' 0. ; "
        "T . 'BLOCAGES_MECANIQUES' = (BLOQ 'UX' (COTE 4 S)) ET (BLOQ 'UY' (COTE 1 S)) ET D ; "
        "T . 'CHARGEMENT' = CHAR 'DIMP' (DEPI D 0.5) (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; "
        "T . 'TEMPS_CALCULES' = PROG 0. PAS 0.02 1. ; T . 'GRANDS_DEPLACEMENTS' = {} ; "
        "@SOLVMEC T ; X = RESU (REDU (EXCO (T . 'REACTIONS' . 50) 'FX' 'FX') (COTE 2 S)) ; "
        "F = MAXI X ;"
    )
    large, small = (found(text.format(word), "F") for word in ("VRAI", "FAUX"))
    assert small == pytest.approx(5.0)
    assert large == pytest.approx(1.5 * 10.0 * (1.5**2 - 1.0) / 2.0, rel=1e-6)
