"""Steps in which shear would jump with the opening have a solution all the same."""

import numpy as np
import pytest
from references.iterations import solve_cached, solve_interface

from ssilang.kernel.interface.laws.columns import HELD, N_STATE
from ssilang.kernel.interface.newton import HOLDING_TURN

ONE_POINT = {
    "pairs": np.zeros((1, 1), dtype=np.int64),
    "B": np.eye(2)[None],
    "weights": np.ones(1),
    "codes": np.ones(1, dtype=np.int64),
    # KN, KS1, KS2, FU, GF, FC, FROT, SHEAR
    "p": np.array([[1.0, 1.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0]]),
}


def solve(solver, S, delta0, f0, state, y0):
    """One step of a single point; turns, increment, forces, new state."""
    y, h, f = y0.copy(), np.zeros(2), np.zeros(2)
    w, t, D = np.zeros((1, 2)), np.zeros((1, 2)), np.zeros((1, 2, 2))
    new = np.zeros_like(state)
    turns, _ = solver(
        *ONE_POINT.values(), S, np.zeros((2, 2)), 1.0,
        delta0, f0, state, y0, y, w, t, new, D, f, h,
    )  # fmt: skip
    return turns, y, f, new


@pytest.mark.parametrize("solver", [solve_interface, solve_cached])
def test_a_step_with_no_consistent_shear_keeps_that_of_its_start(solver):
    """Closed, the shear opens the joint; open, nothing does: the law alone has no solution.

    With S = [[1, s], [s, 1]], KN = KS = 1, a start closed by 1 and y0 = (push, 1.9): open, the
    normal jump is 1.9 - 1 - 1 < 0; closed, a negative push makes it positive.
    """
    S = np.array([[1.0, 0.9], [0.9, 1.0]])
    delta0, f0 = np.array([0.0, -1.0]), np.array([0.0, -1.0])
    state = np.zeros((1, N_STATE))
    found = []
    for push in np.linspace(-6.0, 6.0, 241):
        y0 = np.array([push, 1.9])
        turns, y, f, new = solve(solver, S, delta0, f0, state.copy(), y0)
        assert turns > 0
        assert y + S @ (f - f0) == pytest.approx(y0, abs=1e-10)
        assert new[0, HELD] == 0.0
        if turns >= HOLDING_TURN:
            found.append(push)
            assert f[0] == pytest.approx(delta0[0] + y[0])  # shear still transmitted
            assert f[1] == 0.0  # on a joint that opens
            assert delta0[1] + y[1] >= 0.0
    assert found, "no step needed its shear held: the case proves nothing"
