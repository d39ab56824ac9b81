"""Harmonic balance against closed forms, time integration and constant coefficients."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.sparse import csr_array
from together import together

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.continuation.arc import Lengths, Point, Tracer
from ssilang.kernel.continuation.expansion import FrequencyProblem
from ssilang.kernel.continuation.harmonics import (
    ONE,
    LinkForces,
    Oscillators,
    basis_of,
    crossing,
    monodromy,
    unstable,
)
from ssilang.kernel.continuation.response import (
    FreeMotion,
    _perturbation,
    forced_response,
    normal_mode,
)
from ssilang.kernel.modal import link_laws as law
from ssilang.kernel.modal.links import Link, link_arrays
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
    cubic = lambda q, t: (-t * q**3, 3.0 * t * q[:, :, None] ** 2 * np.eye(m))  # noqa: E731
    problem = FrequencyProblem(None, K, C, M, T, loading, lambda t: 1.0 + t * t, basis, places,
                               cubic, timed=True)  # fmt: skip
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
    f[places] = basis.back @ (-t * q**3)
    np.testing.assert_allclose(R, T.T @ ((K + w * C + w * w * M) @ U - F - f), rtol=1e-10)


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
    for scale in (0.01, 100.0):  # in any unit of time
        assert not unstable(np.array([-1.0, 0.5j + 0.6 * ONE]) * scale, scale)
        assert unstable(np.array([-1.0, 0.5j + 1.6 * ONE]) * scale, scale)


@together(
    "grown, kind",
    [
        ([1e-3], "BP"),
        ([1e-3 + 0.6j, 1e-3 - 0.6j], "PD"),
        ([1e-3 - 0.2j, 1e-3 + 0.2j], "NS"),
        ([], ""),
    ],
)
def test_what_crosses_the_axis_is_named_whatever_has_grown_before(grown, kind):
    calm = np.array([-0.3, -0.2 + 0.1j])
    before = np.array([0.4 + 0.5j, *calm])
    after = np.array([0.4 + 0.5j, *grown, *calm])
    assert crossing(before, after, (1.1, 1.2)) == kind
    assert crossing(after, before, (1.2, 1.1)) == kind


def test_monodromy_is_what_a_period_makes_of_each_perturbation():
    rng, w, angles = np.random.default_rng(5), 1.3, 2 * np.pi * np.arange(32) / 32
    M, *parts = rng.standard_normal((7, 2, 2)) + 2.0 * np.eye(2)
    at = lambda t, i: parts[i] + np.cos(t) * parts[i + 1] + np.sin(2 * t) * parts[i + 2]  # noqa: E731
    C, K = (np.array([at(t, i) for t in angles]) for i in (0, 3))

    def rates(t, y):
        q, v = y.reshape(2, 2, 4)
        return np.ravel([v, -np.linalg.solve(M, at(w * t, 0) @ v + at(w * t, 3) @ q)])

    run = solve_ivp(rates, (0, 2 * np.pi / w), np.eye(4).ravel(), rtol=1e-11, atol=1e-12)
    wanted = run.y[:, -1].reshape(4, 4)
    np.testing.assert_allclose(monodromy(M, C, K, w), wanted, atol=1e-6 * np.abs(wanted).max())


def test_a_perturbation_is_after_a_period_what_it_was_times_its_growth():
    class Rubbing:
        def at(self, q, v):
            slopes = (-0.9 * q**2 - 0.8 * q * v, -0.4 * q**2)
            return -0.3 * q**3 - 0.4 * q**2 * v, *(s[:, :, None] * np.eye(2) for s in slopes)

    M, w, Q = np.diag([1.0, 2.0]), 1.3, np.zeros((29, 2))
    C, K = np.array([[0.1, 0.05], [0.02, 0.3]]), np.array([[2.0, -0.5], [-0.5, 3.0]])
    system = Oscillators(M, C, K, basis_of(14, 128), Rubbing(), np.zeros((29, 2)))
    Q[1:3] = [[0.8, -0.3], [0.2, 0.5]]
    point = Point(Q.ravel(), w, np.zeros(0), system.at(Q.ravel(), w)[1])
    _, fq, fv = system.sampled(Q, w)
    period = monodromy(M, C - fv, K - fq, w)
    for growth in system.exponents(Q, w).tolist():
        shape = _perturbation(system, point, growth).reshape(29, 2)
        place, speed = system.basis.values[0] @ shape, w * system.basis.rates[0] @ shape
        state = np.concatenate([place, speed + growth * place])
        after = np.exp(growth * 2 * np.pi / w) * state
        np.testing.assert_allclose(period @ state, after, atol=1e-6 * np.abs(state).max())


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


class Coupled:
    """Forces on each of two unknowns by motion and velocity of both, with no symmetry."""

    def at(self, q, v):
        (x, y), (a, b) = q.T, v.T
        f = np.stack([-x * y**2 - 0.3 * a**2 * b, 0.2 * x * b - y**3], axis=1)
        fq = np.array([[-(y**2), -2 * x * y], [0.2 * b, -3 * y**2]])
        fv = np.array([[-0.6 * a * b, -0.3 * a**2], [0.0 * x, 0.2 * x]])
        return f, np.moveaxis(fq, -1, 0), np.moveaxis(fv, -1, 0)


@pytest.mark.parametrize("unbalance", [False, True])
def test_a_balance_is_that_of_motions_in_time_and_its_slopes_those_of_differences(unbalance):
    """Two unknowns with full matrices; the balance of free motions, with its energy, too."""
    rng, w, n = np.random.default_rng(1), 1.3, 64
    M, C, K = rng.standard_normal((3, 2, 2)) + 3.0 * np.eye(2)
    load = rng.standard_normal((7, 2))
    system = Oscillators(M, C, K, basis_of(3, n), Coupled(), load, unbalance)
    u = rng.standard_normal(14)

    def in_time(coefficients):
        Q = coefficients.reshape(7, 2)
        terms = np.vstack([Q[:1], Q[1::2] - 1j * Q[2::2]])
        turns = np.exp(1j * np.outer(2 * np.pi * np.arange(n) / n, np.arange(4)))
        return [(turns * (1j * w * np.arange(4)) ** k @ terms).real for k in range(3)]

    q, v, a = in_time(u)
    force = in_time(load)[0] * (w * w if unbalance else 1.0)
    left = np.fft.rfft(a @ M.T + v @ C.T + q @ K.T - Coupled().at(q, v)[0] - force, axis=0)[:4] / n
    wanted = [left[0].real, *(x for c in left[1:] for x in (2 * c.real, -2 * c.imag))]
    np.testing.assert_allclose(system.at(u, w)[0], np.concatenate(wanted), atol=1e-12)
    rows = load * (w * w if unbalance else 1.0)
    assert system.force(w) == pytest.approx(np.sqrt((rows**2).sum()))
    own = replace(system, M=M + M.T, K=K + K.T)  # have an energy
    free, h = FreeMotion(own, 1), 1e-6
    for problem, x, t in ((system, u, w), (free, np.append(u, [w, 0.3]), 0.7)):
        _, J, by_t = problem.at(x, t)
        for step, slope in zip(h * np.eye(len(x)), J.T, strict=True):
            by = (problem.at(x + step, t)[0] - problem.at(x - step, t)[0]) / (2 * h)
            np.testing.assert_allclose(slope, by, atol=1e-7 * np.abs(J).max())
        by = (problem.at(x, t + h)[0] - problem.at(x, t - h)[0]) / (2 * h)
        np.testing.assert_allclose(by_t, by, atol=1e-7 * np.abs(J).max())
    assert free.at(np.append(u, [w, 0.3]), 0.7)[0][-2] == u.reshape(7, 2)[2, 1]  # its first sine
    linear = replace(own, C=0 * C, forces=LinkForces(link_arrays([], 2)))
    for mode in (0, 1):
        motion = FreeMotion(linear, mode)
        assert np.abs(motion.at(motion.guess(0.7), 0.7)[0]).max() < 1e-12


def test_links_are_sampled_with_their_slopes():
    rng, n = np.random.default_rng(4), 3
    rows = rng.standard_normal((4, n))
    links = [
        Link(law.POWER, rows[:1], rows[1:2], {law.FACTOR: 1.7, law.EXPONENT: 3.0}),
        Link(law.VELOCITY, rows[2:3], rows[3:], {law.FACTOR: -0.6}),
    ]
    q, v = rng.standard_normal((2, 5, n))
    f, fq, fv = LinkForces(link_arrays(links, n)).at(q, v)
    np.testing.assert_allclose(
        f, np.outer(1.7 * (q @ rows[1]) ** 3, rows[0]) - 0.6 * np.outer(v @ rows[3], rows[2])
    )
    slope = np.einsum("t,i,j->tij", 5.1 * (q @ rows[1]) ** 2, rows[0], rows[1])
    np.testing.assert_allclose(fq, slope, rtol=1e-6, atol=1e-6)
    drag = np.tile(-0.6 * np.outer(rows[2], rows[3]), (5, 1, 1))
    np.testing.assert_allclose(fv, drag, rtol=1e-6, atol=1e-6)


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


@pytest.mark.parametrize(("most", "ended"), [(200, "no solution"), (3, "steps")])
def test_a_branch_ends_where_its_equation_does(most, ended):
    class Line:
        def at(self, u, t):
            return np.array([u[0] - 2.0 * t + 0.0 * np.sqrt(0.5 - t)]), np.eye(1), np.array([-2.0])

        def force(self, t):
            return 1.0

    tracer = Tracer(Line(), Lengths(0.1, 1e-3, 0.1))
    with np.errstate(invalid="ignore"):
        found = tracer.follow(tracer.first(np.array([0.0]), 0.0), most, lambda t: True)
        asked = tracer.follow(found.points[0], 200, lambda t: True, lambda a, b, ds: b.t < 0.2)
    assert found.ended == ended
    if ended == "steps":
        assert len(found.points) == most + 1
    else:
        assert 0.5 - 2e-3 < found.points[-1].t <= 0.5
    assert (asked.ended, asked.points[-2].t < 0.2 <= asked.points[-1].t) == ("asked", True)


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
