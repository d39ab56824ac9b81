"""RIGI, MASS, AMOR of a modal basis: diagonal matrices on the modes' unknowns ALFA."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.matrices.build import nodal_diagonal
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.modes import eigenvalue
from ssilang.language.call import Call
from ssilang.language.registry import Argument, Function, Operator, arg
from ssilang.language.values import ListReel, Table
from ssilang.operators.dispatch import extend_help
from ssilang.operators.matrices.element import amor, mass, rigi
from ssilang.operators.modal.basis import Shape, shapes_of


def _first(made: Operator, *entries: Argument) -> Callable[[Function], Function]:
    """Decorator: a form that is tried before the operator's own."""

    def add(function: Function) -> Function:
        made.form(*entries)(function)
        made.forms.insert(0, made.forms.pop())
        return function

    return add


def _diagonal(modes: list[Shape], values: list[float], kind: str) -> Matrix:
    nodes = np.array([m.mark.node for m in modes])
    order = np.argsort(nodes, kind="stable")
    table = modes[0].field.table
    return nodal_diagonal(table, nodes[order], {"ALFA": np.array(values)[order]}, kind)


def _modal(call: Call, basis: Table) -> tuple[list[Shape], list[float], list[float]]:
    """Real modes of a basis, their masses and frequencies."""
    modes = [s for s in shapes_of(call, basis) if s.unknown == "ALFA"]
    numbers = []
    for name in ("MASSE_GENERALISEE", "FREQUENCE"):
        column = [m.entry.get(name) for m in modes]
        if not modes or not all(isinstance(v, float) for v in column):
            raise call.bad(f"the basis holds no modes with {name}", basis)
        numbers.append([float(v) for v in column])  # type: ignore[arg-type]
    return modes, numbers[0], numbers[1]


@_first(rigi, arg("basis", "TABLE"))
def modal_stiffness(call: Call, basis: Table) -> Matrix:
    modes, masses, frequencies = _modal(call, basis)
    values = [m * eigenvalue(f) for m, f in zip(masses, frequencies, strict=True)]
    return _diagonal(modes, values, "RIGIDITE")


@_first(mass, arg("basis", "TABLE"))
def modal_mass(call: Call, basis: Table) -> Matrix:
    modes, masses, _ = _modal(call, basis)
    return _diagonal(modes, masses, "MASSE")


@_first(amor, arg("basis", "TABLE"), arg("ratios", "LISTREEL"))
def modal_damping(call: Call, basis: Table, ratios: ListReel) -> Matrix:
    modes, masses, frequencies = _modal(call, basis)
    if len(ratios) != len(modes):
        raise call.bad(f"{len(modes)} modes want as many damping ratios, not {len(ratios)}", ratios)
    values = [
        2.0 * m * abs(2.0 * np.pi * f) * xi / 100.0
        for m, f, xi in zip(masses, frequencies, ratios.values, strict=True)
    ]
    return _diagonal(modes, values, "AMORTISSEMENT")


_EXAMPLE = (
    "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; K1 = APPU 'UX' 400. P1 ;"
    " T1 = VIBR 'SIMU' 1. 1 K1 (MASS 'UX' 4. P1) ; LIST (EXTR ({} T1{}) 'DIAG') ;"
)
extend_help(
    "RIGI",
    "RIG1 = RIGI TAB1 ;  (BASE_MODALE, BASE_DE_MODES)",
    "Of a modal basis: generalised stiffnesses on the diagonal, on ALFA at the modes' points.",
    "D'une base modale : rigidités généralisées sur la diagonale, sur ALFA aux points repères.",
    (_EXAMPLE.format("RIGI", ""),),
)
extend_help(
    "MASS",
    "MASS1 = MASS TAB1 ;  (BASE_MODALE, BASE_DE_MODES)",
    "Of a modal basis: generalised masses on the diagonal.",
    "D'une base modale : masses généralisées sur la diagonale.",
    (_EXAMPLE.format("MASS", ""),),
)
extend_help(
    "AMOR",
    "AMOR1 = AMOR TAB1 LREEL1 ;  (BASE_MODALE)",
    "Of a modal basis: 2 x m w on the diagonal, reduced dampings x in per cent, one a mode.",
    "D'une base modale : 2 x m w sur la diagonale, amortissements réduits x en %, un par mode.",
    (_EXAMPLE.format("AMOR", " (PROG 5.)"),),
)
