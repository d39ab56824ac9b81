"""ENVE of response spectra: the largest of several, damping by damping."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.language.registry import arg
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel, Mot, Table
from ssilang.operators.mesh.selection.boundaries import enve

SAME = 1e-6  # relative: dampings this near are one


def _spectra(call: Call, table: Table) -> list[tuple[Curve, list[float]]]:
    """Spectra of a table with the dampings of their curves."""
    found = []
    for index, entry in table.items():
        if type(index) is not int or not isinstance(entry, Table):
            continue
        curve, dampings = entry.get(Mot("SPECTRE")), entry.get(Mot("AMORTISSEMENT"))
        if not isinstance(curve, Curve) or not isinstance(dampings, ListReel):
            raise call.error("operators.curves.spectrum-and-dampings-wanted", table, index=index)
        if len(dampings) != len(curve.parts):
            raise call.error(
                "operators.curves.curves-and-dampings-differ",
                index=index,
                n_parts=len(curve.parts),
                n_dampings=len(dampings),
            )
        found.append((curve, [float(v) for v in dampings.values]))
    if not found:
        raise call.error("operators.curves.table-has-no-spectrum", table)
    return found


def largest(parts: list[CurvePart]) -> CurvePart:
    """Largest of curves linear between their points, each within its own abscissas."""
    x = np.unique(np.concatenate([p.abscissas for p in parts]))
    rows = [np.interp(x, p.abscissas, p.ordinates, left=-np.inf, right=-np.inf) for p in parts]
    first = parts[0]
    y = np.max(rows, axis=0)
    return CurvePart(x, y, first.abscissa_name, first.ordinate_name, first.legend, first.colour)


@enve.form(arg("table", "TABLE", en="spectra"))
def envelope_of_spectra(call: Call, table: Table) -> Table:
    """Envelope of spectra."""
    spectra = _spectra(call, table)
    every = sorted({d for _, dampings in spectra for d in dampings})
    kept = [d for i, d in enumerate(every) if not i or d - every[i - 1] > SAME * max(d, 1e-12)]
    parts = []
    for damping in kept:
        same = [
            p
            for curve, dampings in spectra
            for p, d in zip(curve.parts, dampings, strict=True)
            if abs(d - damping) <= SAME * max(damping, 1e-12)
        ]
        parts.append(largest(same))
    made = Table()
    made.set(Mot("SPECTRE"), Curve(tuple(parts), spectra[0][0].title))
    made.set(Mot("AMORTISSEMENT"), ListReel(kept))
    return made


enve.extend_help(
    syntax="TAB1 = ENVE TAB2 ;",
    en="Of a table of spectra (at 1, 2 ... tables with SPECTRE, curves, and AMORTISSEMENT, their "
    "dampings): a table with the envelope, the largest ordinate for each damping.",
    examples=(
        "T = TABL ; T . 1 = TABL ; T . 1 . 'SPECTRE' = EVOL 'MANU' (PROG 1. 2.) (PROG 3. 4.) ; "
        "T . 1 . 'AMORTISSEMENT' = PROG 0.05 ; E = ENVE T ; LIST (E . 'AMORTISSEMENT') ;",
    ),
)
