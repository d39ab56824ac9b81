"""Motions that lift off, against the exact ones; the loops against each other."""

import numpy as np
import pytest
from references.assembled import Bench
from references.oscillators import MASS, SOIL_STIFFNESS, STRUCTURE_STIFFNESS, ClubB
from references.recorder import recorded
from together import together

from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht

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
    errors = [club_b_error(dt, scheme) for dt in (5e-4, 2.5e-4)]
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
