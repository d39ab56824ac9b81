"""Ways to follow a path: a load sought in its direction, the time of the loads, or arc length."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.continuation.arc import Lengths
from ssilang.kernel.plasticity.following import Control, PathRun, Split
from ssilang.kernel.plasticity.run import HALVINGS, BulkRun
from ssilang.kernel.statics.stability import count_negative
from ssilang.kernel.stepping.run import History

END = 1e-9
"""Share of an interval of time taken for its end."""


@dataclass
class Trace:
    """What a path leaves behind: times of the steps, load parameters, whether it was cut short."""

    times: list[float] = field(default_factory=list)
    parameters: list[float] = field(default_factory=list)
    unfinished: bool = False


def history_of(path: PathRun, trace: Trace, seconds: float) -> History:
    """The steps as other calculations report them."""
    history = History(np.array(trace.times), np.array(path.energies), solver="SuperLU")
    history.loop = "path following"
    history.beyond = path.run.bulk.beyond_curves(path.run.begun, path.run.state)
    history.iterations, history.seconds = path.iterations, seconds
    return history


def follow_directions(
    run: BulkRun, count: int, asked: FloatArray, control_of: Callable[[float], Control]
) -> tuple[PathRun, Trace]:
    """Steps at the times of the problem: the last `count` loads have an unknown common factor.

    Parameters
    ----------
    asked : array (n_times - 1,)
        What the control must reach over each step.
    control_of : callable
        The control of a step, from what it must reach.

    Raises
    ------
    ConvergenceError
        If a step does not converge however short.
    """
    path, trace = PathRun(run), Trace([float(run.problem.times[0])], [0.0])
    times = run.problem.times
    factors = run.problem.loading.at(times)
    factors[:, -count:] = 0.0
    change = np.zeros(factors.shape[1])
    change[-count:] = 1.0
    eta = 0.0
    path.settle(factors[0])
    path.save(float(times[0]))
    for k in range(1, len(times)):
        done, length = 0.0, 1.0
        control = control_of(float(asked[k - 1]))
        while done < 1.0 - END:
            share = min(length, 1.0 - done)
            end = done + share
            known = (1 - end) * factors[k - 1] + end * factors[k] + eta * change
            time = float((1 - end) * times[k - 1] + end * times[k])
            step = path.step(known, change, control, share, time)
            if step is None:
                length *= 0.5
                if length < 0.5**HALVINGS:
                    told = {"k": k, "times": times[k], "halvings": HALVINGS}
                    raise ConvergenceError("kernel.plasticity.step-time-no-point", **told)
                continue
            eta, done, length = eta + step, end, min(2 * length, 1.0)
        trace.times.append(float(times[k]))
        trace.parameters.append(eta)
        while len(path.energies) > len(trace.times):
            del path.energies[-2]
        path.save(float(times[k]))
    return path, trace


def follow_time(
    run: BulkRun, control_of: Callable[[PathRun], Control], most: int, every: int
) -> tuple[PathRun, Trace]:
    """Times sought with the displacements: the control bounds each step towards the next time.

    Between two times of the problem the loads go straight on, beyond these times too where the
    path goes back.

    Parameters
    ----------
    most : int
        Steps allowed to reach each time; the path ends there if they do not suffice.
    every : int
        One step in so many is saved, and each time of the problem.
    """
    times = run.problem.times
    path, trace = PathRun(run), Trace([float(times[0])], [0.0])
    factors = run.problem.loading.at(times)
    control = control_of(path)
    path.settle(factors[0])
    path.save(float(times[0]))
    for k in range(1, len(times)):
        change = factors[k] - factors[k - 1]
        path.head_for(change, float(times[k] - times[k - 1]))
        s = 0.0
        for number in range(1, most + 1):
            s = _towards(path, factors[k - 1], change, control, s, times[k - 1 : k + 1])
            now = float(times[k - 1] + s * (times[k] - times[k - 1]))
            trace.times.append(now)
            trace.parameters.append(s)
            ended = abs(1.0 - s) <= END
            if ended or number % every == 0 or number == most:
                path.save(float(times[k]) if ended else now)
            if ended:
                break
        else:
            trace.unfinished = True
            break
    return path, trace


def _towards(
    path: PathRun, before: FloatArray, change: FloatArray, control: Control, s: float,
    times: FloatArray,
) -> float:  # fmt: skip
    """One step from the share s of an interval: the new share, 1 where the end is in reach."""
    known = before + s * change
    now = float(times[0] + s * (times[1] - times[0]))
    share = 1.0
    while share >= 0.5**HALVINGS:
        step = path.step(known, change, control, share, now, 1.0 - s)
        if step is not None:
            return s + step
        share *= 0.5
    raise ConvergenceError("kernel.plasticity.time-no-point-path", now=now, halvings=HALVINGS)


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
    """Times, displacements and the negative terms of the tangent stiffness at each."""

    negative: list[float] = field(default_factory=list)
    motions: list[FloatArray] = field(default_factory=list)


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
    trace.motions.append(run.motion.u.copy())
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
        trace.motions.append(run.motion.u.copy())
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
