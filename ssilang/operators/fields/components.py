"""EXCO NOMC MANU CHAN EXTR REDU ENLE COPI on fields: components, supports, natures."""

from ssilang.kernel.fields import cell_algebra, node_algebra
from ssilang.operators.curves.instants import refused_place, tell_zero
from ssilang.operators.dispatch import CHAN, COPI, ENLE, EXTR, REDU
from ssilang.operators.fields.signs import names_of, nature_of, nature_word
from ssilang.operators.prelude import *

_FIELDS = ("CHPOINT", "MCHAML")
_LAGRANGE = frozenset({"LX", "FLX"})


_FIELD = arg("field", *_FIELDS, en="field", range=ANY_NUMBER)
_NODAL = arg("field", "CHPOINT", en="field at nodes")
_IN_CELLS = arg("field", "MCHAML", en="field in cells")
NATURE = key(
    "nature", "NATURE", "MOT", en="DIFFUS (as displacements), DISCRET (as forces) or INDETERMINE"
)
_LENIENT = flag("lenient", "NOID", en="a missing component is no error")


@operator("EXCO", gives=Like("field"), family="fields", full_name="EXCO")
def exco(
    call: Call,
    wanted: ListMots = Arg("LISTMOTS", en="components wanted", distinct=True),
    lenient: bool = _LENIENT,
    field: NodeField | CellField = _FIELD,
    new: ListMots | None = Opt("LISTMOTS", en="their new names", distinct=True),
    nature: str | None = NATURE,
) -> NodeField | CellField:
    """Extract several components."""
    old = names_of(wanted)
    names = old if new is None else names_of(new)
    if len(names) != len(old):
        raise call.error("operators.fields.new-name-count", new, n_old=len(old), n_new=len(names))
    return _extracted(call, field, old, names, lenient, nature)


@exco.form(gives=Like("field"))
def exco_one(
    call: Call,
    wanted: str = Arg("MOT", kind="component", en="component wanted"),
    lenient: bool = _LENIENT,
    field: NodeField | CellField = _FIELD,
    nature: str | None = NATURE,
    new: str | None = Opt("MOT", en="its new name"),
) -> NodeField | CellField:
    """Extract one component."""
    old = wanted.rstrip()
    alone = "SCAL" if isinstance(field, NodeField) else old
    name = alone if new is None else new.rstrip()
    return _extracted(call, field, [old], [name], lenient, nature)


def _extracted(
    call: Call,
    field: NodeField | CellField,
    old: list[str],
    names: list[str],
    lenient: bool,
    nature: str | None,
) -> NodeField | CellField:
    if isinstance(field, CellField):
        return cell_algebra.extracted(field, old, names, not lenient)
    made: dict[str, NodeValues] = {}
    for name, target in zip(old, names, strict=True):
        if name in field.components or not lenient:
            made[target] = node_algebra.component(field, name)
    return node_algebra.rebuilt(field, made, nature_of(call, nature))


_NEW_NAMES = (
    arg("old", "LISTMOTS", en="names to change"),
    arg("new", "LISTMOTS", en="new names", distinct=True),
    _FIELD,
    NATURE,
)
_ONE_NAME = (
    arg("name", "MOT", en="name of the only component"),
    _FIELD,
    NATURE,
)


@operator("NOMC", *_NEW_NAMES, gives=Like("field"), family="fields")
def nomc(
    call: Call, old: ListMots, new: ListMots, field: NodeField | CellField, nature: str | None
) -> NodeField | CellField:
    """Rename components of two lists."""
    names = names_of(old), names_of(new)
    if len(names[0]) != len(names[1]):
        raise call.error(
            "operators.fields.renamed-name-count", old, n_old=len(names[0]), n_new=len(names[1])
        )
    return _renamed(call, field, *names, nature)


@nomc.form(*_ONE_NAME, gives=Like("field"))
def nomc_alone(
    call: Call, name: str, field: NodeField | CellField, nature: str | None
) -> NodeField | CellField:
    """Rename the only component."""
    known = (
        list(field.components)
        if isinstance(field, NodeField)
        else cell_algebra.component_names(field)
    )
    if len(known) > 1:
        raise call.error("operators.fields.one-name-not-enough", name, n_known=len(known))
    return _renamed(call, field, known, [name.rstrip()] * len(known), nature)


def _renamed(
    call: Call, field: NodeField | CellField, old: list[str], new: list[str], nature: str | None
) -> NodeField | CellField:
    if isinstance(field, CellField):
        return cell_algebra.renamed(field, old, new)
    return _with_nature(call, node_algebra.renamed(field, old, new), nature)


def _with_nature(call: Call, field: NodeField, word: str | None) -> NodeField:
    return node_algebra.rebuilt(field, field.components, nature_of(call, word))


CHAN.form(said("COMP"), *_NEW_NAMES, of=_FIELDS, gives=Like("field"))(nomc.forms[0].function)
CHAN.form(said("COMP"), *_ONE_NAME, of=_FIELDS, gives=Like("field"))(nomc_alone)


@CHAN.form(said("ATTR"))
def change_nature(call: Call, field: NodeField = _NODAL, nature: str | None = NATURE) -> NodeField:
    """Another nature."""
    return _with_nature(call, field, nature)


@CHAN.form(said("TITR"), of=("CHPOINT",))
def change_title(
    field: NodeField = _NODAL, title: str = Arg("MOT", en="its new title")
) -> NodeField:
    """Another title."""
    return NodeField(field.table, field.components, field.nature, str(title))


@CHAN.form(said("TYPE"), of=("MCHAML",))
def change_type(
    field: CellField = _IN_CELLS, title: str = Arg("MOT", en="its new sub-type")
) -> CellField:
    """Another sub-type."""
    return CellField(field.blocks, title.rstrip())


@CHAN.form(said("CONS"), of=("MCHAML",))
def change_constituent(
    field: CellField = _IN_CELLS, constituent: str = Arg("MOT", en="its new constituent")
) -> CellField:
    """Another constituent."""
    name = constituent.rstrip()
    blocks = tuple(replace(b, constituent=name) for b in field.blocks)
    return CellField(blocks, field.title)


# ---- EXTR ---------------------------------------------------------------------------------------


def support_nodes(support: Point | Mesh) -> IntArray:
    """Nodes of a point or a mesh, in order; those of a mesh of points as they stand."""
    blocks = () if isinstance(support, Point) else support.blocks
    if blocks and all(b.cell_type == "POI1" for b in blocks):
        return np.concatenate([b.connectivity[:, 0] for b in blocks])
    return support.node_ids


@EXTR.form(gives=by("what", {"VALE": "LISTREEL", "MAIL": "MAILLAGE", "COMP": "LISTMOTS"}, "MOT"))
def extract(
    call: Call,
    field: NodeField = Main("CHPOINT", en="field at nodes"),
    what: Chosen = Cases(
        {
            "VALE": [
                _LENIENT,
                opt("names", "LISTMOTS", "MOT", en="components, else all"),
                opt("support", "POINT", "MAILLAGE", en="points, in their order"),
            ],
            "MAIL": [flag("without", "NOMU", en="without the points of multipliers")],
            "COMP": [],
            "TITR": [],
            "TYPE": [],
            "NATU": [],
        },
        optional=False,
        unless=lambda field: getattr(field, "components", ()),
        en="values as a list, mesh of points, names of components, title, type or nature",
    ),
) -> ListReel | Mesh | ListMots | Mot:
    """A part of a field at nodes."""
    if what.word == "VALE":
        wanted = what["names"]
        support = what["support"]
        names = list(field.components) if wanted is None else names_of(wanted)
        if not what["lenient"]:
            for name in names:
                node_algebra.component(field, name)
            if isinstance(support, Point) and names:
                _tell_foreign(call, field, names[0], support)
        nodes = None if support is None else support_nodes(support)
        return ListReel(node_algebra.values_in_order(field, names, nodes))
    if what.word == "MAIL":
        return _points_of(field, what["without"])
    if what.word == "COMP":
        return ListMots(list(field.components))
    told = {"TITR": field.title, "TYPE": " " * 8, "NATU": nature_word(field.nature)}
    return Mot(told[what.word])


@EXTR.form()
def value_at(
    call: Call,
    field: NodeField = Main("CHPOINT", en="field at nodes"),
    component: str = Arg("MOT", kind="component", en="component"),
    point: Point = Arg("POINT", en="where"),
) -> float:
    """A component at a point."""
    name = component.rstrip()
    node_algebra.component(field, name)
    _tell_foreign(call, field, name, point)
    return float(node_algebra.values_in_order(field, [name], np.asarray([point.node]))[0])


def _tell_foreign(call: Call, field: NodeField, name: str, point: Point) -> None:
    """Warn of a point that the field does not stand on; forces are zero where none acts."""
    if field.nature != "DISCRET" and not field.stands_on(point.node):
        tell_zero(call, refused_place(call, [field], name, point.node))


def _points_of(field: NodeField, without_multipliers: bool) -> Mesh:
    parts = [
        p.nodes for k, p in field.components.items() if not (without_multipliers and k in _LAGRANGE)
    ]
    nodes = np.unique(np.concatenate(parts)) if parts else np.empty(0, dtype=np.int64)
    return Mesh.of(field.table, "POI1", nodes[:, None])


# ---- REDU, ENLE, COPI ---------------------------------------------------------------------------


@REDU.form()
def reduce(
    field: NodeField = Main("CHPOINT", en="field at nodes"),
    support: Mesh | Point | NodeField = Arg(
        "MAILLAGE", "POINT", "CHPOINT", en="points that stay, or field that is not zero there"
    ),
) -> NodeField:
    """A field on fewer nodes."""
    if not isinstance(support, NodeField):
        return node_algebra.restricted(field, support_nodes(support))
    kept = [v.nodes[v.values != 0] for v in support.components.values()]
    nodes = np.concatenate(kept) if kept else np.empty(0, dtype=np.int64)
    return node_algebra.restricted(field, nodes)


@ENLE.form()
def without(
    field: NodeField = Main("CHPOINT", en="field at nodes"),
    names: str | ListMots = Arg("MOT", "LISTMOTS", kind="component", en="components"),
) -> NodeField:
    """A field without some components."""
    gone = set(names_of(names))
    return node_algebra.rebuilt(field, {k: v for k, v in field.components.items() if k not in gone})


@COPI.form(gives=Like("field"))
def copy(
    field: NodeField | CellField = Main(*_FIELDS, en="field"),
    shape: bool = Flag("GEOM", en="accepted, changes nothing"),
) -> NodeField | CellField:
    """A field of its own with the same values."""
    if isinstance(field, NodeField):
        return node_algebra.rebuilt(field, dict(field.components))
    return CellField(field.blocks, field.title)
