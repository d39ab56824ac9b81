"""ANNO: texts that TRAC adds to a picture."""

from __future__ import annotations

from ssilang.io.plots.labels import PLACES, Annotation, Category, Tag
from ssilang.io.plots.palette import index_of
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.registry import arg, many, opt, said
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import ANY_NUMBER
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
    return Annotation((Category(index_of(colour), str(text)),))


@ANNO.form(
    said("ETIQ"),
    arg("point", "POINT", en="where"),
    many("words", "MOT", at_least=1, en="colour and side, if any, then the text"),
    opt("distance", "FLOTTANT", en="distance of the text", unit="m", range=ANY_NUMBER),
    opt("link", "LOGIQUE", default=True, en="whether a line is drawn"),
    syntax="ANNO1 = ANNO 'ETIQ' POIN1 (COUL1) ('N'|'NE'|'E'|'SE'|'S'|'SO'|'O'|'NO'|'C') "
    "(FLOT1) (LOGI1) MOT1 ;",
    en="ETIQ: a text at a point, in a colour, on one of its sides, at a distance, with a line to "
    "the point unless LOGI1 is FAUX.",
)
def _tag(
    call: Call, point: Point, words: tuple[str, ...], distance: float | None, link: bool
) -> Annotation:
    colour, place = 0, "NE"
    for word in words[:-1]:
        if word.strip().upper() in PLACES:
            place = word.strip().upper()
        elif is_colour(word):
            colour = index_of(word)
        else:
            raise call.error("operators.drawing.no-colour-no-place", said=word, places=PLACES)
    return Annotation((), (Tag(point, str(words[-1]), colour, place, distance, link),))
