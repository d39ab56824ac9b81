"""ZINC: motion of a rigid footing under passing and incoherent waves, behind @INCOHER."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import workspace

if TYPE_CHECKING:
    from ssilang.kernel.base.arrays import FloatArray
    from ssilang.kernel.curves.curve import Curve
    from ssilang.kernel.waves.incoherence import Factors, Footing

#: gamma of Luco and Wong: what is used lies below
LARGEST_GAMMA = 0.5
#: no wave runs along the ground slower than Rayleigh's at a Poisson's ratio of zero
SLOWEST = 0.874
#: share of the peak that a record may lose before its beginning
LOST = 0.02
#: sizes of a shape, along x and y
SIZES = {
    "DISQUE": ("RAYON",),
    "RECTANGLE": ("DEMI_LONGUEUR", "DEMI_LARGEUR"),
    "BANDE": ("DEMI_LARGEUR",),
}
#: rotations: name, direction of the slope, factor
Turned = tuple[tuple[str, int, float], ...]
#: what a motion turns, by dimension and component: rotation, direction of the slope, sign
TURNED: dict[tuple[int, str], Turned] = {
    (2, "UX"): (),
    (2, "UY"): (("RZ", 0, 1.0),),
    (3, "UX"): (("RZ", 1, -1.0),),
    (3, "UY"): (("RZ", 0, 1.0),),
    (3, "UZ"): (("RX", 1, 1.0), ("RY", 0, -1.0)),
}


@operator(
    "ZINC",
    arg("table", "TABLE", en="table of @INCOHER", fr="table de @INCOHER"),
    family="dynamics",
    help=Help(
        en="Motion of a rigid footing under passing and incoherent waves, for @INCOHER, whose "
        "table it takes.",
        fr="Mouvement d'une fondation rigide sous des ondes qui passent et incohérentes, pour "
        "@INCOHER, dont il prend la table.",
        syntax="TAB2 = ZINC TAB1 ;",
        examples=(
            "OPTI DIME 3 ; T = TABL ; T . 'FORME' = 'DISQUE' ; T . 'RAYON' = 20. ;"
            " T . 'COMPOSANTE' = 'UX' ; T . 'INCOHERENCE' = 0.2 ; T . 'VITESSE' = 300. ;"
            " T . 'FREQUENCES' = PROG 0. 5. 10. ; W = ZINC T ;"
            " LIST (EXTR (W . 'FACTEURS' . 'UX') 'ORDO') ;",
        ),
    ),
)
def zinc(call: Call, table: Table) -> Table:
    """Read the table, compute, hand back curves."""
    entries = Entries(call, table, "@INCOHER")
    component, dimension = str(entries.needed("COMPOSANTE")), workspace(call.session).dimension
    if (dimension, component) not in TURNED:
        raise entries.error(
            "operators.dynamics.component-of-dimension", component=component, dimension=dimension
        )
    motion = _Motion(entries, _footing(entries, dimension))
    turned = motion.turned(dimension, component)
    record = _record(entries)
    frequencies = _frequencies(entries, record)
    at, result = motion.at(frequencies), Table()
    result.set("FACTEURS", _factors(at, frequencies, component, turned))
    if turned:
        result.set("COHERENCES", _coherences(at, frequencies, turned))
    if record is not None:
        result.set("ACCELERATION", _moved(entries, motion, record, component, turned))
    return result


class _Motion:
    """Ground and footing: factors at frequencies."""

    def __init__(self, entries: Entries, footing: Footing) -> None:
        self.footing = footing
        gamma, speed = float(entries.get("INCOHERENCE")), entries.get("VITESSE")
        if gamma < 0:
            raise entries.error("operators.dynamics.incoherence-negative", value=gamma)
        if gamma > 0 and speed is None:
            entries.needed("VITESSE")
        if gamma > LARGEST_GAMMA:
            entries.warn("operators.dynamics.incoherence-range", value=gamma, largest=LARGEST_GAMMA)
        self.gamma = gamma
        self.speed = 1.0 if speed is None else _positive(entries, "VITESSE")
        self.slowness = _slowness(entries, None if speed is None else self.speed)
        if gamma == 0 and not self.slowness.any():
            entries.warn("operators.dynamics.motion-coherent")

    def at(self, frequencies: FloatArray) -> Factors:
        """Factors at frequencies (Hz)."""
        from ssilang.kernel.waves.incoherence import factors

        omega = 2 * np.pi * np.asarray(frequencies, float)
        return factors(
            self.footing, self.gamma * omega / self.speed, omega[:, None] * self.slowness
        )

    def turned(self, dimension: int, component: str) -> Turned:
        """Rotations: name, direction of the slope, factor; torsion by shares of inertia."""
        from ssilang.kernel.waves.incoherence import Strip

        turned = TURNED[dimension, component]
        if component == "UZ" or dimension == 2 or isinstance(self.footing, Strip):
            return turned
        shares = self.footing.torsion()
        return tuple((name, way, sign * shares[way]) for name, way, sign in turned)


def _slowness(entries: Entries, shear: float | None) -> FloatArray:
    """1 / V times the direction of the way, s/m."""
    turned = float(entries.get("AZIMUT"))
    if entries.get("VITESSE_APPARENTE") is None:
        entries.refuse({"AZIMUT": "operators.dynamics.azimuth-of-nothing"})
        return np.zeros(2)
    if entries.get("FORME") == "BANDE":
        entries.refuse({"AZIMUT": "operators.dynamics.azimuth-of-strip"})
    speed = _positive(entries, "VITESSE_APPARENTE")
    if shear is not None and speed < SLOWEST * shear:
        entries.warn(
            "operators.dynamics.apparent-speed-range",
            value=speed, shear=shear, slowest=SLOWEST * shear,
        )  # fmt: skip
    way = np.radians(turned)
    return np.array([np.cos(way), np.sin(way)]) / speed


def _positive(entries: Entries, index: str) -> float:
    value = float(entries.needed(index))
    if value <= 0:
        raise entries.error("operators.dynamics.entry-not-positive", index=index, value=value)
    return value


def _footing(entries: Entries, dimension: int) -> Footing:
    from ssilang.kernel.waves.incoherence import Disc, Rectangle, Strip

    shape = str(entries.needed("FORME"))
    if shape == "BANDE" and dimension == 3:
        raise entries.error("operators.dynamics.strip-in-space")
    others = {name for names in SIZES.values() for name in names} - set(SIZES[shape])
    entries.refuse(dict.fromkeys(sorted(others), "operators.dynamics.size-of-other-shape"))
    sizes = [_positive(entries, name) for name in SIZES[shape]]
    if shape == "RECTANGLE":
        return Rectangle(*sizes)
    return Disc(*sizes) if shape == "DISQUE" else Strip(*sizes)


@dataclass(frozen=True)
class _Record:
    """Instants (n,), their step (s) and values (n,), m/s2."""

    times: FloatArray
    step: float
    values: FloatArray


def _record(entries: Entries) -> _Record | None:
    given = entries.get("ACCELERATION")
    if given is None:
        return None
    part = cast("Curve", given).parts[0]
    steps = np.diff(part.abscissas)
    if len(steps) == 0 or steps.mean() <= 0 or np.ptp(steps) > 1e-3 * steps.mean():
        raise entries.error("operators.dynamics.equal-steps-of-record")
    return _Record(part.abscissas, float(steps.mean()), part.ordinates)


def _frequencies(entries: Entries, record: _Record | None) -> FloatArray:
    """Those given, else 201 up to the highest that the record holds."""
    given = entries.get("FREQUENCES")
    if given is None:
        if record is None:
            raise entries.error("operators.dynamics.frequencies-or-record")
        return np.linspace(0.0, 0.5 / record.step, 201)
    frequencies = np.asarray(given.values, float)
    if len(frequencies) == 0 or frequencies.min() < 0:
        raise entries.error(
            "operators.dynamics.frequencies-negative", value=float(frequencies.min(initial=0.0))
        )
    return frequencies


def _factors(at: Factors, frequencies: FloatArray, component: str, turned: Turned) -> Table:
    """Moduli of translation (1) and rotations (1/m)."""
    result = Table()
    result.set(component, _curve(frequencies, np.abs(at.mean), "Hz", ""))
    for name, way, factor in turned:
        result.set(name, _curve(frequencies, np.abs(factor * at.slopes[:, way]), "Hz", "1/m"))
    return result


def _coherences(at: Factors, frequencies: FloatArray, turned: Turned) -> Table:
    result = Table()
    for name, way, _ in turned:
        result.set(name, _curve(frequencies, at.coherence[:, way], "Hz", ""))
    return result


def _moved(
    entries: Entries, motion: _Motion, record: _Record, component: str, turned: Turned
) -> Table:
    """Accelerations of the footing."""
    from ssilang.kernel.waves.incoherence import filtered

    made = filtered(record.values, record.step, motion.at)
    if made.lost > LOST:
        entries.warn("operators.dynamics.motion-before-record", seconds=made.early, share=made.lost)
    times, result = record.times, Table()
    result.set(component, _curve(times, made.mean, "s", "m/s2"))
    for name, way, factor in turned:
        result.set(name, _curve(times, factor * made.slopes[:, way], "s", "rad/s2"))
    return result


def _curve(abscissas: FloatArray, ordinates: FloatArray, *units: str) -> Curve:
    from ssilang.kernel.curves.curve import Curve, CurvePart

    names = ("f (Hz)", "factor") if units[0] == "Hz" else ("t (s)", "acceleration")
    return Curve((CurvePart(abscissas, ordinates, *names).measured(*units),))
