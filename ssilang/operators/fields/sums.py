"""RESU XTY XTX COMB SOMT: sums over fields; COLI: combinations; DFOU: a harmonic at an angle."""

from collections import defaultdict

from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.fields.signs import paired_names
from ssilang.operators.prelude import *

# ---- measures -----------------------------------------------------------------------------------


@operator("RESU", family="fields", full_name="RESULT")
def resu(call: Call, field: NodeField = Arg("CHPOINT", en="forces, say")) -> NodeField:
    """Sum components over nodes."""
    nodes = field.node_ids
    if not len(nodes):
        raise call.error("operators.fields.field-empty", field)
    here = nodes[:1]
    made = {k: NodeValues(here, np.asarray([v.values.sum()])) for k, v in field.components.items()}
    return NodeField(field.table, made, "DISCRET")


@resu.form(gives="FLOTTANT|ENTIER")
def resu_of_list(
    values: ListReel | ListEnti = Arg(
        "LISTREEL", "LISTENTI", en="numbers to sum", range=ANY_NUMBER
    ),
) -> float | int:
    """Sum of a list."""
    return values.values.sum()


_PAIRED = (
    arg("left", "LISTMOTS", en="components of the first"),
    arg("right", "LISTMOTS", en="components of the second, paired with them"),
)


@operator(
    "XTY",
    arg("first", "CHPOINT", en="first field"),
    arg("second", "CHPOINT", en="second field"),
    *_PAIRED,
    family="fields",
)
def xty(call: Call, first: NodeField, second: NodeField, left: ListMots, right: ListMots) -> float:
    """Scalar product of fields."""
    return _product(first, second, *paired_names(call, left, right, first, second))


@xty.form(
    arg("first", "LISTCHPO", en="first fields"),
    arg("second", "LISTCHPO", en="as many second fields"),
    *_PAIRED,
)
def xty_of_lists(
    call: Call, first: ListChpo, second: ListChpo, left: ListMots, right: ListMots
) -> ListReel:
    """Scalar products of the fields of two lists."""
    names = paired_names(call, left, right)
    if len(first) != len(second):
        told = {"n_first": len(first), "n_second": len(second)}
        raise call.error("operators.fields.field-counts-differ", second, **told)
    pairs: Any = zip(first.values, second.values, strict=True)
    return ListReel([_product(a, b, *names) for a, b in pairs])


def _product(a: NodeField, b: NodeField, left: list[str], right: list[str]) -> float:
    return float(node_algebra.scalar_product(a, b, left, right).values.sum())


_FACTORS = (
    opt("a", "FLOTTANT", en="factor of the first field", range=ANY_NUMBER),
    opt("b", "FLOTTANT", en="factor of the second field", range=ANY_NUMBER),
)


@operator(
    "XTX",
    main("first", "CHPOINT", en="field"),
    opt("second", "CHPOINT", en="field to add"),
    *_FACTORS,
    family="fields",
)
def xtx(
    call: Call, first: NodeField, second: NodeField | None, a: float | None, b: float | None
) -> float:
    """Square norm of fields at nodes."""
    if second is not None:
        first = _weighted_sum(call, node_algebra, first, second, a, b)
    return float(sum(v.values @ v.values for v in first.components.values()))


@xtx.form(
    main("first", "MCHAML", en="field"), opt("second", "MCHAML", en="field to add"), *_FACTORS
)
def xtx_in_cells(
    call: Call, first: CellField, second: CellField | None, a: float | None, b: float | None
) -> float:
    """Square norm of fields in cells."""
    if second is not None:
        first = _weighted_sum(call, cell_algebra, first, second, a, b)
    total = 0.0
    for p in first.blocks:
        count = n_points(p.element, p.support) if p.element in ELEMENTS else p.cells.kind.n_nodes
        for v in cell_algebra.values_of(CellField((p,))):  # one alone stands for all of its cell
            total += (count if v.shape[1] == 1 else 1) * float((v * v).sum())
    return total


def _weighted_sum(
    call: Call, algebra: Any, first: Any, second: Any, a: float | None, b: float | None
) -> Any:
    if a is None or b is None:
        raise call.missing(("FLOTTANT",))
    return algebra.added(algebra.applied(first, lambda v: v * a), second, b)


@operator("COMB", family="fields", full_name="COMBTABLE")
def comb(
    call: Call,
    alike: bool = Flag("SEMBLABLE", en="the fields have the same nodes and components"),
    weights: NodeField = Arg("CHPOINT", en="coefficients, one component"),
    table: Table = Arg("TABLE", en="fields by point"),
) -> NodeField:
    """Combine fields."""
    if len(weights.components) != 1:
        raise call.error("operators.fields.coefficients-have-one-component", weights)
    (part,) = weights.components.values()
    total: NodeField | None = None
    for index, field in table.items():
        if isinstance(index, Point) and isinstance(field, NodeField):
            factor = float(part.at(np.asarray([index.node]))[0])
            empty = node_algebra.rebuilt(field, {})
            total = node_algebra.added(empty if total is None else total, field, factor)
    if total is None:
        raise call.error("operators.fields.table-without-point-fields", table)
    return total


COLI = shared("COLI", "fields", full_name="COLINEAIRE")


@COLI.form(gives="CHPOINT|MCHAML|LISTREEL")
def _combine_held(
    call: Call,
    held: ListChpo | Table = Arg(
        "LISTCHPO", "TABLE", en="fields, or a table 1 .. N of fields or lists"
    ),
    factors: ListReel = Arg("LISTREEL", en="coefficients", range=ANY_NUMBER),
) -> Any:
    numbers = factors.values.tolist()
    if isinstance(held, ListChpo):
        return _combined(call, list(held.values), numbers)
    return _combined(call, [held.get(i) for i in range(1, len(numbers) + 1)], numbers)


@COLI.form(gives="CHPOINT|MCHAML")
def _combine_fields(
    call: Call,
    objects: tuple[Any, ...] = Many("CHPOINT", "MCHAML", at_least=1, en="fields"),
    factors: tuple[float, ...] = Many("FLOTTANT", en="coefficients", range=ANY_NUMBER),
) -> Any:
    return _combined(call, list(objects), list(factors))


def _combined(call: Call, objects: list[Any], factors: list[float]) -> Any:
    if not objects or len(objects) != len(factors):
        told = {"n_objects": len(objects), "n_factors": len(factors)}
        raise call.error("operators.lists.coefficient-count", **told)
    if all(isinstance(o, ListReel) for o in objects):
        if len({len(o) for o in objects}) > 1:
            raise call.error("operators.lists.lengths-differ")
        return ListReel(sum(f * o.values for f, o in zip(factors, objects, strict=True)))
    kinds = {type(o) for o in objects}
    if len(kinds) > 1 or not kinds <= {NodeField, CellField}:
        raise call.error("operators.lists.nothing-to-combine")
    algebra: Any = node_algebra if isinstance(objects[0], NodeField) else cell_algebra
    total = algebra.applied(objects[0], lambda v: v * factors[0])
    for factor, field in zip(factors[1:], objects[1:], strict=True):
        total = algebra.added(total, field, factor)
    return total


@operator("SOMT", family="fields")
def somt(field: NodeField = Arg("CHPOINT", en="field of one component")) -> float:
    """Sum values."""
    if len(field.components) != 1:
        raise KernelError("operators.lists.single-component")
    return float(next(iter(field.components.values())).values.sum())


# ---- Fourier series ------------------------------------------------------------------------------

_ODD = {
    "UT", "FT", "SMRT", "SMZT", "GART", "GAZT", "EPRT", "EPZT", "GAST", "RTST", "NSST", "MSST",
    "NST", "MST", "RR", "RZ", "MR", "MZ",
}  # fmt: skip
"""Components that go with the sine of a symmetric harmonic; the others go with the cosine."""


@operator("DFOU", gives=Like("field"), family="fields", full_name="DFOURIER")
def dfou(
    call: Call,
    field: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="field of a harmonic"),
    angle: float = Arg("FLOTTANT", en="angle", unit="deg", range=ANY_NUMBER),
) -> NodeField | CellField:
    """Sum a harmonic."""
    n = workspace(call.session).fourier
    if workspace(call.session).mode is not Mode.FOURIER:
        call.warn("operators.fields.no-harmonic-here", harmonic=n)
    turn = np.radians(abs(n) * angle)
    even, odd = (np.cos(turn), np.sin(turn)) if n >= 0 else (np.sin(turn), np.cos(turn))
    if n == 0:
        odd = 1.0  # harmonic 0: uniform stretching and uniform torsion, uncoupled
    factor = defaultdict(lambda: even, dict.fromkeys(_ODD, odd))
    if isinstance(field, NodeField):
        made = {k: NodeValues(v.nodes, factor[k] * v.values) for k, v in field.components.items()}
        return replace(field, components=made)
    parts = [{k: factor[k] * v for k, v in b.components.items()} for b in field.blocks]
    return replace(field, blocks=tuple(map(cell_algebra.rebuilt, field.blocks, parts)))
