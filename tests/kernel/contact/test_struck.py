"""Bodies that are struck while other relations hold them: Housner's rocking block."""

from dataclasses import dataclass

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from references.rocking import HousnerBlock
from together import together

from ssilang.kernel.contact.unilateral import ContactOptions
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.plasticity.bulk import Bulk
from ssilang.kernel.plasticity.run import BulkRun, integrate_bulk, step_bulk_statics
from ssilang.kernel.statics.stepping import step_statics
from ssilang.kernel.stepping.choose import only
from ssilang.kernel.stepping.newmark import Scheme
from ssilang.kernel.stepping.run import integrate
from ssilang.kernel.stepping.state import DAMPED, ELASTIC, EXTERNAL, KINETIC, LOST

M, G, R, TILT = 1e5, 9.81, 3.0, 0.5
CORNERS = (-1.0, 1.0)
SAME = 1e-9  # of a swing or a reaction: two loops, or relations said twice


@dataclass
class Rocking:
    """A rigid block from corner to corner: base's height and rotation at all times."""

    alpha: float
    times: np.ndarray
    y: np.ndarray
    theta: np.ndarray
    record: Recorder
    history: object

    @property
    def upright(self):
        """Steps before which the rotation changes its sign."""
        return np.flatnonzero(self.theta[:-1] * self.theta[1:] < 0.0)

    @property
    def available(self):
        """Kinetic energy with which the block comes upright the first time."""
        b, h = R * np.sin(self.alpha), R * np.cos(self.alpha)
        theta = TILT * np.tan(self.alpha)
        return M * G * (b * theta - 0.5 * h * theta**2)


def rock(
    dt, end=4.0, alpha=0.2, feet=CORNERS, options=None, damping=0.0, lift=None, scheme=None,
    yields=False,
) -> Rocking:  # fmt: skip
    """Let a homogeneous block go, tilted by TILT tan(alpha) about its left corner.

    Rotations are small; `feet` are stops by their places, in half widths; `damping` is that of the
    mass; `lift` moves them up at that speed; `yields`: by the loop of bodies that may.
    """
    b, h = R * np.sin(alpha), R * np.cos(alpha)
    J, theta = M * (R**2 / 3 + h**2), TILT * np.tan(alpha)
    bench = Bench()
    base = bench.node(0.0, 0.0)
    bench.spring(-M * G * h, base, unknown="RZ")
    bench.mass(M, base)
    bench.mass(J, base, ("RZ",))
    bench.fix(base, "UX")
    stops = [bench.relate([(1.0, "UY", base), (s * b, "RZ", base)], sense=1) for s in feet]
    times = np.arange(round(end / dt) + 1) * dt
    load = bench.load(bench.field((base, "FY", -M * G)))
    velocity = None
    if lift is not None:
        n = np.array(stops)
        imposed = NodeField.of(bench.table, n, {"FLX": np.full(len(n), 1.0)})
        moved = bench.load(imposed, [0.0, end], [0.0, lift * end])
        load = type(load)(load.parts + moved.parts)
        velocity = bench.field((base, "UY", lift))
    if damping:
        bench.dashpot(damping * M, base)
        bench.dashpot(damping * J, base, "RZ")
    problem = bench.problem(
        times,
        load,
        displacement=bench.field((base, "UY", b * theta), (base, "RZ", theta)),
        velocity=velocity,
        scheme=scheme or Scheme(),
        contact_options=options or ContactOptions(correction="MASSE"),
    )
    record = Recorder(len(times))
    history = RUNS["steps of bodies" if yields else "compiled"](problem, record)
    y, z = (record.of("u")[:, problem.numbering.index_of(base, u)] for u in ("UY", "RZ"))
    return Rocking(alpha, times, y, z, record, history)


def restitution(motion: Rocking):
    """Ratios of the angular velocities after and before each impact, from what it took."""
    lost = motion.history.energies[:, LOST]
    at = [np.flatnonzero(np.diff(lost) > 1e-9 * motion.available)]
    left = motion.available - np.concatenate([[0.0], lost[at[0] + 1]])
    return np.sqrt(left[1:] / left[:-1])


@pytest.mark.parametrize("alpha", [0.15, 0.3])
def test_each_impact_keeps_the_momentum_about_the_corner_that_lands(alpha):
    """Housner's r, wherever in a step an impact comes: to the second order, coarse steps too."""
    r = HousnerBlock(R, alpha).restitution
    for dt in (2e-2, 1e-2, 2.7e-3, 2.5e-4):
        found = restitution(rock(dt, 3.0, alpha))
        assert len(found) >= 2
        assert np.abs(found - r).max() < 0.3 * dt**2


def test_swings_and_half_periods_are_those_of_housner():
    """Piecewise cosh between impacts; p^2 and the angle of small rotations about the corners."""
    alpha, dt, motion = 0.2, 4e-3, rock(4e-3)
    r, a = HousnerBlock(R, alpha).restitution, np.tan(alpha)
    p = HousnerBlock(R, alpha).p * np.sqrt(np.cos(alpha))
    k = motion.upright
    t = motion.times[k] + dt * motion.theta[k] / (motion.theta[k] - motion.theta[k + 1])
    swings = [np.abs(motion.theta[i:j]).max() for i, j in zip([0, *k[:-1]], k, strict=True)]
    exact = a * (1 - np.sqrt(1 - r ** (2 * np.arange(len(k))) * (1 - (1 - TILT) ** 2)))
    np.testing.assert_allclose(swings, exact, rtol=3e-5)
    halves = 2.0 / p * np.arccosh(1.0 / (1.0 - exact / a))
    halves[0] *= 0.5
    np.testing.assert_allclose(np.diff(t, prepend=0.0), halves, rtol=1e-4)


@pytest.mark.parametrize("yields", [False, True])
def test_what_impacts_take_is_told_as_lost(yields):
    history = rock(8e-3, yields=yields).history
    assert history.energies[-1, LOST] > 0.3 * rock(4e-3, 0.04).available
    assert history.worst_imbalance < 1e-10 * history.largest_energy
    assert (np.diff(history.energies[:, LOST]) >= 0.0).all()


def test_the_block_comes_to_rest():
    """A stocky one: its impacts take most, the last of them fall in one step."""
    motion = rock(1e-3, 6.0, 0.6)
    assert np.abs(motion.theta[-100:]).max() < 1e-12
    assert motion.record.of("contact")[-1] == pytest.approx([0.5 * M * G] * 2, rel=1e-4)  # rounding
    assert motion.history.energies[-1, LOST] == pytest.approx(motion.available, rel=1e-4)


def _bodies(problem, seen):
    return BulkRun(problem, Bulk((), (), problem.numbering.size), (), (seen,))


RUNS = {
    "loads": lambda p, seen: step_statics(p, [seen]),
    "compiled": lambda p, seen: integrate(p, [seen]),
    "condensed": lambda p, seen: integrate(p, [seen]),
    "full Newton": lambda p, seen: integrate(p, [seen], full_newton=True),
    "steps of bodies": lambda p, seen: integrate_bulk(_bodies(p, seen)),
    "loads of bodies": lambda p, seen: step_bulk_statics(_bodies(p, seen)),
}


@together("name", RUNS)
def test_a_stop_that_moves_does_the_work_of_its_reaction(name, monkeypatch):
    """By trapezia of instants: a spring is pressed, and let go, by what it stands on."""
    if name == "condensed":
        monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only(name))
    bench, times = Bench(), np.linspace(0.0, 1.0, 13)
    top = bench.node(0.0, 0.0)
    bench.spring(50.0, top)
    bench.mass(0.5, top)
    bench.fix(top, "UX")
    stop = np.array([bench.relate([(1.0, "UY", top)], sense=1)])
    way = 0.3 + 0.2 * np.sin(2.0 * times)
    load = bench.load(NodeField.of(bench.table, stop, {"FLX": np.ones(1)}), times, way)
    start = {
        "displacement": bench.field((top, "UY", 0.3)),
        "velocity": bench.field((top, "UY", 0.4)),
    }
    problem = bench.problem(times, load, **start)
    history = RUNS[name](problem, seen := Recorder(len(times)))
    pushed, u = seen.of("contact")[:, 0], seen.of("u")[:, problem.numbering.index_of(top, "UY")]
    np.testing.assert_allclose(u, way, atol=1e-9)
    work = np.cumsum(0.5 * (pushed[1:] + pushed[:-1]) * np.diff(way))
    np.testing.assert_allclose(history.energies[1:, EXTERNAL], work, rtol=1e-9)


FEET = [(-1.0, 0.0, 1.0), (-1.0, -0.5, 0.0, 0.5, 1.0), (-1.0, -1.0, 1.0, 1.0)]


@pytest.mark.parametrize("feet", [CORNERS, *FEET])
def test_loops_agree_and_stops_between_the_corners_change_nothing(feet, monkeypatch):
    exact = rock(4e-3, 2.5)
    assert exact.history.loop == "compiled"
    monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only("condensed"))
    motion = rock(4e-3, 2.5, feet=feet)
    assert motion.history.loop == "condensed"
    assert np.abs(motion.theta - exact.theta).max() < SAME * TILT
    assert motion.history.energies[-1, LOST] == pytest.approx(
        exact.history.energies[-1, LOST], rel=1e-6
    )
    for sums in (motion, exact):
        assert np.abs(sums.history.imbalance).max() < 1e-9 * sums.available


def test_damped_loops_agree(monkeypatch):
    one = rock(4e-3, 2.5, damping=0.4)
    monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only("condensed"))
    two = rock(4e-3, 2.5, damping=0.4)
    assert (one.history.loop, two.history.loop) == ("compiled", "condensed")
    # an impact takes its velocities from accelerations too, which loops have to 2e-7 of the largest
    for part, same in {"u": 10 * SAME, "v": SAME, "a": 1e-5, "contact": 1e-5}.items():
        size = np.abs(two.record.of(part)).max()
        assert np.abs(one.record.of(part) - two.record.of(part)).max() < same * size, part
    np.testing.assert_allclose(one.history.energies, two.history.energies, atol=1e-6)
    assert two.history.worst_imbalance < 1e-9 * one.available


def test_stops_that_rise_steadily_change_nothing():
    """The same motion seen from a lift: what the stops do is accounted for."""
    still, lifted = rock(1e-3, 2.0), rock(1e-3, 2.0, lift=0.7)
    assert np.abs(lifted.theta - still.theta).max() < 1e-8
    np.testing.assert_allclose(lifted.y - 0.7 * lifted.times, still.y, atol=1e-8)
    assert lifted.history.energies[-1, LOST] == pytest.approx(
        still.history.energies[-1, LOST], rel=1e-6
    )
    assert lifted.history.worst_imbalance < 1e-9 * lifted.history.largest_energy


def test_adapted_steps_take_the_same_impacts():
    r = HousnerBlock(R, 0.2).restitution
    found = restitution(rock(4e-3, 2.5, scheme=Scheme(adaptive=True)))
    np.testing.assert_allclose(found, r, atol=2e-3)


def test_a_flat_fall_rebounds_as_one_stop_would():
    """Nothing holds the block: both corners turn round, energy is kept."""
    bench = Bench()
    base = bench.node(0.0, 0.0)
    bench.mass(M, base)
    bench.mass(4.0 * M, base, ("RZ",))
    bench.fix(base, "UX")
    for side in CORNERS:
        bench.relate([(1.0, "UY", base), (side, "RZ", base)], sense=1)
    bench.spring(1e-6 * M, base, unknown="RZ")
    problem = bench.problem(
        np.arange(401) * 1e-3,
        bench.load(bench.field((base, "FY", -M * G))),
        displacement=bench.field((base, "UY", 0.2)),
        contact_options=ContactOptions(correction="MASSE"),
    )
    record = Recorder(401)
    energies = integrate(problem, [record]).energies[-1]
    assert energies[LOST] == 0.0
    kept = energies[KINETIC] + energies[ELASTIC] + energies[DAMPED] - energies[EXTERNAL]
    assert kept == pytest.approx(0.0, abs=2e-2 * M * G * 0.2)
    assert record.of("u")[-1].max() > 0.19
