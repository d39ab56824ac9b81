"""What DYNAMIC and PASAPAS keep of a motion: tables of results, VTK series, CSV files."""

from ssilang.io.vtk.labels import Labels
from ssilang.operators.prelude import *

if TYPE_CHECKING:
    from ssilang.io.vtk.labels import Labels
    from ssilang.io.vtk.series import Series
    from ssilang.kernel.stepping.snapshot import Snapshot

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
    writer: "Series"
    stress: Callable[[NodeField], CellField | None] | None = None
    labels: Mapping[str, Labels] = field(default_factory=dict)

    def receive(self, snapshot: "Snapshot") -> None:
        """Write one instant."""
        from ssilang.io.vtk.series import Part

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
        jumps = snapshot.jumps
        tractions = snapshot.tractions
        if bodies is not None:
            tractions = getattr(snapshot, "joint_tractions", None)
        if jumps is not None and tractions is not None:
            cells |= {"opening": jumps, "traction": tractions}
        if snapshot.variables is not None:
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
    """State and energies of joints, for cells: the most open point, and means of energies.

    None where the variables are of bodies alone.
    """
    found, joints = {}, [b for b in variables.blocks if "ETAT" in b.components]
    for name, component in SHOWN.items() if joints else ():
        blocks = []
        for block in joints:
            values = block.components[component]
            if component == "ETAT":
                values = values.max(axis=1, keepdims=True)
            support = "GRAVITE" if component == "ETAT" else block.support
            blocks.append(replace(block, components={component: values}, support=support))
        found[name] = CellField(tuple(blocks), "VARIABLES INTERNES")
    return found
