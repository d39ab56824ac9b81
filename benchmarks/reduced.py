"""Reduced models against the whole one on the block on soil, at several tolerances.

    python benchmarks/reduced.py [steps]                                     default 4000

The block of `uplift_openseespy.py` at 7 524 unknowns, joints with friction, Rayleigh damping, a
motion of 2 Hz. Displacements of all unknowns and jumps of all joints, at one step in ten, must
agree with the whole model's within the tolerance before a speed is printed. `first` is the
first motion on the model, basis included; `next` another motion on the same model, whose basis is
kept, estimate of the error included; `march` the reduced steps alone.
"""

import sys
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

sys.path.insert(0, __file__.rsplit("/", 1)[0])

from uplift_openseespy import (
    BLOCK,
    DT,
    GRAVITY,
    SOIL,
    Case,
    interface,
    make_case,
    pulse,
    quads,
    supports,
    zone,
)

from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.stepping.problem.problem import Inputs, Problem, make_problem
from ssilang.kernel.stepping.rests.reduced.run import _pair_of, integrate_reduced
from ssilang.kernel.stepping.rests.reduced.trace import Trace, comparing
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.snapshot import Snapshot
from ssilang.kernel.stepping.times import every

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
ALPHA, BETA = 0.3, 1e-3  # of Rayleigh's damping, 1/s and s
FRICTION = {"KN": 2e8, "KS": 1e8, "FROT": 0.6}
EVERY = 10


def joints(case: Case) -> tuple[Model, CellField]:
    """Joints of two lines, with friction."""
    low, up = interface(case)
    cells = np.column_stack([up[:-1], up[1:], low[:-1], low[1:]])
    block = CellBlock.make(case.table, "RAC2", cells)
    one = np.ones((len(block), 1))
    values = {k: v * one for k, v in FRICTION.items()}
    field = CellField((CellFieldBlock(block, values, "STRESSES", "JOI2"),))
    law = ("ELASTIQUE", "JOINT_SDM")
    return Model((Zone(block, "MECANIQUE", law, "JOI2", Mode.PLANE_STRAIN),)), field


def problem_of(steps: int) -> Problem:
    """The block on soil, 7 524 unknowns."""
    case = make_case(7500, steps)
    parts = [zone(case, quads(case.soil), SOIL), zone(case, quads(case.block), BLOCK)]
    stiffness = tuple(families.stiffness(*p) for p in parts)
    mass = tuple(families.mass(*p) for p in parts)
    K, M = Matrix(case.table, stiffness, (supports(case),)), Matrix(case.table, mass, kind="MASSE")
    C = Matrix(case.table, M.scaled(ALPHA).blocks + K.scaled(BETA).blocks)
    numbering = numbering_of(K, M)
    assembled, forces = assemble(M, numbering), []
    for name, value in (("UY", -GRAVITY), ("UX", -0.5)):
        motion = np.zeros(numbering.size)
        motion[numbering.where(name)] = value
        forces.append(vector_to_field(assembled @ motion, numbering, dual=True))
    times = DT * np.arange(steps + 1)
    curve = Curve((CurvePart(times, pulse(times)),))
    load = Load((LoadPart("MECA", forces[0]), LoadPart("MECA", forces[1], curve)))
    model, field = joints(case)
    return make_problem(Inputs(K, times, M, C, load, model=model, characteristics=field))


class Keep:
    """Jumps and displacements at one step in `EVERY`."""

    def __init__(self, times: np.ndarray) -> None:
        self.wanted = every(times, EVERY)
        self.u: list[np.ndarray] = []
        self.w: list[np.ndarray] = []

    def receive(self, snapshot: Snapshot) -> None:
        """One more instant."""
        self.w.append(snapshot.w.copy())
        self.u.append(snapshot.u.copy())

    def close(self) -> None:
        """Nothing to close."""


def error(found: list[np.ndarray], exact: list[np.ndarray]) -> float:
    """Largest difference over the largest value."""
    a, b = np.array(found), np.array(exact)
    return float(np.abs(a - b).max() / np.abs(b).max())


def another(problem: Problem) -> Problem:
    """The same model under a weaker motion."""
    (x0, y0), (x1, y1) = problem.loading.curves
    return replace(problem, loading=replace(problem.loading, curves=((x0, y0), (x1, 0.9 * y1))))


def seconds(run: Callable[..., object], *given: object) -> float:
    """Wall time of a call."""
    started = time.perf_counter()
    run(*given)
    return time.perf_counter() - started


def march(problem: Problem, tolerance: float) -> None:
    """The steps of the reduced model alone."""
    trace = Trace(problem, _pair_of(problem, tolerance).rich, np.zeros(len(problem.times), bool))
    for run in comparing(problem.times):
        trace.advance(run)


def main() -> None:
    """A line for the whole model, one for each tolerance."""
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else 4000
    problem = problem_of(steps)
    short = replace(problem, times=problem.times[:20])
    integrate(short)  # compiles
    integrate_reduced(short, 0.5)
    exact = Keep(problem.times)
    integrate(problem, [exact])
    whole = seconds(integrate, problem)
    print(f"{problem.numbering.size} unknowns, {steps} steps: whole {steps / whole:.0f} steps/s")
    for tolerance in TOLERANCES:
        found, first = Keep(problem.times), seconds(integrate_reduced, problem, tolerance)
        history = integrate_reduced(problem, tolerance, [found])
        made = history.reduction
        assert made is not None
        true = max(error(found.u, exact.u), error(found.w, exact.w))
        if made.vectors == 0 or not true <= tolerance:
            print(f"{tolerance:.0e}: {made.refused or f'error {true:.1e}'}, no speed")
            continue
        more = seconds(integrate_reduced, another(problem), tolerance)
        alone = seconds(march, problem, tolerance)
        print(
            f"{tolerance:.0e}: {made.vectors} vectors, estimate {made.estimate:.1e}, error "
            f"{true:.1e}; first {steps / first:.0f}, next {steps / more:.0f}, march "
            f"{steps / alone:.0f} steps/s; ratio {whole / more:.1f} to the whole model",
            flush=True,
        )


if __name__ == "__main__":
    main()
