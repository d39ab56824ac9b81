"""Section 5: the pile of operands and the first unread word; which forms are tried."""

import pytest
from together import together

from ssilang.cli.run import run_text
from ssilang.language.run.call import Call


@pytest.mark.parametrize(
    ("phrase", "value"),
    [
        ("n = 3 ; x = n. EGA 3", True),
        ("n = 3 ; x = n. ega 4", False),
        ("n = 3. ; x = n . NEG 3.", False),
    ],
)
def test_an_operator_behind_the_dot_of_a_number_is_one(run, phrase, value):
    from ssilang.cli.check import check_source
    from ssilang.language.text.source import Source

    made = run(f"{phrase} ;")
    assert made["x"] == value
    assert [w.code for w in made.result.session.warnings] == ["dot-of-number"]
    assert [p.code for p in check_source(Source("test", f"{phrase} ; MESS x ;"))[0]] == [
        "dot-of-number"
    ]


@pytest.mark.parametrize("script", ["OPTI DIME 2 ; a = 2. ; p = a. 0. ; MESS (TYPE p) ;"])
def test_a_dot_behind_a_number_is_checked_as_it_runs(script):
    from ssilang.cli.check import check_source
    from ssilang.language.text.source import Source

    assert [p.code for p in check_source(Source("test", script))[0]] == ["dot-of-number"]


FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 2 'UX' 3. 'UY' 4. ;\n"


@together(
    "phrase",
    ["X = BRUI 'BLAN' 'UNIF' 0. 1. 3", "X = EXCO C 'UX'", "X = EXCO C (MOTS 'UX')", "X = MAXI C"],
)
def test_no_error_is_made_where_a_later_form_fits(monkeypatch, phrase):
    made = []
    for name in ("missing", "error"):
        was = getattr(Call, name)
        monkeypatch.setattr(
            Call, name, lambda self, *a, was=was, **k: made.append(a) or was(self, *a, **k)
        )
    assert run_text(f"{FIELD}{phrase} ;").exit_code == 0
    assert not made


def test_one_place_reads_other_types_and_words_at_each_turn():
    script = (
        f"{FIELD}T = TABL ; T . 1 = MOT 'UX' ; T . 2 = MOTS 'UY' ; T . 3 = MOT 'UY' ; S = 0. ;\n"
        "REPE B 3 ; S = S + (MAXI (EXCO C (T . &B))) ; FIN B ;"
    )
    assert run_text(script).session.root.find("S") == 3.0 + 4.0 + 4.0


def test_the_error_is_the_same_the_second_time():
    first, second = (run_text("X = EXCO 3. 4. ;").message for _ in range(2))
    assert first == second
    assert "EXCO" in first
