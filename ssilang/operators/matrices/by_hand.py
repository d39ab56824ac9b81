"""Matrices of no model: MANU 'RIGI' by hand, MFIL, XXT and ZXXT, CABL."""

from ssilang.kernel.matrices import build
from ssilang.kernel.matrices.by_hand import column, from_columns, square
from ssilang.kernel.mesh.cells import many_noded
from ssilang.operators.dispatch import MANU
from ssilang.operators.prelude import *

_SIGN = {"SYME": 1.0, "ANTI": -1.0, "QUEL": None}


_KIND = key("kind", "TYPE", "MOT", en="kind, such as RIGIDITE (default) or MASSE")


def _sign(words: Sequence[str]) -> Any:
    return choice("sign", words, en="symmetric, antisymmetric or any")


@MANU.form(said("RIGIDITE"))
def repeated(
    call: Call,
    kind: str | None = _KIND,
    support: Mesh | Point = Arg("MAILLAGE", "POINT", en="cells"),
    dual: tuple[ListMots, ...] | None = Key(
        "DUAL", many("names", "LISTMOTS", at_least=1), en="names of the equations"
    ),
    sign: str | None = _sign(("ANTI", "QUEL")),
    primal: tuple[ListMots, ...] = Many(
        "LISTMOTS", at_least=1, kind="component", en="unknowns of a node, or one list a node"
    ),
    rows: tuple[ListReel, ...] = Many(
        "LISTREEL", at_least=1, en="terms row by row, all or the lower triangle", range=ANY_NUMBER
    ),
) -> Matrix:
    """The same matrix on all cells of a mesh."""
    mesh = support.mesh if isinstance(support, Point) else support
    if not mesh.blocks:
        raise call.error("operators.matrices.matrix-mesh-empty", support)
    unknowns = _names(primal)
    nodes = CELL_TYPES[mesh.blocks[0].cell_type].n_nodes if len(unknowns) == 1 else 1
    size = sum(len(n) for n in unknowns) * nodes
    factor = _SIGN[sign or "SYME"]
    terms = square([r.values for r in rows], size, factor)
    equations = None if dual is None else _names(dual)
    return build.repeated_matrix(mesh, unknowns, equations, terms, _kind(kind), factor == 1.0)


@MANU.form(said("RIGIDITE"), of=("CHPOINT",))
def one_column(
    call: Call,
    shape: str = Choice(("COLO", "LIGN"), optional=False, en="column or row"),
    kind: str | None = _KIND,
    sign: str | None = _sign(tuple(_SIGN)),
    partner: tuple[str, str] | None = Key(
        ("DUAL", "PRIM"), "MOT", kind="component", en="its equation, or its unknown"
    ),
    field: NodeField = Arg("CHPOINT", en="terms"),
    point: Point = Arg("POINT", en="node of the unknown"),
    name: str = Arg("MOT", kind="component", en="unknown or equation"),
    names: ListMots | None = Opt("LISTMOTS", en="other names of the field"),
    meant: ListMots | None = Opt("LISTMOTS", en="their unknowns"),
) -> Matrix:
    """The column, or the row, of one unknown."""
    told = name.upper().rstrip()
    other = "" if partner is None else partner[1].upper().rstrip()
    if shape == "COLO":
        unknown, dual = told, other or dual_of(told)
    else:
        unknown, dual = other or told, told if other else dual_of(told)
    old, new = (() if x is None else x.values for x in (names, meant))
    if len(old) != len(new):
        told = {"n_first": len(old), "n_second": len(new)}
        raise call.error("operators.numbers.list-lengths", names, **told)
    pairs = dict(zip(*_names((names, meant)), strict=True)) if names and meant else None
    factor = _SIGN[sign or "QUEL"]
    return column(field, point.node, unknown, dual, _kind(kind), factor, shape == "LIGN", pairs)


@MANU.form(said("RIGIDITE"), of=("CHPOINT",))
def diagonal(
    kind: str | None = _KIND,
    diagonal: bool = Flag("DIAG", en="a diagonal"),
    field: NodeField = Arg("CHPOINT", en="terms of the diagonal"),
) -> Matrix:
    """A diagonal matrix."""
    return build.field_diagonal(field, _kind(kind))


@MANU.form(said("RIGIDITE"), of=("LISTCHPO",))
def modal_matrix(
    kind: str | None = _KIND,
    fields: ListChpo = Arg("LISTCHPO", en="columns"),
    mesh: Mesh = Arg("MAILLAGE", en="points of the modes"),
) -> Matrix:
    """A matrix on modal unknowns, from its columns."""
    columns = [f for f in fields.values if isinstance(f, NodeField)]
    return from_columns(mesh.nodes, mesh.node_ids, columns, _kind(kind, "MONODROM"))


@MANU.form(said("SUPE", "MULT"))
def one_cell(
    call: Call,
    word: str,
    places: tuple[Mesh | Point, ...] = Many("POINT", "MAILLAGE", at_least=1, en="points"),
) -> Mesh:
    """One cell of all the points."""
    nodes = np.concatenate([p.node_ids for p in places])
    if len(np.unique(nodes)) != len(nodes):
        raise call.error("operators.matrices.point-twice-in-cell")
    return Mesh.of(places[0].nodes, many_noded(word, len(nodes)), nodes[None, :])


def _kind(word: str | None, default: str = "RIGIDITE") -> str:
    return default if word is None else word.upper().rstrip()


def _names(lists: Iterable[ListMots]) -> list[tuple[str, ...]]:
    return [tuple(str(w).upper().rstrip() for w in names.values) for names in lists]


@operator("MFIL", family="matrix")
def mfil(
    call: Call,
    weights: NodeField = Arg("CHPOINT", en="weight of each node"),
    radius: float = Opt("FLOTTANT", range=POSITIVE, default=0.0, en="radius", unit="m"),
    power: float = Opt("FLOTTANT", default=1.0, en="power", range=NOT_NEGATIVE),
    least: float = Opt("FLOTTANT", range=NOT_NEGATIVE, default=0.0, en="least weight kept"),
    unknown: str | None = Opt("MOT", kind="component", en="unknown, else SCAL"),
    dual: str | None = Opt("MOT", kind="component", en="dual, else the same"),
) -> Matrix:
    """Weights of a filter."""
    name = "SCAL" if unknown is None else unknown.rstrip()
    return build.filter_weights(
        weights, radius, power, least, name, name if dual is None else dual.rstrip()
    )


@operator("ZXXT", family="matrix")
def zxxt(
    fields: ListChpo = Arg("LISTCHPO", en="fields v"),
    factors: ListReel = Arg("LISTREEL", en="numbers a", range=ANY_NUMBER),
) -> Matrix:
    """Sum of the outer products."""
    vectors = [f for f in fields.values if isinstance(f, NodeField)]
    return build.sum_of_outer_products(vectors, [float(a) for a in factors.values], "AMORTISSEMENT")


@operator("XXT", family="matrix")
def xxt(
    field: NodeField = Arg("CHPOINT", en="v"),
    factor: float = Opt("FLOTTANT", default=1.0, en="a", range=ANY_NUMBER),
) -> Matrix:
    """Outer product."""
    return build.sum_of_outer_products([field], [factor], "RIGIDITE")


@operator("CABL", family="matrix", full_name="CABLE")
def cabl(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="cables"),
    force: float = Arg("FLOTTANT", en="force", unit="N", usual=POSITIVE),
    percent: float = Arg(
        "FLOTTANT", en="lengthening under it", unit="%", range=NOT_ZERO, usual=POSITIVE
    ),
) -> Matrix:
    """Cables."""
    return build.cable_stiffness(mesh, workspace(call.session).dimension, force, percent)
