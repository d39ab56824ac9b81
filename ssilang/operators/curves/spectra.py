"""Spectra of oscillators, linear and yielding (SPON), of floors (ZSPP), their envelopes; VALP."""

from ssilang.io.plots.palette import index_of
from ssilang.kernel.modal.oscillator import default_frequencies, response, spectrum
from ssilang.kernel.records.floors import Storey, floor_spectrum
from ssilang.kernel.records.inelastic import limits_for_ductility, yielding_peaks
from ssilang.kernel.records.signals import rotated_spectra
from ssilang.operators.curves.words import *
from ssilang.operators.mesh.selection.boundaries import enve
from ssilang.operators.prelude import *

_TIMES = key(
    "times", "TEMPS", "LISTREEL", unit="s", range=RISING, en="times; those of the signal without it"
)
_COLOUR = key("colour", "COUL", "MOT", kind="colour", default="DEFA", en="colour")


@operator("OSCI", family="modal")
def osci(
    call: Call,
    damping: float = Key(
        "AMOR", "FLOTTANT", range=NOT_NEGATIVE, optional=False, en="damping ratio"
    ),
    frequency: float = Key(
        "FREQ", "FLOTTANT", range=POSITIVE, unit="Hz", optional=False, en="frequency"
    ),
    times: ListReel | None = _TIMES,
    start: float = Key("DEPL", "FLOTTANT", range=ANY_NUMBER, default=0.0, en="X at the start"),
    speed: float = Key("VITE", "FLOTTANT", range=ANY_NUMBER, default=0.0, en="X' at the start"),
    colour: str = _COLOUR,
    signal: Curve = Arg("EVOLUTIO", en="signal g(t)", over="s"),
) -> Curve:
    warn_of_motions(call, signal)
    warn_of_damping(call, damping)
    warn_of_steps(call, signal, frequency)
    part = signal.parts[0]
    wanted = None if times is None else times.values
    t, x = response(
        part.abscissas, part.ordinates, frequency, damping, wanted, float(start), float(speed)
    )
    made = CurvePart(t, x, part.abscissa_name or "TEMP", "DEPL", colour=index_of(colour))
    return Curve((made,), signal.title)


@operator("SPO", family="modal")
def spo(
    call: Call,
    dampings: ListReel | float = Key(
        "AMOR", "LISTREEL", "FLOTTANT", range=NOT_NEGATIVE, optional=False, en="damping ratios"
    ),
    frequencies: ListReel | None = Key(
        "FREQ",
        "LISTREEL",
        range=POSITIVE,
        usual=IN_ORDER,
        unit="Hz",
        en="frequencies; usual ones without it",
    ),
    times: ListReel | None = _TIMES,
    colour: str = _COLOUR,
    kind: str = Choice(
        ("DEPL", "VITE", "ACCE", "ACCA"),
        optional=False,
        en="displacement, pseudo-velocity, pseudo-acceleration, absolute acceleration",
    ),
    percentiles: ListReel | float | None = Key(
        "ROTD",
        arg("p", "LISTREEL", "FLOTTANT", unit="%", en="50: median", range=between(0.0, 100.0)),
        en="percentiles over all directions of two components",
    ),
    signal: Curve = Arg("EVOLUTIO", en="acceleration", over="s"),
    second: Curve | None = Opt("EVOLUTIO", en="its other component"),
) -> Curve:
    warn_of_motions(call, signal)
    part = signal.parts[0]
    values = [dampings] if isinstance(dampings, float) else dampings.values
    warn_of_damping(call, *map(float, values))
    if frequencies is not None:
        warn_of_steps(call, signal, float(np.min(frequencies.values, initial=np.inf)))
        warn_of_rate(call, signal, float(np.max(frequencies.values, initial=0.0)))
    if second is not None or percentiles is not None:
        if second is None or percentiles is None or times is not None:
            raise call.error("operators.curves.rotd-incomplete")
        check_together(call, signal, second)
        x, y = part.ordinates, second.parts[0].ordinates
        if abs(x @ y) > (1.0 - SAME) * np.linalg.norm(x) * np.linalg.norm(y) > 0.0:
            call.warn("operators.curves.components-alike", second)
        several = [percentiles] if isinstance(percentiles, float) else percentiles.values
        return _all_directions(
            signal, second, values, frequencies, np.asarray(several, float), kind, colour
        )
    wanted = None if times is None else times.values
    made = []
    for xi in values:
        f = default_frequencies(part.abscissas, xi) if frequencies is None else frequencies.values
        y = spectrum(part.abscissas, part.ordinates, f, float(xi), kind, wanted)
        legend = f"{100.0 * xi:g} %"
        made.append(CurvePart(f, y, "FREQ", kind, legend, index_of(colour)).measured("Hz"))
    return Curve(tuple(made), signal.title)


def _all_directions(
    first: Curve,
    second: Curve,
    dampings: Iterable[float],
    frequencies: ListReel | None,
    percentiles: FloatArray,
    kind: str,
    colour: str,
) -> Curve:
    """Spectra of two components over all directions: a curve for each damping and percentile."""
    x, y = first.parts[0], second.parts[0]
    t, made = x.abscissas, []
    for xi in dampings:
        f = default_frequencies(t, xi) if frequencies is None else frequencies.values
        rows = rotated_spectra(t, x.ordinates, y.ordinates, f, float(xi), kind, percentiles)
        for p, row in zip(percentiles, rows, strict=True):
            legend = f"RotD{p:g} {100.0 * xi:g} %"
            made.append(CurvePart(f, row, "FREQ", kind, legend, index_of(colour)).measured("Hz"))
    return Curve(tuple(made), first.title)


@operator("VALP", family="modal", full_name="VALPROPRE")
def _valp(
    call: Call,
    diagonal: ListReel = Arg("LISTREEL", en="diagonal", range=ANY_NUMBER),
    below: ListReel = Arg("LISTREEL", en="sub-diagonal", range=ANY_NUMBER),
    accuracy: list[tuple[str, float]] = Key(
        ("ITERATION", "ABSOLU", "RELATIF"),
        "FLOTTANT",
        range=ANY_NUMBER,
        repeated=True,
        en="accepted: exact to rounding",
    ),
) -> ListReel:
    if len(below) != len(diagonal) - 1:
        told = {"n_diagonal": len(diagonal), "needed": len(diagonal) - 1, "n_below": len(below)}
        raise call.error("operators.curves.terms-below-diagonal", **told)
    matrix = np.diag(diagonal.values) + np.diag(below.values, -1) + np.diag(np.ones(len(below)), 1)
    values = np.linalg.eigvals(matrix)
    if np.abs(values.imag).max(initial=0.0) > 1e-9 * np.abs(values).max(initial=1.0):
        raise call.error("operators.curves.complex-eigenvalues")
    return ListReel(np.sort(values.real))


@operator("ZSPP", family="signals")
def zspp(
    modes: ListReel = Arg("LISTREEL", range=POSITIVE, en="frequencies of modes", unit="Hz"),
    dampings: ListReel = Arg(
        "LISTREEL", range=NOT_NEGATIVE, usual=BELOW_CRITICAL, en="their dampings"
    ),
    shares: ListReel = Arg("LISTREEL", en="their participations", range=ANY_NUMBER),
    frequencies: ListReel = Arg(
        "LISTREEL", range=POSITIVE, en="frequencies of the spectrum", unit="Hz"
    ),
    damping: float = Arg("FLOTTANT", range=NOT_NEGATIVE, usual=BELOW_CRITICAL, en="its damping"),
    power: Curve = Arg("EVOLUTIO", en="power density", over="Hz"),
    envelope: Curve = Arg("EVOLUTIO", en="envelope", over="s"),
) -> tuple[ListReel, ListReel]:
    """Relative displacements of oscillators on a floor."""
    storey = Storey(*(np.asarray(v.values, dtype=float) for v in (modes, dampings, shares)))
    over = np.asarray(frequencies.values, dtype=float)
    density, shape = ((c.parts[0].abscissas, c.parts[0].ordinates) for c in (power, envelope))
    deviations, factors = floor_spectrum(storey, density, shape, over, damping)
    return ListReel(deviations), ListReel(factors)


_LAWS = ("CINE", "ISOT", "ELAS")
_POWER = {"DEPL": 0, "VITE": 1, "ACCE": 2}


@operator("SPON", family="modal")
def _spon(
    call: Call,
    demand: bool = Flag("DEMA", en="limits at which the ductility is the given one"),
    signal: Curve = Key("SIGN", "EVOLUTIO", optional=False, en="signal"),
    linear: Curve = Key(
        "SPEL", "EVOLUTIO", optional=False, en="linear spectra, one for each damping"
    ),
    dampings: ListReel = Key(
        "AMOR", "LISTREEL", range=NOT_NEGATIVE, usual=BELOW_CRITICAL, optional=False, en="dampings"
    ),
    law: tuple[str, ListReel] | None = Key(
        _LAWS,
        arg("numbers", "LISTREEL", en="ductility and ratio", range=NOT_NEGATIVE),
        en="kinematic or isotropic hardening, or non-linear elastic",
    ),
    takeda: bool = Flag("TAKE", en="not available"),
    kinds: list[str] = Key(
        tuple(_POWER), repeated=True, en="what the linear spectrum is, then what is wanted"
    ),
    colour: str = Key("COUL", "MOT", kind="colour", default="DEFA", en="colour"),
) -> Curve:
    if takeda:
        raise call.error("operators.curves.takeda-not-available")
    if law is None or len(kinds) != 2:
        raise call.error("operators.curves.law-and-kinds-wanted")
    name, numbers = law
    if len(numbers.values) < 2:
        raise call.error("operators.curves.ductility-and-hardening-wanted")
    if len(linear.parts) != len(dampings.values):
        raise call.error("operators.curves.spectra-and-dampings-differ")
    record = signal.parts[0]
    t, g = np.asarray(record.abscissas, float), np.asarray(record.ordinates, float)
    given, wanted = kinds
    ductility, hardening = (float(v) for v in numbers.values[:2])
    shade = index_of(colour)
    made = []
    for xi, part in zip(dampings.values, linear.parts, strict=True):
        f = np.asarray(part.abscissas, float)
        w = 2.0 * np.pi * f
        limits = np.asarray(part.ordinates, float) / w ** _POWER[given] / ductility
        if demand:
            x = limits_for_ductility(t, g, f, float(xi), name, hardening, ductility, limits)
        else:
            x = yielding_peaks(t, g, f, float(xi), name, hardening, limits)
        y = x * w ** _POWER[wanted]
        made.append(CurvePart(f, y, "FREQ", wanted, f"{100.0 * xi:g} %", shade))
    return Curve(tuple(made), signal.title)


SAME = 1e-6  # relative: dampings this near are one, motions along one direction


def _spectra(call: Call, table: Table) -> list[tuple[Curve, list[float]]]:
    """Spectra of a table with the dampings of their curves."""
    found = []
    for index, entry in table.items():
        if type(index) is not int or not isinstance(entry, Table):
            continue
        curve, dampings = entry.get(Mot("SPECTRE")), entry.get(Mot("AMORTISSEMENT"))
        if not isinstance(curve, Curve) or not isinstance(dampings, ListReel):
            raise call.error("operators.curves.spectrum-and-dampings-wanted", table, index=index)
        if len(dampings) != len(curve.parts):
            told = {"index": index, "n_parts": len(curve.parts), "n_dampings": len(dampings)}
            raise call.error("operators.curves.curves-and-dampings-differ", **told)
        found.append((curve, [float(v) for v in dampings.values]))
    if not found:
        raise call.error("operators.curves.table-has-no-spectrum", table)
    return found


def largest(parts: list[CurvePart]) -> CurvePart:
    """Largest of curves linear between their points, each within its own abscissas."""
    x = np.unique(np.concatenate([p.abscissas for p in parts]))
    rows = [np.interp(x, p.abscissas, p.ordinates, left=-np.inf, right=-np.inf) for p in parts]
    first = parts[0]
    y = np.max(rows, axis=0)
    return CurvePart(x, y, first.abscissa_name, first.ordinate_name, first.legend, first.colour)


@enve.form()
def envelope_of_spectra(call: Call, table: Table = Arg("TABLE", en="spectra")) -> Table:
    """Envelope of spectra."""
    spectra = _spectra(call, table)
    every = sorted({d for _, dampings in spectra for d in dampings})
    kept = [d for i, d in enumerate(every) if not i or d - every[i - 1] > SAME * max(d, 1e-12)]
    parts = []
    for damping in kept:
        same = [
            p
            for curve, dampings in spectra
            for p, d in zip(curve.parts, dampings, strict=True)
            if abs(d - damping) <= SAME * max(damping, 1e-12)
        ]
        parts.append(largest(same))
    envelope = Curve(tuple(parts), spectra[0][0].title)
    return Table.of({"SPECTRE": envelope, "AMORTISSEMENT": ListReel(kept)})
