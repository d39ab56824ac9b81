"""Making, searching, sorting and changing lists against Python's own lists."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from script_runs import ran

from ssilang.cli.run import run_text
from ssilang.operators.lists import progressions

INTEGERS = st.lists(st.integers(-99, 99), min_size=1, max_size=15)
WORDS = st.lists(st.text("ABCab", min_size=1, max_size=4), min_size=1, max_size=10)


def value(script):
    return ran(f"X = {script} ;").session.root.find("X")


def items(script):
    made = value(script).values
    return made.tolist() if isinstance(made, np.ndarray) else [str(w) for w in made]


def lect(numbers):
    return "(LECT " + " ".join(str(n) for n in numbers) + ")"


def mots(words):
    return "(MOTS " + " ".join(f"'{w}'" for w in words) + ")"


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("PROG 1. 2. PAS -2. -6. 2. 3 * 9. PAS 2. 3. * 13.",
         [1, 2, 0, -2, -4, -6, 2, 9, 9, 9, 11, 13, 13, 13]),
        ("PROG 1. PAS 2. NPAS 2", [1, 3, 5]),
        ("PROG 1. PAS 1. GEOM 2. 8.", [1, 2, 4, 8]),
        ("PROG 1. PAS 1. GEOM 2. NPAS 3", [1, 2, 4, 8]),
        ("PROG 1. PAS 1. GEOM 2. 9.", [1, 15 / 7, 31 / 7, 9]),
        ("PROG 0. PAS 1. GEOM 2. 6.", [0, 2, 6]),
        ("PROG 0. PAS 1. GEOM 0.5 1.5", [0, 1, 1.5]),
        ("PROG 0. PAS 1. GEOM 0.5 3.", [0, 3]),
        ("PROG 0. PAS 5. GEOM 2. 3.", [0, 3]),
        ("PROG 0. PAS 0.3 1.", [0, 1 / 3, 2 / 3, 1]),
        ("PROG 2. PAS -1. 2.", [2, 2]),
        ("PROG 0.3 PAS -0.1 (0.1 + 0.2)", [0.3, 0.3]),
        ("PROG", []),
        ("LECT 1 2 PAS -2 NPAS 4 2 3 * 9 PAS 2 3 * 13",
         [1, 2, 0, -2, -4, -6, 2, 9, 9, 9, 11, 13, 13, 13]),
        ("LECT 1 PAS 2 5", [1, 3, 5]),
        ("MOTS 2 * 'BLEU' 'ROUG'", ["BLEU", "BLEU", "ROUG"]),
        ("PROG 'LINE' 'A' 2. 'B' 1. (PROG 0. 1.)", [1, 3]),
    ],
)  # fmt: skip
def test_list_is_made_as_its_notice_says(phrase, expected):
    made = items(phrase)
    if expected and isinstance(expected[0], str):
        assert made == expected
    else:
        np.testing.assert_allclose(made, expected, rtol=1e-14)


def test_sine_of_a_list_has_frequency_phase_and_amplitude():
    t = np.linspace(0, 1, 11)
    made = items("PROG 'SINU' 2. 'PHAS' 30. 'AMPL' 3. (PROG 0. PAS 0.1 1.)")
    np.testing.assert_allclose(made, 3 * np.sin(2 * np.pi * 2 * t + np.pi / 6), atol=1e-13)


@pytest.mark.parametrize("steps", ["0. PAS -1. 5.", "5. PAS 1. 0.", "0. PAS 0. 1.",
                                   "0. PAS -1. GEOM 2. 8."])  # fmt: skip
def test_steps_that_never_reach_their_end_leave_start_and_end(steps):
    start, end = steps.split()[0], steps.split()[-1]
    result = run_text(f"L = PROG {steps} 7. ;")
    assert list(result.session.root.find("L").values) == [float(start), float(end), 7.0]
    assert [w.code for w in result.session.warnings] == ["operators.lists.steps-left-out"]


@given(INTEGERS, INTEGERS)
@settings(max_examples=25, deadline=None)
def test_union_concatenates(a, b):
    assert items(f"{lect(a)} ET {lect(b)}") == a + b


def test_union_makes_lists_of_numbers():
    assert items("1 ET 2") == [1, 2]
    assert items("1 ET 2.5") == [1.0, 2.5]
    assert items("(LECT 1) ET (PROG 2.5)") == [1.0, 2.5]
    assert items("ET 'A' (MOTS 'B')") == ["A", "B"]


@given(INTEGERS)
@settings(max_examples=25, deadline=None)
def test_sorting_agrees_with_python(numbers):
    assert items(f"ORDO {lect(numbers)}") == sorted(numbers)
    assert items(f"ORDO {lect(numbers)} 'DECR'") == sorted(numbers, reverse=True)
    assert items(f"ORDO {lect(numbers)} 'ABSO'") == sorted(numbers, key=abs)
    assert items(f"ORDO {lect(numbers)} 'UNIQ'") == sorted(set(numbers))
    assert items(f"UNIQ {lect(numbers)}") == list(dict.fromkeys(numbers))
    assert items(f"INVE {lect(numbers)}") == numbers[::-1]


@given(WORDS)
@settings(max_examples=25, deadline=None)
def test_sorting_of_words_puts_capitals_first_unless_told(words):
    assert items(f"ORDO {mots(words)}") == sorted(words)
    assert items(f"ORDO {mots(words)} 'NOCA'") == sorted(words, key=str.upper)


@given(INTEGERS)
@settings(max_examples=25, deadline=None)
def test_other_lists_follow_the_order_of_the_first(numbers):
    result = run_text(f"A B = ORDO {lect(numbers)} {lect(range(len(numbers)))} ;")
    order = result.session.root.find("B").values
    assert [numbers[i] for i in order] == sorted(numbers)


def test_cheapest_permutation_is_found():
    result = run_text(
        "P L = ORDO (LECT 10 20 30) 'COUT' (PROG 9. 1. 9. 9. 9. 1. 1. 9. 9.) 'HONG' ;"
    )
    assert result.session.root.find("P") == 3.0
    assert result.session.root.find("L").values.tolist() == [20, 30, 10]


@given(INTEGERS, st.data())
@settings(max_examples=25, deadline=None)
def test_items_are_taken_removed_and_inserted_by_place(numbers, data):
    place = data.draw(st.integers(1, len(numbers)))
    assert value(f"EXTR {lect(numbers)} {place}") == numbers[place - 1]
    assert items(f"ENLE {lect(numbers)} {place}") == numbers[: place - 1] + numbers[place:]
    expected = [*numbers[: place - 1], 7, *numbers[place - 1 :]]
    assert items(f"INSE {lect(numbers)} {place} 7") == expected
    assert value(f"DIME {lect(numbers)}") == len(numbers)
    assert value(f"SOMM {lect(numbers)}") == sum(numbers)


def test_replacing_changes_the_list_for_all_its_names_but_not_a_copy(found):
    first, second, copy = found(
        "A = PROG 1. 2. 3. ; B = A ; C = COPI A ; REMP A 2 9. ; REMP A (LECT 1 3) 0. ;",
        "A", "B", "C",
    )  # fmt: skip
    assert first.values.tolist() == second.values.tolist() == [0, 9, 0]
    assert copy.values.tolist() == [1, 2, 3]


def test_replacing_in_a_word_makes_a_new_one():
    assert value("REMP 'a_b_c' '_' '-'") == "a-b-c"


@pytest.mark.parametrize(
    ("phrase", "expected"),
    [
        ("POSI 3 'DANS' (LECT 5 3 3)", 2),
        ("POSI 4 'DANS' (LECT 5 3 3)", 0),
        ("POSI 1.05 'DANS' (PROG 0. 1.) 0.1", 2),
        ("POSI 'uy' 'DANS' (MOTS 'UX' 'UY') 'NOCA'", 2),
        ("POSI 'an' 'DANS' 'banana'", 2),
    ],
)
def test_place_of_an_item(phrase, expected):
    assert value(phrase) == expected


def test_all_places_and_places_of_several():
    assert items("POSI 3 'DANS' (LECT 5 3 3) 'TOUS'") == [2, 3]
    assert items("POSI 'a' 'DANS' 'banana' 'TOUS'") == [2, 4, 6]
    assert items("POSI (LECT 5 8) 'DANS' (LECT 4 5)") == [2, 0]


def test_subtracting_and_testing_lists():
    assert items("(LECT 1 2 3 4) SAUF (LECT 2 4)") == [1, 3]
    assert value("DANS (PROG 1. 2.) 2.") is True
    assert value("DANS 'QUEL' (PROG 2. 1.) (PROG 1. 2. 3.)") is True
    assert value("DANS 'SEQU' (PROG 2. 1.) (PROG 1. 2. 3.)") is False


def test_list_of_objects_holds_one_type(refused):
    assert value("DIME (ENUM (PROG 1.) (PROG 2.))") == 2
    assert "one type" in refused("L = ENUM (PROG 1.) «'word'» ;")


def test_ten_thousand_appends():
    script = "L = PROG ; M = MOTS ; REPE B 10000 ; L = L ET 1. ; M = M ET 'UX' ; FIN B ;"
    result = run_text(script)
    assert len(result.session.root.find("L")) == len(result.session.root.find("M")) == 10000


def test_lists_of_objects_join_objects_of_their_type(found, refused):
    script = "L = (ENUM (PROG 1.)) ET (PROG 2. 3.) ; N = DIME L ; S = SOMM (EXTR L 2) ;"
    size, sum_ = found(script, "N", "S")
    assert (size, sum_) == (2, 5.0)
    assert "one type" in refused("L = (ENUM (PROG 1.)) «ET» 'a' ;")


def test_lists_of_objects_that_would_fill_the_memory_are_refused(refused, monkeypatch):
    monkeypatch.setattr(progressions, "LONGEST", 1_000_000)  # objects take a while to be made
    told = refused("L = ENUM (PROG 1.) ; REPE B 60 ; L = L «ET» L ; FIN B ;")
    assert "too long, the limit is 1000000" in told


def test_steps_at_the_head_of_a_list_start_from_a_zero_left_out(found):
    reals, integers = found("A = PROG PAS 0.5 2. 7. ; B = LECT PAS 2 NPAS 3 ;", "A", "B")
    assert list(reals.values) == [0.5, 1.0, 1.5, 2.0, 7.0]
    assert list(integers.values) == [2, 4, 6]


def test_each_operand_loses_its_doubles():
    result = ran(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0 0) (1 0) ; "
        "A B C = UNIQ (PROG 0.3 (0.1 + 0.2) 1. 1.05 1.) (LECT 3 3 1) (L ET (INVE L)) ; "
        "E = UNIQ 0.1 (PROG 1. 2. 1.05) ;"
    )
    a, b, c, e = map(result.session.root.find, "ABCE")
    assert a.values.tolist() == [0.3, 1.0, 1.05]  # 0.1 + 0.2 is 0.3 but for rounding
    assert (b.values.tolist(), c.n_cells) == ([3, 1], 2)
    assert e.values.tolist() == [1.0, 2.0]


def test_places_may_stand_before_a_list_of_another_type(found):
    words, reals, integers = found(
        "W = ENLE (LECT 1 3) (MOTS 'A' 'B' 'C') ; R = ENLE (LECT 2) (PROG 4. 5. 6.) ; "
        "I = ENLE (LECT 1 3 7) (LECT 2 3) ;", "W", "R", "I",
    )  # fmt: skip
    assert [str(w) for w in words.values] == ["B"]
    assert reals.values.tolist() == [4.0, 6.0]
    assert integers.values.tolist() == [1]  # of two alike the first is the list


def test_values_of_fields_on_one_point_need_no_point(found, refused):
    script = (
        "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; C = MANU 'CHPO' P 'T' 3. 'Q' 1. ; "
        "L = SUIT C (2. * C) ; "
    )
    both, one = found(script + "A = EXTR L 'VALE' ; B = EXTR L 'VALE' 'Q' ;", "A", "B")
    assert both.values.tolist() == [3.0, 6.0, 1.0, 2.0]
    assert one.values.tolist() == [1.0, 2.0]
    two = script + "D = MANU 'CHPO' Q 'T' 3. 'Q' 1. ; A = EXTR «(SUIT C D)» 'VALE' ;"
    assert "stand on 2 points" in refused(two)
    assert found(script + "A = EXTR L 'VALE' 'T' Q ;", "A").values.tolist() == [0.0, 0.0]
    assert "no component" in refused(script + "A = EXTR L 'VALE' 'X' Q ;")


def test_type_of_the_objects_of_a_list(found):
    numbers, meshes = found(
        "OPTI DIME 2 ELEM SEG2 ; A = EXTR (ENUM 7 8) 'TYPE' ; "
        "B = EXTR 'TYPE' (ENUM (DROI 1 (0. 0.) (1. 0.))) ;", "A", "B",
    )  # fmt: skip
    assert (str(numbers), str(meshes)) == ("ENTIER  ", "MAILLAGE")


@pytest.mark.parametrize(("count", "reals", "integers"), [(0, [2.0], [3]), (1, [2.0, 2.5], [3, 5])])
def test_no_steps_leave_the_first_value(count, reals, integers):
    result = ran(f"A = PROG 2. 'PAS' 0.5 'NPAS' {count} ; B = LECT 3 'PAS' 2 'NPAS' {count} ;")
    assert result.session.root.find("A").values.tolist() == reals
    assert result.session.root.find("B").values.tolist() == integers
