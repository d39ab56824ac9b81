"""What Tab offers."""

import pytest
from lsprotocol import types as lsp
from pygls.workspace import TextDocument, Workspace

from ssilang.cli.editor.server import make_server
from ssilang.cli.run import run_text
from ssilang.cli.terminal.repl import completions


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
