"""ANNO: texts that TRAC adds to a picture."""

from __future__ import annotations

from ssilang.io.plots.labels import PLACES, Annotation, Category, Tag
from ssilang.io.plots.palette import index_of
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.registry import arg, many, opt, said
from ssilang.language.run.call import Call
from ssilang.operators.dispatch import shared_operator, union
from ssilang.operators.drawing.objects import is_colour

ANNO = shared_operator(
    "ANNO",
    "drawing",
    "Makes texts that TRAC adds to a picture; ET puts several together.",
    examples=(
        (
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ;\n"
            "TRAC L (ANNO 'ETIQ' (0.5 0.) 'ROUG' 'N' 'middle') ;"
        ),
    ),
)


@union(("ANNOTATI", "ANNOTATI"))
def _both(left: Annotation, right: Annotation) -> Annotation:
    return left.joined(right)


@ANNO.form(
    said("CATE"),
    arg("colour", "MOT", en="colour", kind="colour"),
    arg("text", "MOT", en="its meaning"),
    syntax="ANNO1 = ANNO 'CATE' COUL1 MOT1 ;",
    en="CATE: a line of the legend, a colour and its meaning.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) COUL ROUG ; "
        "TRAC L (ANNO 'CATE' 'ROUG' 'beam') ;",
    ),
)
def _category(colour: str, text: str) -> Annotation:
    if not is_colour(colour) and is_colour(text):
        colour, text = text, colour
    return Annotation((Category(index_of(colour), str(text)),))


@ANNO.form(
    said("ETIQ"),
    arg("point", "POINT", en="where"),
    many("words", "MOT", at_least=1, en="the text; a colour and a side, before it or behind it"),
    opt("distance", "FLOTTANT", en="distance of the text", unit="m"),
    opt("link", "LOGIQUE", default=True, en="whether a line is drawn"),
    syntax="ANNO1 = ANNO 'ETIQ' POIN1 (COUL1) ('N'|'NE'|'E'|'SE'|'S'|'SO'|'O'|'NO'|'C') "
    "(FLOT1) (LOGI1) MOT1 ;",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; P = 1. 0. ; L = DROI 4 (0. 0.) P ;\n"
        "A = ANNO 'ETIQ' P 'S' 'end' 'VERT' ; TRAC L A ; MESS (TYPE A) ;",
    ),
    en="ETIQ: a text at a point, in a colour, on one of its sides, at a distance, with a line to "
    "the point unless LOGI1 is FAUX.",
)
def _tag(
    call: Call, point: Point, words: tuple[str, ...], distance: float | None, link: bool
) -> Annotation:
    found: dict[str, str] = {}
    for word in words:
        side = word.strip().upper() in PLACES and "place" not in found
        role = (
            "place" if side else "colour" if is_colour(word) and "colour" not in found else "text"
        )
        if role in found:
            raise call.error("operators.drawing.no-colour-no-place", said=word, places=PLACES)
        found[role] = word
    if "text" not in found:  # the text is spelt as a side or a colour
        role = next(r for r, word in found.items() if word is words[-1])
        found["text"] = found.pop(role)
    colour = index_of(found["colour"]) if "colour" in found else 0
    place = found.get("place", "NE").strip().upper()
    return Annotation((), (Tag(point, str(found["text"]), colour, place, distance, link),))
