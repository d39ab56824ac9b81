"""Event-driven exact motion of a linear system on unilateral springs."""

from dataclasses import dataclass, field

import numpy as np

from .arcs import Arc, Array, Forcing


@dataclass(frozen=True)
class UnilateralSpring:
    """Spring of stiffness `k` that acts only while its gap `c.u + offset` is negative."""

    c: Array
    k: float
    offset: float = 0.0

    def gap(self, u: Array) -> Array:
        """Gap for displacements of shape (..., n); positive when open."""
        return np.asarray(u @ self.c + self.offset)


@dataclass(frozen=True)
class Event:
    """A spring closes or opens: its number, the time, the state, the gap's velocity."""

    time: float
    spring: int
    closes: bool
    u: Array
    v: Array
    gap_velocity: float


@dataclass(frozen=True)
class System:
    """`M u'' + K u + sum_i c_i k_i min(gap_i, 0) = forcing(t)`.

    Several forcings follow each other in time, each from its own start.
    """

    mass: Array
    stiffness: Array
    springs: tuple[UnilateralSpring, ...]
    forcings: tuple[Forcing, ...]

    def arc(self, closed: list[bool], forcing: Forcing, t: float, u: Array, v: Array) -> Arc:
        """The arc that starts at `t` with the springs in the state `closed`."""
        stiffness = np.array(self.stiffness, float)
        constant = np.array(forcing.constant, float)
        for spring, shut in zip(self.springs, closed, strict=True):
            if shut:
                stiffness += spring.k * np.outer(spring.c, spring.c)
                constant -= spring.k * spring.offset * spring.c
        pushed = Forcing(
            forcing.start, constant, forcing.amplitude, forcing.pulsation, forcing.phase
        )
        return Arc(self.mass, stiffness, pushed, t, u, v)

    def energy(self, u: Array, v: Array, forcing: Forcing | None = None) -> Array:
        """Kinetic, elastic and constant loads' potential energy of states (..., n)."""
        force = (forcing or self.forcings[0]).constant
        kinetic = 0.5 * np.einsum("...i,ij,...j->...", v, self.mass, v)
        elastic = 0.5 * np.einsum("...i,ij,...j->...", u, self.stiffness, u)
        total = kinetic + elastic - u @ np.asarray(force, float)
        for spring in self.springs:
            total = total + 0.5 * spring.k * np.minimum(spring.gap(u), 0.0) ** 2
        return np.asarray(total)


@dataclass
class Motion:
    """Exact motion up to `end`: arcs one after the other and the events between them."""

    system: System
    end: float
    arcs: list[Arc] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)

    def __call__(self, t: Array | float) -> tuple[Array, Array]:
        """Displacement and velocity at the times `t` in [0, end], shapes (..., n)."""
        times = np.atleast_1d(np.asarray(t, float))
        starts = np.array([a.start for a in self.arcs])
        which = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, None)
        n = len(self.system.mass)
        u, v = np.empty((*times.shape, n)), np.empty((*times.shape, n))
        for i in np.unique(which):
            here = which == i
            u[here], v[here] = self.arcs[i].state(times[here])
        return (u, v) if np.ndim(t) else (u[0], v[0])

    def times(self, spring: int, closes: bool) -> Array:
        """Times at which a spring closes (or opens)."""
        return np.array([e.time for e in self.events if e.spring == spring and e.closes == closes])

    def energy(self, t: Array | float) -> Array:
        """Total energy at the times `t`, for a constant load."""
        return self.system.energy(*self(t))


def solve(system: System, u: Array, v: Array, end: float, max_events: int = 100_000) -> Motion:
    """Follow the motion from `u, v` at t = 0 to `end`, event by event.

    Raises
    ------
    RuntimeError
        If there are more than `max_events` events.
    """
    motion = Motion(system, end)
    u, v, t = np.array(u, float), np.array(v, float), 0.0
    closed = [bool(s.gap(u) < 0.0 or (s.gap(u) == 0.0 and s.c @ v < 0.0)) for s in system.springs]
    starts = [f.start for f in system.forcings[1:]] + [np.inf]
    stage = 0
    while len(motion.events) <= max_events:
        arc = system.arc(closed, system.forcings[stage], t, u, v)
        motion.arcs.append(arc)
        horizon = min(end, starts[stage])
        roots = [
            arc.first_root(s.c, s.offset, -1.0 if shut else 1.0, horizon)
            for s, shut in zip(system.springs, closed, strict=True)
        ]
        first = int(np.argmin(roots)) if roots else -1
        if not roots or roots[first] > horizon:
            if horizon >= end:
                return motion
            t, stage = horizon, stage + 1
            u, v = arc.state(t)
            continue
        t = roots[first]
        u, v = arc.state(t)
        closed[first] = not closed[first]
        spring = system.springs[first]
        motion.events.append(Event(t, first, closed[first], u, v, float(spring.c @ v)))
    raise RuntimeError(f"more than {max_events} events before t = {t}")
