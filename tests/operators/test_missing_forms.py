"""Forms of operators: powers of matrices, curves past a field's support, models dealt out."""

import numpy as np
import pytest

from ssilang.cli.run import run_text
from ssilang.kernel.matrices.assembly import assemble
from ssilang.language.say.diagnostics import sentence


def test_power_of_a_lumped_mass_is_its_inverse(found):
    script = (
        "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; M = (MASS 'UX' 4. P) ET (MASS 'UX' 5. Q) ; "
        "I = M ** -1 ; R = M ** 0.5 ;"
    )
    inverse, root = found(script, "I", "R")
    np.testing.assert_allclose(assemble(inverse).diagonal(), [0.25, 0.2])
    np.testing.assert_allclose(assemble(root).diagonal(), [2.0, np.sqrt(5)])


def test_power_of_negative_terms_is_refused(refused):
    assert "negative terms" in refused("OPTI DIME 2 ; P = 0. 0. ; M = (MASS 'UX' -4. P) ** 0.5 ;")


def test_curve_is_zero_where_the_field_is_not_and_says_so():
    result = run_text(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; X = COOR 1 (L ELEM 2) ; "
        "E = EVOL 'CHPO' (X + 1.) 'SCAL' L ;"
    )
    assert result.exit_code == 0
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


def test_no_node_faces_an_empty_mesh(found):
    a = found("OPTI DIME 2 ELEM SEG2 ; A B = VISA (DROI 1 (0 0) (1 0)) (VIDE 'MAILLAGE') ;", "A")
    assert a.n_cells == 0


@pytest.mark.parametrize(
    ("sign", "expected"), [("T1 + T2", [6, 8]), ("T2 - T1", [2, 2]), ("2. * T1", [4, 6])]
)
def test_vectors_in_tables(found, sign, expected):
    script = (
        "T1 = TABL 'VECTEUR' ; T1 . 1 = 2. ; T1 . 2 = 3. ; "
        "T2 = TABL 'VECTEUR' ; T2 . 1 = 4. ; T2 . 2 = 5. ; "
    )
    made = found(script + f"T = {sign} ;", "T")
    assert [made.get(1), made.get(2)] == expected
