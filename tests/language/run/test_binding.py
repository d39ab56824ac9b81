"""Declared forms: what entries read, which form runs, what is said where none fits."""

import io

import pytest

from ssilang.cli.run import RunOptions, run_source
from ssilang.language.registry import (
    OPERATORS,
    Chosen,
    Form,
    Like,
    When,
    arg,
    by,
    choice,
    each,
    either,
    flag,
    group,
    key,
    lead,
    main,
    many,
    named,
    opt,
    said,
    select,
    shared,
)
from ssilang.language.run.results import results_of
from ssilang.language.text.source import Source
from ssilang.language.values import ListEnti, ListMots, ListReel


@pytest.fixture
def declare():
    """Makes an operator ZZZZ for one test; what its forms were given is printed."""
    made = shared("ZZZZ", "test", "")

    def add(*entries, **options):
        def show(**values):
            found.append(values)
            return len(found)

        made.form(*entries, gives="ENTIER", **options)(show)

    found: list[dict] = []
    add.found = found
    yield add
    del OPERATORS["ZZZZ"]


def run(text):
    out, err = io.StringIO(), io.StringIO()
    result = run_source(Source("script", text), RunOptions(), out, err)
    return result.exit_code, err.getvalue()


def test_a_repeated_group_reads_pairs_until_they_end(declare):
    declare(
        each("pairs", arg("name", "MOT"), arg("value", "FLOTTANT"), at_least=1), flag("all", "TOUT")
    )
    assert run("A = ZZZZ 'UX' 1. 'UY' 2 'TOUT' ;")[0] == 0
    assert declare.found == [{"pairs": [("UX", 1.0), ("UY", 2.0)], "all": True}]


def test_a_keyword_stands_between_the_pairs_too(declare):
    declare(
        each("pairs", arg("name", "MOT"), arg("value", "FLOTTANT")),
        key("title", "TITR", arg("t", "MOT")),
    )
    assert run("A = ZZZZ 'UX' 1. 'TITRE' 'abc' 'UY' 2. ;")[0] == 0
    assert declare.found == [{"pairs": [("UX", 1.0), ("UY", 2.0)], "title": "abc"}]


def test_a_word_without_its_value_is_told(declare):
    declare(each("pairs", arg("name", "MOT"), arg("value", "FLOTTANT")))
    code, output = run("A = ZZZZ 'UX' 1. 'UY' ;")
    assert code == 1
    assert "FLOTTANT" in output


def test_a_group_leaves_an_operator_that_follows(declare):
    declare(each("pairs", arg("name", "MOT"), arg("value", "FLOTTANT")))
    assert run("A = ZZZZ 'UX' 1. ENTI ;")[0] == 0


def test_a_select_reads_what_its_word_says(declare):
    declare(
        arg("n", "ENTIER"),
        select(
            "way", {"CERC": [arg("r", "FLOTTANT")], "RIEN": [], "LIST": [many("all", "ENTIER")]}
        ),
    )
    assert (
        run("A = ZZZZ 3 'CERC' 2. ; A = ZZZZ 'RIEN' 3 ; A = ZZZZ 1 'LIST' 2 3 ; A = ZZZZ 4 ;")[0]
        == 0
    )
    ways = [v["way"] for v in declare.found]
    assert [w and (w.word, dict(w.values)) for w in ways] == [
        ("CERC", {"r": 2.0}),
        ("RIEN", {}),
        ("LIST", {"all": (2, 3)}),
        None,
    ]


def test_either_takes_the_first_group_that_fits(declare):
    declare(
        either(
            "place",
            group("two", arg("a", "ENTIER"), arg("b", "MOT")),
            group("one", arg("a", "ENTIER")),
        )
    )
    assert run("A = ZZZZ 3 'x' ; A = ZZZZ 4 ;")[0] == 0
    assert [(v["place"].word, dict(v["place"].values)) for v in declare.found] == [
        ("two", {"a": 3, "b": "x"}),
        ("one", {"a": 4}),
    ]


def test_many_leave_the_last_for_what_follows(declare):
    declare(
        many("objects", "ENTIER", "LOGIQUE", leaving=2, left=("ENTIER",)),
        arg("p", "ENTIER"),
        arg("q", "ENTIER"),
    )
    assert run("A = ZZZZ 1 VRAI 2 3 FAUX ;")[0] == 0
    assert declare.found == [{"objects": (1, True, False), "p": 2, "q": 3}]


def test_repeated_words_end_at_a_keyword(declare):
    declare(many("names", "MOT"), choice("how", ("SANS", "AVEC")))
    assert run("A = ZZZZ 'UX' 'UY' 'AVEC' 'UZ' ;")[0] == 0
    assert declare.found == [{"names": ("UX", "UY", "UZ"), "how": "AVEC"}]


def test_a_keyword_may_stand_between_the_operands_of_many(declare):
    declare(
        many("numbers", "ENTIER", at_least=1), flag("quadratic", "QUAD"), key("a", "A", arg("a"))
    )
    assert run("X = ZZZZ 1 'QUAD' 2 'A' 3 4 ;")[0] == 0
    assert declare.found == [{"numbers": (1, 2, 4), "quadratic": True, "a": 3}]


def test_the_type_of_the_main_operand_chooses_behind_a_word(declare):
    declare(main("value", "LISTREEL"), flag("absolute", "ABS"))
    declare(main("value", "ENTIER"), opt("b", "FLOTTANT"))
    assert run("A = ZZZZ 'ABS' (PROG 1.) ; A = ZZZZ 3 4. ;")[0] == 0
    assert declare.found[0]["absolute"] is True
    assert declare.found[1] == {"value": 3, "b": 4.0}
    code, output = run("A = ZZZZ VRAI ;")
    assert code == 1
    assert "LISTREEL" in output
    assert "ENTIER" in output


def test_a_word_chooses_the_form_before_any_type(declare):
    declare(main("value", "ENTIER"))
    declare(said("CUBE", "CARRE"), arg("x", "ENTIER"))
    assert run("A = ZZZZ 'CUBE' 3 ; A = ZZZZ 3 ;")[0] == 0
    assert declare.found == [{"x": 3}, {"value": 3}]


def test_a_keyword_of_the_form_may_stand_before_the_word_that_chooses_it(declare):
    declare(arg("x", "ENTIER"))
    declare(said("CUBE"), arg("x", "ENTIER"), key("step", "PAS", arg("v", "FLOTTANT")))
    assert run("A = ZZZZ 'PAS' 0.5 3 'CUBE' ;")[0] == 0
    assert declare.found == [{"x": 3, "step": 0.5}]


def test_a_mandatory_select_chooses_its_form(declare):
    declare(
        select("on", {"PLAN": [arg("p", "ENTIER")], "AXE": []}, optional=False), opt("n", "MOT")
    )
    declare(arg("x", "FLOTTANT"), arg("y", "FLOTTANT"))
    assert run("A = ZZZZ 1. 'PLAN' 3 ; A = ZZZZ 1 2 ;")[0] == 1
    assert run("A = ZZZZ 'PLAN' 3 ; A = ZZZZ 1 2 ;")[0] == 0
    assert declare.found[-2]["on"].word == "PLAN"
    assert declare.found[-1] == {"x": 1.0, "y": 2.0}


def test_a_keyword_may_take_only_what_stands_behind_it(declare):
    declare(
        select("on", {"SUR": [many("those", "ENTIER", behind=True)]}),
        arg("x", "ENTIER"),
        many("more", "ENTIER"),
    )
    assert run("A = 1 2 ZZZZ 'SUR' ; B = 1 ZZZZ 'SUR' 2 3 ;")[0] == 0
    assert [(v["on"]["those"], v["x"], v["more"]) for v in declare.found] == [
        ((), 1, (2,)),
        ((2, 3), 1, ()),
    ]


def test_the_words_of_all_forms_of_a_type_are_told(declare):
    declare(said("CUBE"), main("x", "ENTIER"))
    declare(said("CARRE"), main("x", "ENTIER"))
    code, output = run("A = ZZZZ 3 ;")
    assert code == 1
    assert "CUBE" in output
    assert "CARRE" in output


def test_a_form_may_want_a_state_of_the_session(declare):
    declare(arg("x", "ENTIER"), when=When(lambda session: False, "in space"))
    code, output = run("A = ZZZZ 3 ;")
    assert code == 1
    assert "in space" in output


def test_the_error_is_that_of_the_form_which_got_furthest(declare):
    declare(arg("a", "MAILLAGE"))
    declare(arg("a", "ENTIER"), arg("b", "LISTREEL"))
    output = run("A = ZZZZ 3 VRAI ;")[1]
    assert "LISTREEL" in output
    assert "MAILLAGE" not in output


def test_operands_stand_as_they_stood_for_the_next_form(declare):
    declare(arg("a", "ENTIER"), key("k", "PAS", arg("v", "LISTREEL"), optional=False))
    declare(arg("a", "ENTIER"), key("k", "PAS", arg("v", "ENTIER"), optional=False))
    assert run("A = ZZZZ 3 'PAS' 4 ;")[0] == 0
    assert declare.found == [{"a": 3, "k": 4}]


def test_results_like_operands_have_their_types():
    form = Form((), lambda: None, gives=Like("objects"))
    assert results_of(form, {"objects": (1, True)}) == ("ENTIER", "LOGIQUE")
    assert results_of(form) is None


def several(call) -> tuple[ListReel, ListMots | None]: ...


def nothing(call) -> None: ...


def some(call) -> ListReel | ListEnti: ...


def test_annotations_say_results():
    assert results_of(Form((), several)) == ("LISTREEL", "LISTMOTS|")
    assert results_of(Form((), nothing)) == ()
    assert results_of(Form((), some)) == ("LISTREEL|LISTENTI",)


def test_a_number_read_before_says_how_often_a_group_is_read(declare):
    declare(
        opt("n", "ENTIER"),
        each("pairs", arg("name", "MOT"), arg("value", "FLOTTANT"), times="n"),
    )
    assert run("A = ZZZZ 1 'UX' 1. + 2 ; A = ZZZZ 'UX' 1. 'UY' 2. ;")[0] == 0
    assert declare.found == [
        {"n": 1, "pairs": [("UX", 1.0)]},
        {"n": None, "pairs": [("UX", 1.0), ("UY", 2.0)]},
    ]


def test_a_name_of_the_main_operand_is_no_word_that_selects(declare):
    declare(
        main("names", "LISTMOTS"),
        select("what", {"TYPE": [], "TOUT": []}, optional=False, unless=lambda names: names.values),
    )
    declare(main("names", "LISTMOTS"), arg("name", "MOT"))
    assert run("L = MOTS 'TYPE' ; A = ZZZZ L 'TOUT' ; A = ZZZZ L 'TYPE' ;")[0] == 0
    assert declare.found[0]["what"].word == "TOUT"
    assert declare.found[1]["name"] == "TYPE"


def test_a_word_selects_where_the_main_operand_has_no_such_name_at_each_turn(declare):
    declare(
        main("names", "LISTMOTS"),
        select("what", {"TYPE": [], "TOUT": []}, optional=False, unless=lambda names: names.values),
    )
    declare(main("names", "LISTMOTS"), arg("name", "MOT"))
    script = (
        "T = TABL ; T . 1 = MOTS 'A' ; T . 2 = MOTS 'TYPE' ; T . 3 = MOTS 'B' ;\n"
        "REPE B 3 ; L = T . &B ; A = ZZZZ L 'TYPE' ; FIN B ;"
    )
    assert run(script)[0] == 0
    assert [getattr(f.get("what"), "word", None) for f in declare.found] == ["TYPE", None, "TYPE"]
    assert declare.found[1]["name"] == "TYPE"
    assert [f["names"].values for f in declare.found] == [["A"], ["TYPE"], ["B"]]


def test_words_alone_give_each_call_values_of_its_own(declare):
    declare(
        main("n", "ENTIER"),
        flag("a", "AAAA"),
        flag(
            "b",
            "BBBB",
        ),
        opt("word", "MOT"),
    )
    script = (
        "A = ZZZZ 1 'AAAA' ; A = ZZZZ 2 'AAAA' ; A = ZZZZ 'BBBB' 3 'AAAA' ; A = ZZZZ 4 'OTHER' ;"
        "A = ZZZZ 5 'BBBB' ;"
    )
    twice = f"REPE I 2 ; {script} FIN I ;"
    assert run(twice)[0] == 0
    assert [tuple(f.values()) for f in declare.found[:5]] == [
        tuple(f.values()) for f in declare.found[5:]
    ]
    assert [(f["n"], f["a"], f["b"], f["word"]) for f in declare.found[5:]] == [
        (1, True, False, None),
        (2, True, False, None),
        (3, True, True, None),
        (4, False, False, "OTHER"),
        (5, False, True, None),
    ]


def test_forms_that_get_equally_far_tell_together_what_they_expect(declare):
    declare(arg("a", "MAILLAGE"))
    declare(arg("a", "LISTREEL"))
    output = run("A = ZZZZ 3 ;")[1]
    assert "MAILLAGE" in output
    assert "LISTREEL" in output


def test_results_by_a_word():
    form = Form((), lambda: None, gives=by("what", {"MAIL": "MAILLAGE", "PAIR": ("MOT", "MOT")}))
    assert results_of(form, {"what": Chosen("MAIL", {})}) == ("MAILLAGE",)
    assert results_of(form, {"what": "PAIR"}) == ("MOT", "MOT")
    flagged = Form((), lambda: None, gives=by("all", {True: "TABLE"}, "LISTREEL"))
    assert results_of(flagged, {"all": True}) == ("TABLE",)
    assert results_of(flagged, {"all": False}) == ("LISTREEL",)


def test_a_keyword_behind_a_pair_does_not_take_its_value(declare):
    declare(
        each("pairs", arg("name", "MOT"), arg("value", "LISTREEL")),
        key("axes", "DIRE", many("v", "LISTREEL")),
    )
    assert run("P = PROG 1. ; Q = PROG 2. ; A = ZZZZ 'VECT' P 'DIRE' Q ;")[0] == 0
    assert [v.values[0] for v in declare.found[0]["axes"]] == [2.0]
    assert declare.found[0]["pairs"][0][1].values[0] == 1.0


def test_what_leads_may_be_spelt_like_a_keyword(declare):
    declare(lead("item"), key("list", "DANS", arg("l", "LISTMOTS"), optional=False))
    assert run("A = ZZZZ 'DANS' 'DANS' (MOTS 'X') ; A = ZZZZ 'B' 'DANS' (MOTS 'X') ;")[0] == 0
    assert [v["item"] for v in declare.found] == ["DANS", "B"]


def test_what_leads_stands_behind_the_word_that_chooses_the_form(declare):
    declare(said("CSV"), lead("file", "MOT"), key("first", "DEBU", arg("n", "ENTIER")))
    declare(arg("x", "ENTIER"))
    text = "A = ZZZZ 'CSV' 'debut.csv' 'DEBU' 2 ; A = ZZZZ 'DEBU' 3 'CSV' 'f.csv' ; A = ZZZZ 1 ;"
    assert run(text)[0] == 0
    assert declare.found == [
        {"file": "debut.csv", "first": 2},
        {"file": "f.csv", "first": 3},
        {"x": 1},
    ]


def test_a_name_is_taken_whatever_object_bears_it(declare):
    declare(named("loop"), opt("n", "ENTIER"))
    assert run("X = 3. ; A = ZZZZ X 2 ; A = ZZZZ NEVER ;")[0] == 0
    assert declare.found == [{"loop": "X", "n": 2}, {"loop": "NEVER", "n": None}]
    code, output = run("A = ZZZZ 5. ;")
    assert code == 1
    assert "MOT" in output


def test_whole_operands_have_their_names(declare):
    declare(many("values", "FLOTTANT", whole=True))
    assert run("X = 3. ; A = ZZZZ X 4 ;")[0] == 0
    assert [(o.name, o.value) for o in declare.found[0]["values"]] == [("X", 3.0), ("", 4.0)]


def test_a_free_word_is_no_sign_between_objects(declare):
    declare(arg("n", "ENTIER"), opt("title", "MOT"))
    assert run("A = ZZZZ 1 'ANY' ; A = ZZZZ 2 ; A = VRAI ET (EXIS (ZZZZ 3)) ;")[0] == 0
    code, output = run("A = ZZZZ 4 ET 5 ;")
    assert [v["title"] for v in declare.found] == ["ANY", None, None, None], (code, output)
