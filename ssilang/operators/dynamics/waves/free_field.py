"""ZCOL: the soil column behind the procedures DECONV and DECONV3D."""

from ssilang.kernel.records.soil_column import FreeField, SoilColumn, free_field
from ssilang.kernel.waves.resolution import highest_frequency
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_CODE = "operators.dynamics.waves-before-the-record"
_BEGUN = 0.05
"""Share of the largest velocity that is in the ground before a motion begins, unheard."""
_COARSE = "operators.dynamics.layer-too-coarse"
_NODES = 8
"""Heights between nodes that carry a wavelength."""
_LAYERS = ("EPAISSEUR", "MASSE_VOLUMIQUE", "MODULE", "AMORTISSEMENT")


@operator("ZCOL", family="dynamics")
def zcol(call: Call, table: Table = Arg("TABLE", en="layers, motion and depths")) -> Table:
    """Read the table, compute, hand back curves."""
    entries = Entries(call, table, "ZCOL")
    thickness, density, modulus, damping = (entries.needed(name).values for name in _LAYERS)
    f1, f2, cutoff = (entries.needed(name) for name in ("F1", "F2", "FC"))
    depths = entries.needed("PROFONDEURS").values
    signal = entries.needed("GAMMAO").parts[0]
    control = entries.get("CONTROLE") or 0.0
    steps = np.diff(signal.abscissas)
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        raise entries.error("operators.dynamics.equal-steps-wanted")
    soil = SoilColumn(thickness, density, modulus, damping, f1, f2)
    at = None if control < 0 else control
    field = free_field(soil, float(steps.mean()), signal.ordinates, depths, cutoff, at)
    if field.begun > _BEGUN and all(w.code != _CODE for w in call.session.warnings):
        entries.warn(_CODE, share=100 * field.begun, rest=1.5 * soil.crossing)
    _tell_coarse(entries, soil, signal, cutoff)
    return _results(field, float(signal.abscissas[0]))


def _tell_coarse(entries: Entries, soil: SoilColumn, signal: CurvePart, cutoff: float) -> None:
    """Warn, once for a script, of the layer whose nodes are farthest apart for its waves."""
    heights = entries.get("ECARTS")
    frequency = min(cutoff, highest_frequency(signal.abscissas, signal.ordinates))
    if heights is None or frequency <= 0.0:
        return
    speed = np.sqrt(soil.modulus / soil.density)
    wanted = speed / (_NODES * frequency)
    i = int(np.argmax(heights.values / wanted))
    if heights.values[i] > (1 + 1e-9) * wanted[i] and not entries.call.session.warned(_COARSE):
        told = {"top": soil.tops[i], "bottom": soil.tops[i + 1], "height": heights.values[i]}
        told |= {"wanted": wanted[i], "frequency": frequency, "speed": speed[i]}
        entries.warn(_COARSE, nodes=_NODES, **told)


def _results(field: FreeField, start: float) -> Table:
    times = field.times + start
    found: dict[str, Any] = {"PAS": float(times[1] - times[0])}
    histories = {"ACCE": field.acceleration, "VITE": field.velocity, "CONT": field.stress}
    for name, rows in histories.items():
        found[name] = Table.numbered(Curve((CurvePart(times, r, "TEMP", name),), "") for r in rows)
    return Table.of(found | {"DEFO": ListReel(field.strain)})
