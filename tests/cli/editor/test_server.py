"""The language server as an editor talks to it: a process of its own, a client of the protocol."""

import asyncio
import os
import sys
from pathlib import Path

import pytest
import pytest_asyncio
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pytest_lsp import ClientServerConfig, LanguageClient

pytestmark = pytest.mark.asyncio(loop_scope="module")
ROOT = Path(__file__).parents[3]
URI = "file:///deck/case.ssi"
DECK = """\
* a bar on springs
OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ;
SIDE = DROI 4 (0. 0.) (2. 0.) ;
LOW = SIDE PLUS (0. 0.) ;
JOIN = RACC 1.E-6 SIDE LOW ;
MOJ = MODE JOIN 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
MAJ = MATE MOJ 'KN' 1.E10 'KS' 1.E10 ;
DEBP HALF X*FLOTTANT ;
  SIDE = X / 2. ;
FINP SIDE ;
T1 = TABL ;
T1 . 'RIGI' = RIGI MOJ MAJ ;
T1 . 'CHARGEMENT' = 1. ;
T2 = DYNAMIC T1 ;
REPE BOUCLE 3 ;
  A = HALF 4. ;
FIN BOUCLE ;
MESS A &BOUCLE ;
LIST (TYPE T2) (TYPE LOW) ;
FIN ;
"""


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def session():
    """A server for all tests: it reads all operators at its start."""
    client = await ClientServerConfig(
        server_command=[sys.executable, "-m", "ssilang.cli.main", "lsp"],
        server_env={**os.environ, "PYTHONPATH": str(ROOT)},
    ).start()
    capabilities = lsp.ClientCapabilities()
    await client.initialize_session(
        lsp.InitializeParams(capabilities=capabilities, process_id=os.getpid())
    )
    yield client
    await client.shutdown_session()
    await client.stop()


@pytest_asyncio.fixture(loop_scope="module")
async def client(session: LanguageClient):
    """The server without an open document; what it says against the protocol is a fault."""
    faults, report = [], session.report_server_error
    session.report_server_error = lambda *said: faults.append(said) or report(*said)
    yield session
    named = lsp.TextDocumentIdentifier(URI)
    session.text_document_did_close(lsp.DidCloseTextDocumentParams(named))
    # the answer comes behind all that was said of the document
    await session.completion_item_resolve_async(lsp.CompletionItem("nothing"))
    session.log_messages.clear()
    session.report_server_error = report
    assert faults == []


def open_deck(client: LanguageClient, text: str = DECK) -> None:
    item = lsp.TextDocumentItem(URI, "gibiane", 1, text)
    client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))


def change_to(client: LanguageClient, text: str, version: int) -> None:
    named = lsp.VersionedTextDocumentIdentifier(version, URI)
    whole = [lsp.TextDocumentContentChangeWholeDocument(text)]
    client.text_document_did_change(lsp.DidChangeTextDocumentParams(named, whole))


def at(text: str, word: str, shift: int = 1, number: int = 1) -> dict[str, object]:
    """Document and position of a word, as requests take them."""
    offset = -1
    for _ in range(number):
        offset = text.index(word, offset + 1)
    before = text[: offset + shift]
    line = before.count("\n")
    position = lsp.Position(line, len(before) - before.rfind("\n") - 1)
    return {"text_document": lsp.TextDocumentIdentifier(URI), "position": position}


def applied(text: str, edits: list[lsp.TextEdit]) -> str:
    """A text (of plain letters) after some edits."""
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    places = [
        (
            starts[e.range.start.line] + e.range.start.character,
            starts[e.range.end.line] + e.range.end.character,
            e.new_text,
        )
        for e in edits
    ]
    for start, end, new in sorted(places, reverse=True):
        text = text[:start] + new + text[end:]
    return text


async def diagnostics(client: LanguageClient) -> list[lsp.Diagnostic]:
    """What the server says next of the deck."""
    await asyncio.wait_for(
        client.wait_for_notification(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS), timeout=60
    )
    return list(client.diagnostics[URI])


async def test_problems_are_told_with_their_places_and_mended_by_a_quick_fix(client):
    open_deck(client)
    found = {d.code: d for d in await diagnostics(client)}
    entry = found["entry-unknown"]
    assert entry.severity == lsp.DiagnosticSeverity.Warning
    assert "'CHARGEMENT'" in entry.message
    assert "CHAR" in entry.message
    assert entry.range.start == lsp.Position(12, 0)
    context = lsp.CodeActionContext([entry])
    actions = await client.text_document_code_action_async(
        lsp.CodeActionParams(lsp.TextDocumentIdentifier(URI), entry.range, context)
    )
    assert [a.title for a in actions] == ["replace by CHAR"]
    mended = applied(DECK, actions[0].edit.changes[URI])
    assert mended == DECK.replace("'CHARGEMENT'", "'CHAR'")
    change_to(client, mended, 2)
    assert "entry-unknown" not in {d.code for d in await diagnostics(client)}


@pytest.mark.parametrize(
    ("wrong", "code", "right"),
    [
        ("X = 'abc ;\n", "unclosed-string", "X = 'abc' ;\n"),
        ("X = 1 + 2", "missing-semicolon", "X = 1 + 2 ;"),
        ("X = (1 + 2 ;\n", "unclosed-paren", "X = (1 + 2) ;\n"),
        ("X = 1 + 2) ;\n", "extra-paren", "X = 1 + 2 ;\n"),
        ("X = 2,5 ;\n", "decimal-comma", "X = 2.5 ;\n"),
        ("OPTI DIME 2 ELME SEG2 ;\n", "near-word", "OPTI DIME 2 ELEM SEG2 ;\n"),
        ("X = RSEO 1 ;\nLIST X ;\n", "unknown-operator", "X = RESO 1 ;\nLIST X ;\n"),
    ],
)
async def test_quick_fixes(client, wrong, code, right):
    open_deck(client, wrong)
    found = [d for d in await diagnostics(client) if d.code == code]
    assert len(found) == 1
    params = lsp.CodeActionParams(
        lsp.TextDocumentIdentifier(URI), found[0].range, lsp.CodeActionContext(found)
    )
    actions = await client.text_document_code_action_async(params)
    assert applied(wrong, actions[0].edit.changes[URI]) == right


async def test_hover_and_completion_are_of_the_place(client):
    """What they hold: `test_information.py`."""
    open_deck(client)
    await diagnostics(client)
    found = await client.text_document_hover_async(lsp.HoverParams(**at(DECK, "MOJ")))
    assert "**MOJ** : MMODEL (first given at line 6)" in found.contents.value
    assert (found.range.start, found.range.end) == (lsp.Position(5, 0), lsp.Position(5, 3))
    assert await client.text_document_hover_async(lsp.HoverParams(**at(DECK, "1.E-6"))) is None
    text = DECK[: DECK.index("REPE")] + "T1 . 'A"
    change_to(client, text, 2)
    position = lsp.Position(text.count("\n"), 7)
    found = await client.text_document_completion_async(
        lsp.CompletionParams(lsp.TextDocumentIdentifier(URI), position)
    )
    entries = {i.label: i.text_edit for i in found.items}
    assert entries["AMOR"].new_text == "'AMOR'"
    assert entries["AMOR"].range.start.character == 5
    assert "DROIT" not in entries
    item = lsp.CompletionItem("DROIT", kind=lsp.CompletionItemKind.Function)
    item = await client.completion_item_resolve_async(item)
    assert item.documentation.value.startswith("**DROI (DROIT) : operator")


async def test_names_are_found_and_renamed_within_their_scope(client):
    open_deck(client)
    inner = await client.text_document_references_async(
        lsp.ReferenceParams(context=lsp.ReferenceContext(True), **at(DECK, "SIDE", number=4))
    )
    assert [place.range.start.line for place in inner] == [8, 9]  # the procedure's own
    marks = await client.text_document_document_highlight_async(
        lsp.DocumentHighlightParams(**at(DECK, "SIDE", number=4))
    )
    kinds = lsp.DocumentHighlightKind
    assert [(m.range.start.line, m.kind) for m in marks] == [(8, kinds.Write), (9, kinds.Read)]
    asked = at(DECK, "SIDE", number=4)
    held = await client.text_document_prepare_rename_async(lsp.PrepareRenameParams(**asked))
    assert (held.start, held.end) == (lsp.Position(8, 2), lsp.Position(8, 6))
    found = await client.text_document_definition_async(
        lsp.DefinitionParams(**at(DECK, "HALF", number=2))
    )
    assert [place.range.start for place in found] == [lsp.Position(7, 5)]
    edit = await client.text_document_rename_async(
        lsp.RenameParams(new_name="TOP", **at(DECK, "SIDE"))
    )
    outer = DECK.replace("SIDE = DROI", "TOP = DROI").replace("SIDE PLUS", "TOP PLUS")
    assert applied(DECK, edit.changes[URI]) == outer.replace("1.E-6 SIDE", "1.E-6 TOP")
    for taken in ("LOW", "DROI", "A B", "1."):
        with pytest.raises(JsonRpcException, match="is no name, or names something else"):
            await client.text_document_rename_async(
                lsp.RenameParams(new_name=taken, **at(DECK, "SIDE"))
            )
    loop = await client.text_document_rename_async(
        lsp.RenameParams(new_name="ROUND", **at(DECK, "BOUCLE"))
    )
    assert applied(DECK, loop.changes[URI]) == DECK.replace("BOUCLE", "ROUND")


async def test_procedures_of_the_library_are_opened(client):
    open_deck(client)
    found = await client.text_document_definition_async(lsp.DefinitionParams(**at(DECK, "DYNAMIC")))
    assert [place.uri.rpartition("/")[2] for place in found] == ["dynamic.ssi"]


async def test_outline_folds_and_colours(client):
    open_deck(client)
    named = lsp.TextDocumentIdentifier(URI)
    symbols = await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(named))
    shape = {s.name: [inner.name for inner in s.children] for s in symbols}
    assert shape["HALF"] == ["X", "SIDE"]
    assert shape["BOUCLE"] == ["A"]
    folds = await client.text_document_folding_range_async(lsp.FoldingRangeParams(named))
    assert {(f.start_line, f.end_line) for f in folds} == {(7, 9), (14, 16)}
    tokens = await client.text_document_semantic_tokens_full_async(lsp.SemanticTokensParams(named))
    assert colours_of(DECK, tokens.data, client)[:5] == [
        ("* a bar on springs", "comment"),
        ("OPTI", "function"),
        ("2", "number"),
        ("SIDE", "variable"),
        ("DROI", "function"),
    ]
    lines = lsp.Range(lsp.Position(2, 5), lsp.Position(4, 1))
    part = await client.text_document_semantic_tokens_range_async(
        lsp.SemanticTokensRangeParams(named, lines)
    )
    seen = colours_of(DECK, part.data, client)
    assert [word for word, _ in seen[:2]] == ["SIDE", "DROI"]
    assert [word for word, _ in seen[-3:]] == ["1.E-6", "SIDE", "LOW"]


def colours_of(text: str, data: list[int], client: LanguageClient) -> list[tuple[str, str]]:
    """Each coloured word of a text, and its colour: what the protocol's differences say."""
    legend = [
        "comment", "keyword", "function", "string", "number", "operator", "variable", "property",
        "parameter",
    ]  # fmt: skip
    lines, line, column, found = text.split("\n"), 0, 0, []
    for i in range(0, len(data), 5):
        down, right, length, kind, _ = data[i : i + 5]
        line, column = line + down, right if down else column + right
        found.append((lines[line][column : column + length], legend[kind]))
    return [pair for pair in found if pair[0] not in ("DIME", "MODE", "PLAN", "DEFO", "ELEM")]


async def test_signatures_follow_the_words_typed(client):
    open_deck(client)
    found = await client.text_document_signature_help_async(
        lsp.SignatureHelpParams(**at(DECK, "1.E-6"))
    )
    assert any("RACC" in s.label for s in found.signatures)


async def test_layout_and_letters_beyond_the_first_plane(client):
    """Positions are counted in UTF-16 units: a letter beyond 65 535 counts twice."""
    text = "MESS '\U0001f3d7 é' ;   X=1 ;\nMESS   X ;\n"
    open_deck(client, text)
    edits = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(
            lsp.TextDocumentIdentifier(URI), lsp.FormattingOptions(2, True)
        )
    )
    assert edits[0].new_text == "MESS '\U0001f3d7 é' ; X = 1 ;\nMESS X ;\n"
    first = text.split("\n")[0]
    column = len(first[: first.index("X=")].encode("utf-16-le")) // 2
    found = await client.text_document_references_async(
        lsp.ReferenceParams(
            lsp.ReferenceContext(True), lsp.TextDocumentIdentifier(URI), lsp.Position(1, 7)
        )
    )
    assert [(f.range.start.line, f.range.start.character) for f in found] == [(0, column), (1, 7)]


async def test_unsound_texts_are_answered_too(client):
    """One types: quotes are open, parentheses miss; no request may fail."""
    open_deck(client)
    named = lsp.TextDocumentIdentifier(URI)
    for version, cut in enumerate(range(0, len(DECK), 37), 2):
        text = DECK[:cut] + "'" * (cut % 2) + DECK[cut + 1 :]
        change_to(client, text, version)
        position = lsp.Position(text[:cut].count("\n"), 3)
        await client.text_document_hover_async(lsp.HoverParams(named, position))
        await client.text_document_completion_async(lsp.CompletionParams(named, position))
        await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(named))
        await client.text_document_semantic_tokens_full_async(lsp.SemanticTokensParams(named))
        await client.text_document_folding_range_async(lsp.FoldingRangeParams(named))
    assert not [m for m in client.log_messages if m.type == lsp.MessageType.Error]


async def test_a_position_that_no_text_has_is_answered(client):
    """In front of the text there is an error, behind it nothing; the server goes on."""
    open_deck(client)
    named = lsp.TextDocumentIdentifier(URI)
    hover = lsp.HoverParams(named, lsp.Position(0, 0))
    for line, column in ((-1, 0), (0, -7)):
        object.__setattr__(hover.position, "line", line)
        object.__setattr__(hover.position, "character", column)
        with pytest.raises(JsonRpcException):
            await asyncio.wait_for(client.text_document_hover_async(hover), 20.0)
    behind = lsp.HoverParams(named, lsp.Position(10**9, 10**9))
    assert await client.text_document_hover_async(behind) is None
