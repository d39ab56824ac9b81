"""Cells of Gibiane in a notebook: run by the kernel itself, and by a client as Jupyter does."""

import asyncio
import base64
import json
import os
import queue
import shutil
import sys
from pathlib import Path

import pytest

import ssilang
from ssilang.jupyter.__main__ import install, main

pytest.importorskip("ipykernel")
nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

from ssilang.jupyter.kernel import GibianeKernel  # noqa: E402
from ssilang.messages.message import sentence  # noqa: E402

CELLS = {
    "assigns": "LENGTH = 3. ; T1 = TABL ; T1 . 'ALPHA' = 2.5 ; L = PROG 1. PAS 1. 40. ;",
    "prints": "MESS 'length' LENGTH ;\nLENGTH * 2. ;",
    "table": "T1 ;",
    "list": "L ;",
    "curve": "EVOL 'MANU' 'T' (PROG 0. 1. 2.) 'U' (PROG 0. 4. 1.) ;",
    "draws": "DESS (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; MESS 'drawn' ;",
    "draws lines": "OPTI 'TRAC' 'SVG' ; DESS (EVOL 'MANU' (PROG 0. 1.) (PROG 2. 1.)) ;",
    "fails": "X = 1. ;\nY = X + ABSENT ;",
    "unread": "X = (1. ;\nZ = 3 ) ;",
    "goes on": "MESS X LENGTH ;",
    "warns": "X = LENGTH ;\nSI (X > 2.) MENA ; X = 0. ; FINS ;",
    "page": "INFO DROIT ;",
    "inner": "DEBP P1 ; INSIDE = 1 ; Y = 1 / 0 ; FINP ; P1 ;",
    "ends": "MESS 'last' ; FIN ; MESS 'never' ;",
}
ENDLESS = ["I = 0 ; REPE B ; I = I + 1 ; FIN B ;", "SI (I > 0) ; MESS 'alive' ; FINSI ;"]
FIRST = nbformat.read(Path(__file__).resolve().parents[2] / "docs/first_uplift.ipynb", as_version=4)
"""The manual's notebook."""
LESSONS = [cell for cell in FIRST.cells if cell.cell_type == "code"]


class Kernel(GibianeKernel):
    """Its messages, without a notebook."""

    def send_response(self, stream, kind, content):
        self.sent.append({"output_type": kind, **content})

    def run(self, text, silent=False):
        """A cell's outputs and the answer."""
        self.sent, self.execution_count = [], self.execution_count + 1
        answer = asyncio.run(self.do_execute(text, silent))
        return self.sent, answer


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """Outputs of all cells, and the kernel that ran them."""
    folder, before = tmp_path_factory.mktemp("cells"), Path.cwd()
    os.chdir(folder)
    try:
        kernel = Kernel()
        kernel.answers = {}
        found = {}
        for name, text in CELLS.items():
            found[name], kernel.answers[name] = kernel.run(text)
    finally:
        os.chdir(before)
    return found, folder, kernel


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    """What a client gets of the manual's cells and of one that never ends."""
    folder = tmp_path_factory.mktemp("notebook")
    before = dict(os.environ)
    install(str(folder), "en")
    os.environ["JUPYTER_PATH"] = str(folder / "share/jupyter")
    os.environ["JUPYTER_RUNTIME_DIR"] = str(folder / "runtime")
    os.environ["PYTHONPATH"] = str(Path(ssilang.__file__).parents[1])
    made = nbformat.v4.new_notebook()
    made.cells = [nbformat.v4.new_code_cell(t) for t in [c.source for c in LESSONS] + ENDLESS]
    made.metadata["kernelspec"] = {"name": "gibiane", "display_name": "Gibiane"}
    client = nbclient.NotebookClient(
        made, timeout=60, allow_errors=True, kernel_name="gibiane",
        resources={"metadata": {"path": str(folder)}},
    )  # fmt: skip
    try:
        return asyncio.run(answers(client))
    finally:
        os.environ.clear()
        os.environ.update(before)


async def answers(client):
    """Run the cells one by one; interrupt the endless one."""
    found = []
    async with client.async_setup_kernel():
        for place, cell in enumerate(client.nb.cells):
            running = asyncio.ensure_future(client.async_execute_cell(cell, place))
            if cell.source == ENDLESS[0]:
                await asyncio.sleep(0.8)
                await client.km.interrupt_kernel()
            await running
            found.append(cell.outputs)
        info = await client.kc.kernel_info(reply=True, timeout=30)
    assert info["content"]["language_info"]["name"] == "gibiane"
    return found


def shown(outputs):
    """Texts of a cell's outputs, and the kinds of its data; nothing of what said progress."""
    errors = ["\n".join(o["traceback"]) for o in outputs if o["output_type"] == "error"]
    data = [d for d in data_of(outputs) if d != {"text/plain": ""}]
    return text_of(outputs), errors, [(sorted(d), d["text/plain"]) for d in data]


def text_of(outputs):
    """What streams say."""
    return "".join(o["text"] for o in outputs if o["output_type"] == "stream")


def data_of(outputs):
    return [o["data"] for o in outputs if o["output_type"] == "display_data"]


def test_the_first_uplift_of_the_manual_shows_what_it_holds(served):
    for outputs, cell in zip(served, LESSONS, strict=False):
        assert shown(outputs) == shown(cell.outputs)
    assert sum(len(shown(cell.outputs)[1]) for cell in LESSONS) == 1  # the one that it shows


def test_an_interruption_leaves_the_session_alive(served):
    (error,), survived = served[len(LESSONS) :]
    assert error["ename"] == "interrupted"
    assert f"--> cell {len(LESSONS) + 1}:1:" in error["traceback"][0]
    assert text_of(survived) == "alive\n"


def test_cells_share_one_session_and_show_what_they_give(ran):
    found, _, kernel = ran
    assert found["assigns"] == []
    assert text_of(found["prints"]).startswith("length 3.0")
    assert [o["output_type"] for o in found["prints"]] == ["stream", "display_data"]
    assert "6." in data_of(found["prints"])[0]["text/plain"]
    (warning,) = found["warns"]
    assert warning["name"] == "stderr"
    assert warning["text"].startswith("warning: ")
    assert text_of(found["ends"]) == "last\n"
    good = {"status": "ok", "execution_count": 2, "payload": [], "user_expressions": {}}
    assert kernel.answers["prints"] == good
    assert kernel.run("MESS 'x' ; LENGTH ; Y = 1 / 0 ;", silent=True)[0] == []


def test_tables_lists_and_curves_are_html_with_text_beside(ran):
    found, *_ = ran
    (table,), (numbers,), (curve,) = (data_of(found[n]) for n in ("table", "list", "curve"))
    assert "<td>&#x27;ALPHA&#x27;</td><td>2.5</td>" in table["text/html"]
    assert table["text/plain"] == "Table of 1 index"
    assert numbers["text/html"].count("<tr>") == 1 + 8 + 1 + 8
    assert "<td>40</td><td>40</td>" in numbers["text/html"]
    assert "data:image/png;base64," in curve["text/html"]
    assert "<td>1</td><td>4</td>" in curve["text/html"]
    assert curve["text/plain"]


def test_pictures_stand_where_they_were_drawn(ran):
    found, folder, _ = ran
    picture, text = found["draws"]
    (file,) = (folder / "results/notebook").glob("*.png")
    assert base64.b64decode(picture["data"]["image/png"]) == file.read_bytes()
    assert picture["data"]["text/plain"] == file.name
    assert text["text"] == "drawn\n"
    (lines,) = found["draws lines"]
    drawn = (folder / "results/notebook" / lines["data"]["text/plain"]).read_text("utf-8")
    assert lines["data"]["image/svg+xml"] == drawn


def test_errors_have_their_place_in_the_cell_and_the_session_goes_on(ran):
    found, _, kernel = ran
    (error,) = found["fails"]
    number = list(CELLS).index("fails") + 1
    assert error["ename"] == "no-rule"
    assert error["evalue"].startswith("error")
    assert error["evalue"] == error["traceback"][0].split("\n")[0]
    assert f"--> cell {number}:2:" in error["traceback"][0]
    del error["output_type"]
    assert kernel.answers["fails"] == {"status": "error", "execution_count": number, **error}
    (unread,) = found["unread"]
    assert unread["ename"] == "unclosed-paren"
    assert unread["traceback"][0].count("-->") == 2
    assert text_of(found["goes on"]).split() == ["1.00000E+00", "3.00000E+00"]
    assert kernel.gibiane.frame is kernel.gibiane.root
    assert kernel.gibiane.root.find("INSIDE") is None


def test_help_completion_and_inspection_know_the_session(ran):
    found, _, kernel = ran
    assert "DROIT" in text_of(found["page"])
    offered = {}
    for code in ("X = LEN", "Y = T1 . 'AL", "OPTI 'DIM", "QQ .", "LENGTH"):
        offered[code] = asyncio.run(kernel.do_complete(code, len(code)))
    first = offered["X = LEN"]
    assert (first["matches"], first["cursor_start"], first["cursor_end"]) == (["LENGTH"], 4, 7)
    (kind,) = first["metadata"]["_jupyter_types_experimental"]
    assert (kind["text"], kind["type"], kind["signature"]) == ("LENGTH", "name", "FLOTTANT")
    assert "'ALPHA'" in offered["Y = T1 . 'AL"]["matches"]
    assert offered["Y = T1 . 'AL"]["cursor_start"] == 9
    assert "'DIME'" in offered["OPTI 'DIM"]["matches"]
    assert (offered["QQ ."]["matches"], offered["QQ ."]["cursor_start"]) == ([], 4)
    inside = asyncio.run(kernel.do_complete("X = LENG * 2", 7))
    assert (inside["matches"], inside["cursor_start"], inside["cursor_end"]) == (["LENGTH"], 4, 8)
    told = {c: asyncio.run(kernel.do_inspect(c, 1)) for c in ("LENGTH", "DROIT", "QQQQ", "T1")}
    value = told["LENGTH"]["data"]["text/markdown"]
    assert value.startswith("**LENGTH** : FLOTTANT\n\n```text\n")
    assert value.endswith("\n```")
    assert "3." in value
    assert told["DROIT"]["data"]["text/plain"].startswith("**DROI")
    assert (told["QQQQ"]["found"], told["QQQQ"]["data"]) == (False, {})
    for code, status in (("SI VRAI ;", "incomplete"), ("X = 1 ;", "complete"), ("X = 1", "inc")):
        assert asyncio.run(kernel.do_is_complete(code))["status"].startswith(status)
    assert asyncio.run(kernel.do_is_complete("X = ) ;"))["status"] == "complete"


def test_a_second_console_cannot_run_beside_a_cell(tmp_path, monkeypatch):
    """The session is one: what a thread beside sets would stand in the middle of a procedure."""
    asked = ("create_subshell_request", "debug_request")
    assert not set(asked) & set(GibianeKernel.control_msg_types)
    install(str(tmp_path), "en")
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path / "share/jupyter"))
    monkeypatch.setenv("PYTHONPATH", str(Path(ssilang.__file__).parents[1]))
    client_of = pytest.importorskip("jupyter_client.manager").start_new_kernel
    manager, client = client_of(kernel_name="gibiane", cwd=str(tmp_path))
    try:
        told = client.kernel_info(reply=True, timeout=30)["content"]
        assert told["implementation"] == "ssilang"
        assert told["supported_features"] == []
        client.control_channel.send(client.session.msg(asked[0], {}))
        with pytest.raises(queue.Empty):
            client.control_channel.get_msg(timeout=1.5)
        answer = client.execute_interactive("X = 1 ; MESS X ;", timeout=60, output_hook=list)
        assert answer["content"]["status"] == "ok"
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)


def test_the_kernel_is_told_to_jupyter_with_its_language(tmp_path, capsys):
    assert main(["install", "--prefix", str(tmp_path), "--lang", "fr"]) == 0
    said = capsys.readouterr().out
    (place,) = (p.parent for p in tmp_path.rglob("kernel.json"))
    assert said == sentence("jupyter.installed", {"place": place}, "fr") + "\n"
    spec = json.loads((place / "kernel.json").read_text())
    assert spec["argv"][:4] == [sys.executable, "-P", "-m", "ssilang.jupyter"]
    assert spec["env"] == {"SSILANG_LANGUAGE": "fr"}
    assert spec["interrupt_mode"] == "signal"


@pytest.mark.skipif(os.name != "posix", reason="links of one system")
@pytest.mark.parametrize("name", ["results", "results/notebook"])
def test_results_that_lead_elsewhere_are_not_followed(tmp_path, monkeypatch, name):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "theirs" / name).parent.mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "theirs")
    kernel = Kernel()
    assert kernel.run(CELLS["draws"])[1]["status"] == "ok"
    shutil.rmtree(tmp_path / "theirs" / "results")
    (tmp_path / "theirs" / name).parent.mkdir(exist_ok=True)
    (tmp_path / "theirs" / name).symlink_to(tmp_path / "elsewhere")
    answer = Kernel().run(CELLS["draws"])[1]
    assert (answer["status"], answer["ename"]) == ("error", "io.folder-is-link")
    assert list((tmp_path / "elsewhere").iterdir()) == []


def test_what_a_script_says_is_no_html(tmp_path, monkeypatch):
    """In a notebook it would run with the rights of whoever reads it."""
    monkeypatch.chdir(tmp_path)
    word = "<img src=x onerror=alert(1)>"
    sent, answer = Kernel().run(
        f"T = TABL '{word}' ; T . '{word}' = '{word}' ; T ; W = MOTS '{word}' ; W ;\n"
        f"L = PROG 1. 2. ; E = EVOL 'MANU' 'LEGE' '{word}' '{word}' L '{word}' L ; E ;"
        f"DESS E 'TITR' '{word}' ;"
    )
    assert answer["status"] == "ok"
    shown = [
        t for s in sent for kind, t in s["data"].items() if kind in ("text/html", "image/svg+xml")
    ]
    assert len(shown) >= 3
    assert sum("&lt;img src=x" in t for t in shown) >= 3
    assert not any("<img src=x" in t for t in shown)
