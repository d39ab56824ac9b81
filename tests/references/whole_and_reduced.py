"""A problem integrated whole and on a reduced basis."""

import numpy as np

from references.recorder import Recorder, recorded
from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced


def relative(found, exact):
    """Largest difference over the largest value."""
    return float(np.abs(found - exact).max() / np.abs(exact).max())


def both(problem, tolerance, known=None):
    """Recorders and histories of the two; those of the whole problem may be `known`."""
    (whole, exact), reduced = known or recorded(problem), Recorder(len(problem.times))
    history = integrate_reduced(problem, tolerance, [reduced])
    assert reduced.closed
    return whole, exact, reduced, history


def check(problem, tolerance, energy=10.0, known=None):
    """Recorders of the two; the reduced one is small, and as good as it says and was asked for."""
    whole, exact, reduced, history = both(problem, tolerance, known)
    found = history.reduction
    assert found.refused is None
    assert history.loop == "reduced"
    assert 0 < found.vectors <= 0.5 * len(whole.of("u")[0])
    assert found.estimate <= tolerance
    assert whole.of("w")[..., 1].max() > 1e-4  # it lifts off
    errors = [relative(reduced.of(x), whole.of(x)) for x in ("u", "w")]
    assert max(errors) <= tolerance
    assert max(errors) <= 2 * found.estimate
    scale = np.abs(exact.energies).max()
    assert np.abs(history.energies - exact.energies).max() <= energy * tolerance * scale
    return whole, reduced
