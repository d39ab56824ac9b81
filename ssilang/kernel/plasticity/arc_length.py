"""Load steps of a given length along the path of load and displacement (arc length)."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.continuation.arc import Lengths
from ssilang.kernel.plasticity.driven_load import Trace
from ssilang.kernel.plasticity.following import PathRun, Split
from ssilang.kernel.plasticity.run import BulkRun
from ssilang.kernel.statics.stability import count_negative


@dataclass
class ArcControl:
    """The first iteration goes ds along the tangent, the others stay across it.

    Attributes
    ----------
    way : tuple of array (n,) and float, or None
        Displacement and time of the step before: the next one goes on that way.
    """

    lengths: Lengths
    ds: float
    way: tuple[FloatArray, float] | None = None
    predicted: tuple[FloatArray, float] | None = None

    def product(self, du: FloatArray, dt: float, dv: FloatArray, ds: float) -> float:
        """Scalar product of two increments in the units of the lengths."""
        return float(du @ dv) / self.lengths.u_ref**2 + dt * ds / self.lengths.t_ref**2

    def __call__(self, split: Split, share: float) -> list[float]:
        if split.x == 0.0 and not split.du.any():
            size = np.sqrt(self.product(split.unit, 1.0, split.unit, 1.0))
            sense = 1.0
            if self.way is not None:
                sense = np.sign(self.product(split.unit, 1.0, *self.way)) or 1.0
            x = float(sense * share * self.ds / size)
            self.predicted = (x * split.unit, x)
            return [x]
        assert self.predicted is not None
        across = self.product(split.unit, 1.0, *self.predicted)
        return [-self.product(split.rest, 0.0, *self.predicted) / across]


@dataclass
class ArcTrace(Trace):
    """Times, and the negative terms of the tangent stiffness at each."""

    negative: list[float] = field(default_factory=list)


def follow_arc(
    run: BulkRun, rate: FloatArray, lengths: Lengths, inside: Callable[[float], bool], most: int,
    every: int, stability: bool = False,
) -> tuple[PathRun, ArcTrace]:  # fmt: skip
    """Steps of equal length, shorter where they are hard, while `inside(t)`.

    Parameters
    ----------
    rate : array (k,)
        Change of the load factors in a unit of time.
    every : int
        One solution in so many is saved, and the last.

    Raises
    ------
    ConvergenceError
        If the shortest step finds no solution.
    """
    t = float(run.problem.times[0])
    path, trace = PathRun(run), ArcTrace([t], [0.0])
    start = run.problem.loading.at(run.problem.times[:1])[0]
    control = ArcControl(lengths, lengths.start)
    path.settle(start)
    path.save(t)
    if stability:
        trace.negative.append(_negative(path))
    began = t
    for number in range(1, most + 1):
        before = run.motion.u.copy()
        step = None
        while step is None:
            path.solver.last = None
            step = path.step(start + (t - began) * rate, rate, control, 1.0, t)
            if step is None:
                if control.ds <= lengths.least:
                    raise ConvergenceError("kernel.plasticity.time-no-solution-found", t=t)
                control.ds = max(0.5 * control.ds, lengths.least)
        t += step
        control.way = (run.motion.u - before, step)
        ease = np.clip(lengths.ideal / max(path.turns, 1), 0.5, 2.0)
        control.ds = float(np.clip(control.ds * ease, lengths.least, lengths.most))
        trace.times.append(t)
        trace.parameters.append(step)
        if stability:
            trace.negative.append(_negative(path))
        ended = not inside(t) or number == most
        if number % every == 0 or ended:
            path.save(t)
        if ended:
            break
    return path, trace


def _negative(path: PathRun) -> float:
    """Negative eigenvalues of the tangent stiffness on the motions that supports leave."""
    run, solver = path.run, path.solver
    now = solver.standing(run.motion)
    T = run.problem.constraints.T
    whole = solver.A + now.K + now.answer.tangent
    return float(count_negative(sp.csr_array(T.T @ whole @ T)))
