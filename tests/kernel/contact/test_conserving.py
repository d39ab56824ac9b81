"""The energy-conserving step with unilateral relations, alone and beside joints."""

import itertools
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse as sp
from references.assembled import Bench
from references.oscillators import MASS, STRUCTURE_STIFFNESS, ClubA
from references.recorder import Recorder
from together import together

from ssilang.kernel.contact.conserving import ConservingContact, mean_penalty
from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.run import integrate

METHODS = [
    ContactOptions("PENALITE", 1e3 * STRUCTURE_STIFFNESS),
    ContactOptions("LAGRANGE"),
    ContactOptions("AUGMENTE"),
    ContactOptions("UZAWA"),
]


def oscillator(options: ContactOptions, dt: float, duration: float):
    """Club-a's mass released against its wall."""
    bench = Bench()
    top = bench.node(0.0, 0.0)
    bench.spring(STRUCTURE_STIFFNESS, top, unknown="UX")
    bench.mass(MASS, top)
    bench.fix(top, "UY")
    bench.relate([(1.0, "UX", top)], sense=1)
    times = np.arange(round(duration / dt) + 1) * dt
    return run(bench, times, options, bench.field((top, "UX", 0.01)))


@cache
def bar(options: ContactOptions, n: int = 30, **joint: float):
    """A falling bar of n springs that lands on a stop, with a joint below a second one."""
    bench = Bench()
    nodes = [bench.node(0.0, 0.1 * i) for i in range(n + 1)]
    for a, b in itertools.pairwise(nodes):
        bench.spring(4e6, a, b)
    for a in nodes:
        bench.mass(0.5 if a in (nodes[0], nodes[-1]) else 1.0, a)
        bench.fix(a, "UX")
    bench.relate([(1.0, "UY", nodes[0])], sense=1)
    moved = [(a, "UY", 0.02) for a in nodes]
    if joint:
        lone, soil = bench.node(1.0, 0.0), bench.node(1.0, -1.0)
        bench.fix(soil)
        bench.fix(lone, "UX")
        bench.mass(2.0, lone)
        bench.joint("SEG2", [soil, lone], "JOI1", KS=0.0, **joint)
        bench.spring(3e4, nodes[1], lone)  # the lone mass hangs on the bar
        moved.append((lone, "UY", 0.02))
    weight = bench.load(bench.field(*[(a, "FY", -9.81) for a in nodes]))
    times = np.arange(376) * 4e-4
    return run(bench, times, options, bench.field(*moved), weight)


def run(bench, times, options, start, load=None):
    problem = bench.problem(
        times, load, displacement=start, scheme=Scheme(conserving=True), contact_options=options
    )
    recorder = Recorder(len(times))
    return problem, recorder, integrate(problem, [recorder])


@pytest.mark.parametrize("options", METHODS, ids=lambda o: o.method)
@pytest.mark.parametrize("dt", [0.1 / 211, 0.1 / 23])
def test_impacts_keep_the_energy_to_rounding(options, dt):
    _, _, history = oscillator(options, dt, 0.4)
    scale = history.energies[0].sum()
    assert np.abs(history.imbalance).max() <= 1e-11 * scale


def test_multipliers_never_cross_the_stop_and_follow_the_exact_motion():
    errors = []
    for steps in (211, 1055):
        problem, recorder, _ = oscillator(ContactOptions(), 0.1 / steps, 0.4)
        u = recorder.of("u")[:, 0]
        assert u.min() >= 0.0
        exact, _ = ClubA().motion(problem.times)
        errors.append(np.abs(u - exact).max() / 0.01)
    # each of the eight impacts is seen within one step: speed x step
    assert errors[0] <= 8 * 2 * np.pi * 10 * 0.1 / 211
    assert errors[1] <= 0.3 * errors[0]


@pytest.mark.parametrize("options", METHODS, ids=lambda o: o.method)
@pytest.mark.parametrize("joint", [{}, {"KN": 1e7}, {"KN": 1e7, "FU": 2e2, "GF": 1e-1, "FC": -50}])
def test_bar_on_a_stop_with_a_joint_beside_keeps_the_energy(options, joint):
    _, recorder, history = bar(options, **joint)
    scale = np.abs(history.energies[:, :2]).max()
    assert np.abs(history.imbalance).max() <= 1e-10 * scale
    pushed = recorder.of("contact")
    assert (pushed > 0).any()
    assert (pushed == 0).any()
    assert (pushed >= 0).all()
    if joint:
        assert (recorder.of("w")[:, 0, -1] < 0).any()


def test_exact_methods_agree():
    _, one, _ = bar(METHODS[1], KN=1e7)
    for options in METHODS[2:]:
        _, two, _ = bar(options, KN=1e7)
        assert np.abs(one.of("u") - two.of("u")).max() <= 1e-9 * np.abs(one.of("u")).max()


def test_a_stop_that_moves_does_work():
    """A mass at rest hit by a stop of constant speed V leaves at 2 V."""
    bench = Bench()
    ball = bench.node(0.0, 0.0)
    bench.mass(3.0, ball)
    bench.fix(ball, "UY")
    row = bench.relate([(1.0, "UX", ball)], sense=1)
    stop = bench.load(
        NodeField.of(bench.table, np.array([row]), {"FLX": np.ones(1)}), [0, 1], [-0.1, 1.9]
    )
    times = np.linspace(0.0, 0.5, 1001)
    _, recorder, history = run(bench, times, ContactOptions(), bench.field((ball, "UX", 0.0)), stop)
    assert recorder.of("v")[-1, 0] == pytest.approx(4.0, rel=1e-12)
    assert history.energies[-1, 5] == pytest.approx(0.5 * 3.0 * 16.0, rel=1e-12)
    assert np.abs(history.imbalance).max() <= 1e-11 * history.energies[-1, 0]


@together("options", METHODS)
def test_a_support_that_moves_away_pulls_a_mass_off_the_stop_that_it_touches(options):
    """From the first step on it moves as if there were no stop."""
    found = []
    for stop in (False, True):
        bench = Bench()
        top, base = bench.node(0.0, 0.0), bench.node(1.0, 0.0)
        bench.mass(3.0, top)
        bench.spring(STRUCTURE_STIFFNESS, top, base, unknown="UX")
        bench.fix(top, "UY")
        bench.fix(base, "UY")
        held = bench.relate([(1.0, "UX", base)])
        if stop:
            bench.relate([(1.0, "UX", top)], sense=1)
        pull = NodeField.of(bench.table, np.array([held]), {"FLX": np.ones(1)})
        load = bench.load(pull, [0.0, 1.0], [0.0, 1.0])
        start = bench.field((top, "UX", 0.0), (base, "UX", 0.0))
        _, recorder, _ = run(bench, np.linspace(0.0, 0.02, 41), options, start, load)
        found.append(recorder.of("u"))
    assert found[0].max() > 0.01
    np.testing.assert_allclose(found[1], found[0], rtol=1e-9)


def test_mean_penalty_is_the_secant_of_the_energy_with_its_own_slope():
    g = np.array([-1.0, -1.0, 1.0, 1.0, -1.0, 0.5])
    dg = np.array([0.5, 2.5, -3.0, 1.0, 1.0, 0.0])
    mean, slope = mean_penalty(g, dg, 7.0)
    psi = lambda x: 3.5 * np.minimum(x, 0.0) ** 2  # noqa: E731
    assert mean * dg == pytest.approx(-(psi(g + dg) - psi(g)))
    step = 1e-6
    up, down = mean_penalty(g, dg + step, 7.0)[0], mean_penalty(g, dg - step, 7.0)[0]
    smooth = [0, 1, 2, 3]
    assert slope[smooth] == pytest.approx(((up - down) / (2 * step))[smooth], rel=1e-6, abs=1e-6)


class TwoStops:
    """What a step asks of relations."""

    G = sp.csr_array(np.eye(2))

    def __len__(self):
        return 2


@together("options", METHODS[1:])
def test_a_stop_that_another_s_push_drives_into_is_met_and_one_that_it_lifts_off_is_not(options):
    """The second gap, 0.5, would close by 0.3; the first reaction takes 0.9 of itself off or on."""
    for lever, wanted in ((0.9, [1.0, 0.0]), (-0.9, [1.27 / 0.19, 1.2 / 0.19])):
        flexibility = np.array([[1.0, lever], [lever, 1.0]])
        none, no_joints = np.zeros((0, 2)), {"S": np.zeros((0, 0)), "Y": np.zeros((2, 0))}
        effective = SimpleNamespace(solve=lambda b, W=flexibility: W @ b, **no_joints)
        step = ConservingContact(effective, TwoStops(), options, none)
        gap, alone = np.array([0.0, 0.5]), np.array([-1.0, -0.3])
        found = step.solve(SimpleNamespace(size=0), np.zeros(0), gap, alone)
        np.testing.assert_allclose(found.P, wanted, rtol=1e-6, atol=1e-9)
