"""Warnings of what is not joined as it looks: supports, joints and ends of beams."""

from itertools import product

from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.mesh.nodes import told_coordinates
from ssilang.kernel.statics import cells_amiss, doubled
from ssilang.kernel.statics.linear_motion import crossed_lines, wrong_signs
from ssilang.kernel.statics.stability import negative_unknowns
from ssilang.kernel.statics.swapped_joints import (
    drawn_gaps,
    hinges,
    inclinations,
    repeated_joints,
    swapped_joints,
)
from ssilang.operators.prelude import *

Tell = Callable[..., None]
_KEY = "connections"
_NAMED = 4  # nodes that a warning names
_OF_SIZE = 0.25  # of the model: a radius of gyration of what has no mass of its own
_UPRIGHT, _TURNED = 3.0, 120.0  # degrees between a footing's normal and the vertical


def warn_connections(
    session: Any,
    span: Any,
    operator: str,
    matrix: Matrix,
    model: Model | None = None,
    characteristics: CellField | None = None,
    laden: Iterable[IntArray] = (),
) -> None:
    """Warn, once a matrix, of what is not joined as it looks.

    Held nodes without stiffness on nodes of the body (lines made twice), joints whose sides are
    swapped, beams that end on one node of a solid, bodies that touch and are not joined, cells
    that count twice, springs on nodes of no body but those `laden` with masses or loads. Joints are
    those of `model`, whose law stands beside the matrix, without it those that the matrix was made
    from.
    """
    if _KEY in matrix.cache:
        return
    matrix.cache[_KEY] = True

    def tell(code: str, **data: object) -> None:
        if not session.warned(code, **data):  # of a part of it, in front of another operator
            session.warn(code, span, operator=operator, **data)

    if matrix.blocks and all(b.kind == "MASSE" for b in matrix.blocks):
        tell("operators.matrices.mass-for-stiffness")

    foreign = (w for w in session.warnings if w.code == "operators.matrices.foreign-unknown")
    known = {n for w in foreign for n in w.data["names"]}
    _warn_doubled_supports(tell, matrix, model, known)
    made = _joints_in(matrix)
    if model is None and made:
        model = Model(made)
    _warn_swapped_joints(tell, matrix, model, characteristics)
    _warn_footings(tell, matrix, model, characteristics)
    _warn_hinges(tell, matrix, model)
    solids = cells_amiss.bordered_solids(matrix)
    if (layer := cells_amiss.bent_layer(matrix, solids)) is not None:
        told = vars(layer) | {"node": matrix.table.told(layer.node), "stiffer": layer.stiffer}
        tell("operators.matrices.layer-bends", **told)
    zones = () if model is None else model.zones
    others = [np.zeros(0, np.int64), *laden, *([model.mesh.node_ids] if model and zones else [])]
    used, joints = np.concatenate(others), [z for z in zones if is_joint(z)]
    springs = [b for b in matrix.blocks if b.raw_nodes.shape[1] == 1]
    found = {
        "operators.matrices.nodes-hang": cells_amiss.hanging_nodes(matrix, solids),
        "operators.matrices.joints-pass-by": cells_amiss.passed_by_joints(matrix, joints),
        "operators.matrices.cells-overlap": cells_amiss.overlapping_cells(matrix, solids),
        "operators.matrices.springs-held": doubled.idle_nodes(springs, matrix),
        "operators.matrices.clamped-alone": doubled.clamped_alone(matrix),
        "operators.matrices.relation-sign": wrong_signs(matrix),
        "operators.matrices.lines-crossed": crossed_lines(matrix),
        "operators.matrices.ends-apart": doubled.ends_apart(matrix),
        "operators.matrices.joints-twice": repeated_joints(model, characteristics),
        "operators.matrices.axis-held": doubled.held_on_axis(matrix),
    }
    if operator == "VIBR":
        sides = [r.nodes[r.row_start[:-1]][r.sense != 0] for r in matrix.relations]
        found["operators.matrices.unilateral-held"] = np.concatenate([used[:0], *sides])
    else:  # modes DYNE may bring into contact
        found["operators.matrices.stops-held"] = doubled.stops_held(matrix)
        found["operators.matrices.springs-apart"] = doubled.springs_apart(matrix, used)
        if not any(z.formulation == "CONTACT" for z in zones):
            found["operators.matrices.feet-free"] = doubled.feet_free(matrix, joints)
            found["operators.matrices.beside-joints"] = doubled.beside_joints(matrix, joints)
            found["operators.matrices.bodies-apart"] = doubled.bodies_apart(matrix, joints)
    for code, nodes in found.items():
        if len(nodes):
            tell(code, count=len(nodes), node=matrix.table.told(int(nodes[0])))
    warn_repeated(session, span, operator, matrix, "RIGI", matrix)
    if not joints:
        _warn_negative(tell, matrix)


def _joints_in(matrix: Matrix) -> tuple[Zone, ...]:
    """Joints between lines and faces that the matrix was made from, which need no axes given."""
    zones = (b.zone for b in matrix.blocks if b.zone is not None)
    found = {id(z): z for z in zones if is_joint(z) and z.element != "JOI1"}
    return tuple(found.values())


def _warn_doubled_supports(
    tell: Tell, matrix: Matrix, model: Model | None, known: set[str]
) -> None:
    if model is None and (names := sorted(doubled.held_nowhere(matrix) - known)):
        tell("operators.matrices.unknown-of-nothing", names=names)
    used = None if model is None or not model.zones else model.mesh.node_ids
    found = doubled.doubled_supports(matrix, used)
    if found is None:
        return
    x, y, z = matrix.table.coordinates[found.held[0]]
    tell("operators.matrices.held-nodes-without-stiffness", n_held=len(found.held), x=x, y=y, z=z)


def _warn_negative(tell: Tell, matrix: Matrix) -> None:
    if found := negative_unknowns(matrix):
        node, name, value = found[0]
        told = {"node": matrix.table.told(node), "name": name, "value": value}
        tell("operators.matrices.negative-stiffness", count=len(found), **told)


def warn_repeated(
    session: Any, span: Any, operator: str, matrix: Matrix, kind: str, beside: Matrix
) -> None:
    """Warn of a matrix that has the same cells, or the same of others, twice.

    Layers, which the stiffness `beside` it knows by their constituents, may be of one mass.
    """
    layered = matrix is not beside and any(b.zone and b.zone.constituent for b in beside.blocks)
    if not layered and len(found := doubled.repeated_cells(matrix)):
        told = {"kind": kind, "count": len(found), "node": matrix.table.told(int(found[0]))}
        session.warn("operators.matrices.cells-twice", span, operator=operator, **told)


def _warn_swapped_joints(
    tell: Tell,
    matrix: Matrix,
    model: Model | None,
    characteristics: CellField | None,
) -> None:
    for node, gap in drawn_gaps(model, characteristics):
        tell("operators.matrices.gap-drawn", node=matrix.table.told(node), gap=gap)
    for found in swapped_joints(matrix, model, characteristics):
        place = told_coordinates(matrix.table.shown(np.round(found.middle, 9)))
        told = {"points": found.points, "overlap": found.overlap}
        tell("operators.matrices.sides-swapped", place=place, **told)


def _warn_footings(
    tell: Tell,
    matrix: Matrix,
    model: Model | None,
    characteristics: CellField | None,
) -> None:
    for node, angle in inclinations(model, characteristics):
        if angle > _TURNED:
            tell("operators.matrices.footing-turned", node=matrix.table.told(node))
        elif _UPRIGHT < angle < 90.0 - _UPRIGHT:
            tell("operators.matrices.footing-inclined", node=matrix.table.told(node), angle=angle)


def _warn_hinges(tell: Tell, matrix: Matrix, model: Model | None) -> None:
    joints = tuple(z for z in model.zones if is_joint(z)) if model is not None else ()
    found = hinges(matrix, joints)
    if found is None:
        return
    nodes = [matrix.table.told(int(n)) for n in found.nodes]
    told = {"nodes": nodes[:_NAMED], "more": len(nodes[_NAMED:]), "shell": found.shell}
    tell("operators.matrices.beam-ends-on-solid", rotations=found.rotations, **told)


def rotary_without_mass(mass: Matrix) -> dict[str, Any] | None:
    """Rotary inertia at a node far beyond what its cells have, where no node is given a mass."""
    lumps = [b for b in mass.blocks if b.zone is None and b.raw_nodes.shape[1] == 1]
    turning = [b for b in lumps if all(u[0] == "R" for u in b.unknowns)]
    if not turning or len(turning) < len(lumps):
        return None
    every = np.unique(np.concatenate([b.nodes.ravel() for b in mass.blocks]))
    size = float(np.ptp(mass.table.coordinates[every], axis=0).max())
    own = np.zeros((len(mass.table), 3))
    for block, (k, axis) in product(mass.blocks, enumerate(("UX", "UY", "UZ"))):
        at = np.flatnonzero(np.array(block.unknowns) == axis)
        rows = block.values[:, at][:, :, at].sum(axis=2)
        np.add.at(own[:, k], block.nodes[:, block.local[at]], rows)
    for block in turning:
        nodes, inertia = block.nodes[:, 0], np.diagonal(block.values, axis1=1, axis2=2).max(axis=1)
        beside = own[nodes].max(axis=1)
        far = (beside > 0.0) & (inertia > (_OF_SIZE * size) ** 2 * beside)
        if far.any():
            i = int(far.argmax())
            told = {"inertia": inertia[i], "mass": beside[i], "size": size}
            way = float(np.sqrt(inertia[i] / beside[i]))
            return {"node": mass.table.told(int(nodes[i])), "way": way, **told}
    return None
