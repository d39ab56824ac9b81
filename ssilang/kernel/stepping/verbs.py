"""The verbs of a step that all loops share, compiled: Newmark's formulas, rows that are kept."""

import math

from ssilang.kernel.base.compiled.apart import apart, later
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fast, compiled_inline
from ssilang.kernel.interface.copies import copy_rows, copy_state
from ssilang.kernel.stepping import newmark
from ssilang.kernel.stepping.state import Motion, Peaks, Recorder, Tap

advance = compiled_inline(newmark.advanced)
from_past = compiled_inline(newmark.from_past)


@compiled_inline
def damped(
    n: newmark.Newmark, alpha: float, beta: float, Mx: float, rest: float, force: float,
    Cv: float, Ca: float,
) -> tuple[float, float]:  # fmt: skip
    """Damping forces `(alpha M + beta K + C_rest) v`, and the same of a, after an increment.

    Without a product with K: from the balance of the step.

    Parameters
    ----------
    Mx, rest
        Mass and C_rest times the increment.
    force
        What the step's loads and inertia add.
    """
    part = alpha * Mx + rest
    Kx = force + Cv - advance(n, part, Cv, Ca)[0]
    return advance(n, part + beta * Kx / (1 + beta * n.v_du), Cv, Ca)


@compiled
def _keep_joints(x: Motion, to: Recorder | Tap, row: int) -> None:
    """Forces and state of relations and joints into a row, whole."""
    if len(to.f):
        copy_state(x.f, to.f[row])
    if len(to.w):
        copy_rows(x.w, to.w[row])
    if len(to.t):
        copy_rows(x.t, to.t[row])
    if len(to.state):
        copy_rows(x.state, to.state[row])
    if len(to.contact):
        copy_state(x.contact, to.contact[row])


@later
@compiled
def keep(x: Motion, to: Recorder, row: int) -> None:
    """The present state into a row of those of its parts that are kept."""
    if len(to.u):
        copy_state(x.u, to.u[row])
        copy_state(x.v, to.v[row])
        copy_state(x.a, to.a[row])
    if len(to.reaction):
        copy_state(x.reaction, to.reaction[row])
    _keep_joints(x, to, row)


@apart
@compiled
def tap(x: Motion, to: Tap, row: int) -> None:
    """The entries of the present state that are tapped into a row."""
    for i in range(len(to.at)):
        j = to.at[i]
        to.u[row, i], to.v[row, i], to.a[row, i] = x.u[j], x.v[j], x.a[j]
    if len(to.reaction):
        for i in range(len(to.at)):
            to.reaction[row, i] = x.reaction[to.at[i]]
    _keep_joints(x, to, row)


@later
@compiled_fast
def watch(x: Motion, to: Peaks, k: int) -> None:
    """What is larger at the end of step k than ever before."""
    step = to.first[0] + k + 1.0
    for i in range(len(to.u)):
        larger = abs(x.u[i]) > abs(to.u[i])
        to.u[i] = x.u[i] if larger else to.u[i]
        to.when[i] = step if larger else to.when[i]
    for i in range(to.joints.shape[1]):
        last, shear = x.t.shape[1] - 1, 0.0
        for j in range(last):
            shear += x.t[i, j] * x.t[i, j]
        _watch_one(to, 0, i, x.w[i, last], step)
        _watch_one(to, 1, i, -x.t[i, last], step)
        _watch_one(to, 2, i, math.sqrt(shear), step)


@compiled_fast
def _watch_one(to: Peaks, kind: int, i: int, value: float, step: float) -> None:
    if value > to.joints[kind, i]:
        to.joints[kind, i], to.joints_when[kind, i] = value, step


@compiled_inline
def end_of_step(x: Motion, to: Recorder, k: int) -> None:
    """What step k leaves: its energies, its rows, what is larger than ever before."""
    copy_state(x.energies, to.energies[k])
    if to.row[k] >= 0:
        keep(x, to, to.row[k])
    if to.tap.row[k] >= 0:
        tap(x, to.tap, to.tap.row[k])
    if len(to.peaks.u):
        watch(x, to.peaks, k)
