"""FILT of a record, TOUR of two components, ZOND: a record matched to a spectrum."""

from __future__ import annotations

import dataclasses

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.directions import turned
from ssilang.kernel.records.filters import butterworth
from ssilang.kernel.records.matching import matched
from ssilang.kernel.records.signals import constant_step
from ssilang.language.registry import Help, arg, flag, key, operator
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import ANY_NUMBER, BELOW_CRITICAL, NOT_NEGATIVE, POSITIVE
from ssilang.operators.curves.signals import filt
from ssilang.operators.curves.words import CURVE, check_together, one_part
from ssilang.operators.mesh.copies.images import tour


@filt.form(
    CURVE,
    key("order", "ORDR", arg("n", "ENTIER", range=POSITIVE), default=4, en="order, 4 without it"),
    key("low", "PHAU", arg("f", "FLOTTANT", range=POSITIVE, unit="Hz"), en="slower is taken off"),
    key("high", "PBAS", arg("f", "FLOTTANT", range=POSITIVE, unit="Hz"), en="faster is taken off"),
    flag("causal", "CAUS", en="one pass, as a device does"),
    en="A record itself, filtered by Butterworth's of order N1 (4): without what is slower than F1 "
    "('PHAU') or faster than F2 ('PBAS'). Forth and back, without phase, both corners count "
    "twice (half the amplitude there); 'CAUS': one pass (0.707 there), with a phase.",
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
    arg("first", "EVOLUTIO", en="component along x"),
    arg("second", "EVOLUTIO", en="component along y"),
    arg("angle", "FLOTTANT", "ENTIER", en="angle", unit="deg", range=ANY_NUMBER),
    gives=("EVOLUTIO", "EVOLUTIO"),
    en="Two horizontal components of a record along axes turned by an angle in degrees, from x to "
    "y.",
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


@operator(
    "ZOND",
    arg("record", "EVOLUTIO", en="acceleration"),
    arg("target", "EVOLUTIO", en="pseudo-accelerations over Hz"),
    key("damping", "AMOR", arg("xi", "FLOTTANT", range=NOT_NEGATIVE, usual=BELOW_CRITICAL),
        default=0.05, en="damping"),
    key("tolerance", "TOLE", arg("x", "FLOTTANT", range=POSITIVE), default=0.05,
        en="largest misfit, 0.05 without it"),
    family="signals",
    gives=("EVOLUTIO", "FLOTTANT"),
    help=Help(
        en="The record near a given one whose spectrum is a target at its frequencies, by wavelets "
        "added in time (Al Atik and Abrahamson 2010), for @ACCORD; and the largest misfit, as a "
        "part of the target.",
        syntax="EVOL1 X1 = ZOND EVOL2 EVOL3 ('AMOR' X2) ('TOLE' X3) ;",
        examples=(
            "T = PROG 0. PAS 0.02 8. ; B = SIN (22.5 * T) ;\n"
            "A = EVOL 'MANU' 'TEMP' T 'ACCE' (B * (SIN (T * 700.))) ;\n"
            "C = EVOL 'MANU' 'FREQ' (PROG 1. 2. 4.) 'ACCE' (PROG 2. 3. 2.) ;\n"
            "D X = ZOND A C ; LIST (X < 0.05) ;",
        ),
    ),
)  # fmt: skip
def zond(
    call: Call, record: Curve, target: Curve, damping: float, tolerance: float
) -> tuple[Curve, float]:
    """Match a record."""
    part, wanted = one_part(call, record), one_part(call, target)
    found = matched(
        part.abscissas, part.ordinates, wanted.abscissas, wanted.ordinates, damping, tolerance
    )
    made = dataclasses.replace(part, ordinates=found.values)
    return Curve((made,), record.title), found.misfit
