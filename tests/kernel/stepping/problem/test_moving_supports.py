"""Curves of imposed values as loads."""

import numpy as np
from together import together

from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark_of
from ssilang.kernel.stepping.problem.moving_supports import Course


@together("scheme", [Scheme(), hht(-0.2), generalised_alpha(0.6)])
def test_weighted_by_the_scheme_s_forces_the_inertia_is_that_of_its_accelerations(scheme):
    """alpha_f f_k + (1 - alpha_f) f_(k+1) = alpha_m c''_k + (1 - alpha_m) c''_(k+1)."""
    c, v, a = np.random.default_rng(4).normal(size=(3, 20, 2))
    loads = Course(c, v, a).factors(newmark_of(scheme, 0.01))
    inertia = loads[:, :2]
    forces = scheme.alpha_f * inertia[:-1] + (1 - scheme.alpha_f) * inertia[1:]
    wanted = scheme.alpha_m * a[:-1] + (1 - scheme.alpha_m) * a[1:]
    np.testing.assert_allclose(forces, wanted, rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(loads[:, 2:4], v)
    np.testing.assert_array_equal(loads[:, 4:], c)
