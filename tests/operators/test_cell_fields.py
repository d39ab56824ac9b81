"""Fields in cells: making, algebra, components, masks."""

import numpy as np
from script_runs import ran
from together import together

LINE = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; L = DROI 4 PA PB ; "
    "C = MANU 'CHML' L 'A' 2. 'B' 5. ; S = MANU 'CHML' L 'SCAL' 3. ; "
)


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
    field = found(LINE + "D = CHAN 'CONS' (CHAN 'TYPE' C 'CARACTERISTIQUES') 'AB  ' ;", "D")
    assert field.title == "CARACTERISTIQUES"
    assert field.blocks[0].constituent == "AB"


@together(
    "other, told",
    [("C", []), ("C * 2.", [["A", "B"]]), ("CHAN 'CONS' (C * 2.) 'W'", []), ("S", [])],
)
def test_other_values_of_a_component_in_the_same_cells_are_told(other, told):
    done = ran(f"{LINE}D = C ET ({other}) ;")
    assert [w.data["names"] for w in done.session.warnings] == told


def test_zero_hooke_matrices_make_no_stiffness(found):
    block = found(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (2. 0.)) TRAN 1 (0. 1.) ; "
        "M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (ZERO M 'HOTANGEN') ; ",
        "K",
    ).blocks[0]  # fmt: skip
    assert block.values.shape == (2, 8, 8)
    assert not block.values.any()


def test_a_field_reduced_strictly_is_the_same_without_mixtures(found):
    a, b = found(LINE + "X = REDU 'STRI' C (L ELEM 1) ; Y = REDU C (L ELEM 1) ;", "X", "Y")
    assert a.blocks[0].components.keys() == b.blocks[0].components.keys()
    assert [len(p.cells) for p in a.blocks] == [1]
