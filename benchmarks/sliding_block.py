"""A block that slides and rocks on soil in space: what a step costs at its joints.

    OMP_NUM_THREADS=1 python benchmarks/sliding_block.py [steps]        default 60

The block of `block_3d_openseespy.py` on 121 pairs of nodes (363 jumps), with Coulomb's friction in
place of elastic shear and joints 30 times as stiff. Each interface problem of the loop is solved
with the start by projected forces and once more, from the same state, without it: mean processor
time and turns of Newton's method. Both must find the same jumps within 1e-8.
"""

import sys
import time
from typing import Any

import block_3d_openseespy as block
import numpy as np

from ssilang.kernel.contact import solver
from ssilang.kernel.interface.newton import Workspace, solve_interface, workspace
from ssilang.kernel.interface.response import InterfaceState
from ssilang.kernel.stepping import choose
from ssilang.kernel.stepping.problem.problem import make_problem
from ssilang.kernel.stepping.rests.sparse import loop
from ssilang.kernel.stepping.run import integrate

CELLS, UNDER, FRICTION, STIFFER, PUSH = 14, 10, 0.4, 30.0, 6.0  # cells of soil, of the block


def made(steps: int) -> block.Case:
    """Soil of CELLS^3 bricks, a block of UNDER^3 on its middle."""
    table, first = block.NodeTable(), (CELLS - UNDER) // 2
    soil = block.grid(table, (0.0, 0.0, 0.0), CELLS)
    corner = (first * block.SIZE, first * block.SIZE, CELLS * block.SIZE)
    return block.Case(table, soil, block.grid(table, corner, UNDER), steps)


def rubbing(case: block.Case) -> tuple[block.Model, block.CellField]:
    """No-tension joints with friction."""
    cells = block.CellBlock.make(case.table, "SEG2", np.column_stack(block.interface(case)))
    one = np.ones((len(cells), 1))
    names = {"KN": STIFFER * block.NORMAL * one, "KS": STIFFER * block.SHEAR * one}
    names |= {"FROT": FRICTION * one, "V1X": 0 * one, "V1Y": 0 * one, "V1Z": one}
    names |= {"V2X": one, "V2Y": 0 * one, "V2Z": 0 * one}
    field = block.CellField((block.CellFieldBlock(cells, names, "STRESSES", "JOI1"),))
    law = ("ELASTIQUE", "JOINT_SDM")
    mode = block.Mode.THREE_DIMENSIONAL
    return block.Model((block.Zone(cells, "MECANIQUE", law, "JOI1", mode),)), field


class Twice(loop.CondensedSolver):
    """Solves the interface of each step with the start and without."""

    done: list[tuple[float, int]] = []  # noqa: RUF012
    alone: list[tuple[float, int]] = []  # noqa: RUF012
    gap = 0.0
    ours: Workspace
    plain: Workspace | None = None

    def solve(self, motion: Any, *given: Any) -> loop.StepOutcome:
        """The step's increment, that of the solution with the start."""
        now = InterfaceState(
            *(x.copy() for x in (motion.delta, motion.f, motion.w, motion.t, motion.state))
        )
        found = super().solve(motion, *given)
        assert self._newton is not None
        trial = self._newton.trial
        ours = trial.y.copy()
        if self.plain is None:
            self.plain = workspace(motion.w.shape, len(ours))
            self.plain.shares[:] = 1.0
            self.ours = workspace(motion.w.shape, len(ours))
        for work, to in ((self.ours, self.done), (self.plain, self.alone)):
            state = InterfaceState(*(x.copy() for x in now))
            work.trial.y0[:] = work.trial.y[:] = trial.y0
            started = time.process_time()
            turns, _ = solve_interface(self.interface.points, self._condensed, state, work)
            to.append((1e3 * (time.process_time() - started), turns))
            Twice.gap = max(Twice.gap, np.abs(work.trial.y - ours).max() / np.abs(ours).max())
        return found


def main() -> None:
    """Both figures."""
    steps = int(sys.argv[1]) if sys.argv[1:] else 60
    block.joints, block.push_at = rubbing, lambda t: PUSH * np.cos(4 * np.pi * t)
    choose.RULES, solver.step_solver = choose.only("condensed"), Twice
    case = made(steps)
    integrate(make_problem(block.inputs_of(case)[0]), [])
    assert Twice.gap < 1e-8, Twice.gap
    for name, values in (("projected", Twice.done), ("without", Twice.alone)):
        cost, turns = np.array(values[5:]).T
        print(f"{name:10s} {cost.mean():6.2f} ms a step, at most {cost.max():.1f}; "
              f"{turns.mean():.1f} turns of Newton's method")  # fmt: skip
    print(f"jumps differ by {Twice.gap:.0e}")


if __name__ == "__main__":
    main()
