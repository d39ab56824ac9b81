"""Small files made to take an hour or all memory: refused, and soon."""

import base64
import lzma
import struct
import time
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from together import together

from ssilang.io.errors import InputError
from ssilang.io.mesh_files import bounds
from ssilang.io.mesh_files.avs import read_avs
from ssilang.io.mesh_files.foreign import read_foreign
from ssilang.io.mesh_files.reading import Asked, read_mesh_file

SOON = 20.0  # s of the processor: each takes hours without its bound
MSH = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
NODES = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT,TYPE=CPS3,ELSET=S0\n1,1,2,3\n"
DOUBLED = "".join(f"*ELSET,ELSET=S{i + 1}\nS{i},S{i}\n" for i in range(60))


def soon(read: Callable[[], object]) -> str:
    """What a reader refuses, within the time."""
    begin = time.process_time()
    with pytest.raises(InputError) as refused:
        read()
    assert time.process_time() - begin < SOON
    return str(refused.value)


@together(
    "name, kind, text",
    [
        ("tags.msh", "GMSH", f"{MSH}$NodeData\n2000000000\n"),
        ("reals.msh", "GMSH", f"{MSH}$ElementData\n0\n2000000000\n"),
        ("heads.msh", "GMSH", "$MeshFormat\n2.2 0 8\n$Nodes\n1\n" * 60_000),
        ("end_first.bdf", "NASTRAN", "ENDDATA\nBEGIN BULK\n"),
        ("passed.mesh", "MEDIT", "MeshVersionFormatted 2\nDimension 3\nRidges\n2000000000\n"),
        ("many.inp", "ABAQUS", f"{NODES}*NSET,NSET=A,GENERATE\n" + "1,9999999,1\n" * 200),
        ("sums.inp", "ABAQUS", NODES + "".join(
            f"*ELSET,ELSET=T{i}\nS0,{','.join(f'T{k}' for k in range(i))}\n" for i in range(5)
        ) + "*ELSET,ELSET=LOOP\nLOOP\n"),
    ],
)  # fmt: skip
def test_counts_beyond_the_file_are_refused_soon(name, kind, text, tmp_path):
    (tmp_path / name).write_text(text)
    assert name in soon(lambda: read_mesh_file(tmp_path / name, kind, Asked()))


def test_sets_that_name_each_other_twice_hold_each_element_once(tmp_path):
    (tmp_path / "sets.inp").write_text(NODES + DOUBLED)
    begin = time.process_time()
    read = read_mesh_file(tmp_path / "sets.inp", "ABAQUS", Asked())
    assert time.process_time() - begin < SOON
    assert len(read.parts) == 61
    assert all(part.cells["TRI3"].tolist() == [0] for part in read.parts.values())


def test_generated_sets_are_those_that_are_written_out(tmp_path):
    (tmp_path / "a.inp").write_text(NODES + "*NSET,NSET=A,GENERATE\n1,3,2\n*NSET,NSET=B\nA,2\n")
    read = read_mesh_file(tmp_path / "a.inp", "ABAQUS", Asked())
    assert read.parts["A"].nodes.tolist() == [0, 2]
    assert read.parts["B"].nodes.tolist() == [0, 1, 2]


def test_decks_that_include_ever_more_are_refused_soon(tmp_path):
    for i in range(9):
        (tmp_path / f"b{i}.inp").write_text(f"*INCLUDE,INPUT=b{i + 1}.inp\n" * 9)
    (tmp_path / "b9.inp").write_text("*NODE\n1,0,0,0\n")
    read = lambda: read_mesh_file(  # noqa: E731
        tmp_path / "b0.inp", "ABAQUS", Asked(allowed=lambda name: Path(name))
    )
    assert "b0.inp" in soon(read)


def test_values_of_no_cells_have_no_parts_without_end(tmp_path):
    (tmp_path / "v.avs").write_text("2 0 0 1 0\n1 0 0 0\n2 1 0 0\n1 2000000000\nA, m\n")
    begin = time.process_time()
    read = read_avs(tmp_path / "v.avs")
    assert time.process_time() - begin < SOON
    assert read is not None
    assert not read.cell_values
    assert len(read.points) == 2


VTU = (
    '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="0.1" '
    'byte_order="LittleEndian" header_type="UInt32" compressor="{how}"><UnstructuredGrid>'
    '<Piece NumberOfPoints="3" NumberOfCells="1"><Points><DataArray type="Float64" '
    'NumberOfComponents="3" format="binary">{points}</DataArray></Points><Cells>'
    '<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>'
    '<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>'
    '<DataArray type="Int64" Name="types" format="ascii">5</DataArray></Cells></Piece>'
    "</UnstructuredGrid></VTKFile>"
)
PACK = {"vtkZLibDataCompressor": zlib.compress, "vtkLZMADataCompressor": lzma.compress}


def packed(how: str, content: bytes, blocks: int) -> str:
    """A file whose points are so many blocks of the same bytes."""
    block = PACK[how](content)
    head = struct.pack(f"<{3 + blocks}I", blocks, len(content), 0, *[len(block)] * blocks)
    text = base64.b64encode(head).decode() + base64.b64encode(block * blocks).decode()
    return VTU.format(how=how, points=text)


@together("how", PACK)
def test_a_vtu_that_unpacks_past_any_use_is_refused(how, tmp_path, monkeypatch):
    points = np.array([0.0, 0, 0, 1, 0, 0, 0, 1, 0])
    (tmp_path / "sound.vtu").write_text(packed(how, points.tobytes(), 1))
    sound = read_foreign(tmp_path / "sound.vtu", "VTU")
    assert sound.points.ravel().tolist() == points.tolist()
    monkeypatch.setattr(bounds, "most_unpacked", lambda path: 2**22)
    (tmp_path / "bomb.vtu").write_text(packed(how, bytes(2**20), 5))
    assert "unpacks to more than 4 MB" in soon(lambda: read_foreign(tmp_path / "bomb.vtu", "VTU"))


def test_a_med_that_unpacks_past_any_use_is_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "bomb.med", "w") as file:
        mesh = file.create_group("ENS_MAA/m")
        mesh.attrs["ESP"] = 3
        nodes = mesh.create_group("-1/NOE").create_dataset(
            "COO", (40_000_000,), "f8", chunks=(1_000_000,), compression="gzip"
        )
        nodes.attrs["NBR"] = 13_333_333
    assert "unpacks to more than 268 MB" in soon(lambda: read_foreign(tmp_path / "bomb.med", "MED"))


FOUR = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
MSH_TEXTS = {  # of each version, a square of four nodes that stand for NODES
    "2.2": f"{MSH}$Nodes\n4\n{FOUR}$EndNodes\n$Elements\n1\n1 3 2 1 1 NODES\n$EndElements\n",
    "4.0": "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n$Nodes\n1 4\n1 2 0 4\n"
    f"{FOUR}$EndNodes\n$Elements\n1 1\n1 2 3 1\n1 NODES\n$EndElements\n",
    "4.1": "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 3 1\n1 NODES\n"
    "$EndElements\n",
}


@together("version", MSH_TEXTS)
@together("nodes", ["-1 -2 3 4", "1 2 3 0", "1 2 3 5", "1 2 3 -1"])
def test_cells_of_gmsh_name_nodes_of_the_file(version, nodes, tmp_path):
    """Python would count what is below 1 from the last node."""
    path = tmp_path / "m.msh"
    path.write_text(MSH_TEXTS[version].replace("NODES", "1 2 3 4"))
    assert read_foreign(path, "GMSH").cells["QUA4"].tolist() == [[0, 1, 2, 3]]
    path.write_text(MSH_TEXTS[version].replace("NODES", nodes))
    with pytest.raises(InputError) as refused:
        read_foreign(path, "GMSH")
    assert refused.value.code == "io.mesh-file-names-no-node"
