"""Jumps that past forces and loads bring: the convolution of a ground's kernels, on the way.

Sums `A_k = G_1 + .. + G_k` of kernels act on changes of forces, `G_1 f_n + G_2 f_(n-1) + .. =
A_1 (f_n - f_(n-1)) + A_2 (f_(n-1) - f_(n-2)) + ..`: what is left out of them adds up to nothing
while forces stay.
"""

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, FloatArray
from ssilang.kernel.base.threads import begun
from ssilang.kernel.solvers.low_rank import add_low_rank_product
from ssilang.kernel.stepping.rests.memory.kernels import Kernels

BLOCK = 8
"""Steps for which a stage is summed together: each is read once for all of them, in its turn."""


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
        self.incoming = self._incoming((loads @ k.patterns).astype(SINGLE), steps)
        self.far = np.zeros((len(k.stages), q), SINGLE)
        self.gone = np.zeros(k.stages[-1].P.shape[1] if k.stages else 0, SINGLE)
        """Sum of the forces before all kernels, in the last stage."""
        self.done = 0  # steps
        self.begun = [self.pad] * len(k.stages)  # rows of forces that each stage has
        self.brought = begun(self._brought)
        """What the next step has of the forces before its start's."""

    def _incoming(self, loads: FloatArray, steps: int) -> FloatArray:
        found = np.zeros((steps, self.kernels.size), SINGLE)
        for k, rows in enumerate(self.kernels.loads[:steps]):
            found[k:] += loads[1 : steps + 1 - k] @ rows.T
        return found

    def next(self, forces: FloatArray) -> FloatArray:
        """Increment (q,) of the jumps in the next step, under unchanged forces (less the start's).

        Those of the whole past are there, and stay.
        """
        total, now = self.brought(), self.pad + self.done
        self.forces[now], self.changes[now] = forces, forces - self.last
        self.last = forces.copy()
        self._add(0, now, total)
        self.done += 1
        if self.done < len(self.incoming):
            self.brought = begun(self._brought)  # while this step is solved
        return -total

    def _add(self, number: int, row: int, total: FloatArray) -> None:
        """What one sum brings of the changes, or of the forces if it lasts."""
        sums = self.kernels.sums
        lasts = number == len(sums) - 1 and not self.kernels.stages
        x = (self.forces if lasts else self.changes)[row].astype(float)
        add_low_rank_product(sums[number], False, x, total)

    def _brought(self) -> FloatArray:
        for i in range(self.done % BLOCK, len(self.kernels.stages), BLOCK):
            self._add_stage(i)
        total = -self.incoming[self.done].astype(float)  # sums of increments drift by rounding
        for j in range(1, len(self.kernels.sums)):
            self._add(j, self.pad + self.done - j, total)
        return total

    def _add_stage(self, number: int) -> None:
        """What forces before the next steps bring in each of them, by a stage."""
        stages, first, at = self.kernels.stages, self.done, self.pad + self.done + 1
        stage, part, steps = stages[number], self.parts[number], len(self.incoming) - first
        rows, steps = slice(self.begun[number], at - 1), min(BLOCK, steps)
        part[rows] = self.forces[rows] @ stage.P
        found = np.zeros((steps, part.shape[1]), SINGLE)
        for j, core in enumerate(stage.sums, stage.first):
            found += part[at - j : at - j + steps] @ core
        if stage is stages[-1]:
            j = at - stage.first - len(stage.sums)
            gone = self.gone + np.cumsum(part[j : j + steps], axis=0)
            found, self.gone = found + gone @ stage.sums[-1], gone[-1]
        far = found @ stage.P.T
        self.incoming[first : first + steps] -= np.diff(far, axis=0, prepend=self.far[number, None])
        self.begun[number], self.far[number] = at - 1, far[-1]
