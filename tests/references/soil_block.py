"""A block of plane quads on a layer of soil, on joints, shaken by inertia forces."""

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem

FRICTION = {"KN": 2e8, "KS": 1e8, "FROT": 0.6}
RAYLEIGH = (0.5, 2e-3)


def _grid(table: NodeTable, x0: float, y0: float, nx: int, ny: int) -> np.ndarray:
    x, y = np.meshgrid(x0 + np.arange(nx + 1.0), y0 + np.arange(ny + 1.0), indexing="ij")
    return table.add(np.column_stack([x.ravel(), y.ravel()])).reshape(nx + 1, ny + 1)


def _solid(table: NodeTable, ids: np.ndarray, young: float, density: float):
    corners = (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:])
    block = CellBlock.make(table, "QUA4", np.stack(corners, -1).reshape(-1, 4))
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "ISOTROPE"), "QUA4", Mode.PLANE_STRAIN)
    one = np.ones((len(block), 1))
    values = {"YOUN": young * one, "NU": 0.3 * one, "RHO": density * one}
    field = CellField((CellFieldBlock(block, values, "STRESSES", "QUA4"),))
    return families.stiffness(zone, field), families.mass(zone, field)


def _joints(table: NodeTable, low: np.ndarray, up: np.ndarray, law: tuple[str, ...], given: dict):
    block = CellBlock.make(table, "RAC2", np.column_stack([up[:-1], up[1:], low[:-1], low[1:]]))
    zone = Zone(block, "MECANIQUE", law, "JOI2", Mode.PLANE_STRAIN)
    one = np.ones((len(block), 1))
    values = {k: v * one for k, v in given.items()}
    return Model((zone,)), CellField((CellFieldBlock(block, values, "STRESSES", "JOI2"),))


def soil_block(
    steps: int = 400,
    dt: float = 5e-3,
    size: tuple[int, int, int] = (28, 14, 4),
    joint: dict | None = None,
    words: tuple[str, ...] = (),
    damping: tuple[float, float] | None = RAYLEIGH,
    acceleration: float = 4.0,
    scheme: Scheme | None = None,
    moving: bool = False,
    extra_damping: float = 0.0,
) -> Problem:
    """Soil of `size[0]` x `size[1]` metres under a block of `size[2]` x 6 metres, 1 m quads.

    The weight acts at once; the base shakes at 2 Hz by inertia forces. `extra_damping` adds a
    dashpot in the first element of the soil; `moving` makes the base's imposed values non-zero.
    """
    nx, ny, nb = size
    table = NodeTable()
    soil, block = _grid(table, -nx / 2, -ny, nx, ny), _grid(table, -nb / 2, 0.0, nb, 6)
    (K1, M1), (K2, M2) = _solid(table, soil, 8e7, 1900.0), _solid(table, block, 2e9, 1500.0)
    first = (nx - nb) // 2
    law = ("ELASTIQUE", "JOINT_SDM", *words)
    model, characteristics = _joints(
        table, soil[first : first + nb + 1, -1], block[:, 0], law, joint or FRICTION
    )
    base = np.repeat(soil[:, 0], 2)
    rows = table.add(np.zeros((len(base), 3)))
    sense, starts = np.zeros(len(base), np.int8), np.arange(len(base) + 1)
    names = ("UX", "UY") * len(soil)
    fixed = Relations(table, starts, base, names, np.ones(len(base)), rows, sense)
    K, M = Matrix(table, (K1, K2), (fixed,)), Matrix(table, (M1, M2), kind="MASSE")
    numbering = numbering_of(K, M)
    mass, forces = assemble(M, numbering), []
    for name, value in (("UY", -9.81), ("UX", -1.0)):
        motion = np.zeros(numbering.size)
        motion[numbering.where(name)] = value
        forces.append(vector_to_field(mass @ motion, numbering, dual=True))
    times = dt * np.arange(steps + 1)
    shake = Curve((CurvePart(times, acceleration * np.sin(4 * np.pi * times)),))
    load = Load((LoadPart("MECA", forces[0]), LoadPart("MECA", forces[1], shake)))
    C = None
    if damping is not None:
        blocks = M.scaled(damping[0]).blocks + K.scaled(damping[1]).blocks
        C = Matrix(table, blocks + (K1,) * bool(extra_damping))
    inputs = Inputs(
        K, times, M, C, load, model=model, characteristics=characteristics,
        scheme=scheme or Scheme(),
    )  # fmt: skip
    problem = make_problem(inputs)
    if moving:
        problem.loading.imposed[:] = 1e-3
    return problem
