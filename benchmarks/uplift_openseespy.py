"""Elastic block on a soil block with a no-tension interface, in ssilang and in OpenSeesPy.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas3 and liblapack3)
    OMP_NUM_THREADS=1 python benchmarks/uplift_openseespy.py [unknowns ...]
                                                 default 2000 7500 30000 116000

The same plane-strain quads, lumped masses, springs (compression only along the normal, elastic in
shear), loads (weight of the block, a sine at the base) and step (average acceleration, 5 ms) in
both; OpenSees with Newton's method and each of its sparse solvers in turn. The best of them is
taken. A ratio is printed only if the displacements of the block's top agree within 1e-6 of the
largest one at every step that both kept (one in ten). Times are of a processor, of the loops, the
factorisation included: ssilang over 1 000 steps, the peer, whose steps all cost the same, over
fewer. The two run in turn; the median of three is kept (one above 10 000 unknowns).
"""

import statistics
import sys
import time
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix, Relations
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.snapshot import Snapshot

DT, SIZE, GRAVITY = 5e-3, 0.5, 9.81
SOIL, BLOCK = (5e7, 0.3, 1900.0), (2e9, 0.25, 1200.0)  # Young's modulus, Poisson's ratio, density
NORMAL, SHEAR = 1e8, 5e7  # N/m of a pair of nodes
PULSE, FREQUENCY = 6.0, 2.0  # m/s2, Hz
AGREEMENT = 1e-6
OWN_STEPS, KEPT = 1000, 10
STEPS = {2000: 400, 7500: 200, 30000: 80, 116000: 30}  # of the peer
PEER_SOLVERS = ("SparseSYM", "UmfPack", "SparseGeneral")


@dataclass
class Case:
    """Grids of node numbers (columns along x) of soil and block, coordinates of all nodes."""

    table: NodeTable
    soil: np.ndarray
    block: np.ndarray
    steps: int


def grid(table: NodeTable, x0: float, y0: float, nx: int, ny: int) -> np.ndarray:
    """Node numbers (nx + 1, ny + 1) of a new regular grid."""
    x, y = x0 + SIZE * np.arange(nx + 1), y0 + SIZE * np.arange(ny + 1)
    X, Y = np.meshgrid(x, y, indexing="ij")
    return table.add(np.column_stack([X.ravel(), Y.ravel()])).reshape(nx + 1, ny + 1)


def quads(ids: np.ndarray) -> np.ndarray:
    """Cells (n, 4) of a grid."""
    return np.stack([ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]], -1).reshape(-1, 4)


def make_case(unknowns: int, steps: int) -> Case:
    """Soil of 4 b x 2 b cells under a block of b x b cells."""
    b = 2 * round((unknowns / 18) ** 0.5 / 2)  # even: soil and block share their nodes
    table = NodeTable()
    soil = grid(table, -2 * b * SIZE, -2 * b * SIZE, 4 * b, 2 * b)
    block = grid(table, -b * SIZE / 2, 0.0, b, b)
    return Case(table, soil, block, steps)


def interface(case: Case) -> tuple[np.ndarray, np.ndarray]:
    """Facing nodes of soil and block."""
    b = case.block.shape[0] - 1
    first = (case.soil.shape[0] - 1 - b) // 2
    return case.soil[first : first + b + 1, -1], case.block[:, 0]


def zone(case: Case, cells: np.ndarray, data: tuple[float, float, float]) -> tuple[Zone, CellField]:
    """Plane-strain quads and their parameters."""
    block = CellBlock.make(case.table, "QUA4", cells)
    one = np.ones((len(block), 1))
    names = dict(zip(("YOUN", "NU", "RHO"), (v * one for v in data), strict=True))
    field = CellField((CellFieldBlock(block, names, "STRESSES", "QUA4"),))
    law = ("ELASTIQUE", "ISOTROPE")
    return Zone(block, "MECANIQUE", law, "QUA4", Mode.PLANE_STRAIN), field


def joints(case: Case) -> tuple[Model, CellField]:
    """No-tension joints of two points, elastic in shear."""
    block = CellBlock.make(case.table, "SEG2", np.column_stack(interface(case)))
    one = np.ones((len(block), 1))
    # coincident points have no direction: the normal is given
    names = {"KN": NORMAL * one, "KS": SHEAR * one, "V1X": 0 * one, "V1Y": one}
    field = CellField((CellFieldBlock(block, names, "STRESSES", "JOI1"),))
    law = ("ELASTIQUE", "JOINT_SDM", "CISAILLEMENT_ELASTIQUE")
    made = Zone(block, "MECANIQUE", law, "JOI1", Mode.PLANE_STRAIN)
    return Model((made,)), field


def supports(case: Case) -> Relations:
    """The soil's base is fixed."""
    base = np.repeat(case.soil[:, 0], 2)
    n = len(base)
    rows = case.table.add(np.zeros((n, 3)))
    names = ("UX", "UY") * (n // 2)
    sense = np.zeros(n, np.int8)
    return Relations(case.table, np.arange(n + 1), base, names, np.ones(n), rows, sense)


def pulse(times: np.ndarray) -> np.ndarray:
    """Acceleration of the base."""
    return PULSE * np.sin(2 * np.pi * FREQUENCY * times)


@dataclass
class Forces:
    """Nodal masses (n_nodes,) and the weight of the block's nodes (n_nodes,)."""

    mass: np.ndarray
    weight: np.ndarray


def inputs_of(case: Case) -> tuple[Inputs, Forces]:
    """The problem for ssilang, and what the peer needs of it."""
    soil, soil_field = zone(case, quads(case.soil), SOIL)
    block, block_field = zone(case, quads(case.block), BLOCK)
    stiffness = [families.stiffness(soil, soil_field), families.stiffness(block, block_field)]
    lumped = [families.mass(soil, soil_field, True), families.mass(block, block_field, True)]
    K = Matrix(case.table, tuple(stiffness), (supports(case),))
    M = Matrix(case.table, tuple(lumped), kind="MASSE")
    numbering = numbering_of(K, M)
    diagonal = assemble(M, numbering).diagonal()
    along_x, along_y = numbering.where("UX"), numbering.where("UY")
    shake, weight = np.zeros(numbering.size), np.zeros(numbering.size)
    shake[along_x] = -diagonal[along_x]
    heavy = along_y[np.isin(numbering.nodes[along_y], case.block)]
    weight[heavy] = -GRAVITY * diagonal[heavy]
    times = DT * np.arange(case.steps + 1)
    curve = Curve((CurvePart(times, pulse(times)),))
    load = Load(
        (
            LoadPart("MECA", vector_to_field(weight, numbering, dual=True)),
            LoadPart("MECA", vector_to_field(shake, numbering, dual=True), curve),
        )
    )
    model, field = joints(case)
    inputs = Inputs(K, times, M, None, load, model=model, characteristics=field)
    n = len(case.table)
    mass, pull = np.zeros(n), np.zeros(n)
    mass[numbering.nodes[along_x]] = diagonal[along_x]
    pull[numbering.nodes[along_y]] = weight[along_y]
    return inputs, Forces(mass, pull)


class Top:
    """Keeps the horizontal displacement of the block's upper left corner."""

    def __init__(self, case: Case, count: int) -> None:
        self.wanted = np.arange(count) % KEPT == 0
        self.node = int(case.block[0, -1])
        self.values: list[float] = []

    def receive(self, snapshot: Snapshot) -> None:
        """One more instant."""
        at = snapshot.problem.numbering.index_of(self.node, "UX")
        self.values.append(float(snapshot.u[at]))

    def close(self) -> None:
        """Nothing to close."""


def run_ssilang(case: Case) -> tuple[np.ndarray, float]:
    """Displacements at all times and seconds of assembly, factorisation and loop."""
    inputs, _ = inputs_of(case)
    top = Top(case, len(inputs.times))
    problem = make_problem(inputs)
    started = time.process_time()
    integrate(problem, [top])
    return np.array(top.values), time.process_time() - started


def peer_model(case: Case, forces: Forces, solver: str) -> None:
    """The same model in OpenSees, ready to analyse."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    used = np.union1d(case.soil, case.block)
    for i in used.tolist():
        x, y, _ = case.table.coordinates[i]
        ops.node(i + 1, float(x), float(y))
        ops.mass(i + 1, float(forces.mass[i]), float(forces.mass[i]))
    for i in case.soil[:, 0].tolist():
        ops.fix(i + 1, 1, 1)
    number = 0
    for tag, (ids, (young, nu, _)) in enumerate(((case.soil, SOIL), (case.block, BLOCK)), 1):
        ops.nDMaterial("ElasticIsotropic", tag, young, nu)
        for cell in (quads(ids) + 1).tolist():
            number += 1
            ops.element("quad", number, *cell, 1.0, "PlaneStrain", tag)
    ops.uniaxialMaterial("ENT", 11, NORMAL)
    ops.uniaxialMaterial("Elastic", 12, SHEAR)
    for low, up in np.column_stack(interface(case)).tolist():
        number += 1
        ops.element("zeroLength", number, low + 1, up + 1, "-mat", 11, 12, "-dir", 2, 1)
    peer_loads(case, forces)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(solver)
    ops.test("NormUnbalance", 1e-3, 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer_loads(case: Case, forces: Forces) -> None:
    """Weight (constant) and inertia of the moving base."""
    import openseespy.opensees as ops

    times = DT * np.arange(case.steps + 2)  # beyond its last value a path gives nothing
    ops.timeSeries("Constant", 1)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *pulse(times).tolist())
    ops.pattern("Plain", 1, 1)
    for i in case.block.ravel().tolist():
        ops.load(i + 1, 0.0, float(forces.weight[i]))
    ops.pattern("Plain", 2, 2)
    fixed = set(case.soil[:, 0].tolist())
    for i in np.union1d(case.soil, case.block).tolist():
        if i not in fixed:
            ops.load(i + 1, -float(forces.mass[i]), 0.0)


def peer_start(case: Case, forces: Forces) -> None:
    """Initial acceleration in equilibrium with the weight, as ssilang takes it."""
    import openseespy.opensees as ops

    for i in case.block.ravel().tolist():
        ops.setNodeAccel(i + 1, 2, float(forces.weight[i] / forces.mass[i]), "-commit")


def run_peer(case: Case, forces: Forces, solver: str) -> tuple[np.ndarray, float]:
    """Displacements at all times and seconds of the loop."""
    import openseespy.opensees as ops

    peer_model(case, forces, solver)
    peer_start(case, forces)
    node = int(case.block[0, -1]) + 1
    values, started = [0.0], time.process_time()
    for _ in range(case.steps // KEPT):
        if ops.analyze(KEPT, DT):
            return np.full(len(values), np.nan), np.inf
        values.append(ops.nodeDisp(node, 1))
    return np.array(values), time.process_time() - started


def compare(unknowns: int) -> None:
    """Print one line."""
    steps = STEPS.get(unknowns, 100)
    case, long = make_case(unknowns, steps), make_case(unknowns, OWN_STEPS)
    inputs, forces = inputs_of(case)
    size = make_problem(inputs).numbering.size
    run_ssilang(case)  # compiles
    own, seconds = run_ssilang(long)
    peers = {s: run_peer(case, forces, s) for s in PEER_SOLVERS}
    best = min(peers, key=lambda s: peers[s][1])
    shared = own[: steps // KEPT + 1]
    difference = np.abs(shared - peers[best][0]).max() / np.abs(shared).max()
    if not difference <= AGREEMENT:
        print(f"{size:7d} unknowns: the answers differ by {difference:.1e}, no ratio")
        return
    peer, mine = [peers[best][1]], [seconds]
    for _ in range(2 if unknowns < 10_000 else 0):
        peer.append(run_peer(case, forces, best)[1])
        mine.append(run_ssilang(long)[1])
    a, b = OWN_STEPS / statistics.median(mine), steps / statistics.median(peer)
    others = ", ".join(f"{s} {steps / t:.2f}" for s, (_, t) in peers.items())
    print(
        f"{size:7d} unknowns: ssilang {a:7.1f} steps/s, OpenSees {best} {b:6.2f} steps/s, "
        f"ratio {a / b:4.0f}; difference {difference:.0e} over {steps} steps   [{others}]",
        flush=True,
    )


def main() -> None:
    """All sizes asked for."""
    for unknowns in [int(a) for a in sys.argv[1:]] or list(STEPS):
        compare(unknowns)


if __name__ == "__main__":
    main()
