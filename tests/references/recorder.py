"""An observer that keeps all instants as arrays."""

import numpy as np


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


def assert_alike(found, expected, tolerance: float) -> None:
    """Two runs, as (history, instants), have the same motions and energies."""
    for name in ("u", "v", "reaction", "w", "t", "state"):
        a, b = (np.array([getattr(s, name) for s in kept]) for _, kept in (found, expected))
        if b.size:
            assert np.abs(a - b).max() <= tolerance * np.abs(b).max(), name
    a, b = (history.energies for history, _ in (found, expected))
    assert np.abs(a - b).max() <= tolerance * np.abs(b).max()
