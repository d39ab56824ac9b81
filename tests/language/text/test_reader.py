"""The quick reader gives what the grammar gives, and gives up on what the grammar refuses."""

import dataclasses
import re
import time
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from references.grammar_tree import read_by_grammar
from together import together

from ssilang.language.say.errors import SsiError
from ssilang.language.text.by_grammar import words_of_grammar
from ssilang.language.text.parser import grammar_words, quick_reader
from ssilang.language.text.reader import Unsound
from ssilang.language.text.source import Source, Span
from ssilang.language.text.source_files import read_source

_ROOT = Path(__file__).resolve().parents[3]
_FILES = sorted([*_ROOT.glob("cases/*/*.ssi"), *_ROOT.glob("stdlib/*.ssi")])
_PIECES = st.sampled_from(
    [
        *"AB;;;()()=.%'*+-/<> \n,1",
        *("T . 1", "A%B", " %B", "**", "<EG", "'a''b'", "1.5", "-2", "1.D-3", ".5", "1E7", "&I"),
        *(
            " X = ",
            " (A B) ",
            " . 'U' ",
            " . (1 + 1) ",
            "4A",
            "2 . 3",
            "@P",
            "()",
            "FIN ;",
            "B. ;",
            "B. / 2.",
        ),
    ]
)


def test_blanks_are_passed_over_without_what_early_pythons_get_wrong():
    """Behind possessive quantifiers Python 3.11.2 loses groups: no script was read there."""
    made = str(re._parser.parse(quick_reader()._token.pattern))
    assert "SUBPATTERN" in made
    assert "POSSESSIVE" not in made
    assert "ATOMIC" not in made


def tree(node):
    """A parsed object as nested tuples, places too."""
    if isinstance(node, Span):
        return node.start, node.end
    if dataclasses.is_dataclass(node):
        parts = [getattr(node, f.name) for f in dataclasses.fields(node)]
        return (type(node).__name__, *(tree(p) for p in parts))
    if isinstance(node, (list, tuple)):
        return tuple(tree(n) for n in node)
    return node


def quick(source):
    return quick_reader().read(source, source.code)


@together("path", _FILES, by=lambda p: p.parent.name)
def test_decks_give_the_grammars_tree(path):
    source = read_source(path)
    text = source.code
    if not text.rstrip().endswith(";"):
        source = Source(source.name, source.text + "\n;")
    assert tree(quick(source)) == tree(read_by_grammar(source))


@settings(max_examples=400, deadline=None)
@given(st.lists(_PIECES, max_size=25))
@example(["1E7", "1", "1"])
@example(["A", " = ", ";"])
@example(["A", " = ", "(B. / 2.", ")", ";"])
def test_any_text_is_read_or_refused_as_by_the_grammar(pieces):
    source = Source("any", "".join(pieces))
    try:
        expected = read_by_grammar(source)
    except SsiError as refused:  # a number too long to be kept
        told = refused.code, refused.data
        with pytest.raises(SsiError) as found:
            quick(source)
        assert (found.value.code, found.value.data) == told
        return
    if expected is None:
        with pytest.raises((Unsound, SsiError)) as found:
            quick(source)
        assert getattr(found.value, "code", "long-real") == "long-real"
        return
    assert tree(quick(source)) == tree(expected)


@together(
    "text, sound",
    [
        ("% A ;", True),  # the object that runs a method
        ("X = % A ;", True),
        ("B%A ;", True),
        ("(B) % A ;", True),
        ("X = 1 %A ;", True),
        ("X = 1%A ;", None),
        ("'W'%A ;", None),
        ("T . 1%A ;", False),
        ("T . X%A ;", False),
        ("B%A%C ;", None),
        ("(%A) ;", True),
        ("B % ;", False),
        ("% ;", False),
        ("X = %;", False),
    ],
)
def test_signs_of_attributes_stand_behind_what_has_some(text, sound):
    source = Source("x", text)
    expected = read_by_grammar(source)
    if sound is not None:
        assert (expected is not None) == sound
    try:
        assert tree(quick(source)) == tree(expected)
    except Unsound:
        assert expected is None


@together("read", [quick, read_by_grammar])
def test_an_empty_parenthesis_has_its_place(read):
    (statement,) = read(Source("x", "A = PROG () ;"))
    assert statement.items[1].span.text == "()"


def test_kept_words_are_those_of_the_grammar(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    for _ in range(2):  # made, then read
        assert grammar_words() == words_of_grammar()
    assert len(list((tmp_path / "ssilang" / "started").iterdir())) == 1


@together("damage", ["", "{", "[1, 2]", '{"sum": 1, "words": 3}', "cut", "changed"])
def test_damaged_words_are_made_again(tmp_path, monkeypatch, damage):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    grammar_words()
    (path,) = (tmp_path / "ssilang" / "started").iterdir()
    good = path.read_text()
    texts = {"cut": good[:-20], "changed": good.replace("OWN", "OWM")}
    path.write_text(texts.get(damage, damage))
    assert grammar_words() == words_of_grammar()
    assert path.read_text() == good


def test_words_need_no_folder(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    assert grammar_words() == words_of_grammar()


@together("read", [quick, read_by_grammar])
@together(
    "text, value",
    [
        ("1.5d3", 1500.0), ("1.5D-3", 0.0015), ("2e2", 200.0), ("2.E+2", 200.0), ("-.5d1", -5.0),
        ("7", 7), ("-12", -12), ("0.25", 0.25), ("3.", 3.0),
    ],
)  # fmt: skip
def test_numbers_have_their_values(read, text, value):
    (statement,) = read(Source("x", f"A = {text} ;"))
    found = statement.items[0].value
    assert (type(found), found) == (type(value), value)


@together("written", [" . T", " . (1)", " . 'U' . 2"])
def test_a_long_path_is_read_in_a_time_that_grows_with_it(written):
    """A copy of all indices at each dot would take some 7 s."""
    count = 30_000
    text = f"X = T{written * count} ;"
    start = time.process_time()
    (statement,) = quick(Source("long", text))
    assert time.process_time() - start < 2.5
    (path,) = statement.items
    assert len(path.indices) == count * written.count(".")
    assert (path.span.start, path.span.end) == (4, len(text) - 2)


def test_paths_within_paths_keep_their_own_indices():
    (statement,) = quick(Source("nested", "A . 1 . (B . 2 . 3 + (C . 4)) . 5 = D . 6 E . 7 ;"))
    (outer,) = statement.targets
    assert [len(p.indices) for p in (outer, *statement.items)] == [3, 1, 1]
    inner, _, last = outer.indices[1].items
    assert len(inner.indices) == 2
    assert [i.value for i in last.items[0].indices] == [4]
