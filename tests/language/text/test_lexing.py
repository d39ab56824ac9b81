"""Sections 1 and 2 of the language: characters, lines, comments, words, numbers, strings."""

import pytest

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


def test_long_lines_have_no_limit(run):
    assert run("x = 0" + " + 1" * 500 + " ;")["x"] == 500


@pytest.mark.parametrize("word", ["ABC_1", "@PROC", "&LOOP", "!GLOB", "#1"])
def test_words_take_underscores_and_special_first_characters(word):
    (item,) = items(f"{word} ;")
    assert isinstance(item, Name)
    assert item.text == word


@pytest.mark.parametrize(
    ("text", "value"),
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


class TestSignOrOperator:
    """A + or - glued to digits is a sign after a blank, a parenthesis, = or an operator."""

    @pytest.mark.parametrize(
        ("phrase", "value"),
        [("n-1", 4), ("n - 1", 4), ("(n-1)", 4), ("n-1+1", 5), ("n*-1", -5), ("-1*n", -5),
         ("(3-1)", 2), ("(n)-1", 4), ("n - -1", 6)],
    )  # fmt: skip
    def test_value(self, run, phrase, value):
        assert run(f"n = 5 ; x = {phrase} ;")["x"] == value

    def test_a_blank_before_and_none_behind_makes_two_operands(self, fails):
        assert fails("a = 5 ; x = a «-1» ;") == "glued-sign"

    def test_two_signed_numbers_are_two_operands(self):
        assert numbers("X 12.5E-3 -50E-3 ;") == [12.5e-3, -50e-3]

    def test_a_keyword_may_precede_a_signed_number(self):
        assert numbers("X PAS -2. -6. ;") == [-2.0, -6.0]

    def test_there_is_no_minus_on_a_name(self, fails):
        assert fails("a = 5 ; x = «-»a ;") == "two-operands"


def test_two_character_signs_are_one_item():
    found = [i.text for i in items("A ** B >EG C <EG D ;") if isinstance(i, Symbol)]
    assert found == ["**", ">EG", "<EG"]


class TestDot:
    """A dot after a word, string, number or ) separates a table from its index."""

    @pytest.mark.parametrize(
        "access", ["T.1", "T. 1", "T . 1", "T.I", "T . I", "(T).1", "T.(0 + 1)"]
    )
    def test_every_layout_reads_the_element(self, run, access):
        text = f"t = TABL ; t . 1 = 7 ; i = 1 ; x = {access} ;"
        assert run(text)["x"] == 7

    def test_chains_of_indices(self, run):
        assert run("t = TABL ; t . 'A' = TABL ; t.'A'.2 = 9 ; x = t.'A'.2 ;")["x"] == 9

    def test_a_dot_behind_a_blank_and_before_a_digit_begins_a_real(self):
        assert numbers("SECT .5 ;") == [0.5]
        assert numbers("ELIM .001 VOL ;") == [0.001]

    def test_a_real_index_has_blanks_around_the_dot(self, run):
        assert run("t = TABL ; t . 0.5 = 3 ; x = t . 0.5 ;")["x"] == 3


def test_a_comma_is_a_blank(run):
    assert len(run("x = PROG 1., 2., 3. ;")["x"]) == 3


def test_quoted_items_stay_strings():
    assert isinstance(items("'ABC' 3 ;")[0], Quoted)


def test_a_dot_before_a_sign_of_product_separates_nothing(run):
    script = run(
        "a = (6. / 4.).*2. ; b = a.*2. ; c = a./2. ; t = TABL ; t.1 = 3. ; d = t.1*2. ;"
        " e = t.1.*2. ; f = 2.*a ;"
    )
    assert [script[n] for n in "abcdef"] == [3.0, 6.0, 1.5, 6.0, 6.0, 6.0]


@pytest.mark.parametrize("end", [".;", ". ;", ".\n  ;"])
def test_a_dot_before_an_end_separates_nothing(run, end):
    script = run(f"a = 3. ; b = (2. * a.) - (1.) ; c = b{end} t = TABL ; t.1 = c ; d = t.1{end}")
    assert [script[n] for n in "bcd"] == [5.0, 5.0, 5.0]
    made = run(f"OPTI DIME 3 ; l = 4. ; p = 0. 0. l{end} q = (l. / 2.) (l.) l{end}")
    assert list(made["p"].coordinates) == [0.0, 0.0, 4.0]
    assert list(made["q"].coordinates) == [2.0, 4.0, 4.0]


def test_a_dot_behind_a_blank_wants_an_index():
    with pytest.raises(SeveralErrors) as told:
        items("x = t . ;")
    assert [e.code for e in told.value.errors] == ["nothing-behind"]


def test_an_old_script_begins_with_its_beginning(run):
    assert run("DEBUT ; OPTI DIME 2 ; a = 1 ;")["a"] == 1


@pytest.mark.parametrize("end", ["FIN() ;", "'FIN' ( ) ;"])
def test_the_end_of_a_script_may_have_empty_parentheses(run, end):
    assert run(f"a = 1 ; {end} a = 2 ;")["a"] == 1
