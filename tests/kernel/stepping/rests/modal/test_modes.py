"""The loops of small problems against the loop on sparse matrices, step by step."""

from dataclasses import replace

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import assert_alike, recorded

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.stepping.choose import Case, Choice, choose, only
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark
from ssilang.kernel.stepping.problem.problem import Inputs, make_problem
from ssilang.kernel.stepping.rests.modal.modes import SmallLoop
from ssilang.kernel.stepping.run import Integration, integrate

SCHEMES = [Scheme(), newmark(0.36, 0.7), hht(0.1), generalised_alpha(0.7)]
LAWS = {
    "no tension": {"KN": 7e6, "KS": 0.0},
    "softening": {"KN": 7e6, "KS": 2e6, "FU": 2e4, "GF": 150.0},
    "closing": {"KN": 7e6, "KS": 2e6, "FC": -2e4, "FROT": 0.3},
    "softening and closing": {"KN": 7e6, "KS": 0.0, "FU": 2e4, "GF": 150.0, "FC": -1e4},
}
TIMES = 1e-3 * np.arange(401)


def problem_of(
    law: dict[str, float], scheme: Scheme = SCHEMES[0], joints: int = 1, shear: bool = False,
    damping: float = 0.0, dashpot: float = 0.0, massless: bool = False,
):  # fmt: skip
    """Masses in a row on springs, the first `joints` on joints; pushed and released."""
    bench, tops = Bench(), []
    for i in range(max(joints, 1)):
        ground, top = bench.node(-1.0, float(i)), bench.node(0.0, float(i))
        bench.fix(ground)
        bench.spring(4e6, top, unknown="UX")
        bench.spring(3e6, top, unknown="UY")
        if not massless or i:
            bench.mass(1000.0 + 300.0 * i, top)
        if not shear:
            bench.fix(top, "UY")
        if dashpot and not (damping and i):
            bench.dashpot(dashpot, top, "UX")
        if i < joints:
            bench.joint("SEG2", [ground, top], "JOI1", **law)
        if tops:
            bench.spring(2e6, tops[-1], top, unknown="UX")
        tops.append(top)
    push = bench.field(*((t, "FX", 6e4) for t in tops), *((t, "FY", 2e4) for t in tops))
    K, M, C = bench.stiffness, bench.mass_matrix, bench.damping
    if damping:
        given = () if C is None else C.blocks
        C = Matrix(K.table, M.scaled(damping).blocks + K.scaled(1e-3 * damping).blocks + given)
    start = bench.field(*((t, "UX", 0.01 * (i + 1)) for i, t in enumerate(tops)))
    return make_problem(
        Inputs(
            K, TIMES, M, C, bench.load(push, TIMES, np.sin(40.0 * TIMES)), start,
            model=bench.model, characteristics=bench.characteristics, scheme=scheme,
        )
    )  # fmt: skip


def compared(problem, monkeypatch, tolerance: float = 1e-11):
    """Run both loops, check which small one ran, compare all that instants hold."""
    choice = choose(Case(problem, Integration(problem).motion, 1e-3))
    assert isinstance(choice.loop, SmallLoop)
    few, found = recorded(problem)
    monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only("condensed"))
    other, truth = recorded(problem)
    assert (found.loop, truth.loop) == ("compiled", "condensed")
    assert_alike((few, found), (other, truth), tolerance=tolerance)
    size = np.abs(truth.energies).max()
    assert found.worst_imbalance == pytest.approx(truth.worst_imbalance, abs=1e-9 * size)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_one_spring_steps_as_the_sparse_loop(law, scheme, monkeypatch):
    compared(problem_of(law, scheme), monkeypatch)


@pytest.mark.parametrize("joints", [0, 1, 3])
def test_damping_of_rayleigh_is_diagonal(joints, monkeypatch):
    problem = problem_of(LAWS["no tension"], joints=joints, damping=2.0)
    compared(problem, monkeypatch)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_unequal_dashpots_pull_beside_the_modes(law, scheme, monkeypatch):
    """Beside Rayleigh damping, with and without shear: they are no part of the modes."""
    problem = problem_of(law, scheme, 5, shear=True, damping=1.5, dashpot=4e3)
    loop = choose(Case(problem, Integration(problem).motion, 1e-3)).loop
    assert 0 < len(loop.modes.sense) < loop.modes.size
    compared(problem, monkeypatch, tolerance=1e-10)


def test_without_common_modes_the_damping_is_dashpots_alone(monkeypatch):
    problem = problem_of(LAWS["no tension"], joints=3, dashpot=4e3)
    compared(problem, monkeypatch)


def test_a_mass_that_a_dashpot_alone_holds_has_no_modes(monkeypatch):
    """Nor has the part of the step's matrix that is left without it an inverse."""
    problem = problem_of(LAWS["no tension"], joints=3, dashpot=4e3)
    n = problem.numbering.size
    at = problem.numbering.where("UX")[-1]
    K, M = (x.toarray() for x in (problem.K, problem.M))
    K[at], K[:, at], M[at, at] = 0.0, 0.0, 0.0
    C = np.diag(np.arange(n) % 3 * 100.0)
    C[at, at] = 5e3
    lone = replace(problem, K=sp.csr_array(K), M=sp.csr_array(M), C=sp.csr_array(C))
    assert choose(Case(lone, Integration(lone).motion, 1e-3)).rule.name == "dissection"


def test_motions_without_mass_follow_their_loads(monkeypatch):
    problem = problem_of(LAWS["softening"], joints=2, massless=True)
    compared(problem, monkeypatch, tolerance=1e-10)


def test_motions_without_mass_keep_their_velocity_and_acceleration(monkeypatch):
    """A node without mass between springs: its mode does not move, but its acceleration starts."""
    bench, times = Bench(), 1e-3 * np.arange(301)
    ground, top, middle = bench.node(-1.0, 0.0), bench.node(0.0, 0.0), bench.node(0.0, 1.0)
    bench.fix(ground)
    bench.fix(top, "UY")
    bench.fix(middle, "UY")
    bench.spring(4e6, top, unknown="UX")
    bench.spring(3e6, top, middle, unknown="UX")
    bench.spring(2e6, middle, unknown="UX")
    bench.mass(1000.0, top)
    bench.joint("SEG2", [ground, top], "JOI1", KN=7e6, KS=0.0)
    start = bench.field((top, "UX", 0.01), (middle, "UX", 0.006))
    problem = bench.problem(times, displacement=start, scheme=newmark(0.3, 0.6))
    compared(problem, monkeypatch)


def test_steps_of_two_lengths_hand_over_their_state(monkeypatch):
    problem = problem_of(LAWS["closing"])
    times = np.cumsum(np.concatenate([[0.0], np.tile([1e-3] * 7 + [5e-4] * 4, 30)]))
    compared(replace(problem, times=times), monkeypatch)


def test_steps_that_differ_by_rounding_share_their_engine(monkeypatch):
    made = []

    def counted(case: Case) -> Choice:
        made.append(case)
        return choose(case)

    monkeypatch.setattr("ssilang.kernel.stepping.run.choose", counted)
    integrate(replace(problem_of(LAWS["no tension"]), times=0.1 + 2.5e-4 * np.arange(30_000)))
    assert len(made) == 1


@pytest.mark.parametrize("name", ["no tension", "softening and closing"])
def test_joints_without_shear_stiffness_step_along_their_normals(name, monkeypatch):
    problem = problem_of(LAWS[name], joints=4, shear=True)
    assert choose(Case(problem, Integration(problem).motion, 1e-3)).loop.normal is not None
    compared(problem, monkeypatch, tolerance=1e-10)


def test_held_unknowns_do_not_make_a_problem_large(monkeypatch):
    problem = problem_of(LAWS["no tension"], joints=3)
    monkeypatch.setattr("ssilang.kernel.stepping.problem.problem.SMALL", 3)
    assert problem.numbering.size > 3
    assert integrate(problem).loop == "compiled"
