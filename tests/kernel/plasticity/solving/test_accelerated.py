"""Steps that keep their factor against Newton's method on all unknowns."""

from dataclasses import fields, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from references.keeper import Ending
from references.tower_on_clay import stepped_tower

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity import run
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.solving import accelerated, part
from ssilang.kernel.plasticity.solving.accelerated import Acceleration
from ssilang.kernel.solvers.backends import DISSECTION
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.triangular import backward_runs, forward_runs
from ssilang.kernel.solvers.factor import Solver
from ssilang.kernel.stepping.problem.problem import Problem

STEPS = 56


def stepped(
    law: str = "J2", keeper=None, steps: int = STEPS, full: bool = False, moved: float = 0.0
):
    """History, and displacements and last plastic strains, of a run."""
    history, seen, strain = stepped_tower(law, steps, keeper=keeper, full=full, moved=moved)
    return history, seen.of("u"), strain, seen.of("w")[..., -1]


@pytest.fixture(scope="module")
def newton():
    """The run by Newton's method, asked for."""
    return stepped(full=True)


def test_a_kept_factor_leads_to_newtons_answer(newton) -> None:
    """Both end each step at 1e-10 of the forces; the model yields, lifts and comes down again."""
    history, u, strain, _ = stepped()
    assert history.loop.startswith("kept factor")
    assert newton[0].loop.startswith("full Newton")
    assert np.mean(strain > 0) > 0.2
    opens = newton[3][1:] > 0
    assert opens.any()
    assert (opens[:-1] & ~opens[1:]).any()
    assert np.abs(u - newton[1]).max() <= 1e-8 * np.abs(newton[1]).max()
    assert np.abs(strain - newton[2]).max() <= 1e-8 * newton[2].max()
    imbalance = np.abs(history.energies - newton[0].energies).max()
    assert imbalance <= 1e-8 * np.abs(newton[0].energies).max()


def test_cells_that_yield_beyond_the_part_are_found(
    newton, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Parts that begin with nothing but what yields are made wider within steps."""
    widened, sizes = [], []
    made, widen = accelerated.AcceleratedSolver._accepted, accelerated.AcceleratedSolver._widened
    monkeypatch.setattr(
        accelerated.AcceleratedSolver, "_widened",
        lambda self, step: widened.append(found := widen(self, step)) or found,
    )  # fmt: skip
    monkeypatch.setattr(
        accelerated.AcceleratedSolver, "_accepted",
        lambda self, step, *more: sizes.append(len(step.part.places)) or made(self, step, *more),
    )  # fmt: skip
    monkeypatch.setattr(accelerated, "NEAR", -1e-9)
    monkeypatch.setattr(part, "NEAR", -1e-9)
    monkeypatch.setattr(part, "MISSED", -1e-9)
    _, u, _, _ = stepped(steps=30)
    assert sum(widened) > 3
    assert sizes[0] == 0
    assert 0 < np.median([n for n in sizes if n]) < 0.7 * u.shape[1]
    assert np.abs(u - newton[1][:31]).max() <= 1e-8 * np.abs(newton[1]).max()


def test_renewed_factors_lead_there_too(newton, monkeypatch: pytest.MonkeyPatch) -> None:
    made = []
    make = accelerated.AcceleratedSolver._factorised
    monkeypatch.setattr(
        accelerated.AcceleratedSolver, "_factorised",
        lambda self, tangent: made.append(0) or make(self, tangent),
    )  # fmt: skip
    monkeypatch.setattr(accelerated, "PATIENCE", 4)
    history, u, _, _ = stepped(steps=20)
    assert len(made) > 3
    assert history.loop.startswith("kept factor")
    assert np.abs(u - newton[1][:21]).max() <= 1e-8 * np.abs(newton[1]).max()


@pytest.mark.parametrize("solver", [DISSECTION, "SuperLU"])
def test_a_base_that_moves_leads_there_too_with_any_factor(solver, newton, monkeypatch) -> None:
    full = stepped(steps=16, full=True, moved=0.02)
    make = accelerated.effective_of
    monkeypatch.setattr(run, "is_accelerated", lambda *of: True)
    monkeypatch.setattr(
        accelerated, "effective_of",
        lambda problem, *more: make(replace(problem, solver=Solver(solver)), *more),
    )  # fmt: skip
    iterate, led = accelerated.AcceleratedSolver._accelerated, []
    monkeypatch.setattr(
        accelerated.AcceleratedSolver, "_accelerated",
        lambda *of: led.append((found := iterate(*of)).turns > 0) or found,
    )  # fmt: skip
    history, u, strain, _ = stepped(steps=16, moved=0.02)
    assert all(led)  # else Newton's method would have gone on
    assert len(led) >= 16
    assert history.loop.startswith("kept factor")
    assert full[0].loop.startswith("full Newton")
    assert np.mean(strain > 0) > 0.1
    assert np.abs(u - full[1]).max() <= 1e-8 * np.abs(full[1]).max()
    still = newton[1][: len(u)]
    assert np.abs(u - still).max() > 0.1 * np.abs(still).max()


def test_newtons_method_goes_on_where_the_iteration_leads_nowhere(
    newton, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(accelerated, "PATIENCE", 2)
    monkeypatch.setattr(accelerated, "RENEWALS", 1)
    _, u, _, _ = stepped(steps=14)
    assert np.abs(u - newton[1][:15]).max() <= 1e-8 * np.abs(newton[1]).max()


def test_runs_repeat_to_the_last_bit_and_go_on_to_it(tmp_path: Path) -> None:
    whole, resumed = stepped(steps=24), None
    with pytest.raises(KeyboardInterrupt):
        stepped(keeper=Ending(tmp_path, 4, 12), steps=24)
    resumed = stepped(keeper=Ending(tmp_path, 4, resume=True), steps=24)
    assert np.array_equal(resumed[0].energies, whole[0].energies)
    assert np.array_equal(resumed[1][-12:], whole[1][-12:])
    assert np.array_equal(resumed[2], whole[2])


def test_perfect_plasticity_keeps_a_factor_and_unsymmetric_flow_does_not(monkeypatch) -> None:
    assert stepped("DRUCKER_PARFAIT", steps=3)[0].loop.startswith("kept factor")
    assert stepped("DRUCKER_PRAGER", steps=3)[0].loop.startswith("full Newton")
    choose = accelerated.is_accelerated
    asked: list[np.ndarray] = []  # of the whole body, held: it is positive
    monkeypatch.setattr(
        accelerated, "factor_pays", lambda A, order, solves: asked.append(A.toarray()) or solves < 9
    )
    chosen: list[tuple[Problem, Bulk, sp.csr_array]] = []
    monkeypatch.setattr(run, "is_accelerated", lambda *of: chosen.append(of) or choose(*of))
    assert stepped(steps=3)[0].loop.startswith("full Newton")
    assert np.linalg.eigvalsh(asked[0])[0] > 1e-6 * np.diag(asked[0]).min()
    monkeypatch.setattr(accelerated, "factor_pays", lambda A, order, solves: solves > 9)
    problem, bulk, A = chosen[0]
    sided = SimpleNamespace(**{**vars(problem.constraints), "associated": False})
    others = [
        (problem, True), (replace(problem, solver=Solver(DISSECTION)), True),
        (replace(problem, solver=Solver("SuperLU")), False),
        (replace(problem, contact=object()), False), (replace(problem, constraints=sided), False),
    ]  # fmt: skip
    parts = {f.name: getattr(bulk, f.name) for f in fields(bulk) if f.init}
    bulks = [
        (bulk, True),
        (replace(bulk, zones=()), False),
        (type("", (Bulk,), {})(**parts), False),
    ]
    for order in (object(), None):  # None: the matrix has no places to be dissected by
        monkeypatch.setattr(accelerated, "ordering_of", lambda *of, order=order: order)
        cases = [*((p, bulk, x) for p, x in others), *((problem, b, x) for b, x in bulks)]
        for p, b, wanted in cases:
            assert choose(p, b, A) == (wanted and order is not None)


def test_the_way_of_a_part_to_the_root_is_all_that_its_solve_needs() -> None:
    """A grid of 30 x 30 nodes, one unknown each; cells in a corner and one in the middle."""
    n = 30
    line = sp.diags_array([-1.0, 2.1, -1.0], offsets=[-1, 0, 1], shape=(n, n))
    A = sp.csr_array(sp.kron(line, sp.eye_array(n)) + sp.kron(sp.eye_array(n), line))
    x, y = np.divmod(np.arange(n * n), n)
    factor = DissectedFactor(A, np.column_stack([x, y]).astype(float))
    panels, order = factor.panels, factor.tree.order
    cells = np.array([[0, 1, n, n + 1], [1, 2, n + 1, n + 2], [465, 466, 495, 496]], np.int32)
    bulk = SimpleNamespace(size=n * n, places=(cells,), passes=(None,))
    T = sp.csr_array(sp.eye_array(n * n).tocsr()[:, order])
    made = part.part_of(bulk, (np.array([0, 2]),), T, panels)  # type: ignore[arg-type]
    nodes = np.unique(cells[[0, 2]])
    assert np.array_equal(made.unknowns, nodes)
    load, x = np.zeros(n * n), np.zeros(n * n)
    load[nodes] = np.arange(1.0, 9.0)
    x[made.places] = made.T.T @ load[nodes]
    forward_runs(panels, made.runs, x, factor.room)
    backward_runs(panels, made.runs, x, factor.room)
    whole = np.linalg.solve(A.toarray(), load)
    assert np.allclose(made.T @ x[made.places], whole[nodes], rtol=1e-12)
    assert 0 < np.diff(made.runs).sum() < 0.3 * (len(panels.first) - 1)


def test_cells_numbered_through_all_zones_are_those_of_each() -> None:
    bulk = SimpleNamespace(places=(np.zeros((3, 8)), np.zeros((4, 6)), np.zeros((2, 8))))
    found = part.by_zone(bulk, np.array([0, 2, 3, 6, 8]))  # type: ignore[arg-type]
    assert [x.tolist() for x in found] == [[0, 2], [0, 3], [1]]
    assert [len(x) for x in part.by_zone(bulk, np.array([4]))] == [0, 1, 0]  # type: ignore[arg-type]


def test_acceleration_solves_a_linear_problem_in_as_many_turns_as_it_has_unknowns() -> None:
    rng = np.random.default_rng(3)
    A, b = 2.0 * rng.normal(size=(6, 6)), rng.normal(size=6)  # p -> A p + b grows without end
    p, step = np.zeros(6), Acceleration(6)
    for _ in range(8):
        p = step.next(p, A @ p + b)
    exact = np.linalg.solve(np.eye(6) - A, b)
    assert np.abs(p - exact).max() <= 1e-8 * np.abs(exact).max()
