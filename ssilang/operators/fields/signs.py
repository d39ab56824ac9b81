"""`+ - * / **`, ET, PSCA on fields at nodes and in cells."""

import numpy as np

from ssilang.kernel.base.powers import real_power
from ssilang.kernel.curves.algebra import combined
from ssilang.kernel.elements.families import elastic_stress
from ssilang.kernel.elements.solids.solid_moduli import HOOKE_COMPONENT
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.node_field import Nature
from ssilang.operators.dispatch import INVE, PSCA, PVEC, worded_union
from ssilang.operators.numbers.arithmetic import _ARRAY, RULES, SIGNS, rule, rule_with_call
from ssilang.operators.prelude import *

_NATURES: dict[str, Nature] = {"INDE": "", "DIFF": "DIFFUS", "DISC": "DISCRET"}


def names_of(value: Any) -> list[str]:
    """Component names from a MOT or a LISTMOTS."""
    words = value.values if isinstance(value, ListMots) else [value]
    return [str(w).rstrip() for w in words]


def nature_of(call: Call, word: str | None) -> Nature | None:
    """The nature that a word behind 'NATURE' says, None if none stands there."""
    if word is None:
        return None
    if word.upper()[:4] not in _NATURES:
        raise call.error("operators.fields.nature-unknown", word)
    return _NATURES[word.upper()[:4]]


def paired_names(
    call: Call, left: ListMots, right: ListMots, *fields: NodeField
) -> tuple[list[str], list[str]]:
    """Names of two lists of the same length; told where two fields have no pair of them."""
    names = names_of(left), names_of(right)
    if len(names[0]) != len(names[1]):
        raise call.error(
            "operators.fields.word-counts-differ", n_left=len(names[0]), n_right=len(names[1])
        )
    if not any(all(n in f.components for n, f in zip(p, fields)) for p in zip(*names)):  # noqa: B905
        call.warn("operators.fields.product-of-nothing", left)
    return names


def nature_word(nature: Nature) -> str:
    """The nature as EXTR 'NATU' tells it."""
    return nature or "INDETERMINE"


def _lists(call: Call) -> tuple[list[str], list[str], list[str]] | None:
    """Three lists of names of equal length, if the first is there."""
    first = call.read("LISTMOTS")
    if first is None:
        return None
    lists = [first.value, call.required("LISTMOTS"), call.required("LISTMOTS")]
    names = [names_of(v) for v in lists]
    if len({len(n) for n in names}) > 1:
        raise call.error(
            "operators.fields.three-word-counts-differ", counts=[str(len(n)) for n in names]
        )
    return names[0], names[1], names[2]


# ---- at nodes -----------------------------------------------------------------------------------


@rule("+ -", "CHPOINT", "CHPOINT")
def _add(sign: str, a: NodeField, b: NodeField) -> NodeField:
    return node_algebra.added(a, b, 1.0 if sign == "+" else -1.0)


@rule_with_call("* /", "CHPOINT", "CHPOINT")
def _multiply(call: Call, sign: str, a: NodeField, b: NodeField) -> NodeField:
    names = _lists(call)
    divide = sign == "/"
    if names is None:
        made = node_algebra.multiplied(a, b, divide)
    else:
        made = node_algebra.multiplied_by_names(a, b, names, divide)
    said = call.keyword(("NATU",))
    word = None if said is None else call.required("MOT", after=call.keyword_end)
    nature = nature_of(call, word)
    return node_algebra.rebuilt(made, made.components, nature)


def _power(call: Call, x: FloatArray, exponent: float) -> FloatArray:
    """Powers of a field's values; where there is none it is zero, and told."""
    lost = x == 0.0 if exponent < 0 else np.zeros(x.shape, bool)
    try:
        real_power(-1.0, exponent)
    except NoResultError:
        lost |= x < 0.0
    if lost.any():
        call.warn("operators.fields.power-put-to-zero", count=int(lost.sum()), exponent=exponent)
    return np.where(lost, 0.0, real_power(np.where(lost, 1.0, x), exponent))


def _with_number(sign: str, x: Any, number: float, left: bool) -> Any:
    if sign == "**":
        if number < 0 or (number == 0 and np.any(np.asarray(x) < 0)):
            raise FieldError("operators.fields.number-has-no-field-power", number=number)
        return np.power(number, np.asarray(x, dtype=float))
    if sign == "/" and (np.any(x == 0) if left else number == 0):
        raise FieldError("operators.fields.division-by-zero")
    return _ARRAY[sign](number, x) if left else _ARRAY[sign](x, number)


def _scaled(sign: str, field: NodeField, number: float, left: bool) -> NodeField:
    return node_algebra.applied(field, lambda x: _with_number(sign, x, float(number), left))


def _node_power(call: Call, sign: str, field: NodeField, number: float) -> NodeField:
    return node_algebra.applied(field, lambda x: _power(call, x, float(number)))


for _kind in ("ENTIER", "FLOTTANT"):
    rule("+ - * /", "CHPOINT", _kind)(lambda sign, a, b: _scaled(sign, a, b, False))
    rule_with_call("**", "CHPOINT", _kind)(_node_power)
    rule(SIGNS, _kind, "CHPOINT")(lambda sign, a, b: _scaled(sign, b, a, True))


@INVE.form()
def _inverse(call: Call, field: NodeField = Main("CHPOINT", en="nodal field")) -> NodeField:
    for name, part in field.components.items():
        if not np.all(part.values):
            node = part.nodes[np.flatnonzero(part.values == 0.0)[0]]
            at = field.table.coordinates[node].tolist()
            raise call.error("operators.fields.no-inverse-of-zero", field, name=name, at=at)
    return node_algebra.applied(field, np.reciprocal)


@worded_union(("CHPOINT", "CHPOINT"))
def _join_node_fields(words: Collection[str], a: NodeField, b: NodeField) -> NodeField:
    return node_algebra.united(a, b, "NOER" not in words)


# ---- in cells -----------------------------------------------------------------------------------


@rule("+ -", "MCHAML", "MCHAML")
def _add_cells(sign: str, a: CellField, b: CellField) -> CellField:
    return cell_algebra.added(a, b, 1.0 if sign == "+" else -1.0, _of_objects)


def _of_objects(sign: str, a: object, b: object) -> object:
    """What cells hold, combined: curves, lists, points, and numbers with them."""
    if isinstance(a, Curve) and isinstance(b, Curve):
        return combined(a, b, sign, _ARRAY[sign])
    if isinstance(a, Point) and isinstance(b, Point) and sign in "+-":
        place = a.coordinates + (1.0 if sign == "+" else -1.0) * b.coordinates
        density = float(a.nodes.density[a.node])
        return Point(a.nodes, int(a.nodes.add(place[None], density)[0]))
    types = type_of(a), type_of(b)
    found = None if types[0] == types[1] == "POINT" else RULES.get((sign, *types))
    if found is None:
        raise FieldError("operators.fields.objects-do-not-go", sign=sign, types=types)
    return found(a, b)


@rule_with_call("* /", "MCHAML", "MCHAML")
def _multiply_cells(
    call: Call, sign: str, a: CellField, b: CellField, model: Model | None = None
) -> CellField:
    names = _lists(call)
    if names is not None:
        factors = _coefficients(call, len(names[0]))
        return cell_algebra.multiplied_by_names(a, b, names, sign == "/", factors)
    if sign == "*" and _has_matrices(a) != _has_matrices(b):
        found = call.required("MMODEL") if model is None else model
        return _stresses(found, a, b) if _has_matrices(a) else _stresses(found, b, a)
    if model is not None and sign == "*":
        raise call.error("operators.fields.model-for-hooke", model)
    return cell_algebra.multiplied(a, b, sign == "/", _of_objects)


_FACTORS = opt("factors", "LISTREEL", en="factors of triples of names", range=ANY_NUMBER)


def _coefficients(call: Call, count: int) -> FloatArray | None:
    """A factor for each triple of names, if a list of numbers follows them."""
    given = call.given(_FACTORS)
    if given is None:
        return None
    factors = np.asarray(given.values, dtype=float)
    if len(factors) != count:
        raise call.error(
            "operators.fields.factor-count", given, n_factors=len(factors), n_names=count
        )
    return factors


def _has_matrices(field: CellField) -> bool:
    return any(HOOKE_COMPONENT in b.components for b in field.blocks)


def _stresses(model: Model, matrices: CellField, strains: CellField) -> CellField:
    """Elastic stresses of strains by matrices of Hooke."""
    blocks = tuple(elastic_stress(zone, matrices, strains) for zone in model.zones)
    return CellField(blocks, "CONTRAINTES")


@rule_with_call("* /", "MMODEL", "MCHAML")
@rule_with_call("* /", "MCHAML", "MMODEL")
def _with_model(call: Call, sign: str, left: Any, right: Any) -> CellField:
    model, field = (left, right) if isinstance(left, Model) else (right, left)
    return _multiply_cells(call, sign, field, call.required("MCHAML"), model)


def _cell_number(
    call: Call, sign: str, field: CellField, number: float, left: bool = False
) -> CellField:
    chosen = call.read("LISTMOTS") if sign in "+-" else None
    names = None if chosen is None else names_of(chosen.value)

    value = float(number)

    def made(values: Any) -> Any:
        if values.dtype != object:
            if sign == "**" and not left:
                return _power(call, values, value)
            return _with_number(sign, values, value, left)
        a, b = (value, values) if left else (values, value)
        return cell_algebra.of_objects(sign, a, b, _of_objects)

    return cell_algebra.applied(field, made, names, objects=True)


for _kind in ("ENTIER", "FLOTTANT"):
    rule_with_call(SIGNS, "MCHAML", _kind)(_cell_number)
    rule_with_call(SIGNS, _kind, "MCHAML")(lambda c, sign, a, b: _cell_number(c, sign, b, a, True))


# ---- PSCA ---------------------------------------------------------------------------------------


PAIRED = (
    arg("left", "LISTMOTS", en="components of the first"),
    arg("right", "LISTMOTS", en="components of the second, paired with them"),
)


@PSCA.form(
    main("first", "CHPOINT", en="first field"), arg("second", "CHPOINT", en="second field"), *PAIRED
)
def scalar_product(
    call: Call, first: NodeField, second: NodeField, left: ListMots, right: ListMots
) -> NodeField:
    """Scalar product at each node."""
    names = paired_names(call, left, right, first, second)
    part = node_algebra.scalar_product(first, second, *names)
    return node_algebra.rebuilt(first, {"SCAL": part})


@PSCA.form(
    main("first", "MCHAML", en="first field"),
    arg("second", "MCHAML", en="second field"),
    *PAIRED,
)
def scalar_product_in_cells(
    call: Call, first: CellField, second: CellField, left: ListMots, right: ListMots
) -> CellField:
    """Scalar product at each point of the cells."""
    names = paired_names(call, left, right)
    return cell_algebra.multiplied_by_names(first, second, (*names, ["SCAL"] * len(names[0])))


IN_PLANE = When(lambda s: s.dimension() == 2, "in the plane")
NOT_IN_PLANE = When(lambda s: s.dimension() != 2, "in space")
_THREE = tuple(
    arg(name, "LISTMOTS", en=f"components of the {en}")
    for name, en in (("left", "first"), ("right", "second"), ("made", "result"))
)
_TWO = (
    arg("old", "LISTMOTS", en="components to turn"),
    arg("new", "LISTMOTS", en="components of the result"),
)


def _lists_of(call: Call, *lists: ListMots) -> list[list[str]]:
    names = [names_of(v) for v in lists]
    dimension = call.session.dimension() or 3
    if any(len(n) != dimension for n in names):
        raise call.error("operators.fields.components-per-list", dimension=dimension)
    return names


@PVEC.form(main("first", "CHPOINT", en="field"), *_TWO, when=IN_PLANE)
def quarter_turn(call: Call, first: NodeField, old: ListMots, new: ListMots) -> NodeField:
    """Components at nodes turned by a quarter turn."""
    (x, y), (u, v) = _lists_of(call, old, new)
    turned = node_algebra.applied(_picked_nodes(first, [y], [u]), np.negative)
    return node_algebra.added(turned, _picked_nodes(first, [x], [v]))


@PVEC.form(main("first", "MCHAML", en="field"), *_TWO, when=IN_PLANE)
def quarter_turn_in_cells(call: Call, first: CellField, old: ListMots, new: ListMots) -> CellField:
    """Components in cells turned by a quarter turn."""
    (x, y), (u, v) = _lists_of(call, old, new)
    turned = cell_algebra.applied(cell_algebra.extracted(first, [y], [u]), np.negative)
    return cell_algebra.added(turned, cell_algebra.extracted(first, [x], [v]))


def vector_product(
    algebra: Any,
    call: Call,
    first: Any,
    second: Any,
    left: ListMots,
    right: ListMots,
    made: ListMots,
) -> Any:
    """Vector product at each node, or at each point of the cells."""
    a, b, c = _lists_of(call, left, right, made)
    terms = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        plus = algebra.multiplied_by_names(first, second, ([a[j]], [b[k]], [c[i]]))
        minus = algebra.multiplied_by_names(first, second, ([a[k]], [b[j]], [c[i]]))
        terms.append(algebra.added(plus, minus, -1.0))
    return reduce(algebra.added, terms)


for _kind, _algebra in (("CHPOINT", node_algebra), ("MCHAML", cell_algebra)):
    PVEC.form(
        main("first", _kind, en="first field"),
        arg("second", _kind, en="second field"),
        *_THREE,
        when=NOT_IN_PLANE,
        gives=_kind,
    )(partial(vector_product, _algebra))


def _picked_nodes(field: NodeField, old: list[str], new: list[str]) -> NodeField:
    made = {n: node_algebra.component(field, o) for o, n in zip(old, new, strict=True)}
    return node_algebra.rebuilt(field, made)
