"""Small mechanical systems put together by hand: masses, springs, supports, joints."""

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of
from ssilang.kernel.matrices.relations import Term, relation_rows
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem


class Bench:
    """A node table and what has been put on it."""

    def __init__(self, mode: Mode = Mode.PLANE_STRAIN) -> None:
        self.table, self.mode = NodeTable(), mode
        self.stiffness_blocks: list[ElementMatrices] = []
        self.mass_blocks: list[ElementMatrices] = []
        self.damping_blocks: list[ElementMatrices] = []
        self.relations: list = []
        self.zones: list[Zone] = []
        self.fields: list[CellFieldBlock] = []

    def node(self, *x: float) -> int:
        return int(self.table.add(np.array([x]))[0])

    def _block(self, nodes, unknowns, matrix, kind) -> ElementMatrices:
        return ElementMatrices(
            self.table,
            np.array([nodes]),
            np.arange(len(nodes)),
            tuple(unknowns),
            tuple(dual_of(u) for u in unknowns),
            np.array([matrix], dtype=float),
            kind,
        )

    def spring(self, k: float, a: int, b: int | None = None, unknown: str = "UY") -> None:
        """Spring k from `a` to the ground or to `b`."""
        if b is None:
            block = self._block([a], [unknown], [[k]], "RIGIDITE")
        else:
            block = self._block([a, b], [unknown] * 2, [[k, -k], [-k, k]], "RIGIDITE")
        self.stiffness_blocks.append(block)

    def dashpot(self, c: float, a: int, unknown: str = "UY") -> None:
        self.damping_blocks.append(self._block([a], [unknown], [[c]], "AMORTISSEMENT"))

    def mass(self, m: float, a: int, unknowns: tuple[str, ...] = ("UX", "UY")) -> None:
        for u in unknowns:
            self.mass_blocks.append(self._block([a], [u], [[m]], "MASSE"))

    def relate(self, terms: list[tuple[float, str, int]], sense: int = 0) -> int:
        """One condition; returns its multiplier node."""
        made = relation_rows(self.table, [Term(c, u, np.array([n])) for c, u, n in terms], sense)
        self.relations.append(made)
        return int(made.multipliers[0])

    def fix(self, a: int, *unknowns: str) -> None:
        for u in unknowns or ("UX", "UY"):
            self.relate([(1.0, u, a)])

    def joint(self, cell_type: str, cells, element: str, law: str = "JOINT_SDM", **p) -> Zone:
        """Joints on cells (n, k) with parameters p."""
        block = CellBlock.make(self.table, cell_type, np.atleast_2d(cells))
        zone = Zone(block, "MECANIQUE", ("ELASTIQUE", law), element, self.mode)
        parameters = {k: np.full((len(block), 1), float(v)) for k, v in p.items()}
        self.zones.append(zone)
        self.fields.append(CellFieldBlock(block, parameters, "STRESSES", element))
        return zone

    @property
    def stiffness(self) -> Matrix:
        return Matrix(self.table, tuple(self.stiffness_blocks), tuple(self.relations))

    @property
    def mass_matrix(self) -> Matrix:
        return Matrix(self.table, tuple(self.mass_blocks), kind="MASSE")

    @property
    def damping(self) -> Matrix | None:
        blocks = tuple(self.damping_blocks)
        return Matrix(self.table, blocks, kind="AMORTISSEMENT") if blocks else None

    @property
    def model(self) -> Model | None:
        return Model(tuple(self.zones)) if self.zones else None

    @property
    def characteristics(self) -> CellField | None:
        return CellField(tuple(self.fields)) if self.fields else None

    def field(self, *values: tuple[int, str, float]) -> NodeField:
        nodes = np.unique([n for n, _, _ in values])
        names = dict.fromkeys(u for _, u, _ in values)
        found = {u: np.zeros(len(nodes)) for u in names}
        for n, u, x in values:
            found[u][np.searchsorted(nodes, n)] = x
        return NodeField.of(self.table, nodes, found)

    def problem(self, times, load: Load | None = None, **given) -> Problem:
        """Of all that was put on it; `given` are entries of `Inputs`, beside or in its place."""
        own = {
            "mass": self.mass_matrix if self.mass_blocks else None, "damping": self.damping,
            "model": self.model, "characteristics": self.characteristics,
        }  # fmt: skip
        return make_problem(Inputs(self.stiffness, times, load=load, **own | given))

    def load(self, field: NodeField, times=None, factors=None) -> Load:
        if times is None:
            return Load((LoadPart("MECA", field),))
        curve = Curve((CurvePart(np.asarray(times, float), np.asarray(factors, float)),))
        return Load((LoadPart("MECA", field, curve),))
