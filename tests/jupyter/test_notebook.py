"""Cells of Gibiane in a notebook: run by a client as Jupyter does, in one process for all."""

import asyncio
import base64
import json
import os
import sys
from pathlib import Path

import pytest

import ssilang
from ssilang.jupyter.__main__ import install

pytest.importorskip("ipykernel")
nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

CELLS = {
    "assigns": "LENGTH = 3. ; T1 = TABL ; T1 . 'ALPHA' = 2.5 ; L = PROG 1. PAS 1. 40. ;",
    "prints": "MESS 'length' LENGTH ;\nLENGTH * 2. ;",
    "table": "T1 ;",
    "list": "L ;",
    "curve": "EVOL 'MANU' 'T' (PROG 0. 1. 2.) 'U' (PROG 0. 4. 1.) ;",
    "draws": "DESS (EVOL 'MANU' (PROG 0. 1.) (PROG 0. 1.)) ; MESS 'drawn' ;",
    "fails": "X = 1. ;\nY = X + ABSENT ;",
    "unread": "X = (1. ;",
    "goes on": "MESS X LENGTH ;",
    "page": "INFO DROIT ;",
    "loops": "I = 0 ; REPE B ; I = I + 1 ; FIN B ;",
    "survives": "SI (I > 0) ; MESS 'alive' ; FINSI ;",
}


FIRST = nbformat.read(Path(__file__).resolve().parents[2] / "docs/first_uplift.ipynb", as_version=4)
"""The manual's notebook, whose cells run before the others."""
LESSONS = [cell for cell in FIRST.cells if cell.cell_type == "code"]


def notebook():
    made = nbformat.v4.new_notebook()
    texts = [cell.source for cell in LESSONS] + list(CELLS.values())
    made.cells = [nbformat.v4.new_code_cell(text) for text in texts]
    made.metadata["kernelspec"] = {"name": "gibiane", "display_name": "Gibiane"}
    return made


def place_of(name):
    """The number of a cell."""
    return len(LESSONS) + list(CELLS).index(name) + 1


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """Outputs of all cells, and what the kernel answered besides."""
    folder = tmp_path_factory.mktemp("notebook")
    before = dict(os.environ)
    install(str(folder), "en")
    os.environ["JUPYTER_PATH"] = str(folder / "share/jupyter")
    os.environ["JUPYTER_RUNTIME_DIR"] = str(folder / "runtime")
    os.environ["PYTHONPATH"] = str(Path(ssilang.__file__).parents[1])
    client = nbclient.NotebookClient(
        notebook(), timeout=60, allow_errors=True, kernel_name="gibiane",
        resources={"metadata": {"path": str(folder)}},
    )  # fmt: skip
    try:
        return asyncio.run(answers(client)), folder
    finally:
        os.environ.clear()
        os.environ.update(before)


async def answers(client):
    """Run the cells one by one; ask for help; interrupt the endless one."""
    found = {}
    names = [*range(len(LESSONS)), *CELLS]
    async with client.async_setup_kernel():
        for place, (name, cell) in enumerate(zip(names, client.nb.cells, strict=True)):
            running = asyncio.ensure_future(client.async_execute_cell(cell, place))
            if name == "loops":
                await asyncio.sleep(0.8)
                await client.km.interrupt_kernel()
            await running
            found[name] = cell.outputs
        for name, code in {
            "names": "X = LEN", "indices": "Y = T1 . 'AL", "operators": "OPTI 'DIM",
        }.items():  # fmt: skip
            reply = await client.kc.complete(code, reply=True, timeout=30)
            found[name] = reply["content"]
        for name, code in {"value": "LENGTH", "help": "DROIT", "nothing": "QQQQ"}.items():
            reply = await client.kc.inspect(code, cursor_pos=1, reply=True, timeout=30)
            found[name] = reply["content"]
        for name, code in {"open": "SI VRAI ;", "closed": "X = 1 ;"}.items():
            reply = await client.kc.is_complete(code, reply=True, timeout=30)
            found[name] = reply["content"]["status"]
        info = await client.kc.kernel_info(reply=True, timeout=30)
        found["info"] = info["content"]["language_info"]["name"]
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


def test_the_first_uplift_of_the_manual_shows_what_it_holds(ran):
    found, _ = ran
    for place, cell in enumerate(LESSONS):
        assert shown(found[place]) == shown(cell.outputs)
    assert sum(len(shown(cell.outputs)[1]) for cell in LESSONS) == 1  # the one that it shows


def test_cells_share_one_session_and_show_what_they_give(ran):
    found, _ = ran
    assert found["assigns"] == []
    assert text_of(found["prints"]).startswith("length 3.0")
    assert "6." in data_of(found["prints"])[0]["text/plain"]


def test_tables_lists_and_curves_are_html_with_text_beside(ran):
    found, _ = ran
    (table,), (numbers,), (curve,) = (data_of(found[n]) for n in ("table", "list", "curve"))
    assert "<td>&#x27;ALPHA&#x27;</td><td>2.5</td>" in table["text/html"]
    assert table["text/plain"] == "Table of 1 index"
    assert numbers["text/html"].count("<tr>") == 1 + 8 + 1 + 8
    assert "<td>40</td><td>40</td>" in numbers["text/html"]
    assert "data:image/png;base64," in curve["text/html"]
    assert "<td>1</td><td>4</td>" in curve["text/html"]
    assert curve["text/plain"]


def test_pictures_stand_where_they_were_drawn(ran):
    found, folder = ran
    picture, text = found["draws"]
    assert base64.b64decode(picture["data"]["image/png"])[:4] == b"\x89PNG"
    assert text["text"] == "drawn\n"
    assert list((folder / "results/notebook").glob("*.png"))


def test_errors_have_their_place_in_the_cell_and_the_session_goes_on(ran):
    found, _ = ran
    (error,) = found["fails"]
    assert error["ename"] == "no-rule"
    assert f"--> cell {place_of('fails')}:2:" in error["traceback"][0]
    assert found["unread"][0]["ename"] == "unclosed-paren"
    assert text_of(found["goes on"]).split() == ["1.00000E+00", "3.00000E+00"]


def test_an_interruption_leaves_the_session_alive(ran):
    found, _ = ran
    (error,) = found["loops"]
    assert error["ename"] == "interrupted"
    assert f"--> cell {place_of('loops')}:1:" in error["traceback"][0]
    assert text_of(found["survives"]) == "alive\n"


def test_help_completion_and_inspection_know_the_session(ran):
    found, _ = ran
    assert "DROIT" in text_of(found["page"])
    assert found["names"]["matches"] == ["LENGTH"]
    assert (found["names"]["cursor_start"], found["names"]["cursor_end"]) == (4, 7)
    assert "'ALPHA'" in found["indices"]["matches"]
    assert "'DIME'" in found["operators"]["matches"]
    assert "FLOTTANT" in found["value"]["data"]["text/markdown"]
    assert "**" in found["help"]["data"]["text/markdown"]
    assert found["nothing"]["found"] is False
    assert (found["open"], found["closed"]) == ("incomplete", "complete")
    assert found["info"] == "gibiane"


def test_the_kernel_is_told_to_jupyter_with_its_language(tmp_path):
    place = install(str(tmp_path), "fr")
    spec = json.loads((place / "kernel.json").read_text())
    assert spec["argv"][:4] == [sys.executable, "-P", "-m", "ssilang.jupyter"]
    assert spec["env"] == {"SSILANG_LANGUAGE": "fr"}
    assert spec["interrupt_mode"] == "signal"
