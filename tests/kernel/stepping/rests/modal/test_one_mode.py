"""The loop of one coordinate against steps by the law, one by one and over long runs."""

from itertools import product

import numpy as np
import pytest
from references.assembled import Bench
from references.recorder import Recorder
from together import together

from ssilang.kernel.stepping.choose import Case, choose, only
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark, newmark_of
from ssilang.kernel.stepping.rests.modal.one_mode import (
    Mode,
    Spring,
    branch_of,
    by_law,
    general_of,
    run_one_mode,
    store,
)
from ssilang.kernel.stepping.run import Integration, integrate
from ssilang.kernel.stepping.state import DAMPED, EXTERNAL, Motion, recorder_of, rows_of

SCHEMES = [Scheme(), newmark(0.36, 0.7), hht(0.1), generalised_alpha(0.7)]
SPRINGS = {
    "none": Spring(0.0, 0.0, 0.0, 0.0, 0.0),
    "no tension": Spring(1.5, 7e6, 0.0, 0.0, 0.0),
    "softening": Spring(1.5, 7e6, 2e4, 150.0, 0.0),
    "closing": Spring(1.5, 7e6, 0.0, 0.0, -2e4),
    "softening and closing": Spring(1.5, 7e6, 2e4, 150.0, -1e4),
}
MASS, STIFFNESS = 3000.0, 12e6


def run_by_law(mode, spring, forces, x, factors, to):
    """As `run_one_mode`, each step by the law."""
    general, n, last = general_of(mode, spring), mode.newmark, len(to.row) - 1
    state = tuple(float(part.flat[0]) for part in (x.u, x.v, x.a, x.w, x.t, x.state))
    damped, external, energies = x.energies[DAMPED], x.energies[EXTERNAL], np.zeros(6)
    loads = factors @ forces if len(forces) else np.zeros(len(factors))
    for k in range(last + 1):
        u, v = state[:2]
        after = by_law(mode, spring, general, state, n.end * loads[k + 1] + n.start * loads[k])
        if not np.isfinite(after).all():
            return k, -1, np.inf
        move, state = after[0] - u, after
        damped += 0.5 * mode.c * move * (v + after[1])
        external += 0.5 * move * (loads[k] + loads[k + 1])
        store(state, mode, spring, (damped, external), energies)
        apart = abs(energies[:EXTERNAL].sum() - energies[EXTERNAL] - to.balance[0])
        to.balance[1] = max(to.balance[1], apart)
        if len(to.energies):
            to.energies[k] = energies
        if to.row[k] >= 0:
            for part, value in zip((to.u, to.v, to.a, to.w, to.t, to.state), state, strict=True):
                part[to.row[k]] = value
    x.energies[:] = energies
    return last + 1, 1, 0.0


def both(
    scheme, spring, steps, dt, damping=0.0, load=0.0, every=1, mass=MASS, energies=True,
    loops=(run_by_law, run_one_mode),
):  # fmt: skip
    """Outcome, state and rows of the two loops from one start."""
    n, c = newmark_of(scheme, dt), 2 * damping * np.sqrt(STIFFNESS * MASS)
    A = n.mass * mass + n.damping * c + n.end * STIFFNESS
    x = 1 / np.sqrt(A)  # the coordinate has a step's matrix of one
    mode = Mode(*(d * x * x for d in (mass, c, STIFFNESS)), -x if spring.weight else 0.0, n)
    forces = np.array([load * x]) if load else np.zeros(0)
    factors = np.sin(30.0 * dt * np.arange(steps + 1))[:, None][:, : 1 if load else 0]
    row = rows_of(np.arange(steps) % every == every - 1)
    found = []
    for run in loops:
        w = 0.01 if spring.weight else 0.0
        t, xi = (0.0, w) if spring.fu == 0.0 else (spring.k * 1e-5, w - 1e-5)
        if spring.fu:
            w, t, xi = 0.0, 0.0, 0.0
        u, none = np.array([-0.01 / x]), np.zeros(0)
        state = Motion(
            u, np.zeros(1), -STIFFNESS / max(mass, 1.0) * u, none, none, np.array([[w]]),
            np.array([[t]]), np.array([[xi]]), none, np.zeros(6), none,
        )  # fmt: skip
        kept = recorder_of(
            state, row, np.zeros((steps if energies else 0, 6)), ("u", "v", "a", "w", "t", "state"),
            balance=np.array([0.5 * STIFFNESS * 0.01**2, 0.0]),
        )  # fmt: skip
        given = np.ascontiguousarray(factors)
        found.append((run(mode, spring, forces, state, given, kept), state, kept))
    return found


def close(a, b, tolerance):
    assert np.abs(a - b).max(initial=0.0) <= tolerance * np.abs(b).max(initial=0.0)


@pytest.mark.parametrize("scheme", SCHEMES)
@together("spring, loaded", product(SPRINGS.values(), [(0.0, 0.0), (0.02, 0.0), (0.02, 6e4)]))
def test_steps_by_branches_are_those_of_the_law(scheme, spring, loaded):
    damping, load = loaded
    (one, few, kept), (two, state, rows) = both(scheme, spring, 1000, 5e-4, damping, load)
    assert one[:2] == two[:2] == (1000, 1)
    for name in ("u", "v", "a", "w", "t", "state"):
        close(getattr(rows, name), getattr(kept, name), 1e-11)
    close(rows.energies, kept.energies, 1e-11)
    close(state.energies, few.energies, 1e-11)
    start = kept.balance[0]
    assert rows.balance[1] == pytest.approx(kept.balance[1], rel=1e-6, abs=1e-10 * start)


def test_a_hundred_thousand_free_steps_keep_twelve_digits():
    """Average acceleration turns the phase by 2 atan(omega dt / 2) a step and loses nothing."""
    steps, dt = 100_000, 2.5e-4
    ((_, _, rows),) = both(
        Scheme(), SPRINGS["none"], steps, dt, every=1000, energies=False, loops=(run_one_mode,)
    )
    turn = 2 * np.arctan(0.5 * dt * np.sqrt(STIFFNESS / MASS))
    start = -0.01 * np.sqrt(4 * MASS / dt**2 + STIFFNESS)
    close(rows.u[:, 0], start * np.cos(turn * np.arange(1000, steps + 1, 1000)), 1e-12)
    assert rows.balance[1] <= 1e-12 * rows.balance[0]


def test_twenty_thousand_steps_with_uplift_agree():
    """The loop of the law alone rounds more: 5e-12 in the free motion above."""
    (_, _, kept), (_, _, rows) = both(
        Scheme(), SPRINGS["no tension"], 20_000, 2.5e-4, every=200, energies=False
    )
    close(rows.u, kept.u, 1e-10)
    close(rows.v, kept.v, 1e-10)
    assert rows.balance[1] == pytest.approx(kept.balance[1], rel=1e-6)
    assert rows.w.min() < 0.0 < rows.w.max()


@together("mass", [0.0, 1e-3])
def test_light_modes_step_by_the_law(mass):
    mode = Mode(mass, 0.0, STIFFNESS, 1.0, newmark_of(Scheme(), 5e-4))
    assert not branch_of(mode, SPRINGS["no tension"], (0.01, 0.0, 0.0, 0.01, 0.0, 0.01)).fits
    (_, _, kept), (_, _, rows) = both(
        Scheme(), SPRINGS["no tension"], 500, 5e-4, load=6e4, mass=mass
    )
    close(rows.u, kept.u, 1e-11)
    for name in ("w", "t", "state"):
        close(getattr(rows, name), getattr(kept, name), 1e-11)


def test_a_motion_beyond_all_numbers_is_told():
    unstable = Scheme(0.0, 0.0, 0.1, 0.5)
    (one, *_), (two, *_) = both(unstable, SPRINGS["none"], 20_000, 0.2)
    assert two[0] < 20_000
    assert two[1] <= 0
    assert np.isinf(two[2])
    assert one[1] <= 0


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
    line = choose(Case(problem, Integration(problem).motion, 1e-3)).loop.line
    assert len(line.idle) == 1
    few, other = Recorder(len(times)), Recorder(len(times))
    integrate(problem, [few])
    monkeypatch.setattr("ssilang.kernel.stepping.choose.RULES", only("condensed"))
    integrate(problem, [other])
    for name in ("u", "v", "a", "reaction", "w", "t", "state"):
        close(few.of(name), other.of(name), 1e-11)
