"""What a step of the large loop costs beside its bound, the reading of the factor.

    OMP_NUM_THREADS=1 python benchmarks/step_profile.py [unknowns ...]

For the block on soil of `uplift_openseespy.py`: the best time of a step, that of a forward and
backward solve alone, the factor's size, and the time in which this processor core reads as many
bytes from memory of that size (a sum over an array).
"""

import sys
import time
from collections.abc import Callable

import numpy as np
from uplift_openseespy import DT, inputs_of, make_case

from ssilang.kernel.base.compiled.compiler import compiled_fast
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.stepping.effective import effective_matrix, effective_of
from ssilang.kernel.stepping.problem.problem import make_problem
from ssilang.kernel.stepping.rests.sparse.interleaved import InterleavedLoop
from ssilang.kernel.stepping.run import Integration
from ssilang.kernel.stepping.state import recorder_of

STEPS = 64


@compiled_fast
def total(x: np.ndarray) -> float:
    """Sum of the values: one reading."""
    found = 0.0
    for i in range(len(x)):
        found += x[i]
    return found


def best(function: Callable[[], object], repetitions: int) -> float:
    """Shortest of several durations, ms."""
    found = np.inf
    for _ in range(repetitions):
        started = time.perf_counter()
        function()
        found = min(found, time.perf_counter() - started)
    return 1e3 * found


def profile(unknowns: int) -> None:
    """Print one line."""
    problem = make_problem(inputs_of(make_case(unknowns, STEPS))[0])
    started = time.perf_counter()
    effective = effective_of(problem, effective_matrix(problem, DT), DT, 1.0)
    seconds = time.perf_counter() - started
    loop = InterleavedLoop(problem, Integration(problem).motion, effective)
    factor = effective.inverse.factor
    assert isinstance(factor, DissectedFactor)
    values, b = factor.panels.values, np.ones(len(factor.tree.order))
    factors = problem.loading.at(problem.times)
    recorder = recorder_of(loop.motion, np.full(STEPS, -1), np.zeros((STEPS, 6)))
    turns = max(3, 100_000 // unknowns)
    step = best(lambda: loop.run(factors, recorder), turns) / STEPS
    pair = best(lambda: factor.solve(b), 20 * turns)
    reading = best(lambda: total(values), 20)
    print(
        f"{problem.numbering.size:7d} unknowns: factorised in {seconds:6.3f} s, factor "
        f"{values.nbytes / 1e6:6.1f} MB, read in {reading:6.3f} ms; solve {pair:6.3f} ms, "
        f"step {step:6.3f} ms",
        flush=True,
    )


if __name__ == "__main__":
    profile(500)  # compiles
    for size in [int(a) for a in sys.argv[1:]] or [2000, 7500, 30000, 116000]:
        profile(size)
