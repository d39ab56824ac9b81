"""Signs, ET, EXTR, DIME, REDU, CHAN, LIST, XTMX, YTMX, DIMN on matrices (RIGIDITE)."""

from ssilang.kernel.matrices import submatrices as parts
from ssilang.kernel.matrices.assembly import assemble, field_to_vector, numbering_of
from ssilang.kernel.matrices.condensation import dependence
from ssilang.kernel.matrices.matrix import imaginary as imaginary_of
from ssilang.kernel.statics.linear import linear_system, product
from ssilang.operators.dispatch import CHAN, DIFF, DIME, EXTR, INTE, REDU, listing, union
from ssilang.operators.numbers.arithmetic import rule, rule_with_call
from ssilang.operators.prelude import *
from ssilang.operators.tables.soundness import flaw_of


@INTE.form()
def intersection_of_matrices(
    first: Matrix = Main("RIGIDITE", en="matrix"), second: Matrix = Arg("RIGIDITE", en="matrix")
) -> Matrix:
    """What two matrices were both put together of."""
    return _parts_of(first, second, True)


@DIFF.form()
def difference_of_matrices(
    first: Matrix = Main("RIGIDITE", en="matrix"), second: Matrix = Arg("RIGIDITE", en="matrix")
) -> Matrix:
    """What one of two matrices alone was put together of."""
    return parts.together(_parts_of(first, second, False), _parts_of(second, first, False))


def _parts_of(one: Matrix, other: Matrix, common: bool) -> Matrix:
    """Parts of a matrix that are parts of another one too, or that are none of it."""
    blocks = tuple(b for b in one.blocks if any(b is c for c in other.blocks) is common)
    relations = tuple(r for r in one.relations if any(r is c for c in other.relations) is common)
    return Matrix(one.table, blocks, relations, one.kind)


# --- signs -----------------------------------------------------------------------------------


@rule("* /", "RIGIDITE", "FLOTTANT")
@rule("* /", "RIGIDITE", "ENTIER")
def _scale(sign: str, matrix: Matrix, number: float) -> Matrix:
    return matrix.scaled(float(number) if sign == "*" else 1.0 / number)


@rule("*", "FLOTTANT", "RIGIDITE")
@rule("*", "ENTIER", "RIGIDITE")
def _scale_left(_sign: str, number: float, matrix: Matrix) -> Matrix:
    return matrix.scaled(float(number))


@rule("**", "RIGIDITE", "FLOTTANT")
@rule("**", "RIGIDITE", "ENTIER")
def _power(_sign: str, matrix: Matrix, power: float) -> Matrix:
    """Terms of the elements' matrices, each to a power; terms that are zero stay."""
    made = []
    for block in matrix.blocks:
        v = block.values
        if power != int(power) and (v < 0).any():
            raise FieldError(
                "operators.matrices.negative-terms-have-no-power", smallest=v.min(), power=power
            )
        raised = np.where(v == 0.0, 0.0, np.where(v == 0.0, 1.0, v) ** float(power))
        made.append(replace(block, values=raised, zone=None))
    return Matrix(matrix.table, tuple(made), matrix.relations, matrix.kind)


@rule_with_call("*", "RIGIDITE", "CHPOINT")
@rule_with_call("*", "CHPOINT", "RIGIDITE")
def _times_field(call: Call, _sign: str, left: Any, right: Any) -> NodeField:
    matrix, field = (left, right) if isinstance(left, Matrix) else (right, left)
    _warn_of_other_names(call, matrix, field)
    made = product(matrix, field)
    if flaw_of(made) and not flaw_of(field):  # sparse products raise no flag
        call.warn("operators.numbers.past-reals", sign="*")
    if matrix.kind.startswith("MASS"):
        workspace(call.session).origins[made] = (), field
    return made


def _warn_of_other_names(call: Call, matrix: Matrix, field: NodeField) -> None:
    """Warn of a product that is zero since no component bears the name of an unknown."""
    known = {name for block in matrix.blocks for name in block.unknowns}
    names = {name for name, part in field.components.items() if part.values.any()}
    if matrix.blocks and names and names.isdisjoint({*known, *_MULTIPLIERS}):
        call.warn(
            "operators.matrices.product-of-other-names", names=sorted(names), known=sorted(known)
        )


_MULTIPLIERS = ("LX", "FLX")


@rule("+", "RIGIDITE", "RIGIDITE")
def _sum(_sign: str, left: Matrix, right: Matrix) -> Matrix:
    return parts.together(left, right)


@rule("-", "RIGIDITE", "RIGIDITE")
def _difference(_sign: str, left: Matrix, right: Matrix) -> Matrix:
    return parts.together(left, right.scaled(-1.0))


union(("RIGIDITE", "RIGIDITE"))(parts.together)


# --- parts -----------------------------------------------------------------------------------


def _points(matrix: Matrix, nodes: IntArray) -> Mesh:
    return Mesh.of(matrix.table, "POI1", nodes[:, None])


def _mesh_of(matrix: Matrix, part: str | None) -> Mesh:
    if part == "NOMU":
        return parts.support_mesh(matrix)
    if part is not None:
        return _points(matrix, parts.multiplier_nodes(matrix, part == "UNIL"))
    whole = parts.support_mesh(matrix)
    points = parts.multiplier_nodes(matrix)
    if len(points) == 0:
        return whole
    return Mesh(matrix.table, (*whole.blocks, *_points(matrix, points).blocks))


def _rigi_of(matrix: Matrix, part: str) -> Matrix:
    if part == "NOMU":
        return Matrix(matrix.table, matrix.blocks, (), matrix.kind)
    if part == "MULT":
        return Matrix(matrix.table, (), matrix.relations)
    kept = [parts.chosen_rows(r, r.sense != 0) for r in matrix.relations]
    return Matrix(matrix.table, (), tuple(r for r in kept if len(r)))


_EXTRACTED: dict[str, Callable[[Matrix, Chosen], Mesh | Matrix | ListMots | NodeField]] = {
    "MAIL": lambda matrix, what: _mesh_of(matrix, what["part"]),
    "RIGI": lambda matrix, what: _rigi_of(matrix, what["part"]),
    "COMP": lambda matrix, what: ListMots(parts.unknown_names(matrix, what["dual"])),
    "DIAG": lambda matrix, what: parts.diagonal(matrix),
    "SYME": lambda matrix, what: parts.symmetric_part(matrix, 1.0),
    "ANTI": lambda matrix, what: parts.symmetric_part(matrix, -1.0),
}


_PART = choice(
    "part", ("NOMU", "MULT", "UNIL"), en="without multipliers, of conditions, or of unilateral ones"
)
_MATRIX = main("matrix", "RIGIDITE", en="matrix")


@EXTR.form(
    gives=by("what", {"MAIL": "MAILLAGE", "COMP": "LISTMOTS", "DIAG": "CHPOINT"}, "RIGIDITE")
)
def extract_from_matrix(
    call: Call,
    matrix: Matrix = _MATRIX,
    what: Chosen = Cases(
        {
            "MAIL": [_PART],
            "RIGI": [_PART],
            "COMP": [flag("dual", "DUAL", en="of the equations")],
            "DIAG": [],
            "SYME": [],
            "ANTI": [],
        },
        optional=False,
        en="mesh, matrices or conditions, names of unknowns, diagonal, symmetric or "
        "antisymmetric part",
    ),
) -> Mesh | Matrix | ListMots | NodeField:
    """A part of a matrix."""
    if what.word == "RIGI" and what["part"] is None:
        raise call.error("operators.matrices.extr-rigi-wants-word")
    return _EXTRACTED[what.word](matrix, what)


@EXTR.form()
def extract_terms(
    matrix: Matrix = _MATRIX,
    unknowns: ListMots = Arg("LISTMOTS", en="unknowns"),
    equations: ListMots = Arg("LISTMOTS", en="equations"),
) -> Matrix:
    """The terms of some unknowns and equations."""
    primal, dual = ({str(w).upper().rstrip() for w in n.values} for n in (unknowns, equations))
    return parts.named_part(matrix, primal, dual)


@EXTR.form()
def extract_term(
    call: Call,
    matrix: Matrix = _MATRIX,
    unknown: str = Arg("MOT", kind="component", en="unknown"),
    equation: str | None = Opt("MOT", kind="component", en="equation"),
) -> Matrix:
    """The terms of one unknown and one equation."""
    if equation is None:
        raise call.error("operators.matrices.extr-wants-word-or-names", matrix, words=_EXTRACTED)
    return parts.named_part(matrix, {unknown.upper().rstrip()}, {equation.upper().rstrip()})


@REDU.form()
def reduced(matrix: Matrix = _MATRIX, mesh: Mesh = Arg("MAILLAGE", en="cells that stay")) -> Matrix:
    """A matrix on fewer cells."""
    return parts.on_mesh(matrix, mesh)


_CHANGED = arg("matrix", "RIGIDITE", en="matrix")


@CHAN.form(said("TYPE"), of=("RIGIDITE",))
def change_kind(matrix: Matrix = _CHANGED, kind: str = Arg("MOT", en="its new kind")) -> Matrix:
    """Another kind."""
    name = kind.upper().rstrip()
    blocks = tuple(replace(b, kind=name, zone=None) for b in matrix.blocks)
    return Matrix(matrix.table, blocks, matrix.relations, name)


@CHAN.form(said("DEPE"), of=("RIGIDITE",))
def dependent(matrix: Matrix = _CHANGED) -> Matrix:
    """The matrix itself."""
    return matrix


@CHAN.form(said("COND"), of=("RIGIDITE",))
def condensing(
    matrix: Matrix = Arg("RIGIDITE", en="relations, alone or with a stiffness"),
) -> tuple[Matrix, Matrix]:
    """Matrix of dependence and its dual."""
    return dependence(matrix)


_SHAPE = (
    choice("shape", ("SYME", "ANTI", "QUEL"), en="symmetric, antisymmetric or any (default)"),
    flag("own", "DUPL", en="each condition gets a multiplier of its own"),
)
_FOUR = (
    ("old_unknowns", "unknowns"),
    ("new_unknowns", "their new names"),
    ("old_equations", "equations"),
    ("new_equations", "their new names"),
)


@CHAN.form(
    said("INCO"),
    choice("imaginary", ("COMP",), optional=False, en="an I (imaginary part) before all names"),
    _CHANGED,
    *_SHAPE,
    of=("RIGIDITE",),
)
def imaginary_names(
    call: Call, imaginary: bool, matrix: Matrix, shape: str | None, own: bool
) -> Matrix:
    """Names of imaginary parts."""
    if matrix.relations:
        raise call.error("operators.matrices.conditions-not-imaginary", matrix)
    primal = {u: imaginary_of(u) for b in matrix.blocks for u in b.unknowns}
    dual = {d: imaginary_of(d) for b in matrix.blocks for d in b.duals}
    return _renamed(matrix, primal, dual, shape, own)


@CHAN.form(
    said("INCO"),
    _CHANGED,
    *(arg(name, "MOT", kind="component", en=en) for name, en in _FOUR),
    *_SHAPE,
    of=("RIGIDITE",),
)
@CHAN.form(
    said("INCO"),
    _CHANGED,
    *(arg(name, "LISTMOTS", en=en) for name, en in _FOUR),
    *_SHAPE,
    of=("RIGIDITE",),
)
def other_names(
    call: Call, matrix: Matrix, shape: str | None, own: bool, **names: ListMots | str
) -> Matrix:
    """Other names."""
    given = [names[name] for name, _ in _FOUR]
    words = [g.values if isinstance(g, ListMots) else [g.upper()] for g in given]
    lists = [[str(w).rstrip() for w in own] for own in words]
    return _renamed(matrix, *_name_changes(call, matrix, lists), shape, own)


def _renamed(
    matrix: Matrix, primal: dict[str, str], dual: dict[str, str], shape: str | None, own: bool
) -> Matrix:
    made = parts.renamed(matrix, primal, dual, shape == "SYME")
    return parts.with_own_multipliers(made) if own else made


def _name_changes(
    call: Call, matrix: Matrix, lists: list[list[str]]
) -> tuple[dict[str, str], dict[str, str]]:
    """Old names of unknowns and of equations with the new ones."""
    if len(lists[0]) != len(lists[1]) or len(lists[2]) != len(lists[3]):
        raise call.error("operators.matrices.inco-wants-four-lists")
    equations = {d for b in matrix.blocks for d in b.duals}
    equations |= {dual_of(u) for r in matrix.relations for u in (*r.unknowns, "LX")}
    if set(lists[1]) <= equations and len(lists[0]) == len(lists[2]):
        # the notice's example: old unknowns, old equations, new unknowns, new equations
        lists[1], lists[2] = lists[2], lists[1]
    primal = dict(zip(lists[0], lists[1], strict=True))
    if primal.get("LX", "LX") != "LX":
        raise call.error("operators.matrices.multiplier-keeps-its-name")
    return primal, dict(zip(lists[2], lists[3], strict=True))


@listing("RIGIDITE")
def _listed(matrix: Matrix, short: bool, say: Teller) -> str:
    return "\n".join(parts.listed(matrix, say, not short))


# --- quadratic forms -------------------------------------------------------------------------


def _form(call: Call, left: NodeField, matrix: Matrix, right: NodeField) -> float:
    _warn_of_other_names(call, matrix, left)
    numbering = numbering_of(matrix)
    y = field_to_vector(left, numbering, dual=False)
    x = field_to_vector(right, numbering, dual=False)
    return float(y @ (assemble(matrix, numbering) @ x))


@operator("XTMX", family="matrix")
def xtmx(
    call: Call, field: NodeField = Arg("CHPOINT", en="X"), matrix: Matrix = Arg("RIGIDITE", en="M")
) -> float:
    return _form(call, field, matrix, field)


@operator("YTMX", family="matrix")
def ytmx(
    call: Call,
    right: NodeField = Arg("CHPOINT", en="X"),
    left: NodeField = Arg("CHPOINT", en="Y"),
    matrix: Matrix = Arg("RIGIDITE", en="M"),
) -> float:
    return _form(call, left, matrix, right)


@operator("DIMN", family="matrix", full_name="DIMNOYAU")
def dimn(matrix: Matrix = Arg("RIGIDITE", en="matrix")) -> int:
    """Dimension of the kernel."""
    return int(linear_system(matrix).free_motions.shape[1])


@DIME.form()
def unknowns(matrix: Matrix = Main("RIGIDITE", en="matrix")) -> int:
    """Number of unknowns."""
    return numbering_of(matrix).size
