"""Abaqus and Nastran decks, read back by meshio and by hand."""

from pathlib import Path

import meshio
import numpy as np
import pytest
from meshio._mesh import topological_dimension
from script_runs import ran
from together import together

from ssilang.cli.run import run_text
from ssilang.io.errors import OutputError
from ssilang.io.mesh_files.decks import abaqus_lines, nastran_lines

VOLUMES = {
    kind: f"OPTI DIME 3 ELEM {kind} ; S = (DROI 2 (0. 0. 0.) (2. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
    + volume
    for kind, volume in (
        ("CUB8", "V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("CU20", "V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("PRI6", "OPTI ELEM TRI3 ; S = SURF (CONT S) ; V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("PR15", "OPTI ELEM TRI6 ; S = SURF (CONT S) ; V = S VOLU 1 'TRAN' (0. 0. 3.) ;"),
        ("TET4", "OPTI ELEM CUB8 ; V = CHAN 'TET4' (S VOLU 1 'TRAN' (0. 0. 3.)) ;"),
        ("TE10", "OPTI ELEM CUB8 ; V = CHAN 'TE10' (CHAN 'TET4' (S VOLU 1 'TRAN' (0. 0. 3.))) ;"),
    )
}


def middles_off_their_places(points, rows, edges):
    """Largest distance of a middle node from the middle of its two corners."""
    found = [points[rows[:, m]] - points[rows[:, [a, b]]].mean(axis=1) for m, a, b in edges]
    return max(np.abs(f).max() for f in found)


BOTTOM, TOP = [(0, 1), (1, 2), (2, 3), (3, 0)], [(4, 5), (5, 6), (6, 7), (7, 4)]
BOX = [*BOTTOM, *TOP, (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
TETRA = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
EDGES = {
    "hexahedron20": [(8 + i, *e) for i, e in enumerate(BOX)],
    "wedge15": [(6 + i, *e) for i, e in enumerate(WEDGE)],
    "tetra10": [(4 + i, *e) for i, e in enumerate(TETRA)],
}
"""Middles in meshio's order, that of VTK: bottom, top, between."""


def volume(points, kind, rows):
    corners = points[rows[:, {"h": [0, 1, 3, 4], "w": [0, 1, 2, 3], "t": [0, 1, 2, 3]}[kind[0]]]]
    sides = corners[:, 1:] - corners[:, :1]
    part = {"h": 1.0, "w": 2.0, "t": 6.0}[kind[0]]
    return np.linalg.det(sides).sum() / part


@together("kind", VOLUMES)
@together("word, suffix", [("ABAQ", ".inp"), ("NAS", ".bdf")])
def test_meshio_reads_the_same_volumes(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, kind: str, word: str, suffix: str
) -> None:
    monkeypatch.setitem(topological_dimension, "wedge15", 3)  # meshio 5.3 has forgotten it
    text = VOLUMES[kind] + f"OPTI SORT 'box' ; SORT '{word}' V ; N = NBEL V ; P = NBNO V ;"
    result = ran(text, tmp_path)
    read = meshio.read(tmp_path / f"box{suffix}", "abaqus" if word == "ABAQ" else "nastran")
    assert len(read.points) == result.session.root.find("P")
    assert sum(len(b.data) for b in read.cells) == result.session.root.find("N")
    assert sum(volume(read.points, b.type, b.data) for b in read.cells) == pytest.approx(6.0)
    for block in read.cells:
        if block.type in EDGES:
            off = middles_off_their_places(read.points, block.data, EDGES[block.type])
            assert off < 1e-12
    assert {b.type for b in read.cells} <= {"hexahedron", "wedge", "tetra", *EDGES}


@together("mode, name", [("PLAN CONT", "CPS8"), ("PLAN DEFO", "CPE8"), ("AXIS", "CAX8")])
def test_surfaces_are_what_the_mode_says(tmp_path: Path, mode: str, name: str) -> None:
    text = f"OPTI DIME 2 MODE {mode} ELEM QUA8 SORT 'plate' ; "
    text += "S = (DROI 1 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; T = MANU 'TRI6' (3. 0.) (4. 0.) (5. 0.) "
    text += "(4. 1.) (3. 2.) (3. 1.) ; SORT 'ABAQ' (S ET T) ;"
    assert run_text(text, tmp_path).exit_code == 0
    lines = (tmp_path / "plate.inp").read_text().splitlines()
    at = lines.index(f"*ELEMENT, TYPE={name}, ELSET=E1")
    nodes = {f[0]: np.array(f[1:], float) for f in (line.split(",") for line in lines[2:at])}
    firsts = [lines[i + 1].split(",")[0] for i, s in enumerate(lines) if s.startswith("*ELEMENT")]
    assert firsts == ["1", "2"]
    corners = [nodes[n.strip()] for n in lines[at + 1].split(",")[1:5]]
    middles = [nodes[n.strip()] for n in lines[at + 1].split(",")[5:9]]
    for i in range(4):
        np.testing.assert_allclose(middles[i], (corners[i] + corners[(i + 1) % 4]) / 2)


def test_cells_without_an_entry_are_refused(tmp_path: Path) -> None:
    text = "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; S = VIDE 'MAILLAGE' ;"
    result = run_text(text, tmp_path)
    line, empty = (result.session.root.find(n) for n in "LS")
    with pytest.raises(OutputError, match="no SEG2"):
        abaqus_lines(line, "CPE")
    with pytest.raises(OutputError, match="no mesh without cells"):
        nastran_lines(empty)


@together("word, near", [("FER", ""), ("NSA", "did you mean 'NAS'?")])
def test_formats_that_are_not_written_are_named(tmp_path: Path, word: str, near: str) -> None:
    result = run_text(
        f"OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; SORT '{word}' L ;", tmp_path
    )
    assert f"'{word}' is no format of meshes that SORT writes" in result.message
    assert near in result.message
    assert "NAS ABAQ" in result.message
