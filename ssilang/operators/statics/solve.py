"""RESO REAC DIAG: linear systems with conditions, reactions, negative eigenvalues."""

import math

import numpy as np

from ssilang.kernel.base.errors import SingularMatrixError
from ssilang.kernel.elements import families
from ssilang.kernel.materials.model import same_elements
from ssilang.kernel.matrices.assembly import imposed_outside
from ssilang.kernel.statics.linear import SolveOptions, linear_system, reactions, solve
from ssilang.kernel.statics.stability import free_motion_fields, negative_eigenvalues
from ssilang.operators.matrices.connections import warn_connections
from ssilang.operators.matrices.supports import static_links
from ssilang.operators.prelude import *
from ssilang.operators.workspace import solver_of

_FIRST = 4  # cells whose matrices are compared
FAR, NOT_SMALL = 10.0, 0.2
"""Sizes of what is loaded: displacements of more are a slip of units, or a body that is loose."""
_MATRIX = arg("matrix", "RIGIDITE", en="matrix")
_WORDS = (
    flag("project", "NOID", en="leave out the part of the loads that drives a free motion"),
    flag("warned", "SOUC", en="leave it out too, with a warning"),
    flag("bilateral", "NOUNIL", en="unilateral conditions are equalities"),
    flag("stabilise", "STAB", en="add to the diagonal what makes the matrix positive"),
    flag("plain", "NOSTAB", en="accepted: the default"),
    key(
        "passes",
        "ELIM",
        "ENTIER",
        range=NOT_NEGATIVE,
        en="0 keeps all conditions in a saddle point",
    ),
    key(
        "first",
        "INIB",
        arg("conditions", "RIGIDITE", en="conditions"),
        arg("active", "LISTENTI", en="active ones", range=ANY_NUMBER),
        en="first guess of the active conditions: accepted, found without it",
    ),
)
_PRECISION = opt(
    "precision",
    "FLOTTANT",
    en="accepted: the solution is refined to rounding anyway",
    range=ANY_NUMBER,
)
_LOADS = many("loads", "CHPOINT", at_least=1, en="second members")


def _options(call: Call, words: Mapping[str, Any]) -> SolveOptions:
    """What `_WORDS` have read."""
    return SolveOptions(
        unilateral=not words["bilateral"],
        eliminate=words["passes"] is None or words["passes"] > 0,
        project=words["project"] or words["warned"],
        stabilise=words["stabilise"],
        solver=solver_of(call.session),
    )


@operator(
    "RESO",
    _MATRIX,
    _PRECISION,
    _LOADS,
    *_WORDS,
    family="solve",
    full_name="RESO",
    gives=Like("loads"),
)
def _reso(
    call: Call, matrix: Matrix, precision: float | None, loads: tuple[NodeField, ...], **words: Any
) -> tuple[NodeField, ...]:
    options = _options(call, words)
    if words["warned"]:
        # loads that drive a free motion give a warning instead of an error
        try:
            return tuple(solve(matrix, loads, replace(options, project=False)))
        except KernelError as problem:
            call.warn(problem.code, **problem.data)
        return tuple(solve(matrix, loads, options))
    laden = [part.nodes for load in loads for part in load.components.values()]
    warn_connections(call.session, call.span, "RESO", matrix, laden=laden)
    known = np.concatenate([np.zeros(0, np.int64), *(r.multipliers for r in matrix.relations)])
    for load in loads:
        if count := imposed_outside(load, known):
            call.warn("operators.statics.imposed-elsewhere", count=count)
    solutions = tuple(solve(matrix, loads, options))
    for load, solution in zip(loads, solutions, strict=True):
        down = load.components.get("FZ" if workspace(call.session).dimension == 3 else "FY")
        down = load.components.get("FZ") if down is None else down  # of revolution
        if down is not None:
            warn_of_weight(call, matrix, (), matrix.table.resolve(down.nodes), -down.values)
        workspace(call.session).origins[solution] = first_cells(matrix), None
        if is_anywhere(load) and not is_anywhere(solution):
            call.warn("operators.statics.nothing-moves")
        judged = workspace(call.session).units is not None
        if judged or "FLX" not in load.components:  # what is imposed may be a unit
            for told in far(solution, NOT_SMALL if judged else FAR):
                call.warn("operators.statics.moves-far", **told)
    _warn_condition(call, matrix, options)
    return solutions


def first_cells(matrix: Matrix) -> list[ElementMatrices]:
    """Some element matrices of each zone: what fields keep of the matrix they were found with."""
    zoned = [b for b in matrix.blocks if b.zone is not None]
    few = [(b, b.raw_nodes[:_FIRST].copy(), b.values[:_FIRST].copy()) for b in zoned]
    return [replace(b, raw_nodes=nodes, values=values) for b, nodes, values in few]


def tell_other_stiffness(call: Call, u: NodeField, model: Model, material: CellField) -> None:
    """Warn where parameters make other matrices of the first cells than those u was found with."""
    found, _ = workspace(call.session).origins.get(u, ((), None))
    for zone in model.zones if found else ():
        given = [b for b in found if same_elements(b.zone, zone)]
        if len(given) != 1 or {"PLASTIQUE", "ENDOMMAGEMENT"} & {*zone.behaviour}:
            continue
        cells = replace(zone.cells, raw=zone.cells.raw[:_FIRST], _resolved=[])
        part = replace(zone, cells=cells)
        if off := families.unlike([replace(given[0], zone=part)], part, material):
            told = {"node": zone.cells.nodes.told(int(zone.cells.raw[0, 0])), "off": off}
            call.warn("operators.statics.stress-of-others", **told)


def warn_of_weight(
    call: Call, matrix: Matrix, zones: Iterable[Zone], nodes: IntArray, pressing: FloatArray
) -> None:
    """Warn of bodies that forces (m,) at nodes (m,) press down by twice the weight of MASS."""
    masses = workspace(call.session).masses.values()
    if masses and not call.session.warned("operators.dynamics.weight-twice"):
        from ssilang.operators.dynamics.standing import weights_twice

        for code, told in weights_twice(masses, matrix, zones, nodes, pressing):
            call.warn(code, **told)


def far(solution: NodeField, most: float) -> Iterator[dict[str, float]]:
    """Displacements of more than so many times the size of the mesh."""
    parts = [p for n, p in solution.components.items() if n in ("UX", "UY", "UZ", "UR")]
    way = max((float(np.abs(p.values).max(initial=0.0)) for p in parts), default=0.0)
    if way > 0.0:
        nodes = np.concatenate([p.nodes for p in parts])
        size = float(np.ptp(solution.table.coordinates[nodes], axis=0).max())
        if way > most * size > 0.0:
            yield {"way": way, "size": size, "times": way / size}


def is_anywhere(field: NodeField) -> bool:
    """Whether a field has other values than zeros, multipliers left out."""
    return any(p.values.any() for n, p in field.components.items() if n != "LX")


def _warn_condition(call: Call, matrix: Matrix, options: SolveOptions) -> None:
    """Warn, once a matrix, of stiffnesses that differ so much that few digits are left."""
    from ssilang.kernel.statics.conditioning import FEW_DIGITS, system_extremes

    if "condition" in matrix.cache:
        return
    system = linear_system(matrix, options)
    line = {"unknowns": system.numbering.size, "solver": system.inverse.factor.name}
    call.session.statistics.setdefault("systems", []).append(line)
    found = system_extremes(system, matrix)
    matrix.cache["condition"] = found
    if found is None or found.number <= FEW_DIGITS:
        return
    (stiff, most), (soft, least) = found.stiffest, found.softest
    digits = max(0, round(16 - math.log10(found.number)))
    call.session.warn(
        "operators.statics.badly-conditioned", call.span, operator="RESO", number=found.number,
        digits=digits, most=most, stiff=stiff, least=least, soft=soft,
    )  # fmt: skip


@_reso.form(said("ENSE"), _MATRIX, _PRECISION, _LOADS, *_WORDS, gives=ANY)
def with_motions(
    call: Call, matrix: Matrix, precision: float | None, loads: tuple[NodeField, ...], **words: Any
) -> tuple[Any, ...]:
    """Solutions, then the number of free motions and the nodes that pin them.

    Where the loads drive a free motion, the motion itself is given.
    """
    options = _options(call, words)
    motions, pins = free_motion_fields(matrix, options)
    fields = []
    for load in loads:
        try:
            fields += solve(matrix, [load], replace(options, project=False))
        except SingularMatrixError:
            fields.append(motions[0])
    nodes = Mesh.of(matrix.table, "POI1", pins[:, None])
    return (*fields, len(motions), nodes)


@_reso.form(_MATRIX, arg("loads", "LISTCHPO", en="second members"), *_WORDS)
def solved_list(call: Call, matrix: Matrix, loads: ListChpo, **words: Any) -> ListChpo:
    """One solution for each second member of a list."""
    fields: list[Any] = loads.values
    return ListChpo(tuple(solve(matrix, fields, _options(call, words))))


@_reso.form(_MATRIX, arg("table", "TABLE", en="table LIAISONS_STATIQUES"), *_WORDS)
def solved_links(call: Call, matrix: Matrix, table: Table, **words: Any) -> Table:
    """Static shapes of a LIAISONS_STATIQUES table: DEFORMEE and POINT_REPERE of each entry."""
    ws, options = workspace(call.session), _options(call, words)
    if not (links := static_links(table)):
        raise call.error("operators.statics.no-numbered-entry", table)
    for entry, _, _ in links:
        force, block = entry.get("FORCE"), entry.get("BLOCAGE")
        if not isinstance(force, NodeField):
            raise call.error("operators.statics.entry-has-no-force", table)
        whole = matrix
        if isinstance(block, Matrix):
            known = {id(r) for r in matrix.relations}
            extra = tuple(r for r in block.relations if id(r) not in known)
            if extra:
                whole = Matrix(matrix.table, matrix.blocks, (*matrix.relations, *extra))
        entry.set("DEFORMEE", solve(whole, [force], options)[0])
        mark = ws.nodes.add(ws.nodes.coordinates[:1] * 0.0)
        entry.set("POINT_REPERE", Point(ws.nodes, int(mark[0])))
    return table


@operator("REAC", family="solve", full_name="REACTION", gives=Like("solution"))
def _reac(
    call: Call,
    matrix: Matrix = _MATRIX,
    solution: NodeField | Table = Arg("CHPOINT", "TABLE", en="solution, or table of shapes"),
) -> NodeField | Table:
    if not matrix.relations:
        call.warn("operators.statics.no-conditions", matrix)
    if isinstance(solution, NodeField):
        return reactions(matrix, solution)
    for entry, shape, index in _shapes(solution):
        entry.set(index, reactions(matrix, shape))
    return solution


_REACTIONS = {
    "DEFORMEE_MODALE": "REACTION_MODALE",
    "DEFORMEE": "REACTION",
    "DEPLACEMENT": "REACTION",
}
"""Of a shape's index, that under which its reaction is put."""


def _shapes(table: Table) -> list[tuple[Table, NodeField, str]]:
    """Sub-tables that hold a shape: entry, shape, index under which its reaction is put."""
    found = []
    for _, entry in table.items():
        if not isinstance(entry, Table):
            continue
        for name, reaction in _REACTIONS.items():
            shape = entry.get(name)
            if isinstance(shape, NodeField):
                found.append((entry, shape, reaction))
                break
        else:
            found += _shapes(entry)
    return found


operator("DIAG", _MATRIX, family="solve", full_name="DIAGNEG")(negative_eigenvalues)
