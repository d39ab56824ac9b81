"""Section 12: objects and methods."""

_COUNTER = """
DEBM INCREASE n*ENTIER ; %COUNT = %COUNT + n ; FINM %COUNT ;
DEBM COUNTER ; %COUNT = 0 ; %METHODE ADD INCREASE ; FINM ;
"""


def test_an_object_runs_its_constructor(run):
    assert run(_COUNTER + "o = OBJE COUNTER ; x = o%COUNT ;")["x"] == 0


def test_a_method_changes_its_object(run):
    assert run(_COUNTER + "o = OBJE COUNTER ; o%ADD 3 ; x = o%ADD 4 ;")["x"] == 7


def test_objects_do_not_share_attributes(run):
    script = run(_COUNTER + "o = OBJE COUNTER ; p = OBJE COUNTER ; o%ADD 3 ; x = p%COUNT ;")
    assert script["x"] == 0
