"""RELA: linear relations between unknowns of several nodes."""

from ssilang.kernel.matrices import relations as made
from ssilang.kernel.matrices import tied_relations as tied
from ssilang.kernel.matrices.relations import Term
from ssilang.operators.matrices.supports import as_matrix, warn_of_foreign
from ssilang.operators.mesh.changes.cells import tie_relations
from ssilang.operators.prelude import *

_SENSE = {"MINI": 1, "MAXI": -1}


@dataclass
class _Sum:
    """One term of `RELA`: sign and number, what moves, along what, where."""

    factor: float = 1.0
    unknown: str = ""
    direction: Point | None = None
    support: Point | Mesh | None = None


# --- sums of terms ---------------------------------------------------------------------------


def _spelled(call: Call, term: _Sum) -> list[list[Term]]:
    """The term by unknowns: one list of terms for each relation that it makes."""
    assert term.support is not None
    mode = workspace(call.session).mode
    nodes = term.support.node_ids
    groups = {"DEPL": made.in_space(mode), "ROTA": made.rotations(mode)}
    names = groups.get(term.unknown, (term.unknown,))
    if term.direction is None:
        return [[Term(term.factor, name, nodes)] for name in names]
    whole = term.direction.coordinates
    vector = whole[2:] if len(names) == 1 else whole[: len(names)]
    length = length_of(call, term.direction, vector)
    return [
        [
            Term(term.factor * float(v) / length, name, nodes)
            for name, v in zip(names, vector, strict=True)
            if v != 0.0
        ]
    ]


def length_of(call: Call, direction: Point, vector: FloatArray) -> float:
    """Length of the part of a direction that counts; it must have one."""
    length = float((vector @ vector) ** 0.5)
    if length == 0.0:
        raise call.error("operators.matrices.direction-without-length", direction)
    return length


def _read_terms(call: Call) -> list[_Sum]:
    """Terms `(+|-) (number) unknown ('DIRE' vector) mesh`; the mesh may come first."""
    terms: list[_Sum] = []
    current = _Sum()
    while call.operands:
        value = call.operands[0].value
        if isinstance(value, Procedure):
            value = Mot(value.name)
        if not _take(call, current, value):
            break
        if current.support is not None and current.unknown:
            terms.append(current)
            current = _Sum()
    if not terms or current.unknown or current.support is not None:
        raise call.missing(("MAILLAGE", "POINT") if current.unknown else ("MOT",))
    return terms


def _take(call: Call, term: _Sum, value: object) -> bool:
    """Put the first operand into the term; False if it does not belong to a relation."""
    if isinstance(value, str):
        word = value.upper().rstrip()
        if word in ("+", "-"):
            term.factor *= -1.0 if word == "-" else 1.0
        elif word[:4] == "DIRE" and term.unknown in ("DEPL", "ROTA"):
            _consume(call)
            term.direction = call.required("POINT")
            return True
        elif term.unknown:
            return False
        else:
            term.unknown = word if word[:4] not in ("DEPL", "ROTA") else word[:4]
    elif isinstance(value, int | float) and not isinstance(value, bool):
        term.factor *= float(value)
    elif isinstance(value, Point | Mesh) and term.support is None:
        term.support = value
    else:
        return False
    _consume(call)
    return True


def _consume(call: Call) -> None:
    call.used.append(call.operands.pop(0))


# --- a field of coefficients -----------------------------------------------------------------


_SIDE = choice("sense", tuple(_SENSE), en="the sum stays at or above the value, or at or below")


@operator("RELA", family="relations", full_name="RELATION")
def rela(
    field: NodeField = Arg("CHPOINT", en="factors of the unknowns"),
    sense: str | None = _SIDE,
    dual: NodeField | None = Key("DUAL", "CHPOINT", en="force on the body for a multiplier of one"),
) -> Matrix:
    """One relation, from a field of factors."""
    side = _SENSE.get(sense or "", 0)
    rows = made.from_field(field, side)
    if dual is None:
        return as_matrix(rows)
    # the field is the force on the body for LX = 1, and K u + D^T LX = F
    reaction = made.from_field(made.primal_names(dual), side, rows.raw_multipliers)
    return as_matrix(replace(rows, dual=replace(reaction, coefficients=-reaction.coefficients)))


@rela.form()
def of_hanging_nodes(
    call: Call,
    model: Model = Arg("MMODEL", en="model with hanging nodes"),
    sense: str | None = _SIDE,
) -> Matrix | None:
    """Ties of the hanging nodes of a model."""
    return tie_relations(model, workspace(call.session).nodes)


# --- options ---------------------------------------------------------------------------------


_UNKNOWNS = opt("words", "LISTMOTS", kind="component", en="unknowns, else all displacements")
_TOLERANCE = opt(
    "tolerance",
    "FLOTTANT",
    range=NOT_NEGATIVE,
    default=1e-5,
    en="how far outside of a cell a node counts, relative to the cell",
)
_GUEST = arg("guest", "MAILLAGE", "POINT", en="nodes to tie")
_HOST = arg("host", "MAILLAGE", en="cells that hold them")


@rela.form(said("CORI"))
def rigid_with_rotations(
    call: Call,
    turning: bool = Choice(("ROTA",), optional=False, en="nodes that turn"),
    moving: bool = Flag("DEPL", en="nodes that move"),
    unchecked: bool = Flag("NOVERIF", en="accepted"),
    mesh: Mesh | Point = Arg(
        "MAILLAGE",
        "POINT",
        en="GEO1: nodes of the body that have rotations, or its centre; the first carries it",
    ),
    rest: Mesh | Point | None = Opt(
        "MAILLAGE", "POINT", en="GEO2: its nodes without rotations, such as the side of a solid"
    ),
) -> Matrix:
    """A rigid body whose nodes turn."""
    ws = workspace(call.session)
    names, turns = made.in_space(ws.mode), made.rotations(ws.mode)
    nodes = mesh.node_ids
    following = nodes[:0] if rest is None else rest.node_ids
    return as_matrix(tied.rigid_with_rotations(ws.nodes, nodes, following, names, turns))


@rela.form(said("CORI"))
def rigid(
    call: Call,
    moving: bool = Flag("DEPL", en="nodes that move"),
    unchecked: bool = Flag("NOVERIF", en="without a check that the nodes hold the body"),
    mesh: Mesh = Arg(
        "MAILLAGE",
        en="GEO1: the body, four nodes not in a plane or more (in the plane three not on a line)",
    ),
) -> Matrix:
    """A rigid body, by distances."""
    ws = workspace(call.session)
    names = made.in_space(ws.mode)
    return as_matrix(tied.rigid_by_distances(ws.nodes, mesh.node_ids, names, not unchecked))


@rela.form(said("ENSE"))
def together(
    call: Call,
    unknown: str = Arg("MOT", kind="component", en="unknown"),
    mesh: Mesh = Arg("MAILLAGE", en="nodes"),
) -> Matrix:
    """The same value at all nodes."""
    ws = workspace(call.session)
    name = unknown.upper().rstrip()
    warn_of_foreign(call, [name])
    return as_matrix(tied.same_value(ws.nodes, mesh.node_ids, name))


@rela.form(said("ACCRO"))
def hooked_on_model(
    call: Call,
    strong: bool = Choice(("FORT",), optional=False, en="onto a model"),
    host: Model = Arg("MMODEL", en="model that holds them"),
    guest: Mesh | Model | Point = Arg("MAILLAGE", "MMODEL", "POINT", en="nodes to tie"),
) -> Matrix:
    """Nodes hooked onto the cells of a model."""
    names = made.in_space(workspace(call.session).mode)
    nodes = (guest.mesh if isinstance(guest, Model) else guest).node_ids
    return as_matrix(tied.hooked(nodes, host.mesh, names, 1e-5))


@rela.form(said("ACCRO"))
def hooked(
    call: Call,
    guest: Mesh | Point = _GUEST,
    host: Mesh = _HOST,
    words: ListMots | None = _UNKNOWNS,
    tolerance: float = _TOLERANCE,
) -> Matrix:
    """Nodes hooked onto the cells that they lie in."""
    return as_matrix(tied.hooked(guest.node_ids, host, _unknowns(call, words), tolerance))


@rela.form(said("GLISSANT"))
def sliding(
    call: Call,
    guest: Mesh | Point = _GUEST,
    host: Mesh = _HOST,
    words: ListMots | None = _UNKNOWNS,
    tolerance: float = _TOLERANCE,
) -> Matrix:
    """A line that slides in cells, along itself."""
    if not isinstance(guest, Mesh):
        raise call.error("operators.matrices.line-slides-not-point", guest)
    return as_matrix(tied.sliding(guest, host, _unknowns(call, words), tolerance))


def _unknowns(call: Call, words: ListMots | None) -> tuple[str, ...]:
    if words is None:
        return made.in_space(workspace(call.session).mode)
    return tuple(str(w).rstrip() for w in words.values)


@rela.form(said("MILI"))
def middles(
    call: Call,
    words: ListMots | None = _UNKNOWNS,
    mesh: Mesh = Arg("MAILLAGE", en="quadratic cells"),
) -> Matrix:
    """Middle nodes held between the corners."""
    mode = workspace(call.session).mode
    names = made.translations(mode) if words is None else [str(w).rstrip() for w in words.values]
    return as_matrix(tied.middle_nodes(mesh, names))


@rela.form(
    _SIDE,
    each(
        "terms",
        opt("factor", "FLOTTANT", en="factor", range=ANY_NUMBER),
        arg("unknown", "MOT", kind="component", en="unknown"),
        arg("support", "MAILLAGE", "POINT", en="nodes"),
    ),
    by_hand="its terms are signs, numbers, words and meshes in any order",
)
def sums(call: Call) -> Matrix:
    """Sums of terms."""
    sense = 0
    while (word := call.keyword(tuple(_SENSE))) is not None:
        sense = _SENSE[word]
    terms = _read_terms(call)
    warn_of_foreign(call, [t.unknown for t in terms])
    ws = workspace(call.session)
    lists = [_spelled(call, t) for t in terms]
    count = max(len(rows) for rows in lists)
    if any(len(rows) not in (1, count) for rows in lists):
        raise call.error("operators.matrices.terms-do-not-add")
    alone = [t.unknown for t, rows in zip(terms, lists, strict=True) if len(rows) < count]
    if alone:
        call.warn("operators.matrices.terms-of-other-counts", names=alone, count=count)
    parts = []
    for i in range(count):
        row = [term for rows in lists for term in rows[i if len(rows) > 1 else 0]]
        parts.append(made.relation_rows(ws.nodes, row, sense))
    rows = made.joined(parts)
    empty = made.saying_nothing(rows)
    if empty.size:
        told = ws.nodes.told(int(rows.nodes[rows.row_start[empty[0]]]))
        call.warn("operators.matrices.terms-cancel", count=int(empty.size), node=told)
    return as_matrix(rows)
