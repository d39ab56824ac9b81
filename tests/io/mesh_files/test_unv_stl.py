"""Universal files written by hand; STL read by meshio and back."""

import struct

import meshio
import numpy as np
import pytest
from together import together

from ssilang.io.errors import InputError, OutputError
from ssilang.io.mesh_files.file_mesh import FileMesh
from ssilang.io.mesh_files.unv_stl import read_stl, read_unv, stl_lines
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

UNV = """    -1
   164
         1  SI: Meters
    -1
    -1
  2411
        11         1         1        11
   0.0D+00   0.0D+00   0.0D+00
        12         1         1        11
   1.0D+00   0.0D+00   0.0D+00
        13         1         1        11
   1.0D+00   1.0D+00   0.0D+00
        14         1         1        11
   0.0D+00   1.0D+00   0.0D+00
    -1
    -1
  2412
         5        11         1         1         7         2
         0         1         1
        11        12
         7        44         1         1         7         4
        11        12        13        14
         9       136         1         1         7         1
        13
    -1
    -1
  2467
         1         0         0         0         0         0         0         2
base side
         8         5         0         0         7        13         0         0
         2         0         0         0         0         0         0         1
face
         8         7         0         0
    -1
"""


def test_nodes_cells_and_groups(tmp_path):
    path = tmp_path / "m.unv"
    path.write_text(UNV)
    read = read_unv(path)
    assert np.array_equal(read.points[2], [1.0, 1.0, 0.0])
    assert np.array_equal(read.cells["QUA4"], [[0, 1, 2, 3]])
    assert np.array_equal(read.cells["SEG2"], [[0, 1]])
    assert held(read) == ({"SEG2": [0]}, [2])
    assert held(read, "face") == ({"QUA4": [0]}, [])
    assert read.left_out == {"136": 1}


def test_older_numbers_of_what_is_told_are_read_as_well(tmp_path):
    """An empty part in front, a cell more that is not read, a group of what is not there."""
    text = "    -1\n    -1\n" + UNV.replace("D+00", "d+00")
    for new, old in (("2411", "781"), ("2412", "780"), ("2467", "2435")):
        text = text.replace(f"\n  {new}\n", f"\n  {old}\n")
    one = "         9       136         1         1         7         1\n        13\n"
    text = text.replace(one, one + one.replace("9", "8").replace("13\n", "14\n"))
    text = text.replace(
        "0         1\nface\n", "0         3\nface\n         7        98 0 0 8 99 0 0\n"
    )
    (tmp_path / "m.unv").write_text(text)
    read = read_unv(tmp_path / "m.unv")
    assert read.points.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert {k: rows.tolist() for k, rows in read.cells.items()} == {
        "SEG2": [[0, 1]], "QUA4": [[0, 1, 2, 3]]
    }  # fmt: skip
    assert (held(read), held(read, "face")) == (({"SEG2": [0]}, [2]), ({"QUA4": [0]}, []))
    assert read.left_out == {"136": 2}
    four = "7         4\n        11        12        13        14"
    (tmp_path / "m.unv").write_text(
        UNV.replace(four, "7         3\n        11        12        13")
    )
    with pytest.raises(InputError, match="7: QUA4, 3"):
        read_unv(tmp_path / "m.unv")


def held(read: FileMesh, name: str = "base side") -> tuple[dict[str, list[int]], list[int]]:
    part = read.parts[name]
    return {k: rows.tolist() for k, rows in part.cells.items()}, part.nodes.tolist()


@together("read, text, said", [
    (read_unv, "    -1\n   164\n    -1\n", "no nodes"),
    (read_stl, "solid a\nendsolid a\n", "no triangles"),
])  # fmt: skip
def test_a_file_that_holds_nothing_is_refused(read, text, said, tmp_path):
    (tmp_path / "m").write_text(text)
    with pytest.raises(InputError, match=said):
        read(tmp_path / "m")


def tetrahedron() -> Mesh:
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]))
    return Mesh.of(table, "TRI3", ids[[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]])


@pytest.mark.filterwarnings("ignore:overflow")  # of meshio itself
def test_meshio_reads_our_triangles(tmp_path):
    path = tmp_path / "t.stl"
    lines = stl_lines(tetrahedron())
    assert (lines[0], lines[-1]) == ("solid surface", "endsolid surface")
    path.write_text("\n".join(lines))
    read = meshio.read(path)
    corners = read.points[read.cells[0].data]
    volume = np.einsum("ni,ni->n", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert volume == pytest.approx(1.0 / 6.0)  # the normals point outwards
    assert np.array_equal(read_stl(path), tetrahedron().blocks[0].coordinates)
    normals = [[*map(float, x.split()[2:])] for x in lines if x.startswith("facet normal")]
    slanted = [1 / np.sqrt(3.0)] * 3
    np.testing.assert_allclose(normals, [[0, 0, -1], [0, -1, 0], slanted, [-1, 0, 0]], atol=1e-15)
    flat = NodeTable()
    ids = flat.add(np.array([(0.0, 0, 0), (1, 0, 0), (2, 0, 0)]))
    assert stl_lines(Mesh.of(flat, "TRI3", ids[None, :]))[1] == "facet normal 0.0 0.0 0.0"


def test_binary_triangles(tmp_path):
    corners = tetrahedron().blocks[0].coordinates
    raw = b"x" * 80 + struct.pack("<I", 4)
    for t in corners:
        raw += struct.pack("<12fH", 0, 0, 0, *t.ravel(), 0)
    path = tmp_path / "b.stl"
    path.write_bytes(raw)
    assert np.array_equal(read_stl(path), corners)


def test_other_cells_are_refused():
    table = NodeTable()
    ids = table.add(np.array([(0.0, 0), (1, 0)]))
    with pytest.raises(OutputError, match="SEG2"):
        stl_lines(Mesh.of(table, "SEG2", ids[None, :]))


def test_nodes_of_a_group_are_no_cells_of_the_same_label(tmp_path):
    path = tmp_path / "m.unv"
    text = UNV.replace("        13", "         7")  # a node of the label that the square has
    path.write_text(text)
    assert held(read_unv(path)) == ({"SEG2": [0]}, [2])
    path.write_text(text.replace("8         5", "8        99"))  # which is no cell
    assert held(read_unv(path)) == ({}, [2])


@together("size", [1e-3, 1.0, 1e3])
def test_normals_of_triangles_have_length_one(size):
    nodes = NodeTable()
    corners = size * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [2, 0, 0]])
    ids = nodes.add(corners)
    triangles = [[ids[0], ids[1], ids[2]], [ids[0], ids[3], ids[1]], [ids[0], ids[1], ids[4]]]
    lines = stl_lines(Mesh.of(nodes, "TRI3", np.array(triangles)))
    found = [[float(x) for x in li.split()[2:]] for li in lines if li.startswith("facet")]
    # the last one is flat: it has none
    np.testing.assert_allclose(found, [[0, 0, 1], [0, 1, 0], [0, 0, 0]], atol=1e-15)
