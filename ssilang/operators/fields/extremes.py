"""MAXI MINI on numbers, lists and fields, MAX1 (curves have theirs); PILE for strains."""

from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.fields.cell_algebra import component_names
from ssilang.language.registry import Operator
from ssilang.operators.dispatch import MAXI, MINI
from ssilang.operators.prelude import *

Numbers = ListReel | ListEnti


def _of_numbers(
    value: float | int, absolute: bool, others: tuple[float | int, ...], largest: bool
) -> float | int:
    values = [value, *others]
    if absolute:
        values = [abs(v) for v in values]
    found = max(values) if largest else min(values)
    return found if all(isinstance(v, int) for v in values) else float(found)


def _of_lists(
    call: Call, value: Numbers, absolute: bool, others: tuple[Numbers, ...], largest: bool
) -> Numbers | float | int:
    lists = [value, *others]
    arrays: list[Any] = [np.abs(v.values) if absolute else v.values for v in lists]
    if not others:
        if not len(arrays[0]):
            raise call.error("operators.fields.list-empty", value)
        return (arrays[0].max() if largest else arrays[0].min()).item()
    if len({len(a) for a in arrays}) > 1:
        raise call.error(
            "operators.fields.list-lengths-differ", lengths=[str(len(a)) for a in arrays]
        )
    best = (np.maximum if largest else np.minimum).reduce(arrays)
    return ListEnti(best) if all(isinstance(v, ListEnti) for v in lists) else ListReel(best)


def _components(
    call: Call, known: list[str], which: str | None, listed: ListMots | None
) -> list[str]:
    """The components to look at; a list without a word stands for 'AVEC'."""
    if listed is None and which is not None:
        raise call.error("operators.fields.components-not-listed", word=which)
    if listed is None:
        return known
    words = {str(w).rstrip() for w in listed.values}
    names = [n for n in known if (n in words) != (which == "SANS")]
    if not names:
        raise call.error("operators.fields.no-component-left", listed, known=known)
    return names


def _of_arrays(call: Call, arrays: list[Any], absolute: bool, largest: bool) -> float:
    arrays = [a for a in arrays if a.size]
    if not arrays:
        raise call.error("operators.fields.field-empty")
    values = [np.abs(a) if absolute else a for a in arrays]
    return float(max(v.max() for v in values) if largest else min(v.min() for v in values))


def _of_node_fields(
    call: Call,
    value: NodeField,
    absolute: bool,
    which: str | None,
    listed: ListMots | None,
    others: tuple[NodeField, ...],
    largest: bool,
) -> NodeField | float:
    names = _components(call, list(value.components), which, listed)
    if not others:
        if not names:
            raise call.error("operators.fields.field-empty", value)
        arrays = {n: value.components[n].values for n in names}
        found = _of_arrays(call, [*arrays.values()], absolute, largest)
        if listed is None and arrays.pop("LX", None) is not None and arrays:
            moved = _of_arrays(call, [*arrays.values()], absolute, largest)
            if moved != found:
                call.warn("operators.fields.extreme-of-multipliers", value, found=found, rest=moved)
        return found
    run = np.maximum if largest else np.minimum
    made = node_algebra.applied(value, np.abs) if absolute else value
    for other in others:
        made = _pairwise(made, node_algebra.applied(other, np.abs) if absolute else other, run)
    return made


def _pairwise(a: NodeField, b: NodeField, run: Any) -> NodeField:
    made = {}
    for name, part in a.components.items():
        other = b.components.get(name)
        if other is None or not np.array_equal(other.nodes, part.nodes):
            raise KernelError("operators.fields.fields-do-not-match")
        made[name] = type(part)(part.nodes, run(part.values, other.values))
    return node_algebra.rebuilt(a, made)


def _of_cell_field(
    call: Call,
    value: CellField,
    absolute: bool,
    which: str | None,
    listed: ListMots | None,
    largest: bool,
) -> float:
    known = [
        n
        for n in cell_algebra.component_names(value)
        if any(n in b.components and b.components[n].dtype != object for b in value.blocks)
    ]
    names = _components(call, known, which, listed)
    return _of_arrays(call, cell_algebra.values_of(value, names), absolute, largest)


_ABSOLUTE = flag("absolute", "ABS", en="of the absolute values")
_COMPONENTS = (
    choice("which", ("AVEC", "SANS"), en="the components of the list, or all but them"),
    opt("listed", "LISTMOTS", kind="component", en="components"),
)


def _add_forms(operator: Operator, largest: bool) -> None:
    operator.form(
        main("value", "ENTIER", "FLOTTANT", en="first number"),
        _ABSOLUTE,
        many("others", "ENTIER", "FLOTTANT", en="more numbers", range=CARRIED),
        gives="FLOTTANT|ENTIER",
    )(partial(_of_numbers, largest=largest))
    operator.form(
        main("value", "LISTREEL", "LISTENTI", en="list"),
        _ABSOLUTE,
        many("others", "LISTREEL", "LISTENTI", en="lists of the same length", range=CARRIED),
        gives=by("others", {True: "LISTREEL|LISTENTI"}, "FLOTTANT|ENTIER"),
    )(partial(_of_lists, largest=largest))
    operator.form(
        main("value", "CHPOINT", en="field at nodes"),
        _ABSOLUTE,
        *_COMPONENTS,
        many("others", "CHPOINT", en="fields at the same nodes"),
        gives=by("others", {True: "CHPOINT"}, "FLOTTANT"),
    )(partial(_of_node_fields, largest=largest))
    operator.form(
        main("value", "MCHAML", en="field in cells"), _ABSOLUTE, *_COMPONENTS, gives="FLOTTANT"
    )(partial(_of_cell_field, largest=largest))


_add_forms(MAXI, True)
_add_forms(MINI, False)


@operator("MAX1", arg("field", "CHPOINT", en="field"), *_COMPONENTS, family="fields")
def max1(call: Call, field: NodeField, which: str | None, listed: ListMots | None) -> NodeField:
    """Bring a field to one."""
    chosen = _components(call, list(field.components), which, listed)
    values = [field.components[n].values for n in chosen]
    every = np.concatenate(values) if values else np.zeros(0)
    largest = float(every[np.argmax(np.abs(every))]) if len(every) else 0.0
    if largest == 0.0:
        raise call.error("operators.fields.field-is-zero", field)
    return node_algebra.applied(field, lambda v: v / largest)


@operator("PILE", family="fields", full_name="PILEPS")
def pile(
    call: Call,
    first: CellField = Arg("MCHAML", en="where one starts"),
    second: CellField = Arg("MCHAML", en="direction"),
    limit: float = Arg("FLOTTANT", en="limit, positive", range=POSITIVE),
) -> float:
    """Largest factor before a component passes the limit."""
    if component_names(first) != component_names(second) or len(first.blocks) != len(second.blocks):
        raise call.error("operators.fields.fields-of-other-zones", second)
    best = np.inf
    for a, b in zip(first.blocks, second.blocks, strict=True):
        for name, values in b.components.items():
            start, step = np.broadcast_arrays(a.components[name], values)
            moving = step != 0.0
            room = (np.sign(step[moving]) * limit - start[moving]) / step[moving]
            best = min(best, float(room.min(initial=np.inf)))
    if not np.isfinite(best):
        raise call.error("operators.fields.second-field-is-zero", second)
    return best
