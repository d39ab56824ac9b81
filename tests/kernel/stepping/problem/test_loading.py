"""Loads as vectors times curves, supports that move too: each part by its own curve."""

import numpy as np
import pytest
from references.assembled import Bench
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark_of
from ssilang.kernel.stepping.problem.loading import loading_of
from ssilang.kernel.stepping.problem.moving_supports import Course
from ssilang.kernel.stepping.run import integrate


@pytest.fixture
def bench():
    b = Bench()
    b.n = [b.node(0.0, 0.0), b.node(1.0, 0.0)]
    for k, n in enumerate(b.n):
        b.spring(2e4 * (k + 1), n)
        b.mass(3.0 + k, n, ("UY",))
    b.mark = b.relate([(1.0, "UY", b.n[1])])
    return b


def test_parts_constant_in_time_and_by_steps_have_their_curves(bench):
    b = bench
    numbering, at = numbering_of(b.stiffness), np.array([b.mark])
    one, two, three = (
        b.field((b.n[0], "FY", 10.0 * k), (b.mark, "FLX", 0.1 * k)) for k in (1, 2, 3)
    )
    curve = Curve((CurvePart(np.array([0.0, 2.0]), np.array([1.0, 5.0])),))
    parts = (LoadPart("FORC", one), LoadPart("MECA", two, curve),
             LoadPart("DIMP", None, None, ((1.0, three), (3.0, one))))  # fmt: skip
    loading = loading_of(Load(parts), numbering, at)
    times = np.array([0.0, 1.0, 1.5, 3.0, 4.0])
    first = numbering.index_of(b.n[0], "UY")
    total = 10 + 20 * np.interp(times, [0, 2], [1, 5]) + np.interp(times, [1, 3], [30, 10])
    np.testing.assert_allclose((loading.at(times) @ loading.forces.T)[:, first], total)
    np.testing.assert_allclose((loading.at(times) @ loading.imposed.T)[:, 0], 0.01 * total)
    none = loading_of(None, numbering, at)
    assert none.at(times).shape == (5, 0)
    assert none.forces.shape == (numbering.size, 0)


def test_what_is_no_force_or_finds_no_unknown_is_refused(bench):
    numbering, at = numbering_of(bench.stiffness), np.array([bench.mark])
    force = bench.field((bench.n[0], "FY", 1.0))
    for part, match in (
        (LoadPart("T", force), "T"), (LoadPart("MECA", 3.0), "nod"),
        (LoadPart("MECA", bench.field((bench.n[0], "FZ", 1.0))), "FZ"),
    ):  # fmt: skip
        with pytest.raises(FieldError, match=match):
            loading_of(Load((part,)), numbering, at)


def test_a_joint_that_stays_closed_takes_one_iteration():
    b = Bench()
    low, top = b.node(0.0, -1.0), b.node(0.0, 0.0)
    b.fix(low)
    b.fix(top, "UX")
    b.mass(5.0, top)
    b.spring(1e3, top)
    b.joint("SEG2", [low, top], "JOI1", KN=1e5, KS=0.0, V1X=0.0, V1Y=1.0)
    t = 1e-3 * np.arange(30)
    load = Load(b.load(b.field((top, "FY", -100.0)), t, 1 + 0.1 * np.sin(50 * t)).parts)
    start = b.field((top, "UY", -100.0 / 1.01e5))
    problem = b.problem(t, load, displacement=start)
    assert integrate(problem, []).iterations == 1


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
