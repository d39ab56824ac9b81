"""Elastic moduli against what defines them: inverses, rotations, hypotheses."""

import numpy as np
import pytest

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.elasticity import (
    isotropic_compliance,
    isotropic_moduli,
    orthotropic_compliance,
    reduced_moduli,
    rotated_moduli,
)
from ssilang.kernel.materials.model import Mode

E, NU = np.array(3.0e10), np.array(0.2)
WOOD = {
    k: np.array(v)
    for k, v in {
        "YG1": 12e9, "YG2": 1e9, "YG3": 0.8e9, "NU12": 0.3, "NU23": 0.4, "NU13": 0.25,
        "G12": 0.7e9, "G23": 0.1e9, "G13": 0.6e9,
    }.items()
}  # fmt: skip


def test_moduli_and_compliance_are_inverse():
    np.testing.assert_allclose(
        isotropic_moduli(E, NU) @ isotropic_compliance(E, NU), np.eye(6), atol=1e-12
    )


def test_isotropic_moduli_do_not_depend_on_axes():
    q, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    D = isotropic_moduli(E, NU)
    np.testing.assert_allclose(rotated_moduli(D, q.T), D, rtol=1e-9, atol=1e-3)


def test_quarter_turn_exchanges_the_orthotropic_axes():
    D = np.linalg.inv(orthotropic_compliance(WOOD))
    turned = rotated_moduli(D, np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]))
    order = [1, 0, 2, 3, 5, 4]
    np.testing.assert_allclose(turned, D[np.ix_(order, order)], rtol=1e-12, atol=1e-3)


def test_plane_stress_leaves_no_stress_across():
    D = reduced_moduli(isotropic_moduli(E, NU), Mode.PLANE_STRESS)
    k = E / (1 - NU**2)
    np.testing.assert_allclose(D[:2, :2], [[k, k * NU], [k * NU, k]])
    assert not D[2].any()
    assert not D[:, 2].any()


def test_unstable_orthotropic_constants_are_refused():
    with pytest.raises(MaterialError, match="stable"):
        orthotropic_compliance({**WOOD, "NU12": np.array(4.0)})
