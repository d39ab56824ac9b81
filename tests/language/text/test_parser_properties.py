"""Properties of the parser: any text gives a script or errors with places; printing is faithful."""

import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from script_printer import print_script, same_tree

from ssilang.language.say.diagnostics import render
from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse

_SECONDS = 2.0  # for a text of a few hundred characters; a loop without end would pass it
_QUICK = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])

_WORDS = "SI SINON FINSI REPE FIN DEBP FINP DEBM FINM B1 x T TEXT ' '' ( ) ; = . % + - * ** / <EG"
_MORE = "< 1 1. .5 -2 1.E5 1.D , @P &B1 !G é $$$$ # A*ENTIER B/MOT"
_PIECES = st.sampled_from(
    [*_WORDS.split(), *_MORE.split(), " ", "\n", "\n*", "\t", '"', "\x00", "'a b'"]
)
_SIGNS = st.sampled_from(["+", "-", "*", "/", "**", "<", ">EG"])


def parse_or_explain(text: str) -> None:
    """Parse; every error must have a place and render in both languages, in time."""
    start = time.process_time()
    try:
        script = parse(Source("test", text))
    except SeveralErrors as several:
        problems = several.errors
    else:
        problems = []
        again = parse(Source("printed", print_script(script)))
        assert same_tree(script.body, again.body)
    assert all(e.span is not None and render(e, "en") and render(e, "fr") for e in problems)
    assert time.process_time() - start < _SECONDS


_TEXTS = {
    "pieces": st.lists(_PIECES, max_size=40).map("".join),
    "words": st.lists(_PIECES, max_size=40).map(" ".join),
    "letters": st.text(max_size=120),
}


@_QUICK
@pytest.mark.parametrize("kind", _TEXTS)
@given(data=st.data())
def test_any_text_parses_or_is_explained(kind, data):
    parse_or_explain(data.draw(_TEXTS[kind]))


def test_digits_of_other_alphabets_are_no_numbers():
    for text in ("%²", "X = O%³ ;", "X = O % ٣ ;", "T . ² = 1 ;", "X = ٣ + 1² ;", "OPTI DIME ² ;"):
        parse_or_explain(text)
    (statement,) = parse(Source("test", "X = O%1 ;")).body
    assert statement.items[0].name == 1


@_QUICK
@given(st.binary(max_size=120))
def test_any_bytes_are_read(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("bytes") / "deck.dgibi"
    path.write_bytes(data)
    parse_or_explain(read_source(path).text)


# ---- scripts that are right, printed and parsed again ------------------------------------------

_names = st.from_regex(r"[A-Z][A-Z0-9_]{0,7}", fullmatch=True).filter(
    lambda n: n[:4] not in {"SI", "SINO", "FINS", "REPE", "FIN", "DEBP", "FINP", "DEBM", "FINM"}
)
_numbers = st.one_of(
    st.integers(-(10**6), 10**6).map(str),
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
)
_strings = st.text(
    st.characters(blacklist_categories=("Cs", "Cc")), max_size=8
).map(lambda s: "'" + s.replace("'", "''") + "'")  # fmt: skip
_leaves = st.one_of(_names, _numbers, _strings)
_items = st.recursive(
    _leaves,
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=4).map(lambda p: f"({' '.join(p)})"),
        st.tuples(_names, inner).map(lambda p: f"{p[0]} . {p[1]}"),
        st.tuples(inner, _SIGNS, inner).map(" ".join),
    ),
    max_leaves=6,
)
_plain = st.one_of(
    st.tuples(_names, st.lists(_items, min_size=1, max_size=4)).map(
        lambda p: f"{p[0]} = {' '.join(p[1])} ;"
    ),
    st.tuples(_names, st.lists(_items, max_size=4)).map(lambda p: f"{p[0]} {' '.join(p[1])} ;"),
)
_blocks = st.recursive(
    _plain,
    lambda inner: st.one_of(
        st.tuples(_items, inner, inner).map(
            lambda p: f"SI {p[0]} ;\n{p[1]}\nSINON ;\n{p[2]}\nFINSI ;"
        ),
        st.tuples(_names, inner).map(lambda p: f"REPE {p[0]} 3 ;\n{p[1]}\nFIN {p[0]} ;"),
        st.tuples(_names, inner).map(
            lambda p: f"DEBP {p[0]} A*MAILLAGE B/FLOTTANT ;\n{p[1]}\nFINP A B ;"
        ),
    ),
    max_leaves=5,
)


@_QUICK
@given(st.lists(_blocks, min_size=1, max_size=4).map("\n".join))
def test_a_printed_script_parses_to_the_same_tree(text):
    script = parse(Source("test", text))
    printed = print_script(script)
    again = parse(Source("printed", printed))
    assert same_tree(script.body, again.body), printed


@_QUICK
@given(st.data())
def test_mutated_decks_parse_or_are_explained(data):
    text = _deck()
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(text)))
        drop = data.draw(st.integers(0, 5))
        text = text[:at] + data.draw(_PIECES) + text[at + drop :]
    parse_or_explain(text)


@pytest.mark.parametrize(
    "text", ["X = T % 'l''aire' ;", "X = 'a'%' b'' c' ;", "X = T % 'a\n  b' ;"]
)
def test_quoted_names_behind_a_percent_sign_say_what_strings_say(text):
    parse_or_explain(text)


def _deck() -> str:
    return """* a plate that is pulled
OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ;
P1 = 0. 0. ; P2 = 1. 0. ; L1 = P1 DROI 4 P2 ; S1 = L1 TRAN 2 (0. 1.) ;
DEBP RATIO A*FLOTTANT B/FLOTTANT ;
  SI (EXIS B) ; R = A / B ; SINON ; R = A ; FINSI ;
FINP R ;
T1 = TABL ; T1 . 'LIST' = PROG 1. PAS 0.5 4. ;
REPE B1 (DIME T1 . 'LIST') ;
  X = EXTR T1 . 'LIST' &B1 ;
  SI (X > 2.) ; ITER B1 ; FINSI ;
  MESS 'x = ' X*20 ' l''essai' ;
FIN B1 ;
FIN ;
"""
