"""What DYNAMIC and PASAPAS keep of a motion: tables of results, VTK series, CSV files."""

from ssilang.io.tables import is_there
from ssilang.io.vtk.labels import Labels
from ssilang.io.vtk.series import Part, Series
from ssilang.kernel.elements.families import stress
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.plasticity.points import is_plastic
from ssilang.kernel.stepping.node_histories import ForceHistories, NodeHistories
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.operators.dynamics.histories import PARQUET, CsvObserver
from ssilang.operators.files.outputs import output_path, run_output
from ssilang.operators.files.writing_vtk import cell_labels
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries
from ssilang.operators.workspace import units_in_si

Steps = NDArray[np.bool_]


@dataclass
class VtkObserver:
    """Writes a VTK series of meshes with displacement, velocity, reactions, joints, stresses.

    Attributes
    ----------
    meshes : dict
        Name of the part ('' for a single one) to mesh.
    stress : function or None
        Stress of the solids for a displacement.
    labels : dict
        Names of the cells of the parts.
    """

    wanted: Steps
    meshes: dict[str, Mesh]
    writer: Series
    stress: Callable[[NodeField], CellField | None] | None = None
    labels: Mapping[str, Labels] = field(default_factory=dict)

    def receive(self, snapshot: Snapshot) -> None:
        """Write one instant."""
        u = snapshot.displacement
        moved = NodeField(u.table, {k: v for k, v in u.components.items() if k != "LX"}, u.nature)
        points = {
            "displacement": moved,
            "velocity": snapshot.velocity,
            "acceleration": snapshot.acceleration,
            "reaction": snapshot.reactions,
        }
        cells: dict[str, CellField] = {}
        bodies: CellField | None = getattr(snapshot, "body_stresses", None)
        if snapshot.problem.interface:
            tractions = getattr(snapshot, "joint_tractions", snapshot.tractions)
            cells |= {"opening": snapshot.jumps, "traction": tractions}
            cells |= joint_points(snapshot.variables)
        stress = self.stress(u) if self.stress is not None else None
        found = [f for f in (stress, bodies) if f is not None]
        if found:
            cells["stress"] = CellField(tuple(b for f in found for b in f.blocks), "CONTRAINTES")
        none = Labels()
        parts = {
            name: Part(mesh, points, cells, self.labels.get(name, none))
            for name, mesh in self.meshes.items()
        }
        self.writer.write_parts(snapshot.time, parts)

    def content(self) -> Any:
        """What a checkpoint keeps: how far the series is; None where it is written again."""
        return self.writer.position()

    def restore(self, kept: Any) -> None:
        """Go on from a checkpoint."""
        self.writer.go_back(kept)

    def close(self) -> None:
        """Finish the series."""
        self.writer.close()


SHOWN = {"joint_state": "ETAT", "stored_energy": "ESTO", "lost_energy": "EPER"}
"""Names in VTK files of what the points of joints have."""


def joint_points(variables: CellField) -> dict[str, CellField]:
    """State and energies of joints, for cells: the most open point, and means of energies."""
    found, joints = {}, [b for b in variables.blocks if "ETAT" in b.components]
    for name, component in SHOWN.items():
        blocks = []
        for block in joints:
            values = block.components[component]
            if component == "ETAT":
                values = values.max(axis=1, keepdims=True)
            support = "GRAVITE" if component == "ETAT" else block.support
            blocks.append(replace(block, components={component: values}, support=support))
        found[name] = CellField(tuple(blocks), "VARIABLES INTERNES")
    return found


MANY_INSTANTS = 50
"""From more of them on, a series is one file if nothing else is said."""


def nodes_asked(entries: Entries, index: str, problem: Problem) -> IntArray | None:
    """Nodes of the mesh or point of an entry; told where none of them moves."""
    mesh = entries.get(index)
    if mesh is None:
        return None
    nodes: IntArray = mesh.sorted_node_ids
    tell_still(entries, index, nodes, problem)
    return nodes


def tell_still(entries: Entries, index: str, nodes: IntArray, problem: Problem) -> None:
    """Warn of nodes (n,) of an entry none of which the matrices have."""
    if not np.isin(nodes, problem.numbering.nodes).any():
        entries.warn("operators.dynamics.asked-elsewhere", index=index)


# ---- outputs ---------------------------------------------------------------------------------


def vtk_observer(entries: Entries, problem: Problem) -> VtkObserver | None:
    if not (entries.has("PAS_SAUVES_VTK") or entries.has("TEMPS_SAUVES_VTK")):
        return None
    wanted = entries.saved_steps("_VTK", problem.times)
    given = entries.get("MAILLAGE_VTK")
    if given is None:
        model: Model | None = entries.get("MODELE")
        given = entries.needed("MAILLAGE_VTK") if model is None else model.mesh
    meshes = {"": given} if isinstance(given, Mesh) else _parts(entries, given)
    for mesh in meshes.values():
        tell_still(entries, "MAILLAGE_VTK", mesh.sorted_node_ids, problem)
    name = entries.get("FICHIER_VTK") or entries.default("FICHIER_VTK")
    path = output_path(entries.call, str(name).rstrip())
    session = entries.call.session
    asked = entries.get("FORMAT_VTK")
    one_file = wanted.sum() > MANY_INSTANTS if asked is None else str(asked).startswith("VTKH")
    writer = run_output(session).begin_series(path, units_in_si(session), one_file=one_file)
    labels = cell_labels(session, meshes)
    return VtkObserver(wanted, meshes, writer, stress_of(entries), labels)


def _parts(entries: Entries, table: Table) -> dict[str, Mesh]:
    parts = {str(i): m for i, m in table.items() if isinstance(m, Mesh)}
    if not parts:
        raise entries.error("operators.dynamics.table-without-mesh")
    return parts


def stress_of(entries: Entries) -> Callable[[NodeField], CellField | None] | None:
    """Stresses of the zones of MODELE that are no joints."""
    model: Model | None = entries.get("MODELE")
    material: CellField | None = entries.get("CARACTERISTIQUES")
    zones = () if model is None else model.zones
    zones = tuple(z for z in zones if not is_joint(z) and not is_plastic(z))
    if not zones or material is None:
        return None
    held = material

    def of(displacement: NodeField) -> CellField:
        return CellField(tuple(stress(z, held, displacement) for z in zones), "CONTRAINTES")

    return of


def force_track(entries: Entries, problem: Problem, saved: BoolArray) -> ForceHistories | None:
    """What RELATIONS_SAUVEES asks for."""
    asked = entries.inside("RELATIONS_SAUVEES")
    if asked is None:
        return None

    known, named = np.concatenate([problem.multipliers, problem.contact.multipliers]), {}
    for index, _ in asked.table.items():
        relations = asked.get(name := str(index).rstrip()).relations
        if not relations:
            raise entries.error("operators.dynamics.no-relations", name=name)
        nodes = np.unique(np.concatenate([part.multipliers for part in relations]))
        if (lost := int(np.isin(nodes, known, invert=True).sum())) > 0:
            raise entries.error("operators.dynamics.relations-not-in-stiffness", name=name, n=lost)
        named[name] = nodes
    return ForceHistories(saved, problem=problem, named=named)


def csv_observer(entries: Entries, problem: Problem) -> CsvObserver | None:
    if not (entries.has("PAS_SAUVES_CSV") or entries.has("TEMPS_SAUVES_CSV")):
        idle = [n for n in ("MAILLAGE_CSV", "COMPOSANTES_CSV", "FICHIER_CSV") if entries.has(n)]
        if idle:
            entries.warn("operators.dynamics.csv-without-steps", names=idle)
        return None
    wanted = entries.saved_steps("_CSV", problem.times)
    entries.needed("MAILLAGE_CSV")
    nodes = nodes_asked(entries, "MAILLAGE_CSV", problem)
    components: ListMots | None = entries.get("COMPOSANTES_CSV")
    text = str(entries.get("FICHIER_CSV")).rstrip()
    named = text.lower().endswith((".csv", PARQUET))
    if text.lower().endswith(PARQUET) and not is_there():
        raise entries.error("operators.dynamics.parquet-needs-pyarrow", name=text)
    path = output_path(entries.call, text if named else text + ".csv")
    run_output(entries.call.session).wrote(path)
    chosen = None if components is None else [str(c).rstrip() for c in components.values]
    if lacking := [c for c in chosen or () if c not in problem.numbering.unknowns]:
        known = [*problem.numbering.unknowns]
        entries.warn("operators.dynamics.csv-of-no-unknown", names=lacking, known=known)
    track = NodeHistories(wanted, problem=problem, nodes=nodes)
    return CsvObserver(track, chosen, path, workspace(entries.call.session).units)
