"""DESS: what a statement makes of its words and table."""

import itertools
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from script_runs import ran, refused
from together import together

from ssilang.cli.run import RunResult, run_text
from ssilang.language.registry import Keyword, Select, find_operator

pytestmark = pytest.mark.usefixtures("unplaced")

CURVES = (
    "E1 = EVOL 'MANU' 'BLEU' 't (s)' (PROG 0. 1. 2.) 'u' (PROG 0. 3. 1.) ; "
    "E2 = EVOL 'ROUG' 'MANU' 't (s)' (PROG 0. 1. 2.) 'v' (PROG 1. 1. 4.) ; E = E1 ET E2 ; "
)


def run(text: str, folder: Path) -> RunResult:
    return ran(CURVES + text, folder)


def words(folder: Path, number: int = 1) -> list[str]:
    (path,) = folder.glob(f"{number:04d}_*.svg")
    root = ElementTree.parse(path).getroot()
    return [t.text or "" for t in root.iter("{http://www.w3.org/2000/svg}text")]


def test_a_curve_is_drawn_as_png_and_svg_under_its_name(tmp_path: Path) -> None:
    run("DESS E1 ; DESS E 'TITR' 'Both' ;", tmp_path)
    names = sorted(p.name for p in tmp_path.iterdir())
    assert names == ["0001_e1.png", "0001_e1.svg", "0002_both.png", "0002_both.svg"]
    assert (tmp_path / "0001_e1.png").read_bytes()[:4] == b"\x89PNG"
    assert {"t (s)", "u"} <= set(words(tmp_path))


def test_options_stand_in_any_order(tmp_path: Path) -> None:
    run("DESS 'XBOR' 0. 5. 'TITX' 'abscissa' E 'GRIL' 'POIN' 'GRIS' 'MIMA' 'TITY' 'y' ;", tmp_path)
    assert {"abscissa", "y", "min 0    max 4"} <= set(words(tmp_path))


# a way to say each optional word of DESS that is declared
SAID = {
    "log_x": "'LOGX'", "log_y": "'LOGY'", "grid": "'GRIL'", "square": "'CARR'",
    "x_limits": "'XBOR' 0.2 1.5", "y_limits": "'YBOR' -2. 5.", "x_step": "'XGRA' 0.7",
    "y_step": "'YGRA' 0.7", "extremes": "'MIMA'", "difference": "'ECAR'", "date": "'DATE'",
    "separate": "'SEPA'", "chosen": "'CHOI' 2", "title": "'TITR' 'a'", "x_title": "'TITX' 'a'",
    "y_title": "'TITY' 'a'", "x_place": "'POSX' 'EXCE'", "y_place": "'POSY' 'EXCE'",
    "x_format": "'XFMT' '(F5.3)'", "y_format": "'YFMT' '(F5.3)'", "axes": "'AXES'",
    "legend": "'LEGE' 'SO'",
}  # fmt: skip
IDLE = {"logo": "'LOGO'", "no_click": "'NCLK'"}  # as their help says
NAMED = CURVES.replace("'BLEU'", "'BLEU' 'LEGE' 'p'")
VAIN = "operators.drawing.changes-nothing"
FURTHER = ("'GRIL' 'POIN'", "'GRIL' 'GRIS'", "'LEGE' 'NE'", "'LEGE' 'XY' 0.5 2.", "'ECAR' FAUX")


def drawn(folder: Path, curve: str, words: list[str]) -> tuple[list[Any], list[str]]:
    """What stands in a curve's picture with each of these words, and the words that are told.

    Numbers that are made anew each time are left out.
    """
    statements = "".join(f"DESS X {w} ;" for w in words)
    result = ran(f"OPTI 'TRAC' 'SVG' ; {NAMED} X = {curve} ; {statements}", folder)
    made = re.compile(r"(#|^)[a-z]\w*$|url")
    pictures = [
        [
            (e.tag, [v for v in e.attrib.values() if not made.search(v)], e.text)
            for e in ElementTree.parse(path).getroot().iter()
            if not e.tag.endswith("date")
        ]
        for path in sorted(folder.glob("*.svg"))
    ]
    told = [w.data["word"] for w in result.session.warnings if w.code == VAIN]
    return pictures, told


def test_each_optional_word_changes_the_picture(tmp_path: Path) -> None:
    tried = [*IDLE.values(), *SAID.values(), *FURTHER]
    (plain, *seen), _ = drawn(tmp_path, "E", ["", *tried])
    entries = [e for e in find_operator("DESS").forms[0].entries if isinstance(e, Keyword | Select)]
    assert {e.name for e in entries} == {*SAID, *IDLE}
    told = dict(zip(tried, seen, strict=True))
    alike = {t for t in told if told[t] == plain}
    # never: two curves of other names have no difference anyway
    assert alike == {*IDLE.values(), "'ECAR' FAUX"}
    for first, second in itertools.combinations(set(told) - {*IDLE.values()}, 2):
        assert told[first] != told[second], (first, second)


SITUATIONS = {
    "a curve without names": ("EVOL 'MANU' (PROG 1. 2. 3.) (PROG 1. 3. 2.)", ""),
    "a curve over words": ("EVOL 'MANU' (MOTS 'A' 'B' 'C') (PROG 3. 1. 2.)", ""),
    "curves over powers of ten": ("E", "'LOGX' 'LOGY'"),
    "curves in frames of their own": ("E", "'SEPA'"),
    "curves that no number can be read of": (
        "EVOL 'MANU' 't' (PROG 1. 2.) 'u' ((PROG 1. 2.) * 1.E308 * 1.E308)", ""
    ),
}  # fmt: skip


@pytest.mark.parametrize("situation", SITUATIONS)
def test_a_word_that_changes_nothing_is_told(situation: str, tmp_path: Path) -> None:
    """Of all words that can stand there: those without effect and no others."""
    curve, beside = SITUATIONS[situation]
    tried = [t for n, t in SAID.items() if t not in beside and n not in ("date", "chosen")]
    if beside == "'LOGX' 'LOGY'":  # refused there
        tried = [t for t in tried if "FMT'" not in t]
    (plain, *seen), told = drawn(tmp_path, curve, [f"{beside} {t}" for t in ("", *tried)])
    alike = [t for t, picture in zip(tried, seen, strict=True) if picture == plain]
    assert told == [t.split("'")[1] for t in alike]


def test_the_title_in_force_is_used(tmp_path: Path) -> None:
    run("TITR 'case 1' ; DESS E1 ; DESS E1 'TITR' 'other' ;", tmp_path)
    assert "case 1" in words(tmp_path, 1)
    assert "case 1" not in words(tmp_path, 2)


def test_white_below_a_curve_hides_the_curves_before_it_and_colour_none(tmp_path: Path) -> None:
    for style in ("REMP BLAN", "REMP REGU"):
        run(f"T = TABL ; T . 1 = '{style}' ; T . 2 = '{style}' ; DESS E T ;", tmp_path / style)
        (path,) = (tmp_path / style).glob("*.svg")
        _, first, second = path.read_text().split('id="PolyCollection_')
        assert ("line2d_" in first, "line2d_" in second) == (style == "REMP BLAN", True)


def test_legends_of_the_table(tmp_path: Path) -> None:
    script = (
        "T = TABL ; T . 1 = 'TIRR MARQ CROI' ; T . 'TITRE' = TABL ; "
        "T . 'TITRE' . 1 = MOT 'first' ; T . 'TITRE' . 2 = MOT 'second' ; "
        "DESS E T 'LEGE' 'SE' ; DESS E 'LEGE' T 'CHOI' 2 ;"
    )
    run(script, tmp_path)
    assert {"first", "second"} <= set(words(tmp_path, 1))
    assert "first" not in words(tmp_path, 2)


@pytest.mark.parametrize(
    ("made", "legends"),
    [
        ("DESS A B 'LEGE' ;", {"UX P A", "UX P B"}),
        ("DESS (A ET B) 'LEGE' ;", {"UX P 1", "UX P 2"}),
        ("DESS (A ET C) 'LEGE' ;", {"UX P", "UX 2"}),
        ("DESS A (A COUL 'ROUG') 'LEGE' ;", {"UX P 1", "UX P 2"}),
        ("DESS (A COUL 'ROUG') (B COUL 'ROUG') 'LEGE' ;", {"UX P"}),
    ],
)
def test_curves_of_one_component_are_told_apart(made, legends, tmp_path: Path) -> None:
    motion = (
        "OPTI 'DIME' 2 ; P = 0. 0. ; L = MANU 'POI1' (P ET (1. 0.)) ; "
        "U = MANU 'CHPO' L 1 'UX' 1. ; V = SUIT U U ; W = SUIT U (2. * U) ; X = PROG 0. 1. ; "
        "A = EVOL 'TEMP' V X 'UX' P ; B = EVOL 'TEMP' W X 'UX' P ; "
        "C = EVOL 'TEMP' W X 'UX' (POIN 2 L) ; "
    )
    run(motion + made, tmp_path)
    assert {w for w in words(tmp_path) if w.startswith("UX ")} == legends


def test_only_one_format_on_demand_named_after_the_file(tmp_path: Path) -> None:
    run("OPTI 'TRAC' 'SVG' 'FTRA' 'out/fig.ps' ; DESS E ; DESS E ;", tmp_path)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["0001_fig.svg", "0002_fig.svg"]


PORTION = "T = TABL ; T . '{0}' = TABL ; T . '{0}' . 1 = {1} ; "


@together(
    "text, said",
    [
        ("DESS 3 ;", "EVOLUTIO"),
        ("DESS E 'XBOR' 2. 2. ;", "both 2"),
        ("DESS E 'CHOI' 7 ;", "curve 7 is asked for"),
        ("T = TABL ; T . 1 = 'MARQ BALL' ; DESS E T ;", "'BALL' is no marker"),
        ("T = TABL ; T . 'INITIAL' = TABL ; T . 'INITIAL' . 1 = 1.5 ; DESS E T ;", "whole numbers"),
        ("DESS E 'XFMT' '(Q3)' ;", "no number format"),
        ("DESS E 'LOGX' 'XFMT' '(F5.1)' ;", "XFMT does not go with LOGX"),
        ("DESS E 'YFMT' '(F5.1)' 'LOGY' 'LOGX' ;", "YFMT does not go with LOGY"),
        ("DESS E 'LEGE' 'NO' 'LEGE' 'SE' ;", "'LEGE' stands twice"),
        (PORTION.format("INITIAL", "4") + "DESS E T ;", "points 1 to 3"),
        (PORTION.format("FINAL", "0") + "DESS E T ;", "say 1 to 0"),
        (PORTION.format("LIGNE_VARIABLE", "3") + "DESS E T ;", "curve 1 has ENTIER"),
        (PORTION.format("LIGNE_VARIABLE", "LECT 1") + "DESS E T ;", "1 dash for the 2 segments"),
        (PORTION.format("LIGNE_VARIABLE", "LECT 0 6") + "DESS E T ;", "holds 6"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_written(text: str, said: str, tmp_path: Path) -> None:
    assert said in refused(CURVES + text, tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("extra", ["", " 7", " 1 2"])
def test_dashes_behind_the_last_segment_are_told_and_left_out(extra: str, tmp_path: Path) -> None:
    script = f"T . 'LIGNE_VARIABLE' . 2 = LECT 0 1{extra} ; DESS E T ;"
    result = run(PORTION.format("LIGNE_VARIABLE", f"LECT 5 0{extra}") + script, tmp_path)
    told = [w for w in result.session.warnings if w.code == "operators.drawing.dashes-beyond"]
    assert [w.data["curves"] for w in told] == ([[1, 2]] if extra else [])
    assert len(list(tmp_path.glob("*.png"))) == 1


def test_bars_of_a_histogram(tmp_path: Path) -> None:
    script = (
        "T = TABL ; T . 'HPOS' = 10. ; T . 'DESS' = 'GRIL AXES' ; "
        "T . 'COUL' = MOTS ROUG VERT BLEU ; H P = @HISTOGR (PROG 3. -1. 2.) T ; "
        "N = DIME H ; A = EXTR H 'ABSC' 3 ; B = P . 'TITRE' . 2 ;"
        "W = EVOL 'MANU' 'abscissas of W' (PROG 0. 1.) 'ordinates of W' (PROG 0. 1.) ;"
    )
    found = run(script, tmp_path).session.root
    assert len(list(tmp_path.glob("*.png"))) == 1
    assert found.find("N") == 3
    assert list(found.find("A").values) == pytest.approx([12.1, 12.1, 12.9, 12.9])
    assert found.find("B") == "2"
    assert [p.colour for p in found.find("H").parts] == [2, 4, 1]
    assert [p.colour for p in found.find("E").parts] == [1, 2]
    (part,) = found.find("W").parts
    assert (part.abscissa_name, part.ordinate_name) == ("abscissas of", "ordinates of")


WHITES = [
    "E = EVOL BLAN 'MANU' 'X' (PROG 0. 1.) 'Y' (PROG 0. 1.) ; DESS E ;",
    "E = EVOL 'MANU' 'X' (PROG 0. 1.) 'Y' (PROG 0. 1.) ; DESS ((COUL E BLAN) ET (COUL E ROUG)) ;",
    "OPTI DIME 2 ELEM SEG2 ; TRAC (COUL (DROI 2 (0. 0.) (1. 1.)) BLAN) ;",
    "OPTI DIME 2 ELEM QUA4 ; TRAC (COUL ((DROI 2 (0. 0.) (1. 0.)) TRAN 1 (0. 1.)) BLAN) ;",
]


@pytest.mark.parametrize("script", WHITES)
def test_white_lines_are_black_on_white_paper(tmp_path, script):
    """Cast3M's default colour is white, on a black screen; its PostScript turns it to black."""
    assert run_text("OPTI TRAC SVG ; " + script, output_directory=tmp_path).exit_code == 0
    (picture,) = tmp_path.rglob("*.svg")
    drawn = picture.read_text(encoding="utf-8")
    assert "stroke: #ffffff" not in drawn
    assert "stroke: #1b1f24" in drawn


def test_words_that_say_nothing_of_a_style_are_told(tmp_path: Path) -> None:
    result = run("T = TABLE ; T . 1 = 'MARQ TRIA TITR M1' ; DESS E T ;", tmp_path)
    (told,) = result.session.warnings
    assert (told.code, told.data["words"], told.data["n"]) == (
        "io.no-line-option", ("TITR", "M1"), 1,
    )  # fmt: skip
