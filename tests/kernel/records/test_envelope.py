"""Mean shocks counted by hand, envelopes against the energy that they keep."""

from itertools import pairwise

import numpy as np
import pytest
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.signals import energy_envelope, inverse_laplace, mean_shock

T = np.arange(12.0) * 0.5


@together("first", [1, 2, 3])
def test_shocks_are_found_wherever_they_begin(first):
    y = np.zeros(12)
    y[first : first + 3] = [4.0, -2.0, 1.0]
    y[first + 5 : first + 7] = [-3.0, 6.0]
    y[first - 1] = 2.0
    t, mean = mean_shock(T, y, 40.0, 1.0, None)  # above 2.4: at `first` and five samples later
    np.testing.assert_allclose(t, [0.0, 0.5, 1.0])
    np.testing.assert_allclose(mean, [(4 - 3) / 2, (-2 + 6) / 2, (1 + 0) / 2])


@together("rest", [[5.0, 5.0, 0.0, 0.0], [5.0, 0.0], [0.0]])
def test_a_shock_longer_than_its_recording_is_one(rest):
    y = np.pad([0.0, 5.0, 5.0, *rest, 3.0, 3.0], (0, 7 - len(rest)))
    _, mean = mean_shock(T, y, 50.0, 0.5, None)
    np.testing.assert_allclose(mean, [4.0, 4.0])
    _, mean = mean_shock(T, y, 50.0, 0.5, 1)
    np.testing.assert_allclose(mean, [5.0, 5.0])


@together("percent", [50.0, 99.0])
def test_a_shock_that_the_record_cuts_does_not_count(percent):
    y = np.zeros(12)
    y[11] = 1.0
    with refusal(FieldError, "kernel.records.record-no-whole-shock"):
        mean_shock(T, y, percent, 1.0, None)
    y[9] = 1.0
    with pytest.raises(FieldError):
        mean_shock(T, y, percent, 1.5, None)


def test_an_envelope_has_the_energy_of_the_signal_on_each_interval():
    rng = np.random.default_rng(4)
    x = np.linspace(0.0, 3.0, 301)
    y = rng.standard_normal(301) * np.exp(-((x - 1.0) ** 2))
    places, values = energy_envelope(x, y, 10)
    assert (values >= 0.0).all()
    assert places[0] == x[0]
    assert places[-1] == x[-1]
    line = np.interp(x, places, values)
    ends = np.searchsorted(x, places)
    assert len(ends) > 11  # some are shortened
    assert set(range(0, 301, 30)) <= set(ends.tolist())
    for begin, end in pairwise(ends):
        part = slice(begin + 1, end + 1)
        assert np.sum(line[part] ** 2) == pytest.approx(np.sum(y[part] ** 2), rel=1e-9)


@together("size", [1.0, 0.1, 0.3, 0.7, 1.1])
def test_a_line_that_falls_to_nought_is_its_own_envelope(size):
    x = np.arange(4.0)
    places, values = energy_envelope(x, size * (3.0 - x), 1)
    assert places.tolist() == [0.0, 3.0]
    np.testing.assert_allclose(values, [3.0 * size, 0.0], atol=1e-7)


@together("times, duration", [(T, 0.0), (T, -1.0), (np.zeros(12), 1.0)])
def test_a_recording_has_a_duration_and_a_step(times, duration):
    with refusal(FieldError, "kernel.records.recording-time-shock-must"):
        mean_shock(times, np.ones(12), 50.0, duration, None)


@together("step", [0.01, 1.0, 100.0])
def test_frequencies_of_a_laplace_transform_have_one_step(step):
    """The step is the same within a ten thousandth of itself."""
    omega = step * np.arange(8.0)
    values = 1.0 / (0.5 * step + 1j * omega)
    for share, sound in ((0.5e-4, True), (2e-4, False)):
        bent = omega.copy()
        bent[-1] += share * step
        if sound:
            inverse_laplace(bent, values, 0.5 * step, 2)
            continue
        with refusal(FieldError, "kernel.records.frequencies-begin-constant-step"):
            inverse_laplace(bent, values, 0.5 * step, 2)
