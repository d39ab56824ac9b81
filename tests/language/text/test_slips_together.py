"""Whatever stands around them, slips of syntax and of blocks are all told in one pass, in place."""

from hypothesis import example, given
from hypothesis import strategies as st
from together import together

from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse

# « and » stand around what is marked
SLIPS = [
    ("x = «(»1 + 2 ;", "unclosed-paren"), ("y = (1 + «(»2 * (3) ;", "unclosed-paren"),
    ("z = 3«)» ;", "extra-paren"), ("z = (1 + 2) * (3)«)» - (4 ;", "syntax"),
    ("w = «=» 2 ;", "second-equal"), ("w = a «=» 2 ;", "second-equal"),
    ("SI (a «=» 2) ;", "equal-comparison"), ("w = (a «=» 3) ;", "equal-comparison"),
    ("«=» 4 ;", "no-target"), ("t . «;»", "nothing-behind"), ("b = t . 'A' .«;»", "nothing-behind"),
    ("l = «1.E309» + 1. ;", "long-real"), ("n = «9223372036854775808» ;", "long-integer"),
    ("l = PROG 1. «-1D999» (2) ;", "long-real"),
]  # fmt: skip
SOUND = [
    "a = 1 ;", "TITR 'text ; (' ;", "* a comment with ' and (\nb = 2 ;", ";", "c = 'l''axe' ;",
    "MESS 'two\n  lines' ;", "SI VRAI ; d = 1 ; SINON ; d = 2 ; FINSI ;", "x y = P (1) ;",
    "REPE b1 2 ; e = 3 ;\nFINSI ; FIN b1 ;", "t . 1 . 'A' = -.5 ;", "DEBP P1 x*ENTIER ; FINP x ;",
]  # fmt: skip
BLOCKS = [
    ("REPE b2 2 ; «SINON» ; FIN b2 ;", "stray-block-end"), ("«FIN nobody» ;", "stray-block-end"),
    ("REPE b2 2 ; FIN «b3» ;", "wrong-loop-name"), ("«SINON» ;", "stray-block-end"),
    ("«FINP x» ;", "stray-block-end"), ("SI VRAI ; «SINON (VRAI)» ; FINSI ;", "sinon-condition"),
    ("SI VRAI ; SINON ; «SINON» ; FINSI ;", "second-sinon"),
]  # fmt: skip


def told(marked):
    """Codes and marked texts of a script's errors, their places, and those that are meant."""
    meant, before = [], ""
    for part, code in marked:
        head, here, rest = part.partition("«")
        place, _, after = rest.partition("»")
        if here:
            meant.append((code, len(before) + len(head), place))
        before += head + place + after + "\n"
    try:
        parse(Source("script", before))
    except SeveralErrors as several:
        found = [(e.code, e.span.start, e.span.text) for e in several.errors]
        return found, meant
    return [], meant


@given(st.lists(st.sampled_from([*SLIPS, *((s, "") for s in SOUND)]), max_size=8))
@example(SLIPS)
@example([(s, "") for s in SOUND])
def test_slips_of_syntax_are_told_together(statements):
    found, meant = told(statements)
    assert sorted(found) == sorted(meant)


@given(st.lists(st.sampled_from([*BLOCKS, *((s, "") for s in SOUND)]), max_size=8))
def test_slips_of_blocks_are_told_together(statements):
    found, meant = told(statements)
    assert found == meant


@together("before", ["", *SOUND])
@together(
    "slip, code",
    [("«SI VRAI» ; x = 1 ;", "unclosed-block"), ("«REPE b2 2» ; x = 1 ;", "unclosed-block"),
     ("«DEBP P x*ENTIER» ; y = x ;", "unclosed-block"),
     ("MESS «'»open ; x = 1 ;", "unclosed-string"), ("«'»open ; x = 1 ;", "unclosed-string"),
     ("«x = 1 +»", "missing-semicolon"), ("«x = PROG 1.»\n2.", "missing-semicolon"),
     ("x = «(»1 + 2", "unclosed-paren")],
)  # fmt: skip
def test_what_is_left_open_at_the_end(before, slip, code):
    found, meant = told([(before, ""), (slip, code)])
    assert found == meant
