"""ZBAS: a rigid base under waves that pass and differ, behind the procedure @PASSAGE."""

from ssilang.kernel.waves.incoherence import (
    Ground,
    RigidBase,
    Shape,
    averaged,
    factors,
    frequencies_of,
    signs,
    steps_before,
)
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_SHAPES: dict[str, Shape] = {"DISQUE": "disc", "RECTANGLE": "rectangle", "BANDE": "strip"}
_SIZES = {
    "DISQUE": ("RAYON", "RAYON"),
    "RECTANGLE": ("DEMI_LONGUEUR", "DEMI_LARGEUR"),
    "BANDE": ("DEMI_LARGEUR",),
}
_MEASURED = 0.5
"""Largest incoherence that dense arrays have shown."""
_SLOWEST = 0.86
"""Speed of Rayleigh's waves over that of shear waves, for a Poisson's ratio of zero."""

_IMPOSSIBLE = 0.1
"""Part of it below which a speed is no wave's: km/s, most often, and calculations without end."""


@operator("ZBAS", family="dynamics")
def zbas(call: Call, table: Table = Arg("TABLE", en="table of @PASSAGE")) -> Table:
    """Read the table, compute, hand back curves over the frequency and the base's record."""
    entries = Entries(call, table, "@PASSAGE")
    base, ground = _base(entries), _ground(entries)
    frequencies, record = entries.get("FREQUENCES"), entries.get("ACCELERATION")
    if frequencies is None and record is None:
        raise entries.error("operators.dynamics.base-without-question")
    result = Table()
    if frequencies is not None:
        over = np.asarray(frequencies.values, float)
        found = factors(base, ground, over)
        curves = {"TRANSLATION": found.translation, "ROTATION": found.rotation}
        if base.shape != "strip":
            curves["TORSION"] = found.torsion
        for name, values in curves.items():
            result.set(name, _curve("FREQ", over, name[:4], values))
    if record is not None:
        _filter(entries, base, ground, cast(Curve, record).parts[0], result)
    return result


def _base(entries: Entries) -> RigidBase:
    shape = entries.needed("FORME")
    sizes = []
    for name in _SIZES[shape]:
        size = entries.get(name)
        if size is None:
            raise entries.error("operators.dynamics.size-of-base", shape=shape, name=name)
        sizes.append(float(size))
    return RigidBase(_SHAPES[shape], *sizes)


def _ground(entries: Entries) -> Ground:
    young, poisson, density = (
        float(entries.needed(n)) for n in ("YOUNG", "POISSON", "MASSE_VOLUMIQUE")
    )
    shear = float(np.sqrt(young / (2 * (1 + poisson)) / density))
    gamma, apparent = float(entries.get("INCOHERENCE")), entries.get("VITESSE_APPARENTE")
    if gamma > _MEASURED:
        entries.warn("operators.dynamics.incoherence-large", gamma=gamma, most=_MEASURED)
    if apparent is not None and apparent < _IMPOSSIBLE * shear:
        raise entries.error("operators.dynamics.passage-impossible", speed=apparent, shear=shear)
    if apparent is not None and apparent < _SLOWEST * shear:
        entries.warn("operators.dynamics.passage-slow", speed=float(apparent), shear=shear)
    if gamma == 0.0 and apparent is None:
        entries.warn("operators.dynamics.motion-everywhere-the-same")
    return Ground(shear, gamma, None if apparent is None else float(apparent))


def _filter(
    entries: Entries, base: RigidBase, ground: Ground, record: CurvePart, result: Table
) -> None:
    """The record of the base, and of its turning: rocking, or torsion of motion across the way."""
    steps = np.diff(record.abscissas)
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        raise entries.error("operators.dynamics.equal-steps-wanted")
    times, step = record.abscissas, float(steps.mean())
    share = 1.0 if entries.get("COMPOSANTE") == "VERT" else base.torsion_share
    frequencies = frequencies_of(record.ordinates, step)
    found, (side, slope) = factors(base, ground, frequencies), signs(base, ground, frequencies)
    moved = averaged(record.ordinates, side * found.translation)
    early = steps_before(record.ordinates, side * found.translation)
    if early:
        entries.warn("operators.dynamics.base-moves-before-record", seconds=early * step)
    result.set("ACCELERATION", _curve("TEMP", times, "ACCE", moved))
    # a quarter of a period behind, as the slope of a wave that passes
    turned = averaged(record.ordinates, np.asarray(-1j * share * slope * found.rotation, complex))
    result.set("ACCELERATION_ANGULAIRE", _curve("TEMP", times, "ACCE", turned))


def _curve(along: str, x: FloatArray, name: str, y: FloatArray) -> Curve:
    return Curve((CurvePart(x, y, along, name),), "")
