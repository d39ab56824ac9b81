"""Motion in time of a layered half-space under one plane wave, from the record of a point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.waves.layered_half_space import HalfSpace, Kind, transfers

Given = Literal["INCIDENTE", "SURFACE"]

#: share of the largest motion above which a wave counts as being there already
EARLY = 1e-3


@dataclass(frozen=True)
class PlaneWave:
    """A record, the wave that it is of, and where it was taken.

    Attributes
    ----------
    kind : 'SH', 'SV' or 'P'
    angle : float
        Of the incident wave's way from the vertical (rad).
    given : 'INCIDENTE' or 'SURFACE'
        Whether the record is the incident wave's as it would pass the point without a surface, or
        the motion of the free surface there: of SH across the plane, SV along x, P upwards.
    start, step : float
        First time and equal step of the record (s).
    acceleration : array (n,)
        m/s2; at rest before it.
    depth : float
        Of the point that an incident wave passes (m).
    """

    kind: Kind
    angle: float
    given: Given
    start: float
    step: float
    acceleration: FloatArray
    depth: float = 0.0

    def delay(self, ground: HalfSpace) -> float:
        """From the record's point to the surface above it, of a wave without a surface (s)."""
        speed = ground.primary[-1] if self.kind == "P" else ground.shear[-1]
        at_depth = self.given == "INCIDENTE"
        return float(self.depth * np.cos(self.angle) / speed) if at_depth else 0.0


@dataclass(frozen=True)
class WaveMotion:
    """Histories (points, components, times); `early` is the time that the record lacks (s)."""

    times: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    early: float


def plane_motion(
    ground: HalfSpace,
    wave: PlaneWave,
    along: FloatArray,
    depths: FloatArray,
    step: float | None = None,
) -> WaveMotion:
    """Motion at points under a plane wave.

    Parameters
    ----------
    along : array (n,)
        Place of each point from the record's, along the horizontal way of the wave (m).
    depths : array (n,)
        Below the free surface (m).
    step : float or None
        Times go by it, or by a part of the record's step that is not longer; interpolation by
        the Fourier series. None: the record's.

    Raises
    ------
    MaterialError
        For a record of a surface that does not move so, or one too short.
    """
    if wave.step <= 0 or len(wave.acceleration) < 2:
        raise MaterialError("kernel.waves.record-too-short")
    if step is not None and step <= 0:
        raise MaterialError("kernel.waves.step-not-positive", step=step)
    n = len(wave.acceleration)
    padded = 2 ** int(np.ceil(np.log2(2 * n)))
    finer = 1 if step is None else max(int(np.ceil(wave.step / step - 1e-9)), 1)
    omega = np.asarray(2 * np.pi * np.fft.rfftfreq(padded, wave.step)[1:], dtype=np.float64)
    levels, row = np.unique(np.round(depths, 9), return_inverse=True)
    motion, slowness = transfers(ground, wave.kind, wave.angle, omega, levels)
    delay = wave.delay(ground)
    spectrum = np.fft.rfft(wave.acceleration, padded)[1:] * np.exp(-1j * omega * delay)
    if wave.given == "SURFACE":
        spectrum = spectrum / _at_surface(ground, wave, omega)
    if finer > 1:
        spectrum[-1] *= 0.5
    count = (n - 1) * finer + 1
    u, v, a = (np.empty((len(along), motion.shape[1], count)) for _ in range(3))
    for place, (x, level) in enumerate(zip(along, row, strict=True)):
        here = motion[level] * (spectrum * np.exp(-1j * omega * slowness * x))
        for histories, factor in ((u, -1 / omega**2), (v, -1j / omega), (a, 1.0)):
            histories[place] = _history(here * factor, padded, finer)[:, :count]
    early = _early(u, v, delay + along * slowness - depths / ground.shear.min())
    if wave.kind == "SV" and slowness * ground.primary[-1] > 1:
        early = max(early, _lead(v, wave.step / finer))
    u -= u[..., :1]
    return WaveMotion(wave.start + np.arange(count) * wave.step / finer, u, v, a, early)


def _at_surface(ground: HalfSpace, wave: PlaneWave, omega: FloatArray) -> ComplexArray:
    surface, _ = transfers(ground, wave.kind, wave.angle, omega, np.zeros(1))
    moved: ComplexArray = surface[0, 1 if wave.kind == "P" else 0]
    if np.abs(moved).min() < 1e-6:
        raise MaterialError("kernel.waves.surface-at-rest", angle=float(np.degrees(wave.angle)))
    return moved


def _history(spectrum: ComplexArray, padded: int, finer: int) -> FloatArray:
    full = np.zeros((len(spectrum), padded * finer // 2 + 1), complex)
    full[:, 1 : spectrum.shape[1] + 1] = spectrum
    return np.fft.irfft(full * finer, padded * finer)


def _early(u: FloatArray, v: FloatArray, delays: FloatArray) -> float:
    """How much sooner (s) than the record the wave is at the first point; 0 if all are at rest."""
    moving = np.abs(v[..., 0]).max(initial=0.0) > EARLY * np.abs(v).max(initial=0.0)
    if not moving or not u.size:
        return 0.0
    return float(max(-delays.min(), 0.0))


def _lead(v: FloatArray, step: float) -> float:
    """Time (s) before which a wave beyond the critical angle moves less than `EARLY`.

    Its parts are the record's Hilbert transform, which has no beginning: velocity grows as the
    inverse square of the time that is left to the pulse.
    """
    largest = np.abs(v).max(axis=(0, 1))
    ahead = float(np.argmax(largest)) * step
    if largest[0] <= EARLY * largest.max():
        return 0.0
    return ahead * (float(np.sqrt(largest[0] / (EARLY * largest.max()))) - 1)
