"""MANU 'RIGI', powers, parts of matrices; what RESO refuses; operands in odd orders."""

import numpy as np
import pytest
from script_runs import failed, ran, refused
from script_runs import found as objects
from together import together

from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.language.say.diagnostics import sentence

PLANE = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P0 = 0. 0. ; P1 = 1. 0. ;\n"


def matrix(script):
    return ran(PLANE + script).session.root.find("R")


def dense(made):
    return assemble(made, numbering_of(made)).toarray()


@together("terms", ["(PROG 1. 2. 2. 5.)", "(PROG 1. 2. 5.)", "(PROG 1.) (PROG 2. 5.)",
              "(PROG 1. 2.) (PROG 2. 5.)"])  # fmt: skip
def test_symmetric_terms_in_all_their_writings(terms):
    made = matrix(f"R = MANU 'RIGI' 'TYPE' 'MASSE' P0 (MOTS 'UX' 'UY') {terms} ;")
    np.testing.assert_array_equal(dense(made), [[1.0, 2.0], [2.0, 5.0]])
    assert made.kind == "MASSE"
    assert made.blocks[0].symmetric


def test_any_and_antisymmetric_matrices():
    made = matrix("R = MANU RIGI TYPE rigidite P0 (MOTS UX UY) (PROG 2 0 1 3) QUEL ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 0.0], [1.0, 3.0]])
    made = matrix("R = MANU 'RIGI' P0 (MOTS 'UX' 'UY') 'ANTI' (PROG 0. 4. 0.) ;")
    np.testing.assert_array_equal(dense(made), [[0.0, -4.0], [4.0, 0.0]])


def test_one_list_serves_all_nodes_of_a_cell_or_each_has_its_own():
    terms = "(PROG 1. -1. -1. 1.)"
    made = matrix(f"L = DROI 2 P0 P1 ; R = MANU 'RIGI' L (MOTS 'UX') {terms} ;")
    # the middle node, numbered after P0 and P1, belongs to both cells
    expected = np.array([[1.0, 0, -1], [0, 1, -1], [-1, -1, 2]])
    np.testing.assert_array_equal(dense(made), expected)
    made = matrix(f"L = DROI 1 P0 P1 ; R = MANU 'RIGI' L (MOTS 'UX') (MOTS 'RZ') {terms} ;")
    assert str(numbering_of(made).label(0)) == "UX at node 1 (0. 0.)"
    assert str(numbering_of(made).label(1)) == "RZ at node 2 (1. 0.)"


def test_field_on_the_diagonal_in_a_column_and_in_a_row():
    field = "(MANU 'CHPO' (P0 ET P1) 1 'UX' (PROG 2. 3.))"
    np.testing.assert_array_equal(dense(matrix(f"R = MANU 'RIGI' {field} ;")), np.diag([2.0, 3.0]))
    made = matrix(f"R = MANU 'RIGI' {field} 'COLO' P0 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 0.0], [3.0, 0.0]])
    made = matrix(f"R = MANU 'RIGI' {field} 'LIGN' P0 'FX' 'PRIM' 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 3.0], [0.0, 0.0]])
    made = matrix(f"R = MANU 'RIGI' {field} 'COLO' 'SYME' P0 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 3.0], [3.0, 0.0]])


COPIED = """
OPTI DIME 2 MODE PLAN DEFO ; P = 0. 0. ; Q = 1. 0. ;
K = (APPU 'UX' 4. (P ET Q)) ET (APPU 'UY' 8. (P ET Q)) ;
R = RELA 'UX' P - 'UX' Q ;
S = CHAN 'INCO' R (MOTS 'UX' 'LX') (MOTS 'FX' 'FLX') (MOTS 'UY' 'LX') (MOTS 'FY' 'FLX') 'DUPL' ;
"""


ORDERS = [
    "(MOTS 'UX' 'LX') (MOTS 'FX' 'FLX') (MOTS 'UY' 'LX') (MOTS 'FY' 'FLX')",
    "(MOTS 'UX' 'LX') (MOTS 'UY' 'LX') (MOTS 'FX' 'FLX') (MOTS 'FY' 'FLX')",
]


@together("order", ORDERS)
def test_a_copied_condition_stands_beside_its_model(order):
    """Lists of old and new names come by pairs or, as in the notice's example, old names first."""
    result = ran(
        COPIED.replace(ORDERS[0], order) + "F = MANU 'CHPO' P 2 'FX' 8. 'FY' 32. 'NATURE' "
        "'DISCRET' ; U = RESO (K ET R ET S) F ; "
        "MESS (EXTR U 'UX' Q) ' ' (EXTR U 'UY' Q) ' ' (EXTR U 'UX' P) ;"
    )
    assert [float(v) for v in result.output.split()] == pytest.approx([1.0, 2.0, 1.0])


def test_imaginary_names_of_a_matrix():
    result = ran(
        COPIED.split("R =")[0] + "I = CHAN 'INCO' K 'COMP' 'SYME' ; LIST (EXTR I 'COMP') ;"
        "LIST (EXTR I 'COMP' 'DUAL') ;"
    )
    assert {"IUX", "IUY", "IFX", "IFY"} <= set(result.output.split())
    assert "conditions" in refused(COPIED.split("S =")[0] + "I = CHAN 'INCO' (K ET R) 'COMP' ;")


def test_impedances_above_resonance_are_no_springs_below_zero():
    result = ran(
        "OPTI DIME 2 ; P = 0. 0. ; K = MANU 'RIGI' P (MOTS 'UX') (PROG 4.) ;"
        "Z = (IMPE K 'RAIDEUR') ET (IMPE K 'MASSE' 2.) ET (IMPE K 'AMOR' 0.1) ;"
        "U = RESO Z (MANU 'CHPO' P 'FX' 1.2 'NATURE' 'DISCRET') ; X = EXTR U 'UX' P ;"
    )
    assert result.session.root.find("X") == pytest.approx(1.2 * -12.0 / (12.0**2 + 0.4**2))
    assert not result.session.warnings


BAR = """
OPTI DIME 2 MODE PLAN CONT ELEM SEG2 ;
PA = 0. 0. ; PB = 10. 0. ; L1 = DROI 5 PA PB ;
MO = MODE L1 'MECANIQUE' 'ELASTIQUE' 'BARR' ;
MA = MATE MO 'YOUN' 200. 'NU' 0. 'RHO' 3. 'SECT' 0.5 ;
K0 = RIGI MO MA ; BX = BLOQ 'UX' PA ; BY = BLOQ 'UY' L1 ;
K1 = K0 ET BX ET BY ; F1 = FORC 'FX' 4. PB ;
"""


def at(field, name, point):
    return float(field.values_at(name, [point.node])[0])


def test_free_body_is_named_or_its_load_left_out_when_told():
    free = BAR + "K2 = K0 ET BY ;"
    result = failed(free + "U = RESO K2 F1 ;")
    assert "translation along X" in result.message
    assert "UX at node" in result.message
    told = ran(free + "U = RESO K2 F1 'NOID' ; W X = RESO K2 F1 ((-3.) * F1) 'SOUC' ;").session
    assert len(told.warnings) == 1
    u, w, x = (at(told.root.find(name), "UX", told.root.find("PB")) for name in "UWX")
    assert (w, x) == pytest.approx((u, -3.0 * u), rel=1e-12)


def test_parts_of_a_matrix():
    script = BAR + (
        "BM = BLOQ 'MINI' 'UX' PB ; KT = K1 ET BM ; M0 = EXTR KT 'MAIL' 'NOMU' ;"
        "M1 = EXTR KT 'MAIL' 'MULT' ; M2 = EXTR KT 'MAIL' 'UNIL' ; M3 = EXTR KT 'MAIL' ;"
        "KN = EXTR KT 'RIGI' 'NOMU' ; KM = EXTR KT 'RIGI' 'MULT' ; C1 = EXTR KT 'COMP' ;"
        "C2 = EXTR KT 'COMP' 'DUAL' ; DI = EXTR K0 'DIAG' ; KX = EXTR KT 'UX' 'FX' ;"
    )
    names = ("M0", "M1", "M2", "M3", "KN", "KM", "C1", "C2", "DI", "KX", "PB")
    m0, m1, m2, m3, kn, km, c1, c2, di, kx, b = objects(script, *names)
    assert (len(m0.node_ids), len(m1.node_ids), len(m2.node_ids)) == (6, 8, 1)
    assert len(m3.node_ids) == 14
    assert not kn.relations
    assert kn.blocks
    assert not km.blocks
    assert len(km.relations) == 3
    assert [str(w) for w in c1.values] == ["UX", "UY", "LX"]
    assert [str(w) for w in c2.values] == ["FX", "FY", "FLX"]
    assert at(di, "UX", b) == pytest.approx(200.0 * 0.5 / 2.0)
    assert {u for block in kx.blocks for u in block.unknowns} == {"UX"}


def test_curve_is_zero_where_the_field_is_not_and_says_so():
    result = ran(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; X = COOR 1 (L ELEM 2) ; "
        "E = EVOL 'CHPO' (X + 1.) 'SCAL' L ;"
    )
    part = result.session.root.find("E").parts[0]
    np.testing.assert_allclose(part.ordinates, [0, 1.25, 1.5, 0, 0])
    said = [sentence(w, "en")[0] for w in result.session.warnings]
    assert any("no value of SCAL at 3 of the 5" in s for s in said)


@pytest.mark.parametrize("how", ["'ARLE' M 2", "2 M"])
def test_model_is_dealt_out_zone_by_zone(found, how):
    script = (
        "OPTI DIME 2 ELEM QUA4 ; L = DROI 5 (0 0) (1 0) ; S = TRAN 1 L (0. 1.) ; "
        "M = (MODE S MECANIQUE ELASTIQUE) ET (MODE (CONT S) MECANIQUE ELASTIQUE BARR) ; "
        f"T = PART 'NESC' {how} ; A = T . 1 ; B = T . 2 ; "
    )
    a, b = found(script, "A", "B")
    assert [len(z.cells) for z in a.zones] == [3, 6]
    assert [len(z.cells) for z in b.zones] == [2, 6]
    assert [z.element for z in a.zones] == ["QUA4", "BARR"]


def test_curves_in_cells_through_fields(found, refused):
    start = (
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (1. 0.) ; "
        "M = MODE L MECANIQUE ELASTIQUE BARR ; "
        "A = MANU 'CHML' M 'REPA' 'YOUN' (PROG 3. 4.) 'GRAVITE' ; "
    )
    first, second, name = found(
        start + "C = MANU 'CHML' 'EVOL' 'T' 20. A 100. (0.5 * A) ; "
        "X1 = IPOL 60. (EXTR C 'YOUN' 1 1 1) ; T = TABL ; T . 1. = A ; T . 2. = 3. * A ; "
        "X2 = IPOL 1.5 (EXTR (MANU T 'CHML' 'EVOL' 'T') 'YOUN' 1 2 1) ; "
        "N = EXTR (EXTR C 'DEVA') 1 ;",
        "X1", "X2", "N",
    )  # fmt: skip
    assert (first, second) == pytest.approx((2.25, 8.0))
    assert str(name).rstrip() == "T"
    assert "increase" in refused(start + "C = «MANU» 'CHML' 'EVOL' 'T' 20. A 10. A ;")
    said = refused(start + "C = «MANU» 'CHML' 'EVOL' 'T' 20. A 30. (NOMC 'NU' A) ;")
    assert "one component" in said


# --- lists and loadings by lists ----------------------------------------------------------------


# --- what there is ------------------------------------------------------------------------------


def test_whether_an_object_is_of_a_type_and_a_file_there(found, tmp_path):
    (tmp_path / "here.txt").write_text("1\n")
    script = (
        "X = 2. ; A = EXIS X * FLOTTANT ; B = EXIS X*'ENTIER' ; C = EXIS UNKNOWN * MOT ;"
        "OPTI SORT 'there.csv' ; SORT 'EXCE' (EVOL 'MANU' (PROG 1.) (PROG 2.)) ;"
        "D = EXIS 'there.csv' * 'FICHIER' ; E = EXIS 'gone.csv' * FICHIER ;"
    )
    assert found(script, *"ABCDE") == (True, False, True, True, False)


_CURVES = "E = EVOL 'MANU' 't' (PROG 0. 1.) 'u' (PROG -5. 5.) ; F = E ET E ; "
_FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 2 'UX' 1. 'UY' 9. ; L = SUIT C C ; "


@pytest.mark.parametrize(
    ("before", "usual", "odd"),
    [
        (_FIELD, "EXTR L 'VALE' P 'UY'", "EXTR L 'VALE' 'UY' P"),
        ("", "DIAD 'INVE' (PROG 1. 3. 7.)", "DIAD (PROG 1. 3. 7.) 'INVE'"),
        (_CURVES, "BORN F 1 'MAXI' 1. 2 'MINI' 0.", "BORN 1 'MAXI' 1. F 2 'MINI' 0."),
        (_CURVES, "E COUL ROUG", "COUL 'ROUG' E"),
    ],
)
def test_the_order_of_operands_is_free(printed, before, usual, odd):
    assert printed(f"{before}LIST ({odd}) ;") == printed(f"{before}LIST ({usual}) ;")


@pytest.mark.parametrize(
    ("statement", "says"),
    [
        ("LIST 'RESU' ;", "Word of 4 characters: RESU"),
        ("LIST '*' ;", "Word of 1 character: *"),
        ("X = 3 ; LIST *ENTIER ;", "  X                        ENTIER   3"),
    ],
)
def test_words_that_are_spelt_like_keywords_are_operands_where_operands_stand(
    printed, statement, says
):
    assert printed(statement)[-1] == says
