"""ZPAS: the load steps behind the procedure PASAPAS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.dynamics.plan import nearest
from ssilang.kernel.elements.families import mass, stiffness, stress
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.joints.elements import is_joint
from ssilang.kernel.joints.law_table import law_of
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.model import Model, Zone
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.language.values import Mot, Table
from ssilang.operators.dynamic import (
    CONTACT_ENTRIES,
    contact_options,
    report,
    scheme_of,
    warn_resolution,
)
from ssilang.operators.progress import ProgressLine
from ssilang.operators.table_entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.dynamics.problem import Inputs
    from ssilang.kernel.dynamics.snapshot import Snapshot

RESULTS = (
    "TEMPS", "DEPLACEMENTS", "CONTRAINTES", "VARIABLES_INTERNES", "REACTIONS", "VITESSES",
    "ACCELERATIONS",
)  # fmt: skip

# entries that steer iterations which the exact interface solution does not need
WITHOUT_EFFECT = (
    "ACCELERATION", "AUGMENTATION_AUTOMATIQUE", "AUTOCRIT", "AUTOPAS", "AUTORESU", "AUTOMATIQUE",
    "CONVERGENCE_FORCEE", "CONVERGENCE_MONOTONE", "CRITERE_COHERENCE", "CTOL", "DELTAITER",
    "ECONOMIQUE", "FTOL", "INITIALISATION", "K_TANGENT", "K_TANGENT_ITER0", "K_TANGENT_PERT",
    "K_TANGENT_SYME", "LINESEARCH", "MAXDEFOR", "MAXISOUSPAS", "MAXITERATION", "MAXSOUSPAS",
    "MES_SAUVEGARDES", "MOVA", "MTOL", "NB_BOTH", "NITERINTER_MAX", "NITER_KTANGENT",
    "NMAXSUBSTEPS", "ORDRE", "PAS_AJUSTE", "PRECDECHARGE", "PRECISINTER", "PRECISION",
    "PREDICTEUR", "PROCESSEURS", "REAC_GRANDS", "RENORMALISATION", "RIGIDITE_AUGMENTEE",
    "SOUS_INCREMENT", "STABILITE", "SUBSTEPPING", "TTOL",
)  # fmt: skip

REFUSED = {
    **dict.fromkeys(
        ("BLOCAGES_THERMIQUES", "BLOCAGES_DIFFUSIONS", "CAPACITE_CONSTANTE", "TEMPERATURES",
         "CONDUCTIVITE_CONSTANTE", "CONCENTRATIONS", "PROCEDURE_THERMIQUE", "CONSOLIDATION",
         "PROJECTION", "PROCEDURE_CHARTHER", "PROCEDURE_PARATHER", "PROCEDURE_PERSO2"),
        "PASAPAS does mechanics only",
    ),
    **dict.fromkeys(
        ("GRANDS_DEPLACEMENTS", "UPDATE_LAGRANGIAN", "MAN", "K_SIGMA", "FEFP_FORMULATION"),
        "displacements are small",
    ),
    **dict.fromkeys(
        ("PILOTAGE_INDIRECT", "DEPLACEMENTS_PILOTES", "FORCES_PILOTEES", "TRACKING",
         "PARAMETRE_DE_PILOTAGE", "ZONE_DE_PILOTAGE"),
        "indirect control is not built",
    ),
    "PROCEDURE_CHARMECA": "loads computed by a procedure are not built",
    "TEMPS_SAUVEGARDES": "saving to disk during the calculation is not built",
}  # fmt: skip

KNOWN = (
    *RESULTS, *WITHOUT_EFFECT, *REFUSED, "MODELE", "CARACTERISTIQUES", "BLOCAGES_MECANIQUES",
    "CHARGEMENT", "TEMPS_CALCULES", "TEMPS_SAUVES", "RIGIDITE_CONSTANTE", "MASSE_CONSTANTE",
    "AMORTISSEMENT", "DYNAMIQUE", "HYPOTHESE_DEFORMATIONS", "PROCEDURE_PERSO1", "ARRET",
    "DEFORMATIONS_INELASTIQUES", "CONV", "ERREUR", "ENERGIES", "ALPHA_F", "RHO_INF", "BETA",
    "GAMMA", "NEWTON_COMPLET", "VITEUNIL", "SOUSTYPE", "FREA1",
    *CONTACT_ENTRIES,
)  # fmt: skip


@operator(
    "ZPAS",
    family="statics",
    help=Help(
        en="Load steps of the table of PASAPAS, which is the procedure to call.",
        fr="Pas de charge de la table de PASAPAS, procédure à appeler.",
        syntax="ZPAS TAB1 ;",
    ),
    reads_itself=True,
)
def zpas(call: Call) -> None:
    """Read the table, step through the times, fill the tables of results."""
    from ssilang.kernel.dynamics.integrate import integrate
    from ssilang.kernel.dynamics.problem import make_problem
    from ssilang.kernel.statics.stepping import step_statics

    entries = Entries(call, call.required("TABLE"), "PASAPAS")
    entries.refuse(REFUSED)
    entries.warn_unknown(KNOWN)
    times, saved = _times(entries)
    dynamic = entries.flag("DYNAMIQUE")
    entries.table.set(Mot("CONV"), False)
    entries.table.set(Mot("ERREUR"), True)
    problem = make_problem(_inputs(entries, times, dynamic))
    results = ResultTables(entries.table, saved, _linear_zones(entries), dynamic)
    line = ProgressLine("PASAPAS")
    try:
        if dynamic:
            warn_resolution(entries, problem)
            history = integrate(problem, [results], line, entries.flag("NEWTON_COMPLET"))
        else:
            history = step_statics(problem, [results], line)
    finally:
        line.close()
    entries.table.set(Mot("CONV"), True)
    entries.table.set(Mot("ERREUR"), False)
    report(entries, problem, history)


def _times(entries: Entries) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Times with the initial one first, and which are saved (the initial one always)."""
    given = entries.get("TEMPS_CALCULES", "LISTREEL")
    if given is None:
        given = entries.needed("TEMPS_SAUVES", "LISTREEL")
    start = entries.initial("TEMPS", "FLOTTANT", "ENTIER")
    wanted = np.asarray(given.values, dtype=float)
    if start is None:
        start = min(0.0, float(wanted[0])) if len(wanted) else 0.0
    times = np.concatenate([[float(start)], wanted[wanted > start]])
    if len(times) < 2:
        raise entries.bad(f"no time of 'TEMPS_CALCULES' comes after the initial one, {start:g}")
    chosen = entries.get("TEMPS_SAUVES", "LISTREEL")
    if chosen is None:
        return times, np.ones(len(times), bool)
    saved = nearest(times, chosen.values[chosen.values > start])
    saved[0] = True
    return times, saved


def _inputs(entries: Entries, times: FloatArray, dynamic: bool) -> Inputs:
    from ssilang.kernel.dynamics.problem import Inputs

    material: CellField | None = entries.get("CARACTERISTIQUES", "MCHAML")
    model: Model | None = entries.get("MODELE", "MMODEL")
    zones = tuple(z for z, _ in _linear_zones(entries)) if material is not None else ()
    solids = tuple(z for z in zones if not is_joint(z))
    constant: Matrix | None = entries.get("RIGIDITE_CONSTANTE", "RIGIDITE")
    supports: Matrix | None = entries.get("BLOCAGES_MECANIQUES", "RIGIDITE")
    masses: Matrix | None = None
    blocks: list[ElementMatrices] = []
    heavy: list[ElementMatrices] = []
    if material is not None:
        blocks = [stiffness(z, material) for z in solids]
        heavy = [mass(z, material) for z in solids] if dynamic else []
    K = _joined(entries, blocks, (constant, supports), "RIGIDITE")
    if dynamic:
        masses = _joined(entries, heavy, (entries.get("MASSE_CONSTANTE", "RIGIDITE"),), "MASSE")
    return Inputs(
        K,
        times,
        masses,
        entries.get("AMORTISSEMENT", "RIGIDITE") if dynamic else None,
        entries.get("CHARGEMENT", "CHARGEME"),
        entries.initial("DEPLACEMENTS", "CHPOINT"),
        entries.initial("VITESSES", "CHPOINT"),
        model,
        material,
        scheme_of(entries),
        contact_options(entries, dynamic),
    )


def _joined(
    entries: Entries, blocks: list[ElementMatrices], parts: tuple[Matrix | None, ...], kind: str
) -> Matrix:
    given = [m for m in parts if m is not None]
    all_blocks = (*blocks, *(b for m in given for b in m.blocks))
    relations = tuple(r for m in given for r in m.relations)
    if blocks:
        table = blocks[0].table
    elif given:
        table = given[0].table
    else:
        model = entries.needed("MODELE", "MMODEL")
        table = model.mesh.nodes
    return Matrix(table, all_blocks, relations, kind)


def _linear_zones(entries: Entries) -> list[tuple[Zone, CellField]]:
    """Zones of MODELE whose stiffness says all, with the characteristics."""
    model: Model | None = entries.get("MODELE", "MMODEL")
    if model is None:
        return []
    material = entries.needed("CARACTERISTIQUES", "MCHAML")
    return [(z, material) for z in model.zones if not is_joint(z) or law_of(z.behaviour).linear]


@dataclass
class ResultTables:
    """Fills TEMPS, DEPLACEMENTS, CONTRAINTES ... of the table at each saved time."""

    table: Table
    wanted: NDArray[np.bool_]
    zones: list[tuple[Zone, CellField]]
    dynamic: bool
    count: int = 0

    def __post_init__(self) -> None:
        for word in RESULTS[: None if self.dynamic else 5]:
            self.table.set(Mot(word), Table())

    def receive(self, snapshot: Snapshot) -> None:
        """Add one time."""
        u = snapshot.displacement
        self._put("TEMPS", snapshot.time)
        self._put("DEPLACEMENTS", u)
        self._put("REACTIONS", snapshot.reactions)
        self._put("CONTRAINTES", self._stresses(snapshot, u))
        self._put("VARIABLES_INTERNES", snapshot.variables or CellField((), "VARIABLES INTERNES"))
        if self.dynamic:
            self._put("VITESSES", snapshot.velocity)
            self._put("ACCELERATIONS", snapshot.acceleration)
        self.count += 1

    def _put(self, word: str, value: Any) -> None:
        inner = self.table.get(word)
        assert isinstance(inner, Table)
        inner.set(self.count, value)

    def _stresses(self, snapshot: Snapshot, u: NodeField) -> CellField:
        blocks = [stress(zone, material, u) for zone, material in self.zones]
        tractions = snapshot.tractions
        return CellField((*blocks, *(tractions.blocks if tractions else ())), "CONTRAINTES")

    def close(self) -> None:
        """Nothing to do: tables are whole after each time."""
