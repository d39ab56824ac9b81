"""TABL, INDE, ENLE, COPI, vectors; VIDE."""

from together import together

from ssilang.language.values import Table


def test_indices_come_in_order_of_creation(found):
    made = found("T = TABL 'S' ; T . 2. = 1 ; T . 'B' = 2 ; I = INDE T ;", "I")
    assert [made.get(i) for i in (1, 2, 3)] == ["SOUSTYPE", 2.0, "B"]


def test_sum_and_union_of_a_table(found):
    total, joined = found(
        "T = TABL 'ESCLAVE' ; T . 1 = PROG 1. ; T . 2 = PROG 5. ; S = + T ; L = ET T ;", "S", "L"
    )
    assert total.values.tolist() == [6.0]
    assert joined.values.tolist() == [1.0, 5.0]


@together(
    "kind",
    ["CHPOINT", "MCHAML", "MMODEL", "RIGIDITE", "EVOLUTIO", "LISTENTI", "LISTREEL", "LISTMOTS",
     "LISTCHPO", "TABLE", "CHARGEME", "MAILLAGE"],
)  # fmt: skip
def test_empty_objects_are_empty(kind, found):
    kind_word, empty = found(f"O = VIDE '{kind}' ; K = TYPE O ; E = VIDE O ;", "K", "E")
    assert kind_word.rstrip() == kind
    assert empty is True


def test_empty_object_begins_a_union(found):
    field, full = found(
        "OPTI DIME 2 ; P = 0. 0. ; C = VIDE 'CHPOINT'/'DIFFUS' ; "
        "C = C ET (MANU 'CHPO' P 'T' 4. 'NATURE' 'DIFFUS') ; X = MAXI C ; E = VIDE C ;",
        "X", "E",
    )  # fmt: skip
    assert (field, full) == (4.0, False)


def test_several_empty_objects_in_a_table(found):
    made = found("T = VIDE 'TABU' (MOTS 'UX' 'UY') 'LISTENTI'*2 ;", "T")
    assert isinstance(made, Table)
    assert [str(i) for i, _ in made.items()] == ["UX", "UY"]
