"""RELA: linear relations between unknowns of several nodes."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import relations as made
from ssilang.kernel.matrices import tied_relations as tied
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.matrices.relations import Term
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Mot, Procedure
from ssilang.operators.matrices.supports import as_matrix, nodes_of
from ssilang.operators.mesh.changes.refining import tie_relations
from ssilang.operators.workspace import workspace

_SENSE = {"MINI": 1, "MAXI": -1}


@dataclass
class _Sum:
    """One term of `RELA`: sign and number, what moves, along what, where."""

    factor: float = 1.0
    unknown: str = ""
    direction: Point | None = None
    support: Point | Mesh | None = None


def _rela(call: Call) -> Matrix | None:
    sense = 0
    while (word := call.keyword((*_SENSE, *_OPTIONS))) is not None:
        if word not in _SENSE:
            return _OPTIONS[word](call)
        sense = _SENSE[word]
    field = call.read("CHPOINT")
    if field is not None:
        return as_matrix(_weighted(call, field.value, sense))
    model = call.read("MMODEL")
    if model is not None:
        return tie_relations(model.value, workspace(call.session).nodes)
    return _sums(call, sense)


# --- sums of terms ---------------------------------------------------------------------------


def _sums(call: Call, sense: int) -> Matrix:
    terms = _read_terms(call)
    ws = workspace(call.session)
    lists = [_spelled(call, t) for t in terms]
    count = max(len(rows) for rows in lists)
    if any(len(rows) not in (1, count) for rows in lists):
        raise call.error("operators.matrices.terms-do-not-add")
    parts = []
    for i in range(count):
        row = [term for rows in lists for term in rows[i if len(rows) > 1 else 0]]
        parts.append(made.relation_rows(ws.nodes, row, sense))
    return as_matrix(made.joined(parts))


def _spelled(call: Call, term: _Sum) -> list[list[Term]]:
    """The term by unknowns: one list of terms for each relation that it makes."""
    if term.support is None:
        raise call.error("operators.matrices.term-without-mesh")
    mode = workspace(call.session).mode
    nodes = nodes_of(term.support)
    groups = {"DEPL": made.in_space(mode), "ROTA": made.rotations(mode)}
    names = groups.get(term.unknown, (term.unknown,))
    if term.direction is None:
        return [[Term(term.factor, name, nodes)] for name in names]
    whole = term.direction.coordinates
    vector = whole[2:] if len(names) == 1 else whole[: len(names)]
    length = float((vector @ vector) ** 0.5)
    if length == 0.0:
        raise call.error("operators.matrices.direction-without-length", term.direction)
    return [
        [
            Term(term.factor * float(v) / length, name, nodes)
            for name, v in zip(names, vector, strict=True)
            if v != 0.0
        ]
    ]


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


def _weighted(call: Call, field: NodeField, sense: int) -> Relations:
    rows = made.from_field(field, sense)
    if call.keyword(("DUAL",)) is None:
        return rows
    dual: NodeField = call.required("CHPOINT", after=call.keyword_end)
    # the field is the force on the body for LX = 1, and K u + D^T LX = F
    reaction = made.from_field(made.primal_names(dual), sense, rows.raw_multipliers)
    return replace(rows, dual=replace(reaction, coefficients=-reaction.coefficients))


# --- options ---------------------------------------------------------------------------------


def _rigid(call: Call) -> Matrix:
    ws = workspace(call.session)
    names = made.in_space(ws.mode)
    words = set()
    while (word := call.keyword(("DEPL", "ROTA", "NOVERIF"))) is not None:
        words.add(word)
    if "ROTA" not in words:
        mesh, check = call.required("MAILLAGE"), "NOVERIF" not in words
        return as_matrix(tied.rigid_by_distances(ws.nodes, mesh.node_ids, names, check))
    turning = nodes_of(call.required("MAILLAGE", "POINT"))
    rest = call.read("MAILLAGE", "POINT")
    following = turning[:0] if rest is None else nodes_of(rest.value)
    turns = made.rotations(ws.mode)
    return as_matrix(tied.rigid_with_rotations(ws.nodes, turning, following, names, turns))


def _together(call: Call) -> Matrix:
    ws = workspace(call.session)
    unknown = call.required("MOT", after=call.keyword_end).upper().rstrip()
    mesh = call.required("MAILLAGE")
    return as_matrix(tied.same_value(ws.nodes, mesh.node_ids, unknown))


def _hooked(call: Call) -> Matrix:
    if call.keyword(("FORT",)) is not None:
        host = call.required("MMODEL").mesh
        guest = call.required("MAILLAGE", "MMODEL", "POINT")
        names, tolerance = made.in_space(workspace(call.session).mode), 1e-5
    else:
        guest, host, names, tolerance = _two_meshes(call)
    guest = getattr(guest, "mesh", guest)
    return as_matrix(tied.hooked(nodes_of(guest), host, names, tolerance))


def _sliding(call: Call) -> Matrix:
    guest, host, names, tolerance = _two_meshes(call)
    if not isinstance(guest, Mesh):
        raise call.error("operators.matrices.line-slides-not-point", guest)
    return as_matrix(tied.sliding(guest, host, names, tolerance))


def _two_meshes(call: Call) -> tuple[Mesh, Mesh, tuple[str, ...], float]:
    guest = call.required("MAILLAGE", "POINT")
    host = call.required("MAILLAGE")
    words = call.optional("LISTMOTS")
    mode = workspace(call.session).mode
    names = made.in_space(mode) if words is None else tuple(str(w).rstrip() for w in words.values)
    return guest, host, names, call.optional("FLOTTANT", default=1e-5)


def _middles(call: Call) -> Matrix:
    words = call.optional("LISTMOTS")
    mesh = call.required("MAILLAGE")
    mode = workspace(call.session).mode
    names = made.translations(mode) if words is None else [str(w).rstrip() for w in words.values]
    return as_matrix(tied.middle_nodes(mesh, names))


_OPTIONS = {
    "CORI": _rigid,
    "ENSE": _together,
    "ACCRO": _hooked,
    "GLISSANT": _sliding,
    "MILI": _middles,
}

operator(
    "RELA",
    family="relations",
    full_name="RELATION",
    help=Help(
        "Linear relations, to add to the matrix of a system; DEPI gives their value (default 0). "
        "A sum of terms makes one relation for each node of the meshes (all of the same number of "
        "nodes, or of one); with 'MINI' the sum stays at or above the value, with 'MAXI' at or "
        "below. A field makes one relation, its values times the unknowns of their names; 'DUAL' "
        "gives the force on the body for a multiplier of one. 'CORI' moves a mesh as a rigid body, "
        "'ENSE' gives all nodes the same value, 'ACCRO' hooks nodes onto the cells that they "
        "lie in, 'GLIS' does so but along the line, 'MILI' holds middle nodes between the corners.",
        "Relations linéaires, à ajouter à la matrice d'un système ; DEPI donne leur valeur "
        "(0 par défaut). Une somme de termes fait une relation par nœud des maillages (de même "
        "nombre de nœuds, ou d'un seul) ; avec 'MINI' la somme reste supérieure ou égale à la "
        "valeur, avec 'MAXI' inférieure ou égale. Un champ fait une relation, ses valeurs fois "
        "les inconnues du même nom ; 'DUAL' donne le champ de la réaction. 'CORI' : corps rigide, "
        "'ENSE' : même valeur partout, 'ACCRO' : nœuds accrochés aux éléments qui les "
        "contiennent, 'GLIS' : de même sauf le long de la ligne, 'MILI' : nœuds milieux.",
        "RIG1 = RELA ('MINI' | 'MAXI') (X1) MOT1 GEO1 + | - (X2) MOT2 GEO2 ... ;\n"
        "RIG1 = RELA ... (X1) 'DEPL' | 'ROTA' ('DIRE' VEC1) GEO1 + | - ... ;\n"
        "RIG1 = RELA ('MINI' | 'MAXI') CHPO1 ('DUAL' CHPO2) ;\n"
        "RIG1 = RELA 'CORI' 'DEPL' ('NOVERIF') GEO1 | 'DEPL' 'ROTA' GEO1 (GEO2) ;\n"
        "RIG1 = RELA 'ENSE' MOT1 GEO1 ;\n"
        "RIG1 = RELA GEO1 'ACCRO' | 'GLIS' GEO2 (LISTMOTS1) (FLOT1) ;\n"
        "RIG1 = RELA 'ACCRO' 'FORT' MODL2 GEO1 | MODL1 ;\n"
        "RIG1 = RELA 'MILI' (LISTMOTS1) GEO1 ;\n"
        "RIG1 = RELA MODL1 ;",
        (
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; P2 = 1. 0. ;"
            " R1 = RELA 'MINI' 2. 'UX' P2 - 'UX' P1 ; F1 = DEPI R1 -0.1 ;",
            "OPTI DIME 2 MODE PLAN DEFO ELEM SEG2 ; L1 = DROI 3 (0. 0.) (1. 0.) ;"
            " R1 = RELA 'ENSE' 'UY' L1 ;",
        ),
    ),
    reads_itself=True,
)(_rela)
