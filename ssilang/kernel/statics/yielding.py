"""Yield criteria of stresses: negative inside, zero on the surface, in the unit of the stress."""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.columns import LawCode, Parameter, Variable
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.behaviours import SECTION_FAMILIES
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.materials.plastic import rounded_coulomb
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS
from ssilang.kernel.materials.plastic.response import PointParameters
from ssilang.kernel.plasticity.bulk import Bulk, State
from ssilang.kernel.plasticity.points import PlasticPoints, is_plastic
from ssilang.kernel.plasticity.zone_points import plastic_points
from ssilang.kernel.statics.constitutive import joint_points, joint_state, section_stress
from ssilang.kernel.stepping.problem.plausibility import solver_of
from ssilang.kernel.stepping.problem.problem import Problem, closed_stiffness

Criterion = Callable[[PointParameters, FloatArray, FloatArray], FloatArray]
"""Criterion (m,) from parameters, stresses (m, 6), internal variables (m, k)."""


CRITERIA: dict[str, Criterion] = {
    **{name: law.cone.excess for name, law in PLASTIC_LAWS.items() if law.cone is not None},
    "RH_COULOMB": lambda p, s, v: rounded_coulomb.criterion(p, s),
}
"""By the word after PLASTIQUE."""


FRICTIONAL = ("DRUCKER_PARFAIT", "DRUCKER_PRAGER", "RH_COULOMB")
"""Laws that bear by pressure."""
FAR, MOST, MANY = 5.0, 0.5, 0.1
"""Times what points bear without pressure; shares of points that yield, and go so far."""


def unconfined(problem: Problem, bulk: Bulk, state: State) -> tuple[str, float, float] | None:
    """Points that forces of an elastic first step take beyond what they bear without pressure.

    Returns
    -------
    law, share of its points, what they bear; None of bodies that have stresses, or few such points.
    """
    loading, T = problem.loading, problem.constraints.T
    names, factors = [_law(z.zone) for z in bulk.zones], loading.at(problem.times[1:2])[0]
    driven = (loading.imposed @ factors).any() or any(s.stress.any() for s in state)
    if {*names}.isdisjoint(FRICTIONAL) or driven:
        return None
    tangent = bulk.respond(state, np.zeros(problem.numbering.size), problem.times[0]).tangent
    stiffness = sp.csr_array(closed_stiffness(problem) + T.T @ tangent @ T)
    try:
        moved = T @ solver_of(stiffness)(T.T @ (loading.forces @ factors)[:, None])[:, 0]
    except SingularFactorError:  # the steps tell what moves
        return None
    for name, z, places, old in zip(names, bulk.zones, bulk.places, state, strict=True):
        if name in FRICTIONAL and type(z) is PlasticPoints:
            stress = np.einsum("mij,mj->mi", z.parameters.moduli, z.strains(moved[places]))
            above = CRITERIA[name](z.parameters, stress, old.variables)
            limit = -CRITERIA[name](z.parameters, old.stress, old.variables)
            share = float((above > 0.0).mean())
            if share > MOST and (above > FAR * limit).mean() > MANY:
                return name, share, float(limit.max())
    return None


def _law(zone: Zone) -> str:
    words = zone.behaviour
    return words[words.index("PLASTIQUE") + 1] if "PLASTIQUE" in words else words[-1]


def criterion(
    zone: Zone, material: CellField, stress: FloatArray, variables: ZoneField
) -> FloatArray:
    """Criterion (n_cells, n_points) of the stresses (n_cells, n_stresses, n_points) of a zone.

    Raises
    ------
    FieldError
        If the law of the zone has none.
    """
    if is_joint(zone):
        return _of_joint(zone, material, stress, variables)
    words = zone.behaviour
    name = _law(zone) if is_plastic(zone) else ""
    if name not in CRITERIA or family_name(zone) in (*SECTION_FAMILIES, "thick"):
        told = {"words": words, "element": zone.element, "criteria": CRITERIA}
        raise FieldError("kernel.statics.law-element-no-criterion", **told)
    points = plastic_points(zone, material)
    kept = variables.matrix(points.law.variables, "STRESSES").transpose(0, 2, 1)
    s = section_stress(points, stress)
    found = CRITERIA[name](points.parameters, s, kept.reshape(len(s), -1))
    return np.asarray(found.reshape(points.weights.shape))


def _of_joint(
    zone: Zone, material: CellField, stress: FloatArray, variables: ZoneField
) -> FloatArray:
    law = law_of(zone.behaviour)
    if law.code not in (LawCode.SDM, LawCode.MOHR):
        raise FieldError("kernel.statics.joints-law-no-criterion", element=zone.element)
    points = joint_points(zone, material)
    t, p = points.local(stress), points.table
    shear, normal = np.linalg.norm(t[:, :-1], axis=1), t[:, -1]
    if law.code == LawCode.MOHR:
        sliding = shear + normal * p[:, Parameter.TPHI] - p[:, Parameter.COHE]
        opening = normal - p[:, Parameter.FTRC]
        return np.asarray(np.maximum(sliding, opening).reshape(points.shape))
    xi, fu = joint_state(points, variables)[:, Variable.XI], p[:, Parameter.FU]
    rate = np.divide(fu, p[:, Parameter.GF], out=np.zeros_like(fu), where=fu > 0)
    opening = normal - fu * np.exp(-rate * xi)
    rough = p[:, Parameter.FROT]
    sliding = shear - rough * np.maximum(-normal, 0.0)
    found = np.where(rough > 0, np.maximum(opening, sliding), opening)
    return found.reshape(points.shape)


def tangent_modulus(
    zone: Zone, material: CellField, stress: FloatArray, variables: ZoneField, precision: float
) -> FloatArray:
    """Slope of the equivalent stress on the equivalent plastic strain, Young's modulus inside.

    A point is on the surface where it has yielded (EPSE > 0) and the criterion is above
    `-precision` times the size of the surface.
    """
    parameters = zone_field(zone, material)
    shape = (len(zone.cells), stress.shape[2])
    elastic = np.broadcast_to(parameters.at("YOUN", "STRESSES"), shape)
    if is_joint(zone) or not is_plastic(zone):
        return elastic.copy()
    name = _law(zone)
    cone = PLASTIC_LAWS[name].cone if name in PLASTIC_LAWS else None
    if cone is None or name in FRICTIONAL:
        raise FieldError("kernel.statics.mota-knows-von-mises", name=name)
    points = plastic_points(zone, material)
    cumulated = np.broadcast_to(variables.at("EPSE", "STRESSES", 0.0), shape).ravel()
    size, slope = cone.strength(points.parameters, cumulated)
    slope = slope + points.parameters.values.get("H", 0.0)
    above = criterion(zone, material, stress, variables).ravel() > -precision * size
    found = np.where(above & (cumulated > 0), slope, elastic.ravel())
    return found.reshape(shape)
