"""PROL CONC LSQF MAPP CMOY LAPL: curves made longer, joined, simplified, and read off others."""

from ssilang.kernel.records import signals
from ssilang.operators.curves.words import COLOUR, CURVE, shade
from ssilang.operators.prelude import *


@operator("PROL", family="curves")
def prol(
    call: Call,
    rule: str = Choice(
        ("BORN", "LINE"),
        default="BORN",
        en="by the value at the end (default), or along the last two points",
    ),
    curve: Curve = CURVE,
    first: float = Arg("FLOTTANT", en="abscissa to reach", range=ANY_NUMBER),
    second: float | None = Opt("FLOTTANT", en="another one", range=ANY_NUMBER),
) -> Curve:
    """Continue curves."""
    wanted = [first] if second is None else [first, second]
    return replace(
        curve, parts=tuple(_continued(call, p, wanted, rule == "LINE") for p in curve.parts)
    )


def _continued(call: Call, part: CurvePart, wanted: list[float], line: bool) -> CurvePart:
    x, y = part.abscissas, part.ordinates
    if part.words or part.abscissa_words or len(x) < 1 + line:
        raise call.error("operators.curves.cannot-be-continued")
    order = np.argsort(x, kind="stable")
    low, high = order[:2], order[-1:-3:-1]
    rising, added = x[0] <= x[-1], list[tuple[float, float]]()
    for w in sorted(set(wanted), reverse=not rising):
        if x.min() <= w <= x.max():
            continue
        ends = low if w < x.min() else high
        value = float(y[ends[0]])
        if line:
            run = float(x[ends[1]] - x[ends[0]])
            if run == 0.0:
                raise call.error("operators.curves.last-points-together")
            value += (w - float(x[ends[0]])) * float(y[ends[1]] - y[ends[0]]) / run
        added.append((w, value))
    before = [row for row in added if (row[0] < x.min()) == rising]
    rows = [*before, *zip(x, y, strict=True), *added[len(before) :]]
    made = np.array(rows)
    return replace(part, abscissas=made[:, 0], ordinates=made[:, 1])


@operator("CONC", family="curves", full_name="CONCAT")
def conc(
    call: Call,
    first: Curve = Arg("EVOLUTIO", en="curves"),
    second: Curve = Arg("EVOLUTIO", en="as many curves"),
) -> Curve:
    """Join curves."""
    if len(first.parts) != len(second.parts):
        told = {"n_parts": len(first.parts), "n_others": len(second.parts)}
        raise call.error("operators.curves.curves-two-by-two", **told)
    parts = []
    for a, b in zip(first.parts, second.parts, strict=True):
        if bool(a.words) != bool(b.words):
            raise call.error("operators.curves.words-and-numbers")
        one, two = (a, b) if _start(a) <= _start(b) else (b, a)
        if _start(two) < one.abscissas.max(initial=-np.inf):
            call.warn("operators.curves.curves-overlap", last=one.abscissas[-1], first=_start(two))
        parts.append(
            replace(
                a,
                abscissas=np.concatenate([one.abscissas, two.abscissas]),
                ordinates=np.concatenate([one.ordinates, two.ordinates]),
                words=one.words + two.words,
                abscissa_words=one.abscissa_words + two.abscissa_words,
            )
        )
    return replace(first, parts=tuple(parts))


def _start(part: CurvePart) -> float:
    return float(part.abscissas[0]) if len(part.abscissas) else np.inf


@operator("LSQF", family="curves")
def lsqf(
    call: Call,
    curve: Curve = CURVE,
    count: int = Arg("ENTIER", range=POSITIVE, en="number of intervals"),
    uniform: bool = Flag("UNIF", en="of equal length, the default"),
    best: int | None = Key("OPTI", "ENTIER", range=POSITIVE, en="not available"),
    size: int | None = Key(
        "REDU", "ENTIER", range=POSITIVE, en="steps of the signal in an interval"
    ),
) -> Curve:
    """Simplify signals."""
    if best is not None:
        raise call.error("operators.curves.no-optimal-fit")
    parts = []
    for p in curve.parts:
        signals.constant_step(p.abscissas)
        wanted = count if size is None else max(count, (len(p.abscissas) - 1) // size)
        if wanted > len(p.abscissas) - 1:
            call.warn("operators.curves.few-samples", wanted=wanted, count=len(p.abscissas))
        x, y = signals.energy_envelope(p.abscissas, p.ordinates, wanted)
        parts.append(replace(p, abscissas=x, ordinates=y))
    return Curve(tuple(parts), curve.title)


@operator("MAPP", family="curves")
def mapp(
    call: Call,
    colour: str | None = COLOUR,
    force: Curve = Arg("EVOLUTIO", en="contact force", unit="N"),
    moved: Curve = Arg("EVOLUTIO", en="displacement", unit="m"),
    speed: Curve = Arg("EVOLUTIO", en="velocity", unit="m/s"),
) -> Curve:
    """Poincaré map."""
    parts = []
    for f in force.parts:
        x, y = f.abscissas, np.abs(f.ordinates) > 0.0
        begins = x[np.flatnonzero(~y[:-1] & y[1:]) + 1]
        pair = [_at(call, c, begins) for c in (moved, speed)]
        parts.append(CurvePart(pair[0], pair[1], "DEPL", "VITE", "", shade(colour or "BLAN", 0)))
    return Curve(tuple(parts), "CARTE DE POINCARE")


def _at(call: Call, curve: Curve, times: FloatArray) -> FloatArray:
    part = curve.parts[0]
    if len(part.abscissas) == 0 or (np.clip(times, *part.abscissas[[0, -1]]) != times).any():
        raise call.error("operators.curves.times-of-force-not-covered", curve)
    return np.asarray(np.interp(times, part.abscissas, part.ordinates))


@operator("CMOY", family="signals")
def cmoy(
    call: Call,
    records: Curve = Arg("EVOLUTIO", en="records", over="s"),
    duration: float = Key(
        "ACQU",
        "FLOTTANT",
        range=POSITIVE,
        unit="s",
        optional=False,
        en="time that a shock is recorded",
    ),
    percent: float = Key(
        "DECL",
        "FLOTTANT",
        unit="%",
        range=between(0.0, 100.0),
        default=1e-6,
        en="threshold of the largest absolute value, 1.E-6 without it",
    ),
    count: int | None = Key(
        "NCHO", "ENTIER", range=POSITIVE, en="number of shocks kept, all without it"
    ),
) -> Curve:
    """Mean shock."""
    parts = []
    for p in records.parts:
        signals.constant_step(p.abscissas)
        x, y = signals.mean_shock(p.abscissas, p.ordinates, percent, duration, count)
        parts.append(replace(p, abscissas=x, ordinates=y))
    return Curve(tuple(parts), records.title)


@operator("LAPL", family="signals", full_name="LAPLACE")
def lapl(
    call: Call,
    inverse: bool = Flag("INVERSE", en="the inverse transform"),
    omega: ListReel = Arg("LISTREEL", en="circular frequencies", unit="rad/s", range=RISING),
    real: ListReel = Arg("LISTREEL", en="real parts", range=ANY_NUMBER),
    imaginary: ListReel = Arg("LISTREEL", en="imaginary parts", range=ANY_NUMBER),
    shift: float = Arg("FLOTTANT", en="real part a of the variable", range=ANY_NUMBER),
    group: int = Arg("ENTIER", en="group size", range=POSITIVE),
) -> Curve:
    """Inverse Laplace transform."""
    if not inverse:
        raise call.error("operators.curves.only-inverse-transform")
    if len(real) != len(imaginary):
        raise call.error(
            "operators.curves.parts-differ", n_real=len(real), n_imaginary=len(imaginary)
        )
    t, y = signals.inverse_laplace(omega.values, real.values + 1j * imaginary.values, shift, group)
    return Curve((CurvePart(t, y, "TEMPS", "F(T)", "LAPLACE INVERSE"),))
