"""Rarer meshing operators and forms as scripts write them: VERM FUIT VISA VORO, ends of lines."""

from typing import Any

import numpy as np
import pytest
from script_runs import found, ran
from together import together


def value(script: str, name: str = "X") -> Any:
    return ran(script).session.root.find(name)


FRAME = """OPTI DIME 2 ELEM SEG2 ; O = 0. 0. ; A = 4. 0. ; B = 4. 4. ; E = 0. 4. ;
C = O D 4 A D 4 B D 4 E D 4 O ; M = C POIN 'PROC' (2. 0.) ; """


def test_nothing_found_in_a_field_is_an_empty_mesh_and_a_doubt() -> None:
    field = FRAME + "U = COOR 1 C ; "
    for none in ("U POIN 'SUPE' 9.", "U POIN 'MAXI' 'SANS' (MOTS 'SCAL')"):
        assert value(field + f"V = {none} ; X = NBEL V ;") == 0
        assert value(field + f"V = {none} ; X = SOUC ;") is True
    assert value(field + "V = U POIN 'SUPE' 3. ; X = SOUC ;") is False


@together(
    "length, option, inwards",
    [("1.", "", True), ("-1.", "", False), ("1.", "'ORIE'", True), ("-1.", "'ORIE'", True)],
)
def test_skin_of_cells_in_the_direct_sense_faces_inwards(length, option, inwards) -> None:
    script = (
        "OPTI DIME 3 ELEM CUB8 ; S = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) ; "
        f"V = S VOLU 2 'TRAN' (0. 0. {length}) ; X = ENVE V {option} ; "
    )
    skin = value(script)
    faces = np.concatenate([b.coordinates for b in skin.blocks])
    middle = faces.mean(axis=(0, 1))
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    sides = (normals * (faces.mean(axis=1) - middle)).sum(axis=1)
    assert ((sides < 0) == inwards).all()


CUT_FRAME = (
    "OPTI DIME 2 ELEM SEG2 ; A = DROI 6 (0. 0.) (3. 0.) ; B = DROI 2 (3. 0.) (3. 1.) ; "
    "C = DROI 6 (3. 1.) (0. 1.) ; D = DROI 2 (0. 1.) (0. 0.) ; L = A ET B ET C ET D ; "
    "ELIM 1.E-6 L ; "
)


def test_one_part_holds_the_segment_and_the_other_its_inverse(found) -> None:
    segment, first, second = found(CUT_FRAME + "E F G = FUIT L (A POIN 3) C ;", "E", "F", "G")
    a, b = segment.single_block().connectivity[0]
    assert [a, b] in first.single_block().connectivity.tolist()
    assert [b, a] in second.single_block().connectivity.tolist()
    # the node stands at x = 1: anticlockwise, the segment going up has the left part behind it
    x = first.nodes.coordinates[first.sorted_node_ids]
    assert x[:, 0].max() == pytest.approx(1.0)


LINES = "OPTI DIME 2 ELEM SEG2 ; A = DROI 4 (0. 0.) (1. 0.) ; B = DROI 2 (1. 1.E-7) (0. 1.E-7) ; "


def test_double_nodes_of_one_mesh_with_the_density() -> None:
    result = ran("DENS 1.E-3 ; " + LINES + "M N = VISA (A ET B) ; K = NBNO M ;")
    m, n = (result.session.root.find(x).sorted_node_ids for x in "MN")
    assert len(m) == 3
    assert not set(m) & set(n)


def test_an_index_that_is_missing_is_told_by_its_type(refused):
    told = refused("OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; T = TABL ; T . P = 3 ; X = T . «Q» ;")
    assert "the table has no index POINT" in told
    assert "object at" not in told


CUBE = (
    "OPTI DIME 3 ELEM CUB8 ; S = (DROI 1 (0. 0. 0.) (1. 0. 0.)) TRAN 1 (0. 1. 0.) ; "
    "V = S VOLU 'TRAN' 1 (0. 0. 1.) ; F = FACE 2 V ; "
)


def names_after(script: str) -> tuple[dict[str, int], str]:
    result = ran(script)
    root = result.session.root
    names = [n for n in ("MESH1", "MESH2", "NODE1", "NODE4", "NODE5") if n in root.names()]
    return {n: getattr(root.find(n), "n_cells", 1) for n in names}, result.output


def test_sound_meshes_are_silent() -> None:
    found, output = names_after(CUBE + "VERM V ; VERM (CHAN V 'QUAF') ; VERM (CHAN 'TET4' V) ;")
    assert found == {}
    assert "VERM" not in output


@together(
    "statements, expected",
    [
        ("VERM (V ET (CHAN 'CUB8' V) ET S ET (INVE S)) ;", {"MESH1": 1}),
        ("VERM (V ET (CHAN 'QUAD' (F VOLU 'TRAN' 1 (0. 0. 1.)))) ;", {"NODE1": 1, "NODE4": 1}),
        ("VERM (V ET (CHAN 'TET4' (F VOLU 'TRAN' 1 (0. 0. 1.)))) ;", {"MESH1": 2}),
    ],
)
def test_defects_are_named(statements: str, expected: dict[str, int]) -> None:
    found, output = names_after(CUBE + statements)
    assert found == expected
    assert f"({' ... '.join(expected)})" in output


@together("phrase", ["M 'CORR'", "'CORR' M"])
def test_corrected_meshes_have_each_cell_once(phrase: str) -> None:
    script = CUBE + f"M = V ET S ET (INVE S) ; N = VERM {phrase} ; VERM N ;"
    result = ran(script)
    assert result.output.count("VERM") == 1
    assert result.session.root.find("N").n_cells == 2


PLACES = "A = 0.2 0.1 ; B = 3.1 0.7 ; C = 0.9 1.3 ; D = 2.4 -0.6 ; O = 1.45 1.3 ;"
# there, and back: nothing is symmetric
KINDS_OF_LINES = {
    "DROI": ("DROI {n} A B {sizes}", "DROI {n} B A {sizes}"),
    "CUBP": ("CUBP {n} A C D B {sizes}", "CUBP {n} B D C A {sizes}"),
    "CUBT": (
        "CUBT {n} A (1. 2.) (2. -1.) B {sizes}", "CUBT {n} B (-2. 1.) (-1. -2.) A {sizes}"
    ),
    "PARA": ("PARA {n} A C B {sizes}", "PARA {n} B C A {sizes}"),
    "CER3": ("CER3 {n} A C B {sizes}", "CER3 {n} B C A {sizes}"),
}  # fmt: skip


def places(line):
    """Coordinates of the nodes as the cells follow one another."""
    (block,) = line.blocks
    ends = block.coordinates[:, :, :2]
    assert (block.connectivity[1:, 0] == block.connectivity[:-1, 1]).all()
    return np.vstack([ends[:1, 0], ends[:, 1]])


@together("name", KINDS_OF_LINES)
@together(
    "n, sizes, turned",
    [("1", "", ""), ("7", "", ""), ("", "'DINI' 0.1 'DFIN' 0.4", "'DINI' 0.4 'DFIN' 0.1")],
)
def test_a_line_and_the_way_back(name, n, sizes, turned):
    there, back = KINDS_OF_LINES[name]
    there, back = there.format(n=n, sizes=sizes), back.format(n=n, sizes=turned)
    script = f"OPTI DIME 2 ELEM SEG2 ; {PLACES} L1 = {there} ; L2 = {back} ;"
    first, second, a, b = found(script, "L1", "L2", "A", "B")
    x = places(first)
    np.testing.assert_allclose(x[[0, -1]], [a.coordinates[:2], b.coordinates[:2]], atol=1e-12)
    np.testing.assert_allclose(x[::-1], places(second), atol=2e-6)
    lengths = np.linalg.norm(np.diff(x, axis=0), axis=1)
    if n:
        assert len(lengths) == int(n)
    else:
        assert lengths[0] < 0.6 * lengths[-1]


SQUARE = (
    "OPTI DIME 2 ELEM TRI3 ; A = 0. 0. ; B = 3. 0. ; C = 3. 2. ; D1 = 0. 2. ; "
    "L = (DROI 9 A B) ET (DROI 5 B C) ET (DROI 9 C D1) ET (DROI 5 D1 A) ; T = TABL ; "
)
BOX = (
    "OPTI DIME 3 ELEM TRI3 ; L = DROI 3 (0. 0. 0.) (2. 0. 0.) ; S = L TRAN 2 (0. 1. 0.) ; "
    "OPTI ELEM TET4 ; V = S VOLU 2 TRAN (0. 0. 1.) ; S = ENVE V ; OPTI ELEM TRI3 ; "
    "S = CHAN TRI3 S ; T = TABL ; "
)


def root_of(text: str):
    return ran(text).session.root


def test_a_hole_stays_empty():
    text = SQUARE + (
        "E = 1. 0.5 ; F = 2. 0.5 ; G = 2. 1.5 ; H = 1. 1.5 ; L2 = (DROI 3 E F) ET (DROI 3 F G) ET "
        "(DROI 3 G H) ET (DROI 3 H E) ; X = MESU (TRIA 'TOPO' (L ET L2)) ; "
        "Y = MESU (TRIA 'TOPO' 'NOAJ' (L ET L2)) ;"
    )
    root = root_of(text)
    assert (root.find("X"), root.find("Y")) == pytest.approx((5.0, 5.0))


@together("script, name, volume", [(SQUARE, "L", 6.0), (BOX, "S", 2.0)])
def test_the_table_gets_what_the_mesher_found(script, name, volume):
    root = root_of(
        script + f"M = TRIA 'TOPO' {name} T ; X = MESU M ; Q = INDI 'TOPO' M ; Y = MINI Q ; "
        "Z = MAXI Q ; N = NBEL (T . 'curtopo') ; NM = NBEL M ;"
    )
    table = root.find("T")
    assert root.find("X") == pytest.approx(volume)
    assert table.get("dvol") == pytest.approx(0.0, abs=1e-12)
    assert (table.get("nnul"), root.find("N")) == (0, root.find("NM"))
    assert (table.get("miq"), table.get("maq")) == pytest.approx((root.find("Y"), root.find("Z")))
    assert table.get("miq") <= table.get("moq") <= table.get("maq")
