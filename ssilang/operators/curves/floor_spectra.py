"""ZSPP: the figures behind the procedure SPPLANC."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.records.floors import Storey, floor_spectrum
from ssilang.language.registry import Help, arg, operator
from ssilang.language.values import ListReel
from ssilang.language.vocabulary.terms import ANY_NUMBER, BELOW_CRITICAL, NOT_NEGATIVE, POSITIVE


@operator(
    "ZSPP",
    arg(
        "modes",
        "LISTREEL",
        range=POSITIVE,
        en="frequencies of modes",
        unit="Hz",
    ),
    arg(
        "dampings",
        "LISTREEL",
        range=NOT_NEGATIVE,
        usual=BELOW_CRITICAL,
        en="their dampings",
    ),
    arg("shares", "LISTREEL", en="their participations", range=ANY_NUMBER),
    arg(
        "frequencies",
        "LISTREEL",
        range=POSITIVE,
        en="frequencies of the spectrum",
        unit="Hz",
    ),
    arg(
        "damping",
        "FLOTTANT",
        range=NOT_NEGATIVE,
        usual=BELOW_CRITICAL,
        en="its damping",
    ),
    arg("power", "EVOLUTIO", en="power density"),
    arg("envelope", "EVOLUTIO", en="envelope"),
    family="signals",
    help=Help(
        en="Standard deviations and peak factors of a floor spectrum, for SPPLANC, the procedure "
        "to call: frequencies, dampings and participations of modes, frequencies of the spectrum, "
        "its damping, power density, envelope.",
        syntax="LREEL1 LREEL2 = ZSPP LREEL3 LREEL4 LREEL5 LREEL6 X1 EVOL1 EVOL2 ;",
    ),
)
def zspp(
    modes: ListReel,
    dampings: ListReel,
    shares: ListReel,
    frequencies: ListReel,
    damping: float,
    power: Curve,
    envelope: Curve,
) -> tuple[ListReel, ListReel]:
    """Relative displacements of oscillators on a floor."""
    storey = Storey(*(np.asarray(v.values, dtype=float) for v in (modes, dampings, shares)))
    over = np.asarray(frequencies.values, dtype=float)
    density, shape = ((c.parts[0].abscissas, c.parts[0].ordinates) for c in (power, envelope))
    deviations, factors = floor_spectrum(storey, density, shape, over, damping)
    return ListReel(deviations), ListReel(factors)
