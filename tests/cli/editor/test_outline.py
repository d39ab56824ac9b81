"""What Tab offers; the outline, what folds, colours; a text that changes is as a new one."""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from lsprotocol import types as lsp
from pygls.workspace import TextDocument, Workspace

from ssilang.cli.editor import tokens
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.outline import colours, folds, outline
from ssilang.cli.editor.server import make_server
from ssilang.cli.run import run_text
from ssilang.cli.terminal.repl import completions
from ssilang.operators.loader import load_operators

TEXT = """* first
* second
Z1 = 1 ;
DEBP ZP X*ENTIER Y/MOT ;
  ZI = X ;
  REPE BX 2 ;
    AI = ZI ;
    ZI = 2 ;
  FIN BX ;
FINP ZI ;
SI VRAI ;
  A1 = 'it' ;
FINSI ;
* alone
A1 = ZP 3
  'W'
  + 4 ;
T1 = TABL ; T1 . 'K' = 2.5 ; REPE ONE 1 ; Q1 = 1 ; FIN ONE ;
* third
* fourth
"""


def test_names_stand_in_the_procedure_or_loop_that_makes_them():
    document = Document.of(TEXT)
    found = outline(document)
    names = [p.name for p in found]
    assert names == ["Z1", "ZP", "A1", "T1", "ONE"]
    inner = {p.name: [q.name for q in p.inner] for p in found}
    assert inner["ZP"] == ["X", "Y", "ZI", "BX"]
    assert inner["ONE"] == ["Q1"]
    loop = next(q for q in found[1].inner if q.name == "BX")
    assert [q.name for q in loop.inner] == ["AI"]
    assert TEXT[found[1].start : found[1].end].startswith("DEBP ZP")
    assert TEXT[found[1].start : found[1].end].rstrip(" ;").endswith("FINP ZI")
    assert [TEXT[p.name_start : p.name_end] for p in found] == names


def test_what_folds():
    assert sorted(folds(Document.of(TEXT))) == [
        (0, 1, "comment"), (3, 9, "region"), (5, 8, "region"), (10, 12, "region"),
        (14, 16, "region"), (18, 19, "comment"),
    ]  # fmt: skip
    for text, found in (
        ("REPE B 2 ;\nX = 1 ;\nFIN B ;", [(0, 2)]),
        ("X = 1\n  + 2 ;\nY = 1\n + 2\n + 3 ;", [(2, 4)]),
        ("REPE B 2 ;\nFIN ;\nX = 1 ;\nFIN B ;", [(0, 3)]),  # the end of the run closes nothing
        ("DEBP P ;\nSI A ;\nX = 1 ;\nFINP ;", [(0, 3)]),  # what is open within is given up
    ):
        assert [fold[:2] for fold in folds(Document.of(text))] == found


def test_a_name_of_the_script_and_of_a_procedure_stand_in_both():
    first, second = outline(Document.of("ZX = 1 ; DEBP ZP ; ZX = 2 ; ZX = 3 ; FINP ;"))
    assert (first.name, [p.name for p in second.inner]) == ("ZX", ["ZX"])


def test_the_colour_of_each_word():
    load_operators()
    told = [(TEXT[a:b], c) for a, b, c in colours(Document.of(TEXT))]
    assert told[:5] == [
        ("* first", "comment"), ("* second", "comment"), ("Z1", "variable"), ("1", "number"),
        ("DEBP", "keyword"),
    ]  # fmt: skip
    for one in (("DEBP", "keyword"), ("X", "parameter"), ("'it'", "string"), ("'K'", "property"),
                ("TABL", "function"), ("ZP", "function"), ("FINSI", "keyword"),
                ("2.5", "number"), ("* alone", "comment"), ("A1", "variable")):  # fmt: skip
        assert one in told
    text = "O = 1 ; X = O%DROI ; MESS SI X ; Y = %VIBR ; %TABL = 2 ;"
    document = Document.of(text)
    shown = [(text[a:b], c) for a, b, c in colours(document)]
    for attribute in ("DROI", "VIBR", "TABL"):  # of an object, and of the one whose method runs
        assert (attribute, "property") in shown
    assert document.names.defined == {"O", "X", "Y"}
    assert ("SI", "keyword") not in shown


def test_the_colours_of_a_part_are_those_of_the_whole_that_begin_there():
    document = Document.of(TEXT)
    whole, lines = colours(document), TEXT.splitlines(keepends=True)
    starts = [sum(map(len, lines[:i])) for i in range(len(lines) + 1)]
    for first in range(len(lines)):
        for last in range(first + 1, len(lines) + 1):
            start, end = starts[first], starts[last]
            assert colours(document, start, end) == [c for c in whole if start <= c[0] < end]


LINES = [
    "A = 1 ;", "B = 'x;y' ; C = A ;", "* A = 'half ;", "D = 'over", "E' ; F = 2 ;", "G = 'open ;",
    "DEBP PRC X*FLOTTANT Y/ENTIER ;", "Z = X + Y ;", "FINP Z ;", "REPE BOU 3 ; A = &BOU ;",
    "FIN BOU ;", ";;", "H = 'it''s' ;", "  TAB . 'A' = (1 + (2 * 3 ;", "", "quit é § ;",
]  # fmt: skip
PIECES = [
    "'",
    ";",
    "\n",
    "* ",
    "''",
    "(",
    " ",
    "A",
    ";\n",
    "\n*",
    "= 'b' ;",
    "DEBP Q ;\n",
    "FINP ;\n",
]
TEXTS = st.lists(st.sampled_from(LINES), min_size=1, max_size=9).map("\n".join)
CHANGES = st.lists(
    st.tuples(st.floats(0, 1), st.floats(0, 1), st.sampled_from(["", *PIECES])),
    min_size=1,
    max_size=4,
)


@given(TEXTS, CHANGES)
@settings(max_examples=150, deadline=None)
@example("X = 'abc\nY = 3 ; Z = 4\nT = 5 ;", [(1.0, 1.0, "'")])  # closes a string far in front
@example("A = 1 ;\nA = 1 ;\nA = 1 ;", [(0.3, 0.65, "")])  # a statement of three alike goes
def test_a_changed_text_has_the_statements_of_a_text_that_was_always_so(text, changes):
    document = Document.of(text)
    for first, second, piece in changes:
        before = document.source.text
        start, end = sorted(round(f * len(before)) for f in (first, second))
        changed = before[:start] + piece + before[min(end, start + 6) :]
        document, fresh = Document.of(changed, before=document), Document.of(changed)
        assert [p.tokens for p in document.phrases] == [p.tokens for p in fresh.phrases]
        assert [(p.start, p.end, p.cut.closed) for p in document.phrases] == [
            (p.start, p.end, p.cut.closed) for p in fresh.phrases
        ]
        assert [(o.name, o.start, o.end, o.scope) for o in document.names.found] == [
            (o.name, o.start, o.end, o.scope) for o in fresh.names.found
        ]
        assert outline(document) == outline(fresh)
        assert colours(document) == colours(fresh)


def test_what_did_not_change_is_not_read_again(monkeypatch):
    text = "\n".join(f"A{i} = {i} + 'b' ;" for i in range(500))
    document, at = Document.of(text), text.index("A250")
    read = []
    quick = tokens.quick_reader()
    reader = type("Counted", (), {"tokens": lambda _, c, i: map(seen, quick.tokens(c, i))})()
    seen = lambda token: read.append(token) or token  # noqa: E731
    monkeypatch.setattr(tokens, "quick_reader", lambda: reader)
    changed = Document.of(text[:at] + "B" + text[at:], before=document)
    assert len(read) < 15
    assert len(changed.phrases) == 500
    assert changed.phrases[250].tokens[0].text == "BA250"
    assert changed.phrases[499].tokens[0].start == document.phrases[499].tokens[0].start + 1


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


def test_no_answer_cuts_the_text_into_lines_for_each_of_its_items(monkeypatch):
    """Cutting a long text takes milliseconds, and an answer has thousands of items."""
    cuts = []
    lines = TextDocument.lines.fget
    monkeypatch.setattr(
        TextDocument, "lines", property(lambda self: cuts.append(self) or lines(self))
    )
    server, uri = make_server(), "file:///deck/long.ssi"
    server.protocol._workspace = Workspace("file:///deck")
    text = "".join(f"N{i} = {i} ;\n" for i in range(300))
    server.workspace.put_text_document(lsp.TextDocumentItem(uri, "gibiane", 1, text))
    named, asked = lsp.TextDocumentIdentifier(uri), server.protocol.fm.features
    position = lsp.Position(300, 0)
    offered = asked[lsp.TEXT_DOCUMENT_COMPLETION](lsp.CompletionParams(named, position))
    parts = asked[lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL](lsp.DocumentSymbolParams(named))
    colours = asked[lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL](lsp.SemanticTokensParams(named))
    assert len(offered.items) > 300
    assert {item.text_edit.range.start.line for item in offered.items} == {300}
    assert [p.selection_range.start.line for p in parts] == list(range(300))
    assert len(colours.data) >= 5 * 300
    assert len(cuts) <= 3
