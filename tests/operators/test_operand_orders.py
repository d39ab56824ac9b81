"""Operands and keywords in odd orders mean what they mean in the usual one."""

import pytest

_CURVES = "E = EVOL 'MANU' 't' (PROG 0. 1.) 'u' (PROG -5. 5.) ; F = E ET E ; "
_FIELD = "OPTI DIME 2 ; P = 0. 0. ; C = MANU 'CHPO' P 2 'UX' 1. 'UY' 9. ; L = SUIT C C ; "


@pytest.mark.parametrize(
    ("before", "usual", "odd"),
    [
        ("", "EXTR (PROG 5. 6.) 2", "EXTR 2 (PROG 5. 6.)"),
        (_FIELD, "EXTR L 'VALE' P 'UY'", "EXTR L 'VALE' 'UY' P"),
        ("", "INSE (PROG 1. 3.) 2 2.", "INSE 2 2. (PROG 1. 3.)"),
        ("", "SOMM 'CUMU' (PROG 1. 2.)", "SOMM (PROG 1. 2.) 'CUMU'"),
        ("", "RACP 'INTE' 2.5 4. (PROG 6. -5. 1.)", "RACP 2.5 4. 'INTE' (PROG 6. -5. 1.)"),
        ("", "POSI 2. 'DANS' (PROG 1. 2.) 'TOUS' 0.1", "POSI 2. 'DANS' (PROG 1. 2.) 0.1 'TOUS'"),
        ("", "POSI 'b' 'DANS' (MOTS 'A' 'B') 'NOCA'", "POSI 'b' 'NOCA' 'DANS' (MOTS 'A' 'B')"),
        ("", "ORDO (PROG 3. 1. 2.) 'DECR'", "ORDO 'DECR' (PROG 3. 1. 2.)"),
        ("", "RAFF (PROG 0. 1. 3.) 0.5", "RAFF 0.5 (PROG 0. 1. 3.)"),
        ("", "DIAD 'INVE' (PROG 1. 3. 7.)", "DIAD (PROG 1. 3. 7.) 'INVE'"),
        ("", "FONC 'BESS' 'Y1' (PROG 5.)", "FONC (PROG 5.) 'BESS' 'Y1'"),
        ("", "ENTI 'PROCHE' -3.5", "ENTI -3.5 'PROCHE'"),
        ("", "MASQ (PROG 1. 5.) 'EGIN' 4", "4. MASQ (PROG 1. 5.) 'EGIN'"),
        ("", "MASQ (PROG 1. 5.) 'SUPE' 'SOMM' 4.", "MASQ (PROG 1. 5.) 'SUPE' 4. 'SOMM'"),
        (_CURVES, "BORN F 1 'MAXI' 1. 2 'MINI' 0.", "BORN 1 'MAXI' 1. F 2 'MINI' 0."),
        (_CURVES, "E COUL ROUG", "COUL 'ROUG' E"),
    ],
)
def test_the_order_of_operands_is_free(printed, before, usual, odd):
    assert printed(f"{before}LIST ({odd}) ;") == printed(f"{before}LIST ({usual}) ;")


@pytest.mark.parametrize(
    ("statement", "says"),
    [
        ("LIST (POSI 'DANS' 'DANS' (MOTS 'X' 'DANS')) ;", "Integer of value: 2"),
        ("LIST (POSI 'NOCA' 'DANS' (MOTS 'noca' 'NOCA')) ;", "Integer of value: 2"),
        (
            "T = TABL ; T . 'DECR' = PROG 2. 1. ; U = ORDO T 'DECR' ; LIST (EXTR (U . 'DECR') 1) ;",
            "Real of value:   1.00000000000000E+00",
        ),
        ("LIST 'RESU' ;", "Word of 4 characters: RESU"),
        ("LIST '*' ;", "Word of 1 character: *"),
        ("X = 3 ; LIST *ENTIER ;", "  X                        ENTIER   3"),
    ],
)
def test_words_that_are_spelt_like_keywords_are_operands_where_operands_stand(
    printed, statement, says
):
    assert printed(statement)[-1] == says


def test_a_file_may_be_called_like_an_option(found):
    read = found(
        "OPTI SORT 'debut.csv' ; SORT 'EXCE' (PROG 1. 2.) (PROG 3. 4.) ; "
        "T = LIRE 'CSV' 'debut.csv' 'DEBU' 2 'LIGN' ; X = EXTR (T . 1) 2 ;",
        "X",
    )
    assert read == 4.0


_TABLE = "T = TABL ; T . 'A' = PROG 3. 1. 2. 1. ; T . 'B' = LECT 30 10 20 11 ; "


@pytest.mark.parametrize("odd", ["'DECR' T 'A'", "T 'DECR' 'A'", "T 'A' 'DECR'"])
def test_a_table_is_sorted_whatever_the_place_of_the_word(found, odd):
    table = found(_TABLE + f"U = ORDO {odd} ;", "U")
    assert table.get("A").values.tolist() == [3, 2, 1, 1]
    assert table.get("B").values.tolist() == [30, 20, 10, 11]


@pytest.mark.parametrize("phrase", ["T 'A' 'UNIQ'", "'UNIQ' 0.2 T 'A'", "T 'UNIQ' 'A'"])
def test_the_only_list_of_a_table_loses_its_doubles(found, phrase):
    table = found(f"T = TABL ; T . 'A' = PROG 3. 1. 2. 1. ; U = ORDO {phrase} ;", "U")
    assert table.get("A").values.tolist() == [1, 2, 3]


def test_doubles_are_dropped_by_value_where_absolute_values_sort(found):
    made = found("L = ORDO (PROG 2. 1. -1. 1. -1. 2.) 'ABSO' 'UNIQ' ;", "L")
    assert made.values.tolist() == [1, -1, 2]


def test_lists_of_a_table_go_to_their_cheapest_places(found):
    # costs 1 1 are off the diagonal: the two lists are swapped
    total, table = found(
        "T = TABL ; T . 'A' = LECT 10 20 ; T . 'B' = MOTS 'X' 'Y' ; "
        "N U = ORDO T 'COUT' (LECT 5 1 1 5) 'HONG' ;",
        "N", "U",
    )  # fmt: skip
    assert total == 2
    assert table.get("A").values.tolist() == [20, 10]
    assert table.get("B").values == ["Y", "X"]


@pytest.mark.parametrize("phrase", ["L M 'ET'", "L 'ET' M"])
def test_all_words_of_a_list_are_looked_for_whatever_the_place_of_the_word(found, phrase):
    lists = "L = MOTS 'A' 'B' ; M = MOTS 'A' 'C' ; "
    assert found(lists + f"X = EXIS {phrase} ;", "X") is False
    assert found(lists + f"X = EXIS {phrase.replace('ET', 'OU')} ;", "X") is True
