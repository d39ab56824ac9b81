"""Plane waves P, SV and SH of any incidence in a layered half-space, in frequency.

Each layer carries waves that go down and waves that go up; free surface, interfaces and the given
incident wave settle their amplitudes (Thomson 1950, Haskell 1953). Waves that go down are referred
to the top of their layer and waves that go up to its bottom, so that no exponential grows, however
thick the layer and however oblique the wave (Knopoff 1964; Kausel and Roesset 1981).

Motion in time of a layered half-space under one plane wave, from the record of a point.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ssilang.kernel.base.arrays import ComplexArray, FloatArray
from ssilang.kernel.base.errors import MaterialError

Kind = Literal["SH", "SV", "P"]


@dataclass(frozen=True)
class HalfSpace:
    """Layers from the free surface down; the last one has no end.

    Attributes
    ----------
    thickness : array (n - 1,)
        m, of all but the last one.
    density, shear, primary : array (n,)
        kg/m3, speeds of shear and pressure waves (m/s).
    damping : array (n,)
        Reduced damping; that of the last one is left aside, since a wave that comes from afar
        would have been lost on its way.
    f1, f2 : float
        Frequencies (Hz) at which Rayleigh's damping is the reduced one.
    """

    thickness: FloatArray
    density: FloatArray
    shear: FloatArray
    primary: FloatArray
    damping: FloatArray
    f1: float = 1.0
    f2: float = 10.0

    def __post_init__(self) -> None:
        n = len(self.density)
        if not n or {len(self.shear), len(self.primary), len(self.damping)} != {n}:
            raise MaterialError("kernel.waves.layers-differ")
        if len(self.thickness) != n - 1:
            raise MaterialError("kernel.waves.last-layer-endless")
        positive = (self.thickness, self.density, self.shear, self.primary)
        if any(np.any(c <= 0) for c in positive) or np.any(self.damping < 0):
            raise MaterialError("kernel.waves.layer-not-positive")
        if min(self.f1, self.f2) <= 0:
            raise MaterialError("kernel.waves.frequencies-not-positive")

    @property
    def tops(self) -> FloatArray:
        """Depth of the top of each layer (n,)."""
        return np.concatenate([[0.0], np.cumsum(self.thickness)])

    def complex_speeds(self, omega: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Speeds of shear and pressure waves, shape (n, n_omega), with Rayleigh's damping."""
        total = self.f1 + self.f2
        damping = np.append(self.damping[:-1], 0.0)[:, None]
        alpha = damping * 4 * np.pi * self.f1 * self.f2 / total
        beta = damping / (np.pi * total)
        factor: ComplexArray = np.sqrt((1 + 1j * omega * beta) / (1 - 1j * alpha / omega))
        shear: ComplexArray = self.shear[:, None] * factor
        primary: ComplexArray = self.primary[:, None] * factor
        return shear, primary

    def moduli(self, omega: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Shear modulus and oedometric modulus, shape (n, n_omega)."""
        beta = np.append(self.damping[:-1], 0.0)[:, None] / (np.pi * (self.f1 + self.f2))
        stiffer = (1 + 1j * omega * beta).astype(np.complex128)
        shear = (self.density * self.shear**2)[:, None] * stiffer
        return shear, (self.density * self.primary**2)[:, None] * stiffer


def transfers(
    ground: HalfSpace, kind: Kind, angle: float, omega: FloatArray, depths: FloatArray
) -> tuple[ComplexArray, float]:
    """Motion at depths below the origin, of a unit incident wave.

    Parameters
    ----------
    angle : float
        Of the wave's way in the last layer from the vertical (rad), below pi/2; the wave goes up
        and to positive x.
    omega : array (n_omega,)
        Positive; time as exp(i omega t).
    depths : array (n_depths,)
        Below the free surface, positive.

    Returns
    -------
    motion : array (n_depths, components, n_omega)
        SH: across the plane of the wave; SV, P: along x and upwards. The incident displacement is
        1 at depth 0 as if the last layer had no end: SH along its normal, P along its way, SV
        towards positive x, and down where the way goes to positive x.
    slowness : float
        Horizontal one (s/m): at x the motion is that at the origin, `slowness * x` later.

    Raises
    ------
    MaterialError
        For an angle that is not below 90 degrees, or a depth above the surface.
    """
    if not abs(angle) < np.pi / 2 * (1 - 1e-9):
        raise MaterialError("kernel.waves.angle-not-upwards", angle=float(np.degrees(angle)))
    if len(depths) and float(np.min(depths)) < -1e-6 * (1 + float(np.max(np.abs(depths)))):
        raise MaterialError("kernel.waves.above-the-surface", height=float(-np.min(depths)))
    speed = ground.primary[-1] if kind == "P" else ground.shear[-1]
    slowness = float(np.sin(angle) / speed)
    waves = _waves(ground, kind, slowness, omega)
    given = 1 if kind == "SV" else 0  # of the waves that go up in the last layer
    amplitudes = _amplitudes(ground, waves, given)
    return _motion(ground, waves, amplitudes, np.maximum(depths, 0.0)), slowness


@dataclass(frozen=True)
class _Waves:
    """Vertical wave numbers (n, w, n_omega) of w kinds a layer, and what a unit wave moves.

    `up` and `down` have shape (n, 2 d, w, n_omega): d displacements, then d tractions on a
    horizontal face (those of direction x or y, then z), z upwards.
    """

    vertical: ComplexArray
    up: ComplexArray
    down: ComplexArray


def _root(squares: ComplexArray) -> ComplexArray:
    """The root whose wave exp(-i k d) fades along its way d (imaginary part not positive)."""
    root = np.sqrt(squares.astype(complex))
    fading: ComplexArray = np.where(root.imag > 0, -root, root)
    return fading


def _waves(ground: HalfSpace, kind: Kind, slowness: float, omega: FloatArray) -> _Waves:
    shear, primary = ground.complex_speeds(omega)
    G, E = ground.moduli(omega)
    p = slowness * np.ones_like(shear)
    s = _root((omega / shear) ** 2 - (omega * p) ** 2) / omega
    if kind == "SH":
        one = np.ones_like(s)
        up = np.stack([one, -1j * omega * G * s], axis=1)[:, :, None]
        down = np.stack([one, 1j * omega * G * s], axis=1)[:, :, None]
        across = (omega * s).astype(np.complex128)[:, None]
        return _Waves(across, up, down)
    q = _root((omega / primary) ** 2 - (omega * p) ** 2) / omega

    def of(sign: float) -> ComplexArray:
        """Waves P and SV that go up (sign 1) or down: exp(i omega (t - p x - sign k z))."""
        move = np.array([[primary * p, shear * s], [sign * primary * q, -sign * shear * p]])
        kz = np.array([q, s])
        xz = G * -1j * omega * (sign * kz * move[0] + p * move[1])
        zz = -1j * omega * (E * sign * kz * move[1] + (E - 2 * G) * p * move[0])
        return np.stack([move[0], move[1], xz, zz], axis=1).transpose(2, 1, 0, 3)

    vertical = (omega * np.stack([q, s], axis=1)).astype(np.complex128)
    return _Waves(vertical, of(1.0), of(-1.0))


def _amplitudes(ground: HalfSpace, waves: _Waves, given: int) -> tuple[ComplexArray, ComplexArray]:
    """Amplitudes (n, w, n_omega) of waves up (at layers' bottoms) and down (at their tops)."""
    n, two, w, n_omega = waves.up.shape
    d = two // 2  # as many as w
    size = 2 * d * (n - 1) + d
    A = np.zeros((n_omega, size, size), complex)
    b = np.zeros((n_omega, size), complex)
    fade = np.exp(-1j * waves.vertical[:-1] * ground.thickness[:, None, None])
    arrive = np.exp(-1j * waves.vertical[-1, given] * -ground.tops[-1])
    # unknowns: up (w), down (w) of each layer; of the last one down only
    for i in range(n):
        at, last = 2 * w * i, i == n - 1
        up_top = waves.up[i] * (fade[i] if not last else 1.0)
        top = slice(0, d) if i == 0 else slice(d + 2 * d * (i - 1), d + 2 * d * i)
        rows = slice(d, 2 * d) if i == 0 else slice(0, 2 * d)
        sign = 1.0 if i == 0 else -1.0
        down_at = at if last else at + w
        A[:, top, down_at : down_at + w] += sign * _last(waves.down[i][rows])
        if last:
            b[:, top] -= sign * (waves.up[i][rows, given] * arrive).T
            continue
        A[:, top, at : at + w] += sign * _last(up_top[rows])
        bottom = slice(d + 2 * d * i, d + 2 * d * (i + 1))
        A[:, bottom, at : at + w] += _last(waves.up[i])
        A[:, bottom, at + w : at + 2 * w] += _last(waves.down[i] * fade[i])
    scale = np.maximum(np.abs(A).max(axis=2, keepdims=True), 1e-300)
    x = np.linalg.solve(A / scale, (b / scale[..., 0])[..., None])[..., 0]
    up = np.zeros((n, w, n_omega), complex)
    down = np.zeros((n, w, n_omega), complex)
    for i in range(n - 1):
        up[i] = x[:, 2 * w * i : 2 * w * i + w].T
        down[i] = x[:, 2 * w * i + w : 2 * w * (i + 1)].T
    down[-1] = x[:, 2 * w * (n - 1) :].T
    up[-1, given] = arrive
    return up, down


def _last(values: ComplexArray) -> ComplexArray:
    """Frequencies first: (r, w, n_omega) to (n_omega, r, w)."""
    return values.transpose(2, 0, 1)


def _motion(
    ground: HalfSpace,
    waves: _Waves,
    amplitudes: tuple[ComplexArray, ComplexArray],
    depths: FloatArray,
) -> ComplexArray:
    up, down = amplitudes
    tops = ground.tops
    d = waves.up.shape[1] // 2
    found = np.zeros((len(depths), d, up.shape[-1]), complex)
    layer = np.clip(np.searchsorted(tops, depths * (1 + 1e-12), "right") - 1, 0, len(tops) - 1)
    for row, (i, depth) in enumerate(zip(layer, depths, strict=True)):
        below = depth - tops[i]
        above = tops[i + 1] - depth if i < len(tops) - 1 else -below
        here = waves.vertical[i] * (up[i] != 0)  # what is not there does not grow downwards
        rising = up[i] * np.exp(-1j * here * above)
        falling = down[i] * np.exp(-1j * waves.vertical[i] * below)
        found[row] = (waves.up[i, :d] * rising).sum(axis=1)
        found[row] += (waves.down[i, :d] * falling).sum(axis=1)
    return found


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
        surface, _ = transfers(ground, wave.kind, wave.angle, omega, np.zeros(1))
        moved: ComplexArray = surface[0, 1 if wave.kind == "P" else 0]
        if np.abs(moved).min() < 1e-6:
            raise MaterialError("kernel.waves.surface-at-rest", angle=float(np.degrees(wave.angle)))
        spectrum = spectrum / moved
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
