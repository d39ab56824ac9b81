"""EVOL in its kinds, parts of curves, arithmetic, interpolation, integrals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.cli.run import run_text

TENT = "E = EVOL 'MANU' 'TEMPS' (PROG 0. 1. 2.) 'DEPL' (PROG 0. 3. 1.) ; "
LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 10 (0. 0.) (3. 4.) ; X Y = COOR L ; "


def test_curve_holds_lists_names_legend_and_colour(found):
    curve = found(
        "E = EVOL 'ROUG' 'MANU' 'LEGE' 'measured' 'TEMPS' (PROG 0. 1.) 'DEPL' (PROG 5. 6.) ; "
        "X = EXTR E 'ABSC' ; Y = EXTR E 'DEPL' ; NX = EXTR E 'LEGX' ; C = EXTR E 'COUL' 1 ; "
        "N = DIME E ;",
        "X", "Y", "NX", "C", "N", "E",
    )  # fmt: skip
    x, y, name, colour, count, whole = curve
    assert x.values.tolist() == [0, 1]
    assert y.values.tolist() == [5, 6]
    assert (name, colour, count) == ("TEMPS", "ROUG", 1)
    assert whole.parts[0].legend == "measured"


def test_curve_along_a_line_has_its_length_as_abscissa(found):
    x, y = found(
        LINE + "E = EVOL 'CHPO' (X * Y) 'SCAL' L ; A = EXTR E 'ABSC' ; B = EXTR E 'ORDO' ;",
        "A", "B",
    )  # fmt: skip
    s = np.linspace(0, 5, 11)
    np.testing.assert_allclose(x.values, s, atol=1e-12)
    np.testing.assert_allclose(y.values, 0.6 * s * 0.8 * s, atol=1e-12)


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


def test_extreme_of_a_curve_gives_place_and_coordinates(found):
    assert found(TENT + "I X Y = MAXI E ;", "I", "X", "Y") == (2, 1.0, 3.0)
    assert found(TENT + "I X Y = MINI E ;", "I", "X", "Y") == (1, 0.0, 0.0)
    places = found(TENT + "I X Y = MAXI (E ET (E * -1.)) 'ABS' ;", "I")
    assert places.values.tolist() == [2, 2]


@pytest.mark.parametrize(
    ("words", "x", "y"),
    [
        ("'PAS' 2", [0, 20, 40], [5, 7, 1]),
        ("'COMP' 'INDI' 2 4", [5, 20, 30], [8, 7, 6]),
        ("'APRE' 'INDI' 2 'ZERO'", [0, 15, 25, 35], [8, 7, 6, 1]),
        ("'AVAN' 20.", [0, 5, 20], [5, 8, 7]),
        ("'APRE' 20.", [20, 30, 40], [7, 6, 1]),
    ],
)
def test_part_of_a_curve(words, x, y, found):
    part = found(
        f"E = EVOL 'MANU' (PROG 0. 5. 20. 30. 40.) (PROG 5. 8. 7. 6. 1.) ; F = EXTR E {words} ;",
        "F",
    ).parts[0]
    assert part.abscissas.tolist() == x
    assert part.ordinates.tolist() == y


def test_curves_are_picked_by_number_and_axis_name(found):
    script = (
        "LX = PROG 0. 1. ; LY = PROG 0. 2. ; E = (EVOL 'MANU' 'X' LX 'Y' LY) ET "
        "(EVOL 'MANU' 'X' LX 'Z' (LY * 2.)) ; A = EXTR E 'COUR' 'Z' ; B = EXTR E 'COUR' 1 ; "
    )
    a, b = found(script, "A", "B")
    assert a.parts[0].ordinates.tolist() == [0, 4]
    assert b.parts[0].ordinates.tolist() == [0, 2]


def test_sum_of_curves_lives_on_their_common_abscissas(found):
    part = found(TENT + "F = EVOL 'MANU' (PROG 0.5 3.) (PROG 10. 20.) ; G = E + F ;", "G").parts[0]
    assert part.abscissas.tolist() == [0.5, 1, 2]
    np.testing.assert_allclose(part.ordinates, [11.5, 15, 17])


def test_complex_curves_multiply_as_complex_numbers(found):
    a, b = found(
        "X = PROG 0. 1. ; E = EVOL 'COMP' 'REIM' 'F' X 'A' (PROG 1. 2.) 'B' (PROG 3. -1.) ; "
        "M = EVOL 'COMP' 'MOPH' 'F' X 'A' (PROG 2. 1.) 'B' (PROG 90. 180.) ; "
        "P = E * M ; Q = M * E ;",
        "P", "Q",
    )  # fmt: skip
    z = np.array([(1 + 3j) * 2j, (2 - 1j) * -1])
    np.testing.assert_allclose(a.parts[0].ordinates + 1j * a.parts[1].ordinates, z, atol=1e-14)
    np.testing.assert_allclose(b.parts[0].ordinates, np.abs(z), rtol=1e-14)
    np.testing.assert_allclose(b.parts[1].ordinates, np.degrees(np.angle(z)), rtol=1e-13)


@given(st.floats(-1, 3))
@settings(max_examples=25, deadline=None)
def test_linear_interpolation_is_that_of_numpy(t):
    result = run_text(TENT + f"Y = IPOL ({t!r} * 1.) E ;")
    expected = np.interp(t, [0, 1, 2], [0, 3, 1])
    assert result.session.root.find("Y") == pytest.approx(expected, abs=1e-15)


def test_interpolation_of_lists_fields_and_decreasing_abscissas(found):
    script = (
        LINE
        + TENT
        + (
            "A = IPOL (PROG 0.5 1.5) E ; B = IPOL 0.5 (PROG 2. 1. 0.) (PROG 1. 3. 0.) ; "
            "F = IPOL X E ; C = MAXI F ; G = X * E ; D = MAXI (F - G) 'ABS' ; "
        )
    )
    a, b, c, d = found(script, "A", "B", "C", "D")
    assert a.values.tolist() == [1.5, 2.0]
    assert b == 1.5
    assert c == pytest.approx(np.interp(np.linspace(0, 3, 11), [0, 1, 2], [0, 3, 1]).max())
    assert d == 0


def test_clamped_spline_reproduces_a_cubic(found):
    x = np.array([0.0, 1.0, 2.5, 4.0])
    values = " ".join(repr(float(v)) for v in x**3)
    y = found(
        f"Y = IPOL (PROG 0.3 1.7 3.9) (PROG 0. 1. 2.5 4.) (PROG {values}) "
        "'SPLI' 'DGAU' 0. 'DDRO' 48. ;",
        "Y",
    )
    np.testing.assert_allclose(y.values, np.array([0.3, 1.7, 3.9]) ** 3, rtol=1e-12)


def test_all_values_of_a_curve_that_goes_back(found):
    y = found("Y = IPOL 0.5 (PROG 0. 1. 0.) (PROG 0. 1. 2.) 'TOUS' ;", "Y")
    assert y.values.tolist() == [0.5, 1.5]


def test_point_at_a_distance_along_a_line(found):
    x = found(
        "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; L = DROI 4 P (3. 4.) ; S = COOR 'CURV' L ; "
        "Q = IPOL S 2.5 ; X = COOR 1 Q ;",
        "X",
    )
    assert x == pytest.approx(1.5)


def test_field_between_those_of_a_table(found):
    x = found(
        "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'T' 3. ; T = TABL 'RESULTAT' ; "
        "T . 1.5 = C ; T . 3. = C * 2. ; X = EXTR (IPOL T 2.) 'T' P ;",
        "X",
    )
    assert x == pytest.approx(3 * 2 / 3 + 6 / 3)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("", 3.5),
        ("'BORN' 0.5 1.5", 2.25 / 2 + 2.5 / 2),
        ("'BORN' 1.5 0.5", -(2.25 / 2 + 2.5 / 2)),
        ("'INDI' 1 2", 1.5),
    ],
)
def test_integral_by_trapezes(words, expected, found):
    assert found(TENT + f"Y = INTG E {words} ;", "Y") == pytest.approx(expected)


def test_integral_of_a_curve_run_backwards_changes_sign(found):
    back = "E = EVOL 'MANU' (PROG 2. 1. 0.) (PROG 0. 1. 3.) ; "
    assert found(back + "Y = INTG E ;", "Y") == pytest.approx(-2.5)
    assert found(back + "Y = INTG E 'INDI' 3 2 ;", "Y") == pytest.approx(2.0)
    assert found(back + "Y = INTG E 'BORN' 0.5 2. ;", "Y") == pytest.approx(1.25)


def test_integral_around_a_loop_is_the_area_inside(found):
    loop = "X = PROG 0. 2. 3. 1. 0. ; Y = PROG 0. 0. 5. 5. 0. ; "  # a parallelogram 2 x 5
    assert found(loop + "A = INTG (EVOL 'MANU' X Y) ;", "A") == pytest.approx(-10.0)
    result = run_text(loop + "A = INTG (EVOL 'MANU' X Y) 'BORN' 0. 1. ;")
    assert "abscissas must increase" in result.message


def test_integrals_over_several_intervals_and_of_several_curves(found):
    a, b = found(
        TENT + "A = INTG E 'BORN' (PROG 0. 1.) (PROG 1. 2.) ; B = INTG (E ET (E * 2.)) ;", "A", "B"
    )
    np.testing.assert_allclose(a.values, [1.5, 2.0])
    np.testing.assert_allclose(b.values, [3.5, 7.0])


def test_title_and_legend_change_in_a_new_curve(found):
    e, f = found(TENT + "F = CHAN 'LEGE' E 1 'later' ; F = CHAN 'TITR' F 'all' ;", "E", "F")
    assert (e.parts[0].legend, f.parts[0].legend, f.title) == ("", "later", "all")


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


def test_words_as_abscissas_stand_at_whole_numbers_and_come_back(found):
    words, second, total = found(
        "E = EVOL 'MANU' 'CAS' (MOTS 'A' 'B' 'C') 'Y' (PROG 1. 2. 4.) ; L = EXTR (2. * E) 'ABSC' ; "
        "M = EXTR (EXTR E 'PAS' 2) 'CAS' ; X = INTG E ;",
        "L", "M", "X",
    )  # fmt: skip
    assert [w.strip() for w in words.values] == ["A", "B", "C"]
    assert [w.strip() for w in second.values] == ["A", "C"]
    assert total == pytest.approx(1.5 + 3.0)  # trapezoids of width 1


@pytest.mark.parametrize(
    "phrase",
    [
        "IPOL 0.5 L M", "IPOL L M 0.5", "IPOL L 0.5 M", "IPOL E 0.5", "IPOL 0.5 E",
        "IPOL L M 0.5 'SPLI'", "IPOL 'SPLI' 0.5 E",
    ],
)  # fmt: skip
def test_place_of_the_number_in_an_interpolation_is_free(found, phrase):
    lists = "L = PROG 0. 1. ; M = PROG 2. 4. ; E = EVOL 'MANU' L M ; "
    assert found(f"{lists}X = {phrase} ;", "X") == pytest.approx(3.0)


def test_all_ordinates_of_a_curve_that_goes_back(found):
    for phrase in ("0.5 L M 'TOUS'", "'TOUS' L M 0.5"):
        made = found(f"L = PROG 0. 1. 0. ; M = PROG 2. 4. 8. ; X = IPOL {phrase} ;", "X")
        assert made.values.tolist() == [3.0, 6.0]


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
