"""EXTR, DIME, ET and LIST of models and fields in cells."""

from __future__ import annotations

from collections.abc import Callable
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
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, Mot, Table
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


def _zone_list(call: Call, model: Model) -> Table:
    table = Table()
    for i, zone in enumerate(model.zones):
        table.set(2 * i + 1, Model((zone,)))
        table.set(2 * i + 2, Mesh(zone.cells.nodes, (zone.cells,)))
    return table


def _chosen(attribute: str) -> Callable[[Call, Model], Model]:
    def choose(call: Call, model: Model) -> Model:
        words = [w.rstrip() for w in iter(call.word, None) if w is not None]
        kept = tuple(z for z in model.zones if getattr(z, attribute) in words)
        if not kept:
            raise call.error("operators.fields.no-zone-has", model, words=words)
        return Model(kept)

    return choose


def _behaving(call: Call, model: Model) -> Model:
    """Zones whose behaviour has all the words that follow."""
    words = [w.rstrip().upper() for w in iter(call.word, None) if w is not None]
    kept = tuple(z for z in model.zones if all(w in z.behaviour for w in words))
    if not kept:
        raise call.error("operators.fields.no-zone-behaves", model, words=words)
    return Model(kept)


_OF_MODEL: dict[str, Callable[[Call, Model], Any]] = {
    "MAIL": lambda call, model: model.mesh,
    "ZONE": _zone_list,
    "FORM": _chosen("formulation"),
    "CONS": _chosen("constituent"),
    "ELEM": _chosen("element"),
    "COMP": _behaving,
    "PARA": lambda call, model: ListMots(),
    "NLOC": lambda call, model: ListMots(),
    "PHAS": lambda call, model: ListMots(),
}


@EXTR.on(
    "MMODEL",
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
def extr_model(call: Call, model: Model) -> Any:
    """A part of a model."""
    word = call.keyword((*_OF_MODEL, *_NAMES))
    if word is None:
        raise call.error("operators.fields.extr-words-of-model", model, words=(*_OF_MODEL, *_NAMES))
    if word in _OF_MODEL:
        return _OF_MODEL[word](call, model)
    return _unique([n for z in model.zones for n in _NAMES[word](z)])


def _mesh_of(field: CellField) -> Mesh:
    blocks = tuple({id(b.cells): b.cells for b in field.blocks}.values())
    return Mesh(blocks[0].nodes, blocks)


def _restricted(call: Call, field: CellField) -> tuple[CellFieldBlock, ...]:
    """Blocks of the field, those of a model if one follows."""
    model = call.optional("MMODEL")
    if model is None:
        return field.blocks
    wanted = {id(z.cells) for z in model.zones}
    return tuple(b for b in field.blocks if id(b.cells) in wanted)


def _varying(call: Call, field: CellField) -> ListMots:
    return _unique(
        [n for b in field.blocks for n, v in b.components.items() if v.dtype == object and v.size]
    )


def _depended_on(call: Call, field: CellField) -> ListMots:
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


_OF_FIELD: dict[str, Callable[[Call, CellField], Any]] = {
    "TITR": lambda call, field: ListMots([field.title]),
    "TYPE": lambda call, field: Mot(field.title),
    "MAIL": lambda call, field: _mesh_of(field),
    "COMP": lambda call, field: _unique(
        [n for b in _restricted(call, field) for n in b.components]
    ),
    "CONS": lambda call, field: ListMots([b.constituent for b in _restricted(call, field)]),
    "COVA": _varying,
    "DEVA": _depended_on,
    "NBZO": lambda call, field: len({id(b.cells) for b in field.blocks}),
}


@EXTR.on(
    "MCHAML",
    syntax="VAL1 = EXTR CHAM1 MOT1 N1 N2 N3 ;\n"
    "OBJ1 = EXTR CHAM1 'TYPE' | 'MAIL' | 'COMP' (MODL1) | 'CONS' | 'COVA' | 'DEVA' | 'NBZO' ;",
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
def extr_cells(call: Call, field: CellField) -> Any:
    """A part of a field in cells."""
    names = [n for b in field.blocks for n in b.components]
    said = (call.peek_word() or "").rstrip()
    if said not in names or not any(isinstance(o.value, int) for o in call.operands):
        word = call.keyword(tuple(_OF_FIELD))
        if word is not None:
            return _OF_FIELD[word](call, field)
    name = (call.word() or "").rstrip()
    if name not in names:
        raise call.error(
            "operators.fields.field-no-component", field, name=name, names=dict.fromkeys(names)
        )
    return _value(call, field, name)


def _value(call: Call, field: CellField, name: str) -> Any:
    zone, cell, point = (call.required("ENTIER") for _ in range(3))
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
def list_model(model: Any, word: str) -> str:
    """Zones of a model, one a line."""
    lines = [f"MMODEL with {len(model.zones)} zone(s)"]
    for i, z in enumerate(model.zones, start=1):
        words = " ".join((z.formulation, *z.behaviour))
        lines.append(
            f"  {i}: {len(z.cells)} cells {z.cells.cell_type}, element {z.element}, {words}, "
            f"mode {z.mode.value}" + (f", constituent {z.constituent}" if z.constituent else "")
        )
    return "\n".join(lines)


@listing("MCHAML")
def list_cells(field: Any, word: str) -> str:
    """Zones of a field in cells with the range of each component."""
    lines = [f"MCHAML {field.title or '(no type)'}, {len(field.blocks)} zone(s)"]
    for i, b in enumerate(field.blocks, start=1):
        lines.append(f"  {i}: {len(b.cells)} cells {b.cells.cell_type}, at {b.support}")
        for name, values in b.components.items():
            if values.dtype == object:
                lines.append(f"     {name:<8} {type(values.flat[0]).__name__}")
            else:
                lines.append(f"     {name:<8} {values.min():12.5E} to {values.max():12.5E}")
    return "\n".join(lines)
