"""`ssilang format`: the same tree, the same comments, and nothing left to do a second time."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_printer import same_tree
from together import together

from ssilang.cli.editor.formatting import formatted
from ssilang.language.text.source import Source
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.resources import resource

DECKS = sorted(
    p for folder in ("cases", "stdlib") for p in resource(folder).rglob("*.ssi") if p.is_file()
)

MESSY = """\
* head
opti  DIME 2   ELEM  SEG2;
SI ( A  EGA 2 );
* inside



X=-1   ;Y = X -1;
   SINON;
REPE  BOU 3;
  T.'K' = 'a   b'   et
 'c'   ;
   * 2 ;
*mid
FIN BOU;
FINSI;
L = PROG 1.,2.,
   3. * 2 , 4;
S = 'long
    text'   ;
FIN ;
 what stands   here ;
"""
NEAT = """\
* head
opti DIME 2 ELEM SEG2 ;
SI (A EGA 2) ;
* inside


  X = -1 ; Y = X -1 ;
SINON ;
  REPE BOU 3 ;
    T.'K' = 'a   b' et
       'c' ;
    * 2 ;
*mid
  FIN BOU ;
FINSI ;
L = PROG 1., 2.,
   3. * 2, 4 ;
S = 'long
    text' ;
FIN ;
 what stands   here ;
"""


def comments(text: str) -> list[str]:
    return [line.rstrip() for line in text.split("\n") if re.match(r"\*|\$\$\$\$", line)]


def assert_kept(text: str) -> str:
    """The layout of a sound text, after what it must keep was looked at."""
    made = formatted(Source("case.ssi", text))
    again = Source("case.ssi", made)
    assert same_tree(parse(Source("case.ssi", text)).body, parse(again).body)
    assert comments(made) == comments(text)
    assert formatted(again) == made
    return made


def test_blocks_blanks_comments_strings_and_lines():
    assert assert_kept(MESSY) == NEAT


@together("path", DECKS, by=lambda p: p.parent.name)
def test_decks_keep_their_meaning(path):
    assert_kept(read_source(path).text)


_GAPS = st.sampled_from([" ", "  ", "\n", "\n   ", "\t", "\n* note\n", "\n\n\n\n", " , "])
_WORDS = st.sampled_from(
    ["A", "'a  b'", "''", "1", "-1", "2.*B", ".5", "(", ")", "T . 'K'", "T.2", "+", "-", "*", "**",
     "&B1", "=", ";", "SI A ;", "SINON ;", "FINSI ;", "REPE B1 3 ;", "FIN B1 ;", "'l''axe'"]
)  # fmt: skip


@settings(max_examples=300, deadline=None)
@given(st.lists(st.tuples(_WORDS, _GAPS), max_size=30))
def test_whatever_is_sound_keeps_its_meaning(pieces):
    text = "".join(word + gap for word, gap in pieces) + ";\n"
    try:
        parse(Source("case.ssi", text))
    except Exception:  # what is unsound is refused, see below
        return
    assert_kept(text)


@together("text", [";\n   *\nSI A ;", "; B C\n* note\n   *\nSI A ;"])
def test_a_star_that_would_begin_a_comment_stays(text):
    assert_kept(text)


def test_the_command_writes_checks_and_shows(ssilang, tmp_path):
    deck = tmp_path / "case.ssi"
    deck.write_bytes("X=1;\r\n* caf\u00e9\r\nMESS   X;\r\n".encode("latin-1"))
    checked = ssilang("format", "--check", str(deck))
    assert (checked.code, "would be laid out" in checked.out) == (1, True)
    for words in (["--diff"], ["--check", "--diff"]):
        shown = ssilang("format", *words, str(deck))
        assert "+X = 1 ;" in shown.out
        assert (shown.code, "would be laid out" in shown.out) == (1, False)
    assert deck.read_bytes().startswith(b"X=1;")
    done = ssilang("format", str(deck))
    assert done.code == 0
    assert deck.read_bytes() == "X = 1 ;\r\n* caf\u00e9\r\nMESS X ;\r\n".encode("latin-1")
    again = ssilang("format", str(deck))
    assert (again.code, again.out) == (0, "")
    assert ssilang("format", "-", stdin="X=1;").out == "X = 1 ;\n"


def test_unsound_scripts_are_refused_and_left(ssilang, tmp_path):
    deck = tmp_path / "case.ssi"
    deck.write_text("X=(1;\n")
    refused = ssilang("format", str(deck))
    assert refused.code == 1
    assert "parenthesis" in refused.err
    assert deck.read_text() == "X=(1;\n"
    absent = ssilang("format", str(tmp_path / "none.ssi"))
    assert (absent.code, "none.ssi" in absent.err) == (2, True)


@pytest.mark.parametrize("depth", [300, 5_000])
def test_parentheses_nested_deep_are_laid_out(ssilang, depth):
    done = ssilang("format", "-", stdin=f"X={'(' * depth}1{')' * depth};")
    assert (done.code, done.out) == (0, f"X = {'(' * depth}1{')' * depth} ;\n")
