"""PRNS: response spectra of modulated random signals."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.modulated import (
    ModulatedSignal,
    Resolution,
    modulated_response_spectrum,
)
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.curves.accelerograms import one_curve, spectrum_part
from ssilang.operators.curves.words import read_colour

_CHOICES = (("PERI", "FREQ"), ("ACCE", "VITE", "DEPL"))
_TUNING = {"NBPR": "ENTIER", "NBIN": "ENTIER", "TPLU": "FLOTTANT", "PREC": "FLOTTANT"}
_ROOTS = ("NEG1", "NEG2", "NBDE")
"""Words that choose what has one answer here: how levels are searched, the defaults."""


@operator(
    "PRNS",
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
        fr="Spectre de réponse d'une accélération aléatoire qui évolue : signal stationnaire de "
        "densité de puissance unilatérale EVOL2 (par hertz), dont chaque bande de fréquences, "
        "entre les nombres de la première liste, est multipliée par sa courbe de EVOL3 (une borne "
        "de plus que de courbes, toutes entre les mêmes instants). Sur 75 périodes de 0,04 s à "
        "la durée, ou celles de la seconde liste, pour l'amortissement donné (0,05) : 'ACCE' "
        "(absolue, par défaut), 'VITE' ou 'DEPL' (relatifs). La valeur est la moyenne d'une loi "
        "de Gumbel par deux fractiles de la loi de Vanmarcke du maximum d'un oscillateur parti du "
        "repos. Le temps se coupe en 'NBPR' processus (d'environ 2 s), où les modulations sont "
        "linéaires, de 'NBIN' instants (10) chacun, et se prolonge de 'TPLU' secondes (20) ; "
        "'PREC' est la précision des niveaux (1.E-3), 'NBDE' dit ces valeurs par défaut. PSRS "
        "fait de même pour un signal stationnaire.",
        syntax="EVOL1 = PRNS EVOL2 EVOL3 LREEL1 (LREEL2) (X1) ('ACCE' | 'VITE' | 'DEPL') "
        "('PERI' | 'FREQ') (COUL1) ('NBPR' N1) ('NBIN' N2) ('TPLU' X2) ('PREC' X3) ('NBDE') ;",
        examples=(
            "S = EVOL 'MANU' 'FREQ' (PROG 0.5 20.) 'DSP' (PROG 0.1 0.1) ; LT = PROG 0. 2. 8. 10. ; "
            "M = EVOL 'MANU' 'TEMP' LT 'MODU' (PROG 0. 1. 1. 0.) ; "
            "LIST (PRNS S M (PROG 0.5 20.) 0.05 (PROG 0.1 0.5) 'FREQ') ;",
        ),
    ),
    reads_itself=True,
)
def prns(call: Call) -> Curve:
    """Response spectrum of a modulated power spectrum."""
    curve, power = one_curve(call)
    modulation: Curve = call.required("EVOLUTIO")
    bands = call.required("LISTREEL").values
    words = [w[0] for w in _CHOICES]
    numbers: dict[str, Any] = {}
    colour = power.colour
    damping, given = _left(call, None, None)
    while True:
        said = call.keyword((*(w for g in _CHOICES for w in g), *_TUNING, *_ROOTS, "ONDE"))
        shade = None if said else read_colour(call)
        if said is None and shade is None:
            break
        if said == "ONDE":
            raise call.error("operators.curves.no-modulation-of-wavelets")
        if said in _TUNING:
            numbers[said] = call.required(_TUNING[said], after=call.keyword_end)
        colour = colour if shade is None else shade
        words = [said if said in g else w for w, g in zip(words, _CHOICES, strict=True)]
        damping, given = _left(call, damping, given)
    signal = ModulatedSignal(
        power.abscissas, power.ordinates, np.asarray(bands, dtype=float),
        tuple(p.abscissas for p in modulation.parts), tuple(p.ordinates for p in modulation.parts),
    )  # fmt: skip
    if given is None and signal.duration <= 0.04:
        raise call.error("operators.curves.duration-too-short", duration=signal.duration)
    periods = np.geomspace(0.04, signal.duration, 75) if given is None else given.values
    resolution = Resolution(
        numbers.get("NBPR", max(round(signal.duration / 2.0), 1)),
        numbers.get("NBIN", 10),
        float(numbers.get("TPLU", 20.0)),
        float(numbers.get("PREC", 1e-3)),
    )
    abscissa, kind = words
    xi = 0.05 if damping is None else float(damping)
    order = np.argsort(periods)
    values = modulated_response_spectrum(signal, periods[order], xi, kind, resolution)
    part = spectrum_part(periods[order], values, abscissa, kind, xi, colour)
    return Curve((part,), curve.title)


def _left(call: Call, damping: Any, given: Any) -> tuple[Any, Any]:
    """The damping and the list of periods, where they stand before the next word."""
    if given is None:
        given = call.optional("LISTREEL")
    if damping is None:
        damping = call.optional("FLOTTANT")
    return damping, given
