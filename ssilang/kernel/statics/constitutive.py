"""Constitutive laws at the points of one zone: from the state at the start and the strain at the
end of a step to stresses, internal variables and tangent moduli.

One table of families of laws serves COMP, ECOU, KTAN, HOTA: elastic, plastic bodies, joints.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.elements.families import family_of, moduli_of, plastic_strain_names
from ssilang.kernel.elements.family import apply_moduli
from ssilang.kernel.elements.zone_fields import ZoneField, n_points, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.family import component_order, has_rotations
from ssilang.kernel.interface.kinematics import joint_cells
from ssilang.kernel.interface.laws.columns import N_STATE, LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.law_table import law_of, shown_variables, state_of
from ssilang.kernel.interface.laws.parameter_table import joint_parameters
from ssilang.kernel.interface.laws.point_laws import respond as compiled_respond
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.materials.plastic.laws import plastic_law
from ssilang.kernel.plasticity.layered_points import STRESSES, is_layered
from ssilang.kernel.plasticity.points import PlasticPoints, is_plastic
from ssilang.kernel.plasticity.zone_points import plastic_points

Variables = Mapping[str, FloatArray]


@dataclass(frozen=True, eq=False)
class Answer:
    """What a law answers at the points of 'STRESSES' of a zone."""

    stress: FloatArray  # (n_cells, n_stresses, n_points)
    variables: Variables  # (n_cells, n_points) each
    inelastic: Variables  # (n_cells, n_points) each: step of inelastic strain
    tangent: FloatArray  # (n_cells, n_points, n_stresses, n_strains)
    symmetric: bool = True  # whether the tangent is symmetric whatever the state


def has_law(zone: Zone) -> bool:
    """Whether a zone's law is more than elasticity."""
    return not law_of(zone.behaviour).linear if is_joint(zone) else is_plastic(zone)


def variable_names(zone: Zone) -> tuple[str, ...]:
    """Internal variables that results of a zone hold, none without a law."""
    if is_joint(zone):
        state = np.zeros(N_STATE)
        return tuple(shown_variables(law_of(zone.behaviour), state, len(component_order(zone))))
    law = plastic_law(zone.behaviour) if is_plastic(zone) else None
    return () if law is None else (*law.variables, *(STRESSES if is_layered(zone) else ()))


def respond(
    zone: Zone,
    material: CellField,
    stress: FloatArray,
    variables: ZoneField,
    step: FloatArray,
    duration: float | None = None,
) -> Answer:
    """The law of a zone over a step.

    Parameters
    ----------
    stress : array (n_cells, n_stresses, n_points)
        At the start, at the points of 'STRESSES'.
    variables : ZoneField
        Internal variables at the start; those absent are zero.
    step : array (n_cells, n_strains, n_points)
        Increment of strain (of jump, for joints).
    duration : float, optional
        Time that the step takes: what creeps needs it.
    """
    _no_fibres(zone)
    if "FLUAGE" in zone.behaviour and duration is None:
        raise FieldError("kernel.statics.answer-law-creep-depends")
    if is_plastic(zone):
        return _plastic(zone, material, (stress, step), variables, duration or 0.0)
    law = _joint if is_joint(zone) else _elastic
    return law(zone, material, stress, variables, step)


def _no_fibres(zone: Zone) -> None:
    """Refuse yielding beams of fibres: their strains say nothing of those of their fibres."""
    if "SECTION" in zone.behaviour and is_plastic(zone):
        raise FieldError("kernel.statics.beams-sections-fibres-no")
    if is_plastic(zone) and (is_layered(zone) or zone.element == "COQ3"):
        raise FieldError("kernel.statics.plastic-shells-no-law", element=zone.element)


def probing_step(
    zone: Zone, material: CellField, stress: FloatArray, precision: float
) -> FloatArray:
    """A step of strain that takes the points within `precision` of yielding just past it.

    It raises the stress by that share of itself (of a joint its shear, and its normal traction
    where that is a tension), elastically: the law's tangent over it is the one of the state.
    """
    _no_fibres(zone)
    step = np.zeros((len(stress), len(family_of(zone).strain_names(zone)), stress.shape[2]))
    if is_joint(zone) and not law_of(zone.behaviour).linear:
        joints = joint_points(zone, material)
        trial = joints.local(stress) * precision
        trial[:, -1] = np.maximum(trial[:, -1], 0.0)
        step[:, : joints.dimension] = joints.named(joints.jumps(trial))
        return step
    if not is_plastic(zone) or "FLUAGE" in zone.behaviour:
        return step
    points = plastic_points(zone, material)
    raised = section_stress(points, stress) * precision
    strain = np.einsum("mij,mj->mi", points.parameters.compliance, raised) / points.roots
    return points.gathered(strain)


# ---- elasticity -----------------------------------------------------------------------------


def elastic_moduli(zone: Zone, parameters: ZoneField) -> FloatArray:
    """Moduli (n_cells, n_points, s, s) at 'STRESSES', from Hooke matrices or parameters."""
    found = moduli_of(zone, parameters, "STRESSES")
    shape = (len(zone.cells), n_points(zone.element, "STRESSES"), *found.shape[2:])
    return np.broadcast_to(found, shape)


def _elastic(
    zone: Zone, material: CellField, stress: FloatArray, variables: ZoneField, step: FloatArray
) -> Answer:
    D = elastic_moduli(zone, zone_field(zone, material))
    return Answer(stress + apply_moduli(D, step), {}, {}, D)


# ---- plastic bodies -------------------------------------------------------------------------


def section_stress(points: PlasticPoints, stress: FloatArray) -> FloatArray:
    """Stress tensors (m, 6) of a zone's stresses (forces in bars)."""
    own = stress if points.section is None else stress / points.section[:, None]
    return points.spread(own) / points.roots


def _plastic(
    zone: Zone,
    material: CellField,
    given: tuple[FloatArray, FloatArray],
    variables: ZoneField,
    duration: float,
) -> Answer:
    (stress, step), points = given, plastic_points(zone, material)
    n, p = points.weights.shape
    before = section_stress(points, stress)
    kept = variables.matrix(points.law.variables, "STRESSES").transpose(0, 2, 1)
    found, whole = points.respond(
        before, points.spread(step) * points.roots, kept.reshape(n * p, -1), duration
    )
    elastic = np.einsum("mij,mj->mi", points.parameters.compliance, found.stress - before)
    plastic = points.gathered((whole - elastic) / points.roots)
    chosen = np.array(points.components)
    whole_tangent = found.tangent * np.outer(points.roots, points.roots)
    tangent = whole_tangent[:, chosen[:, None], chosen[None, :]].reshape(n, p, *step.shape[1:2] * 2)
    after = points.gathered(found.stress * points.roots)
    if points.section is not None:
        after, tangent = after * points.section[:, None], tangent * points.section[..., None, None]
    inner = found.variables.reshape(n, p, -1)
    return Answer(
        after,
        {name: inner[..., k] for k, name in enumerate(points.law.variables)},
        {name: plastic[:, k] for k, name in enumerate(plastic_strain_names(zone))},
        tangent,
        points.law.symmetric,
    )


# ---- joints ---------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class JointPoints:
    """Points of a zone of joints, components in the order that compiled laws use."""

    zone: Zone
    table: FloatArray
    dimension: int
    shape: tuple[int, int]

    @property
    def order(self) -> list[int]:
        return component_order(self.zone)

    def local(self, values: FloatArray) -> FloatArray:
        """Rows (m, d) of components (n_cells, n_names, n_points)."""
        made = np.empty((*self.shape, self.dimension))
        made[..., self.order] = values[:, : self.dimension].transpose(0, 2, 1)
        return made.reshape(-1, self.dimension)

    def named(self, rows: FloatArray) -> FloatArray:
        """Components (n_cells, d, n_points) of rows (m, d)."""
        made = rows.reshape(*self.shape, self.dimension)[..., self.order]
        return np.ascontiguousarray(made.transpose(0, 2, 1))

    def jumps(self, traction: FloatArray) -> FloatArray:
        """Elastic jumps (m, d) of tractions, none where there is no stiffness."""
        shear = (Parameter.KS1, Parameter.KS2)[: self.dimension - 1]
        k = np.stack([self.table[:, c] for c in (*shear, Parameter.KN)], axis=1)
        return np.divide(traction, k, out=np.zeros_like(traction), where=k > 0.0)


def joint_points(zone: Zone, material: CellField) -> JointPoints:
    given = zone_field(zone, material)
    cells = joint_cells(zone, given)
    table = joint_parameters(cells, given)
    return JointPoints(zone, table, cells.element.dimension, cells.weights.shape)


def joint_state(points: JointPoints, variables: ZoneField) -> FloatArray:
    """State (m, N_STATE) from internal variables by name."""
    return state_of(law_of(points.zone.behaviour), variables, points.shape)


def _jump(points: JointPoints, traction: FloatArray, state: FloatArray, code: int) -> FloatArray:
    """The jump (m, d) that tractions and internal variables belong to.

    It is unique but for open points, which start from the opening that their variables hold, and
    for shear without stiffness, which starts from none. In tension shear's stiffness has faded.
    """
    w, p = points.jumps(traction), points.table
    slips = (Variable.SLIP1, Variable.SLIP2)[: points.dimension - 1]
    t, xi, limit = traction[:, -1], state[:, Variable.XI], p[:, Parameter.FC]
    if code == LawCode.SDM:
        fades = (t >= 0.0) & (p[:, Parameter.FU] > 0.0) & (p[:, Parameter.SHEAR] != 1.0)
        spent = p[fades, Parameter.FU] / p[fades, Parameter.GF] * xi[fades]
        w[fades, :-1] *= np.exp(spent)[:, None]
        closed = np.divide(t, limit, out=(t < 0.0).astype(float), where=limit < 0.0)
        w[:, -1] += xi * (1.0 - closed.clip(0.0, 1.0))
    if code in (LawCode.SDM, LawCode.MOHR):
        w[:, :-1] += state[:, slips]
    if code == LawCode.MOHR:
        w[:, -1] += xi + state[:, Variable.OPENING]
    return w


def _joint(
    zone: Zone, material: CellField, stress: FloatArray, variables: ZoneField, step: FloatArray
) -> Answer:
    law = law_of(zone.behaviour)
    if law.macro and (zone_field(zone, material).at("COHE", "STRESSES", 0.0) > 0.0).any():
        raise MaterialError("kernel.statics.ground-is-not-at-a-point")
    if law.linear or law.macro:
        return _elastic(zone, material, stress, variables, step)
    if law.two_points:  # jumps do not follow from forces where the slider has moved
        raise FieldError("kernel.statics.joints-law-no-criterion", element=zone.element)
    points = joint_points(zone, material)
    d, m = points.dimension, len(points.table)
    state = joint_state(points, variables)
    w = _jump(points, points.local(stress), state, law.code) + points.local(step)
    t, new, D = np.zeros((m, d)), np.zeros((m, N_STATE)), np.zeros((m, d, d))
    compiled_respond(np.full(m, law.code), w, state, points.table, t, new, D)
    return _joint_answer(zone, material, points, (stress, step), (t, new, D))


def _joint_answer(
    zone: Zone,
    material: CellField,
    points: JointPoints,
    given: tuple[FloatArray, FloatArray],
    found: tuple[FloatArray, FloatArray, FloatArray],
) -> Answer:
    (stress, step), (t, new, D) = given, found
    d, order = points.dimension, points.order
    n, g = points.shape
    local = D.reshape(n, g, d, d)[..., order, :][..., order]
    after = points.named(t)
    tangent = local
    if has_rotations(zone):
        whole = elastic_moduli(zone, zone_field(zone, material)).copy()
        turned = stress + apply_moduli(whole, step)
        whole[..., :d, :] = 0.0
        whole[..., :, :d] = 0.0
        whole[..., :d, :d] = local
        turned[:, :d], after, tangent = after, turned, whole
    inner = shown_variables(law_of(zone.behaviour), new.reshape(n, g, -1), d)
    elastic = points.jumps(t - points.local(stress))
    rest = points.named(points.local(step) - elastic)
    names = plastic_strain_names(zone)[:d]
    inelastic = {name: rest[:, k] for k, name in enumerate(names)}
    return Answer(after, inner, inelastic, tangent, False)
