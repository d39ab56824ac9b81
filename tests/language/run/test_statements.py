"""Section 4: names, equal sign, parentheses, results."""

from ssilang.language.values import ListReel


def test_results_go_to_the_names_from_left_to_right(run):
    script = run("a b c1 = 1 2. 'x' ;")
    assert (script["a"], script["b"], script["c1"]) == (1, 2.0, "x")


def test_a_result_without_a_name_is_dropped(run):
    script = run("x = 5 ; 1 + 2 ; y = 4 ;")
    assert (script["x"], script["y"]) == (5, 4)


def test_a_result_in_excess_is_an_error(fails):
    assert fails("x = 1 «2» ;") == "excess"


def test_a_name_without_a_result_is_an_error(fails):
    assert fails("x «y» = 1 ;") == "no-result"


def test_a_name_may_ask_for_a_type(run):
    script = run("a*FLOTTANT b = 1 2. ;")
    assert script["a"] == 2.0
    assert script["b"] == 1


def test_innermost_parenthesis_runs_first(run):
    assert run("x = 2 * (3 + (4 * (1 + 1))) ;")["x"] == 22


def test_all_parentheses_run_even_when_the_answer_is_known(fails):
    assert fails("SI (FAUX ET ((«1 / 0») > 1)) ; FINSI ;") == "arithmetic"


def test_a_parenthesis_without_result_vanishes(run):
    assert run("x = (MESS 'hello') 3 ;")["x"] == 3


def test_parentheses_stand_on_the_left_of_a_table_access(run):
    assert run("t = TABL ; t . 'S' = TABL ; (t . 'S') . 0 = 5 ; x = t . 'S' . 0 ;")["x"] == 5


def test_assignment_shares_the_object(run):
    assert run("t = TABL ; u = t ; u . 1 = 4 ; x = t . 1 ;")["x"] == 4


def test_a_name_may_change_its_type(run):
    assert isinstance(run("x = 1 ; x = PROG 1. ;")["x"], ListReel)


def test_two_equal_signs_are_an_error(fails):
    assert fails("x = y «=» 2 ;") == "second-equal"


def test_unbalanced_parentheses_are_errors(fails):
    assert fails("x = «(»1 + 2 ;") == "unclosed-paren"
    assert fails("x = 1 + 2«)» ;") == "extra-paren"


def test_a_failed_statement_stops_the_script(tmp_path):
    from ssilang.cli.run import run_text

    result = run_text("x = 1 ; y = 1 / 0 ; x = 2 ;", output_directory=tmp_path)
    assert result.session.root.find("X") == 1
    assert result.errors[0].span.source.position(result.errors[0].span.start)[0] == 1
