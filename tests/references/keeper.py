"""A keeper of calculations that ends them at a step, and gives their state to another."""

from contextlib import nullcontext

import numpy as np

from ssilang.io.checkpoint import Checkpoints, Deck


class Ending:
    """Cuts steps at multiples of `stride`; ends the calculation behind step `ends` (None: never).

    The state goes through a file of `folder`, as that of a killed run does.
    """

    def __init__(self, folder, stride: int, ends: int | None = None, resume: bool = False) -> None:
        self.files = Checkpoints(folder, Deck("0", "a deck"), resume)
        self.every, self.ends, self.known = stride, ends, 0

    def stride(self, done: int, unknowns: int) -> int:
        return self.every - done % self.every

    def steady(self, done: int, state):
        return nullcontext()

    def reached(self, done: int, state) -> None:
        if self.ends is not None and done >= self.ends:
            raise KeyboardInterrupt

    def left(self, done: int, state) -> None:
        found = state()
        assert len(found["energies"]) == done + 1
        self.files.write(1, {}, found, {"energies": found.pop("energies")[self.known :]})

    def finished(self, done: int, state) -> None:
        """Nothing is kept of what is whole."""

    def last(self):
        kept = self.files.read(1)
        if kept is None:
            return None
        energies = np.concatenate([batch["energies"] for batch in kept.rows])
        self.known = len(energies)
        return kept.state | {"energies": energies}
