"""SPON: spectra of oscillators that yield."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.io.plots.palette import index_of
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call

_LAWS = ("CINE", "ISOT", "ELAS")
_POWER = {"DEPL": 0, "VITE": 1, "ACCE": 2}
_VALUES = {"SIGN": "EVOLUTIO", "SPEL": "EVOLUTIO", "AMOR": "LISTREEL", "COUL": "MOT"}


def _read(call: Call) -> dict[str, Any]:
    """What is said by keyword; the two kinds of spectrum under 'KINDS', the law under 'LAW'."""
    said: dict[str, Any] = {"KINDS": []}
    words = ("DEMA", *_VALUES, *_LAWS, "TAKE", *_POWER)
    while (word := call.keyword(words)) is not None:
        if word in _POWER:
            said["KINDS"].append(word)
        elif word in _VALUES:
            said[word] = call.required(_VALUES[word], after=call.keyword_end)
        elif word == "DEMA":
            said[word] = True
        elif word == "TAKE":
            raise call.error("operators.curves.takeda-not-available")
        else:
            said["LAW"] = word
            said["LIST"] = call.required("LISTREEL", after=call.keyword_end)
    for word in ("SIGN", "SPEL", "AMOR"):
        if word not in said:
            raise call.error("operators.curves.number-wanted", word=word)
    if "LAW" not in said or len(said["KINDS"]) != 2:
        raise call.error("operators.curves.law-and-kinds-wanted")
    if len(said["LIST"].values) < 2:
        raise call.error("operators.curves.ductility-and-hardening-wanted")
    if len(said["SPEL"].parts) != len(said["AMOR"].values):
        raise call.error("operators.curves.spectra-and-dampings-differ")
    return said


def _spon(call: Call) -> Curve:
    from ssilang.kernel.records.inelastic import limits_for_ductility, yielding_peaks

    said = _read(call)
    signal = said["SIGN"].parts[0]
    t, g = np.asarray(signal.abscissas, float), np.asarray(signal.ordinates, float)
    given, wanted = said["KINDS"]
    ductility, hardening = (float(v) for v in said["LIST"].values[:2])
    colour = index_of(str(said.get("COUL", "DEFA")))
    made = []
    for xi, part in zip(said["AMOR"].values, said["SPEL"].parts, strict=True):
        f = np.asarray(part.abscissas, float)
        w = 2.0 * np.pi * f
        limits = np.asarray(part.ordinates, float) / w ** _POWER[given] / ductility
        if "DEMA" in said:
            x = limits_for_ductility(t, g, f, float(xi), said["LAW"], hardening, ductility, limits)
        else:
            x = yielding_peaks(t, g, f, float(xi), said["LAW"], hardening, limits)
        y = x * w ** _POWER[wanted]
        made.append(CurvePart(f, y, "FREQ", wanted, f"{100.0 * xi:g} %", colour))
    return Curve(tuple(made), said["SIGN"].title)


operator(
    "SPON",
    family="modal",
    help=Help(
        "Spectra of oscillators that yield, one for each damping: bilinear with kinematic ('CINE') "
        "or isotropic ('ISOT') hardening, or non-linear elastic ('ELAS'), of given ductility and "
        "ratio of the slope beyond the limit to the elastic one. EVOL2 is the linear spectrum "
        "(kind MOT1) of the signal EVOL1, of equal steps. The elastic limit is the linear "
        "displacement divided by the ductility and the spectrum (kind MOT3) that of the largest "
        "displacements; with 'DEMA' the limit is sought at which the ductility is the given one "
        "and the spectrum is that of the limits.",
        "Spectres d'oscillateurs non linéaires, un par amortissement : bilinéaires à écrouissage "
        "cinématique ('CINE') ou isotrope ('ISOT'), ou élastiques non linéaires ('ELAS'), de "
        "ductilité et de rapport de la pente au-delà de la limite à la pente élastique donnés. "
        "EVOL2 est le spectre linéaire (de type MOT1) du signal EVOL1, à pas constant. La limite "
        "élastique est le déplacement linéaire divisé par la ductilité et le spectre (de type "
        "MOT3) celui des plus grands déplacements ; avec 'DEMA' on cherche la limite pour laquelle "
        "la ductilité est celle donnée et le spectre est celui des limites.",
        "EVOL3 = SPON ('DEMA') 'SIGN' EVOL1 'SPEL' EVOL2 'DEPL'|'VITE'|'ACCE' 'AMOR' LREEL1 "
        "'CINE'|'ISOT'|'ELAS' LREEL2 ('COUL' COUL1) 'DEPL'|'VITE'|'ACCE' ;",
        (
            "T1 = PROG 0. PAS 0.01 2. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;"
            " X1 = PROG 0.05 ; S1 = SPO G1 'AMOR' X1 'FREQ' (PROG 1. 2. 4.) 'ACCE' ;"
            " LIST (SPON 'DEMA' 'SIGN' G1 'SPEL' S1 'ACCE' 'AMOR' X1 'CINE' (PROG 2. 0.1)"
            " 'ACCE') ;",
        ),
    ),
    reads_itself=True,
)(_spon)
