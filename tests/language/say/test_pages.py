"""The page of an operator says all that its forms declare, that of a procedure all of its head."""

from together import together

from ssilang.language.registry import (
    Help,
    arg,
    each,
    either,
    flag,
    group,
    key,
    many,
    opt,
    select,
)
from ssilang.language.say.reference import Page, page_text, procedure_page
from ssilang.language.vocabulary.entries import Argument, Declaration, TableEntry
from ssilang.language.vocabulary.entries_table import entries_text
from ssilang.language.vocabulary.terms import Range

OPERATOR = """\
ZTRY (ZTRYING) : operator [lists]

First sentence. Second one.
Next paragraph.

Syntax
    X = ZTRY A ;
     Y = ZTRY B ;

Arguments
  1.
    x              FLOTTANT or ENTIER: the number [m]; 0 < x <= 2; Usual 0.5 <= x <= 1
    n              ENTIER: how often (= 3)  (optional)
    rest           any object  (one or more)
    more           MOT: words  (one or more)
    'KEYA' or 'KEYB' a: POINT: where b: MOT: the key
    'FLAG': a flag  (optional)
  2.
    what is done
    'ONCE'
    'DEEP'
      d              TABLE
    pairs: pairs of both  (one or more)
      p              MOT
      q              LISTREEL
    e: one of both  (optional)
      r              MAILLAGE
      or
      s              CHPOINT
      t              MOT"""
PROCEDURE = """\
* ZPROC : what it does (see also ZTRY)
*    X = ZPROC A ;
*    Y = ZPROC B ;
*
* EN The text
*    goes on.
* FR Le texte
*    continue.
* Example :
*     A = 1 ;
*       B = 2 ;
X = 1 ;
* no head
"""
SAID = {
    "en": "ZPROC : what it does [procedures]\n\nThe text goes on.\n\nSyntax\n    X = ZPROC A ;\n"
    "    Y = ZPROC B ;\n\nExample\n    A = 1 ;\n      B = 2 ;",
    "fr": "ZPROC : procédure [procédures]\n\nLe texte continue.\n\nSyntaxe\n    X = ZPROC A ;\n"
    "    Y = ZPROC B ;\n\nExemple\n    A = 1 ;\n      B = 2 ;",
}


FORMS = (
    (
        arg("x", "FLOTTANT", "ENTIER", en="the number", unit="m",
            range=Range(0.0, 2.0, True, False), usual=Range(0.5, 1.0)),
        opt("n", "ENTIER", default=3, en="how often"), many("rest"),
        many("more", "MOT", at_least=1, en="words"),
        key("k", ("KEYA", "KEYB"), arg("a", "POINT", en="where"), opt("b", "MOT"), en="the key",
            optional=False),
        flag("f", "FLAG", en="a flag"),
    ),
    None,
    (
        select("how", {"ONCE": (), "DEEP": (arg("d", "TABLE"),)}, optional=False,
               en="what is done"),
        each("pairs", arg("p", "MOT"), arg("q", "LISTREEL"), en="pairs of both"),
        either("e", group("g1", arg("r", "MAILLAGE")),
               group("g2", arg("s", "CHPOINT"), arg("t", "MOT")), en="one of both", optional=True),
    ),
)  # fmt: skip


def test_a_page_says_what_every_form_declares():
    told = Help(
        "First sentence. Second one.\nNext paragraph.", "Phrase.", "X = ZTRY A ;\n Y = ZTRY B ;"
    )
    page = Page("ZTRY", "ZTRYING", "operator", "lists", "", told, FORMS)
    assert page_text(page, "en") == OPERATOR
    french = page_text(page, "fr")
    assert french.startswith("ZTRY (ZTRYING) : opérateur [listes]\n\nPhrase.\n\nSyntaxe\n")
    assert "    x              FLOTTANT ou ENTIER [m]; 0 < x <= 2; Usuel 0.5 <= x <= 1" in french
    assert "    rest           tout objet  (un ou plusieurs)" in french


@together("language", SAID)
def test_the_head_of_a_procedure_is_its_page(language, tmp_path):
    path = tmp_path / "zproc.ssi"
    path.write_text(PROCEDURE)
    assert page_text(procedure_page(path), language) == SAID[language]


def entry(path, types, theme="problem", **said):
    return TableEntry(tuple(path.split(".")), tuple(types.split()), theme, fr="", **said)


ENTRIES = Declaration(
    "ZPROC",
    (Argument("TAB1", "KIND", ()), Argument("TAB2", "", ()), Argument("TAB3", "", ())),
    (
        entry("TAB1.A", "FLOTTANT ENTIER", unit="s", needed=True, en="a time", range=Range(0.0)),
        entry("TAB1.B", "MOT", values=("ON", "OFF"), default="ON", en="a word"),
        entry("TAB1.C", "LOGIQUE", default=False, en="a logical"),
        entry("TAB1.D", "LOGIQUE", default=True, en="a logical"),
        entry("TAB1.T", "TABLE", "results", en="a table"),
        entry("TAB1.T.X", "", "results", default=2.5, en="inside", usual=Range(1.0, 3.0)),
        entry("TAB2.Z", "POINT", en="of the other table"),
    ),
)
TEXT = """

Entries of TAB1, a table 'KIND'
    index  types       unit  default  meaning

  Problem
    A      FLOTTANT |  s     needed   a time
           ENTIER                     Range: A >= 0
    B      MOT               'ON'     a word
                                      Allowed: 'ON' | 'OFF'
    C      LOGIQUE           FAUX     a logical
    D      LOGIQUE           VRAI     a logical

  Results
    T      TABLE                      a table
      . X  any               2.5      inside
                                      Usual: 1 <= X <= 3

Entries of TAB2
    index  types  unit  default  meaning

  Problem
    Z      POINT                 of the other table"""
ROWS = [
    "A|FLOTTANT \\| ENTIER|s|needed|a time Range: A >= 0",
    "B|MOT||'ON'|a word Allowed: 'ON' \\| 'OFF'",
    "C|LOGIQUE||FAUX|a logical", "D|LOGIQUE||VRAI|a logical", "T|TABLE|||a table",
    ". X|any||2.5|inside Usual: 1 <= X <= 3", "Z|POINT|||of the other table",
]  # fmt: skip


def test_a_long_word_of_a_deep_entry_widens_its_column():
    name = "A_NAME_OF_TWENTY_EIGHT_CHARS"
    rows = (entry("TAB2.T", "TABLE", en="it"), entry(f"TAB2.T.{name}", "POINT", en="in it"))
    made = Declaration("ZPROC", ENTRIES.arguments, rows)
    assert entries_text(made, "en", 80)[2:] == [
        f"    {'index':<32}  types  unit  default  meaning", "", "  Problem",
        f"    {'T':<32}  TABLE                 it", f"      . {name}  POINT                 in it",
    ]  # fmt: skip


def test_the_tables_of_a_page_say_what_every_entry_declares(build):
    assert "\n".join(["", *entries_text(ENTRIES, "en", 80)]) == TEXT
    lines = build.entries_markdown(ENTRIES, "en")
    cells = [line.strip("| ").replace("` | ", "|").replace(" | ", "|") for line in lines]
    assert [c[1:] for c in cells if c.startswith("`")] == ROWS
    heads = [line for line in lines if line.startswith("#")]
    assert heads == [
        "## Entries of TAB1, a table 'KIND'", "### Problem", "### Results", "## Entries of TAB2",
        "### Problem",
    ]  # fmt: skip
