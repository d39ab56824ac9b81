"""The bonded joint: tractions, tangent and energy of three springs."""

import numpy as np
import pytest
from references.law_points import energies
from together import together

from ssilang.kernel.interface.laws.columns import N_PARAMETERS, N_STATE, LawCode, Parameter
from ssilang.kernel.interface.laws.point_laws import respond


@together("d", [2, 3])
def test_a_bonded_joint_is_its_springs(d):
    rng = np.random.default_rng(4)
    springs = {"KS1": 3e8, "KS2": 5e8, "KN": 7e8}
    p = np.zeros((20, N_PARAMETERS))
    for name, value in springs.items():
        p[:, Parameter[name]] = value
    k = np.array([3e8, 7e8] if d == 2 else [3e8, 5e8, 7e8])
    w = rng.uniform(-1e-3, 1e-3, (20, d))
    t, new, D = np.ones((20, d)), np.ones((20, N_STATE)), np.ones((20, d, d))
    state = np.zeros((20, N_STATE))
    respond(np.full(20, int(LawCode.ELASTIC)), w, state, p, t, new, D)
    np.testing.assert_allclose(t, k * w, rtol=1e-15)
    np.testing.assert_allclose(D, np.tile(np.diag(k), (20, 1, 1)), rtol=1e-15)
    np.testing.assert_array_equal(new, state)
    stored, lost = energies(int(LawCode.ELASTIC), w[0], t[0], new[0], p[0])
    assert stored == pytest.approx(0.5 * k @ w[0] ** 2, rel=1e-14)
    assert lost == 0.0
