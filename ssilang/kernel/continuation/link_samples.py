"""Forces of links at instants of a period, with their derivatives by small differences."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.modal.link_laws import link_forces
from ssilang.kernel.modal.links import (
    COSINE_OF_TIME,
    FRICTION,
    PLASTIC,
    RECORDS,
    SINE_OF_TIME,
    STATES,
    TANGENT,
    LinkArrays,
)

SMALL = 1e-6
"""Difference over the size of the motion."""


@dataclass(frozen=True, eq=False)
class LinkForces:
    """Links whose forces follow from motion and velocity at the same instant."""

    links: LinkArrays

    def __post_init__(self) -> None:
        table = self.links.numbers
        past = (table[:, PLASTIC] != 0.0) | ((table[:, FRICTION] != 0.0) & (table[:, TANGENT] >= 0))
        if past.any():
            raise KernelError(
                "kernel.continuation.link-remembers-past-plastic",
                past=int(np.flatnonzero(past)[0]) + 1,
            )
        timed = np.isin(self.links.kinds, (COSINE_OF_TIME, SINE_OF_TIME))
        if timed.any():
            raise KernelError(
                "kernel.continuation.link-changes-time-frequency",
                timed=int(np.flatnonzero(timed)[0]) + 1,
            )

    def at(self, q: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """f (N, n), df/dq and df/dv (N, n, n)."""
        k = self.links
        f, (fq, fv) = np.zeros(q.shape), np.zeros((2, *q.shape, q.shape[1]))
        if not len(k.kinds):
            return f, fq, fv
        steps = [SMALL * max(float(np.abs(x).max(initial=0.0)), 1e-9) for x in (q, v)]
        sample_links(
            np.ascontiguousarray(q), np.ascontiguousarray(v), (steps[0], steps[1]), k, f, fq, fv,
        )  # fmt: skip
        return f, fq, fv


@compiled
def sample_links(
    q: FloatArray, v: FloatArray, steps: tuple[float, float], links: LinkArrays,
    f: FloatArray, fq: FloatArray, fv: FloatArray,
) -> None:  # fmt: skip
    """Fill f, fq and fv: central differences by `steps` of q and v, an instant after the other."""
    count, n = q.shape
    up, down = np.zeros(n), np.zeros(n)
    state = np.zeros((len(links.kinds), STATES))
    record = np.zeros((len(links.kinds), RECORDS))
    for i in range(count):
        x, y = q[i].copy(), v[i].copy()
        state[:] = 0.0
        link_forces(x, y, 0.0, links, state, record, up)
        for m in range(n):
            f[i, m] = up[m]
        for j in range(n):
            for which in range(2):
                moved = x if which == 0 else y
                h = steps[which]
                old = moved[j]
                moved[j] = old + h
                state[:] = 0.0
                link_forces(x, y, 0.0, links, state, record, up)
                moved[j] = old - h
                state[:] = 0.0
                link_forces(x, y, 0.0, links, state, record, down)
                moved[j] = old
                for m in range(n):
                    slope = (up[m] - down[m]) / (2.0 * h)
                    if which == 0:
                        fq[i, m, j] = slope
                    else:
                        fv[i, m, j] = slope
