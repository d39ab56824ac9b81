"""Save files: objects come back equal and shared, nodes shift, nothing foreign is built."""

import importlib
import shutil
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.cli.run import run_file
from ssilang.io.archive import Decoder, Encoder, Record, container, read_archive, write_archive
from ssilang.io.archive.classes import HOMES, class_name, class_named
from ssilang.io.errors import InputError, OutputError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.system import peak_memory


def saved(path: Path, **values: Any) -> None:
    encoder = Encoder()
    names = {k: encoder.encode(v) for k, v in values.items()}
    write_archive(path, encoder.objects, encoder.arrays, [Record("", names)], {})


def restored(path: Path, nodes: NodeTable) -> dict[str, Any]:
    archive = read_archive(path)
    decoder = Decoder(archive, nodes)
    return {k: decoder.decode(c) for k, c in archive.records[0].names.items()}


def square() -> Mesh:
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0), (1, 1), (0, 1)]))
    return Mesh.of(table, "QUA4", ids[None, :], 3)


def test_objects_come_back_over_shifted_nodes(tmp_path: Path) -> None:
    mesh = square()
    field = NodeField.of(mesh.nodes, mesh.node_ids, {"UX": np.arange(4.0)}, "DIFFUS")
    saved(tmp_path / "s", M=mesh, F=field, P=Point(mesh.nodes, 2))
    nodes = NodeTable()
    nodes.add(np.array([[7.0, 7.0], [8.0, 8.0]]))
    back = restored(tmp_path / "s", nodes)
    assert back["M"].nodes is nodes
    assert np.array_equal(back["M"].blocks[0].connectivity, [[2, 3, 4, 5]])
    assert np.array_equal(back["M"].blocks[0].coordinates, mesh.blocks[0].coordinates)
    assert np.array_equal(back["F"].values_at("UX", np.arange(2, 6)), np.arange(4.0))
    assert back["F"].nature == "DIFFUS"
    assert np.array_equal(back["P"].coordinates, [1.0, 1.0, 0.0])
    assert nodes.coordinates[0, 0] == 7.0


def test_merged_nodes_stay_merged(tmp_path: Path) -> None:
    mesh = square()
    mesh.nodes.merge(np.array([0]), np.array([3]))
    saved(tmp_path / "s", M=mesh)
    nodes = NodeTable()
    nodes.add(np.array([[7.0, 7.0]]))
    assert np.array_equal(
        restored(tmp_path / "s", nodes)["M"].blocks[0].connectivity, [[1, 2, 3, 1]]
    )


def test_what_is_shared_stays_shared(tmp_path: Path) -> None:
    mesh = square()
    block = mesh.blocks[0]
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE",), "QUA4", Mode.AXISYMMETRIC)
    cells = CellField((CellFieldBlock(block, {"E": np.ones((1, 4))}, "STRESSES", "QUA4"),))
    saved(tmp_path / "s", M=mesh, MO=Model((zone,)), C=cells)
    back = restored(tmp_path / "s", NodeTable())
    assert back["MO"].zones[0].cells is back["M"].blocks[0]
    assert back["C"].blocks[0].cells is back["M"].blocks[0]
    assert back["MO"].zones[0].mode is Mode.AXISYMMETRIC


def test_parameters_that_are_objects(tmp_path: Path) -> None:
    mesh = square()
    values = np.empty((1, 1), dtype=object)
    values[0, 0] = Point(mesh.nodes, 1)
    saved(tmp_path / "s", C=CellField((CellFieldBlock(mesh.blocks[0], {"V": values}),)))
    back = restored(tmp_path / "s", NodeTable())["C"].blocks[0].components["V"]
    assert np.array_equal(back[0, 0].coordinates, [1.0, 0.0, 0.0])


def test_scalars_of_arrays_come_back_as_those_of_python(tmp_path: Path) -> None:
    given = {"A": np.float64(0.1), "B": np.int32(-7), "C": np.bool_(True), "D": np.str_("x")}
    saved(tmp_path / "s", **given)
    back = restored(tmp_path / "s", NodeTable())
    assert back == {"A": 0.1, "B": -7, "C": True, "D": "x"}
    assert {type(v) for v in back.values()} == {float, int, bool, str}


def test_pickled_arrays_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "s"
    write_archive(path, [], [], [Record("", {"X": ["a", 0]})], {})
    import io

    buffer = io.BytesIO()
    np.save(buffer, np.array([{"a": 1}], dtype=object), allow_pickle=True)
    with zipfile.ZipFile(path, "a") as z:
        z.writestr("arrays/0.npy", buffer.getvalue())
    with pytest.raises(InputError, match="no file that SAUV"):
        restored(path, NodeTable())


@together("kind", [complex, "U8", "M8[s]"])
def test_arrays_of_other_kinds_than_objects_hold_are_damage(tmp_path, kind):
    path, value = tmp_path / "s", np.array([1, 2, 3])
    saved(path, X=value.astype(float), N=value)
    assert restored(path, NodeTable())["X"].tolist() == [1.0, 2.0, 3.0]
    saved(path, X=value.astype(kind))
    with refusal(InputError, "io.no-file-sauv-ssilang"):
        restored(path, NodeTable())


def test_foreign_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "s").write_bytes(b"binary of another program")
    with pytest.raises(InputError, match="no file that SAUV"):
        read_archive(tmp_path / "s")


def test_an_object_of_unknown_class_is_not_saved(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be saved"):
        saved(tmp_path / "s", X=object())
    assert not (tmp_path / "s").exists()


def test_a_file_of_the_last_release_is_restored(tmp_path):
    file = Path(__file__).with_name("files") / "0.1.0.sauv"  # its modules stood elsewhere
    shutil.copy(file, tmp_path / "old.sauv")
    script = tmp_path / "old.ssi"
    script.write_text(
        "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; OPTI REST 'old.sauv' ; REST ; "
        "MESS (MAXI 'ABS' (T . 'U')) (MAXI 'ABS' SG) (NBEL S) (TYPE MJ) (TYPE AJ) ;",
        encoding="utf-8",
    )
    result = run_file(script)
    assert result.exit_code == 0, result.message
    assert "3.17147" in result.output
    assert "7.68272" in result.output


OBJECTS = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ; OPTI REST 'old.sauv' ; REST ;
MESS (MAXI 'ABS' U) (MAXI 'ABS' (T . 'DEPLACEMENTS' . 3)) (MAXI (T . 'VARIABLES_INTERNES' . 3)) ;
MESS (MAXI V) (MAXI (EXTR E 'ORDO')) (EXTR LE 2) (EXTR LM 2) F1 W1 X1 (DOUBLE 4.) ;
R2 = (RIGI MS AS) ET B ; D1 = (RESO R (FORC (3. -5.) L2)) - (RESO R2 (FORC (3. -5.) L2)) ;
MESS (MAXI 'ABS' D1) (MAXI 'ABS' ((RESO R (FORC (3. -5.) L2)) - U)) (NBEL (S ELEM 'ROUG')) ;
T1 = TABL ; T1 . 'MODELE' = MS ; T1 . 'CARACTERISTIQUES' = AS ; T1 . 'BLOCAGES_MECANIQUES' = B ;
T1 . 'CHARGEMENT' = C ; T1 . 'TEMPS_CALCULES' = PROG 0. 1. 2. 3. ; PASAPAS T1 ;
MESS (MAXI 'ABS' ((T . 'DEPLACEMENTS' . 3) - (T1 . 'DEPLACEMENTS' . 3))) ;
"""


def test_all_kinds_of_objects_of_the_last_release_are_restored_and_used(tmp_path):
    """Values that the release printed when it wrote the file, and what the objects give today."""
    shutil.copy(Path(__file__).with_name("files") / "0.1.0-objects.sauv", tmp_path / "old.sauv")
    script = tmp_path / "old.ssi"
    script.write_text(OBJECTS, encoding="utf-8")
    result = run_file(script)
    assert result.exit_code == 0, result.message
    *lines, solved, difference = result.output.splitlines()
    assert lines == [
        " 2.73931E+00 2.27158E+02 7.63135E-03",
        " 3.86806E+00 1.00000E+001UY 1.00000E-01wordVRAI 8.00000E+00",
    ]
    # rounding of a solve: eps times the condition of the matrix, some hundreds, times the largest
    rounding = 2.2e-16 * 1e3
    assert (solved[24:], float(solved[:12])) == ("6", pytest.approx(0.0, abs=rounding * 2.74))
    assert float(solved[12:24]) == pytest.approx(0.0, abs=rounding * 2.74)
    assert float(difference) < rounding * 227.0


def test_classes_have_their_homes():
    for name, module in HOMES.items():
        assert class_name(getattr(importlib.import_module(module), name)) == f":{name}"
        for place in ("", "ssilang.kernel.gone", "ssilang.kernel.gone.below"):
            assert class_named(f"{place}:{name}").__module__ == module, place


def _crafted(path: Path, arrays: dict[int, int], format_of: Path) -> None:
    """An archive with the head of a sound one and arrays of so many zeros, highly packed."""
    with zipfile.ZipFile(format_of) as sound, zipfile.ZipFile(path, "w") as made:
        for name in sound.namelist():
            if not name.startswith("arrays/"):
                made.writestr(name, sound.read(name))
        for number, size in arrays.items():
            made.writestr(f"arrays/{number}.npy", bytes(size), zipfile.ZIP_DEFLATED)


def test_an_archive_that_unpacks_past_any_use_is_refused_unread(tmp_path):
    sound, crafted = tmp_path / "sound", tmp_path / "crafted"
    saved(sound, X=1.0)
    _crafted(crafted, dict.fromkeys(range(4), 80 * 2**20), sound)
    assert crafted.stat().st_size < 2**20
    with refusal(InputError, "io.archive-too-large"):
        read_archive(crafted)
    (tmp_path / "deck.ssi").write_text("OPTI REST 'crafted' ;\nREST ;\n")
    result = run_file(tmp_path / "deck.ssi")
    assert result.exit_code == 1
    assert "crafted unpacks to more than 268 MB" in result.message
    assert "deck.ssi:2:1" in result.message


def test_an_array_that_is_asked_for_again_and_again_counts_each_time(tmp_path, monkeypatch):
    sound, crafted = tmp_path / "sound", tmp_path / "crafted"
    saved(sound, X=np.zeros(3))
    monkeypatch.setattr(container, "_SMALL", 2**22)
    _crafted(crafted, {0: 3 * 2**20}, sound)
    archive = read_archive(crafted)
    with refusal(InputError, "io.no-file-sauv-ssilang"):
        archive.array(0)
    with refusal(InputError, "io.archive-too-large"):
        archive.array(0)
    archive.close()


def test_a_large_field_of_zeros_comes_back(tmp_path):
    path = tmp_path / "zeros"
    saved(path, X=np.zeros(2**22))  # 32 MB in some 33 kB
    assert path.stat().st_size < 2**22 * 8 / 200
    archive = read_archive(path)
    assert archive.array(0).shape == (2**22,)
    archive.close()


@together("number", [-1, -4, 10**6])
def test_a_reference_to_no_object_is_damage(tmp_path, number):
    """Python would count what is below 0 from the last object."""
    saved(tmp_path / "sound", X=square(), Y=NodeTable())
    archive = read_archive(tmp_path / "sound")
    assert len(archive.objects) >= 4
    with refusal(InputError, "io.damaged"):
        Decoder(archive, NodeTable()).decode(["o", number])
    archive.close()


def test_an_array_of_objects_is_as_large_as_its_items(tmp_path):
    """A shape that a file declares takes no memory of its own."""
    saved(tmp_path / "sound", X=1.0)
    archive = read_archive(tmp_path / "sound")
    decoder = Decoder(archive, NodeTable())
    assert decoder.decode(["ao", [2, 1], [1.0, None]]).tolist() == [[1.0], [None]]
    before = peak_memory()
    with refusal(InputError, "io.damaged"):
        decoder.decode(["ao", [3 * 10**8], []])
    assert peak_memory() < before + 1e8
    archive.close()


def test_objects_that_unpack_to_many_more_than_the_file_has_are_refused(tmp_path):
    saved(tmp_path / "sound", X=1.0)
    path = tmp_path / "crafted"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("objects.json", '{"objects": [' + "[]," * 2**24 + "0]}")
    before = peak_memory()
    with refusal(InputError, "io.archive-too-large"):
        read_archive(path)
    assert peak_memory() < before + 1e8
