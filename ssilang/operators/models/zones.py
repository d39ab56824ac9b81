"""ENLE and CHAN 'CONS' of models, DIME of matrices."""

from __future__ import annotations

from dataclasses import replace

from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.language.registry import Chosen, arg, main, said, select
from ssilang.language.run.call import Call
from ssilang.operators.dispatch import CHAN, DIME, ENLE

_EXAMPLE = (
    "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
    "MO = MODE L 'MECANIQUE' 'ELASTIQUE' 'BARR' ; "
)


_WORD = arg("word", "MOT", en="word to remove", fr="mot à enlever")


@ENLE.form(
    main("model", "MMODEL", en="model", fr="modèle"),
    select(
        "what",
        {"FORM": [_WORD], "COMP": [_WORD]},
        en="zones of a formulation or a behaviour",
        fr="zones d'une formulation ou d'un comportement",
    ),
    syntax="MODL2 = ENLE MODL1 'FORM' | 'COMP' MOT1 ;",
    en="Of a model: without the zones of a formulation (FORM) or a behaviour (COMP); the model "
    "itself if there are none.",
    fr="D'un modèle : sans les zones d'une formulation (FORM) ou d'un comportement (COMP) ; le "
    "modèle lui-même s'il n'y en a pas.",
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
    arg("model", "MMODEL", en="model", fr="modèle"),
    arg("constituent", "MOT", en="its new constituent", fr="son nouveau constituant"),
    of=("MMODEL",),
    syntax="MODL2 = CHAN 'CONS' MODL1 MOT1 ;",
    en="CONS changes the constituent of a model.",
    fr="CONS change le constituant d'un modèle.",
    examples=(_EXAMPLE + "M2 = CHAN 'CONS' MO 'SOIL' ;",),
)
def change_constituent(call: Call, model: Model, constituent: str) -> Model:
    """Another constituent."""
    if len({z.constituent for z in model.zones}) > 1:
        raise call.error("operators.models.several-constituents", model)
    name = constituent.rstrip()
    return Model(tuple(replace(z, constituent=name) for z in model.zones))


@DIME.form(
    main("matrix", "RIGIDITE", en="matrix", fr="rigidité"),
    en="Of a matrix: its number of unknowns.",
    fr="D'une rigidité : son nombre d'inconnues.",
    examples=(_EXAMPLE + "LIST (DIME (RIGI MO (MATE MO 'YOUN' 1. 'NU' 0. 'SECT' 1.))) ;",),
)
def unknowns(matrix: Matrix) -> int:
    """Number of unknowns."""
    return numbering_of(matrix).size
