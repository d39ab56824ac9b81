"""Harmonic balance against closed forms, time integration and constant coefficients."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import csr_array

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.continuation.arc import Lengths, Tracer
from ssilang.kernel.continuation.expansion import FrequencyProblem
from ssilang.kernel.continuation.floquet import exponents, monodromy
from ssilang.kernel.continuation.harmonics import Oscillators, basis_of, derivative_matrix
from ssilang.kernel.continuation.response import forced_response, normal_mode
from ssilang.kernel.stepping.problem.loading import Loading

DAMPING, CUBIC, LOAD = 0.1, 0.25, 0.5


class Cubic:
    """f = -a q^3 on each unknown."""

    def at(self, q, v):
        n = q.shape[1]
        fq = np.zeros((len(q), n, n))
        fq[:, range(n), range(n)] = -3 * CUBIC * q**2
        return -CUBIC * q**3, fq, np.zeros_like(fq)


def duffing(harmonics, load=LOAD, damping=DAMPING, forces=None):
    one = np.eye(1)
    coefficients = np.zeros((2 * harmonics + 1, 1))
    coefficients[1] = load
    basis = basis_of(harmonics, 8 * (2 * harmonics + 1))
    return Oscillators(one, damping * one, one, basis, forces or Cubic(), coefficients)


def branch(system, start=0.3, end=2.5, most=0.05):
    guess = np.zeros_like(system.load)
    return forced_response(
        system, guess, start, end, 1.0, Lengths(0.01, 1e-4, most, tolerance=1e-11), 2000
    )


def test_one_harmonic_is_the_closed_form_of_duffings_response():
    found = branch(duffing(1))
    assert found.ended == "bounds"
    w = np.array(found.frequencies)
    A = np.array([np.hypot(Q[1, 0], Q[2, 0]) for Q in found.coefficients])
    left = ((1 + 0.75 * CUBIC * A**2 - w**2) ** 2 + (DAMPING * w) ** 2) * A**2
    np.testing.assert_allclose(left, LOAD**2, rtol=1e-8)
    # limit points: where dF/dA of the closed form is nothing
    assert [b.kind for b in found.bifurcations] == ["LP", "LP"]
    for b in found.bifurcations:
        a, s = np.hypot(*b.coefficients[1:, 0]), b.frequency
        k = 1 + 0.75 * CUBIC * a**2 - s**2
        slope = (k**2 + (DAMPING * s) ** 2) + k * 1.5 * CUBIC * a**2
        assert slope == pytest.approx(0.0, abs=1e-5)


def test_slopes_of_a_balance_in_motion_and_in_time_are_those_of_differences():
    """Loads, and the frequency that they go with, change in pseudo-time; some motions are held."""
    rng, n, m = np.random.default_rng(2), 6, 2
    K, C, M, T = (csr_array(rng.standard_normal((n, k))) for k in (n, n, n, 4))
    basis, places = basis_of(1, 12), np.array([[0, 3], [1, 4], [2, 5]])
    times = np.array([0.0, 1.0, 2.0])
    loading = Loading(rng.standard_normal((n, m)), np.zeros((0, m)),
                      ((times, times**2), (times, 3.0 - times)))  # fmt: skip
    cubic = lambda q: (-(q**3), 3.0 * q[:, :, None] ** 2 * np.eye(m))  # noqa: E731
    problem = FrequencyProblem(None, K, C, M, T, loading, lambda t: 1.0 + t * t, basis, places,
                               cubic)  # fmt: skip
    u, t, h = rng.standard_normal(4), 1.4, 1e-6
    R, J, rate = problem.at(u, t)
    for j, step in enumerate(h * np.eye(4)):
        slope = (problem.at(u + step, t)[0] - problem.at(u - step, t)[0]) / (2 * h)
        np.testing.assert_allclose(J[:, j], slope, rtol=1e-6, atol=1e-6)
    slope = (problem.at(u, t + h)[0] - problem.at(u, t - h)[0]) / (2 * h)
    np.testing.assert_allclose(rate, slope, rtol=1e-6, atol=1e-6)
    w, U = 1.0 + t * t, (T @ u)
    F = loading.forces @ [2.2, 1.6]  # between the points of its curves
    f = np.zeros(n)
    q = basis.values @ U[places]
    f[places] = basis.back @ -(q**3)
    np.testing.assert_allclose(R, T.T @ ((K + w * C + w * w * M) @ U - F - f), rtol=1e-10)


def test_an_unbalance_drives_by_the_square_of_the_frequency():
    """Balance is that of a load w^2 times as large; its derivative is that of differences."""
    system = replace(duffing(2), unbalance=True)
    Q = np.linspace(-0.4, 0.3, 5)
    for w in (0.5, 1.0, 1.7):
        rest, _, by_w = system.at(Q, w)
        plain, _, _ = duffing(2).at(Q, w)
        load = system.load.ravel()
        np.testing.assert_allclose(rest, plain + load - w * w * load, atol=1e-14)
        ends = [system.at(Q, w + s * 1e-6)[0] for s in (1.0, -1.0)]
        np.testing.assert_allclose(by_w, (ends[0] - ends[1]) / 2e-6, atol=1e-8)
        assert system.force(w) == pytest.approx(LOAD * w * w)


def test_several_harmonics_are_the_motion_that_time_integration_settles_on():
    found = branch(duffing(7))
    stable = [i for i, u in enumerate(found.unstable) if not u]
    i = min(stable, key=lambda j: abs(found.frequencies[j] - 0.6))
    w, Q = found.frequencies[i], found.coefficients[i]
    system = duffing(7)

    def rates(t, y):
        return [y[1], LOAD * np.cos(w * t) - DAMPING * y[1] - y[0] - CUBIC * y[0] ** 3]

    start = [(system.basis.values[0] @ Q)[0], w * (system.basis.rates[0] @ Q)[0]]
    times = 2 * np.pi / w * np.arange(len(system.basis.values)) / len(system.basis.values)
    run = solve_ivp(rates, (0, times[-1]), start, t_eval=times, rtol=1e-11, atol=1e-12)
    assert np.abs(run.y[0] - (system.basis.values @ Q)[:, 0]).max() < 2e-6


def test_motions_between_the_limit_points_are_unstable():
    found = branch(duffing(5))
    w, unstable = np.array(found.frequencies), np.array(found.unstable)
    back = np.flatnonzero(np.diff(w) < 0)
    assert unstable[back[1:]].all()
    assert not unstable[: back[0]].any()
    assert not unstable[back[-1] + 2 :].any()


def test_exponents_are_those_that_perturbations_of_the_motion_show():
    found = branch(duffing(5), end=1.4)
    i = next(j for j, w in enumerate(found.frequencies) if w > 1.2)
    w, Q, system = found.frequencies[i], found.coefficients[i], duffing(5)

    def rates(t, y):
        q = float(
            Q[0, 0]
            + sum(
                Q[2 * k - 1, 0] * np.cos(k * w * t) + Q[2 * k, 0] * np.sin(k * w * t)
                for k in range(1, 6)
            )
        )
        stiffness = 1 + 3 * CUBIC * q**2
        return [y[1], -DAMPING * y[1] - stiffness * y[0], y[3], -DAMPING * y[3] - stiffness * y[2]]

    period = 2 * np.pi / w
    end = solve_ivp(rates, (0, period), [1, 0, 0, 1], rtol=1e-11, atol=1e-12).y[:, -1]
    multipliers = np.linalg.eigvals(end.reshape(2, 2).T)
    expected = np.sort_complex(np.log(multipliers.astype(complex)) / period)
    np.testing.assert_allclose(np.sort_complex(system.exponents(Q, w)), expected, atol=1e-8)


def test_exponents_of_constant_coefficients_are_eigenvalues():
    M, C, K = np.diag([1.0, 2.0]), np.array([[0.2, 0.1], [0.1, 0.3]]), np.diag([0.04, 0.3])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    found = exponents(M, C[None], K[None], 2.0)
    np.testing.assert_allclose(
        np.sort_complex(found), np.sort_complex(np.linalg.eigvals(A)), atol=1e-9
    )


def test_monodromy_keeps_the_volume_that_damping_leaves():
    angles = 2 * np.pi * np.arange(32) / 32
    K = (1.0 + 0.6 * np.cos(angles))[:, None, None]
    P = monodromy(np.eye(1), np.full((32, 1, 1), 0.2), K, 1.3)
    assert np.linalg.det(P) == pytest.approx(np.exp(-0.2 * 2 * np.pi / 1.3), rel=1e-10)


def test_normal_mode_of_a_cubic_spring_has_the_period_of_the_elliptic_integral():
    from scipy.special import ellipk

    found = normal_mode(
        duffing(9, load=0.0, damping=0.0), 0, 1e-3, 4.0, Lengths(0.05, 1e-4, 0.2), 200
    )
    for w, Q, energy in zip(found.frequencies, found.coefficients, found.energies, strict=True):
        a = Q[1::2, 0].sum()  # the greatest displacement, all cosines in step
        assert energy == pytest.approx(0.5 * a**2 + 0.25 * CUBIC * a**4, rel=1e-5)
        k2 = 0.5 * CUBIC * a**2 / (1 + CUBIC * a**2)
        exact = np.pi * np.sqrt(1 + CUBIC * a**2) / (2 * ellipk(k2))
        assert w == pytest.approx(exact, rel=1e-6)
    assert found.energies[-1] > 4.0
    assert max(e.real.max() for e in found.exponents) < 1e-3  # of a centre: none grows


def test_velocity_dependent_forces_have_their_derivatives():
    class Drag:
        """f = -c v |v|, written smooth."""

        def at(self, q, v):
            s = np.sqrt(v**2 + 1e-2)
            return (
                -0.3 * v * s,
                np.zeros((*v.shape, v.shape[1])),
                (-0.3 * (s + v**2 / s))[..., None] * np.eye(v.shape[1]),
            )

    system = duffing(3, forces=Drag())
    rng = np.random.default_rng(1)
    u, w = rng.normal(size=system.size), 1.3
    _, J, Rw = system.at(u, w)
    h = 1e-6
    for i in range(system.size):
        e = np.eye(system.size)[i]
        column = (system.at(u + h * e, w)[0] - system.at(u - h * e, w)[0]) / (2 * h)
        np.testing.assert_allclose(J[:, i], column, atol=1e-7)
    by_w = (system.at(u, w + h)[0] - system.at(u, w - h)[0]) / (2 * h)
    np.testing.assert_allclose(Rw, by_w, atol=1e-7)


def test_derivative_matrix_turns_cosines_into_sines():
    basis = basis_of(4, 32)
    Q = np.random.default_rng(0).normal(size=9)
    np.testing.assert_allclose(
        basis.values @ (derivative_matrix(4) @ Q), basis.rates @ Q, atol=1e-12
    )


def test_a_period_doubling_is_found_and_named():
    class Mathieu:
        """A spring that stiffens in time with the motion: q1 drives the stiffness of q2."""

        def at(self, q, v):
            f, fq = np.zeros_like(q), np.zeros((len(q), 2, 2))
            f[:, 1] = -q[:, 0] * q[:, 1]
            fq[:, 1, 0], fq[:, 1, 1] = -q[:, 1], -q[:, 0]
            return f, fq, np.zeros_like(fq)

    load = np.zeros((7, 2))
    load[1, 0] = 30.0 * 0.4  # q1 = 0.4 cos wt at low frequency
    system = Oscillators(
        np.eye(2), np.diag([0.1, 0.05]), np.diag([30.0, 0.25]), basis_of(3, 64), Mathieu(), load
    )
    found = forced_response(
        system, np.zeros((7, 2)), 0.7, 1.6, 1.0, Lengths(0.02, 1e-4, 0.02, tolerance=1e-11), 400
    )
    kinds = [b.kind for b in found.bifurcations]
    assert "PD" in kinds
    first = found.bifurcations[kinds.index("PD")]
    assert first.new_frequency == pytest.approx(0.5 * first.frequency)
    q1 = (system.basis.values @ first.coefficients)[:, 0]
    K = (0.25 + q1)[:, None, None]
    multipliers = np.linalg.eigvals(
        monodromy(np.eye(1), np.full((64, 1, 1), 0.05), K, first.frequency)
    )
    assert np.abs(multipliers + 1).min() < 1e-4


def test_no_first_solution_is_said():
    class Never:
        def at(self, u, t):
            return u**2 + 1.0, np.diag(2 * u), np.zeros(1)

        def force(self, t):
            return 1.0

    with pytest.raises(ConvergenceError, match="no first solution"):
        Tracer(Never(), Lengths(0.1, 0.01, 1.0)).first(np.array([0.3]), 0.0)


def test_a_step_around_a_limit_point_ends_just_beyond_it():
    class Circle:
        def at(self, u, t):
            return np.array([u[0] ** 2 + t**2 - 1]), np.array([[2 * u[0]]]), np.array([2 * t])

        def force(self, t):
            return 1.0

    tracer = Tracer(Circle(), Lengths(0.1, 1e-4, 0.3, tolerance=1e-12))
    first = tracer.first(np.array([-1.0]), 0.0)
    found = tracer.follow(first, 60, lambda t: t > -0.5, land=True)
    t, u = np.array([p.t for p in found.points]), np.array([p.u[0] for p in found.points])
    np.testing.assert_allclose(u**2 + t**2, 1.0, atol=1e-10)
    top = int(np.argmax(t))
    assert 0 < u[top] < 2e-3
    assert 1 - t[top] < 1e-5
