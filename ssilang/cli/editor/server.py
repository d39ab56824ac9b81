"""`ssilang lsp`: the language server, over standard input and output.

Protocol: https://microsoft.github.io/language-server-protocol. The text is cut anew at each change
(some milliseconds for a thousand lines); problems are looked for when no key has come for a moment,
of one text at a time, and statements that stay as they are are not read again.
"""

import asyncio
import contextlib
import gc
import os
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol
from pygls.protocol.json_rpc import JsonRPCNotification
from pygls.uris import from_fs_path, to_fs_path
from pygls.workspace import PositionCodec

from ssilang import __version__
from ssilang.cli.checking.sound import SoundStatements
from ssilang.cli.editor import complete, information, outline
from ssilang.cli.editor.document import Document
from ssilang.cli.editor.formatting import formatted
from ssilang.cli.editor.names import Occurrence
from ssilang.cli.editor.problems import Findings, Fix, Problem, find_problems
from ssilang.language.registry import find_operator
from ssilang.language.run.library import Library
from ssilang.language.say.errors import SeveralErrors, SsiError
from ssilang.language.text.source import Source
from ssilang.messages.message import teller
from ssilang.operators.loader import load_operators

WAIT = 0.02
"""Seconds without a key after which problems are looked for."""

_NOTHING = Findings((), {})
_TRIGGERS = ["'", ".", " "]
_SEVERITY = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "note": lsp.DiagnosticSeverity.Information,
}
_FADED = frozenset({"unused-name"})
_CANDIDATES: dict[complete.Kind, lsp.CompletionItemKind] = {
    "operator": lsp.CompletionItemKind.Function,
    "procedure": lsp.CompletionItemKind.Method,
    "control": lsp.CompletionItemKind.Keyword,
    "keyword": lsp.CompletionItemKind.EnumMember,
    "entry": lsp.CompletionItemKind.Property,
    "word": lsp.CompletionItemKind.Value,
    "name": lsp.CompletionItemKind.Variable,
    "file": lsp.CompletionItemKind.File,
}
_ORDER = ("entry", "keyword", "word", "file", "name", "control", "operator", "procedure")
_SYMBOLS = {
    "procedure": lsp.SymbolKind.Function,
    "loop": lsp.SymbolKind.Array,
    "parameter": lsp.SymbolKind.TypeParameter,
    "variable": lsp.SymbolKind.Variable,
}


@dataclass
class Open:
    """A document that the editor holds, and what was last found in it."""

    document: Document
    version: int | None
    findings: Findings = _NOTHING
    sound: SoundStatements = field(default_factory=SoundStatements)
    waiting: asyncio.Task[None] | None = None
    shown: list[lsp.Diagnostic] = field(default_factory=list)


class Protocol(LanguageServerProtocol):
    """Answers requests, those too that make no sense: a position in line -1."""

    def structure_message(self, data: dict[str, Any]) -> Any:
        """A message from its parts; a request that cannot be one is answered with an error."""
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            if "id" not in data or "method" not in data:
                raise
            self._send_response(data["id"], error=error.to_response_error())
            return JsonRPCNotification(method="$/refused", jsonrpc=self.VERSION, params=None)


class Server(LanguageServer):
    """Holds the open documents; its features are registered below."""

    def __init__(self, language: str = "en") -> None:
        super().__init__("ssilang", __version__, protocol_cls=Protocol)
        self.language = language
        load_operators()
        self.library = Library(Path())
        self.open: dict[str, Open] = {}
        self.looker = ThreadPoolExecutor(1)

    def document(self, uri: str) -> Document:
        """The text as it is now, cut."""
        text = self.workspace.get_text_document(uri)
        held = self.open.get(uri)
        if held is not None and held.version == text.version:
            return held.document
        path = to_fs_path(uri)
        made = Document.of(
            text.source,
            Path(path) if path else None,
            self.library.standard_names,
            held.document if held is not None else None,
        )
        if held is None:
            self.open[uri] = Open(made, text.version)
        else:
            held.document, held.version = made, text.version
        return made

    def findings(self, uri: str) -> Findings:
        """What was last found in a document."""
        self.document(uri)
        return self.open[uri].findings

    # ---- places ---------------------------------------------------------------------------------

    @property
    def codec(self) -> PositionCodec:
        """What counts letters as the editor does."""
        return self.workspace.position_codec

    def offset(self, uri: str, position: lsp.Position) -> int:
        """Where a position of the editor stands in our text."""
        document = self.document(uri)
        own = self.codec.position_from_client_units(document.lines, position)
        return document.source.offset(own.line + 1, own.character + 1)

    def range(self, uri: str, start: int, end: int) -> lsp.Range:
        """A part of our text as the editor counts it."""
        document = self.document(uri)
        ends = (_position(document.source.position(at)) for at in (start, end))
        return self.codec.range_to_client_units(document.lines, lsp.Range(*ends))

    # ---- problems -------------------------------------------------------------------------------

    def look_later(self, uri: str) -> None:
        """Look for problems when no key has come for a moment."""
        self.document(uri)
        held = self.open[uri]
        if held.waiting is not None:
            held.waiting.cancel()
        held.waiting = asyncio.ensure_future(self._look(uri))

    async def _look(self, uri: str) -> None:
        with contextlib.suppress(asyncio.CancelledError):
            await asyncio.sleep(WAIT)
            source = self.document(uri).source
            loop = asyncio.get_running_loop()
            found = await loop.run_in_executor(self.looker, self._found, uri, source)
            held = self.open.get(uri)
            if held is None or found is None or held.document.source is not source:
                return  # the text has changed: another look is under way
            held.findings = found
            self.publish(uri, [self._diagnostic(uri, p) for p in found.problems], held.version)

    def _found(self, uri: str, source: Source) -> Findings | None:
        """What is wrong with a text, None if it has changed before its turn has come."""
        held = self.open.get(uri)
        if held is None or held.document.source is not source:
            return None
        return find_problems(source, self.language, sound=held.sound)

    def publish(
        self, uri: str, diagnostics: list[lsp.Diagnostic], version: int | None = None
    ) -> None:
        """Tell the editor what is wrong."""
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri, diagnostics, version)
        )

    def _diagnostic(self, uri: str, problem: Problem) -> lsp.Diagnostic:
        message = "\n".join(p for p in (problem.text, problem.hint) if p)
        return lsp.Diagnostic(
            self.range(uri, problem.start, problem.end),
            message,
            severity=_SEVERITY[problem.severity],
            code=problem.code,
            source="ssilang",
            tags=[lsp.DiagnosticTag.Unnecessary] if problem.code in _FADED else None,
            data=[self._fix(uri, fix) for fix in problem.fixes],
        )

    def _fix(self, uri: str, fix: Fix) -> dict[str, Any]:
        where = self.range(uri, fix.start, fix.end)
        ends = [[p.line, p.character] for p in (where.start, where.end)]
        return {"title": fix.title, "range": ends, "text": fix.text}

    def reader(self, uri: str) -> information.Reader:
        """What answers questions about a document."""
        document = self.document(uri)
        return information.Reader(document, self.findings(uri), self.library, self.language)


def _position(place: tuple[int, int]) -> lsp.Position:
    line, column = place
    return lsp.Position(line - 1, column - 1)


def start(language: str) -> None:
    """Serve the editor that started this process, until it ends the session."""
    # the protocol's own streams: nothing that is printed may come between
    with os.fdopen(os.dup(0), "rb") as reads, os.fdopen(os.dup(1), "wb") as writes:
        os.dup2(2, 1)
        server = make_server(language)
        spare_collections()
        server.start_io(reads, writes)


def spare_collections() -> None:
    """No key waits for a search for garbage among operators and statements, which all stay."""
    gc.freeze()
    gc.set_threshold(200_000, 20, 100)


def make_server(language: str = "en") -> Server:
    """A server with all its features."""
    server = Server(language)
    for register in (_documents, _help, _names, _layout):
        register(server)
    return server


# ---- texts -----------------------------------------------------------------------------------


def _documents(server: Server) -> None:
    @server.feature(lsp.INITIALIZE)
    def initialize(params: lsp.InitializeParams) -> None:
        options = params.initialization_options
        asked = options.get("language") if isinstance(options, dict) else None
        if asked in ("en", "fr"):
            server.language = asked

    async def looked(
        params: lsp.DidOpenTextDocumentParams
        | lsp.DidChangeTextDocumentParams
        | lsp.DidSaveTextDocumentParams,
    ) -> None:
        server.look_later(params.text_document.uri)

    for event in (
        lsp.TEXT_DOCUMENT_DID_OPEN,
        lsp.TEXT_DOCUMENT_DID_CHANGE,
        lsp.TEXT_DOCUMENT_DID_SAVE,
    ):
        server.feature(event)(looked)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        held = server.open.pop(uri, None)
        if held is not None and held.waiting is not None:
            held.waiting.cancel()
        server.publish(uri, [])

    @server.feature(
        lsp.TEXT_DOCUMENT_CODE_ACTION,
        lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix]),
    )
    def actions(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        uri = params.text_document.uri
        found = []
        for diagnostic in params.context.diagnostics:
            fixes = diagnostic.data if isinstance(diagnostic.data, list) else []
            for i, fix in enumerate(fixes):
                (a, b), (c, d) = fix["range"]
                where = lsp.Range(lsp.Position(a, b), lsp.Position(c, d))
                edit = lsp.WorkspaceEdit({uri: [lsp.TextEdit(where, fix["text"])]})
                found.append(
                    lsp.CodeAction(
                        fix["title"],
                        lsp.CodeActionKind.QuickFix,
                        [diagnostic],
                        is_preferred=i == 0,
                        edit=edit,
                    )
                )
        return found


# ---- help ------------------------------------------------------------------------------------


def _help(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        uri = params.text_document.uri
        found = server.reader(uri).hover(server.offset(uri, params.position))
        if found is None:
            return None
        text, begin, end = found
        return lsp.Hover(_markdown(text), server.range(uri, begin, end))

    @server.feature(
        lsp.TEXT_DOCUMENT_COMPLETION,
        lsp.CompletionOptions(trigger_characters=_TRIGGERS, resolve_provider=True),
    )
    def completion(params: lsp.CompletionParams) -> lsp.CompletionList:
        uri = params.text_document.uri
        offset = server.offset(uri, params.position)
        found = complete.candidates(server.document(uri), offset, server.library, server.language)
        where = server.range(uri, found[0].start, found[0].end) if found else None
        items = [_item(candidate, where) for candidate in found if where is not None]
        return lsp.CompletionList(is_incomplete=False, items=items)

    @server.feature(lsp.COMPLETION_ITEM_RESOLVE)
    def resolve(item: lsp.CompletionItem) -> lsp.CompletionItem:
        if item.kind in (lsp.CompletionItemKind.Function, lsp.CompletionItemKind.Method):
            reader = information.Reader(Document.of(""), _NOTHING, server.library, server.language)
            item.documentation = _markdown(reader.page(item.label))
        return item

    @server.feature(
        lsp.TEXT_DOCUMENT_SIGNATURE_HELP, lsp.SignatureHelpOptions(trigger_characters=[" ", "'"])
    )
    def signature(params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
        uri = params.text_document.uri
        place = server.document(uri).place(server.offset(uri, params.position))
        if place.operator is None:
            return None
        typed = [t.name for t in place.before if t.kind == "STRING"]
        lines, active = information.signatures(place.operator, typed)
        told = place.operator.help.told(server.language)
        made = [lsp.SignatureInformation(line, documentation=_markdown(told)) for line in lines]
        return lsp.SignatureHelp(made, active_signature=active) if made else None


def _item(candidate: complete.Candidate, where: lsp.Range) -> lsp.CompletionItem:
    order = _ORDER.index(candidate.kind)
    return lsp.CompletionItem(
        candidate.label,
        kind=_CANDIDATES[candidate.kind],
        detail=candidate.detail or None,
        sort_text=f"{order}{candidate.label}",
        filter_text=candidate.text,
        text_edit=lsp.TextEdit(where, candidate.text),
    )


def _markdown(text: str) -> lsp.MarkupContent:
    return lsp.MarkupContent(lsp.MarkupKind.Markdown, text)


# ---- names -----------------------------------------------------------------------------------


def _names(server: Server) -> None:
    def name_at(uri: str, position: lsp.Position) -> Occurrence | None:
        return server.document(uri).names.at(server.offset(uri, position))

    def alike(uri: str, position: lsp.Position) -> list[Occurrence]:
        name = name_at(uri, position)
        return server.document(uri).names.alike(name) if name is not None else []

    def locations(uri: str, found: Iterable[Occurrence]) -> list[lsp.Location]:
        return [lsp.Location(uri, server.range(uri, o.start, o.end)) for o in found]

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> list[lsp.Location]:
        uri = params.text_document.uri
        name = name_at(uri, params.position)
        if name is not None:
            return locations(uri, server.document(uri).names.definitions(name))
        token = server.document(uri).place(server.offset(uri, params.position)).token
        path = server.library.standard_files.get(token.name) if token is not None else None
        target = from_fs_path(str(path)) if path is not None else None
        nowhere = lsp.Range(lsp.Position(0, 0), lsp.Position(0, 0))
        return [lsp.Location(target, nowhere)] if target else []

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        uri = params.text_document.uri
        every = params.context.include_declaration
        return locations(uri, (o for o in alike(uri, params.position) if every or not o.defines))

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    def highlight(params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
        uri = params.text_document.uri
        kinds = (lsp.DocumentHighlightKind.Read, lsp.DocumentHighlightKind.Write)
        return [
            lsp.DocumentHighlight(server.range(uri, o.start, o.end), kinds[o.defines])
            for o in alike(uri, params.position)
        ]

    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
    def may_rename(params: lsp.PrepareRenameParams) -> lsp.Range | None:
        uri = params.text_document.uri
        name = name_at(uri, params.position)
        return server.range(uri, name.start, name.end) if name is not None else None

    @server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        uri = params.text_document.uri
        document = server.document(uri)
        name = name_at(uri, params.position)
        if name is None:
            return None
        if not _renamable(params.new_name, document):
            told = teller(server.language)("cli.rename-taken", name=params.new_name)
            raise JsonRpcException(told, code=lsp.LSPErrorCodes.RequestFailed)
        edits = [
            lsp.TextEdit(server.range(uri, o.start, o.end), params.new_name)
            for o in document.names.alike(name)
        ]
        return lsp.WorkspaceEdit({uri: edits})


def _renamable(new: str, document: Document) -> bool:
    """Whether a name may be given: a word that is free, and names no operator."""
    made = Document.of(f"{new} = 1 ;")
    kinds = [[t.kind for t in phrase.cut.tokens] for phrase in made.phrases]
    whole = kinds == [["WORD", "_EQUAL", "INTEGER"]] and made.phrases[0].cut.tokens[0].text == new
    return (
        whole and new.upper() not in document.names.defined and find_operator(new.upper()) is None
    )


# ---- layout ----------------------------------------------------------------------------------


def _layout(server: Server) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        uri = params.text_document.uri
        return [_symbol(server, uri, part) for part in outline.outline(server.document(uri))]

    @server.feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
    def folding(params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
        document = server.document(params.text_document.uri)
        kinds = {"region": lsp.FoldingRangeKind.Region, "comment": lsp.FoldingRangeKind.Comment}
        return [
            lsp.FoldingRange(first, last, kind=kinds[kind])
            for first, last, kind in outline.folds(document)
        ]

    legend = lsp.SemanticTokensLegend([*outline.COLOURS], [])

    @server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, legend)
    def colours(params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
        uri = params.text_document.uri
        return lsp.SemanticTokens(_encoded(server, uri))

    @server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, legend)
    def colours_within(params: lsp.SemanticTokensRangeParams) -> lsp.SemanticTokens:
        uri, part = params.text_document.uri, params.range
        lines = part.start.line, part.end.line + 1
        first, last = (server.offset(uri, lsp.Position(line, 0)) for line in lines)
        return lsp.SemanticTokens(_encoded(server, uri, first, last))

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def layout(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
        uri = params.text_document.uri
        source = server.document(uri).source
        try:
            text = formatted(source)
        except (SeveralErrors, SsiError):
            return []  # the problems are told already
        if text == source.text:
            return []
        return [lsp.TextEdit(server.range(uri, 0, len(source.text)), text)]


def _symbol(server: Server, uri: str, part: outline.Part) -> lsp.DocumentSymbol:
    return lsp.DocumentSymbol(
        part.name,
        _SYMBOLS[part.kind],
        server.range(uri, part.start, part.end),
        server.range(uri, part.name_start, part.name_end),
        children=[_symbol(server, uri, inner) for inner in part.inner],
    )


def _encoded(server: Server, uri: str, first: int = 0, last: int | None = None) -> list[int]:
    """Colours as the protocol wants them: line and column from the one before, length, which."""
    data: list[int] = []
    line = column = 0
    document, codec = server.document(uri), server.codec
    text, position = document.source.text, document.source.position

    def units(part: str) -> int:
        return len(part) if part.isascii() else codec.client_num_units(part)

    for start_, end_, colour in outline.colours(document, first, last):
        for a, b in _by_line(text, start_, end_):
            row, place = (n - 1 for n in position(a))
            before = units(text[a - place : a])
            data += [row - line, before - column if row == line else before, units(text[a:b])]
            data += [outline.COLOURS.index(colour), 0]
            line, column = row, before
    return data


def _by_line(text: str, start_: int, end_: int) -> Iterable[tuple[int, int]]:
    """The parts of a word that runs over line ends."""
    at = start_
    for part in text[start_:end_].split("\n"):
        if part:
            yield at, at + len(part)
        at += len(part) + 1
