"""ZSEM: what the joints under a footing carry in time, behind the procedure @BILANSSI."""

from ssilang.kernel.elements.zone_fields import cell_rows, zone_field
from ssilang.kernel.interface.family import ROTATIONS, displacement_names
from ssilang.kernel.interface.footing import Footing, Loads, footings_of
from ssilang.kernel.interface.interface import (
    Interface,
    interface_of,
    joint_zones,
    point_values,
    state_from_field,
)
from ssilang.kernel.interface.kinematics import JointCells
from ssilang.kernel.interface.laws.columns import LawCode, Parameter
from ssilang.kernel.interface.laws.parameter_table import joint_parameters
from ssilang.kernel.matrices.assembly import Numbering, field_to_vector
from ssilang.operators.prelude import *

OFF = 1e-3  # of the largest pressure: no rounding


@operator("ZSEM", family="dynamics")
def zsem(
    call: Call,
    model: Model = Arg("MMODEL", en="joints under one footing"),
    characteristics: CellField = Arg("MCHAML", en="their parameters"),
    motion: ListChpo = Arg("LISTCHPO", en="displacements"),
    tractions: Table = Arg("TABLE", en="tractions of the same instants, from 1"),
    variables: Table | None = Opt("TABLE", en="internal variables of the same instants, from 1"),
) -> Table:
    """Loads of the footing at each instant."""
    zones = joint_zones(model)
    if not zones:
        raise call.error("operators.dynamics.footing-without-joints", model)
    displacements = cast("list[NodeField]", motion.values)
    numbering = _numbering(model)
    interface = interface_of(zones, characteristics, numbering)
    footings = footings_of(interface, numbering)
    if len(footings) != 1:
        raise call.error("operators.dynamics.several-footings", model, count=len(footings))
    u = np.array([field_to_vector(f, numbering, dual=False, absent=np.nan) for f in displacements])
    footing = footings[0]
    names = displacement_names(zones[0])
    if footing.outline is not None:  # whose jumps are rotations too
        names = numbering.unknowns
    moving = np.isin(numbering.codes, [numbering.code(n) for n in names])
    if (lost := np.isnan(u).any(axis=0) & moving).any():
        node = numbering.table.told(numbering.nodes[np.flatnonzero(lost)[0]])
        raise call.error("operators.dynamics.footing-not-kept", motion, node=node)
    u = np.nan_to_num(u, nan=0.0)
    w = np.array([interface.jumps(row) for row in u])
    stresses = [cast(CellField, tractions.get(i + 1)) for i in range(len(u))]
    t = np.array([point_values(interface, field, "traction") for field in stresses])
    for code, told in _of_others(interface, stresses[0], w, t):
        call.warn(code, **told)
    if footing.bed is not None:
        state = np.array([state_from_field(interface, x) for x in _variables(call, variables, u)])
        at = footing.bed.points
        t[:, at] = footing.bed.tractions(w[:, at], state[:, at])
        t[:, footing.points[0]] -= footing.bed.taken(t[:, at])
    shear = _shear(interface, footing, (w, t, u), characteristics, numbering)
    loads = footing.loads(w, t, u[:, footing.unknowns])
    return _results(interface, footing, numbering, shear, loads, u)


def _of_others(
    interface: Interface, field: CellField, w: FloatArray, t: FloatArray
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Joints that are a part of those the run has there, or have other parameters than it."""
    cells = [j.zone.cells for j in interface.joints]
    reached = np.concatenate([c.connectivity.ravel() for c in cells])
    for block in field.blocks:
        beside = np.isin(block.cells.connectivity, reached).any(axis=1)
        own = np.any([cell_rows(c, block.cells) >= 0 for c in cells], axis=0)
        if count := int((beside & ~own).sum()):
            yield "operators.dynamics.footing-in-part", {"count": count, "own": int(own.sum())}
            return
    pressing = (t[..., -1] < 0.0) & (interface.codes == LawCode.SDM)
    off = np.abs(t[..., -1] - interface.parameters[:, Parameter.KN] * w[..., -1])[pressing]
    share = off.max(initial=0.0) / np.abs(t[..., -1][pressing]).max(initial=1e-300)
    if share > OFF:
        yield "operators.dynamics.footing-of-others", {"share": 100.0 * share}


def _variables(call: Call, given: Table | None, u: FloatArray) -> list[CellField]:
    """Internal variables at the instants of u (k, n)."""
    found = [None if given is None else given.get(i + 1) for i in range(len(u))]
    if any(field is None for field in found):
        raise call.error("operators.dynamics.footing-no-variables", given)
    return cast("list[CellField]", found)


def _shear(
    interface: Interface,
    footing: Footing,
    values: tuple[FloatArray, FloatArray, FloatArray],
    characteristics: CellField,
    numbering: Numbering,
) -> FloatArray:
    """Force (k,) across the mean normal, from jumps, tractions and displacements."""
    (w, t, u), d = values, interface.dimension
    if footing.outline is None:
        push = np.einsum("g,gij,kgi->kj", footing.weights, footing.frames, t[:, footing.points])
        normal = footing.normal[:d]
        push -= (push @ normal)[:, None] * normal
    elif footing.bed is not None:  # its places drag
        at, ks = footing.bed.points, footing.bed.parameters[Parameter.BED_KS]
        drag = t[:, at, : d - 1] + ks * w[:, at, : d - 1]
        push = np.einsum("g,kgi->ki", footing.bed.areas, drag)
    else:  # springs beside the interface
        (j,) = interface.joints
        table = joint_parameters(j, zone_field(j.zone, characteristics))[0]
        codes = np.array([numbering.code(n) for n in displacement_names(j.zone)])
        resolve = j.zone.cells.nodes.resolve
        upper, lower = (u[:, numbering.index(resolve(s[0]), codes)] for s in (j.upper, j.lower))
        push = (upper - lower) @ j.frames[0, 0, : d - 1].T
        push *= table[[Parameter.KS1, Parameter.KS2][: d - 1]]
    return np.asarray(np.linalg.norm(push, axis=1))


def _numbering(model: Model) -> Numbering:
    """Displacements, and rotations of macro-elements, of the joints' nodes."""
    zones = joint_zones(model)
    table = zones[0].cells.nodes
    dimension = zones[0].mode.dimension
    names = displacement_names(zones[0]) + ROTATIONS[dimension]
    nodes = np.unique(np.concatenate([z.cells.raw.ravel() for z in zones]))
    nodes = np.unique(table.resolve(nodes))
    codes = np.tile(np.arange(len(names)), len(nodes))
    return Numbering(table, names, names, np.repeat(nodes, len(names)), codes, table.version)


def _results(
    interface: Interface,
    footing: Footing,
    numbering: Numbering,
    shear: FloatArray,
    loads: Loads,
    u: FloatArray,
) -> Table:
    normal = footing.normal[: interface.dimension]
    lists = {
        "PART": loads.share,
        "FORCE": loads.force,
        "CISA": shear,
        "PRESSION": loads.pressure,
        "OUVERTURE": loads.opening,
        "ENFONCEMENT": -_mean_motion(interface.joints, numbering, u, normal),
    }
    levers = (
        _arms(interface.joints, footing) if footing.outline is None else footing.outline.levers()
    )
    axes = {"MOMENT": loads.moment.T, "ROTATION": loads.rotation.T, "BRAS": levers}
    found: dict[str, Any] = {name: ListReel(values) for name, values in lists.items()}
    inner = {name: Table.numbered(map(ListReel, rows)) for name, rows in axes.items()}
    return Table.of(found | {"AIRE": footing.area} | inner)


def _mean_motion(
    joints: tuple[JointCells, ...], numbering: Numbering, u: FloatArray, normal: FloatArray
) -> FloatArray:
    """Mean displacement (k,) of the upper side along the normal."""
    total, area = np.zeros(len(u)), 0.0
    for j in joints:
        codes = np.array([numbering.code(n) for n in displacement_names(j.zone)])
        nodes: IntArray = j.zone.cells.nodes.resolve(j.upper)
        index = numbering.index(nodes[:, :, None], codes)  # (n, m, d)
        parts = np.einsum("ng,gm->nm", j.weights, j.shape)
        total += np.einsum("nm,knmd,d->k", parts, u[:, index], normal)
        area += float(j.weights.sum())
    return total / area


def _arms(joints: tuple[JointCells, ...], footing: Footing) -> FloatArray:
    """Levers (m, 2) of the edges about each axis, the lowest and the highest.

    None in axisymmetry, which carries no moment.
    """
    places = [
        j.zone.cells.nodes.coordinates[j.zone.cells.nodes.resolve(j.upper).ravel()] for j in joints
    ]
    arms = np.concatenate(places) - footing.centre
    levers = np.cross(footing.axes[:, None], arms[None]) @ footing.normal  # (m, nodes)
    return np.stack([levers.min(axis=1), levers.max(axis=1)], axis=1)
