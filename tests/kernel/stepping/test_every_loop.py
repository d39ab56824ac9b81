"""Each step of each loop against the equations as they are written, with dense matrices.

Nothing is solved here: that balance, supports, Newmark's formulas, laws and energies hold at every
step says that the step is right, whatever way led to it.
"""

import itertools
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import scipy.linalg as la
from hypothesis import Phase, given, settings
from references.awkward import LINES, POINTS, PUSH, UNITS, Awkward, problems
from references.recorder import Recorder, recorded
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.continuation.arc import Lengths
from ssilang.kernel.interface.laws.columns import N_STATE
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.point_state import energies_of_points
from ssilang.kernel.plasticity.added_load import Added, loaded_bulk
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.driven_load import (
    follow_arc,
    follow_directions,
    follow_time,
    history_of,
)
from ssilang.kernel.plasticity.run import BulkRun, run_bulk
from ssilang.kernel.solvers.factor import FIRST_FIT, Solver
from ssilang.kernel.solvers.multigrid import hierarchy
from ssilang.kernel.statics import stepping
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping import choose, effective
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.problem import problem as problem_module
from ssilang.kernel.stepping.rests.reduced import run as reduced
from ssilang.kernel.stepping.rests.sparse.adaptive import AdaptiveLoop
from ssilang.kernel.stepping.rests.sparse.loop import SparseSteps, StepOutcome
from ssilang.kernel.stepping.run import Integration, integrate
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC, LOST, STORED, Motion

# steps are many and problems small as they are: nothing is gained by making them smaller
BRIEF = settings(max_examples=8, derandomize=True, phases=(Phase.explicit, Phase.generate))
LARGE = {"point_laws": POINTS}
STILL = {"tied": False, "moving": False}
LOOPS = {
    "springs": {"damping": "Rayleigh", "point_laws": PUSH, "line_laws": (), **STILL},
    "modes": {"moving": False},
    "dissection, small": {"steps": 60},
    "dissection, footings": {"footings": True, "point_laws": (), "line_laws": (), "steps": 30},
    "dissection": LARGE,
    "condensed": LARGE,
    "full Newton": LARGE | {"steps": 25},
    "multigrid": LARGE | {"steps": 25},
    "condensed, relations": {"unilateral": True},
}


def forced(patch, rule):
    """A loop for all problems; those of large ones take them for large."""
    patch.setattr(choose, "RULES", choose.only(rule.partition(",")[0]))
    patch.setattr(hierarchy, "COARSEST", 6)  # several levels
    if LARGE.items() <= LOOPS.get(rule, {}).items():
        patch.setattr(effective, "SMALL", 0)
        patch.setattr(problem_module, "SMALL", 0)


def run(awkward, rule, lost=None):
    """A problem, its history and instants; from the step `lost` on its loads are no numbers."""
    with pytest.MonkeyPatch.context() as patch:
        forced(patch, rule)
        problem = awkward.problem()
        if rule == "multigrid":
            problem = replace(problem, solver=Solver(rule))
        if rule.startswith("adaptive"):
            problem = replace(problem, scheme=replace(problem.scheme, adaptive=True))
        recorder, few = (Recorder(len(problem.times)) for _ in range(2))
        few.wanted[1::3] = False
        if lost:
            late = np.arange(len(problem.times)) >= lost
            curves = tuple((x, np.where(late, np.nan, y)) for x, y in problem.loading.curves)
            problem = replace(problem, loading=replace(problem.loading, curves=curves))
            with pytest.raises(ConvergenceError) as failed:
                integrate(problem, [recorder], full_newton=rule == "full Newton")
            assert recorder.closed
            return failed.value.data, problem.times, len(recorder.snapshots)
        steps = Integration(problem, [recorder, few], full_newton=rule == "full Newton")
        history, end = steps.run(), steps.motion
    check_chosen(few, recorder)
    jumps = problem.interface.J @ end.u  # from where any other loop goes on
    near(end.delta, jumps, np.abs(jumps).max(), 1e-10)
    near(end.f, joint_forces(problem.interface, end.t), np.abs(end.f).max())
    assert history.loop == choose.only(rule.partition(",")[0])[0].loop
    return problem, problem.times, history.energies, recorder.snapshots


def check_chosen(few, all_of_them):
    """Who asks for some instants gets these, and no other."""
    chosen = [s for s, wanted in zip(all_of_them.snapshots, few.wanted, strict=True) if wanted]
    assert [s.time for s in few.snapshots] == [s.time for s in chosen]
    np.testing.assert_array_equal([s.u for s in few.snapshots], [s.u for s in chosen])


def near(found, expected, size, tolerance=1e-8):
    tolerance *= max(size, 1e-30)
    same = np.ndim(expected) == 0 or np.shape(found) == np.shape(expected)
    if not same or not np.all(
        np.abs(found - expected) <= tolerance
    ):  # numpy's takes ten times as long
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance)


def joints_at(interface, u, state):
    """Jumps, tractions, new state, forces on the unknowns, stored and lost energy."""
    delta = (interface.J @ u).reshape(-1, interface.dimension)
    w = np.einsum("pij,pj->pi", interface.B, delta[interface.pairs].reshape(len(state), -1))
    t, new = np.zeros_like(w), np.zeros((len(w), N_STATE))
    D = np.zeros((*w.shape, w.shape[1]))
    respond(interface.codes, w, state, interface.parameters, t, new, D)
    points = (interface.codes, w, t, new, interface.parameters)
    energies = energies_of_points(*points) @ interface.weights
    return w, t, new, interface.J.T @ joint_forces(interface, t), energies


def joint_forces(interface, t):
    """Forces on the jumps at the joints' nodes."""
    d = interface.dimension
    force = np.zeros((interface.J.shape[0] // d, d))
    parts = np.einsum("p,pij,pi->pj", interface.weights, interface.B, t)
    np.add.at(force, interface.pairs, parts.reshape(*interface.pairs.shape, d))
    return force.ravel()


def check_fields(problem, now):
    """Reactions and LX go by the rows that scripts have; for schemes that balance instants."""
    contact, push = problem.contact, np.abs(now.reaction).max()
    fields = (now.displacement, now.velocity, now.acceleration, now.reactions)
    vectors = (now.u, now.v, now.a, now.reaction)
    for names in (("UX", "FX"), ("UY", "FY")):
        at = problem.numbering.where(names[0])
        for field, values in zip(fields, vectors, strict=True):
            found = field.values_at(names[field is fields[3]], problem.numbering.nodes[at])
            near(found, values[at], np.abs(values).max())
    rows, nodes = problem.constraints.C.toarray(), problem.multipliers
    rows = np.vstack([rows, contact.sense[:, None] * contact.G.toarray()])
    nodes = np.concatenate([nodes, contact.multipliers])
    near(-now.displacement.values_at("LX", nodes) @ rows, now.reaction, push)


def check_steps(problem, times, energies, instants, static=False, follows=None):
    """All that a step is made of, at every step; `static` ones are in balance without inertia.

    `follows(t, u)` are loads (n,) beside those of the problem.
    """
    p, s = problem, problem.scheme
    K, M, C, rows = (A.toarray() for A in (p.K, p.M, p.C, p.constraints.C))
    G = p.contact.G.toarray()
    if static:
        M, C = 0.0 * M, 0.0 * C
    free, by_rows = la.null_space(rows), la.pinv(rows.T)
    factors = np.stack([np.interp(times, x, y) for x, y in p.loading.curves], axis=1)
    F, imposed = factors @ p.loading.forces.T, factors @ p.loading.imposed.T
    if follows:
        F = F + np.array([follows(t, i.u) for t, i in zip(times, instants, strict=True)])
    state, before, was = p.state, None, None
    u, v, a = (np.array([getattr(i, n) for i in instants]) for n in "uva")
    sizes = [np.abs(x).max() for x in (u, v, a)]
    push = max(np.abs(F).max(), np.abs(u @ K).max(), np.abs(a @ M).max())
    energy = np.abs(energies).max()
    for k, now in enumerate(instants):
        w, t, new, force, (stored, lost) = joints_at(p.interface, now.u, state)
        near(now.w, w, np.abs(w).max(), 1e-10)
        near(now.t, t, np.abs(t).max())
        near(now.state, new, np.abs(new).max())
        state = now.state
        rest = C @ now.v + K @ now.u + force - F[k] - G.T @ now.contact
        near(now.reaction, M @ now.a + rest + G.T @ now.contact, push)
        if len(G) and k:
            gaps = G @ now.u - p.contact.imposed @ factors[k]
            near(np.minimum(gaps, 0.0), 0.0, sizes[0], 1e-10)
            near(np.minimum(now.contact, 0.0), 0.0, push)
            near(gaps * now.contact, 0.0, sizes[0] * push)
        found = energies[k]
        near(found[KINETIC], 0.5 * now.v @ M @ now.v, energy)
        near(found[ELASTIC], 0.5 * now.u @ K @ now.u, energy)
        near(found[[STORED, LOST]], [stored, lost], energy)
        if before is None:
            near(free.T @ (M @ now.a + rest) * (not static), 0.0, push)
        else:
            dt, du = times[k] - times[k - 1], now.u - before.u
            near(rows @ now.u, imposed[k], sizes[0], 1e-10)
            if static:
                near(free.T @ rest, 0.0, push)
                assert not np.any([now.v, now.a])
            else:
                beta, gamma = s.beta, s.gamma
                ahead = before.u + dt * before.v + dt**2 * (0.5 - beta) * before.a
                near(now.u, ahead + dt**2 * beta * now.a, sizes[0])
                if not len(G):  # impacts change it
                    near(now.v, before.v + dt * ((1 - gamma) * before.a + gamma * now.a), sizes[1])
                inertia = M @ ((1 - s.alpha_m) * now.a + s.alpha_m * before.a)
                balance = inertia + (1 - s.alpha_f) * rest + s.alpha_f * was
                if len(G) and s.alpha_f:  # between instants stops push as they need to
                    pushing = now.contact + before.contact > 0.0
                    free = la.null_space(np.vstack([rows, G[pushing]]))
                near(free.T @ balance, 0.0, push)
            step = found - energies[k - 1]
            near(step[DAMPED], 0.5 * du @ C @ (now.v + before.v), energy)
            pushed = now.contact + before.contact
            held = now.reaction + before.reaction - G.T @ pushed
            supports = 0.5 * (rows @ du) @ by_rows @ held
            if len(G):
                supports += 0.5 * pushed @ p.contact.imposed @ (factors[k] - factors[k - 1])
            if not static or k > 1:  # what is out of balance at first grows from nothing
                near(step[EXTERNAL], 0.5 * du @ (F[k] + F[k - 1]) + supports, energy)
        before, was = now, rest


@pytest.mark.parametrize("loop", LOOPS)
def test_steps_are_those_of_the_equations(loop):
    @settings(BRIEF)
    @given(problems(**LOOPS[loop]))
    def holds(awkward):
        problem, *_, instants = made = run(awkward, loop)
        check_steps(*made)
        if not (problem.scheme.alpha_m or problem.scheme.alpha_f):
            check_fields(problem, instants[-1])

    holds()


@together("lost", [1, 21])
@together("loop", [*[*LOOPS][:-1], "adaptive"])
def test_a_step_without_an_answer_is_told_and_those_before_it_are_handed_over(loop, lost):
    told, times, instants = run(Awkward(3, **LOOPS.get(loop, {})), loop, lost)
    assert (told["step"], told["time"], instants) == (lost, times[lost], lost)


@pytest.mark.parametrize(
    ("solver", "unilateral"), [(FIRST_FIT, False), (Solver("multigrid"), False), (FIRST_FIT, True)],
    ids=["condensed", "multigrid", "relations"],
)  # fmt: skip
def test_load_steps_are_equilibria(solver, unilateral):
    """Also from a start that is none, whatever scheme the motion after them has."""

    @settings(BRIEF, max_examples=5)
    @given(problems(steps=25, unilateral=unilateral))
    def holds(awkward):
        problem = replace(awkward.problem(), solver=solver)
        recorder = Recorder(len(problem.times))
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(hierarchy, "COARSEST", 6)
            history = step_statics(problem, [recorder])
        check_steps(problem, problem.times, history.energies, recorder.snapshots, static=True)

    holds()


def test_a_second_solution_that_fails_leaves_the_first(monkeypatch):
    """What rounding left out of balance is solved for once more; here that leads nowhere."""

    class Nowhere:
        def solve(self, motion, *given):
            for values in motion:
                values += 1.0
            return StepOutcome(motion.u.copy(), 0, np.inf)

    problem, polish = Awkward(1).problem(), stepping._polish
    plain, spoilt = Recorder(len(problem.times)), Recorder(len(problem.times))
    monkeypatch.setattr(stepping, "_polish", lambda *given: None)
    step_statics(problem, [plain])
    monkeypatch.setattr(stepping, "BALANCED", -1.0)
    monkeypatch.setattr(stepping, "_polish", lambda p, s, m, f: polish(p, Nowhere(), m, f))
    step_statics(problem, [spoilt])
    for name in ("u", "w", "t", "state", "reaction"):
        np.testing.assert_array_equal(spoilt.of(name), plain.of(name))


def following_bulk(problem, force, length, hard=2e3, late=5.0):
    """Bodies whose loads (n,) neighbours turn and time changes, and these loads."""
    n = problem.numbering.size
    own = np.random.default_rng(1).uniform(1.0, 2.0, n) * hard * force / length
    neighbour = np.arange(n) - 1

    def follows(time, u):
        x = u / (1e-3 * length)
        return -own * u * (x + 2.0 * x[neighbour]) ** 2 * (1.0 + late * time)

    law, shifts = (lambda t, u: Added(follows(t, u))), np.full(n, 1e-7 * length)
    return loaded_bulk(Bulk((), (), n), law, shifts, 1e-7, None, ""), follows


@pytest.mark.parametrize("unilateral", [False, True])
@pytest.mark.parametrize("static", [False, True])
def test_steps_under_loads_that_follow_are_those_of_the_equations(static, unilateral):
    """By Newton's method of bodies."""

    @settings(BRIEF, max_examples=3)
    @given(problems(steps=20, unilateral=unilateral))
    def holds(awkward):
        problem = awkward.problem()
        hard = 2e2 if static and unilateral else 2e3
        bulk, follows = following_bulk(problem, *UNITS[awkward.units], hard)
        recorder, few = (Recorder(len(problem.times)) for _ in range(2))
        few.wanted[1::3] = False
        state = bulk.begin((), problem.u, 0.0)
        history = run_bulk(problem, bulk, state, [recorder, few], dynamic=not static)
        check_chosen(few, recorder)
        instants = recorder.snapshots
        check_steps(problem, problem.times, history.energies, instants, static, follows)

    holds()


WAYS = ("directions", "time", "arc")
# a bonded joint cracks in the fifth step, from where the unknown led goes back whatever the load
SNAPS = ("directions", 1)
PATHS = [SNAPS, ("time", 1), ("arc", 1), ("directions", 4), ("time", 5), ("arc", 3)]


def a_share(split, share, by):
    """The parameter for which the third unknown goes on by so much; < 0: the way of the load."""
    by = by if by > 0.0 else -by * np.sign(split.unit[2])
    return [(share * by - split.du[2] - split.rest[2]) / split.unit[2]]


@pytest.mark.parametrize(("way", "seed"), [*itertools.product(WAYS, (0, 2)), *PATHS])
def test_steps_along_a_path_are_equilibria_under_the_loads_found(way, seed):
    """An unknown goes by what is asked, or steps have a length; neighbours turn the loads."""
    units = seed % 3
    awkward = Awkward(seed, moving=way != "directions", line_laws=LINES[:1], steps=12, units=units)
    problem, (force, length) = awkward.problem(), UNITS[awkward.units]
    ends, loading = problem.times[[0, -1]], problem.loading
    curves = tuple((ends, np.array([0.0, k + 1.0])) for k in range(len(loading.curves)))
    problem = replace(problem, loading=replace(loading, curves=curves))
    late = 0.0 if way == "arc" else 5.0  # arcs know of no load that time changes but its curves
    bulk, follows = following_bulk(problem, force, length, late=late)
    recorder, by = Recorder(40), 3e-4 * length
    run = BulkRun(problem, bulk, bulk.begin((), problem.u, 0.0), (recorder,))
    asked = by * np.linspace(0.5, 1.5, 12)
    if (way, seed) == SNAPS:
        with refusal(ConvergenceError, "kernel.plasticity.step-time-no-point") as told:
            follow_directions(run, 1, asked, lambda x: partial(a_share, by=x))
        assert told.value.data["k"] == len(recorder.snapshots) == 5
        assert run.motion.t[1, -1] == pytest.approx(POINTS[1]["FU"] * force, rel=1e-3)
        assert asked[:4].sum() < run.motion.u[2] - problem.u[2] < asked[:5].sum()
        return
    if way == "directions":
        path, trace = follow_directions(run, 1, asked, lambda x: partial(a_share, by=x))
        curves = (*curves[:-1], (problem.times, np.array(trace.parameters)))
        near(np.diff(recorder.of("u")[:, 2]), asked, by)
    elif way == "time":
        run.problem = replace(problem, times=problem.times[::6])
        path, trace = follow_time(run, lambda _: partial(a_share, by=-by), 6, 1)
    else:
        rate = (1.0 + np.arange(len(curves))) / ends[1]
        lengths = Lengths(0.1, 1e-4, 0.5, u_ref=1e-3 * length, t_ref=float(ends[1]))
        path, trace = follow_arc(run, rate, lengths, lambda t: t < 0.5 * ends[1], 40, 1)
    found = replace(problem, loading=replace(loading, curves=curves))
    history, times = history_of(path, trace, 0.0), np.array(trace.times)
    near([i.time for i in recorder.snapshots], times, times[-1], 1e-14)
    check_steps(found, times, history.energies, recorder.snapshots, True, follows)


def parts_of(patch):
    """What adapted steps are made of: a list that fills with (end, state) of accepted parts."""
    parts, run, step = [], SparseSteps.run, AdaptiveLoop._step

    def run_one(loop, *given):
        outcome = run(loop, *given)
        parts.append((loop.newmark.dt, Motion(*(x.copy() for x in loop.motion))))
        return outcome

    def step_one(loop, *given):
        tried = len(parts)
        outcome = step(loop, *given)
        if len(parts) > tried + 1:
            del parts[tried]  # it was split
        return outcome

    patch.setattr(SparseSteps, "run", run_one)
    patch.setattr(AdaptiveLoop, "_step", step_one)
    return parts


def test_parts_of_adapted_steps_are_those_of_the_equations():
    """In each joints stay open or closed, but for the shortest ones."""

    @settings(BRIEF, max_examples=4)
    @given(problems(steps=25))
    def holds(awkward):
        problem = awkward.problem()
        problem = replace(problem, scheme=replace(problem.scheme, adaptive=True))
        recorder = Recorder(len(problem.times))
        with pytest.MonkeyPatch.context() as patch:
            parts = parts_of(patch)
            history = integrate(problem, [recorder])
        assert history.loop == "adaptive"
        instants = [recorder.snapshots[0], *(state for _, state in parts)]
        lengths = np.array([dt for dt, _ in parts])
        times = np.cumsum([problem.times[0], *lengths])
        energies = np.array([history.energies[0], *(state.energies for _, state in parts)])
        check_steps(problem, times, energies, instants)
        ends = np.abs(times - problem.times[:, None]).argmin(axis=1)
        near(times[ends], problem.times, problem.times[-1], 1e-12)
        near(energies[ends], history.energies, np.abs(energies).max(), 1e-12)
        near(recorder.of("u"), [instants[k].u for k in ends], 1.0, 1e-15)
        whole = np.diff(problem.times)[np.searchsorted(ends, np.arange(1, len(times))) - 1]
        halvings = np.log2(whole / lengths)
        near(halvings, halvings.round(), 1.0)
        closed = np.array([i.t[:, -1] < 0.0 for i in instants])
        changed = (closed[1:] != closed[:-1]).any(axis=1)
        assert changed.any()
        assert (halvings.round()[changed] == 5).all()
        assert set(halvings.round()) >= {0, 1, 5}

    holds()


def test_reduced_steps_on_all_vectors_are_those_of_the_equations():
    @settings(BRIEF, max_examples=4)
    @given(problems())
    def holds(awkward):
        problem = awkward.problem()
        recorder = Recorder(len(problem.times))
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(reduced, "MOST_VECTORS", 1.0)
            patch.setattr(reduced, "GROWTH", 1.0)
            reduced._PAIRS.clear()
            history = reduced.integrate_reduced(problem, 1e-9, [recorder])
        assert (history.loop, history.reduction.refused) == ("reduced", None)
        assert history.reduction.vectors == problem.constraints.T.shape[1]
        check_steps(problem, problem.times, history.energies, recorder.snapshots)

    holds()


def test_conserving_steps_keep_the_energy_and_the_mean_velocity():
    """To rounding with the laws that have a work of their own."""

    @settings(BRIEF)
    @given(problems(line_laws=LINES[:1]))
    def holds(awkward):
        problem = replace(awkward.problem(), scheme=Scheme(conserving=True))
        recorder, history = recorded(problem)
        assert history.loop == "conserving"
        u, v = recorder.of("u"), recorder.of("v")
        mean = np.diff(problem.times)[:, None] * (v[1:] + v[:-1]) / 2
        near(np.diff(u, axis=0), mean, np.abs(u).max())
        K, M, C = problem.K, problem.M, problem.C
        energy = np.abs(history.energies).max()
        near(history.energies[:, KINETIC], 0.5 * np.vecdot(v, v @ M.toarray()), energy)
        near(history.energies[:, ELASTIC], 0.5 * np.vecdot(u, u @ K.toarray()), energy)
        rate = np.diff(u, axis=0) / np.diff(problem.times)[:, None]
        damped = np.vecdot(np.diff(u, axis=0), rate @ C.toarray())
        near(np.diff(history.energies[:, DAMPED]), damped, energy)
        near(history.imbalance, 0.0, energy)
        rows = problem.constraints.C.toarray()
        factors = np.stack([np.interp(problem.times, x, y) for x, y in problem.loading.curves])
        near(u[1:] @ rows.T, (problem.loading.imposed @ factors).T[1:], np.abs(u).max())
        F = (problem.loading.forces @ factors).T
        a = np.diff(v, axis=0) / np.diff(problem.times)[:, None]
        near(recorder.of("a")[1:], a, np.abs(a).max())
        parts = a @ M.toarray() + rate @ C.toarray() + 0.5 * (u[1:] + u[:-1]) @ K.toarray()
        rest, reaction = parts - 0.5 * (F[1:] + F[:-1]), recorder.of("reaction")[1:]
        push = np.abs(F).max() + np.abs(parts).max()
        near(reaction @ la.null_space(rows), 0.0, push)
        joints, J = reaction - rest, problem.interface.J.toarray()
        kept = np.diff(history.energies[:, STORED] + history.energies[:, LOST])
        near(np.vecdot(joints, np.diff(u, axis=0)), kept, energy)
        near(joints - joints @ la.pinv(J) @ J, 0.0, push)
        work = np.vecdot(np.diff(u, axis=0), 0.5 * (F[1:] + F[:-1]))
        support = np.vecdot(np.diff(u, axis=0) @ rows.T, reaction @ la.pinv(rows))
        near(np.diff(history.energies[:, EXTERNAL]), work + support, energy)

    holds()
