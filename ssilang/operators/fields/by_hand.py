"""MANU 'CHPO' and 'CHML': fields from values; ZERO: fields of zeros."""

from ssilang.kernel.elements.families import family_of, plastic_strain_names
from ssilang.kernel.elements.results.structural_gradients import names_of_gradient
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.solids.solid_moduli import hooke_block
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields.cell_algebra import through
from ssilang.kernel.fields.node_field import Nature
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.statics.constitutive import variable_names
from ssilang.operators.dispatch import MANU
from ssilang.operators.fields.cell_supports import SUPPORTS
from ssilang.operators.fields.components import NATURE, support_nodes
from ssilang.operators.fields.signs import names_of, nature_of
from ssilang.operators.prelude import *
from ssilang.operators.statics.stresses import on_zones

_TITLE = key("title", "TITRE", "MOT", en="title of the field")


_ON_NODES = arg("support", "MAILLAGE", "POINT", en="mesh or point that carries the field")


@MANU.form(said("CHPO"))
def node_field(
    call: Call,
    title: str | None = _TITLE,
    nature: str | None = NATURE,
    count: int | None = Opt("ENTIER", en="number of pairs", range=POSITIVE),
    support: Point | Mesh = _ON_NODES,
    pairs: list[tuple[str, Any]] = Each(
        arg("component", "MOT", en="name of a component", distinct=True),
        arg(
            "value", "FLOTTANT", "LISTREEL", en="its value, or one value a point", range=ANY_NUMBER
        ),
        at_least=1,
        times="count",
    ),
) -> NodeField:
    """Field at nodes from pairs of a component and its value."""
    named = [(name.rstrip()[:8], value) for name, value in pairs]
    return _on_nodes(call, support, named, nature_of(call, nature) or "", title or "")


@MANU.form(said("CHPO"))
def node_field_of_lists(
    call: Call,
    title: str | None = _TITLE,
    nature: str | None = NATURE,
    support: Point | Mesh = _ON_NODES,
    names: ListMots = Arg("LISTMOTS", en="names of the components"),
    values: ListReel = Arg(
        "LISTREEL", en="their values, 0 for those behind the last", range=ANY_NUMBER
    ),
) -> NodeField:
    """Field at nodes, the same value everywhere, from lists of components and values."""
    given = values.values.tolist()
    pairs = [(n, given[i] if i < len(given) else 0.0) for i, n in enumerate(names_of(names))]
    return _on_nodes(call, support, pairs, nature_of(call, nature) or "", title or "")


def _on_nodes(
    call: Call, support: Point | Mesh, pairs: list[tuple[str, Any]], nature: Nature, title: str
) -> NodeField:
    nodes = support_nodes(support)
    made: dict[str, NodeValues] = {}
    for name, value in pairs:
        listed = isinstance(value, ListReel)
        if listed and len(value) != len(nodes):
            raise call.error(
                "operators.fields.values-per-point", value, n_values=len(value), n_nodes=len(nodes)
            )
        values = value.values if listed else np.full(len(nodes), float(value))
        made[name] = _merged(call, name, nodes, values, nature)
    return NodeField(support.nodes, made, nature, title)


def _merged(
    call: Call, name: str, nodes: IntArray, values: FloatArray, nature: Nature
) -> NodeValues:
    """Values of repeated nodes: summed when DISCRET, else they must be equal."""
    ids, first, place = np.unique(nodes, return_index=True, return_inverse=True)
    if len(ids) == len(nodes):
        return NodeValues(ids, values[first])
    if nature == "DISCRET":
        return NodeValues(ids, np.bincount(place, weights=values).astype(float))
    if nature == "DIFFUS" and np.any(values != values[first][place]):
        raise call.error("operators.fields.node-twice-with-other-values", name=name)
    return NodeValues(ids, values[first])


# ---- in cells -----------------------------------------------------------------------------------


_CURVES = (
    said("CHML", "CHAM"),
    choice("curves", ("EVOL",), optional=False, en="curves"),
    arg("name", "MOT", en="name of their abscissas"),
)


@MANU.form(*_CURVES)
def curves_in_cells(
    call: Call,
    curves: str,
    name: str,
    pairs: list[tuple[float, CellField]] = Each(
        arg("abscissa", "FLOTTANT", en="abscissa", range=ANY_NUMBER),
        arg("field", "MCHAML", en="values there"),
        at_least=1,
    ),
) -> CellField:
    """Curves from fields in cells."""
    return through(name.rstrip(), [x for x, _ in pairs], [f for _, f in pairs])


@MANU.form(*_CURVES, arg("table", "TABLE", en="fields by abscissa"))
def curves_of_table(call: Call, curves: str, name: str, table: Table) -> CellField:
    """Curves from a table of fields in cells."""
    rows = [
        (float(k), v)
        for k, v in table.items()
        if isinstance(k, int | float) and isinstance(v, CellField)
    ]
    if not rows:
        raise call.error("operators.fields.table-of-fields", table)
    return through(name.rstrip(), [x for x, _ in rows], [f for _, f in rows])


@MANU.form(said("CHML", "CHAM"))
def cell_field(
    call: Call,
    support: Mesh | Model = Arg("MAILLAGE", "MMODEL", en="mesh or model that carries the field"),
    title: str | None = Key("TYPE", "MOT", en="sub-type of the field"),
    constituent: str | None = Key("CONS", "MOT", en="constituent"),
    position: str | None = Key("POSI", "MOT", en="points: NOEUD ..."),
    deal: bool = Flag("REPA", en="the values of a list are dealt out, one a cell"),
    points: str | None = Choice(
        ("NOEUD", "GRAVITE", "STRESSES"), en="points that carry the values"
    ),
    integration: str | None = Choice(
        ("RIGIDITE", "MASSE"), length=8, en="points that carry the values"
    ),
    pairs: list[tuple[str, Any]] = Each(
        arg("component", "MOT", en="name of a component", distinct=True),
        arg("value", en="its value or object"),
        at_least=1,
    ),
    place: tuple[float, ...] = Many(
        "FLOTTANT",
        en="of a field that is zero but at one point, whose cell was the value: number of the "
        "point, of the zone if not 1, then the value",
        range=ANY_NUMBER,
    ),
) -> CellField:
    """Field in cells from pairs of a component and its value, or zero but at one point."""
    at = points or integration or (position or "NOEUD").rstrip()
    if at not in SUPPORTS:
        raise call.error("operators.fields.no-support", support=at, supports=SUPPORTS)
    kind = (title or "").rstrip()
    named = [(name.rstrip(), value) for name, value in pairs]
    if place:
        name, cell = named[-1]
        return _at_one_point(call, support, name, (cell, *place), at, kind)
    said = None if constituent is None else constituent.rstrip()
    return _in_cells(support, named, at, kind, said, deal)


def _at_one_point(
    call: Call,
    model: Mesh | Model,
    name: str,
    numbers: tuple[Any, ...],
    at: Support,
    title: str,
) -> CellField:
    """Zero but at one point: numbers of cell, point (and zone), then the value."""
    whole = all(float(n).is_integer() for n in numbers[:-1] if isinstance(n, int | float))
    if not isinstance(model, Model) or len(numbers) not in (3, 4) or not whole:
        raise call.error("operators.fields.one-point-field-needs")
    cell, point = int(numbers[0]), int(numbers[1])
    number = int(numbers[2]) if len(numbers) == 4 else 1
    if not 1 <= number <= len(model.zones):
        raise call.error(
            "operators.fields.model-has-no-such-zone", n_zones=len(model.zones), zone=number
        )
    zone = model.zones[number - 1]
    shape = (len(zone.cells), n_points(zone.element, at))
    if not (1 <= cell <= shape[0] and 1 <= point <= shape[1]):
        raise call.error(
            "operators.fields.zone-has-no-such-point", n_cells=shape[0], n_points=shape[1]
        )
    values = np.zeros(shape)
    values[cell - 1, point - 1] = float(numbers[-1])
    element = "" if at == "NOEUD" else zone.element
    block = CellFieldBlock(zone.cells, {name: values}, at, element, zone.constituent)
    return CellField((block,), title)


def _in_cells(
    support: Mesh | Model,
    pairs: list[tuple[str, Any]],
    at: Support,
    title: str,
    named: str | None,
    deal: bool,
) -> CellField:
    blocks = []
    zones: list[tuple[CellBlock, str, str]]
    if isinstance(support, Model):
        zones = [(z.cells, z.element, z.constituent) for z in support.zones]
    else:
        zones = [(cells, "", "") for cells in support.blocks]
        at = "NOEUD"
    taken = 0
    for cells, element, constituent in zones:
        made = {n: _cell_values(v, len(cells), deal, taken) for n, v in pairs}
        taken += len(cells)
        said = constituent if named is None else named
        blocks.append(CellFieldBlock(cells, made, at, element if at != "NOEUD" else "", said))
    return CellField(tuple(blocks), title)


def _cell_values(value: Any, n: int, deal: bool, taken: int) -> Any:
    if isinstance(value, bool):
        value = 1.0 if value else 2.0
    if isinstance(value, int | float):
        return np.full((n, 1), float(value))
    if deal and isinstance(value, ListReel) and len(value):
        return value.values[(taken + np.arange(n)) % len(value)][:, None]
    made = np.empty((n, 1), dtype=object)
    made[:, 0] = [value] * n
    return made


_TITLES: dict[str, tuple[str, Support]] = {
    **{support: ("SCALAIRE", support) for support in SUPPORTS},
    "DEPLACEM": ("DEPLACEMENTS", "NOEUD"),
    "FORCES": ("FORCES", "NOEUD"),
    "TEMPERAT": ("TEMPERATURES", "NOEUD"),
    "GRADIENT": ("GRADIENT", "STRESSES"),
    "CONTRAIN": ("CONTRAINTES", "STRESSES"),
    "DEFORMAT": ("DEFORMATIONS", "STRESSES"),
    "PRINCIPA": ("PRINCIPALE", "STRESSES"),
    "MATERIAU": ("CARACTERISTIQUES", "STRESSES"),
    "CARACTER": ("CARACTERISTIQUES", "STRESSES"),
    "DEFINELA": ("DEFORMATIONS INELASTIQUES", "STRESSES"),
    "VARINTER": ("VARIABLES INTERNES", "STRESSES"),
    "MAHOOKE": ("MATRICE DE HOOKE", "RIGIDITE"),
    "HOTANGEN": ("MATRICE DE HOOKE TANGENTE", "RIGIDITE"),
}


_NAMES: dict[str, Callable[[Zone], tuple[str, ...]]] = {
    "DEPLACEM": lambda zone: tuple(dict.fromkeys(family_of(zone).layout(zone).unknowns)),
    "FORCES": lambda zone: tuple(dict.fromkeys(family_of(zone).layout(zone).duals)),
    "TEMPERAT": lambda zone: ("T",),
    "GRADIENT": lambda zone: names_of_gradient(zone),
    "CONTRAIN": lambda zone: family_of(zone).stress_names(zone),
    "DEFORMAT": lambda zone: family_of(zone).strain_names(zone),
    "DEFINELA": plastic_strain_names,
    "PRINCIPA": lambda zone: PRINCIPAL,
    "MATERIAU": lambda zone: material_names(zone).all,
    "CARACTER": lambda zone: geometric_names(zone).all,
    "VARINTER": lambda zone: variable_names(zone) or ("EPSE",),
}
"""Names of components in a zone, by the word for a kind of field."""


@operator("ZERO", family="fields")
def zero(
    call: Call,
    model: Model = Arg("MMODEL", en="model"),
    word: str | None = Choice(tuple(_TITLES), length=8, en="points of a scalar, or kind of field"),
) -> CellField:
    """Zeros."""
    if word is None:
        raise call.error("operators.fields.which-zeros", titles=_TITLES)
    title, support = _TITLES[word]

    def make(zone: Zone) -> CellFieldBlock:
        if word in ("MAHOOKE", "HOTANGEN"):
            s = len(family_of(zone).strain_names(zone))
            return hooke_block(zone, np.zeros((1, n_points(zone.element, support), s, s)), support)
        shape = (len(zone.cells), n_points(zone.element, support))
        names = _NAMES[word](zone) if word in _NAMES else ("SCAL",)
        return zone.block({n: np.zeros(shape) for n in names}, support)

    return on_zones(model, title, make)
