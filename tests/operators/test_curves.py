"""EVOL in its kinds, parts of curves, arithmetic, interpolation, integrals."""

import pytest

from ssilang.cli.run import run_text

TENT = "E = EVOL 'MANU' 'TEMPS' (PROG 0. 1. 2.) 'DEPL' (PROG 0. 3. 1.) ; "
LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 10 (0. 0.) (3. 4.) ; X Y = COOR L ; "


def test_curve_in_time_from_fields_and_from_tables(found):
    script = (
        "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; M = P ET Q ; "
        "A = MANU 'CHPO' M 'UX' 1. 'UY' 2. ; LC = SUIT A (A * 3.) (A * 5.) ; LT = PROG 0. 1. 4. ; "
        "E = EVOL 'TEMP' LC LT 'UY' P ; F = EVOL 'TEMP' LC LT (LECT 1 3) (MOTS 'UX' 'UY') M ; "
        "T = TABL 'PASAPAS' ; T . 'TEMPS' = TABL ; T . 'DEPLACEMENTS' = TABL ; "
        "REPE B 3 ; I = &B - 1 ; T . 'TEMPS' . I = EXTR LT &B ; "
        "T . 'DEPLACEMENTS' . I = EXTR LC &B ; FIN B ; G = EVOL 'TEMP' T 'UX' Q ; "
    )
    e, f, g = found(script, "E", "F", "G")
    assert e.parts[0].abscissas.tolist() == [0, 1, 4]
    assert e.parts[0].ordinates.tolist() == [2, 6, 10]
    assert len(f.parts) == 4
    assert f.parts[0].ordinates.tolist() == [1, 5]
    assert g.parts[0].ordinates.tolist() == [1, 3, 5]
    assert g.parts[0].abscissas.tolist() == [0, 1, 4]


def test_integral_around_a_loop_is_the_area_inside(found):
    loop = "X = PROG 0. 2. 3. 1. 0. ; Y = PROG 0. 0. 5. 5. 0. ; "  # a parallelogram 2 x 5
    assert found(loop + "A = INTG (EVOL 'MANU' X Y) ;", "A") == pytest.approx(-10.0)
    result = run_text(loop + "A = INTG (EVOL 'MANU' X Y) 'BORN' 0. 1. ;")
    assert "abscissas must increase" in result.message


def test_curve_in_time_at_a_point_of_a_cell(found):
    part = found(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 3 (0. 0.) (1. 0.) ; C = MANU 'CHML' L 'SMXX' 2. ; "
        "T = TABL 'PASAPAS' ; T . 'TEMPS' = TABL ; T . 'CONTRAINTES' = TABL ; "
        "REPE B 3 ; I = &B - 1 ; T . 'TEMPS' . I = 0.5 * I ; T . 'CONTRAINTES' . I = C * I ; "
        "FIN B ; E = EVOL 'TEMP' T 'CONTRAINTES' 'SMXX' 1 2 1 ;",
        "E",
    ).parts[0]
    assert part.abscissas.tolist() == [0, 0.5, 1]
    assert part.ordinates.tolist() == [0, 2, 4]


@pytest.mark.parametrize(
    ("names", "kept"),
    [
        (("F(T)", "G(T)"), ("F(T)", "G(T)")),
        (("'TIME'", "'FORCE'"), ("TIME", "FORCE")),
        (("TIME", ""), ("TIME", "")),
        (("'F (T)'", "X"), ("F (T)", "X")),
    ],
)
def test_one_name_stands_before_each_list(found, names, kept):
    text = "E = EVOL 'MANU' {} (PROG 0. 1.) {} (PROG 2. 3.) ;"
    part = found(text.format(*names), "E").parts[0]
    assert (part.abscissa_name, part.ordinate_name) == kept


@pytest.mark.parametrize(
    ("place", "legends"),
    [
        ("P1", ["UX P1"]),
        ("(POIN 1 L)", ["UX P1"]),
        ("(POIN 2 L)", ["UX 3"]),
        ("L", ["UX P1", "UX 3", "UX TOP"]),
    ],
)
def test_legends_name_the_points_of_the_script(found, place, legends):
    e = found(
        "OPTI DIME 2 ; P1 = 0. 0. ; TOP = 2. 0. ; L = (P1 ET (1. 0.)) ET TOP ; "
        "C = MANU 'CHPO' L 1 'UX' 2. ; "
        f"E = EVOL 'TEMP' (SUIT C C) (PROG 0. 1.) 'UX' {place} ; ",
        "E",
    )
    assert [p.legend for p in e.parts] == legends
