"""Several motions on one large model: side by side against one after another.

    OMP_NUM_THREADS=1 python benchmarks/side_by_side.py [unknowns ...]      default 2000 7500 30000

The block on soil of `uplift_openseespy.py` under 1, 4, 8 and 16 scales of its motion, 200 steps, on
one thread. Both ways find their factors made, as in a sweep, and run in turn, three times each; the
medians count. Displacements of the block's top must agree within 1e-11 of the largest at all steps
kept before a ratio is printed.
"""

from __future__ import annotations

import statistics
import sys
import time
from dataclasses import replace

import numpy as np
from uplift_openseespy import Case, Top, inputs_of, make_case

from ssilang.kernel.solvers.backends import keep_factors
from ssilang.kernel.stepping.problem.loading import Loading
from ssilang.kernel.stepping.problem.problem import Problem, make_problem
from ssilang.kernel.stepping.run import History, integrate
from ssilang.kernel.stepping.run_many import integrate_together

STEPS, TURNS, AGREEMENT = 200, 3, 1e-11
COUNTS = (1, 4, 8, 16)


def motions(whole: Problem, count: int) -> list[Problem]:
    """The same model under motions of several scales."""
    given, found = whole.loading, []
    for scale in np.linspace(0.5, 1.2, count):
        x, y = given.curves[-1]
        curves = (*given.curves[:-1], (x, scale * y))
        found.append(replace(whole, loading=Loading(given.forces, given.imposed, curves)))
    return found


def tops(case: Case, problems: list[Problem]) -> list[Top]:
    """Observers of all motions."""
    return [Top(case, len(p.times)) for p in problems]


def one_after_another(case: Case, problems: list[Problem]) -> tuple[np.ndarray, float]:
    """Displacements (count, n) and seconds."""
    seen, started = tops(case, problems), time.process_time()
    for problem, top in zip(problems, seen, strict=True):
        integrate(problem, [top])
    return np.array([top.values for top in seen]), time.process_time() - started


def side_by_side(case: Case, problems: list[Problem]) -> tuple[np.ndarray, float]:
    """As `one_after_another`."""
    seen, started = tops(case, problems), time.process_time()
    for found in integrate_together(problems, [[top] for top in seen]):
        if not isinstance(found, History):
            raise found
    return np.array([top.values for top in seen]), time.process_time() - started


def compare(unknowns: int) -> None:
    """One line for each number of motions."""
    keep_factors(4)
    case = make_case(unknowns, STEPS)
    whole = make_problem(inputs_of(case)[0])
    for count in COUNTS:
        problems = motions(whole, count)
        a, b, theirs, ours = None, None, [], []
        for _ in range(TURNS):
            a, spent = one_after_another(case, problems)
            theirs.append(spent)
            b, spent = side_by_side(case, problems)
            ours.append(spent)
        gap = float(np.abs(a - b).max() / np.abs(a).max())
        if not gap <= AGREEMENT:
            raise SystemExit(f"the two differ by {gap:.1e}: no ratio")
        steps = count * STEPS
        alone, together = statistics.median(theirs) / steps, statistics.median(ours) / steps
        print(
            f"{whole.numbering.size:7d} unknowns, {count:2d} motions: {1e3 * alone:6.3f} ms a step "
            f"of a motion alone, {1e3 * together:6.3f} ms side by side, ratio "
            f"{alone / together:4.2f}, difference {gap:.0e}",
            flush=True,
        )


if __name__ == "__main__":
    for number in sys.argv[1:] or ("2000", "7500", "30000"):
        compare(int(number))
