"""An observer that keeps all instants as arrays."""

import numpy as np


class Recorder:
    """Keeps displacement, velocity, acceleration, reaction of all times."""

    def __init__(self, n_times: int) -> None:
        self.wanted = np.ones(n_times, bool)
        self.snapshots: list = []
        self.closed = False

    def receive(self, snapshot) -> None:
        self.snapshots.append(snapshot)

    def close(self) -> None:
        self.closed = True

    def of(self, name: str) -> np.ndarray:
        return np.array([getattr(s, name) for s in self.snapshots])
