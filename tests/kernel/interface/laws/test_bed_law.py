"""Ground that yields below a footing: capacity, flow, tangent and energy at one place."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from references.law_points import answer, energies, table_of
from scipy.optimize import minimize_scalar
from together import together

from ssilang.kernel.interface.laws.columns import N_STATE, Parameter, Variable

BED = 6
KN, KS, C = 2e7, 1e7, 5e4
Q = (2 + math.pi) * C
parameters = partial(table_of, BED_KN=KN, BED_KS=KS, COHE=C, QULT=Q, FROT=-1.0)


def relief(w, state, p):
    """What yielding takes away, the state and the tangent."""
    t, new, D = answer(BED, w, state, p)
    return t[0], new, D[0]


def carried(w, state, p):
    """Drag and pressure of the bed itself: the elastic bed and what yielding takes from it."""
    t, new, _ = relief(w, state, p)
    w = np.asarray(w, float)
    elastic = np.append(p[0, Parameter.BED_KS] * w[:-1], KN * min(w[-1], 0.0))
    return t + elastic, new


def green(x):
    """Pressure over (2 + pi) c that Green's solution allows under the drag x c."""
    return (1 + math.pi / 2 + math.acos(x) + math.sqrt(1 - x * x)) / (2 + math.pi)


def rest():
    return np.zeros((1, N_STATE))


@together("w", [[1e-3, -2e-3], [-2e-3, 4e-3], [1e-3, 2e-3, -5e-3], [0.0, 0.0]])
def test_ground_of_great_strength_takes_nothing_from_the_elastic_bed(w):
    t, new, D = relief(w, rest(), parameters(COHE=1e12, QULT=5e12))
    assert not t.any()
    assert not new.any()
    assert not D.any()


def test_a_pressed_place_bears_five_times_the_cohesion_and_a_dragged_one_the_cohesion():
    t, new = carried([0.0, -1.0], rest(), parameters())
    np.testing.assert_allclose(t, [0.0, -Q], rtol=1e-14)
    assert new[0, Variable.XI] == pytest.approx(-1.0 + Q / KN, rel=1e-14)
    t, new = carried([0.1, -1e-3], rest(), parameters())
    np.testing.assert_allclose(t, [C, -1e-3 * KN], rtol=1e-14)
    assert new[0, Variable.SLIP1] == pytest.approx(0.1 - C / KS, rel=1e-14)


def test_a_settled_place_lifts_off_where_it_settled_and_presses_again_only_there():
    p = parameters()
    _, state = carried([0.0, -0.05], rest(), p)
    settled = state[0, Variable.XI]
    t, after = carried([0.0, settled + 1e-3], state, p)
    assert t[1] == pytest.approx(0.0, abs=1e-9 * Q)
    assert after[0, Variable.XI] == settled
    t, _ = carried([0.0, settled - 1e-3], state, p)
    assert t[1] == pytest.approx(-1e-3 * KN, rel=1e-9)


JUMP = st.floats(-0.02, 0.02)


@settings(max_examples=60, deadline=None)
@given(JUMP, st.floats(-0.05, 0.01), st.sampled_from([1.0, 0.2, 3.0]), st.sampled_from([KS, 2e6]))
def test_the_answer_is_the_nearest_admissible_one(u, v, share, ks):
    p = parameters(QULT=share * Q, BED_KS=ks)
    t, _ = carried([u, v], rest(), p)
    drag, press = abs(t[0]), -t[1]
    assert drag <= C * (1 + 1e-12)
    assert press <= share * Q * green(min(drag / C, 1.0)) * (1 + 1e-9)
    trial_p, trial_T = max(0.0, -KN * v), abs(ks * u)

    def distance(T):  # in the elastic metric, to the best point with this drag
        best = min(trial_p, share * Q * green(T / C))
        return (trial_p - best) ** 2 / KN + (trial_T - T) ** 2 / ks

    found = (trial_p - press) ** 2 / KN + (trial_T - drag) ** 2 / ks
    least = minimize_scalar(distance, bounds=(0.0, C), method="bounded", options={"xatol": 1e-3})
    size = trial_p**2 / KN + trial_T**2 / ks
    assert found <= min(least.fun, distance(min(trial_T, C))) + 1e-9 * size


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(JUMP, JUMP, st.floats(-0.04, 0.01)), min_size=2, max_size=6),
    st.sampled_from([-1.0, 0.2, 0.7]),
)
def test_paths_lose_energy_and_never_gain_any(path, friction):
    p, state, lost = parameters(FROT=friction), rest(), 0.0
    for w in path:
        t, after, _ = relief(w, state, p)
        _, spent = energies(BED, np.array(w), t, after[0], p[0])
        assert spent >= lost - 1e-12 * abs(lost)
        # what is lost is force times plastic motion, no more
        whole, _ = carried(w, state, p)
        moved = np.append(after[0, 1:3] - state[0, 1:3], after[0, 0] - state[0, 0])
        assert spent - lost == pytest.approx(whole @ moved, rel=1e-6, abs=1e-6 * C * 1e-3)
        state, lost = after, spent


@settings(max_examples=80, deadline=None)
@given(
    st.tuples(JUMP, JUMP, st.floats(-0.04, 0.01)),
    st.tuples(JUMP, JUMP, st.floats(-0.04, 0.01)),
    st.sampled_from([-1.0, 0.2, 0.7]),
)
def test_the_tangent_is_the_derivative_and_symmetric_without_friction(first, w, friction):
    p = parameters(FROT=friction)
    _, state, _ = relief(first, rest(), p)
    # at no drag at all, friction has a kink
    assume(np.abs(np.array(w[:2]) - state[0, 1:3]).max() > 1e-6)
    _, _, D = relief(w, state, p)
    h = 1e-8
    columns = []
    for i in range(3):
        sides = []
        for sign in (1.0, -1.0):
            moved = np.array(w)
            moved[i] += sign * h
            sides.append(relief(moved, state, p))
        if not np.allclose(sides[0][2], sides[1][2], rtol=1e-3, atol=1e-3 * KN):
            return  # a kink lies between
        columns.append((sides[0][0] - sides[1][0]) / (2 * h))
    np.testing.assert_allclose(D, np.stack(columns, axis=1), atol=2e-4 * KN)
    if friction < 0.0:
        np.testing.assert_allclose(D, D.T, atol=1e-9 * KN)


def test_friction_lets_go_with_the_pressure_and_bounds_what_is_pressed_down():
    p = parameters(FROT=0.3)
    t, _ = carried([0.1, 1e-3], rest(), p)
    np.testing.assert_allclose(t, 0.0, atol=1e-9 * C)
    t, _ = carried([0.1, -1e-3], rest(), p)
    np.testing.assert_allclose(t, [0.3e-3 * KN, -1e-3 * KN], rtol=1e-12)
    t, _ = carried([0.1, -0.02], rest(), p)
    assert -t[1] == pytest.approx(Q * green(0.3 * -t[1] / C), rel=1e-12)
    assert t[0] == pytest.approx(-0.3 * t[1], rel=1e-12)
