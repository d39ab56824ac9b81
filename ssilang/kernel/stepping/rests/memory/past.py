"""Jumps that past forces and loads bring: the convolution of a ground's kernels, on the way.

Sums `A_k = G_1 + .. + G_k` of kernels act on changes of forces, `G_1 f_n + G_2 f_(n-1) + .. =
A_1 (f_n - f_(n-1)) + A_2 (f_(n-1) - f_(n-2)) + ..`: what is left out of them adds up to nothing
while forces stay. What acts k steps later is known for the k steps to come, so that large sums,
which come from memory, are read once for many.
"""

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, FloatArray
from ssilang.kernel.base.threads import begun
from ssilang.kernel.solvers.low_rank import add_low_rank_product
from ssilang.kernel.stepping.rests.memory.kernels import Kernels


def _together(delay: int) -> int:
    """Steps, a power of two, for which what acts so many steps later is summed at once."""
    return 1 << (delay.bit_length() - 1)


class Past:
    """Forces of a motion so far, and what they and the loads bring.

    Parameters
    ----------
    loads : array (n_steps + 1, k)
        Factors of the loads (of forces of norm one), less those of the start.
    """

    def __init__(self, kernels: Kernels, loads: FloatArray, steps: int) -> None:
        self.kernels, self.loads, q = kernels, loads, kernels.size
        k, self.last = kernels, np.zeros(q)
        self.pad = max([len(k.sums) + 1, *(s.first + len(s.sums) for s in k.stages)])
        self.forces, self.changes = np.zeros((2, self.pad + steps + 1, q), SINGLE)
        self.parts = [np.zeros((len(self.forces), s.P.shape[1]), SINGLE) for s in k.stages]
        self.coming = self._loaded((loads @ k.patterns).astype(SINGLE), steps)
        """What is known of each step: in doubles, as sums of increments drift by rounding."""
        self.far = np.zeros((len(k.stages), q), SINGLE)
        self.gone = np.zeros(k.stages[-1].P.shape[1] if k.stages else 0, SINGLE)
        """Sum of the forces before all kernels, in the last stage."""
        self.done = 0  # steps
        self.begun = [self.pad] * len(k.stages)  # rows of forces that each stage has
        self.brought = begun(self._bring)
        """Until the next step has what the forces before its start's bring."""

    def _loaded(self, loads: FloatArray, steps: int) -> FloatArray:
        found = np.zeros((steps, self.kernels.size), SINGLE)
        for k, rows in enumerate(self.kernels.loads[:steps]):
            found[k:] += loads[1 : steps + 1 - k] @ rows.T
        return -found.astype(float)

    def next(self, forces: FloatArray) -> FloatArray:
        """Increment (q,) of the jumps in the next step, under unchanged forces (less the start's).

        Those of the whole past are there, and stay.
        """
        self.brought()
        now = self.pad + self.done
        self.forces[now], self.changes[now] = forces, forces - self.last
        self.last = forces.copy()
        self._add(0, 1)
        self.done += 1
        if self.done < len(self.coming):
            self.brought = begun(self._bring)  # while this step is solved
        return -self.coming[self.done - 1]

    def _add(self, number: int, steps: int) -> None:
        """What one sum brings in the next steps of the changes, or of the forces if it lasts."""
        sums, at = self.kernels.sums, self.pad + self.done - number
        lasts = number == len(sums) - 1 and not self.kernels.stages
        to = self.coming[self.done : self.done + steps]
        x = (self.forces if lasts else self.changes)[at : at + len(to)]
        add_low_rank_product(sums[number], False, x.ravel(), to.ravel())

    def _bring(self) -> None:
        """What is due: sums and stages are read once for as many steps as is known, in turns."""
        for number in range(1, len(self.kernels.sums)):
            steps = _together(number)
            if (self.done - number) % steps == 0:
                self._add(number, steps)
        for number, stage in enumerate(self.kernels.stages):
            steps = _together(stage.first - 1)
            if (self.done + number + 1) % steps == 0:  # rather where no large sum is
                self._add_stage(number, steps)

    def _add_stage(self, number: int, steps: int) -> None:
        """What forces before the next steps bring in each of them, by a stage."""
        stage, part, at = self.kernels.stages[number], self.parts[number], self.pad + self.done + 1
        to, rows = self.coming[self.done : self.done + steps], slice(self.begun[number], at - 1)
        part[rows] = self.forces[rows] @ stage.P
        found = np.zeros((len(to), part.shape[1]), SINGLE)
        for j, core in enumerate(stage.sums, stage.first):
            found += part[at - j : at - j + len(to)] @ core
        if stage is self.kernels.stages[-1]:
            j = at - stage.first - len(stage.sums)
            gone = self.gone + np.cumsum(part[j : j + len(to)], axis=0)
            found, self.gone = found + gone @ stage.sums[-1], gone[-1]
        far = found @ stage.P.T
        to += np.diff(far, axis=0, prepend=self.far[number, None])
        self.begun[number], self.far[number] = at - 1, far[-1]
