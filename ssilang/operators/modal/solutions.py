"""SOLUTION: modes as one object (MANU 'MODE', VIBR 'SOLU'), and the operators that read it."""

from __future__ import annotations

from typing import Any

from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Point
from ssilang.language.registry import Chosen, arg, key, main, many, opt, said, select
from ssilang.language.run.call import Call
from ssilang.language.values import Mot, Table
from ssilang.language.vocabulary.terms import ANY_NUMBER, POSITIVE
from ssilang.operators.dispatch import DIME, MANU, union
from ssilang.operators.matrices.element import joined, present, rigi
from ssilang.operators.modal.loads import sigs, with_stresses
from ssilang.operators.modal.matrices import modal_stiffness
from ssilang.operators.modal.modes import Solution, directions, filled
from ssilang.operators.statics.loads_in_time import tire
from ssilang.operators.workspace import workspace

_MAIN = arg("solution", "SOLUTION", en="modes")


@MANU.form(
    said("MODE"),
    key("number", "NUME", arg("n", "ENTIER", range=POSITIVE), en="its number, 1 without it"),
    arg("frequency", "FLOTTANT", en="frequency", unit="Hz", range=ANY_NUMBER),
    arg("mass", "FLOTTANT", en="generalised mass", unit="kg", range=POSITIVE),
    opt("x", "FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    opt("y", "FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    opt("z", "FLOTTANT", default=0.0, en="generalised displacements", range=ANY_NUMBER),
    arg("shape", "CHPOINT", en="shape"),
    opt("stresses", "MCHAML", en="its stresses"),
)
def mode_by_hand(
    call: Call,
    number: int | None,
    frequency: float,
    mass: float,
    x: float,
    y: float,
    z: float,
    shape: NodeField,
    stresses: CellField | None,
) -> Solution:
    """One mode."""
    nodes = workspace(call.session).nodes
    entries: dict[str, Any] = {
        "NUMERO_MODE": number or 1,
        "POINT_REPERE": Point(nodes, int(nodes.add([[0.0, 0.0, 0.0]])[0])),  # type: ignore[arg-type]
        "FREQUENCE": frequency,
        "MASSE_GENERALISEE": mass,
        "DEPLACEMENTS_GENERALISES": directions((x, y, z)),
        "DEFORMEE_MODALE": shape,
    }
    if stresses is not None:
        entries["CONTRAINTE_MODALE"] = stresses
    return Solution((filled("MODE", entries),))


@union(("SOLUTION", "SOLUTION"))
def join_solutions(first: Solution, second: Solution) -> Solution:
    """The modes of both."""
    return Solution((*first.modes, *second.modes))


@DIME.form(main("solution", "SOLUTION", en="modes"))
def count_modes(solution: Solution) -> int:
    """Number of modes."""
    return len(solution.modes)


_ENTRIES = {
    "FREQ": "FREQUENCE", "MGEN": "MASSE_GENERALISEE", "POIN": "POINT_REPERE",
    "DEPL": "DEFORMEE_MODALE", "CONT": "CONTRAINTE_MODALE",
}  # fmt: skip
_ALONG = {"QX": 1, "QY": 2, "QZ": 3}


@tire.form(
    _MAIN,
    arg("word", "MOT", en="FREQ, MGEN, QX, QY, QZ, POIN, DEPL or CONT"),
    select(
        "which",
        {
            word: [arg("number", "ENTIER", range=POSITIVE, en="its place, or its number")]
            for word in ("RANG", "CAS", "NUME")
        },
        en="which mode, the last without it",
    ),
    gives="FLOTTANT|ENTIER|POINT|CHPOINT|MCHAML",
)
def of_a_mode(call: Call, solution: Solution, word: str, which: Chosen | None) -> Any:
    """What one mode holds."""
    modes = solution.modes
    if which is not None and which.word == "NUME":
        modes = tuple(m for m in modes if m.get(Mot("NUMERO_MODE")) == which["number"])
    elif which is not None:
        modes = modes[which["number"] - 1 : which["number"]]
    if not modes:
        raise call.error(
            "operators.modal.solution-without-mode", solution, count=len(solution.modes)
        )
    name = word.rstrip().upper()[:4]
    if name in _ALONG:
        along = modes[-1].get(Mot("DEPLACEMENTS_GENERALISES"))
        held = along.get(_ALONG[name]) if isinstance(along, Table) else None
    else:
        held = modes[-1].get(Mot(_ENTRIES.get(name, name)))
    if held is None:
        known = (*_ENTRIES, *_ALONG)
        raise call.error("operators.modal.mode-without-word", word, word=name, known=known)
    return held


@sigs.form(
    arg("model", "MMODEL", en="model"),
    many("material", "MCHAML", at_least=1, en="parameters"),
    _MAIN,
)
def stressed(
    call: Call, model: Model, material: tuple[CellField, ...], solution: Solution
) -> Solution:
    """The modes with their stresses."""
    model, given = present(call, model), joined(material)
    return Solution(tuple(with_stresses(model, given, m)[0] for m in solution.modes))


@rigi.form(_MAIN)
def stiffness_of_modes(call: Call, solution: Solution) -> Matrix:
    """Generalised stiffnesses on the diagonal."""
    made: Matrix = modal_stiffness(call, solution.table, None)
    return made
