"""Mean tractions of a step against the work of the law along it."""

import numpy as np
from references.law_points import energies as energies_at
from together import together

from ssilang.kernel.interface.laws.columns import (
    N_PARAMETERS,
    N_STATE,
    LawCode,
    Parameter,
)
from ssilang.kernel.interface.response import (
    InterfaceState,
    Joints,
    interface_response,
    mean_response,
    new_trial,
)

KN, KS = 3e8, 1.1e8
LAWS = {
    "opens": {"FU": 0.0, "FC": 0.0, "FROT": -1.0},
    "bonded": {"FU": 2e4, "GF": 15.0, "FC": 0.0, "FROT": 0.4},
    "bonded, closes late": {"FU": 2e4, "GF": 15.0, "FC": -1e4, "FROT": -1.0},
}


@together("d", [2, 3])
@together("name", LAWS)
def test_mean_traction_times_step_is_what_is_stored_and_lost(name, d):
    """Also where a step opens, closes, tears and rests; its tangent by differences."""
    rng, n = np.random.default_rng(9), 60
    p = np.zeros((n, N_PARAMETERS))
    for parameter, value in {"KN": KN, "KS1": KS, "KS2": 0.4 * KS, **LAWS[name]}.items():
        p[:, Parameter[parameter]] = value
    scales = rng.uniform(0.5, 1.5, n)
    p[:, Parameter.KN] *= scales
    pairs, B = np.arange(n)[::-1, None].copy(), np.tile(np.eye(d), (n, 1, 1))
    weights, codes = rng.uniform(0.5, 2.0, n), np.full(n, int(LawCode.SDM))
    joints = Joints(pairs, B, weights, codes, p)
    zero = np.zeros
    now = InterfaceState(zero(n * d), zero(n * d), zero((n, d)), zero((n, d)), zero((n, N_STATE)))

    def answered(w):
        end = new_trial((n, d), n * d, mean=True)
        interface_response(joints, now.state, w[::-1].ravel(), end)
        mean_response(joints, now, end)
        return end, end.mean

    def energies(w, t, state):
        return np.array([energies_at(1, *one) for one in zip(w, t, state, p, strict=True)])

    changed = 0
    for size in (1e-4, 4e-4, 1e-3, 4e-4, 1e-3, 2e-4, 1e-3):
        w = rng.uniform(-1.0, 1.0, (n, d)) * size
        w[::7] = now.w[::7]
        w[1::7, -1] = p[1::7, Parameter.FC] / p[1::7, Parameter.KN] + 0.05 * w[1::7, -1]
        end, tm = answered(w)
        np.testing.assert_allclose(end.w, w, rtol=1e-12)
        step = energies(w, end.t, end.state) - energies(now.w, now.t, now.state)
        work = np.vecdot(tm, w - now.w)
        scale = np.abs(work).max()
        np.testing.assert_allclose(step.sum(axis=1), work, atol=1e-9 * scale)
        np.testing.assert_allclose(end.f.reshape(n, d), (weights[:, None] * tm)[::-1], rtol=1e-12)
        ways = [(answered(w + h)[1] - answered(w - h)[1]) / 2e-9 for h in 1e-9 * np.eye(d)]
        slopes, moved = np.stack(ways, axis=2), np.arange(n) % 7 > 0
        np.testing.assert_allclose(end.D[moved], slopes[moved], rtol=1e-5, atol=1e-6 * KN)
        changed += np.sum((end.t[:, -1] < 0.0) != (now.t[:, -1] < 0.0))
        now = InterfaceState(now.delta, end.f, w, end.t, end.state)
    assert changed > 50
