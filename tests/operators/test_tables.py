"""TABL, INDE, ENLE, COPI, vectors; VIDE."""

from ssilang.language.values import Table


def test_several_empty_objects_in_a_table(found):
    made = found("T = VIDE 'TABU' (MOTS 'UX' 'UY') 'LISTENTI'*2 ;", "T")
    assert isinstance(made, Table)
    assert [str(i) for i, _ in made.items()] == ["UX", "UY"]
