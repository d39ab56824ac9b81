"""Tensions of cables against a march along them, and which bars make a cable."""

import numpy as np
import pytest
from scipy.optimize import brentq
from together import together

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.statics.prestress import NO_LOSSES, Cable, Losses, cables_of, tensions

X = np.cumsum([[0, 0, 0], [2, 0.1, 0], [1.5, 0.4, 0.3], [1, 0.9, 0.2], [2.5, 0.2, -0.4]], axis=0)
CABLE = Cable(np.array([3, 1, 0, 2]), np.array([0, 1, 2, 3, 4]))
STIFF = np.array([2e8, 1.5e8, 2.2e8, 1.8e8])
SECTION = np.array([1e-3, 8e-4, 1.1e-3, 9e-4])


def march(x, force, losses, stiffness):
    """Tensions from the first end: friction bar by bar, then the slip by its definition."""
    legs = np.diff(x, axis=0)
    length = np.linalg.norm(legs, axis=1)
    alpha, s, h = 0.0, 0.0, []
    for k in range(len(legs)):
        if k:
            turn = legs[k] @ legs[k - 1] / (length[k] * length[k - 1])
            alpha += np.arccos(turn)
        h.append(losses.angular * alpha + losses.linear * (s + length[k] / 2))
        s += length[k]
    h = np.array(h)
    T = force * np.exp(-h)
    if not losses.slip:
        return T

    def after(d):
        return np.where(h < d, force * np.exp(-2 * d) * np.exp(h), T)

    def slipped(d):
        return ((T - after(d)) * length / stiffness).sum() - losses.slip

    if slipped(h[-1] + 1e-12) > 0:
        return after(brentq(slipped, 0, h[-1]))
    level = brentq(
        lambda c: ((T - c * np.exp(h)) * length / stiffness).sum() - losses.slip, -force, force
    )
    return np.maximum(level * np.exp(h), 0.0)


@together("slip", [0.0, 5e-4, 5e-3, 0.02, 0.06])
@together("pulled", [(True, False), (False, True), (True, True)])
def test_tensions_are_those_of_the_march_from_each_end_that_is_pulled(slip, pulled):
    losses = Losses(0.2, 0.01, slip, 0.5, 1.6e9, 2.0)
    found = tensions(CABLE, X, pulled, 1.2e6, STIFF, SECTION, losses)
    parts = []
    if pulled[0]:
        parts.append(march(X, 1.2e6, losses, STIFF))
    if pulled[1]:
        parts.append(march(X[::-1], 1.2e6, losses, STIFF[::-1])[::-1])
    T = np.max(parts, axis=0)
    stress = T / SECTION
    loss = 6 * 2.0 / 100 * np.maximum(stress / 1.6e9 - 0.5, 0) * stress
    np.testing.assert_allclose(found, (stress - loss) * SECTION, rtol=1e-9)
    assert (loss > 0).any() or slip > 0.01


def test_without_losses_all_bars_have_the_force():
    found = tensions(CABLE, X, (True, False), 7.0, STIFF, SECTION, NO_LOSSES)
    np.testing.assert_allclose(found, 7.0)


def test_bars_in_any_order_and_sense_are_strung_into_cables():
    nodes = NodeTable()
    nodes.add(np.arange(27.0).reshape(9, 3) ** 1.1)
    cells = np.array([[5, 2], [7, 5], [0, 1], [3, 2], [1, 8]])
    found = {tuple(c.nodes): tuple(c.bars) for c in cables_of(nodes, cells)}
    assert found == {(7, 5, 2, 3): (1, 0, 3), (0, 1, 8): (2, 4)}
    turned = CABLE.turned()
    assert (turned.bars.tolist(), turned.nodes.tolist()) == ([2, 0, 1, 3], [4, 3, 2, 1, 0])
    for bad, match in (([[0, 1], [1, 2], [1, 3]], "branch"), ([[0, 1], [1, 2], [2, 0]], "ring")):
        with pytest.raises(MeshError, match=match):
            cables_of(nodes, np.array(bad))
