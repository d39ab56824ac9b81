"""Blocks, the end of a run, names that a script assigns, and scripts printed again."""

import pytest

from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.parser import end_of_run
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import first_assignments


@pytest.mark.parametrize(
    "text",
    [
        "A = 1 ; FIN ;",
        "REPETER B1 3 ; A = 1 ; FIN B1 ; FIN ;",
        "REPE B1 3 ; FIN ; FIN B1 ; FIN ;",
        "SI VRAI ; FIN ; SINON ; FIN ; FINSI ; FIN ;",
        "SI VRAI ; REPETER B1 3 ; FIN ; FIN B1 ; FIN ; FINSI ; 'FIN' ;",
        "DEBPROC P1 X*ENTIER ; FIN ; FINPROC X ; FIN;",
        "M = 'FIN ; it''s ;' ; FIN ;",
    ],
)
def test_a_run_ends_at_the_first_fin_outside_of_all_blocks(text):
    assert end_of_run(Source("x", f"{text} remarks ( that are no statement ;")) == len(text)


@pytest.mark.parametrize("text", ["A = 1 ;", "SI VRAI ; FIN ;", "REPE B1 2 ; FIN B1 ;"])
def test_a_script_without_fin_has_no_end(text):
    assert end_of_run(Source("x", text)) is None


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("SI VRAI ; FIN B1 ;", ["stray-block-end", "unclosed-block"]),
        ("DEBP P1 ; FIN B1 ; FINP ;", ["stray-block-end"]),
        ("REPE B1 2 ; SI VRAI ; FIN B1 ;", ["crossed-blocks"]),
        ("REPE B1 2 ; SI VRAI ; FIN B1 ; FINSI ;", ["crossed-blocks"]),
    ],
)
def test_blocks_end_with_their_own_word(text, codes):
    with pytest.raises(SeveralErrors) as caught:
        parse(Source("x", text))
    assert [e.code for e in caught.value.errors] == codes


def test_names_are_assigned_where_they_first_get_a_value():
    text = (
        "A = 1 ; REPE B1 2 ; B = 2 ; A = 3 ; FIN B1 ; SI VRAI ; C = 1 ; SINON ; D = 1 ; FINSI ;"
        " DEBP P1 X*ENTIER ; E = X ; FINP E ; F G = 1 2 ; T . 1 = 3 ;"
    )
    found = first_assignments(parse(Source("x", text)).body)
    assert list(found) == ["A", "B", "C", "D", "P1", "F", "G"]
    assert [found[n].start for n in "ABCDFG"] == [
        text.index(s) for s in ("A =", "B =", "C =", "D =", "F G", "G =")
    ]
