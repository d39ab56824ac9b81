"""Section 11: words, texts and what is printed."""

import pytest


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
