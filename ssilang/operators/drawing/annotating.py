"""ANNO: texts that TRAC adds to a picture."""

from __future__ import annotations

from ssilang.io.plots.labels import PLACES, Annotation, Category, Tag
from ssilang.io.plots.palette import index_of
from ssilang.language.run.call import Call
from ssilang.language.values import register_type
from ssilang.operators.dispatch import ByWord, union
from ssilang.operators.drawing.objects import is_colour

register_type(Annotation, "ANNOTATI")

ANNO = ByWord(
    "ANNO",
    "drawing",
    "Makes texts that TRAC adds to a picture; ET puts several together.",
    "Fabrique des textes que TRAC ajoute à un tracé ; ET en réunit plusieurs.",
)


@union(("ANNOTATI", "ANNOTATI"))
def _both(left: Annotation, right: Annotation) -> Annotation:
    return left.joined(right)


@ANNO.on(
    "CATE",
    syntax="ANNO1 = ANNO 'CATE' COUL1 MOT1 ;",
    en="CATE: a line of the legend, a colour and its meaning.",
    fr="CATE : une ligne de légende, une couleur et son sens.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) COUL ROUG ; "
        "TRAC L (ANNO 'CATE' 'ROUG' 'beam') ;",
    ),
)
def _category(call: Call, word: str) -> Annotation:
    colour = call.required("MOT", after=call.keyword_end)
    return Annotation((Category(index_of(colour), str(call.required("MOT"))),))


@ANNO.on(
    "ETIQ",
    syntax="ANNO1 = ANNO 'ETIQ' POIN1 (COUL1) ('N'|'NE'|'E'|'SE'|'S'|'SO'|'O'|'NO'|'C') "
    "(FLOT1) (LOGI1) MOT1 ;",
    en="ETIQ: a text at a point, in a colour, on one of its sides, at a distance, with a line to "
    "the point unless LOGI1 is FAUX.",
    fr="ETIQ : un texte en un point, dans une couleur, d'un de ses côtés, à une distance, relié au "
    "point par un trait sauf si LOGI1 est FAUX.",
)
def _tag(call: Call, word: str) -> Annotation:
    point = call.required("POINT", after=call.keyword_end)
    distance = call.read("FLOTTANT")
    link = call.optional("LOGIQUE", default=True)
    words = []
    while (operand := call.read("MOT")) is not None:
        words.append(str(operand.value))
        distance = distance or call.read("FLOTTANT")
        behind = call.read("LOGIQUE")
        link = link if behind is None else behind.value
    if not words:
        raise call.missing(("MOT",))
    colour, place = 0, "NE"
    for said in words[:-1]:
        if said.strip().upper() in PLACES:
            place = said.strip().upper()
        elif is_colour(said):
            colour = index_of(said)
        else:
            raise call.error("operators.drawing.no-colour-no-place", said=said, places=PLACES)
    far = None if distance is None else float(distance.value)
    return Annotation((), (Tag(point, words[-1], colour, place, far, bool(link)),))
