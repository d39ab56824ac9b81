"""SIAR PERT PRNS: artificial signals, random perturbations, spectra of modulated signals."""

from ssilang.kernel.records import modulated
from ssilang.operators.curves.accelerograms import ABSCISSA, KIND, PERIODS, spectrum_part
from ssilang.operators.curves.words import COLOUR, one_part, shade
from ssilang.operators.numbers.noise import session_generator
from ssilang.operators.prelude import *

_SERIES = ("ACCE", "VITE", "DEPL")
_SEED = key("seed", "INIT", "ENTIER", range=ANY_NUMBER, en="start of the random numbers")


def _drawn(call: Call, seed: int | None) -> np.random.Generator:
    """A generator begun by the user's number, or the session's."""
    return session_generator(call, None) if seed is None else np.random.default_rng(abs(seed))


@operator("SIAR", family="signals", full_name="SIAR", gives=ANY)
def siar(
    call: Call,
    spectrum: Curve = Arg("EVOLUTIO", en="power density per hertz", over="Hz"),
    modulation: Curve | None = Opt("EVOLUTIO", en="modulations in time by bands of frequencies"),
    limits: ListReel | None = Opt("LISTREEL", range=RISING, en="limits of the bands", unit="Hz"),
    duration: float | None = Opt("FLOTTANT", range=POSITIVE, en="end of the signals", unit="s"),
    start: float | None = Key(
        "TINI", "FLOTTANT", range=NOT_NEGATIVE, unit="s", en="start of the signals"
    ),
    acceleration: bool = Flag("ACCE", en="acceleration"),
    velocity: bool = Flag("VITE", en="velocity"),
    displacement: bool = Flag("DEPL", en="displacement"),
    n_signals: int = Key(
        "NCOU", "ENTIER", range=POSITIVE, default=1, en="number of signals, 1 without it"
    ),
    n_instants: int | None = Key(
        "NPOI", "ENTIER", range=POSITIVE, en="number of instants, steps of 0.02 s without it"
    ),
    n_sines: int | None = Key(
        "NSIN", "ENTIER", range=POSITIVE, en="number of sines, slices of 0.1 Hz without it"
    ),
    seed: int | None = _SEED,
) -> Any:
    """Draw signals."""
    part = one_part(call, spectrum)
    if modulation is not None and limits is None:
        raise call.missing(("LISTREEL",))
    bands = _bands(call, part, modulation, limits.values if limits else None, duration)
    held = bands[0].times
    begin = float(held[0] if start is None else start)
    end = float(held[-1] if duration is None else duration)
    if not held[0] <= begin < end <= held[-1]:
        told = {"start": begin, "end": end, "first": held[0], "last": held[-1]}
        raise call.error("operators.curves.signals-outside-modulation", **told)
    width = float(part.abscissas[-1] - part.abscissas[0])
    count = max(round(width / 0.1), 1) if n_sines is None else n_sines
    samples = round((end - begin) / 0.02) + 1 if n_instants is None else n_instants
    if samples < 2 or count < 1:
        raise call.error("operators.curves.signal-too-short")
    times = np.linspace(begin, end, samples)
    f, amplitudes = modulated.sines(part.abscissas, part.ordinates, count)
    generator = _drawn(call, seed)
    drawn = []
    for _ in range(n_signals):
        phases = 2.0 * np.pi * generator.random(count)
        drawn.append(modulated.motion(times, f, amplitudes, phases, bands, float(held[0])))
    asked = zip(_SERIES, (acceleration, velocity, displacement), strict=True)
    wanted = [w for w, said in asked if said] or _SERIES
    made = [_series(times, drawn, w, part.colour) for w in wanted]
    return made[0] if len(made) == 1 else tuple(made)


def _series(times: FloatArray, drawn: list[Any], word: str, colour: int) -> Curve:
    place = _SERIES.index(word)
    parts = [
        CurvePart(times, rows[place], "TEMPS", f"{word} {k}", f"SIGNAL {k}", colour)
        for k, rows in enumerate(drawn, 1)
    ]
    return Curve(tuple(parts), f"SIGNAL {word}")


def _bands(
    call: Call, spectrum: CurvePart, modulation: Curve | None, limits: Any, end: float | None
) -> tuple[modulated.Band, ...]:
    f = spectrum.abscissas
    if len(f) < 2 or (np.diff(f) <= 0).any() or f[0] < 0:
        raise call.error("operators.curves.not-a-power-spectrum")
    if modulation is None:
        if end is None:
            raise call.missing(("FLOTTANT",))
        times = np.array([min(0.0, end), end])
        return (modulated.Band(float(f[0]), float(f[-1]), times, np.ones(2)),)
    if len(limits) != len(modulation.parts) + 1:
        told = {"n_parts": len(modulation.parts), "least": len(modulation.parts) + 1}
        told |= {"n_limits": len(limits)}
        raise call.error("operators.curves.limits-of-bands", **told)
    pairs = zip(limits[:-1], limits[1:], modulation.parts, strict=True)
    bands = tuple(modulated.Band(float(a), float(b), p.abscissas, p.ordinates) for a, b, p in pairs)
    ends = np.array([[b.times[0], b.times[-1]] for b in bands])
    if np.ptp(ends, axis=0).max() > 1e-6:
        raise call.error("operators.curves.modulations-differ", modulation)
    return bands


@operator("PERT", family="signals")
def pert(
    call: Call,
    values: ListReel = Arg("LISTREEL", en="values", range=ANY_NUMBER),
    signs: bool = Flag("SIGN", en="signs drawn, the default"),
    degrees: float | None = Key(
        "AMPL",
        "FLOTTANT",
        unit="deg",
        usual=between(0.0, 90.0),
        en="largest angle whose sin^2 is the share given to the neighbours",
    ),
    seed: int | None = _SEED,
) -> ListReel:
    """Perturb values."""
    generator = _drawn(call, seed)
    return ListReel(
        modulated.perturbed(values.values, generator, signs or degrees is None, degrees)
    )


@operator("PRNS", family="signals")
def prns(
    call: Call,
    curve: Curve = Arg("EVOLUTIO", en="power density per hertz", over="Hz"),
    modulation: Curve = Arg("EVOLUTIO", en="a curve for each band"),
    bands: ListReel = Arg("LISTREEL", range=RISING, en="limits of the bands", unit="Hz"),
    periods: ListReel | None = PERIODS,
    damping: float = Opt(
        "FLOTTANT",
        range=NOT_NEGATIVE,
        usual=BELOW_CRITICAL,
        default=0.05,
        en="damping, 0.05 without it",
    ),
    kind: str = KIND,
    abscissa: str = ABSCISSA,
    colour: str | None = COLOUR,
    n_processes: int | None = Key(
        "NBPR", "ENTIER", range=POSITIVE, en="number of processes, of about 2 s without it"
    ),
    n_instants: int = Key(
        "NBIN", "ENTIER", range=POSITIVE, default=10, en="instants of each, 10 without it"
    ),
    rest: float = Key(
        "TPLU",
        "FLOTTANT",
        range=NOT_NEGATIVE,
        unit="s",
        default=20.0,
        en="time behind the end, 20 without it",
    ),
    precision: float = Key(
        "PREC",
        "FLOTTANT",
        range=POSITIVE,
        default=1e-3,
        en="precision of the levels, 1.E-3 without it",
    ),
    defaults: bool = Flag("NBDE", en="the defaults"),
    root_1: bool = Flag("NEG1", en="accepted, changes nothing"),
    root_2: bool = Flag("NEG2", en="accepted, changes nothing"),
    wavelets: bool = Flag("ONDE", en="not available"),
) -> Curve:
    """Response spectrum of a modulated power spectrum."""
    if wavelets:
        raise call.error("operators.curves.no-modulation-of-wavelets")
    power = one_part(call, curve)
    signal = modulated.ModulatedSignal(
        power.abscissas, power.ordinates, np.asarray(bands.values, dtype=float),
        tuple(p.abscissas for p in modulation.parts), tuple(p.ordinates for p in modulation.parts),
    )  # fmt: skip
    if periods is None and signal.duration <= 0.04:
        raise call.error("operators.curves.duration-too-short", duration=signal.duration)
    over = np.geomspace(0.04, signal.duration, 75) if periods is None else periods.values
    if n_processes is None:
        n_processes = max(round(signal.duration / 2.0), 1)
    resolution = modulated.Resolution(n_processes, n_instants, rest, precision)
    order = np.argsort(over)
    values = modulated.modulated_response_spectrum(signal, over[order], damping, kind, resolution)
    index = shade(colour, power.colour)
    part = spectrum_part(over[order], values, abscissa, kind, damping, index)
    return Curve((part,), curve.title)
