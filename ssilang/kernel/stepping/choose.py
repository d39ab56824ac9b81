"""Which loop a problem gets: a table of rules, the first that fits is taken.

`python -m ssilang.kernel.stepping.choose` prints the table. What a loop needs besides (the step's
system, the modes) is made once, when a rule asks for it. A problem loads the loops that it may get:
each brings compiled functions, a hundredth of a second or two.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Protocol, cast

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.solvers.backends import MULTIGRID, PETSC, goes_to_petsc
from ssilang.kernel.stepping.effective import Effective, effective_matrix, effective_of
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.problem import SMALL, Problem
from ssilang.kernel.stepping.rests.sparse import iterated
from ssilang.kernel.stepping.rests.sparse.interleaved import InterleavedLoop, fits
from ssilang.kernel.stepping.rests.sparse.loop import SparseSteps, StepSolver
from ssilang.kernel.stepping.state import Motion, Outcome, Recorder
from ssilang.kernel.stepping.track import View
from ssilang.messages.message import Sentence

if TYPE_CHECKING:
    from ssilang.kernel.contact.modal import ContactLoop
    from ssilang.kernel.stepping.rests.modal.modes import SmallLoop


class Loop(Protocol):
    """Steps of one length of a problem."""

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps between the rows of `factors` (n_steps + 1, k)."""

    def view(self, unknowns: IntArray) -> View:
        """How unknowns of the problem follow from what the loop keeps of steps."""


class RenewableLoop(Loop, Protocol):
    """A loop whose loads may change from step to step."""

    def renew(self, problem: Problem) -> None:
        """Go on with other loads, all else being the same."""


@dataclass(frozen=True, eq=False)
class Case:
    """What rules look at: a problem with its motion, for steps dt.

    `full` asks for Newton's method on all unknowns, `closed` (m,) are the relations that are
    closed, kept up to date by the loop.
    """

    problem: Problem
    motion: Motion
    dt: float
    full: bool = False
    closed: BoolArray = field(default_factory=lambda: np.zeros(0, bool))

    @cached_property
    def A(self) -> sp.csr_array:  # noqa: N802
        """The step's matrix without the joints."""
        return effective_matrix(self.problem, self.dt)

    @property
    def share(self) -> float:
        """What the joints' forces count for in a step."""
        return 1 - self.problem.scheme.alpha_f

    @cached_property
    def effective(self) -> Effective:
        """The step's linear system."""
        return effective_of(self.problem, self.A, self.dt, self.share)

    @cached_property
    def rooted(self) -> Effective:
        """The same by a factor with the interface at its root, of small problems too."""
        if self.problem.numbering.size > SMALL:
            return self.effective
        return effective_of(self.problem, self.A, self.dt, self.share, least=0)

    @cached_property
    def iterated(self) -> bool:
        """Whether multigrid solves each step."""
        return iterated.pays(self.problem, self.A)

    @cached_property
    def modal(self) -> "SmallLoop | None":
        """The loop on all modes of a small problem, if it has some."""
        if not self.problem.small:
            return None
        from ssilang.kernel.stepping.rests.modal.modes import SmallLoop, modes_of

        modes = modes_of(self.problem, self.effective)
        if modes is None:
            return None
        return SmallLoop(self.problem, self.motion, self.effective, modes)

    @cached_property
    def stops(self) -> "ContactLoop | None":
        """The compiled loop of unilateral relations, if it can run the problem."""
        if not self.problem.contact:
            return None
        from ssilang.kernel.contact.modal import contact_loop, takes

        if not takes(self.problem):
            return None
        return contact_loop(self.problem, self.motion, self.effective, self.closed)


def _adaptive(case: Case) -> Loop:
    from ssilang.kernel.stepping.rests.sparse.adaptive import AdaptiveLoop

    def part(dt: float) -> SparseSteps:
        return _condensed(case if dt == case.dt else replace(case, dt=dt))

    return AdaptiveLoop(case.problem, case.motion, case.dt, case.closed, part)


def _iterated(case: Case) -> Loop:
    system = iterated.iterated_system(case.problem, case.A, case.share)
    return _sparse(case, iterated.IteratedSolver(case.problem, system, case.share))


def _condensed(case: Case) -> SparseSteps:
    from ssilang.kernel.contact.solver import step_solver

    return _sparse(case, step_solver(case.problem, case.effective))


def _full_newton(case: Case) -> Loop:
    from ssilang.kernel.stepping.rests.sparse.full_newton import FullNewtonSolver

    return _sparse(case, FullNewtonSolver(case.problem, case.A, case.share))


def _sparse(case: Case, solver: StepSolver) -> SparseSteps:
    p, impact = case.problem, None
    if p.contact and not p.scheme.conserving:
        from ssilang.kernel.contact.impact import ImpactRule

        impact = ImpactRule(p, case.effective, p.contact, case.closed)
    return SparseSteps(p, case.motion, solver, newmark_of(p.scheme, case.dt), impact)


@dataclass(frozen=True)
class Rule:
    """One loop: when it fits, how it is made, what is said of it."""

    name: str
    loop: str  # the word of the summary
    when: str  # the condition, for the table
    said: str  # code of what is said of the choice; `q` is the number of the interface's unknowns,
    # `relations` whether there are unilateral ones
    fits: Callable[[Case], bool]
    make: Callable[[Case], Loop]
    renewable: bool = False  # whether loads may change from step to step (CHARMECA)


RULES = (
    Rule(
        "adaptive", "adaptive",
        "steps adapted to contact, with joints or unilateral relations",
        "kernel.stepping.loop-adaptive",
        lambda c: c.problem.scheme.adaptive and bool(c.problem.interface or c.problem.contact),
        _adaptive, renewable=True,
    ),
    Rule(
        "conserving", "conserving",
        "the energy-conserving step",
        "kernel.stepping.loop-conserving",
        lambda c: c.problem.scheme.conserving,
        _condensed, renewable=True,
    ),
    Rule(
        "full Newton", "full Newton",
        "Newton's method on all unknowns is asked for",
        "kernel.stepping.loop-full-newton",
        lambda c: c.full,
        _full_newton, renewable=True,
    ),
    Rule(
        "relations on modes", "compiled",
        "few unknowns, relations without friction, no joints, supports at rest, diagonal damping",
        "kernel.stepping.loop-relations-on-modes",
        lambda c: c.stops is not None,
        lambda c: cast("ContactLoop", c.stops),
    ),
    Rule(
        "springs", "compiled",
        "small, diagonal damping, joints that only push",
        "kernel.stepping.loop-springs",
        lambda c: c.modal is not None and c.modal.springs is not None,
        lambda c: cast("SmallLoop", c.modal).using("springs"),
    ),
    Rule(
        "modes", "compiled",
        "small, supports at rest",
        "kernel.stepping.loop-modes",
        lambda c: c.modal is not None,
        lambda c: cast("SmallLoop", c.modal).using("modes"),
    ),
    Rule(
        "multigrid", "multigrid",
        "multigrid is asked for, or makes few steps sooner than a factor, or memory holds none",
        "kernel.stepping.loop-multigrid",
        lambda c: c.iterated,
        _iterated, renewable=True,
    ),
    Rule(
        "dissection", "condensed",
        "a factor by nested dissection, the interface at its root, few curves of imposed values",
        "kernel.stepping.loop-dissection",
        lambda c: not c.problem.contact and fits(c.problem, c.rooted),
        lambda c: InterleavedLoop(c.problem, c.motion, c.rooted),
    ),
    Rule(
        "condensed", "condensed",
        "all others",
        "kernel.stepping.loop-condensed",
        lambda c: True,
        _condensed, renewable=True,
    ),
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Choice:
    """The loop of a case, and the rule that gave it."""

    rule: Rule
    loop: Loop
    solver: str


def method_of(rule: Rule, problem: Problem) -> Sentence:
    """What is said of a problem's loop."""
    return Sentence(rule.said, q=problem.interface.size, relations=bool(problem.contact))


def rule_of(case: Case, renewable: bool = False) -> Rule:
    """The first rule that fits; of those whose loads may change, if wished.

    Raises
    ------
    KernelError
        For combinations that do not exist.
    """
    refuse_combinations(case.problem, case.full)
    return next(r for r in RULES if (r.renewable or not renewable) and r.fits(case))


def choose(case: Case, renewable: bool = False) -> Choice:
    """The loop of a case; see `rule_of`."""
    rule = rule_of(case, renewable)
    loop = rule.make(case)
    if rule.make is _iterated:
        solver = MULTIGRID
    elif rule.make is _full_newton:  # factorised at each iteration
        n = case.problem.constraints.T.shape[1]
        solver = PETSC if goes_to_petsc(case.problem.solver, n) else "SuperLU"
    else:
        used = case.rooted if isinstance(loop, InterleavedLoop) else case.effective
        solver = used.inverse.factor.name
    return Choice(rule, loop, solver)


def only(name: str) -> tuple[Rule, ...]:
    """The table with one rule, that fits all: to hold loops against each other."""
    return tuple(r for r in RULES if r.name == name)


def refuse_combinations(problem: Problem, full: bool) -> None:
    """Refuse schemes and methods that exclude each other.

    Raises
    ------
    KernelError
        For adapted steps with others, and for conserving steps with friction, dual relations
        or bearings.
    """
    scheme, contact = problem.scheme, problem.contact
    if scheme.adaptive and (scheme.conserving or full):
        raise KernelError("kernel.stepping.adapted-steps-condensed-interface")
    if scheme.conserving and (contact.friction or not contact.associated):
        raise KernelError("kernel.stepping.conserving-step-no-friction")
    codes = problem.interface.codes
    if scheme.conserving and np.isin(codes, (LawCode.LEAD, LawCode.PENDULUM)).any():
        raise KernelError("kernel.stepping.conserving-step-no-bearings")


def table() -> str:
    """The rules, in the order in which they are tried."""
    width = max(len(r.name) for r in RULES)
    return "\n".join(f"{r.name:{width}s}  {r.when}" for r in RULES)


if __name__ == "__main__":
    print(table())
