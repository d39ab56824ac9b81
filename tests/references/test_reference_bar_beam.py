"""Bar impact and beams: energy, boundary conditions, published times, finite differences."""

import numpy as np
import pytest

from .bar import Bar, solve_bar
from .beam import TensionlessBeam, bar_frequencies, cantilever_frequencies, cantilever_tip


def test_bar_without_gravity_touches_for_one_round_trip_and_leaves_with_its_speed():
    bar = Bar(gravity=0.0, initial_velocity=-10.0)
    motion = solve_bar(bar, 5.0)
    assert motion.impacts == pytest.approx([0.5], abs=1e-14)
    assert motion.releases == pytest.approx([0.5 + 20.0 / 30.0], abs=1e-13)
    assert motion.pressure(np.array([0.51, 0.9, 1.16])) == pytest.approx(300.0, rel=1e-12)
    x = np.linspace(0.0, 10.0, 11)
    assert motion.velocity(x, 2.0) == pytest.approx(10.0, rel=1e-12)
    assert motion.stress(x, 2.0) == pytest.approx(0.0, abs=1e-10)


@pytest.fixture(scope="module", params=[5.0, 3.3])
def bounces(request):
    """The article's height, whose impacts fall on the waves' arrival, and one that has no luck."""
    return solve_bar(Bar(height=request.param), 12.0)


def test_article_case_is_periodic():
    motion = solve_bar(Bar(), 12.0)
    assert motion.impacts == pytest.approx(1.0 + 8.0 / 3.0 * np.arange(5), abs=1e-12)
    releases = np.array(motion.releases)
    assert releases == pytest.approx(np.array(motion.impacts)[: len(releases)] + 2 / 3, abs=1e-12)


def test_bouncing_bar_alternates_impacts_and_releases(bounces):
    first = np.sqrt(2.0 * bounces.bar.height / 10.0)
    assert bounces.impacts[0] == pytest.approx(first, abs=1e-14)
    events = np.ravel(list(zip(bounces.impacts, bounces.releases, strict=False)))
    assert len(events) >= 6
    assert np.all(np.diff(events) > 0.0)


def test_bouncing_bar_keeps_its_energy(bounces):
    energies = np.array([bounces.energy(t) for t in np.linspace(0.01, 11.9, 40)])
    # zero at the start by the choice of the potential; jumps inside a cell cost ~ jump^2 / cells
    scale = bounces.bar.density * 10.0 * bounces.bar.length * bounces.bar.height
    assert np.max(np.abs(energies)) < 1e-3 * scale


def test_wall_transmits_no_tension_and_is_not_crossed(bounces):
    t = np.linspace(0.0, 12.0, 24001)[:-1] + 1.2345e-5  # off the instants of the fronts
    gap = bounces.bar.height + bounces.displacement(0.0, t)
    pressure = bounces.pressure(t)
    assert np.min(gap) > -1e-9
    assert np.min(pressure) > -1e-7
    assert np.max(np.abs(gap * pressure)) < 1e-6
    assert np.max(np.abs(bounces.stress(bounces.bar.length, t))) < 1e-9


def test_momentum_of_the_bar_changes_by_weight_and_wall(bounces):
    bar, n = bounces.bar, 4000
    x = (np.arange(n) + 0.5) * bar.length / n
    t = np.linspace(0.0, 6.0, 60001)
    wall = np.trapezoid(bounces.pressure(t), t)
    change = bar.density * bar.length * np.mean(bounces.velocity(x, 6.0))
    assert change == pytest.approx(wall - bar.density * bar.length * bar.gravity * 6.0, abs=0.5)


def test_displacement_solves_the_wave_equation(bounces):
    h = 1e-4
    x, t = np.meshgrid(np.linspace(0.3, 9.7, 23), np.linspace(0.3, 11.7, 37))
    u = bounces.displacement
    tt = (u(x, t + h) - 2 * u(x, t) + u(x, t - h)) / h**2
    xx = (u(x + 30 * h, t) - 2 * u(x, t) + u(x - 30 * h, t)) / (30 * h) ** 2
    residual = np.abs(tt - 900.0 * xx + 10.0)
    # away from fronts the equation holds; a front may pass through a stencil
    assert np.mean(residual < 1e-3) > 0.97


def test_tensionless_beam_contact_ends_at_pi_over_two_lambda():
    beam = TensionlessBeam(force=1e5, bending=2e8, k=4e7)
    assert beam.half_length * beam.wave_number == pytest.approx(np.pi / 2, rel=1e-12)
    assert beam.reaction() == pytest.approx(1e5, rel=1e-12)
    half = beam.half_length
    assert beam.settlement(half)[0] == pytest.approx(0.0, abs=1e-15)
    assert np.all(beam.settlement(np.linspace(0.0, 0.999 * half, 50)) > 0.0)
    assert np.all(beam.settlement(np.linspace(1.001, 2.0, 50) * half) < 0.0)


def test_tensionless_beam_satisfies_its_equation():
    beam = TensionlessBeam(force=1e5, bending=2e8, k=4e7)
    h = 0.02 * beam.half_length
    x = np.linspace(0.2, 0.8, 7) * beam.half_length
    w = [beam.settlement(x + i * h) for i in (-2, -1, 0, 1, 2)]
    fourth = (w[0] - 4 * w[1] + 6 * w[2] - 4 * w[3] + w[4]) / h**4
    assert 2e8 * fourth == pytest.approx(-4e7 * w[2], rel=1e-3)


def test_cantilever_and_bar_frequencies():
    assert cantilever_tip(3.0, 2.0, 4.0) == pytest.approx(2.0)
    f = cantilever_frequencies(1.0, 1.0, 1.0, 3) * 2 * np.pi
    assert f == pytest.approx([3.516015, 22.034492, 61.697214], rel=1e-7)
    assert bar_frequencies(2.0, 16.0, 1.0, 3) == pytest.approx([0.5, 1.5, 2.5])
