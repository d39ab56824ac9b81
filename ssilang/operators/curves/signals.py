"""TFR TFRI FILT HANN COMT TOTE FDT: signals in time and frequency."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from ssilang.kernel.curves.algebra import complex_values, is_complex
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.records.signals import (
    constant_step,
    fourier,
    inverse_fourier,
    shocks,
    smoothed,
    time_above,
)
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListEnti, ListReel
from ssilang.operators.curves.words import read_colour

_SIGNAL = "S = EVOL 'MANU' 'TEMP' (PROG 0. PAS 0.01 NPAS 63) 'A' (PROG 64 * 1.) ; "


def spectrum(
    x: Any, values: Any, form: str, colours: tuple[int, int] = (0, 0), title: str = ""
) -> Curve:
    """A complex curve over frequencies, as real and imaginary parts or modulus and phase."""
    if form == "REIM":
        names, both = ("PREE", "PIMA"), (values.real, values.imag)
    else:
        names, both = ("MODU", "PHAS"), (np.abs(values), np.degrees(np.angle(values)))
    parts = tuple(
        CurvePart(x, np.asarray(y, dtype=float), "FREQ (HZ)", name, name, colour, (), name)
        for y, name, colour in zip(both, names, colours, strict=True)
    )
    return Curve(parts, title, "COMPLEXE")


@operator(
    "TFR",
    family="signals",
    help=Help(
        en="Fast Fourier transform of a signal at constant step, on 2**N1 points (cut, or filled "
        "with zeros): the integral of s(t) exp(-2 i pi f t), as real and imaginary parts ('REIM') "
        "or modulus and phase in degrees ('MOPH'), over frequencies between FMIN and FMAX. Of a "
        "list of fields: lists of real and imaginary fields, and the frequencies.",
        fr="Transformée de Fourier rapide d'un signal à pas constant, sur 2**N1 points (tronqué, "
        "ou complété par des zéros) : l'intégrale de s(t) exp(-2 i pi f t), en parties réelle et "
        "imaginaire ('REIM') ou module et phase en degrés ('MOPH'), entre FMIN et FMAX. D'une "
        "liste de champs : listes des champs réels et imaginaires, et fréquences.",
        syntax="EVOL1 = TFR N1 EVOL2 'REIM' | 'MOPH' ('FMIN' F1) ('FMAX' F2) (COUL1) (COUL2) ;\n"
        "LCHP1 LCHP2 LREE1 = TFR N1 LCHP3 LREE2 'REIM' | 'MOPH' ('FMIN' F1) ('FMAX' F2) ;",
        examples=(_SIGNAL + "F = TFR 6 S 'MOPH' ; LIST (EXTR (EXTR F 'MODU') 1) ;",),
    ),
    reads_itself=True,
)
def tfr(call: Call) -> Any:
    """Transform signals."""
    power = call.required("ENTIER")
    if not 1 <= power <= 26:
        raise call.error("operators.curves.power-of-two", power, power=power)
    operand = call.read("EVOLUTIO", "LISTCHPO")
    if operand is None:
        raise call.missing(("EVOLUTIO", "LISTCHPO"))
    times = call.required("LISTREEL").values if isinstance(operand.value, ListChpo) else None
    form = call.keyword(("REIM", "MOPH"))
    if form is None:
        raise call.error("operators.curves.how-to-give-values")
    limits = {"FMIN": 0.0, "FMAX": np.inf}
    while (said := call.keyword(("FMIN", "FMAX"))) is not None:
        limits[said] = call.required("FLOTTANT", after=call.keyword_end)
    colours = read_colour(call), read_colour(call)
    if times is not None:
        return _transformed_fields(call, operand.value, times, 2**power, limits)
    curve: Curve = operand.value
    if len(curve.parts) != 1:
        raise call.error("operators.curves.one-curve-at-a-time", curve, n_parts=len(curve.parts))
    part = curve.parts[0]
    f, values = fourier(part.ordinates, constant_step(part.abscissas), 2**power)
    kept = (f >= limits["FMIN"]) & (f <= limits["FMAX"])
    shades = (colours[0] or 0, colours[1] or 0)
    return spectrum(f[kept], values[kept], form, shades, curve.title)


def _transformed_fields(
    call: Call, fields: ListChpo, times: Any, n: int, limits: dict[str, float]
) -> tuple[ListChpo, ListChpo, ListReel]:
    held: list[Any] = fields.values
    if len(held) != len(times):
        raise call.error(
            "operators.curves.fields-and-times-differ",
            fields,
            n_fields=len(held),
            n_times=len(times),
        )
    step = constant_step(times)
    real: dict[str, Any] = {}
    f = np.empty(0)
    for name, first in held[0].components.items():
        rows = np.asarray([h.values_at(name, first.nodes) for h in held])
        f, real[name] = fourier(rows, step, n)
    kept = np.flatnonzero((f >= limits["FMIN"]) & (f <= limits["FMAX"]))
    like: NodeField = held[0]

    def field(k: int, part: str) -> NodeField:
        made = {
            name: NodeValues(like.components[name].nodes, getattr(values[k], part).copy())
            for name, values in real.items()
        }
        return NodeField(like.table, made, like.nature)

    lists = [ListChpo([field(int(k), part) for k in kept]) for part in ("real", "imag")]
    return lists[0], lists[1], ListReel(f[kept])


@operator(
    "TFRI",
    family="signals",
    help=Help(
        en="Inverse Fourier transform of a complex curve from frequency 0 to the highest, at "
        "constant step: a real signal; inverse of TFR.",
        fr="Transformée de Fourier inverse d'une évolution complexe, de la fréquence 0 à la plus "
        "haute, à pas constant : un signal réel ; inverse de TFR.",
        syntax="EVOL2 = TFRI EVOL1 ;",
        examples=(_SIGNAL + "R = TFRI (TFR 6 S 'REIM') ; LIST (MAXI (EXTR R 'ORDO')) ;",),
    ),
    reads_itself=True,
)
def tfri(call: Call) -> Curve:
    """Transform back."""
    curve: Curve = call.required("EVOLUTIO")
    if not is_complex(curve) or len(curve.parts) != 2:
        raise call.error("operators.curves.complex-curve-wanted", curve)
    f = curve.parts[0].abscissas
    if len(f) and abs(f[0]) > 1e-9 * max(abs(f[-1]), 1e-300):
        raise call.error("operators.curves.frequencies-from-zero", curve, f=f[0])
    t, values = inverse_fourier(f, complex_values(*curve.parts))
    part = CurvePart(t, values, "TEMPS", "SIGNAL", "", curve.parts[0].colour)
    return Curve((part,), curve.title)


@operator(
    "FILT",
    family="signals",
    full_name="FILTRE",
    help=Help(
        en="Filter as a complex curve on 2**(N1 - 1) + 1 frequencies: first-order high-pass "
        "('PHAU') or low-pass ('PBAS') of cut-off F1, or a power of the circular frequency "
        "(i 2 pi f)**N ('OMEG').",
        fr="Filtre sous forme d'évolution complexe sur 2**(N1 - 1) + 1 fréquences : passe-haut "
        "('PHAU') ou passe-bas ('PBAS') du premier ordre de coupure F1, ou puissance de la "
        "pulsation (i 2 pi f)**N ('OMEG').",
        syntax="EVOL1 = FILT N1 'TYPE' 'PHAU' F1 | 'PBAS' F1 | 'OMEG' N2 ('SORT' 'REIM' | 'MOPH') "
        "'DFRQ' F2 ;",
        examples=("LIST (DIME (FILT 4 'TYPE' 'PBAS' 2. 'DFRQ' 0.5)) ;",),
    ),
    reads_itself=True,
)
def filt(call: Call) -> Curve:
    """Make a filter."""
    power = call.required("ENTIER")
    kind, cut, form, spacing = "", 0.0, "MOPH", 0.0
    while (said := call.keyword(("TYPE", "SORT", "DFRQ", "REIM", "MOPH"))) is not None:
        if said == "TYPE":
            kind = call.keyword(("PHAU", "PBAS", "OMEG")) or ""
            number = "ENTIER" if kind == "OMEG" else "FLOTTANT"
            cut = call.required(number, after=call.keyword_end)
        elif said == "DFRQ":
            spacing = call.required("FLOTTANT", after=call.keyword_end)
        elif said != "SORT":
            form = said
    if not kind or spacing <= 0 or not 1 <= power <= 26:
        raise call.error("operators.curves.filter-incomplete")
    f = spacing * np.arange(2 ** (power - 1) + 1)
    if kind == "OMEG":
        omega = 2j * np.pi * f
        if cut < 0:
            omega[0] = np.inf
        values = omega**cut
    else:
        if cut <= 0:
            raise call.error("operators.curves.cut-off-not-positive", cut, cut=cut)
        ratio = 1j * f / cut
        values = (ratio if kind == "PHAU" else 1.0) / (1.0 + ratio)
    return spectrum(f, values, form)


def _single(call: Call) -> tuple[Curve, CurvePart]:
    curve: Curve = call.required("EVOLUTIO")
    if len(curve.parts) != 1:
        raise call.error("operators.curves.one-curve-wanted", curve, n_parts=len(curve.parts))
    return curve, curve.parts[0]


@operator(
    "HANN",
    family="signals",
    full_name="HANNING",
    help=Help(
        en="Hanning's mean (1/4, 1/2, 1/4) of a spectrum, N1 times.",
        fr="Moyenne de Hanning (1/4, 1/2, 1/4) d'un spectre, N1 fois.",
        syntax="EVOL1 = HANN EVOL2 N1 (COUL1) ;",
        examples=("LIST (HANN (EVOL 'MANU' (PROG 1. 2. 3.) (PROG 0. 4. 0.)) 1) ;",),
    ),
    reads_itself=True,
)
def hann(call: Call) -> Curve:
    """Smooth a spectrum."""
    curve, part = _single(call)
    passes = call.required("ENTIER")
    colour = read_colour(call)
    made = dataclasses.replace(
        part,
        ordinates=smoothed(part.ordinates, passes),
        colour=part.colour if colour is None else colour,
    )
    return Curve((made,), f"HANNING({passes}) {curve.title}".rstrip(), curve.kind)


@operator(
    "COMT",
    family="signals",
    help=Help(
        en="Number of shocks in records: stretches above a threshold in percent of the largest "
        "absolute value (1.E-6 by default). Of one record also the peaks ('MAXI') and the places "
        "where shocks begin ('DEBU') and end ('FIN').",
        fr="Nombre de chocs d'enregistrements : passages au-dessus d'un seuil en pour cent du "
        "maximum absolu (1.E-6 par défaut). D'un seul, aussi les maxima ('MAXI') et les rangs de "
        "début ('DEBU') et de fin ('FIN').",
        syntax="LENT1 = COMT EVOL1 (X1) ; N1 (LREE1) (LENT2) (LENT3) = COMT EVOL1 (X1) ('MAXI') "
        "('DEBU') ('FIN') ;",
        examples=("LIST (COMT (EVOL 'MANU' (PROG 0. PAS 1. 4.) (PROG 0. 3. 0. 2. 0.))) ;",),
    ),
    reads_itself=True,
)
def comt(call: Call) -> Any:
    """Count shocks."""
    curve: Curve = call.required("EVOLUTIO")
    percent = call.optional("FLOTTANT", default=1e-6)
    words: set[str] = set()
    while (said := call.keyword(("MAXI", "DEBU", "FIN"))) is not None:
        words.add(said)
    found = [shocks(p.ordinates, percent) for p in curve.parts]
    if not words:
        return ListEnti([len(f[1]) for f in found])
    if len(found) != 1:
        raise call.error("operators.curves.peaks-of-one-curve", curve)
    peaks, begins, ends = found[0]
    more: list[Any] = [ListReel(peaks)] if "MAXI" in words else []
    more += [ListEnti(begins)] if "DEBU" in words else []
    more += [ListEnti(ends)] if "FIN" in words else []
    return (len(begins), *more)


@operator(
    "TOTE",
    family="signals",
    full_name="TOTEMP",
    help=Help(
        en="Length of the abscissas where each curve is above a level, in percent of its maximum.",
        fr="Longueur des abscisses où chaque courbe dépasse un seuil, en pour cent du maximum.",
        syntax="LREE1 = TOTE EVOL1 (X1) ;",
        examples=("LIST (TOTE (EVOL 'MANU' (PROG 0. 1. 2.) (PROG 0. 2. 0.)) 50.) ;",),
    ),
    reads_itself=True,
)
def tote(call: Call) -> ListReel:
    """Measure durations."""
    curve: Curve = call.required("EVOLUTIO")
    percent = call.optional("FLOTTANT", default=1e-6)
    levels = [percent / 100.0 * float(np.max(p.ordinates)) for p in curve.parts]
    pairs = zip(curve.parts, levels, strict=True)
    return ListReel([time_above(p.abscissas, p.ordinates, v) for p, v in pairs])


@operator(
    "FDT",
    family="signals",
    help=Help(
        en="Curve in time from ordinates at a constant step ('CONS'), or from times and values "
        "('NOCO': pairs one after the other with 'COUP', else all times then all values, or two "
        "lists, the first of which holds the step or 0).",
        fr="Évolution en temps à partir d'ordonnées à pas constant ('CONS'), ou de temps et de "
        "valeurs ('NOCO' : couples successifs avec 'COUP', sinon tous les temps puis toutes les "
        "valeurs, ou deux listes dont la première contient le pas ou 0).",
        syntax="EVOL1 = FDT MOT1 'CONS' X1 LREE1 ; EVOL1 = FDT MOT1 'NOCO' 'COUP' LREE2 | LREE3 ;",
        examples=("LIST (FDT 'ACCE' 'CONS' 0.5 (PROG 1. 2. 3.)) ;",),
    ),
    reads_itself=True,
)
def fdt(call: Call) -> Curve:
    """Make a curve in time."""
    name = call.word() or ""
    word = call.keyword(("CONS", "NOCO"))
    if word == "CONS":
        step = call.required("FLOTTANT", after=call.keyword_end)
        y = call.required("LISTREEL").values
        return _in_time(step * np.arange(len(y)), y, name)
    pairs = call.keyword(("COUP",)) is not None
    values = call.required("LISTREEL").values
    second = call.optional("LISTREEL")
    if second is not None:
        if len(values) == 1 and values[0] > 0:
            return _in_time(values[0] * np.arange(len(second)), second.values, name)
        values, pairs = second.values, True
    if len(values) % 2:
        raise call.error("operators.curves.times-and-values-in-pairs", n_values=len(values))
    if pairs:
        return _in_time(values[::2], values[1::2], name)
    half = len(values) // 2
    return _in_time(values[:half], values[half:], name)


def _in_time(t: Any, y: Any, name: str) -> Curve:
    return Curve((CurvePart(np.asarray(t, dtype=float), np.array(y), "TEMPS", name[:12]),))
