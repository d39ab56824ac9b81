"""A word's meanings: however it is typed, and whose they are."""

from together import together

from ssilang.language import vocabulary


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
