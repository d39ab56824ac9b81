"""Modified Cam-Clay against closed forms: compression, undrained shear, critical state, energy."""

import math

import numpy as np
import pytest
from refusing import refusal
from scipy.integrate import solve_ivp
from together import together

from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.materials.plastic.laws import PLASTIC_LAWS, check_parameters
from ssilang.kernel.materials.plastic.response import PointParameters, mises

E0, M, P0, KAPPA, LAMBDA, G = 1.0, 1.2, 1e5, 0.05, 0.2, 8e6
GIVEN = {
    "YOUN": 2e7, "NU": 0.3, "E0": E0, "M": M, "P0": P0, "KAPA": KAPPA, "LAMD": LAMBDA, "G1": G,
    "COHE": 0.0,
}  # fmt: skip
CLAY = PLASTIC_LAWS["CAM_CLAY"]
COMPRESSION = np.array([-1, -1, -1, 0, 0, 0]) / 3
SHEAR = np.array([-1, 0.5, 0.5, 0, 0, 0])  # of constant volume


def points(m=1, **change):
    values = {**GIVEN, **change}
    return PointParameters({n: np.full(m, float(v)) for n, v in values.items()}, {})


def strained(path, p=None, stress=None):
    """The last answer on a path of strain steps (k, 6), from a stress (6,)."""
    p = p or points()
    now = np.zeros((1, 6)) if stress is None else np.array([stress], float)
    variables, out = np.zeros((1, 2)), []
    for step in path:
        found = CLAY.respond(p, now, np.array([step]), variables)
        now, variables = found.stress, found.variables
        out.append(found)
    return out


def pressure(found):
    return -found.stress[0, :3].sum() / 3


def isotropic(p):
    return np.array([-p, -p, -p, 0, 0, 0])


@together("n", [1, 7])
def test_compression_follows_both_lines_of_the_logarithm_of_the_pressure(n):
    """The void ratio falls by KAPA ln p up to P0, by LAMD ln p beyond, rises by KAPA back."""
    first = KAPPA / (1 + E0) * math.log(P0 / 2e4)
    second = LAMBDA / (1 + E0) * math.log(3.0)
    back = KAPPA / (1 + E0) * math.log(6.0)
    path = [COMPRESSION * first / n] * n + [COMPRESSION * second / n] * n
    path += [-COMPRESSION * back / n] * n
    found = strained(path, stress=isotropic(2e4))
    assert pressure(found[n - 1]) == pytest.approx(P0, rel=1e-10)
    assert pressure(found[2 * n - 1]) == pytest.approx(3 * P0, rel=1e-9)
    assert pressure(found[-1]) == pytest.approx(0.5 * P0, rel=1e-9)


@pytest.mark.parametrize("n", [3, 50])
def test_undrained_shear_follows_its_closed_form_to_the_critical_state(n):
    """Constant volume: pc = P0 (P0 / p)^(KAPA / (LAMD - KAPA)), q = M sqrt(p (pc - p))."""
    found = strained([SHEAR * 0.9 / n] * n, stress=isotropic(P0))
    for answer in found:
        p, q = pressure(answer), mises(answer.stress)[0][0]
        pc = P0 * (P0 / p) ** (KAPPA / (LAMBDA - KAPPA))
        assert q == pytest.approx(M * math.sqrt(p * (pc - p)), rel=1e-6)
    p_end = P0 * 0.5 ** ((LAMBDA - KAPPA) / LAMBDA)
    assert pressure(found[-1]) == pytest.approx(p_end, rel=1e-3)
    assert mises(found[-1].stress)[0][0] == pytest.approx(M * p_end, rel=1e-3)


def test_overconsolidated_clay_swells_when_it_is_sheared_under_a_constant_pressure():
    """Drained shear: the pressure is kept by expanding; it ends at q = M p."""
    stress, variables = np.array([isotropic(2e4)]), np.zeros((1, 2))
    p, volume = points(), 0.0
    tops = []
    for _ in range(40):
        swell = 0.0
        for _ in range(30):
            step = SHEAR * 1e-2 + swell * np.array([1, 1, 1, 0, 0, 0]) / 3
            found = CLAY.respond(p, stress, step[None], variables)
            rest = 2e4 - pressure(found)
            if abs(rest) < 1e-7:
                break
            K = (found.tangent[0] @ (np.array([1, 1, 1, 0, 0, 0]) / 3))[:3].sum() / 3
            swell -= rest / K
        stress, variables, volume = found.stress, found.variables, volume + swell
        tops.append(mises(stress)[0][0])
    assert volume > 0.01
    assert tops[-1] == pytest.approx(M * 2e4, rel=2e-2)
    assert max(tops) > 1.3 * tops[-1]  # and was stronger before it softened


def test_tangent_is_the_derivative_of_the_stress():
    m, rng = 60, np.random.default_rng(2)
    p = points(m)
    start = np.tile(isotropic(0.7 * P0), (m, 1)) + 1e4 * rng.normal(size=(m, 6))
    strain = 8e-3 * rng.normal(size=(m, 6))
    strain[:, :3] -= 6e-3 * rng.random((m, 1))
    variables = np.zeros((m, 2))
    found = CLAY.respond(p, start, strain, variables)
    assert 0.4 < (found.variables[:, 0] > 0).mean() <= 1.0
    h = 1e-8
    for j in range(6):
        shift = np.zeros((m, 6))
        shift[:, j] = h
        ends = [CLAY.respond(p, start, strain + s * shift, variables).stress for s in (1, -1)]
        wanted = (ends[0] - ends[1]) / (2 * h)
        # central differences at 1e-8 of stresses of 1e5: a part in 1e7 of the moduli
        assert np.abs(found.tangent[:, :, j] - wanted).max() < 1e-5 * np.abs(wanted).max()


def test_stored_and_lost_energy_is_the_work():
    """The elasticity has an energy: work less what is stored is never given back."""
    rng = np.random.default_rng(7)
    legs = [SHEAR * 0.02, COMPRESSION * 0.05, -SHEAR * 0.03, -COMPRESSION * 0.02]
    path = [leg / 100 for leg in legs for _ in range(100)]
    p, now, variables = points(), np.array([isotropic(6e4)]), np.zeros((1, 2))

    def stored(stress):
        linear = 0.5 * np.einsum("mi,mij,mj->m", stress, p.compliance, stress)
        return (linear + CLAY.locked(p, stress, variables))[0]

    before, lost = stored(now), [0.0]
    for step in path:
        found = CLAY.respond(p, now, np.array([step]), variables)
        work = 0.5 * (now + found.stress)[0] @ step
        now, variables = found.stress, found.variables
        after = stored(now)
        lost.append(lost[-1] + work - (after - before))
        before = after
    assert np.diff(lost).min() > -1e-4 * lost[-1]  # the mean of both ends, in a hundred steps
    assert lost[-1] > 100.0
    # inside the surface nothing is lost, whatever the cycle
    small = list(1e-4 * rng.normal(size=(50, 6)))
    cycle = strained([*small, -np.sum(small, axis=0)], stress=isotropic(5e4))
    assert pressure(cycle[-1]) == pytest.approx(5e4, rel=1e-10)


def test_elastic_strain_is_what_the_logarithm_and_the_shear_modulus_give():
    step = COMPRESSION * 0.08 + SHEAR * 0.01
    found = strained([step], stress=isotropic(5e4))[-1]
    p, s = pressure(found), mises(found.stress)[1][0]
    volume = KAPPA / (1 + E0) * math.log(p / 5e4)
    wanted = s / (2 * G) - volume / 3 * np.array([1, 1, 1, 0, 0, 0])
    np.testing.assert_allclose(found.elastic[0], wanted, atol=1e-12)


def test_clay_without_stress_begins_with_a_stiffness():
    found = strained([COMPRESSION * 1e-6])
    assert pressure(found[-1]) == pytest.approx((1 + E0) / KAPPA * 0.01 * P0 * 1e-6, rel=1e-9)
    far = strained([COMPRESSION * 0.2])
    assert np.isfinite(far[-1].stress).all()
    pulled = strained([COMPRESSION * 0.02, -COMPRESSION * 0.2])
    assert -1e-3 <= pressure(pulled[-1]) < 0.05 * P0


@together("change, code", [({"COHE": 1e3}, "clay-cohesion"), ({"LAMD": 0.04}, "law-condition")])
def test_clay_without_an_ellipse_is_refused(change, code):
    with refusal(MaterialError, f"kernel.materials.{code}"):
        check_parameters(CLAY, points(**change))


def test_oedometric_compression_follows_the_equations_of_the_law():
    """One-dimensional compression of a virgin clay, against its equations integrated by scipy.

    On the ellipse F = q^2 / M^2 + p (p - pc) = 0 the flow is (2 p - pc) of volume for 2 q / M^2 of
    deviator; a rate of strain 1 along the axis and 0 across has a volume of 1 and a deviator of
    2/3. The multiplier follows from dF = 0.
    """
    soft, hard = (1 + E0) / KAPPA, (1 + E0) / (LAMBDA - KAPPA)

    def rates(_, y):
        p, q, pc = y
        volume, deviator = 2 * p - pc, 2 * q / M**2
        bulk, decay = soft * p, hard * pc
        elastic = volume * bulk + deviator * 3 * G * (2 / 3)
        phi = elastic / (volume * bulk * volume + deviator * 3 * G * deviator + p * decay * volume)
        return (
            bulk * (1 - phi * volume), 3 * G * (2 / 3 - phi * deviator), decay * phi * volume,
        )  # fmt: skip

    end, n = 0.15, 500
    exact = solve_ivp(rates, (0, end), (P0, 0.0, P0), rtol=1e-10, atol=1e-6).y[:, -1]
    found = strained([np.array([-end / n, 0, 0, 0, 0, 0])] * n, stress=isotropic(P0))[-1]
    p, q = pressure(found), mises(found.stress)[0][0]
    assert (p, q) == pytest.approx(tuple(exact[:2]), rel=1e-3)
    assert q == pytest.approx(found.stress[0, 1] - found.stress[0, 0])
