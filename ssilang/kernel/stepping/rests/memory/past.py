"""Jumps that past forces and loads bring: the convolution of a ground's kernels, on the way."""

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import SINGLE, FloatArray
from ssilang.kernel.base.threads import begun
from ssilang.kernel.interface.copies import add_symmetric_product
from ssilang.kernel.stepping.rests.memory.kernels import Kernels

BLOCK = 8
"""Steps whose far past is summed together: each kernel is read once for all of them."""
EVEN = 2, 5  # steps of a block in which later kernels and stages are read: no step waits for all


class Past:
    """Forces of a motion so far, and what they and the loads bring.

    Parameters
    ----------
    loads : array (n_steps + 1, k)
        Factors of the loads (of forces of norm one), less those of the start.
    """

    def __init__(self, kernels: Kernels, loads: FloatArray, steps: int) -> None:
        self.kernels, self.loads, q = kernels, loads, kernels.size
        k = kernels
        self.pad = max([len(k.whole), *(s.first + len(s.sums) for s in k.stages)])
        self.forces = np.zeros((self.pad + steps + 1, q), SINGLE)
        self.parts = [np.zeros((len(self.forces), s.P.shape[1]), SINGLE) for s in k.stages]
        self.near = [k.whole[0] + k.whole[1], *k.whole[2 : BLOCK + 1]]
        self.incoming = self._incoming((loads @ k.patterns).astype(SINGLE), steps)
        self.far = np.zeros((1, q), SINGLE)
        self.gone = np.zeros(k.stages[-1].P.shape[1] if k.stages else 0, SINGLE)
        """Sum of the forces before all kernels, in the last stage."""
        self.done, self.begun = 0, self.pad  # steps; rows of forces that stages have
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
        self.forces[now] = forces
        add_symmetric_product(self.near[0], self.forces[now].astype(float), total)
        self.done += 1
        if self.done < len(self.incoming):
            self.brought = begun(self._brought)  # while this step is solved
        return -total

    def _brought(self) -> FloatArray:
        phase, now = self.done % BLOCK, self.pad + self.done
        if phase == 0:
            self._add_kernels(range(2, BLOCK + 1))
        elif phase == EVEN[0]:
            self._add_kernels(range(BLOCK + 1, len(self.kernels.whole)))
        elif phase == EVEN[1]:
            self._add_stages()
        total = -self.incoming[self.done].astype(float)  # sums of increments drift by rounding
        for j in range(1, phase + 1):
            add_symmetric_product(self.near[j], self.forces[now - j].astype(float), total)
        return total

    def _add_kernels(self, numbers: Sequence[int]) -> None:
        """What forces before the next steps bring in each of them, by some whole kernels."""
        first, at = self.done, self.pad + self.done + 1
        for j in numbers:
            n = min(BLOCK, j - 1, len(self.incoming) - first)
            self.incoming[first : first + n] -= (
                self.forces[at - j : at - j + n] @ self.kernels.whole[j]
            )

    def _add_stages(self) -> None:
        """The same by stages."""
        k, first, at = self.kernels, self.done, self.pad + self.done + 1
        rows, steps = slice(self.begun, at - 1), min(BLOCK, len(self.incoming) - first)
        far = np.zeros((steps, len(self.far[0])), SINGLE)
        for stage, part in zip(k.stages, self.parts, strict=True):
            part[rows] = self.forces[rows] @ stage.P
            found = np.zeros((steps, part.shape[1]), SINGLE)
            for j, core in enumerate(stage.sums, stage.first):
                found += part[at - j : at - j + steps] @ core
            if stage is k.stages[-1]:
                j = at - stage.first - len(stage.sums)
                gone = self.gone + np.cumsum(part[j : j + steps], axis=0)
                found, self.gone = found + gone @ stage.sums[-1], gone[-1]
            far += found @ stage.P.T
        self.incoming[first : first + steps] -= np.diff(far, axis=0, prepend=self.far)
        self.begun, self.far = at - 1, far[-1:]
