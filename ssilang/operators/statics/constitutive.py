"""COMP ECOU PLAS KTAN HOTA CRIT MOTA: constitutive laws at integration points."""

from ssilang.kernel.elements.families import components_of, family_of, stiffness
from ssilang.kernel.elements.family import cell_block, contract, per_cell
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.solids.solid_moduli import hooke_block
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.statics.constitutive import (
    Answer,
    elastic_moduli,
    has_law,
    probing_step,
    respond,
)
from ssilang.kernel.statics.yielding import criterion, tangent_modulus
from ssilang.operators.dispatch import COMP
from ssilang.operators.matrices.element import joined, present
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import MODEL, on_zones
from ssilang.operators.tables.entries import Entries


def _stresses_of(zone: Zone, field: CellField) -> FloatArray:
    """Stresses (n_cells, n_stresses, n_points) at 'STRESSES'; a field without any is refused."""
    return components_of(zone, field, family_of(zone).stress_names(zone))


_STRESSES, _HELD, _LEFT = "CONTRAINTES", "VARIABLES INTERNES", "DEFORMATIONS INELASTIQUES"


def _named(zone: Zone, answer: Answer, wanted: str) -> CellFieldBlock:
    """Stresses, variables or inelastic strains of an answer as a block."""
    if wanted == _STRESSES:
        return cell_block(zone, family_of(zone).stress_names(zone), answer.stress)
    values = answer.variables if wanted == _HELD else answer.inelastic
    return zone.block(dict(values))


# ---- COMP -----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Step:
    """Two states as COMP takes them."""

    start: CellField
    end: CellField

    def material(self, zone: Zone) -> CellField:
        """Parameters: those of the end, and of the start where the end has none."""
        return joined((self.end, self.start))

    def increment(self, zone: Zone) -> FloatArray:
        """Step of strain."""
        names = family_of(zone).strain_names(zone)
        return components_of(zone, self.end, names) - self._begun(zone, names)

    def _begun(self, zone: Zone, names: tuple[str, ...]) -> FloatArray:
        """Components of the start, zero where it has none: a start may be unloaded."""
        return zone_field(zone, self.start).matrix(names, "STRESSES")

    def answer(self, zone: Zone, more: FloatArray | float = 0.0) -> Answer:
        """The law over the step, with another step of strain added."""
        return respond(
            zone,
            self.material(zone),
            self._begun(zone, family_of(zone).stress_names(zone)),
            zone_field(zone, self.start),
            self.increment(zone) + more,
            self._duration(zone),
        )

    def _duration(self, zone: Zone) -> float | None:
        """Time between the two states, none where one has no date TEMP."""
        states = [zone_field(zone, field) for field in (self.start, self.end)]
        if any("TEMP" not in state for state in states):
            return None
        before, after = (state.at("TEMP", "STRESSES") for state in states)
        return float((after - before).max())


_TWO_STATES = (
    MODEL,
    arg("start", "MCHAML", en="stresses, variables, strains and parameters at the start"),
    arg("end", "MCHAML", en="strains and parameters at the end"),
)
_STRESS = arg("stress", "MCHAML", en="stresses")
_VARIABLES = arg("variables", "MCHAML", en="internal variables")
_MATERIAL = many("material", "MCHAML", at_least=1, en="parameters")


@COMP.form(*_TWO_STATES)
def comp(call: Call, model: Model, start: CellField, end: CellField) -> CellField:
    """Integrate the laws."""
    step = _Step(start, end)
    blocks = []
    for zone in present(call, model).zones:
        answer = step.answer(zone)
        before = zone_field(zone, step.start)
        parts = dict(_named(zone, answer, _STRESSES).components) | dict(answer.variables)
        for name, values in answer.inelastic.items():
            parts[name] = values + before.at(name, "STRESSES", 0.0)
        blocks.append(zone.block(parts))
    return CellField(tuple(blocks))


# ---- ECOU, PLAS -----------------------------------------------------------------------------


_FLOW = (
    MODEL,
    _STRESS,
    _VARIABLES,
    arg("strain", "MCHAML", en="step of strain"),
    _MATERIAL,
    opt("extra", "TABLE", en="duration of the step; gets SUCCES"),
    opt("accuracy", "FLOTTANT", en="accepted: the laws are solved to rounding", range=ANY_NUMBER),
    flag("alone", "NOID", en="accepted, changes nothing"),
    opt("count", "ENTIER", en="accepted, changes nothing", range=ANY_NUMBER),
)


def _flow(
    call: Call,
    model: Model,
    stress: CellField,
    variables: CellField,
    strain: CellField,
    material: tuple[CellField, ...],
    extra: Table | None,
    **accepted: Any,
) -> tuple[CellField, CellField, CellField]:
    parameters = joined(material)
    duration = None if extra is None else Entries(call, extra, "ECOU").get("DT")
    found: dict[str, list[CellFieldBlock]] = {t: [] for t in (_STRESSES, _HELD, _LEFT)}
    for zone in present(call, model).zones:
        answer = respond(
            zone,
            parameters,
            _stresses_of(zone, stress),
            zone_field(zone, variables),
            components_of(zone, strain, family_of(zone).strain_names(zone)),
            duration,
        )
        for title, blocks in found.items():
            blocks.append(_named(zone, answer, title))
    if extra is not None:
        extra.set(Mot("SUCCES"), True)
    made = [CellField(tuple(b for b in bs if b.components), t) for t, bs in found.items()]
    return made[0], made[1], made[2]


for _name, _full in (("ECOU", "ECOULE"), ("PLAS", "PLAS")):
    operator(_name, *_FLOW, family="stress", full_name=_full)(_flow)


# ---- tangents -------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _StateRead:
    """What KTAN, HOTA, CRIT and MOTA read: model, stresses, variables, parameters, precision."""

    model: Model
    stress: CellField
    variables: CellField
    material: CellField
    precision: float
    duration: float | None

    def tangent(self, zone: Zone) -> Answer:
        """The law's tangent at this state: over the shortest of the steps that make it yield."""
        stress, variables = _stresses_of(zone, self.stress), zone_field(zone, self.variables)
        step = probing_step(zone, self.material, stress, self.precision)
        share, small = np.ones_like(step[:, :1]), 1e-6 * np.abs(step).max(axis=1, keepdims=True)
        for less in 0.5 ** np.arange(1, 11) if step.any() else ():
            tried = respond(zone, self.material, stress, variables, (share - less) * step)
            share -= less * (sum(np.abs(v)[:, None] for v in tried.inelastic.values()) > small)
        return respond(zone, self.material, stress, variables, share * step, self.duration)


_STATE = (
    MODEL,
    _STRESS,
    _VARIABLES,
    _MATERIAL,
    key(
        "precision",
        "PREC",
        "FLOTTANT",
        range=POSITIVE,
        default=1e-3,
        en="distance to the surface, a share of the stress; 1.E-3 without it",
    ),
    key(
        "step",
        "DT",
        "FLOTTANT",
        range=POSITIVE,
        unit="s",
        en="time over which laws of creep answer; others do without",
    ),
    opt("number", "FLOTTANT", en="the same as PREC", range=POSITIVE),
)
_SYMMETRIC = flag("symmetric", "SYME", en="symmetric part")


def _state_read(call: Call, said: Mapping[str, Any]) -> _StateRead:
    """What `_STATE` has read."""
    model, material = present(call, said["model"]), joined(said["material"])
    precision = said["precision"] if said["number"] is None else said["number"]
    return _StateRead(model, said["stress"], said["variables"], material, precision, said["step"])


def _tangent_matrix(
    model: Model, tangents: list[tuple[FloatArray, bool]], material: CellField, symmetric: bool
) -> Matrix:
    if not model.zones:
        raise MeshError("operators.statics.no-mechanical-zone")
    blocks = []
    for zone, (tangent, own) in zip(model.zones, tangents, strict=True):
        parameters, family = zone_field(zone, material), family_of(zone)
        D = 0.5 * (tangent + np.swapaxes(tangent, -1, -2)) if symmetric else tangent
        # elements whose stiffness is more than their stresses' keep the rest of it
        block = stiffness(zone, material)
        D = D - elastic_moduli(zone, parameters)
        values = block.values.copy()
        for cells in chunks(len(zone.cells)) if D.any() else ():
            operator_ = family.strain_operator(zone, parameters, "STRESSES", cells)
            values[cells] += contract(operator_, per_cell(D, cells))
        blocks.append(replace(block, values=values, symmetric=own or symmetric))
    return Matrix(model.mesh.nodes, tuple(blocks), (), "RIGIDITE")


@operator("KTAN", *_STATE, _SYMMETRIC, family="matrix")
def ktan(call: Call, symmetric: bool, **state: Any) -> Matrix:
    """Tangent stiffness."""
    read = _state_read(call, state)
    tangents = [(a.tangent, a.symmetric) for a in map(read.tangent, read.model.zones)]
    return _tangent_matrix(read.model, tangents, read.material, symmetric)


@ktan.form(said("PERT"), *_TWO_STATES)
def perturbed(
    call: Call,
    model: Model,
    start: CellField,
    end: CellField,
    share: float = Key(
        "C1",
        "FLOTTANT",
        range=POSITIVE,
        default=1e-3,
        en="share of the step by which its strain is perturbed, 1.E-3 without it",
    ),
    least: float | None = Key(
        "C2", "FLOTTANT", range=POSITIVE, en="least perturbation, C1 / 100 without it"
    ),
    symmetric: bool = _SYMMETRIC,
) -> Matrix:
    """Stiffness of a step, by perturbing its strain."""
    model, step = present(call, model), _Step(start, end)
    smallest = share / 100.0 if least is None else least
    tangents = [(_by_differences(z, step, share, smallest), not has_law(z)) for z in model.zones]
    return _tangent_matrix(model, tangents, joined((step.end, step.start)), symmetric)


def _by_differences(zone: Zone, step: _Step, share: float, least: float) -> FloatArray:
    """Tangent (n_cells, n_points, s, s) by one perturbation a component of strain."""
    base, increment = step.answer(zone).stress, step.increment(zone)
    n, s, p = increment.shape
    size = np.maximum(share * np.abs(increment).max(axis=1), least)
    D = np.empty((n, p, base.shape[1], s))
    for k in range(s):
        more = np.zeros_like(increment)
        # in the direction of the step, so that a loading point stays loading
        more[:, k] = np.where(increment[:, k] < 0.0, -size, size)
        change = (step.answer(zone, more).stress - base) / more[:, k][:, None]
        D[..., k] = change.transpose(0, 2, 1)
    return D


@operator("HOTA", *_STATE, family="stress", full_name="HOTANGE")
def hota(call: Call, **state: Any) -> CellField:
    """Tangent Hooke matrices."""
    read = _state_read(call, state)
    blocks = [hooke_block(z, read.tangent(z).tangent, "STRESSES") for z in read.model.zones]
    return CellField(tuple(blocks), "MATRICE DE HOOKE")


@operator("CRIT", *_STATE, family="stress", full_name="CRITERE")
def crit(call: Call, **state: Any) -> CellField:
    """Yield criterion."""
    return _scalar(_state_read(call, state), criterion)


@operator("MOTA", *_STATE, family="stress")
def mota(call: Call, **state: Any) -> CellField:
    """Tangent moduli."""
    read = _state_read(call, state)
    return _scalar(read, partial(tangent_modulus, precision=read.precision))


def _scalar(read: _StateRead, of: Callable[..., FloatArray]) -> CellField:
    """What a law says of a state, a number a point."""

    def make(zone: Zone) -> CellFieldBlock:
        there, held = _stresses_of(zone, read.stress), zone_field(zone, read.variables)
        return zone.block({"SCAL": of(zone, read.material, there, held)})

    return on_zones(read.model, "SCALAIRE", make)
