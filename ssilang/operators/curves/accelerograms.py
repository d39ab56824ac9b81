"""INSI COSI CHSP DSPR PSRS: integrated and corrected records, spectra of power and of response."""

from ssilang.io.plots.palette import index_of
from ssilang.kernel.records.filters import brought_to_rest, integrated, without_trend
from ssilang.kernel.records.power import power_density, response_spectrum
from ssilang.kernel.records.signals import constant_step
from ssilang.operators.curves.words import *
from ssilang.operators.prelude import *

_KINDS = ("DEPL", "VITE", "ACCE")
_SHAKEN = 10  # changes of sign that make a record of a curve
_ADDED = 0.2  # of the largest value: a mean that no record has
_DRIFT = 0.1  # of the largest velocity, that a record may end with


_RULE = choice(
    "rule",
    ("SIMP", "LINE"),
    default="SIMP",
    en="by trapezoids (default), or exactly for an acceleration linear in the steps",
)


@operator("INSI", family="signals")
def insi(call: Call, curve: Curve = RECORD, rule: str = _RULE) -> tuple[Curve, Curve]:
    """Integrate records."""
    warn_of_motions(call, curve)
    linear = rule == "LINE"
    moved, fast = [], []
    for p in curve.parts:
        v, d = integrated(p.ordinates, constant_step(p.abscissas), linear)
        shaken = np.count_nonzero(np.diff(np.signbit(p.ordinates))) > _SHAKEN
        # @SEISME tells it itself
        if shaken and not call.session.in_library and abs(v[-1]) > _DRIFT * np.abs(v).max():
            told, mean = {"speed": float(v[-1]), "way": float(d[-1])}, float(p.ordinates.mean())
            added = abs(mean) > _ADDED * np.abs(p.ordinates).max()
            call.warn("operators.curves.drifts", curve, **told, mean=mean if added else 0.0)
        moved.append(replace(p, ordinates=d, ordinate_name="DEPL"))
        fast.append(replace(p, ordinates=v, ordinate_name="VITE"))
    return Curve(tuple(moved), curve.title), Curve(tuple(fast), curve.title)


@operator("COSI", family="signals")
def cosi(
    call: Call,
    curve: Curve = RECORD,
    rule: str = _RULE,
    degree: int | None = Key(
        "POLY",
        arg("degree", "ENTIER", en="from 1 to 6", range=between(1, 6)),
        en="degree of the velocity's polynomial",
    ),
) -> Curve:
    """Correct records."""
    warn_of_motions(call, curve)
    linear = rule == "LINE"

    def corrected(values: FloatArray, step: float) -> FloatArray:
        if degree is None:
            return brought_to_rest(values, step, linear)
        return without_trend(values, step, degree, linear)

    parts = [
        replace(p, ordinates=corrected(p.ordinates, constant_step(p.abscissas)))
        for p in curve.parts
    ]
    return Curve(tuple(parts), curve.title)


@operator("CHSP", family="signals")
def chsp(
    call: Call,
    spectrum: Curve = Arg("EVOLUTIO", en="spectra over frequencies", over="Hz"),
    given: str = Key(
        "ENTR", arg("kind", "MOT", en="DEPL, VITE or ACCE"), optional=False, en="what they are"
    ),
    wanted: str = Key(
        "SORT", arg("kind", "MOT", en="DEPL, VITE or ACCE"), optional=False, en="what they become"
    ),
    colour: str | None = Key("COUL", "MOT", kind="colour", en="colour"),
) -> Curve:
    """Change the unit of spectra."""
    names = [w.strip().upper()[:4] for w in (given, wanted)]
    for name in names:
        if name not in _KINDS:
            raise call.error("operators.curves.kind-of-spectrum", name=name)
    power = _KINDS.index(names[1]) - _KINDS.index(names[0])
    parts = []
    for p in spectrum.parts:
        if power < 0 and (p.abscissas <= 0.0).any():
            raise call.error("operators.curves.frequency-not-positive", spectrum)
        y = p.ordinates * (2.0 * np.pi * p.abscissas) ** power
        shade = p.colour if colour is None else index_of(colour)
        parts.append(replace(p, ordinates=y, ordinate_name=names[1], colour=shade))
    return Curve(tuple(parts), spectrum.title)


@operator("DSPR", POWER, RECORD, *LIMITS, family="signals")
def dspr(
    call: Call, power: int, curve: Curve, lowest: float, highest: float, colour: str | None = COLOUR
) -> Curve:
    """Power density."""
    part = one_part(call, curve)
    step = warned_step(call, part, 2**power, highest)
    f, y = power_density(part.ordinates, step, 2**power)
    kept = (f >= abs(lowest)) & (f <= (abs(highest) or np.inf))
    index = shade(colour, 0)
    made = CurvePart(f[kept], y[kept], "FREQ (HZ)", "DSP UN**2/HZ", part.legend, index)
    return Curve((made,), curve.title)


ABSCISSA = choice(
    "abscissa", ("PERI", "FREQ"), default="PERI", en="over periods (default) or frequencies"
)
KIND = choice(
    "kind",
    ("ACCE", "VITE", "DEPL"),
    default="ACCE",
    en="absolute acceleration (default), relative velocity or displacement",
)
PERIODS = opt(
    "periods",
    "LISTREEL",
    range=POSITIVE,
    en="periods, 75 from 0.04 s to the duration without it",
    unit="s",
)


@operator("PSRS", family="signals")
def psrs(
    call: Call,
    curve: Curve = Arg("EVOLUTIO", en="power density per hertz", over="Hz"),
    duration: float = Arg("FLOTTANT", range=POSITIVE, en="duration", unit="s"),
    dampings: ListReel = Arg("LISTREEL", range=NOT_NEGATIVE, usual=BELOW_CRITICAL, en="dampings"),
    periods: ListReel | None = PERIODS,
    abscissa: str = ABSCISSA,
    kind: str = KIND,
    law: str = Choice(
        ("CRAM", "NEWG"), default="CRAM", en="law of rare crossings (default), or of Gumbel"
    ),
    colour: str | None = COLOUR,
) -> Curve:
    """Response spectra of a power spectrum."""
    part = one_part(call, curve)
    if periods is None and duration <= 0.04:
        raise call.error("operators.curves.duration-too-short", duration=duration)
    over = np.geomspace(0.04, duration, 75) if periods is None else periods.values
    index = shade(colour, part.colour)
    parts = []
    for xi in dampings.values:
        y = response_spectrum(part.abscissas, part.ordinates, duration, over, float(xi), kind, law)
        parts.append(spectrum_part(over, y, abscissa, kind, float(xi), index))
    return Curve(tuple(parts), curve.title)


def spectrum_part(
    periods: FloatArray, y: FloatArray, abscissa: str, kind: str, damping: float, colour: int
) -> CurvePart:
    """One response spectrum as a curve, over periods or over frequencies."""
    legend = f"{100.0 * damping:g} %"
    if abscissa == "PERI":
        made = CurvePart(periods, y, "PERIODE", f"RSPE-{kind}", legend, colour)
        return made.measured("s")
    made = CurvePart(1.0 / periods[::-1], y[::-1], "FREQUENCE", f"RSPE-{kind}", legend, colour)
    return made.measured("Hz")
