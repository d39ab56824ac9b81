"""ENLE and CHAN 'CONS' of models, what EXTR takes out of them, LIST."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.structural_gradients import names_of_gradient
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.plasticity.points import variable_names
from ssilang.language.registry import (
    Chosen,
    Entry,
    arg,
    by,
    main,
    many,
    said,
    select,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, Table
from ssilang.messages.message import Teller
from ssilang.operators.dispatch import CHAN, ENLE, EXTR, listing

_EXAMPLE = (
    "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
    "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
)


_WORD = arg("word", "MOT", en="word to remove")


@ENLE.form(
    main("model", "MMODEL", en="model"),
    select("what", {"FORM": [_WORD], "COMP": [_WORD]}, en="zones of a formulation or a behaviour"),
    syntax="MODL2 = ENLE MODL1 'FORM' | 'COMP' MOT1 ;",
    en="Of a model: without the zones of a formulation (FORM) or a behaviour (COMP); the model "
    "itself if there are none.",
    examples=(_EXAMPLE + "LIST (DIME (EXTR (ENLE MO 'COMP' 'PLASTIQUE') 'CONT')) ;",),
)
def without(call: Call, model: Model, what: Chosen | None) -> Model:
    """A model without some zones."""
    if what is None:
        raise call.error("operators.models.what-to-remove", model)
    said = what["word"].rstrip().upper()
    kept = tuple(
        z
        for z in model.zones
        if (z.formulation != said if what.word == "FORM" else said not in z.behaviour)
    )
    return model if len(kept) == len(model.zones) else Model(kept)


@CHAN.form(
    said("CONS"),
    arg("model", "MMODEL", en="model"),
    arg("constituent", "MOT", en="its new constituent"),
    of=("MMODEL",),
    syntax="MODL2 = CHAN 'CONS' MODL1 MOT1 ;",
    en="CONS changes the constituent of a model.",
    examples=(_EXAMPLE + "M2 = CHAN 'CONS' MO 'SOIL' ;",),
)
def change_constituent(call: Call, model: Model, constituent: str) -> Model:
    """Another constituent."""
    if len({z.constituent for z in model.zones}) > 1:
        raise call.error("operators.models.several-constituents", model)
    name = constituent.rstrip()
    return Model(tuple(replace(z, constituent=name) for z in model.zones))


_NAMES: dict[str, Callable[[Zone], tuple[str, ...]]] = {
    "GEOM": lambda z: geometric_names(z).all,
    "CONT": lambda z: family_of(z).stress_names(z),
    "DEFO": lambda z: family_of(z).strain_names(z),
    "DEPL": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).unknowns)),
    "FORC": lambda z: tuple(dict.fromkeys(family_of(z).layout(z).duals)),
    "GRAD": names_of_gradient,
    "GRAF": lambda z: (),
    "MATE": lambda z: material_names(z).all,
    "CONP": lambda z: PRINCIPAL if is_solid(z) else (),
    "TEMP": lambda z: ("T",),
    "VARI": variable_names,
}


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
            raise call.error("operators.models.no-zone-behaves", model, words=words)
        raise call.error("operators.models.no-zone-has", model, words=words)
    return Model(kept)


def _names(kind: str, en: str) -> list[Entry]:
    return [many("names", "MOT", at_least=1, kind=kind, en=en)]


@EXTR.form(
    main("model", "MMODEL", en="model"),
    select(
        "what",
        {
            "MAIL": [],
            "ZONE": [],
            "FORM": _names("formulation", "formulations"),
            "CONS": _names("", "constituents"),
            "ELEM": _names("element", "elements"),
            "COMP": _names("law", "words of the law"),
            **{word: [] for word in (*_NO_NAMES, *_NAMES)},
        },
        optional=False,
        en="mesh, table of zones, zones that have some words, or names of components",
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
    "LMOT1 = EXTR MODL1 'CONT' | 'DEFO' | 'DEPL' | 'FORC' | 'MATE' | 'GEOM' | 'GRAD' | 'CONP' "
    "| 'VARI' ;",
    en="Of a model: its mesh (MAIL), a table of its zones and their meshes (ZONE), the zones of a "
    "formulation, constituent or element, or the names of the components of its stresses (CONT), "
    "strains (DEFO), displacements (DEPL), forces (FORC), parameters (MATE, GEOM), gradients "
    "(GRAD), principal stresses (CONP), internal variables of a plastic law (VARI).",
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
        names = [n for z in model.zones for n in _NAMES[what.word](z)]
        return ListMots(list(dict.fromkeys(names)))
    return ListMots() if what.word in _NO_NAMES else _chosen(call, model, what)


@listing("MMODEL")
def list_model(model: Any, short: bool, say: Teller) -> str:
    """Zones of a model, one a line."""
    lines = [say("operators.models.listed-model", count=len(model.zones))]
    for i, z in enumerate(model.zones, start=1):
        lines.append(
            say(
                "operators.models.listed-zone",
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
