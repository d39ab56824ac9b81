"""MANU 'RIGI': matrices by hand."""

import numpy as np
import pytest
from script_runs import ran, refused
from together import together

from ssilang.kernel.matrices.assembly import assemble, numbering_of

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
