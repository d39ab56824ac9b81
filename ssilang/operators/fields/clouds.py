"""NUAG: clouds, clouds in EXTR DIME REDU LIST, and IPOL in them."""

from ssilang.kernel.curves.cloud import Cloud, inverse_distance, moving_plane, on_grid
from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.dispatch import DIME, EXTR, REDU, listing, union
from ssilang.operators.prelude import *


@union(("NUAGE", "NUAGE"))
def _joined(first: Cloud, second: Cloud) -> Cloud:
    return first.joined(second)


@operator("NUAG", family="clouds", full_name="NUAGE")
def nuag(field: NodeField | CellField = Arg("CHPOINT", "MCHAML", en="field")) -> Cloud:
    """Cloud of the values of a field."""
    if isinstance(field, NodeField):
        nodes = field.node_ids
        return Cloud({k: tuple(v.at(nodes).tolist()) for k, v in field.components.items()})
    names = dict.fromkeys(n for b in field.blocks for n in b.components)
    columns: dict[str, list[float]] = {n: [] for n in names}
    for block in field.blocks:
        width = max((v.shape[1] for v in block.components.values()), default=1)
        shape = (len(block.cells), width)
        for name in names:
            values = block.components.get(name, np.zeros((1, 1)))
            columns[name] += np.broadcast_to(values, shape).ravel().tolist()
    return Cloud({k: tuple(v) for k, v in columns.items()})


@nuag.form(
    each(
        "columns",
        choice("word", ("COMP",), optional=False),
        arg("component", "MOT", en="name of a column"),
        many("values", en="its values, one a row"),
    ),
    by_hand="the values of a column are objects of any type, up to the next word; the types of a "
    "row are said by words",
)
def cloud_by_hand(call: Call) -> Cloud:
    """Cloud column by column, or row by row."""
    if call.peek_word() is not None and str(call.peek_word())[:4] == "COMP":
        columns: dict[str, tuple[object, ...]] = {}
        while call.keyword(("COMP",)) is not None:
            name = str(call.required("MOT", after=call.keyword_end)).rstrip()
            values: list[object] = []
            while call.operands and not call.at_word():
                values.append(call.operands.pop(0).value)
            columns[name] = tuple(values)
        sizes = {len(v) for v in columns.values()}
        if len(sizes) != 1 or 0 in sizes:
            counts = " ".join(f"{k}: {len(v)}" for k, v in columns.items())
            raise call.error("operators.fields.cloud-columns-differ", counts=counts)
        return Cloud(columns)
    kinds: dict[str, str] = {}
    while call.at_word():
        name = str(call.required("MOT")).rstrip()
        if not call.operands or call.operands[0].span.text != "*":
            raise call.error("operators.fields.component-type-missing", name=name)
        call.operands.pop(0)
        kinds[name] = str(call.required("MOT")).rstrip().upper()[:8]
    if not kinds:
        raise call.missing(("MOT",))
    rows: list[list[object]] = []
    while call.operands:
        rows.append([call.required(kind) for kind in kinds.values()])
    return Cloud({n: tuple(r[i] for r in rows) for i, n in enumerate(kinds)})


_COMPONENT = arg("component", "MOT", en="column")
_LIMIT = arg("limit", "FLOTTANT", en="limit", range=ANY_NUMBER)


@EXTR.form(gives=by("what", {"COMP": "LISTMOTS"}, "NUAGE"))
def extract_from_cloud(
    call: Call,
    cloud: Cloud = Main("NUAGE", en="cloud"),
    what: Chosen = Cases(
        {
            "COMP": [],
            "MAXI": [_COMPONENT],
            "MINI": [_COMPONENT],
            "INFE": [_COMPONENT, _LIMIT],
            "SUPE": [_COMPONENT, _LIMIT],
            "ENTR": [
                _COMPONENT,
                _LIMIT,
                arg("upper", "FLOTTANT", en="upper limit", range=ANY_NUMBER),
            ],
        },
        optional=False,
        unless=lambda cloud: getattr(cloud, "columns", ()),
        en="names of columns, or the rows to take",
    ),
) -> ListMots | Cloud:
    """Rows of a cloud, or the names of its columns."""
    word = what.word
    if word == "COMP":
        return ListMots(list(cloud.columns))
    name = what["component"].rstrip()
    values = cloud.numbers(name)
    if word in ("MAXI", "MINI"):
        place = np.argmax(values) if word == "MAXI" else np.argmin(values)
        return cloud.rows([int(place)])
    low = what["limit"]
    if word == "ENTR":
        inside = (values >= low) & (values <= what["upper"])
        return cloud.rows([int(i) for i in np.flatnonzero(inside)])
    below = word == "INFE"
    side = values <= low if below else values >= low
    if not np.any(side):
        raise call.error("operators.fields.no-row-beyond", low, name=name, below=below, low=low)
    near = np.where(side, values, -np.inf if below else np.inf)
    return cloud.rows([int(np.argmax(near) if below else np.argmin(near))])


@EXTR.form(gives=ANY)
def extract_object(
    call: Call, cloud: Cloud = Main("NUAGE", en="cloud of one row"), component: str = _COMPONENT
) -> object:
    """What a column of a cloud of one row holds."""
    name = component.rstrip()
    if name not in cloud.columns:
        raise call.error("operators.fields.cloud-lacks-component", name=name, columns=cloud.columns)
    if len(cloud) != 1:
        raise call.error("operators.fields.cloud-has-several-rows", cloud, n_rows=len(cloud))
    return cloud.columns[name][0]


@DIME.form()
def size(
    cloud: Cloud = Main("NUAGE", en="cloud"),
    what: str | None = Choice(("COMP", "UPLE"), en="columns or rows"),
) -> int:
    """Number of columns or rows."""
    return len(cloud) if what == "UPLE" else len(cloud.columns)


@REDU.form()
def reduce_cloud(
    call: Call,
    cloud: Cloud = Main("NUAGE", en="cloud"),
    names: tuple[str, ...] = Many("MOT", en="columns to keep"),
) -> Cloud:
    """Some columns of a cloud."""
    kept = [str(w).rstrip() for w in names]
    missing = [n for n in kept if n not in cloud.columns]
    if missing or not kept:
        raise call.error("operators.fields.cloud-lacks-components", cloud, missing=missing)
    return Cloud({n: cloud.columns[n] for n in kept})


@listing("NUAGE")
def _list(cloud: Cloud, short: bool, say: Teller) -> str:
    lines = [say("operators.fields.listed-cloud", count=len(cloud), n_names=len(cloud.columns))]
    for name, held in cloud.columns.items():
        kind = type_of(held[0]) if held else ""
        lines.append(say("operators.fields.listed-column", name=name, kind=kind))
        if not short and kind in ("FLOTTANT", "ENTIER"):
            lines.append("   " + " ".join(f"{v:.5E}" for v in cloud.numbers(name)))
    return "\n".join(lines)


def interpolate_cloud(
    cloud: Cloud, field: NodeField | CellField, method: str, settings: dict[str, float]
) -> NodeField | CellField:
    """Evaluate the cloud at the values of a field; settings 'PID' and 'ELIM' of the method."""
    if isinstance(field, NodeField):
        nodes = field.node_ids
        given = {k: v.at(nodes) for k, v in field.components.items()}
        made = _evaluated(cloud, given, method, settings)
        return node_algebra.rebuilt(field, {k: NodeValues(nodes, v) for k, v in made.items()})
    blocks = []
    for block in field.blocks:
        width = max((v.shape[1] for v in block.components.values()), default=1)
        shape = (len(block.cells), width)
        given = {
            k: np.broadcast_to(v, shape).ravel().astype(float) for k, v in block.components.items()
        }
        made = _evaluated(cloud, given, method, settings)
        blocks.append(cell_algebra.rebuilt(block, {k: v.reshape(shape) for k, v in made.items()}))
    return CellField(tuple(blocks), field.title)


def _evaluated(
    cloud: Cloud, given: dict[str, FloatArray], method: str, settings: dict[str, float]
) -> dict[str, FloatArray]:
    names = [n for n in cloud.columns if n in given]
    wanted = [n for n in cloud.columns if n not in given]
    if not names or not wanted:
        raise FieldError(
            "operators.fields.cloud-shares-some-components", given=given, columns=cloud.columns
        )
    at = np.stack([given[n] for n in names], axis=1)
    if method == "GRIL":
        return {wanted[-1]: _grid(cloud, names, wanted[-1], at)}
    points = np.stack([cloud.numbers(n) for n in names], axis=1)
    values = np.stack([cloud.numbers(n) for n in wanted], axis=1)
    if method == "PID":
        found = inverse_distance(points, values, at, settings["PID"], settings["ELIM"])
    else:
        found = moving_plane(points, values, at, method == "GAUS")
    return {n: found[:, i] for i, n in enumerate(wanted)}


def _grid(cloud: Cloud, names: list[str], target: str, at: FloatArray) -> FloatArray:
    lists = {n: cloud.columns[n][0] for n in (*names, target)}
    for name, held in lists.items():
        if not isinstance(held, ListReel):
            raise FieldError("operators.fields.grid-component-is-one-list", name=name)
    arrays: dict[str, Any] = {n: getattr(held, "values", None) for n, held in lists.items()}
    return on_grid([arrays[n] for n in names], arrays[target], at)
