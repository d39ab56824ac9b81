"""Zones of models by formulation and behaviour, constituents, number of unknowns, single values."""

import numpy as np

MODELS = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; PC = 4. 3. ; L = DROI 4 PA PB ; "
    "K = DROI 2 PB PC ; M1 = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
    "M2 = MODE K 'MECANIQUE' 'ELASTIQUE' 'POUT' ; MO = M1 ET M2 ; "
)


def test_zones_are_removed_and_chosen_by_words(found):
    whole, none, beams = found(
        MODELS + "A = NBEL (EXTR (ENLE MO 'COMP' 'PLASTIQUE') 'MAIL') ; "
        "B = VIDE (ENLE MO 'FORM' 'MECANIQUE') ; "
        "C = NBEL (EXTR (EXTR MO 'COMP' 'ELASTIQUE') 'MAIL') ;",
        "A", "B", "C",
    )  # fmt: skip
    assert (whole, none, beams) == (6, True, 6)


def test_constituent_of_a_model_changes(found):
    model = found(MODELS + "M3 = CHAN 'CONS' MO 'SOIL' ;", "M3")
    assert {z.constituent for z in model.zones} == {"SOIL"}


def test_internal_variables_of_a_model_are_named(found):
    """Those of a law once, in the order of its field; none of an elastic body."""
    script = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = ((0. 0.) D 2 (1. 0.)) TRAN 1 (0. 1.) ; "
        "A = MODE (S ELEM 1) MECANIQUE ELASTIQUE PLASTIQUE CINEMATIQUE ; "
        "B = MODE (S ELEM 2) MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; "
        "X = EXTR (A ET B) 'VARI' ; Y = EXTR B 'VARI' ; "
        "Z = EXTR (MODE S MECANIQUE ELASTIQUE) 'VARI' ; "
    )
    both, one, none = (list(v.values) for v in found(script, "X", "Y", "Z"))
    axes = ["ALXX", "ALYY", "ALZZ", "ALXY", "ALXZ", "ALYZ"]
    assert [str(n).rstrip() for n in both] == ["EPSE", *axes]
    assert [str(n).rstrip() for n in one] == ["EPSE"]
    assert none == []


def test_gradients_of_a_bar_are_named(found):
    names = found(MODELS + "X = EXTR M1 'GRAD' ;", "X")
    assert [str(n).rstrip() for n in names.values] == ["UX,X", "UY,X"]


def test_number_of_unknowns_of_a_bar(found):
    count = found(MODELS + "N = DIME (RIGI M1 (MATE M1 'YOUN' 1. 'NU' 0. 'SECT' 1.)) ;", "N")
    assert count == 10


def test_single_value_stands_where_it_is_put(found, refused):
    words = "'TYPE' 'SCALAIRE' 'POSI' 'GRAVITE'"
    field = found(MODELS + f"C = MANU 'CHAM' MO {words} 'V' 2 1 7. ;", "C")
    assert np.ravel(field.blocks[0].components["V"]).tolist() == [0, 7, 0, 0]
    assert field.title == "SCALAIRE"
    assert "4 cells" in refused(MODELS + "C = «MANU» 'CHAM' MO 'V' 9 1 7. ;")
