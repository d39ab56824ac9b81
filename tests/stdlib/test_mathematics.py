"""@INTLIN @MOD @ARR @FIX @STAT POLYNO FZERO QUADRATU MULC SIGNDERI against closed forms."""

import math

import numpy as np
import pytest
from script_runs import failed, found


@pytest.mark.parametrize("a", [-7, -6, 0, 5, 8])
def test_remainder_is_that_of_python(a):
    assert found(f"X = @MOD {a} 3 ;", "X") == a % 3
    assert found(f"X = @MOD {a}.5 3 ;", "X") == pytest.approx((a + math.copysign(0.5, a)) % 3)


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("@ARR 3.14159 2", "3.14"),
        ("@ARR 2.71828 3", "2.718"),
        ("@ARR -7.6 0", "-8"),
        ("@ARR 0.00012 2", "1.20E-4"),
        ("@ARR 12345.6 1 'EXPOSANT'", "1.2E4"),
        ("@FIX 2.71828 3", "2.718"),
        ("@FIX 2.999 1", "2.9"),
        ("@FIX -2.719 2", "-2.71"),
    ],
)
def test_number_becomes_a_short_word(phrase, expected):
    assert found(f"X = {phrase} ;", "X") == expected


def test_regression_line_is_that_of_least_squares():
    x, y = np.array([0, 1.85, 4.65, 7, 10, 11]), np.array([2.25, 2.0, 1.75, 1.4, 1.0, 0.8])
    lists = [" ".join(repr(float(v)) for v in values) for values in (x, y)]
    values = found(
        f"XM EX YM EY A B R = @STAT (PROG {lists[0]}) (PROG {lists[1]}) ;",
        "XM", "EX", "YM", "EY", "A", "B", "R",
    )  # fmt: skip
    slope, level = np.polyfit(x, y, 1)
    expected = (x.mean(), x.std(), y.mean(), y.std(), slope, level, np.corrcoef(x, y)[0, 1])
    assert values == pytest.approx(expected, rel=1e-10)


def test_zero_of_functions_within_the_tolerance():
    script = "DEBP F X*FLOTTANT ; Y = (EXP X) - 3. ; FINP Y ; A = FZERO F 0. 2. ; "
    a, b = found(
        script + "DEBP G X*FLOTTANT ; Y = X ** 3 ; FINP Y ; B = FZERO G -1. 2. ;", "A", "B"
    )
    assert a == pytest.approx(math.log(3), abs=1e-13)
    assert b == pytest.approx(0, abs=1e-4)  # a triple root: cube root of the rounding of Y


def test_function_of_one_sign_has_no_zero():
    result = failed("DEBP F X*FLOTTANT ; Y = (X * X) + 1. ; FINP Y ; A = FZERO F 0. 2. ;")
    assert "same sign" in result.message


@pytest.mark.parametrize(
    ("law", "moment"),
    [("NORM", 945.0), ("UNIF", 3**5 / 11), ("EXPO", math.factorial(10))],
)
def test_quadrature_is_exact_up_to_twice_its_points(law, moment):
    """Tenth moment of the centred normal, uniform and exponential (from zero) laws, 6 points."""
    mean = 1 if law == "EXPO" else 0
    value = found(
        f"T = QUADRATU '{law}' {mean}. 1. 6 ; S = 0. ; "
        "REPE B 6 ; S = S + ((T . &B . 'POIDS') * ((T . &B . 'POINT') ** 10)) ; FIN B ;",
        "S",
    )
    assert value == pytest.approx(moment, rel=1e-8)


def test_corrected_accelerogram_ends_at_rest():
    v, d = found(
        "E = EVOL 'MANU' 'T' (PROG 0. PAS 0.1 NPAS 50) 'A' (BRUI 'BLAN' 'GAUS' 0.3 1. 51) ; "
        "F = SIGNDERI E ; V = EXTR (EXTR (PRIM F) 'ORDO') 51 ; "
        "D = EXTR (EXTR (PRIM (PRIM F)) 'ORDO') 51 ;",
        "V", "D",
    )  # fmt: skip
    assert abs(v) < 1e-12
    assert abs(d) < 1e-12


def test_product_of_fields_by_component():
    script = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 'UX' 3. 'UY' 4. ; "
    assert found(script + "X = MAXI (MULC C C) ; Y = MINI (MULC C C) ;", "X", "Y") == (16.0, 9.0)


def test_remainders_by_the_items_of_a_list():
    whole, pairs, reals = found(
        "A = @MOD 7 (LECT 2 4) ; B = @MOD (LECT 7 8) (LECT 2 3) ; C = @MOD 7.5 (PROG 2. 4.) ;",
        "A", "B", "C",
    )  # fmt: skip
    assert whole.values.tolist() == [7 % 2, 7 % 4]
    assert pairs.values.tolist() == [7 % 2, 8 % 3]
    assert reals.values.tolist() == [1.5, 3.5]
