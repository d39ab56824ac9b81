"""A tower that rocks on a box of 10 000 yielding quads, in ssilang and in OpenSeesPy.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas3 and liblapack3)
    OMP_NUM_THREADS=1 python benchmarks/yielding_box.py [cells across [steps [steps of the peer]]]

Clay in plane strain (von Mises with linear hardening, four points a quad), fixed at its base; an
elastic tower on joints that only push along the normal and are elastic in shear; its weight, and a
sine at the base. The same quads, lumped masses, springs, loads and step (average acceleration,
5 ms) in both. OpenSees takes the best of its sparse solvers and algorithms, found over the first
steps, and ends a step at 0.1 N out of balance.
A ratio is printed only if the displacements of the tower's top agree within 1e-6 of the largest
one at every step that both made. Times are processor times of the stepping loops, factorisation
and assembly included; a run of the same steps before loads the compiled code.
"""

import resource
import sys
import time
from dataclasses import dataclass

import numpy as np
from uplift_openseespy import DT, GRAVITY, SIZE, grid, quads

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.plasticity.bulk import bulk_of, without_stiffness
from ssilang.kernel.plasticity.run import run_bulk
from ssilang.kernel.plasticity.snapshot import BulkSnapshot
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem
from ssilang.kernel.stepping.snapshot import Snapshot

SOIL = {"YOUN": 6e7, "NU": 0.45, "RHO": 1900.0}
CLAY = {"SIG0": 1.5e5, "SIGI": 1.5e5, "KISO": 6e5, "VELO": 0.0}  # strength, hardening (Pa)
TOWER = {"YOUN": 2e9, "NU": 0.25, "RHO": 1000.0}
NORMAL, SHEAR = 1e8, 5e7  # N/m of a pair of nodes
PULSE, FREQUENCY = 3.0, 1.0  # m/s2, Hz
AGREEMENT = 1e-6
SOLVERS = ("SparseSYM", "UmfPack", "SparseGeneral", "ProfileSPD")
ALGORITHMS = (("Newton",), ("ModifiedNewton",), ("KrylovNewton",), ("ModifiedNewton", "-initial"))
TRIED = 16  # steps over which the peer's solvers and algorithms compete; it yields from the 11th on
UNBALANCE = 1e-1  # N: the peer's test


@dataclass
class Case:
    """Grids of node numbers (columns along x) of soil and tower, coordinates of all nodes."""

    table: NodeTable
    soil: np.ndarray
    tower: np.ndarray


def make_case(across: int) -> Case:
    """Soil of `across` by a quarter of it, a tower of 1/20 by 1/5 on top."""
    table = NodeTable()
    deep, wide = across // 4, max(2 * round(across / 40), 2)
    soil = grid(table, -across / 2 * SIZE, -deep * SIZE, across, deep)
    tower = grid(table, -wide / 2 * SIZE, 0.0, wide, 4 * wide)
    return Case(table, soil, tower)


def facing(case: Case) -> np.ndarray:
    """Pairs (n, 2) of nodes of soil and tower."""
    wide = case.tower.shape[0]
    first = (case.soil.shape[0] - wide) // 2
    return np.column_stack([case.soil[first : first + wide, -1], case.tower[:, 0]])


def zone(
    case: Case, ids: np.ndarray, law: tuple[str, ...], data: dict[str, float]
) -> tuple[Zone, CellField]:
    """Plane-strain quads and their parameters."""
    block = CellBlock.make(case.table, "QUA4", quads(ids))
    names = {name: np.full((len(block), 1), v) for name, v in data.items()}
    field = CellField((CellFieldBlock(block, names, "STRESSES", "QUA4"),))
    return Zone(block, "MECANIQUE", law, "QUA4", Mode.PLANE_STRAIN), field


def joints(case: Case) -> tuple[Model, CellField]:
    """No-tension joints of two points, elastic in shear."""
    block = CellBlock.make(case.table, "SEG2", facing(case))
    one = np.ones((len(block), 1))
    names = {"KN": NORMAL * one, "KS": SHEAR * one, "V1X": 0 * one, "V1Y": one}
    field = CellField((CellFieldBlock(block, names, "STRESSES", "JOI1"),))
    law = ("ELASTIQUE", "JOINT_SDM", "CISAILLEMENT_ELASTIQUE")
    return Model((Zone(block, "MECANIQUE", law, "JOI1", Mode.PLANE_STRAIN),)), field


def supports(case: Case) -> Relations:
    """The soil's base is fixed."""
    base = np.repeat(case.soil[:, 0], 2)
    n = len(base)
    rows, names = case.table.add(np.zeros((n, 3))), ("UX", "UY") * (n // 2)
    return Relations(
        case.table, np.arange(n + 1), base, names, np.ones(n), rows, np.zeros(n, np.int8)
    )


def pulse(times: np.ndarray) -> np.ndarray:
    """Acceleration of the base."""
    return PULSE * np.sin(2 * np.pi * FREQUENCY * times)


@dataclass
class Model2D:
    """A problem with its plastic zone, and nodal masses and weights (n_nodes,) for the peer."""

    problem: Problem
    soil: tuple[Zone, CellField]
    mass: np.ndarray
    weight: np.ndarray


def make_model(case: Case, steps: int) -> Model2D:
    """The problem for ssilang, and what the peer needs of it."""
    plastic = ("ELASTIQUE", "ISOTROPE", "PLASTIQUE", "J2")
    soil, clay = zone(case, case.soil, plastic, SOIL | CLAY)
    tower, concrete = zone(case, case.tower, ("ELASTIQUE", "ISOTROPE"), TOWER)
    lumped = (families.mass(soil, clay, True), families.mass(tower, concrete, True))
    stiffness = (without_stiffness(soil), families.stiffness(tower, concrete))
    K = Matrix(case.table, stiffness, (supports(case),))
    M = Matrix(case.table, lumped, kind="MASSE")
    numbering = numbering_of(K, M)
    diagonal = assemble(M, numbering).diagonal()
    along_x, along_y = numbering.where("UX"), numbering.where("UY")
    shake, weight = np.zeros(numbering.size), np.zeros(numbering.size)
    shake[along_x] = -diagonal[along_x]
    heavy = along_y[np.isin(numbering.nodes[along_y], case.tower)]
    weight[heavy] = -GRAVITY * diagonal[heavy]
    times = DT * np.arange(steps + 1)
    curve = Curve((CurvePart(times, pulse(times)),))
    load = Load(
        (
            LoadPart("MECA", vector_to_field(weight, numbering, dual=True)),
            LoadPart("MECA", vector_to_field(shake, numbering, dual=True), curve),
        )
    )
    model, field = joints(case)
    problem = make_problem(Inputs(K, times, M, None, load, model=model, characteristics=field))
    n = len(case.table)
    mass, pull = np.zeros(n), np.zeros(n)
    mass[numbering.nodes[along_x]] = diagonal[along_x]
    pull[numbering.nodes[along_y]] = weight[along_y]
    return Model2D(problem, (soil, clay), mass, pull)


class Top:
    """Keeps the horizontal displacement of the tower's upper left corner, and the soil's state."""

    def __init__(self, case: Case, count: int) -> None:
        self.wanted = np.ones(count, bool)
        self.node = int(case.tower[0, -1])
        self.values: list[float] = []
        self.at = -1
        self.strain = np.zeros(0)

    def receive(self, snapshot: Snapshot) -> None:
        """One more instant."""
        if self.at < 0:
            self.at = snapshot.problem.numbering.index_of(self.node, "UX")
        self.values.append(float(snapshot.u[self.at]))
        if isinstance(snapshot, BulkSnapshot):
            self.strain = snapshot.bulk_state[0].variables[:, 0]

    def close(self) -> None:
        """Nothing to close."""


def run_ssilang(case: Case, steps: int) -> tuple[np.ndarray, float, str]:
    """Displacements at all times, seconds of a processor of the loop, what was found."""
    made = make_model(case, steps)
    zone_, field = made.soil
    bulk = bulk_of((zone_,), field, made.problem.numbering)
    top = Top(case, steps + 1)
    started = time.process_time()
    history = run_bulk(made.problem, bulk, bulk.unloaded(), [top], None, True)
    seconds = time.process_time() - started
    yielded = np.mean(top.strain > 0)
    told = f"{history.loop}, at most {history.iterations} turns, {yielded:.0%} of points yielded"
    return np.array(top.values), seconds, told


def peer_model(case: Case, made: Model2D, solver: str, algorithm: tuple[str, ...]) -> None:
    """The same model in OpenSees, ready to analyse."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    nodes = np.union1d(case.soil, case.tower).tolist()
    for i in nodes:
        x, y, _ = case.table.coordinates[i]
        ops.node(i + 1, float(x), float(y))
        ops.mass(i + 1, float(made.mass[i]), float(made.mass[i]))
    for i in case.soil[:, 0].tolist():
        ops.fix(i + 1, 1, 1)
    E, nu = SOIL["YOUN"], SOIL["NU"]
    bulk, shear = E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))
    strength = (CLAY["SIG0"], CLAY["SIGI"], CLAY["VELO"], CLAY["KISO"])
    ops.nDMaterial("J2Plasticity", 1, bulk, shear, *strength)
    ops.nDMaterial("ElasticIsotropic", 2, TOWER["YOUN"], TOWER["NU"])
    number = 0
    for tag, ids in enumerate((case.soil, case.tower), 1):
        for cell in (quads(ids) + 1).tolist():
            number += 1
            ops.element("quad", number, *cell, 1.0, "PlaneStrain", tag)
    ops.uniaxialMaterial("ENT", 11, NORMAL)
    ops.uniaxialMaterial("Elastic", 12, SHEAR)
    for low, up in facing(case).tolist():
        number += 1
        ops.element("zeroLength", number, low + 1, up + 1, "-mat", 11, 12, "-dir", 2, 1)
    peer_loads(case, made, nodes)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(solver)
    ops.test("NormUnbalance", UNBALANCE, 60)
    ops.algorithm(*algorithm)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer_loads(case: Case, made: Model2D, nodes: list[int]) -> None:
    """Weight (constant), inertia of the moving base, and the acceleration that ssilang starts with.

    A path gives nothing beyond its last value.
    """
    import openseespy.opensees as ops

    times = DT * np.arange(len(made.problem.times) + 1)
    ops.timeSeries("Constant", 1)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *pulse(times).tolist())
    ops.pattern("Plain", 1, 1)
    for i in case.tower.ravel().tolist():
        ops.load(i + 1, 0.0, float(made.weight[i]))
        ops.setNodeAccel(i + 1, 2, float(made.weight[i] / made.mass[i]), "-commit")
    ops.pattern("Plain", 2, 2)
    fixed = set(case.soil[:, 0].tolist())
    for i in nodes:
        if i not in fixed:
            ops.load(i + 1, -float(made.mass[i]), 0.0)


def run_peer(
    case: Case, made: Model2D, steps: int, solver: str, algorithm: tuple[str, ...]
) -> tuple[np.ndarray, float]:
    """Displacements at all times and seconds of a processor of the loop."""
    import openseespy.opensees as ops

    peer_model(case, made, solver, algorithm)
    node = int(case.tower[0, -1]) + 1
    values, started = [0.0], time.process_time()
    for _ in range(steps):
        if ops.analyze(1, DT):
            return np.full(len(values), np.nan), np.inf
        values.append(ops.nodeDisp(node, 1))
    return np.array(values), time.process_time() - started


def compare(across: int, steps: int, peer_steps: int) -> None:
    """Print what both take for a step, and the ratio."""
    case = make_case(across)
    made = make_model(make_case(across), peer_steps)
    size = made.problem.numbering.size
    run_ssilang(case, steps)  # compiles
    own, seconds, told = run_ssilang(make_case(across), steps)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{size} unknowns; ssilang {1e3 * seconds / steps:.1f} ms a step, {peak:.0f} MB: {told}")
    ways = [(s, ALGORITHMS[0]) for s in SOLVERS]
    tried = {way: run_peer(case, made, TRIED, *way)[1] / TRIED for way in ways}
    solver = min(tried, key=lambda way: tried[way])[0]
    for algorithm in ALGORITHMS[1:]:
        tried[solver, algorithm] = run_peer(case, made, TRIED, solver, algorithm)[1] / TRIED
    for (name, algorithm), spent in tried.items():
        print(f"  OpenSees {name} {' '.join(algorithm)}: {1e3 * spent:.0f} ms a step", flush=True)
    best = min(tried, key=lambda way: tried[way])
    values, spent = run_peer(case, made, peer_steps, *best)
    shared = own[: peer_steps + 1]
    difference = np.abs(shared - values).max() / np.abs(shared).max()
    if not difference <= AGREEMENT:
        print(f"the answers differ by {difference:.1e}, no ratio")
        return
    ratio = (spent / peer_steps) / (seconds / steps)
    print(f"OpenSees {best[0]} {' '.join(best[1])} {1e3 * spent / peer_steps:.0f} ms a step over "
          f"{peer_steps} steps, ratio {ratio:.1f}; difference {difference:.0e}")  # fmt: skip


def main() -> None:
    """The size asked for."""
    given = [int(a) for a in sys.argv[1:]]
    across, steps, peer_steps = (given + [200, 60, 60][len(given) :])[:3]
    compare(across, steps, peer_steps)


if __name__ == "__main__":
    main()
