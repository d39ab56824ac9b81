"""Branches of solutions of `R(u, t) = 0` by pseudo arc length (Keller 1977).

Lengths are `ds^2 = dt^2/t_ref^2 + |du|^2/u_ref^2`. A step goes ds along the tangent, then Newton's
method comes back to the branch in the plane across it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import ConvergenceError

BISECTIONS = 40
FAR = 0.5
"""Correction over the step, beyond which the solution is taken for one of another branch."""
CORNER = 5.0
"""The same for the shortest step, which goes around corners of the branch."""
BEYOND = 1e-3
"""Length by which a step passes a limit point at most; its t stays beyond that before."""


class System(Protocol):
    """Equations in u (n,) and one parameter t."""

    def at(self, u: FloatArray, t: float) -> tuple[FloatArray, FloatArray, FloatArray]:
        """R (n,), dR/du (n, n), dR/dt (n,)."""

    def force(self, t: float) -> float:
        """Size of the forces that R is compared with."""


@dataclass(frozen=True)
class Lengths:
    """How far steps go."""

    start: float  # first length ds
    least: float  # least length ds
    most: float  # largest length ds
    ideal: float = 6.0  # iterations that keep the length
    turns: int = 24  # iterations at most
    u_ref: float = 1.0  # unit of u in the lengths
    t_ref: float = 1.0  # unit of t in them
    tolerance: float = 1e-6  # of the residual, over the forces
    # steps that turn by more than this angle (radians) from the one before are cut
    bend: float = np.pi


@dataclass(frozen=True, eq=False)
class Point:
    """A solution: u (n,), t, the unit tangent of the branch there (scaled), dR/du."""

    u: FloatArray
    t: float
    tangent: FloatArray
    jacobian: FloatArray
    turns: int = 0


@dataclass(eq=False)
class Branch:
    """The solutions found, and why there are no more."""

    points: list[Point] = field(default_factory=list)
    ended: str = ""


class Tracer:
    """Follows one branch of a system."""

    def __init__(self, system: System, lengths: Lengths) -> None:
        self.system, self.lengths = system, lengths

    def first(self, u: FloatArray, t: float, sense: float = 1.0) -> Point:
        """The solution nearest to u at a given t, with its tangent towards `sense` in t.

        Raises
        ------
        ConvergenceError
            If Newton's method finds none.
        """
        size = 0.0
        for turn in range(self.lengths.turns + 1):
            R, J, _ = self.system.at(u, t)
            size = float(np.linalg.norm(R))
            if not (np.isfinite(size) and np.isfinite(J).all()):
                break
            if size <= self.lengths.tolerance * self._scale(u, t):
                return self._point(u, t, None, sense, turn)
            u = u - np.linalg.lstsq(J, R, rcond=None)[0]
            if not np.isfinite(u).all():
                break
        raise ConvergenceError("kernel.continuation.no-first-solution-found", t=t, size=size)

    def _scale(self, u: FloatArray, t: float) -> float:
        return max(self.system.force(t), 1e-300)

    def _scaled(self, du: FloatArray, dt: float) -> FloatArray:
        return np.append(du / self.lengths.u_ref, dt / self.lengths.t_ref)

    def _point(
        self, u: FloatArray, t: float, towards: FloatArray | None, sense: float, turns: int
    ) -> Point:
        _, J, Rt = self.system.at(u, t)
        scaled = np.column_stack([J * self.lengths.u_ref, Rt * self.lengths.t_ref])
        if not np.isfinite(scaled).all():
            raise ConvergenceError("kernel.continuation.tangent-branch-not-made", t=t)
        tangent = np.linalg.svd(scaled)[2][-1] if towards is None else _across(scaled, towards)
        ahead = float(tangent[-1] * sense) if towards is None else float(tangent @ towards)
        return Point(u, t, -tangent if ahead < 0.0 else tangent, J, turns)

    def turned(self, point: Point, du: FloatArray, dt: float) -> Point:
        """The same point with its tangent the way of a given increment."""
        way = self._scaled(du, dt)
        tangent = point.tangent if point.tangent @ way >= 0.0 else -point.tangent
        return Point(point.u, point.t, tangent, point.jacobian, point.turns)

    def step(self, point: Point, ds: float) -> Point | None:
        """The solution ds further along the tangent, None if there is none near."""
        u_ref, t_ref = self.lengths.u_ref, self.lengths.t_ref
        u = point.u + ds * point.tangent[:-1] * u_ref
        t = point.t + ds * float(point.tangent[-1]) * t_ref
        start_u, start_t, close = u, t, False
        row = np.append(point.tangent[:-1] / u_ref, point.tangent[-1] / t_ref)
        for turn in range(1, self.lengths.turns + 1):
            R, J, Rt = self.system.at(u, t)
            if np.linalg.norm(R) <= self.lengths.tolerance * self._scale(u, t):
                close = True
            bordered = np.block([[J, Rt[:, None]], [row[None, :]]])
            try:
                change = np.linalg.solve(bordered, -np.append(R, 0.0))
            except np.linalg.LinAlgError:
                return None
            u, t = u + change[:-1], t + float(change[-1])
            if close:  # the last correction is made too: it is there
                far = np.linalg.norm(self._scaled(u - start_u, t - start_t))
                if far > (FAR if ds > self.lengths.least else CORNER) * ds:
                    return None  # another branch
                return self._point(u, t, point.tangent, 1.0, turn)
            if not (np.isfinite(u).all() and np.isfinite(t)):
                return None
        return None

    def follow(
        self, start: Point, most: int, inside: Callable[[float], bool],
        seen: Callable[[Point, Point, float], bool] | None = None, land: bool = False,
    ) -> Branch:  # fmt: skip
        """Steps from a point while `inside(t)`, `most` of them at most.

        Parameters
        ----------
        land : bool
            A step around a limit point in t ends just beyond it.
        seen : callable, optional
            Called with each pair of neighbours and the length between them; False ends the branch.
        """
        lengths = self.lengths
        branch, ds = Branch([start]), lengths.start
        while len(branch.points) <= most:
            point = branch.points[-1]
            found = self.step(point, ds)
            bent = found is None or _angle(point.tangent, found.tangent) > lengths.bend
            if bent and (found is None or ds > lengths.least):
                if ds <= lengths.least:
                    branch.ended = "no solution"
                    break
                ds = max(0.5 * ds, lengths.least)
                continue
            assert found is not None
            if land and found.tangent[-1] * point.tangent[-1] < 0.0:
                found = self._landed(point, ds, found)
            branch.points.append(found)
            if seen is not None and not seen(point, found, ds):
                branch.ended = "asked"
                break
            if not inside(found.t):
                branch.ended = "bounds"
                break
            ease = np.clip(lengths.ideal / max(found.turns, 1), 0.5, 2.0)
            ds = float(np.clip(ds * ease, lengths.least, lengths.most))
        else:
            branch.ended = "steps"
        return branch

    def _landed(self, point: Point, ds: float, found: Point) -> Point:
        way = float(np.sign(found.tangent[-1]))
        nearer = self.located(point, ds, lambda p: bool(p.tangent[-1] * way > 0.0), 1e-6)
        if nearer is None:
            return found
        over = BEYOND
        while over > 1e-3 * BEYOND:
            beyond = self.step(point, nearer[0] + over)
            if beyond is not None and (beyond.t - point.t) * way < 0.0:
                return beyond
            over *= 0.5
        return nearer[1]

    def located(
        self, point: Point, ds: float, beyond: Callable[[Point], bool], share: float = 1e-9
    ) -> tuple[float, Point] | None:
        """The first solution `beyond` something within ds of a point, by bisection.

        Returns
        -------
        length and the solution just beyond, at most `share` of ds too far
        """
        low, high, found = 0.0, ds, None
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            trial = self.step(point, middle)
            if trial is None:
                return None if found is None else (high, found)
            if beyond(trial):
                high, found = middle, trial
            else:
                low = middle
            if high - low <= share * ds:
                break
        return None if found is None else (high, found)


def _across(scaled: FloatArray, towards: FloatArray) -> FloatArray:
    """Unit tangent: what the rows of `scaled` (n, n + 1) leave, with a share along `towards`."""
    right = np.zeros(len(towards))
    right[-1] = 1.0
    try:
        tangent = np.linalg.solve(np.vstack([scaled, towards]), right)
    except np.linalg.LinAlgError:
        tangent = np.linalg.svd(scaled)[2][-1]
    return np.asarray(tangent / np.linalg.norm(tangent))


def _angle(a: FloatArray, b: FloatArray) -> float:
    return float(np.arccos(np.clip(a @ b, -1.0, 1.0)))
