"""The quick reader gives what the grammar gives, and gives up on what the grammar refuses."""

import dataclasses
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.language.errors import SeveralErrors
from ssilang.language.parser import _parser, parse_by_grammar
from ssilang.language.reader import Unsound
from ssilang.language.source import Source, Span

_ROOT = Path(__file__).resolve().parents[2]
_FILES = sorted([*_ROOT.glob("cases/*/*.ssi"), *_ROOT.glob("stdlib/*.ssi")])
_PIECES = st.sampled_from(
    [
        *"AB;;;()()=.%'*+-/<> \n,1",
        *("T . 1", "A%B", " %B", "**", "<EG", "'a''b'", "1.5", "-2", "1.D-3", ".5", "1E7", "&I"),
        *(" X = ", " (A B) ", " . 'U' ", " . (1 + 1) ", "4A", "2 . 3", "@P", "()", "FIN ;"),
    ]
)


def tree(node, spans=True):
    """A parsed object as nested tuples; places too, except those of () alone."""
    if isinstance(node, Span):
        return (node.start, node.end) if spans else None
    if dataclasses.is_dataclass(node):
        parts = [getattr(node, f.name) for f in dataclasses.fields(node)]
        return (type(node).__name__, *(tree(p, spans) for p in parts))
    if isinstance(node, (list, tuple)):
        return tuple(tree(n, spans) for n in node)
    return node


def quick(source):
    return _parser()[2].read(source, source.code)


@pytest.mark.parametrize("path", _FILES, ids=lambda p: p.name)
def test_decks_give_the_grammars_tree(path):
    source = Source.read(path)
    text = source.code
    if not text.rstrip().endswith(";"):
        source = Source(source.name, source.text + "\n;")
    assert tree(quick(source)) == tree(parse_by_grammar(source, source.code))


@settings(max_examples=400, deadline=None)
@given(st.lists(_PIECES, max_size=25))
def test_any_text_is_read_or_refused_as_by_the_grammar(pieces):
    source = Source("any", "".join(pieces))
    try:
        expected = parse_by_grammar(source, source.code)
    except SeveralErrors:
        with pytest.raises(Unsound):
            quick(source)
        return
    spans = "()" not in source.text.replace(" ", "").replace(",", "").replace("\n", "")
    assert tree(quick(source), spans) == tree(expected, spans)


def test_an_empty_parenthesis_has_its_place():
    (statement,) = quick(Source("x", "A = PROG () ;"))
    assert statement.items[1].span.text == "()"
