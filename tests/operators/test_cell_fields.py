"""Fields in cells: making, algebra, components, masks."""

import numpy as np
import pytest

LINE = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; L = DROI 4 PA PB ; "
    "C = MANU 'CHML' L 'A' 2. 'B' 5. ; S = MANU 'CHML' L 'SCAL' 3. ; "
)


def test_components_that_only_one_field_has_are_kept(found):
    names = found(LINE + "D = C - (EXCO 'A' C) - S ; N = EXTR D 'COMP' ; ", "N")
    assert sorted(str(w) for w in names.values) == ["A", "B", "SCAL"]
    field = found(LINE + "D = C - (EXCO 'A' C) - S ;", "D")
    block = field.blocks[0].components
    assert [float(np.ravel(block[n])[0]) for n in ("A", "B", "SCAL")] == [0.0, 5.0, -3.0]


def test_values_of_a_list_are_dealt_out_one_a_cell(found):
    field = found(
        LINE + "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
        "D = MANU 'CHML' MO 'REPA' 'V' (PROG 1. 2. 3.) 'TYPE' 'SCALAIRE' 'GRAVITE' ;",
        "D",
    )
    assert np.ravel(field.blocks[0].components["V"]).tolist() == [1, 2, 3, 1]
    assert field.title == "SCALAIRE"
    assert field.blocks[0].support == "GRAVITE"


def test_support_words_compare_on_their_eight_letters(found):
    field = found(
        LINE + "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
        "D = manu chml MO fx 0. fy -9.81 rigidites type scalaire ;",
        "D",
    )
    assert list(field.blocks[0].components) == ["FX", "FY"]
    assert (field.blocks[0].support, field.title) == ("RIGIDITE", "SCALAIRE")


def test_type_and_constituent_change(found):
    field = found(LINE + "D = CHAN 'CONS' (CHAN 'TYPE' C 'CARACTERISTIQUES') 'SOIL' ;", "D")
    assert field.title == "CARACTERISTIQUES"
    assert field.blocks[0].constituent == "SOIL"


def test_zero_hooke_matrices_make_no_stiffness(found):
    block = found(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (ZERO M 'HOTANGEN') ; ",
        "K",
    ).blocks[0]  # fmt: skip
    assert block.values.shape == (2, 8, 8)
    assert not block.values.any()


STRAINED = (
    "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
    "M = MODE S MECANIQUE ELASTIQUE ; H = HOOK M (MATE M 'YOUN' 91. 'NU' 0.3) ; "
    "U = (NOMC 'UX' (0.01 * (COOR 1 S))) ET (NOMC 'UY' (0.02 * (COOR 2 S))) ; E = EPSI M U ; "
)


@pytest.mark.parametrize(
    "order", ["H * E M", "E * H M", "M H * E", "M E * H", "H M * E", "E * M H"]
)
def test_hooke_matrices_times_strains_are_stresses_in_any_order(found, order):
    # plane stress: E / (1 - nu^2) = 100, so 100 (0.01 + 0.3 0.02), 100 (0.02 + 0.3 0.01)
    x, y, title = found(
        STRAINED + f"T = {order} ; X = EXTR T 'SMXX' 1 1 1 ; Y = EXTR T 'SMYY' 1 2 4 ; "
        "N = EXTR T 'TYPE' ;",
        "X", "Y", "N",
    )  # fmt: skip
    assert (x, y) == pytest.approx((1.6, 2.3), rel=1e-12)
    assert str(title).rstrip() == "CONTRAINTES"


def test_products_by_names_take_a_factor_each(found, refused):
    lists = "(MOTS 'A' 'B') (MOTS 'B' 'B') (MOTS 'Y' 'Z')"
    values = found(
        LINE + f"D = C * C {lists} (PROG 3. -1.) ; Q = C / C {lists} (PROG 4. 5.) ; "
        "X1 = EXTR D 'Y' 1 1 1 ; X2 = EXTR D 'Z' 1 1 1 ; "
        "X3 = EXTR Q 'Y' 1 1 1 ; X4 = EXTR Q 'Z' 1 1 1 ;",
        "X1", "X2", "X3", "X4",
    )  # fmt: skip
    assert values == pytest.approx((30.0, -25.0, 0.1, 0.2))
    assert "1 factor for 2 names" in refused(LINE + f"D = C * C {lists} (PROG 3.) ;")


def test_lists_curves_and_points_in_cells_combine(found, refused):
    script = (
        LINE + "E = EVOL 'MANU' (PROG 1. 2.) (PROG 4. 5.) ; F = MANU 'CHML' L 'SCAL' E ; "
        "G = MANU 'CHML' L 'SCAL' (PROG 2. 6.) ; P = MANU 'CHML' L 'SCAL' PB ; "
    )
    curve, factor, lists, quotient, x, y = found(
        script + "Y1 = EXTR (EXTR (F * F) 'SCAL' 1 2 1) 'ORDO' ; "
        "Y2 = EXTR (EXTR (S * F) 'SCAL' 1 1 1) 'ORDO' ; Y3 = EXTR (G * G) 'SCAL' 1 1 1 ; "
        "Y4 = EXTR (G / S) 'SCAL' 1 1 1 ; X = COOR 1 (EXTR (P + P) 'SCAL' 1 1 1) ; "
        "Y = COOR 1 (EXTR (P - P) 'SCAL' 1 1 1) ;",
        "Y1", "Y2", "Y3", "Y4", "X", "Y",
    )  # fmt: skip
    assert curve.values.tolist() == [16.0, 25.0]
    assert factor.values.tolist() == [12.0, 15.0]
    assert lists.values.tolist() == [4.0, 36.0]
    assert quotient.values.tolist() == pytest.approx([2 / 3, 2.0])
    assert (x, y) == (8.0, 0.0)
    assert "points add up" in refused(script + "Q = P «*» P ;")


def test_a_field_is_dealt_out_over_a_table_of_models_and_joined_again(found):
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; A = CHAN 'STRESSES' M (CHAN 'CHAM' (COOR 1 S) M) ; "
        "TM = PART 'ARLE' M 3 ; T = REDU A TM ; W = T . 'SOUSTYPE' ; N = DIME T ; "
        "X = (INTG (TM . 1) (T . 1)) + (INTG (TM . 2) (T . 2)) + (INTG (TM . 3) (T . 3)) ; "
        "Y = INTG M (REDU T M) ; "
    )
    kind, count, parts, whole = found(script, "W", "N", "X", "Y")
    assert (str(kind), count) == ("ESCLAVE", 4)
    assert parts == pytest.approx(8.0)  # the integral of x over the band
    assert whole == pytest.approx(8.0)


def test_the_sub_type_of_a_changed_field_is_any_word(found):
    script = (
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 1 (0. 0.) (1. 0.)) TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; T = COOR 1 S ; "
        "A = CHAN 'CHAM' T M 'STRESSES' 'MY OWN' ; B = CHAN 'CHAM' T S 'OTHER' ; "
        "C = CHAN 'GRAVITE' M A 'DEFORMATIONS' ; D = CHAN 'GRAVITE' M A ; "
        "N = NBEL (EXTR (CHAN 'CHAM' T M ET (CHAN 'CHAM' T M)) 'MAIL') ; "
    )
    a, b, c, d, n = found(script, "A", "B", "C", "D", "N")
    assert (a.title, b.title, c.title, d.title) == ("MY OWN", "OTHER", "DEFORMATIONS", "MY OWN")
    assert n == 1


def test_a_field_reduced_strictly_is_the_same_without_mixtures(found):
    a, b = found(LINE + "X = REDU 'STRI' C (L ELEM 1) ; Y = REDU C (L ELEM 1) ;", "X", "Y")
    assert a.blocks[0].components.keys() == b.blocks[0].components.keys()
    assert [len(p.cells) for p in a.blocks] == [1]
