"""ZDRM, ZBOR: forces that bring a free field into a mesh, behind the procedures @DRM and @BORDS."""

from ssilang.kernel.elements.boundary import wave_speeds
from ssilang.kernel.elements.families import unlike
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.matrices.assembly import Numbering, field_to_vector
from ssilang.kernel.waves import free_field_forces, resolution
from ssilang.kernel.waves.shaken import longest_cell
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_LOWEST = 3  # heights that the elements of the base may have
_PULLS = 0.01  # of the largest force at the edges
_UNLIKE = 1e-3  # of a motion along a height: that of a wave at an angle
_UNBALANCED = 0.3  # of the forces of inertia: what damping leaves is less
_MOTION = ("DEPL", "VITE", "ACCE")


@operator("ZDRM", family="dynamics")
def zdrm(call: Call, table: Table = Arg("TABLE", en="table of @DRM")) -> Load:
    """Forces at the layer."""
    entries = Entries(call, table, "@DRM")
    # matrices stand for the ground in the layer and outside it
    found = free_field_forces.yielding_outside(
        entries.needed("MODELE"), entries.needed("INTERIEUR")
    )
    if found is not None:
        raise entries.error("operators.dynamics.soil-yields-outside", **found.told())
    layer = free_field_forces.elements_of(_ground(entries), entries.needed("COUCHE"))
    motion = _motion(entries, layer.numbering)
    _free_field_is_linear(entries, layer)
    _tell_coarse(entries, motion)
    _tell_reflecting(entries, motion)
    forces = free_field_forces.layer_forces(layer, entries.needed("INTERIEUR"), motion)
    return free_field_forces.load_of(layer, entries.get("AMORTISSEURS"), motion, forces)


@operator("ZBOR", family="dynamics")
def zbor(call: Call, table: Table = Arg("TABLE", en="table of @BORDS")) -> Load:
    """Forces at the edges."""
    entries = Entries(call, table, "@BORDS")
    # matrices stand for the ground beyond the edges
    found = free_field_forces.yielding_at(entries.needed("MODELE"), entries.needed("FRONTIERE"))
    if found is not None:
        raise entries.error("operators.dynamics.soil-yields-at-edges", **found.told())
    edge = entries.needed("FRONTIERE")
    row = free_field_forces.elements_at(_ground(entries), edge)
    motion = _motion(entries, row.numbering)
    _free_field_is_linear(entries, row)
    _tell_coarse(entries, motion)
    _tell_other_ground(entries, row, motion)
    _tell_other_matter(entries)
    dampers = entries.needed("AMORTISSEURS")
    forces = free_field_forces.edge_forces(row, edge, dampers, motion)
    _tell_bare(entries, edge, motion, float(np.abs(forces).max(initial=0.0)))
    return free_field_forces.load_of(row, dampers, motion, forces)


def _tell_bare(entries: Entries, edge: Mesh, motion: free_field_forces.Motion, most: float) -> None:
    """Warn of sides that are neither edges nor held, where the motion asks for a part of a force.

    At a free surface, and along a plane that waves do not pull at, it asks for none.
    """
    held = [r.nodes for r in entries.needed("RIGI").relations]
    known = np.unique(np.concatenate([edge.sorted_node_ids, *held]))
    nodes = resolution.bare_sides(entries.needed("MODELE"), known)
    row = free_field_forces.elements_with(_ground(entries), nodes)
    at = np.isin(row.numbering.nodes, nodes)
    asked = np.abs(row.force(*motion.at(row.touched))[at])  # not a number where it is not known
    if asked.size and asked.max() > _PULLS * most:
        node = row.numbering.nodes[at][asked.max(axis=1).argmax()]
        told = {"count": len(nodes), "node": row.numbering.table.told(int(node))}
        entries.warn("operators.dynamics.edges-bare", **told)


def _tell_other_matter(entries: Entries) -> None:
    """Warn of a ground whose matrix has not the parameters that the table gives for it."""
    given, material = entries.needed("RIGI").blocks, entries.get("CARACTERISTIQUES")
    for zone in entries.needed("MODELE").zones if material is not None else ():
        if not is_joint(zone) and (off := unlike(given, zone, material)):
            entries.warn("operators.dynamics.ground-of-others", off=100.0 * off)
            return


def _tell_other_ground(
    entries: Entries, row: free_field_forces.Share, motion: free_field_forces.Motion
) -> None:
    """Warn of a motion, the same along a height, that is not in balance with the ground's elements.

    What the elements above those of the base exert sums to nought at a height, the motion being
    the same along it; of damping that the table does not name a part is left.
    """
    u, v, a = (np.nan_to_num(of) for of in motion.at(row.touched))
    numbering, axis = row.numbering, _upward(row.numbering)
    size = [np.abs(a[numbering.where(n)]).max(initial=0.0) for n in numbering.unknowns]
    moving = numbering.codes == int(np.argmax(size))
    heights = numbering.table.coordinates[numbering.nodes, axis].round(6)
    levels, at = np.unique(heights, return_inverse=True)
    most, least = np.full((2, len(levels), u.shape[1]), [[[-np.inf]], [[np.inf]]])
    known = moving & row.touched
    np.maximum.at(most, at[known], u[known])
    np.minimum.at(least, at[known], u[known])
    if (most - least).max() > _UNLIKE * np.abs(u).max():
        return
    sums = np.zeros((len(levels), 2, u.shape[1]))
    np.add.at(sums, at[moving], np.stack([row.force(u, v, a), row.mass @ a], axis=1)[moving])
    left, whole = np.linalg.norm(sums[_LOWEST:], axis=(0, 2))
    if left > _UNBALANCED * whole > 0.0:
        told = {"share": 100.0 * left / whole, "column": entries.get("COLONNE") is not None}
        entries.warn("operators.dynamics.column-of-others", **told)


def _free_field_is_linear(entries: Entries, share: free_field_forces.Share) -> None:
    """Refuse a free field that has yielded where the ground's matrices take its motion."""
    table = entries.needed("MOUVEMENT")
    last = max(i for i in table.indices() if isinstance(i, int))
    variables = table.get(last).get("VARIABLES_INTERNES")
    if not isinstance(variables, CellField):
        return
    nodes = np.unique(share.numbering.nodes[share.touched])
    axis = None if entries.get("COLONNE") is None else _upward(share.numbering)
    found = free_field_forces.yielded(variables, nodes, axis)
    if found is not None:
        raise entries.error("operators.dynamics.free-field-yields", **vars(found))


def _upward(numbering: Numbering) -> int:
    """The upward axis, by the translations that there are."""
    return len([n for n in numbering.unknowns if n in ("UX", "UY", "UZ")]) - 1


def _ground(entries: Entries) -> free_field_forces.Ground:
    return free_field_forces.Ground(
        entries.needed("RIGI"), entries.needed("MASS"), entries.get("AMOR")
    )


def _motion(entries: Entries, numbering: Numbering) -> free_field_forces.Motion:
    """Histories of the free field on the ground's unknowns, from instants 1, 2 ..."""
    table = entries.needed("MOUVEMENT")
    count = sum(isinstance(i, int) for i in table.indices())
    instants = [table.get(i + 1) for i in range(count)]
    if count < 2 or any(not _is_instant(i) for i in instants):
        raise entries.error("operators.dynamics.instants-of-motion", count=count)
    times = np.array([float(i.get("TEMP")) for i in instants])
    if np.any(np.diff(times) <= 0):
        raise entries.error("operators.dynamics.motion-times-must-increase")
    spread = _spread(entries, numbering)
    histories = (
        np.array([spread(instant.get(name)) for instant in instants]).T for name in _MOTION
    )  # fmt: skip
    return free_field_forces.Motion(times, *histories)


def _is_instant(of: Any) -> bool:
    return (
        isinstance(of, Table)
        and isinstance(of.get("TEMP"), int | float)
        and all(isinstance(of.get(name), NodeField) for name in _MOTION)
    )


def _spread(entries: Entries, numbering: Numbering) -> Any:
    """The function that takes a field to the unknowns, along the heights of a column if given."""
    column = entries.get("COLONNE")
    if column is None:
        return lambda field: field_to_vector(field, numbering, dual=False, absent=np.nan)
    places = [(n, numbering.where(n)) for n in numbering.unknowns]
    nodes, weights = _column(numbering, column.sorted_node_ids)

    def by_height(field: NodeField) -> FloatArray:
        found = np.empty(numbering.size)
        for name, place in places:
            found[place] = weights[name] @ field.values_at(name, nodes, np.nan)
        return found

    return by_height


def _column(numbering: Numbering, nodes: IntArray) -> tuple[IntArray, dict[str, Any]]:
    """One node a height of the column, and the weights of each unknown's nodes in them."""
    axis = _upward(numbering)
    heights = numbering.table.coordinates[:, axis]
    span = float(np.ptp(heights[nodes])) or 1.0
    _, first = np.unique(np.round(heights[nodes] / (1e-7 * span)), return_index=True)
    kept = nodes[first]
    weights = {
        name: free_field_forces.along_columns(
            heights[numbering.nodes[numbering.where(name)]], heights[kept]
        )
        for name in numbering.unknowns
    }
    return kept, weights


def _tell_coarse(entries: Entries, motion: free_field_forces.Motion) -> None:
    """Warn of elements too long for the highest frequency, that of the motion if none is given."""
    frequency = entries.get("FREQUENCE")
    if frequency is None:
        frequency = resolution.highest_frequency(motion.times, np.nan_to_num(motion.acceleration))
    if frequency <= 0:
        return
    ground = _ground(entries)
    first = ground.stiffness.blocks[0].unknowns[0]  # UX, about an axis UR
    coarse = longest_cell(ground.stiffness, ground.mass, first, frequency, upwards=False)
    if coarse is not None and coarse.cells < coarse.usual * (1.0 - 1e-9):
        told = vars(coarse) | {"node": ground.mass.table.told(coarse.node), "frequency": frequency}
        entries.warn("operators.dynamics.element-too-long", **told)


def _tell_reflecting(entries: Entries, motion: free_field_forces.Motion) -> None:
    """Warn where what leaves the layer comes back from an edge before the motion ends."""
    model, material = entries.needed("MODELE"), entries.needed("CARACTERISTIQUES")
    found = resolution.reflecting_edges(
        model, entries.needed("COUCHE"), entries.get("AMORTISSEURS")
    )
    if found is None:
        return
    fastest = max(float(wave_speeds(zone, material)[0].max()) for zone in model.zones)
    back = 2 * found.distance / fastest
    if back < motion.times[-1] - motion.times[0]:
        table = model.zones[0].cells.nodes
        told = vars(found) | {"place": table.shown(found.place), "back": back}
        entries.warn("operators.dynamics.edges-reflect", **told)
