"""PRNS: response spectra of modulated random signals."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.modulated import (
    ModulatedSignal,
    Resolution,
    modulated_response_spectrum,
)
from ssilang.language.registry import Help, arg, flag, key, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel
from ssilang.language.vocabulary.terms import BELOW_CRITICAL, NOT_NEGATIVE, POSITIVE, RISING
from ssilang.operators.curves.accelerograms import ABSCISSA, KIND, PERIODS, spectrum_part
from ssilang.operators.curves.words import COLOUR, one_part, shade


@operator(
    "PRNS",
    arg("curve", "EVOLUTIO", en="power density per hertz"),
    arg("modulation", "EVOLUTIO", en="a curve for each band"),
    arg(
        "bands",
        "LISTREEL",
        range=RISING,
        en="limits of the bands",
        unit="Hz",
    ),
    PERIODS,
    opt(
        "damping",
        "FLOTTANT",
        range=NOT_NEGATIVE,
        usual=BELOW_CRITICAL,
        default=0.05,
        en="damping, 0.05 without it",
    ),
    KIND,
    ABSCISSA,
    COLOUR,
    key(
        "n_processes",
        "NBPR",
        arg("n", "ENTIER", range=POSITIVE),
        en="number of processes, of about 2 s without it",
    ),
    key(
        "n_instants",
        "NBIN",
        arg("n", "ENTIER", range=POSITIVE),
        default=10,
        en="instants of each, 10 without it",
    ),
    key(
        "rest",
        "TPLU",
        arg("rest", "FLOTTANT", range=NOT_NEGATIVE, unit="s"),
        default=20.0,
        en="time behind the end, 20 without it",
    ),
    key(
        "precision",
        "PREC",
        arg("precision", "FLOTTANT", range=POSITIVE),
        default=1e-3,
        en="precision of the levels, 1.E-3 without it",
    ),
    flag("defaults", "NBDE", en="the defaults"),
    flag("root_1", "NEG1", en="accepted, changes nothing"),
    flag("root_2", "NEG2", en="accepted, changes nothing"),
    flag("wavelets", "ONDE", en="not available"),
    family="signals",
    help=Help(
        en="Response spectrum of a random acceleration that changes in time: a stationary signal "
        "of one-sided power density EVOL2 (per hertz), each band of frequencies of which, between "
        "the numbers of the first list, is multiplied by its curve in EVOL3 (one more limit than "
        "curves, which go from one instant to another, all alike). Over 75 periods from 0.04 s to "
        "the duration, or those of the second list, for the damping given (0.05): 'ACCE' "
        "(absolute, the default), 'VITE' or 'DEPL' (relative). The value is the mean of a Gumbel "
        "law through two fractiles of Vanmarcke's law of the largest answer of an oscillator that "
        "starts from rest. Time is cut into 'NBPR' processes (of about 2 s), in which modulations "
        "are linear, of 'NBIN' instants (10) each, and goes on for 'TPLU' seconds (20); 'PREC' is "
        "the precision of the levels (1.E-3), 'NBDE' says these defaults. PSRS does the same for "
        "a stationary signal.",
        syntax="EVOL1 = PRNS EVOL2 EVOL3 LREEL1 (LREEL2) (X1) ('ACCE' | 'VITE' | 'DEPL') "
        "('PERI' | 'FREQ') (COUL1) ('NBPR' N1) ('NBIN' N2) ('TPLU' X2) ('PREC' X3) ('NBDE') ;",
        examples=(
            "S = EVOL 'MANU' 'FREQ' (PROG 0.5 20.) 'DSP' (PROG 0.1 0.1) ; LT = PROG 0. 2. 8. 10. ; "
            "M = EVOL 'MANU' 'TEMP' LT 'MODU' (PROG 0. 1. 1. 0.) ; "
            "LIST (PRNS S M (PROG 0.5 20.) 0.05 (PROG 0.1 0.5) 'FREQ') ;",
        ),
    ),
)
def prns(
    call: Call,
    curve: Curve,
    modulation: Curve,
    bands: ListReel,
    periods: ListReel | None,
    damping: float,
    kind: str,
    abscissa: str,
    colour: str | None,
    n_processes: int | None,
    n_instants: int,
    rest: float,
    precision: float,
    wavelets: bool,
    **_: bool,
) -> Curve:
    """Response spectrum of a modulated power spectrum."""
    if wavelets:
        raise call.error("operators.curves.no-modulation-of-wavelets")
    power = one_part(call, curve)
    signal = ModulatedSignal(
        power.abscissas, power.ordinates, np.asarray(bands.values, dtype=float),
        tuple(p.abscissas for p in modulation.parts), tuple(p.ordinates for p in modulation.parts),
    )  # fmt: skip
    if periods is None and signal.duration <= 0.04:
        raise call.error("operators.curves.duration-too-short", duration=signal.duration)
    over = np.geomspace(0.04, signal.duration, 75) if periods is None else periods.values
    if n_processes is None:
        n_processes = max(round(signal.duration / 2.0), 1)
    resolution = Resolution(n_processes, n_instants, rest, precision)
    order = np.argsort(over)
    values = modulated_response_spectrum(signal, over[order], damping, kind, resolution)
    index = shade(colour, power.colour)
    part = spectrum_part(over[order], values, abscissa, kind, damping, index)
    return Curve((part,), curve.title)
