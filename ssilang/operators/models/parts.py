"""ENLE and CHAN 'CONS' of models, DIME of matrices, MANU 'CHAM' of one value."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np

from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.run.call import Call
from ssilang.operators.dispatch import CHAN, DIME, ENLE, MANU

_EXAMPLE = (
    "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
    "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
)
_SUPPORTS = ("NOEUD", "GRAVITE", "RIGIDITE", "MASSE", "STRESSES")


@ENLE.on(
    "MMODEL",
    syntax="MODL2 = ENLE MODL1 'FORM' | 'COMP' MOT1 ;",
    en="Of a model: without the zones of a formulation (FORM) or a behaviour (COMP); the model "
    "itself if there are none.",
    fr="D'un modèle : sans les zones d'une formulation (FORM) ou d'un comportement (COMP) ; le "
    "modèle lui-même s'il n'y en a pas.",
    examples=(_EXAMPLE + "LIST (DIME (EXTR (ENLE MO 'COMP' 'PLASTIQUE') 'CONT')) ;",),
)
def _without(call: Call, model: Model) -> Model:
    word = call.keyword(("FORM", "COMP"))
    if word is None:
        raise call.error("operators.models.what-to-remove", model)
    said = str(call.required("MOT", after=call.keyword_end)).rstrip().upper()
    kept = tuple(
        z
        for z in model.zones
        if (z.formulation != said if word == "FORM" else said not in z.behaviour)
    )
    return model if len(kept) == len(model.zones) else Model(kept)


@CHAN.on(
    "CONS",
    of=("MMODEL",),
    syntax="MODL2 = CHAN 'CONS' MODL1 MOT1 ;",
    en="CONS changes the constituent of a model.",
    fr="CONS change le constituant d'un modèle.",
    examples=(_EXAMPLE + "M2 = CHAN 'CONS' MO 'SOIL' ;",),
)
def _constituent(call: Call, word: str) -> Model:
    model: Model = call.required("MMODEL")
    name = str(call.required("MOT")).rstrip()
    if len({z.constituent for z in model.zones}) > 1:
        raise call.error("operators.models.several-constituents", model)
    return Model(tuple(replace(z, constituent=name) for z in model.zones))


@DIME.on(
    "RIGIDITE",
    en="Of a matrix: its number of unknowns.",
    fr="D'une rigidité : son nombre d'inconnues.",
    examples=(_EXAMPLE + "LIST (DIME (RIGI MO (MATE MO 'YOUN' 1. 'NU' 0. 'SECT' 1.))) ;",),
)
def _unknowns(call: Call, matrix: Matrix) -> int:
    return numbering_of(matrix).size


@MANU.on(
    "CHAM",
    of=("MMODEL",),
    syntax="CHAM1 = MANU 'CHAM' MODL1 ('TYPE' MOT1) ('POSI' MOT2) MOT3 N1 N2 (N3) X1 ;",
    en="CHAM on a model: zero everywhere but X1 in cell N1 at point N2 of zone N3.",
    fr="CHAM sur un modèle : nul partout sauf X1 dans l'élément N1 au point N2 de la zone N3.",
    examples=(_EXAMPLE + "LIST (MAXI (MANU 'CHAM' MO 'POSI' 'GRAVITE' 'V' 2 1 7.)) ;",),
)
def _single_value(call: Call, word: str) -> CellField:
    model: Model = call.required("MMODEL")
    title, support = "", "NOEUD"
    while (said := call.keyword(("TYPE", "POSI"))) is not None:
        value = str(call.required("MOT", after=call.keyword_end)).rstrip()
        title, support = (value, support) if said == "TYPE" else (title, value)
    if support not in _SUPPORTS:
        raise call.error("operators.models.no-support", support=support, supports=_SUPPORTS)
    name = str(call.required("MOT")).rstrip()
    cell, point = call.required("ENTIER"), call.required("ENTIER")
    place = call.optional("ENTIER", default=1)
    value = call.required("FLOTTANT")
    if not 1 <= place <= len(model.zones):
        raise call.error(
            "operators.models.no-such-zone", place, n_zones=len(model.zones), place=place
        )
    zone = model.zones[place - 1]
    at = cast(Support, support)
    count = zone.cells.kind.n_nodes if at == "NOEUD" else n_points(zone.element, at)
    if not 1 <= cell <= len(zone.cells) or not 1 <= point <= count:
        raise call.error(
            "operators.models.no-such-point", cell, n_cells=len(zone.cells), count=count
        )
    values = np.zeros((len(zone.cells), count))
    values[cell - 1, point - 1] = value
    element = "" if at == "NOEUD" else zone.element
    block = CellFieldBlock(zone.cells, {name: values}, at, element, zone.constituent)
    return CellField((block,), title)
