"""Macro-elements of footings that lift off: a whole no-tension Winkler bed at one point, compiled.

Jumps are the rotations and the opening v of the footing's centre, forces the moments and the
vertical force. With A, S, Q the area, first and second moments of the part in contact,

    F = k (v A + theta S) ,  M = k (v S + theta Q) ,  tangent k [[A, S], [S, Q]]

in closed form: a strip or rectangle, a disc, two springs. Nonlinear elastic, no memory. In 2D the
point at s along the base opens by `v + theta s`; in 3D by `v + theta_1 s_2 - theta_2 s_1`.

The base of a macro-element as a plane that opens: where it presses, how far its edges move.

A point at s opens by `v + theta s` in the plane, by `v + theta_1 s_2 - theta_2 s_1` in space.
"""

import math
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.copies import clear, copy_state
from ssilang.kernel.interface.laws.columns import LawCode
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.elastic_law import elastic_energy
from ssilang.kernel.interface.laws.law import Law, columns_of, refuse
from ssilang.kernel.interface.laws.places import pressed_at_places

HARD_AREA = 0.1
"""Share of the area of each place under a footing that its hard spots take (PDUR)."""


@compiled
def _segment(start: float, end: float) -> tuple[float, float, float]:
    """Length, first and second moments of an interval."""
    return end - start, 0.5 * (end**2 - start**2), (end**3 - start**3) / 3.0


@compiled
def strip_contact(v: float, theta: float, width: float) -> tuple[float, float, float]:
    """Contact of a unit-length strip: opening v + theta s < 0, |s| <= width/2."""
    half = 0.5 * width
    if v + abs(theta) * half <= 0.0:
        return _segment(-half, half)
    if v - abs(theta) * half >= 0.0:
        return 0.0, 0.0, 0.0
    lift = -v / theta
    return _segment(-half, lift) if theta > 0.0 else _segment(lift, half)


@compiled
def disc_contact(v: float, theta: float, r: float) -> tuple[float, float, float]:
    """Contact of a disc that turns by theta > 0, s along the side that lifts."""
    if v + theta * r <= 0.0:
        return math.pi * r**2, 0.0, 0.25 * math.pi * r**4
    if v - theta * r >= 0.0:
        return 0.0, 0.0, 0.0
    c = v / (theta * r)
    phi, s = math.acos(c), math.sqrt(max(1.0 - c * c, 0.0))
    area = phi - s * c
    return r**2 * area, -2.0 / 3.0 * r**3 * s**3, 0.25 * r**4 * (area + 2.0 * s**3 * c)


@compiled
def springs_contact(v: float, theta: float, width: float) -> tuple[float, float, float]:
    """Contact of two unit springs at +-width/2."""
    half = 0.5 * width
    count, first, second = 0.0, 0.0, 0.0
    for side in (-half, half):
        if v + theta * side < 0.0:
            count += 1.0
            first += side
            second += side * side
    return count, first, second


N_MOMENTS = 6
AREA, S1, S2, I11, I12, I22 = range(N_MOMENTS)  # of a part in contact: area, first, second moments


@compiled
def rectangle_contact(
    v: float, a1: float, a2: float, width: float, length: float, out: FloatArray
) -> None:
    """Contact of a rectangle, opening v + a1 s1 + a2 s2 < 0: A, S1, S2, I11, I12, I22 in out.

    The rectangle is cut by the line of zero opening; moments by triangles from the origin.
    """
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    points = np.zeros((8, 2))
    n = 0
    for i in range(4):
        x1, y1 = 0.5 * width * corners[i, 0], 0.5 * length * corners[i, 1]
        j = (i + 1) % 4
        x2, y2 = 0.5 * width * corners[j, 0], 0.5 * length * corners[j, 1]
        g1, g2 = v + a1 * x1 + a2 * y1, v + a1 * x2 + a2 * y2
        if g1 < 0.0:
            points[n, 0], points[n, 1] = x1, y1
            n += 1
        if (g1 < 0.0) != (g2 < 0.0):
            at = g1 / (g1 - g2)
            points[n, 0], points[n, 1] = x1 + at * (x2 - x1), y1 + at * (y2 - y1)
            n += 1
    for i in range(N_MOMENTS):
        out[i] = 0.0
    for i in range(n):
        j = (i + 1) % n
        x1, y1, x2, y2 = points[i, 0], points[i, 1], points[j, 0], points[j, 1]
        cross = x1 * y2 - x2 * y1
        out[AREA] += cross / 2.0
        out[S1] += cross * (x1 + x2) / 6.0
        out[S2] += cross * (y1 + y2) / 6.0
        out[I11] += cross * (x1 * x1 + x1 * x2 + x2 * x2) / 12.0
        out[I12] += cross * (2 * x1 * y1 + x1 * y2 + x2 * y1 + 2 * x2 * y2) / 24.0
        out[I22] += cross * (y1 * y1 + y1 * y2 + y2 * y2) / 12.0


@seldom
@compiled
def macro_point(
    code: int,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """Moments and force t, tangent D, written in place."""
    copy_state(state, new)
    _elastic(code, w, p, t, D)
    if p[Par.COHE] > 0.0:
        _over_places(code, w, p, t, D)


@compiled
def _elastic(code: int, w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    """The bed in closed form."""
    if w.shape[0] == 2:
        _plane(code, w, p, t, D)
    elif code == LawCode.DISC:
        _disc(w, p, t, D)
    else:
        _rectangle(w, p, t, D)


FAR = 8.0
"""Rotation times k B over the pressure that the ground bears, from which places alone count."""


@compiled
def _share(w: FloatArray, p: FloatArray) -> tuple[float, float]:
    """Share of what the closed form has over the places, and the square of a rotation."""
    width = 2.0 * p[Par.RAYO] if p[Par.RAYO] > 0.0 else p[Par.LARG]
    area = math.pi * p[Par.RAYO] ** 2
    if p[Par.RAYO] == 0.0:
        area = p[Par.LARG] * (p[Par.LONG] if p[Par.LONG] > 0.0 else 1.0)
    far = (FAR * p[Par.QULT] * area / (p[Par.KN] * width)) ** 2
    turned = 0.0
    for i in range(w.shape[0] - 1):
        turned += w[i] * w[i]
    return far / (far + turned), far


@seldom
@compiled
def _over_places(code: int, w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    """The closed form over ground that yields at places (`bed_law`), which take off theirs.

    Closed form and places differ where the edge of contact lies between two of these, by a force
    E that grows with the rotation. The ground bears no such force: its energy 1/2 w.E enters with
    the share 1/(1 + (theta/theta_1)^2), 1 while the ground is elastic. In place.
    """
    d = w.shape[0]
    at, Da, fade = np.zeros(d), np.zeros((d, d)), np.zeros(d)
    pressed_at_places(code, w, p, at, Da)
    share, far = _share(w, p)
    energy = 0.0
    for i in range(d):
        t[i] -= at[i]
        energy += 0.5 * w[i] * t[i]
    for i in range(d - 1):
        fade[i] = -2.0 * w[i] * share * share / far
    for i in range(d):
        for j in range(d):
            more = t[i] * fade[j] + fade[i] * t[j]
            if i < d - 1 and j < d - 1:
                more += 8.0 * energy * w[i] * w[j] * share**3 / far**2
                if i == j:
                    more -= 2.0 * energy * share * share / far
            D[i, j] = Da[i, j] + share * (D[i, j] - Da[i, j]) + more
    for i in range(d):
        t[i] = at[i] + share * t[i] + energy * fade[i]


@seldom
@compiled
def macro_energy(
    code: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray
) -> float:
    """Stored energy of a macro-element, without what its ground takes."""
    half: float = elastic_energy(code, w, t, state, p)
    return half if p[Par.COHE] == 0.0 else _energy_over_places(code, w, p, half)


@seldom
@compiled
def _energy_over_places(code: int, w: FloatArray, p: FloatArray, half: float) -> float:
    """`macro_energy` over ground that yields, of `half = w.t/2`.

    It is `E_at + share (E - E_at)`, E_at that of the places and E that of the closed form. By
    `_over_places`, `w.t/2 = E_at + share^2 (E - E_at)`, so that E alone is needed.
    """
    d = w.shape[0]
    exact, D = np.zeros(d), np.zeros((d, d))
    _elastic(code, w, p, exact, D)
    share, _ = _share(w, p)
    stored = half
    for i in range(d):
        stored += 0.5 * share * w[i] * exact[i]
    return stored / (1.0 + share)


@compiled
def _plane(code: int, w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    theta, v = w[0], w[1]
    if code == LawCode.DISC:
        k = p[Par.KN] / (math.pi * p[Par.RAYO] ** 2)
        A, S, Q = disc_contact(v, abs(theta), p[Par.RAYO])
        if theta < 0.0:
            S = -S
    elif code == LawCode.STRIP:
        k = p[Par.KN] / p[Par.LARG]
        A, S, Q = strip_contact(v, theta, p[Par.LARG])
    else:
        k = 0.5 * p[Par.KN]
        A, S, Q = springs_contact(v, theta, p[Par.LARG])
    t[0], t[1] = k * (v * S + theta * Q), k * (v * A + theta * S)
    D[0, 0], D[0, 1], D[1, 0], D[1, 1] = k * Q, k * S, k * S, k * A


@seldom
@compiled
def _disc(w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    """w = (theta_1, theta_2, v); the opening grows along a = (-theta_2, theta_1)."""
    k, v = p[Par.KN] / (math.pi * p[Par.RAYO] ** 2), w[2]
    theta = math.sqrt(w[0] ** 2 + w[1] ** 2)
    A, S, Q = disc_contact(v, theta, p[Par.RAYO])
    t[0], t[1], t[2] = 0.0, 0.0, k * (v * A + theta * S)
    clear(D)
    D[2, 2] = k * A
    if theta == 0.0:
        D[0, 0] = D[1, 1] = k * Q
        return
    moment = k * (v * S + theta * Q)
    for i in range(2):
        e_i = w[i] / theta
        t[i] = moment * e_i
        D[i, 2] = D[2, i] = k * S * e_i
        for j in range(2):
            e_j = w[j] / theta
            D[i, j] = k * Q * e_i * e_j + moment / theta * ((1.0 if i == j else 0.0) - e_i * e_j)


@seldom
@compiled
def _rectangle(w: FloatArray, p: FloatArray, t: FloatArray, D: FloatArray) -> None:
    """w = (theta_1, theta_2, v); the opening is v + theta_1 s_2 - theta_2 s_1."""
    k = p[Par.KN] / (p[Par.LARG] * p[Par.LONG])
    m = np.zeros(N_MOMENTS)
    rectangle_contact(w[2], -w[1], w[0], p[Par.LARG], p[Par.LONG], m)
    D[0, 0], D[1, 1], D[2, 2] = k * m[I22], k * m[I11], k * m[AREA]
    D[0, 1] = D[1, 0] = -k * m[I12]
    D[0, 2] = D[2, 0] = k * m[S2]
    D[1, 2] = D[2, 1] = -k * m[S1]
    for i in range(3):
        t[i] = D[i, 0] * w[0] + D[i, 1] * w[1] + D[i, 2] * w[2]


FLAT = 1e-6
"""Slope across a rectangle, over that along it, below which it opens as a strip does."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Base of a macro-element."""

    code: LawCode
    halves: FloatArray  # (d - 1,) half of its widths, along t1 and t2; its radius, of a disc
    area: float  # of the whole length (1 m without LONG) in the plane; 1 of two springs
    stiffness: float  # per unit area (Pa/m); of each of two springs (N/m)

    def levers(self) -> FloatArray:
        """Levers (d - 1, 2) of the edges about the axes, the lowest and the highest."""
        across = self.halves if len(self.halves) == 1 else self.halves[::-1]
        return across[:, None] * np.array([-1.0, 1.0])

    def reach(self, w: FloatArray) -> FloatArray:
        """What turning adds (...) to the opening of the edge that opens most, from w (..., d)."""
        turns = np.abs(w[..., :-1])
        if self.code == LawCode.DISC:
            found: FloatArray = self.halves[0] * np.linalg.norm(turns, axis=-1)
        else:
            found = turns @ self.levers()[:, 1]
        return found

    def opening(self, w: FloatArray) -> FloatArray:
        """Largest opening (...), 0 where nothing is open."""
        return np.maximum(w[..., -1] + self.reach(w), 0.0)

    def pressure(self, w: FloatArray) -> FloatArray:
        """Largest pressure (...) of the elastic bed; force of a spring."""
        return self.stiffness * np.maximum(self.reach(w) - w[..., -1], 0.0)

    def share(self, w: FloatArray) -> FloatArray:
        """Share (...) of the area that presses on the elastic bed."""
        reach, v = self.reach(w), w[..., -1]
        turned = np.where(reach > 0.0, reach, 1.0)
        found: FloatArray
        if self.code == LawCode.DISC:
            x = np.clip(v / turned, -1.0, 1.0)
            found = (np.arccos(x) - x * np.sqrt(1.0 - x * x)) / np.pi
        elif self.code == LawCode.SPRINGS:
            found = 0.5 * ((v < reach).astype(float) + (v < -reach))
        else:
            found = _of_rectangle(np.abs(w[..., :-1]) * self.levers()[:, 1], v)
        return np.where(v + reach <= 0.0, 1.0, np.where(v - reach >= 0.0, 0.0, found))


def _of_rectangle(slopes: FloatArray, v: FloatArray) -> FloatArray:
    """Share (...) of the square [-1, 1]^2 where v + a x + b y < 0, slopes (..., 1 or 2) a, b >= 0.

    Second differences of half the square of what is positive; of what is positive for a strip.
    """
    large, small = slopes.max(axis=-1), slopes.min(axis=-1)
    if slopes.shape[-1] == 1:
        small = np.zeros_like(large)
    a, flat = np.where(large > 0.0, large, 1.0), small <= FLAT * large
    b = np.where(flat, a, small)
    ends = ((a + b - v, 1.0), (a - b - v, -1.0), (b - a - v, -1.0), (-a - b - v, 1.0))
    cut = sum(sign * np.maximum(x, 0.0) ** 2 for x, sign in ends) / (8.0 * a * b)
    return np.clip(np.where(flat, (a - v) / (2.0 * a), cut), 0.0, 1.0)


def outline_of(code: LawCode, p: FloatArray, dimension: int) -> Outline:
    """The outline of a macro-element from its parameters (N_PARAMETERS,)."""
    width, length = p[Par.LARG], p[Par.LONG]
    if code == LawCode.DISC:
        radius = p[Par.RAYO]
        halves, area = np.full(dimension - 1, radius), float(np.pi * radius**2)
    elif code == LawCode.SPRINGS:
        return Outline(code, np.array([0.5 * width]), 1.0, float(0.5 * p[Par.KN]))
    else:
        halves = 0.5 * np.array([width, length][: dimension - 1])
        area = float(width * (length if length > 0.0 else 1.0))
    return Outline(code, halves, area, float(p[Par.KN] / area))


def _check(parameters: FloatArray) -> None:
    """Refuse a macro-element without stiffness or size."""
    columns = columns_of(parameters)
    refuse(columns["KN"] <= 0, columns["KN"], "KN", "> 0")
    for name in ("LARG", "LONG", "RAYO"):
        refuse(columns[name] < 0, columns[name], name, "> 0")
    for name in ("COHE", "QULT"):
        refuse(columns[name] < 0, columns[name], name, ">= 0")
    spots = columns["PDUR"]
    even = (spots == 0) | ((spots > HARD_AREA) & (spots < 1))
    refuse(~even, spots, "PDUR", f"0, {HARD_AREA} < ... < 1")
    strong = columns["COHE"] == 0.0
    for name, idle in (("QULT", 0.0), ("FROT", -1.0), ("PDUR", 0.0)):
        if (strong & (columns[name] > idle)).any():
            raise MaterialError("kernel.interface.macro-needs-cohe", name=name)


def _rocking_rectangle(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    k, width, length = p[:, Par.KN], p[:, Par.LARG], p[:, Par.LONG]
    about_2 = k * width**2 / 12
    return np.where(length > 0, k * length**2 / 12, about_2), about_2


def _rocking_disc(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    both = p[:, Par.KN] * p[:, Par.RAYO] ** 2 / 4
    return both, both


def _rocking_springs(p: FloatArray) -> tuple[FloatArray, FloatArray]:
    both = p[:, Par.KN] * p[:, Par.LARG] ** 2 / 4
    return both, both


LAWS = {
    "MACRO_SEMELLE": Law(
        LawCode.STRIP,
        macro_point,
        macro_energy,
        ("KN", "KS", "LARG"),
        ("LONG", "COHE", "QULT", "FROT", "PDUR"),
        _check,
        rocking=_rocking_rectangle,
        in_space=("LONG",),
    ),
    "MACRO_DISQUE": Law(
        LawCode.DISC,
        macro_point,
        macro_energy,
        ("KN", "KS", "RAYO"),
        ("COHE", "QULT", "FROT", "PDUR"),
        _check,
        rocking=_rocking_disc,
    ),
    "MACRO_RESSORTS": Law(
        LawCode.SPRINGS,
        macro_point,
        macro_energy,
        ("KN", "KS", "LARG"),
        (),
        _check,
        rocking=_rocking_springs,
        in_space=None,
    ),
}
