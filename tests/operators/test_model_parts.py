"""Zones of models by formulation and behaviour, constituents, number of unknowns, single values."""

import numpy as np

MODELS = (
    "OPTI DIME 2 ELEM SEG2 ; PA = 0. 0. ; PB = 4. 0. ; PC = 4. 3. ; L = DROI 4 PA PB ; "
    "K = DROI 2 PB PC ; M1 = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
    "M2 = MODE K 'MECANIQUE' 'ELASTIQUE' 'POUT' ; MO = M1 ET M2 ; "
)


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


def test_single_value_stands_where_it_is_put(found, refused):
    words = "'TYPE' 'SCALAIRE' 'POSI' 'GRAVITE'"
    field = found(MODELS + f"C = MANU 'CHAM' MO {words} 'V' 2 1 7. ;", "C")
    assert np.ravel(field.blocks[0].components["V"]).tolist() == [0, 7, 0, 0]
    assert field.title == "SCALAIRE"
    assert "4 cells" in refused(MODELS + "C = «MANU» 'CHAM' MO 'V' 9 1 7. ;")


def test_an_elastic_body_has_none_of_the_internal_variables(found, refused):
    """REDU gives what is there of them, nothing, and ET counts on; other fields are refused."""
    script = (
        "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; S = ((0. 0.) D 2 (1. 0.)) TRAN 1 (0. 1.) ; "
        "G = S ELEM 1 ; H = S ELEM 2 ; A = MODE G MECANIQUE ELASTIQUE ; "
        "B = MODE H MECANIQUE ELASTIQUE PLASTIQUE PARFAIT ; M = A ET B ; "
        "C = (MATE A YOUN 1. NU 0.) ET (MATE B YOUN 1. NU 0. SIGY 0.1) ; "
        "D = BLOQ UX UY S ; T = TABL ; T . MODELE = M ; T . CARACTERISTIQUES = C ; "
        "X = COOR 1 S ; T . BLOCAGES_MECANIQUES = D ; "
        "T . CHARGEMENT = CHAR DIMP (DEPI D (NOMC UX X)) (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ; "
        "T . TEMPS_CALCULES = PROG 1. ; PASAPAS T ; V = T . VARIABLES_INTERNES . 1 ; "
    )
    of_elastic = "E = REDU V G ; F = REDU V A ; "
    both = "N = EXTR (E ET F) NBZO ; P = MAXI (E ET (REDU V H)) ; Q = MAXI V ; "
    n, p, q = found(script + of_elastic + both, "N", "P", "Q")
    assert (n, p) == (0, q)
    assert q > 0.5
    assert "no cell" in refused(script + "E = REDU (REDU (T . CONTRAINTES . 1) H) G ;")
