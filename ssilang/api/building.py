"""A short way to problems of the kernel: blocks on soil, joints between them, a motion, a run.

Blocks are rectangles or boxes along the axes. All that they do is done by functions of
`ssilang.kernel`: grids of nodes, zones, matrices, a problem, its integration in time.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ssilang.api.errors import Error, MissingKey, Notice, refused
from ssilang.api.fields import MeshView
from ssilang.api.objects import CurveView
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.elements.catalog import ELEMENTS, default_element
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.elements import JOINT_NAMES
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.materials.parameters import material_names
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.matrices.relations import blocked, translations
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.interfaces import joint_mesh
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces.grid import grid_cells
from ssilang.kernel.mesh.volumes.block import brick_cells
from ssilang.kernel.statics.linear import product, solve
from ssilang.kernel.stepping.node_histories import NodeHistories
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.run import History, integrate
from ssilang.language.say.errors import SsiError
from ssilang.language.search import nearest_told

FIELDS = {"DEPL": "u", "VITE": "v", "ACCE": "a"}
_MODES = {2: Mode.PLANE_STRAIN, 3: Mode.THREE_DIMENSIONAL}
_SIDES = ("left", "right", "front", "back", "bottom", "top")
_SAME_PLACE = 1e-6  # of the size of a part


@contextmanager
def _one_error(language: str) -> Iterator[None]:
    """What the kernel refuses, as the exception of all that is wrong."""
    try:
        yield
    except KernelError as problem:
        raise Error([Notice.of(SsiError.of(problem, None), language)]) from problem


@dataclass(frozen=True, eq=False)
class Part:
    """A block, or the rigid ground under one.

    Attributes
    ----------
    ids : array
        Node numbers from 0, (rows, columns) in the plane, (layers, rows, columns) in space.
    mesh : MeshView
        Its cells, or those of its one face.
    language : 'en' or 'fr'
        Of what it refuses.
    """

    ids: IntArray
    mesh: MeshView
    language: str = "en"

    def nodes_of(self, side: str) -> IntArray:
        """Node numbers, from 0, of a side: left, right, bottom, top; front, back in space."""
        return self._side(side).ravel()

    def _side(self, side: str) -> IntArray:
        ends = {2: ("left", "right", "bottom", "top"), 3: _SIDES}[max(self.ids.ndim, 2)]
        if side not in ends:
            told = {"side": side, **nearest_told(side, ends)}
            raise refused("api.no-such-side", self.language, MissingKey, **told)
        axis, last = divmod(ends.index(side), 2)
        return np.take(self.ids, -1 if last else 0, axis=self.ids.ndim - 1 - axis)


@dataclass(frozen=True, eq=False)
class Joint:
    """What lies between two parts; `zone` is the kernel's."""

    zone: Zone
    upper: Part
    lower: Part


@dataclass(eq=False)
class Builder:
    """Blocks, joints and what moves them.

    Parameters
    ----------
    dimension : 2 or 3
        Plane strain, or space. The last axis is upwards.
    gravity : float
        m/s2, downwards; 0 for none.
    language : 'en' or 'fr'
        Of what is refused.

    Examples
    --------
    A block stands on rigid ground, which it may leave. Thrown upwards at 1 m/s it is back at its
    place after `2 v / g`:

    >>> import numpy as np
    >>> from ssilang import Builder
    >>> b = Builder()
    >>> block = b.block((0, 0), (1, 1), size=1, YOUN=3e10, NU=0.2, RHO=2400.0)
    >>> joint = b.joint(block, KN=2e8, KS=0.0)
    >>> b.push(block, UY=1.0)
    >>> motion = b.run(np.linspace(0.0, 0.2, 401), start="unloaded")
    >>> flight = motion.opening(joint)[:, 0]
    >>> bool(np.allclose(flight, motion.times - 9.81 * motion.times**2 / 2, atol=1e-9))
    True
    """

    dimension: int = 2
    gravity: float = 9.81
    language: str = "en"
    table: NodeTable = field(default_factory=NodeTable, init=False, repr=False)
    _zones: list[tuple[Zone, CellField]] = field(default_factory=list, init=False, repr=False)
    _joints: list[tuple[Zone, CellField]] = field(default_factory=list, init=False, repr=False)
    _held: list[Relations] = field(default_factory=list, init=False, repr=False)
    _loads: list[tuple[FloatArray, FloatArray, FloatArray]] = field(
        default_factory=list, init=False, repr=False
    )
    _speeds: list[tuple[IntArray, dict[str, float]]] = field(
        default_factory=list, init=False, repr=False
    )
    _damping: tuple[float, float] = field(default=(0.0, 0.0), init=False, repr=False)

    def __post_init__(self) -> None:
        if self.dimension not in _MODES:
            raise refused("api.no-such-dimension", self.language, dimension=self.dimension)
        self.mode = _MODES[self.dimension]
        self.unknowns = translations(self.mode)

    # ---- parts ---------------------------------------------------------------------------------

    def block(
        self,
        corner: Sequence[float],
        opposite: Sequence[float],
        size: float | Sequence[float],
        **material: float,
    ) -> Part:
        """A rectangle or a box of elastic cells: a footing, a structure, soil.

        Parameters
        ----------
        corner, opposite : sequence of float
            Coordinates of two opposite corners.
        size : float or sequence of float
            Size of the cells at most, one for each axis or for all.
        **material
            YOUN (Pa), NU, RHO (kg/m3) ...: the parameters of ELASTIQUE ISOTROPE.

        Raises
        ------
        Error
            For corners that make no block, a parameter that is missing or that the law has not.
        """
        ends = np.array([corner, opposite], dtype=float)
        lengths = np.ptp(ends, axis=0) if ends.shape == (2, self.dimension) else np.zeros(1)
        sizes = np.broadcast_to(np.asarray(size, dtype=float), lengths.shape)
        if not (lengths > 0.0).all() or not (sizes > 0.0).all():
            raise refused(
                "api.no-block", self.language, corner=corner, opposite=opposite, size=size
            )
        counts = np.ceil(lengths / sizes * (1.0 - 1e-9)).astype(int) + 1
        low, high = ends.min(axis=0), ends.max(axis=0)
        axes = [np.linspace(low[i], high[i], n) for i, n in enumerate(counts.tolist())]
        grid = np.meshgrid(*axes[::-1], indexing="ij")[::-1]
        ids = self._add(np.stack([g.ravel() for g in grid], axis=1)).reshape(grid[0].shape)
        flat = self.dimension == 2
        cell = "QUA4" if flat else "CUB8"
        cells = CellBlock.make(self.table, cell, grid_cells(ids, 1) if flat else brick_cells(ids))
        element = default_element(cell, self.mode)
        zone = Zone(cells, "MECANIQUE", ("ELASTIQUE", "ISOTROPE"), element, self.mode)
        self._zones.append((zone, self._material(zone, material)))
        return Part(ids, MeshView(Mesh(self.table, (cells,)), self.language), self.language)

    def joint(
        self, upper: Part, lower: Part | None = None, law: str = "JOINT_SDM", **parameters: float
    ) -> Joint:
        """A joint between the bottom of a part and the top of another one.

        Parameters
        ----------
        lower : Part, optional
            What it stands on: nodes of its top must lie at those of the bottom of `upper`. Without
            it, rigid ground.
        law : str
            'JOINT_SDM' pushes, rubs and does not pull.
        **parameters
            KN, KS (Pa/m), FROT ...: the parameters of the law.
        """
        if lower is None:
            lower = self._ground(upper)
        faces = self._face(upper._side("bottom")), self._face(lower._side("top"))
        extent = float(np.ptp(upper.mesh.points, axis=0).max())
        with _one_error(self.language):
            made = joint_mesh(*faces, tolerance=_SAME_PLACE * extent)
        (cells,) = made.blocks
        names = [n for n in JOINT_NAMES if ELEMENTS[n].cell_type == cells.cell_type]
        zone = Zone(cells, "MECANIQUE", ("ELASTIQUE", law), names[0], self.mode)
        self._joints.append((zone, self._material(zone, parameters)))
        return Joint(zone, upper, lower)

    def _add(self, x: FloatArray) -> IntArray:
        with _one_error(self.language):
            return self.table.add(x)

    def _ground(self, upper: Part) -> Part:
        """Fixed nodes under a part."""
        under = upper._side("bottom")
        ids = self._add(self.table.coordinates[under.ravel()]).reshape(under.shape)
        self._held.append(blocked(self.table, ids.ravel(), self.unknowns))
        return Part(ids[None], MeshView(self._face(ids), self.language), self.language)

    def _face(self, ids: IntArray) -> Mesh:
        """Segments or quadrangles of a side; seen from above, their normal comes to the eye."""
        if self.dimension == 2:
            return Mesh.of(self.table, "SEG2", np.stack([ids[:-1], ids[1:]], axis=1))
        return Mesh.of(self.table, "QUA4", grid_cells(ids, 1))

    def _material(self, zone: Zone, given: Mapping[str, float]) -> CellField:
        """Constant parameters over the cells of a zone."""
        with _one_error(self.language):
            names = material_names(zone)
        for name in given:
            if name not in names.all:
                told = {"name": name, **nearest_told(name, names.all)}
                raise refused("api.no-such-material", self.language, **told)
        lost = [n for n in names.required if n not in given]
        if lost:
            raise refused("api.material-missing", self.language, names=lost)
        n = len(zone.cells)
        values = {name: np.full((n, 1), float(value)) for name, value in given.items()}
        block = CellFieldBlock(zone.cells, values, "STRESSES", zone.element)
        return CellField((block,), "CARACTERISTIQUES")

    # ---- what holds and moves them -------------------------------------------------------------

    def fix(self, part: Part, side: str = "bottom", unknowns: Sequence[str] | None = None) -> None:
        """Hold a side of a part: all displacements, or some ('UX', 'UY', 'UZ')."""
        names = self.unknowns if unknowns is None else self._known(unknowns)
        self._held.append(blocked(self.table, part.nodes_of(side), names))

    def push(self, part: Part, **speeds: float) -> None:
        """Give a part a velocity at the start: `push(block, UX=1.0)`, in m/s."""
        self._known(speeds)
        self._speeds.append((np.unique(part.ids), speeds))

    def shake(self, times: ArrayLike, acceleration: ArrayLike, direction: str = "UX") -> None:
        """Let the base move with an acceleration (m/s2) in time.

        Displacements are then relative to the base: what has mass gets `-M a(t)`.
        """
        self._known([direction])
        way = np.array([name == direction for name in self.unknowns], dtype=float)
        self._loads.append((-way, np.asarray(times, float), np.asarray(acceleration, float)))

    def damp(self, mass: float = 0.0, stiffness: float = 0.0) -> None:
        """Rayleigh damping `mass M + stiffness K` (1/s, s) of the blocks; joints have none."""
        self._damping = (mass, stiffness)

    def _known(self, names: Sequence[str] | Mapping[str, float]) -> tuple[str, ...]:
        for name in names:
            if name not in self.unknowns:
                raise refused(
                    "api.no-such-unknown", self.language, name=name, known=list(self.unknowns)
                )
        return tuple(names)

    # ---- the run -------------------------------------------------------------------------------

    def matrices(self) -> tuple[Matrix, Matrix]:
        """Stiffness, with supports but without joints, and mass: the kernel's objects."""
        K = [families.stiffness(zone, material) for zone, material in self._zones]
        M = [families.mass(z, m) for z, m in self._zones if "RHO" in m.blocks[0].components]
        return (
            Matrix(self.table, tuple(K), tuple(self._held)),
            Matrix(self.table, tuple(M), kind="MASSE"),
        )

    def inputs(self, times: ArrayLike, start: str = "rest") -> Inputs:
        """The problem as the kernel takes it, to change what the builder does not know."""
        if start not in ("rest", "unloaded"):
            raise refused("api.no-such-start", self.language, start=start)
        K, M = self.matrices()
        weight = self._force(M, np.eye(self.dimension)[-1] * -self.gravity)
        parts = [LoadPart("MECA", weight)] if self.gravity else []
        for way, t, a in self._loads:
            curve = Curve((CurvePart(t, a),))
            parts.append(LoadPart("MECA", self._force(M, way), curve))
        rest = None
        if start == "rest" and self.gravity:  # under the weight, with closed joints
            closed = tuple(families.stiffness(zone, material) for zone, material in self._joints)
            rest = solve(Matrix(self.table, (*K.blocks, *closed), K.relations), [weight])[0]
        alpha, beta = self._damping
        damped = (*M.scaled(alpha).blocks, *K.scaled(beta).blocks)
        C = Matrix(self.table, damped, kind="AMORTISSEMENT")
        joints = [zone for zone, _ in self._joints]
        blocks = tuple(block for _, m in self._joints for block in m.blocks)
        return Inputs(
            K, np.asarray(times, dtype=float), M, C if alpha or beta else None,
            Load(tuple(parts)) if parts else None, rest, self._velocity(),
            Model(tuple(joints)) if joints else None, CellField(blocks) if blocks else None,
        )  # fmt: skip

    def run(self, times: ArrayLike, start: str = "rest") -> "Motion":
        """Integrate in time.

        Parameters
        ----------
        times : array
            The steps, from the initial state on.
        start : 'rest' or 'unloaded'
            At rest under the weight, or as built, with the weight coming on at once.
        """
        with _one_error(self.language):
            problem = make_problem(self.inputs(times, start))
            track = NodeHistories(np.ones(len(problem.times), dtype=bool), problem=problem)
            history = integrate(problem, [track])
        return Motion(self, track, history)

    def _force(self, M: Matrix, acceleration: FloatArray) -> NodeField:
        """Forces `M a` of one acceleration of all that has mass."""
        nodes = np.unique(np.concatenate([z.cells.connectivity.ravel() for z, _ in self._zones]))
        values = {
            name: np.full(len(nodes), a)
            for name, a in zip(self.unknowns, acceleration, strict=True)
        }
        return product(M, NodeField.of(self.table, nodes, values, "DIFFUS"))

    def _velocity(self) -> NodeField | None:
        if not self._speeds:
            return None
        nodes = np.unique(np.concatenate([ids for ids, _ in self._speeds]))
        values = {name: np.zeros(len(nodes)) for _, given in self._speeds for name in given}
        for ids, given in self._speeds:
            for name, speed in given.items():
                values[name][np.searchsorted(nodes, ids)] = speed
        return NodeField.of(self.table, nodes, values, "DIFFUS")

    def mesh(self) -> MeshView:
        """All blocks."""
        return MeshView(
            union(*(Mesh(self.table, (z.cells,)) for z, _ in self._zones)), self.language
        )


@dataclass(frozen=True, eq=False)
class Motion:
    """What a built problem did.

    Attributes
    ----------
    track : NodeHistories
        What the kernel kept: all nodes and joints at all steps.
    account : History
        The kernel's account: energies, imbalance, solver, loop.
    """

    builder: Builder
    track: NodeHistories
    account: History

    @property
    def times(self) -> FloatArray:
        """Of all instants (n_times,)."""
        return self.track.times

    def history(self, word: str, component: str, at: Sequence[float], of: Part) -> CurveView:
        """A component at a node of a part in time.

        Parameters
        ----------
        word : str
            'DEPL', 'VITE' or 'ACCE'.
        component : str
            'UX', 'UY' ...
        at : sequence of float
            Coordinates of a node.
        of : Part
            The part: at a joint two nodes stand at one place.
        """
        if word not in FIELDS:
            raise refused("api.no-such-word", self.builder.language, word=word, known=list(FIELDS))
        self.builder._known([component])
        node = _nearest(self.builder, np.unique(of.ids), np.asarray(at, dtype=float))
        values = self.track.history(FIELDS[word], component, node)
        assert values is not None
        part = CurvePart(self.times, values, "TEMP", component, component)
        return CurveView(Curve((part,)), self.builder.language)

    def opening(self, joint: Joint) -> FloatArray:
        """Normal jumps (n_times, n_points) of a joint, positive where it is open."""
        return self._at_points("w", joint)[:, :, -1]

    def traction(self, joint: Joint) -> FloatArray:
        """Tractions (n_times, n_points, dimension) of a joint: along it, then normal, Pa."""
        return self._at_points("t", joint)

    def contact(self, joint: Joint) -> FloatArray:
        """Share of a joint's area that pushes, in time (n_times,)."""
        pushes = self.traction(joint)[:, :, -1] < 0.0
        weights = self._cells(joint)[0].weights.ravel()
        return pushes @ weights / weights.sum()

    def _cells(self, joint: Joint) -> tuple[Any, slice]:
        """The kernel's cells of a joint, and which of its points they are."""
        first, interface = 0, self.track.problem.interface
        assert interface is not None
        for cells in interface.joints:
            last = first + cells.weights.size
            if cells.zone is joint.zone:
                return cells, slice(first, last)
            first = last
        raise refused("api.joint-of-another", self.builder.language)

    def _at_points(self, name: str, joint: Joint) -> FloatArray:
        places = self._cells(joint)[1]
        return self.track.joints(name)[:, places]


def _nearest(builder: Builder, nodes: IntArray, at: FloatArray) -> int:
    """The node of some that stands at a place."""
    table = builder.table
    x = table.coordinates[nodes]
    distance = np.linalg.norm(x - np.pad(at, (0, 3 - len(at))), axis=1)
    i = int(distance.argmin())
    if distance[i] > _SAME_PLACE * np.ptp(x, axis=0).max():
        told = {"nearest": table.told(int(nodes[i])), "distance": distance[i]}
        raise refused("api.no-node-there", builder.language, **told)
    return int(nodes[i])
