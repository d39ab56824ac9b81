"""Which solver a step gets."""

from __future__ import annotations

from ssilang.kernel.dynamics.effective import Effective
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.dynamics.sparse_loop import CondensedSolver, StepSolver


def step_solver(problem: Problem, effective: Effective) -> StepSolver:
    """The condensed interface."""
    return CondensedSolver(problem, effective)
