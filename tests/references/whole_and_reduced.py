"""A problem integrated whole and on a reduced basis."""

import numpy as np

from references.recorder import Recorder
from ssilang.kernel.stepping.rests.reduced.run import integrate_reduced
from ssilang.kernel.stepping.run import integrate


def relative(found, exact):
    """Largest difference over the largest value."""
    return float(np.abs(found - exact).max() / np.abs(exact).max())


def both(problem, tolerance):
    """Recorders and histories of the two."""
    whole, reduced = Recorder(len(problem.times)), Recorder(len(problem.times))
    exact = integrate(problem, [whole])
    history = integrate_reduced(problem, tolerance, [reduced])
    assert reduced.closed
    return whole, exact, reduced, history
