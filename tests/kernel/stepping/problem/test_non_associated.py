"""Non-associated relations (C u = d, pushing by D^T lambda) beside joints, static and in time."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder, assert_alike, recorded
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.relations import Term, relation_rows
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping.driven import Additions
from ssilang.kernel.stepping.newmark import Scheme, hht
from ssilang.kernel.stepping.run import integrate

KN, K1, K2, M1, M2 = 5e4, 2e4, 3e4, 2.0, 3.0
C, D = np.array([1.0, -0.5]), np.array([1.0, -0.2])


def lever():
    """Two masses on springs, the first on a joint; u1 = u2/2, but the pull on u2 is 0.2."""
    bench = Bench()
    one, two, soil = bench.node(0.0, 0.0), bench.node(1.0, 0.0), bench.node(0.0, -1.0)
    bench.fix(soil)
    for a in (one, two):
        bench.fix(a, "UX")
    bench.spring(K1, one)
    bench.spring(K2, two)
    bench.mass(M1, one)
    bench.mass(M2, two)
    bench.relate([(C[0], "UY", one), (C[1], "UY", two)])
    rows = bench.relations[-1]
    pull = [Term(D[0], "UY", np.array([one])), Term(D[1], "UY", np.array([two]))]
    dual = relation_rows(bench.table, pull, 0)
    bench.relations[-1] = replace(rows, dual=replace(dual, raw_multipliers=rows.raw_multipliers))
    bench.joint("SEG2", [soil, one], "JOI1", KN=KN, KS=0.0)
    return bench, one, two


def problem_of(bench, times, load, scheme=None, start=None):
    return bench.problem(times, load, displacement=start, scheme=scheme or Scheme())


def where(problem, *nodes):
    return [problem.numbering.index_of(n, "UY") for n in nodes]


@together("force", [-100.0, 80.0])
def test_equilibrium_is_that_of_the_saddle_point(force):
    bench, one, two = lever()
    load = bench.load(bench.field((one, "FY", force), (two, "FY", 10.0)))
    problem = problem_of(bench, np.array([0.0, 1.0]), load)
    recorder = Recorder(2)
    history = step_statics(problem, [recorder])
    i = where(problem, one, two)
    closed = KN if recorder.of("u")[-1][i[0]] < 0 else 0.0
    saddle = np.block([[np.diag([K1 + closed, K2]), D[:, None]], [C[None, :], np.zeros((1, 1))]])
    u = np.linalg.solve(saddle, [force, 10.0, 0.0])
    assert (u[0] < 0) == (force < 0)
    assert recorder.of("u")[-1][i] == pytest.approx(u[:2], rel=1e-12)
    pushed = recorder.snapshots[-1].reactions.values_at("FY", np.array([one, two]))
    assert pushed == pytest.approx(-D * u[2], rel=1e-9)
    assert abs(history.imbalance[-1]) <= 1e-12 * abs(history.energies[-1]).max()


def newmark(times, u0, force):
    """Average acceleration with the saddle point, the joint found by trial."""
    M, dt = np.diag([M1, M2]), times[1]
    u, v, found = u0.copy(), np.zeros(2), [u0.copy()]
    saddle = lambda A: np.block([[A, D[:, None]], [C[None, :], np.zeros((1, 1))]])  # noqa: E731
    stiffness = lambda w: np.diag([K1 + (KN if w < 0 else 0.0), K2])  # noqa: E731
    a = np.linalg.solve(saddle(M), [*(force - stiffness(u[0]) @ u), 0.0])[:2]
    for _ in times[1:]:
        for sign in (-1.0, 1.0):
            A = stiffness(sign) + 4 / dt**2 * M
            new = np.linalg.solve(
                saddle(A), [*(force + M @ (4 / dt**2 * u + 4 / dt * v + a)), 0.0]
            )[:2]
            if new[0] * sign >= 0:
                break
        v_new = 2 * (new - u) / dt - v
        a = 2 * (v_new - v) / dt - a
        u, v = new, v_new
        found.append(u.copy())
    return np.array(found)


def test_motion_is_that_of_the_saddle_point():
    bench, one, two = lever()
    times = np.arange(401) * 1e-3
    start = np.array([1e-2, 2e-2])
    load = bench.load(bench.field((one, "FY", -40.0)))
    field = bench.field((one, "UY", start[0]), (two, "UY", start[1]))
    problem = problem_of(bench, times, load, start=field)
    recorder, history = recorded(problem)
    u = recorder.of("u")[:, where(problem, one, two)]
    exact = newmark(times, start, np.array([-40.0, 0.0]))
    assert (exact[:, 0] < 0).any()
    assert (exact[:, 0] > 0).any()
    assert np.abs(u - exact).max() <= 1e-9 * np.abs(exact).max()
    assert np.abs(history.imbalance).max() <= 5e-3 * history.energies[0].sum()


@pytest.mark.parametrize("scheme", [hht(0.1), Scheme(conserving=True), Scheme(adaptive=True)])
def test_every_scheme_keeps_the_relation(scheme):
    bench, one, two = lever()
    times = np.arange(201) * 1e-3
    field = bench.field((one, "UY", 1e-2), (two, "UY", 2e-2))
    problem = problem_of(bench, times, None, scheme, field)
    recorder, history = recorded(problem)
    u = recorder.of("u")[:, where(problem, one, two)]
    assert np.abs(u @ C).max() <= 1e-14
    assert np.abs(u - newmark(times, u[0], np.zeros(2))).max() <= 0.2 * 2e-2
    if scheme.conserving:
        assert np.abs(history.imbalance).max() <= 1e-11 * history.energies[0].sum()


def test_what_is_added_at_each_step_acts_as_what_the_problem_has():
    """A relation with a dual and its moving value, a spring, a dashpot, a force."""
    bench, one, two = lever()
    bench.dashpot(90.0, two)
    times, (link,) = np.arange(41) * 5e-3, bench.relations[-1].multipliers
    curves = np.cos(11.0 * times), np.sin(37.0 * times)

    def fields(*sizes):
        return bench.field((one, "FY", -40.0 * sizes[0])), bench.field((int(link), "FLX", sizes[1]))

    parts = zip(fields(1.0, 1e-3), curves, strict=True)
    load = Load(tuple(LoadPart("MECA", f, Curve((CurvePart(times, x),))) for f, x in parts))
    whole = recorded(bench.problem(times, load))
    spring, relation = bench.stiffness_blocks.pop(), bench.relations.pop()
    added = Matrix(bench.table, (spring,)), bench.damping, Matrix(bench.table, (), (relation,))
    bench.damping_blocks.clear()

    def driver(time, state, problem):
        return Additions(*added, *fields(np.cos(11.0 * time), 1e-3 * np.sin(37.0 * time)))

    found = recorded(bench.problem(times), driver=driver)
    assert (whole[0].of("w") < 0.0).any()
    assert_alike(found, whole, ("u", "v", "a", "w", "t"))


def one_sided():
    bench, one, two = lever()
    rows = bench.relations[-1]
    one_row = np.ones(1, np.int8)
    bench.relations[-1] = replace(rows, sense=one_row, dual=replace(rows.dual, sense=one_row))
    return bench, one, two


def test_unilateral_relation_with_a_dual_holds_and_lets_go():
    """u1 never goes below u2/2; where it leaves it nothing pulls on either mass."""
    bench, one, two = one_sided()
    times = np.arange(401) * 1e-3
    field = bench.field((one, "UY", 1e-2), (two, "UY", 2e-2))
    load = bench.load(bench.field((one, "FY", -40.0)))
    problem = problem_of(bench, times, load, start=field)
    recorder, _ = recorded(problem)
    gap = recorder.of("u")[:, where(problem, one, two)] @ C
    push = recorder.of("contact")[:, 0]
    assert gap.min() >= -1e-15
    assert (gap > 1e-4).any()
    assert ((push > 0.1) & (gap < 1e-15)).any()
    assert push[gap > 1e-12].max() == 0.0
    forces = recorder.of("reaction")[:, where(problem, one, two)]
    assert np.abs(forces - push[:, None] * D).max() <= 1e-9 * push.max()


def test_conserving_step_refuses_a_unilateral_relation_with_a_dual():
    bench, _one, _two = one_sided()
    problem = problem_of(bench, np.array([0.0, 1.0]), None, Scheme(conserving=True))
    with pytest.raises(KernelError, match="conserving step"):
        integrate(problem, [])
