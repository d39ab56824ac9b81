"""Bases trained by whole runs, on records that trained nothing, against the whole model."""

from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest
from references.recorder import Recorder
from references.soil_block import soil_block
from references.whole_and_reduced import relative

from ssilang.io.errors import InputError
from ssilang.io.training import TrainingFile
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.interface.response import interface_stiffness
from ssilang.kernel.stepping.newmark import Scheme, hht, newmark_of
from ssilang.kernel.stepping.rests.reduced import basis as reduced_basis
from ssilang.kernel.stepping.rests.reduced import run, trained
from ssilang.kernel.stepping.rests.reduced.basis import on_motions
from ssilang.kernel.stepping.rests.reduced.damping import split
from ssilang.kernel.stepping.rests.reduced.run import ReducedIntegration, integrate_reduced
from ssilang.kernel.stepping.rests.reduced.trace import Coordinates, Trace, comparing
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.times import Run

STEPS, SIZE = 150, (16, 6, 8)


def record(seed, **given):
    """The block on its soil between absorbing edges, under six sines of a seed."""
    problem = soil_block(**{"steps": STEPS, "size": SIZE, **given})
    numbering = problem.numbering
    x = numbering.table.coordinates[numbering.nodes, 0]
    edge = np.where(np.abs(np.abs(x) - SIZE[0] / 2) < 1e-9, 5e5, 0.0)
    random, (t, _) = np.random.default_rng(seed), problem.loading.curves[1]
    waves = [
        random.uniform(1, 3) * np.sin(2 * np.pi * f * t + random.uniform(0, 6))
        for f in random.uniform(0.8, 4, 6)
    ]
    curve = (t, sum(waves) * np.minimum(1.0, t / 0.2))
    loading = replace(problem.loading, curves=(problem.loading.curves[0], curve))
    return replace(problem, loading=loading, C=sp.csr_array(problem.C + sp.diags_array(edge)))


@pytest.fixture(scope="module")
def suite(tmp_path_factory):
    """A basis of 60 vectors that three records have trained."""
    file = TrainingFile(tmp_path_factory.mktemp("suite") / "basis.npz")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(trained, "VECTORS", 60)
        patch.setattr(trained, "FEWEST", 4)
        for seed in (1, 2, 3):
            history = integrate_reduced(record(seed), 5e-2, shelf=file)
            assert history.loop == "condensed"
    assert len(file.read().taught) == 3
    return file


def copy_of(file, folder):
    path = folder / "basis.npz"
    path.write_bytes(file.path.read_bytes())
    return TrainingFile(path)


def beside_the_whole(problem, tolerance, file):
    """What was kept of the whole run and of the reduced one, the history of each."""
    whole, found = Recorder(STEPS + 1), Recorder(STEPS + 1)
    exact = integrate(problem, [whole])
    return whole, found, exact, integrate_reduced(problem, tolerance, [found], shelf=file)


def test_a_record_that_trained_nothing_is_within_its_estimate(suite):
    stamp = suite.stamp()
    whole, found, exact, history = beside_the_whole(record(4), 5e-2, suite)
    assert (history.loop, suite.stamp()) == ("reduced", stamp)
    assert found.closed
    assert whole.of("w")[..., 1].max() > 1e-3  # it lifts off
    errors = [relative(found.of(x), whole.of(x)) for x in ("u", "w")]
    assert 1e-6 < max(errors) <= 1.2 * history.reduction.estimate <= 6e-2
    scale = np.abs(exact.energies).max()
    assert np.abs(history.energies - exact.energies).max() <= 5e-2 * scale
    assert np.abs(history.imbalance - exact.imbalance).max() <= 1e-2 * scale


class Watched(Coordinates):
    """Coordinates whose matrix is compared with the plain one whenever it changes."""

    seen: ClassVar = []

    def _tangent(self, D):
        super()._tangent(D)
        K = np.zeros((len(self.J), len(self.J)))
        interface_stiffness(self.joints, self._D, K)
        np.testing.assert_allclose(self._D, D, rtol=0, atol=0.02 * np.abs(D).max())
        plain = self.A + self.newmark.end * self.J.T @ K @ self.J
        self.seen.append(((D[:, -1, -1] == 0.0).sum(), relative(self._matrix, plain)))


@pytest.mark.parametrize(
    ("most", "scheme"),
    [(-1, Scheme()), (400, hht(0.3))],
    ids=["a damping of all bodies", "few dashpots"],
)
def test_newton_on_the_coordinates_steps_as_the_condensed_interface(
    suite, monkeypatch, most, scheme
):
    monkeypatch.setattr(reduced_basis, "split", lambda C, M, K, _: split(C, M, K, most))
    problem = replace(record(5), scheme=scheme)
    basis = trained.TrainedBasis(problem, suite.read())
    basis.meet(problem)
    model, joints = basis.model(), problem.interface.points
    one, two = (Trace(problem, model, np.ones(STEPS + 1, bool)) for _ in range(2))
    for part in comparing(problem.times):
        step = Watched(two._reduced, newmark_of(problem.scheme, part.dt), joints)
        two._steps[part.dt] = step
        a, b = one.advance(part), two.advance(part)
        for name in ("u", "w", "t", "state", "jumps"):
            assert relative(getattr(b.rows, name), getattr(a.rows, name)) < 1e-7
    assert relative(two.energies, one.energies) < 1e-8
    V = problem.constraints.T @ basis.vectors.T @ model.X
    assert relative(step.C, V.T @ (problem.C @ V)) < 1e-9
    opened, errors = np.array(Watched.seen).T
    Watched.seen.clear()
    assert opened.max() > opened.min()
    assert errors.max() < 1e-5


def test_more_joints_than_vectors(suite, monkeypatch, tmp_path):
    """Vectors cut to fewer than the unknowns of the joints: both ways of stepping meet."""
    few = replace(suite.read(), vectors=suite.read().vectors[-12:])
    file = TrainingFile(tmp_path / "few.npz")
    file.write(few)
    whole, found, _, history = beside_the_whole(record(4), 0.9, file)
    assert history.loop == "reduced"
    assert relative(found.of("w"), whole.of("w")) <= 1.2 * history.reduction.estimate


def test_answers_to_what_is_out_of_balance_reach_the_tolerance_and_stay(suite, tmp_path):
    file, tolerance = copy_of(suite, tmp_path), 2e-4
    for seed, kept in ((8, "learns"), (9, "has learnt")):
        trained._LAST.clear()  # as another process would read it
        stamp = file.stamp()
        whole, found, _, history = beside_the_whole(record(seed), tolerance, file)
        assert history.loop == "reduced"
        assert max(relative(found.of(x), whole.of(x)) for x in ("u", "w")) <= 1.2 * tolerance
        assert (file.stamp() != stamp) == (kept == "learns")
    now, before = file.read(), suite.read()
    assert now.taught == before.taught
    np.testing.assert_array_equal(now.vectors, before.vectors)
    assert len(now.answers) >= trained.ANSWERS


@pytest.mark.parametrize("begun", [0, 70])
def test_a_motion_goes_on_as_if_it_had_had_more_vectors_from_the_start(suite, begun):
    problem = record(5)
    basis = trained.TrainedBasis(problem, suite.read())
    basis.meet(problem)
    dt, kept = float(problem.times[1]), np.ones(STEPS + 1, bool)
    one = Trace(problem, basis.model(), kept)
    before = one.advance(Run(0, begun, dt)).rows if begun else None
    fields = [one.model.expand(x[:, None]) for x in one.motion[:3]]
    basis.take(np.random.default_rng(1).normal(size=(basis.T.shape[1], 5)))
    rich = basis.model()
    one.again(one.motion, rich)
    two = Trace(problem, rich, kept)
    if before is not None:  # by projection, vectors being orthonormal in N
        u, v, a = (rich.X.T @ basis.vectors @ (basis.N @ on_motions(basis.T, x)) for x in fields)
        two.motion = one.motion._replace(
            **{name: x[:, 0] for name, x in zip("uva", (u, v, a), strict=True)},
            **{
                k: getattr(one.motion, k).copy()
                for k in ("delta", "f", "w", "t", "state", "energies")
            },
        )
    a, b = (x.advance(Run(begun, STEPS, dt)).rows for x in (one, two))
    for name in ("u", "v", "w", "t", "jumps", "energies"):
        assert relative(getattr(a, name), getattr(b, name)) < 1e-8


def test_a_basis_grows_in_the_run_that_needs_it(suite, tmp_path, monkeypatch):
    """Within the tolerance at once, where answers after the run want more rounds."""
    rounds, seen = ReducedIntegration._answered, []
    monkeypatch.setattr(
        ReducedIntegration, "_answered", lambda *given: seen.append(rounds(*given)) or seen[-1]
    )
    counts = []
    for share in (run.SHARE, np.inf):
        monkeypatch.setattr(run, "SHARE", share)
        history = integrate_reduced(record(8), 3e-4, shelf=copy_of(suite, tmp_path))
        assert history.reduction.estimate <= 3e-4
        counts.append(len(seen))
        seen.clear()
    assert counts[0] == 1 < counts[1]


def test_answers_of_two_processes_are_both_kept_as_long_as_there_is_room(suite, tmp_path):
    file, problem, sound = copy_of(suite, tmp_path), record(8), suite.read()
    basis = trained.TrainedBasis(problem, sound)
    basis.meet(problem)
    basis.take(np.random.default_rng(1).normal(size=(sound.vectors.shape[1], 5)))
    other = np.ones((trained.ROUNDS * trained.ANSWERS - 5, sound.vectors.shape[1]))
    for answers, kept in ((other[3:], len(other) + 5), (other, len(other))):
        file.write(replace(sound, answers=answers))
        basis._fixed = len(basis.vectors) - 8  # five, and three that start the motion
        basis.learn(sound.model, file)
        assert len(file.read().answers) == kept


def test_beyond_the_tolerance_a_record_runs_whole_and_trains(suite, tmp_path, monkeypatch):
    monkeypatch.setattr(trained, "ROUNDS", 0)
    file, problem = copy_of(suite, tmp_path), record(6)
    whole, found, _, history = beside_the_whole(problem, 1e-9, file)
    said = str(history.reduction.refused)
    assert "trained by 3 records does not reach the tolerance (estimated error" in said
    np.testing.assert_array_equal(found.of("u"), whole.of("u"))
    assert len(file.read().taught) == 4
    assert integrate_reduced(problem, 5e-2, shelf=file).loop == "reduced"


def test_one_record_does_not_train(tmp_path):
    file = TrainingFile(tmp_path / "one.npz")
    for count in ("0 records", "1 record,", "1 record,"):
        history = integrate_reduced(record(1), 0.5, shelf=file)
        assert count in str(history.reduction.refused)
    assert len(file.read().taught) == 1


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"size": (18, 6, 8)}, "another mesh"),
        ({"joint": {"KN": 1e8, "KS": 1e8, "FROT": 0.6}}, "other joints"),
        ({"dt": 4e-3}, "with the step 0.005, not 0.004"),
    ],
)
def test_a_basis_of_another_model_or_step_is_refused(suite, given, told):
    before = suite.path.read_bytes()
    with pytest.raises(KernelError, match=f"basis.npz was trained .*{told}"):
        integrate_reduced(record(4, **given), 5e-2, shelf=suite)
    assert suite.path.read_bytes() == before


def test_a_file_that_is_no_basis_is_told(tmp_path):
    file = TrainingFile(tmp_path / "other.npz")
    file.path.write_bytes(b"PK\x03\x04 no arrays")
    with pytest.raises(InputError, match=r"other\.npz is damaged"):
        integrate_reduced(record(4), 5e-2, shelf=file)


@pytest.mark.parametrize("cut", [np.s_[0], np.s_[:, 1:], np.s_[:, :, None]])
def test_a_file_of_other_shapes_is_told(suite, cut, tmp_path):
    file, sound = TrainingFile(tmp_path / "other.npz"), suite.read()
    file.write(replace(sound, vectors=sound.vectors[cut]))
    with pytest.raises((InputError, KernelError), match=r"other\.npz is damaged: .*vectors \("):
        integrate_reduced(record(4), 5e-2, shelf=file)


def test_runs_that_end_together_lose_no_training(suite, tmp_path):
    """One waits for the other, and reads what that has written."""
    file, problem, sound = copy_of(suite, tmp_path), record(7), suite.read()
    learner = trained.Learner(problem)
    integrate(problem, [learner])
    with ThreadPoolExecutor(1) as pool:
        with file.held():
            other = pool.submit(learner.teach, sound.model, file)
            assert wait([other], 1.0).not_done
            file.write(replace(sound, taught=(*sound.taught, "another")))
        other.result()
    assert file.read().taught[3] == "another"
    assert len(file.read().taught) == 5
    assert [path.name for path in tmp_path.iterdir()] == ["basis.npz"]


def test_supports_that_move_run_whole_and_train_nothing(suite):
    problem, stamp = soil_block(steps=STEPS, size=SIZE), suite.stamp()
    problem.u[:] = problem.constraints.particular(np.full(problem.constraints.C.shape[0], 1e-3))
    history = integrate_reduced(problem, 5e-2, shelf=suite)
    assert "a trained basis does not describe" in str(history.reduction.refused)
    assert (history.loop, suite.stamp()) == ("condensed", stamp)
