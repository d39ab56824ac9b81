"""Floor spectra of a random earthquake by the theory of crossings (SPPLANC).

A structure of N modes stands on a ground whose acceleration is `e(t) s(t)`, a stationary signal
under an envelope; an oscillator stands on one of its floors. All of it, at rest at the start,
answers to each frequency of the signal by an evolution in closed form; what follows is that of
`ssilang.kernel.records.modulated`.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.records.modulated import answers, moments_of
from ssilang.kernel.records.power import gauss_points, largest_value

_STEPS = 60
"""Instants over the earthquake, and a third of them after it."""


@dataclass(frozen=True, eq=False)
class Storey:
    """A floor of a structure: its modes as the floor sees them.

    Attributes
    ----------
    frequencies : array (n_modes,)
        Hz.
    dampings : array (n_modes,)
        Fractions of the critical one.
    participations : array (n_modes,)
        Participation of each mode times its shape at the floor: the floor moves, in relation to
        the ground, by `sum c_n q_n` with `q_n'' + 2 x w q_n' + w^2 q_n = - ground acceleration`.
    """

    frequencies: FloatArray
    dampings: FloatArray
    participations: FloatArray

    def __post_init__(self) -> None:
        """Refuse what has no meaning."""
        if not len(self.frequencies) == len(self.dampings) == len(self.participations):
            raise FieldError("kernel.records.mode-frequency-damping-participation")
        if (self.frequencies <= 0.0).any():
            raise FieldError("kernel.records.frequencies-modes-positive")
        wrong = self.dampings[(self.dampings <= 0.0) | (self.dampings >= 1.0)]
        if len(wrong):
            raise FieldError("kernel.records.damping-between-not", damping=wrong[0])


def _system(storey: Storey, natural: float, damping: float) -> tuple[FloatArray, FloatArray]:
    """`x' = A x + b a`: displacements of the modes and of the oscillator, then velocities."""
    n = len(storey.frequencies)
    w = 2.0 * np.pi * storey.frequencies
    w0 = 2.0 * np.pi * natural
    K = np.zeros((n + 1, n + 1))
    C = np.zeros((n + 1, n + 1))
    K[range(n), range(n)], C[range(n), range(n)] = w**2, 2.0 * storey.dampings * w
    K[n, n], C[n, n] = w0**2, 2.0 * damping * w0
    # z'' + 2 x w0 z' + w0^2 z = - (a + sum c q''), q'' = - a - 2 x w q' - w^2 q
    c = storey.participations
    K[n, :n] = -c * w**2
    C[n, :n] = -c * 2.0 * storey.dampings * w
    push = np.concatenate([-np.ones(n), [c.sum() - 1.0]])
    zero = np.zeros((n + 1, n + 1))
    A = np.block([[zero, np.eye(n + 1)], [-K, -C]])
    return A, np.concatenate([np.zeros(n + 1), push])


def floor_evolution(
    storey: Storey,
    power: tuple[FloatArray, FloatArray],
    envelope: tuple[FloatArray, FloatArray],
    natural: float,
    damping: float,
) -> tuple[FloatArray, FloatArray]:
    """Times (n,) and moments 0, 1, 2 (n, 3) of the displacement of an oscillator on a floor.

    Parameters
    ----------
    power : tuple of arrays
        Frequencies and one-sided density of the ground acceleration per hertz.
    envelope : tuple of arrays
        Times and factors.
    natural : float
        Frequency of the oscillator (Hz).
    """
    A, b = _system(storey, natural, damping)
    f, weights = _points(power, storey, natural, damping)
    row = len(b) // 2 - 1
    length = envelope[0][-1] - envelope[0][0]
    times = np.union1d(
        np.linspace(envelope[0][0], envelope[0][-1], _STEPS + 1), np.asarray(envelope[0])
    )
    factors = np.interp(times, *envelope)
    pieces = [
        (end - start, first, last)
        for (start, end), (first, last) in zip(pairwise(times), pairwise(factors), strict=True)
    ]
    pieces += [(length / _STEPS, 0.0, 0.0)] * (_STEPS // 3)
    moments = [moments_of(weights, x[row], x[row + len(b) // 2]) for x in answers(A, b, f, pieces)]
    ends = np.cumsum([0.0, *(piece[0] for piece in pieces)])
    return ends, np.array([np.zeros(3), *moments])


def _points(
    power: tuple[FloatArray, FloatArray], storey: Storey, natural: float, damping: float
) -> tuple[FloatArray, FloatArray]:
    """Frequencies and weights times density: finer near each resonance."""
    f, density = power
    if (density < 0.0).any() or not (density > 0.0).any() or (np.diff(f) <= 0.0).any():
        raise FieldError("kernel.records.power-spectrum-positive-over")
    spread = np.sinh(np.linspace(-6.0, 6.0, 41))
    near = [natural * (1.0 + damping * spread)]
    near += [
        n * (1.0 + x * spread) for n, x in zip(storey.frequencies, storey.dampings, strict=True)
    ]
    edges = np.union1d(f, np.concatenate(near))
    return gauss_points(f, density, edges[(edges >= f[0]) & (edges <= f[-1])])


def floor_spectrum(
    storey: Storey,
    power: tuple[FloatArray, FloatArray],
    envelope: tuple[FloatArray, FloatArray],
    frequencies: FloatArray,
    damping: float,
) -> tuple[FloatArray, FloatArray]:
    """Largest standard deviations in time (n,) and peak factors (n,) of relative displacements.

    The peak factor is the mean of the largest displacement over that deviation: Gumbel's law
    through two fractiles of Vanmarcke's.

    Raises
    ------
    FieldError
        For dampings, frequencies or an envelope out of their range.
    """
    if not 0.0 < damping < 1.0:
        raise FieldError("kernel.records.damping-between-not", damping=damping)
    if (frequencies <= 0.0).any() or envelope[0][-1] <= envelope[0][0]:
        raise FieldError("kernel.records.frequencies-spectrum-duration-positive")
    deviations, factors = [], []
    for natural in frequencies:
        times, moments = floor_evolution(storey, power, envelope, float(natural), damping)
        deviation = float(np.sqrt(moments[:, 0].max()))
        deviations.append(deviation)
        factors.append(largest_value(times, moments) / deviation if deviation > 0.0 else 0.0)
    return np.array(deviations), np.array(factors)
