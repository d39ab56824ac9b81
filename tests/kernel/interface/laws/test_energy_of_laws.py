"""Every law along irregular paths in fine steps: work is what is stored and what is lost."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, LawCode, Parameter
from ssilang.kernel.interface.laws.point_laws import point_energies, respond

FINE = 400
KN, KS = 3e8, 1.1e8
LAWS = {
    "elastic": (LawCode.ELASTIC, {}),
    "opens": (LawCode.SDM, {"FU": 0.0, "FC": 0.0, "FROT": -1.0}),
    "bonded": (LawCode.SDM, {"FU": 2e4, "GF": 15.0, "FC": -1e4, "FROT": -1.0}),
    "rubs": (LawCode.SDM, {"FU": 0.0, "FC": 0.0, "FROT": 0.4}),
    "Mohr": (LawCode.MOHR, {"TPHI": 0.6, "TPSI": 0.2, "COHE": 1e4, "FTRC": 5e3}),
    "lead": (LawCode.LEAD, {"QD": 3e4, "KPOS": 6e6, "ETA": 1.0, "BETA": 0.5}),
    "slider": (LawCode.PENDULUM, {"RAYO": 2.0, "FROT": 0.06}),
}


def path_of(seed, d, pressed):
    """Opening and closing, sliding both ways, unequal along t1 and t2; or pressed all the time."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-1.0, 1.0, (7, d)) * [*(4e-4, 1.7e-3)[: d - 1], 2.3e-4]
    corners[0] = 0.0
    corners[:, -1] -= 4e-5
    corners[0, -1] = 0.0
    if pressed:
        corners[1:, -1] = -1e-4
        corners[1, :-1] = 0.0
    part = np.linspace(0.0, 1.0, FINE + 1)[1:, None]
    return np.vstack([a + part * (b - a) for a, b in itertools.pairwise(corners)])


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("name", LAWS)
def test_work_is_stored_and_lost(name, seed, d):
    code, given = LAWS[name]
    p = np.zeros((1, N_PARAMETERS))
    for parameter, value in {"KN": KN, "KS1": KS, "KS2": 0.4 * KS, **given}.items():
        p[0, Parameter[parameter]] = value
    state, new = np.zeros((1, N_STATE)), np.zeros((1, N_STATE))
    t, D, codes = np.zeros((1, d)), np.zeros((1, d, d)), np.array([int(code)])
    before, push, work, moved, lost = np.zeros(d), np.zeros(d), 0.0, 0.0, 0.0
    for w in path_of(seed, d, name == "slider"):
        respond(codes, w[None], state, p, t, new, D)
        done = 0.5 * (push + t[0]) @ (w - before)
        stored, gone = point_energies(int(code), w, t[0], new[0], p[0])
        assert gone >= lost - 1e-9 * moved
        before, push, work, moved, lost = w, t[0].copy(), work + done, moved + abs(done), gone
        state[:] = new
    assert stored + lost == pytest.approx(work, abs=3e-3 * moved)
    assert moved > 0.0
