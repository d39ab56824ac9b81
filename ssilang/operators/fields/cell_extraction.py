"""EXTR, ET and LIST of fields in cells."""

from ssilang.kernel.curves.cloud import Cloud
from ssilang.operators.dispatch import EXTR, listing, union
from ssilang.operators.prelude import *


def _mesh_of(call: Call, field: CellField) -> Mesh:
    blocks = tuple({id(b.cells): b.cells for b in field.blocks}.values())
    return Mesh(workspace(call.session).nodes, blocks)


def _restricted(field: CellField, what: Chosen) -> tuple[CellFieldBlock, ...]:
    """Blocks of the field, those of a model if one is given."""
    model = what["model"]
    if model is None:
        return field.blocks
    wanted = {id(z.cells) for z in model.zones}
    return tuple(b for b in field.blocks if id(b.cells) in wanted)


def _unique(names: list[str]) -> ListMots:
    return ListMots(list(dict.fromkeys(names)))


def _varying(field: CellField) -> ListMots:
    return _unique(
        [n for b in field.blocks for n, v in b.components.items() if v.dtype == object and v.size]
    )


def depended_on(field: CellField) -> ListMots:
    """Names of the abscissas of curves, and of the columns of clouds but the last."""
    held = [v for b in field.blocks for a in b.components.values() if a.dtype == object
            for v in {id(x): x for x in a.ravel()}.values()]  # fmt: skip
    return _unique([n for v in held for n in _variables(v)])


def _variables(value: Any) -> list[str]:
    if isinstance(value, Curve):
        return [p.abscissa_name.rstrip() for p in value.parts]
    if isinstance(value, Cloud):
        *before, last = value.columns
        return [*before, *(n for v in value.columns[last][:1] for n in _variables(v))]
    return list(value.values) if isinstance(value, ListMots) else []


def _own_names(field: CellField) -> Collection[str]:
    return [n for b in getattr(field, "blocks", ()) for n in b.components]


_OF_MODEL = [opt("model", "MMODEL", en="its zones only")]


_OF_FIELD: dict[str, Callable[[CellField, Chosen], ListMots | Mesh | int]] = {
    **dict.fromkeys(("TITR", "TYPE"), lambda field, what: ListMots([field.title])),
    "COMP": lambda field, what: _unique(
        [n for b in _restricted(field, what) for n in b.components]
    ),
    "CONS": lambda field, what: ListMots([b.constituent for b in _restricted(field, what)]),
    "COVA": lambda field, what: _varying(field),
    "DEVA": lambda field, what: depended_on(field),
    "NBZO": lambda field, what: len({id(b.cells) for b in field.blocks}),
}


@EXTR.form(gives=by("what", {"MAIL": "MAILLAGE", "NBZO": "ENTIER"}, "LISTMOTS"))
def extr_cells(
    call: Call,
    field: CellField = Main("MCHAML", en="field in cells"),
    what: Chosen = Cases(
        {word: _OF_MODEL if word in ("COMP", "CONS") else [] for word in ("MAIL", *_OF_FIELD)},
        optional=False,
        unless=_own_names,
        en="sub-type, mesh, names of components or constituents, number of zones",
    ),
) -> ListMots | Mesh | int:
    """A part of a field in cells."""
    return _mesh_of(call, field) if what.word == "MAIL" else _OF_FIELD[what.word](field, what)


@EXTR.form(gives=ANY)
def extr_value(
    call: Call,
    field: CellField = Main("MCHAML", en="field in cells"),
    component: str = Arg("MOT", kind="component", en="component"),
    zone: int | None = Opt("ENTIER", en="number of the zone", range=POSITIVE),
    cell: int | None = Opt("ENTIER", en="number of the cell in it", range=POSITIVE),
    point: int | None = Opt("ENTIER", en="number of the point in it", range=POSITIVE),
) -> object:
    """The value of a component at a point of a cell."""
    name, names = component.rstrip(), _own_names(field)
    if name not in names:
        raise call.error(
            "operators.fields.field-no-component", field, name=name, names=dict.fromkeys(names)
        )
    if zone is None or cell is None or point is None:
        raise call.missing(("ENTIER",))
    cells = list({id(b.cells): b.cells for b in field.blocks}.values())
    if not 1 <= zone <= len(cells):
        raise call.error("operators.fields.no-such-zone", zone, n_zones=len(cells), zone=zone)
    block = next(
        (b for b in field.blocks if b.cells is cells[zone - 1] and name in b.components), None
    )
    if block is None:
        raise call.error("operators.fields.component-not-in-zone", zone, name=name, zone=zone)
    values = block.components[name]
    if not 1 <= cell <= len(block.cells):
        raise call.error(
            "operators.fields.no-such-cell", cell, zone=zone, n_cells=len(block.cells), cell=cell
        )
    values = np.broadcast_to(values, (len(block.cells), values.shape[1]))
    if values.shape[1] > 1 and not 1 <= point <= values.shape[1]:
        raise call.error(
            "operators.fields.no-such-point", point, n_points=values.shape[1], point=point
        )
    value = values[cell - 1, 0 if values.shape[1] == 1 else point - 1]
    return ListReel(value.ravel()) if isinstance(value, np.ndarray) else value  # Hooke's matrix


def join_cell_fields(first: CellField, second: CellField) -> CellField:
    """Blocks of both; those over the same cells and points are put together, the first first."""
    blocks = list(first.blocks)
    for new in second.blocks:
        place = next((i for i, b in enumerate(blocks) if _same_place(b, new)), None)
        if place is None:
            blocks.append(new)
        else:
            old = blocks[place]
            merged = {**new.components, **old.components}
            ordered = {n: merged[n] for n in (*old.components, *new.components)}
            blocks[place] = replace(old, components=ordered)
    return CellField(tuple(blocks), first.title or second.title)


def _same_place(a: CellFieldBlock, b: CellFieldBlock) -> bool:
    return (
        a.cells is b.cells
        and a.support == b.support
        and a.element == b.element
        and a.constituent == b.constituent
    )


union(("MCHAML", "MCHAML"))(join_cell_fields)


@listing("MCHAML")
def list_cells(field: Any, short: bool, say: Teller) -> str:
    """Zones of a field in cells with the range of each component."""
    lines = [say("operators.fields.listed-field", title=field.title, count=len(field.blocks))]
    for i, b in enumerate(field.blocks, start=1):
        lines.append(
            say(
                "operators.fields.listed-cells",
                number=i,
                count=len(b.cells),
                cell_type=b.cells.cell_type,
                support=b.support,
            )
        )
        for name, values in b.components.items():
            if values.dtype == object:
                lines.append(f"     {name:<8} {type(values.flat[0]).__name__}")
            else:
                low, high = values.min(), values.max()
                lines.append(say("operators.fields.listed-range", name=name, low=low, high=high))
    return "\n".join(lines)
