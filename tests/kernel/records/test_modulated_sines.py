"""Modulated sines: their velocity and displacement against integration by numbers."""

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson
from together import together

from ssilang.kernel.records.modulated import Band, motion, perturbed


def test_velocity_and_displacement_are_the_integrals_of_the_acceleration():
    times = np.linspace(-0.5, 4.0, 4501)
    bands = (
        Band(0.5, 2.0, np.array([0.0, 1.0, 2.5, 4.0]), np.array([0.2, 1.0, 0.7, 0.1])),
        Band(2.0, 6.0, np.array([0.0, 0.5, 4.0]), np.array([0.0, 2.0, 0.5])),
    )
    f = np.array([0.7, 1.9, 2.0, 3.3, 6.0])
    amplitudes, phases = np.array([1.0, -0.5, 2.0, 0.3, 0.8]), np.array([0.1, 2.0, 4.0, 5.0, 1.0])
    own = times[times >= 0.0]
    found = motion(own, f, amplitudes, phases, bands, 0.0)
    exact = np.zeros_like(own)
    for frequency, amplitude, phase in zip(f, amplitudes, phases, strict=True):
        band = bands[int(frequency >= 2.0)]
        m = np.interp(own, band.times, band.values)
        exact += m * amplitude * np.cos(2.0 * np.pi * frequency * own + phase)
    velocity = cumulative_simpson(exact, x=own, initial=0.0)
    displacement = cumulative_simpson(velocity, x=own, initial=0.0)
    np.testing.assert_allclose(found[0], exact, atol=1e-12)
    np.testing.assert_allclose(found[1], velocity, atol=1e-6)
    np.testing.assert_allclose(found[2], displacement, atol=1e-6)


@together("count", [2, 3, 9])
def test_squares_that_move_to_their_neighbours_keep_their_sum(count):
    values = np.cos(np.arange(1.0, count + 1.0))
    found = perturbed(values, np.random.default_rng(1), False, 60.0)
    assert np.sum(found**2) == pytest.approx(np.sum(values**2), rel=1e-14)
    assert np.array_equal(np.sign(found), np.sign(values))
    assert not np.allclose(found, values)
    # a quarter at least stays where it was
    assert (found**2 >= 0.25 * values**2 * (1.0 - 1e-12)).all()


def test_no_angle_moves_nothing_and_signs_change_no_size():
    values = np.array([1.0, -2.0, 3.0, 0.5])
    generator = np.random.default_rng(2)
    np.testing.assert_allclose(perturbed(values, generator, False, 0.0), values)
    assert np.array_equal(perturbed(values, generator, False, None), values)
    assert np.array_equal(np.abs(perturbed(values, generator, True, None)), np.abs(values))
