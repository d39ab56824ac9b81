"""Search: names, summaries, texts, whatever the accents and the form of the word."""

from ssilang.language.search import Item, fold, search

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
