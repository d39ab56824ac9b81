"""Motion of a rigid base under waves that pass along it and differ from point to point.

A rigid base without mass averages the motion of the ground below it. Between two points at a
distance s, waves of the circular frequency w that go along x at the apparent speed c have the
coherency of Luco and Wong (1986, *Response of a rigid foundation to a spatially random ground
motion*, Earthquake Engng. Struct. Dyn. 14, 891-908), V being the speed of shear waves,

    Gamma = exp(-(gamma w s / V)^2) exp(-i w (x - x') / c)

The spectra of the base's translation and rotation are those of a point times

    T^2 = 1/A^2 int int Gamma dA dA' ,   M^2 = 1/I^2 int int x x' Gamma dA dA' ,   I = int x^2 dA

Here all points count alike (Veletsos and Prasad 1989, *Seismic interaction of structures and soils:
stochastic approach*, J. Struct. Engng. 115, 935-956); Luco and Wong weight them by the tractions
below the base. Over the distance s the double integrals become simple ones of what the shape and
its copy moved by s have in common.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from scipy.special import j0, j1

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import MaterialError

Shape = Literal["strip", "rectangle", "disc"]

POINTS = 20
"""Gauss points on each part of a distance."""
BEGUN = 0.01
"""Share of the peak above which a motion has begun."""
PHASE, DECAY = 4.0, 3.0
"""Radians of the phase, and lengths of the decay, on each part: rounding is all that is left."""


@dataclass(frozen=True)
class RigidBase:
    """Shape of a base and its half sizes (m): along the way of the waves, and across it.

    A disc has its radius as both, a strip has nothing across.
    """

    shape: Shape
    along: float
    across: float = 0.0

    def __post_init__(self) -> None:
        sizes = (self.along, self.across) if self.shape == "rectangle" else (self.along,)
        if min(sizes) <= 0.0:
            raise MaterialError("kernel.waves.base-without-size")

    @property
    def torsion_share(self) -> float:
        """I over the polar moment: torsion by unit rotation; 0 of a strip."""
        if self.shape == "strip":
            return 0.0
        if self.shape == "disc":
            return 0.5
        return self.along**2 / (self.along**2 + self.across**2)


@dataclass(frozen=True)
class Ground:
    """How motions differ: speed of shear waves (m/s), gamma, apparent speed (m/s, None: no way).

    Raises
    ------
    MaterialError
        For a speed that is not positive, a negative gamma.
    """

    shear: float
    gamma: float = 0.0
    apparent: float | None = None

    def __post_init__(self) -> None:
        if self.shear <= 0.0 or (self.apparent is not None and self.apparent <= 0.0):
            raise MaterialError("kernel.waves.speed-not-positive")
        if self.gamma < 0.0:
            raise MaterialError("kernel.waves.gamma-negative", gamma=self.gamma)

    def numbers(self, frequency: float) -> tuple[float, float]:
        """Decay gamma w / V and wave number w / c (1/m) at a frequency (Hz)."""
        w = 2 * np.pi * frequency
        return self.gamma * w / self.shear, 0.0 if self.apparent is None else w / self.apparent


Pair = Callable[[RigidBase, float, float], tuple[float, float]]
"""Two means over a base by decay and wave number."""


@dataclass(frozen=True)
class Factors:
    """What a base makes of unit motion at each frequency."""

    translation: FloatArray  # (n,)
    rotation: FloatArray  # (n,) about the axis across the way, of vertical motion (1/m)
    torsion: FloatArray  # (n,) about the vertical, of motion across the way (1/m); zeros of a strip


def factors(base: RigidBase, ground: Ground, frequencies: FloatArray) -> Factors:
    """Factors of translation, rotation and torsion at frequencies (n,) in Hz."""
    mean_of = _disc if base.shape == "disc" else _rectangle
    squares = _over(frequencies, mean_of, base, ground)
    translation, rotation = np.sqrt(np.maximum(squares, 0.0))
    return Factors(translation, rotation, base.torsion_share * rotation)


def signs(
    base: RigidBase, ground: Ground, frequencies: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Whether translation and slope go with the wave (1) or against it (-1), at frequencies (n,).

    Those of their cross spectra with the motion at the centre, which is all that the coherency
    says of phases: without chance the wave's own; where chance prevails none goes against it.
    """
    translation, slope = np.where(_over(frequencies, _with_centre, base, ground) < 0.0, -1.0, 1.0)
    return translation, slope


def _over(frequencies: FloatArray, of: Pair, base: RigidBase, ground: Ground) -> FloatArray:
    """Two means (2, n) at frequencies (n,)."""
    found = [of(base, *ground.numbers(float(f))) for f in frequencies]
    return np.array(found, float).reshape(len(frequencies), 2).T


def frequencies_of(acceleration: FloatArray, step: float) -> FloatArray:
    """Frequencies (Hz) of a record (n,) and of as many zeros behind it, which keep ends apart."""
    return np.asarray(np.fft.rfftfreq(2 * len(acceleration), step), float)


def averaged(acceleration: FloatArray, factor: ComplexArray | FloatArray) -> FloatArray:
    """A record (n,) by a factor at each of `frequencies_of` it."""
    return _whole(acceleration, factor)[: len(acceleration)]


def steps_before(acceleration: FloatArray, factor: ComplexArray | FloatArray) -> int:
    """Steps before a record's beginning in which the base moves by `BEGUN` of its peak and more.

    A wave that passes is at the base's edge before it is at the centre, where the record is. What
    comes before the first instant stands at the end of the zeros behind the record.
    """
    moved = np.abs(_whole(acceleration, factor))
    before = moved[-(len(acceleration) // 2) :]
    begun = np.flatnonzero(before > BEGUN * moved.max())
    return len(before) - int(begun[0]) if len(begun) else 0


def _whole(acceleration: FloatArray, factor: ComplexArray | FloatArray) -> FloatArray:
    spectrum = np.fft.rfft(acceleration, 2 * len(acceleration))
    return np.asarray(np.fft.irfft(spectrum * factor, 2 * len(acceleration)), float)


@cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    return (points + 1) / 2, weights / 2


def _nodes(end: float, decay: float, number: float) -> tuple[FloatArray, FloatArray]:
    """Points and weights of an integral from 0 to `end`, in parts that the waves ask for."""
    points, weights = _gauss()
    parts = 1 + int(end * (number / PHASE + decay / DECAY))
    width = end / parts
    places = (np.arange(parts)[:, None] + points).ravel() * width
    return places, np.tile(weights, parts) * width


def _rectangle(base: RigidBase, decay: float, number: float) -> tuple[float, float]:
    """T^2 and M^2 of a rectangle or strip: products of those of its sides."""
    first, turned = _line(base.along, decay, number)
    second = _line(base.across, decay, 0.0)[0] if base.shape == "rectangle" else 1.0
    return first * second, turned * second


def _with_centre(base: RigidBase, decay: float, number: float) -> tuple[float, float]:
    """Means of the coherency with the centre, and of its slope, but for positive factors."""
    x, weights = _nodes(base.along, decay, abs(number))
    weights = weights * np.exp(-((decay * x) ** 2))
    if base.shape == "disc":
        return float(weights @ (x * j0(number * x))), float(weights @ (x**2 * j1(number * x)))
    return float(weights @ np.cos(number * x)), float(weights @ (x * np.sin(number * x)))


def _line(half: float, decay: float, number: float) -> tuple[float, float]:
    """Means over a line of half length a: of two points, and of their moments."""
    s, weights = _nodes(2 * half, decay, number)
    both = half - s / 2  # half of what the line and its copy have in common
    # the coherency less one: the moments' weights have no mean
    less = np.expm1(-((decay * s) ** 2)) * np.cos(number * s) - 2 * np.sin(number * s / 2) ** 2
    mean = 1.0 + 2 * float(weights @ (2 * both * less)) / (2 * half) ** 2
    moments = 2 * both**3 / 3 - s**2 / 2 * both
    return mean, 2 * float(weights @ (moments * less)) / (2 * half**3 / 3) ** 2


def _disc(base: RigidBase, decay: float, number: float) -> tuple[float, float]:
    """T^2 and M^2 of a disc; `s = 2 R cos(angle)`, where the common lens is smooth."""
    radius = base.along
    angle, weights = _nodes(np.pi / 2, 2 * radius * decay, 2 * radius * number)
    half = radius * np.cos(angle)
    s, weights = 2 * half, weights * 2 * radius * np.sin(angle)
    # the lens: its area, its second moments along s and across it
    area = 2 * radius**2 * (angle - np.sin(angle) * np.cos(angle))
    fourth = np.sin(4 * angle) / 32
    across = 4 / 3 * radius**4 * (3 * angle / 8 - np.sin(2 * angle) / 4 + fourth)
    along = 4 * radius**2 * (
        radius**2 * (angle / 8 - fourth)
        - 2 * radius * half * np.sin(angle) ** 3 / 3
        + half**2 * (angle / 2 - np.sin(2 * angle) / 4)
    )  # fmt: skip
    phase = number * s
    ratio = np.full_like(phase, 0.5)  # J1(z)/z
    np.divide(j1(phase), phase, out=ratio, where=phase > 0.0)
    loss = np.exp(-((decay * s) ** 2))
    mean = 1.0 + 2 * float(weights @ (s * area * (loss * j0(phase) - 1.0))) / np.pi / radius**4
    apart = (along - s**2 / 4 * area) * (loss * (j0(phase) - ratio) - 0.5)
    turned = apart + across * (loss * ratio - 0.5)
    moment = np.pi * radius**4 / 4
    return mean, 2 * np.pi * float(weights @ (s * turned)) / moment**2
