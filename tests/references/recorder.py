"""An observer that keeps all instants as arrays."""

import numpy as np

from ssilang.kernel.stepping.run import integrate


class Recorder:
    """Keeps displacement, velocity, acceleration, reaction of all times, or of one in `every`."""

    def __init__(self, n_times: int, every: int = 1) -> None:
        self.wanted = np.arange(n_times) % every == 0
        self.snapshots: list = []
        self.closed = False

    def receive(self, snapshot) -> None:
        self.snapshots.append(snapshot)

    def close(self) -> None:
        self.closed = True

    def of(self, name: str) -> np.ndarray:
        return np.array([getattr(s, name) for s in self.snapshots])


def recorded(problem, every=1, **how):
    """All instants of a problem, or some at equal distances, and the history of its steps."""
    recorder = Recorder(len(problem.times), every)
    return recorder, integrate(problem, [recorder], **how)


def assert_alike(run, exact, names=("u", "v", "a", "reaction", "w", "t", "state"), tolerance=1e-9):
    """Recorders and histories of two runs hold the same, relative to the largest value."""
    (one, history), (other, truth) = run, exact
    for name in names:
        a, b = one.of(name), other.of(name)
        assert np.abs(a - b).max(initial=0.0) <= tolerance * np.abs(b).max(initial=0.0), name
    size = np.abs(truth.energies).max()
    assert np.abs(history.energies - truth.energies).max() <= max(tolerance, 1e-10) * size
