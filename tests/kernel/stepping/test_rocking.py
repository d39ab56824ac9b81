"""Motions that lift off and rock, a bar that hits a wall: against the exact ones and each other."""

import itertools
from functools import cache

import numpy as np
import pytest
from references.assembled import Bench
from references.bar import Bar, solve_bar
from references.contact import solve
from references.oscillators import MASS, SOIL_STIFFNESS, STRUCTURE_STIFFNESS, ClubB
from references.recorder import recorded
from references.rocking import TwoSpringBlock
from together import together

from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht

BLOCK = TwoSpringBlock(mass=1e5, inertia=4e5, height=3.0, half_width=1.5, k=4e7)


def block_problem(dt, duration, scheme):
    """Base centre C (UY, RZ) with the two edges tied to it, joints to the fixed soil."""
    bench, b = Bench(), BLOCK.half_width
    centre = bench.node(0.0, 0.0)
    bench.mass(BLOCK.mass, centre, ("UY",))
    bench.mass(BLOCK.rocking_inertia, centre, ("RZ",))
    for x in (-b, b):
        edge, soil = bench.node(x, 0.0), bench.node(x, -1.0)
        bench.fix(soil)
        bench.fix(edge, "UX")
        bench.relate([(1.0, "UY", edge), (-1.0, "UY", centre), (-x, "RZ", centre)])
        bench.joint("SEG2", [soil, edge], "JOI1", KN=BLOCK.k, KS=0.0)
    problem = bench.problem(
        np.arange(round(duration / dt) + 1) * dt,
        bench.load(bench.field((centre, "FY", -BLOCK.weight))),
        displacement=bench.field((centre, "UY", BLOCK.rest[0])),
        velocity=bench.field((centre, "RZ", 0.5)),
        scheme=scheme,
    )
    # edges start at the settlement, and move with the centre
    for x in (-b, b):
        node = int(np.flatnonzero(bench.table.coordinates[:, 0] == x)[0])
        problem.u[problem.numbering.index_of(node, "UY")] = BLOCK.rest[0]
        problem.v[problem.numbering.index_of(node, "UY")] = 0.5 * x
    recorder, history = recorded(problem)
    u = recorder.of("u")
    found = u[:, [problem.numbering.index_of(centre, n) for n in ("UY", "RZ")]]
    return problem.times, found, history


@cache
def exact_motion():
    """That of the block, from event to event."""
    return solve(BLOCK.system(), BLOCK.rest, np.array([0.0, 0.5]), 2.0)


def block_error(dt, scheme):
    times, found, _ = block_problem(dt, 2.0, scheme)
    exact, _ = exact_motion()(times)
    return np.abs(found[:, 1] - exact[:, 1]).max() / np.abs(exact[:, 1]).max()


@pytest.mark.parametrize("scheme", [Scheme(), Scheme(conserving=True)])
def test_rocking_block_follows_the_event_driven_motion(scheme):
    coarse, fine = (block_error(dt, scheme) for dt in (2e-3, 5e-4))
    assert fine < 2e-3
    assert 1.5 < np.log2(coarse / fine) / 2 < 2.5


def test_rocking_block_keeps_its_energy_with_the_conserving_step():
    _, _, history = block_problem(1e-2, 3.0, Scheme(conserving=True))
    reference = 0.5 * BLOCK.rocking_inertia * 0.5**2
    assert np.abs(history.imbalance).max() < 1e-10 * reference


BAR, PLAIN = Bar(), ContactOptions()


def bar_impact(dt, options=PLAIN, joint=None, cells=100):
    """Bar falling on a wall at its lower end; (times, lower end, history, pressure)."""
    bench = Bench()
    h = BAR.length / cells
    nodes = [bench.node(0.0, i * h) for i in range(cells + 1)]
    k, m = BAR.young / h, BAR.density * h
    for a, b in itertools.pairwise(nodes):
        bench.spring(k, a, b)
        mass = np.array([[2.0, 1.0], [1.0, 2.0]]) * m / 6
        bench.mass_blocks.append(bench._block([a, b], ["UY", "UY"], mass, "MASSE"))
    if joint is None:
        bench.relate([(1.0, "UY", nodes[0])], sense=1)
    else:
        wall = bench.node(0.0, -1.0)
        bench.fix(wall)
        bench.fix(nodes[0], "UX")
        bench.joint("SEG2", [wall, nodes[0]], "JOI1", KN=joint, KS=0.0)
    weight = np.full(cells + 1, -BAR.gravity * m)
    weight[[0, -1]] /= 2
    start = [(n, "UY", BAR.height) for n in nodes]
    problem = bench.problem(
        np.arange(round(2.2 / dt) + 1) * dt,
        bench.load(bench.field(*((n, "FY", w) for n, w in zip(nodes, weight, strict=True)))),
        displacement=bench.field(*start),
        contact_options=options,
    )
    recorder, history = recorded(problem)
    end = recorder.of("u")[:, problem.numbering.index_of(nodes[0], "UY")]
    pressure = recorder.of("contact")[:, 0] if joint is None else -recorder.of("t")[:, 0, -1]
    return problem.times, end, history, pressure


def release(times, end):
    """Time at which the end leaves the wall, between two steps."""
    contact = np.flatnonzero(end < 1e-9)
    i = contact[-1]
    return times[i] + (times[i + 1] - times[i]) * max(-end[i], 0.0) / (end[i + 1] - end[i])


def test_bar_on_a_joint_leaves_the_wall_in_time_and_keeps_its_energy():
    times, end, history, _ = bar_impact(2.5e-4, joint=1e5)
    exact = BAR.fall + BAR.round_trip
    assert release(times, end) == pytest.approx(exact, abs=0.01)
    kinetic = 0.5 * BAR.density * BAR.length * BAR.impact_velocity**2
    assert np.abs(history.imbalance).max() < 2e-3 * kinetic


def test_modified_mass_gives_the_cleanest_pressure():
    motion = solve_bar(BAR, 2.2)
    rms = {}
    for name, options in (
        ("plain", ContactOptions(correction="FAUX")),
        ("modified", ContactOptions(modified_mass=True)),
    ):
        times, _, _, pressure = bar_impact(2e-3, options=options)
        inside = (times > BAR.fall + 0.1) & (times < BAR.fall + BAR.round_trip - 0.1)
        exact = motion.pressure(times[inside])
        rms[name] = np.sqrt(np.mean((pressure[inside] - exact) ** 2)) / BAR.mean_pressure
    assert rms["modified"] < 0.01
    assert rms["modified"] < 0.1 * rms["plain"]


AVERAGE = Scheme()


def club_b(dt: float, duration: float = 1.0, scheme: Scheme = AVERAGE, **joint: float):
    bench = Bench()
    soil, top = bench.node(-1.0, 0.0), bench.node(0.0, 0.0)
    bench.spring(STRUCTURE_STIFFNESS, top, unknown="UX")
    bench.mass(MASS, top)
    bench.fix(soil)
    bench.fix(top, "UY")
    bench.joint("SEG2", [soil, top], "JOI1", **({"KN": SOIL_STIFFNESS, "KS": 0.0} | joint))
    problem = bench.problem(
        np.arange(0, round(duration / dt) + 1) * dt,
        displacement=bench.field((top, "UX", 0.01)),
        scheme=scheme,
    )
    return problem, problem.numbering.index_of(top, "UX")


def run(problem, **options):
    recorder, history = recorded(problem, **options)
    return recorder, history


def club_b_error(dt: float, scheme: Scheme = AVERAGE) -> float:
    problem, i = club_b(dt, scheme=scheme)
    recorder, _ = run(problem)
    exact, _ = ClubB().motion(problem.times)
    return float(np.abs(recorder.of("u")[:, i] - exact).max() / 0.01)


def test_bilinear_oscillator_is_of_second_order():
    errors = np.array([club_b_error(dt) for dt in (1e-3, 5e-4, 2.5e-4)])
    assert errors[2] < 2e-3
    orders = np.log2(errors[:-1] / errors[1:])
    assert (np.abs(orders - 2.0) < 0.1).all()


CONSERVING = Scheme(conserving=True)


@pytest.mark.parametrize("scheme", [hht(0.05), generalised_alpha(0.9), CONSERVING])
def test_other_schemes_are_of_second_order(scheme):
    errors = [club_b_error(dt, scheme) for dt in (1e-3, 5e-4)]
    low, high = (1.8, 2.2) if scheme.conserving else (1.7, 2.3)
    assert low < np.log2(errors[0] / errors[1]) < high


@together("scheme", [hht(0.3), generalised_alpha(0.0)])
def test_damped_schemes_lose_energy(scheme):
    _, history = run(club_b(1e-3, scheme=scheme)[0])
    total = history.energies[:, :4].sum(axis=1)
    assert total[-1] < 0.9999 * total[0]


@pytest.mark.parametrize(
    ("scheme", "dt", "stiffness", "most"),
    [(AVERAGE, 2.5e-4, 1.0, 1e-4)]
    + [(CONSERVING, dt, k, 1e-10) for dt in (1e-2, 3e-3, 1e-3) for k in (1.0, 1e4)],
)
def test_energy_is_kept(scheme, dt, stiffness, most):
    """By average acceleration at fine steps, by the conserving one at any step and stiffness."""
    problem, _ = club_b(dt, scheme=scheme, KN=stiffness * SOIL_STIFFNESS)
    _, history = run(problem)
    assert np.abs(history.imbalance).max() < most * ClubB().energy


def test_adapted_steps_find_the_events_and_keep_the_step_elsewhere():
    plain, adapted = club_b_error(2e-3), club_b_error(2e-3, Scheme(adaptive=True))
    smooth, _ = club_b(2e-3, 0.02)
    split, _ = club_b(2e-3, 0.02, Scheme(adaptive=True))
    assert adapted < plain
    np.testing.assert_allclose(run(split)[0].of("u"), run(smooth)[0].of("u"), atol=1e-12)
    problem, _ = club_b(2e-3, scheme=Scheme(adaptive=True))
    _, history = run(problem)
    _, coarse = run(club_b(2e-3)[0])
    assert np.abs(history.imbalance).max() < 0.05 * np.abs(coarse.imbalance).max()
