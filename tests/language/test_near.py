"""Near names: fewest slips, a swap being one."""

from together import together

from ssilang.language.cast3m import find_cast3m_word
from ssilang.language.search import likeness, nearest, nearest_names, slips


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
