"""EXTR, DIME, ET and LIST of models and fields in cells."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import numpy as np

from ssilang.kernel.curves.cloud import Cloud
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.solids.gradients import gradient_names
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import (
    ANY,
    Chosen,
    Entry,
    arg,
    by,
    main,
    many,
    opt,
    select,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, Mot, Table
from ssilang.messages.message import Teller
from ssilang.operators.dispatch import EXTR, UNIONS, listing, union

_NAMES: dict[str, Callable[[Zone], tuple[str, ...]]] = {
    "GEOM": lambda z: geometric_names(z).all,
    "CONT": lambda z: family_of(z).stress_names(z),
    "DEFO": lambda z: family_of(z).strain_names(z),
    "DEPL": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).unknowns)),
    "FORC": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).duals)),
    "GRAD": lambda z: gradient_names(z) if is_solid(z) else (),
    "GRAF": lambda z: (),
    "MATE": lambda z: material_names(z).all,
    "CONP": lambda z: PRINCIPAL if is_solid(z) else (),
    "TEMP": lambda z: ("T",),
    "VARI": lambda z: (),
}


def _unique(names: list[str]) -> ListMots:
    return ListMots(list(dict.fromkeys(names)))


def _zone_list(model: Model) -> Table:
    table = Table()
    for i, zone in enumerate(model.zones):
        table.set(2 * i + 1, Model((zone,)))
        table.set(2 * i + 2, Mesh(zone.cells.nodes, (zone.cells,)))
    return table


_ATTRIBUTES = {"FORM": "formulation", "CONS": "constituent", "ELEM": "element"}
_NO_NAMES = ("PARA", "NLOC", "PHAS")
"""Parameters, non-local variables and phases: no law has them."""


def _chosen(call: Call, model: Model, what: Chosen) -> Model:
    """Zones that have one of the words, or behave as all of them."""
    words = [w.rstrip() for w in what["names"]]
    if what.word == "COMP":
        words = [w.upper() for w in words]
        kept = tuple(z for z in model.zones if all(w in z.behaviour for w in words))
    else:
        attribute = _ATTRIBUTES[what.word]
        kept = tuple(z for z in model.zones if getattr(z, attribute) in words)
    if not kept:
        if what.word == "COMP":
            raise call.error("operators.fields.no-zone-behaves", model, words=words)
        raise call.error("operators.fields.no-zone-has", model, words=words)
    return Model(kept)


def _names(kind: str, en: str, fr: str) -> list[Entry]:
    return [many("names", "MOT", kind=kind, en=en, fr=fr)]


@EXTR.form(
    main("model", "MMODEL", en="model", fr="modèle"),
    select(
        "what",
        {
            "MAIL": [],
            "ZONE": [],
            "FORM": _names("formulation", "formulations", "formulations"),
            "CONS": _names("", "constituents", "constituants"),
            "ELEM": _names("element", "elements", "éléments"),
            "COMP": _names("law", "words of the law", "mots de la loi"),
            **{word: [] for word in (*_NO_NAMES, *_NAMES)},
        },
        optional=False,
        en="mesh, table of zones, zones that have some words, or names of components",
        fr="maillage, table des zones, zones qui ont certains mots, ou noms de composantes",
    ),
    gives=by(
        "what",
        {
            "MAIL": "MAILLAGE",
            "ZONE": "TABLE",
            "COMP": "MMODEL",
            **dict.fromkeys(_ATTRIBUTES, "MMODEL"),
        },
        "LISTMOTS",
    ),
    syntax="OBJ1 = EXTR MODL1 'MAIL' | 'ZONE' ;\n"
    "MODL2 = EXTR MODL1 'FORM' | 'CONS' | 'ELEM' | 'COMP' MOT1 ... ;\n"
    "LMOT1 = EXTR MODL1 'CONT' | 'DEFO' | 'DEPL' | 'FORC' | 'MATE' | 'GEOM' | 'GRAD' | 'CONP' ;",
    en="Of a model: its mesh (MAIL), a table of its zones and their meshes (ZONE), the zones of a "
    "formulation, constituent or element, or the names of the components of its stresses (CONT), "
    "strains (DEFO), displacements (DEPL), forces (FORC), parameters (MATE, GEOM), gradients "
    "(GRAD), principal stresses (CONP).",
    fr="D'un modèle : son maillage (MAIL), une table de ses zones et de leurs maillages (ZONE), "
    "les zones d'une formulation, d'un constituant ou d'un élément, ou les noms de composantes "
    "des contraintes (CONT), déformations (DEFO), déplacements (DEPL), forces (FORC), paramètres "
    "(MATE, GEOM), gradients (GRAD), contraintes principales (CONP).",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; M = MODE L MECANIQUE ELASTIQUE BARR ; "
        "LIST (NBEL (EXTR M 'MAIL')) ; LIST (EXTR M 'CONT') ;",
    ),
)
def extr_model(call: Call, model: Model, what: Chosen) -> Mesh | Table | Model | ListMots:
    """A part of a model."""
    if what.word == "MAIL":
        return model.mesh
    if what.word == "ZONE":
        return _zone_list(model)
    if what.word in _NAMES:
        return _unique([n for z in model.zones for n in _NAMES[what.word](z)])
    return ListMots() if what.word in _NO_NAMES else _chosen(call, model, what)


def _mesh_of(field: CellField) -> Mesh:
    blocks = tuple({id(b.cells): b.cells for b in field.blocks}.values())
    return Mesh(blocks[0].nodes, blocks)


def _restricted(field: CellField, what: Chosen) -> tuple[CellFieldBlock, ...]:
    """Blocks of the field, those of a model if one is given."""
    model = what["model"]
    if model is None:
        return field.blocks
    wanted = {id(z.cells) for z in model.zones}
    return tuple(b for b in field.blocks if id(b.cells) in wanted)


def _varying(field: CellField) -> ListMots:
    return _unique(
        [n for b in field.blocks for n, v in b.components.items() if v.dtype == object and v.size]
    )


def _depended_on(field: CellField) -> ListMots:
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


_OF_MODEL = [opt("model", "MMODEL", en="its zones only", fr="ses zones seulement")]
_OF_FIELD: dict[str, Callable[[CellField, Chosen], Any]] = {
    "TITR": lambda field, what: ListMots([field.title]),
    "TYPE": lambda field, what: Mot(field.title),
    "MAIL": lambda field, what: _mesh_of(field),
    "COMP": lambda field, what: _unique(
        [n for b in _restricted(field, what) for n in b.components]
    ),
    "CONS": lambda field, what: ListMots([b.constituent for b in _restricted(field, what)]),
    "COVA": lambda field, what: _varying(field),
    "DEVA": lambda field, what: _depended_on(field),
    "NBZO": lambda field, what: len({id(b.cells) for b in field.blocks}),
}


@EXTR.form(
    main("field", "MCHAML", en="field in cells", fr="champ par éléments"),
    select(
        "what",
        {word: _OF_MODEL if word in ("COMP", "CONS") else [] for word in _OF_FIELD},
        optional=False,
        unless=_own_names,
        en="sub-type, mesh, names of components or constituents, number of zones",
        fr="sous-type, maillage, noms de composantes ou constituants, nombre de zones",
    ),
    gives=by("what", {"TYPE": "MOT", "MAIL": "MAILLAGE", "NBZO": "ENTIER"}, "LISTMOTS"),
    syntax="OBJ1 = EXTR CHAM1 'TITR' | 'TYPE' | 'MAIL' | 'COMP' (MODL1) | 'CONS' | 'COVA' | 'DEVA' "
    "| 'NBZO' ;",
)
def extr_cells(field: CellField, what: Chosen) -> ListMots | Mot | Mesh | int:
    """A part of a field in cells."""
    found: ListMots | Mot | Mesh | int = _OF_FIELD[what.word](field, what)
    return found


@EXTR.form(
    main("field", "MCHAML", en="field in cells", fr="champ par éléments"),
    arg("component", "MOT", kind="component", en="component", fr="composante"),
    opt("zone", "ENTIER", en="number of the zone", fr="numéro de la zone"),
    opt("cell", "ENTIER", en="number of the cell in it", fr="numéro de l'élément"),
    opt("point", "ENTIER", en="number of the point in it", fr="numéro du point"),
    gives=ANY,
    syntax="VAL1 = EXTR CHAM1 MOT1 N1 N2 N3 ;",
    en="Of a field in cells: the value of a component in zone N1, cell N2, point N3; its type, "
    "mesh, names of components or constituents, of the components that vary (COVA: curves, "
    "clouds), of what they depend on (DEVA), number of zones.",
    fr="D'un champ par éléments : la valeur d'une composante en zone N1, élément N2, point N3 ; "
    "son type, son maillage, les noms de ses composantes ou constituants, des composantes "
    "variables (COVA : évolutions, nuages), de ce dont elles dépendent (DEVA), son nombre de "
    "zones.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (1 0) ; M = MODE L MECANIQUE ELASTIQUE BARR ; "
        "A = MATE M 'YOUN' 2. 'NU' 0.3 'SECT' 1. ; LIST (EXTR A 'YOUN' 1 3 1) ;",
    ),
)
def extr_value(
    call: Call,
    field: CellField,
    component: str,
    zone: int | None,
    cell: int | None,
    point: int | None,
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
    return values[cell - 1, 0 if values.shape[1] == 1 else point - 1]


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
            blocks[place] = CellFieldBlock(
                old.cells, ordered, old.support, old.element, old.constituent
            )
    return CellField(tuple(blocks), first.title or second.title)


def _same_place(a: CellFieldBlock, b: CellFieldBlock) -> bool:
    return (
        a.cells is b.cells
        and a.support == b.support
        and a.element == b.element
        and a.constituent == b.constituent
    )


if ("MCHAML", "MCHAML") not in UNIONS:
    union(("MCHAML", "MCHAML"))(join_cell_fields)


@listing("MMODEL")
def list_model(model: Any, short: bool, say: Teller) -> str:
    """Zones of a model, one a line."""
    lines = [say("operators.fields.listed-model", count=len(model.zones))]
    for i, z in enumerate(model.zones, start=1):
        lines.append(
            say(
                "operators.fields.listed-zone",
                number=i,
                count=len(z.cells),
                cell_type=z.cells.cell_type,
                element=z.element,
                words=[z.formulation, *z.behaviour],
                mode=z.mode.value,
                constituent=z.constituent,
            )
        )
    return "\n".join(lines)


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
