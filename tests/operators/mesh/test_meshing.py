"""Meshing as scripts write it: the forms of the operators, read against closed forms."""

import math
from typing import Any

import numpy as np
import pytest
from script_runs import failed, ran

from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import Mesh

PLANE = "OPTI DIME 2 ELEM QUA4 ; O = 0. 0. ; A = 1. 0. ; B = 1. 1. ; "
SPACE = "OPTI DIME 3 ELEM CUB8 ; O = 0. 0. 0. ; A = 1. 0. 0. ; Z = 0. 0. 1. ; "
STRIP = PLANE + "L = O D 4 A ; S = L TRAN 2 (0. 1.) ; "


def value(script: str, name: str = "X") -> Any:
    return ran(script).session.root.find(name)


def message(script: str) -> str:
    return failed(script).message


def xy(mesh: Mesh) -> np.ndarray:
    """Positions along a line."""
    return mesh.nodes.coordinates[line_chain(mesh), :2]


# ---- lines --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "phrase",
    ["DROI 4 O A", "O D 4 A", "O DROI A 4", "'DROIT' O A 4", "4 DROI O A"],
)
def test_line_reads_its_operands_in_any_order(phrase: str) -> None:
    assert xy(value(PLANE + f"X = {phrase} ;")) == pytest.approx(
        np.column_stack([np.linspace(0, 1, 5), np.zeros(5)])
    )


def test_lines_continue_one_another_and_close() -> None:
    line = value(PLANE + "X = O D 2 A D 3 B ; X = X D 4 ;")
    chain = line_chain(line)
    assert (line.n_cells, chain[0]) == (9, chain[-1])


def test_negative_number_grades_by_the_given_sizes() -> None:
    line = value(PLANE + "X = DROI -5 O A 'DINI' 0.1 'DFIN' 0.4 ;")
    sizes = np.diff(xy(line)[:, 0])
    assert len(sizes) == 5
    assert sizes[1:] / sizes[:-1] == pytest.approx(sizes[1] / sizes[0])
    assert sizes[0] < sizes[-1]


def test_density_of_the_ends_decides_without_a_number() -> None:
    assert value(PLANE + "DENS 0.2 ; P = 0. 0. ; Q = 1. 0. ; X = P D Q ;").n_cells == 5
    said = message(PLANE + "X = O D A ;")
    assert "mesh sizes must be positive" in said


def test_line_without_element_type_is_explained() -> None:
    assert "OPTI ELEM" in message("OPTI DIME 2 ; X = (0. 0.) D 2 (1. 0.) ;")


@pytest.mark.parametrize(
    "phrase",
    [
        "C 8 A O (0. 1.)",
        "CERC 8 'CENTR' A O (0. 1.)",
        "CERC 8 'PASS' A (0.6 0.8) (0. 1.)",
        "CERC 'ROTA' 8 90. A O",
        "CERC 8 'ROTA' 90 A O",
        "CER3 8 A (0.8 0.6) (0. 1.)",
        "LIGN 'ROTA' 8 O A 90.",
    ],
)
def test_arcs_lie_on_the_unit_circle(phrase: str) -> None:
    at = xy(value(PLANE + f"X = {phrase} ;"))
    assert np.linalg.norm(at, axis=1) == pytest.approx(1.0)
    turn = np.degrees(np.unwrap(np.arctan2(at[:, 1], at[:, 0])))
    assert turn == pytest.approx(np.linspace(0, 90, 9), abs=1e-9)


def test_whole_turn_closes_on_its_first_point() -> None:
    line = value(PLANE + "X = CERC 12 'ROTA' 360. A O 'ELIM' ;")
    chain = line_chain(line)
    assert chain[0] == chain[-1]
    assert len(line.node_ids) == 12


def test_half_circle_by_its_centre_is_refused() -> None:
    assert "in line" in message(PLANE + "X = CERC 8 A O (-1. 0.) ;")


def test_polynomial_curve_uses_existing_ends() -> None:
    script = PLANE + "Q = 1. 1. ; X = COUR 4 (0. 0.) (1. 0.) (0. 1.) 'PINI' O 'PFIN' Q 'REGU' ; "
    line = value(script)
    at = xy(line)
    assert at[:, 1] == pytest.approx(at[:, 0] ** 2)
    assert line_chain(line)[-1] == value(script, "Q").node


def test_broken_line_from_lists_points_and_meshes() -> None:
    lists = value("OPTI DIME 2 ; X = QUEL SEG2 (PROG 0. 1. 2.) (PROG 0. 1. 0.) ;")
    points = value("OPTI DIME 2 ; X = QUEL SEG2 (0. 0.) (1. 1.) (2. 0.) ;")
    mesh = value("OPTI DIME 2 ; M = (0. 0.) ET (1. 1.) ET (2. 0.) ; X = QUEL SEG2 M ;")
    for line in (lists, points, mesh):
        assert xy(line) == pytest.approx(np.array([[0, 0], [1, 1], [2, 0]]))
    assert value("OPTI DIME 2 ; X = QUEL SEG3 (0. 0.) (1. 1.) (2. 0.) ;").n_cells == 1


# ---- surfaces and volumes -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("phrase", "area"),
    [
        ("L TRAN 2 (0. 1.)", 1.0),
        ("TRAN 2 L (0. 1.)", 1.0),
        ("L REGL 2 (DROI 4 (0. 1.) (3. 1.))", 2.0),
        ("L GENE (QUEL SEG2 O (0. 1.) (1. 2.))", 2.0),
        ("DALL L (A D 3 B) (B D 4 (0. 1.)) ((0. 1.) D 3 O) PLAN", 1.0),
        ("SURF (L ET (A D 3 B D 4 (0. 1.) D 3 O)) PLAN", 1.0),
    ],
)
def test_surfaces_have_their_area(phrase: str, area: float) -> None:
    if phrase.startswith("DALL"):
        phrase = phrase.replace("(0. 1.)", "E")
    if phrase.startswith("SURF"):
        phrase = phrase.replace("(0. 1.)", "E")
    script = PLANE + f"E = 0. 1. ; L = O D 4 A ; S = {phrase} ; X = MESU S ;"
    assert value(script) == pytest.approx(area)


def test_turned_line_gives_a_ring() -> None:
    x = value(PLANE + "S = (A D 2 (2. 0.)) ROTA 40 90. O ; X = MESU S ;")
    assert x == pytest.approx(3 * 40 / 4 * 2 * math.sin(math.pi / 80) / 2 * 2, rel=1e-3)


def test_sides_and_growth_of_a_swept_surface() -> None:
    script = STRIP + "T = S TRAN 3 (0. 2.) ; X Y Z W = COTE T ; X1 = MESU T ; N = NBEL Y ; "
    assert value(script, "X1") == pytest.approx(3.0)
    assert value(script, "N") == 5
    assert value(script + "V = (COTE 3 S) POIN 'INIT' ; X = COOR 1 V ;") == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("phrase", "cells"),
    [
        ("S VOLU 3 'TRAN' Z", 24),
        ("VOLU 3 S 'TRAN' Z", 24),
        ("S VOLU 'TRAN' 3 Z", 24),
        ("S 'VOLUME' 'TRANSLATION' Z 3", 24),
        ("S VOLU 3 (S PLUS Z)", 24),
        ("S VOLU 'PROG' (PROG 0. 0.2 1.) 'TRAN' Z", 16),
        ("S VOLU 'GENE' (DROI 5 O Z)", 40),
        ("(S VOLU 2 'TRAN' (0. 0. 0.5)) VOLU 1 'TRAN' (0. 0. 0.5)", 24),
        ("VOLU (ENVE (S VOLU 2 'TRAN' Z))", None),
        ("(S PLUS (0. 0. 0.5)) VOLU 1. Z", 8),
    ],
)
def test_volumes_have_their_volume(phrase: str, cells: int | None) -> None:
    volume = value(SPACE + f"L = O D 4 A ; S = L TRAN 2 (0. 1. 0.) ; X = {phrase} ; V = MESU X ;")
    if cells is not None:
        assert volume.n_cells == cells
    script = SPACE + f"L = O D 4 A ; S = L TRAN 2 (0. 1. 0.) ; V = {phrase} ; X = MESU V ;"
    assert value(script) == pytest.approx(1.0)


def test_volume_turned_about_an_axis() -> None:
    script = SPACE + "S = (A D 2 (2. 0. 0.)) TRAN 3 Z ; V = S VOLU 60 'ROTA' 90. O Z ; "
    assert value(script + "X = MESU V ;") == pytest.approx(math.pi * 3 / 4, rel=1e-3)
    assert value(script + "X = NBEL (FACE 3 V) ;") == 10 * 60


# ---- copies and moves ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phrase", "place"),
    [
        ("P PLUS (1. 2.)", (3, 3)),
        ("P MOIN (1. 2.)", (1, -1)),
        ("P TOUR 90. O", (-1, 2)),
        ("P SYME 'POINT' A", (0, -1)),
        ("P SYME 'DROIT' O B", (1, 2)),
        ("P HOMO 3. O", (6, 3)),
        ("P AFFI 3. O A", (6, 1)),
        ("P PROJ (0. 1.) 'DROI' O B", (2, 2)),
        ("P PROJ 'CONI' O 'CERC' O A", (2 / math.sqrt(5), 1 / math.sqrt(5))),
        ("P + (2. * A) - B", (3, 0)),
        ("P / 2.", (1, 0.5)),
    ],
)
def test_points_are_copied_and_moved(phrase: str, place: tuple[float, float]) -> None:
    script = PLANE + f"P = 2. 1. ; X = {phrase} ;"
    if "+" in phrase:  # phrases run from left to right
        script = PLANE + "P = 2. 1. ; X = P + (2. * A) - B ;"
    assert value(script).coordinates[:2] == pytest.approx(place)


@pytest.mark.parametrize(
    ("motion", "place"),
    [
        ("'PLUS' (1. 2.)", (3, 3)),
        ("'TOUR' 90. O", (-1, 2)),
        ("'HOMO' 3. O", (6, 3)),
        ("'SYME' 'DROI' O A", (2, -1)),
        ("'COOR' 'CYLI' O A", (math.sqrt(5), math.degrees(math.atan2(1, 2)))),
        ("'DEDU' (O ET A ET (0. 1.)) (A ET B ET O)", (3 - 2, 2 - 0)),
    ],
)
def test_points_move_in_place(motion: str, place: tuple[float, float]) -> None:
    script = PLANE + f"X = 2. 1. ; M = X ET O ; DEPL X {motion} ;"
    if "DEDU" in motion:  # (x, y) -> O' + x (A' - O') + y (E' - O') with O' = A, A' = B, E' = O
        place = (1 - 1, 0 + 2)
    assert value(script).coordinates[:2] == pytest.approx(place, abs=1e-12)


def test_objects_that_share_nodes_still_do_when_copied_together() -> None:
    script = STRIP + "L2 S2 = L S PLUS (0. 5.) ; X = NBNO (L2 ET S2) ;"
    assert value(script) == 15


def test_displacements_lead_from_one_mesh_to_another() -> None:
    script = STRIP + "T = S TOUR 30. O ; U = T MOIN S ; V = S PLUS U ; ELIM 1E-9 (V ET T) ;"
    assert value(script + "X = NBNO (V ET T) ;") == 15


# ---- picking ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phrase", "count"),
    [
        ("S POIN 'DROI' O A 1E-3", 5),
        ("POIN S 'DROI' O A 1E-3", 5),
        ("S POIN 'SPHE' O A 1E-3", 2),
        ("(COOR 1 S) POIN 'SUPE' 0.6", 6),
        ("(COOR 1 S) POIN 'MAXI'", 3),
        ("(COOR 1 S) POIN 'COMP' 0.2 0.6", 6),
        ("S ELEM 'APPU' 'LARG' (S POIN 'DROI' O A 1E-3)", 10),
        ("CONT S", 12),
        ("CHAN 'POI1' S", 15),
        ("CHAN 'QUAD' S", 37),
        ("S ELEM 3", 4),
        ("S ELEM 'CONT' (0.1 0.1)", 4),
        ("(CONT S) ELEM 'COMP' O A", 5),
    ],
)
def test_parts_have_their_nodes(phrase: str, count: int) -> None:
    assert value(STRIP + f"X = NBNO ({phrase}) ;") == count


def test_default_distance_is_a_tenth_of_the_density() -> None:
    script = STRIP + "DENS 6. ; X = NBNO (S POIN 'DROI' O A) ;"
    assert value(script) == 10


def test_nearest_first_and_last_points() -> None:
    assert value(STRIP + "X = S POIN 'PROC' (0.4 0.6) ;").coordinates[:2] == pytest.approx(
        [0.5, 0.5]
    )
    assert value(STRIP + "X = L POIN 'FINA' ;").coordinates[:2] == pytest.approx([1, 0])
    assert value(STRIP + "X = L POIN 3 ;").coordinates[:2] == pytest.approx([0.5, 0])
    assert value(STRIP + "X = S POIN 3 2 ;").coordinates[:2] == pytest.approx([0.5, 0.5])


def test_no_cell_on_the_points_is_an_error_unless_allowed() -> None:
    assert "rests on" in message(STRIP + "X = S ELEM 'APPU' 'STRI' A ;")
    assert value(STRIP + "X = NBEL (S ELEM 'APPU' 'STRI' A 'NOVE') ;") == 0


def test_colours_select_cells() -> None:
    script = STRIP + "T = (S COUL ROUG) ET (L COUL 2) ; "
    assert value(script + "X = NBEL (T ELEM ROUG) ;") == 8
    assert value(script + "X = NBEL (T ELEM BLEU SEG2) ;") == 4
    assert value(script + "X = T ELEM 'TYPE' ;").values == ["QUA4", "SEG2"]


def test_sets_of_meshes() -> None:
    script = STRIP + "T = S ELEM (LECT 1 PAS 1 3) ; "
    assert value(script + "X = NBEL (S DIFF T) ;") == 5
    assert value(script + "X = NBEL (S INTE T) ;") == 3
    assert value(script + "X = NBEL (UNIQ (T ET (INVE T))) ;") == 3
    assert "in common" in message(script + "X = T INTE L ;")


def test_merging_is_seen_by_all_objects() -> None:
    script = PLANE + "L = O D 2 A ; P = 1. 1E-6 ; M = P D 2 B ; ELIM L M 1E-3 ; "
    assert value(script + "X = NBNO (L ET M) ;") == 5
    assert value(script + "X = (NOEU P) EGA (NOEU A) ;") is True


def test_measures() -> None:
    assert value(STRIP + "X = MESU (CONT S) ;") == pytest.approx(4.0)
    assert value(STRIP + "X = MESU (CONT S) 'SURF' ;") == pytest.approx(1.0)
    assert value(STRIP + "X = MAXI (MESU S 'DENS') ;") == pytest.approx(5 / 12)
    assert value(STRIP + "X = MAXI (COOR L 'CURV') ;") == pytest.approx(1.0)
    assert value(STRIP + "X = BARY S ;").coordinates[:2] == pytest.approx([0.5, 0.5])


def test_vectors() -> None:
    assert value(PLANE + "X = (3. 4.) PSCA (1. 2.) ;") == pytest.approx(11.0)
    assert value(PLANE + "X = NORM (3. 4.) ;") == pytest.approx(5.0)
    assert value(PLANE + "X = PVEC (3. 4.) ;").coordinates[:2] == pytest.approx([-4, 3])
    cross = value(SPACE + "X = (1. 0. 0.) PVEC (0. 1. 0.) ;")
    assert cross.coordinates == pytest.approx([0, 0, 1])
    assert value(PLANE + "X = PMIX (3. 4.) (1. 2.) ;") == pytest.approx(2.0)


def test_joint_line_between_two_blocks() -> None:
    script = STRIP + "M = L PLUS (0. 0.) ; X = RACC 1E-6 L M ;"
    assert value(script).single_block().cell_type == "RAC2"
    assert "LIAI" in message(STRIP + "X = RACC 1E-6 S S ;")


def test_moved_vectors_and_tensors_turn() -> None:
    script = STRIP + "F = MANU 'CHPO' S 2 'FX' 1. 'FY' 0. ; G = F TOUR 90. O ; "
    assert value(script + "X = MAXI (EXCO 'FY' G) ;") == pytest.approx(1.0)
    assert value(script + "X = MAXI 'ABS' (EXCO 'FX' G) ;") == pytest.approx(0.0, abs=1e-12)
