"""ZDYN: the time integration behind the procedure DYNAMIC."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.dynamics.contact_options import ContactOptions
from ssilang.kernel.dynamics.plan import every
from ssilang.kernel.dynamics.scheme import Scheme, generalised_alpha, hht, newmark
from ssilang.kernel.elements.families import stress
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.joints.elements import is_joint
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import FloatArray, IntArray
from ssilang.kernel.model import Model
from ssilang.kernel.plasticity.bulk import without_stiffness
from ssilang.kernel.plasticity.points import is_plastic, plastic_zones
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.language.values import LazyTable, ListMots, ListReel, Mot, Table, promises
from ssilang.operators.dynamics.charmeca import AddedByProcedure
from ssilang.operators.dynamics.motion_observers import CsvObserver, TableObserver, VtkObserver
from ssilang.operators.files.outputs import output_path, run_output
from ssilang.operators.session.progress import COMPILING, ProgressLine
from ssilang.operators.statics.bodies import plastic_bodies
from ssilang.operators.tables.entries import Entries

if TYPE_CHECKING:
    from ssilang.kernel.dynamics.integrate import History
    from ssilang.kernel.dynamics.problem import Inputs, Problem
    from ssilang.kernel.dynamics.snapshot import Observer
    from ssilang.kernel.plasticity.bulk import Bulk, State

SCHEME_ENTRIES = ("ALPHA_F", "RHO_INF", "BETA", "GAMMA")
CONTACT_ENTRIES = (
    "CONSERVATIF",
    "PAS_ADAPTE",
    "CONTACT",
    "COEFFICIENT",
    "CONTACT_PERSISTANT",
    "MASSE_MODIFIEE",
)
KNOWN = (
    "DEPL", "VITE", "CHAR", "RIGI", "MASS", "AMOR", "MODELE", "CARACTERISTIQUES",
    "TEMPS_CALCULES", "INST", "FREQ", "DEBU",
    "PAS_SAUVES", "TEMPS_SAUVES", "MAILLAGE_SAUVE", "SAUV",
    "ECON", "PAS_SAUVES_VTK", "TEMPS_SAUVES_VTK", "MAILLAGE_VTK", "FICHIER_VTK",
    "PAS_SAUVES_CSV", "TEMPS_SAUVES_CSV", "MAILLAGE_CSV", "COMPOSANTES_CSV", "FICHIER_CSV",
    "CHARMECA", "ETAT", "VITEUNIL", "ALPHA_F", "RHO_INF", "BETA", "GAMMA", "NEWTON_COMPLET",
    "RESULTATS", "RESULTATS_CSV", "ENERGIES", "SOUSTYPE", "REDUCTION", *CONTACT_ENTRIES,
)  # fmt: skip


@operator(
    "ZDYN",
    family="dynamics",
    help=Help(
        en="Time integration of the table of DYNAMIC, which is the procedure to call.\n"
        "Results go to TAB1 . 'RESULTATS_CSV' and 'ENERGIES'; the table of saved instants is "
        "returned.",
        fr="Intégration en temps de la table de DYNAMIC, procédure à appeler.\n"
        "Les résultats vont dans TAB1 . 'RESULTATS_CSV' et 'ENERGIES' ; la table des instants "
        "sauvés est rendue.",
        syntax="TAB2 = ZDYN TAB1 ;",
    ),
    reads_itself=True,
)
def zdyn(call: Call) -> Table:
    """Read the table, integrate, hand back the saved instants."""
    from ssilang.kernel.compiled import is_compiled
    from ssilang.kernel.dynamics.problem import make_problem

    entries = Entries(call, call.required("TABLE"), "DYNAMIC")
    entries.warn_unknown(KNOWN)
    times, saved = _times(entries)
    inputs = _with_bodies(entries, _inputs(entries, times))
    problem = make_problem(inputs)
    make_bodies = plastic_bodies(entries)
    bodies = None if make_bodies is None else make_bodies(problem, inputs)
    warn_resolution(entries, problem)
    results = TableObserver(saved, _nodes(entries.get("MAILLAGE_SAUVE", "MAILLAGE", "POINT")))
    vtk, csv = _vtk(entries, times), _csv(entries, times)
    line = ProgressLine("DYNAMIC")
    observers = [o for o in (results, vtk, csv) if o is not None]
    if not is_compiled("dynamics"):
        line.note(COMPILING)
    try:
        history = _integrated(entries, problem, observers, line, bodies)
    finally:
        line.close()
    _say_reduction(entries, history)
    if csv is not None:
        entries.table.set(Mot("RESULTATS_CSV"), csv.table)
    report(entries, problem, history)
    return results.table


def _integrated(
    entries: Entries,
    problem: Problem,
    observers: Sequence[Observer],
    line: ProgressLine,
    bodies: tuple[Bulk, State] | None = None,
) -> History:
    """The history, on a reduced basis if REDUCTION gives a tolerance."""
    from ssilang.kernel.dynamics.integrate import integrate
    from ssilang.kernel.dynamics.reduced_run import integrate_reduced
    from ssilang.kernel.plasticity.run import run_bulk

    tolerance = entries.get("REDUCTION", "FLOTTANT")
    full = entries.flag("NEWTON_COMPLET")
    if bodies is not None:
        if tolerance is not None:
            raise entries.bad("'REDUCTION' needs linear bodies", "MODELE has plastic ones")
        return run_bulk(problem, *bodies, observers, line, dynamic=True)
    driver = AddedByProcedure(entries) if entries.flag("CHARMECA") else None
    if tolerance is None:
        return integrate(problem, observers, line, full, driver)
    if driver is not None:
        raise entries.bad("'REDUCTION' and 'CHARMECA' exclude each other", "leave one")
    if full:
        raise entries.bad("'REDUCTION' and 'NEWTON_COMPLET' choose two methods", "give one")
    return integrate_reduced(problem, float(tolerance), observers, line)


def _say_reduction(entries: Entries, history: History) -> None:
    """Warn when a reduction that was asked for was not made."""
    found = history.reduction
    if found is not None and found.vectors == 0:
        entries.warn(
            f"no reduced model was used: {found.refused}", "the whole model was run, exactly"
        )


# ---- what is read ----------------------------------------------------------------------------


def _times(entries: Entries) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Times of the calculation and which of them the table keeps."""
    given = entries.get("TEMPS_CALCULES", "LISTREEL")
    if given is None:
        return _older_times(entries)
    times = given.values
    return times, entries.saved_steps("", times, lambda: every(times, 4))


def _older_times(entries: Entries) -> tuple[FloatArray, NDArray[np.bool_]]:
    """INST (instants kept), DEBU (start, 0), FREQ (cut-off frequency, dt = 1/(4 FREQ))."""
    instants = entries.get("INST", "LISTREEL")
    if instants is None:
        raise entries.bad(
            "the entry 'TEMPS_CALCULES' is missing", "TAB1 . 'TEMPS_CALCULES' = PROG 0. 'PAS' ... ;"
        )
    frequency = entries.get("FREQ", "FLOTTANT")
    wanted = np.asarray(instants.values, dtype=float)
    begin = entries.get("DEBU", "FLOTTANT")
    if begin is None:
        begin = min(0.0, float(wanted[0])) if len(wanted) else 0.0
    stops = wanted if len(wanted) and wanted[0] <= begin else np.concatenate([[begin], wanted])
    if frequency is None or len(stops) < 2:
        return stops, np.isin(stops, wanted)
    if frequency <= 0:
        raise entries.bad(f"'FREQ' is {frequency:g}", "a cut-off frequency > 0 (Hz)")
    counts = np.maximum(np.ceil(np.diff(stops) * 4 * frequency * (1 - 1e-9)), 1).astype(int)
    pieces = [
        np.linspace(a, b, n, endpoint=False)
        for a, b, n in zip(stops[:-1], stops[1:], counts, strict=True)
    ]
    times = np.concatenate([*pieces, stops[-1:]])
    return times, np.isin(times, wanted)


def _inputs(entries: Entries, times: FloatArray) -> Inputs:
    from ssilang.kernel.dynamics.problem import Inputs

    if entries.flag("ECON"):
        entries.warn(
            "'ECON' asks to keep results on disk: they stay in memory",
            "PAS_SAUVES and MAILLAGE_SAUVE make them smaller",
        )
    if entries.flag("SAUV"):
        entries.warn(
            "'SAUV' asks to write each step to the file of OPTI SAUV: results stay in memory",
            "SAUV the table behind DYNAMIC, or use the VTK or CSV entries",
        )
    return Inputs(
        entries.needed("RIGI", "RIGIDITE"),
        times,
        entries.get("MASS", "RIGIDITE"),
        entries.get("AMOR", "RIGIDITE"),
        entries.get("CHAR", "CHARGEME"),
        entries.get("DEPL", "CHPOINT"),
        entries.get("VITE", "CHPOINT"),
        entries.get("MODELE", "MMODEL"),
        entries.get("CARACTERISTIQUES", "MCHAML"),
        scheme_of(entries),
        contact_options(entries),
    )


def _with_bodies(entries: Entries, inputs: Inputs) -> Inputs:
    """The stiffness without that of plastic bodies: their law replaces it."""
    from ssilang.kernel.joints.interface import without_zones

    zones = plastic_zones(inputs.model)
    if not zones:
        return inputs
    entries.needed("CARACTERISTIQUES", "MCHAML")
    stiffness = without_zones(inputs.stiffness, zones)
    blocks = (*stiffness.blocks, *(without_stiffness(z) for z in zones))
    return replace(inputs, stiffness=replace(stiffness, blocks=blocks, cache={}))


def contact_options(entries: Entries, dynamic: bool = True) -> ContactOptions:
    """How unilateral relations are solved, and velocities corrected (VITEUNIL).

    VRAI, the default of the average acceleration, corrects in the norm of the mass.
    """
    methods = ("LAGRANGE", "PENALITE", "AUGMENTE", "UZAWA")
    method = str(entries.get("CONTACT", "MOT") or "LAGRANGE").upper().rstrip()
    if method not in methods:
        raise entries.bad(f"'CONTACT' is '{method}'", "one of " + ", ".join(methods))
    coefficient = entries.get("COEFFICIENT", "FLOTTANT")
    if method == "PENALITE" and coefficient is None:
        raise entries.bad("'CONTACT' = 'PENALITE' needs 'COEFFICIENT'", "a stiffness, N/m")
    if not dynamic:
        return ContactOptions(method, coefficient)
    return ContactOptions(
        method,
        coefficient,
        _correction(entries, method),
        entries.flag("CONTACT_PERSISTANT"),
        entries.flag("MASSE_MODIFIEE"),
    )


def _correction(entries: Entries, method: str) -> str:
    scheme = scheme_of(entries)
    average = scheme.average_acceleration
    given = entries.get("VITEUNIL", "LOGIQUE", "MOT")
    if scheme.conserving:
        return _no_correction(entries, given)
    if given is None:
        return "MASSE" if average and method != "PENALITE" else "FAUX"
    word = {True: "MASSE", False: "FAUX"}.get(given, str(given).upper().rstrip())
    if word not in ("FAUX", "MASSE", "RIGIDITE"):
        raise entries.bad(f"'VITEUNIL' is '{given}'", "VRAI, FAUX, 'MASSE' or 'RIGIDITE'")
    if word != "FAUX" and not average:
        raise entries.bad(
            "'VITEUNIL' corrects velocities of the average acceleration only",
            "leave ALPHA_F, RHO_INF, BETA and GAMMA, or VITEUNIL = FAUX",
        )
    return word


def _no_correction(entries: Entries, given: object) -> str:
    """The conserving step reflects velocities by itself."""
    if given is not None and given is not False and str(given).upper().rstrip() != "FAUX":
        entries.warn(
            "'VITEUNIL' has no effect: the conserving step keeps the energy of impacts by itself",
            "VITEUNIL = FAUX",
        )
    if entries.flag("CONTACT_PERSISTANT"):
        raise entries.bad(
            "'CONTACT_PERSISTANT' takes energy, 'CONSERVATIF' keeps it: they exclude each other",
            "leave one",
        )
    return "FAUX"


def scheme_of(entries: Entries) -> Scheme:
    """Time scheme by ALPHA_F, RHO_INF, or BETA and GAMMA; average acceleration by default."""
    return replace(_basic_scheme(entries), adaptive=entries.flag("PAS_ADAPTE"))


def _basic_scheme(entries: Entries) -> Scheme:
    given = [name for name in SCHEME_ENTRIES if entries.has(name)]
    if entries.flag("CONSERVATIF"):
        if given:
            raise entries.bad(f"'CONSERVATIF' and '{given[0]}' choose two schemes", "give one")
        return Scheme(conserving=True)
    if len(given) > 1 and given != ["BETA", "GAMMA"]:
        raise entries.bad(f"'{given[0]}' and '{given[1]}' choose two schemes", "give one")
    if not given:
        return Scheme()
    values = [float(entries.needed(name, "FLOTTANT")) for name in given]
    makers: dict[str, Callable[[float], Scheme]] = {
        "ALPHA_F": hht,
        "RHO_INF": generalised_alpha,
        "BETA": lambda beta: newmark(beta, values[-1] if len(values) == 2 else 0.5),
        "GAMMA": lambda gamma: newmark((gamma + 0.5) ** 2 / 4, gamma),
    }
    return makers[given[0]](values[0])


def _nodes(mesh: Any) -> IntArray | None:
    if mesh is None:
        return None
    if isinstance(mesh, Mesh):
        return mesh.sorted_node_ids
    return np.array([mesh.node])


# ---- outputs ---------------------------------------------------------------------------------


def _vtk(entries: Entries, times: FloatArray) -> VtkObserver | None:
    if not (entries.has("PAS_SAUVES_VTK") or entries.has("TEMPS_SAUVES_VTK")):
        return None
    wanted = entries.saved_steps("_VTK", times, lambda: np.zeros(len(times), bool))
    given = entries.get("MAILLAGE_VTK", "MAILLAGE", "TABLE")
    if given is None:
        model: Model | None = entries.get("MODELE", "MMODEL")
        given = entries.needed("MAILLAGE_VTK", "MAILLAGE", "TABLE") if model is None else model.mesh
    meshes = {"": given} if isinstance(given, Mesh) else _parts(entries, given)
    name = entries.get("FICHIER_VTK", "MOT") or "dynamic"
    path = output_path(entries.call, str(name).rstrip())
    writer = run_output(entries.call.session).begin_series(path)
    return VtkObserver(wanted, meshes, writer, _stress(entries))


def _parts(entries: Entries, table: Table) -> dict[str, Mesh]:
    parts = {str(i): m for i, m in table.items() if isinstance(m, Mesh)}
    if not parts:
        raise entries.bad("'MAILLAGE_VTK' is a TABLE without MAILLAGE")
    return parts


def _stress(entries: Entries) -> Callable[[NodeField], CellField | None] | None:
    """Stresses of the zones of MODELE that are no joints."""
    model: Model | None = entries.get("MODELE", "MMODEL")
    material: CellField | None = entries.get("CARACTERISTIQUES", "MCHAML")
    zones = () if model is None else model.zones
    zones = tuple(z for z in zones if not is_joint(z) and not is_plastic(z))
    if not zones or material is None:
        return None
    held = material

    def of(displacement: NodeField) -> CellField:
        return CellField(tuple(stress(z, held, displacement) for z in zones), "CONTRAINTES")

    return of


def _csv(entries: Entries, times: FloatArray) -> CsvObserver | None:
    if not (entries.has("PAS_SAUVES_CSV") or entries.has("TEMPS_SAUVES_CSV")):
        return None
    wanted = entries.saved_steps("_CSV", times, lambda: np.zeros(len(times), bool))
    nodes = _nodes(entries.needed("MAILLAGE_CSV", "MAILLAGE", "POINT"))
    assert nodes is not None
    components: ListMots | None = entries.get("COMPOSANTES_CSV", "LISTMOTS")
    name = entries.get("FICHIER_CSV", "MOT")
    path = None
    if name is not None:
        text = str(name).rstrip()
        path = output_path(entries.call, text if text.lower().endswith(".csv") else text + ".csv")
        run_output(entries.call.session).wrote(path)
    chosen = None if components is None else [str(c).rstrip() for c in components.values]
    return CsvObserver(wanted, nodes, chosen, path)


ENERGIES = ("CINETIQUE", "ELASTIQUE", "JOINTS", "DISSIPEE", "AMORTIE", "EXTERIEURE")


def _energy(history: History, word: str) -> ListReel:
    """Energies in time by their word."""
    if word == "TEMPS":
        return ListReel(history.times)
    if word == "ECART":
        return ListReel(history.imbalance)
    return ListReel(history.energies[:, ENERGIES.index(word)])


def report(entries: Entries, problem: Problem, history: History) -> None:
    """Energies in time into the table, and a line of statistics for the summary."""
    energies = LazyTable(partial(_energy, history), promises("TEMPS", *ENERGIES, "ECART"))
    entries.table.set(Mot("ENERGIES"), energies)
    steps = len(history.times) - 1
    line: dict[str, Any] = {
        "procedure": entries.procedure,
        "unknowns": problem.numbering.size,
        "interface_unknowns": problem.interface.size if problem.interface else 0,
        "steps": steps,
        "loop": history.loop,
        "solver": history.solver,
        "most_interface_iterations": history.iterations,
        "seconds": history.seconds,
        "steps_per_second": steps / history.seconds if history.seconds > 0 else None,
        "energy_imbalance": history.worst_imbalance,
    }
    if history.reduction is not None:
        line |= {
            "reduced": history.reduction.vectors > 0,
            "vectors": history.reduction.vectors,
            "estimated_error": none_if_nan(history.reduction.estimate),
            "estimated_error_of_velocities": none_if_nan(history.reduction.velocity),
            "estimated_error_of_accelerations": none_if_nan(history.reduction.acceleration),
            "not_reduced_because": history.reduction.refused,
            "seconds_preparing_the_basis": history.reduction.prepared,
        }
    entries.call.session.statistics.setdefault("calculations", []).append(line)


def none_if_nan(value: float) -> float | None:
    """A number for JSON."""
    return None if np.isnan(value) else value


def warn_resolution(entries: Entries, problem: Problem) -> None:
    """Warn when the step does not resolve contact, saying the step to use."""
    from ssilang.kernel.dynamics.resolution import contact_resolution

    warn_contrast(entries, problem)
    warn_massless(entries, problem)
    found = contact_resolution(problem)
    if found is None or found.resolved:
        return
    advice = f"dt <= T_c/30 = {found.wanted_dt:.3g} s keeps energy; or CONSERVATIF, a softer joint"
    if problem.scheme.conserving:
        advice = f"energy is kept; dt <= T_c/30 = {found.wanted_dt:.3g} s follows the contact too"
    entries.warn(
        f"the step {found.dt:.3g} s does not resolve contact, whose half period is "
        f"{found.contact_time:.3g} s with the mass attached to the joints",
        advice,
    )


def warn_massless(entries: Entries, problem: Problem) -> None:
    """Warn of bodies without mass that only joints hold: MASS was forgotten, most often."""
    from ssilang.kernel.dynamics.bodies import loose_bodies

    joints = problem.interface
    if joints is None:
        return
    for body in loose_bodies(problem, np.zeros((joints.n_points, joints.dimension))):
        if body.mass == 0.0:
            entries.warn(
                f"the body at node {body.node} has no mass and only joints hold it: it follows "
                "its loads at once, and is lost where all its joints open",
                "give its MASS",
            )


def warn_contrast(entries: Entries, problem: Problem) -> None:
    """Warn when joints are out of all proportion to the bodies: units, most often."""
    from ssilang.kernel.dynamics.contrast import STRANGE, stiffness_contrast
    from ssilang.kernel.statics.conditioning import joint_conditioning

    found = joint_conditioning(problem)
    if found is not None and found.joints_are_to_blame:
        entries.warn(
            f"the condition number of the stiffness with closed joints is {found.number:.0e}: "
            f"{found.digits} of 16 digits are left; with joints as stiff as the bodies at their "
            f"nodes it is {found.balanced:.0e}",
            f"KN and KS are in Pa/m (N/m for JOI1), here KN = {found.kn:.3g}: check their units; "
            f"{found.wanted_kn:.1e} is as stiff as the bodies",
        )
        return
    ratio = stiffness_contrast(problem)
    if ratio is None or 1 / STRANGE <= ratio <= STRANGE:
        return
    more = f"{ratio:.1e} times as stiff as" if ratio > 1 else f"{1 / ratio:.1e} times softer than"
    entries.warn(
        f"the joints are {more} the bodies at the same nodes: digits are lost",
        "KN and KS are in Pa/m (N/m for JOI1); check their units",
    )
