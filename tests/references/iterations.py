"""Newton on an interface in plain numpy, without kept factors: what the compiled one must give."""

import numpy as np

from ssilang.kernel.interface.factors.kept import new_factors
from ssilang.kernel.interface.newton import Workspace, solve_interface
from ssilang.kernel.interface.response import (
    InterfaceState,
    interface_response,
    interface_stiffness,
    new_trial,
)

KINDS = {
    "usual": {},
    "inverse": {"few": 10**6},
    "LU": {"few": 0},
    "single LU": {"few": 0, "single": True},
}
"""A threshold: what is followed at once, or corrected for."""


def room(joints, q, kind):
    """Arrays for an iteration with one kind of factors."""
    shape = (len(joints.weights), joints.B.shape[1])
    factors = new_factors(shape, q, **KINDS[kind])
    return Workspace(new_trial(shape, q), factors, np.full(shape, np.nan))


def at_rest(joints, q, state):
    """An interface without jumps and forces."""
    shape = (len(joints.weights), joints.B.shape[1])
    return InterfaceState(np.zeros(q), np.zeros(q), np.zeros(shape), np.zeros(shape), state)


def compiled_newton(joints, condensed, now, y0, work):
    """The compiled iteration from the linear prediction y0: turns; `work.trial` is its end."""
    work.trial.y0[:] = work.trial.y[:] = y0
    return solve_interface(joints, condensed, now, work)[0]


def plain_newton(joints, condensed, now, y0, turns=30):
    """The same by full matrices, made anew in each turn: turns and end of the step."""
    q, (S, R, c, *_) = len(y0), condensed
    end = new_trial((len(joints.weights), joints.B.shape[1]), q)
    R = R if len(R) else np.zeros((q, q))
    K, end.y[:] = np.zeros((q, q)), y0
    for turn in range(1, turns + 1):
        end.delta[:] = now.delta + end.y
        interface_response(joints, now.state, end.delta, end)
        end.h[:] = c * (end.f - now.f) - R @ end.y
        rest = end.y - y0 + S @ end.h
        if np.abs(rest).max() <= 1e-12 * max(np.abs(x).max() for x in (y0, now.delta, end.y)):
            return turn, end
        interface_stiffness(joints, end.D, K)
        end.y[:] -= np.linalg.solve(np.eye(q) + S @ (c * K - R), rest)
    raise AssertionError(f"no convergence in {turns} turns")
