"""MASQ: ones where values meet a relation, zeros elsewhere; BORN: values cut at bounds."""

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.curves.extraction import numbered
from ssilang.operators.numbers.functions import mapped
from ssilang.operators.prelude import *

_TESTS: dict[str, Callable[[Any, Any], Any]] = {
    "SUPERIEUR": np.greater, "EGSUPE": np.greater_equal, "EGALE": np.equal,
    "EGINFE": np.less_equal, "INFERIEUR": np.less, "DIFFERENT": np.not_equal,
}  # fmt: skip
_LIMITS = {
    "CHPOINT": ("FLOTTANT", "CHPOINT"),
    "MCHAML": ("FLOTTANT", "MCHAML"),
    "LISTREEL": ("FLOTTANT", "LISTREEL", "LISTENTI"),
    "LISTENTI": ("ENTIER", "FLOTTANT", "LISTENTI"),
}
"""What the values of an object may be compared with, by its type."""

MASQ = shared("MASQ", "numbers", full_name="MASQUE")


_EXISTE = {"EXISTE": [opt("component", "MOT", en="component", kind="component")]}
"""What is asked of fields in cells alone."""


_COUNTED = flag("counted", "SOMM", en="number of ones")


def _test_of(kind: str, *limits: str) -> tuple[Entry, ...]:
    """The relation, with what the values are compared with."""
    limit = arg("limit", *limits, en="value to compare with", range=CARRIED)
    low = arg("low", *limits, en="lower bound", range=CARRIED)
    high = arg("high", *limits, en="upper bound", range=CARRIED)
    words = {**{word: [limit] for word in _TESTS}, "COMPRIS": [low, high]}
    words |= _EXISTE if kind == "MCHAML" else {}
    return select("test", words, optional=False, en="relation"), _COUNTED


def _masked(value: Any, test: Chosen, counted: bool) -> Any:
    if test.word == "EXISTE":
        return _existing(value, test["component"])
    if test.word == "COMPRIS":
        above = _tested(value, test["low"], np.greater_equal)
        made = _times(above, _tested(value, test["high"], np.less_equal))
    else:
        made = _tested(value, test["limit"], _TESTS[test.word])
    return _count(made) if counted else made


for _kind, _limits in _LIMITS.items():
    MASQ.form(
        main("value", _kind, en="values to test"),
        *_test_of(_kind, *_limits),
        gives=by("counted", {True: "ENTIER"}, _kind),
    )(_masked)


def _tested(value: Any, other: Any, test: Callable[[Any, Any], Any]) -> Any:
    if isinstance(other, int | float):
        return mapped(lambda x: test(x, other).astype(x.dtype), value)
    if isinstance(value, NodeField):
        made = {
            k: type(v)(v.nodes, test(v.values, other.values_at(k, v.nodes)).astype(float))
            for k, v in value.components.items()
        }
        return node_algebra.rebuilt(value, made)
    if isinstance(value, CellField):
        gap = cell_algebra.added(value, other, -1.0)
        return cell_algebra.applied(gap, lambda x: test(x, 0.0).astype(float))
    if len(value) != len(other):
        raise KernelError("operators.numbers.list-lengths", n_first=len(value), n_second=len(other))
    return type(value)(test(value.values, other.values))


def _times(a: Any, b: Any) -> Any:
    if isinstance(a, NodeField):
        return node_algebra.multiplied(a, b)
    if isinstance(a, CellField):
        return cell_algebra.multiplied(a, b)
    return type(a)(a.values * b.values)


def _count(made: Any) -> int:
    if isinstance(made, NodeField):
        return int(sum(v.values.sum() for v in made.components.values()))
    if isinstance(made, CellField):
        return int(sum(v.sum() for v in cell_algebra.values_of(made)))
    return int(made.values.sum())


def _existing(value: CellField, component: str | None) -> CellField:
    name = None if component is None else str(component).rstrip()
    blocks = []
    for block in value.blocks:
        shape = max((v.shape for v in block.components.values()), default=(len(block.cells), 1))
        if name is None:
            made = {k: np.ones(v.shape) for k, v in block.components.items()}
        else:
            made = {name: np.full(shape, float(name in block.components))}
        blocks.append(cell_algebra.rebuilt(block, made))
    return CellField(tuple(blocks), value.title)


BORN = shared("BORN", "numbers", full_name="BORNER")
_HIGH = arg("high", "ENTIER", "FLOTTANT", en="upper bound", range=ANY_NUMBER)
_LOW = arg("low", "ENTIER", "FLOTTANT", en="lower bound", range=ANY_NUMBER)
_BOUND = select(
    "bound",
    {"MAXIMUM": [_HIGH], "MINIMUM": [_LOW], "COMPRIS": [_LOW, _HIGH]},
    optional=False,
    en="bounds of the values",
)


def _ends(bound: Chosen) -> tuple[float, float]:
    return bound.values.get("low", -np.inf), bound.values.get("high", np.inf)


@BORN.form(main("value", "LISTENTI", "LISTREEL", en="list"), _BOUND, gives=Like("value"))
def _clipped_list(value: ListEnti | ListReel, bound: Chosen) -> Any:
    return type(value)(np.clip(value.values, *_ends(bound)))


@BORN.form(
    main("value", "EVOLUTIO", en="curves"),
    each(
        "bounds",
        opt("curve", "ENTIER", en="number of a curve, where there are several", range=POSITIVE),
        _BOUND,
        at_least=1,
    ),
)
def _clipped_curves(call: Call, value: Curve, bounds: list[tuple[int | None, Chosen]]) -> Curve:
    parts: list[CurvePart] = []
    for who, bound in bounds:
        if who is None and len(value.parts) > 1:
            raise call.error("operators.numbers.which-curve", n_parts=len(value.parts))
        part = numbered(call, value, who)
        parts.append(replace(part, ordinates=np.clip(part.ordinates, *_ends(bound))))
    return Curve(tuple(parts), value.title, value.kind)


@BORN.form(gives=Like("value"))
def _clipped_fields(
    call: Call,
    value: Any = Main("CHPOINT", "MCHAML", en="field"),
    bounds: list[Chosen] = Each(
        either(
            "one",
            group("only", _BOUND),
            group(
                "named",
                arg("component", "MOT", en="component", kind="component"),
                _BOUND,
            ),
        ),
        at_least=1,
    ),
) -> Any:
    node = isinstance(value, NodeField)
    names = list(value.components) if node else cell_algebra.component_names(value)
    united: Callable[..., Any] = node_algebra.united if node else cell_algebra.united
    made: Any = None
    for one in bounds:
        who = one.values.get("component")
        if who is None and len(names) != 1:
            raise call.error("operators.numbers.which-component", names=names)
        name = names[0] if who is None else str(who).rstrip()
        low, high = _ends(one["bound"])
        clip = partial(np.clip, a_min=low, a_max=high)
        if node:
            only = node_algebra.rebuilt(value, {name: node_algebra.component(value, name)})
            part: Any = node_algebra.applied(only, clip)
        else:
            part = cell_algebra.applied(cell_algebra.extracted(value, [name], [name]), clip)
        made = part if made is None else united(made, part)
    return made
