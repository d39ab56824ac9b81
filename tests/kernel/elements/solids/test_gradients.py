"""Gradients of one component, and logarithmic strains of gradients in every hypothesis."""

import numpy as np
import scipy.linalg as la
from together import together

from ssilang.kernel.elements.solids.gradients import (
    gradient_names,
    logarithmic_strain,
    scalar_gradient,
)
from ssilang.kernel.materials.model import Mode
from tests.kernel.elements.samples import cell_zone, field


@together("element, mode", [("QUA8", Mode.PLANE_STRAIN), ("CU20", Mode.THREE_DIMENSIONAL)])
def test_a_linear_component_has_one_gradient(element, mode):
    zone = cell_zone(element, mode)
    found = scalar_gradient(zone, field(zone, T=lambda x: 3 * x[:, 0] - 2 * x[:, 1] + x[:, 2]), "T")
    d = mode.dimension
    np.testing.assert_allclose(
        found[0], np.broadcast_to(np.array([3.0, -2.0, 1.0])[:d, None], found[0].shape)
    )


@together("of_displacement", [False, True])
@together("mode", [Mode.PLANE_STRAIN, Mode.PLANE_STRESS, Mode.AXISYMMETRIC, Mode.THREE_DIMENSIONAL])
def test_logarithmic_strains_are_those_of_the_matrix_logarithm(mode, of_displacement):
    space = mode is Mode.THREE_DIMENSIONAL
    zone = cell_zone("CUB8" if space else "QUA4", mode)
    d = 3 if space else 2
    rng = np.random.default_rng(1)
    p = 4
    F = np.eye(3)[None] + 0.0 * np.ones((p, 1, 1))
    F[:, :d, :d] += 0.3 * rng.standard_normal((p, d, d))
    if mode is Mode.AXISYMMETRIC:
        F[:, 2, 2] = rng.uniform(0.8, 1.3, p)
    given = F - np.eye(3) if of_displacement else F
    flat = given[:, :d, :d].reshape(p, -1).T
    if mode is Mode.AXISYMMETRIC:
        flat = np.vstack([flat, given[:, 2, 2]])
    assert len(flat) == len(gradient_names(zone))
    found = logarithmic_strain(zone, flat[None], of_displacement)
    for k in range(p):
        E = 0.5 * la.logm(F[k].T @ F[k])
        rows = [E[0, 0], E[1, 1], E[2, 2], 2 * E[0, 1], 2 * E[0, 2], 2 * E[1, 2]]
        np.testing.assert_allclose(found[0, :, k], rows[: found.shape[1]], atol=1e-10)
