"""Growth from 10^5 to 10^6 unknowns: a block on a cube of soil, at rest, then pushed to lift off.

    python benchmarks/million.py [cells of a side ...] [-- steps]       default 30 40 52 66, 100
    python benchmarks/million.py --direct 30        the same by the own factor, and the difference

The soil has `cells`^3 bricks, the block under half of them along each side (66: 1 000 600 unknowns,
1 024 joint points without tension). First RESO's solve: weight and a push, joints closed, from the
matrix's blocks to displacements and reactions. Then steps of 5 ms by average acceleration from the
state at rest under the weight. Each size runs in a process of its own. Printed by the clock and of
the processor (all threads): the static solve, what is done once for the steps, a step (median) with
the turns of conjugate gradients; the largest resident size after each; open points; the error of
the balance of energies over the work of the loads. OMP_NUM_THREADS says how many threads.
"""

import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass, field, replace
from typing import Any

import block_3d_openseespy as solid
import numpy as np

from ssilang.kernel.elements import families
from ssilang.kernel.fields.node_algebra import added
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers.backends import DISSECTION, MULTIGRID
from ssilang.kernel.solvers.factor import Solver
from ssilang.kernel.statics.linear import SolveOptions, linear_system, solve
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.rests.sparse.iterated import IteratedSolver
from ssilang.kernel.stepping.run import integrate

CELLS, STEPS = (30, 40, 52, 66), 100
SMALL, FEW = 8, 14  # cells of the models that compile
COLUMNS = (
    "unknowns", "points", "loop", "static, s", "MB", "once, s", "a step, s", "turns",
    "all steps, s", "MB", "open", "balance",
)  # fmt: skip
SHARE = 0.47  # side of the block over that of the soil


@dataclass
class Spent:
    """Seconds by the clock and of the processor since it was made, or last asked."""

    clock: float = field(default_factory=time.perf_counter)
    processor: float = field(default_factory=time.process_time)

    def since(self) -> tuple[float, float]:
        """Seconds since the last time."""
        now = time.perf_counter(), time.process_time()
        found = now[0] - self.clock, now[1] - self.processor
        self.clock, self.processor = now
        return found


def make_case(cells: int, steps: int) -> solid.Case:
    """Soil of cells^3 bricks, a block of `SHARE` of them along each side on its middle."""
    b = int(SHARE * cells)
    first, table = (cells - b) // 2, NodeTable()
    soil = solid.grid(table, (0.0, 0.0, 0.0), cells)
    at = first * solid.SIZE
    return solid.Case(table, soil, solid.grid(table, (at, at, cells * solid.SIZE), b), steps)


def at_rest(inputs: Inputs, solver: Solver) -> tuple[NodeField, NodeField, str]:
    """Displacements under weight and push, under the weight alone, and the solver."""
    joints, data = inputs.model.zones[0], inputs.characteristics
    matrix = replace(
        inputs.stiffness, cache={},
        blocks=(*inputs.stiffness.blocks, families.stiffness(joints, data)),
    )  # fmt: skip
    weight, push = (part.space for part in inputs.load.parts)
    options = SolveOptions(solver=solver)
    pushed, still = solve(matrix, [added(weight, push, solid.PUSH), weight], options)
    return pushed, still, linear_system(matrix, options).inverse.factor.name


def run(cells: int, steps: int, name: str | None) -> dict[str, Any]:
    """One size."""
    case, spent, solver = make_case(cells, steps), Spent(), Solver(name)
    inputs, _ = solid.inputs_of(case)
    row: dict[str, Any] = {"cells": cells, "points": case.block.shape[0] ** 2}
    row["made"] = spent.since()
    pushed, still, row["solver"] = at_rest(inputs, solver)
    row["static"], row["static_memory"] = spent.since(), solid.peak_memory()
    problem = make_problem(replace(inputs, displacement=still, solver=solver))
    del inputs
    row["unknowns"], row["assembly"] = problem.numbering.size, spent.since()
    turns, times, top = [], [], solid.Top(case)
    original = IteratedSolver.solve

    def watched(self: IteratedSolver, *given: Any) -> Any:
        before = self.turns
        if not times:
            row["once"] = spent.since()
        found = original(self, *given)
        turns.append(self.turns - before)
        times.append(spent.since())
        return found

    IteratedSolver.solve = watched  # type: ignore[method-assign]
    start = Spent()
    history = integrate(problem, [top])
    row["steps"] = start.since()
    row["loop"], row["memory"] = history.loop, solid.peak_memory()
    row["step"] = [float(x) for x in np.median(np.array(times), axis=0)] if times else None
    row["turns"] = [int(np.median(turns)), max(turns)] if turns else None
    kinetic, elastic, stored, lost, damped, external = history.energies.T
    balance = kinetic + elastic + stored + lost + damped - external
    row["balance"] = float(np.abs(balance - balance[0]).max() / np.abs(external).max())
    row["open"] = [int(max(top.open)), top.open[-1]]
    row["values"] = top.values
    row["at_rest"] = [float(still.values_at("UZ", np.array([top.node]))[0]),
                      float(pushed.values_at("UX", np.array([top.node]))[0])]  # fmt: skip
    return row


def apart(cells: int, steps: int, name: str | None) -> dict[str, Any]:
    """A row, measured in a process of its own."""
    command = [sys.executable, __file__, "--one", str(cells), str(steps), name or "-"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr[-2000:])
    return dict(json.loads(done.stdout.splitlines()[-1]))


def told(pair: Any) -> str:
    """'12.3 (20.1)': by the clock, of the processor."""
    return "" if pair is None else f"{pair[0]:.3g} ({pair[1]:.3g})"


def line(row: dict[str, Any]) -> str:
    """A row of the table."""
    turns = "" if row["turns"] is None else f"{row['turns'][0]}, at most {row['turns'][1]}"
    cells = [
        f"{row['unknowns']:,}".replace(",", " "), row["points"], row["loop"], told(row["static"]),
        f"{row['static_memory']:.0f}", told(row.get("once")), told(row["step"]), turns,
        told(row["steps"]), f"{row['memory']:.0f}", f"{row['open'][0]}", f"{row['balance']:.0e}",
    ]  # fmt: skip
    return "| " + " | ".join(str(c) for c in cells) + " |"


def main() -> None:
    """The table, or one of its rows."""
    words = sys.argv[1:]
    if words[:1] == ["--one"]:
        name = None if words[3] == "-" else words[3]
        run(SMALL, 2, name if name == MULTIGRID else None)  # compiles
        run(FEW, 2, name)
        print(json.dumps(run(int(words[1]), int(words[2]), name)))
        return
    direct = words[:1] == ["--direct"]
    words = words[1:] if direct else words
    cut = words.index("--") if "--" in words else len(words)
    steps = int((words[cut + 1 :] or [STEPS])[0])
    print(f"threads: {os.environ.get('OMP_NUM_THREADS', 'all')}")
    print("| " + " | ".join(COLUMNS) + " |\n" + "| --- " * len(COLUMNS) + "|")
    for cells in [int(w) for w in words[:cut]] or CELLS:
        row = apart(cells, steps, MULTIGRID)
        print(line(row), flush=True)
        if not direct:
            continue
        exact = apart(cells, steps, DISSECTION)
        print(line(exact), flush=True)
        for key in ("at_rest", "values"):
            a, b = np.array(row[key]), np.array(exact[key])
            print(f"difference {key}: {np.abs(a - b).max() / np.abs(b).max():.1e}")


if __name__ == "__main__":
    main()
