"""ONDE: continuous wavelet transform of a signal, and its ridge."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.records.signals import constant_step
from ssilang.kernel.records.wavelets import modulus_ridge, phase_ridge, scales, settled, transform
from ssilang.language.registry import Help, arg, by, choice, key, operator
from ssilang.language.run.call import Call
from ssilang.language.vocabulary.terms import NOT_NEGATIVE, POSITIVE
from ssilang.operators.curves.words import COLOUR, CURVE, one_part, shade
from ssilang.operators.workspace import workspace


@operator(
    "ONDE",
    arg("power", "ENTIER", range=POSITIVE, en="2**N1 points"),
    CURVE,
    choice(
        "form",
        ("CRMO", "CRPH", "REIM", "MOPH"),
        default="CRMO",
        en="ridge by the modulus (default) or by the phase, or the transform as a field",
    ),
    key(
        "lowest",
        "FMIN",
        arg("lowest", "FLOTTANT", range=NOT_NEGATIVE, unit="Hz"),
        default=0.0,
        en="lowest frequency",
    ),
    key(
        "highest",
        "FMAX",
        arg("highest", "FLOTTANT", range=POSITIVE, unit="Hz"),
        default=0.0,
        en="highest frequency",
    ),
    key(
        "count",
        ("NFRQ", "DFRQ"),
        arg("count", "FLOTTANT", range=POSITIVE),
        default=("NFRQ", 50.0),
        en="number of frequencies, 50 without it",
    ),
    key(
        "turn",
        "EPSI",
        arg("turn", "FLOTTANT", range=POSITIVE),
        default=1e-4,
        en="tolerance of the phase, 1.E-4 without it",
    ),
    key(
        "pulsation",
        "PULS",
        arg("pulsation", "FLOTTANT", range=POSITIVE),
        default=5.0,
        en="pulsation of the wavelet, 5 without it",
    ),
    COLOUR,
    family="signals",
    full_name="ONDE",
    gives=by("form", dict.fromkeys(("REIM", "MOPH"), ("CHPOINT", "MAILLAGE")), "EVOLUTIO"),
    help=Help(
        en="Continuous wavelet transform (Morlet's wavelet of pulsation 'PULS', 5 by default) of a "
        "signal on 2**N1 points, scaled so that a sine gives its amplitude. 'REIM' or 'MOPH': "
        "nodal field (PREE PIMA, or MODU and PHAS in degrees) and its mesh, a unit square with "
        "time in abscissa and frequency in ordinate (evenly spaced in 1/f), zero near the ends. "
        "'CRMO' or 'CRPH': its ridge, by the largest modulus or where the phase turns at the "
        "wavelet's pulsation to 'EPSI' (1.E-4): frequency and amplitude in time.",
        syntax="CHP1 MAIL1 = ONDE N1 EVOL2 'REIM' | 'MOPH' 'FMIN' F1 'FMAX' F2 ('NFRQ' N2) "
        "('PULS' X4) ;\nEVOL1 = ONDE N1 EVOL2 ('CRMO' | 'CRPH') 'FMIN' F1 'FMAX' F2 ('NFRQ' N2) "
        "('EPSI' X5) ('PULS' X4) (COUL1) ;",
        examples=(
            "T = PROG 0. PAS 0.02 NPAS 511 ; S = EVOL 'MANU' 'TEMP' T 'A' (3. * (SIN (720. * T))) "
            "; R = ONDE 9 S 'CRMO' 'FMIN' 1. 'FMAX' 4. ; LIST (DIME R) ;",
        ),
    ),
)
def onde(
    call: Call,
    power: int,
    curve: Curve,
    form: str,
    lowest: float,
    highest: float,
    count: tuple[str, float],
    turn: float,
    pulsation: float,
    colour: str | None,
) -> Any:
    """Wavelet transform."""
    if not 1 <= power <= 20:
        raise call.error("operators.curves.power-of-two-of-wavelets", power, power=power)
    part, rows = one_part(call, curve), int(count[1])
    if not 0.0 < lowest < highest or rows < 1 or pulsation <= 0.0:
        raise call.error("operators.curves.frequencies-must-increase", fmin=lowest, fmax=highest)
    step, n = constant_step(part.abscissas), 2**power
    if n * (rows + 1) > 20_000_000:
        raise call.error("operators.curves.transform-too-large")
    scale = scales(lowest, highest, rows, pulsation)
    found = transform(part.ordinates, step, n, scale, pulsation)
    times = part.abscissas[0] + step * np.arange(n)
    if form in ("REIM", "MOPH"):
        return _square(call, times, found, scale, form)
    if form == "CRMO":
        t, f, size = modulus_ridge(times, found, scale, pulsation)
    else:
        t, f, size = phase_ridge(times, found, scale, pulsation, turn)
    index = shade(colour, 0)
    parts = (
        CurvePart(t, f, "TEMPS", "FREQ (HZ)", "FREQUENCE", index),
        CurvePart(t, size, "TEMPS", "MODULE", "MODULE", index),
    )
    return Curve(parts, curve.title)


def _square(
    call: Call, times: FloatArray, found: ComplexArray, scale: FloatArray, form: str
) -> tuple[NodeField, Mesh]:
    ws = workspace(call.session)
    rows, n = found.shape
    if ws.dimension < 2:
        raise call.error("operators.curves.two-dimensions-wanted")
    xy = np.zeros((rows * n, ws.dimension))
    xy[:, 0] = np.tile(np.linspace(0.0, 1.0, n), rows)
    xy[:, 1] = np.repeat(np.linspace(1.0, 0.0, rows), n)
    ids = ws.nodes.add(xy, ws.density)
    grid = np.asarray(ids).reshape(rows, n)
    corners = (grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:], grid[:-1, :-1])
    cells = np.stack([c.ravel() for c in corners], axis=1)
    mesh = Mesh.of(ws.nodes, "QUA4", cells, ws.colour)
    inside = np.array([settled(times, float(a)) for a in scale])
    values = np.where(inside, found, 0.0).ravel()
    if form == "REIM":
        pair = {"PREE": values.real.copy(), "PIMA": values.imag.copy()}
    else:
        pair = {"MODU": np.abs(values), "PHAS": np.degrees(np.angle(values))}
    return NodeField.of(ws.nodes, np.asarray(ids), pair, "DIFFUS"), mesh
