"""Complete quadratic cells: shared middles, and the cells that they are taken apart into."""

import numpy as np
import pytest
from script_runs import ran
from together import together

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
