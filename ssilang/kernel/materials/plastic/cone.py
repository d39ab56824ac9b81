"""Laws on a cone of revolution `alpha tr(s) + beta q = K(p)`, flow along `gamma tr(s) + delta q`.

q is von Mises' equivalent stress, p the cumulated equivalent plastic strain
`sqrt(2/3 ep : ep)`. Von Mises' cylinder is alpha = gamma = 0. The flow direction does not turn
during the return, so that one scalar equation is left; where the deviator would turn over, the
return goes to the apex. (Simo and Hughes 1998; de Souza Neto, Peric and Owen 2008, chapter 8.)

A law gives its numbers at all points as columns (`cone_laws`), points with equal ones share a row;
the return at a point is compiled.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.compiled.compiler import compiled, compiled_fused, compiled_inline
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.materials.plastic.response import PointParameters, Response, mises

TURNS = 60
YIELDS = 1e-14  # share of the stresses at play by which the surface must be passed


class ConeColumn(IntEnum):
    """Columns of a row.

    `alpha tr(s) + beta q <= K(p)`, flow along `gamma tr(s) + delta q`; KINEMATIC moves the centre.
    K(p) is `FIRST + SLOPE p + RISE (1 - exp(-RATE p))`, LAST where it has come there (SINKS: from
    above), or the curve number CURVE (none: -1).
    """

    SHEAR = 0
    BULK = 1
    ALPHA = 2
    BETA = 3
    GAMMA = 4
    DELTA = 5
    KINEMATIC = 6
    FIRST = 7
    SLOPE = 8
    RISE = 9
    RATE = 10
    LAST = 11
    SINKS = 12
    CURVE = 13


N_COLUMNS = len(ConeColumn)
_CYLINDER = {ConeColumn.BETA: 1.0, ConeColumn.DELTA: 1.0, ConeColumn.LAST: np.inf}
_CYLINDER |= {ConeColumn.CURVE: -1.0}


class ConeRows(NamedTuple):
    """Rows (n_rows, N_COLUMNS), the row of each point (m,), and all curves one behind the other.

    `start` (n_curves + 1,) says where each begins in x, y.
    """

    rows: FloatArray
    of: IntArray
    start: IntArray
    x: FloatArray
    y: FloatArray


@dataclass(frozen=True)
class Cone:
    """A law on a cone; variables EPSE (p) and the centre XX YY ZZ XY XZ YZ of a cone that moves.

    Attributes
    ----------
    columns : callable
        Numbers (m,) at m points by the names of `ConeColumn`; what is not given is a perfect
        cylinder's.
    curve : str
        The parameter that is the curve K(p), none: ''.
    """

    columns: Callable[[PointParameters], dict[str, FloatArray]]
    curve: str = ""

    def rows(self, parameters: PointParameters) -> ConeRows:
        """The law at the points."""
        table = np.zeros((len(parameters["YOUN"]), N_COLUMNS))
        for column, value in _CYLINDER.items():
            table[:, column] = value
        table[:, ConeColumn.SHEAR], table[:, ConeColumn.BULK] = parameters.shear, parameters.bulk
        for name, values in self.columns(parameters).items():
            table[:, ConeColumn[name]] = values
        curves: list[Curve] = []
        if self.curve:
            curves, table[:, ConeColumn.CURVE] = parameters.curves[self.curve]
        # the rows that differ; most tables have few, in long runs
        begins = np.flatnonzero(np.concatenate([[True], (table[1:] != table[:-1]).any(axis=1)]))
        rows, of = np.unique(table[begins], axis=0, return_inverse=True)
        lengths = np.diff(np.concatenate([begins, [len(table)]]))
        rows, of = np.ascontiguousarray(rows), np.repeat(of.ravel().astype(np.int64), lengths)
        x = [np.asarray(c.parts[0].abscissas, float) for c in curves]
        y = [np.asarray(c.parts[0].ordinates, float) for c in curves]
        start = np.concatenate([[0], np.cumsum([len(v) for v in x])]).astype(np.int64)
        none = [np.zeros(0)]
        return ConeRows(rows, of, start, np.concatenate(x or none), np.concatenate(y or none))

    def strength(self, parameters: PointParameters, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """K (m,) and its slope for cumulated strains p (m,)."""
        found = np.empty((2, len(p)))
        _strengths(parameters.once(self.rows), np.ascontiguousarray(p), found)
        return found[0], found[1]

    def excess(
        self, parameters: PointParameters, stress: FloatArray, variables: FloatArray
    ) -> FloatArray:
        """`alpha tr(s) + beta q - K` (m,) of stresses from the cone's centre, < 0 inside."""
        rows = parameters.once(self.rows)
        own, centre = rows.rows[rows.of], variables[:, 1:7] if variables.shape[1] > 1 else 0.0
        q, pull = mises(stress - centre)[0], stress[:, :3].sum(axis=1)
        strength = self.strength(parameters, variables[:, 0])[0]
        return np.asarray(own[:, ConeColumn.ALPHA] * pull + own[:, ConeColumn.BETA] * q - strength)

    def __call__(
        self,
        parameters: PointParameters,
        stress: FloatArray,
        strain: FloatArray,
        variables: FloatArray,
    ) -> Response:
        after, inner = stress.copy(), variables.copy()
        tangent, room = np.empty((len(stress), 6, 6)), np.empty((3, 6))
        rows = parameters.once(self.rows)
        _return(rows, np.ascontiguousarray(strain), after, inner, np.arange(6), tangent, room)
        return Response(after, inner, tangent)


@compiled
def _on_curve(cone: ConeRows, which: int, p: float) -> tuple[float, float]:
    """Ordinate and slope, constant beyond the ends."""
    a, b = cone.start[which], cone.start[which + 1] - 1
    if p < cone.x[a]:
        return cone.y[a], 0.0
    if p >= cone.x[b]:
        return cone.y[b], 0.0
    while b - a > 1:
        middle = (a + b) // 2
        if p >= cone.x[middle]:
            a = middle
        else:
            b = middle
    slope = (cone.y[b] - cone.y[a]) / max(cone.x[b] - cone.x[a], 1e-300)
    return cone.y[a] + slope * (p - cone.x[a]), slope


@compiled
def strength_at(cone: ConeRows, row: int, p: float) -> tuple[float, float]:
    """Strength K and its slope for a cumulated strain p."""
    c = cone.rows[row]
    if c[ConeColumn.CURVE] >= 0.0:
        return _on_curve(cone, int(c[ConeColumn.CURVE]), p)
    value, slope = c[ConeColumn.FIRST] + c[ConeColumn.SLOPE] * p, c[ConeColumn.SLOPE]
    if c[ConeColumn.RISE] != 0.0:
        left = math.exp(-c[ConeColumn.RATE] * p)
        value += c[ConeColumn.RISE] * (1.0 - left)
        slope += c[ConeColumn.RISE] * c[ConeColumn.RATE] * left
    last = c[ConeColumn.LAST]
    if (value <= last) if c[ConeColumn.SINKS] != 0.0 else (value >= last):
        return last, 0.0
    return value, slope


@compiled
def _strengths(cone: ConeRows, p: FloatArray, found: FloatArray) -> None:
    """`strength_at` all points, into `found` (2, m)."""
    for m in range(len(p)):
        found[0, m], found[1, m] = strength_at(cone, cone.of[m], p[m])


@compiled
def _multiplier(cone: ConeRows, row: int, trace: float, q: float, p: float, growth: float) -> float:
    """Plastic multiplier by Newton's method on a function without kinks but the curve's own."""
    c, x = cone.rows[row], 0.0
    elastic = c[ConeColumn.BETA] * c[ConeColumn.DELTA]
    elastic *= 3.0 * c[ConeColumn.SHEAR] + c[ConeColumn.KINEMATIC]
    elastic += 9.0 * c[ConeColumn.BULK] * c[ConeColumn.ALPHA] * c[ConeColumn.GAMMA]
    rounding = 4e-16 * (abs(c[ConeColumn.ALPHA] * trace) + c[ConeColumn.BETA] * q) / elastic
    for _ in range(TURNS):
        K, slope = strength_at(cone, row, p + growth * x)
        f = c[ConeColumn.ALPHA] * trace + c[ConeColumn.BETA] * q - elastic * x - K
        step = f / max(elastic + slope * growth, 1e-9 * elastic)
        x = max(x + step, 0.0)
        if abs(step) <= 1e-15 * abs(x) + rounding:
            break
    return x


@compiled
def _apex(
    cone: ConeRows, row: int, trial: float, q: float, p: float
) -> tuple[float, float, float, float]:
    """Trace of the stress, cumulated strain, its rate by volume, lost shear, at the tip."""
    c = cone.rows[row]
    shear, trace, grown, rate = q / (3.0 * c[ConeColumn.SHEAR]), trial, p, 0.0
    for _ in range(TURNS):
        volume = (trial - trace) / (3.0 * c[ConeColumn.BULK])
        dp = math.sqrt(2.0 / 9.0 * volume**2 + shear**2)
        grown = p + dp
        K, slope = strength_at(cone, row, grown)
        rate = (2.0 / 9.0) * volume / max(dp, 1e-300)
        stiff = c[ConeColumn.ALPHA] + slope * rate / (3.0 * c[ConeColumn.BULK])
        step = (K - c[ConeColumn.ALPHA] * trace) / stiff
        trace += step
        if abs(step) <= 1e-14 * (abs(trace) + abs(trial)):
            break
    return trace, grown, rate, shear


@compiled_inline
def cone_point(
    cone: ConeRows, row: int, s: FloatArray, p: float, N: FloatArray, t: FloatArray, tangent: bool
) -> float:
    """Return a trial stress s (6,) to the cone, in place; the cumulated strain.

    Where it flows N (6,) is 3/2 of the deviator over q. With `tangent`, t (5,) are the factors of
    `1 x 1`, of the deviatoric part, of `N x N`, `1 x N`, `N x 1` in the tangent.
    """
    c = cone.rows[row]
    G, B = c[ConeColumn.SHEAR], c[ConeColumn.BULK]
    alpha, beta = c[ConeColumn.ALPHA], c[ConeColumn.BETA]
    trace = s[0] + s[1] + s[2]
    mean, square = trace / 3.0, 0.0
    for i in range(6):
        N[i] = s[i] - mean if i < 3 else s[i]
        square += N[i] * N[i] if i < 3 else 2.0 * N[i] * N[i]
    q = math.sqrt(1.5 * square)
    if tangent:
        t[0], t[1], t[2], t[3], t[4] = B, 2.0 * G, 0.0, 0.0, 0.0
    K = strength_at(cone, row, p)[0]
    size = abs(K) + beta * q + abs(alpha * trace)
    if alpha * trace + beta * q - K <= YIELDS * size:
        return p
    gamma, delta = c[ConeColumn.GAMMA], c[ConeColumn.DELTA]
    growth = math.sqrt(delta**2 + 2.0 * gamma**2)
    x = _multiplier(cone, row, trace, q, p, growth)
    for i in range(6):
        N[i] *= 1.5 / max(q, 1e-300)
    if q < 3.0 * G * delta * x and alpha > 0.0:
        end, grown, rate, shear = _apex(cone, row, trace, q, p)
        for i in range(6):
            s[i] = end / 3.0 if i < 3 else 0.0
        if tangent:
            slope = strength_at(cone, row, grown)[1]
            change = slope / (alpha + slope * rate / (3.0 * B))
            t[0], t[1] = change * rate / 3.0, 0.0
            t[3] = change * (2.0 / 9.0) * shear / max(grown - p, 1e-300)
        return grown
    for i in range(6):
        s[i] -= x * (2.0 * G * delta * N[i] + (3.0 * B * gamma if i < 3 else 0.0))
    if tangent:
        slope = strength_at(cone, row, p + growth * x)[1]
        stiff = beta * delta * (3.0 * G + c[ConeColumn.KINEMATIC]) + 9.0 * B * alpha * gamma
        stiff += slope * growth
        turn = 6.0 * G**2 * delta * x / max(q, 1e-300)
        t[0] = B - 9.0 * B**2 * alpha * gamma / stiff
        t[1] = 2.0 * G - turn
        t[2] = (2.0 / 3.0) * turn - 4.0 * G**2 * beta * delta / stiff
        t[3] = -6.0 * B * gamma * G * beta / stiff
        t[4] = -6.0 * G * delta * B * alpha / stiff
    return p + growth * x


@compiled_fused
def cone_tangent(N: FloatArray, t: FloatArray, components: IntArray, D: FloatArray) -> None:
    """Tangent (n_strains, n_strains) from its factors (`cone_point`)."""
    for a in range(len(components)):
        i = components[a]
        for b in range(len(components)):
            j = components[b]
            value = t[2] * N[i] * N[j]
            if i < 3:
                value += t[3] * N[j]
            if j < 3:
                value += t[4] * N[i]
            if i < 3 and j < 3:
                value += t[0] - t[1] / 3.0
            if i == j:
                value += t[1] if i < 3 else 0.5 * t[1]
            D[a, b] = value


@compiled_fused
def _return(
    cone: ConeRows,
    strain: FloatArray,
    stress: FloatArray,
    variables: FloatArray,
    components: IntArray,
    tangent: FloatArray,
    room: FloatArray,
) -> None:
    """A step of strain (m, 6): stress (m, 6) and variables (m, 1 or 7) are brought up to date.

    `tangent` (m, 6, 6) of all six `components` is filled; `room` is (3, 6).
    """
    s, N, t, moves = room[0], room[1], room[2], variables.shape[1] > 1
    for m in range(len(strain)):
        c, old = cone.rows[cone.of[m]], variables[m]
        G, p = c[ConeColumn.SHEAR], old[0]
        volume = strain[m, 0] + strain[m, 1] + strain[m, 2]
        mean = (c[ConeColumn.BULK] - 2.0 / 3.0 * G) * volume
        for i in range(6):
            s[i] = stress[m, i] + G * strain[m, i]
            s[i] += mean + G * strain[m, i] if i < 3 else 0.0
            s[i] -= old[1 + i] if moves else 0.0
        old[0] = cone_point(cone, cone.of[m], s, p, N, t, True)
        cone_tangent(N, t, components, tangent[m])
        H = c[ConeColumn.KINEMATIC] * (old[0] - p) / 1.5
        for i in range(6):
            stress[m, i] = s[i]
            if moves:
                stress[m, i] += old[1 + i]
                old[1 + i] += H * N[i]
