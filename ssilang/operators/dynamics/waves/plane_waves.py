"""ZOPL ZPML: plane waves and matched layers, behind the procedures @ONDE and @PML."""

from ssilang.kernel.waves.layered_half_space import (
    Given,
    HalfSpace,
    Kind,
    PlaneWave,
    WaveMotion,
    plane_motion,
)
from ssilang.kernel.waves.matched_layer import matched_layer
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

#: share of the largest velocity that a record may keep at its end
DRIFT = 0.02


@operator("ZOPL", family="dynamics")
def zopl(call: Call, table: Table = Arg("TABLE", en="table of @ONDE")) -> Table:
    """Read the table, compute, hand back instants."""
    entries = Entries(call, table, "@ONDE")
    dimension = workspace(call.session).dimension
    points, wave = entries.needed("POINTS"), cast("Kind", entries.needed("ONDE"))
    if dimension < 2 or (dimension == 2 and wave == "SH"):
        raise entries.error("operators.dynamics.wave-out-of-plane", wave=wave, dimension=dimension)
    xyz = points.nodes.coordinates[points.sorted_node_ids]
    top = entries.get("SURFACE")
    top = float(xyz[:, dimension - 1].max()) if top is None else float(top)
    record = entries.needed("POINT").coordinates
    turned = np.radians(float(entries.get("AZIMUT") or 0.0)) if dimension == 3 else 0.0
    way = np.array([np.cos(turned), np.sin(turned)]) if dimension == 3 else np.array([1.0])
    along = (xyz - record)[:, : len(way)] @ way
    given = _wave(entries, wave, top - float(record[dimension - 1]))
    motion = plane_motion(
        _ground(entries), given, along, top - xyz[:, dimension - 1], entries.get("PAS")
    )
    if motion.early > 0:
        entries.warn("operators.dynamics.wave-already-there", seconds=motion.early)
    return _instants(points, motion, wave, way)


def _wave(entries: Entries, kind: Kind, depth: float) -> PlaneWave:
    curve = cast("Curve", entries.needed("ACCELERATION")).parts[0]
    steps = np.diff(curve.abscissas)
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        raise entries.error("operators.dynamics.equal-steps-wanted")
    step, a = float(steps.mean()), curve.ordinates
    velocity = np.cumsum(a[1:] + a[:-1]) * step / 2
    largest = float(np.abs(velocity).max())
    if abs(velocity[-1]) > DRIFT * largest:
        entries.warn(
            "operators.dynamics.record-drifts", velocity=float(velocity[-1]), largest=largest
        )
    angle = np.radians(float(entries.needed("ANGLE")))
    given = cast(Given, entries.get("NATURE"))
    return PlaneWave(kind, float(angle), given, float(curve.abscissas[0]), step, a, depth)


def _ground(entries: Entries) -> HalfSpace:
    entries.needed("COUCHES")
    layers = entries.inside("COUCHES")
    assert layers is not None
    layers.needed(1)
    rows: list[tuple[float, ...]] = []
    thickness: list[float | None] = []
    while (layer := layers.inside(len(rows) + 1)) is not None:
        young, poisson, density = (
            float(layer.needed(n)) for n in ("YOUNG", "POISSON", "MASSE_VOLUMIQUE")
        )
        shear = young / (2 * (1 + poisson))
        primary = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
        damping = float(layer.get("AMORTISSEMENT") or 0.0)
        rows.append((density, np.sqrt(shear / density), np.sqrt(primary / density), damping))
        thickness.append(layer.get("EPAISSEUR"))
    if any(h is None for h in thickness[:-1]):
        raise entries.error(
            "operators.dynamics.thickness-of-layer", number=thickness.index(None) + 1
        )
    density, shear, primary, damping = np.array(rows, float).T
    f1, f2 = (float(entries.get(n)) for n in ("F1", "F2"))
    return HalfSpace(np.array(thickness[:-1], float), density, shear, primary, damping, f1, f2)


def _instants(points: Mesh, motion: WaveMotion, kind: Kind, way: FloatArray) -> Table:
    """Instants 1, 2 ... with TEMP, DEPL, VITE, ACCE."""
    ids = points.sorted_node_ids
    histories = {"DEPL": motion.displacement, "VITE": motion.velocity, "ACCE": motion.acceleration}
    named = {name: _components(of, kind, way) for name, of in histories.items()}
    instants = []
    for i, time in enumerate(motion.times):
        instants.append(Table.of({"TEMP": float(time)}))
        for name, components in named.items():
            values = {unknown: of[:, i] for unknown, of in components.items()}
            instants[i].set(Mot(name), NodeField.of(points.nodes, ids, values, "DIFFUS"))
    return Table.numbered(instants)


def _components(of: FloatArray, kind: Kind, way: FloatArray) -> dict[str, FloatArray]:
    """From the wave's plane to axes: histories (points, times) by name."""
    still = np.zeros_like(of[:, 0])
    along, up = (still, still) if kind == "SH" else (of[:, 0], of[:, 1])
    if len(way) == 1:
        return {"UX": along, "UY": up}
    across = of[:, 0] if kind == "SH" else still
    cos, sin = way
    return {"UX": cos * along - sin * across, "UY": sin * along + cos * across, "UZ": up}


FEWEST = 4
"""Cells through the layer below which it reflects about as much as dampers."""


@operator("ZPML", family="dynamics")
def zpml(call: Call, table: Table = Arg("TABLE", en="table of @PML")) -> Table:
    """Read the table, hand back three matrices."""
    entries = Entries(call, table, "@PML")
    made = matched_layer(
        entries.needed("MODELE"), entries.needed("CARACTERISTIQUES"),
        entries.needed("INTERIEUR"), entries.get("REFLEXION"),
    )  # fmt: skip
    if made.cells < FEWEST - 1e-6:
        entries.warn("operators.dynamics.thin-layer", cells=made.cells, fewest=FEWEST)
    return Table.of({"RIGI": made.stiffness, "MASS": made.mass, "AMOR": made.damping})
