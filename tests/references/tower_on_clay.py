"""An elastic tower that rocks on joints on a box of clay that yields, shaken and pushed over."""

import numpy as np

from references.recorder import Recorder
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.relations import Term, relation_rows
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.plasticity.bulk import bulk_of, without_stiffness
from ssilang.kernel.plasticity.run import run_bulk
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem

DT = 1e-2
CLAY = {"YOUN": 2e7, "NU": 0.4, "RHO": 1900.0}
LAWS = {
    "J2": {"SIG0": 6e4, "SIGI": 6e4, "KISO": 5e5, "VELO": 0.0},
    "DRUCKER_PARFAIT": {"LTR": 1e4, "LCS": 4e4},
    "CINEMATIQUE": {"SIGY": 6e4, "H": 5e5},
    "DRUCKER_PRAGER": {
        "ALFA": 0.1, "BETA": 1.0, "K": 3e4, "ETA": 0.1, "MU": 1.0, "KL": 3e4, "H": 0.0,
        "GAMM": 0.0, "DELT": 1.0,
    },
}  # fmt: skip


def grid(table: NodeTable, x0: float, y0: float, nx: int, ny: int) -> np.ndarray:
    X, Y = np.meshgrid(x0 + np.arange(nx + 1.0), y0 + np.arange(ny + 1.0), indexing="ij")
    return table.add(np.column_stack([X.ravel(), Y.ravel()])).reshape(nx + 1, ny + 1)


def zone(table, ids, law: tuple[str, ...], data: dict[str, float]) -> tuple[Zone, CellField]:
    cells = np.stack([ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]], -1).reshape(-1, 4)
    block = CellBlock.make(table, "QUA4", cells)
    values = {name: np.full((len(block), 1), v) for name, v in data.items()}
    field = CellField((CellFieldBlock(block, values, "STRESSES", "QUA4"),))
    return Zone(
        block, "MECANIQUE", ("ELASTIQUE", "ISOTROPE", *law), "QUA4", Mode.PLANE_STRAIN
    ), field


def tower_on_clay(law: str = "J2", steps: int = 56, wide: int = 4, moved: float = 0.0):
    """Problem, plastic bodies: a tower of `wide` x 10 on a box of eight times its width.

    `moved`: the base goes that far to and fro, too.
    """
    table, across, first = NodeTable(), 8 * wide, 7 * wide // 2
    soil = grid(table, 0, -across // 2, across, across // 2)
    tower = grid(table, first, 0, wide, 10)
    clay, clay_field = zone(table, soil, ("PLASTIQUE", law), CLAY | LAWS[law])
    stiff, stiff_field = zone(table, tower, (), {"YOUN": 1e9, "NU": 0.2, "RHO": 1000.0})
    pairs = np.column_stack([soil[first : first + wide + 1, -1], tower[:, 0]])
    block, one = CellBlock.make(table, "SEG2", pairs), np.ones((wide + 1, 1))
    names = {"KN": 1e8 * one, "KS": 5e7 * one, "V1X": 0 * one, "V1Y": one}
    joints = Zone(
        block, "MECANIQUE", ("ELASTIQUE", "JOINT_SDM", "CISAILLEMENT_ELASTIQUE"), "JOI1",
        Mode.PLANE_STRAIN,
    )  # fmt: skip
    base = soil[:, 0]
    held = [relation_rows(table, [Term(1.0, u, base)], 0) for u in ("UX", "UY")]
    K = Matrix(
        table, (without_stiffness(clay), families.stiffness(stiff, stiff_field)), tuple(held)
    )
    lumped = (families.mass(clay, clay_field, True), families.mass(stiff, stiff_field, True))
    M = Matrix(table, lumped, kind="MASSE")
    numbering = numbering_of(K, M)
    mass = assemble(M, numbering).diagonal()
    shake, weight = np.zeros(numbering.size), np.zeros(numbering.size)
    along_x, along_y = numbering.where("UX"), numbering.where("UY")
    shake[along_x] = -mass[along_x]
    heavy = along_y[np.isin(numbering.nodes[along_y], tower)]
    weight[heavy] = -9.81 * mass[heavy]
    shake[along_x[np.isin(numbering.nodes[along_x], tower)]] *= 3.0  # it is pushed over, too
    times = DT * np.arange(steps + 1)
    ties = np.sort(held[0].multipliers)
    motion = NodeField.of(table, ties, {"FLX": np.full(len(ties), moved / 6.0)})
    sine = Curve((CurvePart(times, 6.0 * np.sin(2 * np.pi * 2.5 * times)),))
    load = Load(
        (
            LoadPart("MECA", vector_to_field(weight, numbering, dual=True)),
            LoadPart("MECA", vector_to_field(shake, numbering, dual=True), sine),
            *([LoadPart("DIMP", motion, sine)] if moved else ()),
        )
    )
    field = CellField((CellFieldBlock(block, names, "STRESSES", "JOI1"),))
    inputs = Inputs(K, times, M, None, load, model=Model((joints,)), characteristics=field)
    problem = make_problem(inputs)
    return problem, bulk_of((clay,), clay_field, numbering)


def stepped_tower(
    law: str = "J2", steps: int = 56, wide: int = 4, keeper=None, full=False, moved=0.0
):
    """History of its run, what an observer has seen, plastic strains (m,) at the end."""
    problem, bulk = tower_on_clay(law, steps, wide, moved)
    seen = Recorder(steps + 1)
    history = run_bulk(problem, bulk, bulk.unloaded(), [seen], None, True, keeper, full)
    return history, seen, seen.snapshots[-1].bulk_state[0].variables[:, 0]
