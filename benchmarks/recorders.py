"""What histories cost: loops alone against loops that record ten points and largest values.

    OMP_NUM_THREADS=1 python benchmarks/recorders.py [turns]                      default 9

Displacement, velocity, acceleration of ten points (of the one that moves, for one unknown) and all
joints at every step; the largest displacements, reactions, openings and joint forces over all
steps. The ways run in turn, by processor time; printed are the median time of a step of the loop
alone and the median of each way's ratio to it in the same turn. Before each way, memory that others
let go is given back to the system, so that rows lie in memory that nobody has touched, as in the
first calculation of a script; but "again" takes what the way before it let go. "as DYNAMIC": beside
largest values that nobody asked for. Loops that give the largest values only when asked are marked:
there, nobody pays who does not ask, and reading them later steps again.
"""

import ctypes
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from uplift_openseespy import inputs_of, make_case

from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.track import Track

POINTS, STIFFNESS, MASS, RELEASE = 10, 1.2e7, 3000.0, 0.01
AGAIN = "again"


def oscillator(steps: int, joint: bool) -> Problem:
    """A mass on a spring, released beside a joint that only pushes."""
    table = NodeTable()
    ground, top = table.add(np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])).tolist()

    def block(value: float, kind: str) -> ElementMatrices:
        values = np.array([[[value]]])
        return ElementMatrices(
            table, np.array([[top]]), np.zeros(1, int), ("UX",), ("FX",), values, kind
        )

    held, names = np.array([ground, ground, top]), ("UX", "UY", "UY")
    rows = table.add(np.zeros((3, 3)))
    fixed = Relations(table, np.arange(4), held, names, np.ones(3), rows, np.zeros(3, np.int8))
    model = field = None
    if joint:
        cells = CellBlock.make(table, "SEG2", np.array([[ground, top]]))
        law = ("ELASTIQUE", "JOINT_SDM")
        model = Model((Zone(cells, "MECANIQUE", law, "JOI1", Mode.PLANE_STRAIN),))
        values = {"KN": np.full((1, 1), 7e6), "KS": np.zeros((1, 1))}
        field = CellField((CellFieldBlock(cells, values, "STRESSES", "JOI1"),))
    start = NodeField.of(table, np.array([top]), {"UX": np.array([RELEASE])})
    K = Matrix(table, (block(STIFFNESS, "RIGIDITE"),), (fixed,))
    M = Matrix(table, (block(MASS, "MASSE"),), kind="MASSE")
    times = 2.5e-4 * np.arange(steps + 1)
    return make_problem(Inputs(K, times, M, displacement=start, model=model, characteristics=field))


def block_on_soil(unknowns: int, steps: int, scheme: Scheme | None = None) -> Problem:
    """The model of `uplift_openseespy.py`."""
    problem = make_problem(inputs_of(make_case(unknowns, steps))[0])
    return problem if scheme is None else replace(problem, scheme=scheme)


def tracked(problem: Problem) -> Track:
    """Ten points at every step, spread over what moves."""
    numbering = problem.numbering
    moving = np.setdiff1d(numbering.nodes, numbering.nodes[problem.constraints.C.indices])
    if not len(moving):
        moving = numbering.nodes[np.diff(problem.constraints.T.indptr) > 0]
    chosen = moving[np.unique(np.linspace(0, len(moving) - 1, POINTS).astype(int))]
    unknowns = np.flatnonzero(np.isin(numbering.nodes, chosen))
    return Track(np.ones(len(problem.times), bool), unknowns)


def give_back() -> None:
    """Free memory to the system, where the C library can."""
    if sys.platform == "linux":
        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
        if trim is not None:
            trim(0)


def compare(name: str, problem: Problem, turns: int) -> None:
    """Print one line."""
    probe = Extremes(problem=problem, asked=False)
    history = integrate(problem, [probe])
    ways: dict[str, Callable[[], object]] = {
        "alone": lambda: integrate(problem),
        "points": lambda: integrate(problem, [tracked(problem)]),
        AGAIN: lambda: integrate(problem, [tracked(problem)]),
        "table": lambda: integrate(
            problem, [tracked(problem), Extremes(problem=problem, asked=False)]
        ),
        "largest": lambda: integrate(problem, [Extremes(problem=problem)]),
        "both": lambda: integrate(problem, [tracked(problem), Extremes(problem=problem)]),
    }
    seconds: dict[str, list[float]] = {way: [] for way in ways}
    for turn in range(turns + 1):
        for way, run in ways.items():
            if way != AGAIN:
                give_back()
            started = time.process_time()
            run()
            if turn:  # the first one compiles
                seconds[way].append(time.process_time() - started)
    step = statistics.median(seconds["alone"]) / (len(problem.times) - 1)
    ratios = {
        way: statistics.median(a / b for a, b in zip(found, seconds["alone"], strict=True))
        for way, found in seconds.items()
    }
    said = "" if probe.known else " (only if asked)"
    print(
        f"{name:34s} {problem.numbering.size:5d} unknowns, {history.loop:10s} "
        f"{1e6 * step:9.3f} us a step; ten points {100 * (ratios['points'] - 1):+6.1f} %, "
        f"again {100 * (ratios[AGAIN] - 1):+6.1f} %, "
        f"as DYNAMIC {100 * (ratios['table'] - 1):+6.1f} %, "
        f"largest values {100 * (ratios['largest'] - 1):+6.1f} %{said}, "
        f"both {100 * (ratios['both'] - 1):+6.1f} %",
        flush=True,
    )


def main(turns: int = 9) -> None:
    """All loops."""
    compare("one unknown", oscillator(1_000_000, False), turns)
    compare("one unknown and a joint", oscillator(1_000_000, True), turns)
    compare("small block, on modes", block_on_soil(100, 5000), turns)
    conserving = Scheme(conserving=True)
    compare("small block, conserving", block_on_soil(100, 500, conserving), turns)
    compare("block", block_on_soil(2000, 2000), turns)
    compare("block", block_on_soil(7500, 600), turns)


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]))
