"""ZSPP: the figures behind the procedure SPPLANC."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.floors import Storey, floor_spectrum
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel


@operator(
    "ZSPP",
    family="signals",
    help=Help(
        en="Standard deviations and peak factors of a floor spectrum, for SPPLANC, the procedure "
        "to call: frequencies, dampings and participations of modes, frequencies of the spectrum, "
        "its damping, power density, envelope.",
        fr="Écarts-types et facteurs de pic d'un spectre de plancher, pour SPPLANC, procédure à "
        "appeler : fréquences, amortissements et participations des modes, fréquences du spectre, "
        "son amortissement, densité de puissance, enveloppe.",
        syntax="LREEL1 LREEL2 = ZSPP LREEL3 LREEL4 LREEL5 LREEL6 X1 EVOL1 EVOL2 ;",
    ),
    reads_itself=True,
)
def zspp(call: Call) -> tuple[ListReel, ListReel]:
    """Relative displacements of oscillators on a floor."""
    modes = [np.asarray(call.required("LISTREEL").values, dtype=float) for _ in range(3)]
    frequencies = np.asarray(call.required("LISTREEL").values, dtype=float)
    damping = float(call.required("FLOTTANT"))
    power: Curve = call.required("EVOLUTIO")
    envelope: Curve = call.required("EVOLUTIO")
    density, shape = ((c.parts[0].abscissas, c.parts[0].ordinates) for c in (power, envelope))
    deviations, factors = floor_spectrum(Storey(*modes), density, shape, frequencies, damping)
    return ListReel(deviations), ListReel(factors)
