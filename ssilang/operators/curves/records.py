"""FILT of a record, TOUR of two components."""

from __future__ import annotations

import dataclasses

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.directions import turned
from ssilang.kernel.records.filters import butterworth
from ssilang.kernel.records.signals import constant_step
from ssilang.language.registry import arg, flag, key
from ssilang.language.run.call import Call
from ssilang.operators.curves.signals import filt
from ssilang.operators.curves.words import CURVE, check_together, one_part
from ssilang.operators.mesh.copies.images import tour


@filt.form(
    CURVE,
    key("order", "ORDR", arg("n", "ENTIER"), default=4, en="order, 4 without it",
        fr="ordre, 4 sans elle"),
    key("low", "PHAU", arg("f", "FLOTTANT", unit="Hz"), en="slower is taken off",
        fr="le plus lent est ôté"),
    key("high", "PBAS", arg("f", "FLOTTANT", unit="Hz"), en="faster is taken off",
        fr="le plus rapide est ôté"),
    flag("causal", "CAUS", en="one pass, as a device does", fr="un passage, comme un appareil"),
    en="A record itself, filtered by Butterworth's of order N1 (4): without what is slower than F1 "
    "('PHAU') or faster than F2 ('PBAS'). Forth and back, without phase, both corners count "
    "twice (half the amplitude there); 'CAUS': one pass (0.707 there), with a phase.",
    fr="Un signal lui-même, filtré par celui de Butterworth d'ordre N1 (4) : sans ce qui est plus "
    "lent que F1 ('PHAU') ou plus rapide que F2 ('PBAS'). Aller et retour, sans phase, les "
    "coupures comptent deux fois (amplitude par deux) ; 'CAUS' : un passage (0.707), avec phase.",
    syntax="EVOL1 = FILT EVOL2 ('ORDR' N1) ('PHAU' F1) ('PBAS' F2) ('CAUS') ;",
    examples=(
        "T = PROG 0. PAS 0.01 4. ; A = EVOL 'MANU' 'TEMP' T 'ACCE' (SIN (T * 3600.)) ;\n"
        "B = FILT A 'PHAU' 0.2 'PBAS' 2. ; LIST ((MAXI (EXTR B 'ORDO')) < 0.01) ;",
    ),
)  # fmt: skip
def filtered_records(
    call: Call, curve: Curve, order: int, low: float | None, high: float | None, causal: bool
) -> Curve:
    """Filter records."""
    if low is None and high is None:
        raise call.error("operators.curves.filter-without-corner")
    parts = [
        dataclasses.replace(
            p,
            ordinates=butterworth(
                p.ordinates, constant_step(p.abscissas), order, low, high, causal=causal
            ),
        )
        for p in curve.parts
    ]
    return Curve(tuple(parts), curve.title, curve.kind)


@tour.form(
    arg("first", "EVOLUTIO", en="component along x", fr="composante selon x"),
    arg("second", "EVOLUTIO", en="component along y", fr="composante selon y"),
    arg("angle", "FLOTTANT", "ENTIER", en="angle", fr="angle", unit="deg"),
    gives=("EVOLUTIO", "EVOLUTIO"),
    en="Two horizontal components of a record along axes turned by an angle in degrees, from x to "
    "y.",
    fr="Deux composantes horizontales d'un signal selon des axes tournés d'un angle en degrés, de "
    "x vers y.",
    syntax="EVOL1 EVOL2 = TOUR EVOL3 EVOL4 FLOT1 ;",
    examples=(
        "T = PROG 0. 0.1 ; X = EVOL 'MANU' T (PROG 0. 2.) ; Y = EVOL 'MANU' T (PROG 0. 1.) ;\n"
        "A B = TOUR X Y 90. ; LIST (EXTR A 'ORDO') ; LIST (EXTR B 'ORDO') ;",
    ),
)
def turned_components(call: Call, first: Curve, second: Curve, angle: float) -> tuple[Curve, Curve]:
    """Turn two components."""
    x, y = one_part(call, first), one_part(call, second)
    check_together(call, first, second)
    a, b = turned(x.ordinates, y.ordinates, angle)
    return (
        Curve((dataclasses.replace(x, ordinates=a),), first.title),
        Curve((dataclasses.replace(y, ordinates=b),), second.title),
    )
