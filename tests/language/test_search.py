"""Words: search, near names, meanings, types compared on eight letters, one operator a name."""

import pytest
from script_runs import ran
from together import together

from ssilang.language import vocabulary
from ssilang.language.cast3m import find_cast3m_word
from ssilang.language.registry import OPERATORS, shared
from ssilang.language.search import Item, fold, likeness, nearest, nearest_names, search, slips
from ssilang.operators.loader import prepare_operators

_ITEMS = [
    Item("VIBR", "operator", "Modes of vibration", "Modes of vibration; modes propres"),
    Item("MODE", "operator", "Gives a mesh its elements", "the law"),
    Item("JOINT_SDM", "law", "Joint that opens (uplift)", "Joint qui s'ouvre (décollement)"),
    Item("TRAC", "operator", "Draws meshes", "the modes of a table are drawn too"),
]


def _found(query):
    return [i.name for i in search(query, _ITEMS)]


def test_accents_and_capitals_count_for_nothing():
    assert fold("Décollement") == "decollement"
    assert fold("M²") == "m2"
    assert _found("DECOLLEMENT") == _found("décollement") == ["JOINT_SDM"]


def test_a_summary_comes_before_a_text():
    assert _found("modes")[0] == "VIBR"
    assert "TRAC" in _found("modes")


def test_a_part_of_a_name_is_found():
    assert _found("sdm") == ["JOINT_SDM"]


def test_all_words_of_a_query_must_fit():
    assert _found("modes drawn") == ["TRAC"]
    assert _found("uplift vibration") == []


def test_nothing_is_found_for_nothing():
    assert _found("") == []
    assert _found("zzzz") == []


@together("word", ["YOUN", "PLAN", "KN", "CONT"])
def test_meanings_do_not_depend_on_how_a_word_is_typed(word):
    found = vocabulary.all_meanings(word)
    assert found
    for typed in (word.lower(), f" {word}  ", word.capitalize()):
        assert vocabulary.all_meanings(typed) == found


def test_values_of_options_are_found_by_name_and_by_four_letters_with_their_option():
    options = [o for o in vocabulary.words("option") if getattr(o, "values", ())]
    assert options
    for option in options:
        for value in option.values:
            for typed in (value.name, value.name[:4].lower()):
                found = [w for kind, w in vocabulary.all_meanings(typed) if kind == "value"]
                assert any(w.of == (option.name,) and w.name == value.name for w in found)
    assert not [w for kind, w in vocabulary.all_meanings("ZZZZ") if kind == "value"]


@together(
    "said, meant, count",
    [("RESO", "RESO", 0), ("RSEO", "RESO", 1), ("DORI", "DROI", 1), ("DRO", "DROI", 1),
     ("DROIX", "DROI", 1), ("DRAI", "DROI", 1), ("", "DROI", 4), ("CA", "ABC", 3)],
)  # fmt: skip
def test_slips_of_the_fingers(said, meant, count):
    assert slips(said, meant) == slips(meant, said) == count


def test_likeness_is_the_part_of_letters_that_agree():
    assert likeness("RSEO", "RESO") == 0.75
    assert likeness("", "") == 1.0


def test_swapped_letters_come_before_other_slips():
    assert nearest("RSEO", ["RSET", "RESO", "SEO"]) == "RESO"
    assert nearest("DORI", ["DORE", "DROI"]) == "DROI"


def test_of_names_as_near_the_one_that_begins_alike_comes_first():
    assert nearest_names("PROD", ["POD", "BROD", "PROG"]) == ["PROG", "POD", "BROD"]


def test_a_word_unlike_all_has_no_near_name():
    assert nearest("ZZZZ", ["RESO", "DROI"]) == ""


@together(
    "said, name",
    [("EXTRAIRE", "EXTR"), ("extr", "EXTR"), ("CTOD", "CTOD"), ("CTODX", None),
     ("@CARENE", "@CARENE"),
     ("@CAR", None), ("NOWORD", None)],
)  # fmt: skip
def test_an_operator_is_named_by_four_letters_and_a_procedure_in_full(said, name):
    assert getattr(find_cast3m_word(said), "name", None) == name


def test_a_second_operator_of_one_name_is_no_operator():
    prepare_operators()
    known = OPERATORS["ZOND"]
    with pytest.raises(ValueError, match="ZOND is declared twice"):
        shared("ZOND", "curves", "another")
    assert OPERATORS["ZOND"] is known


def test_a_longer_type_word_of_a_parameter_is_cut() -> None:
    script = "DEBP F L1*'LISTREELS' N1/ENTIERS ; N2 = DIME L1 ; FINP N2 ; X = F (PROG 1. 2.) ;"
    result = ran(script)
    assert result.session.root.find("X") == 2
