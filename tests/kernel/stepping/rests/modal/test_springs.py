"""Springs that only push: each step is the answer of its complementarity problem."""

from dataclasses import replace

import numpy as np
import pytest
from references.recorder import assert_alike, recorded
from references.rocking_beam import COUNT, rocking
from scipy.optimize import nnls
from together import together

from ssilang.kernel.contact import active_set
from ssilang.kernel.contact.active_set import active_set_of, anew, find_active, list_closed
from ssilang.kernel.interface.laws.columns import Variable
from ssilang.kernel.stepping.choose import Case, rule_of
from ssilang.kernel.stepping.newmark import Scheme, hht
from ssilang.kernel.stepping.rests.modal.springs import WRONG
from ssilang.kernel.stepping.run import Integration


def contact_of(Q, k, closed):
    contact = active_set_of(Q, k, WRONG)
    contact.closed[:] = closed
    anew(contact)
    list_closed(contact)
    return contact


def forces_of(contact, answer):
    return np.where(contact.closed, answer, 0.0)


@together("at_once", [0, 20])
@together("seed", range(6))
def test_forces_are_the_smallest_in_the_compliance(seed, at_once, monkeypatch):
    """`min f.Q f/2 - g.f` over f <= 0, by non-negative least squares on Q's factor."""
    monkeypatch.setattr(active_set, "ALL_AT_ONCE", at_once)
    rng = np.random.default_rng(seed)
    k = rng.uniform(1.0, 10.0, COUNT)
    J = rng.normal(size=(COUNT, 9))
    Q = J @ J.T + np.diag(1 / k)
    contact = contact_of(Q, k, rng.random(COUNT) < 0.5)
    answer, L = contact.found, np.linalg.cholesky(Q)
    for _ in range(5):
        g = rng.normal(size=COUNT)
        contact.free[:] = g
        find_active.py_func(contact)
        truth = -nnls(L.T, -np.linalg.solve(L, g))[0]
        assert truth.any()
        assert not truth.all()
        np.testing.assert_allclose(forces_of(contact, answer), truth, atol=1e-12)
        jumps = g - Q @ truth
        np.testing.assert_allclose(answer[~contact.closed], jumps[~contact.closed], atol=1e-12)


def test_many_exchanges_do_not_gather_rounding():
    rng = np.random.default_rng(1)
    k = 10.0 ** rng.uniform(0.0, 4.0, COUNT)
    Q = np.diag(1 / k) + (J := rng.normal(size=(COUNT, 4))) @ J.T
    contact = contact_of(Q, k, np.zeros(COUNT, bool))
    for _ in range(3000):
        contact.free[:] = rng.normal(size=COUNT)
        find_active(contact)
    g = contact.free[:] = rng.normal(size=COUNT)
    find_active(contact)
    f = forces_of(contact, contact.found)
    jumps = g - Q @ f
    np.testing.assert_allclose(f, np.minimum(k * (jumps + f / k), 0.0), atol=1e-9)
    np.testing.assert_allclose(jumps[contact.closed], 0.0, atol=1e-10)


@pytest.mark.parametrize("scheme", [Scheme(), hht(0.1)])
def test_rocking_beam_steps_as_the_full_newton(scheme):
    problem = rocking(scheme, 300)
    assert rule_of(Case(problem, Integration(problem).motion, 1e-3)).name == "springs"
    exact = recorded(problem, full_newton=True)
    open_points = (exact[0].of("t")[..., -1] == 0.0).sum(axis=1)
    assert len(np.unique(open_points)) > 4  # ends lift by and by
    assert_alike(recorded(problem), exact, ("u", "v", "w", "t", "state"), 1e-10)


def test_springs_with_a_past_keep_their_largest_opening():
    problem = rocking(Scheme(), 400)
    state = problem.state.copy()
    state[:, Variable.XI] = 1.0
    few, _ = recorded(replace(problem, state=state))
    assert (few.of("state")[..., Variable.XI] == 1.0).all()
    assert (few.of("t")[..., -1] == 0.0).any()
