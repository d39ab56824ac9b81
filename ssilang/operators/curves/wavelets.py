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
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.curves.accelerograms import one_curve
from ssilang.operators.curves.words import read_colour
from ssilang.operators.workspace import workspace

_NUMBERS = {"FMIN": 0.0, "FMAX": 0.0, "NFRQ": 50.0, "DFRQ": 50.0, "EPSI": 1e-4, "PULS": 5.0}


@operator(
    "ONDE",
    family="signals",
    full_name="ONDE",
    help=Help(
        en="Continuous wavelet transform (Morlet's wavelet of pulsation 'PULS', 5 by default) of a "
        "signal on 2**N1 points, scaled so that a sine gives its amplitude. 'REIM' or 'MOPH': "
        "nodal field (PREE PIMA, or MODU and PHAS in degrees) and its mesh, a unit square with "
        "time in abscissa and frequency in ordinate (evenly spaced in 1/f), zero near the ends. "
        "'CRMO' or 'CRPH': its ridge, by the largest modulus or where the phase turns at the "
        "wavelet's pulsation to 'EPSI' (1.E-4): frequency and amplitude in time.",
        fr="Transformée en ondelettes continue (ondelette de Morlet de pulsation 'PULS', 5 par "
        "défaut) d'un signal sur 2**N1 points, normée pour qu'un sinus donne son amplitude. "
        "'REIM' ou 'MOPH' : champ par points (PREE PIMA, ou MODU et PHAS en degrés) et son "
        "maillage, carré unité avec le temps en abscisse et la fréquence en ordonnée (régulière "
        "en 1/f), nul près des bouts. 'CRMO' ou 'CRPH' : son arête, par le plus grand module ou "
        "là où la phase tourne à la pulsation de l'ondelette à 'EPSI' près (1.E-4) : fréquence et "
        "amplitude en fonction du temps.",
        syntax="CHP1 MAIL1 = ONDE N1 EVOL2 'REIM' | 'MOPH' 'FMIN' F1 'FMAX' F2 ('NFRQ' N2) "
        "('PULS' X4) ;\nEVOL1 = ONDE N1 EVOL2 ('CRMO' | 'CRPH') 'FMIN' F1 'FMAX' F2 ('NFRQ' N2) "
        "('EPSI' X5) ('PULS' X4) (COUL1) ;",
        examples=(
            "T = PROG 0. PAS 0.02 NPAS 511 ; S = EVOL 'MANU' 'TEMP' T 'A' (3. * (SIN (720. * T))) "
            "; R = ONDE 9 S 'CRMO' 'FMIN' 1. 'FMAX' 4. ; LIST (DIME R) ;",
        ),
    ),
    reads_itself=True,
)
def onde(call: Call) -> Any:
    """Wavelet transform."""
    power = call.required("ENTIER")
    if not 1 <= power <= 20:
        raise call.error("operators.curves.power-of-two-of-wavelets", power, power=power)
    curve, part = one_curve(call)
    form = call.keyword(("CRMO", "CRPH", "REIM", "MOPH"))
    said = dict(_NUMBERS)
    while (word := call.keyword(tuple(_NUMBERS))) is not None:
        said["NFRQ" if word == "DFRQ" else word] = call.required("FLOTTANT", after=call.keyword_end)
    form = form or call.keyword(("CRMO", "CRPH", "REIM", "MOPH")) or "CRMO"
    colour = read_colour(call) or 0
    count = int(said["NFRQ"])
    if not 0.0 < said["FMIN"] < said["FMAX"] or count < 1 or said["PULS"] <= 0.0:
        raise call.error(
            "operators.curves.frequencies-must-increase", fmin=said["FMIN"], fmax=said["FMAX"]
        )
    step, n = constant_step(part.abscissas), 2**power
    if n * (count + 1) > 20_000_000:
        raise call.error("operators.curves.transform-too-large")
    scale = scales(said["FMIN"], said["FMAX"], count, said["PULS"])
    found = transform(part.ordinates, step, n, scale, said["PULS"])
    times = part.abscissas[0] + step * np.arange(n)
    if form in ("REIM", "MOPH"):
        return _square(call, times, found, scale, form)
    if form == "CRMO":
        t, f, size = modulus_ridge(times, found, scale, said["PULS"])
    else:
        t, f, size = phase_ridge(times, found, scale, said["PULS"], said["EPSI"])
    parts = (
        CurvePart(t, f, "TEMPS", "FREQ (HZ)", "FREQUENCE", colour),
        CurvePart(t, size, "TEMPS", "MODULE", "MODULE", colour),
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
