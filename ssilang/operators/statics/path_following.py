"""PASAPAS along a path: indirect control (PILOTAGE_INDIRECT) and automatic one (AUTOMATIQUE)."""

from __future__ import annotations

import time

from ssilang.kernel.elements.families import family_of, strain
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.matrices.assembly import Numbering, field_to_vector, vector_to_field
from ssilang.operators.prelude import *
from ssilang.operators.session.user_procedures import call_user
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.driven_load import Trace
    from ssilang.kernel.plasticity.following import Control, PathRun, Split
    from ssilang.kernel.plasticity.run import BulkRun
    from ssilang.kernel.stepping.run import History


FLAT = 1e-12
"""Slope over the greatest one that no longer moves a control."""
SEARCHES = 30


# --- strains at points -----------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class StrainPoints:
    """Points where strains are looked at: zones, cells kept, shears counted half."""

    zones: tuple[tuple[Zone, NDArray[np.bool_]], ...]
    material: CellField | None
    numbering: Numbering

    def at(self, u: FloatArray) -> list[FloatArray]:
        """Strains (n_points, n_components) of each zone, as components of tensors."""
        displacement = vector_to_field(u, self.numbering)
        return [self._zone(zone, kept, displacement) for zone, kept in self.zones]

    def _zone(self, zone: Zone, kept: NDArray[np.bool_], displacement: Any) -> FloatArray:
        block = strain(zone, displacement, self.material)
        names = [n for n in block.components if n.startswith(("EP", "GA"))]
        count = max(block.components[n].shape[1] for n in names)
        weights = [np.sqrt(0.5) if n.startswith("GA") else 1.0 for n in names]
        values = [
            w * np.broadcast_to(block.components[n], (len(kept), count))[kept].ravel()
            for n, w in zip(names, weights, strict=True)
        ]
        return np.stack(values, axis=1)


def strain_points(entries: Entries, numbering: Numbering) -> StrainPoints:
    """Points of MODELE that have strains, those of ZONE_DE_PILOTAGE if it is given."""
    model: Model = entries.needed("MODELE")
    material: CellField | None = entries.get("CARACTERISTIQUES")
    region: Mesh | None = entries.get("ZONE_DE_PILOTAGE")
    zones = []
    for zone in model.zones:
        if zone.formulation != "MECANIQUE" or is_joint(zone):
            continue
        if not any(n.startswith("EP") for n in family_of(zone).strain_names(zone)):
            continue
        kept: NDArray[np.bool_] = np.ones(len(zone.cells.connectivity), bool)
        if region is not None:
            nodes = region.node_ids
            inside: NDArray[np.bool_] = np.isin(zone.cells.connectivity, nodes)
            kept = inside.min(axis=1)
        if kept.any():
            zones.append((zone, kept))
    if not zones:
        raise entries.error("operators.statics.no-strain-to-control")
    return StrainPoints(tuple(zones), material, numbering)


def strain_parameters(
    points: StrainPoints, start: FloatArray, known: FloatArray, unit: FloatArray, asked: float
) -> list[float]:
    """Parameters x for which the greatest increment of strain of `known + x unit` is `asked`.

    The increment at a point is seen along the strain at the start of the step (along that of
    `unit` where there is none). Of a growing and a falling branch both ends are given.
    """
    a, b = [], []
    sets = zip(points.at(start), points.at(known), points.at(unit), strict=True)
    for before, fixed, moving in sets:
        size = np.linalg.norm(before, axis=1)
        there = size > 1e-12 * max(size.max(initial=0.0), 1e-300)
        along = np.where(there[:, None], before, moving)
        along = along / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
        a.append((along * fixed).sum(axis=1))
        b.append((along * moving).sum(axis=1))
    return ends_of(np.concatenate(a), np.concatenate(b), asked)


def ends_of(a: FloatArray, b: FloatArray, asked: float) -> list[float]:
    """Both x where `max(a + x b)` is `asked`; the x of its least value where it is never."""
    flat = FLAT * np.abs(b).max(initial=0.0)
    upper = ((asked - a[b > flat]) / b[b > flat]).min(initial=np.inf)
    lower = ((asked - a[b < -flat]) / b[b < -flat]).max(initial=-np.inf)
    if lower > upper:
        for _ in range(SEARCHES):  # of where the greatest falls and where it grows
            x = 0.5 * (lower + upper)
            lower, upper = (x, upper) if b[np.argmax(a + x * b)] > 0.0 else (lower, x)
        return [0.5 * float(lower + upper)]
    return [float(x) for x in (upper, lower) if np.isfinite(x)]


# --- PILOINDI --------------------------------------------------------------------------------


def indirect_control(entries: Entries, numbering: Numbering) -> Callable[[float], Control]:
    """The control of a step from what it must reach: the script's PILOINDI, or strains."""
    if isinstance(entries.call.session.frame.find("PILOINDI"), Procedure):
        return lambda asked: _by_procedure(entries, numbering, asked)
    points = strain_points(entries, numbering)

    def control_of(asked: float) -> Control:
        def control(split: Split, share: float) -> list[float]:
            known = split.du + split.rest
            return strain_parameters(points, split.start, known, split.unit, share * asked)

        return control

    return control_of


def _by_procedure(entries: Entries, numbering: Numbering, asked: float) -> Control:
    def control(split: Split, share: float) -> list[float]:
        parts = (split.start, split.du, split.rest, split.unit)
        fields = [vector_to_field(p, numbering) for p in parts]
        found = call_user(entries.call, "PILOINDI", entries.table, *fields, share * asked)
        return [_number(entries, "PILOINDI", found)]

    return control


def _number(entries: Entries, name: str, found: list[Any]) -> float:
    if len(found) != 1 or isinstance(found[0], bool) or not isinstance(found[0], int | float):
        raise entries.error("operators.statics.procedure-gives-a-real", name=name)
    return float(found[0])


# --- AUTOPILO --------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class AutomaticControl:
    """AUTOPILO's norm of the step equals AUTOCRIT.

    Attributes
    ----------
    elastic : callable
        Displacement of the elastic structure for one unit of the load parameter, in the interval
        of time under way.
    """

    entries: Entries
    numbering: Numbering
    asked: float
    elastic: Callable[[], FloatArray]
    model: Model
    material: CellField = field(default_factory=lambda: CellField((), "CARACTERISTIQUES"))

    def __call__(self, split: Split, share: float) -> list[float]:
        asked, known = share * self.asked, split.du + split.rest
        unit_elastic = self.elastic()

        def norm(x: float, of: FloatArray = known) -> float:
            return self._norm(of + x * split.unit, (split.x + x) * unit_elastic)

        try:
            nothing = np.zeros_like(known)
            ahead, back = norm(1.0, nothing), norm(-1.0, nothing)
        except SsiError:
            # a norm that the load's own part of the step does not have (0/0): with the other part
            if not known.any():
                raise
            ahead, back = norm(1.0), norm(-1.0)
        if ahead == 0.0 or not np.isfinite(ahead):
            raise self.entries.error("operators.statics.no-norm-of-step")
        if ahead * back < 0.0:
            return [_root(norm, asked, asked / ahead)]
        if not known.any():
            return [asked / abs(ahead), -asked / abs(back)]
        far = 2.0 * (asked + abs(norm(0.0))) / min(abs(ahead), abs(back))
        return [_root(norm, asked, far), _root(norm, asked, -far)]

    def _norm(self, total: FloatArray, elastic: FloatArray) -> float:
        values = [vector_to_field(v, self.numbering) for v in (total, elastic)]
        table = self.entries.table
        found = call_user(self.entries.call, "AUTOPILO", *values, self.model, self.material, table)
        return _number(self.entries, "AUTOPILO", found)


def _root(norm: Callable[[float], float], asked: float, start: float) -> float:
    """The x where the norm is as asked, by Newton's method with small differences."""
    x = start
    scale = max(abs(start), 1e-300)
    for _ in range(SEARCHES):
        value = norm(x)
        if abs(value - asked) <= 1e-11 * abs(asked):
            break
        h = 1e-6 * max(abs(x), 1e-3 * scale)
        slope = (norm(x + h) - value) / h
        if slope == 0.0:
            return float("nan")
        x -= (value - asked) / slope
    return x


DRIVEN = ("DEPLACEMENTS_PILOTES", "FORCES_PILOTEES")


def control_asked(entries: Entries) -> str:
    """'PILOTAGE_INDIRECT', 'AUTOMATIQUE', or nothing."""
    asked = [w for w in ("PILOTAGE_INDIRECT", "AUTOMATIQUE") if entries.flag(w)]
    if len(asked) > 1:
        raise entries.error("operators.statics.two-controls")
    if asked and entries.flag("DYNAMIQUE"):
        raise entries.error("operators.statics.only-in-statics", asked=asked[0])
    return asked[0] if asked else ""


def driven_parts(entries: Entries) -> list[LoadPart]:
    """The loads of unknown size, behind all others."""
    if control_asked(entries) != "PILOTAGE_INDIRECT":
        return []
    found = [(w, entries.get(w)) for w in DRIVEN]
    parts = [
        LoadPart("DIMP" if word == DRIVEN[0] else "MECA", field)
        for word, field in found
        if field is not None
    ]
    if not parts:
        raise entries.error("operators.statics.which-load-is-controlled")
    return parts


def follow(entries: Entries, run: BulkRun) -> History:
    """Step along the path; fills COEFFICIENT_DE_PILOTAGE where the control is indirect."""
    from ssilang.kernel.plasticity.driven_load import history_of

    started = time.perf_counter()
    try:
        if control_asked(entries) == "AUTOMATIQUE":
            path, trace = _automatic(entries, run)
        else:
            path, trace = _indirect(entries, run)
            entries.table.set(Mot("COEFFICIENT_DE_PILOTAGE"), ListReel(np.array(trace.parameters)))
    finally:
        for observer in run.observers:
            observer.close()
    return history_of(path, trace, time.perf_counter() - started)


def _indirect(entries: Entries, run: BulkRun) -> tuple[PathRun, Trace]:
    from ssilang.kernel.plasticity.driven_load import follow_directions

    curve = entries.needed("PARAMETRE_DE_PILOTAGE")
    asked = np.diff([curve.at(float(t)) for t in run.problem.times])
    if not asked.all():
        k = int(np.flatnonzero(asked == 0.0)[0])
        raise entries.error("operators.statics.control-does-not-change", k=k + 1)
    control_of = indirect_control(entries, run.problem.numbering)
    return follow_directions(run, len(driven_parts(entries)), asked, control_of)


def _automatic(entries: Entries, run: BulkRun) -> tuple[PathRun, Trace]:
    from ssilang.kernel.plasticity.driven_load import follow_time

    asked = entries.get("AUTOCRIT")
    most = entries.get("AUTOPAS")
    every = entries.get("AUTORESU")
    model = entries.needed("MODELE")
    material = entries.get("CARACTERISTIQUES") or CellField((), "CARACTERISTIQUES")

    def control_of(path: PathRun) -> Control:
        numbering = run.problem.numbering
        return AutomaticControl(entries, numbering, asked, path.elastic, model, material)

    path, trace = follow_time(run, control_of, most, every)
    if trace.unfinished:
        entries.warn("operators.statics.path-ends-early", most=most, times=trace.times[-1])
    return path, trace


@operator("ZPIL", family="statics")
def zpil(
    call: Call,
    table: Table = Arg("TABLE", en="table of PILOINDI"),
    start: NodeField = Arg("CHPOINT", en="displacement", unit="m"),
    du: NodeField = Arg("CHPOINT", en="step so far", unit="m"),
    rest: NodeField = Arg("CHPOINT", en="step by the residual", unit="m"),
    unit: NodeField = Arg("CHPOINT", en="step by the load", unit="m"),
    asked: float = Arg("FLOTTANT", en="strain asked for", range=ANY_NUMBER),
) -> float:
    """Of the parameters that fulfil the equation, the one nearest zero."""
    entries = Entries(call, table, "PILOINDI")
    numbering = _numbering_of((start, du, rest, unit))
    u0, u1, u2, u3 = (field_to_vector(f, numbering, dual=False) for f in (start, du, rest, unit))
    points = strain_points(entries, numbering)
    found = strain_parameters(points, u0, u1 + u2, u3, asked)
    if not found:
        raise entries.error("operators.statics.controlled-load-strains-nothing")
    return min(found, key=abs)


def _numbering_of(fields: Sequence[NodeField]) -> Numbering:
    """All unknowns of fields of displacement."""
    names = tuple(dict.fromkeys(n for f in fields for n in f.components))
    nodes, codes = [], []
    for code, name in enumerate(names):
        own = [f.components[name].nodes for f in fields if name in f.components]
        there = np.unique(np.concatenate(own))
        nodes.append(there)
        codes.append(np.full(len(there), code, dtype=np.int64))
    if not names:
        raise FieldError("operators.statics.empty-fields")
    table = fields[0].table
    numbers, places = np.concatenate(nodes), np.concatenate(codes)
    order = np.lexsort((places, numbers))
    return Numbering(table, names, names, numbers[order], places[order], table.version)
