"""Curves in EXTR DIME CHAN ORDO MAXI MINI COPI ET and in signs."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ssilang.io.plots.palette import NAMES
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import NoResultError
from ssilang.kernel.curves.algebra import combined, is_complex
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListMots, ListReel, Mot
from ssilang.operators.curves.words import read_colour
from ssilang.operators.dispatch import CHAN, COPI, DIME, EXTR, MAXI, MINI, ORDO, union
from ssilang.operators.numbers.arithmetic import _ARRAY, SIGNS, rule, rule_with_call


def numbered(call: Call, curve: Curve, place: int | None) -> CurvePart:
    """Curve number `place` (from 1; the first without number)."""
    place = 1 if place is None else place
    if not 1 <= place <= len(curve.parts):
        raise call.error("operators.curves.no-such-curve", n_parts=len(curve.parts), place=place)
    return curve.parts[place - 1]


def abscissa_list(part: CurvePart) -> ListReel | ListMots:
    """Abscissas as reals, or as the words that they were given as."""
    return ListMots(part.abscissa_words) if part.abscissa_words else ListReel(part.abscissas)


def ordinate_list(part: CurvePart) -> ListReel | ListEnti | ListMots:
    """Ordinates as the list that they were given as."""
    if part.words:
        return ListMots(part.words)
    if part.kind == "ENTI":
        return ListEnti(part.ordinates.astype(np.int64))
    return ListReel(part.ordinates)


@EXTR.on(
    "EVOLUTIO",
    syntax="LREE1 = EXTR EVOL1 'ABSC' | 'ORDO' (N1) | MOT1 ; EVOL2 = EXTR EVOL1 'COUR' N1 | MOT1 "
    "| LENT1 ;\nEVOL2 = EXTR EVOL1 'PAS' N1 | 'AVAN' X2 | 'APRE' X3 | 'COMP' X2 X3 ('ZERO') ; "
    "(limits as reals, or 'INDI' and integers)\n"
    "MOT1 = EXTR EVOL1 'LEGX' | 'LEGY' | 'LEGE' | 'COUL' (N1) ;",
    en="Of curves: abscissas or ordinates as a list (also by the name of an axis), some of the "
    "curves, some of their points, names of axes, colours.",
    fr="D'évolutions : abscisses ou ordonnées en liste (aussi par le nom d'un axe), certaines des "
    "courbes, certains de leurs points, noms des axes, couleurs.",
    examples=(
        "E = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 5. 6. 7.) ; LIST (EXTR E 'ORDO') ;",
        "E = EVOL 'MANU' (PROG 0. 1. 2.) (PROG 5. 6. 7.) ; LIST (EXTR E 'APRE' 1. 'ZERO') ;",
    ),
)
def _extract(call: Call, curve: Curve) -> Any:
    word = call.keyword(tuple(_PARTS))
    if word is not None:
        return _PARTS[word](call, curve)
    said = call.read("MOT")
    if said is None:
        raise call.missing(("MOT",))
    wanted = str(said.value).rstrip()[:12]
    for part in curve.parts:
        if part.abscissa_name.rstrip() == wanted:
            return abscissa_list(part)
        if part.ordinate_name.rstrip() == wanted:
            return ordinate_list(part)
    names = sorted({n for p in curve.parts for n in (p.abscissa_name, p.ordinate_name)} - {""})
    raise call.error(
        "operators.curves.no-axis-of-name",
        said.value,
        wanted=wanted,
        names=[f"'{n}'" for n in names],
    )


def _abscissas(call: Call, curve: Curve) -> Any:
    return abscissa_list(numbered(call, curve, call.optional("ENTIER")))


def _ordinates(call: Call, curve: Curve) -> Any:
    return ordinate_list(numbered(call, curve, call.optional("ENTIER")))


def _curves(call: Call, curve: Curve) -> Curve:
    operand = call.read("ENTIER", "LISTENTI", "MOT")
    if operand is None:
        raise call.missing(("ENTIER", "LISTENTI", "MOT"))
    value = operand.value
    if isinstance(value, str):
        wanted = value.rstrip()[:12]
        parts = tuple(
            p for p in curve.parts if wanted in (p.abscissa_name.rstrip(), p.ordinate_name.rstrip())
        )
        if not parts:
            raise call.error("operators.curves.no-axis-with-name", value, wanted=wanted)
    else:
        places = value.values.tolist() if isinstance(value, ListEnti) else [value]
        parts = tuple(numbered(call, curve, int(i)) for i in places)
    return Curve(parts, curve.title, curve.kind)


def _pick(part: CurvePart, kept: Any, zero: bool = False) -> CurvePart:
    x: FloatArray = part.abscissas[kept]
    if zero and len(x):
        x = x - x[0]
    words = tuple(np.asarray(part.words)[kept]) if part.words else ()
    marks = tuple(np.asarray(part.abscissa_words)[kept]) if part.abscissa_words else ()
    return dataclasses.replace(
        part, abscissas=x, ordinates=part.ordinates[kept], words=words, abscissa_words=marks
    )


def _picked(curve: Curve, choose: Any, zero: bool = False) -> Curve:
    parts = tuple(_pick(p, choose(p), zero) for p in curve.parts)
    return dataclasses.replace(curve, parts=parts)


def _every(call: Call, curve: Curve) -> Curve:
    step = call.required("ENTIER")
    if step < 1:
        raise call.error("operators.curves.step-of-points", step, step=step)
    return _picked(curve, lambda p: slice(None, None, step))


def _limits(call: Call, count: int) -> tuple[bool, list[Any]]:
    by_place = call.keyword(("INDI",)) is not None
    kind = "ENTIER" if by_place else "FLOTTANT"
    return by_place, [call.required(kind) for _ in range(count)]


def _between(by_place: bool, low: float, high: float) -> Any:
    def choose(part: CurvePart) -> Any:
        x = np.arange(1, len(part.abscissas) + 1) if by_place else part.abscissas
        slack = 0.0 if by_place else 1e-10 * max(float(np.ptp(part.abscissas)), 1e-300)
        return (x >= low - slack) & (x <= high + slack)

    return choose


def _before(call: Call, curve: Curve) -> Curve:
    by_place, (high,) = _limits(call, 1)
    return _picked(curve, _between(by_place, -np.inf, high))


def _after(call: Call, curve: Curve) -> Curve:
    by_place, (low,) = _limits(call, 1)
    zero = call.keyword(("ZERO",)) is not None
    return _picked(curve, _between(by_place, low, np.inf), zero)


def _window(call: Call, curve: Curve) -> Curve:
    by_place, (low, high) = _limits(call, 2)
    zero = call.keyword(("ZERO",)) is not None
    return _picked(curve, _between(by_place, low, high), zero)


def _x_name(call: Call, curve: Curve) -> Mot:
    return Mot(numbered(call, curve, call.optional("ENTIER")).abscissa_name)


def _y_name(call: Call, curve: Curve) -> Mot:
    return Mot(numbered(call, curve, call.optional("ENTIER")).ordinate_name)


def _legend(call: Call, curve: Curve) -> Mot:
    return Mot(numbered(call, curve, call.optional("ENTIER")).legend)


def _colour(call: Call, curve: Curve) -> Mot | ListMots:
    place = call.optional("ENTIER")
    if place is None:
        return ListMots([NAMES[p.colour] for p in curve.parts])
    return Mot(NAMES[numbered(call, curve, place).colour])


_PARTS = {
    "ABSC": _abscissas, "ORDO": _ordinates, "COUR": _curves, "PAS": _every, "AVAN": _before,
    "APRE": _after, "COMP": _window, "LEGX": _x_name, "LEGY": _y_name, "LEGE": _legend,
    "COUL": _colour,
}  # fmt: skip


@DIME.on("EVOLUTIO", en="Of curves: how many there are.", fr="D'évolutions : le nombre de courbes.")
def _count(call: Call, curve: Curve) -> int:
    return len(curve.parts)


@COPI.on("EVOLUTIO")
def _copy(call: Call, curve: Curve) -> Curve:
    return dataclasses.replace(curve)


@ORDO.on(
    "EVOLUTIO",
    syntax="EVOL2 = ORDO EVOL1 ('CROI' | 'DECR') ('ABSO') ;",
    en="Of curves: points in order of abscissas.",
    fr="D'évolutions : points dans l'ordre des abscisses.",
    examples=("LIST (ORDO (EVOL 'MANU' (PROG 2. 1.) (PROG 5. 6.))) ;",),
)
def _ordered(call: Call, curve: Curve) -> Curve:
    words = set()
    while (said := call.keyword(("CROI", "DECR", "ABSO"))) is not None:
        words.add(said)

    def choose(part: CurvePart) -> Any:
        keys = np.abs(part.abscissas) if "ABSO" in words else part.abscissas
        return np.argsort(-keys if "DECR" in words else keys, kind="stable")

    return _picked(curve, choose)


_FIELD_OF = {"LEGE": "legend", "NOMA": "abscissa_name", "NOMO": "ordinate_name"}


@CHAN.on(
    "TITR",
    "LEGE",
    "NOMA",
    "NOMO",
    of=("EVOLUTIO",),
    syntax="EVOL2 = CHAN 'TITR' | 'LEGE' | 'NOMABS' | 'NOMORD' EVOL1 (N1) MOT1 ;",
    en="TITR, LEGE, NOMABS, NOMORD change the title, the legend, the names of the axes of curves "
    "(of curve N1 only).",
    fr="TITR, LEGE, NOMABS, NOMORD changent le titre, la légende, les noms des axes d'évolutions "
    "(de la seule courbe N1).",
    examples=("E = CHAN 'LEGE' (EVOL 'MANU' (PROG 0. 1.) (PROG 2. 3.)) 'measured' ; LIST E ;",),
)
def _change(call: Call, word: str) -> Curve:
    curve: Curve = call.required("EVOLUTIO")
    place = call.optional("ENTIER")
    said = str(call.required("MOT")).rstrip()
    if word == "TITR":
        return dataclasses.replace(curve, title=said)
    change: dict[str, Any] = {_FIELD_OF[word]: said}
    if place is not None:
        numbered(call, curve, place)
    parts = tuple(
        dataclasses.replace(p, **change) if place in (None, i) else p
        for i, p in enumerate(curve.parts, start=1)
    )
    return dataclasses.replace(curve, parts=parts)


def _extreme(call: Call, curve: Curve, pick: Any) -> Any:
    absolute = call.keyword(("ABS",)) is not None
    places, xs, ys = [], [], []
    for part in curve.parts:
        if not len(part.ordinates):
            raise call.error("operators.curves.empty-curve", curve)
        i = int(pick(np.abs(part.ordinates) if absolute else part.ordinates))
        places.append(i + 1)
        xs.append(float(part.abscissas[i]))
        ys.append(float(part.ordinates[i]))
    if len(places) == 1:
        return places[0], xs[0], ys[0]
    return ListEnti(places), ListReel(xs), ListReel(ys)


@MAXI.on(
    "EVOLUTIO",
    syntax="N1 X1 Y1 = MAXI EVOL1 ('ABS') ;",
    en="Of a curve: place, abscissa and ordinate of the largest ordinate; of several, lists.",
    fr="D'une évolution : rang, abscisse et ordonnée de la plus grande ; de plusieurs, des listes.",
    examples=("I X Y = MAXI (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 3. 9. 1.)) ; LIST Y ;",),
)
def _largest(call: Call, curve: Curve) -> Any:
    return _extreme(call, curve, np.argmax)


@MINI.on(
    "EVOLUTIO",
    syntax="N1 X1 Y1 = MINI EVOL1 ('ABS') ;",
    en="Of a curve: place, abscissa and ordinate of the smallest ordinate; of several, lists.",
    fr="D'une évolution : rang, abscisse et ordonnée de la plus petite ; de plusieurs, des listes.",
)
def _smallest(call: Call, curve: Curve) -> Any:
    return _extreme(call, curve, np.argmin)


# ---- ET and signs -------------------------------------------------------------------------------


@union(("EVOLUTIO", "EVOLUTIO"))
def _join(a: Curve, b: Curve) -> Curve:
    kind = a.kind if a.kind == b.kind else "REEL"
    return Curve((*a.parts, *b.parts), a.title or b.title, kind)


@rule_with_call("+ - * /", "EVOLUTIO", "EVOLUTIO")
def _combine(call: Call, sign: str, a: Curve, b: Curve) -> Curve:
    made = combined(a, b, sign, _ARRAY[sign])
    colour = read_colour(call)
    if colour is None:
        return made
    parts = tuple(dataclasses.replace(p, colour=colour) for p in made.parts)
    return dataclasses.replace(made, parts=parts)


def _scaled(sign: str, curve: Curve, number: Any, left: bool) -> Curve:
    run = _ARRAY[sign]
    skip_phase = is_complex(curve) and sign in "*/"
    parts = []
    for part in curve.parts:
        if skip_phase and part.kind == "PHAS":
            parts.append(part)
            continue
        if sign == "/" and (np.any(part.ordinates == 0) if left else number == 0):
            raise NoResultError("division-by-zero")
        y = run(number, part.ordinates) if left else run(part.ordinates, number)
        parts.append(dataclasses.replace(part, ordinates=np.asarray(y, dtype=float)))
    return dataclasses.replace(curve, parts=tuple(parts))


for _kind in ("ENTIER", "FLOTTANT"):
    rule(SIGNS, "EVOLUTIO", _kind)(lambda sign, a, b: _scaled(sign, a, float(b), False))
    rule(SIGNS, _kind, "EVOLUTIO")(lambda sign, a, b: _scaled(sign, b, float(a), True))
