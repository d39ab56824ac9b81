"""ZERO: fields of zeros."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.structural_gradients import names_of_gradient
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.solids.hooke import hooke_block
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.plasticity.points import variable_names
from ssilang.language.registry import Help, arg, choice, operator
from ssilang.language.run.call import Call
from ssilang.operators.statics.stresses import on_zones


def _scalar(support: Support) -> tuple[str, Support]:
    return "SCALAIRE", support


_TITLES: dict[str, tuple[str, Support]] = {
    "NOEUD": _scalar("NOEUD"),
    "GRAVITE": _scalar("GRAVITE"),
    "RIGIDITE": _scalar("RIGIDITE"),
    "MASSE": _scalar("MASSE"),
    "STRESSES": _scalar("STRESSES"),
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


def _names(zone: Zone, what: str) -> tuple[str, ...]:
    family = family_of(zone)
    tables: dict[str, Callable[[], tuple[str, ...]]] = {
        "DEPLACEM": lambda: tuple(dict.fromkeys(family.layout(zone).unknowns)),
        "FORCES": lambda: tuple(dict.fromkeys(family.layout(zone).duals)),
        "TEMPERAT": lambda: ("T",),
        "GRADIENT": lambda: names_of_gradient(zone),
        "CONTRAIN": lambda: family.stress_names(zone),
        "DEFORMAT": lambda: family.strain_names(zone),
        "DEFINELA": lambda: family.strain_names(zone),
        "PRINCIPA": lambda: PRINCIPAL,
        "MATERIAU": lambda: material_names(zone).all,
        "CARACTER": lambda: geometric_names(zone).all,
        "VARINTER": lambda: variable_names(zone) or ("EPSE",),
    }
    return tables[what]() if what in tables else ("SCAL",)


@operator(
    "ZERO",
    arg("model", "MMODEL", en="model"),
    choice("word", tuple(_TITLES), length=8, en="points of a scalar, or kind of field"),
    family="fields",
    help=Help(
        en="Field of zeros on a model: a scalar at the points of a support (NOEUD GRAVITE RIGIDITE "
        "MASSE STRESSES), or the components of a kind of field (CONTRAIN, DEFORMAT, DEPLACEM, "
        "FORCES, GRADIENT, MATERIAU, CARACTER, TEMPERAT, PRINCIPA, DEFINELA, VARINTER, MAHOOKE, "
        "HOTANGEN).",
        syntax="CHAM1 = ZERO MODL1 MOT1 ;",
    ),
)
def zero(call: Call, model: Model, word: str | None) -> CellField:
    """Zeros."""
    if word is None:
        raise call.error("operators.fields.which-zeros", titles=_TITLES)
    title, support = _TITLES[word]

    def make(zone: Zone) -> CellFieldBlock:
        if word in ("MAHOOKE", "HOTANGEN"):
            s = len(family_of(zone).strain_names(zone))
            return hooke_block(zone, np.zeros((1, n_points(zone.element, support), s, s)), support)
        shape = (len(zone.cells), n_points(zone.element, support))
        components = {n: np.zeros(shape) for n in _names(zone, word)}
        return CellFieldBlock(zone.cells, components, support, zone.element, zone.constituent)

    return on_zones(model, title, make)
