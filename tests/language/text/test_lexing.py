"""Sections 1 and 2 of the language: characters, lines, comments, words, numbers, strings."""

import pytest

from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Name, Number, Quoted, Symbol


def items(text: str):
    (statement,) = parse(Source("test", text)).body
    return statement.items


def numbers(text: str):
    return [i.value for i in items(text) if isinstance(i, Number)]


def test_star_in_first_column_makes_a_comment(run):
    assert run("x = 1 ;\n* y = 2 ; 'open quote (\nz = 3 ;")["z"] == 3


def test_comment_line_inside_an_unfinished_statement_is_dropped(run):
    assert run("x = 1 +\n* a remark\n 2 ;")["x"] == 3


def test_runs_of_stars_in_first_column_are_comments(run):
    assert run("**** title ****\n*-----\n*\nx = 4 ;")["x"] == 4


def test_star_in_any_other_column_multiplies(run):
    assert run("x = 2\n * 3 ;")["x"] == 6


def test_library_separator_lines_are_skipped(run):
    assert run("$$$$ NAME\nx = 1 ;")["x"] == 1


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_utf8_and_latin1_files_keep_their_accents(tmp_path, encoding):
    from ssilang.cli.run import run_file

    path = tmp_path / "accents.dgibi"
    path.write_bytes("* déjà vu\nx = 'é à ç' ;\n".encode(encoding))
    assert run_file(path).session.root.find("X") == "é à ç"


def test_windows_line_ends_are_read(run):
    assert run("x = 1 ;\r\n* comment\r\ny = 2 ;\r\n")["y"] == 2


def test_tabs_are_blanks(run):
    assert run("x\t=\t1\t+\t2 ;")["x"] == 3


def test_long_lines_have_no_limit(run):
    assert run("x = 0" + " + 1" * 500 + " ;")["x"] == 500


def test_empty_statements_do_nothing(run):
    assert run(";; x = 1 ; ; ;")["x"] == 1


def test_several_statements_share_a_line_and_one_spans_lines(run):
    script = run("x = 1 ; y = 2 ; z =\n\n 3\n;")
    assert (script["x"], script["y"], script["z"]) == (1, 2, 3)


def test_end_of_file_without_fin_ends_the_run(run):
    assert run("x = 1 ;\n\n")["x"] == 1


def test_fin_without_semicolon_at_the_end_is_accepted(run):
    assert run("x = 1 ;\nFIN")["x"] == 1


def test_semicolon_inside_a_string_does_not_end_the_statement(run):
    assert run("x = 'a ; b' ;")["x"] == "a ; b"


def test_names_fold_to_capitals_and_strings_keep_their_case(run):
    script = run("Abc = 'MiXed' ;")
    assert script["ABC"] == "MiXed"


def test_doubled_quote_is_a_quote(run):
    assert run("x = 'l''axe' ;")["x"] == "l'axe"


def test_empty_string_is_a_word_of_no_characters(run):
    assert run("x = '' ;")["x"] == ""


def test_double_quote_is_an_ordinary_character(run):
    assert run("""x = 'say "yes"' ;""")["x"] == 'say "yes"'


def test_string_over_a_line_end_is_joined_with_one_blank(run):
    assert run("x = 'first   \nsecond' ;")["x"] == "first second"


@pytest.mark.parametrize("word", ["ABC_1", "@PROC", "&LOOP", "!GLOB", "#1"])
def test_words_take_underscores_and_special_first_characters(word):
    (item,) = items(f"{word} ;")
    assert isinstance(item, Name)
    assert item.text == word


def test_a_hyphen_is_never_part_of_a_word(run):
    assert run("ti = 5 ; temp0 = 3 ; x = TI-TEMP0 ;")["x"] == 2


def test_names_keep_24_characters(run):
    script = run("A23456789012345678901234XY = 1 ; y = A23456789012345678901234ZZ ;")
    assert script["y"] == 1


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.", 1.0), (".5", 0.5), ("1.5", 1.5), ("200e9", 2e11), ("2E11", 2e11),
        ("1.D-3", 1e-3), ("2D-3", 2e-3), ("5.E-3", 5e-3), ("1.e+2", 100.0), ("-1.", -1.0),
        ("-.5", -0.5), ("+3.", 3.0),
    ],
)  # fmt: skip
def test_reals_are_written_with_a_dot_or_an_exponent(text, value):
    found = numbers(f"X {text} ;")
    assert found == [value]
    assert isinstance(found[0], float)


@pytest.mark.parametrize(("text", "value"), [("12", 12), ("-3", -3), ("+7", 7), ("007", 7)])
def test_integers_are_digits_with_a_sign(text, value):
    found = numbers(f"X {text} ;")
    assert found == [value]
    assert isinstance(found[0], int)


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


def test_signs_may_be_quoted(run):
    script = run("a = 3 ; x = (a '-' 1) ; y = (a '<' 4) ;")
    assert script["x"] == 2
    assert script["y"] is True


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
