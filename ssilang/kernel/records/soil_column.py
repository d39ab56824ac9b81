"""Free field of a layered soil under vertically propagating waves, in frequency."""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import MaterialError

#: steps a period of the cut-off frequency, in the refined times
STEPS_A_PERIOD = 40


@dataclass(frozen=True)
class SoilColumn:
    """Layers from the free surface down; the last one goes on below its base.

    Attributes
    ----------
    thickness, density, modulus, damping : FloatArray
        One a layer: m, kg/m3, Pa (G of shear waves, E_oed of pressure waves), reduced damping.
    f1, f2 : float
        Frequencies (Hz) at which Rayleigh's damping is the reduced one.
    """

    thickness: FloatArray
    density: FloatArray
    modulus: FloatArray
    damping: FloatArray
    f1: float
    f2: float

    def __post_init__(self) -> None:
        columns = (self.thickness, self.density, self.modulus)
        if len({len(c) for c in (*columns, self.damping)}) != 1 or not len(self.thickness):
            raise MaterialError("kernel.records.soil-needs-many-thicknesses")
        if any(np.any(c <= 0) for c in columns) or np.any(self.damping < 0):
            raise MaterialError("kernel.records.thickness-density-modulus-layer")
        if self.f1 <= 0 or self.f2 <= 0:
            raise MaterialError("kernel.records.frequencies-rayleigh-damping-must")

    @property
    def tops(self) -> FloatArray:
        """Depth of the top of each layer, then of the base."""
        return np.concatenate([[0.0], np.cumsum(self.thickness)])

    @property
    def crossing(self) -> float:
        """Time (s) that a wave takes from the base to the surface."""
        return float((self.thickness * np.sqrt(self.density / self.modulus)).sum())

    def rayleigh(self) -> tuple[FloatArray, FloatArray]:
        """Factors of mass and of stiffness, one a layer."""
        total = self.f1 + self.f2
        return (
            self.damping * 4 * np.pi * self.f1 * self.f2 / total,
            self.damping / (np.pi * total),
        )


@dataclass(frozen=True)
class FreeField:
    """Motion and stress at depths; rows are depths, columns times.

    `stress` is modulus times derivative along the upward axis (positive in tension). `begun` is by
    how much the velocities at the depths differ where the times begin, of the largest one: waves
    that are in the ground before the given motion begins.
    """

    times: FloatArray
    acceleration: FloatArray
    velocity: FloatArray
    stress: FloatArray
    strain: FloatArray  # largest absolute value, one a depth
    begun: float


def transfers(
    soil: SoilColumn, omega: FloatArray, depths: FloatArray
) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
    """Displacement, stress (upward axis) and strain at depths, and the outcrop of the base.

    All for a unit displacement of the free surface, exp(i omega t), omega > 0; the first three
    have shape (depths, omega). The outcrop is twice the upgoing wave at the base.
    """
    shape = (len(depths), len(omega))
    u_at, s_at, e_at = (np.zeros(shape, complex) for _ in range(3))
    u, s = np.ones(len(omega), complex), np.zeros(len(omega), complex)
    tops = soil.tops
    where = np.clip(np.searchsorted(tops, depths * (1 - 1e-9), "right") - 1, 0, len(tops) - 2)
    for i, h in enumerate(soil.thickness):
        alpha, beta = (c[i] for c in soil.rayleigh())
        modulus = soil.modulus[i] * (1 + 1j * omega * beta)  # complex; k is the wave number
        k = omega * np.sqrt(soil.density[i] * (1 - 1j * alpha / omega) / modulus)
        for row in np.flatnonzero(where == i):
            u_at[row], s_at[row] = _down(u, s, k, modulus, depths[row] - tops[i])
            e_at[row] = s_at[row] / modulus
        u, s = _down(u, s, k, modulus, float(h))
    outcrop = u + s / (1j * k * modulus)
    return u_at, -s_at, -e_at, outcrop


def _down(
    u: ComplexArray, s: ComplexArray, k: ComplexArray, modulus: ComplexArray, d: float
) -> tuple[ComplexArray, ComplexArray]:
    c, sn = np.cos(k * d), np.sin(k * d)
    return c * u + sn / (k * modulus) * s, c * s - k * modulus * sn * u


def free_field(
    soil: SoilColumn,
    step: float,
    acceleration: FloatArray,
    depths: FloatArray,
    cutoff: float,
    control: float | None = 0.0,
) -> FreeField:
    """Histories at depths from an acceleration known at one of them.

    Parameters
    ----------
    step, acceleration
        Equal step (s) and values of the given acceleration, which starts at rest.
    cutoff : float
        Frequency (Hz) above which the motion is left out. Times are refined between the given
        ones (interpolation by the Fourier series) to 40 steps a period of it, and go on a tenth
        beyond the last one, with no acceleration.
    control : float or None
        Depth at which the acceleration is given; None: at an outcrop of the base.

    Raises
    ------
    MaterialError
        For a depth outside the layers or a step that is not positive.
    """
    depths = np.asarray(depths, float)
    bottom = soil.tops[-1]
    inside: FloatArray = np.append(depths, np.zeros(0) if control is None else control)
    if step <= 0 or cutoff <= 0 or len(acceleration) < 2:
        raise MaterialError("kernel.records.acceleration-needs-two-points")
    if np.any(inside < -1e-6 * bottom) or np.any(inside > bottom * (1 + 1e-6)):
        raise MaterialError("kernel.records.depth-outside-layers-end", bottom=bottom)
    n = len(acceleration)
    padded = 2 ** int(np.ceil(np.log2(2 * n)))
    finer = int(np.ceil(step * STEPS_A_PERIOD * cutoff - 1e-9))
    finer = max(finer, 1)
    given = np.fft.rfft(acceleration, padded)
    frequencies = np.fft.rfftfreq(padded, step)
    given[frequencies > cutoff * (1 + 1e-9)] = 0
    if finer > 1:
        given[-1] *= 0.5
    omega = (2 * np.pi * frequencies[1:]).astype(float)
    u, s, e, outcrop = transfers(soil, omega, inside)
    surface = given[1:] / (outcrop if control is None else u[-1])
    mean = given[0].real / padded
    count = min(n - 1 + max(n // 10, 2), padded - 1) * finer + 1
    times = np.arange(count, dtype=float) * (step / finer)

    def history(spectrum: ComplexArray, at_zero: float = 0.0) -> FloatArray:
        full = np.zeros((len(spectrum), padded * finer // 2 + 1), complex)
        full[:, 1 : len(frequencies)] = spectrum
        full[:, 0] = at_zero * padded
        return np.asarray(np.fft.irfft(full * finer, padded * finer)[:, :count])

    rows = slice(0, len(depths))
    motion = u[rows] * surface
    speed = history(motion / (1j * omega))
    # what makes the given motion start at rest goes to all depths alike: constants of their own
    # would draw the depths apart all along
    start = history((given[1:] / (1j * omega))[None])[0, 0]
    drift = (mean * times - start)[None]
    stress = history(s[rows] * surface / -(omega**2))
    strain = history(e[rows] * surface / -(omega**2))
    # stress that a uniform acceleration and velocity of the column ask for
    above = np.clip(depths[:, None] - soil.tops[None, :-1], 0, soil.thickness)
    mass = above @ soil.density
    damped = above @ (soil.density * soil.rayleigh()[0])
    return FreeField(
        times,
        history(motion, mean),
        speed + drift,
        stress - (mass[:, None] * mean + damped[:, None] * drift),
        np.abs(strain).max(axis=1),
        float(np.ptp(speed[:, 0]) / max(np.abs(speed - speed[:, :1]).max(), 1e-300)),
    )
