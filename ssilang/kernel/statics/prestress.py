"""Tensions along prestressing cables, with the losses of BPEL 99.

Friction: `T(s) = T_0 exp(-(f alpha + phi s))` from the end that is pulled, alpha the angle that
the cable has turned by and s its length up to there. A slip g at the anchorage turns the friction
round near the end: with h = f alpha + phi s, `T' = T(d)^2/T` up to the length d at which
`int (T - T') ds = E S g`; where that is longer than the cable, all of it slips back. Relaxation of
the steel takes `6 rho/100 (sigma/f_prg - mu_0) sigma` (rho at 1 000 hours, in per cent).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import optimize
from ssilang.kernel.mesh.boundary import walked
from ssilang.kernel.mesh.nodes import NodeTable


@dataclass(frozen=True)
class Losses:
    """Parameters of the losses, in SI units."""

    angular: float = 0.18  # f (1/rad)
    linear: float = 0.002  # phi (1/m)
    slip: float = 0.0  # g (m) at the anchorage
    threshold: float = 0.43  # mu_0
    strength: float = 1.7e9  # f_prg (Pa), guaranteed strength
    relaxation: float = 2.5  # rho, per cent at 1 000 hours


NO_LOSSES = Losses(0.0, 0.0, 0.0, 0.0, np.inf, 0.0)


@dataclass(frozen=True, eq=False)
class Cable:
    """Bars of one cable in order from one end to the other."""

    bars: IntArray  # (n,) rows of the cells
    nodes: IntArray  # (n + 1,)

    def turned(self) -> "Cable":
        """The same cable from its other end."""
        return Cable(self.bars[::-1], self.nodes[::-1])


def cables_of(nodes: NodeTable, cells: IntArray) -> list[Cable]:
    """The cables that bars (n, 2) make, each from the end at which its cells begin.

    Raises
    ------
    MeshError
        If bars branch, or close a ring.
    """
    count = np.bincount(cells.ravel())
    if (count > 2).any():
        raise MeshError(
            "kernel.statics.cable-branches-node", node=nodes.told(int(np.argmax(count)))
        )
    bars, side = np.nonzero(count[cells] == 1)
    found, order = walked(cells, cells[bars, side][np.argsort(side, kind="stable")])
    if len(order) < len(cells):
        left = np.setdiff1d(np.arange(len(cells)), order)
        raise MeshError("kernel.statics.cable-node-ring-no", node=nodes.told(cells[left[0], 0]))
    cuts = np.flatnonzero(found[1:, 0] != found[:-1, 1]) + 1
    parts = zip(np.split(order, cuts), np.split(found, cuts), strict=True)
    return [Cable(bars, np.append(ends[:, 0], ends[-1:, 1])) for bars, ends in parts if len(bars)]


def tensions(
    cable: Cable,
    x: FloatArray,
    pulled: tuple[bool, bool],
    force: float,
    stiffness: FloatArray,
    section: FloatArray,
    losses: Losses,
) -> FloatArray:
    """Tensions (n,) at the middles of a cable's bars, in its order.

    Parameters
    ----------
    x : array (n_nodes, dim)
        Coordinates of all nodes.
    pulled : pair of bool
        Whether it is pulled at its first and at its last node; where both, the larger holds.
    stiffness, section : arrays (n,)
        E S and S of its bars.
    """
    parts = []
    if pulled[0]:
        parts.append(_from_first(cable, x, force, stiffness, losses))
    if pulled[1]:
        back = _from_first(cable.turned(), x, force, stiffness[::-1], losses)
        parts.append(back[::-1])
    found: FloatArray = np.max(parts, axis=0)
    stress = found / section
    ratio = np.maximum(stress / losses.strength - losses.threshold, 0.0)
    return found * (1.0 - 6.0 * losses.relaxation / 100.0 * ratio)


def _from_first(
    cable: Cable, x: FloatArray, force: float, stiffness: FloatArray, losses: Losses
) -> FloatArray:
    along = np.diff(x[cable.nodes], axis=0)
    length = np.linalg.norm(along, axis=1)
    way = along / length[:, None]
    cosine = np.clip(np.einsum("nd,nd->n", way[1:], way[:-1]), -1.0, 1.0)
    kinks = np.concatenate([[0.0], np.arccos(cosine)])
    kinks[kinks < 1e-7] = 0.0  # rounding of the cosine
    h = losses.angular * np.cumsum(kinks)
    h = h + losses.linear * (np.cumsum(length) - 0.5 * length)
    if losses.slip <= 0.0:
        smooth: FloatArray = force * np.exp(-h)
        return smooth
    return _slipped(force, h, length, stiffness, losses.slip)


def _slipped(
    force: float, h: FloatArray, length: FloatArray, stiffness: FloatArray, slip: float
) -> FloatArray:
    """Tensions after the anchorage has gone back by `slip`, exact for tensions even in each bar."""
    flexible = length / stiffness
    T = force * np.exp(-h)

    def gone(H: float) -> float:
        """Shortening where friction is turned round up to h = H."""
        on: NDArray[np.bool_] = h < H
        return float(((T - force * np.exp(h - 2 * H)) * flexible)[on].sum())

    last = float(h[-1])
    if gone(last) <= slip:  # all of it slips back: T' = c exp(h)
        c = (float((T * flexible).sum()) - slip) / float((np.exp(h) * flexible).sum())
        return np.maximum(c * np.exp(h), 0.0)

    H = optimize.brentq(lambda v: gone(v) - slip, 0.0, last, xtol=1e-14)
    return np.where(h < H, force * np.exp(h - 2 * H), T)
