"""TABLO2D TABLO3D MONTAGNE @AFEVOZT FILC INT_COMP @SOLVMEC."""

import pytest
from script_runs import found, ran, refused
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


@needs_window
def test_relief_takes_a_second_field_and_an_eye(tmp_path):
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = ((0. 0.) DROI 3 (2. 0.)) TRAN 3 (0. 2.) ; "
        "MONTAGNE (COOR 1 S) (COOR 2 S) S (PROG 9. 9. 9.) ;"
    )
    assert len(drawn(script, tmp_path)[1]) == 1
    assert "not NONSENSE" in refused(script.replace("(PROG 9. 9. 9.)", "'NONSENSE'"))


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


def test_curves_of_other_abscissas_are_interpolated():
    script = _CURVES + (
        "T . 2 = EVOL 'MANU' (PROG 0. 2.) (PROG 1. 7.) ; M C = @AFEVOZT T ; "
        "D = MAXI (ABS (C - (2. * (COOR 1 M)) - (3. * (COOR 2 M)))) ;"
    )
    assert found(script, "D") == pytest.approx(0.0, abs=1e-12)
    assert "no curve 4" in refused(_CURVES + "T . 'TEMPS' = PROG 0. 1. 2. 3. ; M C = @AFEVOZT T ;")


def test_low_pass_gives_back_as_many_points_as_it_got():
    script = (
        "T = PROG 0. 'PAS' 0.01 'NPAS' 99 ; E = FILC (EVOL 'MANU' T ((0. * T) + 2.)) 45. 2. ; "
        "N = DIME (EXTR E 'ABSC') ; X = EXTR (EXTR E 'ORDO') 50 ;"
    )
    count, value = found(script, "N", "X")
    assert count == 100
    assert value == pytest.approx(2.0, abs=0.05)
    assert "does not fit" in refused("E = FILC (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) 1. 4. ;")


def test_field_is_carried_by_the_elements_of_its_mesh():
    """A bilinear field is exact on QUA4 at any point inside."""
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = ((0. 0.) DROI 2 (2. 0.)) TRAN 2 (0. 1.) ; OPTI ELEM SEG2 ; "
        "L = (0.3 0.2) DROI 7 (1.5 0.8) ; F = NOMC 'T' ((COOR 1 S) * (COOR 2 S)) ; "
        "G = INT_COMP S F L ; D = MAXI (ABS (G - (NOMC 'T' ((COOR 1 L) * (COOR 2 L))))) ; "
        "N = EXTR (EXTR G 'COMP') 1 ;"
    )
    error, name = found(script, "D", "N")
    assert error == pytest.approx(0.0, abs=1e-9)
    assert str(name).strip() == "T"


def test_steps_are_those_of_pasapas():
    script = (
        "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 1 (1. 0.)) TRAN 1 (0. 1.) ; "
        "MO = MODE S MECANIQUE ELASTIQUE ; T = TABL ; F = FORC (0. 1.) (COTE 3 S) ; "
        "T . 'MODELE' = MO ; T . 'CARACTERISTIQUES' = MATE MO YOUN 10. NU 0. ; "
        "T . 'BLOCAGES_MECANIQUES' = BLOQ 'DEPL' (COTE 1 S) ; T . 'TEMPS_CALCULES' = PROG 0. 1. "
        "2. ; "
        "T . 'CHARGEMENT' = CHAR 'MECA' F (EVOL 'MANU' (PROG 0. 2.) (PROG 0. 2.)) ; @SOLVMEC T ; "
        "X = MAXI (EXCO 'UY' (T . 'DEPLACEMENTS' . 2)) ;"
    )
    assert found(script, "X") == pytest.approx(0.2, rel=1e-9)
    assert "has no MODELE" in refused("T = TABL ; @SOLVMEC T ;")


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
