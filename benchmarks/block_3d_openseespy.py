"""Elastic block on a cube of soil with a no-tension interface, in ssilang and in OpenSeesPy.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas3 and liblapack3)
    OMP_NUM_THREADS=1 python benchmarks/block_3d_openseespy.py [cells [seconds]]    default 30 180

The soil has `cells`^3 bricks, the block a third of them along each side; its lower nodes stand on
the soil's by springs that resist no tension. Weight of the block, a push to its side that rocks it
at once, average acceleration, 5 ms. The peer runs by Newton's method with each of its sparse
solvers, each in a process of its own for at most `seconds`; the fastest a step counts. A ratio is
printed only if all displacements of a corner of the block's top agree within 1e-6 of the largest
one at every step that the peer made. Memory is the largest resident size of the process.
"""

import json
import resource
import subprocess
import sys
import time
from dataclasses import dataclass
from typing import Any

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
NORMAL, SHEAR = 5e7, 2.5e7  # N/m of a pair of nodes
PUSH, FREQUENCY = 20.0, 2.0  # m/s2, Hz; at its largest when it begins
AGREEMENT = 1e-6
OWN_STEPS, PEER_STEPS = 200, 4
PEER_SOLVERS = ("Mumps", "SparseSYM", "UmfPack", "SuperLU")
AXES = ("UX", "UY", "UZ")


@dataclass
class Case:
    """Node numbers of soil and block by place (x, y, z), coordinates of all nodes."""

    table: NodeTable
    soil: np.ndarray
    block: np.ndarray
    steps: int


def grid(table: NodeTable, corner: tuple[float, float, float], n: int) -> np.ndarray:
    """Node numbers (n + 1, n + 1, n + 1) of a new cube of cells."""
    axes = [x + SIZE * np.arange(n + 1) for x in corner]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    return table.add(points).reshape(n + 1, n + 1, n + 1)


def bricks(ids: np.ndarray) -> np.ndarray:
    """Cells (n, 8) of a grid."""
    low, high = slice(None, -1), slice(1, None)
    ring = ((low, low), (high, low), (high, high), (low, high))
    faces = [ids[x, y, z] for z in (low, high) for x, y in ring]
    return np.stack(faces, -1).reshape(-1, 8)


def make_case(cells: int, steps: int) -> Case:
    """Soil of cells^3 bricks, a block of a third of them along each side on its middle."""
    b = max(cells // 3, 1)
    first = (cells - b) // 2
    table = NodeTable()
    soil = grid(table, (0.0, 0.0, 0.0), cells)
    block = grid(table, (first * SIZE, first * SIZE, cells * SIZE), b)
    return Case(table, soil, block, steps)


def interface(case: Case) -> tuple[np.ndarray, np.ndarray]:
    """Facing nodes of soil and block."""
    count = case.block.shape[0]
    first = (case.soil.shape[0] - count) // 2
    under = slice(first, first + count)
    return case.soil[under, under, -1].ravel(), case.block[:, :, 0].ravel()


def zone(case: Case, ids: np.ndarray, data: tuple[float, float, float]) -> tuple[Zone, CellField]:
    """Bricks and their parameters."""
    block = CellBlock.make(case.table, "CUB8", bricks(ids))
    one = np.ones((len(block), 1))
    names = dict(zip(("YOUN", "NU", "RHO"), (v * one for v in data), strict=True))
    field = CellField((CellFieldBlock(block, names, "STRESSES", "CUB8"),))
    law = ("ELASTIQUE", "ISOTROPE")
    return Zone(block, "MECANIQUE", law, "CUB8", Mode.THREE_DIMENSIONAL), field


def joints(case: Case) -> tuple[Model, CellField]:
    """No-tension joints of two points, elastic in shear, along z."""
    block = CellBlock.make(case.table, "SEG2", np.column_stack(interface(case)))
    one = np.ones((len(block), 1))
    names = {"KN": NORMAL * one, "KS": SHEAR * one}
    names |= {"V1X": 0 * one, "V1Y": 0 * one, "V1Z": one}  # the normal
    names |= {"V2X": one, "V2Y": 0 * one, "V2Z": 0 * one}
    field = CellField((CellFieldBlock(block, names, "STRESSES", "JOI1"),))
    law = ("ELASTIQUE", "JOINT_SDM", "CISAILLEMENT_ELASTIQUE")
    made = Zone(block, "MECANIQUE", law, "JOI1", Mode.THREE_DIMENSIONAL)
    return Model((made,)), field


def supports(case: Case) -> Relations:
    """The soil's base is fixed."""
    base = np.repeat(case.soil[:, :, 0].ravel(), 3)
    n = len(base)
    rows = case.table.add(np.zeros((n, 3)))
    sense = np.zeros(n, np.int8)
    return Relations(
        case.table, np.arange(n + 1), base, AXES * (n // 3), np.ones(n), rows, sense
    )  # fmt: skip


def push_at(times: np.ndarray) -> np.ndarray:
    """Push on the block over its mass."""
    return PUSH * np.cos(2 * np.pi * FREQUENCY * times)


@dataclass
class Forces:
    """Nodal masses (n_nodes,) and weights of the block's nodes (n_nodes,)."""

    mass: np.ndarray
    weight: np.ndarray


def inputs_of(case: Case) -> tuple[Inputs, Forces]:
    """The problem for ssilang, and what the peer needs of it."""
    zones = [zone(case, case.soil, SOIL), zone(case, case.block, BLOCK)]
    K = Matrix(case.table, tuple(families.stiffness(*z) for z in zones), (supports(case),))
    M = Matrix(case.table, tuple(families.mass(*z, True) for z in zones), kind="MASSE")
    numbering = numbering_of(K, M)
    diagonal = assemble(M, numbering).diagonal()
    along_x, along_z = numbering.where("UX"), numbering.where("UZ")
    push, weight = np.zeros(numbering.size), np.zeros(numbering.size)
    pushed = along_x[np.isin(numbering.nodes[along_x], case.block)]
    push[pushed] = diagonal[pushed]
    heavy = along_z[np.isin(numbering.nodes[along_z], case.block)]
    weight[heavy] = -GRAVITY * diagonal[heavy]
    times = DT * np.arange(case.steps + 1)
    load = Load(
        (
            LoadPart("MECA", vector_to_field(weight, numbering, dual=True)),
            LoadPart(
                "MECA",
                vector_to_field(push, numbering, dual=True),
                Curve((CurvePart(times, push_at(times)),)),
            ),
        )
    )
    model, field = joints(case)
    n = len(case.table)
    mass, pull = np.zeros(n), np.zeros(n)
    mass[numbering.nodes[along_x]] = diagonal[along_x]
    pull[numbering.nodes[along_z]] = weight[along_z]
    inputs = Inputs(K, times, M, None, load, model=model, characteristics=field)
    return inputs, Forces(mass, pull)


class Top:
    """Keeps the displacements of a corner of the block's top and the number of open pairs."""

    def __init__(self, case: Case) -> None:
        self.wanted = np.ones(case.steps + 1, bool)
        self.node = int(case.block[0, 0, -1])
        self.values: list[list[float]] = []
        self.open: list[int] = []

    def receive(self, snapshot: Snapshot) -> None:
        """One more instant."""
        places = [snapshot.problem.numbering.index_of(self.node, name) for name in AXES]
        self.values.append([float(snapshot.u[i]) for i in places])
        self.open.append(int((snapshot.w[:, -1] > 0.0).sum()))

    def close(self) -> None:
        """Nothing to close."""


def peak_memory() -> float:
    """Largest resident size of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def run_ssilang(cells: int, steps: int) -> dict[str, Any]:
    """Displacements, seconds of all and of the steps beyond the first ones, memory."""
    integrate(make_problem(inputs_of(make_case(12, 2))[0]), [])  # compiles
    case = make_case(cells, steps)
    started = time.perf_counter()
    problem = make_problem(inputs_of(case)[0])
    made = time.perf_counter() - started
    top = Top(case)
    started = time.perf_counter()
    history = integrate(problem, [top])
    return {
        "values": top.values, "open": top.open, "pairs": case.block.shape[0] ** 2,
        "unknowns": problem.numbering.size, "made": made,
        "seconds": time.perf_counter() - started, "memory": peak_memory(),
        "solver": history.solver,
    }  # fmt: skip


def peer_model(case: Case, forces: Forces, solver: str, strength: float = 1.0) -> None:
    """The same model in OpenSees, ready to analyse; the push is `strength` times as strong."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 3)
    used = np.union1d(case.soil, case.block)
    for i in used.tolist():
        ops.node(i + 1, *(float(x) for x in case.table.coordinates[i]))
        ops.mass(i + 1, *[float(forces.mass[i])] * 3)
    fixed = set(case.soil[:, :, 0].ravel().tolist())
    for i in fixed:
        ops.fix(i + 1, 1, 1, 1)
    number = 0
    for tag, (ids, (young, nu, _)) in enumerate(((case.soil, SOIL), (case.block, BLOCK)), 1):
        ops.nDMaterial("ElasticIsotropic", tag, young, nu)
        for cell in (bricks(ids) + 1).tolist():
            number += 1
            ops.element("stdBrick", number, *cell, tag)
    ops.uniaxialMaterial("ENT", 11, NORMAL)
    ops.uniaxialMaterial("Elastic", 12, SHEAR)
    for low, up in np.column_stack(interface(case)).tolist():
        number += 1
        ops.element("zeroLength", number, low + 1, up + 1, "-mat", 11, 12, 12, "-dir", 3, 1, 2)
    times = DT * np.arange(case.steps + 2)  # beyond its last value a path gives nothing
    ops.timeSeries("Constant", 1)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *(strength * push_at(times)).tolist())
    ops.pattern("Plain", 1, 1)
    for i in case.block.ravel().tolist():
        ops.load(i + 1, 0.0, 0.0, float(forces.weight[i]))
    ops.pattern("Plain", 2, 2)
    for i in case.block.ravel().tolist():
        ops.load(i + 1, float(forces.mass[i]), 0.0, 0.0)
    peer_start(case, forces, strength)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(solver)
    ops.test("NormUnbalance", 1e-3, 30)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def peer_start(case: Case, forces: Forces, strength: float) -> None:
    """Initial acceleration in equilibrium with the loads, as ssilang takes it."""
    import openseespy.opensees as ops

    for i in case.block.ravel().tolist():
        ops.setNodeAccel(i + 1, 1, strength * PUSH, "-commit")
        ops.setNodeAccel(i + 1, 3, float(forces.weight[i] / forces.mass[i]), "-commit")


def run_peer(cells: int, steps: int, solver: str) -> None:
    """Print displacements, seconds of each step and memory after every step."""
    import openseespy.opensees as ops

    case = make_case(cells, steps)
    peer_model(case, inputs_of(case)[1], solver)
    node = int(case.block[0, 0, -1]) + 1
    found: dict[str, Any] = {"values": [[0.0] * 3], "seconds": [], "turns": 0}
    for _ in range(steps):
        started = time.perf_counter()
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees did not converge")
        found["seconds"].append(time.perf_counter() - started)
        found["turns"] += ops.testIter()
        found["values"].append([ops.nodeDisp(node, i) for i in (1, 2, 3)])
        print(json.dumps(found | {"memory": peak_memory()}), flush=True)


def apart(limit: float, *words: object) -> dict[str, Any] | None:
    """What a run in a process of its own said last within the limit; None if nothing."""
    command = [sys.executable, __file__, *map(str, words)]
    try:
        done = subprocess.run(command, capture_output=True, timeout=limit)
        said = done.stdout
        if done.returncode:
            print(done.stderr.decode()[-300:], file=sys.stderr)
    except subprocess.TimeoutExpired as late:
        said = late.stdout or b""
    lines = [line for line in said.decode().splitlines() if line.startswith('{"values"')]
    return json.loads(lines[-1]) if lines else None


def best_peer(cells: int, limit: float) -> tuple[str, dict[str, Any]]:
    """The fastest solver of the peer and what it found."""
    found: dict[str, dict[str, Any]] = {}
    for solver in PEER_SOLVERS:
        ran = apart(limit, "--peer", cells, PEER_STEPS, solver)
        if ran is None:
            print(f"OpenSees {solver:10s} made no step (at most {limit:.0f} s)", flush=True)
            continue
        found[solver] = ran
        print(
            f"OpenSees {solver:10s} {np.median(ran['seconds']):7.2f} s a step "
            f"({ran['turns']} factorisations in {len(ran['seconds'])} steps), "
            f"{ran['memory']:.0f} MB",
            flush=True,
        )
    if not found:
        raise SystemExit("the peer has no answer: no ratio")
    best = min(found, key=lambda name: float(np.median(found[name]["seconds"])))
    return best, found[best]


def compare(cells: int, limit: float) -> None:
    """Compare the answers, then the speeds."""
    own = apart(3600, "--own", cells, OWN_STEPS)
    if own is None:
        raise SystemExit("ssilang failed")
    few = apart(3600, "--own", cells, PEER_STEPS)
    assert few is not None
    solver, peer = best_peer(cells, limit)
    exact = np.array(peer["values"])
    gap = np.abs(np.array(own["values"])[: len(exact)] - exact).max() / np.abs(exact).max()
    steps = len(exact) - 1
    print(
        f"{own['unknowns']} unknowns; after {steps} steps {own['open'][steps]} of "
        f"{own['pairs']} pairs are open; answers differ by {gap:.0e}"
    )
    if not gap <= AGREEMENT:
        raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
    step = (own["seconds"] - few["seconds"]) / (OWN_STEPS - PEER_STEPS)
    theirs = float(np.median(peer["seconds"]))
    print(
        f"ssilang    {step:8.3f} s a step, {few['seconds'] - PEER_STEPS * step:.1f} s once "
        f"({own['solver']}), {own['memory']:.0f} MB"
    )
    print(f"OpenSees   {theirs:8.3f} s a step ({solver}), {peer['memory']:.0f} MB")
    whole = OWN_STEPS * theirs / own["seconds"]
    print(f"ratio      {theirs / step:8.0f} a step, {whole:.0f} over {OWN_STEPS} steps in all")


def main() -> None:
    """The comparison, or one of its runs."""
    words = sys.argv[1:]
    if words[:1] == ["--own"]:
        print(json.dumps(run_ssilang(int(words[1]), int(words[2]))))
    elif words[:1] == ["--peer"]:
        run_peer(int(words[1]), int(words[2]), words[3])
    else:
        compare(int(words[0]) if words else 30, float(words[1]) if len(words) > 1 else 180.0)


if __name__ == "__main__":
    main()
