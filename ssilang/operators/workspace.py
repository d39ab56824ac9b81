"""What OPTI sets and operators share during a session: nodes, dimension, mode, element, density."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast
from weakref import WeakKeyDictionary

import numpy as np

from ssilang.io.run_output import RunOutput
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.materials.model import Mode
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers.backends import MULTIGRID
from ssilang.kernel.solvers.factor import RESIDUAL, Solver
from ssilang.language.run.session import Session
from ssilang.language.vocabulary.unit_systems import SYSTEMS, UnitSystem

if TYPE_CHECKING:
    from ssilang.kernel.matrices.matrix import Matrix
    from ssilang.kernel.solvers.petsc.client import PetscServer

_FEWEST, _SAME = 100, 1e-6
"""Values by which a record is known again, and by what part of the largest they may differ."""
MULTIGRID_WORD = "MULTIGRILLE"
TOLERANCE = "SOLV TOLERANCE"
"""Where the number behind OPTI 'SOLVEUR' 'MULTIGRILLE' stands among the options."""


def _shape(values: FloatArray) -> FloatArray:
    return values / values[np.abs(values).argmax()]


@dataclass
class Workspace:
    """State of the operators in one session.

    Attributes
    ----------
    dimension : int
        OPTI DIME; 0 until it is set.
    mode : Mode
        OPTI MODE.
    fourier : int
        Harmonic of OPTI MODE FOUR.
    element : str
        OPTI ELEM: type of the cells that generators make.
    density : float
        OPTI DENS / DENS: mesh size that new points carry, 0 before it is set.
    colour : int
        OPTI COUL: index of the colour given to new cells.
    title : str
        TITR: title of the next pictures.
    options : dict
        Every other option of OPTI, as set, for VALE.
    output : RunOutput or None
        Files of the run; made when first asked for (`ssilang.operators.files.outputs.run_output`).
    petsc : PetscServer or None
        What solves for OPTI 'SOLVEUR' 'PETSC', if the run was given a command that starts it.
    heated : mapping of object to str
        What comes of the stresses of a temperature: forces, displacements, stresses; the cells.
    origins : mapping of NodeField to (element matrices, NodeField or Matrix or None)
        What displacements and shapes were found with, and the mass of these; of forces that are
        a mass times accelerations these.
    sides : list of (first side, second side, method)
        What IMPO 'MAIL' made contact meshes of.
    ended : (unknowns, displacements, whether it moves, whether it is damped)
        Where the last motion came to: how a next one may go on.
    records : mapping of (file, column) to (step, values over the largest)
        What LIRE read of ground motions.
    masses : mapping of int to (nodes, masses)
        What MASS gave cells and points along the vertical: what loads of statics are held to.
    """

    nodes: NodeTable = field(default_factory=NodeTable)
    dimension: int = 0
    mode: Mode = Mode.PLANE_STRAIN
    fourier: int = 0
    element: str = ""
    density: float = 0.0
    colour: int = 0
    title: str = ""
    options: dict[str, Any] = field(default_factory=dict)
    output: RunOutput | None = None
    petsc: "PetscServer | None" = None
    heated: WeakKeyDictionary[Any, str] = field(default_factory=WeakKeyDictionary)
    origins: WeakKeyDictionary[Any, Any] = field(default_factory=WeakKeyDictionary)
    ended: tuple[IntArray, FloatArray, bool, bool] = (
        np.zeros(0, int), np.zeros(0), False, False,
    )  # fmt: skip
    masses: dict[int, tuple[IntArray, FloatArray]] = field(default_factory=dict)
    sides: list[tuple[Mesh, Mesh, str]] = field(default_factory=list)
    records: dict[tuple[str, int], tuple[float, FloatArray]] = field(default_factory=dict)

    def keep_record(self, file: str, column: int, times: FloatArray, values: FloatArray) -> None:
        """Remember a record that is long enough to be known again."""
        if len(values) >= _FEWEST and values.any():
            self.records[file, column] = float(np.median(np.diff(times))), _shape(values)

    def record_of(self, values: FloatArray) -> tuple[str, float]:
        """File and step of the record that has these values, whatever scales them, or ('', 0.)."""
        shape = _shape(values) if self.records and values.any() else values
        known = [
            (file, step)
            for (file, _), (step, own) in self.records.items()
            if len(own) == len(shape) and np.abs(own - shape).max() < _SAME
        ]
        return known[-1] if known else ("", 0.0)

    @property
    def units(self) -> UnitSystem | None:
        """The deck's units, OPTI 'UNIT'; None if it says nothing of them."""
        return SYSTEMS.get(str(self.options.get("UNIT", "")))

    @property
    def in_frequency(self) -> bool:
        """Whether OPTI 'MODE' 'FREQ' is in force: PASAPAS sweeps frequencies."""
        return bool(self.options.get("FREQ"))

    def weighed(self, made: "Matrix", *constituents: str) -> "Matrix":
        """A matrix of MASS, its masses remembered: those made last of the same cells.

        Of points that are given masses once more, nothing is known: they may be others beside.
        """
        for block in made.blocks:
            axis = "UZ" if "UZ" in block.unknowns else "UY"
            rows = np.flatnonzero(np.array(block.unknowns) == axis)
            nodes = block.raw_nodes[:, block.local[rows]]
            sums = block.values[:, rows][:, :, rows].sum(axis=2)
            key = hash((block.raw_nodes.tobytes(), axis, *constituents))
            known = bool(constituents) or key not in self.masses
            self.masses[key] = nodes.ravel(), sums.ravel() if known else np.full(sums.size, np.nan)
        return made

    def point(self, coordinates: list[float]) -> Point:
        """A new point with the density in force."""
        ids = self.nodes.add(np.asarray([coordinates], dtype=float), self.density)
        return Point(self.nodes, int(ids[0]))


def workspace(session: Session) -> Workspace:
    """The session's workspace."""
    return cast(Workspace, session.workspace)


def solver_of(session: Session) -> Solver:
    """Which solver takes the systems of calculations, OPTI 'SOLVEUR'."""
    ws = workspace(session)
    said, tolerance = str(ws.options.get("SOLV", "AUTO")), ws.options.get(TOLERANCE)
    name = {"AUTO": None, MULTIGRID_WORD: MULTIGRID}.get(said, said)
    return Solver(name, ws.petsc, RESIDUAL if tolerance is None else float(tolerance))


def units_in_si(session: Session) -> dict[str, float]:
    """The units that OPTI 'UNIT' declares with their sizes, nothing without it."""
    units = workspace(session).units
    return {} if units is None else units.in_si()


def open_session(session: Session) -> Session:
    """Give a session its evaluator, its workspace and its operators."""
    from ssilang.language.run.evaluator import Evaluator
    from ssilang.operators.loader import prepare_operators
    from ssilang.operators.tables.soundness import apart, flaw_of, follow

    prepare_operators()
    Evaluator(session)
    made = Workspace()
    session.workspace = made
    session.make_point = made.point
    session.dimension = lambda: made.dimension
    session.units = lambda: made.units
    session.flaw_of, session.apart, session.follow = flaw_of, apart, follow
    return session
