"""MANU 'RIGI': matrices by hand."""

import numpy as np
import pytest

from ssilang.cli.run import run_text
from ssilang.kernel.matrices.assembly import assemble, numbering_of

PLANE = "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; P0 = 0. 0. ; P1 = 1. 0. ;\n"


def matrix(script):
    result = run_text(PLANE + script)
    assert result.exit_code == 0, result.message
    return result.session.root.find("R")


def dense(made):
    return assemble(made, numbering_of(made)).toarray()


@pytest.mark.parametrize(
    "terms", ["(PROG 1. 2. 2. 5.)", "(PROG 1. 2. 5.)", "(PROG 1.) (PROG 2. 5.)",
              "(PROG 1. 2.) (PROG 2. 5.)"],
)  # fmt: skip
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
    assert numbering_of(made).label(0) == "UX at node 1"
    assert numbering_of(made).label(1) == "RZ at node 2"


def test_wrong_number_of_terms_is_said():
    result = run_text(PLANE + "R = MANU 'RIGI' P0 (MOTS 'UX' 'UY') (PROG 1. 2.) ;")
    assert result.exit_code == 1
    assert "4 or 3 terms" in result.message


def test_field_on_the_diagonal_in_a_column_and_in_a_row():
    field = "(MANU 'CHPO' (P0 ET P1) 1 'UX' (PROG 2. 3.))"
    np.testing.assert_array_equal(dense(matrix(f"R = MANU 'RIGI' {field} ;")), np.diag([2.0, 3.0]))
    made = matrix(f"R = MANU 'RIGI' {field} 'COLO' P0 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 0.0], [3.0, 0.0]])
    made = matrix(f"R = MANU 'RIGI' {field} 'LIGN' P0 'FX' 'PRIM' 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 3.0], [0.0, 0.0]])
    made = matrix(f"R = MANU 'RIGI' {field} 'COLO' 'SYME' P0 'UX' ;")
    np.testing.assert_array_equal(dense(made), [[2.0, 3.0], [3.0, 0.0]])
