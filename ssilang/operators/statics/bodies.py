"""Plastic bodies of the tables of PASAPAS and DYNAMIC."""

from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.results.frames import FOLLOWING
from ssilang.kernel.elements.solids.finite_motion import motion_of
from ssilang.kernel.elements.solids.kinematics import harmonic
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.plasticity.points import is_plastic, plastic_zones
from ssilang.kernel.statics.doubled import face_keys
from ssilang.kernel.stepping.problem.problem import Inputs, Problem
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.plasticity.bulk import Bulk, State

_STATE = ("CONTRAINTES", "VARIABLES_INTERNES", "DEFORMATIONS_INELASTIQUES")
"""Results that a calculation goes on from."""

Bodies = Callable[["Problem", "Inputs"], tuple["Bulk", "State"]]


def plastic_bodies(entries: Entries, start: Any = None) -> Bodies | None:
    """What makes the plastic bodies of MODELE once the problem is numbered; None without any.

    Parameters
    ----------
    start : Start, optional
        Where the calculation goes on from, with stresses and internal variables.
    """
    model: Model | None = entries.get("MODELE")
    zones = plastic_zones(model)
    if not zones:
        return None
    given_material: CellField = entries.needed("CARACTERISTIQUES")
    material = _in_parts(entries, zones, given_material)
    if start is None or start.reached is None:
        _warn_of_two_models(entries, zones)

    def make(problem: "Problem", inputs: "Inputs") -> "tuple[Bulk, State]":
        from ssilang.kernel.plasticity.bulk import bulk_of
        from ssilang.kernel.plasticity.expansion import free_strains

        bulk = bulk_of(zones, material, problem.numbering)
        load = entries.get("CHARGEMENT") or entries.get("CHAR")
        bulk = replace(bulk, free=free_strains(load, zones, material))
        first = float(problem.times[0])
        given = None if start is None else _given(bulk, start)
        if given is not None:
            before = getattr(start, "before", None) or entries
            old, strained = before.get("CARACTERISTIQUES"), bulk
            if old is not given_material:
                strained = bulk_of(zones, old, problem.numbering)
                free = free_strains(before.get("CHARGEMENT"), zones, old)
                strained = replace(strained, free=free)
            return bulk, tuple(replace(s, time=first) for s in bulk.entered(strained, given, first))
        blank = tuple(replace(s, time=first) for s in bulk.unloaded())
        if inputs.displacement is None:
            return bulk, blank
        # a displacement without stresses: those of a step from nothing to it
        return bulk, replace(bulk, free={}).respond(blank, problem.u, first).state

    return make


def _in_parts(entries: Entries, zones: Sequence[Zone], material: CellField) -> CellField:
    """Characteristics, with what SUBSTEPPING says of laws that are integrated in parts."""
    if not entries.get("SUBSTEPPING"):
        return material
    said = {"NSUB": entries.get("NMAXSUBSTEPS"), "NITE": entries.get("NITERINTER_MAX")}

    def block(zone: Zone) -> CellFieldBlock:
        values = {name: np.full((len(zone.cells), 1), float(value)) for name, value in said.items()}
        return zone.block(values, "GRAVITE")

    blocks = tuple(block(zone) for zone in zones if "RH_COULOMB" in zone.behaviour)
    return CellField((*material.blocks, *blocks), material.title)


def _warn_of_two_models(entries: Entries, zones: tuple[Zone, ...]) -> None:
    """Warn of cells that several models have: each bears its part, as if both were there."""
    solid = [z.cells for z in zones if z.cells.kind.dimension > 1 and not z.constituent]
    cells = [c.nodes.resolve(c.raw) for c in solid]
    keys = np.concatenate([np.zeros(0, int), *map(face_keys, cells)])
    _, first, times = np.unique(keys, return_index=True, return_counts=True)
    if len(again := first[times > 1]):
        node = solid[0].nodes.told(np.concatenate([c[:, 0] for c in cells])[again[0]])
        entries.warn("operators.statics.cells-in-two-models", count=len(again), node=node)


def finite_bodies(entries: Entries, zones: tuple[Zone, ...], start: Any) -> Bodies:
    """What makes the bodies in finite displacements once the problem is numbered."""
    if any(z.options.get("FRAME") == FOLLOWING for z in entries.needed("MODELE").zones):
        entries.warn("operators.statics.joint-axes-stay")
    material: CellField = entries.needed("CARACTERISTIQUES")

    def make(problem: "Problem", inputs: "Inputs") -> "tuple[Bulk, State]":
        from ssilang.kernel.plasticity.large.finite_flow import LAGRANGIAN
        from ssilang.kernel.plasticity.large.finite_yielding import finite_bulk

        yielding = tuple(z for z in zones if is_plastic(z))
        elastic = tuple(z for z in zones if z not in yielding)
        stress, variables, plastic = (start.of(word) for word in _STATE)
        return finite_bulk(
            elastic, yielding, material, problem.numbering, problem.u,
            (stress, variables, plastic), float(problem.times[0]),
            LAGRANGIAN[str(entries.get("LAGRANGIEN"))],
        )  # fmt: skip

    return make


def finite_zones(entries: Entries) -> tuple[Zone, ...]:
    """Zones of MODELE in finite displacements: all bodies, where GRANDS_DEPLACEMENTS says so."""
    model: Model | None = entries.get("MODELE")
    if model is None or not entries.flag("GRANDS_DEPLACEMENTS"):
        return ()
    return tuple(z for z in model.zones if z.formulation == "MECANIQUE" and not is_joint(z))


def warn_of_confinement(entries: Entries, problem: Problem, bulk: "Bulk", state: "State") -> None:
    """Warn of ground of friction that has no stress, and gets none before the loads."""
    from ssilang.kernel.plasticity.bulk import Bulk
    from ssilang.kernel.statics.yielding import unconfined

    if type(bulk) is Bulk and (found := unconfined(problem, bulk, state)) is not None:
        law, share, strength = found
        told = {"law": law, "share": 100.0 * share, "strength": strength}
        entries.warn("operators.statics.no-confinement", **told)


def warn_of_strains(entries: Entries, displacement: NodeField | None) -> None:
    """Tell, once, of solids that strain beyond what their law holds for, by the table below."""
    finite = finite_zones(entries)
    zones = [z for z in finite or plastic_zones(entries.get("MODELE")) if is_solid(z)]
    for large, plastic, code, most in _HELD:
        asked = [z for z in zones if is_plastic(z) is plastic and not harmonic(z)]
        told = any(
            w.code == code and w.span == entries.place for w in entries.call.session.warnings
        )
        present = large and plastic and entries.get("LAGRANGIEN") != "TOTAL"
        if displacement is None or told or present or large is not bool(finite):
            continue
        moved = [motion_of(z, displacement, "STRESSES") for z in asked]
        if large:
            strains = [0.5 * abs(F.swapaxes(2, 3) @ F - np.eye(3)).max() for F in moved]
        else:
            strains = [abs(0.5 * (F.swapaxes(2, 3) + F) - np.eye(3)).max() for F in moved]
        strain = max(strains, default=0.0)
        if strain > most:
            entries.warn(code, strain=float(strain), error=2.0 * float(strain))


_HELD = (
    (True, True, "operators.statics.small-strains-left", 0.05),
    (True, False, "operators.statics.elastic-strains-large", 0.1),
    (False, True, "operators.statics.displacements-not-small", 0.1),
)
"""Of large displacements or not, of plastic or elastic solids: codes, strains from which told."""


def _given(bulk: "Bulk", start: Any) -> "State | None":
    from ssilang.kernel.plasticity.bulk import state_from_fields

    given: Any = tuple(start.of(word) for word in _STATE)
    return state_from_fields(bulk, given)
