"""Sections 1 and 2 of the language: characters, lines, comments, words, numbers, strings."""

import pytest
from together import together

from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Name, Number, Quoted, Symbol


def items(text: str):
    (statement,) = parse(Source("test", text)).body
    return statement.items


def numbers(text: str):
    return [i.value for i in items(text) if isinstance(i, Number)]


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_utf8_and_latin1_files_keep_their_accents(tmp_path, encoding):
    from ssilang.cli.run import run_file

    path = tmp_path / "accents.dgibi"
    path.write_bytes("* déjà vu\nx = 'é à ç' ;\n".encode(encoding))
    assert run_file(path).session.root.find("X") == "é à ç"


@together("word", ["ABC_1", "@PROC", "&LOOP", "!GLOB", "#1"])
def test_words_take_underscores_and_special_first_characters(word):
    (item,) = items(f"{word} ;")
    assert isinstance(item, Name)
    assert item.text == word


@together(
    "text, value",
    [
        ("1.", 1.0), (".5", 0.5), ("1.5", 1.5), ("200e9", 2e11), ("2E11", 2e11),
        ("1.D-3", 1e-3), ("2D-3", 2e-3), ("5.E-3", 5e-3), ("1.e+2", 100.0), ("-1.", -1.0),
        ("-.5", -0.5), ("+3.", 3.0), ("2.7e-2 .", 0.027), ("2D-3 . ", 2e-3),
        ("12", 12), ("-3", -3), ("+7", 7), ("007", 7),
    ],
)  # fmt: skip
def test_integers_are_digits_with_a_sign_reals_have_a_dot_or_an_exponent(text, value):
    found = numbers(f"X {text} ;")
    assert found == [value]
    assert isinstance(found[0], type(value))


@together(
    "text, read",
    [("X 12.5E-3 -50E-3 ;", [12.5e-3, -50e-3]), ("X PAS -2. -6. ;", [-2.0, -6.0]),
     ("SECT .5 ;", [0.5]), ("ELIM .001 VOL ;", [0.001])],
)  # fmt: skip
def test_signs_and_dots_behind_a_blank_begin_numbers(text, read):
    assert numbers(text) == read


def test_two_character_signs_are_one_item():
    found = [i.text for i in items("A ** B >EG C <EG D ;") if isinstance(i, Symbol)]
    assert found == ["**", ">EG", "<EG"]


def test_quoted_items_stay_strings():
    assert isinstance(items("'ABC' 3 ;")[0], Quoted)


def test_a_dot_behind_a_blank_wants_an_index():
    with pytest.raises(SeveralErrors) as told:
        items("x = t . ;")
    assert [e.code for e in told.value.errors] == ["nothing-behind"]
