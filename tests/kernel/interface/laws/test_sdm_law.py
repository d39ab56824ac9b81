"""The SDM law: closed form, path, energies, tangent, limits; refused parameters."""

import itertools
from functools import partial

import numpy as np
import pytest
from references import law_points
from references.sdm_arrays import normal_arrays, shear_arrays
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.interface.laws.columns import (
    CLOSED_SHEAR,
    N_STATE,
    OPEN_SHEAR,
    Parameter,
    Variable,
)
from ssilang.kernel.interface.laws.sdm_law import check_sdm_parameters, normal_law

SDM = 1
parameters = partial(
    law_points.table_of, KN=1e9, KS1=4e8, KS2=3e8, FU=0.0, GF=0.0, FC=0.0, FROT=-1.0
)
answer, walk = partial(law_points.answer, SDM), partial(law_points.walk, SDM)


def test_iteration_gives_lamberts_closed_form():
    rng = np.random.default_rng(3)
    k = 10.0 ** rng.uniform(6, 11, 500)
    fu = 10.0 ** rng.uniform(3, 6, 500) * (rng.random(500) > 0.2)
    gf = np.where(fu > 0, fu**2 / k * rng.uniform(1.01, 50, 500), 0.0)
    fc = -(10.0 ** rng.uniform(2, 6, 500)) * (rng.random(500) > 0.3)
    length = np.where(fu > 0, gf / np.maximum(fu, 1.0), 1e-3)
    xi, w = rng.uniform(0, 2, 500) * length, rng.uniform(-3, 4, 500) * length
    t, new, slope = normal_arrays(w, xi, k, fu, gf, fc)
    for i in range(500):
        found = normal_law(w[i], xi[i], k[i], fu[i], gf[i], fc[i])
        assert found[0] == pytest.approx(t[i], rel=1e-9, abs=1e-9 * k[i] * length[i])
        assert found[1] == pytest.approx(new[i], rel=1e-9, abs=1e-12 * length[i])
        assert found[2] == pytest.approx(slope[i], rel=1e-6, abs=1e-9 * k[i])


@together("d", [2, 3])
def test_points_take_the_tractions_and_slips_of_the_arrays(d):
    """Paths through opening, sliding and closing; one shear direction in three has no stiffness."""
    rng, n = np.random.default_rng(d), 300
    p = parameters(n, GF=20.0)
    p[:, Parameter.FU] = np.where(rng.random(n) < 0.4, 1e5, 0.0)
    p[:, Parameter.FROT] = np.where(rng.random(n) < 0.5, 0.6, -1.0)
    columns = [Parameter.KS1, Parameter.KS2][: d - 1]
    stiffness = p[:, columns] * (rng.random((n, d - 1)) < 0.67)
    p[:, columns] = stiffness
    k, fu, gf, fc, friction = (p[:, Parameter[name]] for name in ("KN", "FU", "GF", "FC", "FROT"))
    state, xi, slip = np.zeros((n, N_STATE)), np.zeros(n), np.zeros((n, d - 1))
    seen = set()
    for _ in range(12):
        w = rng.normal(scale=3e-4, size=(n, d))
        damage = state[:, Variable.DAMAGE]
        t, state, _ = answer(w, state, p)
        tn, xi, _ = normal_arrays(w[:, -1], xi, k, fu, gf, fc)
        shear, slip = shear_arrays(w[:, :-1], slip, damage, stiffness, tn, xi, fu, gf, friction)
        np.testing.assert_allclose(t[:, -1], tn, rtol=1e-9, atol=1e-4)
        np.testing.assert_allclose(t[:, :-1], shear, rtol=1e-9, atol=1e-4)
        np.testing.assert_allclose(
            state[:, Variable.SLIP1 : Variable.SLIP1 + d - 1], slip, rtol=1e-9, atol=1e-15
        )
        seen |= set(zip((tn < 0.0).tolist(), (fu > 0.0).tolist(), strict=True))
    assert len(seen) == 4
    assert not slip[stiffness == 0.0].any()  # never slides, never records a slip
    assert slip[stiffness > 0.0].any()


def test_path_does_not_depend_on_the_steps():
    p = parameters(FU=1e5, GF=20.0, FC=-2e4)
    corners = np.array([0.0, 3e-4, -1e-4, 6e-4, 1e-5, 9e-4, -5e-4, 2e-4])
    fine = np.concatenate([np.linspace(a, b, 400)[1:] for a, b in itertools.pairwise(corners)])
    coarse, _ = walk(np.stack([0 * corners, corners], 1)[1:], p)
    detailed, _ = walk(np.stack([0 * fine, fine], 1), p)
    np.testing.assert_allclose(detailed[398::399], coarse, rtol=1e-9, atol=1e-4)


def test_without_strength_it_is_the_unilateral_spring():
    p = parameters()
    w = np.stack([np.zeros(41), np.linspace(-1e-3, 1e-3, 41)], 1)
    t, _ = walk(np.concatenate([w, w[::-1]]), p)
    expected = 1e9 * np.minimum(np.concatenate([w, w[::-1]])[:, 1], 0.0)
    np.testing.assert_allclose(t[:, 1], expected, atol=1e-12 * 1e6)


def test_friction_bounds_the_shear_and_counts_its_loss():
    p = parameters(FROT=0.5)
    s = np.linspace(0, 2e-3, 2001)
    path = np.stack([s, np.full_like(s, -1e-3)], 1)
    t, states = walk(path, p)
    assert t[:, 0].max() == pytest.approx(0.5 * 1e6, rel=1e-12)
    slipped = 2e-3 - 0.5e6 / 4e8
    assert states[-1, Variable.SHEAR_LOSS] == pytest.approx(0.5e6 * slipped, rel=1e-9)


def test_shear_is_lost_when_open_and_starts_anew_when_closed():
    t, _ = walk(np.array([[1e-3, -1e-3], [1e-3, 1e-4], [3e-3, -1e-3]]), parameters())
    np.testing.assert_allclose(t[:, 0], [4e5, 0.0, 4e8 * 2e-3])


@together("normal", [-1e-4, 2e-4])
def test_elastic_shear_stores_its_work_at_any_opening(normal):
    p = parameters(SHEAR=1.0)
    path = np.array([[0.0, normal], [1e-4, normal], [3e-4, normal], [-2e-4, normal]])
    t, states = walk(path, p)
    np.testing.assert_allclose(t[:, 0], 4e8 * path[:, 0], rtol=1e-12)
    np.testing.assert_allclose(states[:, Variable.SHEAR_ENERGY], 2e8 * path[:, 0] ** 2, rtol=1e-12)
    assert not states[:, Variable.SHEAR_LOSS].any()


def test_too_soft_a_joint_is_refused_with_the_least_stiffness():
    with pytest.raises(MaterialError) as error:
        check_sdm_parameters(parameters(KN=4e8, FU=1e5, GF=20.0))
    assert "5e+08" in str(error.value)
    check_sdm_parameters(parameters(KN=6e8, FU=1e5, GF=20.0))
    brittle = [parameters(KN=kn, FU=fu) for kn, fu in ((4e8, 5e4), (9e8, 1e5), (1e7, 0.0))]
    with pytest.raises(MaterialError, check=lambda e: e.data == {"fu": 1e5, "fu_2": 25.0}):
        check_sdm_parameters(np.concatenate(brittle))


@together("code, wrong", [("parameter-must", {"KN": 0.0}), ("parameter-must", {"KS1": -1.0}),
     ("parameter-must", {"FC": 1.0}), ("parameter-must", {"FU": -1.0}),
     ("fu-gf-perfectly", {"FU": 1e5}), ("parameter-not-finite", {"KN": np.nan})])  # fmt: skip
def test_inadmissible_parameters_are_refused(code, wrong):
    with pytest.raises(
        MaterialError,
        check=lambda e: (
            e.code == f"kernel.interface.joint-{code}" and e.data.get("name") in {*wrong, None}
        ),
    ):
        check_sdm_parameters(parameters(**wrong))


@together("size", [1.0, 1e-6, 1e-9])
def test_softening_lies_on_its_curve_whatever_the_unit_of_length(size):
    """Openings of `size` times 1e-4: t = fu exp(-fu xi / gf) = k (w - xi)."""
    k, fu, gf = 1e9 / size, 1e5, 20.0 * size
    t, xi, slope = normal_law(3e-4 * size, 0.0, k, fu, gf, 0.0)
    assert t == pytest.approx(k * (3e-4 * size - xi), rel=1e-11)
    assert t == pytest.approx(fu * np.exp(-fu * xi / gf), rel=1e-11)
    h = 1e-8 * size
    ends = [normal_law(3e-4 * size + s * h, 0.0, k, fu, gf, 0.0)[0] for s in (1, -1)]
    assert slope == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-5)


def test_slipped_points_store_the_work_of_their_traction_alone():
    """Shear stops at 0.5e6: stored t^2 / (2 KS1), on the way back too; opening gives it up."""
    path = np.array([[2e-3, -1e-3], [1.9e-3, -1e-3], [1.9e-3, 1e-4]])
    t, states = walk(path, parameters(FROT=0.5))
    np.testing.assert_allclose(t[:, 0], [5e5, 5e5 - 4e4, 0.0], rtol=1e-12)
    stored = states[:, Variable.SHEAR_ENERGY]
    np.testing.assert_allclose(stored, t[:, 0] ** 2 / 8e8, rtol=1e-12)
    lost = np.diff(states[:, Variable.SHEAR_LOSS])
    np.testing.assert_allclose(lost, [0.0, stored[1]], rtol=1e-12, atol=1e-9)


@together("held, kept", [(CLOSED_SHEAR, True), (OPEN_SHEAR, False)])
@together("normal", [-1e-4, 1e-4])
def test_shear_that_a_step_holds_is_kept_or_given_up_with_its_energy(held, kept, normal):
    """HELD decides, whatever the normal traction does meanwhile."""
    p = parameters()
    _, states = walk(np.array([[1e-3, -1e-3]]), p)
    state = states[-1:].copy()
    state[:, Variable.HELD] = held
    t, new, _ = answer(np.array([[1e-3, normal]]), state, p)
    assert t[0, 0] == pytest.approx(4e5 if kept else 0.0)
    assert new[0, Variable.SHEAR_ENERGY] == pytest.approx(200.0 if kept else 0.0)
    assert new[0, Variable.SHEAR_LOSS] == pytest.approx(0.0 if kept else 200.0)


def test_what_closes_keeps_the_shear_that_is_left_and_loses_energy():
    """Opened to a damage, sheared, then pressed without moving along: closed forms."""
    fu, gf, e = 1e5, 20.0, 2e-4
    p = parameters(FU=fu, GF=gf, FC=-2e4)
    t, states = walk([[0.0, 4e-4], [e, 4e-4], [e, -1e-3], [1.5 * e, -1e-3]], p)
    left = 1.0 - states[1, Variable.DAMAGE]
    ks = p[0, Parameter.KS1]
    assert 0.1 < left < 0.9
    assert t[2, 0] == pytest.approx(t[1, 0])  # left * ks * e
    assert t[3, 0] == pytest.approx(ks * e * (left + 0.5))  # from there as stiff as before
    stored = states[:, Variable.SHEAR_ENERGY]
    lost = states[:, Variable.SHEAR_LOSS]
    assert stored[1:3] == pytest.approx(0.5 * ks * e**2 * np.array([left, left**2]))
    assert lost[2] - lost[1] == pytest.approx(stored[1] - stored[2])
    assert lost[3] == lost[2]
