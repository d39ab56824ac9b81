"""The two ways to follow a path: a load sought in its direction, or the time of the loads."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.plasticity.following import Control, PathRun
from ssilang.kernel.plasticity.run import HALVINGS, BulkRun
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
