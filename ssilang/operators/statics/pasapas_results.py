"""The tables that PASAPAS fills."""

from ssilang.kernel.elements.families import family_of, strain, stress
from ssilang.kernel.elements.results.integrals import green_strain, has_second_order
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.statics.thermal_load import ThermalStress, free_terms
from ssilang.kernel.stepping.snapshot import Receiver, Snapshot
from ssilang.operators.prelude import *
from ssilang.operators.statics.loads_in_time import named_at

RESULTS = (
    "TEMPS", "DEPLACEMENTS", "CONTRAINTES", "VARIABLES_INTERNES", "REACTIONS", "VITESSES",
    "ACCELERATIONS", "DEFORMATIONS_INELASTIQUES",
)  # fmt: skip
"""Tables of results, by number of the saved time."""


def put_results(table: Table, number: int, values: Mapping[str, Any], keep: bool) -> None:
    """Put results of a number into their tables; with `keep` what stands there already stays."""
    for word, value in values.items():
        inner = table.inner(word)
        if not (keep and inner.has(number)):
            inner.set(number, value)


@dataclass
class Stresses:
    """Stresses of the zones whose stiffness says all.

    Attributes
    ----------
    thermal : list of ThermalStress
        Taken off.
    offsets : list of CellFieldBlock
        Initial stresses that no displacement causes, by zone (empty: none).
    """

    zones: list[tuple[Zone, CellField]]
    thermal: list[ThermalStress]
    offsets: dict[int, CellFieldBlock] = field(default_factory=dict)

    def at(self, displacement: NodeField, time: float) -> list[CellFieldBlock]:
        """Stresses of all zones that have any at a displacement and a time."""
        strained = ((z, m) for z, m in self.zones if family_of(z).stress_names(z))
        return [self._zone(z, m, displacement, time) for z, m in strained]

    def _zone(
        self, zone: Zone, material: CellField, displacement: NodeField, time: float
    ) -> CellFieldBlock:
        found = stress(zone, material, displacement)
        for part in self.thermal:
            if part.zone is zone:
                found = part.taken_off(found, time)
        offset = self.offsets.get(id(zone))
        if offset is None:
            return found
        total = {k: v + offset.components[k] for k, v in found.components.items()}
        return replace(found, components=total)


@dataclass
class ResultTables(Receiver):
    """Fills TEMPS, DEPLACEMENTS, CONTRAINTES ... of the table at each saved time.

    `number` is that of the initial state; what the table already holds there is kept. Fields in
    cells come in the order of `zones`, the model's, which a script's EXTR counts. DEFORMATIONS
    is filled with strains, less those that `load` gives (T, DEFI), where `material` is given:
    the linear ones or, with `finite`, those of Green-Lagrange, which beams and shells have none of.
    TEMPERATURES is filled with the temperatures of `load` where it has some.
    """

    table: Table
    wanted: NDArray[np.bool_]
    stresses: Stresses
    dynamic: bool
    number: int = 0
    zones: tuple[Zone, ...] = ()
    material: CellField | None = None
    load: Load | None = None
    finite: bool = False
    _free: dict[int, list[tuple[FloatArray, Any]]] = field(default_factory=dict, repr=False)
    _last: tuple[Snapshot, dict[str, Any]] | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        skipped = () if self.dynamic else ("VITESSES", "ACCELERATIONS")
        strains = () if self.material is None else ("DEFORMATIONS",)
        for word in (*(w for w in RESULTS if w not in skipped), *strains):
            self.table.inner(word)

    def receive(self, snapshot: Snapshot) -> None:
        """Add one time."""
        put_results(self.table, self.number, self.values(snapshot), keep=snapshot.step == 0)
        self.number += 1

    def values(self, snapshot: Snapshot) -> dict[str, Any]:
        """Results of one time, by their words."""
        if self._last is not None and self._last[0] is snapshot:
            return self._last[1]
        u = snapshot.displacement
        blocks = (*self.stresses.at(u, snapshot.time), *snapshot.tractions.blocks)
        values = {
            "TEMPS": snapshot.time,
            "DEPLACEMENTS": u,
            "REACTIONS": snapshot.reactions,
            "CONTRAINTES": self._in_order(CellField(blocks, "CONTRAINTES")),
            "VARIABLES_INTERNES": self._in_order(snapshot.variables),
            "DEFORMATIONS_INELASTIQUES": self._in_order(snapshot.plastic_strains),
        }
        if self.material is not None:
            bodies = (z for z in self.zones if not is_joint(z) and z.formulation == "MECANIQUE")
            seen = (z for z in bodies if has_second_order(z) or not self.finite)
            strained = (z for z in seen if family_of(z).strain_names(z))
            strains = [self._strain(z, self.material, u, snapshot.time) for z in strained]
            strains += snapshot.jumps.blocks
            values["DEFORMATIONS"] = self._in_order(CellField(tuple(strains), "DEFORMATIONS"))
        if self.dynamic:
            values |= {"VITESSES": snapshot.velocity, "ACCELERATIONS": snapshot.acceleration}
        warm = named_at(self.load, "T", snapshot.time)
        if warm is not None:
            values["TEMPERATURES"] = warm
        self._last = (snapshot, values)
        return values

    def _strain(
        self, zone: Zone, material: CellField, displacement: NodeField, time: float
    ) -> CellFieldBlock:
        found = (green_strain if self.finite else strain)(zone, displacement, material)
        parts = dict(found.components)
        if id(zone) not in self._free:  # the same at all instants
            self._free[id(zone)] = free_terms(self.load, zone, material)
        for free, curve in self._free[id(zone)]:
            factor = float(np.interp(time, *curve))
            for k, name in enumerate(family_of(zone).strain_names(zone)):
                parts[name] = parts[name] - factor * free[:, k]
        return replace(found, components=parts)

    def _in_order(self, found: CellField) -> CellField:
        """A field whose blocks come in the order of the zones that they lie on."""
        places = {(id(z.cells), z.constituent): i for i, z in enumerate(self.zones)}
        where = [places.get((id(b.cells), b.constituent), -1) for b in found.blocks]
        if -1 in where or where == sorted(where):
            return found
        order = sorted(range(len(where)), key=where.__getitem__)
        return CellField(tuple(found.blocks[i] for i in order), found.title)
