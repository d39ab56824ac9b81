"""Which forms of operators a run has gone through."""

from typing import NoReturn

import pytest
from forms_ran import FormsRan

from ssilang.cli.run import RunOptions, run_text
from ssilang.language.registry import (
    OPERATORS,
    arg,
    each,
    either,
    group,
    said,
    select,
    shared,
)


@pytest.fixture
def declared():
    made = shared("ZTRY", "test", "")

    @made.form(
        select("how", {"ONCE": (), "DEEP": (select("in", {"LEFT": (), "RIGH": ()}),)}, False)
    )
    def chosen(how):
        return 1

    @made.form(arg("x", "FLOTTANT"))
    def number(x):
        return x

    @made.form(
        said("PAIR"),
        either("all", group("pairs", each("of", select("k", {"A": (), "B": ()}, False)))),
    )
    def grouped(all):
        return 2

    @made.form(said("WRON"))
    def refused() -> NoReturn:
        raise AssertionError

    yield made
    del OPERATORS["ZTRY"]


def _missing(declared, script):
    ran = FormsRan()
    result = run_text(script, options=RunOptions(on_form=ran))
    assert result.exit_code == 0, result.message
    return ran.missing(declared)


def test_forms_that_did_not_run_are_named_by_their_number(declared):
    assert _missing(declared, "MESS 1 ;") == ["1", "2", "3"]
    assert _missing(declared, "X = ZTRY 1.5 ;") == ["1", "3"]


def test_words_of_a_choice_are_named_behind_those_that_lead_to_them(declared):
    left = _missing(declared, "X = ZTRY 'DEEP' 'LEFT' ;")
    assert left == ["1 ONCE", "1 DEEP RIGH", "2", "3"]
    assert _missing(declared, "X = ZTRY 'ONCE' ; X = ZTRY 'DEEP' 'RIGH' ;")[0] == "1 DEEP LEFT"


def test_words_in_groups_are_seen(declared):
    assert _missing(declared, "X = ZTRY 'PAIR' 'B' ;") == ["1", "2", "3 A"]


def test_signs_between_numbers_are_seen_though_they_have_a_short_way():
    assert _missing(OPERATORS["+"], "X = 1 + 2 ;") == []
    assert _missing(OPERATORS["-"], "X = 1 + 2 ;") == ["1"]


def test_what_ends_the_run_is_seen():
    assert _missing(OPERATORS["FIN"], "FIN ;") == []
