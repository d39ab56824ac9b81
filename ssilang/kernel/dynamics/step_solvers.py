"""Which solver a step gets."""

from __future__ import annotations

from ssilang.kernel.dynamics.contact_solver import ContactSolver
from ssilang.kernel.dynamics.effective import Effective
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.dynamics.sparse_loop import CondensedSolver, StepSolver


def step_solver(problem: Problem, effective: Effective) -> StepSolver:
    """The condensed interface, with active sets where there are unilateral relations."""
    if problem.contact is not None:
        return ContactSolver(problem, effective, problem.contact)
    return CondensedSolver(problem, effective)
