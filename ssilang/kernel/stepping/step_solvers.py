"""Which solver a step gets."""

from __future__ import annotations

from ssilang.kernel.contact.solver import ContactSolver
from ssilang.kernel.stepping.effective import Effective
from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.sparse.loop import CondensedSolver, StepSolver


def step_solver(problem: Problem, effective: Effective) -> StepSolver:
    """The condensed interface, with active sets where there are unilateral relations."""
    if problem.contact is not None:
        return ContactSolver(problem, effective, problem.contact)
    return CondensedSolver(problem, effective)
