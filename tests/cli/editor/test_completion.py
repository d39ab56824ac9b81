"""What Tab offers."""

from __future__ import annotations

import pytest

from ssilang.cli.editor.completion import completions
from ssilang.cli.run import run_text


@pytest.fixture(scope="module")
def session():
    text = "LENGTH = 3. ; T1 = TABL ; T1 . 'ALPHA' = 1 ; T1 . 'BETA' = TABL ; T1 . 'BETA' . 7 = 1 ;"
    return run_text(text).session


@pytest.mark.parametrize(
    ("text", "prefix", "expected"),
    [
        ("DRO", "DRO", "DROIT"),
        ("x = dro", "dro", "DROIT"),
        ("x = LEN", "LEN", "LENGTH"),
        ("@VER", "@VER", "@VERIFIE"),
        ("REP", "REP", "REPETER"),
        ("OPTI DIM", "DIM", "DIME"),
        ("OPTI 'DIM", "'DIM", "'DIME'"),
        ("x = T1 . ", "", "'ALPHA'"),
        ("x = T1 . 'AL", "'AL", "'ALPHA'"),
        ("x = T1 . AL", "AL", "'ALPHA'"),
        ("x = T1 . 'BETA' . ", "", "7"),
    ],
)
def test_candidates(session, text, prefix, expected):
    found_prefix, found = completions(text, session)
    assert found_prefix == prefix
    assert expected in found


def test_keywords_belong_to_the_statement_under_the_cursor(session):
    _, found = completions("OPTI DIME 2 ; x = ELE", session)
    assert "ELEMENT" in found or "ELEM" in found
    _, found = completions("x = 1 ; y = 'DI", session)
    assert "'DIME'" not in found


def test_a_table_offers_the_entries_of_the_procedures_that_it_suits():
    made = run_text("T1 = TABL ; T1 . 'RIGI' = 1 ; T1 . 'MASS' = 1 ;").session
    _, found = completions("x = T1 . 'TEMPS", made)
    assert "'TEMPS_CALCULES'" in found
    assert "'CHARGEMENT'" not in completions("x = T1 . 'CHAR", made)[1]
