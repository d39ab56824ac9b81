"""CMCT: the matrix first, its relations second, and told when they are swapped."""

import pytest
from script_runs import failed, ran

START = (
    "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ; "
    "C = RELA 2. 'UX' P '+' 3. 'UX' Q ; "
)


def test_the_relation_leaves_one_unknown():
    """2 u + 3 v = 0: with v = -2 u / 3 the stiffness is 4 + 5 x 4 / 9."""
    result = ran(START + "D = MAXI (EXTR (CMCT K C) 'DIAG') ;")
    one, other = 4 + 5 * 4 / 9, 5 + 4 * 9 / 4
    found = result.session.root.find("D")
    assert found == pytest.approx(one) or found == pytest.approx(other)


@pytest.mark.parametrize(
    ("operands", "said"),
    [("C K", "the matrix stands first, its relations second"), ("K K", "no relations to condense")],
)
def test_matrices_without_relations_are_refused(operands, said):
    result = failed(START + f"D = CMCT {operands} ;")
    assert said in result.message
