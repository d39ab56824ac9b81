"""COUP FUIT VSUR and sets of polygons."""

import numpy as np
import pytest

BALL = (
    "OPTI DIME 3 ELEM CUB8 ; S = (DROI 4 (0. 0. 0.) (1. 0. 0.)) TRAN 4 (0. 1. 0.) ; "
    "V = S VOLU 4 'TRAN' (0. 0. 1.) ; "
)


def test_a_plane_cuts_a_hexagon_out_of_a_cube(found) -> None:
    """The plane x + y + z = 3/2 cuts the unit cube in a regular hexagon of side 1/sqrt 2."""
    area, kinds, off = found(
        BALL + "C = COUP V (1.5 0. 0.) (0. 1.5 0.) (0. 0. 1.5) ; A = MESU C ; K = ELEM C 'TYPE' ; "
        "X Y Z = COOR C ; D = MAXI (ABS (X + Y + Z - 1.5)) ;",
        "A", "K", "D",
    )  # fmt: skip
    assert area == pytest.approx(3 * np.sqrt(3) / 4)
    assert kinds.values == ["TRI3"]
    assert off < 1e-12


def test_a_plane_through_nodes_and_one_through_a_surface(found, refused) -> None:
    area, length = found(
        BALL + "P = COUP V (0. 0. 0.5) (1. 0. 0.5) (0. 1. 0.5) ; A = MESU P ; "
        "L = COUP S (0.3 0. 0.) (0.3 1. 0.) (0.3 0. 1.) ; B = MESU L ;",
        "A", "B",
    )  # fmt: skip
    assert (area, length) == (pytest.approx(1.0), pytest.approx(1.0))
    assert "no plane" in refused(BALL + "C = COUP V (0. 0. 0.) (1. 0. 0.) «(2. 0. 0.)» ;")


FRAME = (
    "OPTI DIME 2 ELEM SEG2 ; A = DROI 6 (0. 0.) (3. 0.) ; B = DROI 2 (3. 0.) (3. 1.) ; "
    "C = DROI 6 (3. 1.) (0. 1.) ; D = DROI 2 (0. 1.) (0. 0.) ; L = A ET B ET C ET D ; "
    "ELIM 1.E-6 L ; "
)


def test_one_part_holds_the_segment_and_the_other_its_inverse(found) -> None:
    segment, first, second = found(FRAME + "E F G = FUIT L (A POIN 3) C ;", "E", "F", "G")
    a, b = segment.single_block().connectivity[0]
    assert [a, b] in first.single_block().connectivity.tolist()
    assert [b, a] in second.single_block().connectivity.tolist()
    # the node stands at x = 1: anticlockwise, the segment going up has the left part behind it
    x = first.nodes.coordinates[first.sorted_node_ids]
    assert x[:, 0].max() == pytest.approx(1.0)


def test_an_open_line_is_cut_too(found) -> None:
    one, two = found(
        FRAME + "M = A ET B ET C ; E F G = FUIT M (A POIN 4) C ; N1 = NBEL F ; N2 = NBEL G ;",
        "N1", "N2",
    )  # fmt: skip
    assert (one, two) == (7, 9)


def test_neighbours_and_strangers_are_refused(refused) -> None:
    assert "neighbours" in refused(FRAME + "E F G = «FUIT» L (A POIN 3) (A POIN 4) ;")
    assert "no node" in refused(FRAME + "P = 9. 9. ; E F G = «FUIT» L P C ;")


def test_vectors_of_shells_and_beams(found) -> None:
    x, z, lone = found(
        "OPTI DIME 3 ELEM QUA4 ; S = (DROI 1 (0. 0. 0.) (2. 0. 0.)) TRAN 1 (0. 3. 3.) ; "
        "MS = MODE S MECANIQUE ELASTIQUE COQ4 ; V = VSUR MS 'NORM' ; J = VSUR MS ; "
        "OPTI ELEM SEG2 ; L = DROI 1 (0. 0. 0.) (4. 0. 0.) ; "
        "T = VSUR (MODE L MECANIQUE ELASTIQUE POUT) ; "
        "A = MINI (EXCO 'VZ' V) ; B = MAXI (EXCO 'VZ' J) ; C = MAXI (EXCO 'VX' T) ;",
        "A", "B", "C",
    )  # fmt: skip
    assert x == pytest.approx(np.sqrt(0.5))
    assert z == pytest.approx(2.0 * 3.0 / 4.0)  # the area over that of the reference square
    assert lone == pytest.approx(2.0)  # half the length


def test_polygons_are_picked_by_their_family_name(found) -> None:
    count, total = found(
        "OPTI DIME 2 ELEM POLY ; L = (0. 0.) DROI 8 (2. 0.) DROI 6 (2. 1.) DROI 8 (0. 1.) "
        "DROI 6 (0. 0.) ; ELIM 1.E-6 L ; S = SURF L 'PLANE' ; N = NBEL (ELEM S 'POLY') ; "
        "M = (NBEL S) - (NBEL (ELEM S 'TRI3')) ;",
        "N", "M",
    )  # fmt: skip
    assert count == total > 4
