"""TABL, INDE, ENLE, COPI, vectors; VIDE."""

from ssilang.language.values import Table


def test_indices_come_in_order_of_creation(found):
    made = found("T = TABL 'S' ; T . 2. = 1 ; T . 'B' = 2 ; I = INDE T ;", "I")
    assert [made.get(i) for i in (1, 2, 3)] == ["SOUSTYPE", 2.0, "B"]


def test_several_empty_objects_in_a_table(found):
    made = found("T = VIDE 'TABU' (MOTS 'UX' 'UY') 'LISTENTI'*2 ;", "T")
    assert isinstance(made, Table)
    assert [str(i) for i, _ in made.items()] == ["UX", "UY"]
