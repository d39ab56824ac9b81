"""Curves in EXTR DIME CHAN ORDO MAXI MINI COPI ET and in signs."""

from ssilang.io.plots.palette import COLOURS
from ssilang.kernel.curves.algebra import combined, is_complex
from ssilang.kernel.waves.shaken import GRAVITIES
from ssilang.operators.curves.words import CURVE, read_colour
from ssilang.operators.dispatch import CHAN, COPI, DIME, EXTR, MAXI, MINI, ORDO, union
from ssilang.operators.numbers.arithmetic import _ARRAY, SIGNS, rule, rule_with_call
from ssilang.operators.prelude import *


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


_MAIN = main("curve", "EVOLUTIO", en="curves")
_NUMBER = opt("place", "ENTIER", en="number of the curve", range=POSITIVE)
_BY_PLACE = flag("by_place", "INDI", en="limits are places of points")
_LOW = arg("low", "FLOTTANT", en="first abscissa", range=ANY_NUMBER)
_HIGH = arg("high", "FLOTTANT", en="last abscissa", range=ANY_NUMBER)
_ZERO = flag("zero", "ZERO", en="abscissas begin at 0")


@EXTR.form(
    _MAIN,
    select(
        "what",
        {
            "ABSC": [_NUMBER],
            "ORDO": [_NUMBER],
            "COUR": [
                arg(
                    "which",
                    "ENTIER",
                    "LISTENTI",
                    "MOT",
                    en="number, numbers, or name of an axis",
                    range=POSITIVE,
                )
            ],
            "PAS": [arg("step", "ENTIER", range=POSITIVE, en="one point of so many")],
            "AVAN": [_BY_PLACE, _HIGH],
            "APRE": [_BY_PLACE, _LOW, _ZERO],
            "COMP": [_BY_PLACE, _LOW, _HIGH, _ZERO],
            "LEGX": [_NUMBER],
            "LEGY": [_NUMBER],
            "LEGE": [_NUMBER],
            "COUL": [_NUMBER],
        },
        optional=False,
        en="abscissas, ordinates, curves, points before, after or between, names, colours",
    ),
    gives=by(
        "what",
        {
            "ABSC": "LISTREEL|LISTMOTS",
            "ORDO": "LISTREEL|LISTENTI|LISTMOTS",
            "LEGX": "MOT",
            "LEGY": "MOT",
            "LEGE": "MOT",
            "COUL": "MOT|LISTMOTS",
        },
        "EVOLUTIO",
    ),
)
def extr_curve(call: Call, curve: Curve, what: Chosen) -> Any:
    """A part of curves, by a word."""
    return _PARTS[what.word](call, curve, **what.values)


@EXTR.form(gives="LISTREEL|LISTENTI|LISTMOTS")
def extr_axis(
    call: Call, curve: Curve = _MAIN, name: str = Arg("MOT", en="name of an axis")
) -> ListReel | ListEnti | ListMots:
    """What stands along the axis of a name."""
    wanted = name.rstrip()[:12]
    for part in curve.parts:
        if part.abscissa_name.rstrip() == wanted:
            return abscissa_list(part)
        if part.ordinate_name.rstrip() == wanted:
            return ordinate_list(part)
    names = sorted({n for p in curve.parts for n in (p.abscissa_name, p.ordinate_name)} - {""})
    raise call.error(
        "operators.curves.no-axis-of-name", name, wanted=wanted, names=[f"'{n}'" for n in names]
    )


def _curves(call: Call, curve: Curve, which: int | ListEnti | str) -> Curve:
    if isinstance(which, str):
        wanted = which.rstrip()[:12]
        parts = tuple(
            p for p in curve.parts if wanted in (p.abscissa_name.rstrip(), p.ordinate_name.rstrip())
        )
        if not parts:
            raise call.error("operators.curves.no-axis-with-name", which, wanted=wanted)
    else:
        places = which.values.tolist() if isinstance(which, ListEnti) else [which]
        parts = tuple(numbered(call, curve, int(i)) for i in places)
    return Curve(parts, curve.title, curve.kind)


def _pick(part: CurvePart, kept: Any, zero: bool = False) -> CurvePart:
    x: FloatArray = part.abscissas[kept]
    if zero and len(x):
        x = x - x[0]
    words = tuple(np.asarray(part.words)[kept]) if part.words else ()
    marks = tuple(np.asarray(part.abscissa_words)[kept]) if part.abscissa_words else ()
    return replace(
        part, abscissas=x, ordinates=part.ordinates[kept], words=words, abscissa_words=marks
    )


def _picked(curve: Curve, choose: Any, zero: bool = False) -> Curve:
    parts = tuple(_pick(p, choose(p), zero) for p in curve.parts)
    return replace(curve, parts=parts)


def _between(
    call: Call, curve: Curve, by_place: bool, low: float, high: float, zero: bool = False
) -> Curve:
    def choose(part: CurvePart) -> Any:
        x = np.arange(1, len(part.abscissas) + 1) if by_place else part.abscissas
        slack = 0.0 if by_place else 1e-10 * max(float(np.ptp(part.abscissas)), 1e-300)
        return (x >= low - slack) & (x <= high + slack)

    return _picked(curve, choose, zero)


def _colour(call: Call, curve: Curve, place: int | None) -> Mot | ListMots:
    if place is None:
        return ListMots([COLOURS[p.colour] for p in curve.parts])
    return Mot(COLOURS[numbered(call, curve, place).colour])


_PARTS: dict[str, Any] = {
    "ABSC": lambda call, curve, place: abscissa_list(numbered(call, curve, place)),
    "ORDO": lambda call, curve, place: ordinate_list(numbered(call, curve, place)),
    "COUR": _curves,
    "PAS": lambda call, curve, step: _picked(curve, lambda p: slice(None, None, step)),
    "AVAN": partial(_between, low=-np.inf),
    "APRE": partial(_between, high=np.inf),
    "COMP": _between,
    "LEGX": lambda call, curve, place: Mot(numbered(call, curve, place).abscissa_name),
    "LEGY": lambda call, curve, place: Mot(numbered(call, curve, place).ordinate_name),
    "LEGE": lambda call, curve, place: Mot(numbered(call, curve, place).legend),
    "COUL": _colour,
}


@DIME.form()
def count_curves(curve: Curve = _MAIN) -> int:
    """Number of curves."""
    return len(curve.parts)


@COPI.form()
def copy_curves(curve: Curve = _MAIN) -> Curve:
    """A copy."""
    return replace(curve)


@ORDO.form()
def ordered(
    curve: Curve = _MAIN,
    order: str = Choice(("CROI", "DECR"), default="CROI", en="increasing (default) or decreasing"),
    absolute: bool = Flag("ABSO", en="by absolute values"),
) -> Curve:
    """Points in order of abscissas."""

    def choose(part: CurvePart) -> Any:
        keys = np.abs(part.abscissas) if absolute else part.abscissas
        return np.argsort(-keys if order == "DECR" else keys, kind="stable")

    return _picked(curve, choose)


_FIELD_OF = {"LEGE": "legend", "NOMA": "abscissa_name", "NOMO": "ordinate_name"}


@CHAN.form(said("TITR", *_FIELD_OF), of=("EVOLUTIO",))
def change_names(
    call: Call,
    word: str,
    curve: Curve = CURVE,
    place: int | None = Opt("ENTIER", en="number of the curve, all without it", range=POSITIVE),
    name: str = Arg("MOT", en="title, legend or name"),
) -> Curve:
    """Other titles, legends, names of axes."""
    name = name.rstrip()
    if word == "TITR":
        return replace(curve, title=name)
    change: dict[str, Any] = {_FIELD_OF[word]: name}
    if place is not None:
        numbered(call, curve, place)
    parts = tuple(
        replace(p, **change) if place in (None, i) else p
        for i, p in enumerate(curve.parts, start=1)
    )
    return replace(curve, parts=parts)


_ABSOLUTE = flag("absolute", "ABS", en="of absolute values")
_EXTREME = ("ENTIER|LISTENTI", "FLOTTANT|LISTREEL", "FLOTTANT|LISTREEL")


def _extreme(call: Call, curve: Curve, absolute: bool, pick: Any) -> Any:
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


@MAXI.form(gives=_EXTREME)
def largest_ordinate(call: Call, curve: Curve = _MAIN, absolute: bool = _ABSOLUTE) -> Any:
    """The largest ordinate."""
    return _extreme(call, curve, absolute, np.argmax)


@MINI.form(gives=_EXTREME)
def smallest_ordinate(call: Call, curve: Curve = _MAIN, absolute: bool = _ABSOLUTE) -> Any:
    """The smallest ordinate."""
    return _extreme(call, curve, absolute, np.argmin)


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
    parts = tuple(replace(p, colour=colour) for p in made.parts)
    return replace(made, parts=parts)


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
        parts.append(replace(part, ordinates=np.asarray(y, dtype=float)))
    return replace(curve, parts=tuple(parts))


_NORMED = 0.01  # of a record whose largest value is one


@rule_with_call("*", "EVOLUTIO", "FLOTTANT")
def _times(call: Call, sign: str, curve: Curve, number: float) -> Curve:
    """Told: a record in m/s2, but one of a peak of 1, times what makes m/s2 of g."""
    known = [p for p in curve.parts if p.units[1] == "m/s2" and abs(number) in GRAVITIES]
    for peak in (float(np.abs(p.ordinates).max(initial=0.0)) for p in known):
        if abs(peak - 1.0) > _NORMED:
            call.warn("operators.curves.gravity-again", curve, number=number, value=peak)
    return _scaled(sign, curve, number, False)


@rule_with_call("*", "FLOTTANT", "EVOLUTIO")
def _times_left(call: Call, sign: str, number: float, curve: Curve) -> Curve:
    return _times(call, sign, curve, number)


for _kind in ("ENTIER", "FLOTTANT"):
    rule(SIGNS, "EVOLUTIO", _kind)(lambda sign, a, b: _scaled(sign, a, float(b), False))
    rule(SIGNS, _kind, "EVOLUTIO")(lambda sign, a, b: _scaled(sign, b, float(a), True))
