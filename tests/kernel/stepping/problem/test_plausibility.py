"""What is told of a problem before it steps: bodies, swings, masses alone, dampings, steps."""

import numpy as np
import pytest
import scipy.sparse as sp
from references.assembled import Bench
from together import together

from ssilang.kernel.curves.curve import Load
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.stepping.problem import plausibility, problem
from ssilang.kernel.stepping.problem.bodies import full_uplift, loose_bodies
from ssilang.kernel.stepping.problem.constraints import split_damping
from ssilang.kernel.stepping.problem.plausibility import (
    Resolution,
    Start,
    against_supports,
    contact_resolution,
    masses_alone,
    stiffness_contrast,
    swings,
)

T = 1e-3 * np.arange(41)


def swings_of(problem):
    """`swings` with the factors of the problem's loads."""
    return swings(problem, problem.loading.at(problem.times))


def block(**change):
    """A body of two masses over a joint, beside it a held one; pushed by a weight and a sine."""
    given = {"side": 0.0, "weight": -100.0, "push": 0.0, "kn": 1e6, "ks": 0.0, "stop": False,
             "size": 2.0, "start": 0.0} | change  # fmt: skip
    b = Bench()
    low, one, two, apart = (b.node(*p) for p in ((0, -1), (0, 0), (given["size"], 0), (9, 9)))
    b.n = (low, one, two, apart)
    b.fix(low)
    b.fix(apart, "UX")
    b.spring(5e3, apart)
    for node, m in ((one, 2.0), (two, 3.0), (apart, 1.0)):
        b.mass(m, node)
    for u in ("UX", "UY"):
        b.spring(1e7, one, two, u)
    if given["side"]:
        b.spring(given["side"], two, unknown="UX")
    if given["stop"]:
        b.relate([(1.0, "UY", two)], sense=1)
    else:
        b.joint("SEG2", [low, one], "JOI1", KN=given["kn"], KS=given["ks"], V1X=0.0, V1Y=1.0)
    parts = ()
    if given["weight"]:
        parts += b.load(
            b.field((one, "FY", given["weight"] / 2), (two, "FY", given["weight"] / 2))
        ).parts
    if given["push"]:
        parts += b.load(b.field((two, "FX", given["push"])), T, np.sin(100 * T)).parts
    start = b.field((one, "UX", given["start"])) if given["start"] else None
    return b, b.problem(T, Load(parts) if parts else None, displacement=start)


@together(
    "change, told",
    [
        ({}, []),  # pressed on its joint; nothing moves it along x
        ({"push": 50.0, "ks": 1e5}, []),
        ({"push": 50.0, "side": 1e4, "weight": 0.0}, [("UY", True)]),  # nothing presses it
        ({"push": 50.0, "side": 1e4, "weight": 100.0}, []),  # pulled off, and stands until then
        ({"push": 50.0, "side": 1e4, "weight": 0.0, "start": 1e-3}, [("UY", True)]),
        ({"push": 50.0, "weight": 0.0}, [("UX", False), ("UY", True)]),
        ({"stop": True, "push": 50.0}, [("UX", False)]),
        ({"stop": True, "push": 50.0, "side": 1e3}, []),
    ],
)
def test_bodies_that_nothing_holds_or_presses(change, told):
    b, problem = block(**change)
    found = list(Start(problem, None).loose())
    assert [(x.axis, x.pressed) for x in found] == told
    assert all(x.node in map(b.table.told, b.n[1:3]) for x in found)


@together("kn, size", [(1e6, 2.0), (3.0, 2.0), (3.0, 90.0), (3.0, 350.0)])
def test_bodies_that_their_joints_let_sink(kn, size):
    b, problem = block(kn=kn, size=size)
    found = list(Start(problem, None).sunk())
    way = 100.0 / kn
    if way <= 0.1 * size:
        assert found == []
        return
    (one,) = found
    assert (one.axis, one.node) == ("UY", b.table.told(b.n[1]))
    assert (one.way, one.size) == (pytest.approx(way, rel=1e-6), pytest.approx(size))


def masses(*loads, c=0.0, v=None, free=False):
    """Two unlike masses on springs in a row; loads are of both, times curves."""
    b = Bench()
    n = [b.node(0.0, 0.0), b.node(1.0, 0.0)]
    b.n = n
    for node, m in zip(n, (2.0, 5.0), strict=True):
        b.mass(m, node, ("UY",))
    if not free:
        b.spring(3e4, n[0])
    b.spring(8e4, n[0], n[1])
    if c:
        b.dashpot(c, n[1])
    parts = ()
    for first, second, factors in loads:
        parts += b.load(b.field((n[0], "FY", first), (n[1], "FY", second)), T, factors).parts
    velocity = None if v is None else b.field((n[0], "UY", v), (n[1], "UY", 2 * v))
    return b.problem(T, Load(parts), velocity=velocity)


SINE, STEP = np.sin(30 * T), (T > 0.01) * 1.0


def counting(function, counted):
    """The function, that counts its calls by its name."""

    def count(*args):
        counted[function.__name__] = counted.get(function.__name__, 0) + 1
        return function(*args)

    return count


def test_periods_are_rayleighs_of_the_static_shape(monkeypatch):
    K, M = np.array([[11e4, -8e4], [-8e4, 8e4]]), np.diag([2.0, 5.0])
    loads = (
        (7.0, -2.0, SINE),
        (1.0, 4.0, STEP),
        (1.0, 1.0, np.ones(41)),
        (1.0, 0.5, np.sin(350 * T)),
    )
    found = [*swings_of(masses(*loads, c=60.0, v=0.3))]
    assert [s.sudden for s in found] == [False, True, True, True]
    forces = [7.0, -2.0], [1.0, 4.0], [1.0, 0.5], M @ [0.3, 0.6]
    for s, f in zip(found, forces, strict=True):
        x = np.linalg.solve(K, f)
        moved, work = x @ M @ x, x @ f
        assert s.period == pytest.approx(2 * np.pi * np.sqrt(moved / work))
        assert s.damping == pytest.approx(60.0 * x[1] ** 2 / (2 * np.sqrt(work * moved)))
    b = Bench()  # what stands on a support that moves swings as the inertia of going along asks
    n = [b.node(float(i), 0.0) for i in range(3)]
    for i, (m, k) in enumerate(((2.0, 3e4), (5.0, 8e4))):
        b.mass(m, n[i + 1], ("UY",))
        b.spring(k, n[i], n[i + 1])
    base = b.relate([(1.0, "UY", n[0])])
    pull = NodeField.of(b.table, np.array([base]), {"FLX": np.array([0.4])})
    counted = {}
    for name in ("solver_of", "closed_forces"):
        monkeypatch.setattr(plausibility, name, counting(getattr(plausibility, name), counted))
    monkeypatch.setattr(problem, "closed_forces", plausibility.closed_forces)
    (carried,) = swings_of(b.problem(T, b.load(pull, T, SINE)))
    x = np.linalg.solve(K, M @ [1.0, 1.0])
    assert carried.period == pytest.approx(2 * np.pi * np.sqrt(x @ M @ x / (x @ M @ [1.0, 1.0])))
    assert counted == {"solver_of": 1, "closed_forces": 2}  # of the way, and of what is free
    first = np.linalg.eigvals(np.linalg.solve(M, K)).min()
    assert carried.period == pytest.approx(2 * np.pi / np.sqrt(first), rel=0.01)
    for second in (1.0, 0.0, -0.3):
        (loose,) = swings_of(masses((1.0, second, SINE), free=True))
        assert loose.period == np.inf
    assert not [*swings_of(masses((1.0, 1.0, SINE), free=True, c=5.0))]
    for weak, held in ((1e-16, False), (1e-10, True)):  # of the largest stiffness
        b = Bench()
        for x, k in ((0.0, 1e9), (1.0, 1e9 * weak)):
            node = b.node(x, 0.0)
            b.mass(2.0, node, ("UY",))
            b.spring(k, node)
        push = b.load(b.field((node, "FY", 3.0)), T, SINE)
        (one,) = swings_of(b.problem(T, push))
        assert np.isfinite(one.period) == held
    assert not [*swings_of(masses((1.0, 2.0, np.ones(41))))]


def test_masses_alone_and_starts_against_supports():
    b = Bench()
    n = [b.node(float(i), 0.0) for i in range(10)]
    for node in n[:7]:
        b.mass(1.0, node, ("UY",))
    b.dashpot(4.0, n[7])
    joined = b._block(n[8:], ["UY"] * 2, [[6.0, -6.0], [-6.0, 6.0]], "AMORTISSEMENT")
    b.damping_blocks.append(joined)
    b.spring(2.0, n[0])
    b.relate([(1.0, "UY", n[1])])
    b.relate([(1.0, "UY", n[6])])
    b.dashpot(3.0, n[2])
    start = b.field((n[1], "UY", 0.2), (n[0], "UY", 0.1))
    fast = b.field((n[3], "UY", 0.4), (n[1], "UY", 0.0))
    load = b.load(b.field((n[4], "FY", 1.0)))
    problem = b.problem(T, load, displacement=start, velocity=fast)
    assert masses_alone(problem).tolist() == [n[2], n[5], n[7]]
    found = against_supports(problem)
    assert (found["DEPL"].tolist(), found["VITE"].tolist()) == ([0], [])
    fast = b.field((n[1], "UY", 0.5))
    problem = b.problem(T, load, velocity=fast)
    found = against_supports(problem)
    assert (found["DEPL"].tolist(), found["VITE"].tolist()) == ([], [0])
    at = int(b.relations[1].multipliers[0])
    moved = b.load(NodeField.of(b.table, np.array([at]), {"FLX": np.array([0.3])}))
    assert against_supports(b.problem(T, moved))["DEPL"].tolist() == [1]


def test_contact_times_are_those_of_the_mass_that_the_joints_carry():
    _, problem = block(kn=4e5)
    found = contact_resolution(problem)
    assert found.contact_time == pytest.approx(np.pi * np.sqrt(5.0 / 4e5))
    assert found.dt == pytest.approx(1e-3)
    assert found.wanted_dt == pytest.approx(found.contact_time / 30)
    assert found.resolved is (found.dt <= found.wanted_dt * 1.005)
    _, soft = block(kn=4e1)
    assert contact_resolution(soft).resolved
    assert contact_resolution(block(stop=True)[1]) is None
    assert stiffness_contrast(problem) == pytest.approx(4e5 / 1e7)
    assert stiffness_contrast(block(stop=True)[1]) is None


@together("normal", [(0.0, 1.0), (0.6, 0.8)])
def test_joints_of_several_bodies_share_the_push(normal):
    """One on fixed ground, another on one that moves: each with its part of the stiffness."""
    b, along = Bench(), dict(zip(("V1X", "V1Y"), normal, strict=True))
    low, one, two, three = (b.node(*p) for p in ((0, -1), (0, 0), (3, 0), (3, 1)))
    b.fix(low)
    for node, m, k in ((one, 2.0, 2e6), (two, 5.0, 7e6), (three, 11.0, 5e4)):
        b.mass(m, node)
        b.spring(k, node)
    b.joint("SEG2", [low, one], "JOI1", KN=4e5, KS=0.0, **along)
    b.joint("SEG2", [two, three], "JOI1", KN=1e5, KS=0.0, **along)
    problem = b.problem(np.array([0.0, 1e-3, 4e-3, 5e-3]))
    found = contact_resolution(problem)
    mobility = 0.8**2 / 2.0 + 0.2**2 * (1 / 5.0 + 1 / 11.0)
    assert found.contact_time == pytest.approx(np.pi / np.sqrt(5e5 * mobility))
    assert found.dt == pytest.approx(3e-3)
    if not normal[0]:
        assert stiffness_contrast(problem) == pytest.approx(4e5 / 2e6)  # of 1/70, 1/5 and 2


@together("first", [0, 1])
def test_each_body_at_a_joint_counts_the_points_that_touch_it(first):
    """Two joints on three nodes above ground: two bodies meet on the first, one of them has mass.

    A third, at a joint of two points, stands on a spring as well.
    """
    bench = Bench()
    x = [0.0, 1.0, 2.5]
    above, below = ([bench.node(v, 0.0) for v in x] for _ in range(2))
    cells = [[above[k], above[k + 1], below[k], below[k + 1]] for k in (0, 1)]
    bench.joint("RAC2", cells, "JOI2", KN=3e6, KS=1e6)
    foot, head = bench.node(5.0, -1.0), bench.node(5.0, 0.0)
    bench.joint("SEG2", [foot, head], "JOI1", KN=3e6, KS=1e6)
    for node in (*below, foot):
        bench.fix(node)
    bench.spring(2e5, head)
    bench.relate([(1.0, "UY", above[1]), (-1.0, "UY", above[2])])  # the second body
    heavy = above[:1] if first == 0 else above[1:]
    for node in heavy:
        bench.mass(7.0, node)
    problem = bench.problem(np.array([0.0, 1e-3]))
    joints = problem.interface
    tractions = np.zeros((joints.n_points, 2))
    tractions[:, -1] = -1.0
    line = np.flatnonzero((joints.B[:, -1] != 0.0).sum(axis=1) > 1)
    assert len(line) == 4
    tractions[line[:2], -1] = 0.0  # the first joint is open
    one, two = sorted(loose_bodies(problem, tractions), key=lambda b: b.node)
    assert (one.node, one.open_points, one.points) == (above[0], 2, 2)
    assert (two.open_points, two.points) == (2, 4)
    assert two.node == above[1]
    masses = [7.0, 0.0] if first == 0 else [0.0, 14.0]
    assert [one.mass, two.mass] == masses
    assert (full_uplift(problem, tractions) or one) == one
    assert (full_uplift(problem, tractions) is None) == (first == 0)
    assert full_uplift(problem, 0.0 * tractions).node == (above[1] if first == 0 else above[0])
    assert loose_bodies(problem, np.abs(tractions))[0].open_points == 2


def chain(n=60):
    K = 3e8 * sp.diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1))
    M = sp.diags_array(
        [np.full(n - 1, 1.0), np.full(n, 4.0), np.full(n - 1, 1.0)], offsets=(-1, 0, 1)
    )
    return sp.csr_array(K), sp.csr_array(M)


@together("alpha, beta", [(0.7, 3e-4), (0.7, 0.0), (0.0, 3e-4)])
@together("lumped", [True, False])
@together("dashpots", [0, 9])
def test_shares_and_rest(alpha, beta, lumped, dashpots):
    K, M = chain()
    if lumped:
        M = sp.csr_array(sp.diags_array(M.sum(axis=1)))
    extra = np.zeros(60)
    extra[:dashpots] = 1e4
    C = sp.csr_array(alpha * M + beta * K + sp.diags_array(extra))
    a, b, rest = split_damping(C, M, K)
    assert a == pytest.approx(alpha, rel=1e-11, abs=1e-9)
    assert b == pytest.approx(beta, rel=1e-11, abs=1e-17)
    if alpha or not lumped or dashpots == 0:
        assert rest.nnz == dashpots
    np.testing.assert_allclose(
        (a * M + b * K + rest).toarray(), C.toarray(), atol=1e-12 * abs(C).max()
    )


def test_another_damping_is_all_rest():
    K, M = chain()
    C = sp.csr_array(sp.diags_array(np.random.default_rng(0).uniform(1.0, 2.0, 60)))
    assert split_damping(C, M, K)[:2] == (0.0, 0.0)
    assert split_damping(C, M, K)[2] is C
    assert split_damping(sp.csr_array((60, 60)), M, K)[2].nnz == 0


@together("size", [1e-12, 1e12])
def test_dashpots_do_not_count_in_any_unit(size):
    K, M = chain()
    extra = np.zeros(60)
    extra[:9] = 1e4
    C = sp.csr_array(size * (0.7 * M + 3e-4 * K + sp.diags_array(extra)))
    a, b, rest = split_damping(C, sp.csr_array(size * M), sp.csr_array(size * K))
    assert (a, b, rest.nnz) == (pytest.approx(0.7, rel=1e-9), pytest.approx(3e-4, rel=1e-9), 9)


@together("contact_time", [0.030, 0.0299, 0.0281, 0.02999])
def test_a_step_that_is_told_as_the_limit_is_no_reason_to_warn(contact_time):
    told = float(f"{Resolution(contact_time, 1.0).wanted_dt:.3g}")
    assert Resolution(contact_time, told).resolved
    assert not Resolution(contact_time, 1.02 * told).resolved
