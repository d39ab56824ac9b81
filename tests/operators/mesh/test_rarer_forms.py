"""Rarer meshing operators and forms, as scripts write them."""

import math
from typing import Any

import numpy as np
import pytest
from script_runs import failed, ran

PLANE = "OPTI DIME 2 ELEM QUA4 ; O = 0. 0. ; A = 1. 0. ; B = 1. 1. ; E = 0. 1. ; "
STRIP = PLANE + "L = O D 4 A ; S = L TRAN 2 (0. 1.) ; "
SPACE = "OPTI DIME 3 ELEM CUB8 ; O = 0. 0. 0. ; A = 1. 0. 0. ; Z = 0. 0. 1. ; "


def value(script: str, name: str = "X") -> Any:
    return ran(script).session.root.find(name)


def message(script: str) -> str:
    return failed(script).message


def test_words_may_stand_before_the_lines() -> None:
    sides = "(O D 3 A) (A D 2 B) (B D 3 E) (E D 2 O)"
    assert value(PLANE + f"X = NBEL (DALL 'PLAN' {sides}) ;") == 6
    assert value(PLANE + "X = NBEL (SURF 'PLAN' (O D 3 A D 2 B D 3 E D 2 O)) ;") == 6


def test_sides_of_unequal_cuts_are_filled_too() -> None:
    script = PLANE + "S = DALL (O D 3 A) (A D 2 B) (B D 5 E) (E D 2 O) 'PLAN' ; "
    assert value(script + "X = MESU S ;") == pytest.approx(1.0)
    assert value(script + "X = NBEL (CONT S) ;") == 12


def test_rectangle_of_matching_sides_gives_a_grid() -> None:
    script = PLANE + "S = SURF (O D 7 A D 4 B D 7 E D 4 O) 'PLAN' ; "
    assert value(script + "X = S ELEM 'TYPE' ;").values == ["QUA4"]
    assert value(script + "X = NBEL S ;") == 28


def test_sizes_of_a_field_are_followed() -> None:
    script = (
        "OPTI DIME 2 ELEM TRI3 ; O = 0. 0. ; L = O D 20 (1. 0.) D 20 (1. 1.) D 20 (0. 1.) D 20 O ; "
    )
    fine = value(script + "X = NBEL (SURF L 'PLAN') ;")
    coarse = value(script + "C = MANU 'CHPO' L 1 'SCAL' 0.2 ; X = NBEL (SURF C L 'PLAN') ;")
    assert coarse < 0.6 * fine


def test_rounded_corner() -> None:
    script = PLANE + "D1 E1 F1 = (O D 5 A) CONG 8 0.25 (A D 5 B) ; "
    arc = 16 * 0.25 * math.sin(math.pi / 32)
    assert value(script + "X = MESU E1 ;") == pytest.approx(arc)
    assert value(script + "X = NBNO (D1 ET E1 ET F1) ;") == 8 + 2 * 4 + 1
    assert "DOUBLE" in message(PLANE + "D1 E1 F1 = (O D 5 A) CONG 8 0.25 (A D 5 B) 'DOUBLE' ;")


def test_triangulations() -> None:
    closed = "L = O D 6 A D 6 B D 6 E D 6 O ; T = TRIA L ; "
    assert value(PLANE + closed + "X = MESU T ;") == pytest.approx(1.0)
    assert value(PLANE + closed + "X = (NBNO T) - (NBNO L) ;") == 0
    fine = PLANE + closed + "C = MANU 'CHPO' T 1 'SCAL' 0.08 ; R = RAFT C T ; "
    assert value(fine + "X = MESU R ;") == pytest.approx(1.0)
    assert value(fine + "X = NBEL R ;") > 8 * value(PLANE + closed + "X = NBEL T ;")
    assert value(PLANE + "X = MESU (TRIA (O ET A ET B ET E)) ;") == pytest.approx(1.0)


def test_points_are_inside_or_not() -> None:
    assert value(STRIP + "X = DEDA (0.3 0.4) (CONT S) ;") is True
    assert value(STRIP + "X = DEDA (1.3 0.4) (CONT S) ;") is False
    solid = SPACE + "V = ((O D 2 A) TRAN 2 (0. 1. 0.)) VOLU 2 'TRAN' Z ; E = CHAN TRI3 (ENVE V) ; "
    assert value(solid + "X = DEDA (0.3 0.4 0.5) E ;") is True
    assert value(solid + "X = DEDA (0.3 0.4 1.5) E ;") is False


def test_cells_inside_a_surface_or_a_line() -> None:
    inner = "T = (DROI 1 (0. 0.) (0.5 0.)) TRAN 1 (0. 1.) ; "
    assert value(STRIP + inner + "X = NBEL (INCL S T) ;") == 4
    assert value(STRIP + inner + "X = NBEL (S INCL (CONT T) 'STRI' 'NOID') ;") == 0
    assert "inside" in message(STRIP + inner + "X = INCL S (CONT T) 'STRI' ;")


def test_joints_of_touching_parts() -> None:
    script = STRIP + "T = S PLUS (0. 1.) ; J = GENJ (S ET T) 1E-6 ; "
    assert value(script + "X = NBEL J ;") == 4
    assert value(script + "X = J ELEM 'TYPE' ;").values == ["RAC2"]


def test_opened_surface() -> None:
    script = (
        STRIP + "T = L TRAN 2 (0. -1.) ; C = L ELEM 'COMP' O (L POIN 3) ; U V = DEDO (S ET T) C ; "
    )
    assert value(script + "X = (NBNO U) - (NBNO (S ET T)) ;") == 2
    assert value(script + "X = NBEL V ;") == 2


def test_block_of_six_faces() -> None:
    script = SPACE + (
        "L = O D 2 A ; M = O D 3 (0. 1. 0.) ; B = L TRAN 3 (0. 1. 0.) ; F = L TRAN 4 Z ;"
        " G = M TRAN 4 Z ; B2 = B PLUS Z ; F2 = F PLUS (0. 1. 0.) ; G2 = G PLUS A ;"
        " ELIM 1E-6 (B ET B2 ET F ET F2 ET G ET G2) ; V = PAVE F F2 B B2 G2 G ; "
    )
    assert value(script + "X = MESU V ;") == pytest.approx(1.0)
    assert value(script + "X = NBEL V ;") == 24
    assert "six faces" in message(script + "X = PAVE F F2 ;")


def test_frame_of_an_arc() -> None:
    script = PLANE + "C = CERC 30 'ROTA' 90. A O ; F = FREN C ; P = C POIN 'FINA' ; "
    assert value(script + "X = EXTR F 'TX' P ;") == pytest.approx(-1.0, abs=1e-12)
    assert value(script + "X = EXTR F 'NY' P ;") == pytest.approx(-1.0, abs=1e-12)


def test_cell_fields_tell_their_points() -> None:
    script = STRIP + "M = MODE S MECANIQUE ELASTIQUE ; U = MANU 'CHML' M 'SCAL' 1. ; "
    assert value(script + "X = MAXI (COOR 2 U) ;") == pytest.approx(1.0)
    gauss = script + "V = CHAN 'STRESSES' M U ; Y = COOR 2 V ; "
    highest = 1.0 - 0.5 * (0.5 - 0.5 / math.sqrt(3))
    assert value(gauss + "X = MAXI Y ;") == pytest.approx(highest)
    assert value(gauss + "X = NBNO (Y POIN 'MAXI') ;") == 8
    assert value(gauss + "X = NBEL (Y ELEM 'SUPE' 0.5) ;") == 4


def test_points_of_cells_come_in_the_order_of_the_cells() -> None:
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = TRAN 2 (DROI 3 (0. 0.) (3. 0.)) (0. 2.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; U = MANU 'CHML' M 'SCAL' 1. 'GRAVITE' ; "
        "P = U POIN 'SUPERIEUR' 0. ; X1 = CHAN 'GRAVITE' M (CHAN 'CHAM' (COOR 1 S) M 'NOEUD') ; "
        "X2 = MANU 'CHML' M 'REPA' 'SCAL' (EXTR (COOR 1 P) 'VALE') 'GRAVITE' ; "
    )
    assert value(script + "X = MAXI 'ABS' (X1 - X2) ;") == pytest.approx(0.0, abs=1e-12)


def test_models_and_fields_are_copied_together() -> None:
    script = STRIP + "M = MODE S MECANIQUE ELASTIQUE ; U = MANU 'CHML' M 'SMXX' 1. 'SMYY' 0. ; "
    script += "M2 U2 = M U TOUR 90. O ; "
    assert value(script + "X = MAXI (EXCO 'SMYY' U2) ;") == pytest.approx(1.0)
    assert value(script + "X = NBNO ((EXTR M2 'MAIL') ET (S TOUR 90. O)) ;") == 30


def test_transformation_between_meshes_carries_other_objects() -> None:
    script = STRIP + "T = S TOUR 30. O ; K = CONT S ; N = K DEDU 'TRAN' S T ; "
    assert value(script + "X = NBNO (N ET T) ;") == 15
    assert "does not belong" in message(script + "X = (DROI 1 (7. 7.) A) DEDU 'TRAN' S T ;")


def test_meshes_of_other_cells() -> None:
    assert value(STRIP + "X = NBEL (CHAN 'TRI3' S) ;") == 16
    assert value(STRIP + "X = NBEL (CHAN 'LIGN' S) ;") == 22
    assert value(STRIP + "X = NBEL (CHAN 'SEG2' (CHAN 'SEG3' L)) ;") == 8
    assert value(STRIP + "P = CHAN 'POI1' S ; X = MESU (CHAN 'TRI3' P (LECT 1 2 3)) ;") > 0
    assert "cannot be changed" in message(STRIP + "X = CHAN 'CUB8' S ;")


def test_cells_by_hand() -> None:
    assert value(PLANE + "X = MESU (MANU 'QUA4' O A B E) ;") == pytest.approx(1.0)
    assert value(PLANE + "X = (MANU 'TRI3' ROUG O A B) ELEM 'COUL' ;").values == ["ROUG"]
    assert "needs 3 points" in message(PLANE + "X = MANU 'TRI3' O A ;")


def test_stitched_lines_and_cones() -> None:
    assert value(PLANE + "X = MESU (COUT (O D 5 A) (E D 2 B)) ;") == pytest.approx(1.0)
    cone = SPACE + "S = (O D 2 A) TRAN 2 (0. 1. 0.) ; X = MESU (COUT S Z) ;"
    assert value(cone) == pytest.approx(1 / 3)


def test_curved_line_joined_to_a_point() -> None:
    """A quarter disc of six triangles whose mid nodes lie on the arc: parabolas, nearly exact."""
    fan = PLANE + "OPTI ELEM QUA8 ; T = COUT (CERC 6 (1. 0.) O (0. 1.)) O ; "
    assert value(fan + "X = MESU T ;") == pytest.approx(np.pi / 4, rel=1e-4)
    assert value(fan + "X = NBNO (T ELEM 'TRI6') ;") == 13 + 7 + 1


def test_moved_point_has_the_density_in_force() -> None:
    script = PLANE + "DENS 0.1 ; P = 0. 0. ; DENS 0.5 ; Q = P PLUS (2. 0.) ; "
    assert value(script + "X = COOR 3 Q ;") == 0.5
    assert value(script + "X = COOR 3 (P MOIN (2. 0.)) ;") == 0.5
    assert value(script + "X = COOR 3 P ;") == 0.1
    # sizes 0.5 at both ends, whatever P's was
    assert value(script + "X = NBEL (Q D (P MOIN (2. 0.))) ;") == 8


def test_line_put_in_order() -> None:
    script = PLANE + "L = (A D 2 O) ET (A D 2 B) ; M = ORDO L ; "
    assert value(script + "X = MAXI (COOR M 'CURV') ;") == pytest.approx(2.0)
    assert "opposite senses" in message(script + "X = VERS L ;")


def test_sets_of_models() -> None:
    script = STRIP + "T = S PLUS (3. 0.) ; A1 = MODE S MECANIQUE ELASTIQUE ; "
    script += "B1 = MODE T MECANIQUE ELASTIQUE ; C = A1 ET B1 ; "
    assert value(script + "X = NBEL (EXTR (C DIFF A1) 'MAIL') ;") == 8
    assert value(script + "X = COOR 1 (BARY (EXTR (C INTE B1) 'MAIL')) ;") == pytest.approx(3.5)
    assert "in common" in message(script + "X = A1 INTE B1 ;")


def test_merged_mesh_may_be_named_again() -> None:
    script = PLANE + "L = (O D 2 A) ET ((1. 0.) D 2 B) ; "
    assert value(script + "M = ELIM 1E-3 L ; X = NBNO M ;") == 5


def test_line_in_one_dimension() -> None:
    script = "OPTI DIME 1 ELEM SEG2 ; P = POIN 0. ; Q = POIN 2. ; L = P D 4 Q ; "
    assert value(script + "X = MESU L ;") == pytest.approx(2.0)
    assert value(script + "X = COOR (L POIN 'PROC' (POIN 0.9)) ;") == pytest.approx(1.0)


CROSSING = (
    "OPTI DIME 3 ELEM TRI3 ; A = (DROI 2 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. 2. 0.) COUL 'ROUG' ; "
    "B = (DROI 2 (-1. 1.1 -1.) (3. 1.1 -1.)) TRAN 2 (0. 0. 2.) ; "
)


def test_two_surfaces_are_cut_where_they_cross() -> None:
    script = CROSSING + "C D L M = INTE 'GEOM' A B ; X = "
    assert value(script + "MESU L ;") == pytest.approx(2.0)
    assert value(script + "MESU C ;") == pytest.approx(4.0)
    assert value(script + "NBNO (INTE (CHAN 'POI1' L) (CHAN 'POI1' C)) ;") == value(
        script + "NBNO M ;"
    )
    red = value(script + "C ;").blocks[0].colours
    assert len(set(red.tolist())) == 1
    assert red[0] != 0


def test_surfaces_that_do_not_cross_need_noverif() -> None:
    script = CROSSING + "B = B PLUS (0. 5. 0.) ; C D L M = INTE 'GEOM' A B "
    assert "do not cross" in message(script + "; ")
    assert value(script + "'NOVERIF' ; X = (NBEL C) + (NBEL L) ;") == 8
    square = script.replace("TRI3", "QUA4")
    assert "surfaces of TRI3 are needed" in message(square + "; ")


def test_colours_tell_the_types_of_cells(found):
    red, blue, white, total = found(
        "OPTI DIME 2 ELEM QUA4 ; L = DROI 3 (0. 0.) (1. 0.) ; S = L TRAN 2 (0. 1.) ; "
        "T = MANU 'TRI3' (3. 0.) (4. 0.) (3. 1.) ; P = MANU 'POI1' (5. 5.) ; "
        "A = AFCO (S ET L ET T ET P) ; R = NBEL (A ELEM ROUG) ; B = NBEL (A ELEM BLEU) ; "
        "W = NBEL (A ELEM BLAN) ; N = NBEL A ;",
        "R", "B", "W", "N",
    )  # fmt: skip
    assert (red, blue, white, total) == (6, 4, 1, 11)


FRAME = """OPTI DIME 2 ELEM SEG2 ; O = 0. 0. ; A = 4. 0. ; B = 4. 4. ; E = 0. 4. ;
C = O D 4 A D 4 B D 4 E D 4 O ; M = C POIN 'PROC' (2. 0.) ; """
INNER_LINES = {
    "hanging": ("H = D 3 M (2. 2.5) ;", 16.0, 3),
    "free": ("H = D 4 (1. 3.) (3. 3.3) ;", 16.0, 4),
    "across": ("H = D 5 (C POIN 'PROC' (0. 2.)) (C POIN 'PROC' (4. 2.)) ;", 16.0, 5),
    "hole and line": (
        "P = 1. 1. ; H = (P D 2 (1.5 1.) D 2 (1.5 1.5) D 2 (1. 1.5) D 2 P) ET "
        "(D 3 (3. 1.) (3. 3.)) ;",
        15.75,
        11,
    ),
    "loop on a stalk": (
        "P = 2. 1. ; H = (M D 2 P) ET (P D 2 (3. 1.) D 2 (2.5 2.) D 2 P) ;",
        15.5,
        8,
    ),
}


@pytest.mark.parametrize("kind", INNER_LINES)
def test_lines_inside_a_contour_are_sides_of_its_triangles(kind) -> None:
    made, area, sides = INNER_LINES[kind]
    text = FRAME + made + " T = TRIA (C ET H) ; "
    assert value(text + "X = MESU T ;") == pytest.approx(area)
    assert value(text + "X = NBEL (INTE (CHAN 'LIGN' T) H) ;") == sides
    assert value(text + "X = (NBNO T) - (NBNO (C ET H)) ;") == 0


def test_crossing_lines_and_empty_contours_are_refused() -> None:
    assert "cross" in message(FRAME + "H = D 1 (1. 1.) (3. 3.) ; G = D 1 (1. 3.) (3. 1.) ;"
                              "T = TRIA (C ET H ET G) ;")  # fmt: skip
    assert "enclose nothing" in message(FRAME + "T = TRIA ((D 2 O A) ET (D 3 (1. 1.) (3. 2.5))) ;")


def test_junctions_are_a_mesh_even_if_there_is_one() -> None:
    cross = FRAME + "J = (C ET (D 3 M (2. 2.5))) POIN 'JONC' ; "
    assert value(cross + "X = NBEL J ;") == 1
    assert value(cross + "X = COOR 1 (J POIN 1) ;") == pytest.approx(2.0)


def test_nothing_found_in_a_field_is_an_empty_mesh_and_a_doubt() -> None:
    field = FRAME + "U = COOR 1 C ; "
    for none in ("U POIN 'SUPE' 9.", "U POIN 'MAXI' 'SANS' (MOTS 'SCAL')"):
        assert value(field + f"V = {none} ; X = NBEL V ;") == 0
        assert value(field + f"V = {none} ; X = SOUC ;") is True
    assert value(field + "V = U POIN 'SUPE' 3. ; X = SOUC ;") is False


@pytest.mark.parametrize(
    ("length", "option", "inwards"),
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


def test_envelope_of_a_surface_is_its_lone_cells() -> None:
    flat = SPACE + "OPTI ELEM QUA4 ; S = (O D 3 A) TRAN 2 (0. 1. 0.) ; "
    assert value(flat + "X = NBEL (ENVE S) ;") == 6
    assert value(flat + "X = NBEL (ENVE (S ET (INVE (S ELEM 1)))) ;") == 5
    assert "envelope" in message(flat + "X = ENVE (S ET S ET (O D 1 A)) ; Y = ENVE (O D 1 A) ;")


def test_surface_under_an_element_of_lines_is_of_triangles() -> None:
    side = (
        "OPTI DIME 2 ELEM {} ; O = 0. 0. ; A = 2. 0. ; B = 0. 1. ; S = SURF (O D 4 A D 4 B D 4 O) ;"
    )
    for element, cell in (("SEG2", "TRI3"), ("SEG3", "TRI6")):
        script = side.format(element)
        assert value(script + "X = S ELEM 'TYPE' ;").values == [cell]
        assert value(script + "X = MESU S ;") == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("skin", "cells"),
    [("E", {"TE10", "PY13"}), ("(CHAN 'TRI6' E)", {"TE10"})],
)
def test_quadratic_skins_are_filled_and_keep_their_middles(skin: str, cells: set[str]) -> None:
    script = SPACE + (
        "OPTI ELEM CU20 ; V = ((O D 2 A) TRAN 2 (0. 1. 0.)) VOLU 2 'TRAN' Z ; E = ENVE V ; "
        f"F = {skin} ; W = VOLU F ; N = NBNO F ; G = ENVE W ; K = NBNO G ; "
    )
    assert set(value(script + "X = W ELEM 'TYPE' ;").values) == cells
    assert value(script + "X = MESU W ;") == pytest.approx(1.0)
    # the skin's nodes are those of the volume: all cells are common
    assert value(script + "X = NBEL (G INTE F) ;") == value(script + "X = NBEL F ;")


LINES = PLANE + "B2 = 2. 0. ; M = MANU 'SEG2' A B2 ; N = MANU 'SEG2' O A ; "


@pytest.mark.parametrize(
    ("phrase", "first"),
    [
        ("M ET N", 0.0),  # N continues into M
        ("M ET N 'TELQUEL'", 1.0),
        ("M ET 'TELQUEL' N", 1.0),
        ("ET 'TELQ' M N", 1.0),
    ],
)
def test_lines_are_joined_as_they_continue_or_as_given(phrase: str, first: float) -> None:
    assert value(LINES + f"Y = {phrase} ; X = COOR 1 ((Y ELEM 1) POIN 'INIT') ;") == first


def test_cells_of_a_mesh_of_several_types_come_first() -> None:
    both = STRIP + "M = (0. 3.) D 1 (1. 3.) ; C = S ET L ; "
    for phrase, height in (("M ET C", 0.0), ("C ET M", 0.0), ("ET 'TELQ' M C", 3.0)):
        script = both + f"Y = ({phrase}) ELEM 'SEG2' ; X = COOR 2 ((Y ELEM 1) POIN 'INIT') ;"
        assert value(script) == height


def test_edges_are_sharp_from_the_angle_that_is_given() -> None:
    cube = SPACE + "V = ((O D 2 A) TRAN 2 (0. 1. 0.)) VOLU 2 'TRAN' Z ; "
    assert value(cube + "X = NBEL (ARET V 89.) ;") == 24  # twelve edges of two cells
    assert value(cube + "X = NBEL (ARET V) ;") == 24
    assert value(cube + "X = (ARET V 91.) ; N = NBEL X ;", "N") == 0


def test_matrices_are_moved_with_their_nodes_and_relations() -> None:
    script = (
        PLANE + "L = O D 1 A ; V = 0. 2. ; K = (APPU 'UX' 4. L) ET (RELA 'UX' O '-' 'UX' A) ; "
        "M R = L K PLUS V ; F = FORC (1. 0.) (M POIN 1) ; "
        "U = RESO R F ; X = EXTR U 'UX' (M POIN 'INIT') ; Y = EXTR U 'UX' (M POIN 'FINA') ; "
    )
    # two springs of 4 that move together under 1
    assert value(script) == pytest.approx(1 / 8)
    assert value(script, "Y") == pytest.approx(1 / 8)
    moved = PLANE + "K = APPU 'UX' 4. O ; U = MANU 'CHPO' O 'UX' 1. 'UY' 0. ; Q = K PLUS U ;"
    assert "vector" in message(moved)


def test_nodes_are_told_in_the_order_of_their_numbers() -> None:
    script = PLANE + "L = O D 2 B ; M = TASS L 'NOOP' ; "
    assert value(script + "X = NBEL M ;") == 5
    assert value(script + "X = COOR 2 (M POIN 3) ;") == 1.0  # B is the third point made


@pytest.mark.parametrize(
    ("goal", "expected"),
    [
        ("S", 0.25),  # the plane z = x / 2 of QUA4
        ("(CHAN 'QUAD' S)", 0.25),
        ("(CHAN 'TRI3' S)", 0.25),
        ("(S VOLU 1 'TRAN' (0. 0. -1.))", 0.25),  # the nearest face of the skin
    ],
)
def test_points_go_on_a_mesh_along_a_vector(goal: str, expected: float) -> None:
    script = SPACE + (
        "OPTI ELEM QUA4 ; S = (O D 4 (1. 0. 0.5)) TRAN 3 (0. 1. 0.) ; OPTI ELEM CUB8 ; "
        f"G = {goal} ; P = 0.5 0.41 7. ; Q = P PROJ 'CYLI' Z G ; X = COOR 3 Q ; "
    )
    assert value(script) == pytest.approx(expected)


def test_meshes_go_on_a_mesh_away_from_a_point() -> None:
    flat = SPACE + (
        "OPTI ELEM QUA4 ; S = ((-9. -9. 2.) D 3 (9. -9. 2.)) TRAN 3 (0. 18. 0.) ; L = Z D 2 "
        "(1. 0. 1.) ; M = L PROJ 'CONI' O S ; "
    )
    # twice as far from the origin as the line at height 1
    assert value(flat + "X = MESU M ;") == pytest.approx(2.0)
    assert value(flat + "X = COOR 3 (M POIN 'FINA') ;") == pytest.approx(2.0)
    assert "no projection" in message(flat + "N = L PROJ 'CYLI' A S ;")


def test_points_of_the_plane_go_on_a_line() -> None:
    line = PLANE + "L = (O D 2 A D 2 B) ; Q = (5. 0.25) PROJ 'CYLI' A L ; "
    assert value(line + "X = COOR 1 Q ;") == pytest.approx(1.0)
    assert "lines" in message(PLANE + "Q = O PROJ 'CYLI' A (MANU 'POI1' B) ;")
