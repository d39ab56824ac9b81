"""The state of a calculation under way, changed in place by the loops."""

from __future__ import annotations

from ssilang.kernel.stepping.problem.problem import Problem
from ssilang.kernel.stepping.rests.dense.loop import Motion
from ssilang.kernel.stepping.snapshot import Snapshot


def snapshot_of(problem: Problem, motion: Motion, step: int) -> Snapshot:
    """A copy of the state at a step."""
    m = motion
    parts = (m.u, m.v, m.a, m.reaction, m.w, m.t, m.state, m.contact)
    u, v, a, reaction, w, t, state, contact = (x.copy() for x in parts)
    time = float(problem.times[step])
    return Snapshot(problem, step, time, u, v, a, reaction, w, t, state, contact)


__all__ = ["Motion", "snapshot_of"]
