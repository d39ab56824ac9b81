"""A ground by its memory against the whole model: without truncation steps are the same ones."""

from copy import copy
from dataclasses import replace

import numpy as np
import pytest
from references.recorder import Recorder
from references.soil_block import FRICTION, soil_block
from references.whole_and_reduced import relative

from ssilang.io.memory_file import MemoryFile
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.scientific import spla
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.low_rank import add_low_rank_product, low_rank
from ssilang.kernel.stepping import keeping
from ssilang.kernel.stepping.extremes import Extremes
from ssilang.kernel.stepping.newmark import Scheme, hht
from ssilang.kernel.stepping.problem.problem import closed_stiffness
from ssilang.kernel.stepping.rests.memory import kernels, run
from ssilang.kernel.stepping.rests.memory.ground import parts_of
from ssilang.kernel.stepping.rests.memory.kernels import NEAR
from ssilang.kernel.stepping.rests.memory.past import Past
from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC
from ssilang.kernel.stepping.track import Track

STEPS, SIZE = 150, (16, 6, 4)


def record(seed=1, strength=1.0, edges=5e5, stiffer=1.0, heavier=1.0, **given):
    """The block at rest on its soil between edges that absorb, under six sines of a seed."""
    problem = soil_block(**{"steps": STEPS, "size": SIZE, **given})
    problem = replace(problem, K=stiffer * problem.K, M=heavier * problem.M)
    numbering, T = problem.numbering, problem.constraints.T
    x = numbering.table.coordinates[numbering.nodes, 0]
    edge = np.where(np.abs(np.abs(x) - SIZE[0] / 2) < 1e-9, edges, 0.0)
    random, t = np.random.default_rng(seed), problem.times
    waves = [
        random.uniform(1, 3) * np.sin(2 * np.pi * f * t + random.uniform(0, 6))
        for f in random.uniform(0.8, 4, 6)
    ]
    curve = (t, strength * sum(waves) * np.minimum(1.0, t / 0.2))
    loading = replace(problem.loading, curves=(problem.loading.curves[0], curve))
    u = T @ spla.spsolve(sp.csc_array(closed_stiffness(problem)), T.T @ loading.forces[:, 0])
    C = sp.csr_array(problem.C + sp.diags_array(edge))
    return replace(problem, loading=loading, C=C, u=u)


def with_another_load(problem):
    """The same with the sines on other places of the soil."""
    turned = problem.loading.forces.copy()
    turned[:, 1] = np.roll(turned[:, 1], 2)
    return replace(problem, loading=replace(problem.loading, forces=turned))


def building(problem):
    """Unknowns of the block, and of the soil's side of the joints."""
    y = problem.numbering.table.coordinates[problem.numbering.nodes, 1]
    return np.flatnonzero(y >= -1e-9)[np.abs(x_of(problem)[y >= -1e-9]) <= SIZE[2] / 2]


def x_of(problem):
    return problem.numbering.table.coordinates[problem.numbering.nodes, 0]


def as_they_come(name, shape, rows):
    return rows


def track(problem, unknowns=None):
    wanted = np.arange(len(problem.times)) % 2 == 0
    return Track(wanted, building(problem) if unknowns is None else unknowns)


def beside_the_whole(problem, tolerance, file):
    """What was kept of the whole run and of that on the memory, the history of each."""
    whole, found = track(problem), track(problem)
    exact = integrate(problem, [whole])
    return whole, found, exact, integrate_reduced(problem, tolerance, [found], shelf=file)


def errors(whole, found, at=None):
    """Of jumps, tractions, displacements, velocities and accelerations."""
    at = whole.unknowns if at is None else at
    pairs = [
        (x.joints("w"), x.joints("t"), *(x.values(n, at) for n in "uva")) for x in (found, whole)
    ]
    return [relative(a, b) for a, b in zip(*pairs, strict=True)]


@pytest.fixture
def file(tmp_path):
    run._KEPT.clear()
    return MemoryFile(tmp_path / "ground.npz")


@pytest.fixture(scope="module")
def memories():
    """Memories that runs have made, to 1e-4, by their steps: in the process, and as a file."""
    return {}


@pytest.fixture
def made(file, memories):
    """The file that a run of so many steps has made; the process has its memory, too."""

    def of(steps=STEPS):
        if steps not in memories:
            integrate_reduced(record(steps=steps), 1e-4, [], shelf=file)
            memories[steps] = run._KEPT.copy(), file.path.read_bytes()
        run._KEPT[:], content = memories[steps]
        file.path.write_bytes(content)
        return file

    return of


@pytest.mark.parametrize(
    ("scheme", "given"),
    [
        (Scheme(), {}),
        (hht(0.2), {"damping": None}),
        (Scheme(), {"edges": 0.0, "extra_damping": 0.02}),
    ],
    ids=["dashpots", "no Rayleigh damping, HHT", "a damping of its own"],
)
def test_memory_without_truncation_is_the_whole_model(file, scheme, given):
    problem = record(scheme=scheme, strength=1.5, **given)
    whole, found, exact, history = beside_the_whole(problem, 1e-4, file)
    assert (history.loop, history.reduction.refused) == ("memory", None)
    assert "by its memory" in str(history.method)
    assert whole.joints("w")[..., 1].max() > 1e-2  # it lifts off
    ground = np.flatnonzero(np.asarray(problem.interface.J.sum(axis=0)).ravel() < 0.0)
    errors_above = errors(whole, found, np.setdiff1d(whole.unknowns, ground))
    assert max(errors_above[:4]) < 2e-5
    assert errors_above[4] < 5e-4
    *_, moved, velocity, acceleration = errors(whole, found, ground)
    forgetful = scheme == Scheme()  # of what alternates
    assert moved < 2e-5
    assert velocity < (2e-2 if forgetful else 2e-5)
    assert acceleration < (0.5 if forgetful else 5e-4)
    assert history.reduction.estimate < 5e-6
    assert relative(history.energies[:, 2:4], exact.energies[:, 2:4]) < 1e-4


def tied(problem):
    """The same with one motion along the joints at two of the block's lower nodes."""
    T = sp.csr_array(problem.constraints.T)
    one, other = (int(T[[i]].indices[0]) for i in _upper(problem)[[0, 4]])
    merged = sp.lil_array(sp.eye_array(T.shape[1]))
    merged[other, one] = 1.0
    constraints = copy(problem.constraints)
    kept = np.delete(np.arange(T.shape[1]), other)
    T = constraints.T = constraints.V = sp.csr_array(T @ sp.csr_array(merged)[:, kept])
    problem = replace(problem, constraints=constraints)
    K = sp.csc_array(closed_stiffness(problem))
    return replace(problem, u=T @ spla.spsolve(K, T.T @ problem.loading.forces[:, 0]))


@pytest.mark.parametrize(
    ("threads", "changed"), [(1, replace), (2, replace), (2, tied)], ids=["1", "2", "tied"]
)
def test_blocks_of_compliances_lead_to_the_same_steps(monkeypatch, file, threads, changed):
    """Where joints are soft beside what they join, whatever the number of processors is."""
    monkeypatch.setattr(run, "MANY", 9)
    monkeypatch.setattr("ssilang.kernel.solvers.low_rank.CLUSTER", 8)
    monkeypatch.setattr("ssilang.kernel.base.threads.cores", lambda: threads)
    loops, made = [], run.MemoryLoop
    monkeypatch.setattr(run, "MemoryLoop", lambda *given: loops.append(made(*given)) or loops[-1])
    problem = changed(record(strength=1.5))
    whole, found, exact, history = beside_the_whole(problem, 1e-4, file)
    assert all(len(x.plan.condensed.blocks.values) for x in loops)
    assert all(bool(len(x.plan.blocks.values)) == (changed is replace) for x in loops)
    assert whole.joints("w")[..., 1].max() > 1e-2
    assert history.loop == "memory"
    assert max(errors(whole, found)[:3]) < 2e-5
    assert relative(history.energies[:, 2:4], exact.energies[:, 2:4]) < 1e-4
    stiff = changed(record(steps=20, joint=FRICTION | {"KN": 1e3 * FRICTION["KN"]}))
    integrate_reduced(stiff, 1e-4, [], shelf=file)
    assert not len(loops[-1].plan.condensed.blocks.values)


def test_the_building_is_read_in_blocks_that_are_as_good_as_exact(monkeypatch, file):
    """Those of the compliance of its own side of the joints."""
    monkeypatch.setattr("ssilang.kernel.solvers.low_rank.CLUSTER", 16)
    loops, made = [], run.MemoryLoop
    monkeypatch.setattr(run, "MemoryLoop", lambda *given: loops.append(made(*given)) or loops[-1])
    problem = record(size=(80, 3, 64), dt=1e-3, steps=3)
    for many in (9, 1000):
        monkeypatch.setattr(run, "MANY", many)
        assert integrate_reduced(problem, 0.5, [], shelf=file).loop == "memory"
    blocks, plan = loops[0].plan.blocks, loops[-1].plan
    assert (blocks.ranks[:, 1] > 0).any()
    assert (blocks.ranks[:, 0] == blocks.ranks[:, 1]).any()
    assert not len(plan.blocks.values)
    exact = np.zeros((len(plan.Yr), len(plan.Yr)))
    exact[:, plan.Jr.indices] = plan.Yr / plan.Jr.data
    left = np.linalg.norm(_dense(blocks) - exact, 2)
    assert left < 1e-9 * np.linalg.norm(exact, np.inf)


def test_what_is_left_of_a_step_is_taken_to_the_next(monkeypatch, file):
    """Jumps of which much is left in each step do not drift: a third of what that adds up to."""
    monkeypatch.setattr(run, "MANY", 9)
    monkeypatch.setattr(run, "LEFT", 10.0)
    whole, found, _, _ = beside_the_whole(record(strength=1.5), 1e-4, file)
    jumps, _, displacements, *_ = errors(whole, found)
    assert 1e-5 < jumps < 2.5e-4
    assert displacements < 2e-4


def test_energies_are_those_of_what_stands_on_the_ground(file):
    """Masses and springs of the block alone, and what loads and the ground give it."""
    problem = record(strength=1.5)
    whole, _, exact, history = beside_the_whole(problem, 1e-4, file)
    y = problem.numbering.table.coordinates[problem.numbering.nodes, 1]
    block = np.setdiff1d(building(problem), np.flatnonzero(problem.constraints.T.sum(axis=1) == 0))
    block = block[(y[block] > 0.0) | np.isin(block, _upper(problem))]
    for name, A, kind in (("v", problem.M, KINETIC), ("u", problem.K, ELASTIC)):
        x, own = whole.values(name, block), A[block][:, block]
        energy = 0.5 * np.einsum("ki,ki->k", x, (own @ x.T).T)
        assert relative(history.energies[::2, kind], energy) < 1e-4
    lost = np.abs(history.imbalance - exact.imbalance).max()
    assert lost < 1e-4 * history.largest_energy
    assert np.ptp(history.energies[:, EXTERNAL]) > 0.1 * history.largest_energy
    assert history.energies[-1, DAMPED] > 0.0


def _upper(problem):
    """Unknowns on the block's side of the joints."""
    return np.flatnonzero(np.asarray(problem.interface.J.sum(axis=0)).ravel() > 0.0)


def test_steps_are_as_many_at_a_time_as_what_stands_on_the_ground_lets(made, monkeypatch):
    """Not the ground's unknowns, which nobody steps."""
    file, problem, asked = made(), record(2), []
    far = parts_of(problem, np.zeros(problem.numbering.size, bool)).ground.T.shape[1]
    stride = keeping.stride_of
    monkeypatch.setattr(
        keeping, "stride_of", lambda done, n, every: asked.append(n) or stride(done, n, every)
    )
    assert integrate_reduced(problem, 1e-4, [], shelf=file).loop == "memory"
    assert set(asked) == {problem.constraints.T.shape[1] - far}


WIDE = {"size": (28, 10, 16), "dt": 2.5e-3}
TRUNCATED = 0.2


@pytest.fixture(scope="module")
def truncated(tmp_path_factory):
    """The memory of a ground whose later kernels are few vectors, and runs on it."""
    run._KEPT.clear()
    file = MemoryFile(tmp_path_factory.mktemp("suite") / "ground.npz")
    return file, beside_the_whole(record(**WIDE), TRUNCATED, file)


def test_truncated_kernels_are_as_good_as_they_say(truncated):
    file, (whole, found, _, history) = truncated
    kept = file.read()
    assert kept.stages
    assert all(s.P.shape[1] < kept.size for s in kept.stages)
    assert kept.tolerance == run.SHARE * TRUNCATED  # good enough at once
    assert 5e-5 < history.reduction.estimate <= TRUNCATED
    told, error, rounding = history.reduction.estimate, errors(whole, found)[0], 1e-7
    assert 0.5 * (error - rounding) < told < 2.0 * (error + rounding)
    assert max(errors(whole, found)[:3]) <= 1e-2 * TRUNCATED
    assert history.reduction.vectors == kept.size + sum(s.P.shape[1] for s in kept.stages)


def _dense(A):
    """The matrix whose blocks these are."""
    found = np.zeros((len(A.order), len(A.order)))
    for x, row in zip(np.eye(len(found)), found, strict=True):
        add_low_rank_product(A, False, x, row)
    return found


def _sums(kernels, steps):
    """How far impulses have moved the jumps (steps, q, q), as the memory has it."""
    found = np.zeros((steps, kernels.size, kernels.size))
    found[0] = kernels.first
    for k, A in enumerate(kernels.sums, 1):
        found[k:] = _dense(A)
    for stage in kernels.stages:
        for k, core in enumerate(stage.sums, stage.first):
            found[k:] = stage.P.astype(float) @ core @ stage.P.T
    return found


@pytest.fixture(scope="module")
def wide_ground():
    """The ground of a wide block, and how far impulses on each joint have moved the jumps."""
    problem = record(**WIDE)
    ground = parts_of(problem, np.zeros(problem.numbering.size, bool)).ground
    forces = np.ascontiguousarray(ground.steps.J.T.todense())
    moved = kernels.increments(ground.steps, kernels.impulse(forces, STEPS))
    return ground, np.cumsum(np.array(list(moved), float), axis=0)


@pytest.mark.parametrize("probes", [4, 64])
def test_few_probes_tell_what_impulses_on_each_joint_do(monkeypatch, wide_ground, probes):
    """Against columns of the identity; something is left out of sums, and no more than said."""
    monkeypatch.setattr(kernels, "PROBES", probes)
    ground, exact = wide_ground
    made = kernels.kernels_of(ground, 1e-2, STEPS, as_they_come)
    assert len(made.stages) > 1
    assert made.stages[0].P.shape[1] < made.size
    left = np.linalg.norm(_sums(made, STEPS) - exact, 2, axis=(1, 2))
    size = np.linalg.norm(exact[0], 2)
    assert left[0] < 1e-4 * size
    assert 1e-4 * size < left.max() < 1e-2 * size


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_blocks_of_near_sums_leave_out_what_is_said(monkeypatch, file, wide_ground, tolerance):
    """A quarter of the tolerance, of the norm of the first kernel; and something of it."""
    monkeypatch.setattr("ssilang.kernel.solvers.low_rank.CLUSTER", 8)
    ground, exact = wide_ground
    made = kernels.kernels_of(ground, tolerance, STEPS, as_they_come)
    near = len(made.sums) + 1
    left = np.linalg.norm(_sums(made, STEPS)[1:near] - exact[1:near], 2, axis=(1, 2)).max()
    said = 0.25 * tolerance * np.linalg.norm(exact[0], 2)
    assert 0.05 * said < left < said
    file.write(made)
    for one, other in zip(made.sums, file.read().sums, strict=True):
        for part, same in zip(one, other, strict=True):
            np.testing.assert_array_equal(part, same)
    assert len({A.ranks.tobytes() for A in made.sums}) > 1


def test_places_are_those_of_both_sides_of_the_joints(wide_ground):
    """One of each pair, in the order of the jumps."""
    problem, places = wide_ground[0].problem, wide_ground[0].places
    J, numbering = problem.interface.J, problem.numbering
    assert 2 * len(places) == J.shape[0]
    for row, at in enumerate(np.repeat(places, 2, axis=0)):
        nodes = numbering.nodes[J[[row]].indices]
        np.testing.assert_allclose(numbering.table.coordinates[nodes], [at, at], atol=1e-12)


@pytest.mark.parametrize("between", [0, 1])
def test_kernels_may_have_more_vectors_again(monkeypatch, wide_ground, between):
    """After steps of few vectors, or of none: each sum stays in its step."""
    ground = wide_ground[0]
    q, random = ground.J.shape[0], np.random.default_rng(6)
    U = np.linalg.qr(random.standard_normal((q, q)))[0]
    count = np.repeat([q, between, q], [9, 2, 6])
    sums = [(U[:, :n] * random.uniform(1.0, 2.0, n)) @ U[:, :n].T for n in count]
    monkeypatch.setattr(
        kernels, "_answers_to_probes",
        lambda ground, probes, *_: [np.asarray(A @ probes, np.float32) for A in sums],
    )  # fmt: skip
    made = kernels.kernels_of(ground, 1e-2, len(sums), as_they_come)
    np.testing.assert_allclose(_sums(made, len(sums))[:9], sums[:9], atol=1e-4)
    np.testing.assert_allclose(_sums(made, len(sums))[11:], sums[11:], atol=1e-4)


def test_a_making_that_is_broken_off_goes_on(monkeypatch, wide_ground):
    """Piece by piece, to the same numbers; of another step or tolerance nothing is taken over."""
    monkeypatch.setattr(kernels, "PROBES", 4)
    monkeypatch.setattr(kernels, "COLUMNS", 3)
    left, made = {}, []

    def answered(name, shape, rows, most=10**6):
        if name not in left:
            if len(left) >= most:
                raise KeyboardInterrupt
            rows = list(rows)
            assert np.shape(rows)[1:] == shape
            left[name], _ = rows, made.append(name)
        yield from left[name]

    def until(most, tolerance=1e-2, changed=replace, **given):
        made.clear()
        problem = changed(record(**WIDE | given))
        ground = parts_of(problem, np.zeros(problem.numbering.size, bool)).ground
        return kernels.kernels_of(
            ground, tolerance, 60, lambda *asked: answered(*asked, most=most)
        )  # fmt: skip

    exact = kernels.kernels_of(wide_ground[0], 1e-2, 60, as_they_come)
    with pytest.raises(KeyboardInterrupt):
        until(3)
    first = len(made)
    assert first in (3, 4)  # two at once
    found = until(10**6)
    assert len(made) == len(left) - first > 3
    for a, b in ((exact, found), (exact, until(10**6))):
        np.testing.assert_array_equal(a.first, b.first)
        np.testing.assert_array_equal(a.loads, b.loads)
        for one, other in zip(a.sums, b.sums, strict=True):
            np.testing.assert_array_equal(one.values, other.values)
        assert len(a.stages) == len(b.stages) > 0
        for one, other in zip(a.stages, b.stages, strict=True):
            np.testing.assert_array_equal(one.sums, other.sums)
    assert not made
    until(10**6, dt=2e-3)
    assert made
    until(10**6, tolerance=1e-3)
    assert made
    until(10**6, changed=with_another_load)
    assert made


@pytest.mark.parametrize("threads", [1, 2])
def test_making_says_how_far_it_is(monkeypatch, wide_ground, threads):
    """Columns times steps, to the last one; what is left comes nearer to what is left."""
    monkeypatch.setattr(kernels, "PROBES", 4)
    monkeypatch.setattr("ssilang.kernel.base.threads.cores", lambda: threads)
    told, stepped = [], []

    def kept(name, shape, rows):
        for row in rows:
            stepped.append(shape[1])
            yield row

    kernels.kernels_of(wide_ground[0], 1e-2, STEPS, kept, lambda *now: told.append(now))
    done, total = np.array(told).T
    assert (done[-1], total[-1]) == (sum(stepped), sum(stepped))
    assert (np.sort(done) == done).all()
    assert (total >= done).all()
    left, guess = sum(stepped) - done, total - done
    last = left < 0.5 * sum(stepped)
    assert (guess[last] <= 3.0 * left[last]).all()
    assert (guess[last] >= 0.5 * left[last]).all()


def test_ground_whose_patterns_all_count_is_kept_whole(monkeypatch, wide_ground):
    """What an impulse has moved for good stays."""
    monkeypatch.setattr(kernels, "FEW", 0.0)
    made = kernels.kernels_of(wide_ground[0], 1e-2, 20, as_they_come)
    assert (made.stages, len(made.sums)) == ((), 19)
    assert np.diff([made.first, *map(_dense, made.sums)], axis=0).any(axis=(1, 2)).all()


MANY_STAGES = tuple((12 + 2 * k, 1 + k % 3, 2) for k in range(19))


@pytest.mark.parametrize("staged", [((12, 2, 9), (21, 1, 6)), (), MANY_STAGES])
def test_convolution_is_that_of_sums_which_last(staged):
    """Of kernels by hand: whole ones, stages, what impulses have moved for good."""
    random, q, steps = np.random.default_rng(4), 3, 70

    def symmetric(count, r):
        found = random.standard_normal((count, r, r))
        return found + found.transpose(0, 2, 1)

    sums, stages = symmetric(12, q), []
    for first, r, count in staged:
        P = np.linalg.qr(random.standard_normal((q, r)))[0]
        stages.append(kernels.Stage(first, P, symmetric(count, r)))
        sums = np.concatenate([sums, P @ stages[-1].sums @ P.T])
    near = tuple(low_rank(A, np.zeros((q, 1)), 0.0, 0.0) for A in sums[1:12])
    loads = random.standard_normal((5, q, 2))
    mark = np.zeros(1)
    patterns = np.linalg.qr(random.standard_normal((4, 2)))[0]
    past_of = kernels.Kernels(
        mark, 0.01, 1e-3, sums[0], near, tuple(stages), loads, patterns, mark, 0
    )
    factors = random.standard_normal((steps + 1, 2))
    past = Past(past_of, factors @ patterns.T, steps)
    forces = random.standard_normal((steps, q))
    lasting = np.concatenate([sums, np.repeat(sums[-1:], steps, axis=0)])
    of_steps = np.diff(lasting, axis=0, prepend=0.0)
    for n in range(steps):
        known = [forces[n], *forces[n::-1]]  # at the end of this step as at its start
        brought = -sum(G @ f for G, f in zip(of_steps, known, strict=False))
        brought = brought + sum(A @ c for A, c in zip(loads, factors[n + 1 : 0 : -1], strict=False))
        np.testing.assert_allclose(past.next(forces[n]), brought, rtol=2e-4, atol=2e-4)


def test_rounding_of_increments_adds_up_to_little():
    """Forces that stay: what kernels of single precision bring in each step is summed in double."""
    random, q, steps = np.random.default_rng(1), 600, 200
    sums = random.uniform(0.5, 1.0, (9, q, q))
    sums, mark = sums + sums.transpose(0, 2, 1), np.zeros(1)
    near = [low_rank(A, np.zeros((q, 1)), 0.0, 0.0) for A in sums[1:]]
    whole = np.diff(sums.astype(np.float32).astype(float), axis=0, prepend=0.0, append=0.0)
    stage = kernels.Stage(9, np.eye(q, 1, dtype=np.float32), np.zeros((3, 1, 1), np.float32))
    loads, patterns = np.zeros((1, q, 1), np.float32), np.ones((1, 1))
    first = sums[0].astype(np.float32)
    made = kernels.Kernels(
        mark, 0.01, 1e-3, first, tuple(near), (stage,), loads, patterns, mark, 0
    )  # fmt: skip
    past = Past(made, np.zeros((steps + 1, 1)), steps)
    history = 1.0 + 0.3 * np.sin(0.3 * np.arange(steps))
    forces = np.outer(history, random.uniform(1.0, 2.0, q)).astype(np.float32).astype(float)
    away, largest = np.zeros(q), 0.0
    for n in range(steps):
        known = [forces[n], *forces[n::-1]]
        exact = -sum(G @ f for G, f in zip(whole, known, strict=False))
        away += past.next(forces[n]) - exact
        largest = max(largest, float(np.abs(away).max()))
    assert largest < 2e-5 * np.abs(whole[0] @ forces[0]).max()


def test_forces_that_stay_bring_nothing_once_all_sums_have_them():
    """Changes are those of the forces, not of what single precision has of these."""
    random, q, mark = np.random.default_rng(2), 7, np.zeros(1)
    sums = random.uniform(0.5, 1.0, (9, q, q)).astype(np.float32)
    sums += sums.transpose(0, 2, 1)
    near = tuple(low_rank(A, np.zeros((q, 1)), 0.0, 0.0) for A in sums[1:])
    stage = kernels.Stage(9, np.eye(q, 1, dtype=np.float32), np.zeros((3, 1, 1), np.float32))
    loads, patterns = np.zeros((1, q, 1), np.float32), np.ones((1, 1))
    made = kernels.Kernels(mark, 0.01, 1e-3, sums[0], near, (stage,), loads, patterns, mark, 0)
    past, forces = Past(made, np.zeros((41, 1)), 40), random.uniform(1.0, 2.0, q)
    brought = np.array([past.next(forces) for _ in range(40)])
    assert brought[:8].any(axis=1).all()
    assert not brought[8:].any()


@pytest.mark.parametrize("elsewhere", [True, False], ids=["another process", "the same"])
def test_a_memory_serves_other_motions(truncated, elsewhere):
    file, stamp = truncated[0], truncated[0].path.stat().st_mtime_ns
    run._KEPT.clear()
    if not elsewhere:
        run._KEPT.append(file.read())
    problem = record(2, **WIDE)
    rounded = problem.loading.forces * (1.0 + 1e-14)  # as another number of threads sums them
    loading = replace(problem.loading, forces=rounded)
    problem = replace(problem, loading=loading, K=problem.K * (1.0 - 1e-14))
    whole, found, _, history = beside_the_whole(problem, TRUNCATED, file)
    assert history.loop == "memory"
    assert file.path.stat().st_mtime_ns == stamp
    assert max(errors(whole, found)[:3]) <= 1e-2 * TRUNCATED


def test_a_finer_tolerance_makes_it_anew(truncated, file):
    file.path.write_bytes(truncated[0].path.read_bytes())
    whole, found, _, history = beside_the_whole(record(2, **WIDE), 2e-3, file)
    assert history.reduction.estimate <= 2e-3
    assert max(errors(whole, found)[:3]) <= 2e-3
    assert file.read().tolerance < truncated[0].read().tolerance


@pytest.mark.parametrize(("tries", "loop"), [(1, "condensed"), (3, "memory")])
def test_a_memory_that_misses_the_tolerance_is_made_finer_or_told(file, monkeypatch, tries, loop):
    monkeypatch.setattr(run, "SHARE", 3000.0)
    monkeypatch.setattr(run, "TRIES", tries)
    whole, found, _, history = beside_the_whole(record(**WIDE), 1e-4, file)
    assert history.loop == loop
    assert max(errors(whole, found)[:3]) <= 1e-4
    if loop == "memory":
        assert history.reduction.estimate <= 1e-4
    else:
        assert "misses the tolerance (error" in str(history.reduction.refused)


@pytest.mark.parametrize(("steps", "again"), [(60, False), (120, True), (150, True), (400, True)])
def test_a_memory_serves_shorter_motions_and_grows_for_longer_ones(made, steps, again):
    """Of a ground that is as little at rest at the end as this one's; else any length goes."""
    file = made(100)
    before = file.path.read_bytes()
    whole, found, _, history = beside_the_whole(record(2, steps=steps), 1e-4, file)
    assert history.loop == "memory"
    assert max(errors(whole, found)[:3]) < 1e-4
    assert (file.path.read_bytes() != before) == again


def test_other_loads_on_the_ground_are_answered_anew(made):
    file, problem = made(), with_another_load(record(2))
    whole, found, _, _ = beside_the_whole(problem, 1e-4, file)
    assert max(errors(whole, found)[:3]) < 2e-5


def driven(mixed, steps=STEPS):
    """The block's record with twelve loads on its ground that follow so much of three motions."""
    problem = record(steps=steps)
    random, (weight, first) = np.random.default_rng(11), problem.loading.curves
    motions = np.array([np.roll(first[1], k) * np.minimum(1.0, first[0]) for k in (0, 7, 19)])
    curves = random.standard_normal((12, 3)) @ (np.array(mixed)[:, None] * motions)
    push = np.abs(problem.loading.forces[:, 1:])
    forces = np.hstack(
        [problem.loading.forces[:, :1], push * random.uniform(-1, 1, (len(push), 12))]
    )
    loading = replace(
        problem.loading, forces=forces, curves=(weight, *((first[0], c) for c in curves)),
        imposed=np.zeros((len(problem.loading.imposed), 13)),
    )  # fmt: skip
    contact = replace(problem.contact, imposed=np.zeros((0, 13)))
    return replace(problem, loading=loading, contact=contact)


def test_loads_that_follow_few_motions_are_few_patterns(file):
    """Others of these motions find them there; what is beside them is added, or small."""
    known = []
    for mixed, patterns in (
        ([3, -2, 0], 2), ([1, 2, 0], 2), ([1, 2, 1e-7], 2), ([-1, 0, 2], 3), ([2, 5, 1e-3], 3),
    ):  # fmt: skip
        problem = driven(mixed)
        whole, found, _, history = beside_the_whole(problem, 1e-4, file)
        assert history.loop == "memory"
        assert max(errors(whole, found)[:3]) < 2e-5
        made = file.read()
        assert made.patterns.shape == (13, patterns)  # and the weight
        known.append((made.loads, file.path.stat().st_mtime_ns))
    assert known[0][1] == known[2][1] < known[3][1] == known[4][1]
    np.testing.assert_array_equal(known[3][0][: len(known[0][0]), :, :2], known[0][0])
    np.testing.assert_allclose(made.patterns.T @ made.patterns, np.eye(3), atol=1e-12)


@pytest.mark.parametrize(("known", "made", "left"), [(0, 0, 0), (80, 0, 80), (80, 60, 60)])
def test_patterns_that_are_added_tell_as_many_steps_as_all_do(monkeypatch, known, made, left):
    """0: all of them, as these are quiet before."""
    problem, other = driven([1, 1, 0], 60), driven([1, 1, 1], 60)
    grounds = [parts_of(p, np.zeros(p.numbering.size, bool)).ground for p in (problem, other)]
    memory = kernels.kernels_of(grounds[0], 1e-2, 60, as_they_come)
    memory, answers = replace(memory, reach=known), kernels._answers
    monkeypatch.setattr(kernels, "_answers", lambda *given: (answers(*given)[0], made))
    assert kernels.with_loads(memory, grounds[1], 60, as_they_come).reach == left


def test_loads_are_followed_until_next_to_nothing_is_left():
    """A twentieth of the tolerance, of the largest answer; not for as long as the motion goes."""
    nowhere, steps = np.zeros(record().numbering.size, bool), 400
    first, second = record(steps=steps), with_another_load(record(steps=steps))
    memory = kernels.kernels_of(parts_of(first, nowhere).ground, 1e-2, NEAR, as_they_come)
    ground, told = parts_of(second, nowhere).ground, []
    made = kernels.with_loads(
        memory, ground, steps, as_they_come, lambda *progress: told.append(progress)
    )
    forces = np.asarray(ground.steps.forces @ made.patterns, np.float32)
    exact = np.array(list(kernels.increments(ground.steps, kernels.impulse(forces, steps))))
    followed, _, count = made.loads.shape
    assert followed < 0.5 * steps
    assert told == [(k * count, steps * count) for k in range(1, followed + 1)]
    np.testing.assert_array_equal(made.loads, exact[:followed])
    assert np.abs(exact[followed:]).max() < 0.05 * 1e-2 * np.abs(exact).max()


def test_a_short_motion_with_another_load_shortens_no_memory():
    """The next long one would have to make it anew."""
    nowhere = np.zeros(record().numbering.size, bool)
    first, second = record(steps=400), with_another_load(record(steps=30))
    memory = kernels.kernels_of(parts_of(first, nowhere).ground, 1e-2, 400, as_they_come)
    assert memory.reach == 0
    made = kernels.with_loads(memory, parts_of(second, nowhere).ground, 30, as_they_come)
    assert made.reach == 0
    assert len(made.loads) > 100
    held = kernels.with_loads(
        replace(memory, reach=60), parts_of(second, nowhere).ground, 30, as_they_come
    )  # fmt: skip
    assert (held.reach, len(held.loads)) == (60, 60)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("steps", [1, 2, 8])
def test_a_motion_of_few_steps_runs_on_a_memory(monkeypatch, file, steps, threads):
    """Fewer than kernels are near; before the end of one no force has changed to look at."""
    monkeypatch.setattr("ssilang.kernel.base.threads.cores", lambda: threads)
    problem = record(2, steps=steps, strength=20.0)
    whole, found = (track(problem, building(problem)) for _ in range(2))
    whole.wanted[:] = found.wanted[:] = True
    integrate(problem, [whole])
    assert integrate_reduced(problem, 1e-4, [found], shelf=file).loop == "memory"
    assert max(errors(whole, found)[:3]) < 1e-5


def test_a_ground_that_no_load_acts_on_answers_none():
    problem = record(steps=40)
    ground = parts_of(problem, np.zeros(problem.numbering.size, bool)).ground
    alone = replace(ground, loads=ground.loads[:0])
    made = kernels.kernels_of(alone, 1e-2, 40, as_they_come)
    assert made.loads.shape[1:] == (ground.J.shape[0], 0)
    assert (made.patterns.shape, made.loads_mark.size) == ((0, 0), 0)
    assert kernels.with_loads(made, alone, 40, as_they_come) is made


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"size": (18, 6, 4)}, "another mesh"),
        ({"stiffer": 1.001}, "other materials"),
        ({"heavier": 1.001}, "other materials"),
        ({"edges": 5.01e5}, "dashpots"),
        ({"scheme": hht(0.1)}, "another scheme"),
        ({"dt": 4e-3}, "for the step 0.005, not 0.004"),
    ],
)
def test_the_memory_of_another_ground_or_step_is_refused(made, given, told):
    file = made()
    before = file.path.read_bytes()
    for kept in ([], run._KEPT.copy()):
        run._KEPT[:] = kept
        with pytest.raises(KernelError, match=rf"ground\.npz is the memory .*{told}"):
            integrate_reduced(record(**given), 1e-4, [], shelf=file)
    assert file.path.read_bytes() == before


def _inside(problem):
    return [track(problem, np.arange(problem.numbering.size))]


def _fields(problem):
    return [Recorder(len(problem.times))]


def _moving(problem):
    problem.loading.imposed[:] = 1e-3
    return []


def _thrown(problem):
    problem.v[:] = 0.1
    return []


def _unbalanced(problem):
    problem.u[:] = 0.0
    return []


def _extremes(problem):
    return [Extremes(problem=problem)]


def _uneven(problem):
    problem.times[-1] += 1e-3
    return []


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (_inside, "results are asked of"),
        (_fields, "results are asked of"),
        (_extremes, "results are asked of"),
        (_moving, "supports move"),
        (_thrown, "does not start at rest"),
        (_unbalanced, "does not start at rest"),
        (_uneven, "steps of one length"),
    ],
)
def test_what_a_memory_does_not_describe_runs_whole_and_says_why(file, spoil, told):
    problem = record()
    observers = spoil(problem)
    history = integrate_reduced(problem, 1e-2, observers, shelf=file)
    assert told in str(history.reduction.refused)
    assert (history.loop, file.path.exists()) == ("condensed", False)


def test_a_building_without_mass_runs_whole(file):
    problem = record(strength=0.01)
    held = np.ones(problem.numbering.size)
    held[np.union1d(building(problem), _upper(problem))] = 0.0
    problem = replace(problem, M=sp.csr_array(sp.diags_array(held) @ problem.M), C=0.0 * problem.C)
    history = integrate_reduced(problem, 1e-2, [], shelf=file)
    assert "what stands on the ground has no mass" in str(history.reduction.refused)


def test_largest_values_come_from_the_whole_model(file):
    """The loop compares none: those that nobody asked for stay unknown."""
    problem = record()
    unasked = Extremes(problem=problem, asked=False)
    assert integrate_reduced(problem, 1e-4, [unasked], shelf=file).loop == "memory"
    assert not unasked.known


def test_bodies_that_hang_together_have_no_ground(file):
    problem = record()
    tie = sp.csr_array((problem.numbering.size, problem.numbering.size))
    lower, upper = building(problem)[0], _upper(problem)[0]
    tie = sp.csr_array(([1.0], ([lower], [upper])), shape=tie.shape)
    problem = replace(problem, C=sp.csr_array(problem.C + 1e3 * (tie + tie.T)))
    history = integrate_reduced(problem, 1e-2, [], shelf=file)
    assert "no body hangs on by its joints alone" in str(history.reduction.refused)
