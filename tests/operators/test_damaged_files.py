"""Damaged decks and input files end with a message; a sample of `benchmarks/fuzz_decks.py`."""

import importlib.util
import io
import json
import random
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from together import together

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.text.source import Source

_CAMPAIGN = Path(__file__).resolve().parents[2] / "benchmarks" / "fuzz_decks.py"
_SAMPLE = 60


@pytest.fixture(scope="module")
def campaign():
    spec = importlib.util.spec_from_file_location("fuzz_decks", _CAMPAIGN)
    module = importlib.util.module_from_spec(spec)
    sys.modules["fuzz_decks"] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules["fuzz_decks"]


@pytest.fixture(scope="module")
def files(campaign, tmp_path_factory):
    """A file of every format that is read, as the interpreter writes it."""
    return campaign.made_files(tmp_path_factory.mktemp("files"))


def run(text: str, folder: Path):
    source = Source("deck.ssi", text, folder / "deck.ssi")
    return run_source(source, RunOptions(folder / "out"), io.StringIO(), io.StringIO())


def test_files_that_are_whole_are_read_and_used(campaign, files, tmp_path):
    assert set(files) == set(campaign._USE)
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
        result = run(campaign._USE[name].format(f=name), tmp_path)
        assert result.exit_code == 0, result.message


def test_damaged_files_end_with_a_message(campaign, files, tmp_path):
    for number in range(_SAMPLE):
        folder = tmp_path / str(number)
        folder.mkdir()
        text = campaign.damaged_input(files, random.Random(f"sample {number}"), folder)
        assert campaign.outcome(text, folder)[1] == "", (number, text)


def test_damaged_decks_end_with_a_message(campaign, tmp_path):
    decks = [t for t in campaign.decks() if len(t) < 300 and "DYNA" not in t]
    rng = random.Random(3)
    for _ in range(_SAMPLE):
        text = campaign.mutated(rng.choice(decks), rng)
        assert campaign.outcome(text, tmp_path)[1] == "", text


def test_the_campaign_sees_what_python_lets_through(campaign, monkeypatch, tmp_path):
    from ssilang.operators.lists import progressions

    def fails(*_):
        raise KeyError("lost")

    assert campaign.outcome("L = PROG 0. PAS 0.5 1. ;", tmp_path) == ("ran", "")
    monkeypatch.setattr(progressions, "real_steps", fails)
    kind, defect = campaign.outcome("L = PROG 0. PAS 0.5 1. ;", tmp_path)
    assert kind == "defect"
    assert "KeyError" in defect


# ---- each kind of damage that campaigns found

_UNV = """    -1
  2411
 1 1 1 11
 0. 0. 0.
 2 1 1 11
 2. 0. 0.
    -1
    -1
  2412
 1 11 1 1 7 2
 0 1 1
 1 {second}
    -1
"""


@together("second", ["9", "2 2", "x", "99999999999999999999999"])
def test_a_cell_of_a_universal_file_that_has_not_its_nodes(second, tmp_path):
    (tmp_path / "line.unv").write_text(_UNV.format(second=second))
    result = run("OPTI DIME 3 ; T = LIRE 'UNV' 'line.unv' ;", tmp_path)
    assert [e.code for e in result.errors] == ["io.no-readable-unv-file"]
    (tmp_path / "line.unv").write_text(_UNV.format(second="2"))
    assert run("OPTI DIME 3 ; T = LIRE 'UNV' 'line.unv' ;", tmp_path).exit_code == 0


@together(
    "sizes, values, code",
    [
        ("NPTS= 2, DT= .01 SEC", ".1 .2", ""),
        ("NPTS= 2, DT= E SEC", ".1 .2", "io.line-no-npts-dt"),
        ("NPTS= 2, DT= 1E999 SEC", ".1 .2", "io.line-no-npts-dt"),
        ("NPTS= 2, DT= .01 SEC", ".1 1E999", "io.record-not-finite"),
        ("NPTS= 3, DT= .01 SEC", ".1 .2", "io.line-says-values-file"),
        ("NPTS= " + "9" * 5000 + ", DT= .01 SEC", ".1 .2", "io.line-no-npts-dt"),
    ],
)
def test_a_motion_with_a_damaged_head_or_value(sizes, values, code, tmp_path):
    (tmp_path / "q.at2").write_text(f"PEER\nevent\nUNITS OF G\n{sizes}\n{values}\n")
    result = run("E = LIRE 'PEER' 'q.at2' ;", tmp_path)
    assert [e.code for e in result.errors] == ([code] if code else [])


def test_a_surface_with_a_corner_that_is_no_place(tmp_path):
    text = "facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 {y} 0\n"
    for y, code in (("1", []), ("1e300", ["kernel.mesh.node-out-of-range"])):
        (tmp_path / "one.stl").write_text(text.format(y=y))
        result = run("OPTI DIME 3 ; M = LIRE 'STL' 'one.stl' ; ELIM M 1.E-3 ;", tmp_path)
        assert [e.code for e in result.errors] == code


def test_a_procedure_file_with_errors_tells_them(tmp_path):
    (tmp_path / "bad.procedur").write_text("DEBP TWICE X*'FLOTTANT' ;\nSI VRAI ;\nFINP (2. * X) ;")
    result = run("LIRE 'PROC' 'bad.procedur' ;", tmp_path)
    assert result.exit_code == 1
    assert "internal" not in [e.code for e in result.errors]
    assert "bad.procedur" in result.message


def archive_of(files, change) -> bytes:
    """The archive with its head changed."""
    with zipfile.ZipFile(io.BytesIO(files["all.sauv"])) as z:
        members = {n: z.read(n) for n in z.namelist()}
    head = json.loads(members["objects.json"])
    change(head)
    members["objects.json"] = json.dumps(head).encode()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as z:
        for name, content in members.items():
            z.writestr(name, content)
    return packed.getvalue()


def part_of(head, name):
    """Fields of the first object of a class."""
    return next(parts for kind, parts in head["objects"] if kind.endswith(":" + name))


def point_to_itself(head):
    number = next(i for i, o in enumerate(head["objects"]) if o[0].endswith(":Mesh"))
    head["objects"][number][1]["sides"] = ["t", [["o", number]]]


def fields(name, **changed):
    return lambda head: part_of(head, name).update(changed)


def class_name(name):
    return lambda head: head["objects"][-1].__setitem__(0, name)


_HEADS = [  # what is said, the damage
    ("blocks of an object 'Mesh'", fields("Mesh", blocks=3)),
    ("blocks of an object 'Mesh'", fields("Mesh", blocks=["t", ["text"]])),
    ("cell_type of an object 'CellBlock'", fields("CellBlock", cell_type=["o", 1])),
    ("raw of an object 'CellBlock'", fields("CellBlock", raw=3)),
    ("components of an object 'CellFieldBlock'", fields("CellFieldBlock", components=3)),
    ("element of an object 'Zone'", fields("Zone", element="QUA5")),
    ("space of an object 'LoadPart'", fields("LoadPart", space=None)),
    (":Mesh of an object 'class'", fields("CellBlock", cell_type=["e", ":Mesh", "X"])),
    ("DIME of an object 'OPTI'", lambda head: head["settings"].update(DIME=[3])),
    ("INCO of an object 'OPTI'", lambda head: head["settings"].update(INCO=3)),
    ("all.sauv is damaged: 'raw'", lambda head: part_of(head, "CellBlock").pop("raw")),
    ("all.sauv is damaged: maximum recursion", point_to_itself),
    ("SAUV of ssilang wrote: objects", lambda head: head.update(settings=3)),
    ("SAUV of ssilang wrote: objects", lambda head: head.update(objects="x")),
    ("SAUV of ssilang wrote: 'int' object", lambda head: head.update(records=[3])),
    ("SAUV of ssilang wrote: records", lambda head: head["records"][0].update(names=3)),
    ("SAUV of ssilang wrote: format 'x'", lambda head: head.update(format="x")),
    ("'arrays/999.npy'", fields("NodeValues", values=["a", 999])),
    ("unknown kind of data 'z'", fields("NodeValues", values=["z", 999])),
    ("object of unknown kind 'nothing'", class_name("nothing")),
    ("'ssilang.kernel.mesh.mesh:No', which does not", class_name("ssilang.kernel.mesh.mesh:No")),
    *((f"'{name}', which is no saved", class_name(name)) for name in (
        ":Nothing", "os:system", "ssilang.cli.main:main", "ssilang.kernel.mesh.mesh:CELL_TYPES",
        "ssilang.kernel.mesh.mesh:Mesh.of")),
    ("later version of ssilang, 7.0.0; this is 0.1.0",
     lambda head: head.update(version=99, ssilang="7.0.0")),
]  # fmt: skip


@together("said, damage", _HEADS)
def test_an_archive_whose_head_is_damaged_fails_when_it_is_read(said, damage, files, tmp_path):
    (tmp_path / "all.sauv").write_bytes(archive_of(files, damage))
    result = run("OPTI REST 'all.sauv' ; REST ; MESS 'read' ;", tmp_path)
    assert [e.code.split(".")[0] for e in result.errors] == ["io"]
    assert said in result.message
    (tmp_path / "all.sauv").write_bytes(archive_of(files, lambda head: None))
    assert run("OPTI REST 'all.sauv' ; REST ; LIST S1 ;", tmp_path).exit_code == 0


@pytest.mark.parametrize("array", ["raw", "colours", "alias"])
@pytest.mark.parametrize(
    ("name", "text"),
    [("all.sauv", "OPTI REST 'all.sauv' ; REST ;"), ("mesh", "OPTI LECT 'mesh' ; LIRE S1 ;")],
)
def test_an_archive_names_nodes_and_colours_that_are_there(name, text, array, files, tmp_path):
    with zipfile.ZipFile(io.BytesIO(files[name])) as z:
        members = {n: z.read(n) for n in z.namelist()}
    head = json.loads(members["objects.json"])
    nodes = {"alias": next(parts for kind, parts in head["objects"] if kind == "nodes")[2]}
    number = (nodes if array == "alias" else part_of(head, "CellBlock"))[array][1]
    sound = np.load(io.BytesIO(members[f"arrays/{number}.npy"]))
    for first, codes in (
        (99 if array == "colours" else 10**6, ["io.damaged-object"]),
        (-1, ["io.damaged-object"]),
        (sound.flat[0], []),
    ):
        table = sound.copy()
        table.flat[0] = first
        buffer = io.BytesIO()
        np.save(buffer, table)
        with zipfile.ZipFile(tmp_path / name, "w") as z:
            for member, content in members.items():
                changed = member == f"arrays/{number}.npy"
                z.writestr(member, buffer.getvalue() if changed else content)
        result = run(text, tmp_path)
        assert [e.code for e in result.errors] == codes


def test_texts_come_back_from_an_archive_as_they_were(tmp_path):
    text = "Y = 4 ; T1 = TEXT '2 + 3' ; T2 = TEXT 'Y' '*' 2 ; T3 = TEXT 'MESS ''it''''s''' ;"
    text += "OPTI SAUV 'a' ; SAUV ; T1 = 0 ; T2 = 0 ; OPTI REST 'a' ; REST ; A = T1 ; B = T2 ; T3 ;"
    result = run(text, tmp_path)
    assert result.exit_code == 0, result.message
    assert result.session.root.find("A") == 5
    assert result.session.root.find("B") == 8


@pytest.mark.parametrize("at", [0.1, 0.3, 0.5, 0.7, 0.9, 0.99])
def test_an_archive_that_is_cut_or_holds_wrong_bytes(at, files, tmp_path):
    data = files["all.sauv"]
    place = int(at * len(data))
    for wrong in (data[:place], data[:place] + b"\xff\x00\x13" + data[place + 3 :]):
        (tmp_path / "all.sauv").write_bytes(wrong)
        result = run("OPTI REST 'all.sauv' ; REST ; LIST S1 ; LIST U1 ; SAUV ;", tmp_path)
        assert [e.code.split(".")[0] for e in result.errors] in ([], ["io"])
