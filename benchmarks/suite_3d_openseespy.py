"""Ten motions of a block on a cube of soil, 6 966 unknowns: reduced, whole, and in OpenSeesPy.

    pip install '.[bench]'          (OpenSeesPy needs the system's libblas3 and liblapack3)
    OMP_NUM_THREADS=1 python benchmarks/suite_3d_openseespy.py [motions [steps [of the peer]]]

The model of `block_3d_openseespy.py` on 12^3 bricks with Rayleigh damping, under pushes of growing
strength; by default 10 motions of 1 000 steps, of which the peer makes 5 steps of the first and
last motion. Kept of a motion are the displacements of a corner of the block's top at all steps. The
step's factor is kept from motion to motion, as `ssilang sweep` does. Each side is a process of its
own, from its start to the last answer, as a user waits for it: imports, model, factor or basis, all
motions. The peer's time for the suite is its time before the first step, for each motion, and its
seconds a step times all steps. All run on one thread; seconds are those of the processor, which
other work on the machine changes less, and by the clock for the whole suites.

Ratios are printed only if the displacements of a corner of the block's top agree with the peer's
within 1e-6 of the largest one (whole), and the reduced motions with the whole ones within the
tolerance.
"""

import json
import resource
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from block_3d_openseespy import (
    AGREEMENT,
    AXES,
    DT,
    PEER_SOLVERS,
    Case,
    inputs_of,
    make_case,
    peer_model,
)

from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.solvers.backends import keep_factors
from ssilang.kernel.stepping.problem.problem import Problem, make_problem
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.track import Track

CELLS, ALPHA, BETA = 12, 0.3, 1e-3  # bricks a side; Rayleigh's damping, 1/s and s
TOLERANCE = 1e-2


def strength(number: int, count: int) -> float:
    """Strength of the push of a motion, 0.4 to 1."""
    return 0.4 + 0.6 * number / max(count - 1, 1)


def corner(case: Case) -> int:
    """The node of a corner of the block's top."""
    return int(case.block[0, 0, -1])


def problem_of(steps: int) -> tuple[Problem, np.ndarray]:
    """The damped model under a push of strength 1, and the unknowns of its corner."""
    case = make_case(CELLS, steps)
    inputs = inputs_of(case)[0]
    K, M = inputs.stiffness, inputs.mass
    assert M is not None
    C = Matrix(case.table, M.scaled(ALPHA).blocks + K.scaled(BETA).blocks)
    problem = make_problem(replace(inputs, damping=C))
    return problem, np.array([problem.numbering.index_of(corner(case), name) for name in AXES])


def motion(problem: Problem, factor: float) -> Problem:
    """The same model under another strength."""
    (x0, y0), (x1, y1) = problem.loading.curves
    curves = ((x0, y0), (x1, factor * y1))
    return replace(problem, loading=replace(problem.loading, curves=curves))


def own(way: str, count: int, steps: int) -> dict[str, Any]:
    """All motions here, `reduced` or `whole`."""
    from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced

    keep_factors(1)
    problem, at = problem_of(steps)
    values, seconds, said = [], [], []
    for i in range(count):
        started = time.process_time()
        track = Track(np.ones(steps + 1, bool), np.sort(at))
        of_motion = motion(problem, strength(i, count))
        if way == "reduced":
            made = integrate_reduced(of_motion, TOLERANCE, [track]).reduction
            assert made is not None
            said.append([made.vectors, made.estimate, str(made.refused or "")])
        else:
            integrate(of_motion, [track])
        values.append(track.values("u", at).tolist())
        seconds.append(time.process_time() - started)
    return {"values": values, "seconds": seconds, "said": said, "unknowns": problem.numbering.size}


def peer(solver: str, factor: float, steps: int) -> dict[str, Any]:
    """The first steps of one motion in OpenSeesPy."""
    import openseespy.opensees as ops

    case = make_case(CELLS, steps)
    peer_model(case, inputs_of(case)[1], solver, factor)
    ops.rayleigh(ALPHA, 0.0, BETA, 0.0)
    node = corner(case) + 1
    values, seconds = [[0.0] * 3], []
    for _ in range(steps):
        started = time.process_time()
        if ops.analyze(1, DT):
            raise SystemExit("OpenSees did not converge")
        seconds.append(time.process_time() - started)
        values.append([ops.nodeDisp(node, i) for i in (1, 2, 3)])
    return {"values": values, "seconds": seconds}


@dataclass
class Spent:
    """Seconds of the processor and by the clock."""

    processor: float
    clock: float


def apart(*words: object) -> tuple[dict[str, Any], Spent]:
    """What a process of its own says, and what it took from its start to its end."""
    children, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([sys.executable, __file__, *map(str, words)], capture_output=True)
    clock, after = time.perf_counter() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(done.stderr.decode()[-500:])
    used = after.ru_utime + after.ru_stime - children.ru_utime - children.ru_stime
    return json.loads(done.stdout.decode().splitlines()[-1]), Spent(used, clock)


def distance(found: list[Any], exact: list[Any]) -> float:
    """Largest difference over the largest value."""
    a, b = np.array(found), np.array(exact)
    return float(np.abs(a - b).max() / np.abs(b).max())


def fastest() -> str:
    """The peer's solver with the shortest step."""
    took = {}
    for solver in PEER_SOLVERS:
        found, _ = apart("--peer", solver, 1.0, 2)
        took[solver] = float(np.median(found["seconds"]))
        print(f"OpenSees {solver:10s} {took[solver]:.2f} s a step", flush=True)
    return min(took, key=lambda name: took[name])


def said(name: str, took: Spent, found: dict[str, Any], theirs: float) -> None:
    """A line for a suite made here."""
    first, others = found["seconds"][0], np.median(found["seconds"][1:])
    print(
        f"{name:8s} {took.processor:6.1f} s, {took.clock:.0f} by the clock (first motion "
        f"{first:.1f}, further ones {others:.2f}): {theirs / took.processor:.0f} times OpenSees",
        flush=True,
    )


def main(count: int, steps: int, of_peer: int) -> None:
    """Compare the answers, then the times."""
    apart("--own", "whole", 1, 2)  # compiles
    whole, waited = apart("--own", "whole", count, steps)
    solver, gap, once, each = fastest(), 0.0, [], []
    for i in (0, count - 1):
        found, spent = apart("--peer", solver, strength(i, count), of_peer)
        once.append(spent.processor - sum(found["seconds"]))
        each.append(float(np.mean(found["seconds"])))
        gap = max(gap, distance(whole["values"][i][: of_peer + 1], found["values"]))
    theirs = count * (float(np.mean(once)) + steps * float(np.mean(each)))
    print(
        f"{whole['unknowns']} unknowns, {count} motions of {steps} steps; answers differ by "
        f"{gap:.1e}\n"
        f"OpenSees {solver}: {np.mean(each):.3f} s a step of {2 * of_peer}, {theirs:.0f} s for the "
        "suite if all its steps take as long"
    )
    if not gap <= AGREEMENT:
        raise SystemExit(f"the two do not agree within {AGREEMENT:.0e}: no ratio")
    said("whole", waited, whole, theirs)
    apart("--own", "reduced", 1, 20)
    reduced, waited = apart("--own", "reduced", count, steps)
    between = max(distance(a, b) for a, b in zip(reduced["values"], whole["values"], strict=True))
    vectors, estimate, refused = reduced["said"][-1]
    print(refused or f"{vectors} vectors, error {between:.1e}, estimated {estimate:.1e}")
    if not between <= TOLERANCE:
        raise SystemExit(f"reduced motions are not within {TOLERANCE:.0e}: no ratio")
    said("reduced", waited, reduced, theirs)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--own"]:
        print(json.dumps(own(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))))
    elif sys.argv[1:2] == ["--peer"]:
        print(json.dumps(peer(sys.argv[2], float(sys.argv[3]), int(sys.argv[4]))))
    else:
        given = [int(a) for a in sys.argv[1:4]]
        main(*(given + [10, 1000, 5][len(given) :]))
