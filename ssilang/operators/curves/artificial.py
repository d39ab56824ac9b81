"""SIAR PERT: artificial signals and random perturbations."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.curves.curve import Curve, CurvePart
from ssilang.kernel.records.artificial import Band, motion, perturbed, sines
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListReel
from ssilang.operators.curves.accelerograms import one_curve
from ssilang.operators.numbers.noise import session_generator

_SERIES = ("ACCE", "VITE", "DEPL")
_NUMBERS = ("TINI", "NCOU", "NPOI", "NSIN", "INIT")


def _drawn(call: Call, seed: int | None) -> np.random.Generator:
    """A generator begun by the user's number, or the session's."""
    return session_generator(call, None) if seed is None else np.random.default_rng(abs(seed))


@operator(
    "SIAR",
    family="signals",
    full_name="SIAR",
    help=Help(
        en="Artificial signals of a one-sided power density (per hertz): sums of sines of random "
        "phase, times modulations in time given for bands of frequencies (limits in the list), "
        "from 0 to X1. Acceleration, velocity and displacement, or those named. 'TINI' start, "
        "'NCOU' number of signals, 'NPOI' number of instants (steps of 0.02 s by default), 'NSIN' "
        "number of sines (slices of 0.1 Hz by default), 'INIT' start of the random numbers.",
        fr="Signaux artificiels d'une densité de puissance unilatérale (par hertz) : sommes de "
        "sinus de phase aléatoire, fois des modulations en temps données par bandes de fréquence "
        "(bornes dans la liste), de 0 à X1. Accélération, vitesse et déplacement, ou ceux nommés. "
        "'TINI' instant initial, 'NCOU' nombre de signaux, 'NPOI' nombre d'instants (pas de 0,02 s "
        "par défaut), 'NSIN' nombre de sinus (bandes de 0,1 Hz par défaut), 'INIT' germe.",
        syntax="EVOL1 EVOL2 EVOL3 = SIAR EVOL4 (EVOL5 LREEL1) (X1) ('TINI' X2) ('ACCE') ('VITE') "
        "('DEPL') ('NCOU' N1) ('NPOI' N2) ('NSIN' N3) ('INIT' N4) ;",
        examples=(
            "S = EVOL 'MANU' 'FREQ' (PROG 0.5 10.) 'DSP' (PROG 0.1 0.1) ; "
            "A = SIAR S 8. 'ACCE' 'INIT' 3 ; LIST (DIME (EXTR A 'ORDO')) ;",
        ),
    ),
    reads_itself=True,
)
def siar(call: Call) -> Any:
    """Draw signals."""
    _, part = one_curve(call)
    modulation = call.optional("EVOLUTIO")
    limits = call.required("LISTREEL").values if modulation is not None else None
    given = call.optional("FLOTTANT")
    wanted: list[str] = []
    said: dict[str, Any] = {}
    while (word := call.keyword(_SERIES + _NUMBERS)) is not None:
        if word in _SERIES:
            wanted.append(word)
        else:
            kind = "FLOTTANT" if word == "TINI" else "ENTIER"
            said[word] = call.required(kind, after=call.keyword_end)
    given = call.optional("FLOTTANT") if given is None else given
    bands = _bands(call, part, modulation, limits, given)
    start = float(said.get("TINI", bands[0].times[0]))
    end = float(bands[0].times[-1]) if given is None else float(given)
    if not bands[0].times[0] <= start < end <= bands[0].times[-1]:
        raise call.error(
            "operators.curves.signals-outside-modulation",
            start=start,
            end=end,
            times=bands[0].times[0],
            times_2=bands[0].times[-1],
        )
    if said.get("NPOI", 2) < 2 or said.get("NSIN", 1) < 1:
        raise call.error("operators.curves.signal-too-short")
    times = np.linspace(start, end, said.get("NPOI", round((end - start) / 0.02) + 1))
    width = float(part.abscissas[-1] - part.abscissas[0])
    count = said.get("NSIN", max(round(width / 0.1), 1))
    if len(times) < 2 or count < 1:
        raise call.error("operators.curves.signal-too-short")
    f, amplitudes = sines(part.abscissas, part.ordinates, count)
    generator = _drawn(call, said.get("INIT"))
    drawn = []
    for _ in range(said.get("NCOU", 1)):
        phases = 2.0 * np.pi * generator.random(count)
        drawn.append(motion(times, f, amplitudes, phases, bands, float(bands[0].times[0])))
    made = [_series(times, drawn, w, part.colour) for w in _SERIES if w in (wanted or _SERIES)]
    return made[0] if len(made) == 1 else tuple(made)


def _series(times: FloatArray, drawn: list[Any], word: str, colour: int) -> Curve:
    place = _SERIES.index(word)
    parts = [
        CurvePart(times, rows[place], "TEMPS", f"{word} {k}", f"SIGNAL {k}", colour)
        for k, rows in enumerate(drawn, 1)
    ]
    return Curve(tuple(parts), f"SIGNAL {word}")


def _bands(
    call: Call, spectrum: CurvePart, modulation: Curve | None, limits: Any, end: float | None
) -> tuple[Band, ...]:
    f = spectrum.abscissas
    if len(f) < 2 or (np.diff(f) <= 0).any() or f[0] < 0:
        raise call.error("operators.curves.not-a-power-spectrum")
    if modulation is None:
        if end is None:
            raise call.missing(("FLOTTANT",))
        times = np.array([min(0.0, end), end])
        return (Band(float(f[0]), float(f[-1]), times, np.ones(2)),)
    if len(limits) != len(modulation.parts) + 1:
        raise call.error(
            "operators.curves.limits-of-bands",
            n_parts=len(modulation.parts),
            least=len(modulation.parts) + 1,
            n_limits=len(limits),
        )
    pairs = zip(limits[:-1], limits[1:], modulation.parts, strict=True)
    bands = tuple(Band(float(a), float(b), p.abscissas, p.ordinates) for a, b, p in pairs)
    ends = np.array([[b.times[0], b.times[-1]] for b in bands])
    if np.ptp(ends, axis=0).max() > 1e-6:
        raise call.error("operators.curves.modulations-differ", modulation)
    return bands


@operator(
    "PERT",
    family="signals",
    help=Help(
        en="A list perturbed at random: signs drawn ('SIGN', the default), or a part of each "
        "square given to the neighbours ('AMPL': the share sin^2 of an angle drawn between 0 and "
        "X1 degrees; the sum of squares stays), or both. 'INIT' starts the random numbers.",
        fr="Liste perturbée au hasard : signes tirés ('SIGN', par défaut), ou une part de chaque "
        "carré donnée aux voisins ('AMPL' : la part sin^2 d'un angle tiré entre 0 et X1 degrés ; "
        "la somme des carrés reste), ou les deux. 'INIT' donne le germe.",
        syntax="LREEL1 = PERT LREEL2 ('SIGN') ('AMPL' X1) ('INIT' N1) ;",
        examples=("LIST (SOMM ((PERT (PROG 1. 2. 3.) 'AMPL' 30. 'INIT' 1) ** 2)) ;",),
    ),
    reads_itself=True,
)
def pert(call: Call) -> ListReel:
    """Perturb values."""
    values = call.required("LISTREEL").values
    signs, degrees, seed = False, None, None
    while (word := call.keyword(("SIGN", "AMPL", "INIT"))) is not None:
        if word == "SIGN":
            signs = True
        elif word == "AMPL":
            degrees = call.required("FLOTTANT", after=call.keyword_end)
        else:
            seed = call.required("ENTIER", after=call.keyword_end)
    generator = _drawn(call, seed)
    return ListReel(perturbed(values, generator, signs or degrees is None, degrees))
