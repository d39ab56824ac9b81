"""Reduced models against the whole one: error held below the estimate, what is refused."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from references.recorder import Recorder, recorded
from references.soil_block import soil_block
from references.whole_and_reduced import both, check, relative
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.newmark import generalised_alpha, hht
from ssilang.kernel.stepping.rests.reduced import run
from ssilang.kernel.stepping.rests.reduced.basis import Basis
from ssilang.kernel.stepping.rests.reduced.run import _PAIRS, integrate_reduced
from ssilang.kernel.stepping.rests.reduced.trace import Difference
from ssilang.kernel.stepping.run import integrate


@pytest.fixture(autouse=True)
def no_bases_of_other_tests():
    _PAIRS.clear()


CASES = {
    "friction": {},
    "elastic shear": {"words": ("CISAILLEMENT_ELASTIQUE",), "joint": {"KN": 2e8, "KS": 1e8}},
    "softening": {"joint": {"KN": 2e8, "KS": 1e8, "FU": 2e4, "GF": 50.0, "FC": -1e4, "FROT": 0.6}},
    "HHT": {"scheme": hht(0.1)},
    "generalised alpha": {"scheme": generalised_alpha(0.8)},
    "a small step": {"dt": 1e-3, "steps": 600, "acceleration": 15.0},
    "a wide block": {"size": (40, 16, 6), "steps": 200},
}


@pytest.mark.parametrize("name", CASES)
def test_true_error_is_below_the_estimate_and_the_tolerance(name):
    problem = soil_block(**CASES[name])
    known = recorded(problem)
    for tolerance in (1e-3, 1e-5):
        whole, reduced = check(problem, tolerance, known=known)
        assert relative(reduced.of("t"), whole.of("t")) <= 10 * tolerance
        _PAIRS.clear()


def test_the_estimate_holds_down_to_one_in_a_million():
    whole, _, reduced, history = both(soil_block(), 1e-6)
    assert history.loop == "reduced"
    errors = [relative(reduced.of(x), whole.of(x)) for x in ("u", "w")]
    assert max(errors) <= history.reduction.estimate <= 1e-6
    velocities = relative(reduced.of("v"), whole.of("v"))
    assert velocities <= 10 * history.reduction.velocity


def test_the_bases_used_last_are_kept():
    problem, kept = soil_block(steps=10), run.PAIRS_KEPT
    pairs = [run._pair_of(problem, 10.0**-k) for k in range(1, kept + 1)]
    assert run._pair_of(problem, 0.1) is pairs[0]
    last = run._pair_of(problem, 0.5)
    assert [*_PAIRS.values()] == [*pairs[2:], pairs[0], last]


def test_average_acceleration_balances_energy():
    words = {"words": ("CISAILLEMENT_ELASTIQUE",), "joint": {"KN": 5e7, "KS": 5e7}}
    problem = soil_block(steps=1000, dt=5e-4, acceleration=12.0, **words)
    exact, history = integrate(problem), integrate_reduced(problem, 1e-4)
    assert history.loop == "reduced"
    scale = np.abs(history.energies).max()
    assert np.abs(history.imbalance - exact.imbalance).max() < 1e-3 * scale


def test_static_answer_to_interface_and_loads_is_exact():
    problem = soil_block()
    basis = Basis(problem, 5e-3, 400)
    model = basis.model()
    joints = problem.interface
    T = problem.constraints.T
    closed = problem.K + joints.J.T @ joints.closed_stiffness() @ joints.J
    closed = (T.T @ closed @ T).toarray()
    inputs = np.column_stack([joints.J.T.toarray(), problem.loading.forces])
    exact = T @ np.linalg.solve(closed, T.T @ inputs)
    reduced_closed = np.diag(model.k) + model.J.T @ joints.closed_stiffness().toarray() @ model.J
    V = model.expand(np.eye(model.size))
    found = V @ np.linalg.solve(reduced_closed, V.T @ inputs)
    assert relative(found, exact) < 1e-8


def test_answer_of_the_step_to_interface_forces_is_exact():
    problem, dt = soil_block(damping=None), 5e-3
    model = Basis(problem, dt, 400).model()
    T, J = problem.constraints.T, problem.interface.J @ problem.constraints.T
    A = T.T @ (problem.K + 4 / dt**2 * problem.M) @ T
    exact = J @ np.linalg.solve(A.toarray(), J.T.toarray())
    found = (model.J / (model.k + 4 / dt**2 * model.m)) @ model.J.T
    assert relative(found, exact) < 1e-9


def test_initial_fields_are_kept():
    problem = soil_block()
    T = problem.constraints.T
    random = np.random.default_rng(3).standard_normal((2, T.shape[1]))
    problem = replace(problem, u=1e-4 * (T @ random[0]), v=1e-2 * (T @ random[1]))
    model = Basis(problem, 5e-3, 400).model()
    assert relative(model.expand(model.start)[:, 0], problem.u) < 1e-9
    assert relative(model.expand(model.start)[:, 1], problem.v) < 1e-9


def test_saved_steps_and_reactions():
    problem = soil_block(steps=200)
    whole, reduced = Recorder(201), Recorder(201)
    for recorder in (whole, reduced):
        recorder.wanted[:] = False
        recorder.wanted[[0, 7, 130, 200]] = True
    integrate(problem, [whole])
    integrate_reduced(problem, 1e-6, [reduced])
    assert [s.step for s in reduced.snapshots] == [0, 7, 130, 200]
    for a, b in zip(reduced.snapshots[1:], whole.snapshots[1:], strict=True):
        exact = problem.constraints.multipliers(b.reaction)
        assert relative(problem.constraints.multipliers(a.reaction), exact) < 1e-3
        np.testing.assert_allclose(a.state, b.state, atol=1e-6 * np.abs(b.state).max())


def test_states_that_do_not_fit_memory_run_again(monkeypatch):
    problem = soil_block(steps=100)
    one, two = Recorder(101), Recorder(101)
    told = []
    integrate_reduced(problem, 1e-3, [one], lambda *at: told.append(at))
    monkeypatch.setattr("ssilang.kernel.stepping.rests.reduced.run.MOST_VALUES", 0)
    integrate_reduced(problem, 1e-3, [two])
    np.testing.assert_array_equal(one.of("u"), two.of("u"))
    assert told == sorted(set(told))
    assert told[-1] == (100, 100)


def test_the_next_motion_finds_the_basis(monkeypatch):
    problem = soil_block()
    first = integrate_reduced(problem, 1e-4)
    abscissas, ordinates = problem.loading.curves[1]
    loading = replace(
        problem.loading, curves=(problem.loading.curves[0], (abscissas, 0.7 * ordinates))
    )
    other = replace(problem, loading=loading)
    monkeypatch.setattr("ssilang.kernel.stepping.rests.reduced.run.Basis", None)  # none is made
    second = integrate_reduced(other, 1e-4)
    assert second.reduction.vectors == first.reduction.vectors


def test_a_basis_kept_for_loads_at_other_places_is_not_taken(monkeypatch):
    """A push on the far edge of the soil, which the first basis has never seen."""
    problem = soil_block(steps=100)
    integrate_reduced(problem, 1e-4)
    forces = problem.loading.forces.copy()
    far = int(np.flatnonzero(problem.constraints.T.sum(axis=1))[-3])
    forces[:, 1] = 0.0
    forces[far, 1] = 2e4
    other = replace(problem, loading=replace(problem.loading, forces=forces))
    whole, _, reduced, history = both(other, 1e-4)
    assert history.loop == "reduced"
    alone = Recorder(101)
    _PAIRS.clear()
    integrate_reduced(other, 1e-4, [alone])
    np.testing.assert_array_equal(reduced.of("u"), alone.of("u"))
    assert relative(reduced.of("u"), whole.of("u")) <= 2 * history.reduction.estimate


@pytest.mark.parametrize("worst", [0, 1, 2])
def test_the_estimate_is_the_worst_of_jumps_displacements_and_rotations(worst):
    """Two traces in the same coordinates, of which one group differs by 30 %, the others by 1."""
    names = ("UX", "RZ")
    numbering = SimpleNamespace(unknowns=names, codes=np.array([0, 1]))
    whole = SimpleNamespace(X=np.eye(2), size=2, whole=lambda z: z)
    rows = np.ones((3, 2))
    changes = np.where(np.arange(3) == worst, 1.3, 1.01)

    def chunk(jumps, fields):
        parts = SimpleNamespace(jumps=jumps * np.ones((3, 4)), u=fields, v=rows, a=rows)
        return SimpleNamespace(steps=np.arange(3), rows=parts)

    trace = SimpleNamespace(model=whole)
    difference = Difference(SimpleNamespace(numbering=numbering))
    difference.take(trace, trace, chunk(changes[0], rows * changes[1:]), chunk(1.0, rows))
    assert difference.estimate == pytest.approx(0.3)
    assert difference.relative[:3] == pytest.approx(changes - 1)


def test_damping_that_is_not_symmetric_runs_the_whole_model():
    problem = soil_block(steps=20)
    i, j = problem.constraints.T[:, [100, 101]].argmax(axis=0).ravel()
    turned = problem.C.tolil()
    turned[i, j] += abs(problem.C).max()
    history = integrate_reduced(replace(problem, C=sp.csr_array(turned)), 1e-3)
    assert history.loop == "condensed"
    assert "not symmetric" in str(history.reduction.refused)


def test_a_tolerance_out_of_reach_runs_the_whole_model_for_the_next_motion_too():
    problem = soil_block(steps=100, size=(12, 3, 8), damping=None)
    for _ in range(2):
        history = integrate_reduced(problem, 1e-10)
        assert history.loop == "condensed"
        assert "vectors do not reach" in str(history.reduction.refused)


def test_an_interface_of_too_many_unknowns_is_told_before_any_vector_is_made(monkeypatch):
    problem, module = soil_block(steps=20), "ssilang.kernel.stepping.rests.reduced"
    monkeypatch.setattr(f"{module}.run.MOST", 2 * problem.interface.size - 1)
    monkeypatch.setattr(f"{module}.basis.invert", None)  # no factor is made
    history = integrate_reduced(problem, 1e-3)
    assert history.loop == "condensed"
    assert f"the {problem.interface.size} unknowns of the interface" in str(
        history.reduction.refused
    )


@together("tolerance", [0.0, -1.0, 1.0, np.nan])
def test_tolerances_out_of_range_are_refused(tolerance):
    with pytest.raises(KernelError, match="tolerance"):
        integrate_reduced(soil_block(steps=2), tolerance)


def test_schemes_that_do_not_go_with_it_are_refused():
    problem = soil_block(steps=2)
    for scheme in (
        replace(problem.scheme, conserving=True),
        replace(problem.scheme, adaptive=True),
    ):
        with pytest.raises(KernelError, match="neither conserving nor adapted"):
            integrate_reduced(replace(problem, scheme=scheme), 1e-3)
