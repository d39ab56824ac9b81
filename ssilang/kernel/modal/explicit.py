"""Time stepping on modes with links: De Vogelaere, central differences, Newmark on the modes.

`M a + C v + K q = f(t) + links(q, v, t)`. The velocity that links see is the change of the
displacement since the last evaluation, as contact laws of this kind are defined.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.modal.explicit_loops import (
    Loads,
    Motion,
    Plan,
    Saved,
    System,
    de_vogelaere,
    newmark,
)
from ssilang.kernel.modal.link_laws import NX, NZ, PLANE, RECORDS, STATES, STIFF, LinkArrays

SCHEMES = ("DE_VOGELAERE", "DIFFERENCES_CENTREES", "ACCELERATION_MOYENNE", "FOX_GOODWIN")
BETA = {"DIFFERENCES_CENTREES": 0.0, "ACCELERATION_MOYENNE": 0.25, "FOX_GOODWIN": 1.0 / 12.0}
VARIABLES = ("DEPLACEMENT", "VITESSE", "DEPLACEMENT_1/2", "VITESSE_1/2", "ACCELERATION",
             "ACCELERATION_1/2", "TRAVAIL_EXTERIEUR", "TRAVAIL_INTERIEUR")  # fmt: skip
"""Rows of each saved step."""


@dataclass(frozen=True, eq=False)
class ModalState:
    """Where a run stands: q, v, acceleration and displacement of the half step before, links.

    `h` is the step that led there.
    """

    time: float
    q: FloatArray
    v: FloatArray
    before: FloatArray | None
    q_before: FloatArray | None
    links: FloatArray | None
    h: float = 0.0


@dataclass(frozen=True, eq=False)
class ModalRun:
    """What a run gives: times (m,), values (m, 8, n), links (m, L, RECORDS), the last state."""

    times: FloatArray
    values: FloatArray
    links: FloatArray
    last: ModalState


@dataclass(frozen=True, eq=False)
class ModalProblem:
    """What moves: modes, the forces on them and their links."""

    M: FloatArray  # (n, n)
    C: FloatArray  # (n, n)
    K: FloatArray  # (n, n)
    spaces: FloatArray  # (p, n) forces
    amplitudes: FloatArray  # (p, 2 steps + 1) their values at each half step
    links: LinkArrays


@dataclass(frozen=True)
class ModalSteps:
    """Step h (s), number of steps, steps from one saved to the next, one of SCHEMES, begin (s)."""

    h: float
    count: int
    every: int = 1
    scheme: str = "DE_VOGELAERE"
    begin: float = 0.0


def integrate_modes(problem: ModalProblem, start: ModalState, steps: ModalSteps) -> ModalRun:
    """Step through time.

    Raises
    ------
    KernelError
        For a singular mass, a step too long for the scheme, or a run that diverges.
    """
    M, C, K, links = problem.M, problem.C, problem.K, problem.links
    h, count, every, scheme = steps.h, steps.count, steps.every, steps.scheme
    if h <= 0.0 or count < 1 or every < 1:
        raise KernelError("kernel.modal.step-numbers-steps-must")
    if not np.isfinite(M).all() or np.linalg.matrix_rank(M) < len(M):
        raise KernelError("kernel.modal.mass-modes-singular")
    if h > (limit := largest_step(M, K, scheme)):
        raise KernelError("kernel.modal.step-too-long-most", h=h, scheme=scheme, limit=limit)
    n = len(M)
    saved = count // every + 1
    values = np.zeros((saved, len(VARIABLES), n))
    records = np.zeros((saved, len(links.kinds), RECORDS))
    state = np.zeros((len(links.kinds), STATES)) if start.links is None else start.links.copy()
    has_before = start.before is not None
    before = np.zeros(n) if start.before is None else start.before.copy()
    q_before = np.zeros(n) if start.q_before is None else start.q_before.copy()
    q, v = start.q.copy(), start.v.copy()
    loads, beta = Loads(problem.spaces, problem.amplitudes), BETA.get(scheme, 0.0)
    plan = Plan(start.time, h, count, every, beta)
    motion = Motion(q, v, before, q_before, has_before, state)
    inverse = _inverse(M)
    if scheme == "DE_VOGELAERE":
        half, full = _inverse(M + 5.0 * h / 24.0 * C), _inverse(M + h / 6.0 * C)
        system = System(inverse, half, full, C, K)
        de_vogelaere(system, loads, plan, links, motion, Saved(values, records))
    else:
        full = _inverse(M + 0.5 * h * C + beta * h * h * K)
        system = System(inverse, full, full, C, K)
        newmark(system, loads, plan, links, motion, Saved(values, records))
    if not np.isfinite(values).all():
        raise KernelError("kernel.modal.run-diverges")
    times = start.time + h * every * np.arange(saved, dtype=np.float64)
    end = ModalState(start.time + h * count, q, v, before, q_before, state, h)
    return ModalRun(times, values, records, end)


def _inverse(A: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.inv(A), dtype=np.float64)


def largest_step(M: FloatArray, K: FloatArray, scheme: str) -> float:
    """The largest step of an explicit or conditionally stable scheme, infinite for others."""
    limit = {"DE_VOGELAERE": 2.0 * np.sqrt(2.0), "DIFFERENCES_CENTREES": 2.0,
             "FOX_GOODWIN": np.sqrt(6.0)}.get(scheme)  # fmt: skip
    if limit is None:
        return np.inf
    fastest = float(np.linalg.eigvals(np.linalg.solve(M, K)).real.max(initial=0.0))
    return float(limit / np.sqrt(fastest)) if fastest > 0.0 else np.inf


def stiffness_of_links(links: LinkArrays) -> FloatArray:
    """Stiffness (n, n) of the springs of stops at planes, all closed."""
    numbers = links.numbers[links.kinds == PLANE]
    normals = numbers[:, NX : NZ + 1]
    receives, sees = (a[links.kinds == PLANE] for a in (links.receives, links.sees))
    rows = "l,la,lai,lb,lbj->ij", numbers[:, STIFF], normals, receives, normals, sees
    return np.asarray(np.einsum(*rows))
