"""Newton's method by Cholesky factors against that by LU."""

import numpy as np
import pytest
from references.tower_on_clay import stepped_tower, tower_on_clay

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.plasticity import newton
from ssilang.kernel.plasticity.solving.positive import PositiveFactors

STEPS = 12


class Listening(PositiveFactors):
    """Notes which of its solves succeed."""

    solved: list[bool]

    def solve(self, *given):
        found = super().solve(*given)
        self.solved.append(found is not None)
        return found


def stepped(solved: list[bool], monkeypatch: pytest.MonkeyPatch) -> np.ndarray:
    """Displacements; whether Cholesky factors solved, each time that they were asked."""
    Listening.solved = solved
    monkeypatch.setattr(newton, "PositiveFactors", Listening)
    history, seen, strain = stepped_tower("J2", STEPS, full=True)
    assert history.solver == ("nested dissection" if solved else "SuperLU")
    assert (strain > 0).any()
    return seen.of("u")


def test_both_lead_to_the_same_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    none, solved = [], []
    monkeypatch.setattr(newton, "dissection_pays", lambda n: True)
    found = stepped(solved, monkeypatch)
    monkeypatch.setattr(newton, "dissection_pays", lambda n: False)
    expected = stepped(none, monkeypatch)
    assert not none
    assert len(solved) > 2 * STEPS
    assert all(solved)
    assert np.abs(found - expected).max() <= 1e-9 * np.abs(expected).max()


def test_what_is_not_positive_or_not_symmetric_is_left_to_others() -> None:
    problem, _ = tower_on_clay("J2", 1)
    n = problem.numbering.size
    factors, load = PositiveFactors(problem), np.ones(n)
    none, A = sp.csr_array((n, n)), sp.csr_array(sp.eye_array(n))
    T = problem.constraints.T
    assert np.allclose(factors.solve(A, none, load), T @ (T.T @ load))
    assert factors.solve(-A, none, load) is None
    rubs = sp.csr_array(([1.0], ([0], [1])), shape=(n, n))
    assert factors.solve(A, rubs, load) is None
