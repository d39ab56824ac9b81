"""Complete quadratic cells; each part of a mesh of many kinds is changed as if it were alone."""

from collections import Counter
from functools import partial

import numpy as np
import pytest
from script_runs import ran
from together import together

from ssilang.kernel.mesh import boundary
from ssilang.kernel.mesh.changes.degree import complete, linear, quadratic
from ssilang.kernel.mesh.changes.split import split_quadrangles
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.orientation import (
    flip,
    orient,
    orient_towards,
    reversed_line,
    signed_volumes,
    surface_normals,
)

CORNERS = {
    "POI1": "000", "SEG2": "000 100", "TRI3": "000 100 010", "QUA4": "000 100 110 010",
    "TET4": "000 100 010 001", "PYR5": "000 100 110 010 001", "PRI6": "000 100 010 001 101 011",
    "CUB8": "000 100 110 010 001 101 111 011", "RAC2": "000 100 000 100",
    "LIA3": "000 100 010 000 100 010", "LIA4": "000 100 110 010 000 100 110 010",
}  # fmt: skip
LINES, FLAT, SOLID = ("SEG2", "SEG3"), ("TRI3", "QUA4", "TRI6", "QUA8"), ("TET4", "PYR5", "PRI6")
CURVED = ("SEG3", "TRI6", "QUA8", "TE10", "PY13", "PR15", "CU20")
DOWNWARDS, APEX = np.array([0.3, 0.5, -2.0]), np.array([1.0, -4.0, -30.0])
FULL = (*SOLID, "CUB8", *CURVED[3:])
JOINTS = ("RAC2", "LIA3", "LIA4")
ALL = {*CORNERS, *CURVED} - {"POI1", *JOINTS}


def parts_of(nodes: NodeTable) -> list[Mesh]:
    """Meshes of one kind each, far from each other; the second of three cells is turned over."""
    random, parts = np.random.default_rng(5), []
    for k, (kind, corners) in enumerate([*CORNERS.items(), *list(CORNERS.items())[1:8]]):
        x = np.array([list(map(float, at)) for at in corners.split()])
        x = x + 0.1 * random.uniform(-1, 1, (3, *x.shape)) * (x.shape[-1] == 3)
        x = x + 3.0 * np.arange(3)[:, None, None] + np.array([0.0, 20.0 * k, 0.0])
        x[..., 2] *= kind not in FLAT  # in the plane
        block = CellBlock.make(nodes, kind, nodes.add(x.reshape(-1, 3)).reshape(3, -1), [k, 0, 3])
        part = Mesh(nodes, (flip(block, np.array([False, True, False])),))
        parts.append(part if k < len(CORNERS) else quadratic(part))
    return parts


def cells_of(mesh: Mesh, sense: bool = True) -> Counter:
    """Each cell by its kind, colour and where its nodes are, in their order if `sense`."""
    order = list if sense else sorted
    return Counter(
        (block.cell_type, colour, tuple(map(tuple, order(np.round(x, 9).tolist()))))
        for block in mesh.blocks
        for colour, x in zip(block.colours.tolist(), block.coordinates, strict=True)
    )


def rows_of(mesh: Mesh) -> list:
    return [(block.cell_type, block.connectivity.tolist()) for block in mesh.blocks]


@pytest.mark.parametrize("backwards", [False, True])
@together(
    "change, meant",
    [(linear, CURVED), (quadratic, ALL - {*CURVED}), (complete, ALL - {"SEG3"}),
     (split_quadrangles, ("QUA4", "QUA8")), (partial(orient, space_dimension=1), LINES),
     (partial(orient, space_dimension=2), FLAT),
     (partial(orient, space_dimension=3), FULL),
     (partial(orient_towards, target=DOWNWARDS, is_point=False), (*FLAT, "CUB8")),
     (partial(orient_towards, target=APEX, is_point=True), (*FLAT, "CUB8")),
     (reversed_line, ALL),
     (boundary.contour, FLAT), (boundary.envelope, FULL), (boundary.lone_cells, FLAT),
     (boundary.edges, ALL), (boundary.faces, (*FLAT, *FULL))],
)  # fmt: skip
def test_each_part_is_changed_as_if_it_were_alone(change, meant, backwards) -> None:
    nodes = NodeTable()
    parts = parts_of(nodes)[:: -1 if backwards else 1]
    if change in (quadratic, complete):  # joints are refused
        parts = [part for part in parts if part.single_block().cell_type not in JOINTS]
    of_sides = change in vars(boundary).values()  # an edge has the sense of the first face met
    made = [change(part) for part in parts]
    whole = cells_of(change(union(*parts, as_given=True)), not of_sides)
    assert whole == sum((cells_of(one, not of_sides) for one in made), Counter())
    for part, one in zip(parts, made, strict=True):  # what is not meant stays, or has no sides
        rest = [] if of_sides else rows_of(part)
        assert (rows_of(one) == rest) == (part.single_block().cell_type not in meant)


def test_cells_are_turned_to_be_positive_and_by_turning_alone() -> None:
    parts = parts_of(NodeTable())
    mixed = union(*parts, as_given=True)
    ways = (lambda b: b.coordinates[:, -1, 0] - b.coordinates[:, 0, 0],
            lambda b: surface_normals(b)[:, 2], signed_volumes)  # fmt: skip
    for dimension, measure in enumerate(ways, 1):
        made = orient(mixed, dimension)
        sizes = [measure(b) for b in made.blocks if b.kind.dimension == dimension]
        assert len(sizes) >= 2
        assert all((size > 0).all() for size in sizes)
        assert cells_of(made, sense=False) == cells_of(mixed, sense=False)


CUBES = (
    "OPTI DIME 3 ELEM CUB8 ; L = DROI 2 (0. 0. 0.) (2. 0. 0.) ; "
    "S = L TRAN 1 (0. 1. 0.) ; V = S VOLU 'TRAN' 1 (0. 0. 1.) ; "
)


def found(script: str, *names: str) -> list[object]:
    result = ran(script)
    return [result.session.root.find(n) for n in names]


@together("kind, cells", [("TET4", 96), ("CUB8", 16)])
def test_bricks_are_taken_apart_on_all_their_nodes(kind: str, cells: int) -> None:
    script = CUBES + f"Q = CHAN V 'QUAF' ; M = CHAN Q '{kind}' ; N = NBNO Q ; K = NBNO M ;"
    n, k, volume, count = found(script + "X = MESU M ; C = NBEL M ;", "N", "K", "X", "C")
    assert n == k == 5 * 3 * 3  # all points of a grid of half the size: nothing is doubled
    assert volume == pytest.approx(2.0)
    assert count == cells


@together(
    "source, kind, target, cells, nodes",
    [
        ("TRI3", "TRI7", "TRI3", 24, 19),
        ("QUA4", "QUA9", "TRI3", 16, 15),
        ("QUA4", "QUA9", "QUA4", 8, 15),
    ],
)
def test_plane_cells(source: str, kind: str, target: str, cells: int, nodes: int) -> None:
    script = f"OPTI DIME 2 ELEM {source} ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
    script += f"Q = CHAN S 'QUAF' ; T = ELEM Q 'TYPE' ; M = CHAN '{target}' Q ; "
    kinds, n, area, count = found(
        script + "N = NBNO Q ; X = MESU M ; C = NBEL M ;", "T", "N", "X", "C"
    )
    assert [str(w).strip() for w in kinds.values] == [kind]
    assert (n, count) == (nodes, cells)
    assert area == pytest.approx(2.0)


def test_tetrahedra_and_prisms_keep_their_volume() -> None:
    script = (
        CUBES.replace("CUB8", "PRI6")
        .replace("S = L", "OPTI ELEM TRI3 ; S = L")
        .replace("V = S", "OPTI ELEM PRI6 ; V = S")
    )
    script += "A = CHAN 'TET4' (CHAN 'QUAF' V) ; B = CHAN 'TET4' (CHAN 'QUAF' (CHAN 'TET4' V)) ; "
    a, b, n, k = found(script + "X = MESU A ; Y = MESU B ; N = NBEL A ; K = NBEL B ;", *"XYNK")
    assert a == pytest.approx(2.0)
    assert b == pytest.approx(2.0)
    assert (n, k) == (4 * 36, 12 * 24)


@together(
    "source, target, cells",
    [
        ("TET4", "CUB8", 4 * 12),
        ("TET4", "PYR5", 12 * 12),
        ("PYR5", "PYR5", 16 * 48),
        ("PYR5", "TET4", 32 * 48),
        ("CUB8", "PYR5", 24 * 2),
    ],
)
def test_volumes_and_their_envelope_are_taken_apart_alike(
    source: str, target: str, cells: int
) -> None:
    script = CUBES
    if source == "TET4":
        script += "V = CHAN 'TET4' V ; "
    if source == "PYR5":
        script += "V = CHAN 'PYR5' (CHAN V 'QUAF') ; "
    script += (
        "Q = CHAN V 'QUAF' ; E = CHAN (ENVE V) 'QUAF' ; ELIM (Q ET E) 1.E-6 ; "
        f"M = CHAN Q '{target}' ; D = NBEL (DIFF (ENVE M) (CHAN E '{target}')) ; "
        "X = MESU M ; C = NBEL M ; Y = MESU (ENVE (ORIE M)) ; "
    )
    d, x, c, area, made = found(script, "D", "X", "C", "Y", "M")
    assert (d, c) == (0, cells)
    corners = made.single_block().coordinates[:, [0, 1, 2 if target == "TET4" else 3, -1]]
    if target != "CUB8":
        assert (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0.0).all()
    assert x == pytest.approx(2.0)
    assert area == pytest.approx(10.0)


@together("kind", ["CUB8", "PRI6", "TET4"])
def test_neighbours_are_one_part_and_hold_what_lies_in_them(kind: str) -> None:
    script = CUBES
    if kind == "TET4":
        script += "V = CHAN 'TET4' V ; "
    if kind == "PRI6":
        script = script.replace("S = L", "OPTI ELEM TRI3 ; S = L")
        script = script.replace("V = S", "OPTI ELEM PRI6 ; V = S")
    script += "Q = CHAN V 'QUAF' ; T = PART 'SEPA' Q 'FACE' 'NESC' ; N = DIME T ; "
    script += "I = ((0.1 0.1 0.1) ET (3. 0. 0.)) INCL Q 'VOLU' 'NOID' ; K = NBNO I ;"
    assert found(script, "N", "K") == [1, 1]


def test_middles_of_complete_quadrangles_are_those_of_their_sides() -> None:
    """A linear field obeys all relations."""
    script = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN CONT ; S = (DROI 1 (0. 0.) (3. 0.)) TRAN 1 (0. 2.) ; "
        "Q = CHAN S 'QUAF' ; R = RELA 'MILI' Q ; X Y = COOR Q ; "
        "F = R * ((NOMC 'UX' X) ET (NOMC 'UY' Y)) ; M = MAXI 'ABS' F ;"
    )
    (most,) = found(script, "M")
    assert most == pytest.approx(0.0, abs=1e-14)
