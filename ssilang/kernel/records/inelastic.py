"""Largest responses of bilinear oscillators to ground motion, at given or wanted ductility."""

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import KernelError

LAWS = ("CINE", "ISOT", "ELAS")
"""Kinematic hardening, isotropic hardening, non-linear elastic; all bilinear when pushed once."""
STEPS_A_PERIOD = 200
"""Central differences err by (2 pi / 200)^2 / 24, four in 100 000, on the period."""
NEARNESS = 0.05
"""Share by which the ductility of the first limit may miss the wanted one (Cast3M's)."""
CLOSE = 0.002
"""The same for limits that are searched, where the response allows it."""
TRIALS = 60


def yielding_peaks(
    times: FloatArray,
    signal: FloatArray,
    frequencies: FloatArray,
    damping: float,
    law: str,
    hardening: float,
    limits: FloatArray,
) -> FloatArray:
    """Largest displacements (n,) of `x'' + 2 xi w x' + r(x) = g(t)`.

    The force r has slope w^2 up to the elastic limit, `hardening` times that beyond it. The
    response is followed for one elastic period after the signal.

    Parameters
    ----------
    times, signal : array (m,)
        Equal steps.
    limits : array (n,)
        Displacement at the elastic limit of each oscillator.

    Raises
    ------
    KernelError
        If the steps differ, or a frequency, a limit, the damping or the hardening makes no sense.
    """
    _check(times, frequencies, damping, hardening)
    if (limits <= 0.0).any():
        raise KernelError("kernel.records.elastic-limit-oscillator-must")
    dt = float(times[-1] - times[0]) / (len(times) - 1)
    return np.array(
        [
            _peak(signal, dt, float(f), damping, LAWS.index(law), hardening, float(limit))
            for f, limit in zip(frequencies, limits, strict=True)
        ]
    )


def limits_for_ductility(
    times: FloatArray,
    signal: FloatArray,
    frequencies: FloatArray,
    damping: float,
    law: str,
    hardening: float,
    ductility: float,
    first: FloatArray,
) -> FloatArray:
    """Elastic limits (n,) at which the largest displacement is `ductility` times the limit.

    Where the ratio jumps over the wanted one as the limit changes, the larger limit is given:
    its ductility is the smaller.

    Parameters
    ----------
    first : array (n,)
        Limits to start from, such as those of the linear spectrum divided by the ductility.
    """
    _check(times, frequencies, damping, hardening)
    if ductility < 1.0:
        raise KernelError("kernel.records.ductility-least", ductility=ductility)
    dt = float(times[-1] - times[0]) / (len(times) - 1)
    found = np.empty(len(frequencies))
    for k, f in enumerate(frequencies):
        oscillator = (signal, dt, float(f), damping, LAWS.index(law), hardening)
        found[k] = _limit(
            lambda limit, o=oscillator: float(_peak(*o, limit)) / limit, ductility, float(first[k])
        )
    return found


def _check(times: FloatArray, frequencies: FloatArray, damping: float, hardening: float) -> None:
    if len(times) < 2 or np.ptp(np.diff(times)) > 1e-4 * abs(float(times[1] - times[0])):
        raise KernelError("kernel.records.signal-times-must-go")
    if (frequencies <= 0.0).any():
        raise KernelError("kernel.records.frequency-oscillator-must-positive")
    if damping < 0.0:
        raise KernelError("kernel.records.damping-oscillator-cannot-negative", damping=damping)
    if not 0.0 <= hardening < 1.0:
        raise KernelError("kernel.records.hardening-ratio-lies-left", hardening=hardening)


def _limit(ductility: Callable[[float], float], wanted: float, first: float) -> float:
    """The limit of the wanted ductility: a bracket by doubling, then halving in logarithms."""
    if not first > 0.0:
        return 0.0
    low = high = first
    reached = ductility(first)
    if abs(reached / wanted - 1.0) <= NEARNESS:
        return first
    for _ in range(TRIALS):
        if reached > wanted:
            low, high = high, 2.0 * high
            reached = ductility(high)
            if reached <= wanted:
                break
        else:
            low, high = low / 2.0, low
            reached = ductility(low)
            if reached >= wanted:
                break
    for _ in range(TRIALS):
        middle = float(np.sqrt(low * high))
        reached = ductility(middle)
        if abs(reached / wanted - 1.0) <= CLOSE:
            return middle
        low, high = (middle, high) if reached > wanted else (low, middle)
    return high


@compiled
def _peak(
    signal: FloatArray,
    dt: float,
    f: float,
    damping: float,
    law: int,
    hardening: float,
    limit: float,
) -> float:
    """Largest displacement, by central differences with steps that divide the signal's."""
    w = 2.0 * np.pi * f
    parts = max(1, int(np.ceil(dt * f * STEPS_A_PERIOD)))
    h = dt / parts
    rest = int(np.ceil(1.0 / (f * dt)))
    stiffness = w * w
    ahead, behind = 1.0 + damping * w * h, 1.0 - damping * w * h
    x, before, largest = 0.0, h * h * signal[0] / 2.0, 0.0  # starts at rest
    plastic, hardened = 0.0, 0.0
    n = len(signal)
    for i in range(n - 1 + rest):
        start = signal[i] if i < n else 0.0
        end = signal[i + 1] if i + 1 < n else 0.0
        for j in range(parts):
            load = start + (end - start) * j / parts
            # force and the state of the law
            if law == 0:
                shift = x - plastic
                if abs(shift) > limit:
                    shift = limit if shift > 0.0 else -limit
                    plastic = x - shift
                force = stiffness * (hardening * x + (1.0 - hardening) * shift)
            elif law == 1:
                modulus = stiffness * hardening / (1.0 - hardening)
                force = stiffness * (x - plastic)
                over = abs(force) - stiffness * limit - modulus * hardened
                if over > 0.0:
                    flow = over / (stiffness + modulus)
                    hardened += flow
                    plastic += flow if force > 0.0 else -flow
                    force = stiffness * (x - plastic)
            else:
                size = abs(x)
                if size > limit:
                    size = limit + hardening * (size - limit)
                force = stiffness * (size if x > 0.0 else -size)
            after = (h * h * (load - force) + 2.0 * x - behind * before) / ahead
            before, x = x, after
            if abs(x) > largest:
                largest = abs(x)
    return largest
