"""TFR TFRI FILT HANN COMT TOTE FDT: signals in time and frequency."""

from ssilang.io.plots.palette import COLOURS
from ssilang.kernel.curves.algebra import complex_values, is_complex
from ssilang.kernel.records import signals
from ssilang.operators.curves.words import *
from ssilang.operators.prelude import *

_PARTS = {"PREE": "PART REEL", "PIMA": "PART IMAG"}
_POLAR = {"MODU": "MODU", "PHAS": "PHAS"}


def spectrum(
    x: Any, values: Any, form: str, colours: tuple[int, int] = (0, 0), title: str = ""
) -> Curve:
    """A complex curve over frequencies, as real and imaginary parts or modulus and phase."""
    if form == "REIM":
        names, both = _PARTS, (values.real, values.imag)
    else:
        names, both = _POLAR, (np.abs(values), np.degrees(np.angle(values)))
    parts = tuple(
        CurvePart(x, np.asarray(y, dtype=float), "FREQ (HZ)", name, name, colour, (), kind)
        for y, (kind, name), colour in zip(both, names.items(), colours, strict=True)
    )
    return Curve(parts, title, "COMPLEXE")


_REIM = "real and imaginary parts, or modulus and phase"
_FORM = choice("form", ("REIM", "MOPH"), optional=False, en=_REIM)


@operator(
    "TFR",
    POWER,
    arg("signal", "EVOLUTIO", en="signal at constant step", over="s"),
    _FORM,
    *LIMITS,
    family="signals",
)
def tfr(
    call: Call,
    power: int,
    signal: Curve,
    form: str,
    lowest: float,
    highest: float,
    colour: str | None = COLOUR,
    second_colour: str | None = Choice(COLOURS, en="colour of the second curve"),
) -> Curve:
    """Transform signals."""
    part = one_part(call, signal)
    step = warned_step(call, part, 2**power, highest)
    f, values = signals.fourier(part.ordinates, step, 2**power)
    kept = (f >= lowest) & (f <= highest)
    shades = (shade(colour, 0), shade(second_colour, 0))
    return spectrum(f[kept], values[kept], form, shades, signal.title)


@tfr.form(
    POWER,
    arg("fields", "LISTCHPO", en="fields at constant step"),
    arg("times", "LISTREEL", en="their times", unit="s", range=ANY_NUMBER, usual=IN_ORDER),
    _FORM,
    *LIMITS,
)
def tfr_of_fields(
    call: Call,
    power: int,
    fields: ListChpo,
    times: ListReel,
    form: str,
    lowest: float,
    highest: float,
) -> tuple[ListChpo, ListChpo, ListReel]:
    """Transform fields: real and imaginary ones, and the frequencies."""
    held: list[Any] = fields.values
    if len(held) != len(times):
        told = {"n_fields": len(held), "n_times": len(times)}
        raise call.error("operators.curves.fields-and-times-differ", fields, **told)
    step, n = signals.constant_step(times.values), 2**power
    real: dict[str, Any] = {}
    f = np.empty(0)
    for name, first in held[0].components.items():
        rows = np.asarray([h.values_at(name, first.nodes) for h in held])
        f, real[name] = signals.fourier(rows, step, n)
    kept = np.flatnonzero((f >= lowest) & (f <= highest))
    like: NodeField = held[0]

    def field(k: int, part: str) -> NodeField:
        made = {
            name: NodeValues(like.components[name].nodes, getattr(values[k], part).copy())
            for name, values in real.items()
        }
        return NodeField(like.table, made, like.nature)

    lists = [ListChpo([field(int(k), part) for k in kept]) for part in ("real", "imag")]
    return lists[0], lists[1], ListReel(f[kept])


@operator("TFRI", family="signals")
def tfri(call: Call, curve: Curve = Arg("EVOLUTIO", en="complex curve")) -> Curve:
    """Transform back."""
    if not is_complex(curve) or len(curve.parts) != 2:
        raise call.error("operators.curves.complex-curve-wanted", curve)
    f = curve.parts[0].abscissas
    if len(f) and abs(f[0]) > 1e-9 * max(abs(f[-1]), 1e-300):
        raise call.error("operators.curves.frequencies-from-zero", curve, f=f[0])
    t, values = signals.inverse_fourier(f, complex_values(*curve.parts))
    part = CurvePart(t, values, "TEMPS", "SIGNAL", "", curve.parts[0].colour)
    return Curve((part,), curve.title)


_CUT = arg("cut", "FLOTTANT", en="cut-off frequency", unit="Hz", range=POSITIVE)


@operator("FILT", family="signals", full_name="FILTRE")
def filt(
    call: Call,
    power: int = POWER,
    type: bool = Flag("TYPE", en="its type follows"),
    kind: Chosen | None = Cases(
        {
            "PHAU": [_CUT],
            "PBAS": [_CUT],
            "OMEG": [arg("cut", "ENTIER", en="exponent", range=ANY_NUMBER)],
        },
        en="high-pass, low-pass, or power of the circular frequency",
    ),
    shown: bool = Flag("SORT", en="the parts wanted follow"),
    form: str = Choice(("REIM", "MOPH"), default="MOPH", en=_REIM + ", the default"),
    spacing: float = Key(
        "DFRQ", "FLOTTANT", range=POSITIVE, unit="Hz", default=0.0, en="step of frequency"
    ),
) -> Curve:
    """Make a filter."""
    if kind is None or spacing <= 0:
        raise call.error("operators.curves.filter-incomplete")
    f = spacing * np.arange(2 ** (power - 1) + 1)
    cut = kind["cut"]
    if kind.word == "OMEG":
        omega = 2j * np.pi * f
        if cut < 0:
            omega[0] = np.inf
        values = omega**cut
    else:
        ratio = 1j * f / cut
        values = (ratio if kind.word == "PHAU" else 1.0) / (1.0 + ratio)
    return spectrum(f, values, form)


@operator("HANN", family="signals", full_name="HANNING")
def hann(
    call: Call,
    curve: Curve = CURVE,
    passes: int = Arg("ENTIER", range=POSITIVE, en="how many times"),
    colour: str | None = COLOUR,
) -> Curve:
    """Smooth a spectrum."""
    part = one_part(call, curve)
    made = replace(
        part, ordinates=signals.smoothed(part.ordinates, passes), colour=shade(colour, part.colour)
    )
    return Curve((made,), f"HANNING({passes}) {curve.title}".rstrip(), curve.kind)


_PERCENT = opt(
    "percent",
    "FLOTTANT",
    range=between(0.0, 100.0),
    default=1e-6,
    en="threshold, 1.E-6 without it",
    unit="%",
)


@operator("COMT", family="signals", gives=ANY)
def comt(
    call: Call,
    curve: Curve = RECORD,
    percent: float = _PERCENT,
    peaks: bool = Flag("MAXI", en="peaks too"),
    begins: bool = Flag("DEBU", en="places where they begin too"),
    ends: bool = Flag("FIN", en="places where they end too"),
) -> Any:
    """Count shocks."""
    found = [signals.shocks(p.ordinates, percent) for p in curve.parts]
    if not (peaks or begins or ends):
        return ListEnti([len(f[1]) for f in found])
    if len(found) != 1:
        raise call.error("operators.curves.peaks-of-one-curve", curve)
    largest, first, last = found[0]
    more: list[Any] = [ListReel(largest)] if peaks else []
    more += [ListEnti(first)] if begins else []
    more += [ListEnti(last)] if ends else []
    return (len(first), *more)


@operator("TOTE", family="signals", full_name="TOTEMP")
def tote(curve: Curve = RECORD, percent: float = _PERCENT) -> ListReel:
    """Measure durations."""
    levels = [percent / 100.0 * float(np.abs(p.ordinates).max()) for p in curve.parts]
    pairs = zip(curve.parts, levels, strict=True)
    return ListReel([signals.time_above(p.abscissas, p.ordinates, v) for p, v in pairs])


_AXIS = arg("name", "MOT", en="name of the ordinates")


@operator("FDT", family="signals")
def fdt(
    name: str = _AXIS,
    step: float = Key(
        "CONS", "FLOTTANT", range=POSITIVE, unit="s", optional=False, en="constant step"
    ),
    values: ListReel = Arg("LISTREEL", en="ordinates", range=ANY_NUMBER),
) -> Curve:
    """A curve at a constant step."""
    return _in_time(step * np.arange(len(values)), values.values, name)


@fdt.form()
def fdt_of_times(
    call: Call,
    name: str = _AXIS,
    given: bool = Flag("NOCO", en="times are given"),
    pairs: bool = Flag("COUP", en="by pairs"),
    values: ListReel = Arg(
        "LISTREEL", en="times and ordinates, or the step or 0", range=ANY_NUMBER
    ),
    second: ListReel | None = Opt(
        "LISTREEL", en="ordinates, or pairs of time and ordinate", range=ANY_NUMBER
    ),
) -> Curve:
    """A curve over given times."""
    numbers = values.values
    if second is not None:
        if len(numbers) == 1 and numbers[0] > 0:
            return _in_time(numbers[0] * np.arange(len(second)), second.values, name)
        numbers, pairs = second.values, True
    if len(numbers) % 2:
        raise call.error("operators.curves.times-and-values-in-pairs", n_values=len(numbers))
    if pairs:
        times, values_there = numbers[::2], numbers[1::2]
    else:
        times, values_there = np.split(numbers, 2)
    warn_of_order(call, times)
    return _in_time(times, values_there, name)


def _in_time(t: Any, y: Any, name: str) -> Curve:
    return Curve((CurvePart(np.asarray(t, dtype=float), np.array(y), "TEMPS", name[:12]),))
