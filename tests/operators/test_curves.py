"""EVOL in its kinds, parts of curves, arithmetic, interpolation, integrals."""

import pytest

from ssilang.cli.run import run_text

LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 10 (0. 0.) (3. 4.) ; X Y = COOR L ; "


def test_integral_around_a_loop_is_the_area_inside(found):
    loop = "X = PROG 0. 2. 3. 1. 0. ; Y = PROG 0. 0. 5. 5. 0. ; "  # a parallelogram 2 x 5
    assert found(loop + "A = INTG (EVOL 'MANU' X Y) ;", "A") == pytest.approx(-10.0)
    result = run_text(loop + "A = INTG (EVOL 'MANU' X Y) 'BORN' 0. 1. ;")
    assert "abscissas must increase" in result.message


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
