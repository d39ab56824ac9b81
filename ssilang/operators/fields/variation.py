"""VARI: fields that follow a law of variation, parameters that depend on a field."""

from ssilang.kernel.curves.algebra import beyond, interpolated
from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.kernel.mesh.mesh import same_cells
from ssilang.operators.curves.words import one_part
from ssilang.operators.fields.cell_supports import SUPPORTS, placed
from ssilang.operators.prelude import *


def argument_name(names: list[str], part: CurvePart) -> str:
    """The component that a law is a function of: its abscissa's name, or the only one.

    Raises
    ------
    FieldError
        If the field has several components and none bears the name.
    """
    wanted = part.abscissa_name.strip()
    if wanted in names:
        return wanted
    if len(names) == 1:
        return names[0]
    raise FieldError("operators.fields.no-component-is-abscissa", names=names, wanted=wanted)


_SUPPORT = choice("support", SUPPORTS, default="RIGIDITE", en="points of the result")
_LAW = arg("curve", "EVOLUTIO", en="law of variation")


@operator("VARI", family="fields", full_name="VARIATION")
def vari(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    field: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="what the law depends on"),
    curve: Curve = _LAW,
    support: str = _SUPPORT,
) -> CellField:
    """Evaluate a law in cells."""
    part = one_part(call, curve)
    at_points = placed(model, field, cast(Support, support))
    name = argument_name(cell_algebra.component_names(at_points), part)
    one = cell_algebra.extracted(at_points, [name], ["SCAL"])
    for block in one.blocks:
        _warn_beyond(call, part, block.components["SCAL"])
    made = cell_algebra.applied(one, lambda v: interpolated(part.abscissas, part.ordinates, v))
    return CellField(made.blocks, "SCALAIRE")


@vari.form()
def vari_at_nodes(
    call: Call,
    field: NodeField = Arg("CHPOINT", en="what the law depends on"),
    curve: Curve = _LAW,
    target: str | None = Opt("MOT", en="component of the result, else the name of the ordinate"),
) -> NodeField:
    """Evaluate a law at nodes."""
    part = one_part(call, curve)
    name = part.ordinate_name.strip() if target is None else target.rstrip()
    given = field.components[argument_name(list(field.components), part)]
    _warn_beyond(call, part, given.values)
    values = interpolated(part.abscissas, part.ordinates, given.values)
    return node_algebra.rebuilt(field, {name or "SCAL": NodeValues(given.nodes, values)})


def _warn_beyond(call: Call, part: CurvePart, at: FloatArray) -> None:
    if (value := beyond(part.abscissas, part.ordinates, at)) is not None:
        names = part.ordinate_name.strip() or "SCAL", part.abscissa_name.strip()
        call.warn("operators.fields.beyond-law", **_told(part.abscissas, value, *names))


def _told(x: FloatArray, value: float, name: str, over: str) -> dict[str, Any]:
    ends = {"first": float(x.min()), "last": float(x.max())}
    return {"name": name, "over": over or "x", "value": value, **ends}


def beyond_laws(laws: CellField, fields: CellField) -> Iterator[dict[str, Any]]:
    """Each parameter that fields ask for outside of its curve."""
    for block in laws.blocks:
        known = _known(block, fields)
        for name, values in block.components.items():
            held = values.ravel() if values.dtype == object else ()
            for law in {id(v): v for v in held if isinstance(v, Curve | Cloud)}.values():
                over, x, y = _points(law)
                if (value := beyond(x, y, known.get(over, np.zeros(0)))) is not None:
                    yield _told(x, value, name, over)


def _points(law: Curve | Cloud) -> tuple[str, FloatArray, FloatArray]:
    """What a law depends on first, where it is given, its values there; of objects, rising ones."""
    if isinstance(law, Curve):
        part = law.parts[0]
        return part.abscissa_name.strip(), part.abscissas, part.ordinates
    over, *rest = law.columns
    x = law.numbers(over)
    plain = len(rest) == 1 and all(isinstance(v, int | float) for v in law.columns[rest[0]])
    order = np.argsort(x)
    return over, x[order], (law.numbers(rest[0]) if plain else x)[order]


@vari.form(said("NUAG"))
def vari_of_parameters(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    laws: CellField = Arg("MCHAML", en="parameters, curves among them"),
    given: CellField | NodeField = Arg("MCHAML", "CHPOINT", en="fields that the curves depend on"),
    support: str = _SUPPORT,
    title: str | None = Opt("MOT", en="sub-type of the result"),
) -> CellField:
    """Parameters given by curves and clouds as numbers."""
    at = cast(Support, support)
    at_points = placed(model, given, at)
    for told in beyond_laws(laws, at_points):
        call.warn("operators.fields.beyond-law", **told)
    made = evaluated(laws, at_points, at)
    return CellField(made.blocks, laws.title if title is None else title.rstrip())


def evaluated(laws: CellField, fields: CellField, support: Support) -> CellField:
    """Parameters as numbers where their laws are functions of some fields at the same points.

    A law is a curve over a component of the fields, or a cloud: columns of such components, then
    numbers, curves over one more component, or curves that are the parameter themselves (ECRO).
    Between rows of a cloud values are linear, beyond its ends constant.
    """
    return CellField(tuple(_evaluated(b, fields, support) for b in laws.blocks), laws.title)


def _evaluated(block: CellFieldBlock, fields: CellField, support: Support) -> CellFieldBlock:
    if not any(v.dtype == object for v in block.components.values()):
        return block
    given = _there(block, fields)
    if not given:
        raise FieldError("operators.fields.parameters-and-fields-apart")
    known = _known(block, fields)
    made = {
        name: _values(values, known) if values.dtype == object else values
        for name, values in block.components.items()
    }
    return CellFieldBlock(block.cells, made, support, given[0].element, block.constituent)


def _there(block: CellFieldBlock, fields: CellField) -> list[CellFieldBlock]:
    return [b for b in fields.blocks if same_cells(b.cells, block.cells)]


def _known(block: CellFieldBlock, fields: CellField) -> dict[str, FloatArray]:
    """Components of fields in the cells of a block."""
    there = _there(block, fields)
    return {n: np.asarray(v, float) for b in there for n, v in b.components.items()}


def _values(laws: NDArray[Any], known: dict[str, FloatArray]) -> NDArray[Any]:
    """Values (n_cells, n_points) of laws (n_cells, 1); the laws where nothing known says them."""
    shape = np.broadcast_shapes(laws[:, :1].shape, *(v.shape for v in known.values()))
    column = np.broadcast_to(laws[:, :1], (shape[0], 1))[:, 0]
    found = {id(law): (law, _of_law(law, known, shape)) for law in column}
    if all(values.dtype == object and values.flat[0] is law for law, values in found.values()):
        return laws
    kind = np.result_type(*(values.dtype for _, values in found.values()))
    made = np.empty(shape, dtype=kind)
    for law, values in found.values():
        rows = np.array([one is law for one in column])
        made[rows] = values[rows]
    return made


def _of_law(law: Any, known: dict[str, FloatArray], shape: tuple[int, ...]) -> NDArray[Any]:
    if isinstance(law, Cloud) and next(iter(law.columns)) in known:
        first, *rest = law.columns
        levels, place = np.unique(law.numbers(first), return_inverse=True)
        cuts = (law.rows(np.flatnonzero(place == i).tolist()) for i in range(len(levels)))
        inner = [c.columns[rest[0]][0] if len(rest) == 1 else
                 Cloud({n: c.columns[n] for n in rest}) for c in cuts]  # fmt: skip
        x = np.broadcast_to(known[first], shape)
        return _between(levels, [_of_law(one, known, shape) for one in inner], x)
    part = law.parts[0] if isinstance(law, Curve) else None
    if part is not None and part.abscissa_name.strip() in known:
        x = known[part.abscissa_name.strip()]
        return np.broadcast_to(interpolated(part.abscissas, part.ordinates, x), shape)
    made = np.empty(shape, dtype=float if isinstance(law, int | float) else object)
    made.fill(law)
    return made


def _between(levels: FloatArray, values: list[NDArray[Any]], x: FloatArray) -> NDArray[Any]:
    """Values (n_cells, n_points) at x, linear between those at levels; curves go point by point."""
    k = np.clip(np.searchsorted(levels, x, side="right") - 1, 0, max(len(levels) - 2, 0))
    upper = np.minimum(k + 1, len(levels) - 1)
    width = levels[upper] - levels[k]
    share = np.clip((x - levels[k]) / np.where(width > 0, width, 1.0), 0.0, 1.0)
    stacked = np.stack(values)
    low, high = (np.take_along_axis(stacked, i[None], 0)[0] for i in (k, upper))
    if stacked.dtype != object:
        return np.asarray(low + share * (high - low))
    made, kept = np.empty(x.shape, dtype=object), {}
    for place, part in np.ndenumerate(share):
        key = (id(low[place]), id(high[place]), part)
        if key not in kept:
            kept[key] = _mixed(low[place], high[place], part)
        made[place] = kept[key]
    return made


def _mixed(first: Curve, second: Curve, share: float) -> Curve:
    """A curve between two, at the abscissas of both."""
    a, b = first.parts[0], second.parts[0]
    x = np.union1d(a.abscissas, b.abscissas)
    low, high = (np.interp(x, part.abscissas, part.ordinates) for part in (a, b))
    return Curve((replace(a, abscissas=x, ordinates=low + share * (high - low)),), first.title)
