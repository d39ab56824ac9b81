"""Ground below a footing that yields: what it takes from the elastic bed, at one place, compiled.

A macro-element (`macro_law`) is a no-tension elastic bed in closed form. Where its ground has a
strength, places under the base carry the difference between a bed that yields and the elastic one,

    t = t_yielding(w) - t_elastic(w) ,   t_elastic = (ks w_t, kn min(w_n, 0))

so that a bed that never yields is the macro-element itself, to rounding. A place presses with
`p = max(0, -kn (w_n - settlement))` and drags with `T = ks |w_t - slip|`, and stays within

    T <= c ,   p <= q G(T/c) ,   G(x) = (1 + pi/2 + acos x + sqrt(1 - x^2)) / (2 + pi)

which is the exact capacity of a strip under an inclined central load on clay (Green 1954, *The
plastic yielding of metal junctions due to combined shear and pressure*) with q = (2 + pi) c. Flow
is associated; each increment is a closest-point projection, unique whatever its size. With
FROT >= 0 also `T <= FROT p`, along which slip is without settlement.

Beds of springs that yield and lift off: Allotey and El Naggar 2003, *Analytical moment-rotation
curves for rigid foundations based on a Winkler model*; Gajan and others, PEER 2007/04.
"""

import math

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.apart import seldom
from ssilang.kernel.base.compiled.compiler import compiled, compiled_inline
from ssilang.kernel.interface.laws.columns import Parameter as Par
from ssilang.kernel.interface.laws.columns import Variable as Var

TURNS = 60  # of the projection: halvings alone end below rounding
SAME = 1e-15  # of a right angle


@compiled
def _bearing(x: float, q: float) -> float:
    """Pressure that the ground bears under the drag x c."""
    bound: float = 1.0 + 0.5 * math.pi + math.acos(x) + math.sqrt(1.0 - x * x)
    return q * bound / (2.0 + math.pi)


@compiled
def corner_pressure(q: float, c: float, friction: float) -> float:
    """Pressure on the capacity curve where the drag is `friction` times it."""
    low, high = 0.0, q
    for _ in range(TURNS):
        p = 0.5 * (low + high)
        if p < _bearing(min(friction * p / c, 1.0), q):
            low = p
        else:
            high = p
    return 0.5 * (low + high)


@compiled
def _on_curve(
    p_try: float, T_try: float, kn: float, ks: float, q: float, c: float
) -> tuple[float, float, float, float, float, float]:
    """p, T and (dp/dp_try, dp/dT_try, dT/dp_try, dT/dT_try) of the nearest point of the curve.

    The curve is `T = c cos(phi)`, `p = q (1 + pi/2 + phi + sin phi)/(2 + pi)`, its normal
    `(sin(phi/2), nu cos(phi/2))` with `nu = q/((2 + pi) c)`.
    """
    nu = q / ((2.0 + math.pi) * c)
    if T_try * kn <= (p_try - q) * ks * nu:  # the corner: pressed straight down
        return q, 0.0, 0.0, 0.0, 0.0, 0.0
    low, high = 0.0, 0.5 * math.pi
    phi = high
    slope = -1.0
    for _ in range(TURNS):
        half_s, half_c = math.sin(0.5 * phi), math.cos(0.5 * phi)
        p = q * (1.0 + 0.5 * math.pi + phi + math.sin(phi)) / (2.0 + math.pi)
        T = c * math.cos(phi)
        r = (p_try - p) * ks * nu * half_c - (T_try - T) * kn * half_s
        slope = (
            -q * (1.0 + math.cos(phi)) / (2.0 + math.pi) * ks * nu * half_c
            - 0.5 * (p_try - p) * ks * nu * half_s
            - c * math.sin(phi) * kn * half_s
            - 0.5 * (T_try - T) * kn * half_c
        )
        if r > 0.0:
            low = phi
        else:
            high = phi
        step = -r / slope if slope < 0.0 else high - low
        after = phi + step
        if not (low < after < high):
            after = 0.5 * (low + high)
        if abs(after - phi) <= SAME:
            break
        phi = after
    half_s, half_c = math.sin(0.5 * phi), math.cos(0.5 * phi)
    along, down = q * (1.0 + math.cos(phi)) / (2.0 + math.pi), -c * math.sin(phi)
    by_p, by_T = -ks * nu * half_c / slope, kn * half_s / slope
    p = q * (1.0 + 0.5 * math.pi + phi + math.sin(phi)) / (2.0 + math.pi)
    return p, c * math.cos(phi), along * by_p, along * by_T, down * by_p, down * by_T


@compiled
def _below_chord(p_try: float, T_try: float, c: float, q: float) -> bool:
    """Whether the tries lie within the chord of the curve, which is concave: no arc cosine."""
    return T_try <= c and 2.0 * c * (p_try - q) <= -q * T_try


@compiled
def _returned(
    p_try: float, T_try: float, kn: float, ks: float, c: float, q: float, friction: float
) -> tuple[float, float, float, float, float, float]:
    """p, T and derivatives by the tries, back within the capacity."""
    if T_try <= c and (_below_chord(p_try, T_try, c, q) or p_try <= _bearing(T_try / c, q)):
        found = (p_try, T_try, 1.0, 0.0, 0.0, 1.0)
    elif p_try <= 0.5 * q:
        found = (p_try, c, 1.0, 0.0, 0.0, 0.0)
    else:
        found = _on_curve(p_try, T_try, kn, ks, q, c)
    if friction >= 0.0 and found[1] > friction * found[0]:
        most = corner_pressure(q, c, friction)
        if p_try < most:
            return p_try, friction * p_try, 1.0, 0.0, friction, 0.0
        return most, friction * most, 0.0, 0.0, 0.0, 0.0
    return found


@compiled_inline
def _tries(
    n: int, k: int, w: FloatArray, state: FloatArray, kn: float, ks: float
) -> tuple[float, float]:
    """Pressure and drag at the place k of many if nothing yielded further; n directions of drag."""
    gap, drag = w[k, n] - state[k, Var.XI], 0.0
    for i in range(n):
        drag += (w[k, i] - state[k, Var.SLIP1 + i]) ** 2
    return (-kn * gap if gap < 0.0 else 0.0), ks * math.sqrt(drag)


@compiled_inline
def _place(
    n: int, k: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray,
    new: FloatArray, D: FloatArray,
) -> None:  # fmt: skip
    """What yielding takes from an elastic bed, and tangent, at the place k of many.

    Written out in its callers for a known n: a call hands over more than the law reads.
    """
    kn, ks, friction = p[k, Par.BED_KN], p[k, Par.BED_KS], p[k, Par.FROT]
    p_try, T_try = _tries(n, k, w, state, kn, ks)
    if not _below_chord(p_try, T_try, p[k, Par.COHE], p[k, Par.QULT]) or (
        friction >= 0.0 and friction * p_try < T_try
    ):
        _yield(k, w, state, p, t, new, D)
        return
    # differences are written out: what never yielded takes nothing, to the last bit
    closed = w[k, n] < 0.0
    for i in range(n):
        t[k, i] = -ks * state[k, Var.SLIP1 + i]
        for j in range(n + 1):
            D[k, i, j] = D[k, n, j] = 0.0
        D[k, i, n] = 0.0
    if p_try > 0.0 and closed:
        t[k, n] = -kn * state[k, Var.XI]
    else:
        t[k, n] = -p_try - (kn * w[k, n] if closed else 0.0)
    D[k, n, n] = (kn if p_try > 0.0 else 0.0) - (kn if closed else 0.0)


@compiled
def _yield(
    k: int, w: FloatArray, state: FloatArray, p: FloatArray, t: FloatArray, new: FloatArray,
    D: FloatArray,
) -> None:  # fmt: skip
    """As `_place` where the ground yields or may, and its new state."""
    n = w.shape[1] - 1
    kn, ks = p[k, Par.BED_KN], p[k, Par.BED_KS]
    p_try, T_try = _tries(n, k, w, state, kn, ks)
    press, drag, pp, pT, Tp, TT = _returned(
        p_try, T_try, kn, ks, p[k, Par.COHE], p[k, Par.QULT], p[k, Par.FROT]
    )
    ratio = drag / T_try if T_try > 0.0 else 1.0
    spent = 0.0
    if press != p_try:
        new[k, Var.XI] = w[k, n] + press / kn
        spent += press * (p_try - press) / kn
    # less the elastic bed
    touching, closed = p_try > 0.0, w[k, n] < 0.0
    t[k, n] = -press - (kn * w[k, n] if closed else 0.0)
    D[k, n, n] = (kn * pp if touching else 0.0) - (kn if closed else 0.0)
    for i in range(n):
        trial = ks * (w[k, i] - state[k, Var.SLIP1 + i])
        e_i = trial / T_try if T_try > 0.0 else 0.0
        t[k, i] = ratio * trial - ks * w[k, i]
        if drag != T_try:
            moved = (1.0 - ratio) * (w[k, i] - state[k, Var.SLIP1 + i])
            new[k, Var.SLIP1 + i] += moved
            spent += ratio * trial * moved
        for j in range(n):
            e_j = ks * (w[k, j] - state[k, Var.SLIP1 + j]) / T_try if T_try > 0.0 else 0.0
            D[k, i, j] = ks * (TT - ratio) * e_i * e_j
        D[k, i, i] += ks * ratio - ks
        D[k, n, i] = -pT * ks * e_i if touching else 0.0
        D[k, i, n] = -kn * Tp * e_i if touching else 0.0
    new[k, Var.SHEAR_LOSS] = state[k, Var.SHEAR_LOSS] + spent


@seldom
@compiled
def bed_points(
    first: int,
    w: FloatArray,
    state: FloatArray,
    p: FloatArray,
    t: FloatArray,
    new: FloatArray,
    D: FloatArray,
) -> None:
    """What yielding takes at the places from `first` on, written in place.

    All in one call, by their numbers: a view of each array for each place takes longer than the
    law. State: XI settlement (<= 0), SLIP1 SLIP2, SHEAR_LOSS energy lost.
    """
    n = w.shape[0]
    for k in range(first, n):
        for i in range(state.shape[1]):
            new[k, i] = state[k, i]
    if w.shape[1] == 2:
        for k in range(first, n):
            _place(1, k, w, state, p, t, new, D)
    else:
        for k in range(first, n):
            _place(2, k, w, state, p, t, new, D)


@compiled_inline
def _stored(n: int, k: int, w: FloatArray, t: FloatArray, p: FloatArray) -> float:
    """Energy stored beyond that of the elastic bed at the place k of many, per unit area."""
    kn, ks = p[k, Par.BED_KN], p[k, Par.BED_KS]
    closing = min(w[k, n], 0.0)
    press = -t[k, n] - kn * closing
    stored: float = 0.5 * press * press / kn - 0.5 * kn * closing * closing
    for i in range(n):
        drag = t[k, i] + ks * w[k, i]
        if ks > 0.0:
            stored += 0.5 * drag * drag / ks - 0.5 * ks * w[k, i] * w[k, i]
    return stored


@seldom
@compiled
def bed_energies(
    first: int, w: FloatArray, t: FloatArray, state: FloatArray, p: FloatArray, found: FloatArray
) -> None:
    """Energies stored beyond those of the elastic bed, and lost so far, of the places from `first`.

    Per unit area, into `found` (2, n).
    """
    if w.shape[1] == 2:
        for k in range(first, w.shape[0]):
            found[0, k] = _stored(1, k, w, t, p)
    else:
        for k in range(first, w.shape[0]):
            found[0, k] = _stored(2, k, w, t, p)
    for k in range(first, w.shape[0]):
        found[1, k] = state[k, Var.SHEAR_LOSS]
