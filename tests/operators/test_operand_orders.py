"""Operands and keywords in odd orders mean what they mean in the usual one."""

import pytest

_CURVES = "E = EVOL 'MANU' 't' (PROG 0. 1.) 'u' (PROG -5. 5.) ; F = E ET E ; "
_FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 2 'UX' 1. 'UY' 9. ; L = SUIT C C ; "


@pytest.mark.parametrize(
    ("before", "usual", "odd"),
    [
        (_FIELD, "EXTR L 'VALE' P 'UY'", "EXTR L 'VALE' 'UY' P"),
        ("", "DIAD 'INVE' (PROG 1. 3. 7.)", "DIAD (PROG 1. 3. 7.) 'INVE'"),
        (_CURVES, "BORN F 1 'MAXI' 1. 2 'MINI' 0.", "BORN 1 'MAXI' 1. F 2 'MINI' 0."),
        (_CURVES, "E COUL ROUG", "COUL 'ROUG' E"),
    ],
)
def test_the_order_of_operands_is_free(printed, before, usual, odd):
    assert printed(f"{before}LIST ({odd}) ;") == printed(f"{before}LIST ({usual}) ;")


@pytest.mark.parametrize(
    ("statement", "says"),
    [
        ("LIST 'RESU' ;", "Word of 4 characters: RESU"),
        ("LIST '*' ;", "Word of 1 character: *"),
        ("X = 3 ; LIST *ENTIER ;", "  X                        ENTIER   3"),
    ],
)
def test_words_that_are_spelt_like_keywords_are_operands_where_operands_stand(
    printed, statement, says
):
    assert printed(statement)[-1] == says
