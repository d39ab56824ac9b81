"""Makes the pictures of the pages: editor, notebook and site as a browser shows them.

    npm install --prefix FOLDER monaco-editor@0.52 && pip install '.[test]' nbconvert
    python docs/screenshots.py FOLDER [SITE]

The editor is the one inside VS Code (Monaco). What it shows (problems, hover, completion, colours)
are the answers of `ssilang lsp`, a process that is asked by the protocol; the notebook is run anew
and laid out by nbconvert as JupyterLab does; SITE is what `docs/web_pages.py` has made (site/).
Debian's chromium draws all of them, without a network.
"""

import asyncio
import io
import json
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from PIL import Image
from pygls.lsp.client import LanguageClient

_HERE = Path(__file__).resolve().parent
_ROOT = _HERE.parent
sys.path.insert(0, str(_ROOT / "tests"))

from chromium import Chromium  # noqa: E402  (the driver of the tests)

PICTURES = _HERE / "pictures"
COLOURS, LARGEST = (256, 128, 64), 60_000
DECK = """\
* a block of concrete on soil, pushed sideways
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
T = MAILLER 'SOL' 12. 4. 'SEMELLE' 4. 1. 'STRUCTURE' 2. 4. 'TAILLE' 1. 2. ;
MO = MODE (T . 'TOTAL') 'MECANIQUE' 'ELASTIQUE' ;
MA = MATE MO 'YOUN' 5.E8 'NU' 0.3 'RHO' 2000. ;
MJ = MODE (T . 'JOINT') 'MECANIQUE' 'ELASTIQUE' 'JOINT_SDM' ;
AJ = MATE MJ 'KN' 2.E8 'KS' 2.E8 'FROT' 0.7 ;
RI = (RIGI MO MA) ET (RIGI MJ AJ) ET (BLOQ 'DEPL' (T . 'BASE')) ;
MS = MASS MO MA ;
T1 = TABL ; T1 . 'RIGI' = RI ; T1 . 'MASS' = MS ;
T1 . 'MODELE' = MO ET MJ ; T1 . 'CARACTERISTIQUES' = MA ET AJ ;
T1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' 1.E-3 2. ;
T2 = DYNAMIC T1 ;
"""
_PAGE = """<!doctype html><meta charset="utf-8">
<style>html, body, #editor {{ margin: 0; width: 100%; height: 100%; overflow: hidden }}</style>
<div id="editor"></div><script src="{vs}/loader.js"></script><script>
const told = {told};
const kinds = {{2: 'Method', 3: 'Function', 6: 'Variable', 10: 'Property', 12: 'Value',
  14: 'Keyword', 17: 'File', 20: 'EnumMember'}};
const area = r => ({{startLineNumber: r.start.line + 1, startColumn: r.start.character + 1,
  endLineNumber: r.end.line + 1, endColumn: r.end.character + 1}});
require.config({{paths: {{vs: '{vs}'}}}});
require(['vs/editor/editor.main'], () => {{
  monaco.languages.register({{id: 'gibiane'}});
  monaco.languages.registerHoverProvider('gibiane', {{provideHover: () => told.hover && (
    {{range: area(told.hover.range), contents: [{{value: told.hover.contents.value}}]}})}});
  monaco.languages.registerCompletionItemProvider('gibiane', {{provideCompletionItems: () => (
    {{suggestions: told.items.map(i => ({{label: i.label, detail: i.detail, sortText: i.sortText,
      filterText: i.filterText, insertText: i.textEdit.newText, range: area(i.textEdit.range),
      kind: monaco.languages.CompletionItemKind[kinds[i.kind]]}}))}})}});
  monaco.languages.registerDocumentSemanticTokensProvider('gibiane', {{
    getLegend: () => told.legend, releaseDocumentSemanticTokens: () => 0,
    provideDocumentSemanticTokens: () => ({{data: new Uint32Array(told.tokens)}})}});
  monaco.editor.defineTheme('told', {{base: 'vs', inherit: true, colors: {{}}, rules: [
    {{token: 'comment', foreground: '008000'}}, {{token: 'function', foreground: '795E26'}},
    {{token: 'string', foreground: 'A31515'}}, {{token: 'number', foreground: '098658'}},
    {{token: 'keyword', foreground: 'AF00DB'}}, {{token: 'variable', foreground: '001080'}},
    {{token: 'property', foreground: '0451A5'}}, {{token: 'operator', foreground: '000000'}}]}});
  const model = monaco.editor.createModel(told.text, 'gibiane');
  window.editor = monaco.editor.create(document.getElementById('editor'), {{model, theme: 'told',
    'semanticHighlighting.enabled': true, minimap: {{enabled: false}}, fontSize: 14,
    wordBasedSuggestions: 'off', scrollBeyondLastLine: false, lineNumbersMinChars: 3,
    suggest: {{showStatusBar: false}}, hover: {{delay: 0, above: false}}}});
  const levels = {{1: 8, 2: 4, 3: 2, 4: 1}};
  monaco.editor.setModelMarkers(model, 'ssilang', told.problems.map(p => ({{...area(p.range),
    message: p.message, severity: levels[p.severity], source: 'ssilang', code: p.code}})));
  editor.setPosition({{lineNumber: told.at.line + 1, column: told.at.character + 1}});
  editor.focus();
  setTimeout(() => {{ editor.trigger('picture', told.action, {{}}); window.done = true; }}, 1500);
}});
</script>"""


class _Asked(LanguageClient):
    """A client of the server that keeps what is published of a text."""

    def __init__(self) -> None:
        super().__init__("pictures", "1")
        self.problems: asyncio.Future[list[lsp.Diagnostic]] = asyncio.Future()

        @self.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def published(found: lsp.PublishDiagnosticsParams) -> None:
            if not self.problems.done():
                self.problems.set_result(list(found.diagnostics))


async def answers(text: str, word: str, action: str) -> dict[str, Any]:
    """What the server says of a text; hover and completion at the end of a word in it."""
    client = _Asked()
    environment = {**os.environ, "PYTHONPATH": str(_ROOT)}
    await client.start_io(sys.executable, "-m", "ssilang.cli.main", "lsp", env=environment)
    began = await client.initialize_async(
        lsp.InitializeParams(capabilities=lsp.ClientCapabilities(), process_id=os.getpid())
    )
    item = lsp.TextDocumentItem("file:///deck/block.ssi", "gibiane", 1, text)
    client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
    before = text[: text.rindex(word) + len(word)]
    at = lsp.Position(before.count("\n"), len(before) - before.rfind("\n") - 1)
    named = lsp.TextDocumentIdentifier(item.uri)
    problems = await asyncio.wait_for(client.problems, 60)
    inside = lsp.Position(at.line, at.character - 1)
    hover = await client.text_document_hover_async(lsp.HoverParams(named, inside))
    items = await client.text_document_completion_async(lsp.CompletionParams(named, at))
    tokens = await client.text_document_semantic_tokens_full_async(lsp.SemanticTokensParams(named))
    plain = client.protocol._converter.unstructure
    told = {
        "text": text, "at": plain(at), "action": action,
        "problems": [plain(p) for p in problems], "hover": plain(hover),
        "items": [plain(i) for i in items.items], "tokens": tokens.data,
        "legend": plain(began.capabilities.semantic_tokens_provider.legend),
    }  # fmt: skip
    await client.shutdown_async(None)
    client.exit(None)
    await client.stop()
    return told


EDITOR = {
    "editor_hover": (DECK, "'FROT", "editor.action.showHover"),
    "editor_completion": (
        DECK.replace("T2 = ", "T1 . 'P\nT2 = "), "T1 . 'P", "editor.action.triggerSuggest",
    ),
    "editor_problems": (
        DECK.replace("'TEMPS_CALCULES'", "'TEMPS_CALCULE'").replace("= MASS MO", "= MSAS MO"),
        "MS = ", "editor.action.marker.next",
    ),
}  # fmt: skip
"""Of each picture the text, the word at whose end the cursor stands, what is done there."""


def editor(browser: Chromium, monaco: Path, folder: Path) -> None:
    """Hover, completion and problems."""
    vs = (monaco / "node_modules" / "monaco-editor" / "min" / "vs").resolve().as_uri()
    for name, (text, word, action) in EDITOR.items():
        told = asyncio.run(answers(text, word, action))
        page = folder / f"{name}.html"
        page.write_text(_PAGE.format(vs=vs, told=json.dumps(told)), encoding="utf-8")
        browser.open(page, 860, 520)
        browser.until("!!window.done")
        browser.run("new Promise(r => setTimeout(r, 1500))")
        keep(name, browser.png())


def notebook(browser: Chromium, folder: Path) -> None:
    """The first notebook, run anew by a kernel of its own."""
    import nbclient
    import nbformat
    from nbconvert import HTMLExporter

    from ssilang.jupyter.__main__ import install

    install(str(folder), "en")
    first = {"JUPYTER_PATH": str(folder / "share" / "jupyter"), "PYTHONPATH": str(_ROOT)}
    os.environ |= {k: os.pathsep.join([v, os.environ.get(k, "")]) for k, v in first.items()}
    os.environ["JUPYTER_RUNTIME_DIR"] = str(folder / "runtime")
    cells = nbformat.read(_HERE / "first_uplift.ipynb", as_version=4)
    nbclient.NotebookClient(
        cells, timeout=120, allow_errors=True, kernel_name="gibiane",
        resources={"metadata": {"path": str(folder)}},
    ).execute()  # fmt: skip
    made = folder / "first_uplift.html"
    made.write_text(HTMLExporter().from_notebook_node(cells)[0], encoding="utf-8")
    browser.open(made, 860, 780)
    browser.run("document.querySelector('.jp-RenderedImage').scrollIntoView({block: 'end'})")
    browser.run("new Promise(r => setTimeout(r, 500))")
    keep("notebook", browser.png())


def fragility(browser: Chromium, folder: Path) -> None:
    """The suite of docs/sweep.md."""
    from ssilang.cli.main import main as command

    scripts = re.findall(r"```ssi\n(.*?)```", (_HERE / "sweep.md").read_text("utf-8"), re.DOTALL)
    suite = folder / "suite"
    suite.mkdir()
    for name, script in zip(("records", "oscillator"), scripts[2:], strict=True):
        (suite / f"{name}.ssi").write_text(script, encoding="utf-8")
    command([str(suite / "records.ssi"), "--out", str(suite / "results" / "records")])
    command(
        ["sweep", str(suite / "oscillator.ssi"), "--motions", str(suite / "results" / "records"),
         "--set", "AG=1,2,4,6,10", "--fragility", "drift>0.001",
         "--out", str(suite / "oscillator_sweep")]
    )  # fmt: skip
    browser.open(suite / "oscillator_sweep" / "report.html", 1000, 1150)
    browser.until("!!document.querySelector('figure.chart').plot")
    browser.run("document.querySelector('#fragility').scrollIntoView()")
    browser.run("new Promise(r => setTimeout(r, 1000))")
    keep("fragility", browser.png())


def site(browser: Chromium, made: Path) -> None:
    """The gallery."""
    browser.open(made / "cases" / "gallery.html", 1240, 640)
    browser.run("new Promise(r => setTimeout(r, 1000))")
    keep("site", browser.png())


def keep(name: str, png: bytes) -> None:
    """Write a picture in as many colours as fit."""
    image = Image.open(io.BytesIO(png)).convert("RGB")
    target = PICTURES / f"{name}.png"
    for colours in COLOURS:
        image.quantize(colours, Image.Quantize.MEDIANCUT).save(target, optimize=True)
        if target.stat().st_size <= LARGEST:
            return
    raise SystemExit(f"{target} is larger than {LARGEST} bytes")


def main(monaco: str, made: str = "site") -> None:
    """Make all pictures."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        browser = Chromium(folder / "profile")
        try:
            editor(browser, Path(monaco), folder)
            notebook(browser, folder)
            fragility(browser, folder)
            site(browser, Path(made).resolve())
        finally:
            browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
