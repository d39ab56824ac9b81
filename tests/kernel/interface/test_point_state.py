"""State and energies at the points of joints, along paths whose work is integrated."""

import numpy as np
import pytest

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, Parameter
from ssilang.kernel.interface.laws.point_laws import respond
from ssilang.kernel.interface.point_state import (
    CLOSED,
    CLOSING,
    OPEN,
    OPENING,
    energies_of_points,
    point_states,
)

ELASTIC, SDM, MOHR, STRIP, PENDULUM = 0, 1, 2, 3, 8


def parameters(**given):
    table = np.zeros((1, N_PARAMETERS))
    for name, value in ({"KN": 1e9, "KS1": 4e8, "KS2": 4e8, "FROT": -1.0} | given).items():
        table[0, Parameter[name]] = value
    return table


class Point:
    """One point walked along jumps, its work by Simpson's rule on the way."""

    def __init__(self, code, **given):
        self.code, self.p = np.array([code]), parameters(**given)
        self.w, self.t, self.work = np.zeros((1, 2)), np.zeros((1, 2)), 0.0
        self.state = np.zeros((1, N_STATE))

    def answer(self, w):
        t, new, D = np.zeros((1, 2)), np.zeros((1, N_STATE)), np.zeros((1, 2, 2))
        respond(self.code, w, self.state, self.p, t, new, D)
        return t, new

    def to(self, shear, normal, pieces=4000):
        last = np.array([[shear, normal]])
        step = (last - self.w) / pieces
        for _ in range(pieces):
            t0 = self.t
            self.w = self.w + step
            self.t, self.state = self.answer(self.w)
            self.work += float(((t0 + self.t) / 2 * step).sum())
        return self

    @property
    def arrays(self):
        return self.code, self.w, self.t, self.state, self.p

    @property
    def condition(self):
        return point_states(*self.arrays)[0]

    @property
    def energies(self):
        return energies_of_points(*self.arrays)[:, 0]


@pytest.mark.parametrize("unit", [1.0, 1e6])
def test_states_of_a_joint_with_strength_along_its_path(unit):
    p = Point(SDM, KN=1e9 / unit, FU=1e5 / unit, GF=20.0 / unit, FC=-2e4 / unit)
    assert p.condition == OPEN  # at rest between FC and the strength
    assert p.to(0, -1e-4).condition == CLOSED
    assert p.to(0, 5e-5).condition == OPEN  # elastic tension
    assert p.to(0, 4e-4).condition == OPENING
    xi = p.state[0, 0]
    assert p.to(0, xi + 1e-6).condition == OPEN  # unloading towards the largest opening
    assert p.to(0, xi / 2).condition == CLOSING
    assert -2e4 < unit * p.t[0, 1] < 0
    assert p.to(0, -1e-4).condition == CLOSED
    assert p.to(0, 8e-4).condition == OPENING


def test_states_of_a_joint_without_tension():
    p = Point(SDM)
    assert p.condition == CLOSED
    assert p.to(0, 1e-3).condition == OPENING
    assert p.to(0, 5e-4).condition == OPEN
    assert p.to(0, 2e-3).condition == OPENING
    assert p.to(0, -1e-6).condition == CLOSED


def test_states_of_the_other_laws():
    assert Point(ELASTIC).to(0, 1e-3).condition == CLOSED  # bonded
    assert Point(MOHR, TPHI=0.5).to(0, -1e-4).condition == CLOSED
    assert Point(MOHR, TPHI=0.5).to(0, 1e-4).condition == OPEN
    assert Point(MOHR, FTRC=1e4, COHE=1e5).to(0, 1e-4).condition == OPENING
    strip = {"KN": 1e6, "LARG": 4.0, "KS1": 1e6 * 16 / 12}
    assert Point(STRIP, **strip).to(1e-4, -1e-3).condition == CLOSED
    assert Point(STRIP, **strip).to(1e-3, -1e-3).condition == OPEN
    bowl = Point(PENDULUM, RAYO=2.0, FROT=0.1).to(0.04, 3e-4)
    assert bowl.condition == CLOSED  # 0.8 mm of the bowl above where it rose to
    assert bowl.to(0.04, 9e-4).condition == OPEN


def test_opening_spends_the_fracture_energy():
    fu, gf = 1e5, 20.0
    p = Point(SDM, FU=fu, GF=gf).to(0, 6e-4)
    xi = p.state[0, 0]
    # traction integrated to 1e-9 by Gauss-Legendre on the elastic and on the softening part
    nodes, weights = np.polynomial.legendre.leggauss(40)
    start = fu / 1e9
    w = start + (6e-4 - start) * (nodes + 1) / 2
    t = [Point(SDM, FU=fu, GF=gf).to(0, x, 1).t[0, 1] for x in w]
    work = fu * start / 2 + (6e-4 - start) / 2 * float(weights @ t)
    stored, lost = p.energies
    assert lost == pytest.approx(gf * (1 - np.exp(-fu * xi / gf)), rel=1e-7)
    assert stored + lost == pytest.approx(work, rel=1e-7)


def test_a_joint_of_three_dimensions_opens_along_its_normal():
    """Tension beside shear of the other sign: the traction across decides, not that along."""
    p = parameters(TPHI=0.5, COHE=1e9, FTRC=1e9)
    w, t = np.array([[-1e-3, -2e-3, 1e-3]]), np.array([[-4e5, -8e5, 1e6]])
    state = np.zeros((1, N_STATE))
    assert point_states(np.array([MOHR]), w, t, state, p)[0] == OPENING
    assert point_states(np.array([MOHR]), -w, -t, state, p)[0] == CLOSED
