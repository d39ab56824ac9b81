"""Section 7: numbers that become a point."""

import pytest


def test_two_numbers_are_a_point_in_two_dimensions(run):
    assert run("OPTI DIME 2 ; p = 1. 2. ;").kind("p") == "POINT"


def test_three_integers_are_a_point_in_three_dimensions(run):
    assert run("OPTI DIME 3 ; p = 0 0 0 ;").kind("p") == "POINT"


def test_two_numbers_in_three_dimensions_miss_one(fails):
    assert fails("OPTI DIME 3 ; p = «1. 2.» ;") == "third-coordinate"


def test_no_point_without_dimension(fails):
    assert fails("p = 1. 2. ;") == "excess"


def test_two_names_take_two_numbers(run):
    script = run("OPTI DIME 2 ; x y = 1. 2. ;")
    assert (script["x"], script["y"]) == (1.0, 2.0)


@pytest.mark.parametrize("place", ["t . 'A'", "t . 'T' . 'A'", "t . 'T' . 1 . 'A'"])
def test_the_index_of_a_table_takes_a_point(run, place):
    inner = "t = TABL ; t . 'T' = TABL ; t . 'T' . 1 = TABL ;"
    script = run(f"OPTI DIME 2 ; {inner} {place} = 3. -4. ; k = COOR 2 ({place}) ;")
    assert script["k"] == -4.0


def test_numbers_in_a_parenthesis_are_a_point(run):
    assert run("OPTI DIME 2 ; p = (1. 2.) PLUS (1. 0.) ; x = COOR 1 p ;")["x"] == 2.0


def test_operators_run_before_the_point_is_made(run):
    script = run("OPTI DIME 2 ; p = (1. + 1.) 3. ; x y = COOR p ;")
    assert (script["x"], script["y"]) == (2.0, 3.0)


def test_a_point_carries_the_density_in_force(run):
    script = run("OPTI DIME 2 ELEM SEG2 DENS 0.25 ; n = NBEL (DROI (0. 0.) (1. 0.)) ;")
    assert script["n"] == 4
