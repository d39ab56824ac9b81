"""INSI COSI CHSP DSPR PSRS: integrated and corrected records, spectra of power and of response."""

from __future__ import annotations

import dataclasses

import numpy as np

from ssilang.io.plots.palette import index_of
from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.records.integration import brought_to_rest, integrated
from ssilang.kernel.records.power import power_density, response_spectrum
from ssilang.kernel.records.signals import constant_step
from ssilang.language.registry import Help, arg, key, operator
from ssilang.language.run.call import Call
from ssilang.operators.curves.words import read_colour

_KINDS = ("DEPL", "VITE", "ACCE")
_RECORD = "A = EVOL 'MANU' 'TEMP' (PROG 0. PAS 0.1 1.) 'ACCE' (PROG 11 * 2.) ; "


def _rule(call: Call) -> bool:
    """Whether 'LINE' is asked for."""
    return call.keyword(("SIMP", "LINE")) == "LINE"


@operator(
    "INSI",
    family="signals",
    help=Help(
        en="Displacements and velocities of accelerations at a constant step, from rest: by "
        "trapezoids twice ('SIMP', the default) or exactly for an acceleration linear in the "
        "steps ('LINE').",
        fr="Déplacements et vitesses d'accélérations à pas constant, à partir du repos : par deux "
        "fois les trapèzes ('SIMP', par défaut) ou exactement pour une accélération linéaire dans "
        "les pas ('LINE').",
        syntax="EVOL1 EVOL2 = INSI EVOL3 ('SIMP' | 'LINE') ;",
        examples=(_RECORD + "D V = INSI A 'LINE' ; LIST (EXTR V 'ORDO') ; LIST (EXTR D 'ORDO') ;",),
    ),
    reads_itself=True,
)
def insi(call: Call) -> tuple[Curve, Curve]:
    """Integrate records."""
    curve: Curve = call.required("EVOLUTIO")
    linear = _rule(call)
    moved, fast = [], []
    for p in curve.parts:
        v, d = integrated(p.ordinates, constant_step(p.abscissas), linear)
        moved.append(dataclasses.replace(p, ordinates=d, ordinate_name="DEPL"))
        fast.append(dataclasses.replace(p, ordinates=v, ordinate_name="VITE"))
    return Curve(tuple(moved), curve.title), Curve(tuple(fast), curve.title)


@operator(
    "COSI",
    family="signals",
    help=Help(
        en="Accelerations corrected, as little as possible in least squares, so that INSI (with "
        "the same 'SIMP' or 'LINE') ends with no velocity, no displacement and no mean "
        "displacement.",
        fr="Accélérations corrigées, le moins possible au sens des moindres carrés, pour que INSI "
        "(avec le même 'SIMP' ou 'LINE') finisse avec une vitesse, un déplacement et un "
        "déplacement moyen nuls.",
        syntax="EVOL1 = COSI EVOL2 ('SIMP' | 'LINE') ;",
        examples=(
            "A = EVOL 'MANU' 'TEMP' (PROG 0. PAS 0.1 1.) 'ACCE' (SIN (PROG 0. PAS 70. 700.)) ; "
            "D V = INSI (COSI A) ; MESS (ABS (EXTR (EXTR D 'ORDO') 11) < 1.E-12) ;",
        ),
    ),
    reads_itself=True,
)
def cosi(call: Call) -> Curve:
    """Correct records."""
    curve: Curve = call.required("EVOLUTIO")
    linear = _rule(call)
    parts = [
        dataclasses.replace(
            p, ordinates=brought_to_rest(p.ordinates, constant_step(p.abscissas), linear)
        )
        for p in curve.parts
    ]
    return Curve(tuple(parts), curve.title)


@operator(
    "CHSP",
    arg("spectrum", "EVOLUTIO"),
    key("given", "ENTR", arg("kind", "MOT"), optional=False),
    key("wanted", "SORT", arg("kind", "MOT"), optional=False),
    key("colour", "COUL", arg("c", "MOT")),
    family="signals",
    help=Help(
        en="Response spectra over frequencies (Hz) in another unit: displacement 'DEPL', "
        "pseudo-velocity 'VITE' (w times it), pseudo-acceleration 'ACCE' (w squared times it).",
        fr="Spectres de réponse en fréquence (Hz) dans une autre grandeur : déplacement 'DEPL', "
        "pseudo-vitesse 'VITE' (w fois), pseudo-accélération 'ACCE' (w au carré fois).",
        syntax="EVOL2 = CHSP EVOL1 'ENTR' MOT1 'SORT' MOT2 ('COUL' COUL1) ;",
        examples=(
            "S = EVOL 'MANU' 'FREQ' (PROG 1. 2.) 'DEPL' (PROG 0.1 0.1) ; "
            "LIST (CHSP S 'ENTR' 'DEPL' 'SORT' 'ACCE') ;",
        ),
    ),
)
def chsp(call: Call, spectrum: Curve, given: str, wanted: str, colour: str | None) -> Curve:
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
        parts.append(dataclasses.replace(p, ordinates=y, ordinate_name=names[1], colour=shade))
    return Curve(tuple(parts), spectrum.title)


def one_curve(call: Call) -> tuple[Curve, CurvePart]:
    """A curve object of one curve, and that curve."""
    curve: Curve = call.required("EVOLUTIO")
    if len(curve.parts) != 1:
        raise call.error("operators.curves.one-curve-wanted", curve, n_parts=len(curve.parts))
    return curve, curve.parts[0]


@operator(
    "DSPR",
    family="signals",
    help=Help(
        en="One-sided power spectral density (per hertz) of a signal at constant step, on 2**N1 "
        "points (cut, or filled with zeros): summed over the frequencies times their step it is "
        "the mean square.",
        fr="Densité spectrale de puissance unilatérale (par hertz) d'un signal à pas constant, sur "
        "2**N1 points (tronqué, ou complété par des zéros) : sommée sur les fréquences fois leur "
        "pas, elle donne la moyenne du carré.",
        syntax="EVOL1 = DSPR N1 EVOL2 ('FMIN' F1) ('FMAX' F2) (COUL1) ;",
        examples=(
            "S = EVOL 'MANU' 'TEMP' (PROG 0. PAS 0.125 NPAS 7) 'A' (SIN (PROG 0. PAS 90. NPAS 7)) "
            "; LIST (DSPR 3 S) ;",
        ),
    ),
    reads_itself=True,
)
def dspr(call: Call) -> Curve:
    """Power density."""
    power = call.required("ENTIER")
    if not 1 <= power <= 26:
        raise call.error("operators.curves.power-of-two", power, power=power)
    curve, part = one_curve(call)
    limits = {"FMIN": 0.0, "FMAX": 0.0}
    while (said := call.keyword(("FMIN", "FMAX"))) is not None:
        limits[said] = abs(call.required("FLOTTANT", after=call.keyword_end))
    colour = read_colour(call) or 0
    f, y = power_density(part.ordinates, constant_step(part.abscissas), 2**power)
    kept = (f >= limits["FMIN"]) & (f <= (limits["FMAX"] or np.inf))
    made = CurvePart(f[kept], y[kept], "FREQ (HZ)", "DSP UN**2/HZ", part.legend, colour)
    return Curve((made,), curve.title)


_PSRS = (("PERI", "FREQ"), ("ACCE", "VITE", "DEPL"), ("CRAM", "NEWG"))


@operator(
    "PSRS",
    family="signals",
    help=Help(
        en="Response spectra of a stationary acceleration of duration X1 whose one-sided power "
        "density (per hertz) is given, one for each damping of the list: over 75 periods from "
        "0.04 s to the duration, or over the second list. 'ACCE' (absolute), 'VITE' or 'DEPL' "
        "(relative); the largest value is the median of the law of rare crossings ('CRAM') or the "
        "mean of a Gumbel law through two fractiles of Vanmarcke's ('NEWG').",
        fr="Spectres de réponse d'une accélération stationnaire de durée X1 et de densité de "
        "puissance unilatérale donnée (par hertz), un par amortissement de la liste : sur 75 "
        "périodes de 0,04 s à la durée, ou sur la seconde liste. 'ACCE' (absolue), 'VITE' ou "
        "'DEPL' (relatifs) ; le maximum est la médiane de la loi des franchissements rares "
        "('CRAM') ou la moyenne d'une loi de Gumbel par deux fractiles de celle de Vanmarcke "
        "('NEWG').",
        syntax="EVOL1 = PSRS EVOL2 X1 LREEL1 (LREEL2) ('ACCE' | 'VITE' | 'DEPL') "
        "('CRAM' | 'NEWG') ('PERI' | 'FREQ') (COUL1) ;",
        examples=(
            "S = EVOL 'MANU' 'FREQ' (PROG 0.1 20.) 'DSP' (PROG 0.1 0.1) ; "
            "LIST (PSRS S 10. (PROG 0.05) (PROG 0.1 0.5) 'FREQ') ;",
        ),
    ),
    reads_itself=True,
)
def psrs(call: Call) -> Curve:
    """Response spectra of a power spectrum."""
    curve, part = one_curve(call)
    duration = call.required("FLOTTANT")
    dampings = call.required("LISTREEL").values
    given = call.optional("LISTREEL")
    words = [w[0] for w in _PSRS]
    colour = part.colour
    while True:
        said = call.keyword(tuple(w for group in _PSRS for w in group))
        shade = None if said else read_colour(call)
        if said is None and shade is None:
            break
        colour = colour if shade is None else shade
        words = [said if said in group else w for w, group in zip(words, _PSRS, strict=True)]
    abscissa, kind, law = words
    if given is None and duration <= 0.04:
        raise call.error("operators.curves.duration-too-short", duration=duration)
    periods = np.geomspace(0.04, duration, 75) if given is None else given.values
    parts = []
    for xi in dampings:
        y = response_spectrum(
            part.abscissas, part.ordinates, duration, periods, float(xi), kind, law
        )
        parts.append(spectrum_part(periods, y, abscissa, kind, float(xi), colour))
    return Curve(tuple(parts), curve.title)


def spectrum_part(
    periods: FloatArray, y: FloatArray, abscissa: str, kind: str, damping: float, colour: int
) -> CurvePart:
    """One response spectrum as a curve, over periods or over frequencies."""
    legend = f"{100.0 * damping:g} %"
    if abscissa == "PERI":
        return CurvePart(periods, y, "PERIODE", f"RSPE-{kind}", legend, colour)
    return CurvePart(1.0 / periods[::-1], y[::-1], "FREQUENCE", f"RSPE-{kind}", legend, colour)
