"""OSCI SPO VALP: oscillators under a signal, response spectra, eigenvalues of a tridiagonal."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ssilang.io.plots.palette import index_of
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.modal.oscillator import default_frequencies, response, spectrum
from ssilang.kernel.records.directions import rotated_spectra
from ssilang.language.registry import Help, arg, choice, key, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel
from ssilang.language.vocabulary.terms import ANY_NUMBER, NOT_NEGATIVE, POSITIVE, RISING, between
from ssilang.operators.curves.words import check_together, warn_of_damping, warn_of_motions

_TIMES = key(
    "times",
    "TEMPS",
    arg("t", "LISTREEL", unit="s", range=RISING),
    en="times; those of the signal without it",
)
_COLOUR = key("colour", "COUL", arg("c", "MOT", kind="colour"), default="DEFA", en="colour")


@operator(
    "OSCI",
    key(
        "damping",
        "AMOR",
        arg("xi", "FLOTTANT", range=NOT_NEGATIVE),
        optional=False,
        en="damping ratio",
    ),
    key(
        "frequency",
        "FREQ",
        arg("f", "FLOTTANT", range=POSITIVE, unit="Hz"),
        optional=False,
        en="frequency",
    ),
    _TIMES,
    key("start", "DEPL", arg("x0", "FLOTTANT", range=ANY_NUMBER), default=0.0, en="X at the start"),
    key(
        "speed", "VITE", arg("v0", "FLOTTANT", range=ANY_NUMBER), default=0.0, en="X' at the start"
    ),
    _COLOUR,
    arg("signal", "EVOLUTIO", en="signal g(t)"),
    family="modal",
    help=Help(
        "Displacement X(t) of an oscillator, X'' + 2 a w X' + w^2 X = g(t), from X and X' at the "
        "start (0); exact for a signal linear between its points.",
        "EVOL2 = OSCI EVOL1 'AMOR' A1 'FREQ' F1 ('TEMPS' LREEL1) ('DEPL' X0) ('VITE' V0) "
        "('COUL' MOT1) ;",
        (
            "T1 = PROG 0. PAS 0.01 1. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (0. * T1) ;"
            " X1 = OSCI G1 'AMOR' 0.05 'FREQ' 2. 'DEPL' 1. ; LIST (EXTR X1 'ORDO') ;",
        ),
    ),
)
def osci(
    call: Call,
    signal: Curve,
    damping: float,
    frequency: float,
    times: ListReel | None,
    start: float,
    speed: float,
    colour: str,
) -> Curve:
    warn_of_motions(call, signal)
    warn_of_damping(call, damping)
    part = signal.parts[0]
    wanted = None if times is None else times.values
    t, x = response(
        part.abscissas, part.ordinates, frequency, damping, wanted, float(start), float(speed)
    )
    made = CurvePart(t, x, part.abscissa_name or "TEMP", "DEPL", colour=index_of(colour))
    return Curve((made,), signal.title)


@operator(
    "SPO",
    key(
        "dampings",
        "AMOR",
        arg("xi", "LISTREEL", "FLOTTANT", range=NOT_NEGATIVE),
        optional=False,
        en="damping ratios",
    ),
    key(
        "frequencies",
        "FREQ",
        arg("f", "LISTREEL", range=POSITIVE, unit="Hz"),
        en="frequencies; usual ones without it",
    ),
    _TIMES,
    _COLOUR,
    choice(
        "kind",
        ("DEPL", "VITE", "ACCE", "ACCA"),
        optional=False,
        en="displacement, pseudo-velocity, pseudo-acceleration, absolute acceleration",
    ),
    key(
        "percentiles",
        "ROTD",
        arg("p", "LISTREEL", "FLOTTANT", unit="%", en="50: median", range=between(0.0, 100.0)),
        en="percentiles over all directions of two components",
    ),
    arg("signal", "EVOLUTIO", en="acceleration"),
    opt("second", "EVOLUTIO", en="its other component"),
    family="modal",
    help=Help(
        "Response spectrum of an acceleration: for each damping, the largest relative displacement "
        "('DEPL'), pseudo-velocity ('VITE'), pseudo-acceleration ('ACCE') or absolute acceleration "
        "('ACCA') of oscillators against their frequency. Of two horizontal components with "
        "'ROTD': percentiles of these over all directions (RotD50, RotD100; Boore 2010).",
        "EVOL2 = SPO EVOL1 'AMOR' LREEL1 ('FREQ' LREEL2) ('TEMP' LREEL3) ('COUL' MOT2) "
        "'DEPL' | 'VITE' | 'ACCE' | 'ACCA' ;\nEVOL2 = SPO EVOL1 EVOL3 'ROTD' LREEL4 'AMOR' LREEL1 "
        "('FREQ' LREEL2) ('COUL' MOT2) 'DEPL' | 'VITE' | 'ACCE' | 'ACCA' ;",
        (
            "T1 = PROG 0. PAS 0.01 2. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;"
            " LIST (SPO G1 (0. * G1) 'ROTD' (PROG 50. 100.) 'AMOR' 0.05 'FREQ' (PROG 2.) 'ACCE') ;",
            "T1 = PROG 0. PAS 0.01 2. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;"
            " S1 = SPO G1 'AMOR' (PROG 0.05) 'FREQ' (PROG 1. 2. 4.) 'ACCE' ; LIST S1 ;",
        ),
    ),
)
def spo(
    call: Call,
    signal: Curve,
    second: Curve | None,
    dampings: ListReel | float,
    frequencies: ListReel | None,
    times: ListReel | None,
    colour: str,
    kind: str,
    percentiles: ListReel | float | None,
) -> Curve:
    warn_of_motions(call, signal)
    part = signal.parts[0]
    values = [dampings] if isinstance(dampings, float) else dampings.values
    warn_of_damping(call, *map(float, values))
    if second is not None or percentiles is not None:
        if second is None or percentiles is None or times is not None:
            raise call.error("operators.curves.rotd-incomplete")
        check_together(call, signal, second)
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


def _valp(
    call: Call, diagonal: ListReel, below: ListReel, accuracy: list[tuple[str, float]]
) -> ListReel:
    if len(below) != len(diagonal) - 1:
        raise call.error(
            "operators.curves.terms-below-diagonal",
            n_diagonal=len(diagonal),
            needed=len(diagonal) - 1,
            n_below=len(below),
        )
    matrix = np.diag(diagonal.values) + np.diag(below.values, -1) + np.diag(np.ones(len(below)), 1)
    values = np.linalg.eigvals(matrix)
    if np.abs(values.imag).max(initial=0.0) > 1e-9 * np.abs(values).max(initial=1.0):
        raise call.error("operators.curves.complex-eigenvalues")
    return ListReel(np.sort(values.real))


operator(
    "VALP",
    arg("diagonal", "LISTREEL", en="diagonal", range=ANY_NUMBER),
    arg("below", "LISTREEL", en="sub-diagonal", range=ANY_NUMBER),
    key(
        "accuracy",
        ("ITERATION", "ABSOLU", "RELATIF"),
        arg("number", "FLOTTANT", range=ANY_NUMBER),
        repeated=True,
        en="accepted: exact to rounding",
    ),
    family="modal",
    full_name="VALPROPRE",
    help=Help(
        "Eigenvalues, increasing, of the tridiagonal matrix of given diagonal and sub-diagonal and "
        "of ones above the diagonal.",
        "LREEL1 = VALP LREEL2 LREEL3 ('ITERATION' N1) ('ABSOLU' | 'RELATIF' X1) ;",
        ("LIST (VALP (PROG 2. 2.) (PROG 1.)) ;",),
    ),
)(_valp)
