"""Section 10: procedures."""

import pytest

_SUM = (
    "DEBP SUM2 a*FLOTTANT b/FLOTTANT ; SI (EXIS b) ; r = a + b ; SINON ; r = a ; FINSI ; FINP r ;"
)


def test_mandatory_and_optional_arguments(run):
    script = run(_SUM + "x = SUM2 1. 2. ; y = SUM2 1. ;")
    assert (script["x"], script["y"]) == (3.0, 1.0)


def test_a_missing_mandatory_argument_is_an_error(fails):
    assert fails(_SUM + "x = SUM2 «'a'» ;") == "missing-parameter"


def test_an_integer_passes_as_a_real(run):
    assert isinstance(run("DEBP P a*FLOTTANT ; FINP a ; x = P 3 ;")["x"], float)


def test_arguments_are_matched_by_type(run):
    text = "DEBP P t*TABLE n*ENTIER ; t . n = 1 ; FINP ; u = TABL ; P 4 u ; x = u . 4 ;"
    assert run(text)["x"] == 1


def test_an_untyped_argument_takes_anything(run):
    script = run("DEBP P a ; FINP a ; x = P 'w' ; y = P 3. ;")
    assert (script["x"], script["y"]) == ("w", 3.0)


def test_an_argument_may_ask_for_a_subtype(run, fails):
    text = "DEBP P t*TABLE*MODAL ; FINP 1 ; t1 = TABL 'MODAL' ; t2 = TABL ;"
    assert run(text + "x = P t1 ;")["x"] == 1
    assert fails(text + "x = P «t2» ;") == "missing-parameter"


def test_types_may_be_quoted(run):
    assert run("DEBP P a*'ENTIER' b/'MOT' ; FINP a ; x = P 2 ;")["x"] == 2


def test_a_missing_argument_hides_an_outer_object(run):
    text = "b = 5. ; DEBP P a*ENTIER b/FLOTTANT ; r = EXIS b ; FINP r ; x = P 1 ;"
    assert run(text)["x"] is False


def test_names_of_the_caller_are_seen_and_not_changed(run):
    script = run("g = 1 ; DEBP P ; g = g + 1 ; FINP g ; x = P ; y = g ;")
    assert (script["x"], script["y"]) == (2, 1)


def test_scope_is_that_of_the_caller(run):
    text = "DEBP INNER ; FINP v ; DEBP OUTER ; v = 2 ; r = INNER ; FINP r ; v = 1 ; x = OUTER ;"
    assert run(text)["x"] == 2


def test_names_that_begin_with_an_exclamation_mark_are_not_inherited(run):
    text = "!g = 1 ; DEBP P ; r = TYPE !g ; FINP r ; x = P ;"
    assert run(text)["x"].rstrip() == "MOT"


def test_assignments_vanish_at_the_end(run):
    assert run("DEBP P ; local = 4 ; FINP ; P ; x = TYPE local ;")["x"].rstrip() == "MOT"


def test_several_results(run):
    script = run("DEBP P ; FINP 1 2. 'c' ; a b c1 = P ;")
    assert (script["a"], script["b"], script["c1"]) == (1, 2.0, "c")


def test_resp_queues_results_before_those_of_finp(run):
    script = run("DEBP P ; RESP 1 ; RESP 2 ; FINP 3 ; a b c1 = P ;")
    assert (script["a"], script["b"], script["c1"]) == (1, 2, 3)


def test_argu_reads_further_arguments(run):
    text = "DEBP P ; s = 0 ; REPE b ; ARGU n/ENTIER ; SI (NON (EXIS n)) ; QUIT b ; FINSI ;"
    assert run(text + "s = s + n ; FIN b ; FINP s ; x = P 1 2 3 ;")["x"] == 6


def test_recursion(run):
    text = "DEBP FACT n*ENTIER ; SI (n <EG 1) ; r = 1 ; SINON ; r = n * (FACT (n - 1)) ; FINSI ;"
    assert run(text + "FINP r ; x = FACT 10 ;")["x"] == 3628800


def test_endless_recursion_is_an_error(fails):
    assert fails("DEBP P ; «P» ; FINP ; P ;") == "recursion"


def test_quit_leaves_a_procedure_and_returns_its_results(run):
    assert run("DEBP P ; r = 1 ; QUIT P ; r = 2 ; FINP r ; x = P ;")["x"] == 1


def test_a_procedure_is_a_value(run):
    assert run("DEBP P a*ENTIER ; r = a + 1 ; FINP r ; q = MOT P ; x = q 2 ;")["x"] == 3


def test_a_procedure_is_an_argument(run):
    text = "DEBP F a*ENTIER ; r = a * 3 ; FINP r ; DEBP CALL p*PROCEDUR ; r = p 5 ; FINP r ;"
    assert run(text + "x = CALL F ;")["x"] == 15


def test_a_procedure_can_be_redefined(run):
    assert run("DEBP P ; FINP 1 ; DEBP P ; FINP 2 ; x = P ;")["x"] == 2


@pytest.mark.parametrize(("call", "value"), [("8 MODU 3", 2), ("MODU 8 3", 2)])
def test_infix_calls(run, call, value):
    text = "DEBP MODU a*ENTIER b*ENTIER ; r = a - (a / b * b) ; FINP r ;"
    assert run(f"{text} x = {call} ;")["x"] == value


def test_a_call_is_found_only_before_the_first_word(run):
    text = "DEBP P a*ENTIER ; r = a * 10 ; FINP r ;"
    script = run(text + "x = P 2 + 1 ; y = 1 + (P 2) ;")
    assert (script["x"], script["y"]) == (21, 21)


def test_a_procedure_name_is_compared_in_full(fails):
    assert fails("DEBP PASSPORT a*ENTIER ; FINP a ; x = «PASS» 1 ;") == "unknown-operator"


def test_a_procedure_must_be_defined_before_it_is_called(fails):
    assert fails("x = «LATER» 1 ; DEBP LATER a*ENTIER ; FINP a ;") == "set-later"


def test_at_procedures_are_found_beside_the_deck(tmp_path):
    from ssilang.cli.run import run_file

    (tmp_path / "@twice.procedur").write_text("DEBP @TWICE a*ENTIER ; r = 2 * a ; FINP r ;\n")
    deck = tmp_path / "deck.dgibi"
    deck.write_text("x = @twice 4 ;\n")
    assert run_file(deck).session.root.find("X") == 8


def test_the_chain_of_calls_is_told(tmp_path):
    from ssilang.cli.run import run_text

    text = "DEBP INNER ; x = 1 / 0 ; FINP ;\nDEBP OUTER ; INNER ; FINP ;\nOUTER ;"
    error = run_text(text, output_directory=tmp_path).errors[0]
    assert [name for name, _ in error.calls] == ["INNER", "OUTER"]


def test_replacing_a_procedure_of_the_library_is_told(tmp_path):
    from ssilang.cli.run import run_text

    text = "DEBP @BILAN t*TABLE ; FINP 7 ; t1 = TABL ; x = @BILAN t1 ;"
    result = run_text(text, output_directory=tmp_path)
    assert result.session.root.find("X") == 7
    assert [w.code for w in result.session.warnings] == ["overrides-procedure"]


def test_a_name_forgotten_in_a_procedure_is_forgotten_there_alone(run):
    script = run(
        "Y = 7 ; DEBP P ; Y = 3 ; OUBL Y ; FINP (TYPE Y) ; DEBP Q ; OUBL Y ; FINP (TYPE Y) ;"
        "A = P ; B = Q ; DEBP R ; OUBL Y ; Y = 4 ; FINP Y ; C = R ;"
    )
    assert [str(script[name]).strip() for name in "AB"] == ["ANNULE", "ANNULE"]
    assert (script["C"], script["Y"]) == (4, 7)


def test_a_forgotten_name_has_no_value_in_a_procedure(run, fails):
    assert fails("Y = 7 ; DEBP P ; OUBL Y ; FINP («Y + 1») ; A = P ;") == "no-rule"
    assert run("Y = 7 ; DEBP P ; FINP (Y + 1) ; A = P ;")["A"] == 8
