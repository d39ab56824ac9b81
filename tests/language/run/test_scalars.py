"""Sections 6 and 11: scalars, lists, words, texts and what is printed."""

import math

import pytest


@pytest.mark.parametrize(
    ("phrase", "value"),
    [
        ("7 / 2", 3), ("-7 / 2", -3), ("2 ** 3", 8), ("7 / 2.", 3.5), ("1 + 1.", 2.0),
        ("2. ** 0.5", math.sqrt(2)), ("3 * 2", 6), ("9 / 3", 3),
    ],
)  # fmt: skip
def test_integers_stay_integers_and_mixtures_are_real(run, phrase, value):
    found = run(f"x = {phrase} ;")["x"]
    assert type(found) is type(value)
    assert found == pytest.approx(value)


@pytest.mark.parametrize(
    ("phrase", "value"),
    [("1 EGA 1.5", True), ("1. EGA 1", True), ("1 NEG 2", True), ("3 > 2", True), ("3 < 2", False),
     ("2 >EG 2", True), ("2 <EG 1", False), ("EGA 'ab' 'ab   '", True)],
)  # fmt: skip
def test_comparisons(run, phrase, value):
    assert run(f"x = {phrase} ;")["x"] is value


@pytest.mark.parametrize(
    ("phrase", "value"),
    [("SIN 30.", 0.5), ("COS 60.", 0.5), ("TAN 45.", 1.0), ("ATG 1.", 45.0), ("ASIN 1.", 90.0),
     ("ACOS 0.", 90.0), ("EXP 0.", 1.0), ("LOG 1.", 0.0), ("ABS -3.", 3.0), ("ATG 1. -1.", 135.0)],
)  # fmt: skip
def test_functions_work_in_degrees(run, phrase, value):
    assert run(f"x = {phrase} ;")["x"] == pytest.approx(value, abs=1e-12)


def test_functions_take_lists(run):
    assert list(run("x = SIN (PROG 0. 90.) ;")["x"].values) == pytest.approx([0.0, 1.0])


def test_conversions(run):
    script = run("a = ENTI 2.7 ; b = ENTI -2.7 ; c1 = FLOT 3 ; d1 = ENTI 'PROCHE' 2.7 ;")
    assert (script["a"], script["b"], script["c1"], script["d1"]) == (2, -2, 3.0, 3)
    assert isinstance(script["c1"], float)


@pytest.mark.parametrize(
    ("phrase", "length"),
    [("'TOTO'*10", 10), ("'TOTO'/10", 13), ("'TITI' 'TOTO'<10", 14), ("'TITI' 'TOTO'>10", 17)],
)
def test_tab_marks_of_chai(run, phrase, length):
    assert len(run(f"x = CHAI {phrase} ;")["x"]) == length


def test_erre_5_fails_and_erre_0_does_not(run, fails):
    assert fails("«ERRE» 5 ;") == "erre"
    run("ERRE 0 ;")


def test_type_exis_and_oubl(run):
    script = run(
        "a = 3 ; k = TYPE a ; e = EXIS a ; OUBL a ; f = TYPE a ; g = EXIS a ; h = EXIS b ;"
    )
    assert script["k"].rstrip() == "ENTIER"
    assert script["f"].rstrip() == "ANNULE"
    assert (script["e"], script["g"], script["h"]) == (True, False, True)
