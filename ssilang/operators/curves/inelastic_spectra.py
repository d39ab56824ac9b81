"""SPON: spectra of oscillators that yield."""

from __future__ import annotations

import numpy as np

from ssilang.io.plots.palette import index_of
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.language.registry import Help, arg, flag, key, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel
from ssilang.language.vocabulary.terms import BELOW_CRITICAL, NOT_NEGATIVE

_LAWS = ("CINE", "ISOT", "ELAS")
_POWER = {"DEPL": 0, "VITE": 1, "ACCE": 2}


def _spon(
    call: Call,
    demand: bool,
    signal: Curve,
    linear: Curve,
    dampings: ListReel,
    law: tuple[str, ListReel] | None,
    takeda: bool,
    kinds: list[str],
    colour: str,
) -> Curve:
    from ssilang.kernel.records.inelastic import limits_for_ductility, yielding_peaks

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


operator(
    "SPON",
    flag("demand", "DEMA", en="limits at which the ductility is the given one"),
    key("signal", "SIGN", arg("signal", "EVOLUTIO"), optional=False, en="signal"),
    key(
        "linear",
        "SPEL",
        arg("linear", "EVOLUTIO"),
        optional=False,
        en="linear spectra, one for each damping",
    ),
    key(
        "dampings",
        "AMOR",
        arg("dampings", "LISTREEL", range=NOT_NEGATIVE, usual=BELOW_CRITICAL),
        optional=False,
        en="dampings",
    ),
    key(
        "law",
        _LAWS,
        arg("numbers", "LISTREEL", en="ductility and ratio", range=NOT_NEGATIVE),
        en="kinematic or isotropic hardening, or non-linear elastic",
    ),
    flag("takeda", "TAKE", en="not available"),
    key(
        "kinds", tuple(_POWER), repeated=True, en="what the linear spectrum is, then what is wanted"
    ),
    key("colour", "COUL", arg("colour", "MOT", kind="colour"), default="DEFA", en="colour"),
    family="modal",
    help=Help(
        "Spectra of oscillators that yield, one for each damping: bilinear with kinematic ('CINE') "
        "or isotropic ('ISOT') hardening, or non-linear elastic ('ELAS'), of given ductility and "
        "ratio of the slope beyond the limit to the elastic one. EVOL2 is the linear spectrum "
        "(kind MOT1) of the signal EVOL1, of equal steps. The elastic limit is the linear "
        "displacement divided by the ductility and the spectrum (kind MOT3) that of the largest "
        "displacements; with 'DEMA' the limit is sought at which the ductility is the given one "
        "and the spectrum is that of the limits.",
        "EVOL3 = SPON ('DEMA') 'SIGN' EVOL1 'SPEL' EVOL2 'DEPL'|'VITE'|'ACCE' 'AMOR' LREEL1 "
        "'CINE'|'ISOT'|'ELAS' LREEL2 ('COUL' COUL1) 'DEPL'|'VITE'|'ACCE' ;",
        (
            "T1 = PROG 0. PAS 0.01 2. ; G1 = EVOL 'MANU' 'TEMP' T1 'ACCE' (SIN (720. * T1)) ;"
            " X1 = PROG 0.05 ; S1 = SPO G1 'AMOR' X1 'FREQ' (PROG 1. 2. 4.) 'ACCE' ;"
            " LIST (SPON 'DEMA' 'SIGN' G1 'SPEL' S1 'ACCE' 'AMOR' X1 'CINE' (PROG 2. 0.1)"
            " 'ACCE') ;",
        ),
    ),
)(_spon)
