"""Blocks, the end of a run, names that a script assigns, and scripts printed again."""

import pytest
from together import together

from ssilang.language.say.errors import SeveralErrors
from ssilang.language.text import tree
from ssilang.language.text.parser import end_of_run
from ssilang.language.text.source import Source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Definition, If, Loop, Statement, first_assignments


@together(
    "text",
    [
        "A = 1 ; FIN ;",
        "REPETER B1 3 ; A = 1 ; FIN B1 ; FIN ;",
        "REPE B1 3 ; FIN ; FIN B1 ; FIN ;",
        "SI VRAI ; FIN ; SINON ; FIN ; FINSI ; FIN ;",
        "SI VRAI ; REPETER B1 3 ; FIN ; FIN B1 ; FIN ; FINSI ; 'FIN' ;",
        "DEBPROC P1 X*ENTIER ; FIN ; FINPROC X ; FIN;",
        "M = 'FIN ; it''s ;' ; FIN ;",
    ],
)
def test_a_run_ends_at_the_first_fin_outside_of_all_blocks(text):
    assert end_of_run(Source("x", f"{text} remarks ( that are no statement ;")) == len(text)


@together("text", ["A = 1 ;", "SI VRAI ; FIN ;", "REPE B1 2 ; FIN B1 ;"])
def test_a_script_without_fin_has_no_end(text):
    assert end_of_run(Source("x", text)) is None


@together(
    "text, codes",
    [
        ("SI VRAI ; FIN B1 ;", ["stray-block-end", "unclosed-block"]),
        ("DEBP P1 ; FIN B1 ; FINP ;", ["stray-block-end"]),
        ("REPE B1 2 ; SI VRAI ; FIN B1 ;", ["crossed-blocks"]),
        ("REPE B1 2 ; SI VRAI ; FIN B1 ; FINSI ;", ["crossed-blocks"]),
    ],
)
def test_blocks_end_with_their_own_word(text, codes):
    with pytest.raises(SeveralErrors) as caught:
        parse(Source("x", text))
    assert [e.code for e in caught.value.errors] == codes


def test_names_are_assigned_where_they_first_get_a_value():
    text = (
        "A = 1 ; REPE B1 2 ; B = 2 ; A = 3 ; FIN B1 ; SI VRAI ; C = 1 ; SINON ; D = 1 ; FINSI ;"
        " DEBP P1 X*ENTIER ; E = X ; FINP E ; F G = 1 2 ; T . 1 = 3 ;"
    )
    found = first_assignments(parse(Source("x", text)).body)
    assert list(found) == ["A", "B", "C", "D", "P1", "F", "G"]
    assert [found[n].start for n in "ABCDFG"] == [
        text.index(s) for s in ("A =", "B =", "C =", "D =", "F G", "G =")
    ]


def _shape(nodes):
    """Blocks as nested lists of their words, names and bodies."""
    made = []
    for node in nodes:
        match node:
            case If():
                condition = tree.print_items(node.condition.items)
                made.append(["SI", condition, _shape(node.then), _shape(node.otherwise)])
            case Loop():
                made.append(["REPE", node.name, tree.print_items(node.count), _shape(node.body)])
            case Definition():
                results = tree.print_items(node.results)
                made.append([tree.heading(node), node.method, results, _shape(node.body)])
            case Statement():
                made.append(tree.print_items(node.items))
    return made


@together(
    "text, shape",
    [
        ("SI (A > 1) ; B ; SINON ; C ; D ; FINSI ; E ;",
         [["SI", "(A > 1)", ["B"], ["C", "D"]], "E"]),
        ("SI A ; SI B ; C ; FINSI ; 3 SINON ; D ; FINSI ;",
         [["SI", "A", [["SI", "B", ["C"], []]], ["D"]]]),
        ("REPE ZB 3 ; A ; REPE 2 AB ; B ; FIN AB ; C ; FIN ZB ; D ;",
         [["REPE", "ZB", "3", ["A", ["REPE", "AB", "2", ["B"]], "C"]], "D"]),
        ("DEBP ZP X*ENTIER Y/'MOT     ' T*TABLE*MODES Q ; A ; FINP Y X ; B ;",
         [["ZP X*ENTIER Y/MOT T*TABLE*MODES Q", False, "Y X", ["A"]], "B"]),
        ("DEBM MET 'x y'*ENTIER ; FINM ;", [["MET 'X Y'*ENTIER", True, "", []]]),
        ("REPE B1 2 ; SI A ; C ; FIN ;", [["REPE", "B1", "2", [["SI", "A", ["C", "FIN"], []]]]]),
        ("T . 'it''s' . 2 = -1.5 + %k ;", ["-1.5 + %K"]),
    ],
)  # fmt: skip
def test_what_stands_in_which_block(text, shape):
    assert _shape(parse(Source("x", text)).body) == shape
