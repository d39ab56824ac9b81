"""TRAC, DEFO, VECT, ANNO: what statements draw."""

import gc
import weakref
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from script_runs import ran, refused
from together import together

from ssilang.cli.run import RunResult, run_text
from ssilang.io.errors import NoGraphicsError
from ssilang.io.plots import animation
from ssilang.io.plots.layers import PictureOptions
from ssilang.io.plots.palette import index_of
from ssilang.io.plots.scene import draw_scene
from ssilang.io.plots.view import View
from ssilang.kernel.fields.deformed import Arrows, Deformed
from tests.windows import needs_window

PLATE = (
    "OPTI DIME 2 ELEM QUA4 MODE PLAN DEFO ; L = DROI 4 (0. 0.) (2. 0.) ; S = TRAN L 2 (0. 1.) ; "
    "X = COOR 1 S ; U = (NOMC 'UX' (0.01 * X)) ET (NOMC 'UY' (-0.02 * X)) ; "
    "MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 1.E9 'NU' 0.3 ; "
    "SG = SIGM MO MA U ; "
)


pytestmark = pytest.mark.usefixtures("unplaced")


def run(text: str, folder: Path | None = None) -> RunResult:
    return ran(PLATE + text, folder)


STATEMENTS = [
    "TRAC S ;",
    "TRAC 'NOEU' 'ELEM' 'QUAL' S 'TITR' 'numbers' ;",
    "TRAC 'FACE' (S COUL 'VERT') (CONT S) ;",
    "TRAC S 'ECLA' ;",
    "TRAC S 'COUL' 'ROUG' ;",
    "TRAC X S ;",
    "TRAC 7 X S (CONT S) 'LEGE' 'abscissa' ;",
    "TRAC (PROG 0.5 1. 1.5) X S 'NOLE' ;",
    "TRAC X ;",
    "TRAC X S 'CHAM' ;",
    "TRAC U S ;",
    "TRAC MO SG ;",
    "TRAC SG MO (DEFO S U) (CONT S) 5 ;",
    "TRAC (DEFO S U) ;",
    "TRAC ((DEFO S U 0. 'BLEU') ET (DEFO S U 10. 'ROUG')) 'BOIT' L ;",
    "TRAC (DEFO S U 10. X) ;",
    "TRAC X (DEFO S U 10.) ;",
    "TRAC (VECT U 'DEPL') S ;",
    "TRAC S (VECT SG MO) ;",
    "TRAC ((RIGI MO MA) ET (BLOQ 'DEPL' L)) ;",
    "TRAC S (ANNO 'ETIQ' (0. 0.) 'SO' 'base' 0.1 'BLEU') ;",
    "TRAC S ((ANNO 'CATE' 'ROUG' 'soil') ET (ANNO 'ETIQ' (0. 0.) 'BLEU' 'SO' 0.1 FAUX 'base')) ;",
]


@pytest.mark.parametrize("text", STATEMENTS)
def test_forms_that_draw_one_picture(text, tmp_path):
    result = run(text, tmp_path)
    (path,) = tmp_path.iterdir()
    assert path.read_bytes()[:4] == b"\x89PNG"
    assert result.session.workspace.output.files == [path]


def test_isovalues_are_faces_lines_or_both(tmp_path):
    drawn = {}
    for word in ("", "ISOV SURF", "ISOV LIGNE", "ISOV SULI"):
        (tmp_path / word).mkdir(exist_ok=True)
        run(f"OPTI DIME 2 {word} ; TRAC X S ;", tmp_path / word)
        (path,) = (tmp_path / word).glob("*.png")
        drawn[word] = path.read_bytes()
    assert drawn[""] == drawn["ISOV SURF"]
    assert len(set(drawn.values())) == 3


@together(
    "words, text, colour, place",
    [
        ("'N' 'top'", "top", "", "N"),
        ("'top' 'S'", "top", "", "S"),
        ("'SE' 'top' VERT", "top", "VERT", "SE"),
        ("VERT 0.1 FAUX 'top' 'O'", "top", "VERT", "O"),
        ("'N' 'S'", "S", "", "N"),
        ("'ROUG'", "ROUG", "", "NE"),
        ("'O' 'ROUG' 'VERT'", "VERT", "ROUG", "O"),
    ],
)
def test_colour_and_side_of_a_label_stand_before_its_text_or_behind(words, text, colour, place):
    result = run_text(f"OPTI DIME 2 ; P = 1. 0. ; A = ANNO 'ETIQ' P {words} ;")
    (tag,) = result.session.root.find("A").tags
    assert (tag.text, tag.colour, tag.place) == (text, index_of(colour) if colour else 0, place)


def test_the_colour_of_a_category_stands_before_its_text_or_behind():
    result = run_text("A = ANNO 'CATE' 'VERT' 'soil' ; B = ANNO 'CATE' 'soil' 'VERT' ;")
    one, other = (result.session.root.find(name).categories for name in "AB")
    assert one == other
    assert one[0].text == "soil"


def test_pictures_are_named_after_title_or_objects(tmp_path):
    run("TRAC X S ; TRAC S 'TITR' 'The plate' ; TITR 'in force' ; TRAC S ;", tmp_path)
    names = sorted(p.name for p in tmp_path.iterdir())
    assert names == ["0001_x-s.png", "0002_the-plate.png", "0003_in-force.png"]


def test_the_bar_has_the_units_of_the_deck_where_they_are_certain(tmp_path):
    run("OPTI TRAC SVG UNIT 'N-MM' ; TRAC MO SG ; TRAC U S ;", tmp_path)
    stress, displacement = (p.read_text("utf-8") for p in sorted(tmp_path.glob("*.svg")))
    assert ">von Mises (MPa)" in stress
    assert ">UX   " in displacement  # it may be a velocity


SOLID = (
    "OPTI DIME 3 ELEM SEG2 MODE TRID ; L = DROI 2 (0. 0. 0.) (2. 0. 0.) ; OPTI ELEM QUA4 ; "
    "S = TRAN L 1 (0. 1. 0.) ; OPTI ELEM CUB8 ; V = S VOLU 'TRAN' 2 (0. 0. 1.) ; X = COOR 1 V ; "
)


@pytest.mark.parametrize(
    "text",
    [
        "TRAC V ;",
        "TRAC (10. -20. 5.) 'CACH' V ;",
        "TRAC 'FACE' V (ARET V) ;",
        "OPTI OEIL (0. -10. 3.) ; TRAC 'CACH' X V ;",
        "TRAC X V 'COUP' (0. 0.4 0.) (1. 0.4 0.) (0. 0.4 1.) ;",
        "TRAC X V 'SECT' (0. 0.5 0.) (1. 0.5 0.) (0. 0.5 1.) ;",
    ],
)
@needs_window
def test_views_in_space(text, tmp_path):
    ran(SOLID + text, tmp_path)
    assert len(list(tmp_path.iterdir())) == 1


DIRE = "'DIRE' 'COUP' (0. 0.4 0.) (0. 0.4 1.) (1. 0.4 0.)"
LYING = "'DIRE' 'COUP' (0. 0.4 0.) (-1. 0.4 0.) (0. 0.4 1.)"


def test_the_picture_turns_after_the_plane_of_the_cut(monkeypatch):
    """One looks from the eye at P1; of P1 P2 what is across the view goes upwards."""
    views: list[View] = []

    def taken(layers: object, seen: tuple[View, ...], *rest: object) -> None:
        views.extend(seen)
        raise NoGraphicsError("io.no-drawing-in-space", reason="none")

    monkeypatch.setattr("ssilang.operators.drawing.scenes.draw_scene", taken)
    ran(
        f"{SOLID} TRAC X V (0. -19.6 0.) {DIRE} ; TRAC V (3. 0.4 4.) 'DIRE' 'COUP' (0. 0.4 0.) "
        f"(1. 0.4 0.) (0. 0.4 1.) ; OPTI OEIL (0. 0.4 9.) ; TRAC V {LYING} ;"
    )
    first, second, third = (v.axes for v in views)
    np.testing.assert_allclose(first, [(1, 0, 0), (0, 0, 1), (0, -1, 0)], atol=1e-12)
    np.testing.assert_allclose(second, [(0, -1, 0), (0.8, 0, -0.6), (0.6, 0, 0.8)], atol=1e-12)
    np.testing.assert_allclose(third, [(0, 1, 0), (-1, 0, 0), (0, 0, 1)], atol=1e-12)


def test_deformed_shape_keeps_what_is_given():
    result = run("V = VECT U 'DEPL' ; D = (DEFO S U V 3. 'ROUG') ET (DEFO U S) ;")
    made = result.session.root.find("D")
    assert isinstance(made, Deformed)
    first, second = made.parts
    assert (first.scale, first.colour, second.scale, second.colour) == (3.0, 2, None, None)
    assert first.arrows is result.session.root.find("V")


@together(
    "words, columns",
    [("'DEPL'", "UX UY"), ("'UY' ' '", "UY"), ("(MOTS 'UX' 'UY')", "UX UY"), ("", "UX UY")],
)
def test_components_of_arrows(words, columns):
    result = run(f"V = VECT U -2. {words} 'ROUG' ;")
    made = result.session.root.find("V")
    assert isinstance(made, Arrows)
    (part,) = made.parts
    assert (part.name, part.scale, part.colour) == (columns, -2.0, 2)
    tip = part.vectors[part.origins[:, 0] == 2.0][0]
    expected = [0.02, -0.04, 0] if columns == "UX UY" else [-0.04, 0, 0]
    assert np.allclose(tip, expected)


@together(
    "text, said",
    [
        ("TRAC 'FACE' ;", "MAILLAGE"),
        ("TRAC S 'COUPE' (0. 0.) (1. 1.) (2. 2.) ;", "on a line"),
        ("V = VECT U 'FORC' ;", "none of FX FY"),
        ("D = DEFO S ;", "CHPOINT"),
        ("TRAC S 'COLOUR' ;", "COLOUR"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_written(text, said, tmp_path):
    assert said in refused(PLATE + text, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_successive_shapes_become_an_animation(tmp_path):
    """Three shapes: three frames on one sheet, in the order of the shapes, and the way back."""
    from PIL import Image, ImageSequence

    run(
        "D0 = DEFO S U 0. ; D1 = DEFO S U 10. ; D2 = DEFO S U 20. ; "
        "TRAC (D0 ET D1 ET D2) 'ANIME' 'TITR' 'on' ; TRAC (D2 ET D1 ET D0) 'OSCIL' 'TITR' 'back' ;",
        tmp_path,
    )
    names = ("0001_on.gif", "0001_on.png", "0002_back.gif", "0002_back.png")
    assert tuple(sorted(p.name for p in tmp_path.rglob("*.*"))) == names
    seen = []
    for name in names[::2]:
        with Image.open(next(tmp_path.rglob(name))) as movie:
            seen.append([np.asarray(f.convert("RGB"), int) for f in ImageSequence.Iterator(movie)])
    a, b, c = seen[0]
    apart = [(np.abs(one - other) > 60).mean() for one, other in ((a, b), (b, c))]
    same = [(np.abs(x - y) > 60).mean() for x, y in zip(seen[1], (c, b, a, b), strict=True)]
    assert max(same) < 0.3 * min(apart), (same, apart)  # titles are others


@pytest.mark.parametrize(
    ("number", "second", "levels"),
    [("", "X - 1.", np.linspace(-1, 2, 14)), ("5", "3. * X", np.linspace(0, 6, 5)),
     ("(PROG 1. 3. 4.)", "X", [1, 3, 4]), ("", "", None)],
)  # fmt: skip
def test_frames_share_the_iso_values_of_all_shapes(number, second, levels, tmp_path, monkeypatch):
    """X goes from 0 to 2; without a second field both are 1 everywhere."""
    seen = []

    def drawn(layers: Any, views: Any, options: PictureOptions, *rest: Any) -> Any:
        seen.append(options.levels)
        return draw_scene(layers, views, options, *rest)

    monkeypatch.setattr(animation, "draw_scene", drawn)
    first = "X" if second else "((0. * X) + 1.)"
    shapes = f"((DEFO S U 0. ({first})) ET (DEFO S U 10. ({second or first})))"
    run(f"TRAC {number} {shapes} 'ANIME' ;", tmp_path)
    assert len(seen) == 2
    for found in seen:
        assert found == pytest.approx(levels)


def test_one_shape_makes_no_animation(tmp_path):
    run("TRAC (DEFO S U 10.) 'ANIME' ;", tmp_path)
    assert not list(tmp_path.rglob("*.gif"))


SHAPES = "((DEFO S U 0. 'BLEU') ET (DEFO S U 10. 'ROUG'))"


@pytest.mark.parametrize(
    ("subjects", "vain"),
    [  # "'LEGE' 'a'" stands for a title of the legend
        ("S", ["'LEGE' 'a'", "'CHAM'", "7", "(PROG 0.5 1.)", "'COUP' A B C", "'ANIM'", "'OSCI'"]),
        ("X S", ["'ECLA'", "'COUP' A B C", "'ANIM'", "'OSCI'"]),
        ("(DEFO S U 10. X)", ["'COUP' A B C", "'ANIM'", "'OSCI'"]),
        (SHAPES, ["'LEGE' 'a'", "'CHAM'", "7", "(PROG 0.5 1.)", "'COUP' A B C"]),
    ],
)
def test_a_word_that_changes_nothing_is_told(subjects, vain, tmp_path):
    """Of the words that ask for something to be seen; the picture decides which these are."""
    points = "A = 1. 0. ; B = 1. 1. ; C = 2. 1. ; "

    def drawn(text: str, name: str) -> tuple[list[bytes], list[str]]:
        (folder := tmp_path / name).mkdir()
        result = run(f"{points} TRAC {text} {subjects} ;", folder)
        warned = [w.data["word"] for w in result.session.warnings]
        return [p.read_bytes() for p in sorted(folder.glob("*.[pg][ni][gf]"))], warned

    plain, warned = drawn("", "plain")
    assert warned == []
    tried = ["'LEGE' 'a'", "'CHAM'", "7", "(PROG 0.5 1.)", "'COUP' A B C", "'ANIM'", "'OSCI'",
             "'ECLA'"]  # fmt: skip
    found = {text: drawn(text, str(i)) for i, text in enumerate(tried)}
    assert [t for t, (pictures, _) in found.items() if pictures == plain] == [
        t for t in tried if t in vain
    ]
    assert [t for t, (_, warned) in found.items() if warned] == [t for t in tried if t in vain]


def test_pictures_keep_nothing_of_a_run_that_is_gone(tmp_path):
    result = run("TRAC U S ; DESS (EVOL MANU (PROG 0. 1.) (PROG 0. 1.)) ;", tmp_path)
    kept = weakref.ref(result.session)
    assert len(list(tmp_path.glob("*.png"))) == 2
    del result
    gc.collect()
    assert kept() is None
