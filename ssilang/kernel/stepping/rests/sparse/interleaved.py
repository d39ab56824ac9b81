"""Large problems with supports at rest or in motion, set up for `run_interleaved`."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.scientific import sp, spla
from ssilang.kernel.interface.condensed import condensed_of
from ssilang.kernel.interface.newton import workspace
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import longest
from ssilang.kernel.solvers.low_rank import NONE
from ssilang.kernel.stepping.effective import Effective, RootResponse
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.constraints import split_damping
from ssilang.kernel.stepping.problem.moving_supports import (
    MOST,
    Columns,
    Course,
    MovingSupports,
    Start,
)
from ssilang.kernel.stepping.problem.problem import Problem, keep_reactions, react
from ssilang.kernel.stepping.rests.sparse.interleaved_loop import (
    BOTH,
    DOWN,
    UP,
    Damping,
    Plan,
    Products,
    Sparse,
    run_interleaved,
    sweep_of,
)
from ssilang.kernel.stepping.state import (
    Motion,
    Outcome,
    Peaks,
    Recorder,
    peaks_of,
    recorder_of,
    rows_of,
    tap_of,
)
from ssilang.kernel.stepping.track import View, whole_view

KEPT = ("u", "v", "a", "w", "t", "state")
BRANCH = 64_000  # numbers of a branch of the factor: half of a megabyte, the cache of a core
BLOCK = 64  # steps between two evaluations of the equilibrium from the displacements
MANY = 16_384  # unknowns of steps between them where unknowns are few: they cost calls alone
HALVED = 500  # jumps from which half of their compliance is read
SINGLE = 400  # jumps beyond which a response of double precision leaves the cache of a core


def fits(problem: Problem, effective: Effective) -> bool:
    """Whether `InterleavedLoop` can run a problem.

    Associated relations, no unilateral ones, few curves of imposed values, and a factor by
    dissection.
    """
    if problem.contact or not problem.constraints.associated:
        return False
    if effective.inverse.singular or problem.loading.imposed.any(axis=0).sum() > MOST:
        return False
    if problem.interface and effective.root is None:
        return False
    return isinstance(effective.inverse.factor, DissectedFactor)


class InterleavedLoop:
    """Steps of one dt of a problem that fits."""

    remembered = ("newton",)

    def __init__(self, problem: Problem, motion: Motion, effective: Effective) -> None:
        self.problem, self.motion = problem, motion
        inverse = effective.inverse
        factor = inverse.factor
        assert isinstance(factor, DissectedFactor)
        order = factor.tree.order
        scaled = sp.csr_array(problem.constraints.T @ sp.diags_array(inverse.scale))
        self.T = sp.csr_array(sp.csc_array(scaled)[:, order])
        self.M, self.C, self.K = (self._reduced(A) for A in (problem.M, problem.C, problem.K))
        self.forces = np.ascontiguousarray((self.T.T @ problem.loading.forces).T)
        n, q = len(order), effective.S.shape[0]
        root = effective.root
        if root is None:
            root = RootResponse(sp.csr_array((q, 0)), np.zeros((0, q)))
        visits = _visits(factor, root.J.shape[1] > 0)
        self._spans = factor.panels.first[visits[:, :2]]
        alpha, beta, rest = split_damping(self.C, self.M, self.K)
        self.plan = Plan(
            factor.panels, visits, len(factor.panels.first) - 2 + (root.J.shape[1] == 0),
            _rows(self.M), Damping(alpha, beta, _all_rows(rest)), self.C.nnz > 0, self.forces,
            *self._acting(self.forces), np.zeros((q, 0)), _all_rows(root.J),
            _all_rows(sp.csr_array(root.J.T)), root.Y,
            NONE._replace(values=np.zeros(0)),
            condensed_of(effective.S, 1.0 - problem.scheme.alpha_f, effective.R, q >= HALVED),
            newmark_of(problem.scheme, effective.dt), longest(factor.panels),
        )  # fmt: skip
        self.supports = MovingSupports(problem, effective.dt, self.T)
        joints, self.joints = problem.interface, problem.interface.points
        soft = q > SINGLE and joints.is_soft(effective.S)
        self.J = joints.J @ self.T
        self.newton = workspace(motion.w.shape, q, single=soft and not effective.R.any())
        self._moved: tuple[FloatArray | None, sp.csr_array] = None, sp.csr_array((0, 0))
        gram = sp.csr_array(self.T.T @ self.T)
        self._gram_diagonal = gram.diagonal()
        self._gram = None if gram.nnz == n else sp.csc_array(gram)

    def _acting(self, forces: FloatArray) -> tuple[IntArray, IntArray]:
        """`first` and `acting` of the plan."""
        found = [np.flatnonzero(forces[:, i:j].any(axis=1)) for i, j in self._spans]
        return np.cumsum([0, *map(len, found)]), np.concatenate([np.zeros(0, np.int64), *found])

    def _reduced(self, A: sp.csr_array) -> sp.csr_array:
        return sp.csr_array(self.T.T @ A @ self.T)

    def run(self, factors: FloatArray, recorder: Recorder) -> Outcome:
        """Steps on the whole problem's arrays, some at a time."""
        worst, r, steps = 0, recorder, len(recorder.row)
        seen = self.seen(r.tap.at)
        peaks = peaks_of(self.T.shape[1] if len(r.peaks.u) else 0, r.peaks.joints.shape[1])
        length = max(BLOCK, MANY // max(self.T.shape[1], 1))
        for first in range(0, steps, length):
            part = slice(first, min(first + length, steps))
            given = np.ascontiguousarray(factors[first : part.stop + 1])
            block = self.block(given)
            kept = self.room(block, r, part, seen)._replace(peaks=peaks)
            peaks.first[0] = r.peaks.first[0] + first
            done, turns, residual = self.stepped(block, kept)
            self.finish(block, given, kept, done)
            self.put(block, kept, r, first, done, seen)
            if first + done == steps or turns <= 0:
                react(self.problem, self.motion, given[done])
                keep_reactions(self.problem, factors, r)
                self._compare(peaks, r.peaks)
            if turns <= 0:
                return first + done, turns, residual
            worst = max(worst, turns)
        return steps, worst, 0.0

    def stepped(self, block: "PreparedBlock", kept: Recorder) -> Outcome:
        """The steps of a block."""
        return run_interleaved(
            block.plan, self.joints, block.motion, block.products,
            sweep_of(block.plan, len(block.motion.u), block.factors.shape[1]), self.newton,
            block.factors, kept, -1, len(kept.row),
        )  # fmt: skip

    def view(self, unknowns: IntArray) -> View:
        """Unknowns as they are: they are made block by block, supports move within one."""
        return whole_view(self.motion, unknowns, "reaction", "contact")

    def seen(self, unknowns: IntArray) -> "Seen":
        """How unknowns follow from those of the factor."""
        rows = self.T[unknowns]
        at = np.unique(rows.indices).astype(np.int64)
        return Seen(unknowns, at, sp.csr_array(rows[:, at]))

    def _compare(self, own: Peaks, to: Peaks) -> None:
        """The largest values of some steps with those before, at unknowns that no support holds."""
        if not len(to.u):
            return
        free = np.flatnonzero(np.diff(self.T.indptr) == 1)
        at = self.T.indices[self.T.indptr[free]]
        factor = self.T.data[self.T.indptr[free]]
        values = factor * own.u[at]
        larger = np.abs(values) > np.abs(to.u[free])
        to.u[free[larger]], to.when[free[larger]] = values[larger], own.when[at][larger]
        larger = own.joints > to.joints
        to.joints[larger], to.joints_when[larger] = own.joints[larger], own.joints_when[larger]

    def block(self, factors: FloatArray) -> "PreparedBlock":
        """The motion on the loop's unknowns, with the forces of equilibrium from scratch."""
        m = self.motion
        columns, course = self.supports.begin(m, factors)
        plan, whole, extra = self.plan, factors, self.forces.shape[0]
        moved = columns.X.shape[1] > 0
        parts = (course.c[0], course.v[0], course.a[0])
        u, v, a = (
            self._folded(x - columns.X @ p if moved else x)
            for x, p in zip((m.u, m.v, m.a), parts, strict=True)
        )
        if moved:
            whole = np.hstack([factors, course.factors(plan.newmark)])
            forces = np.vstack([self.forces, columns.forces])
            lift = np.zeros((len(m.f), whole.shape[1]))
            lift[:, whole.shape[1] - columns.X.shape[1] :] = columns.lift
            first, acting = self._acting(forces)
            plan = plan._replace(forces=forces, first=first, acting=acting)
            plan = plan._replace(lift=lift if lift.any() else lift[:, :0].copy())
        Cv, Ca = self.C @ v, self.C @ a
        g = self.K @ u + Cv + self.J.T @ m.f - plan.forces.T @ whole[0]
        few = m._replace(u=u, v=v, a=a, reaction=np.zeros(0), contact=np.zeros(0))
        products = Products(g, self.M @ v, self.M @ a, Cv, Ca, plan.forces @ u)
        own = plan.forces[extra:]
        start = Start(np.array([own @ u, own @ v, own @ a]), m.f.copy())
        return PreparedBlock(plan, few, products, columns, course, whole, start)

    def finish(
        self, block: "PreparedBlock", factors: FloatArray, kept: Recorder, done: int
    ) -> None:
        """The motion and its energies after the steps that were done."""
        m, few, history = self.motion, block.motion, kept.energies[:done]
        works = kept.work[:, :done, self.forces.shape[0] :]
        self.supports.complete(block.columns, block.course, block.start, works, factors, history)
        if done:
            m.energies[:] = history[-1]
        m.u[:], m.v[:], m.a[:] = self._unfolded(block, few.u, few.v, few.a, done)

    def _unfolded(
        self, block: "PreparedBlock", u: FloatArray, v: FloatArray, a: FloatArray, k: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Displacement, velocity and acceleration (n,) after k steps."""
        X, c = block.columns.X, block.course
        u, v, a = self.T @ u, self.T @ v, self.T @ a
        if X.shape[1]:
            moved = self._columns(block)
            u, v, a = u + moved @ c.c[k], v + moved @ c.v[k], a + moved @ c.a[k]
        return u, v, a

    def _columns(self, block: "PreparedBlock") -> sp.csr_array:
        """The columns of the supports, most of whose entries are zero."""
        X = block.columns.X
        if self._moved[0] is not X:
            self._moved = X, sp.csr_array(X)
        return self._moved[1]

    def _folded(self, x: FloatArray) -> FloatArray:
        """q of an admissible x = T q."""
        b: FloatArray = self.T.T @ x
        if self._gram is None:
            return b / self._gram_diagonal
        if not hasattr(self, "_gram_factor"):
            self._gram_factor = spla.splu(self._gram)
        return self._gram_factor.solve(b)

    def room(self, block: "PreparedBlock", to: Recorder, part: slice, seen: "Seen") -> Recorder:
        """Room for the kept steps of a block, that is a part of all steps."""
        row, m = to.row[part], block.motion
        work = np.zeros((2, len(row), block.factors.shape[1]))
        shapes: dict[str, tuple[int, ...]] = dict.fromkeys("uva", seen.at.shape)
        shapes |= {name: getattr(m, name).shape for name in ("w", "t", "state")}
        tap = tap_of(rows_of(to.tap.row[part] >= 0), seen.at, shapes)
        energies = to.energies[part]
        return recorder_of(m, rows_of(row >= 0), energies, KEPT, work=work, tap=tap)

    def put(
        self,
        block: "PreparedBlock",
        kept: Recorder,
        to: Recorder,
        first: int,
        done: int,
        seen: "Seen",
    ) -> None:
        """Kept instants of a block that begins with step `first` as whole arrays, and the tap."""
        for k in np.flatnonzero(kept.row[:done] >= 0).tolist():
            row, at = int(kept.row[k]), int(to.row[first + k])
            u, v, a = self._unfolded(block, kept.u[row], kept.v[row], kept.a[row], k + 1)
            to.u[at], to.v[at], to.a[at] = u, v, a
            to.w[at], to.t[at], to.state[at] = kept.w[row], kept.t[row], kept.state[row]
        steps = np.flatnonzero(kept.tap.row[:done] >= 0)
        if not len(steps):
            return
        own, tap, count, c = kept.tap, to.tap, len(steps), block.course
        start = int(tap.row[first + steps[0]])
        rows = slice(start, start + count)
        for name, course in (("u", c.c), ("v", c.v), ("a", c.a)):
            found = seen.of(getattr(own, name)[:count])
            if block.columns.X.shape[1]:
                found += (self._columns(block)[seen.unknowns] @ course[steps + 1].T).T
            getattr(tap, name)[rows] = found
        tap.w[rows], tap.t[rows], tap.state[rows] = own.w[:count], own.t[:count], own.state[:count]


@dataclass(frozen=True, eq=False)
class Seen:
    """Unknowns (p,) of the problem as `matrix` (p, c) times entries (c,) of the factor's."""

    unknowns: IntArray
    at: IntArray
    matrix: sp.csr_array

    def of(self, z: FloatArray) -> FloatArray:
        """Unknowns (k, p) of entries (k, c)."""
        entries = np.diff(self.matrix.indptr)
        if entries.max(initial=0) > 1:
            return np.asarray((self.matrix @ z.T).T)
        found = np.zeros((len(z), len(entries)))
        found[:, entries == 1] = z[:, self.matrix.indices] * self.matrix.data
        return found


@dataclass(frozen=True, eq=False)
class PreparedBlock:
    """Some steps: what `run_interleaved` takes, and the supports' part of the motion."""

    plan: Plan
    motion: Motion
    products: Products
    columns: Columns
    course: Course
    factors: FloatArray
    start: Start


def _rows(A: sp.csr_array) -> Sparse:
    diagonal = A.diagonal()
    if A.nnz == np.count_nonzero(diagonal):
        return Sparse(np.zeros(0, np.int64), np.zeros(0, np.int64), diagonal, True)
    return _all_rows(A)


def _all_rows(A: sp.csr_array) -> Sparse:
    return Sparse(A.indptr.astype(np.int64), A.indices.astype(np.int64), A.data, False)


def _visits(factor: DissectedFactor, has_root: bool) -> IntArray:
    """`visits` of the plan: branches of at most `BRANCH` numbers, the others one by one."""
    at, parent = factor.panels.at, factor.tree.parent
    count = len(parent)
    lowest = np.arange(count)
    for s in range(count):
        if parent[s] >= 0:
            lowest[parent[s]] = min(lowest[parent[s]], lowest[s])
    whole = count - 1 if has_root else count
    size = at[1:] - at[lowest]
    light = size <= BRANCH
    heads = np.array([
        s for s in range(whole)
        if light[s] and (parent[s] < 0 or parent[s] >= whole or not light[parent[s]])
    ], np.int64)  # fmt: skip
    covered = np.zeros(count, bool)
    for s in heads:
        covered[lowest[s] : s + 1] = True
    trunk, rising = np.flatnonzero(~covered[:whole]), np.flatnonzero(~covered)
    kind = np.repeat([BOTH, DOWN, UP], [len(heads), len(trunk), len(rising)])
    begin = np.concatenate([lowest[heads], trunk, rising])
    end = np.concatenate([heads, trunk, rising]) + 1
    # the part of the tree below a supernode stands in a row: down before it, up after it
    place = np.concatenate([lowest[heads], lowest[trunk], rising])
    order = np.lexsort((-end, kind != DOWN, place))
    return np.column_stack([begin, end, kind])[order].astype(np.int64)
